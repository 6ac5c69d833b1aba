// STEP (ISO 10303-21) by AP214 or AP203: a plant is a product whose shape is a surface model of
// shells: a closed one for each tube with its caps, an open one for each blade. Equal organs are
// mapped items (ISO 10303-43): a shape is written once and placed by its axes. Readers ignore the
// scale of such a mapping, so each size is a shape of its own.
#include "io/formats.h"
#include "io/step_faces.h"

#include <string.h>

enum { POINT_BYTES = 60 };

typedef struct FrStepFile {
    const FrScene *scene;
    const FrContext *context;
    bool is_203;
    FrIoNurbs nurbs;
    uint64_t bytes;
} FrStepFile;

static void put_shells(FrStep *step, const FrNurbsPiece *pieces, uint64_t count, GArray *shells) {
    for (uint64_t i = 0; i < count;) {
        uint64_t faces[3];
        bool is_closed;
        uint32_t used = fr_step_shell(step, &pieces[i], count - i, faces, &is_closed);
        uint64_t shell = fr_step_entity(step, is_closed ? "CLOSED_SHELL" : "OPEN_SHELL", "('',(",
                                        faces, used, "));\n");
        g_array_append_val(shells, shell);
        i += used;
    }
}

static uint64_t put_model(FrStep *step, const GArray *shells) {
    return fr_step_entity(step, "SHELL_BASED_SURFACE_MODEL", "('',(",
                          (const uint64_t *)(void *)shells->data, shells->len, "));\n");
}

static uint64_t put_representation(FrStep *step, const GArray *items) {
    return fr_step_entity(step, "MANIFOLD_SURFACE_SHAPE_REPRESENTATION", "('',(",
                          (const uint64_t *)(void *)items->data, items->len, "),#9);\n");
}

/// The map of a shape of copies, written when the first of them wants it.
static uint64_t map_of(FrStep *step, const FrNurbsSkin *skin, const FrNurbsCopy *copy,
                       GHashTable *maps) {
    gpointer found = g_hash_table_lookup(maps, &copy->first_piece);
    if (found != NULL) {
        return *(const uint64_t *)found;
    }
    static const double at[4] = {0}, axis[3] = {0, 0, 1}, across[3] = {1, 0, 0};
    const FrPose plain = {.cosine = 1, .scale = step->pose->scale};
    const FrPose *pose = step->pose;
    step->pose = &plain;
    GArray *shells = g_array_new(FALSE, FALSE, sizeof(uint64_t));
    put_shells(step, &skin->pieces[copy->first_piece], copy->piece_count, shells);
    uint64_t item = put_model(step, shells);
    g_array_set_size(shells, 0);
    g_array_append_val(shells, item);
    uint64_t parts[2];
    parts[0] = fr_step_placement(step, at, axis, across);
    parts[1] = put_representation(step, shells);
    uint64_t map = fr_step_entity(step, "REPRESENTATION_MAP", "(", parts, 2, ");\n");
    g_array_unref(shells);
    step->pose = pose;
    g_hash_table_insert(maps, g_memdup2(&copy->first_piece, sizeof(uint64_t)),
                        g_memdup2(&map, sizeof map));
    return map;
}

static void turn(const FrPose *pose, const double v[3], double out[3]) {
    out[0] = pose->cosine * v[0] - pose->sine * v[1];
    out[1] = pose->sine * v[0] + pose->cosine * v[1];
    out[2] = v[2];
}

static uint64_t put_copy(FrStep *step, const FrNurbsSkin *skin, const FrNurbsCopy *copy,
                         GHashTable *maps) {
    const double origin[4] = {copy->at[0], copy->at[1], copy->at[2], 1.0};
    double at[4], axis[3], across[3];
    uint64_t parts[2] = {map_of(step, skin, copy, maps), 0};
    fr_io_nurbs_posed(step->pose, origin, at);
    turn(step->pose, copy->axes[2], axis);
    turn(step->pose, copy->axes[0], across);
    parts[1] = fr_step_placement(step, at, axis, across);
    return fr_step_entity(step, "MAPPED_ITEM", "('',", parts, 2, ");\n");
}

static void put_stand(FrStepFile *file, FrStep *step, const FrStand *stand) {
    const FrNurbsSkin *skin = file->nurbs.skins[stand->plant];
    GArray *shells = g_array_new(FALSE, FALSE, sizeof(uint64_t));
    GArray *items = g_array_new(FALSE, FALSE, sizeof(uint64_t));
    GHashTable *maps = g_hash_table_new_full(g_int64_hash, g_int64_equal, g_free, g_free);
    put_shells(step, skin->pieces, skin->count, shells);
    if (shells->len > 0) {
        uint64_t model = put_model(step, shells);
        g_array_append_val(items, model);
    }
    for (uint64_t i = 0; i < skin->copy_count && step->output.error == 0; i++) {
        uint64_t item = put_copy(step, skin, &skin->copies[i], maps);
        g_array_append_val(items, item);
    }
    if (items->len > 0) {
        uint64_t representation = put_representation(step, items);
        fr_step_product(step, fr_io_plant(file->scene, stand->plant)->name, representation);
    }
    g_hash_table_unref(maps);
    g_array_unref(items);
    g_array_unref(shells);
}

static bool write_step(void *user, int descriptor) {
    FrStepFile *file = user;
    FrStep step = {.is_203 = file->is_203, .scratch = g_array_new(FALSE, FALSE, sizeof(uint64_t))};
    fr_output_start(&step.output, descriptor, file->context->progress);
    fr_step_head(&step);
    for (guint s = 0; s < file->scene->stands->len && step.output.error == 0; s++) {
        const FrStand *stand = fr_io_stand(file->scene, s);
        FrPose pose = fr_io_pose(stand, FR_UP_Z);
        step.pose = &pose;
        put_stand(file, &step, stand);
        fr_progress_report(file->context->progress, "write",
                           (double)(s + 1) / file->scene->stands->len);
    }
    fr_step_text(&step, "ENDSEC;\nEND-ISO-10303-21;\n");
    bool is_whole = fr_output_finish(&step.output);
    file->bytes = step.output.done;
    g_array_unref(step.scratch);
    return is_whole;
}

/// The protocol that the first plant wants that is shown as surfaces, else that of the options.
static bool wants_203(const FrScene *scene, const FrIoOptions *options) {
    int wanted = options->nurbs.step;
    for (guint p = scene->plants->len; p-- > 0;) {
        const FrScenePlant *plant = &g_array_index(scene->plants, FrScenePlant, p);
        wanted = plant->has_nurbs ? plant->nurbs.step : wanted;
    }
    return wanted == FR_STEP_AP203;
}

FrStatus fr_step_write(const FrScene *scene, const char *path, const FrIoOptions *options,
                       const FrContext *context, FrIoStats *stats) {
    FrStepFile file = {.scene = scene, .context = context, .is_203 = wants_203(scene, options)};
    gint64 start = g_get_monotonic_time();
    FrStatus status =
        fr_io_nurbs_make(&file.nurbs, scene, &options->nurbs, true, POINT_BYTES, context);
    if (status != FR_OK) {
        return status;
    }
    gint64 skinned = g_get_monotonic_time();
    status = fr_io_replace_file(path, write_step, &file, context->diags);
    *stats = fr_io_nurbs_stats(&file.nurbs, file.bytes, start, skinned);
    fr_io_nurbs_clear(&file.nurbs);
    return status;
}
