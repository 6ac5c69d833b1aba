/// Pictures and meshes go with a part to the presets, and with a preset to the next document.
#include "frond/document.h"
#include "frond/presets.h"
#include "studio.h"
#include "studio/model/adopt.h"
#include "studio/model/presets.h"
#include "studio/model/subgraph.h"

#include <glib/gstdio.h>
#include <sys/stat.h>
#include <unistd.h>

// A folder with two documents' folders and the presets in it.
typedef struct Fixture {
    char *home, *here, *there, *presets;
} Fixture;

#define ADD(name, function) g_test_add(name, Fixture, NULL, set_up, function, tear_down)

static char *folder_within(const char *home, const char *name) {
    char *path = g_build_filename(home, name, NULL);
    g_assert_cmpint(g_mkdir_with_parents(path, 0777), ==, 0);
    return path;
}

static void set_up(Fixture *fixture, gconstpointer data) {
    (void)data;
    fixture->home = g_dir_make_tmp("frond-carry-XXXXXX", NULL);
    fixture->here = folder_within(fixture->home, "here");
    fixture->there = folder_within(fixture->home, "there");
    fixture->presets = folder_within(fixture->home, "presets");
}

static void tear_down(Fixture *fixture, gconstpointer data) {
    (void)data;
    remove_tree(fixture->home);
    g_free(fixture->home);
    g_free(fixture->here);
    g_free(fixture->there);
    g_free(fixture->presets);
}

static void write_bytes(const char *folder, const char *name, const void *bytes, size_t size) {
    char *path = g_build_filename(folder, name, NULL), *outer = g_path_get_dirname(path);
    g_assert_cmpint(g_mkdir_with_parents(outer, 0777), ==, 0);
    g_assert_true(g_file_set_contents(path, bytes, (gssize)size, NULL));
    g_free(outer);
    g_free(path);
}

static void write_text(const char *folder, const char *name, const char *text) {
    write_bytes(folder, name, text, strlen(text));
}

// A picture of one colour, which tells pictures apart.
static void write_picture(const char *folder, const char *name, uint8_t red) {
    FrImage *image = fr_image_new(2, 2, 3);
    memset(image->pixels, red, (size_t)2 * 2 * 3);
    GBytes *png = fr_image_to_png(image);
    gsize size;
    const void *bytes = g_bytes_get_data(png, &size);
    write_bytes(folder, name, bytes, size);
    g_bytes_unref(png);
    fr_image_unref(image);
}

static bool is_there(const char *folder, const char *name) {
    char *path = g_build_filename(folder, name, NULL);
    bool is_it = g_file_test(path, G_FILE_TEST_EXISTS);
    g_free(path);
    return is_it;
}

static void assert_same(const char *folder, const char *name, const char *other_folder,
                        const char *other) {
    char *a = g_build_filename(folder, name, NULL),
         *b = g_build_filename(other_folder, other, NULL);
    char *bytes[2];
    gsize sizes[2];
    g_assert_true(g_file_get_contents(a, &bytes[0], &sizes[0], NULL));
    g_assert_true(g_file_get_contents(b, &bytes[1], &sizes[1], NULL));
    g_assert_cmpuint(sizes[0], ==, sizes[1]);
    g_assert_true(memcmp(bytes[0], bytes[1], sizes[0]) == 0);
    g_free(bytes[0]);
    g_free(bytes[1]);
    g_free(a);
    g_free(b);
}

static StudioDocument *save_in(const char *folder, const char *text) {
    StudioDocument *document = studio_document_new(text, strlen(text), "test", folder);
    char *path = g_build_filename(folder, "plant.frond", NULL);
    FrDiags *diags = fr_diags_new();
    g_assert_cmpint(studio_document_save(document, path, diags), ==, FR_OK);
    fr_diags_free(diags);
    g_free(path);
    return document;
}

// Whether all that a text names is there and it is right.
static bool is_right(const char *text, const char *folder) {
    FrContext context = fr_context_default();
    FrSource *source = fr_source_new("right", text, strlen(text));
    FrDocument *document;
    FrStatus status = fr_document_parse(source, folder, &context, &document);
    fr_document_free(document);
    fr_source_unref(source);
    return status == FR_OK;
}

static char *preset_text(const Fixture *fixture, const char *name) {
    char *file = fr_presets_file(fixture->presets, name, ".frond"), *text;
    g_assert_true(g_file_get_contents(file, &text, NULL, NULL));
    g_free(file);
    return text;
}

