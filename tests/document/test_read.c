/// Sections are read into definitions; what is wrong is said at its place.
#include "documents.h"

#include <glib/gstdio.h>

static void test_definitions(void) {
    char *path = in_source("tests/document/versions/1.frond");
    FrContext context = fr_context_default();
    context.diags = fr_diags_new();
    FrDocument *document;
    FrStatus status = fr_document_load(path, &context, &document);
    char *said = printed(context.diags);
    g_test_message("%s", said);
    g_assert_cmpint(status, ==, FR_OK);
    g_assert_cmpuint(fr_document_plants(document)->len, ==, 1);
    const FrPlantDef *plant = g_ptr_array_index(fr_document_plants(document), 0);
    g_assert_cmpstr(plant->id, ==, "shrub");
    g_assert_cmpuint(plant->seed, ==, 7);
    g_assert_cmpuint(fr_pgraph_count(plant->pgraph), ==, 4);
    g_assert_cmpint(fr_pgraph_kind(plant->pgraph, 1), ==, FR_COMPONENT_TREE);
    g_assert_cmpstr(fr_pgraph_id(plant->pgraph, 1), ==, "trunk");
    g_assert_cmpuint(fr_document_materials(document)->len, ==, 2);
    const GPtrArray *places = fr_document_places(document);
    g_assert_cmpuint(places->len, ==, 2);
    const FrPlace *second = g_ptr_array_index(places, 1);
    g_assert_cmpstr(second->plant, ==, "shrub");
    g_assert_cmpfloat_with_epsilon(second->turn, 70 * G_PI / 180, 1e-12);
    g_assert_cmpint((int)second->seed, ==, 9);
    const FrViewParams *view = g_ptr_array_index(fr_document_views(document), 0);
    g_assert_cmpstr(view->name, ==, "front");
    g_assert_cmpfloat_with_epsilon(view->azimuth, 20 * G_PI / 180, 1e-12);
    g_assert_cmpfloat_with_epsilon(fr_document_scene(document)->sun_elevation, 40 * G_PI / 180,
                                   1e-12);
    char *title = fr_document_title(document);
    g_assert_cmpstr(title, ==, "A document of version 1: every version of the program reads it.");
    g_free(title);
    g_free(said);
    fr_document_free(document);
    fr_diags_free(context.diags);
    g_free(path);
}

static void test_shipped(void) {
    static const char *const folders[] = {"examples", "data/presets"};
    for (size_t f = 0; f < G_N_ELEMENTS(folders); f++) {
        GPtrArray *paths = documents_in(folders[f]);
        for (guint i = 0; i < paths->len; i++) {
            FrContext context = fr_context_default();
            context.diags = fr_diags_new();
            FrDocument *document;
            FrStatus status = fr_document_load(g_ptr_array_index(paths, i), &context, &document);
            char *said = printed(context.diags);
            g_test_message("%s", said);
            g_assert_cmpint(status, ==, FR_OK);
            g_assert_cmpuint(fr_diags_count(context.diags), ==, 0);
            g_free(said);
            fr_document_free(document);
            fr_diags_free(context.diags);
        }
        g_ptr_array_unref(paths);
    }
}

typedef struct Wrong {
    const char *inner; ///< of the root, which begins on line 1; this on line 2
    const char *code;
    uint32_t line, column;
} Wrong;

#define GRAPH(inner) "<plant id='p'><pgraph><camera id='r'/>" inner "</pgraph></plant>"

#define SLIDERS(inner)                                                                             \
    "<plant id='p'>" inner "<pgraph><camera id='r'/><horn id='h'/>"                                \
    "<link from='r' to='h'/></pgraph></plant>"

