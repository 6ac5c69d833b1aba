/// What the tools of the scene draw over its picture: handles, brushes, lines, envelopes.
#include "studio/scene_tool_private.h"

#include "studio/model/values.h"

#include <math.h>
#include <string.h>

enum { CIRCLE = 48, MOST_FEET = 3000 };

#define STUDIO_TYPE_SCENE_LAYER (studio_scene_layer_get_type())
G_DECLARE_FINAL_TYPE(StudioSceneLayer, studio_scene_layer, STUDIO, SCENE_LAYER, GtkWidget)

struct _StudioSceneLayer {
    GtkWidget parent;
    StudioSceneTool *tool;
};

G_DEFINE_TYPE(StudioSceneLayer, studio_scene_layer, GTK_TYPE_WIDGET)

static const double red[3] = {0.93, 0.33, 0.31}, green[3] = {0.44, 0.78, 0.30},
                    blue[3] = {0.36, 0.62, 0.96}, amber[3] = {1.0, 0.70, 0.20},
                    white[3] = {0.95, 0.95, 0.95};

// Twice: a dark rim keeps it readable on any picture.
static void stroke(cairo_t *cairo, const double colour[3], double width) {
    cairo_set_source_rgba(cairo, 0, 0, 0, 0.45);
    cairo_set_line_width(cairo, width + 2);
    cairo_stroke_preserve(cairo);
    cairo_set_source_rgb(cairo, colour[0], colour[1], colour[2]);
    cairo_set_line_width(cairo, width);
    cairo_stroke(cairo);
}

static void fill(cairo_t *cairo, const double colour[3]) {
    cairo_set_source_rgb(cairo, colour[0], colour[1], colour[2]);
    cairo_fill_preserve(cairo);
    cairo_set_source_rgba(cairo, 0, 0, 0, 0.45);
    cairo_set_line_width(cairo, 1);
    cairo_stroke(cairo);
}

// ---- handles -----------------------------------------------------------------------------------

static void draw_arrow(cairo_t *cairo, const double from[2], const double to[2],
                       const double colour[3], bool is_over) {
    double dx = to[0] - from[0], dy = to[1] - from[1], length = hypot(dx, dy);
    if (length < 4) { // it points at the eye
        return;
    }
    dx /= length;
    dy /= length;
    const double head = 11, half = 5;
    cairo_move_to(cairo, from[0], from[1]);
    cairo_line_to(cairo, to[0] - dx * head, to[1] - dy * head);
    stroke(cairo, colour, is_over ? 4 : 2.5);
    cairo_move_to(cairo, to[0], to[1]);
    cairo_line_to(cairo, to[0] - dx * head - dy * half, to[1] - dy * head + dx * half);
    cairo_line_to(cairo, to[0] - dx * head + dy * half, to[1] - dy * head - dx * half);
    cairo_close_path(cairo);
    fill(cairo, colour);
}

static void draw_gizmo(cairo_t *cairo, const StudioGizmo *gizmo, StudioGrip over) {
    if (gizmo->can_turn) {
        for (int i = 0; i < STUDIO_RING; i++) {
            cairo_line_to(cairo, gizmo->ring[i][0], gizmo->ring[i][1]);
        }
        stroke(cairo, amber, over == STUDIO_GRIP_TURN ? 3.5 : 2);
    }
    const double *const colours[] = {red, green, blue};
    for (int k = 0; k < 3; k++) {
        draw_arrow(cairo, gizmo->middle, gizmo->tips[k], colours[k],
                   over == (StudioGrip)(STUDIO_GRIP_X + k));
    }
    if (gizmo->can_scale) {
        double half = over == STUDIO_GRIP_SCALE ? 7 : 5.5;
        cairo_move_to(cairo, gizmo->middle[0], gizmo->middle[1]);
        cairo_line_to(cairo, gizmo->scale[0], gizmo->scale[1]);
        stroke(cairo, white, 1);
        cairo_rectangle(cairo, gizmo->scale[0] - half, gizmo->scale[1] - half, 2 * half, 2 * half);
        fill(cairo, white);
    }
    cairo_arc(cairo, gizmo->middle[0], gizmo->middle[1], over == STUDIO_GRIP_GROUND ? 8.5 : 6.5, 0,
              2 * G_PI);
    fill(cairo, over == STUDIO_GRIP_GROUND ? amber : white);
}

