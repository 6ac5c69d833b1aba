/// Scenes at several times from one growth.
#include "built.h"

#include "frond/sequence.h"

#include <math.h>

#define TREE "<plant id='t'><species model='open' step='0.3' auxin-reach='1' leaves='1'/></plant>"
#define ASKING                                                                                     \
    "<plant id='l'><lsystem><![CDATA[\nderivation length: 7\nw : D(?,?)?E(0)A\n"                   \
    "p : D(d,a) > ?E(e) : a > 0.2 -> F(0.1)[+(60)f(0.1)]D(?,?)\n"                                  \
    "q : ?E(e) -> F(0.02*e)?E(0)\n]]></lsystem></plant>"
#define STAKE(growth)                                                                              \
    "<plant id='s'><pgraph><camera id='root'/><tree id='stem' length='1.5' radius='0.1' " growth   \
    "/><link from='root' to='stem'/></pgraph></plant>"
#define WORLD "<growth steps='6' min='-4,-4,-1' max='4,4,6' cell='0.05'/><place plant='t'/>"
#define SCENE(plants, places)                                                                      \
    "<frond version='1'>" plants "<scene frame-time='1'>" places "</scene></frond>"

static const char only_buds[] = SCENE(TREE, WORLD);
static const char mixed[] =
    SCENE(TREE ASKING STAKE(""), "<light/>" WORLD "<place plant='l' at='0.4,0,0'/>"
                                 "<place plant='l' at='-0.5,0,0'/><place plant='s' at='0,0.4,0'/>"
                                 "<obstacle at='1,0,1' size='0.5,0.5,0.5'/>");
static const char only_asking[] = SCENE(ASKING, "<light/><place plant='l' at='0.3,0,0'/>"
                                                "<place plant='l'/>");
static const char clocked[] =
    SCENE(TREE STAKE("growth='9'"), WORLD "<place plant='s' at='0.1,0,0'/>");

typedef struct Run {
    FrContext context;
    FrDocument *document;
    FrSceneOptions options;
    uint64_t steps; ///< made so far
} Run;

static FrStatus count_step(void *data, const FrSimulation *simulation, const FrContext *context) {
    (void)simulation, (void)context;
    ((Run *)data)->steps++;
    return FR_OK;
}

static void begin(Run *run, const char *text) {
    *run = (Run){.context = fr_context_default(),
                 .options = {.seed = -1, .steps = -1, .after_step = count_step, .data = run}};
    run->context.diags = fr_diags_new();
    FrSource *source = fr_source_new("wood.frond", text, strlen(text));
    g_assert_cmpint(fr_document_parse(source, NULL, &run->context, &run->document), ==, FR_OK);
    fr_source_unref(source);
}

static void end(Run *run) {
    fr_document_free(run->document);
    fr_diags_free(run->context.diags);
}

static FrDigest digest_apart(Run *run, double time) {
    FrSceneOptions options = run->options;
    options.time = time;
    options.after_step = NULL;
    FrScene *scene;
    g_assert_cmpint(fr_scene_build_with(run->document, &options, &run->context, &scene), ==, FR_OK);
    FrDigest digest = fr_scene_digest(scene);
    fr_scene_free(scene);
    return digest;
}

/// Holds every scene of a sequence against the one that is built by itself. Returns the steps made.
static uint64_t compare(const char *text, const double *times, size_t count) {
    Run run;
    begin(&run, text);
    FrSequence *sequence = fr_sequence_new(run.document, &run.options);
    for (size_t i = 0; i < count; i++) {
        FrScene *scene;
        g_assert_cmpint(fr_sequence_scene(sequence, times[i], &run.context, &scene), ==, FR_OK);
        g_assert_cmpuint(fr_scene_digest(scene), ==, digest_apart(&run, times[i]));
        fr_scene_free(scene);
    }
    fr_sequence_free(sequence);
    uint64_t steps = run.steps;
    end(&run);
    return steps;
}

static const double rising[] = {0, 1, 2, 2, 3, 5, 6, 7, 9};

