// Documents that are shown while they are edited, against the same documents built anew.
#include "frond/rebuild.h"

#include "../document/documents.h"

static FrContext context;

static FrDocument *load(const char *path) {
    char *full = in_source(path);
    FrDocument *document;
    g_assert_cmpint(fr_document_load(full, &context, &document), ==, FR_OK);
    g_free(full);
    return document;
}

static FrDocument *parse_text(const char *text) {
    Parsed parsed = parse(text);
    g_assert_cmpint(parsed.status, ==, FR_OK);
    fr_diags_free(parsed.diags);
    return parsed.document;
}

static FrRebuild *rebuild_new(void) {
    FrSkinParams params = fr_skin_default();
    return fr_rebuild_new(&params, FR_UP_Y);
}

/// What is shown, as one number.
static FrDigest shown_digest(const FrRebuild *shown) {
    const FrScene *scene = fr_rebuild_scene(shown);
    FrDigest digest = fr_scene_digest(scene);
    for (guint i = 0; i < scene->plants->len; i++) {
        FrMesh *mesh = fr_skin_mesh(fr_rebuild_skin(shown, i));
        FrDigest of_mesh = fr_mesh_digest(mesh);
        digest = fr_digest(digest, &of_mesh, sizeof of_mesh);
        fr_mesh_free(mesh);
    }
    return digest;
}

static FrDigest fresh_digest(const FrDocument *document) {
    FrScene *scene;
    FrSkinParams params = fr_skin_default();
    g_assert_cmpint(fr_scene_build(document, -1, &context, &scene), ==, FR_OK);
    FrDigest digest = fr_scene_digest(scene);
    for (guint i = 0; i < scene->plants->len; i++) {
        FrMesh *mesh;
        const FrPlant *plant = g_array_index(scene->plants, FrScenePlant, i).plant;
        g_assert_cmpint(fr_skin_plant(plant, &params, FR_UP_Y, &context, &mesh), ==, FR_OK);
        FrDigest of_mesh = fr_mesh_digest(mesh);
        digest = fr_digest(digest, &of_mesh, sizeof of_mesh);
        fr_mesh_free(mesh);
    }
    fr_scene_free(scene);
    return digest;
}

static FrRebuildWork update(FrRebuild *shown, const FrDocument *document) {
    g_assert_cmpint(fr_rebuild_update(shown, document, -1, &context), ==, FR_OK);
    g_assert_cmphex(shown_digest(shown), ==, fresh_digest(document));
    return fr_rebuild_work(shown);
}

static FrRebuildWork set(FrRebuild *shown, FrDocument *document, const char *path,
                         const char *value) {
    g_assert_cmpint(fr_document_set(document, path, value, &context), ==, FR_OK);
    return update(shown, document);
}

static const char *const text =
    "<frond version=\"1\">\n"
    "<curve id=\"c\" points=\"0,1 1,0.5\"/>\n"
    "<material id=\"bark\" colour=\"#7d6f60\"/><material id=\"green\" colour=\"#4f7a2c\"/>\n"
    "<material id=\"red\" colour=\"#aa2222\"/>\n"
    "<plant id=\"tree\" seed=\"3\"><pgraph>\n"
    "<tree id=\"trunk\" material=\"bark\" length=\"3\" number=\"9\" gnarl=\"9\"/>\n"
    "<tree id=\"twig\" length=\"0.5..1 : c\" number=\"8\"/>\n"
    "<leaf id=\"leaf\" material=\"green\" curvature-along=\"-30 ~ 20\" scale=\"1 ~ 0.3\"/>\n"
    "<leaf id=\"fruit\" material=\"red\" length=\"0.03\" only=\"odd\"/>\n"
    "<link from=\"trunk\" to=\"twig\" kind=\"branch\"/>\n"
    "<link from=\"twig\" to=\"leaf\" kind=\"branch\"/>\n"
    "<link from=\"twig\" to=\"fruit\" kind=\"branch\"/>\n"
    "</pgraph></plant>\n"
    "<plant id=\"herb\"><pgraph><horn id=\"stem\"/><leaf id=\"blade\"/>\n"
    "<link from=\"stem\" to=\"blade\"/></pgraph></plant>\n"
    "<scene><place plant=\"tree\"/><place plant=\"herb\" at=\"2, 0, 0\"/>\n"
    "<place plant=\"tree\" at=\"5, 0, 0\" seed=\"8\"/></scene>\n"
    "</frond>\n";

static void test_look(void) {
    FrDocument *document = parse_text(text);
    FrRebuild *shown = rebuild_new();
    update(shown, document);
    FrRebuildWork work = set(shown, document, "green.colour", "#118811");
    g_assert_cmpuint(work.instances_made, ==, 0);
    g_assert_cmpuint(work.skin.runs_written + work.skin.organs_written, ==, 0);
    const FrScene *scene = fr_rebuild_scene(shown);
    const FrPlant *plant = g_array_index(scene->plants, FrScenePlant, 0).plant;
    bool is_new = false;
    for (guint i = 0; i < plant->materials->len; i++) {
        is_new |= g_ptr_array_index(plant->materials, i) ==
                  g_ptr_array_index(fr_document_materials(document), 1);
    }
    g_assert_true(is_new);
    fr_rebuild_free(shown);
    fr_document_free(document);
}

