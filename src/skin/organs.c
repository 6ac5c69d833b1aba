// Places, counts and copies organs.
#include "skin/organs.h"

#include "plant/place.h"
#include "skin/stream.h"

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
        bytes += organs->is_used[i] ? fr_shape_bytes_most(plant, shape, &plan->detail) : 0;
    }
    FrStatus status = fr_limit_check(bytes, context->limits.bytes, "bytes", "shapes of organs",
                                     fr_plant_place(plant), context->diags);
    if (status == FR_OK) {
        fr_parallel_for(context->pool, plant->shapes->len, 8, make_shapes, organs,
                        context->progress);
    }
    return status;
}

// ---- places ------------------------------------------------------------------------------------

enum { MOST_CHUNKS = 64, LEAST_CHUNK = 1024, MOST_SLOTS_OF_CHUNKS = 256 };

// What a chunk of organs makes in one slot; then, where its first piece has its place.
typedef struct Tally {
    uint64_t vertices, indices;
    uint32_t pieces;
    bool is_foliage;
} Tally;

typedef struct Placing {
    FrOrganPlan *organs;
    uint32_t count, grain;
    Tally *tallies; // by chunk, then slot
} Placing;

// Its mesh, NULL if it makes no piece.
static const FrShapeMesh *piece_of(const FrOrganPlan *organs, uint32_t organ) {
    const FrShapeMesh *shape = shape_of(organs, organ);
    return shape != NULL && stays(organs, organ, shape) ? shape : NULL;
}

static void tally_chunks(void *data, size_t begin, size_t end, int worker) {
    const Placing *placing = data;
    const FrOrganPlan *organs = placing->organs;
    (void)worker;
    for (size_t chunk = begin; chunk < end; chunk++) {
        Tally *tallies = &placing->tallies[chunk * organs->plan->slots];
        uint32_t from = (uint32_t)chunk * placing->grain;
        uint32_t to = MIN(from + placing->grain, placing->count);
        for (uint32_t i = from; i < to; i++) {
            const FrShapeMesh *shape = piece_of(organs, i);
            if (shape != NULL) {
                Tally *tally = &tallies[fr_slot(organs->plan->plant->organs.material[i])];
                tally->vertices += shape->vertex_count;
                tally->indices += shape->index_count;
                tally->is_foliage |= shape->is_foliage;
                tally->pieces++;
            }
        }
    }
}

// Turns what each chunk makes into where it begins, slot by slot.
static void sum_tallies(const Placing *placing, uint32_t chunks) {
    FrOrganPlan *organs = placing->organs;
    uint32_t slots = organs->plan->slots;
    for (uint32_t slot = 0; slot < slots; slot++) {
        organs->slot_pieces[slot] = organs->piece_count;
        for (uint32_t chunk = 0; chunk < chunks; chunk++) {
            Tally *tally = &placing->tallies[(size_t)chunk * slots + slot], made = *tally;
            *tally = (Tally){organs->slot_vertices[slot], organs->slot_indices[slot],
                             organs->piece_count, false};
            organs->slot_vertices[slot] += made.vertices;
            organs->slot_indices[slot] += made.indices;
            organs->slot_foliage[slot] |= made.is_foliage;
            organs->piece_count += made.pieces;
        }
    }
    organs->slot_pieces[slots] = organs->piece_count;
}

static void place_chunks(void *data, size_t begin, size_t end, int worker) {
    const Placing *placing = data;
    const FrOrganPlan *organs = placing->organs;
    (void)worker;
    for (size_t chunk = begin; chunk < end; chunk++) {
        Tally *tallies = &placing->tallies[chunk * organs->plan->slots];
        uint32_t from = (uint32_t)chunk * placing->grain;
        uint32_t to = MIN(from + placing->grain, placing->count);
        for (uint32_t i = from; i < to; i++) {
            const FrShapeMesh *shape = piece_of(organs, i);
            if (shape != NULL) {
                Tally *at = &tallies[fr_slot(organs->plan->plant->organs.material[i])];
                // Beyond 32 bits the mesh is refused before it is written.
                organs->pieces[at->pieces++] =
                    (FrOrganPiece){i, (uint32_t)at->vertices, at->indices};
                at->vertices += shape->vertex_count;
                at->indices += shape->index_count;
            }
        }
    }
}

