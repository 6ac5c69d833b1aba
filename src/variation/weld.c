// From bare lines to a plant: ends that coincide become joints, joints and lines a tree.
#include "frond/variation.h"

#include <cglm/struct.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define TOLERANCE 1e-5 // of the height
#define HANGING 0.1f   // … above the lowest end
#define FINEST 1e-8    // of the extent: what a float still tells apart

/// A cell of the grid that finds near ends.
typedef struct Cell {
    int64_t at[3];
} Cell;

typedef struct Weld {
    const FrSegment *segments;
    size_t count;
    double tolerance;
    vec3s *at;       ///< position of every joint
    uint32_t *joint; ///< of end e of segment s: joint[2 s + e]
    uint32_t *first; ///< of every joint: where its segments begin in `touching`; joints + 1
    uint32_t *touching;
    uint8_t *is_reached; ///< joints
    uint8_t *is_used;    ///< segments
    uint32_t joints;
    uint64_t loops, points;
    uint64_t parts;   ///< stems that begin on no other
    uint64_t hanging; ///< … high above the lowest
    vec3s first_hanging;
} Weld;

/// An axis to grow: it begins with a segment at a joint.
typedef struct Start {
    uint32_t segment, from; ///< from: a joint
    uint32_t bearer;        ///< node
    FrKey path;
} Start;

static guint cell_hash(gconstpointer data) {
    const Cell *cell = data;
    FrKey key = 0;
    for (int k = 0; k < 3; k++) {
        key = fr_key_child(key, (uint64_t)cell->at[k]);
    }
    return (guint)key;
}

static gboolean cell_equal(gconstpointer a, gconstpointer b) {
    return memcmp(a, b, sizeof(Cell)) == 0;
}

/// The joint within the tolerance of a point, looked for in its cell and the 26 around; FR_NONE.
/// `next` chains the joints of a cell.
static uint32_t find_joint(const Weld *weld, GHashTable *cells, const uint32_t *next, Cell centre,
                           vec3s point) {
    for (int n = 0; n < 27; n++) {
        Cell cell = {
            {centre.at[0] + n % 3 - 1, centre.at[1] + n / 3 % 3 - 1, centre.at[2] + n / 9 - 1}};
        uint32_t joint = GPOINTER_TO_UINT(g_hash_table_lookup(cells, &cell));
        for (; joint != 0; joint = next[joint - 1]) {
            if ((double)glms_vec3_distance(weld->at[joint - 1], point) <= weld->tolerance) {
                return joint - 1;
            }
        }
    }
    return FR_NONE;
}

static void weld_ends(Weld *weld) {
    GHashTable *cells = g_hash_table_new_full(cell_hash, cell_equal, g_free, NULL);
    uint32_t *next = g_new0(uint32_t, 2 * weld->count + 1);
    double size = 2 * weld->tolerance;
    for (size_t e = 0; e < 2 * weld->count; e++) {
        vec3s point = e % 2 == 0 ? weld->segments[e / 2].from : weld->segments[e / 2].to;
        Cell cell = {{(int64_t)floor((double)point.x / size),
                      (int64_t)floor((double)point.y / size),
                      (int64_t)floor((double)point.z / size)}};
        uint32_t joint = find_joint(weld, cells, next, cell, point);
        if (joint == FR_NONE) {
            joint = weld->joints++;
            weld->at[joint] = point;
            next[joint] = GPOINTER_TO_UINT(g_hash_table_lookup(cells, &cell));
            g_hash_table_replace(cells, g_memdup2(&cell, sizeof cell), GUINT_TO_POINTER(joint + 1));
        }
        weld->joint[e] = joint;
    }
    g_hash_table_unref(cells);
    g_free(next);
}

