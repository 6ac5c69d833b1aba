/// Plants of every engine in the place of components.
#include "frond/scene.h"

#include <string.h>

#define TWIG                                                                                       \
    "<plant id='twig'><pgraph><tree id='w' length='0.3..0.5 ~ 0.1' radius='0.01' number='4'/>"     \
    "<leaf id='f'/><link from='w' to='f' kind='branch'/></pgraph></plant>"
#define STEM(graft)                                                                                \
    "<plant id='tree'><pgraph><tree id='t' length='2' radius='0.1' number='6'/>" graft             \
    "<link from='t' to='g' kind='branch'/></pgraph></plant>"
#define WHOLE(plants) "<frond version='1'>" plants "</frond>"

static FrScene *built(FrDocument **document, const char *text, int threads) {
    FrContext context = fr_context_default();
    context.pool = fr_pool_new(threads);
    FrSource *source = fr_source_new("test.frond", text, strlen(text));
    FrScene *scene;
    g_assert_cmpint(fr_document_parse(source, NULL, &context, document), ==, FR_OK);
    g_assert_cmpint(fr_scene_build(*document, -1, &context, &scene), ==, FR_OK);
    g_assert_true(fr_plant_is_valid(g_array_index(scene->plants, FrScenePlant, 0).plant, NULL));
    fr_pool_free(context.pool);
    fr_source_unref(source);
    return scene;
}

static const FrPlant *first_plant(const FrScene *scene) {
    return g_array_index(scene->plants, FrScenePlant, 0).plant;
}

/// Axes, internodes of the axes from the second on, organs.
static void check_counts(const char *text, uint32_t axes, uint32_t organs) {
    FrDocument *document;
    FrScene *scene = built(&document, text, 1);
    g_assert_cmpuint(first_plant(scene)->axes.count, ==, axes);
    g_assert_cmpuint(first_plant(scene)->organs.count, ==, organs);
    fr_scene_free(scene);
    fr_document_free(document);
}

static float axis_length(const FrPlant *plant, uint32_t axis) {
    float length = 0;
    for (uint32_t node = plant->axes.first[axis]; node != FR_NONE; node = plant->nodes.next[node]) {
        length += plant->nodes.length[node];
    }
    return length;
}

// Six twigs of a stem and four leaves, no two of one length.
static void graphs(void) {
    FrDocument *document;
    FrScene *scene = built(&document, WHOLE(STEM("<graft id='g' plant='twig'/>") TWIG), 1);
    const FrPlant *plant = first_plant(scene);
    g_assert_cmpuint(plant->axes.count, ==, 1 + 6);
    g_assert_cmpuint(plant->organs.count, ==, 6 * 4);
    for (uint32_t axis = 1; axis < 7; axis++) {
        g_assert_cmpuint(plant->nodes.axis[plant->axes.bearer[axis]], ==, 0);
        g_assert_true(axis_length(plant, axis) > 0.2F && axis_length(plant, axis) < 0.4F);
        for (uint32_t other = 1; other < axis; other++) {
            g_assert_true(axis_length(plant, axis) != axis_length(plant, other));
        }
    }
    fr_scene_free(scene);
    fr_document_free(document);
}

// The symbols of an L-system place plants of components, which bear an L-system in turn.
static void mixed(void) {
    check_counts(WHOLE("<plant id='tree'><pgraph><graft id='g' plant='ell'/><graft id='h' "
                       "plant='twig'/><link from='g' to='h' symbol='L'/></pgraph></plant>"
                       "<plant id='ell'><lsystem>w : F[+L]F[-L]FL</lsystem></plant>" TWIG),
                 1 + 3, 3 * 4);
    check_counts(WHOLE(STEM("<graft id='g' plant='middle'/>") "<plant id='middle'><pgraph><tree "
                                                              "id='m' length='0.5' radius='0.02' "
                                                              "number='2'/><graft id='e' "
                                                              "plant='ell'/><link from='m' to='e' "
                                                              "kind='branch'/></pgraph></plant>"
                                                              "<plant id='ell'><lsystem>w : "
                                                              "F[+F]@O(1)</lsystem></plant>"),
                 1 + 6 + 6 * 2 * 2, 6 * 2);
}

