// The pipe model for the stems that ask for it: a bundle of pipes, one from each tip it feeds
// (Shinozaki, Yoda, Hozumi, Kira. A quantitative analysis of plant form. 1964). What other stems
// are thick they bring to the bundle as well. Profiles and feet are factors on top of it.
#include "pgraph/pipes.h"

#include <math.h>

// The parameters of a stem that asks for pipes; NULL for any other component.
static const FrStemParams *pipes_of(const FrExpansion *expansion, uint32_t component) {
    const FrPrepared *prepared = &expansion->prepared[component];
    bool is_stem = prepared->kind == FR_COMPONENT_HORN || prepared->kind == FR_COMPONENT_TREE;
    const FrStemParams *stem = prepared->params;
    return is_stem && stem != NULL && stem->radius_mode == FR_RADIUS_BY_PIPES ? stem : NULL;
}

bool fr_has_pipes(const FrExpansion *expansion) {
    for (uint32_t c = 0; c < fr_pgraph_count(expansion->graph); c++) {
        if (pipes_of(expansion, c) != NULL) {
            return true;
        }
    }
    return false;
}

// Moves what stands on the surface of a stem that became thicker.
static void move_out(const uint32_t *bearer, vec3s *offset, uint32_t count, const float *factor) {
    for (uint32_t k = 0; k < count; k++) {
        if (bearer[k] != FR_NONE) {
            offset[k].x *= factor[bearer[k]];
            offset[k].y *= factor[bearer[k]];
        }
    }
}

typedef struct Bundles {
    const FrExpansion *expansion;
    double *borne; // by node: radii to the power of its exponent
    float *tip;    // by axis: radius as it was made
    float *factor; // by node: of its radius
} Bundles;

static const FrStemParams *stem_of(const Bundles *bundles, uint32_t node) {
    const FrPlant *plant = bundles->expansion->plant;
    return pipes_of(bundles->expansion, plant->axes.component[plant->nodes.axis[node]]);
}

// Gives a node its radius, once all it bears have theirs; returns what it brings to the bundle.
static double bind(const Bundles *bundles, uint32_t node, const FrStemParams *stem) {
    FrNodes *nodes = &bundles->expansion->plant->nodes;
    uint32_t axis = nodes->axis[node];
    double tip = (double)bundles->tip[axis], thick = (double)nodes->radius[node];
    double pipes = fmax(tip, pow(bundles->borne[node], 1 / stem->pipe_exponent));
    bundles->factor[node] = tip > 0 ? (float)(pipes / tip) : 1;
    nodes->radius[node] = (float)(thick * (double)bundles->factor[node]);
    return pipes;
}

static void sum_up(const Bundles *bundles) {
    FrPlant *plant = bundles->expansion->plant;
    FrNodes *nodes = &plant->nodes;
    FrAxes *axes = &plant->axes;
    for (uint32_t node = nodes->count; node-- > 0;) {
        uint32_t axis = nodes->axis[node], before = nodes->parent[node];
        const FrStemParams *stem = stem_of(bundles, node);
        bool is_first = axes->first[axis] == node;
        double brings = is_first ? (double)axes->base_radius[axis] : 0;
        bundles->factor[node] = 1;
        if (axes->last[axis] == node) {
            bundles->tip[axis] = nodes->radius[node];
        }
        if (stem != NULL) {
            brings = bind(bundles, node, stem);
            axes->base_radius[axis] *= is_first ? bundles->factor[node] : 1;
        }
        const FrStemParams *bearer = before != FR_NONE ? stem_of(bundles, before) : NULL;
        if (bearer != NULL) {
            bundles->borne[before] += pow(brings, bearer->pipe_exponent);
        }
    }
}

void fr_pipes_apply(const FrExpansion *expansion) {
    FrPlant *plant = expansion->plant;
    FrAxes *axes = &plant->axes;
    Bundles bundles = {
        .expansion = expansion,
        .borne = g_new0(double, MAX(plant->nodes.count, 1)),
        .tip = g_new0(float, MAX(axes->count, 1)),
        .factor = g_new(float, MAX(plant->nodes.count, 1)),
    };
    sum_up(&bundles);
    move_out(axes->bearer, axes->offset, axes->count, bundles.factor);
    move_out(plant->organs.node, plant->organs.offset, plant->organs.count, bundles.factor);
    fr_plant_update_frames(plant, 0);
    g_free(bundles.borne);
    g_free(bundles.tip);
    g_free(bundles.factor);
}
