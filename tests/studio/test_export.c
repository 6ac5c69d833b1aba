/// What is written is what stands: all of it or one plant, whatever was changed between its steps.
#include "building.h"
#include "frond/simulation.h"
#include "studio/model/profile.h"

#define GROVE                                                                                      \
    "<frond version='1'><plant id='tree' seed='3'><species/></plant><scene><growth steps='6'/>"    \
    "<place plant='tree'/><row plants='tree' spacing='2'>2,0,0 6,0,0</row></scene></frond>"

static StudioDocument *new_document(const char *text) {
    return studio_document_new(text, strlen(text), "grove.frond", "");
}

static char *new_folder(void) {
    char *folder = g_dir_make_tmp("studio-XXXXXX", NULL);
    g_assert_nonnull(folder);
    return folder;
}

// Removes a folder with what was written; returns how many files that were.
static guint drop_folder(char *folder) {
    guint files = remove_tree(folder);
    g_free(folder);
    return files;
}

// A copy as it would be written, and whether it is as old as said.
static FrScene *take(StudioCopy *copy, bool is_behind) {
    FrContext context = fr_context_default();
    FrScene *scene;
    bool was_behind;
    g_assert_cmpint(studio_copy_take(copy, &context, &scene, &was_behind), ==, FR_OK);
    g_assert_true(was_behind == is_behind);
    studio_copy_free(copy);
    return scene;
}

static void fails(StudioCopy *copy, FrStatus status, const char *code) {
    FrContext context = fr_context_default();
    context.diags = fr_diags_new();
    FrScene *scene;
    bool is_behind;
    g_assert_cmpint(studio_copy_take(copy, &context, &scene, &is_behind), ==, status);
    g_assert_null(scene);
    g_assert_cmpuint(fr_diags_count(context.diags), ==, code == NULL ? 0 : 1);
    if (code != NULL) {
        g_assert_cmpstr(fr_diags_get(context.diags, 0)->code, ==, code);
    }
    fr_diags_free(context.diags);
    studio_copy_free(copy);
}

static const StudioWhich all = {0};

// Three steps, another gravity and a wall, three more steps. What stands then is collected.
static const StudioBuilt *grow_changed(Fixture *fixture, StudioDocument *document) {
    request_step(fixture, document, 3);
    g_assert_cmpint(await(fixture)->status, ==, FR_OK);
    studio_builder_release(fixture->builder);
    char *text = g_strdup(text_of(document));
    GString *changed = g_string_new(text);
    g_string_replace(changed, "<species/>", "<species><sliders gravity='-0.8'/></species>", 0);
    g_string_replace(changed, "</scene>", "<obstacle at='0.4,0,0' size='0.1,2,3'/></scene>", 0);
    g_assert_true(studio_document_replace(document, changed->str, changed->len, "Change", NULL));
    g_string_free(changed, TRUE);
    g_free(text);
    request_step(fixture, document, 6);
    const StudioBuilt *built = await(fixture);
    g_assert_cmpint(built->status, ==, FR_OK);
    g_assert_cmpuint(built->step, ==, 6);
    return built;
}

static FrDigest grown_anew(const StudioDocument *document) {
    FrContext context = fr_context_default();
    FrDocument *parsed;
    FrScene *scene;
    g_assert_cmpint(fr_document_parse(studio_document_source(document), "", &context, &parsed), ==,
                    FR_OK);
    g_assert_cmpint(fr_scene_build(parsed, -1, &context, &scene), ==, FR_OK);
    FrDigest digest = fr_scene_digest(scene);
    fr_scene_free(scene);
    fr_document_free(parsed);
    return digest;
}

// The bytes of a model.
static char *contents_of(const char *path, gsize *size) {
    char *bytes;
    g_assert_true(g_file_get_contents(path, &bytes, size, NULL));
    g_unlink(path);
    return bytes;
}