// A part of a document kept as a preset; NULL, or why it is not, to be freed with g_free().
static char *keep(const Fixture *fixture, const StudioDocument *document, const char *id,
                  const char *name) {
    char *text = studio_subgraph_text(document, first_plant(document), id, name), *why = NULL;
    FrDiags *diags = fr_diags_new();
    if (studio_presets_save(fixture->presets, name, text, studio_document_folder(document),
                            diags) != FR_OK) {
        why = g_strdup(fr_diags_get(diags, 0)->text);
    }
    fr_diags_free(diags);
    g_free(text);
    return why;
}

static FrContents *read_contents(const char *text) {
    FrContext context = fr_context_default();
    FrSource *source = fr_source_new("preset", text, strlen(text));
    FrContents *contents;
    g_assert_cmpint(fr_contents_read(source, &context, &contents), ==, FR_OK);
    fr_source_unref(source);
    return contents;
}

// A text from the presets' folder put into a document; why not, to be freed with g_free().
static char *put_in(const Fixture *fixture, StudioDocument *document, const char *text) {
    FrContents *theirs = read_contents(text);
    GHashTable *wanted = studio_subgraph_elements(theirs);
    StudioCarried carried = studio_bring(document, theirs, fixture->presets, wanted);
    char *why = g_strdup(carried.refusal);
    g_assert_true((carried.source == NULL) == (why != NULL));
    if (carried.source != NULL) {
        g_assert_true(
            studio_insert_subgraph(document, first_plant(document), carried.source, NULL, NULL));
    }
    studio_carried_clear(&carried);
    g_hash_table_unref(wanted);
    fr_contents_free(theirs);
    return why;
}

#define DRESSED(picture)                                                                           \
    "<frond version=\"1\">\n  <material id=\"m\" picture=\"" picture "\"/>\n"                      \
    "  <plant id=\"p\"><pgraph>\n    <horn id=\"h\" material=\"m\"/>\n  </pgraph></plant>\n"       \
    "</frond>\n"
#define BARE                                                                                       \
    "<frond version=\"1\">\n  <plant id=\"q\"><pgraph>\n    <horn id=\"stem\"/>\n"                 \
    "  </pgraph></plant>\n</frond>\n"

static void test_there_and_back(Fixture *fixture, gconstpointer data) {
    (void)data;
    write_picture(fixture->home, "textures/bark.png", 100);
    StudioDocument *document = save_in(fixture->here, DRESSED("../textures/bark.png"));
    g_assert_null(keep(fixture, document, "h", "my bark"));
    studio_document_free(document);
    char *text = preset_text(fixture, "my bark");
    g_assert_nonnull(strstr(text, "picture=\"my bark.files/bark.png\""));
    g_assert_true(is_right(text, fixture->presets));
    assert_same(fixture->home, "textures/bark.png", fixture->presets, "my bark.files/bark.png");
    // Into another document, beside which another picture is called so already.
    write_picture(fixture->there, "bark.png", 7);
    document = save_in(fixture->there, BARE);
    g_assert_null(put_in(fixture, document, text));
    g_assert_nonnull(strstr(text_of(document), "picture=\"bark-2.png\""));
    assert_same(fixture->home, "textures/bark.png", fixture->there, "bark-2.png");
    // Once more: the same file and the same material are used.
    g_assert_null(put_in(fixture, document, text));
    g_assert_false(is_there(fixture->there, "bark-3.png"));
    g_assert_null(strstr(text_of(document), "bark-3"));
    // The document is whole wherever it is taken with what is beside it.
    g_assert_true(studio_presets_remove(fixture->presets, "my bark"));
    char *moved = g_build_filename(fixture->home, "moved", NULL);
    g_assert_cmpint(g_rename(fixture->there, moved), ==, 0);
    g_assert_true(is_right(text_of(document), moved));
    g_free(moved);
    g_free(text);
    studio_document_free(document);
}