static void test_once(void) {
    g_assert_cmpuint(compare(only_buds, rising, G_N_ELEMENTS(rising)), ==, 6);
    g_assert_cmpuint(compare(mixed, rising, G_N_ELEMENTS(rising)), ==, 7);
    g_assert_cmpuint(compare(only_asking, rising, G_N_ELEMENTS(rising)), ==, 7);
}

static void test_falling(void) {
    static const double falling[] = {4, 3, 3, 1, 2, NAN};
    // Four, three, none, one, one more; and all six, four more.
    g_assert_cmpuint(compare(only_buds, falling, G_N_ELEMENTS(falling)), ==, 4 + 3 + 1 + 1 + 4);
    compare(mixed, falling, G_N_ELEMENTS(falling));
}

/// What stands in the way at each time grows by its clock, so nothing can be taken over.
static void test_clocked(void) {
    static const double times[] = {1, 3, 3, 5};
    g_assert_cmpuint(compare(clocked, times, G_N_ELEMENTS(times)), ==, 1 + 3 + 0 + 5);
}

static FrStatus keep_state(void *data, const FrSimulation *simulation, const FrContext *context) {
    GBytes **state = data;
    if (*state == NULL) {
        *state = fr_simulation_save(simulation, context);
    }
    return FR_OK;
}

static void test_resumed(void) {
    Run run;
    begin(&run, mixed);
    GBytes *state = NULL;
    FrSceneOptions options = {
        .seed = -1, .time = 1, .steps = -1, .after_step = keep_state, .data = &state};
    FrScene *scene;
    g_assert_cmpint(fr_scene_build_with(run.document, &options, &run.context, &scene), ==, FR_OK);
    fr_scene_free(scene);
    FrDigest whole = digest_apart(&run, 4);
    run.options.resume = g_bytes_get_data(state, &run.options.resume_size);
    FrSequence *sequence = fr_sequence_new(run.document, &run.options);
    for (int time = 1; time <= 4; time++) {
        g_assert_cmpint(fr_sequence_scene(sequence, time, &run.context, &scene), ==, FR_OK);
        g_assert_cmpuint(scene->steps->len, ==, (guint)time);
        g_assert_true(time < 4 || fr_scene_digest(scene) == whole);
        fr_scene_free(scene);
    }
    g_assert_cmpuint(run.steps, ==, 3);
    fr_sequence_free(sequence);
    g_bytes_unref(state);
    end(&run);
}

static FrStatus refuse(void *data, const FrSimulation *simulation, const FrContext *context) {
    (void)simulation, (void)context;
    return ++*(int *)data == 3 ? FR_CANCELLED : FR_OK;
}

static void test_cancelled(void) {
    Run run;
    begin(&run, only_buds);
    int steps = 0;
    FrSceneOptions options = {.seed = -1, .steps = -1, .after_step = refuse, .data = &steps};
    FrSequence *sequence = fr_sequence_new(run.document, &options);
    FrScene *scene;
    g_assert_cmpint(fr_sequence_scene(sequence, 2, &run.context, &scene), ==, FR_OK);
    fr_scene_free(scene);
    g_assert_cmpint(fr_sequence_scene(sequence, 5, &run.context, &scene), ==, FR_CANCELLED);
    g_assert_null(scene);
    g_assert_cmpint(fr_sequence_scene(sequence, 5, &run.context, &scene), ==, FR_OK);
    g_assert_cmpuint(fr_scene_digest(scene), ==, digest_apart(&run, 5));
    fr_scene_free(scene);
    fr_sequence_free(sequence);
    end(&run);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/scene/sequence/one growth serves all times with the bits of each by itself",
                    test_once);
    g_test_add_func("/scene/sequence/an earlier time grows from the seed again", test_falling);
    g_test_add_func("/scene/sequence/what a clock moves in the way is grown for each time",
                    test_clocked);
    g_test_add_func("/scene/sequence/a saved state is taken up once", test_resumed);
    g_test_add_func("/scene/sequence/a scene that is cancelled leaves the next one right",
                    test_cancelled);
    return g_test_run();
}
