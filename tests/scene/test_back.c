/// Steps that are taken back in scenes where L-systems grow, too; and those that fail or go on in a
/// changed document.
#include "run.h"

#include <math.h>
#include <string.h>

#define TREE                                                                                       \
    "<plant id='t'><species model='open' step='0.3' auxin-reach='1' particles='60'/></plant>"
// It asks for light and space; what is drawn takes random numbers.
#define ASKING(more)                                                                               \
    "<plant id='l'><lsystem><![CDATA[\nderivation length: 9\nw : ?E(0)D(?,?)A\n"                   \
    "p : ?E(e) < D(d,a) > A : * -> F(0.8+e/5000)[+(60)f(0.1)" more "]?E(0)D(?,?)A\n"               \
    "]]></lsystem></plant>"
#define DRAWN                                                                                      \
    "<plant id='l'><lsystem><![CDATA[\nLsystem: 1\nderivation length: 9\nAxiom: ?E(0)A\n"          \
    "?E(e) < A --> BF(0.3+ran(0.2)+e/9)?E(0)A\nhomomorphism\nB --> [+(ran(90))f(0.1)F(0.1)]\n"     \
    "endlsystem\n]]></lsystem></plant>"
#define STAKE                                                                                      \
    "<plant id='s'><pgraph><camera id='root'/><tree id='stem' length='1.5' radius='0.1'/>"         \
    "<link from='root' to='stem'/></pgraph></plant>"
#define LIGHT "<light by='density' photons='800' distance='0.5'/>"
#define WORLD "<growth steps='6' min='-4,-4,-1' max='4,4,9' cell='0.05'/><place plant='t'/>"
#define STANDS                                                                                     \
    "<place plant='l' at='0.4,0,0'/><place plant='l' at='-0.5,0,0'/><place plant='s' "             \
    "at='0,0.4,0'/>"
#define DOCUMENT(plants, scene)                                                                    \
    "<frond version='1'>" plants STAKE "<scene ground='no'>" LIGHT scene "</scene></frond>"

static const char mixed[] = DOCUMENT(TREE ASKING(""), WORLD STANDS);
static const char asking[] = DOCUMENT(ASKING(""), STANDS);
static const char drawn[] = DOCUMENT(TREE DRAWN, WORLD STANDS);
static const char moved[] =
    DOCUMENT(TREE ASKING(""), WORLD STANDS "<place plant='l' at='2,0,0'/><obstacle at='0,2,0'/>");
static const char other[] = DOCUMENT(TREE ASKING("F(0.1)"), WORLD STANDS);

static FrDigest digest(Run *run) {
    return fr_scene_digest(scene_of(run));
}

static uint32_t nodes_of(Run *run, guint plant) {
    return g_array_index(scene_of(run)->plants, FrScenePlant, plant).plant->nodes.count;
}

enum { STEPS = 5 };

/// Steps back are taken from every step, and made again.
static void take_back(const char *text) {
    Run run = begin(text, STEPS);
    FrDigest wanted[STEPS + 1] = {digest(&run)};
    for (int i = 1; i <= STEPS; i++) {
        step(&run, 1);
        wanted[i] = digest(&run);
        g_assert_cmpuint(wanted[i], !=, wanted[i - 1]);
    }
    for (int back = 1; back <= STEPS; back++) {
        for (int i = STEPS - 1; i >= STEPS - back; i--) {
            g_assert_true(fr_simulation_undo(run.simulation));
            g_assert_cmpuint(digest(&run), ==, wanted[i]);
            g_assert_cmpuint(scene_of(&run)->steps->len, ==, (guint)i);
        }
        for (int i = STEPS - back + 1; i <= STEPS; i++) {
            step(&run, 1);
            g_assert_cmpuint(digest(&run), ==, wanted[i]);
        }
    }
    end(&run);
}

static void test_undone(void) {
    take_back(mixed);
    take_back(drawn);
}

static void test_alone(void) {
    take_back(asking);
    Run run = begin(asking, 2);
    step(&run, 12); // nine, and then there is nothing to do
    FrDigest whole = digest(&run);
    g_assert_true(fr_simulation_undo(run.simulation) && fr_simulation_undo(run.simulation));
    g_assert_false(fr_simulation_undo(run.simulation));
    g_assert_cmpuint(scene_of(&run)->steps->len, ==, 7);
    step(&run, 2);
    g_assert_cmpuint(digest(&run), ==, whole);
    end(&run);
}

/// Who looks changes nothing, and sees what has grown until now.
static void test_looked_at(void) {
    Run blind = begin(drawn, 0), looking = begin(drawn, 0);
    for (int i = 0; i < STEPS; i++) {
        step(&blind, 1);
        step(&looking, 1);
        g_assert_cmpuint(nodes_of(&looking, 1), ==, 2 * ((guint)i + 1));
    }
    g_assert_cmpuint(digest(&blind), ==, digest(&looking));
    end(&blind);
    end(&looking);
}