static void test_mesh(Fixture *fixture, gconstpointer data) {
    (void)data;
    write_text(fixture->here, "models/rock.obj",
               "mtllib rock.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 1\nusemtl grey\nf 1 2 3\n");
    write_text(fixture->here, "models/rock.mtl",
               "newmtl grey\n  map_Kd -s 1 1 1 maps/grey.png\nmap_Ks ../secret.png\n");
    write_picture(fixture->here, "models/maps/grey.png", 90);
    write_picture(fixture->here, "secret.png", 1);
    StudioDocument *document =
        save_in(fixture->here, "<frond version=\"1\">\n  <plant id=\"p\"><pgraph>\n"
                               "    <scatter id=\"s\" number=\"3\" surface=\"mesh\" "
                               "file=\"models/rock.obj\"/>\n    <leaf id=\"l\"/>\n"
                               "    <link from=\"s\" to=\"l\"/>\n  </pgraph></plant>\n</frond>\n");
    char *why = keep(fixture, document, "s", "rock");
    g_assert_cmpstr(why, ==, NULL);
    studio_document_free(document);
    char *text = preset_text(fixture, "rock");
    g_assert_nonnull(strstr(text, "file=\"rock.files/rock/rock.obj\""));
    assert_same(fixture->here, "models/rock.mtl", fixture->presets, "rock.files/rock/rock.mtl");
    assert_same(fixture->here, "models/maps/grey.png", fixture->presets,
                "rock.files/rock/maps/grey.png");
    g_assert_false(is_there(fixture->presets, "rock.files/secret.png"));
    document = save_in(fixture->there, BARE);
    g_assert_null(put_in(fixture, document, text));
    g_assert_nonnull(strstr(text_of(document), "file=\"rock/rock.obj\""));
    g_assert_true(is_right(text_of(document), fixture->there));
    g_assert_null(put_in(fixture, document, text));
    g_assert_nonnull(strstr(text_of(document), "id=\"s2\"")); // of the same file
    g_assert_false(is_there(fixture->there, "rock-2"));
    g_free(text);
    studio_document_free(document);
}

static void test_names(Fixture *fixture, gconstpointer data) {
    (void)data;
    // Two pictures of one name, and one that is named twice.
    write_picture(fixture->here, "a/bark.png", 1);
    write_picture(fixture->here, "b/bark.png", 2);
    StudioDocument *document =
        save_in(fixture->here, "<frond version=\"1\"><material id=\"m\" picture=\"a/bark.png\" "
                               "normal-map=\"b/bark.png\" roughness-map=\"a/bark.png\"/>"
                               "<plant id=\"p\"><pgraph><horn id=\"h\" material=\"m\"/></pgraph>"
                               "</plant></frond>");
    g_assert_null(keep(fixture, document, "h", "two"));
    char *text = preset_text(fixture, "two");
    g_assert_nonnull(strstr(text, "picture=\"two.files/bark.png\""));
    g_assert_nonnull(strstr(text, "normal-map=\"two.files/bark-2.png\""));
    g_assert_nonnull(strstr(text, "roughness-map=\"two.files/bark.png\""));
    g_free(text);
    // In its place another one; then a name that leads to the same folder; then none is left.
    g_assert_null(keep(fixture, document, "h", "two"));
    g_assert_false(is_there(fixture->presets, "two.files"));
    text = preset_text(fixture, "two");
    g_assert_nonnull(strstr(text, "picture=\"two-2.files/bark.png\""));
    g_free(text);
    g_assert_true(studio_presets_rename(fixture->presets, "two", "three"));
    text = preset_text(fixture, "three");
    g_assert_true(is_right(text, fixture->presets));
    g_free(text);
    g_assert_null(keep(fixture, document, "h", "two"));
    g_assert_true(studio_presets_remove(fixture->presets, "two"));
    text = preset_text(fixture, "three");
    g_assert_true(is_right(text, fixture->presets));
    g_assert_true(studio_presets_remove(fixture->presets, "three"));
    g_assert_cmpint(g_rmdir(fixture->presets), ==, 0); // nothing is in it
    g_free(folder_within(fixture->home, "presets"));
    g_free(text);
    studio_document_free(document);
}

static void test_missing(Fixture *fixture, gconstpointer data) {
    (void)data;
    StudioDocument *document = save_in(fixture->here, DRESSED("bark.png"));
    char *why = keep(fixture, document, "h", "x");
    g_assert_nonnull(strstr(why, "bark.png"));
    g_free(why);
    studio_document_free(document);
    // What cannot be read to its end, or is none, is not waited for.
    char *pipe = g_build_filename(fixture->here, "pipe.png", NULL);
    g_assert_cmpint(mkfifo(pipe, 0666), ==, 0);
    write_picture(fixture->here, "good.png", 3);
    static const struct {
        const char *name, *why;
    } cases[] = {{"pipe.png", "The file pipe.png is not a file"},
                 {".", "The file . is not a file"},
                 {"/dev/zero", "The file /dev/zero is not a file"},
                 {"good.png/x", "The file good.png/x is not there"},
                 {"none.png", "The file none.png is not there"}};
    for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
        char *text = g_strdup_printf("<frond version=\"1\"><material id=\"a\" "
                                     "picture=\"good.png\"/><material id=\"m\" "
                                     "picture=\"%s\"/></frond>",
                                     cases[i].name);
        FrContents *contents = read_contents(text);
        StudioCarried carried = studio_carry(
            contents, &(StudioCarry){.from = fixture->here, .to = fixture->there, .prefix = "x/"});
        g_assert_null(carried.source);
        g_assert_cmpstr(carried.refusal, ==, cases[i].why);
        g_assert_false(is_there(fixture->there, "good.png")); // nothing is left of it
        studio_carried_clear(&carried);
        fr_contents_free(contents);
        g_free(text);
    }
    g_free(pipe);
}

