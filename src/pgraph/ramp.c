#include "pgraph/ramp.h"

#include <math.h>

bool fr_has_ramps(const FrPgraph *graph) {
    for (guint k = 0; k < graph->materials->len; k++) {
        if (fr_material_has_ramp(g_ptr_array_index(graph->materials, k))) {
            return true;
        }
    }
    return false;
}

uint32_t *fr_ramps_add(FrPlant *plant) {
    guint count = plant->materials->len;
    uint32_t *ramps = NULL;
    for (guint k = 0; k < count; k++) {
        FrMaterial *material = g_ptr_array_index(plant->materials, k);
        if (!fr_material_has_ramp(material)) {
            continue;
        }
        if (ramps == NULL) {
            ramps = g_new(uint32_t, count);
            for (guint i = 0; i < count; i++) {
                ramps[i] = FR_NONE;
            }
        }
        ramps[k] = plant->materials->len;
        for (uint32_t step = 0; step <= FR_RAMP_STEPS; step++) {
            fr_plant_add_material(plant, fr_material_at(material, step));
        }
    }
    return ramps;
}

uint8_t fr_ramp_step(const FrExpansion *expansion, uint32_t row, FrEvaluator *evaluator) {
    fr_instance_enter(expansion, row, evaluator);
    const FrBasicParams *basic = fr_stage_prepared(expansion, expansion->level.stage[row])->params;
    double place = fr_value(evaluator, &basic->ramp_at, FR_BASIC_ramp_at);
    return (uint8_t)lround(fmax(0, fmin(place, 1)) * FR_RAMP_STEPS);
}

static void mark(bool *is_used, const uint32_t *materials, uint32_t count) {
    for (uint32_t k = 0; k < count; k++) {
        if (materials[k] != FR_NONE) {
            is_used[materials[k]] = true;
        }
    }
}

static void renumber(uint32_t *materials, uint32_t count, const uint32_t *number) {
    for (uint32_t k = 0; k < count; k++) {
        materials[k] = materials[k] != FR_NONE ? number[materials[k]] : FR_NONE;
    }
}

void fr_ramps_drop_unused(FrPlant *plant, const uint32_t *ramps) {
    if (ramps == NULL) {
        return;
    }
    guint count = plant->materials->len, kept = 0;
    guint first = count; // of the steps
    for (guint k = 0; k < first; k++) {
        first = MIN(first, ramps[k]);
    }
    bool *is_used = g_new0(bool, count);
    uint32_t *number = g_new(uint32_t, count);
    mark(is_used, plant->organs.material, plant->organs.count);
    mark(is_used, plant->axes.material, plant->axes.count);
    for (guint k = 0; k < count; k++) {
        number[k] = kept;
        bool is_kept = k < first || is_used[k];
        if (!is_kept) {
            g_ptr_array_remove_index(plant->materials, kept);
        }
        kept += is_kept;
    }
    renumber(plant->organs.material, plant->organs.count, number);
    renumber(plant->axes.material, plant->axes.count, number);
    g_free(is_used);
    g_free(number);
}
