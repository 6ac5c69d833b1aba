// What every engine promises about a plant, checked row by row.
#include "frond/plant.h"

#include <math.h>

typedef struct FrFinding {
    char **why;
    bool is_valid;
} FrFinding;

static void FR_PRINTF(2, 3) found(FrFinding *finding, const char *format, ...) {
    if (finding->is_valid && finding->why != NULL) {
        va_list values;
        va_start(values, format);
        *finding->why = g_strdup_vprintf(format, values);
        va_end(values);
    }
    finding->is_valid = false;
}

static bool is_index(uint32_t index, guint count) {
    return index == FR_NONE || index < count;
}

static bool is_length(float value) {
    return isfinite(value) && value >= 0.0f;
}

static bool is_point(vec3s point) {
    return isfinite(point.x) && isfinite(point.y) && isfinite(point.z);
}

static bool is_rotation(versors q) {
    return fabsf(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w - 1.0f) < 1e-3f;
}

static void check_nodes(const FrPlant *plant, FrFinding *finding) {
    const FrNodes *nodes = &plant->nodes;
    for (uint32_t i = 0; i < nodes->count && finding->is_valid; i++) {
        if (nodes->parent[i] != FR_NONE && nodes->parent[i] >= i) {
            found(finding, "node %u comes before its parent %u", i, nodes->parent[i]);
        } else if (nodes->next[i] != FR_NONE &&
                   (nodes->next[i] <= i || nodes->next[i] >= nodes->count)) {
            found(finding, "node %u has the next node %u", i, nodes->next[i]);
        } else if (nodes->axis[i] >= plant->axes.count) {
            found(finding, "node %u is on axis %u of %u", i, nodes->axis[i], plant->axes.count);
        } else if (!is_rotation(nodes->rotation[i])) {
            found(finding, "the rotation of node %u is not a unit quaternion", i);
        } else if (!is_length(nodes->length[i]) || !is_length(nodes->radius[i]) ||
                   !is_length(nodes->flatness[i])) {
            found(finding, "node %u has length %g, radius %g, flatness %g", i,
                  (double)nodes->length[i], (double)nodes->radius[i], (double)nodes->flatness[i]);
        }
    }
}

static void check_axes(const FrPlant *plant, FrFinding *finding) {
    const FrAxes *axes = &plant->axes;
    uint32_t nodes = plant->nodes.count;
    for (uint32_t a = 0; a < axes->count && finding->is_valid; a++) {
        if (!is_index(axes->first[a], nodes) || !is_index(axes->last[a], nodes) ||
            (axes->first[a] == FR_NONE) != (axes->last[a] == FR_NONE)) {
            found(finding, "axis %u runs from node %u to node %u", a, axes->first[a],
                  axes->last[a]);
        } else if (!is_index(axes->bearer[a], nodes)) {
            found(finding, "axis %u is borne by node %u of %u", a, axes->bearer[a], nodes);
        } else if (axes->bearer[a] != FR_NONE && plant->nodes.axis[axes->bearer[a]] >= a) {
            found(finding, "axis %u comes before the axis %u that bears it", a,
                  plant->nodes.axis[axes->bearer[a]]);
        } else if (!is_index(axes->profile[a], plant->profiles->len) ||
                   !is_index(axes->finish[a], plant->finishes->len) ||
                   !is_index(axes->material[a], plant->materials->len) ||
                   !is_index(axes->deformer[a], plant->deformers->len) ||
                   !is_index(axes->component[a], plant->components->len)) {
            found(finding,
                  "axis %u has a profile, finish, material, deformer or component out of range", a);
        } else if (!is_point(axes->offset[a]) || !is_length(axes->base_radius[a])) {
            found(finding, "axis %u has an offset or base radius that is no length", a);
        }
    }
}

/// Walks every axis from first to last; every node must be met exactly once.
static void check_chains(const FrPlant *plant, FrFinding *finding) {
    const FrNodes *nodes = &plant->nodes;
    const FrAxes *axes = &plant->axes;
    uint32_t met = 0;
    for (uint32_t a = 0; a < axes->count && finding->is_valid; a++) {
        uint32_t before = axes->bearer[a];
        uint32_t last = FR_NONE;
        for (uint32_t i = axes->first[a]; i != FR_NONE && finding->is_valid; i = nodes->next[i]) {
            if (nodes->axis[i] != a) {
                found(finding, "axis %u runs through node %u of axis %u", a, i, nodes->axis[i]);
            } else if (nodes->parent[i] != before) {
                found(finding, "node %u of axis %u has parent %u, not %u", i, a, nodes->parent[i],
                      before);
            }
            before = last = i;
            met++;
        }
        if (finding->is_valid && last != axes->last[a]) {
            found(finding, "axis %u ends at node %u, not at %u", a, last, axes->last[a]);
        }
    }
    if (finding->is_valid && met != nodes->count) {
        found(finding, "%u nodes of %u are on no axis", nodes->count - met, nodes->count);
    }
}

