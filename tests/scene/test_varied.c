/// Varied plants in documents: read, placed, collected.
#include "frond/scene.h"

#include <cglm/struct.h>
#include <math.h>
#include <string.h>

#define TREE                                                                                       \
    "<plant id='tree' seed='3'><pgraph><camera id='root'/>"                                        \
    "<tree id='trunk' length='5' radius='0.1' gnarl='20' number='6' branching-angle='50'/>"        \
    "<horn id='limb' length='1.5' radius='0.03' gnarl='20'/>"                                      \
    "<link from='root' to='trunk'/><link from='trunk' to='limb' kind='branch'/></pgraph></plant>"
#define WIND "<indicator kind='wind' to='2,0,0'/>"
#define SHORE(within)                                                                              \
    "<plant id='shore' seed='1'><vary base='tree'>"                                                \
    "<stroke select='trunk'>0,0,0 0.1,0,1 0.5,0,1.8</stroke>" within "</vary></plant>"

static FrStatus parse(const char *text, FrDiags *diags, FrDocument **document) {
    FrContext context = fr_context_default();
    context.diags = diags;
    FrSource *source = fr_source_new("shore.frond", text, strlen(text));
    FrStatus status = fr_document_parse(source, NULL, &context, document);
    fr_source_unref(source);
    return status;
}

static FrDocument *parsed(const char *text) {
    FrDocument *document;
    FrDiags *diags = fr_diags_new();
    FrStatus status = parse(text, diags, &document);
    for (size_t i = 0; i < fr_diags_count(diags); i++) {
        g_test_message("%s", fr_diags_get(diags, i)->text);
    }
    g_assert_cmpint(status, ==, FR_OK);
    fr_diags_free(diags);
    return document;
}

static const FrPlant *plant_at(const FrScene *scene, guint index) {
    return g_array_index(scene->plants, FrScenePlant, index).plant;
}

static FrScene *built(const FrDocument *document, int64_t seed) {
    FrContext context = fr_context_default();
    FrScene *scene;
    g_assert_cmpint(fr_scene_build(document, seed, &context, &scene), ==, FR_OK);
    return scene;
}

static void places(void) {
    FrDocument *document =
        parsed("<frond version='1'>" SHORE(WIND) TREE
               "<scene><place plant='tree'/><place plant='shore'/>"
               "<place plant='shore' seed='5' at='9,0,0'/><place plant='shore' at='4,0,0'/></scene>"
               "</frond>");
    FrScene *scene = built(document, -1);
    g_assert_cmpuint(scene->stands->len, ==, 4);
    g_assert_cmpuint(scene->plants->len, ==, 3);
    FrDigest topology = fr_vary_topology_digest(plant_at(scene, 0));
    for (guint i = 1; i < 3; i++) {
        g_assert_cmpuint(fr_vary_topology_digest(plant_at(scene, i)), ==, topology);
        g_assert_cmpuint(fr_plant_digest(plant_at(scene, i)), !=,
                         fr_plant_digest(plant_at(scene, 0)));
    }
    g_assert_cmpuint(fr_plant_digest(plant_at(scene, 1)), !=, fr_plant_digest(plant_at(scene, 2)));
    g_assert_cmpuint(g_array_index(scene->plants, FrScenePlant, 2).by_component[2], ==, 6);
    fr_scene_free(scene);
    fr_document_free(document);
}

static void another_seed(void) {
    // --seed gives another instance of the same base.
    FrDocument *document = parsed("<frond version='1'>" SHORE(WIND) TREE
                                  "<scene><place plant='shore'/></scene></frond>");
    FrScene *one = built(document, 1), *other = built(document, 2), *own = built(document, -1);
    g_assert_cmpuint(fr_plant_digest(plant_at(one, 0)), ==, fr_plant_digest(plant_at(own, 0)));
    g_assert_cmpuint(fr_plant_digest(plant_at(one, 0)), !=, fr_plant_digest(plant_at(other, 0)));
    g_assert_cmpuint(fr_vary_topology_digest(plant_at(one, 0)), ==,
                     fr_vary_topology_digest(plant_at(other, 0)));
    // Collected, they are the same.
    FrContext context = fr_context_default();
    FrScene *all;
    const FrPlantDef *shore = g_ptr_array_index(fr_document_plants(document), 0);
    g_assert_cmpint(fr_scene_collect(document, shore, -1, NAN, 3, &context, &all), ==, FR_OK);
    g_assert_cmpuint(all->stands->len, ==, 3);
    g_assert_cmpuint(fr_plant_digest(plant_at(all, 0)), ==, fr_plant_digest(plant_at(one, 0)));
    g_assert_cmpuint(fr_plant_digest(plant_at(all, 1)), ==, fr_plant_digest(plant_at(other, 0)));
    FrScene *single = fr_scene_single(all, 1);
    g_assert_true(plant_at(single, 0) == plant_at(all, 1));
    fr_scene_free(single);
    fr_scene_free(all);
    context.limits.plants = 2;
    g_assert_cmpint(fr_scene_collect(document, shore, -1, NAN, 3, &context, &all), ==,
                    FR_ERR_LIMIT);
    g_assert_null(all);
    fr_scene_free(one);
    fr_scene_free(other);
    fr_scene_free(own);
    fr_document_free(document);
}