/// Lists the segments at every joint.
static void list_segments(Weld *weld) {
    for (size_t e = 0; e < 2 * weld->count; e++) {
        weld->first[weld->joint[e] + 1]++;
    }
    for (uint32_t j = 0; j < weld->joints; j++) {
        weld->first[j + 1] += weld->first[j];
    }
    uint32_t *filled = g_memdup2(weld->first, (weld->joints + 1) * sizeof *weld->first);
    for (size_t e = 0; e < 2 * weld->count; e++) {
        weld->touching[filled[weld->joint[e]]++] = (uint32_t)(e / 2);
    }
    g_free(filled);
}

static uint32_t other_end(const Weld *weld, uint32_t segment, uint32_t joint) {
    uint32_t from = weld->joint[2 * segment];
    return from == joint ? weld->joint[2 * segment + 1] : from;
}

/// Takes the segments that lead on from a joint to new ones into `leading`.
static void lead_on(Weld *weld, uint32_t joint, GArray *leading) {
    g_array_set_size(leading, 0);
    for (uint32_t t = weld->first[joint]; t < weld->first[joint + 1]; t++) {
        uint32_t segment = weld->touching[t];
        if (weld->is_used[segment] != 0) {
            continue;
        }
        uint32_t to = other_end(weld, segment, joint);
        weld->is_used[segment] = 1;
        if (to == joint) {
            weld->points++;
        } else if (weld->is_reached[to] != 0) {
            weld->loops++;
        } else {
            weld->is_reached[to] = 1;
            g_array_append_val(leading, segment);
        }
    }
}

static vec3s direction(const Weld *weld, uint32_t segment, uint32_t from) {
    return glms_vec3_normalize(
        glms_vec3_sub(weld->at[other_end(weld, segment, from)], weld->at[from]));
}

/// Where in `leading` the segment is along which the axis goes on.
static guint choose(const Weld *weld, const GArray *leading, uint32_t joint, vec3s heading) {
    guint best = 0;
    float best_radius = -1, best_along = -2;
    for (guint i = 0; i < leading->len; i++) {
        uint32_t segment = g_array_index(leading, uint32_t, i);
        float radius = weld->segments[segment].radius;
        float along = glms_vec3_dot(direction(weld, segment, joint), heading);
        if (radius > best_radius || (radius >= best_radius && along > best_along)) {
            best = i;
            best_radius = radius;
            best_along = along;
        }
    }
    return best;
}

static uint32_t add_internode(FrPlant *plant, const Weld *weld, uint32_t axis, uint32_t segment,
                              uint32_t from, uint32_t last) {
    versors frame = last == FR_NONE ? GLMS_QUAT_IDENTITY : plant->nodes.frame[last];
    vec3s heading = direction(weld, segment, from);
    vec3s local = glms_quat_rotatev(glms_quat_conjugate(frame), heading);
    versors turn = fr_rotation_between((vec3s){{0, 0, 1}}, glms_vec3_normalize(local));
    float length = glms_vec3_distance(weld->at[from], weld->at[other_end(weld, segment, from)]);
    return fr_plant_add_node(plant, axis, turn, length, weld->segments[segment].radius);
}

/// Grows an axis to its end; branches on the way are added to `starts`.
static void grow_axis(FrPlant *plant, Weld *weld, Start start, GArray *starts, GArray *leading) {
    vec3s offset = start.bearer == FR_NONE ? weld->at[start.from] : (vec3s){{0, 0, 0}};
    uint32_t axis =
        fr_plant_add_axis(plant, start.bearer, offset, weld->segments[start.segment].radius);
    plant->axes.path[axis] = start.path;
    plant->axes.component[axis] = plant->axes.order[axis] > 0;
    uint32_t joint = start.from, segment = start.segment, node = start.bearer;
    for (uint32_t along = 0;; along++) {
        node = add_internode(plant, weld, axis, segment, joint, node);
        joint = other_end(weld, segment, joint);
        lead_on(weld, joint, leading);
        if (leading->len == 0) {
            return;
        }
        guint on = choose(weld, leading, joint, fr_frame_heading(plant->nodes.frame[node]));
        segment = g_array_index(leading, uint32_t, on);
        FrKey here = fr_key_child(start.path, along);
        for (guint i = 0; i < leading->len; i++) {
            if (i != on) {
                Start branch = {g_array_index(leading, uint32_t, i), joint, node,
                                fr_key_child(here, i)};
                g_array_append_val(starts, branch);
            }
        }
    }
}