// Gives every organ that is drawn its place in its part.
static void place_organs(FrOrganPlan *organs, uint32_t count) {
    uint32_t slots = organs->plan->slots;
    uint32_t wanted = slots <= MOST_SLOTS_OF_CHUNKS ? MOST_CHUNKS : 1;
    Placing placing = {
        .organs = organs, .count = count, .grain = MAX(count / wanted + 1, LEAST_CHUNK)};
    uint32_t chunks = (count - 1) / placing.grain + 1;
    FrPool *pool = organs->plan->context->pool;
    placing.tallies = g_new0(Tally, (size_t)chunks * slots);
    fr_parallel_for(pool, chunks, 1, tally_chunks, &placing, NULL);
    sum_tallies(&placing, chunks);
    organs->pieces = g_atomic_rc_box_alloc(MAX(organs->piece_count, 1) * sizeof *organs->pieces);
    fr_parallel_for(pool, chunks, 1, place_chunks, &placing, NULL);
    g_free(placing.tallies);
}

// Whether organs of the same rows have the places that they have in another plan.
static bool can_share(const FrOrganPlan *organs, const FrOrganPlan *other) {
    bool is_same = other->shape_count == organs->shape_count && other->staying >= 1.0 &&
                   organs->staying >= 1.0 && other->pieces != NULL;
    for (uint32_t i = 0; i < organs->shape_count && is_same; i++) {
        const FrShapeMesh *a = &organs->shapes[i], *b = &other->shapes[i];
        is_same = a->vertex_count == b->vertex_count && a->index_count == b->index_count &&
                  a->is_foliage == b->is_foliage;
    }
    return is_same;
}

static void share_pieces(FrOrganPlan *organs, const FrOrganPlan *other) {
    size_t slots = organs->plan->slots;
    organs->pieces = g_atomic_rc_box_acquire(other->pieces);
    organs->piece_count = other->piece_count;
    organs->shares_pieces = true;
    memcpy(organs->slot_pieces, other->slot_pieces, (slots + 1) * sizeof *organs->slot_pieces);
    memcpy(organs->slot_vertices, other->slot_vertices, slots * sizeof *organs->slot_vertices);
    memcpy(organs->slot_indices, other->slot_indices, slots * sizeof *organs->slot_indices);
    memcpy(organs->slot_foliage, other->slot_foliage, slots * sizeof *organs->slot_foliage);
}

// The middle of what is shaded as a crown, summed in the order of organs.
static void find_crown(FrOrganPlan *organs) {
    double sum[3] = {0}, count = 0;
    bool has_crown = false;
    for (uint32_t i = 0; i < organs->shape_count; i++) {
        has_crown |= organs->shapes[i].is_crown;
    }
    for (uint32_t i = 0; has_crown && i < organs->plan->plant->organs.count; i++) {
        const FrShapeMesh *shape = shape_of(organs, i);
        if (shape != NULL && shape->is_crown) {
            vec3s at;
            versors rotation;
            fr_plant_organ_pose(organs->plan->plant, i, &at, &rotation);
            for (int k = 0; k < 3; k++) {
                sum[k] += (double)at.raw[k];
            }
            count++;
        }
    }
    for (int k = 0; k < 3 && count > 0; k++) {
        organs->crown.raw[k] = (float)(sum[k] / count);
    }
}

FrStatus fr_organs_init(FrOrganPlan *organs, const FrPlan *plan, const FrOrganPlan *same) {
    const FrPlant *plant = plan->plant;
    uint32_t count = plan->detail.foliage ? plant->organs.count : 0;
    *organs = (FrOrganPlan){
        .plan = plan,
        .shapes = g_new0(FrShapeMesh, plant->shapes->len + 1),
        .shape_count = plant->shapes->len,
        .is_used = g_new0(bool, plant->shapes->len + 1),
        .slot_pieces = g_new0(uint32_t, plan->slots + 1),
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
        find_crown(organs);
        if (same != NULL && can_share(organs, same)) {
            share_pieces(organs, same);
        } else {
            place_organs(organs, count);
        }
    }
    return status;
}

void fr_organs_clear(FrOrganPlan *organs) {
    for (uint32_t i = 0; i < organs->shape_count; i++) {
        fr_shape_mesh_clear(&organs->shapes[i]);
    }
    g_free(organs->shapes);
    g_free(organs->is_used);
    g_clear_pointer(&organs->pieces, g_atomic_rc_box_release);
    g_free(organs->slot_pieces);
    g_free(organs->slot_vertices);
    g_free(organs->slot_indices);
    g_free(organs->slot_foliage);
    g_free(organs->groups);
}

// ---- copies ------------------------------------------------------------------------------------

float fr_piece_enlarged(const FrOrganPlan *organs, uint32_t piece) {
    uint32_t organ = organs->pieces[piece].organ;
    bool is_leaf = organs->shapes[organs->plan->plant->organs.shape[organ]].is_foliage;
    return organs->staying < 1.0 && is_leaf ? group_of(organs, organ)->enlarged : 1.0F;
}

FrOrganPose fr_piece_pose(const FrOrganPlan *organs, uint32_t piece) {
    const FrPlant *plant = organs->plan->plant;
    uint32_t organ = organs->pieces[piece].organ;
    FrOrganPose pose;
    fr_plant_organ_pose(plant, organ, &pose.at, &pose.rotation);
    pose.scale = plant->organs.scale[organ] * fr_piece_enlarged(organs, piece);
    return pose;
}

