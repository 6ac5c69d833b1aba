// IGES, STEP and free-form OBJ: the rules of their texts, and what they hold.
#include "scenes.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/// A stem with leaves that stands twice, once turned, moved and doubled.
static FrScene *garden(void) {
    FrScene *scene = scene_new();
    FrPlant *oak = plant_with_leaves("it's an oak", 5, FR_TEXTURE_NONE, FR_TEXTURE_NONE);
    uint32_t plant = scene_add(scene, oak);
    scene_stand(scene, plant, 0, 0, 0, 1);
    scene_stand(scene, plant, 100, 0, G_PI / 2, 2);
    return scene;
}

static size_t count_of(const char *text, const char *word) {
    size_t count = 0;
    for (const char *at = strstr(text, word); at != NULL; at = strstr(at + 1, word)) {
        count++;
    }
    return count;
}

static void iges(void) {
    char *folder = folder_new();
    FrScene *scene = garden();
    FrIoStats stats = write_scene(scene, folder, "oak.igs", FR_LEAVES_MERGED);
    g_assert_cmpuint(stats.surfaces, >, 10);
    g_assert_cmpuint(stats.triangles, ==, 0);
    size_t size;
    char *text = file_bytes(folder, "oak.igs", &size);
    g_assert_cmpuint(size, ==, stats.bytes);
    g_assert_cmpuint(size % 81, ==, 0);
    unsigned long counted[5] = {0};
    size_t surfaces = 0, section = 0;
    for (size_t at = 0; at < size; at += 81) {
        static const char order[] = "SGDPT";
        const char *found = strchr(order, text[at + 72]);
        g_assert_nonnull(found);
        g_assert_cmpuint((size_t)(found - order), >=, section);
        section = (size_t)(found - order);
        counted[section]++;
        g_assert_cmpuint(strtoul(text + at + 73, NULL, 10), ==, counted[section]);
        g_assert_cmpint(text[at + 80], ==, '\n');
        surfaces += section == 2 && strncmp(text + at, "     128", 8) == 0;
    }
    g_assert_cmpuint(surfaces, ==, 2 * stats.surfaces); // two lines each
    g_assert_cmpuint(counted[4], ==, 1);
    char wanted[64];
    g_snprintf(wanted, sizeof wanted, "S%7luG%7luD%7luP%7lu", counted[0], counted[1], counted[2],
               counted[3]);
    g_assert_cmpint(strncmp(text + size - 81, wanted, 32), ==, 0);
    g_free(text);
    fr_scene_free(scene);
    remove_folder(folder);
}

/// Writes a .stp; answers its text.
static char *step_text(const FrScene *scene, const char *folder, int protocol, int share,
                       FrIoStats *stats, size_t *size) {
    FrContext context = fr_context_default();
    FrIoOptions options = fr_io_options_default();
    options.nurbs.step = protocol;
    options.nurbs.share = share;
    char *path = g_build_filename(folder, "oak.stp", NULL);
    g_assert_cmpint(fr_io_write(scene, path, &options, &context, stats), ==, FR_OK);
    g_free(path);
    return file_bytes(folder, "oak.stp", size);
}

static void shared_step(void) {
    char *folder = folder_new();
    FrScene *scene = garden();
    FrIoStats whole, shared;
    size_t size, smaller;
    char *text = step_text(scene, folder, FR_STEP_AP214, FR_SHARE_NO, &whole, &size);
    g_assert_cmpuint(count_of(text, "=MAPPED_ITEM("), ==, 0);
    g_free(text);
    text = step_text(scene, folder, FR_STEP_AP214, FR_SHARE_EQUAL, &shared, &smaller);
    g_assert_cmpuint(shared.surfaces, ==, whole.surfaces);
    g_assert_cmpuint(smaller, <, size);
    // Two of the five leaves are of one size, and each stand has a size of its own.
    g_assert_cmpuint(count_of(text, "=MAPPED_ITEM("), ==, 2 * 2);
    g_assert_cmpuint(count_of(text, "=REPRESENTATION_MAP("), ==, 2);
    size_t faces = count_of(text, "=ADVANCED_FACE("), leaf = (whole.surfaces - faces) / 2;
    g_assert_cmpuint(leaf, >=, 2);
    g_assert_cmpuint(faces + 2 * leaf, ==, whole.surfaces);
    g_free(text);
    fr_scene_free(scene);
    remove_folder(folder);
}

