/// What the pointer draws over the scene: handles that are dragged, brushes, roads, envelopes.
#include "studio/scene_tool_private.h"

#include <math.h>
#include <string.h>

enum { MOST_DABS = 60 }; // between two places of the pointer

static const double point_pixels = 6; // from point to point of a line
static const double dab_part = 0.5;   // of the brush's radius, from dab to dab
static const double individuals = 4;  // different plants of a brush

static bool grows(const StudioSceneTool *tool) {
    return tool->window->moment.step >= 0;
}

// ---- handles -----------------------------------------------------------------------------------

// Along the one axis that it went farther on.
static void keep_straight(const StudioStanding *from, StudioStanding *to) {
    int axis = fabs(to->at[0] - from->at[0]) < fabs(to->at[1] - from->at[1]) ? 0 : 1;
    to->at[axis] = from->at[axis];
}

// What is dragged from here on is a copy, and the first one stays.
static void copy(StudioSceneTool *tool) {
    StudioWindow *window = tool->window;
    uint32_t made = studio_copy(window->document, studio_window_selected(window), tool->key);
    tool->is_copy_due = false;
    if (made == FR_NONE) {
        studio_window_say(window, "This cannot be copied");
        return;
    }
    StudioGrip held = tool->held;
    studio_window_select(window, made);
    tool->held = held;
}

static void drag_handle(StudioSceneTool *tool, const double pixel[2], bool is_stepped) {
    StudioWindow *window = tool->window;
    StudioEye eye = studio_scene_eye(tool);
    StudioGround *ground = studio_builder_ground(window->builder);
    double step = studio_camera_step(&eye.camera, is_stepped ? 0.05 : 0.002);
    StudioStanding to = studio_gizmo_drag(&eye, ground, tool->held, &tool->grabbed, tool->begin,
                                          pixel, step, is_stepped ? 15 : 1);
    studio_ground_unref(ground);
    if (tool->is_straight && tool->held == STUDIO_GRIP_GROUND) {
        keep_straight(&tool->grabbed, &to);
    }
    if (tool->is_copy_due) {
        copy(tool);
    }
    tool->standing = to;
    gtk_widget_queue_draw(tool->layer);
    // What grows bud by bud would begin anew with every pixel: it does when the handle is let go.
    if (!grows(tool) && studio_standing_move(window->document, studio_window_selected(window),
                                             &tool->written, &to, tool->key)) {
        tool->written = to;
    }
}

static void drop_handle(StudioSceneTool *tool) {
    StudioWindow *window = tool->window;
    StudioStanding to = tool->standing;
    tool->held = STUDIO_GRIP_NONE;
    if (grows(tool)) {
        studio_standing_move(window->document, studio_window_selected(window), &tool->written, &to,
                             tool->key);
    }
}

// ---- brushes -----------------------------------------------------------------------------------

static StudioBrush brush_of(const StudioSceneTool *tool) {
    return (StudioBrush){.radius = gtk_spin_button_get_value(GTK_SPIN_BUTTON(tool->radius)),
                         .density = gtk_spin_button_get_value(GTK_SPIN_BUTTON(tool->density)) / 100,
                         .seed = tool->strokes};
}

static void paint(StudioSceneTool *tool, const double at[3]) {
    StudioBrush brush = brush_of(tool);
    GArray *places = studio_brush_dab(&brush, tool->dabs, at, tool->taken);
    StudioSpot *spots = g_new0(StudioSpot, places->len + 1);
    for (guint i = 0; i < places->len; i++) {
        const double *place = &g_array_index(places, double, 2 * i);
        spots[i] = (StudioSpot){
            {studio_scene_rounded(tool, place[0]), studio_scene_rounded(tool, place[1]), 0},
            floor(360 * g_random_double()),
            0.85 + 0.3 * g_random_double(),
            1 + (int64_t)(individuals * g_random_double())};
    }
    char *plant = studio_scene_chosen_plant(tool, tool->key);
    if (plant != NULL) {
        studio_plant(tool->window->document, plant, spots, places->len, tool->key);
    }
    g_free(plant);
    g_free(spots);
    g_array_unref(places);
}

