// Leaves: the shapes of a component's leaves, the same for all, a few variants, or one for each.
#include "pgraph/prepare.h"

#include <math.h>

enum { CURVE_POINTS = 33 };

static bool is_always(const FrNumber *number, double value) {
    return number->is_constant && number->constant == value;
}

// Whether a parameter depends on anything but the path's random numbers and the place along itself.
static bool depends_on_place(const FrNumber *number) {
    if (number->is_constant) {
        return false;
    }
    for (int var = 0; var < FR_VAR_COUNT; var++) {
        // The plain range is walked before the function, but only t tells where.
        if (var != FR_VAR_s && fr_number_uses(number, (FrVar)var)) {
            return true;
        }
    }
    return false;
}

static uint32_t add_curve(FrPlant *plant, const FrCurve *curve) {
    if (curve == NULL) {
        return FR_NONE;
    }
    double points[CURVE_POINTS][2];
    for (int k = 0; k < CURVE_POINTS; k++) {
        points[k][0] = (double)k / (CURVE_POINTS - 1);
        points[k][1] = fr_curve_eval(curve, points[k][0]);
    }
    return fr_plant_add_profile(plant, (const double(*)[2])points, CURVE_POINTS, false);
}

void fr_prepare_leaf(FrPrepared *made, const FrPgraph *graph, const FrPrototype *prototype,
                     FrPlant *plant, GHashTable *faults) {
    const FrLeafParams *leaf = prototype->params;
    made->blade = (FrShape){.kind = FR_SHAPE_BLADE};
    FrBlade *blade = &made->blade.blade;
    blade->outline = fr_leaf_outline(plant, leaf);
    blade->along_curve = add_curve(plant, leaf->along_curve);
    blade->across_curve = add_curve(plant, leaf->across_curve);
    blade->segments_along = (uint16_t)leaf->segments_along;
    blade->segments_across = (uint16_t)leaf->segments_across;
    blade->undulations = (float)leaf->undulations;
    blade->margin = (uint32_t)leaf->margin;
    blade->teeth = leaf->margin != FR_MARGIN_ENTIRE ? (uint32_t)leaf->teeth : 0;
    blade->tooth_depth = (float)leaf->tooth_depth;
    blade->tooth_sharpness = (float)leaf->tooth_sharpness;
    blade->normals = (uint32_t)leaf->normals;
    if (leaf->compound != FR_COMPOUND_SIMPLE) {
        blade->compound = (uint32_t)leaf->compound;
        blade->pinnae = (uint32_t)leaf->pinnae;
        blade->is_terminal = leaf->terminal;
        blade->leaflet_petiole = (float)leaf->leaflet_petiole;
        blade->leaflet_curve = add_curve(plant, leaf->leaflet_curve) + 1; // FR_NONE + 1 is 0
    }
    const FrNumber *numbers[] = {
        &leaf->length,
        &leaf->width,
        &leaf->petiole_length,
        &leaf->petiole_radius,
        &leaf->petiole_bend,
        &leaf->curvature_along,
        &leaf->curvature_across,
        &leaf->fold,
        &leaf->twist,
        &leaf->wave,
        &leaf->waves,
        &leaf->edge_curl,
        &leaf->tip_droop,
        &leaf->undulation,
        &leaf->leaflets,
        &leaf->rachis_length,
        &leaf->rachis_curvature,
        &leaf->leaflet_angle,
    };
    // Bumps are by chance.
    bool varies = !is_always(&leaf->undulation, 0), depends = false;
    for (size_t k = 0; k < G_N_ELEMENTS(numbers); k++) {
        varies |= !numbers[k]->is_constant;
        depends |= depends_on_place(numbers[k]);
    }
    made->shape_choice = depends ? FR_SHAPE_EVALUATED : varies ? FR_SHAPE_VARIANT : FR_SHAPE_SAME;
    made->variant_count = (uint32_t)leaf->variants;
    made->is_along = fr_leaf_is_along(leaf);
    if (depends) {
        return;
    }
    uint32_t count = varies ? made->variant_count : 1;
    made->variants = g_new(uint32_t, count);
    FrEvaluator evaluator = {.faults = faults};
    evaluator.component = fr_pgraph_find(graph, prototype->id);
    for (uint32_t k = 0; k < count; k++) {
        evaluator.vars.key = fr_variant_key(graph, made, k);
        FrShape shape = fr_leaf_shape(made, &evaluator);
        fr_leaf_along(&shape.blade, leaf, &evaluator, plant);
        made->variants[k] = fr_plant_add_shape(plant, &shape);
    }
    made->shape = made->variants[0];
}

FrKey fr_variant_key(const FrPgraph *graph, const FrPrepared *prepared, uint32_t variant) {
    return fr_key_child(fr_key_child(fr_key_root(graph->seed), prepared->key_word), variant);
}

FrShape fr_leaf_shape(const FrPrepared *prepared, FrEvaluator *evaluator) {
    const FrLeafParams *leaf = prepared->params;
    FrShape shape = prepared->blade;
    FrBlade *blade = &shape.blade;
#define FR_SET(field) blade->field = (float)fr_value(evaluator, &leaf->field, FR_LEAF_##field)
    FR_SET(length);
    FR_SET(width);
    FR_SET(petiole_length);
    FR_SET(petiole_radius);
    FR_SET(petiole_bend);
    FR_SET(curvature_along);
    FR_SET(curvature_across);
    FR_SET(fold);
    FR_SET(twist);
    FR_SET(wave);
    FR_SET(waves);
    FR_SET(edge_curl);
    FR_SET(tip_droop);
    FR_SET(undulation);
    if (blade->undulation > 0) {
        // A whole number is a place of its own in the noise.
        blade->phase = (float)floor(fr_random(evaluator->vars.key, FR_LEAF_undulation, 1) * 4096);
    }
    if (blade->compound != FR_COMPOUND_SIMPLE) {
        blade->leaflets = (uint32_t)(fr_value(evaluator, &leaf->leaflets, FR_LEAF_leaflets) + 0.5);
        FR_SET(rachis_length);
        FR_SET(rachis_curvature);
        FR_SET(leaflet_angle);
    }
#undef FR_SET
    return shape;
}