// ---- on the ground -----------------------------------------------------------------------------

static void draw_circle(cairo_t *cairo, const StudioEye *eye, const StudioGround *ground,
                        const double middle[3], double radius, const double colour[3]) {
    cairo_new_path(cairo);
    for (int i = 0; i <= CIRCLE; i++) {
        double angle = 2 * G_PI * i / CIRCLE, pixel[2];
        double point[3] = {middle[0] + radius * cos(angle), middle[1] + radius * sin(angle), 0};
        point[2] = studio_ground_height(ground, point[0], point[1]);
        if (studio_eye_project(eye, point, pixel)) {
            cairo_line_to(cairo, pixel[0], pixel[1]);
        }
    }
    stroke(cairo, colour, 1.8);
}

// A sprout where a plant would stand.
static void draw_sprout(cairo_t *cairo, const StudioEye *eye, const double at[3]) {
    double foot[2], tip[2], height = 34 * studio_eye_pixel(eye, at);
    const double above[3] = {at[0], at[1], at[2] + height};
    if (!studio_eye_project(eye, at, foot) || !studio_eye_project(eye, above, tip)) {
        return;
    }
    cairo_move_to(cairo, foot[0], foot[1]);
    cairo_line_to(cairo, tip[0], tip[1]);
    stroke(cairo, green, 2);
    for (int side = -1; side <= 1; side += 2) {
        cairo_move_to(cairo, tip[0], tip[1] + 8);
        cairo_curve_to(cairo, tip[0] + side * 4, tip[1] - 2, tip[0] + side * 13, tip[1] - 6,
                       tip[0] + side * 14, tip[1] - 4);
        cairo_curve_to(cairo, tip[0] + side * 12, tip[1] + 6, tip[0] + side * 5, tip[1] + 9, tip[0],
                       tip[1] + 8);
        fill(cairo, green);
    }
}

static void draw_pointer(StudioSceneTool *tool, cairo_t *cairo, const StudioEye *eye,
                         const StudioGround *ground) {
    double at[3];
    if (!tool->is_hovering || !studio_scene_ground(tool, tool->hover, at)) {
        return;
    }
    double radius = gtk_spin_button_get_value(GTK_SPIN_BUTTON(tool->radius));
    double wide = 0.5 * gtk_spin_button_get_value(GTK_SPIN_BUTTON(tool->width));
    switch (tool->tool) {
    case SCENE_PLANT:
        draw_circle(cairo, eye, ground, at, 9 * studio_eye_pixel(eye, at), green);
        draw_sprout(cairo, eye, at);
        break;
    case SCENE_PAINT:
        draw_circle(cairo, eye, ground, at, radius, green);
        break;
    case SCENE_TAKE_OUT:
        draw_circle(cairo, eye, ground, at, radius, red);
        break;
    case SCENE_ROAD:
        draw_circle(cairo, eye, ground, at, wide, amber);
        break;
    case SCENE_OBSTACLE:
        draw_circle(cairo, eye, ground, at, 0.5 * studio_camera_step(&eye->camera, 0.14), amber);
        break;
    default:
        break;
    }
}

// Where plants stand: seeds cannot be seen otherwise.
static void draw_feet(const StudioSceneTool *tool, cairo_t *cairo, const StudioEye *eye) {
    GArray *stands = studio_builder_stands(tool->window->builder);
    cairo_new_path(cairo);
    for (guint i = 0; i < MIN(stands->len, MOST_FEET); i++) {
        double pixel[2];
        if (studio_eye_project(eye, g_array_index(stands, StudioStand, i).at, pixel)) {
            cairo_new_sub_path(cairo);
            cairo_arc(cairo, pixel[0], pixel[1], 2.5, 0, 2 * G_PI);
        }
    }
    fill(cairo, white);
    cairo_new_path(cairo);
    g_array_unref(stands);
}

