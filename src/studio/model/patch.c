#include "studio/model/patch.h"

#include "plant/frames.h"
#include "studio/model/commands.h"
#include "studio/model/values.h"

#include <math.h>
#include <string.h>

static const double near_enough = 11; // pixels

static void footing_clear(gpointer data) {
    g_free(((StudioFooting *)data)->plant);
    g_free(((StudioFooting *)data)->component);
}

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// ---- where it stands ---------------------------------------------------------------------------

static void turn_by_stand(const FrStand *stand, const double from[3], double to[3]) {
    double c = stand->scale * cos(stand->turn), s = stand->scale * sin(stand->turn);
    to[0] = c * from[0] - s * from[1];
    to[1] = s * from[0] + c * from[1];
    to[2] = stand->scale * from[2];
}

static StudioFooting footing_of(const FrPlant *plant, const FrDeformer *deformer,
                                const FrStand *stand) {
    vec3s at = deformer->offset;
    versors turn = deformer->rotation;
    if (deformer->node != FR_NONE) {
        versors frame = plant->nodes.frame[deformer->node];
        at = glms_vec3_add(plant->nodes.position[deformer->node], fr_turned(frame, at));
        turn = fr_frame_step(frame, turn);
    }
    StudioFooting footing = {.plant = NULL};
    for (int k = 0; k < 3; k++) {
        vec3s axis = glms_vec3_zero();
        axis.raw[k] = deformer->scale;
        axis = fr_turned(turn, axis);
        const double along[3] = {(double)axis.x, (double)axis.y, (double)axis.z};
        turn_by_stand(stand, along, footing.axes[k]);
    }
    const double place[3] = {(double)at.x, (double)at.y, (double)at.z};
    turn_by_stand(stand, place, footing.origin);
    for (int k = 0; k < 3; k++) {
        footing.origin[k] += stand->at[k];
    }
    return footing;
}

const StudioFooting *studio_footing_find(const GArray *footings, const char *plant,
                                         const char *component) {
    for (guint i = 0; footings != NULL && i < footings->len; i++) {
        const StudioFooting *footing = &g_array_index(footings, StudioFooting, i);
        if (strcmp(footing->component, component) == 0 && g_strcmp0(footing->plant, plant) == 0) {
            return footing;
        }
    }
    return NULL;
}

static void add_footings(const FrPlant *plant, const FrStand *stand, GArray *footings) {
    for (guint i = 0; i < plant->deformers->len; i++) {
        const FrDeformer *deformer = &g_array_index(plant->deformers, FrDeformer, i);
        uint32_t component =
            g_array_index(plant->deformations, FrDeformation, deformer->deformation).component;
        if (component >= plant->components->len) {
            continue;
        }
        const char *id = g_array_index(plant->components, FrComponent, component).id;
        if (studio_footing_find(footings, plant->name, id) == NULL) {
            StudioFooting footing = footing_of(plant, deformer, stand);
            footing.plant = g_strdup(plant->name);
            footing.component = g_strdup(id);
            g_array_append_val(footings, footing);
        }
    }
}

GArray *studio_footings_of(const FrScene *scene) {
    GArray *footings = g_array_new(FALSE, FALSE, sizeof(StudioFooting));
    g_array_set_clear_func(footings, footing_clear);
    bool *is_done = g_new0(bool, scene->plants->len + 1);
    for (guint i = 0; i < scene->stands->len; i++) {
        const FrStand *stand = &g_array_index(scene->stands, FrStand, i);
        if (!is_done[stand->plant]) {
            is_done[stand->plant] = true;
            add_footings(g_array_index(scene->plants, FrScenePlant, stand->plant).plant, stand,
                         footings);
        }
    }
    g_free(is_done);
    return footings;
}

// ---- reading and writing -----------------------------------------------------------------------

static char *value_of(const StudioDocument *document, uint32_t element, const char *attribute) {
    const FrContents *contents = studio_document_contents(document);
    char *value = fr_contents_get(contents, element, attribute);
    const FrParamTable *table = fr_contents_at(contents, element)->table;
    const FrParam *row = value != NULL ? NULL : fr_params_find(table, attribute);
    return row != NULL ? g_strdup(row->default_text) : value;
}