/// What ISO 10303-203 wants of every product besides.
static void managed_step(void) {
    char *folder = folder_new();
    FrScene *scene = garden();
    FrIoStats stats;
    char *text = step_text(scene, folder, FR_STEP_AP203, FR_SHARE_EQUAL, &stats, NULL);
    g_assert_nonnull(strstr(text, "FILE_SCHEMA(('CONFIG_CONTROL_DESIGN'));"));
    static const char *const wanted[] = {"=PRODUCT_DEFINITION_FORMATION_WITH_SPECIFIED_SOURCE(",
                                         "=CC_DESIGN_APPROVAL(",
                                         "=CC_DESIGN_SECURITY_CLASSIFICATION("};
    for (size_t i = 0; i < G_N_ELEMENTS(wanted); i++) {
        g_assert_cmpuint(count_of(text, wanted[i]), ==, 2);
    }
    g_assert_cmpuint(count_of(text, "=CC_DESIGN_PERSON_AND_ORGANIZATION_ASSIGNMENT("), ==, 7);
    g_assert_cmpuint(count_of(text, "=PRODUCT_CONTEXT("), ==, 0);
    g_free(text);
    fr_scene_free(scene);
    remove_folder(folder);
}

static void step(void) {
    char *folder = folder_new();
    FrScene *scene = garden();
    FrIoStats stats;
    size_t size;
    char *text = step_text(scene, folder, FR_STEP_AP214, FR_SHARE_NO, &stats, &size);
    g_assert_cmpuint(size, ==, stats.bytes);
    g_assert_true(g_str_has_prefix(text, "ISO-10303-21;"));
    g_assert_true(g_str_has_suffix(text, "END-ISO-10303-21;\n"));
    g_assert_cmpuint(count_of(text, "=ADVANCED_FACE("), ==, stats.surfaces);
    g_assert_cmpuint(count_of(text, "=PRODUCT("), ==, 2);
    g_assert_cmpuint(count_of(text, "PRODUCT('it''s an oak'"), ==, 2);
    // Entities are numbered in order and name only those before them.
    char **lines = g_strsplit(text, "\n", -1);
    unsigned long last = 0;
    for (char **line = lines; *line != NULL; line++) {
        if ((*line)[0] != '#') {
            continue;
        }
        char *rest;
        unsigned long own = strtoul(*line + 1, &rest, 10);
        g_assert_cmpuint(own, ==, last + 1);
        for (char *at = strchr(rest, '#'); at != NULL; at = strchr(at + 1, '#')) {
            g_assert_cmpuint(strtoul(at + 1, NULL, 10), <, own);
        }
        last = own;
    }
    g_strfreev(lines);
    g_free(text);
    fr_scene_free(scene);
    remove_folder(folder);
}

static void free_form(void) {
    char *folder = folder_new();
    FrScene *scene = garden();
    FrIoStats stats = write_scene(scene, folder, "oak.nurbs.obj", FR_LEAVES_MERGED);
    char *text = file_bytes(folder, "oak.nurbs.obj", NULL);
    g_assert_cmpuint(count_of(text, "\nsurf "), ==, stats.surfaces);
    g_assert_cmpuint(count_of(text, "cstype rat bspline\n"), ==, stats.surfaces);
    g_assert_cmpuint(count_of(text, "\nend\n"), ==, stats.surfaces);
    g_assert_cmpuint(count_of(text, "\nf "), ==, 0);
    // Every surface has as many points as its knots and degrees say.
    char **lines = g_strsplit(text, "\n", -1);
    size_t points = 0, controls = 0, knots[2] = {0};
    unsigned long degree[2] = {0};
    for (char **line = lines; *line != NULL; line++) {
        points += g_str_has_prefix(*line, "v ") ? 1 : 0;
        if (g_str_has_prefix(*line, "deg ")) {
            g_assert_cmpint(sscanf(*line, "deg %lu %lu", &degree[0], &degree[1]), ==, 2);
        } else if (g_str_has_prefix(*line, "surf ")) {
            controls = count_of(*line, " -");
        } else if (g_str_has_prefix(*line, "parm ")) {
            knots[(*line)[5] == 'v'] = count_of(*line, " ") - 1;
        } else if (strcmp(*line, "end") == 0) {
            g_assert_cmpuint(points, ==, (knots[0] - degree[0] - 1) * (knots[1] - degree[1] - 1));
            g_assert_cmpuint(controls, >=, points);
            points = 0;
        }
    }
    g_strfreev(lines);
    g_free(text);
    fr_scene_free(scene);
    remove_folder(folder);
}

