// A skeleton of a document: a table of lines and what is said of it.
#include "variation/skeleton_mtg.h"

#include <cglm/struct.h>

#define FR_PARAM_STRUCT FrSkeletonParams
static const FrParam rows[] = {FR_SKELETON_PARAMS(FR_PARAM_ROW)};
#undef FR_PARAM_STRUCT

static const FrParamTable table = {
    .element = "skeleton",
    .meaning = "lines that become stems: x y z x y z r a row, two ends and a radius",
    .rows = rows,
    .count = G_N_ELEMENTS(rows),
    .struct_size = sizeof(FrSkeletonParams)};

struct FrSkeleton {
    FrSkeletonParams params;
    FrMaterial *material;
    FrSegment *segments;
    size_t count;
    FrSpan span; ///< where it is described
};

const FrParamTable *fr_skeleton_table(void) {
    return &table;
}

FrSkeleton *fr_skeleton_new(const FrSkeletonParams *params) {
    FrSkeleton *skeleton = g_new0(FrSkeleton, 1);
    fr_params_copy(&table, &skeleton->params, params);
    return skeleton;
}

void fr_skeleton_free(FrSkeleton *skeleton) {
    if (skeleton != NULL) {
        fr_params_clear(&table, &skeleton->params);
        fr_material_unref(skeleton->material);
        g_free(skeleton->segments);
        fr_source_unref(skeleton->span.source);
        g_free(skeleton);
    }
}

const char *fr_skeleton_file(const FrSkeleton *skeleton) {
    return skeleton->params.file;
}

void fr_skeleton_set_material(FrSkeleton *skeleton, FrMaterial *material) {
    skeleton->material = material == NULL ? NULL : fr_material_ref(material);
}

FrStatus fr_skeleton_load(FrSkeleton *skeleton, const FrSource *text, const char *folder,
                          FrSpan span, const FrContext *context) {
    FrStatus status = FR_OK;
    FrSource *file = NULL;
    skeleton->span = span;
    fr_source_ref(span.source);
    if (text == NULL) {
        file = fr_source_load_beside(skeleton->params.file, folder, span,
                                     context->limits.document_bytes, context->diags, &status);
        text = file;
    }
    if (status == FR_OK) {
        bool is_graph = file != NULL && g_str_has_suffix(skeleton->params.file, ".mtg");
        status = (is_graph ? fr_skeleton_read_mtg : fr_skeleton_read)(
            text, context, &skeleton->segments, &skeleton->count);
    }
    fr_source_unref(file);
    float unit = (float)skeleton->params.unit;
    for (size_t i = 0; i < skeleton->count; i++) {
        FrSegment *segment = &skeleton->segments[i];
        segment->from = glms_vec3_scale(segment->from, unit);
        segment->to = glms_vec3_scale(segment->to, unit);
        segment->radius *= unit;
    }
    return status;
}

FrStatus fr_skeleton_grow(const FrSkeleton *skeleton, const char *name, const FrContext *context,
                          FrPlant **plant) {
    *plant = NULL;
    FrStatus status = fr_limit_check(skeleton->count, context->limits.nodes, "nodes", name,
                                     skeleton->span, context->diags);
    if (status == FR_OK) {
        status = fr_skeleton_weld(skeleton->segments, skeleton->count, skeleton->params.tolerance,
                                  name, skeleton->span, context, plant);
    }
    if (status == FR_OK && skeleton->material != NULL) {
        uint32_t material = fr_plant_add_material(*plant, skeleton->material);
        for (uint32_t a = 0; a < (*plant)->axes.count; a++) {
            (*plant)->axes.material[a] = material;
        }
    }
    return status;
}