static void variations(void) {
    FrDocument *document;
    FrScene *scene = built(&document,
                           WHOLE(STEM("<graft id='g' plant='bent'/>") TWIG
                                 "<plant id='bent'><vary base='twig' joints='3'/></plant>"),
                           1);
    const FrPlant *plant = first_plant(scene);
    g_assert_cmpuint(plant->axes.count, ==, 1 + 6);
    // One base: all as long, but bent in different ways.
    for (uint32_t axis = 2; axis < 7; axis++) {
        g_assert_cmpfloat_with_epsilon(axis_length(plant, axis), axis_length(plant, 1), 1e-5F);
        versors a = plant->nodes.rotation[plant->nodes.next[plant->axes.first[1]]];
        versors b = plant->nodes.rotation[plant->nodes.next[plant->axes.first[axis]]];
        g_assert_true(memcmp(&a, &b, sizeof a) != 0);
    }
    fr_scene_free(scene);
    fr_document_free(document);
}

static void skeletons(void) {
    check_counts(
        WHOLE(STEM("<graft id='g' plant='scan'/>") "<plant id='scan'><skeleton>0 0 0 0 0 1 0.1\n0 "
                                                   "0 1 0 0 2 0.05\n"
                                                   "0 0 1 0 1 2 0.03\n</skeleton></plant>"),
        1 + 6 * 2, 0);
}

// Scopes of a grafted plant come along: the leaf's deformation and its place.
static void deformations(void) {
    FrDocument *document;
    FrScene *scene =
        built(&document,
              WHOLE(STEM("<graft id='g' plant='bent'/>") "<plant id='bent'><pgraph><ffd id='d' "
                                                         "to-x='x+0.1*z'/><horn id='h' "
                                                         "length='0.3'/><link from='d' "
                                                         "to='h'/></pgraph></plant>"),
              1);
    const FrPlant *plant = first_plant(scene);
    g_assert_cmpuint(plant->deformers->len, ==, 6);
    for (uint32_t axis = 1; axis < plant->axes.count; axis++) {
        uint32_t scope = plant->axes.deformer[axis];
        g_assert_cmpuint(scope, ==, axis - 1);
        const FrDeformer *deformer = &g_array_index(plant->deformers, FrDeformer, scope);
        g_assert_cmpuint(plant->nodes.axis[deformer->node], ==, 0);
        g_assert_cmpuint(deformer->deformation, <, plant->deformations->len);
    }
    fr_scene_free(scene);
    fr_document_free(document);
}

static void threads(void) {
    FrDigest first = 0;
    for (int count = 1; count <= 8; count += count < 3 ? 1 : 5) {
        FrDocument *document;
        FrScene *scene = built(&document, WHOLE(STEM("<graft id='g' plant='twig'/>") TWIG), count);
        first = count == 1 ? fr_scene_digest(scene) : first;
        g_assert_cmpuint(fr_scene_digest(scene), ==, first);
        fr_scene_free(scene);
        fr_document_free(document);
    }
}

// Plants that double in each other make too many instances before long.
static void limits(void) {
    GString *text = g_string_new("<frond version='1'>");
    for (int i = 0; i < 14; i++) {
        g_string_append_printf(text,
                               "<plant id='p%d'><pgraph><simple id='s'/><graft id='a' "
                               "plant='p%d'/><graft id='b' plant='p%d'/><graft id='c' plant='p%d'/>"
                               "<link from='s' to='a'/><link from='s' to='b'/><link from='s' "
                               "to='c'/></pgraph></plant>",
                               i, i + 1, i + 1, i + 1);
    }
    g_string_append(text, "<plant id='p14'><pgraph><horn id='h'/></pgraph></plant></frond>");
    FrContext context = fr_context_default();
    context.diags = fr_diags_new();
    context.limits.instances = 10000;
    FrSource *source = fr_source_new("many.frond", text->str, text->len);
    FrDocument *document;
    FrScene *scene;
    g_assert_cmpint(fr_document_parse(source, NULL, &context, &document), ==, FR_OK);
    g_assert_cmpint(fr_scene_build(document, -1, &context, &scene), ==, FR_ERR_LIMIT);
    g_assert_cmpstr(fr_diags_get(context.diags, 0)->code, ==, "limit-instances");
    fr_document_free(document);
    fr_source_unref(source);
    fr_diags_free(context.diags);
    g_string_free(text, TRUE);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/scene/grafts/every one of a p-graph is another", graphs);
    g_test_add_func("/scene/grafts/L-systems and p-graphs stand in each other", mixed);
    g_test_add_func("/scene/grafts/variations share their base", variations);
    g_test_add_func("/scene/grafts/skeletons stand as they are", skeletons);
    g_test_add_func("/scene/grafts/deformations come along", deformations);
    g_test_add_func("/scene/grafts/threads make the same", threads);
    g_test_add_func("/scene/grafts/grafts within grafts are counted", limits);
    return g_test_run();
}
