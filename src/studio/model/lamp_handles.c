// Lamps and the probe taken hold of in the picture.
#include "studio/model/commands.h"
#include "studio/model/lamp_private.h"

#include <math.h>
#include <string.h>

static const double near_enough = 11;   // pixels
static const double along_arrow = 0.25; // an arrow is held from this part of it on

typedef struct Search {
    const StudioCamera *camera;
    double aspect, height; // of the picture, in pixels
    double x, y;           // the pointer
    double best;           // pixels
    StudioHandle found;
} Search;

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// Takes what is nearer than anything before; later ones win where they are as near.
static void offer(Search *search, const StudioHandle *handle) {
    double x, y;
    if (!studio_camera_project(search->camera, search->aspect, handle->grip, &x, &y)) {
        return;
    }
    double pixels = 0.5 * search->height;
    double away = hypot((x - search->x) * pixels * search->aspect, (y - search->y) * pixels);
    if (away <= search->best) {
        search->best = away;
        search->found = *handle;
    }
}

static void offer_arrows(Search *search, const StudioHandle *place, double reach) {
    for (int axis = 0; axis < 3; axis++) {
        for (double part = along_arrow; part <= 1.0001; part += 0.05) {
            StudioHandle handle = *place;
            handle.kind = (StudioHandleKind)(STUDIO_HANDLE_X + axis);
            handle.grip[axis] += part * reach;
            offer(search, &handle);
        }
    }
}

static StudioHandle handle_of(StudioHandleKind kind, uint32_t element, const double at[3]) {
    StudioHandle handle = {.kind = kind, .element = element};
    memcpy(handle.begin, at, sizeof handle.begin);
    memcpy(handle.grip, at, sizeof handle.grip);
    memcpy(handle.pivot, at, sizeof handle.pivot);
    return handle;
}

static void offer_lamp(Search *search, const StudioLamp *lamp, bool is_selected, double reach) {
    double at[3], tip[3];
    for (int i = 0; i < 3; i++) {
        at[i] = (double)lamp->params.at.raw[i];
    }
    StudioHandle place = handle_of(STUDIO_HANDLE_PLACE, lamp->element, at);
    if (is_selected) {
        offer_arrows(search, &place, reach);
    }
    if (is_selected && lamp->params.kind != 0) {
        studio_aim_place(&lamp->params, reach, tip);
        StudioHandle aim = handle_of(STUDIO_HANDLE_AIM, lamp->element, tip);
        memcpy(aim.pivot, at, sizeof at);
        offer(search, &aim);
    }
    offer(search, &place);
}

StudioHandle studio_handle_at(const StudioDocument *document, uint32_t selected, double reach,
                              const StudioCamera *camera, double aspect, double height, double x,
                              double y) {
    Search search = {camera, aspect, height, x, y, near_enough, {.kind = STUDIO_HANDLE_NONE}};
    GArray *lamps = studio_lamps(document);
    double at[3];
    for (guint i = 0; i < lamps->len; i++) {
        const StudioLamp *lamp = &g_array_index(lamps, StudioLamp, i);
        offer_lamp(&search, lamp, lamp->element == selected, reach);
    }
    if (studio_probe_place(document, at)) {
        uint32_t light = studio_find_in_scene(document, "light");
        StudioHandle place = handle_of(STUDIO_HANDLE_PLACE, light, at);
        if (light == selected) {
            offer_arrows(&search, &place, reach);
        }
        offer(&search, &place);
    }
    g_array_unref(lamps);
    return search.found;
}

// ---- dragging ----------------------------------------------------------------------------------

// How far along an axis through the grip the ray comes nearest to it.
static bool meet_axis(const StudioHandle *handle, int axis, const double origin[3],
                      const double way[3], double *along) {
    double between[3];
    for (int i = 0; i < 3; i++) {
        between[i] = handle->grip[i] - origin[i];
    }
    double straight = way[axis], cross = 1 - straight * straight;
    *along = cross < 1e-4 ? 0 : (straight * dot(between, way) - between[axis]) / cross;
    return cross >= 1e-4;
}

static bool dragged_to(const StudioHandle *handle, const StudioCamera *camera, double aspect,
                       double x, double y, double at[3]) {
    double origin[3], way[3], hit[3], along;
    studio_camera_ray(camera, aspect, x, y, origin, way);
    memcpy(at, handle->begin, sizeof hit);
    if (handle->kind == STUDIO_HANDLE_PLACE || handle->kind == STUDIO_HANDLE_AIM) {
        if (!studio_camera_meet(camera, aspect, x, y, handle->grip, hit)) {
            return false;
        }
        for (int i = 0; i < 3; i++) {
            at[i] += hit[i] - handle->grip[i];
        }
        return true;
    }
    int axis = (int)handle->kind - STUDIO_HANDLE_X;
    if (!meet_axis(handle, axis, origin, way, &along)) {
        return false;
    }
    at[axis] += along;
    return true;
}

static bool set_vector(StudioDocument *document, uint32_t element, const char *attribute,
                       const double at[3], double span, const char *step) {
    char *text = studio_vector_text(at, span);
    char *key = g_strdup_printf("%u.%s", element, attribute);
    FrSplice splice = fr_contents_set(studio_document_contents(document), element, attribute, text);
    bool is_changed = studio_document_splice_one(document, splice, step, key);
    g_free(key);
    g_free(text);
    return is_changed;
}

bool studio_handle_drag(StudioDocument *document, const StudioHandle *handle,
                        const StudioCamera *camera, double aspect, double x, double y) {
    double at[3], length = 0;
    if (handle->kind == STUDIO_HANDLE_NONE || studio_document_is_broken(document) ||
        !dragged_to(handle, camera, aspect, x, y, at)) {
        return false;
    }
    bool is_probe = handle->element == studio_find_in_scene(document, "light");
    if (handle->kind != STUDIO_HANDLE_AIM) {
        return set_vector(document, handle->element, is_probe ? "reference" : "at", at,
                          camera->distance, is_probe ? "Move the probe" : "Move a lamp");
    }
    for (int i = 0; i < 3; i++) {
        at[i] -= handle->pivot[i];
        length += at[i] * at[i];
    }
    if (!(length > 0)) {
        return false;
    }
    for (int i = 0; i < 3; i++) {
        at[i] /= sqrt(length);
    }
    return set_vector(document, handle->element, "direction", at, 1, "Aim a lamp");
}