static void grow_from(FrPlant *plant, Weld *weld, uint32_t root, FrKey path, GArray *starts,
                      GArray *leading) {
    weld->is_reached[root] = 1;
    lead_on(weld, root, leading);
    g_array_set_size(starts, 0);
    for (guint i = 0; i < leading->len; i++) {
        Start start = {g_array_index(leading, uint32_t, i), root, FR_NONE, fr_key_child(path, i)};
        g_array_append_val(starts, start);
    }
    for (guint i = 0; i < starts->len; i++) {
        grow_axis(plant, weld, g_array_index(starts, Start, i), starts, leading);
    }
}

static int compare_height(const void *a, const void *b, void *user) {
    const vec3s *at = user;
    uint32_t one = *(const uint32_t *)a, other = *(const uint32_t *)b;
    if (at[one].z < at[other].z || at[one].z > at[other].z) {
        return at[one].z < at[other].z ? -1 : 1;
    }
    return (one > other) - (one < other);
}

// A stem begins at joint `order[j]`. Stems that stand side by side begin near the lowest.
static void note_part(Weld *weld, const uint32_t *order, uint32_t j) {
    float low = weld->at[order[0]].z, high = weld->at[order[weld->joints - 1]].z;
    weld->parts++;
    if (weld->at[order[j]].z > low + HANGING * (high - low)) {
        weld->first_hanging = weld->hanging++ == 0 ? weld->at[order[j]] : weld->first_hanging;
    }
}

static void grow_all(FrPlant *plant, Weld *weld) {
    uint32_t *order = g_new(uint32_t, weld->joints + 1);
    for (uint32_t j = 0; j < weld->joints; j++) {
        order[j] = j;
    }
    g_qsort_with_data(order, (gint)weld->joints, sizeof *order, compare_height, weld->at);
    GArray *starts = g_array_new(FALSE, FALSE, sizeof(Start));
    GArray *leading = g_array_new(FALSE, FALSE, sizeof(uint32_t));
    for (uint32_t j = 0; j < weld->joints; j++) {
        if (weld->is_reached[order[j]] == 0) {
            uint32_t before = plant->axes.count;
            grow_from(plant, weld, order[j], fr_key_child(fr_key_root(0), j), starts, leading);
            if (plant->axes.count > before) {
                note_part(weld, order, j);
            }
        }
    }
    g_array_unref(starts);
    g_array_unref(leading);
    g_free(order);
}

static bool is_sound(const FrSegment *segment) {
    for (int k = 0; k < 3; k++) {
        if (!(fabsf(segment->from.raw[k]) <= 1e9f) || !(fabsf(segment->to.raw[k]) <= 1e9f)) {
            return false;
        }
    }
    return segment->radius >= 0 && segment->radius <= 1e9f;
}

/// The tolerance in metres; negative if a segment is not sound.
static double measure(const FrSegment *segments, size_t count, double tolerance) {
    vec3s min = {{INFINITY, INFINITY, INFINITY}}, max = {{-INFINITY, -INFINITY, -INFINITY}};
    for (size_t s = 0; s < count; s++) {
        if (!is_sound(&segments[s])) {
            return -1;
        }
        min = glms_vec3_minv(min, glms_vec3_minv(segments[s].from, segments[s].to));
        max = glms_vec3_maxv(max, glms_vec3_maxv(segments[s].from, segments[s].to));
    }
    double height = count > 0 ? (double)(max.z - min.z) : 0, farthest = 1e-30;
    for (int k = 0; k < 3 && count > 0; k++) {
        farthest = fmax(farthest, fmax(fabs((double)min.raw[k]), fabs((double)max.raw[k])));
    }
    return fmax(tolerance >= 0 ? tolerance : TOLERANCE * height, FINEST * farthest);
}