static bool read_box(const StudioDocument *document, uint32_t element, FrLattice *lattice) {
    static const char *const degrees[] = {"degree-x", "degree-y", "degree-z"};
    char *from = value_of(document, element, "box-from");
    char *to = value_of(document, element, "box-to");
    double a[3], b[3], degree;
    bool is_right = from != NULL && to != NULL && studio_numbers_read(from, 3, a) &&
                    studio_numbers_read(to, 3, b);
    for (int k = 0; k < 3 && is_right; k++) {
        char *text = value_of(document, element, degrees[k]);
        is_right = text != NULL && studio_numbers_read(text, 1, &degree) && degree >= 1 &&
                   degree <= FR_LATTICE_MOST_DEGREE && fabs(a[k] - b[k]) > 1e-6;
        if (is_right) {
            lattice->degree[k] = (uint32_t)degree;
            lattice->min[k] = fmin(a[k], b[k]);
            lattice->max[k] = fmax(a[k], b[k]);
        }
        g_free(text);
    }
    g_free(from);
    g_free(to);
    if (is_right) {
        fr_lattice_reset(lattice);
    }
    return is_right;
}

// Adds one "i,j,k:x,y,z".
static bool add_move(StudioPatch *patch, char *word) {
    double index[3], by[3];
    char *colon = strchr(word, ':');
    if (colon == NULL) {
        return false;
    }
    *colon = '\0';
    if (!studio_numbers_read(word, 3, index) || !studio_numbers_read(colon + 1, 3, by)) {
        return false;
    }
    for (int k = 0; k < 3; k++) {
        if (!(index[k] >= 0 && index[k] <= patch->lattice.degree[k])) {
            return false;
        }
    }
    uint32_t point = fr_lattice_index(&patch->lattice, (uint32_t)index[0], (uint32_t)index[1],
                                      (uint32_t)index[2]);
    for (int k = 0; k < 3; k++) {
        patch->moves[point][k] += by[k];
    }
    return true;
}

bool studio_patch_read(const StudioDocument *document, uint32_t element,
                       const StudioFooting *footing, StudioPatch *patch) {
    const FrContentsElement *at = fr_contents_at(studio_document_contents(document), element);
    bool is_patch = at->component == FR_COMPONENT_HYPERPATCH;
    *patch = (StudioPatch){.element = element, .can_move = is_patch};
    if ((!is_patch && at->component != FR_COMPONENT_FFD) ||
        !read_box(document, element, &patch->lattice)) {
        return false;
    }
    memcpy(patch->origin, footing->origin, sizeof patch->origin);
    memcpy(patch->axes, footing->axes, sizeof patch->axes);
    char *text = is_patch ? value_of(document, element, "points") : NULL;
    char **words = g_strsplit_set(text == NULL ? "" : text, " \t\r\n", -1);
    bool is_right = true;
    for (char **word = words; *word != NULL; word++) {
        is_right = is_right && (**word == '\0' || add_move(patch, *word));
    }
    g_strfreev(words);
    g_free(text);
    return is_right;
}

static bool write_moves(StudioDocument *document, const StudioPatch *patch, const char *step,
                        const char *key) {
    const FrLattice *lattice = &patch->lattice;
    double span = 0;
    for (int k = 0; k < 3; k++) {
        span = fmax(span, lattice->max[k] - lattice->min[k]);
    }
    GString *text = g_string_new(NULL);
    for (uint32_t i = 0; i < fr_lattice_count(lattice); i++) {
        const double *by = patch->moves[i];
        if (fmax(fabs(by[0]), fmax(fabs(by[1]), fabs(by[2]))) < 1e-4 * span) {
            continue;
        }
        uint32_t row = lattice->degree[2] + 1, plane = row * (lattice->degree[1] + 1);
        g_string_append_printf(text, "%s%u,%u,%u:", text->len > 0 ? " " : "", i / plane,
                               i / row % (lattice->degree[1] + 1), i % row);
        for (int k = 0; k < 3; k++) {
            char *number = studio_value_text(by[k], span);
            g_string_append_printf(text, "%s%s", k > 0 ? "," : "", number);
            g_free(number);
        }
    }
    FrSplice splice = fr_contents_set(studio_document_contents(document), patch->element, "points",
                                      text->len > 0 ? text->str : NULL);
    g_string_free(text, TRUE);
    return studio_document_splice_one(document, splice, step, key);
}

// ---- in the picture ----------------------------------------------------------------------------

void studio_patch_place(const StudioPatch *patch, uint32_t point, double at[3]) {
    memcpy(at, patch->origin, sizeof patch->origin);
    for (int axis = 0; axis < 3; axis++) {
        double local = patch->lattice.points[point][axis] + patch->moves[point][axis];
        for (int k = 0; k < 3; k++) {
            at[k] += local * patch->axes[axis][k];
        }
    }
}