static const Wrong wrongs[] = {
    {"<oak/>", "unknown-element", 2, 2},
    {"<place plant='p'/>", "misplaced-element", 2, 2},
    {"  words", "unexpected-text", 2, 3},
    {"<![CDATA[words]]>", "unexpected-text", 2, 10},
    {"<material id='m' coulour='#ffffff'/>", "unknown-attribute", 2, 18},
    {"<material id='m' tile_width='1'/>", "unknown-attribute", 2, 18},
    {"<material/>", "missing-attribute", 2, 2},
    {"<material id='1m'/>", "bad-id", 2, 15},
    {"<material id='a.b'/>", "bad-id", 2, 15},
    {"<material id='m'/><material id='m'/>", "duplicate-id", 2, 33},
    {"<material id='m' picture='none.png'/>", "missing-file", 2, 27},
    {"<material id='m' picture='/etc/passwd'/>", "absolute-path", 2, 27},
    {"<curve id='c'/>", "missing-attribute", 2, 2},
    {"<curve id='c' points='1,0 0,1'/>", "bad-curve", 2, 23},
    {"<curve id='c' points='0,1'/>\n<function id='c'>1</function>", NULL, 3, 0},
    {"<plant id='p'/>", "missing-element", 2, 2},
    {GRAPH("<link from='r' to='trnk'/><horn id='trunk'/>"), "unknown-component", 2, 58},
    {"<plant id='p'><pgraph><!-- nothing --></pgraph></plant>", "no-component", 2, 16},
    {GRAPH("<horn id='h' material='brk'/>"), "unknown-material", 2, 62},
    {GRAPH("<link to='r'/>"), "missing-attribute", 2, 40},
    {GRAPH("<horn id='r'/>"), NULL, 2, 0},
    {GRAPH("<horn id='h'/><link from='r' to='h' kind='stem'/>"), "unknown-choice", 2, 81},
    {"<slider id='s'/>", "misplaced-element", 2, 2},
    {SLIDERS("<slider id='t'/>"), "name-taken", 2, 27},
    {SLIDERS("<slider id='seed'/>"), "name-taken", 2, 27},
    {SLIDERS("<slider id='bell'/>"), "name-taken", 2, 27},
    {SLIDERS("<slider id='a-b'/>"), "name-taken", 2, 27},
    {SLIDERS("<slider id='h'/>"), "duplicate-id", 2, 27},
    {SLIDERS("<slider id='a'/>\n<slider id='a'/>"), "duplicate-id", 3, 13},
    {SLIDERS("<slider id='a' min='2'/>"), "slider-range", 2, 35},
    {SLIDERS("<slider id='a' initial='2'/>"), "out-of-range", 2, 39},
    {SLIDERS("<slider id='a' value='-1'/>"), "out-of-range", 2, 37},
    {"<plant id='p'><pgraph><camera id='r'/><horn id='h' seed='= t'/></pgraph></plant>",
     "not-fixed", 2, 59},
    {"<scene/>\n<scene/>", "repeated-element", 3, 2},
    {"<scene><place/></scene>", "missing-attribute", 2, 9},
    {"<scene><place plant='oak'/></scene>", "unknown-plant", 2, 22},
    {"<scene><view name='a'/><view name='a'/></scene>", "duplicate-id", 2, 36},
    {"<scene sun-elevation='high'/>", NULL, 2, 23},
    {"<scene sun-elevation='nan'/>", NULL, 2, 23},
    {"<scene sun-elevation='inf'/>", NULL, 2, 23},
    {"<scene sun-elevation='1e999'/>", NULL, 2, 23},
    {"<scene sun-elevation='91'/>", NULL, 2, 23},
    {"<scene sun-elevation=''/>", NULL, 2, 23},
};

static void test_wrong(void) {
    for (size_t i = 0; i < G_N_ELEMENTS(wrongs); i++) {
        const Wrong *wrong = &wrongs[i];
        char *text = in_root(wrong->inner);
        Parsed parsed = parse(text);
        char *said = printed(parsed.diags);
        g_test_message("%s\n%s", wrong->inner, said);
        g_assert_cmpint(parsed.status, ==, FR_ERR_DOCUMENT);
        g_assert_nonnull(parsed.document);
        g_assert_cmpuint(fr_diags_error_count(parsed.diags), ==, 1);
        const FrDiag *diag = fr_diags_get(parsed.diags, 0);
        if (wrong->code != NULL) {
            g_assert_cmpstr(diag->code, ==, wrong->code);
        }
        uint32_t line, column;
        fr_source_position(diag->span.source, diag->span.begin, &line, &column);
        g_assert_cmpuint(line, ==, wrong->line);
        if (wrong->column != 0) {
            g_assert_cmpuint(column, ==, wrong->column);
        }
        g_free(said);
        forget(&parsed);
        g_free(text);
    }
}

static void test_versions(void) {
    static const struct {
        const char *text, *code;
    } rows[] = {
        {"<frond/>", "missing-version"},
        {"<frond version='2'/>", "newer-version"},
        {"<forest version='1'/>", "not-a-document"},
    };
    for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
        Parsed parsed = parse(rows[i].text);
        uint32_t column = strcmp(rows[i].code, "newer-version") == 0 ? 17 : 2;
        assert_one_error(&parsed, FR_ERR_DOCUMENT, rows[i].code, 1, column);
        forget(&parsed);
    }
    Parsed schema_aware = parse("<frond version='1' xmlns:xsi='http://www.w3.org/2001/"
                                "XMLSchema-instance' xsi:noNamespaceSchemaLocation='f.xsd'/>");
    g_assert_cmpint(schema_aware.status, ==, FR_OK);
    forget(&schema_aware);
}

