/// What is drawn of a store: what is seen, and of that as much as there is time for.
///
/// While the view moves, each plant gets a part of the triangles by its area in the picture. Leaves
/// are left out at random and the others enlarged, so that a crown covers as much as it does whole:
/// stochastic simplification of aggregate detail, Cook et al., SIGGRAPH 2007.
#include "studio/view/store_private.h"

#include "frond/random.h"

#include <math.h>
#include <string.h>

static const double most_enlarged = 3;    // larger ones look like another plant
static const double least_enlarged = 1.3; // the limit for leaves as large as their plant, as grass
static const double wood_part = 0.3;      // of the triangles
static const double still_part = 0.15;    // that obstacles may have, to be fine

// A plant that is seen.
typedef struct Seen {
    const Stand *stand;
    const Plant *plant;
    uint32_t number;    // of the stand
    double area;        // in the picture, in no unit
    double away;        // m, of its nearest point
    double leaves;      // triangles of all its coarse leaves, …
    double allowed;     // … and of those that are drawn
    const GArray *wood; // Part
} Seen;

// ---- pieces ------------------------------------------------------------------------------------

static void dress(const StudioStore *store, const Plant *plant, uint32_t material,
                  StudioPiece *piece) {
    if (material >= plant->looks->len) { // of no material: as pictures show it
        piece->look = piece->is_blade
                          ? (StudioDress){.tint = {0.12f, 0.25f, 0.05f},
                                          .roughness = 0.5f,
                                          .translucency = 0.45f}
                          : (StudioDress){.tint = {0.22f, 0.17f, 0.12f}, .roughness = 0.9f};
        return;
    }
    const Look *look = &g_array_index(plant->looks, Look, material);
    piece->picture = studio_pictures_find(store->pictures, look->digest, FR_MAP_COLOUR);
    piece->bumps = studio_pictures_find(store->pictures, look->digest, FR_MAP_NORMAL);
    piece->gloss = studio_pictures_find(store->pictures, look->digest, FR_MAP_ROUGHNESS);
    piece->look = look->dress;
    if (piece->picture != 0) {
        memcpy(piece->look.tint, look->picture_tint, sizeof piece->look.tint);
    }
}

static StudioPiece piece_of(const StudioStore *store, const Stand *stand, const Plant *plant,
                            const Part *part, uint32_t material) {
    StudioPiece piece = {.model = stand->model,
                         .vertices = part->vertices,
                         .indices = part->indices,
                         .index_count = part->index_count,
                         .enlarge = 1,
                         .is_blade = part->is_blade,
                         .is_still = stand->is_still,
                         .triangles = part->index_count / 3};
    dress(store, plant, material, &piece);
    return piece;
}

static void list_parts(const StudioStore *store, const Stand *stand, const Plant *plant,
                       const GArray *parts, uint64_t most, GArray *list) {
    for (guint i = 0; i < parts->len; i++) {
        const Part *part = &g_array_index(parts, Part, i);
        StudioPiece piece = piece_of(store, stand, plant, part, part->material);
        for (uint64_t first = 0; first < part->index_count; first += 3 * most) {
            piece.first_index = first;
            piece.index_count = MIN(3 * most, part->index_count - first);
            piece.triangles = piece.index_count / 3;
            g_array_append_val(list, piece);
        }
    }
}

// How much larger leaves are of which one in so many is drawn; those that nearly are the plant
// would make another one of it.
static float enlarged(const Plant *plant, const StudioBatch *batch, double part) {
    double most = 0.35 * (double)plant->radius / fmax((double)batch->reach, 1e-9);
    return (float)fmin(sqrt(1 / part), CLAMP(most, least_enlarged, most_enlarged));
}

// So many of a batch, in pieces of at most `most` triangles.
static void list_batch(const StudioStore *store, const Seen *seen, const StudioBatch *batch,
                       const Part *shape, double part, uint64_t most, GArray *list) {
    uint64_t each = shape->index_count / 3;
    double chance = fr_random(fr_key_child(seen->number, batch->first), 0, 0);
    uint64_t wanted = MIN(batch->count, (uint64_t)(part * batch->count + chance));
    if (each == 0 || wanted == 0) {
        return;
    }
    StudioPiece piece = piece_of(store, seen->stand, seen->plant, shape, batch->material);
    piece.leaves = seen->plant->leaves;
    piece.enlarge = enlarged(seen->plant, batch, part);
    uint64_t step = MAX(1, most / each);
    for (uint64_t first = 0; first < wanted; first += step) {
        piece.first_leaf = batch->first + first;
        piece.leaf_count = MIN(step, wanted - first);
        piece.triangles = piece.leaf_count * each;
        g_array_append_val(list, piece);
    }
}