static void assert_same_points(const FrNurbsSurface *own, const FrNurbsSurface *read,
                               const double at[3]) {
    g_assert_cmpuint(read->count_u, ==, own->count_u);
    g_assert_cmpuint(read->count_v, ==, own->count_v);
    for (int k = 0; k < 9; k++) {
        double p[3], q[3];
        fr_nurbs_surface_at(own, (k % 3) / 2.0, (k / 3) / 2.0, p, NULL, NULL);
        fr_nurbs_surface_at(read, (k % 3) / 2.0, (k / 3) / 2.0, q, NULL, NULL);
        for (int d = 0; d < 3; d++) {
            g_assert_cmpfloat_with_epsilon(p[d] + at[d], q[d], 1e-12);
        }
    }
}

/// What is written is read again: the same surfaces, where they were.
static void round_trip(void) {
    static const char *const names[] = {"oak.igs", "oak.nurbs.obj"};
    char *folder = folder_new();
    FrScene *scene = garden();
    const FrPlant *oak = g_array_index(scene->plants, FrScenePlant, 0).plant;
    FrNurbsParams params = fr_nurbs_default();
    FrContext context = fr_context_default();
    FrNurbsSkin *skin;
    g_assert_cmpint(fr_nurbs_plant(oak, &params, &context, &skin), ==, FR_OK);
    for (size_t i = 0; i < G_N_ELEMENTS(names); i++) {
        FrIoStats stats = write_scene(scene, folder, names[i], FR_LEAVES_MERGED);
        FrStatus status = FR_OK;
        FrMeshFile *file = fr_mesh_file_load(folder, names[i], (FrSpan){0}, &context, &status);
        g_assert_cmpint(status, ==, FR_OK);
        g_assert_cmpuint(file->surfaces->len, ==, stats.surfaces);
        g_assert_cmpuint(file->index_count, >, 6 * stats.surfaces);
        const FrStand *first = &g_array_index(scene->stands, FrStand, 0); // not turned
        for (uint64_t n = 0; n < skin->count; n++) {
            assert_same_points(&skin->pieces[n].surface,
                               &g_array_index(file->surfaces, FrNurbsSurface, n), first->at);
        }
        fr_mesh_file_unref(file);
    }
    fr_nurbs_skin_free(skin);
    fr_scene_free(scene);
    remove_folder(folder);
}

static void too_many_bytes(void) {
    static const char *const names[] = {"oak.igs", "oak.stp", "oak.nurbs.obj"};
    char *folder = folder_new();
    FrScene *scene = garden();
    for (size_t i = 0; i < G_N_ELEMENTS(names); i++) {
        FrContext context = fr_context_default();
        FrIoOptions options = fr_io_options_default();
        context.limits.bytes = 5000;
        char *path = g_build_filename(folder, names[i], NULL);
        g_assert_cmpint(fr_io_write(scene, path, &options, &context, NULL), ==, FR_ERR_LIMIT);
        g_assert_false(g_file_test(path, G_FILE_TEST_EXISTS));
        g_free(path);
    }
    fr_scene_free(scene);
    remove_folder(folder);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/io/surfaces/IGES has lines of 80 columns, all numbered", iges);
    g_test_add_func("/io/surfaces/STEP has a face for each surface, all numbered", step);
    g_test_add_func("/io/surfaces/STEP writes equal leaves once", shared_step);
    g_test_add_func("/io/surfaces/STEP by AP203 says who, when and how secret", managed_step);
    g_test_add_func("/io/surfaces/free-form OBJ has as many points as its knots say", free_form);
    g_test_add_func("/io/surfaces/what is written is read again", round_trip);
    g_test_add_func("/io/surfaces/too large a text is refused and leaves no file", too_many_bytes);
    return g_test_run();
}