// ---- lines -------------------------------------------------------------------------------------

static void draw_road(const StudioSceneTool *tool, cairo_t *cairo, const StudioEye *eye) {
    cairo_new_path(cairo);
    for (guint i = 0; i < tool->line->len; i++) {
        double pixel[2];
        if (studio_eye_project(eye, &g_array_index(tool->line, double, 3 * i), pixel)) {
            cairo_line_to(cairo, pixel[0], pixel[1]);
        }
    }
    stroke(cairo, amber, 3);
}

// The outline of an envelope (radius, height) at a side of its axis.
static void draw_side(const StudioSceneTool *tool, cairo_t *cairo, const StudioEye *eye,
                      const GArray *outline, double turn, const double colour[3]) {
    cairo_new_path(cairo);
    for (guint i = 0; i < outline->len; i++) {
        const double *from = &g_array_index(outline, double, 2 * i);
        double pixel[2];
        const double point[3] = {tool->foot[0] + from[0] * cos(turn),
                                 tool->foot[1] + from[0] * sin(turn), tool->foot[2] + from[1]};
        if (studio_eye_project(eye, point, pixel)) {
            cairo_line_to(cairo, pixel[0], pixel[1]);
        }
    }
    stroke(cairo, colour, 1.5);
}

static void draw_rings(const StudioSceneTool *tool, cairo_t *cairo, const StudioEye *eye,
                       const GArray *outline) {
    for (guint i = 0; i < outline->len; i++) {
        const double *from = &g_array_index(outline, double, 2 * i);
        cairo_new_path(cairo);
        for (int k = 0; k <= CIRCLE; k++) {
            double angle = 2 * G_PI * k / CIRCLE, pixel[2];
            const double point[3] = {tool->foot[0] + from[0] * cos(angle),
                                     tool->foot[1] + from[0] * sin(angle), tool->foot[2] + from[1]};
            if (studio_eye_project(eye, point, pixel)) {
                cairo_line_to(cairo, pixel[0], pixel[1]);
            }
        }
        cairo_set_source_rgba(cairo, amber[0], amber[1], amber[2], 0.4);
        cairo_set_line_width(cairo, 1);
        cairo_stroke(cairo);
    }
}

static void draw_envelope(StudioSceneTool *tool, cairo_t *cairo, const StudioEye *eye) {
    const FrContents *contents = studio_document_contents(tool->window->document);
    double foot[3];
    uint32_t plant = studio_scene_species(tool, foot);
    if (tool->line == NULL) {
        memcpy(tool->foot, foot, sizeof foot);
    }
    uint32_t species = plant == FR_NONE ? FR_NONE : fr_contents_child(contents, plant, "species");
    char *text = species == FR_NONE ? NULL : fr_contents_get(contents, species, "envelope");
    GArray *outline = text == NULL ? NULL : studio_points_read(text);
    if (outline != NULL && tool->line == NULL) {
        draw_rings(tool, cairo, eye, outline);
        for (int side = 0; side < 2; side++) {
            draw_side(tool, cairo, eye, outline, eye->camera.azimuth + side * G_PI, amber);
        }
    }
    if (tool->line != NULL) {
        draw_side(tool, cairo, eye, tool->line, eye->camera.azimuth, amber);
        draw_side(tool, cairo, eye, tool->line, eye->camera.azimuth + G_PI, white);
    }
    double low[2], high[2];
    const double above[3] = {tool->foot[0], tool->foot[1],
                             tool->foot[2] + 0.5 * eye->camera.distance};
    if (plant != FR_NONE && studio_eye_project(eye, tool->foot, low) &&
        studio_eye_project(eye, above, high)) {
        const double dashes[] = {5, 5};
        cairo_move_to(cairo, low[0], low[1]);
        cairo_line_to(cairo, high[0], high[1]);
        cairo_set_dash(cairo, dashes, 2, 0);
        cairo_set_source_rgba(cairo, 1, 1, 1, 0.6);
        cairo_set_line_width(cairo, 1);
        cairo_stroke(cairo);
        cairo_set_dash(cairo, NULL, 0, 0);
    }
    g_clear_pointer(&outline, g_array_unref);
    g_free(text);
}

