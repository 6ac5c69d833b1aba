// Places, counts and copies organs.
#include "skin/organs.h"

#include <cglm/struct.h>

#include <math.h>
#include <string.h>

// The purpose of the draw that decides whether a leaf stays.
enum { PURPOSE_STAY = 0x6c6f64 };

bool fr_organ_is_drawn(const FrPlan *plan, uint32_t organ) {
    const FrOrgans *organs = &plan->plant->organs;
    uint32_t node = organs->node[organ];
    return (organs->flags[organ] & (FR_SHED | FR_HIDDEN)) == 0 && organs->scale[organ] > 0.0F &&
           isfinite(organs->scale[organ]) &&
           (node == FR_NONE || (plan->marks[node] & FR_NODE_GONE) == 0);
}

static FrLeafGroup *group_of(const FrOrganPlan *organs, uint32_t organ) {
    const FrPlant *plant = organs->plan->plant;
    return &organs->groups[MIN(plant->organs.component[organ], plant->components->len)];
}

static double draw_of(const FrOrganPlan *organs, uint32_t organ) {
    FrKey path = organs->plan->plant->organs.path[organ];
    return fr_random(path != 0 ? path : fr_key_root(organ), PURPOSE_STAY, 0);
}

// Its mesh, NULL if there is nothing to draw.
static const FrShapeMesh *shape_of(const FrOrganPlan *organs, uint32_t organ) {
    const FrPlant *plant = organs->plan->plant;
    uint32_t form = plant->organs.shape[organ];
    if (form >= plant->shapes->len || !fr_organ_is_drawn(organs->plan, organ)) {
        return NULL;
    }
    const FrShapeMesh *shape = &organs->shapes[form];
    return shape->index_count > 0 ? shape : NULL;
}

// Finds which leaf of each component stays in any case, and how much those that stay are enlarged.
static void count_leaves(FrOrganPlan *organs, uint32_t count) {
    for (uint32_t i = 0; i < count && organs->staying < 1.0; i++) {
        const FrShapeMesh *shape = shape_of(organs, i);
        if (shape == NULL || !shape->is_foliage) {
            continue;
        }
        FrLeafGroup *group = group_of(organs, i);
        double draw = draw_of(organs, i);
        if (group->all == 0 || draw < group->lowest) {
            group->lowest = draw;
        }
        group->all++;
        group->staying += draw < organs->staying ? 1 : 0;
    }
    for (uint32_t k = 0; k <= organs->plan->plant->components->len; k++) {
        FrLeafGroup *group = &organs->groups[k];
        double each = (double)group->all / MAX(group->staying, 1);
        group->enlarged = (float)fmin(sqrt(fmax(each, 1.0)), 2.0);
    }
}

static bool stays(const FrOrganPlan *organs, uint32_t organ, const FrShapeMesh *shape) {
    if (!shape->is_foliage || organs->staying >= 1.0) {
        return true;
    }
    double draw = draw_of(organs, organ);
    return draw < organs->staying || draw <= group_of(organs, organ)->lowest;
}

// From the second level on each has the root of 0.4 of the leaves of the one before.
static double staying_at(int lod) {
    double part = 1.0;
    for (int i = 2; i <= lod; i++) {
        part *= sqrt(0.4);
    }
    return part;
}

static void make_shapes(void *data, size_t begin, size_t end, int worker) {
    (void)worker;
    FrOrganPlan *organs = data;
    for (size_t i = begin; i < end; i++) {
        if (organs->is_used[i]) {
            fr_shape_mesh_init(&organs->shapes[i], organs->plan->plant, (uint32_t)i,
                               &organs->plan->detail);
        }
    }
}

// Makes the shapes that organs have, once they are known not to be too large.
static FrStatus prepare_shapes(FrOrganPlan *organs) {
    const FrPlan *plan = organs->plan;
    const FrPlant *plant = plan->plant;
    const FrContext *context = plan->context;
    for (uint32_t i = 0; i < plant->organs.count; i++) {
        if (plant->organs.shape[i] < plant->shapes->len) {
            organs->is_used[plant->organs.shape[i]] = true;
        }
    }
    uint64_t bytes = 0;
    for (uint32_t i = 0; i < plant->shapes->len; i++) {
        const FrShape *shape = &g_array_index(plant->shapes, FrShape, i);
        bytes += organs->is_used[i] ? fr_shape_bytes_most(shape, &plan->detail) : 0;
    }
    FrStatus status = fr_limit_check(bytes, context->limits.bytes, "bytes", "shapes of organs",
                                     (FrSpan){0}, context->diags);
    if (status == FR_OK) {
        fr_parallel_for(context->pool, plant->shapes->len, 8, make_shapes, organs,
                        context->progress);
    }
    return status;
}

// Gives every organ its place in its part.
static void place_organs(FrOrganPlan *organs, uint32_t count) {
    const FrPlant *plant = organs->plan->plant;
    for (uint32_t i = 0; i < count; i++) {
        organs->index[i] = UINT64_MAX;
        uint32_t slot = fr_slot(plant->organs.material[i]);
        const FrShapeMesh *shape = shape_of(organs, i);
        if (shape == NULL || !stays(organs, i, shape)) {
            continue;
        }
        organs->vertex[i] = organs->slot_vertices[slot];
        organs->index[i] = organs->slot_indices[slot];
        organs->slot_vertices[slot] += shape->vertex_count;
        organs->slot_indices[slot] += shape->index_count;
        organs->slot_foliage[slot] |= shape->is_foliage;
    }
}

