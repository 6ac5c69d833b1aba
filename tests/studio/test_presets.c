#include "studio/model/presets.h"

#include "frond/document.h"
#include "frond/presets.h"
#include "studio.h"
#include "studio/model/subgraph.h"

#include <glib/gstdio.h>

#define BUSH                                                                                       \
    "<frond version=\"1\">\n  <curve id=\"thin\" points=\"0,1 1,0.2\"/>\n"                         \
    "  <curve id=\"unused\" points=\"0,1 1,0\"/>\n"                                                \
    "  <function id=\"swing\">thin(t) * 0.5</function>\n"                                          \
    "  <material id=\"my-bark\" colour=\"#665544\"/>\n  <material id=\"red\" "                     \
    "colour=\"#cc2211\"/>\n  <plant id=\"bush\" seed=\"7\">\n"                                     \
    "    <slider id=\"size\" label=\"how big\" min=\"0\" max=\"2\"/>\n"                            \
    "    <slider id=\"other\" label=\"of the trunk\"/>\n    <pgraph>\n"                            \
    "      <camera id=\"root\"/>\n"                                                                \
    "      <horn id=\"trunk\" material=\"my-bark\" length=\"1 | other\"/>\n"                       \
    "      <horn id=\"twig\" length=\"0.3 | size\" radius=\"0.01..0.02 : swing()\"/>\n"            \
    "      <leaf id=\"leaf\" material=\"red\"/>\n"                                                 \
    "      <link from=\"root\" to=\"trunk\"/>\n      <link from=\"trunk\" to=\"twig\"/>\n"         \
    "      <link from=\"twig\" to=\"leaf\"/>\n    </pgraph>\n  </plant>\n</frond>\n"

#define CUT                                                                                        \
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<frond version=\"1\">\n"                          \
    "  <curve id=\"thin\" points=\"0,1 1,0.2\"/>\n"                                                \
    "  <function id=\"swing\">thin(t) * 0.5</function>\n"                                          \
    "  <material id=\"my-bark\" colour=\"#665544\"/>\n  <material id=\"red\" "                     \
    "colour=\"#cc2211\"/>\n  <plant id=\"red_twig\" seed=\"7\">\n"                                 \
    "    <slider id=\"size\" label=\"how big\" min=\"0\" max=\"2\"/>\n    <pgraph>\n"              \
    "      <camera id=\"root2\"/>\n"                                                               \
    "      <horn material=\"my-bark\" id=\"twig\" length=\"0.3 | size\" radius=\"0.01..0.02 : "    \
    "swing()\"/>\n      <leaf id=\"leaf\" material=\"red\"/>\n"                                    \
    "      <link from=\"root2\" to=\"twig\"/>\n      <link from=\"twig\" to=\"leaf\"/>\n"          \
    "    </pgraph>\n  </plant>\n</frond>\n"

static StudioDocument *document_of(const char *text) {
    return studio_document_new(text, strlen(text), "test", NULL);
}

// Whether a text is a document of so many instances.
static uint64_t instances_of(const char *text) {
    FrContext context = fr_context_default();
    context.diags = fr_diags_new();
    FrSource *source = fr_source_new("test", text, strlen(text));
    FrDocument *document;
    g_assert_cmpint(fr_document_parse(source, ".", &context, &document), ==, FR_OK);
    g_assert_cmpuint(fr_diags_count(context.diags), ==, 0);
    FrScene *scene;
    g_assert_cmpint(fr_scene_build(document, -1, &context, &scene), ==, FR_OK);
    uint64_t count = g_array_index(scene->plants, FrScenePlant, 0).instances;
    fr_scene_free(scene);
    fr_document_free(document);
    fr_source_unref(source);
    fr_diags_free(context.diags);
    return count;
}

static void test_cut(void) {
    StudioDocument *document = document_of(BUSH);
    char *text = studio_subgraph_text(document, first_plant(document), "twig", "red twig");
    g_assert_cmpstr(text, ==, CUT);
    g_assert_cmpuint(instances_of(text), >=, 2);
    g_free(text);
    g_assert_null(studio_subgraph_text(document, first_plant(document), "elm", "elm"));
    studio_document_free(document);
}