static void test_large(Fixture *fixture, gconstpointer data) {
    (void)data;
    char *path = g_build_filename(fixture->here, "large.png", NULL);
    write_text(fixture->here, "large.png", "");
    g_assert_cmpint(truncate(path, 65 << 20), ==, 0); // takes no room
    StudioDocument *document = save_in(fixture->here, DRESSED("large.png"));
    FrContents *contents = read_contents(text_of(document));
    StudioCarried carried = studio_carry(
        contents, &(StudioCarry){.from = fixture->here, .to = fixture->there, .prefix = ""});
    g_assert_cmpstr(carried.refusal, ==, "The file large.png is too large");
    studio_carried_clear(&carried);
    fr_contents_free(contents);
    studio_document_free(document);
    GString *many = g_string_new("<frond version=\"1\">");
    for (int i = 0; i < 250; i++) {
        char *name = g_strdup_printf("%d.png", i);
        write_text(fixture->here, name, "x");
        g_string_append_printf(many, "<material id=\"m%d\" picture=\"%s\"/>", i, name);
        g_free(name);
    }
    g_string_append(many, "</frond>");
    contents = read_contents(many->str);
    carried = studio_carry(
        contents, &(StudioCarry){.from = fixture->here, .to = fixture->there, .prefix = ""});
    g_assert_cmpstr(carried.refusal, ==, "The file 200.png is one of too many");
    studio_carried_clear(&carried);
    fr_contents_free(contents);
    g_string_free(many, TRUE);
    char *rest = g_build_filename(fixture->there, NULL);
    g_assert_cmpint(g_rmdir(rest), ==, 0);
    g_free(folder_within(fixture->home, "there"));
    g_free(rest);
    g_free(path);
}

// A preset of someone else's brings nothing but what is in its own folder.
static void test_hostile(Fixture *fixture, gconstpointer data) {
    (void)data;
    write_picture(fixture->home, "secret.png", 200);
    write_picture(fixture->presets, "x.files/own.png", 100);
    char *secret = g_build_filename(fixture->home, "secret.png", NULL);
    char *link = g_build_filename(fixture->presets, "x.files", "link.png", NULL);
    char *way = g_build_filename(fixture->presets, "way", NULL);
    g_assert_cmpint(symlink(secret, link), ==, 0);
    g_assert_cmpint(symlink(fixture->home, way), ==, 0);
    StudioDocument *document = save_in(fixture->there, BARE);
    const char *const names[] = {"../secret.png",  "x.files/../../secret.png",
                                 secret,           "x.files/link.png",
                                 "way/secret.png", "x.files//../../secret.png"};
    for (size_t i = 0; i < G_N_ELEMENTS(names); i++) {
        char *text = g_strdup_printf("<frond version=\"1\"><material id=\"m\" picture=\"%s\"/>"
                                     "<plant id=\"p\"><pgraph><horn id=\"h\" material=\"m\"/>"
                                     "</pgraph></plant></frond>",
                                     names[i]);
        char *why = put_in(fixture, document, text);
        g_assert_nonnull(why);
        g_assert_nonnull(strstr(why, i == 4 ? "is not there" : "does not lie in its folder"));
        g_free(why);
        g_free(text);
    }
    g_assert_cmpstr(text_of(document), ==, BARE);
    // A link where the copy would go is not followed, and stays.
    char *trap = g_build_filename(fixture->there, "own.png", NULL);
    g_assert_cmpint(symlink(secret, trap), ==, 0);
    g_assert_null(put_in(fixture, document, DRESSED("x.files/own.png")));
    g_assert_true(g_file_test(trap, G_FILE_TEST_IS_SYMLINK));
    g_assert_nonnull(strstr(text_of(document), "picture=\"own-2.png\""));
    // Removing it removes no more than a folder of presets.
    write_text(fixture->presets, "bad.frond", DRESSED("../here/own.png"));
    write_text(fixture->presets, "worse.frond", DRESSED("way/x.png"));
    write_text(fixture->here, "own.png", "kept");
    g_assert_true(studio_presets_remove(fixture->presets, "bad"));
    g_assert_true(studio_presets_remove(fixture->presets, "worse"));
    g_assert_true(is_there(fixture->here, "own.png"));
    g_assert_true(is_there(fixture->home, "secret.png"));
    g_free(trap);
    g_free(way);
    g_free(link);
    g_free(secret);
    studio_document_free(document);
}