StudioOverlay *studio_patch_marks(const StudioPatch *patch, uint32_t chosen) {
    static const float line[4] = {0.45f, 0.72f, 1, 0.75f}, plain[4] = {0.78f, 0.88f, 1, 1};
    static const float moved[4] = {1, 0.62f, 0.13f, 1}, held[4] = {1, 1, 1, 1};
    const FrLattice *lattice = &patch->lattice;
    StudioOverlay *overlay = studio_overlay_new();
    overlay->through = 0.6f;
    const uint32_t row = lattice->degree[2] + 1, plane = row * (lattice->degree[1] + 1);
    const uint32_t strides[3] = {plane, row, 1};
    for (uint32_t i = 0; i < fr_lattice_count(lattice); i++) {
        const uint32_t index[3] = {i / plane, i / row % (lattice->degree[1] + 1), i % row};
        double at[3], next[3];
        studio_patch_place(patch, i, at);
        for (int axis = 0; axis < 3; axis++) {
            if (index[axis] < lattice->degree[axis]) {
                studio_patch_place(patch, i + strides[axis], next);
                studio_overlay_line(overlay, at, next, 1.4, line);
            }
        }
        bool is_moved = dot(patch->moves[i], patch->moves[i]) > 0;
        if (patch->can_move) {
            studio_overlay_point(overlay, at, i == chosen ? 13 : 9, is_moved ? moved : plain);
        }
        if (patch->can_move && i == chosen) {
            studio_overlay_point(overlay, at, 6, held);
        }
    }
    return overlay;
}

uint32_t studio_patch_under(const StudioPatch *patch, const StudioCamera *camera, double aspect,
                            double height, double x, double y) {
    uint32_t found = FR_NONE;
    double best = near_enough;
    for (uint32_t i = 0; patch->can_move && i < fr_lattice_count(&patch->lattice); i++) {
        double at[3], seen_x, seen_y;
        studio_patch_place(patch, i, at);
        if (!studio_camera_project(camera, aspect, at, &seen_x, &seen_y)) {
            continue;
        }
        double pixels = 0.5 * height;
        double away = hypot((seen_x - x) * pixels * aspect, (seen_y - y) * pixels);
        if (away < best) {
            best = away;
            found = i;
        }
    }
    return found;
}

static uint32_t mirrored(const FrLattice *lattice, uint32_t point) {
    uint32_t plane = (lattice->degree[1] + 1) * (lattice->degree[2] + 1);
    return (lattice->degree[0] - point / plane) * plane + point % plane;
}

bool studio_patch_drag(StudioDocument *document, const StudioPatch *from, uint32_t point,
                       const StudioCamera *camera, double aspect, double x, double y,
                       bool is_mirrored) {
    double grip[3], hit[3];
    studio_patch_place(from, point, grip);
    if (!from->can_move || studio_document_is_broken(document) ||
        !studio_camera_meet(camera, aspect, x, y, grip, hit)) {
        return false;
    }
    StudioPatch to = *from;
    for (int k = 0; k < 3; k++) {
        hit[k] -= grip[k];
    }
    for (int axis = 0; axis < 3; axis++) {
        to.moves[point][axis] +=
            dot(hit, from->axes[axis]) / dot(from->axes[axis], from->axes[axis]);
    }
    uint32_t other = mirrored(&from->lattice, point);
    if (is_mirrored && other != point) {
        memcpy(to.moves[other], to.moves[point], sizeof to.moves[other]);
        to.moves[other][0] = -to.moves[point][0];
    } else if (is_mirrored) {
        to.moves[point][0] = 0; // the middle stays in the middle
    }
    char *key = g_strdup_printf("%u.points.%u", from->element, point);
    bool is_changed = write_moves(document, &to, "Move a control point", key);
    g_free(key);
    return is_changed;
}

bool studio_patch_reset(StudioDocument *document, const StudioPatch *patch, uint32_t point) {
    StudioPatch to = *patch;
    if (point == FR_NONE) {
        memset(to.moves, 0, sizeof to.moves);
    } else {
        memset(to.moves[point], 0, sizeof to.moves[point]);
    }
    return !studio_document_is_broken(document) &&
           write_moves(document, &to,
                       point == FR_NONE ? "Reset all control points" : "Reset a control point",
                       NULL);
}