static void test_shape(void) {
    FrDocument *document = parse_text(text);
    FrRebuild *shown = rebuild_new();
    update(shown, document);
    FrRebuildWork work = set(shown, document, "leaf.width", "0.07");
    g_assert_cmpuint(work.instances_made, ==, 0);
    g_assert_cmpuint(work.skin.runs_written, ==, 0);
    g_assert_cmpuint(work.skin.organs_written, ==, 2 * 9 * 8);
    // Other numbers of segments, so every leaf has another place; fruits are a part of their own.
    work = set(shown, document, "leaf.segments-along", "9");
    g_assert_cmpuint(work.skin.organs_written, ==, 2 * 9 * 8);
    fr_rebuild_free(shown);
    fr_document_free(document);
}

static void test_parts(void) {
    FrDocument *document = parse_text(text);
    FrRebuild *shown = rebuild_new();
    update(shown, document);
    FrRebuildWork work = set(shown, document, "fruit.scale", "2");
    g_assert_cmpuint(work.instances_made, ==, 2 * 9 * 4);
    g_assert_cmpuint(work.skin.runs_written, ==, 0);
    g_assert_cmpuint(work.skin.organs_written, ==, 2 * 9 * 4);
    work = set(shown, document, "stem.length", "2");
    g_assert_cmpuint(work.instances_made, ==, 2);
    g_assert_cmpuint(work.skin.runs_written, ==, 1);
    work = set(shown, document, "c.points", "0,1 1,0.25");
    g_assert_cmpuint(work.instances, ==, work.instances_made + 4);
    set(shown, document, "trunk.number", "7");
    set(shown, document, "trunk.number", "12");
    set(shown, document, "bark.tile-width", "0.3");
    set(shown, document, "tree.seed", "4");
    fr_rebuild_free(shown);
    fr_document_free(document);
}

static void test_ranges(void) {
    FrDocument *document = parse_text(text);
    FrRebuild *shown = rebuild_new();
    update(shown, document);
    set(shown, document, "fruit.scale", "2");
    uint32_t count;
    const FrSkinPart *parts = fr_skin_parts(fr_rebuild_skin(shown, 0), &count);
    uint32_t changed = 0;
    for (uint32_t i = 0; i < count; i++) {
        bool is_whole = parts[i].changed_vertex == 0 &&
                        parts[i].changed_vertex_end == parts[i].part.vertex_count;
        bool is_kept = parts[i].changed_vertex == parts[i].changed_vertex_end;
        g_assert_true(is_whole || is_kept);
        g_assert_cmpuint(parts[i].changed_index, ==, parts[i].changed_index_end);
        changed += is_whole;
    }
    g_assert_cmpuint(changed, ==, 1);
    fr_rebuild_free(shown);
    fr_document_free(document);
}

static void test_failure(void) {
    FrDocument *document = parse_text(text);
    FrRebuild *shown = rebuild_new();
    update(shown, document);
    FrDigest before = shown_digest(shown);
    FrContext narrow = context;
    g_assert_cmpint(fr_document_set(document, "twig.number", "30", &context), ==, FR_OK);
    narrow.limits.instances = 400;
    g_assert_cmpint(fr_rebuild_update(shown, document, -1, &narrow), ==, FR_ERR_LIMIT);
    narrow = context;
    narrow.limits.triangles = 4000; // the first plant is planned already when the last is too much
    g_assert_cmpint(fr_rebuild_update(shown, document, -1, &narrow), ==, FR_ERR_LIMIT);
    narrow = context;
    narrow.progress = fr_progress_new(NULL, NULL);
    fr_progress_cancel(narrow.progress);
    g_assert_cmpint(fr_rebuild_update(shown, document, -1, &narrow), ==, FR_CANCELLED);
    fr_progress_free(narrow.progress);
    g_assert_cmphex(shown_digest(shown), ==, before);
    g_assert_cmpint(fr_document_set(document, "twig.number", "8", &context), ==, FR_OK);
    FrRebuildWork work = update(shown, document);
    g_assert_cmpuint(work.instances_made + work.skin.runs_written + work.skin.organs_written, ==,
                     0);
    fr_document_free(document);
    g_assert_cmphex(shown_digest(shown), ==, before);
    g_assert_cmpfloat(fr_rebuild_scene(shown)->params->sun_elevation, ==, 42 * G_PI / 180);
    fr_rebuild_free(shown);
}

static void test_structure(void) {
    static const char *const paths[] = {"examples/figure2.frond",     "data/presets/daisy.frond",
                                        "examples/collection.frond",  "examples/figure2.frond",
                                        "examples/shore-trees.frond", "data/presets/fern.frond",
                                        "examples/blossom.frond",     "examples/indicators.frond"};
    FrRebuild *shown = rebuild_new();
    for (size_t i = 0; i < G_N_ELEMENTS(paths); i++) {
        FrDocument *document = load(paths[i]);
        update(shown, document);
        FrRebuildWork again = update(shown, document);
        g_assert_cmpuint(again.instances_made, ==, 0);
        fr_document_free(document);
    }
    fr_rebuild_free(shown);
}

#define NAME(text) "/scene/shown/" text

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    context = fr_context_default();
    context.pool = fr_pool_new(3);
    g_test_add_func(NAME("another colour touches no geometry"), test_look);
    g_test_add_func(NAME("another shape of leaves writes leaves only"), test_shape);
    g_test_add_func(NAME("only what depends on a change is made and written"), test_parts);
    g_test_add_func(NAME("what was written is told part by part"), test_ranges);
    g_test_add_func(NAME("a failed update leaves everything as it was"), test_failure);
    g_test_add_func(NAME("one document may follow on another"), test_structure);
    int result = g_test_run();
    fr_pool_free(context.pool);
    return result;
}