/// Many errors in one run, each with the line, a caret and, where there is one, the near name.
static void test_carets(void) {
    Parsed parsed = parse("<frond version='1'>\n"
                          "  <material id='bark' textur='leaf'/>\n"
                          "  <curv id='c'/>\n"
                          "  <plant id='oak'>\n"
                          "    <pgraph>\n"
                          "      <camera id='root'/>\n"
                          "      <horn id='trunk' lenght='3'/>\n"
                          "      <link from='root' to='trunc'/>\n"
                          "    </pgraph>\n"
                          "  </plant>\n"
                          "  <scene><place plant='oaks'/></scene>\n"
                          "</frond>\n");
    char *said = printed(parsed.diags);
    g_assert_cmpstr(
        said, ==,
        "test.frond:3:4: error: unknown element <curv> in <frond>; did you mean 'curve'? "
        "[unknown-element]\n"
        "    3 |   <curv id='c'/>\n"
        "      |    ^~~~\n"
        "test.frond:2:23: error: unknown attribute 'textur' of <material>; did you mean "
        "'texture'? [unknown-attribute]\n"
        "    2 |   <material id='bark' textur='leaf'/>\n"
        "      |                       ^~~~~~\n"
        "test.frond:7:24: error: unknown attribute 'lenght' of <horn>; did you mean 'length'? "
        "[unknown-attribute]\n"
        "    7 |       <horn id='trunk' lenght='3'/>\n"
        "      |                        ^~~~~~\n"
        "test.frond:8:29: error: there is no component 'trunc' in this graph; did you mean "
        "'trunk'? [unknown-component]\n"
        "    8 |       <link from='root' to='trunc'/>\n"
        "      |                             ^~~~~\n"
        "test.frond:11:24: error: there is no plant 'oaks'; did you mean 'oak'? "
        "[unknown-plant]\n"
        "   11 |   <scene><place plant='oaks'/></scene>\n"
        "      |                        ^~~~\n");
    g_free(said);
    forget(&parsed);
}

/// The name is suggested even where no component of the graph uses that material.
static void test_material_is_suggested(void) {
    Parsed parsed = parse("<frond version='1'><material id='bark'/>\n" GRAPH(
        "<horn id='h' material='bakr'/>") "</frond>");
    assert_one_error(&parsed, FR_ERR_DOCUMENT, "unknown-material", 2, 62);
    g_assert_cmpstr(fr_diags_get(parsed.diags, 0)->text, ==,
                    "there is no material 'bakr'; did you mean 'bark'?");
    forget(&parsed);
}

/// A picture that is there but is none is found when it is read, and shown where it is named.
static void test_damaged_picture(void) {
    char *folder = g_dir_make_tmp("frond-XXXXXX", NULL);
    char *picture = g_build_filename(folder, "leaf.png", NULL);
    g_assert_true(g_file_set_contents(picture, "no picture", -1, NULL));
    FrContext context = fr_context_default();
    context.diags = fr_diags_new();
    const char *text = "<frond version='1'>\n<material id='m'\n  normal-map='leaf.png'/></frond>";
    FrSource *source = fr_source_new("test.frond", text, strlen(text));
    Parsed parsed = {.diags = context.diags};
    FrStatus status = fr_document_parse(source, folder, &context, &parsed.document);
    g_assert_cmpint(status, ==, FR_OK);
    FrMaterial *material = g_ptr_array_index(fr_document_materials(parsed.document), 0);
    g_assert_null(fr_material_image(material, FR_MAP_NORMAL, &context, &parsed.status));
    assert_one_error(&parsed, FR_ERR_DOCUMENT, "picture-format", 3, 15);
    forget(&parsed);
    fr_source_unref(source);
    g_remove(picture);
    g_rmdir(folder);
    g_free(picture);
    g_free(folder);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func(
        "/document/read/C37 a document of version 1 gives its definitions, views and sun",
        test_definitions);
    g_test_add_func("/document/read/examples and presets have nothing wrong", test_shipped);
    g_test_add_func("/document/read/what is wrong is said at its place", test_wrong);
    g_test_add_func("/document/read/versions are minded", test_versions);
    g_test_add_func("/document/read/many errors come in one run with carets and near names",
                    test_carets);
    g_test_add_func("/document/read/a material's name is suggested", test_material_is_suggested);
    g_test_add_func("/document/read/a damaged picture is shown where it is named",
                    test_damaged_picture);
    return g_test_run();
}