static void list_leaves(const StudioStore *store, const Seen *seen, bool is_coarse, uint64_t most,
                        GArray *list) {
    double part = seen->leaves > 0 ? fmin(1, seen->allowed / seen->leaves) : 1;
    for (guint b = 0; part > 0 && b < seen->plant->batches->len; b++) {
        const StudioBatch *batch = &g_array_index(seen->plant->batches, StudioBatch, b);
        const Part *shape =
            &g_array_index(seen->plant->shapes, Part, 2 * batch->shape + (is_coarse ? 1 : 0));
        list_batch(store, seen, batch, shape, part, most, list);
    }
}

static void list_plant(const StudioStore *store, const Seen *seen, bool is_coarse, uint64_t most,
                       GArray *list) {
    list_parts(store, seen->stand, seen->plant, seen->wood, most, list);
    list_parts(store, seen->stand, seen->plant, seen->plant->foliage, most, list);
    list_leaves(store, seen, is_coarse, most, list);
}

// ---- what is seen ------------------------------------------------------------------------------

// Whether a ball is outside of the picture: behind one of its four sides, or behind the camera.
static bool is_outside(const StudioOutlook *outlook, vec3s at, float radius) {
    const mat4s *clip = &outlook->clip;
    for (int side = 0; side < 5; side++) {
        vec4s plane;
        for (int k = 0; k < 4; k++) {
            float w = clip->raw[k][3], other = side == 4 ? 0 : clip->raw[k][side / 2];
            plane.raw[k] = side % 2 == 0 ? w + other : w - other;
        }
        vec3s normal = {{plane.x, plane.y, plane.z}};
        if (glms_vec3_dot(normal, at) + plane.w < -radius * glms_vec3_norm(normal)) {
            return true;
        }
    }
    return false;
}

static double coarse_leaves_of(const Plant *plant) {
    double sum = 0;
    for (guint b = 0; b < plant->batches->len; b++) {
        const StudioBatch *batch = &g_array_index(plant->batches, StudioBatch, b);
        uint64_t indices = g_array_index(plant->shapes, Part, 2 * batch->shape + 1).index_count;
        sum += (double)batch->count * (double)(indices / 3);
    }
    return sum;
}

static int compare_distance(gconstpointer a, gconstpointer b) {
    double first = ((const Seen *)a)->away, second = ((const Seen *)b)->away;
    return first < second ? -1 : first > second ? 1 : 0;
}

// Seen, the nearest first, as what they hide need not be shaded. Without an outlook all, by size.
static GArray *look(const StudioStore *store, const StudioOutlook *outlook) {
    GArray *list = g_array_new(FALSE, FALSE, sizeof(Seen));
    for (guint i = 0; i < store->stands->len; i++) {
        const Stand *stand = &g_array_index(store->stands, Stand, i);
        Seen seen = {.stand = stand, .plant = studio_store_plant(store, stand), .number = i};
        float scale = glms_vec3_norm(glms_vec3(stand->model.col[0]));
        float radius = scale * seen.plant->radius * (outlook == NULL ? 1 : 1 + outlook->slack);
        vec3s at = glms_mat4_mulv3(stand->model, seen.plant->middle, 1);
        if (seen.plant->radius < 0 || (outlook != NULL && is_outside(outlook, at, radius))) {
            continue;
        }
        double size = (double)radius;
        if (outlook != NULL) {
            vec3s eye = {{outlook->eye[0], outlook->eye[1], outlook->eye[2]}};
            double distance = (double)glms_vec3_distance(at, eye);
            seen.away = distance - size;
            size = fmin(size / fmax(distance, 1e-9), 1);
        }
        seen.area = size * size;
        seen.wood = seen.plant->wood;
        seen.leaves = seen.allowed = coarse_leaves_of(seen.plant);
        g_array_append_val(list, seen);
    }
    g_array_sort(list, compare_distance);
    return list;
}

static uint64_t triangles_of(const GArray *parts) {
    uint64_t sum = 0;
    for (guint i = 0; i < parts->len; i++) {
        sum += g_array_index(parts, Part, i).index_count / 3;
    }
    return sum;
}