// Columns of the rotation, and the place.
typedef struct Matrix {
    FrFour x, y, z, at;
} Matrix;

static FrFour four_of(vec3s v, FrUpAxis up) {
    v = fr_upright(v, up);
    return (FrFour){v.x, v.y, v.z, 0.0F};
}

static Matrix matrix_of(FrOrganPose pose, FrUpAxis up) {
    versors q = pose.rotation;
    float xx = q.x * q.x, yy = q.y * q.y, zz = q.z * q.z, xy = q.x * q.y, xz = q.x * q.z;
    float yz = q.y * q.z, wx = q.w * q.x, wy = q.w * q.y, wz = q.w * q.z;
    vec3s x = {{1.0F - 2.0F * (yy + zz), 2.0F * (xy + wz), 2.0F * (xz - wy)}};
    vec3s y = {{2.0F * (xy - wz), 1.0F - 2.0F * (xx + zz), 2.0F * (yz + wx)}};
    vec3s z = {{2.0F * (xz + wy), 2.0F * (yz - wx), 1.0F - 2.0F * (xx + yy)}};
    return (Matrix){four_of(x, up), four_of(y, up), four_of(z, up), four_of(pose.at, up)};
}

static void copy_vertices(const FrShapeMesh *shape, const Matrix *matrix, float scale,
                          FrVertex *out, bool is_streamed, FrBox *box) {
    FrFour x = matrix->x, y = matrix->y, z = matrix->z;
    FrFour low = {INFINITY, INFINITY, INFINITY, INFINITY}, high = -low;
    for (uint32_t i = 0; i < shape->vertex_count; i++) {
        const FrVertex *in = &shape->vertices[i];
        const float *p = in->position, *n = in->normal;
        FrFour at = matrix->at + scale * (p[0] * x + p[1] * y + p[2] * z);
        FrFour normal = n[0] * x + n[1] * y + n[2] * z;
        low = fr_four_min(at, low);
        high = fr_four_max(at, high);
        at[3] = normal[0];
        fr_four_store(out[i].position, at, is_streamed);
        fr_four_store(out[i].normal + 1, (FrFour){normal[1], normal[2], in->uv[0], in->uv[1]},
                      is_streamed);
    }
    memcpy(box->min, &low, sizeof box->min);
    memcpy(box->max, &high, sizeof box->max);
}

// Normals away from the middle of the crown.
static void turn_away(const FrOrganPlan *organs, FrVertex *vertices, uint32_t count, FrUpAxis up) {
    vec3s middle = fr_upright(organs->crown, up);
    for (uint32_t i = 0; i < count; i++) {
        vec3s at;
        memcpy(at.raw, vertices[i].position, sizeof at.raw);
        vec3s out = glms_vec3_sub(at, middle);
        float length = glms_vec3_norm(out);
        if (length > 1e-6F) {
            memcpy(vertices[i].normal, glms_vec3_scale(out, 1.0F / length).raw, sizeof out.raw);
        }
    }
}

void fr_write_piece(const FrOrganPlan *organs, uint32_t piece, FrUpAxis up, const FrSlab *slab,
                    unsigned writing, FrBox *box, FrDeformNote *notes) {
    const FrPlant *plant = organs->plan->plant;
    FrOrganPiece place = organs->pieces[piece];
    const FrShapeMesh *shape = &organs->shapes[plant->organs.shape[place.organ]];
    FrVertex *out = slab->vertices + place.vertex;
    uint32_t *index = slab->indices + place.index;
    uint32_t scope = fr_plan_scope(organs->plan, plant->organs.deformer[place.organ]);
    if ((writing & FR_WRITE_INDICES) != 0) {
        for (uint32_t i = 0; i < shape->index_count; i++) {
            index[i] = place.vertex + shape->indices[i];
        }
    }
    if ((writing & FR_WRITE_VERTICES) != 0) {
        FrOrganPose pose = fr_piece_pose(organs, piece);
        Matrix matrix = matrix_of(pose, up);
        bool is_read = scope != FR_NONE || shape->is_crown;
        bool is_streamed = (writing & FR_WRITE_STREAM) != 0 && !is_read;
        copy_vertices(shape, &matrix, pose.scale, out, is_streamed, box);
        if (shape->is_crown) {
            turn_away(organs, out, shape->vertex_count, up);
        }
    }
    if (scope != FR_NONE) {
        fr_deform_vertices(organs->plan, scope, up, out, shape->vertex_count, index,
                           shape->index_count, notes);
        *box = fr_box_empty();
        fr_box_widen(box, out, shape->vertex_count);
    }
}