// Removes places within the brush, and leaves out plants of rows and areas.
static void take_out(StudioSceneTool *tool, const double at[3]) {
    StudioWindow *window = tool->window;
    const FrContents *contents = studio_document_contents(window->document);
    double radius = brush_of(tool).radius;
    GArray *gone = g_array_new(FALSE, FALSE, sizeof(uint32_t));
    uint32_t scene = contents == NULL ? FR_NONE : fr_contents_child(contents, 0, "scene");
    uint32_t place = scene == FR_NONE ? FR_NONE : fr_contents_child(contents, scene, "place");
    for (; place != FR_NONE; place = fr_contents_sibling(contents, place)) {
        StudioStanding standing;
        if (studio_standing_read(window->document, place, &standing) &&
            hypot(standing.at[0] - at[0], standing.at[1] - at[1]) <= radius) {
            g_array_append_val(gone, place);
        }
    }
    studio_scene_leave_out(tool, at, radius); // it renumbers no element
    if (gone->len > 0) {
        studio_window_select(window, FR_NONE);
        studio_take_out(window->document, (const uint32_t *)(const void *)gone->data, gone->len,
                        tool->key);
    }
    g_array_unref(gone);
}

static void dab(StudioSceneTool *tool, const double at[3]) {
    memcpy(tool->dabbed, at, sizeof tool->dabbed);
    if (tool->tool == SCENE_PAINT) {
        paint(tool, at);
    } else {
        take_out(tool, at);
    }
    tool->dabs++;
}

// Dabs along the way from the last one: a pointer that is fast leaves no gaps.
static void dab_to(StudioSceneTool *tool, const double pixel[2]) {
    double to[3];
    double apart = dab_part * brush_of(tool).radius;
    if (!studio_scene_ground(tool, pixel, to)) {
        return;
    }
    if (tool->dabs == 0) { // it began where no ground is
        dab(tool, to);
    }
    const double *from = tool->dabbed;
    double way = hypot(to[0] - from[0], to[1] - from[1]);
    double count = fmin(floor(way / apart), MOST_DABS);
    double step[2] = {(to[0] - from[0]) / fmax(way, 1e-9) * apart,
                      (to[1] - from[1]) / fmax(way, 1e-9) * apart};
    for (int i = 0; i < (int)count; i++) {
        const double next[3] = {from[0] + step[0], from[1] + step[1], to[2]};
        dab(tool, next);
    }
}

static GArray *stands_of(StudioBuilder *builder) {
    GArray *stands = studio_builder_stands(builder);
    GArray *taken = g_array_new(FALSE, FALSE, 2 * sizeof(double));
    for (guint i = 0; i < stands->len; i++) {
        g_array_append_vals(taken, g_array_index(stands, StudioStand, i).at, 1);
    }
    g_array_unref(stands);
    return taken;
}

// ---- lines -------------------------------------------------------------------------------------

bool studio_scene_on_profile(const StudioSceneTool *tool, const double pixel[2], double at[2]) {
    StudioEye eye = studio_scene_eye(tool);
    double origin[3], direction[3];
    studio_eye_ray(&eye, pixel, origin, direction);
    double c = cos(eye.camera.azimuth), s = sin(eye.camera.azimuth);
    // The plane's normal looks to the camera along the ground.
    double along = direction[0] * s - direction[1] * c;
    double away = (tool->foot[0] - origin[0]) * s - (tool->foot[1] - origin[1]) * c;
    double t = along != 0 ? away / along : -1;
    at[0] = (origin[0] + t * direction[0] - tool->foot[0]) * c +
            (origin[1] + t * direction[1] - tool->foot[1]) * s;
    at[1] = origin[2] + t * direction[2] - tool->foot[2];
    return t > 0;
}

static void add_point(StudioSceneTool *tool, const double pixel[2]) {
    double ground[3], profile[2];
    if (tool->tool == SCENE_ROAD && studio_scene_ground(tool, pixel, ground)) {
        for (int k = 0; k < 3; k++) {
            ground[k] = studio_scene_rounded(tool, ground[k]);
        }
        g_array_append_val(tool->line, ground);
    } else if (tool->tool == SCENE_ENVELOPE && studio_scene_on_profile(tool, pixel, profile)) {
        profile[0] = studio_scene_rounded(tool, profile[0]);
        profile[1] = studio_scene_rounded(tool, profile[1]);
        g_array_append_val(tool->line, profile);
    }
    memcpy(tool->last, pixel, sizeof tool->last);
    gtk_widget_queue_draw(tool->layer);
}

static double road_height(const StudioSceneTool *tool) {
    return gtk_spin_button_get_value(GTK_SPIN_BUTTON(tool->width)); // as high as it is wide
}