static void test_unsaved(Fixture *fixture, gconstpointer data) {
    (void)data;
    write_picture(fixture->presets, "x.files/own.png", 100);
    StudioDocument *document = studio_document_new(BARE, strlen(BARE), "new", NULL);
    char *why = put_in(fixture, document, DRESSED("x.files/own.png"));
    g_assert_true(g_str_has_prefix(why, "Save the document first"));
    g_free(why);
    g_assert_null(put_in(fixture, document, BARE)); // without files it goes
    studio_document_free(document);
}

static void test_adopt(Fixture *fixture, gconstpointer data) {
    (void)data;
    write_picture(fixture->presets, "x.files/own.png", 100);
    write_picture(fixture->presets, "x.files/hill.png", 50);
    FrContents *theirs = read_contents(
        "<frond version=\"1\"><material id=\"m\" picture=\"x.files/own.png\"/><plant id=\"p\">"
        "<pgraph><horn id=\"h\" material=\"m\"/></pgraph></plant><scene>"
        "<terrain file=\"x.files/hill.png\"/></scene></frond>");
    StudioDocument *document = save_in(fixture->there, BARE);
    GHashTable *wanted = studio_adopt_elements(theirs);
    StudioCarried carried = studio_bring(document, theirs, fixture->presets, wanted);
    char *id;
    g_assert_true(studio_adopt(document, carried.source, NULL, NULL, &id));
    g_assert_cmpstr(id, ==, "p");
    g_assert_true(is_right(text_of(document), fixture->there));
    g_assert_true(is_there(fixture->there, "own.png"));
    g_assert_false(is_there(fixture->there, "hill.png")); // the scene stays behind
    g_free(id);
    studio_carried_clear(&carried);
    g_hash_table_unref(wanted);
    fr_contents_free(theirs);
    studio_document_free(document);
}

static void test_save_as(Fixture *fixture, gconstpointer data) {
    (void)data;
    // A preset becomes a document elsewhere.
    write_picture(fixture->presets, "x.files/own.png", 100);
    StudioDocument *document = studio_document_new(
        DRESSED("x.files/own.png"), strlen(DRESSED("x.files/own.png")), "x", fixture->presets);
    char *path = g_build_filename(fixture->there, "plant.frond", NULL);
    FrDiags *diags = fr_diags_new();
    g_assert_cmpint(studio_document_save(document, path, diags), ==, FR_OK);
    g_assert_cmpuint(fr_diags_count(diags), ==, 0);
    g_assert_cmpstr(text_of(document), ==, DRESSED("x.files/own.png"));
    g_assert_true(is_right(text_of(document), fixture->there));
    assert_same(fixture->presets, "x.files/own.png", fixture->there, "x.files/own.png");
    g_free(path);
    // What is called so there is not written over, and a save that fails leaves nothing.
    write_picture(fixture->here, "x.files/own.png", 1);
    path = g_build_filename(fixture->here, "plant.frond", NULL);
    g_assert_cmpint(studio_document_save(document, path, diags), ==, FR_OK);
    g_assert_cmpuint(fr_diags_count(diags), ==, 1);
    g_assert_cmpstr(fr_diags_get(diags, 0)->code, ==, "file-left");
    g_free(path);
    char *folder = folder_within(fixture->home, "full/plant.frond"), *full;
    full = g_path_get_dirname(folder);
    g_assert_cmpint(studio_document_save(document, folder, diags), !=, FR_OK);
    g_assert_false(is_there(full, "x.files"));
    g_free(full);
    g_free(folder);
    fr_diags_free(diags);
    studio_document_free(document);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    ADD("/studio/carry/a picture goes to the presets and on to another document",
        test_there_and_back);
    ADD("/studio/carry/a mesh brings what it names, and nothing from elsewhere", test_mesh);
    ADD("/studio/carry/files of one name stay apart, and go with their preset", test_names);
    ADD("/studio/carry/what is missing or no file is told and nothing copied", test_missing);
    ADD("/studio/carry/large files and too many are refused", test_large);
    ADD("/studio/carry/a preset brings nothing from outside its folder", test_hostile);
    ADD("/studio/carry/a document without a file has no place for files", test_unsaved);
    ADD("/studio/carry/a plant that is planted brings its own files", test_adopt);
    ADD("/studio/carry/what is saved elsewhere has its files there", test_save_as);
    return g_test_run();
}