FrStatus fr_organs_init(FrOrganPlan *organs, const FrPlan *plan) {
    const FrPlant *plant = plan->plant;
    uint32_t count = plan->detail.foliage ? plant->organs.count : 0;
    *organs = (FrOrganPlan){
        .plan = plan,
        .shapes = g_new0(FrShapeMesh, plant->shapes->len + 1),
        .is_used = g_new0(bool, plant->shapes->len + 1),
        .vertex = g_new(uint64_t, count),
        .index = g_new(uint64_t, count),
        .slot_vertices = g_new0(uint64_t, plan->slots),
        .slot_indices = g_new0(uint64_t, plan->slots),
        .slot_foliage = g_new0(bool, plan->slots),
        .groups = g_new0(FrLeafGroup, plant->components->len + 1),
        .staying = staying_at(plan->detail.lod),
    };
    if (count == 0) {
        return FR_OK;
    }
    FrStatus status = prepare_shapes(organs);
    if (status == FR_OK) {
        count_leaves(organs, count);
        place_organs(organs, count);
    }
    return status;
}

void fr_organs_clear(FrOrganPlan *organs) {
    for (uint32_t i = 0; i < organs->plan->plant->shapes->len; i++) {
        fr_shape_mesh_clear(&organs->shapes[i]);
    }
    g_free(organs->shapes);
    g_free(organs->is_used);
    g_free(organs->vertex);
    g_free(organs->index);
    g_free(organs->slot_vertices);
    g_free(organs->slot_indices);
    g_free(organs->slot_foliage);
    g_free(organs->groups);
}

// Columns of the rotation, and the place.
typedef struct FrPose {
    vec3s x, y, z, at;
} FrPose;

static FrPose pose_of(const FrPlant *plant, uint32_t organ, FrUpAxis up) {
    vec3s at;
    versors q;
    fr_plant_organ_pose(plant, organ, &at, &q);
    float xx = q.x * q.x, yy = q.y * q.y, zz = q.z * q.z, xy = q.x * q.y, xz = q.x * q.z;
    float yz = q.y * q.z, wx = q.w * q.x, wy = q.w * q.y, wz = q.w * q.z;
    FrPose pose = {
        .x = {{1.0F - 2.0F * (yy + zz), 2.0F * (xy + wz), 2.0F * (xz - wy)}},
        .y = {{2.0F * (xy - wz), 1.0F - 2.0F * (xx + zz), 2.0F * (yz + wx)}},
        .z = {{2.0F * (xz + wy), 2.0F * (yz - wx), 1.0F - 2.0F * (xx + yy)}},
        .at = at,
    };
    pose.x = fr_upright(pose.x, up);
    pose.y = fr_upright(pose.y, up);
    pose.z = fr_upright(pose.z, up);
    pose.at = fr_upright(pose.at, up);
    return pose;
}

static void copy_shape(const FrShapeMesh *shape, const FrPose *pose, float scale, uint32_t base,
                       FrVertex *out, uint32_t *index) {
    for (uint32_t i = 0; i < shape->vertex_count; i++) {
        const FrVertex *in = &shape->vertices[i];
        const float *p = in->position, *n = in->normal;
        for (int k = 0; k < 3; k++) {
            float x = pose->x.raw[k], y = pose->y.raw[k], z = pose->z.raw[k];
            out[i].position[k] = pose->at.raw[k] + scale * (p[0] * x + p[1] * y + p[2] * z);
            out[i].normal[k] = n[0] * x + n[1] * y + n[2] * z;
        }
        memcpy(out[i].uv, in->uv, sizeof in->uv);
    }
    for (uint32_t i = 0; i < shape->index_count; i++) {
        index[i] = base + shape->indices[i];
    }
}

void fr_write_organs(const FrOrganPlan *organs, size_t begin, size_t end, FrUpAxis up, FrMesh *mesh,
                     const uint32_t *part_of, FrBox *boxes, FrDeformNote *notes) {
    const FrPlant *plant = organs->plan->plant;
    for (size_t i = begin; i < end; i++) {
        if (organs->index[i] == UINT64_MAX) {
            continue;
        }
        uint32_t organ = (uint32_t)i, slot = fr_slot(plant->organs.material[i]);
        const FrShapeMesh *shape = &organs->shapes[plant->organs.shape[i]];
        const FrMeshPart *part = &mesh->parts[part_of[slot]];
        FrVertex *out = mesh->vertices + part->first_vertex + organs->vertex[i];
        uint32_t *index = mesh->indices + part->first_index + organs->index[i];
        float scale =
            plant->organs.scale[i] * (shape->is_foliage ? group_of(organs, organ)->enlarged : 1.0F);
        FrPose pose = pose_of(plant, organ, up);
        copy_shape(shape, &pose, scale, (uint32_t)organs->vertex[i], out, index);
        uint32_t scope = fr_plan_scope(organs->plan, plant->organs.deformer[organ]);
        if (scope != FR_NONE) {
            fr_deform_vertices(organs->plan, scope, up, out, shape->vertex_count, index,
                               shape->index_count, notes);
        }
        fr_box_widen(&boxes[slot], out, shape->vertex_count);
    }
}
