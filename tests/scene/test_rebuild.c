// Builds that take over what a change did not reach, against whole builds.
#include "edits.h"

static void assert_same_plant(const FrPlant *plant, const FrPlant *fresh, const char *what) {
    bool is_same = fr_plant_digest(plant) == fr_plant_digest(fresh) &&
                   plant->materials->len == fresh->materials->len &&
                   plant->components->len == fresh->components->len;
    for (uint32_t i = 0; i < fresh->nodes.count && is_same; i++) {
        is_same =
            memcmp(&plant->nodes.position[i], &fresh->nodes.position[i], sizeof(vec3s)) == 0 &&
            memcmp(&plant->nodes.frame[i], &fresh->nodes.frame[i], sizeof(versors)) == 0;
    }
    for (guint i = 0; i < fresh->materials->len && is_same; i++) {
        is_same = g_ptr_array_index(plant->materials, i) == g_ptr_array_index(fresh->materials, i);
    }
    for (guint i = 0; i < fresh->components->len && is_same; i++) {
        is_same = strcmp(g_array_index(plant->components, FrComponent, i).id,
                         g_array_index(fresh->components, FrComponent, i).id) == 0;
    }
    if (!is_same) {
        g_error("%s: the plant differs from a whole build", what);
    }
}

/// A skin that follows the builds of a session, and the build that it shows.
typedef struct Shown {
    FrSkin *skin;
    FrPgraphBuild *build;
} Shown;

static Shown shown_new(void) {
    FrSkinParams params = fr_skin_default();
    return (Shown){fr_skin_new(&params, FR_UP_Y), NULL};
}

static void shown_free(Shown *shown) {
    fr_skin_free(shown->skin);
    fr_pgraph_build_free(shown->build);
}

/// Shows a build, which it takes, and compares with a whole skin.
static void show(Shown *shown, FrPgraphBuild *build, const char *what) {
    FrContext context = fr_context_default();
    FrSkinParams params = fr_skin_default();
    const FrPlant *plant = fr_pgraph_build_plant(build);
    FrMesh *fresh;
    bool has_same_rows = shown->build != NULL && fr_pgraph_build_shares(build, shown->build);
    FrStatus status = fr_skin_update(shown->skin, plant, has_same_rows, &context);
    g_assert_cmpint(status, ==, FR_OK);
    g_assert_cmpint(fr_skin_plant(plant, &params, FR_UP_Y, &context, &fresh), ==, FR_OK);
    FrMesh *mesh = fr_skin_mesh(shown->skin);
    if (fr_mesh_digest(mesh) != fr_mesh_digest(fresh)) {
        g_error("%s: the mesh differs from a whole skin", what);
    }
    fr_mesh_free(mesh);
    fr_mesh_free(fresh);
    fr_pgraph_build_free(shown->build);
    shown->build = build;
}

static char *messages(const FrDiags *diags) {
    return printed(diags);
}

/// Rebuilds from `last` and compares with a whole build; NULL where both fail.
static FrPgraphBuild *rebuild(const FrPgraph *graph, const FrPgraphBuild *last, const char *what) {
    FrContext context = fr_context_default();
    FrDiags *said = fr_diags_new(), *said_fresh = fr_diags_new();
    FrPgraphBuild *build;
    FrPlant *fresh;
    FrPgraphCounts counts = {0};
    context.limits.instances = 60000;
    context.diags = said;
    FrStatus status = fr_pgraph_rebuild(graph, last, &context, &build);
    context.diags = said_fresh;
    FrStatus fresh_status = fr_pgraph_build(graph, &context, &fresh, &counts);
    char *text = messages(said), *fresh_text = messages(said_fresh);
    if (status != fresh_status || strcmp(text, fresh_text) != 0) {
        g_error("%s: %s\nbut a whole build: %s", what, text, fresh_text);
    }
    if (status == FR_OK) {
        assert_same_plant(fr_pgraph_build_plant(build), fresh, what);
        g_assert_cmpuint(fr_pgraph_build_counts(build)->instances, ==, counts.instances);
    }
    fr_plant_free(fresh);
    fr_pgraph_counts_clear(&counts);
    g_free(text);
    g_free(fresh_text);
    fr_diags_free(said);
    fr_diags_free(said_fresh);
    return build;
}