static void end_road(StudioSceneTool *tool) {
    StudioDocument *document = tool->window->document;
    StudioEye eye = studio_scene_eye(tool);
    GArray *points =
        studio_line_simplify(tool->line, 4 * studio_eye_pixel(&eye, eye.camera.target));
    double width = gtk_spin_button_get_value(GTK_SPIN_BUTTON(tool->width));
    if (points->len < 2) {
        studio_window_say(tool->window, "Draw the road along the ground");
    } else if (studio_add_road(document, points, width, road_height(tool))) {
        studio_window_select(tool->window, studio_scene_last(document, "obstacle"));
    }
    g_array_unref(points);
}

static void end_envelope(StudioSceneTool *tool) {
    StudioWindow *window = tool->window;
    StudioEye eye = studio_scene_eye(tool);
    GArray *outline =
        studio_line_to_outline(tool->line, 3 * studio_eye_pixel(&eye, eye.camera.target));
    double foot[3];
    uint32_t plant = studio_scene_species(tool, foot);
    double height = outline->len == 0 ? 0
                                      : g_array_index(outline, double, 2 * outline->len - 1) -
                                            g_array_index(outline, double, 1);
    if (plant == FR_NONE) {
        studio_window_say(window, "Only a species, which grows bud by bud, has an envelope");
    } else if (outline->len < 2 || !(height > 0)) {
        studio_window_say(window, "Draw a higher outline, beside the plant's axis");
    } else {
        studio_set_envelope(window->document, plant, outline, NULL);
    }
    g_array_unref(outline);
}

// ---- a stroke ----------------------------------------------------------------------------------

void studio_scene_stroke_begin(StudioSceneTool *tool, const double pixel[2]) {
    g_free(tool->key);
    tool->key = g_strdup_printf("scene-%" G_GUINT64_FORMAT, ++tool->strokes);
    memcpy(tool->begin, pixel, sizeof tool->begin);
    memcpy(tool->last, pixel, sizeof tool->last);
    tool->dabs = 0;
    if (tool->held != STUDIO_GRIP_NONE) {
        tool->grabbed = tool->written = tool->standing;
    } else if (tool->tool == SCENE_PAINT || tool->tool == SCENE_TAKE_OUT) {
        g_clear_pointer(&tool->taken, g_array_unref);
        g_clear_pointer(&tool->ones, g_array_unref);
        tool->taken = stands_of(tool->window->builder);
        tool->ones = studio_scene_ones(tool);
        double at[3];
        if (studio_scene_ground(tool, pixel, at)) {
            dab(tool, at);
        } else {
            studio_scene_say_no_ground(tool);
        }
    } else {
        g_clear_pointer(&tool->line, g_array_unref);
        guint size = tool->tool == SCENE_ROAD ? 3 : 2;
        tool->line = g_array_new(FALSE, FALSE, (guint)(size * sizeof(double)));
        studio_scene_species(tool, tool->foot);
        add_point(tool, pixel);
    }
}

void studio_scene_stroke_go(StudioSceneTool *tool, const double pixel[2]) {
    if (studio_document_is_abandoned(tool->window->document)) {
        return;
    }
    if (tool->held != STUDIO_GRIP_NONE) {
        drag_handle(tool, pixel, tool->is_stepped);
    } else if (tool->taken != NULL) {
        dab_to(tool, pixel);
    } else if (tool->line != NULL &&
               hypot(pixel[0] - tool->last[0], pixel[1] - tool->last[1]) >= point_pixels) {
        add_point(tool, pixel);
    }
}

void studio_scene_stroke_end(StudioSceneTool *tool) {
    if (studio_document_is_abandoned(tool->window->document)) {
        tool->held = STUDIO_GRIP_NONE;
    } else if (tool->held != STUDIO_GRIP_NONE) {
        drop_handle(tool);
    } else if (tool->line != NULL && tool->tool == SCENE_ROAD) {
        end_road(tool);
    } else if (tool->line != NULL && tool->tool == SCENE_ENVELOPE) {
        end_envelope(tool);
    }
    g_clear_pointer(&tool->line, g_array_unref);
    g_clear_pointer(&tool->taken, g_array_unref);
    g_clear_pointer(&tool->ones, g_array_unref);
    studio_document_seal(tool->window->document);
    gtk_widget_queue_draw(tool->layer);
}
