#include "studio/viewport_private.h"

#include "studio/accessible.h"

#include <math.h>

// Without a move the view rests; with the button held a little later, as hands halt in turning.
static const double rest_seconds = 0.2, held_seconds = 0.4;

enum { SIGNAL_READY, SIGNAL_DRAWN, SIGNAL_WOKEN, SIGNAL_COUNT };

static guint signals[SIGNAL_COUNT];

G_DEFINE_TYPE(StudioViewport, studio_viewport, GTK_TYPE_GL_AREA)

double studio_viewport_aspect(StudioViewport *viewport) {
    int width = gtk_widget_get_width(GTK_WIDGET(viewport));
    int height = gtk_widget_get_height(GTK_WIDGET(viewport));
    return width > 0 && height > 0 ? (double)width / height : 1;
}

// ---- drawing -----------------------------------------------------------------------------------

static void on_realize(GtkGLArea *area, gpointer data) {
    (void)data;
    StudioViewport *viewport = STUDIO_VIEWPORT(area);
    gtk_gl_area_make_current(area);
    const GError *failed = gtk_gl_area_get_error(area);
    GError *error = NULL;
    g_clear_pointer(&viewport->error, g_free);
    if (failed != NULL) {
        viewport->error = g_strdup(failed->message);
        return;
    }
    viewport->renderer = studio_renderer_new(&error);
    if (viewport->renderer == NULL) {
        viewport->error = g_strdup(error->message);
        gtk_gl_area_set_error(area, error);
        g_error_free(error);
        return;
    }
    GHashTableIter layers;
    gpointer name, overlay;
    g_hash_table_iter_init(&layers, viewport->overlays);
    while (g_hash_table_iter_next(&layers, &name, &overlay)) {
        studio_renderer_set_overlay(viewport->renderer, name, overlay);
    }
    g_signal_emit(viewport, signals[SIGNAL_READY], 0);
}

static void on_unrealize(GtkGLArea *area, gpointer data) {
    (void)data;
    StudioViewport *viewport = STUDIO_VIEWPORT(area);
    gtk_gl_area_make_current(area);
    if (gtk_gl_area_get_error(area) == NULL) {
        g_clear_pointer(&viewport->renderer, studio_renderer_free);
    }
}

// The view is turned, but its button is held where it was: there is nothing to draw.
static bool is_held_still(const StudioViewport *viewport) {
    double rested = (double)(g_get_monotonic_time() - viewport->moved) * 1e-6;
    return viewport->is_moving && rested > rest_seconds && !viewport->display.has_wind;
}

static gboolean on_tick(GtkWidget *widget, GdkFrameClock *clock, gpointer data) {
    (void)clock;
    (void)data;
    StudioViewport *viewport = STUDIO_VIEWPORT(widget);
    double rested = (double)(g_get_monotonic_time() - viewport->moved) * 1e-6;
    if (viewport->is_moving && rested > (viewport->is_dragging ? held_seconds : rest_seconds)) {
        viewport->is_moving = false;
    }
    if (is_held_still(viewport)) {
        return G_SOURCE_CONTINUE;
    }
    gtk_gl_area_queue_render(GTK_GL_AREA(widget));
    return G_SOURCE_CONTINUE;
}

void studio_viewport_wake(StudioViewport *viewport) {
    if (viewport->tick == 0) {
        viewport->tick = gtk_widget_add_tick_callback(GTK_WIDGET(viewport), on_tick, NULL, NULL);
    }
    viewport->was_done = false;
    gtk_gl_area_queue_render(GTK_GL_AREA(viewport));
    g_signal_emit(viewport, signals[SIGNAL_WOKEN], 0);
}

static void on_resize(GtkGLArea *area, int width, int height, gpointer data) {
    (void)data;
    StudioViewport *viewport = STUDIO_VIEWPORT(area);
    if (viewport->renderer != NULL) {
        studio_renderer_resize(viewport->renderer, width, height,
                               gtk_widget_get_scale_factor(GTK_WIDGET(area)));
        studio_viewport_wake(viewport);
    }
}