static void test_as_it_stands(Fixture *fixture, gconstpointer data) {
    (void)data;
    StudioDocument *document = new_document(GROVE);
    const StudioBuilt *built = grow_changed(fixture, document);
    const FrScene *shown = built->view->scene;
    FrDigest seen = fr_scene_digest(shown);
    g_assert_cmphex(seen, !=, grown_anew(document));
    // The model has the vertices of what is shown, each of them.
    char *folder = new_folder(), *path = g_build_filename(folder, "model.glb", NULL);
    FrContext context = fr_context_default();
    StudioCopy *copy = studio_builder_copy(fixture->builder, &all);
    const StudioExport how = {FR_LEAVES_MERGED, 0};
    StudioExported exported = studio_export(copy, path, &how, &context);
    studio_copy_free(copy);
    g_assert_cmpint(exported.status, ==, FR_OK);
    g_assert_false(exported.is_behind);
    gsize size, expected_size;
    char *written = contents_of(path, &size);
    FrIoOptions options = fr_io_options_default();
    FrIoStats stats;
    g_assert_cmpint(fr_io_write(shown, path, &options, &context, &stats), ==, FR_OK);
    char *expected = contents_of(path, &expected_size);
    g_assert_cmpuint(exported.stats.vertices, ==, stats.vertices);
    g_assert_cmpuint(size, ==, expected_size);
    g_assert_true(memcmp(written, expected, size) == 0);
    // It is a copy: what goes on growing leaves it as it was.
    copy = studio_builder_copy(fixture->builder, &all);
    FrScene *kept = take(copy, false);
    studio_builder_release(fixture->builder);
    request_step(fixture, document, 8);
    g_assert_cmphex(fr_scene_digest(await(fixture)->view->scene), !=, seen);
    g_assert_cmphex(fr_scene_digest(kept), ==, seen);
    studio_builder_release(fixture->builder);
    fr_scene_free(kept);
    g_free(written);
    g_free(expected);
    g_free(path);
    g_assert_cmpuint(drop_folder(folder), ==, 0);
    studio_document_free(document);
}

static void test_one(Fixture *fixture, gconstpointer data) {
    (void)data;
    StudioDocument *document = new_document(GROVE);
    const FrScene *shown = grow_changed(fixture, document)->view->scene;
    for (guint i = 0; i < fr_scene_stand_count(shown); i++) {
        const FrStand *stand = &g_array_index(shown->stands, FrStand, i);
        StudioWhich one = {true, stand->origin, stand->number, i % 2 == 0};
        FrScene *lone = take(studio_builder_copy(fixture->builder, &one), false);
        g_assert_cmpuint(lone->plants->len, ==, 1);
        const FrPlant *seen = g_array_index(shown->plants, FrScenePlant, stand->plant).plant;
        g_assert_cmphex(fr_plant_digest(g_array_index(lone->plants, FrScenePlant, 0).plant), ==,
                        fr_plant_digest(seen));
        const double *at = g_array_index(lone->stands, FrStand, 0).at;
        g_assert_cmpfloat(at[0], ==, i % 2 == 0 ? stand->at[0] : 0);
        fr_scene_free(lone);
    }
    StudioWhich none = {true, 5, 0, false};
    fails(studio_builder_copy(fixture->builder, &none), FR_ERR_DOCUMENT, "unknown-stand");
    studio_builder_release(fixture->builder);
    studio_document_free(document);
}

static void test_awaited(Fixture *fixture, gconstpointer data) {
    (void)data;
    StudioDocument *document = open_example("examples/figure2.frond");
    request(fixture, document, NAN);
    FrScene *scene = take(studio_builder_copy(fixture->builder, &all), false);
    const StudioBuilt *built = await(fixture);
    g_assert_cmphex(fr_scene_digest(scene), ==, fr_scene_digest(built->view->scene));
    studio_builder_release(fixture->builder);
    fr_scene_free(scene);
    studio_document_free(document);
}