// Under sanitizers, which look for other faults than differing bits, every fourth parameter; of
// each document others.
static bool is_tried(const char *path, uint32_t component, size_t row) {
    return g_getenv("FROND_SANITIZED") == NULL || (g_str_hash(path) + component + row) % 4 == 0;
}

static void change_each_parameter(const char *path) {
    Shipped shipped = shipped_load(path);
    if (shipped.plant == NULL) {
        fr_document_free(shipped.document);
        return;
    }
    FrPgraph *graph = small_graph(&shipped);
    FrPgraphBuild *last = rebuild(graph, NULL, path);
    g_assert_nonnull(last);
    Shown shown = shown_new();
    for (uint32_t c = 0; c < fr_pgraph_count(graph); c++) {
        for (size_t row = 0; row < rows_of(graph, c); row++) {
            if (!is_tried(path, c, row)) {
                continue;
            }
            void *before = aside(graph, c);
            nudge(graph, c, row);
            char *what = g_strdup_printf("%s, %s.%s", path, fr_pgraph_id(graph, c),
                                         fr_pgraph_table(fr_pgraph_kind(graph, c))->rows[row].name);
            FrPgraphBuild *build = rebuild(graph, last, what);
            if (build != NULL) {
                show(&shown, build, what);
            }
            put_back(graph, c, before);
            g_free(what);
        }
    }
    shown_free(&shown);
    fr_pgraph_build_free(last);
    fr_pgraph_free(graph);
    fr_document_free(shipped.document);
}

static void change_all_in(const char *folder) {
    GPtrArray *paths = documents_in(folder);
    g_assert_cmpuint(paths->len, >, 5);
    for (guint i = 0; i < paths->len; i++) {
        change_each_parameter(g_ptr_array_index(paths, i));
    }
    g_ptr_array_unref(paths);
}

static void test_every_parameter_of_examples(void) {
    change_all_in("examples");
}

static void test_every_parameter_of_presets(void) {
    change_all_in("data/presets");
}

/// A long session of edits, each of which may be taken back by the next.
static void edit_at_random(const char *path, FrKey key) {
    Shipped shipped = shipped_load(path);
    FrPgraph *graph = shipped.plant != NULL ? small_graph(&shipped) : NULL;
    Shown shown = shown_new();
    for (uint32_t edit = 0; edit < 12 && graph != NULL; edit++) {
        uint32_t c = (uint32_t)(fr_random(key, edit, 0) * fr_pgraph_count(graph));
        size_t row = (size_t)(fr_random(key, edit, 1) * (double)rows_of(graph, c));
        void *before = aside(graph, c);
        nudge(graph, c, row);
        FrPgraphBuild *build = rebuild(graph, shown.build, path);
        if (build != NULL) {
            show(&shown, build, path);
        }
        if (build == NULL || edit % 3 == 2) {
            put_back(graph, c, before);
            show(&shown, rebuild(graph, shown.build, path), path);
        } else {
            fr_params_clear(fr_pgraph_table(fr_pgraph_kind(graph, c)), before);
            g_free(before);
        }
    }
    shown_free(&shown);
    fr_pgraph_free(graph);
    fr_document_free(shipped.document);
}

static void test_sessions(void) {
    GPtrArray *paths = documents_in("data/presets");
    for (guint i = 0; i < paths->len; i++) {
        edit_at_random(g_ptr_array_index(paths, i), fr_key_root(i));
    }
    g_ptr_array_unref(paths);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func(
        "/scene/rebuild/any parameter of an example changed gives what a whole build does",
        test_every_parameter_of_examples);
    g_test_add_func(
        "/scene/rebuild/any parameter of a preset changed gives what a whole build does",
        test_every_parameter_of_presets);
    g_test_add_func("/scene/rebuild/edits and undone edits in a row give what whole builds do",
                    test_sessions);
    return g_test_run();
}
