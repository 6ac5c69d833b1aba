#include "studio/model/extent.h"

#include <cglm/struct.h>
#include <math.h>

typedef struct Box {
    vec3s min, max;
} Box;

static void add(Box *box, vec3s at, float reach) {
    box->min = glms_vec3_minv(box->min, glms_vec3_subs(at, reach));
    box->max = glms_vec3_maxv(box->max, glms_vec3_adds(at, reach));
}

static void add_vertices(Box *box, const FrVertex *vertices, uint64_t count) {
    for (uint64_t i = 0; i < count; i++) {
        const float *at = vertices[i].position;
        add(box, (vec3s){{at[0], at[1], at[2]}}, 0);
    }
}

static void add_wood(Box *box, const FrSkin *skin) {
    uint32_t count;
    const FrSkinPart *parts = fr_skin_parts(skin, &count);
    for (uint32_t i = 0; i < count; i++) {
        add_vertices(box, parts[i].vertices, parts[i].part.vertex_count);
    }
}

// How far the farthest vertex of a shape is from its base.
static float reach_of(const FrMesh *mesh) {
    float square = 0;
    for (uint64_t i = 0; mesh != NULL && i < mesh->vertex_count; i++) {
        const float *at = mesh->vertices[i].position;
        square = fmaxf(square, at[0] * at[0] + at[1] * at[1] + at[2] * at[2]);
    }
    return sqrtf(square);
}

static void add_leaves(Box *box, const StudioPlant *plant, StudioBatch *batch) {
    float reach = reach_of(g_array_index(plant->shapes, StudioShape, batch->shape).fine);
    double sum = 0;
    for (uint32_t i = 0; i < batch->count; i++) {
        const StudioLeaf *leaf = &g_array_index(plant->leaves, StudioLeaf, batch->first + i);
        float far = leaf->scale * reach;
        add(box, (vec3s){{leaf->at[0], leaf->at[1], leaf->at[2]}}, far);
        sum += (double)far;
    }
    batch->reach = (float)(sum / fmax(batch->count, 1));
}

void studio_view_measure(StudioPlant *plant) {
    Box box = {{{INFINITY, INFINITY, INFINITY}}, {{-INFINITY, -INFINITY, -INFINITY}}};
    if (plant->wood != NULL && !plant->is_rational) {
        add_wood(&box, plant->wood);
    }
    if (plant->foliage != NULL) {
        add_vertices(&box, plant->foliage->vertices, plant->foliage->vertex_count);
    }
    for (guint b = 0; b < plant->batches->len; b++) {
        add_leaves(&box, plant, &g_array_index(plant->batches, StudioBatch, b));
    }
    for (guint i = 0; i < plant->points->len; i++) { // the skeleton may be shown alone
        const float *at = g_array_index(plant->points, StudioPoint, i).at;
        add(&box, (vec3s){{at[0], at[1], at[2]}}, 0);
    }
    bool is_there = box.max.x >= box.min.x;
    plant->middle =
        is_there ? glms_vec3_scale(glms_vec3_add(box.min, box.max), 0.5f) : (vec3s){{0, 0, 0}};
    plant->radius = is_there ? 0.5f * glms_vec3_distance(box.min, box.max) : -1;
}