// The finest wood of at most so many triangles; else the coarsest there is.
static const GArray *wood_of(const Plant *plant, double most) {
    const GArray *wood = plant->wood;
    for (int level = 0; level < STUDIO_COARSE_LEVELS && (double)triangles_of(wood) > most;
         level++) {
        wood = plant->coarse[level]->len > 0 ? plant->coarse[level] : wood;
    }
    return wood;
}

// Chooses the wood of all; what it has of triangles.
static double choose_wood(GArray *list, double most) {
    double areas = 0, sum = 0;
    for (guint i = 0; i < list->len; i++) {
        const Seen *seen = &g_array_index(list, Seen, i);
        areas += seen->plant->wood->len > 0 ? seen->area : 0;
    }
    for (guint i = 0; i < list->len; i++) {
        Seen *seen = &g_array_index(list, Seen, i);
        seen->wood = wood_of(seen->plant, most * seen->area / fmax(areas, 1e-12));
        sum += (double)triangles_of(seen->wood);
    }
    return sum;
}

// Triangles of leaves go by area, but no plant has more than it needs: what is left over goes to
// the others. Obstacles stay whole.
static void share_leaves(GArray *list, double most) {
    double rate = 0, before = -1;
    while (rate > before) {
        double left = most, areas = 0;
        for (guint i = 0; i < list->len; i++) {
            const Seen *seen = &g_array_index(list, Seen, i);
            bool is_whole = seen->stand->is_still || rate * seen->area >= seen->leaves;
            left -= is_whole ? seen->leaves : 0;
            areas += is_whole ? 0 : seen->area;
        }
        before = rate;
        rate = areas > 0 ? fmax(rate, left / areas) : rate;
    }
    for (guint i = 0; i < list->len; i++) {
        Seen *seen = &g_array_index(list, Seen, i);
        seen->allowed = seen->stand->is_still ? seen->leaves : rate * seen->area;
    }
}

// Triangles of the fine leaves of all, or of obstacles.
static double fine_leaves(const GArray *list, bool is_still_only) {
    double sum = 0;
    for (guint i = 0; i < list->len; i++) {
        const Seen *seen = &g_array_index(list, Seen, i);
        bool counts = !is_still_only || seen->stand->is_still;
        sum += counts ? (double)seen->plant->leaf_triangles : 0;
    }
    return sum;
}

// ---- lists -------------------------------------------------------------------------------------

// Puts what is clear behind all else, the farthest first: it is drawn over what is seen through it.
static GArray *with_clear_last(GArray *list) {
    GArray *sorted = g_array_sized_new(FALSE, FALSE, sizeof(StudioPiece), list->len);
    for (guint i = 0; i < list->len; i++) {
        const StudioPiece *piece = &g_array_index(list, StudioPiece, i);
        if (piece->look.clear <= 0) {
            g_array_append_vals(sorted, piece, 1);
        }
    }
    for (guint i = list->len; i > 0 && sorted->len < list->len; i--) {
        const StudioPiece *piece = &g_array_index(list, StudioPiece, i - 1);
        if (piece->look.clear > 0) {
            g_array_append_vals(sorted, piece, 1);
        }
    }
    g_array_unref(list);
    return sorted;
}

static GArray *new_list(void) {
    return g_array_new(FALSE, FALSE, sizeof(StudioPiece));
}

GArray *studio_store_list_fine(const StudioStore *store, const StudioOutlook *outlook,
                               uint64_t most) {
    GArray *list = new_list(), *seen = look(store, outlook);
    for (guint i = 0; i < seen->len; i++) {
        list_plant(store, &g_array_index(seen, Seen, i), false, most, list);
    }
    g_array_unref(seen);
    return with_clear_last(list);
}

GArray *studio_store_list_coarse(const StudioStore *store, const StudioOutlook *outlook,
                                 uint64_t budget, uint64_t most) {
    GArray *list = new_list(), *seen = look(store, outlook);
    double all = (double)budget, left = all - choose_wood(seen, wood_part * all);
    bool is_all_fine = fine_leaves(seen, false) <= left;
    bool is_still_fine = fine_leaves(seen, true) <= still_part * all;
    share_leaves(seen, fmax(left, (1 - wood_part) * all));
    for (guint i = 0; i < seen->len; i++) {
        const Seen *one = &g_array_index(seen, Seen, i);
        bool is_fine = is_all_fine || (is_still_fine && one->stand->is_still);
        list_plant(store, one, !is_fine, most, list);
    }
    g_array_unref(seen);
    return with_clear_last(list);
}