static void settings(void) {
    FrDocument *document = parsed("<frond version='1'>" SHORE(WIND) TREE
                                  "<scene><place plant='shore'/></scene></frond>");
    FrContext context = fr_context_default();
    FrScene *before = built(document, -1);
    FrDigest digest = fr_plant_digest(plant_at(before, 0));
    fr_scene_free(before);
    g_assert_cmpint(fr_document_set(document, "shore.vary.scatter", "0", &context), ==, FR_OK);
    FrScene *one = built(document, 1), *two = built(document, 2);
    g_assert_cmpuint(fr_plant_digest(plant_at(one, 0)), !=, digest);
    g_assert_cmpuint(fr_plant_digest(plant_at(one, 0)), ==, fr_plant_digest(plant_at(two, 0)));
    fr_scene_free(one);
    fr_scene_free(two);
    fr_document_free(document);
}

static void mistakes(void) {
    static const struct {
        const char *text, *code;
    } rows[] = {
        {TREE "<plant id='a'><vary base='tee'/></plant>", "unknown-plant"},
        {TREE "<plant id='a'><vary base=''/></plant>", "unknown-plant"},
        {TREE "<plant id='a'><vary/></plant>", "missing-attribute"},
        {TREE "<plant id='a'><vary base='a'/></plant>", "varied-base"},
        {TREE "<plant id='a'><vary base='tree'/><pgraph/></plant>", "two-definitions"},
        {TREE "<plant id='a'><vary base='tree'><stroke>0,0,0</stroke></vary></plant>",
         "bad-stroke"},
        {TREE "<plant id='a'><vary base='tree'><stroke/></vary></plant>", "bad-stroke"},
        {TREE "<plant id='a'><vary base='tree'><indicator/></vary></plant>", "missing-attribute"},
        {TREE "<plant id='a'><vary base='tree' feedback='1'/></plant>", "out-of-range"},
    };
    for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
        char *text = g_strdup_printf("<frond version='1'>%s</frond>", rows[i].text);
        FrDiags *diags = fr_diags_new();
        FrDocument *document;
        g_assert_cmpint(parse(text, diags, &document), ==, FR_ERR_DOCUMENT);
        g_assert_cmpstr(fr_diags_get(diags, 0)->code, ==, rows[i].code);
        g_assert_nonnull(fr_diags_get(diags, 0)->span.source);
        fr_document_free(document);
        fr_diags_free(diags);
        g_free(text);
    }
}

static void unknown_branch(void) {
    FrDocument *document =
        parsed("<frond version='1'>" SHORE("<indicator to='1,0,0' select='limp'/>") TREE
               "<scene><place plant='shore'/></scene></frond>");
    FrContext context = fr_context_default();
    context.diags = fr_diags_new();
    FrScene *scene;
    g_assert_cmpint(fr_scene_build(document, -1, &context, &scene), ==, FR_ERR_DOCUMENT);
    g_assert_null(scene);
    const FrDiag *diag = fr_diags_get(context.diags, 0);
    g_assert_cmpstr(diag->code, ==, "unknown-branch");
    g_assert_cmpuint(diag->span.end - diag->span.begin, ==, strlen("limp"));
    fr_diags_free(context.diags);
    fr_document_free(document);
}

/// Mean distance of the same joints over the height.
static double difference(const FrPlant *one, const FrPlant *other, double height) {
    double sum = 0;
    for (uint32_t i = 0; i < one->nodes.count; i++) {
        sum += (double)glms_vec3_distance(one->nodes.position[i], other->nodes.position[i]);
    }
    return sum / one->nodes.count / height;
}

/// Seven instances of the example differ enough to tell them apart, and are still one kind.
static void a_collection_of_one_kind(void) {
    char *path = g_build_filename(g_getenv("FROND_SOURCE"), "examples", "collection.frond", NULL);
    FrContext context = fr_context_default();
    FrDocument *document;
    g_assert_cmpint(fr_document_load(path, &context, &document), ==, FR_OK);
    const FrPlantDef *drawn = g_ptr_array_index(fr_document_plants(document), 1);
    FrScene *all;
    g_assert_cmpint(fr_scene_collect(document, drawn, 1, NAN, 7, &context, &all), ==, FR_OK);
    vec3s min, max;
    fr_plant_bounds(plant_at(all, 0), &min, &max);
    FrDigest topology = fr_vary_topology_digest(plant_at(all, 0));
    for (guint i = 0; i < 7; i++) {
        g_assert_cmpuint(fr_vary_topology_digest(plant_at(all, i)), ==, topology);
        for (guint j = 0; j < i; j++) {
            double apart = difference(plant_at(all, i), plant_at(all, j), (double)(max.z - min.z));
            g_test_message("%u and %u differ by %.1f %%", i, j, 100 * apart);
            g_assert_cmpfloat(apart, >=, 0.02);
            g_assert_cmpfloat(apart, <=, 0.15);
        }
    }
    fr_scene_free(all);
    fr_document_free(document);
    g_free(path);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/scene/varied/seven of a collection differ and are of one kind",
                    a_collection_of_one_kind);
    g_test_add_func("/scene/varied/instances stand beside their base", places);
    g_test_add_func("/scene/varied/another seed is another instance of the same base",
                    another_seed);
    g_test_add_func("/scene/varied/settings have paths", settings);
    g_test_add_func("/scene/varied/mistakes are told at their place", mistakes);
    g_test_add_func("/scene/varied/a branch that is not there is told", unknown_branch);
    return g_test_run();
}