/// Plants grow out of where the light was at first.
static void test_resumed(void) {
    Run whole = begin(asking, 0);
    step(&whole, 9);
    for (int at = 3; at < 9; at += 2) {
        Run first = begin(asking, 0), second = begin(asking, 9);
        step(&first, at);
        GBytes *saved = fr_simulation_save(first.simulation, &first.context);
        gsize size;
        const void *data = g_bytes_get_data(saved, &size);
        g_assert_cmpint(
            fr_simulation_restore(second.simulation, data, size, (FrSpan){0}, &second.context), ==,
            FR_OK);
        g_assert_cmpuint(digest(&second), ==, digest(&first));
        step(&second, 9 - at);
        g_assert_cmpuint(digest(&second), ==, digest(&whole));
        // Taken up where more has been done, it knows nothing of steps before it.
        g_assert_cmpint(
            fr_simulation_restore(second.simulation, data, size, (FrSpan){0}, &second.context), ==,
            FR_OK);
        g_assert_false(fr_simulation_undo(second.simulation));
        g_assert_cmpuint(digest(&second), ==, digest(&first));
        g_bytes_unref(saved);
        end(&first);
        end(&second);
    }
    end(&whole);
}

/// A step in which the L-systems fail is no step of the buds either.
static void test_failed(void) {
    for (uint32_t history = 0; history <= 2; history++) {
        Run run = begin(mixed, history);
        step(&run, 3);
        FrDigest before = digest(&run);
        run.context.limits.modules = 30;
        g_assert_cmpint(fr_simulation_step(run.simulation, &run.context), ==, FR_ERR_LIMIT);
        g_assert_cmpuint(digest(&run), ==, before);
        g_assert_cmpuint(fr_simulation_stats(run.simulation).step, ==, 3);
        g_assert_cmpuint(scene_of(&run)->steps->len, ==, 3);
        run.context.limits = fr_limits_default();
        step(&run, 2);
        Run other_run = begin(mixed, 0);
        step(&other_run, 5);
        g_assert_cmpuint(digest(&run), ==, digest(&other_run));
        end(&run);
        end(&other_run);
    }
}

/// L-systems that are as they were go on in a changed document; others begin.
static void test_changed(void) {
    Run run = begin(mixed, 9);
    step(&run, 3);
    FrDigest before = digest(&run);
    FrDocument *next = parse(moved, &run.context);
    g_assert_cmpint(fr_simulation_change(run.simulation, next, &run.context), ==, FR_OK);
    g_assert_cmpuint(nodes_of(&run, 1), ==, 3);
    g_assert_cmpuint(nodes_of(&run, 4), ==, 0);
    step(&run, 2);
    g_assert_cmpuint(nodes_of(&run, 1), ==, 5);
    g_assert_cmpuint(nodes_of(&run, 4), ==, 2);
    g_assert_cmpuint(scene_of(&run)->steps->len, ==, 5);
    for (int i = 0; i < 3; i++) { // one farther than the change
        g_assert_true(fr_simulation_undo(run.simulation));
    }
    g_assert_cmpuint(nodes_of(&run, 1), ==, 2);
    g_assert_cmpuint(nodes_of(&run, 4), ==, 0);
    step(&run, 1);
    g_assert_cmpuint(nodes_of(&run, 1), ==, 3);
    FrDocument *same = parse(mixed, &run.context);
    Run again = begin(mixed, 0);
    step(&again, 3);
    g_assert_cmpint(fr_simulation_change(again.simulation, same, &run.context), ==, FR_OK);
    g_assert_cmpuint(digest(&again), ==, before);
    step(&again, 3);
    Run whole = begin(mixed, 0);
    step(&whole, 6);
    g_assert_cmpuint(digest(&again), ==, digest(&whole));
    FrDocument *grown = parse(other, &run.context);
    g_assert_cmpint(fr_simulation_change(again.simulation, grown, &run.context), ==, FR_OK);
    g_assert_cmpuint(nodes_of(&again, 1), ==, 0);
    step(&again, 1);
    end(&whole);
    end(&again);
    end(&run);
    fr_document_free(grown);
    fr_document_free(same);
    fr_document_free(next);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/scene/back/E01 steps of buds and L-systems are taken back and made again",
                    test_undone);
    g_test_add_func("/scene/back/so are those of L-systems alone", test_alone);
    g_test_add_func("/scene/back/looking at a scene changes nothing", test_looked_at);
    g_test_add_func("/scene/back/plants that outgrow their light are resumed", test_resumed);
    g_test_add_func("/scene/back/a step that fails leaves buds and L-systems as they were",
                    test_failed);
    g_test_add_func("/scene/back/L-systems go on in a changed document", test_changed);
    return g_test_run();
}