static void test_cut_presets(void) {
    // All of it, and each part of it, is a document without errors or warnings.
    static const char *const presets[] = {"oak", "daisy", "fern", "poppy", "palm", "spruce"};
    for (size_t i = 0; i < G_N_ELEMENTS(presets); i++) {
        char *name = g_strdup_printf("data/presets/%s.frond", presets[i]);
        StudioDocument *document = open_example(name);
        const FrContents *contents = studio_document_contents(document);
        uint32_t plant = first_plant(document);
        for (uint32_t c = 0; c < fr_contents_count(contents); c++) {
            if (fr_contents_at(contents, c)->component >= 0) {
                const char *id = fr_contents_at(contents, c)->id;
                char *text = studio_subgraph_text(document, plant, id, "1 part");
                FrContext context = fr_context_default();
                context.diags = fr_diags_new();
                FrSource *source = fr_source_new(id, text, strlen(text));
                FrDocument *part;
                g_assert_cmpint(fr_document_parse(source, ".", &context, &part), ==, FR_OK);
                g_assert_cmpuint(fr_diags_error_count(context.diags), ==, 0);
                fr_document_free(part);
                fr_source_unref(source);
                fr_diags_free(context.diags);
                g_free(text);
            }
        }
        studio_document_free(document);
        g_free(name);
    }
}

static void test_insert(void) {
    StudioDocument *document = document_of(BUSH);
    uint32_t plant = first_plant(document);
    FrSource *source = fr_source_new("cut", CUT, strlen(CUT));
    g_assert_null(studio_subgraph_refusal(source));
    char *id;
    uint64_t before = instances_of(BUSH);
    g_assert_true(studio_insert_subgraph(document, plant, source, "trunk", &id));
    g_assert_cmpstr(id, ==, "twig2");
    g_assert_cmpuint(studio_document_steps(document), ==, 1);
    g_assert_cmpstr(studio_document_undo_name(document), ==, "Insert red_twig");
    const char *text = text_of(document);
    g_assert_nonnull(
        strstr(text, "<horn material=\"my-bark\" id=\"twig2\" length=\"0.3 | size\" "));
    g_assert_nonnull(strstr(text, "\n      <link from=\"trunk\" to=\"twig2\"/>\n"));
    g_assert_nonnull(strstr(text, "\n      <link from=\"twig2\" to=\"leaf2\"/>\n"));
    g_assert_null(strstr(text, "red_twig")); // all else is there, the same to the byte
    g_assert_null(strstr(text, "root2"));
    g_assert_cmpuint(instances_of(text), ==, before + 2);
    g_free(id);
    g_assert_true(studio_document_undo(document));
    g_assert_cmpstr(text_of(document), ==, BUSH);
    fr_source_unref(source);
    studio_document_free(document);
}

static void test_insert_clash(void) {
    static const char here[] =
        "<frond version=\"1\">\n  <curve id=\"thin\" points=\"0,0 1,1\"/>\n"
        "  <material id=\"my-bark\" colour=\"#000000\"/>\n"
        "  <plant id=\"p\">\n    <slider id=\"size\" min=\"1\" max=\"3\"/>\n    <pgraph>\n"
        "      <horn id=\"twig\" length=\"1 | size\"/>\n    </pgraph>\n  </plant>\n</frond>\n";
    StudioDocument *document = document_of(here);
    FrSource *source = fr_source_new("cut", CUT, strlen(CUT));
    g_assert_true(studio_insert_subgraph(document, first_plant(document), source, NULL, NULL));
    const char *text = text_of(document);
    g_assert_nonnull(strstr(text, "\n  <curve id=\"red_twig_thin\" points=\"0,1 1,0.2\"/>\n"));
    g_assert_nonnull(strstr(text, "<function id=\"swing\">red_twig_thin(t) * 0.5</function>"));
    g_assert_nonnull(strstr(text, "<material id=\"red_twig_my_bark\" colour=\"#665544\"/>"));
    g_assert_nonnull(strstr(text, "\n    <slider id=\"red_twig_size\" label=\"how big\""));
    g_assert_nonnull(strstr(text,
                            "<horn material=\"red_twig_my_bark\" id=\"twig2\" "
                            "length=\"0.3 | red_twig_size\" radius=\"0.01..0.02 : swing()\"/>"));
    g_assert_null(strstr(text, "to=\"twig2\"")); // nothing leads to it
    fr_source_unref(source);
    studio_document_free(document);
}