static gboolean on_render(GtkGLArea *area, GdkGLContext *context, gpointer data) {
    (void)context;
    (void)data;
    StudioViewport *viewport = STUDIO_VIEWPORT(area);
    if (viewport->renderer == NULL) {
        return FALSE;
    }
    viewport->display.scale = gtk_widget_get_scale_factor(GTK_WIDGET(area));
    viewport->display.cell = studio_camera_step(&viewport->camera, 0.1);
    gint64 now = g_get_monotonic_time();
    studio_wind_advance(&viewport->display.wind, (double)(now - viewport->drawn) * 1e-6);
    viewport->drawn = now;
    bool has_more = studio_renderer_draw(viewport->renderer, &viewport->camera, &viewport->display,
                                         viewport->is_moving || viewport->display.has_wind);
    if (viewport->stamp != NULL) {
        glFinish();
        *viewport->stamp = g_get_monotonic_time();
        viewport->stamp = NULL;
    }
    if (!has_more && viewport->tick != 0) {
        gtk_widget_remove_tick_callback(GTK_WIDGET(viewport), viewport->tick);
        viewport->tick = 0;
    }
    if (!has_more && !viewport->was_done) {
        viewport->was_done = true;
        g_signal_emit(viewport, signals[SIGNAL_DRAWN], 0);
    }
    return TRUE;
}

// ---- what it shows -----------------------------------------------------------------------------

bool studio_viewport_is_ready(StudioViewport *viewport) {
    return viewport->renderer != NULL;
}

const char *studio_viewport_error(StudioViewport *viewport) {
    return viewport->error;
}

void studio_viewport_take(StudioViewport *viewport, const StudioView *view) {
    gtk_gl_area_make_current(GTK_GL_AREA(viewport));
    StudioStore *store = studio_renderer_store(viewport->renderer);
    studio_store_update(store, view);
    studio_renderer_invalidate(viewport->renderer, true);
    double min[3], max[3];
    studio_store_bounds(store, min, max);
    if (!viewport->is_framed && max[0] >= min[0]) {
        viewport->is_framed = true;
        studio_viewport_frame_all(viewport);
        if (view->scene->views->len > 0) {
            studio_viewport_see(viewport, g_ptr_array_index(view->scene->views, 0));
        }
    }
    studio_viewport_wake(viewport);
}

void studio_viewport_add_picture(StudioViewport *viewport, const StudioPicture *picture) {
    gtk_gl_area_make_current(GTK_GL_AREA(viewport));
    studio_store_add_picture(studio_renderer_store(viewport->renderer), picture);
    studio_renderer_invalidate(viewport->renderer, true);
    studio_viewport_wake(viewport);
}

void studio_viewport_forget(StudioViewport *viewport) {
    viewport->is_framed = false;
    viewport->camera = studio_camera_default();
    if (viewport->renderer != NULL) {
        gtk_gl_area_make_current(GTK_GL_AREA(viewport));
        studio_store_clear(studio_renderer_store(viewport->renderer));
        studio_renderer_invalidate(viewport->renderer, true);
        studio_viewport_wake(viewport);
    }
}

StudioDisplay *studio_viewport_display(StudioViewport *viewport) {
    return &viewport->display;
}

void studio_viewport_update(StudioViewport *viewport) {
    if (viewport->renderer != NULL) {
        studio_renderer_invalidate(viewport->renderer, false);
        studio_viewport_wake(viewport);
    }
}

StudioCamera *studio_viewport_camera(StudioViewport *viewport) {
    return &viewport->camera;
}

void studio_viewport_bounds(StudioViewport *viewport, double min[3], double max[3]) {
    if (viewport->renderer != NULL) {
        studio_store_bounds(studio_renderer_store(viewport->renderer), min, max);
    } else {
        min[0] = min[1] = min[2] = 1;
        max[0] = max[1] = max[2] = -1;
    }
}

void studio_viewport_frame(StudioViewport *viewport, const double min[3], const double max[3]) {
    studio_camera_frame(&viewport->camera, min, max, studio_viewport_aspect(viewport));
    studio_viewport_update(viewport);
}

void studio_viewport_frame_all(StudioViewport *viewport) {
    if (viewport->renderer != NULL) {
        double min[3], max[3];
        studio_store_bounds(studio_renderer_store(viewport->renderer), min, max);
        studio_viewport_frame(viewport, min, max);
    }
}

void studio_viewport_see(StudioViewport *viewport, const FrViewParams *view) {
    double min[3], max[3];
    studio_store_bounds(studio_renderer_store(viewport->renderer), min, max);
    studio_camera_see(&viewport->camera, view, min, max, studio_viewport_aspect(viewport));
    studio_viewport_update(viewport);
}

void studio_viewport_set_overlay(StudioViewport *viewport, const char *name,
                                 StudioOverlay *overlay) {
    bool is_change = overlay != NULL || g_hash_table_contains(viewport->overlays, name);
    if (overlay == NULL) {
        g_hash_table_remove(viewport->overlays, name);
    } else {
        g_hash_table_replace(viewport->overlays, g_strdup(name), overlay);
    }
    if (is_change && viewport->renderer != NULL) {
        gtk_gl_area_make_current(GTK_GL_AREA(viewport));
        studio_renderer_set_overlay(viewport->renderer, name, overlay);
        studio_viewport_wake(viewport);
    }
}