static void test_mistake(Fixture *fixture, gconstpointer data) {
    (void)data;
    StudioDocument *document = new_document("<frond version='1'><oops/></frond>");
    request(fixture, document, NAN);
    await(fixture);
    fails(studio_builder_copy(fixture->builder, &all), FR_ERR_DOCUMENT, "nothing-stands");
    studio_builder_release(fixture->builder);
    studio_document_free(document);
    document = open_example("examples/figure2.frond");
    request(fixture, document, NAN);
    const FrScene *shown = await(fixture)->view->scene;
    FrDigest good = fr_scene_digest(shown);
    studio_builder_release(fixture->builder);
    studio_set(document, element_of(document, "B"), "length", "2 +", false);
    request(fixture, document, NAN);
    await(fixture);
    FrScene *scene = take(studio_builder_copy(fixture->builder, &all), true);
    g_assert_cmphex(fr_scene_digest(scene), ==, good);
    studio_builder_release(fixture->builder);
    fr_scene_free(scene);
    studio_document_free(document);
}

static void cancel_later(void *user, const char *stage, double fraction) {
    (void)fraction;
    FrProgress **progress = user;
    if (strcmp(stage, "build") != 0) {
        fr_progress_cancel(*progress);
    }
}

static void test_cancel(Fixture *fixture, gconstpointer data) {
    (void)data;
    StudioDocument *document = open_example("examples/figure2.frond");
    request(fixture, document, NAN);
    await(fixture);
    char *folder = new_folder(), *path = g_build_filename(folder, "model.glb", NULL);
    FrContext context = fr_context_default();
    const StudioExport how = {FR_LEAVES_MERGED, 0};
    for (int early = 0; early < 2; early++) {
        context.progress = fr_progress_new(cancel_later, &context.progress);
        if (early == 1) {
            fr_progress_cancel(context.progress);
        }
        StudioCopy *copy = studio_builder_copy(fixture->builder, &all);
        StudioExported exported = studio_export(copy, path, &how, &context);
        g_assert_cmpint(exported.status, ==, FR_CANCELLED);
        studio_copy_free(copy);
        fr_progress_free(context.progress);
    }
    g_free(path);
    g_assert_cmpuint(drop_folder(folder), ==, 0);
    studio_builder_release(fixture->builder);
    studio_document_free(document);
}

static void test_gone(Fixture *fixture, gconstpointer data) {
    (void)data;
    StudioDocument *document = open_example("examples/figure2.frond");
    request(fixture, document, NAN);
    await(fixture);
    request(fixture, document, 1); // waits until the first has been looked at
    StudioCopy *copy = studio_builder_copy(fixture->builder, &all);
    studio_builder_forget(fixture->builder);
    fails(copy, FR_CANCELLED, NULL);
    request(fixture, document, 2);
    copy = studio_builder_copy(fixture->builder, &all);
    studio_builder_free(fixture->builder);
    fails(copy, FR_CANCELLED, NULL);
    fixture->builder = NULL;
    studio_document_free(document);
}

static void test_profiles(Fixture *fixture, gconstpointer data) {
    (void)data;
    StudioDocument *document = open_example("examples/figure2.frond");
    request(fixture, document, NAN);
    char *folder = new_folder();
    size_t count;
    const StudioProfile *profiles = studio_profiles(&count);
    for (size_t i = 0; i < count; i++) {
        char *name = g_strdup_printf("model-%zu%s", i, profiles[i].extension);
        char *path = g_build_filename(folder, name, NULL);
        FrContext context = fr_context_default();
        const StudioExport how = {profiles[i].leaves, profiles[i].lod};
        StudioCopy *copy = studio_builder_copy(fixture->builder, &all);
        StudioExported exported = studio_export(copy, path, &how, &context);
        g_assert_cmpint(exported.status, ==, FR_OK);
        g_assert_cmpuint(exported.stats.bytes, >, 100);
        studio_copy_free(copy);
        g_free(path);
        g_free(name);
    }
    g_assert_cmpuint(drop_folder(folder), >=, count);
    studio_document_free(document);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    ADD("/studio/export/a model has what is shown, not what would grow anew", test_as_it_stands);
    ADD("/studio/export/one plant is as it is shown among the others", test_one);
    ADD("/studio/export/what was asked for before is built first", test_awaited);
    ADD("/studio/export/after a mistake the last plants are written, and that is told",
        test_mistake);
    ADD("/studio/export/who cancels finds nothing written", test_cancel);
    ADD("/studio/export/a document that goes takes what was not written with it", test_gone);
    ADD("/studio/export/every profile writes a model", test_profiles);
    return g_test_run();
}