static void test_insert_shipped(void) {
    char *path = project_file("data/presets/daisy.frond");
    FrStatus status;
    FrSource *source = fr_source_load(path, 1000000, NULL, &status);
    StudioDocument *document = document_of(BUSH);
    g_assert_true(studio_insert_subgraph(document, first_plant(document), source, "trunk", NULL));
    const char *text = text_of(document);
    g_assert_nonnull(strstr(text, "<link from=\"trunk\" to=\"rosette\"/>"));
    g_assert_nonnull(strstr(text, "<link from=\"trunk\" to=\"stalks\"/>"));
    g_assert_cmpuint(instances_of(text), >, 900);
    fr_source_unref(source);
    studio_document_free(document);
    g_free(path);
}

static void test_refused(void) {
    static const char *const texts[] = {
        "<frond version=\"1\"/>", "<frond version=\"1\"><plant id=\"p\"><species/></plant></frond>",
        "<frond version=\"1\"><plant id=\"p\"><pgraph><camera id=\"c\"/></pgraph></plant></frond>",
        "<frond"};
    StudioDocument *document = document_of(BUSH);
    for (size_t i = 0; i < G_N_ELEMENTS(texts); i++) {
        FrSource *source = fr_source_new("no", texts[i], strlen(texts[i]));
        char *id;
        g_assert_nonnull(studio_subgraph_refusal(source));
        g_assert_false(
            studio_insert_subgraph(document, first_plant(document), source, "trunk", &id));
        g_assert_null(id);
        fr_source_unref(source);
    }
    g_assert_cmpstr(text_of(document), ==, BUSH);
    studio_document_free(document);
}

// ---- the folder --------------------------------------------------------------------------------

static char *new_folder(void) {
    char *folder = g_dir_make_tmp("frond-presets-XXXXXX", NULL), *within;
    within = g_build_filename(folder, "a", "b", NULL); // made when something is kept
    g_free(folder);
    return within;
}

static void remove_folder(char *folder) {
    for (int i = 0; i < 3; i++) {
        char *outer = g_path_get_dirname(folder);
        g_assert_cmpint(g_rmdir(folder), ==, 0);
        g_free(folder);
        folder = outer;
    }
    g_free(folder);
}

static void test_keep(void) {
    char *folder = new_folder();
    GPtrArray *none = fr_presets_list(folder);
    g_assert_cmpuint(none->len, ==, 0);
    g_ptr_array_unref(none);
    g_assert_cmpint(studio_presets_save(folder, "red twig", CUT, ".", NULL), ==, FR_OK);
    g_assert_cmpint(studio_presets_save(folder, "bush", BUSH, ".", NULL), ==, FR_OK);
    GPtrArray *two = fr_presets_list(folder);
    g_assert_cmpuint(two->len, ==, 2);
    g_assert_cmpstr(g_ptr_array_index(two, 0), ==, "bush");
    g_ptr_array_unref(two);
    g_assert_false(studio_presets_rename(folder, "red twig", "bush"));
    g_assert_false(studio_presets_rename(folder, "elm", "ash"));
    g_assert_true(studio_presets_rename(folder, "red twig", "blue twig"));
    char *file = fr_presets_file(folder, "blue twig", ".frond"), *text;
    g_assert_true(g_file_get_contents(file, &text, NULL, NULL));
    g_assert_cmpstr(text, ==, CUT);
    g_free(text);
    g_free(file);
    g_assert_true(studio_presets_remove(folder, "blue twig"));
    g_assert_false(studio_presets_remove(folder, "blue twig"));
    g_assert_true(studio_presets_remove(folder, "bush"));
    remove_folder(folder);
}