// ---- the layer ---------------------------------------------------------------------------------

static void draw(StudioSceneTool *tool, cairo_t *cairo) {
    StudioEye eye = studio_scene_eye(tool);
    StudioGround *ground = studio_builder_ground(tool->window->builder);
    tool->drawn = eye.camera;
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
    if (tool->tool == SCENE_ENVELOPE) {
        draw_envelope(tool, cairo, &eye);
    } else if (tool->tool == SCENE_ROAD && tool->line != NULL) {
        draw_road(tool, cairo, &eye);
    }
    if (tool->tool >= SCENE_MOVE && tool->tool <= SCENE_TAKE_OUT) {
        draw_feet(tool, cairo, &eye);
    }
    double pivot[3];
    StudioGizmo gizmo;
    bool shows = tool->has_standing && tool->tool != SCENE_PAINT && tool->tool != SCENE_TAKE_OUT &&
                 tool->tool != SCENE_ROAD && tool->tool != SCENE_ENVELOPE;
    studio_gizmo_pivot(ground, &tool->standing, pivot);
    if (shows && studio_gizmo_place(&eye, pivot, &tool->standing, &gizmo)) {
        draw_gizmo(cairo, &gizmo, tool->held != STUDIO_GRIP_NONE ? tool->held : tool->over);
    }
    if (tool->tool == SCENE_MOVE && tool->one_of != NULL) {
        draw_circle(cairo, &eye, ground, tool->one_at, 12 * studio_eye_pixel(&eye, tool->one_at),
                    amber);
    }
    if (tool->over == STUDIO_GRIP_NONE) {
        draw_pointer(tool, cairo, &eye, ground);
    }
    studio_ground_unref(ground);
}

static void studio_scene_layer_snapshot(GtkWidget *widget, GtkSnapshot *snapshot) {
    StudioSceneTool *tool = STUDIO_SCENE_LAYER(widget)->tool;
    int width = gtk_widget_get_width(widget), height = gtk_widget_get_height(widget);
    if (tool == NULL || tool->window->document == NULL || tool->window->builder == NULL ||
        studio_document_contents(tool->window->document) == NULL) {
        return;
    }
    graphene_rect_t area = GRAPHENE_RECT_INIT(0, 0, (float)width, (float)height);
    gtk_snapshot_push_clip(snapshot, &area);
    cairo_t *cairo = gtk_snapshot_append_cairo(snapshot, &area);
    draw(tool, cairo);
    cairo_destroy(cairo);
    gtk_snapshot_pop(snapshot);
}

static void studio_scene_layer_class_init(StudioSceneLayerClass *class) {
    GTK_WIDGET_CLASS(class)->snapshot = studio_scene_layer_snapshot;
    gtk_widget_class_set_accessible_role(GTK_WIDGET_CLASS(class), GTK_ACCESSIBLE_ROLE_PRESENTATION);
}

static void studio_scene_layer_init(StudioSceneLayer *layer) {
    gtk_widget_set_can_target(GTK_WIDGET(layer), FALSE);
}

GtkWidget *studio_scene_layer_new(StudioSceneTool *tool) {
    StudioSceneLayer *layer = g_object_new(STUDIO_TYPE_SCENE_LAYER, NULL);
    layer->tool = tool;
    return GTK_WIDGET(layer);
}
