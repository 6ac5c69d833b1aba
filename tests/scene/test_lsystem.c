/// Plants that are L-systems: built, placed and varied like any other.
#include "frond/scene.h"

#include <string.h>

#define BUSH                                                                                       \
    "<plant id='bush'><lsystem steps='4' unit='0.5'><define id='angle' value='25 ~ "               \
    "5'/><![CDATA[\n"                                                                              \
    "w : A\np1 : A -> F[+(angle)A][-(angle)A]FA : 2\np2 : A -> F[&(angle)A]FA : 1\n"               \
    "]]></lsystem></plant>"

static FrScene *built(FrDocument **document, const char *text, int64_t seed) {
    FrContext context = fr_context_default();
    FrSource *source = fr_source_new("bush.frond", text, strlen(text));
    FrScene *scene;
    g_assert_cmpint(fr_document_parse(source, NULL, &context, document), ==, FR_OK);
    g_assert_cmpint(fr_scene_build(*document, seed, &context, &scene), ==, FR_OK);
    fr_source_unref(source);
    return scene;
}

static const FrScenePlant *plant_at(const FrScene *scene, guint index) {
    return &g_array_index(scene->plants, FrScenePlant, index);
}

static FrDigest digest_of(const char *text, int64_t seed) {
    FrDocument *document;
    FrScene *scene = built(&document, text, seed);
    FrDigest digest = fr_scene_digest(scene);
    fr_scene_free(scene);
    fr_document_free(document);
    return digest;
}

static void places(void) {
    FrDocument *document;
    FrScene *scene = built(&document,
                           "<frond version='1'>" BUSH "<scene><place plant='bush'/>"
                           "<place plant='bush' seed='5'/><place plant='bush' at='2,0,0'/></scene>"
                           "</frond>",
                           -1);
    g_assert_cmpuint(scene->plants->len, ==, 2);
    g_assert_cmpuint(scene->stands->len, ==, 3);
    const FrScenePlant *first = plant_at(scene, 0);
    g_assert_cmpstr(first->plant->name, ==, "bush");
    g_assert_true(fr_plant_is_valid(first->plant, NULL));
    g_assert_cmpuint(first->modules, >, 100);
    g_assert_cmpuint(fr_plant_digest(first->plant), !=, fr_plant_digest(plant_at(scene, 1)->plant));
    fr_scene_free(scene);
    fr_document_free(document);
}

static void units(void) {
    FrDocument *document;
    FrScene *scene = built(&document,
                           "<frond version='1'><plant id='a'><lsystem unit='0.25'>"
                           "w : F(2)[+(90)F(4)]f(4)@O(2)</lsystem></plant></frond>",
                           -1);
    const FrPlant *plant = plant_at(scene, 0)->plant;
    g_assert_cmpuint(plant->nodes.count, ==, 2);
    g_assert_cmpfloat_with_epsilon(plant->nodes.length[0], 0.5, 1e-6);
    g_assert_cmpfloat_with_epsilon(plant->nodes.length[1], 1, 1e-6);
    g_assert_cmpfloat_with_epsilon(plant->organs.scale[0], 0.5, 1e-6);
    vec3s position;
    versors rotation;
    fr_plant_organ_pose(plant, 0, &position, &rotation);
    g_assert_cmpfloat_with_epsilon(position.z, 1.25, 1e-6); // its lowest point
    fr_scene_free(scene);
    fr_document_free(document);
}

static void seeds(void) {
    FrDigest first = digest_of("<frond version='1'>" BUSH "</frond>", -1);
    g_assert_cmpuint(digest_of("<frond version='1'>" BUSH "</frond>", -1), ==, first);
    g_assert_cmpuint(digest_of("<frond version='1'>" BUSH "</frond>", 70000), !=, first);
    g_assert_cmpuint(digest_of("<frond version='1'>" BUSH "</frond>", 70000), !=,
                     digest_of("<frond version='1'>" BUSH "</frond>", 70000 + 65536));
}

static void own_seed(void) {
    static const char text[] = "<frond version='1'><plant id='a'%s><lsystem>"
                               "Lsystem: 1\nseed: 9\nderivation length: 6\naxiom: A\n"
                               "A --> FA : 1\nA --> +FA : 1\nendlsystem\n"
                               "</lsystem></plant></frond>";
    char *plain = g_strdup_printf(text, ""), *same = g_strdup_printf(text, " seed='9'");
    char *other = g_strdup_printf(text, " seed='3'");
    g_assert_cmpuint(digest_of(plain, -1), ==, digest_of(same, -1));
    g_assert_cmpuint(digest_of(plain, -1), !=, digest_of(other, -1));
    g_free(plain);
    g_free(same);
    g_free(other);
}