static void check_organs(const FrPlant *plant, FrFinding *finding) {
    const FrOrgans *organs = &plant->organs;
    for (uint32_t o = 0; o < organs->count && finding->is_valid; o++) {
        if (!is_index(organs->node[o], plant->nodes.count)) {
            found(finding, "organ %u is borne by node %u of %u", o, organs->node[o],
                  plant->nodes.count);
        } else if (organs->shape[o] >= plant->shapes->len) {
            found(finding, "organ %u has shape %u of %u", o, organs->shape[o], plant->shapes->len);
        } else if (!is_index(organs->material[o], plant->materials->len) ||
                   !is_index(organs->deformer[o], plant->deformers->len) ||
                   !is_index(organs->component[o], plant->components->len)) {
            found(finding, "organ %u has a material, deformer or component out of range", o);
        } else if (!is_point(organs->offset[o]) || !is_rotation(organs->rotation[o]) ||
                   !isfinite(organs->scale[o]) || organs->scale[o] <= 0.0f) {
            found(finding, "organ %u has an offset, rotation or scale that is none", o);
        }
    }
}

static void check_buds(const FrPlant *plant, FrFinding *finding) {
    const FrBuds *buds = &plant->buds;
    for (uint32_t b = 0; b < buds->count && finding->is_valid; b++) {
        if (!is_index(buds->node[b], plant->nodes.count)) {
            found(finding, "bud %u sits on node %u of %u", b, buds->node[b], plant->nodes.count);
        } else if (buds->kind[b] > FR_BUD_FLORAL || buds->state[b] > FR_BUD_SPROUTED) {
            found(finding, "bud %u has kind %u and state %u", b, buds->kind[b], buds->state[b]);
        } else if (!is_point(buds->direction[b])) {
            found(finding, "bud %u has no direction", b);
        }
    }
}

static bool has_part(const FrPlant *plant, const FrShape *shape) {
    if (shape->detail >= plant->files->len) {
        return false;
    }
    const FrMeshFile *file = g_ptr_array_index(plant->files, shape->detail);
    return shape->outline < file->part_count;
}

static void check_tables(const FrPlant *plant, FrFinding *finding) {
    for (guint i = 0; i < plant->shapes->len && finding->is_valid; i++) {
        const FrShape *shape = &g_array_index(plant->shapes, FrShape, i);
        const FrBlade *blade = &shape->blade;
        if (shape->kind == FR_SHAPE_BLADE &&
            (!is_index(blade->outline, plant->profiles->len) ||
             !is_index(blade->along_curve, plant->profiles->len) ||
             !is_index(blade->across_curve, plant->profiles->len) ||
             blade->across_along > plant->profiles->len ||
             blade->fold_along > plant->profiles->len ||
             blade->twist_along > plant->profiles->len ||
             blade->wave_along > plant->profiles->len ||
             blade->leaflet_curve > plant->profiles->len)) {
            found(finding, "shape %u has an outline or curve out of range", i);
        } else if (shape->kind == FR_SHAPE_REVOLUTION && shape->outline >= plant->profiles->len) {
            found(finding, "shape %u has outline %u of %u", i, shape->outline,
                  plant->profiles->len);
        } else if (shape->kind == FR_SHAPE_FILE && !has_part(plant, shape)) {
            found(finding, "shape %u is part %u of file %u, which there is not", i, shape->outline,
                  shape->detail);
        }
    }
    for (guint i = 0; i < plant->deformers->len && finding->is_valid; i++) {
        const FrDeformer *deformer = &g_array_index(plant->deformers, FrDeformer, i);
        if (deformer->outer != FR_NONE && deformer->outer >= i) {
            found(finding, "deformer %u comes before the scope %u around it", i, deformer->outer);
        } else if (deformer->deformation >= plant->deformations->len ||
                   !is_index(deformer->node, plant->nodes.count)) {
            found(finding, "deformer %u has a deformation or node out of range", i);
        } else if (!is_point(deformer->offset) || !is_rotation(deformer->rotation) ||
                   !isfinite(deformer->scale) || deformer->scale <= 0.0f ||
                   !isfinite(deformer->strength) || !isfinite(deformer->amount)) {
            found(finding, "deformer %u has a place, scale, strength or amount that is none", i);
        }
    }
}

bool fr_plant_is_valid(const FrPlant *plant, char **why) {
    FrFinding finding = {.why = why, .is_valid = true};
    check_nodes(plant, &finding);
    check_axes(plant, &finding);
    check_chains(plant, &finding);
    check_organs(plant, &finding);
    check_buds(plant, &finding);
    check_tables(plant, &finding);
    return finding.is_valid;
}