static void warn(const Weld *weld, FrSpan span, FrDiags *diags) {
    if (weld->loops > 0) {
        fr_diags_add(diags, FR_WARNING, "skeleton-loop", span,
                     "%" G_GUINT64_FORMAT " lines that close a loop are left out", weld->loops);
    }
    if (weld->points > 0) {
        fr_diags_add(diags, FR_WARNING, "skeleton-point", span,
                     "%" G_GUINT64_FORMAT " lines without a length are left out", weld->points);
    }
    if (weld->hanging > 0) {
        fr_diags_add(diags, FR_WARNING, "skeleton-apart", span,
                     "%" G_GUINT64_FORMAT " of %" G_GUINT64_FORMAT
                     " stems hang in the air, connected with no other, the lowest from (%.4g, "
                     "%.4g, %.4g) on; a larger tolerance may join them",
                     weld->hanging, weld->parts, (double)weld->first_hanging.x,
                     (double)weld->first_hanging.y, (double)weld->first_hanging.z);
    }
}

static int compare_points(vec3s a, vec3s b) {
    for (int k = 2; k >= 0; k--) {
        if (a.raw[k] < b.raw[k] || a.raw[k] > b.raw[k]) {
            return a.raw[k] < b.raw[k] ? -1 : 1;
        }
    }
    return 0;
}

static int compare_segments(const void *a, const void *b) {
    const FrSegment *one = a, *other = b;
    int order = compare_points(one->from, other->from);
    order = order != 0 ? order : compare_points(one->to, other->to);
    return order != 0 ? order : (one->radius > other->radius) - (one->radius < other->radius);
}

/// The lines from the lowest upwards, each from its lower end: the plant must not depend on the
/// order and the direction in which they were written. Free with g_free().
static FrSegment *in_order(const FrSegment *segments, size_t count) {
    FrSegment *sorted = g_new(FrSegment, count + 1);
    for (size_t s = 0; s < count; s++) {
        sorted[s] = segments[s];
        if (compare_points(sorted[s].to, sorted[s].from) < 0) {
            sorted[s].from = segments[s].to;
            sorted[s].to = segments[s].from;
        }
    }
    if (count > 1) {
        qsort(sorted, count, sizeof *sorted, compare_segments);
    }
    return sorted;
}

FrStatus fr_skeleton_weld(const FrSegment *segments, size_t count, double tolerance,
                          const char *name, FrSpan span, const FrContext *context,
                          FrPlant **plant) {
    *plant = NULL;
    FrStatus status = fr_limit_check(count, MIN(context->limits.nodes, G_MAXINT / 2), "nodes",
                                     "the skeleton", span, context->diags);
    if (status != FR_OK) {
        return status;
    }
    Weld weld = {segments, count, measure(segments, count, tolerance)};
    if (weld.tolerance < 0) {
        fr_diags_add(context->diags, FR_ERROR, "bad-skeleton", span,
                     "a line of the skeleton has no finite ends or no radius");
        return FR_ERR_DOCUMENT;
    }
    FrSegment *sorted = in_order(segments, count);
    weld.segments = sorted;
    weld.at = g_new(vec3s, 2 * count + 1);
    weld.joint = g_new(uint32_t, 2 * count + 1);
    weld.first = g_new0(uint32_t, 2 * count + 2);
    weld.touching = g_new(uint32_t, 2 * count + 1);
    weld.is_reached = g_new0(uint8_t, 2 * count + 1);
    weld.is_used = g_new0(uint8_t, count + 1);
    weld_ends(&weld);
    list_segments(&weld);
    *plant = fr_plant_new(name);
    fr_plant_add_component(*plant, "stem", (FrSpan){0});
    fr_plant_add_component(*plant, "branch", (FrSpan){0});
    grow_all(*plant, &weld);
    warn(&weld, span, context->diags);
    g_free(sorted);
    g_free(weld.at);
    g_free(weld.joint);
    g_free(weld.first);
    g_free(weld.touching);
    g_free(weld.is_reached);
    g_free(weld.is_used);
    return FR_OK;
}