static void test_keep_wrong(void) {
    char *folder = new_folder();
    FrDiags *diags = fr_diags_new();
    g_assert_cmpint(
        studio_presets_save(folder, "x", "<frond version=\"1\"><oops/></frond>", ".", diags), ==,
        FR_ERR_DOCUMENT);
    g_assert_cmpuint(fr_diags_error_count(diags), >, 0);
    g_assert_false(g_file_test(folder, G_FILE_TEST_EXISTS));
    fr_diags_free(diags);
    char *outer = g_path_get_dirname(folder), *first = g_path_get_dirname(outer);
    g_assert_cmpint(g_rmdir(first), ==, 0);
    g_free(first);
    g_free(outer);
    g_free(folder);
}

static void test_names(void) {
    static const char *const wrong[] = {"", ".hidden", "a/b", "../a", "a\nb", " a", "a ", "-x"};
    for (size_t i = 0; i < G_N_ELEMENTS(wrong); i++) {
        g_assert_nonnull(studio_presets_name_refusal(wrong[i]));
    }
    g_assert_null(studio_presets_name_refusal("Rosen\u00adbusch 2"));
}

static void test_draw(void) {
    char *folder = new_folder();
    FrContext context = fr_context_default();
    g_assert_cmpint(studio_presets_save(folder, "twig", CUT, ".", NULL), ==, FR_OK);
    g_assert_cmpint(studio_presets_draw(folder, "twig", &context), ==, FR_OK);
    char *file = fr_presets_file(folder, "twig", ".png"), *bytes;
    gsize size;
    g_assert_true(g_file_get_contents(file, &bytes, &size, NULL));
    g_assert_cmpint(memcmp(bytes, "\x89PNG", 4), ==, 0);
    g_free(bytes);
    g_assert_cmpint(studio_presets_save(folder, "twig", BUSH, ".", NULL), ==, FR_OK);
    g_assert_false(g_file_test(file, G_FILE_TEST_EXISTS)); // it shows another plant
    g_assert_true(studio_presets_remove(folder, "twig"));
    g_free(file);
    remove_folder(folder);
}

static void test_problem(void) {
    char *folder = new_folder(), *file = fr_presets_file(folder, "twig", ".frond");
    g_assert_cmpint(studio_presets_save(folder, "twig", CUT, ".", NULL), ==, FR_OK);
    g_assert_null(studio_presets_problem(file));
    g_assert_true(
        g_file_set_contents(file, "<frond version='1'>\n  <plan id='p'/>\n</frond>\n", -1, NULL));
    char *problem = studio_presets_problem(file);
    g_assert_true(g_str_has_prefix(problem, "line 2: "));
    g_free(problem);
    g_unlink(file);
    problem = studio_presets_problem(file);
    g_assert_nonnull(problem);
    g_free(problem);
    g_free(file);
    remove_folder(folder);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/studio/presets/a subgraph is cut out with what it uses alone", test_cut);
    g_test_add_func("/studio/presets/each part of the presets stands alone", test_cut_presets);
    g_test_add_func("/studio/presets/inserting is one step and uses what is there", test_insert);
    g_test_add_func("/studio/presets/names that clash get new ones", test_insert_clash);
    g_test_add_func("/studio/presets/all that stands on a camera is linked", test_insert_shipped);
    g_test_add_func("/studio/presets/what has no components is not inserted", test_refused);
    g_test_add_func("/studio/presets/presets are kept, renamed and removed", test_keep);
    g_test_add_func("/studio/presets/what is wrong is not kept", test_keep_wrong);
    g_test_add_func("/studio/presets/what has become wrong is told with its line", test_problem);
    g_test_add_func("/studio/presets/names are those of files", test_names);
    g_test_add_func("/studio/presets/a preset is drawn", test_draw);
    return g_test_run();
}