void studio_viewport_highlight(StudioViewport *viewport, const float (*points)[3], uint32_t count) {
    static const float paint[4] = {1.0f, 0.62f, 0.13f, 1.0f};
    StudioOverlay *overlay = count == 0 ? NULL : studio_overlay_new();
    for (uint32_t i = 0; i + 1 < count; i += 2) {
        double ends[2][3];
        for (int k = 0; k < 6; k++) {
            ends[k / 3][k % 3] = (double)points[i + (uint32_t)k / 3][k % 3];
        }
        studio_overlay_line(overlay, ends[0], ends[1], 3, paint);
    }
    if (overlay != NULL) {
        overlay->through = 1;
    }
    studio_viewport_set_overlay(viewport, "picked", overlay);
}

void studio_viewport_stamp(StudioViewport *viewport, gint64 *stamp) {
    viewport->stamp = stamp;
}

bool studio_viewport_is_done(StudioViewport *viewport) {
    bool is_held = viewport->is_dragging && is_held_still(viewport);
    return viewport->was_done || viewport->display.has_wind || is_held;
}

StudioPace studio_viewport_pace(StudioViewport *viewport) {
    return viewport->renderer == NULL ? (StudioPace){0} : studio_renderer_pace(viewport->renderer);
}

StudioAmount studio_viewport_amount(StudioViewport *viewport) {
    return viewport->renderer == NULL
               ? (StudioAmount){0}
               : studio_store_amount(studio_renderer_store(viewport->renderer));
}

// ---- life --------------------------------------------------------------------------------------

static void studio_viewport_finalize(GObject *object) {
    g_free(STUDIO_VIEWPORT(object)->error);
    g_hash_table_unref(STUDIO_VIEWPORT(object)->overlays);
    G_OBJECT_CLASS(studio_viewport_parent_class)->finalize(object);
}

static void studio_viewport_class_init(StudioViewportClass *class) {
    G_OBJECT_CLASS(class)->finalize = studio_viewport_finalize;
    gtk_widget_class_set_accessible_role(GTK_WIDGET_CLASS(class), GTK_ACCESSIBLE_ROLE_IMG);
    gtk_widget_class_set_css_name(GTK_WIDGET_CLASS(class), "plantview");
    GType type = G_TYPE_FROM_CLASS(class);
    signals[SIGNAL_READY] =
        g_signal_new("ready", type, G_SIGNAL_RUN_LAST, 0, NULL, NULL, NULL, G_TYPE_NONE, 0);
    signals[SIGNAL_DRAWN] =
        g_signal_new("drawn", type, G_SIGNAL_RUN_LAST, 0, NULL, NULL, NULL, G_TYPE_NONE, 0);
    signals[SIGNAL_WOKEN] =
        g_signal_new("woken", type, G_SIGNAL_RUN_LAST, 0, NULL, NULL, NULL, G_TYPE_NONE, 0);
    studio_viewport_add_signals(type);
}

static void studio_viewport_init(StudioViewport *viewport) {
    GtkGLArea *area = GTK_GL_AREA(viewport);
    viewport->camera = studio_camera_default();
    viewport->overlays =
        g_hash_table_new_full(g_str_hash, g_str_equal, g_free, (GDestroyNotify)studio_overlay_free);
    viewport->display = (StudioDisplay){.mode = STUDIO_SHADED,
                                        .has_shadow = true,
                                        .has_occlusion = true,
                                        .has_grid = true,
                                        .wind = studio_wind_default(),
                                        .is_dark = true};
    gtk_gl_area_set_required_version(area, 3, 3);
    // Else a frame that GTK draws for its own reasons, as for the focus, may show an older picture.
    gtk_gl_area_set_auto_render(area, TRUE);
    gtk_widget_set_focusable(GTK_WIDGET(viewport), TRUE);
    studio_name(GTK_WIDGET(viewport), "Picture of the plants");
    g_signal_connect(area, "realize", G_CALLBACK(on_realize), NULL);
    g_signal_connect(area, "unrealize", G_CALLBACK(on_unrealize), NULL);
    g_signal_connect(area, "resize", G_CALLBACK(on_resize), NULL);
    g_signal_connect(area, "render", G_CALLBACK(on_render), NULL);
    studio_viewport_add_controllers(viewport);
}

GtkWidget *studio_viewport_new(void) {
    return g_object_new(STUDIO_TYPE_VIEWPORT, NULL);
}