static void varied(void) {
    FrDocument *document;
    FrScene *scene =
        built(&document,
              "<frond version='1'>" BUSH
              "<plant id='shore'><vary base='bush' joints='1'><indicator kind='wind' to='2,0,0'/>"
              "</vary></plant><scene><place plant='shore'/><place plant='bush'/>"
              "</scene></frond>",
              -1);
    g_assert_cmpuint(fr_vary_topology_digest(plant_at(scene, 0)->plant), ==,
                     fr_vary_topology_digest(plant_at(scene, 1)->plant));
    g_assert_cmpuint(fr_plant_digest(plant_at(scene, 0)->plant), !=,
                     fr_plant_digest(plant_at(scene, 1)->plant));
    fr_scene_free(scene);
    fr_document_free(document);
}

#define TREE                                                                                       \
    "<plant id='tree' seed='2'><pgraph><tree id='t' length='2' radius='0.1' number='6'/>"          \
    "<graft id='g' plant='twig' steps='3'><define id='l' value='0.1..0.3'/></graft>"               \
    "<leaf id='leaf'/><link from='t' to='g' kind='branch'/><link from='g' to='leaf' symbol='L'/>"  \
    "</pgraph></plant>"                                                                            \
    "<plant id='twig'><lsystem steps='2'><define id='l' value='0.5'/>"                             \
    "w : A\np1 : A -> F(l)[+(30+ran(20))L(0.5)]A : 1\np2 : A -> F(l)/(90)A : 1</lsystem></plant>"

static void grafts(void) {
    FrDocument *document;
    FrScene *scene = built(&document, "<frond version='1'>" TREE "</frond>", -1);
    const FrScenePlant *tree = plant_at(scene, 0);
    g_assert_true(fr_plant_is_valid(tree->plant, NULL));
    g_assert_cmpuint(tree->by_component[1], ==, 6);
    uint64_t leaves = tree->by_component[2];
    g_assert_cmpuint(leaves, ==, tree->plant->organs.count);
    g_assert_true(leaves > 0 && leaves < 18); // three steps each, every other one a leaf by chance
    const FrPlant *plant = tree->plant;
    float first = plant->nodes.length[plant->axes.first[1]];
    float last = plant->nodes.length[plant->axes.first[plant->axes.count - 1]];
    g_assert_cmpfloat_with_epsilon(first, 0.1, 1e-6);
    g_assert_cmpfloat_with_epsilon(last, 0.3, 1e-6);
    fr_scene_free(scene);
    fr_document_free(document);
    g_assert_cmpuint(digest_of("<frond version='1'>" TREE "</frond>", 1), !=,
                     digest_of("<frond version='1'>" TREE "</frond>", 3));
}

static void limits(void) {
    FrContext context = fr_context_default();
    context.diags = fr_diags_new();
    static const char text[] = "<frond version='1'><plant id='a'><lsystem steps='60'>\n"
                               "w : A\np1 : A -> AA\n</lsystem></plant></frond>";
    FrSource *source = fr_source_new("many.frond", text, sizeof text - 1);
    FrDocument *document;
    FrScene *scene;
    g_assert_cmpint(fr_document_parse(source, NULL, &context, &document), ==, FR_OK);
    context.limits.modules = 100000;
    g_assert_cmpint(fr_scene_build(document, -1, &context, &scene), ==, FR_ERR_LIMIT);
    g_assert_null(scene);
    const FrDiag *diag = fr_diags_get(context.diags, 0);
    g_assert_cmpstr(diag->code, ==, "limit-modules");
    uint32_t line, column;
    fr_source_position(diag->span.source, diag->span.begin, &line, &column);
    g_assert_cmpuint(line, ==, 3);
    fr_document_free(document);
    fr_source_unref(source);
    fr_diags_free(context.diags);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/scene/lsystem/it stands where it is placed, once for each seed", places);
    g_test_add_func("/scene/lsystem/its unit scales all there is", units);
    g_test_add_func("/scene/lsystem/every bit of a seed counts", seeds);
    g_test_add_func("/scene/lsystem/its text's seed holds unless the plant has one", own_seed);
    g_test_add_func("/scene/lsystem/it can be varied", varied);
    g_test_add_func("/scene/lsystem/it stands in a p-graph and places components", grafts);
    g_test_add_func("/scene/lsystem/runaway growth names the production in the document", limits);
    return g_test_run();
}
