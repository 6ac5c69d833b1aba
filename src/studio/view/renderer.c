#include "studio/view/renderer.h"

#include "studio/view/overlays.h"
#include "studio/view/piece.h"
#include "studio/view/program.h"
#include "studio/view/shaders.h"
#include "studio/view/surface_shader.h"
#include "studio/view/target.h"

#include <math.h>

enum {
    SHADOW_SIZE = 2048,
    SHADOW_TRIANGLES = 250000,
    LEAST_BUDGET = 8000,
    MOST_BUDGET = 4000000,
    SLICE_TRIANGLES = 12000,
    PIECE_COST = 500,         // of a piece by itself, in triangles
    WIRE_TRIANGLES = 1000000, // from which on a wireframe is a coarse one
    SAMPLES = 2,              // of the fine picture, a side of a pixel of the desktop
};

static const double slice_seconds = 0.022; // of the fine picture, between two frames
static const double frame_seconds = 0.030; // wanted of a coarse one

typedef enum Stage { STAGE_NOTHING, STAGE_SHADOW, STAGE_FINE, STAGE_DONE } Stage;

struct StudioRenderer {
    StudioStore *store;
    GLuint array; // the one vertex array object
    GLuint surface, shadow, floor, line, backdrop, show;
    StudioTarget coarse, fine, shadow_map;
    int width, height;
    double budget; // triangles of a coarse picture
    Stage stage;   // of the fine picture
    bool is_shadow_old, has_shadow_map, is_coarse_old;
    GArray *slices; // StudioPiece of the stage
    guint next;     // slice
    double fine_began, fine_spent;
    mat4s to_shadow;
    StudioOverlays *overlays;
    StudioPace pace;
};

// What is the same for all pieces of a picture.
typedef struct Shot {
    const StudioRenderer *renderer;
    const StudioDisplay *display;
    mat4s clip;
    float eye[3];
    float near, far, reach;
    double radius;
} Shot;

static double now(void) {
    return (double)g_get_monotonic_time() * 1e-6;
}

// ---- life --------------------------------------------------------------------------------------

StudioRenderer *studio_renderer_new(GError **error) {
    StudioRenderer *renderer = g_new0(StudioRenderer, 1);
    struct {
        GLuint *program;
        const char *vertex, *fragment;
    } programs[] = {
        {&renderer->surface, studio_surface_vertex, studio_surface_fragment},
        {&renderer->shadow, studio_shadow_vertex, studio_shadow_fragment},
        {&renderer->floor, studio_floor_vertex, studio_floor_fragment},
        {&renderer->line, studio_line_vertex, studio_line_fragment},
        {&renderer->backdrop, studio_whole_vertex, studio_backdrop_fragment},
        {&renderer->show, studio_whole_vertex, studio_show_fragment},
    };
    for (size_t i = 0; i < G_N_ELEMENTS(programs); i++) {
        *programs[i].program = studio_program_new(programs[i].vertex, programs[i].fragment, error);
        if (*programs[i].program == 0) {
            studio_renderer_free(renderer);
            return NULL;
        }
    }
    renderer->overlays = studio_overlays_new(error);
    if (renderer->overlays == NULL) {
        studio_renderer_free(renderer);
        return NULL;
    }
    glGenVertexArrays(1, &renderer->array);
    renderer->store = studio_store_new();
    renderer->budget = 40000;
    renderer->is_shadow_old = true;
    renderer->is_coarse_old = true;
    studio_target_make_shadow(&renderer->shadow_map, SHADOW_SIZE);
    return renderer;
}

void studio_renderer_free(StudioRenderer *renderer) {
    if (renderer == NULL) {
        return;
    }
    studio_store_free(renderer->store);
    studio_overlays_free(renderer->overlays);
    const GLuint programs[] = {renderer->surface, renderer->shadow,   renderer->floor,
                               renderer->line,    renderer->backdrop, renderer->show};
    for (size_t i = 0; i < G_N_ELEMENTS(programs); i++) {
        glDeleteProgram(programs[i]);
    }
    glDeleteVertexArrays(1, &renderer->array);
    studio_target_clear(&renderer->coarse);
    studio_target_clear(&renderer->fine);
    studio_target_clear(&renderer->shadow_map);
    g_clear_pointer(&renderer->slices, g_array_unref);
    g_free(renderer);
}

StudioStore *studio_renderer_store(StudioRenderer *renderer) {
    return renderer->store;
}

void studio_renderer_set_overlay(StudioRenderer *renderer, const char *name,
                                 const StudioOverlay *overlay) {
    studio_overlays_set(renderer->overlays, name, overlay);
}

StudioPace studio_renderer_pace(const StudioRenderer *renderer) {
    return renderer->pace;
}

void studio_renderer_resize(StudioRenderer *renderer, int width, int height, int scale) {
    renderer->width = MAX(width, 1);
    renderer->height = MAX(height, 1);
    int across = MAX(width / scale, 1), down = MAX(height / scale, 1);
    studio_target_resize(&renderer->coarse, across, down);
    studio_target_resize(&renderer->fine, SAMPLES * across, SAMPLES * down);
    studio_renderer_invalidate(renderer, false);
}

void studio_renderer_invalidate(StudioRenderer *renderer, bool is_geometry) {
    renderer->stage = STAGE_NOTHING;
    renderer->is_coarse_old = true;
    renderer->is_shadow_old = renderer->is_shadow_old || is_geometry;
}

// ---- what is the same for all pieces ------------------------------------------------------------

static bool shows_shadow(const Shot *shot) {
    const FrShading *shading = studio_store_shading(shot->renderer->store);
    bool shines = shading->sun.r + shading->sun.g + shading->sun.b > 0;
    return shines && shot->display->has_shadow && shot->renderer->has_shadow_map;
}

static void use_shadow(const Shot *shot, GLuint program) {
    glActiveTexture(GL_TEXTURE1);
    glBindTexture(GL_TEXTURE_2D, shot->renderer->shadow_map.depth);
    studio_program_int(program, "shadow", 1);
    studio_program_int(program, "has_shadow", shows_shadow(shot));
    studio_program_matrix(program, "to_shadow", &shot->renderer->to_shadow);
}

static void use_wind(const Shot *shot, GLuint program) {
    double min[3], max[3];
    studio_store_bounds(shot->renderer->store, min, max);
    float gust[4];
    studio_wind_gust(&shot->display->wind, shot->display->has_wind ? fmax(max[2], 0) : 0, gust);
    studio_program_vec4(program, "gust", gust);
}

static GLuint begin_surfaces(const Shot *shot) {
    GLuint program = shot->renderer->surface;
    float sun[3];
    studio_store_sun(shot->renderer->store, sun);
    glUseProgram(program);
    studio_program_matrix(program, "clip", &shot->clip);
    studio_program_vec3(program, "eye", shot->eye);
    studio_program_vec3(program, "sun", sun);
    studio_program_int(program, "is_wire", shot->display->mode == STUDIO_WIREFRAME);
    studio_piece_light(program, studio_store_shading(shot->renderer->store));
    use_wind(shot, program);
    use_shadow(shot, program);
    glPolygonMode(GL_FRONT_AND_BACK, shot->display->mode == STUDIO_WIREFRAME ? GL_LINE : GL_FILL);
    return program;
}

// ---- around the plants -------------------------------------------------------------------------

static void draw_backdrop(const Shot *shot) {
    static const float dark[2][3] = {{0.205f, 0.215f, 0.235f}, {0.115f, 0.120f, 0.132f}};
    static const float light[2][3] = {{0.86f, 0.88f, 0.90f}, {0.66f, 0.68f, 0.70f}};
    const float(*colours)[3] = shot->display->is_dark ? dark : light;
    GLuint program = shot->renderer->backdrop;
    glDisable(GL_DEPTH_TEST);
    glUseProgram(program);
    studio_program_vec3(program, "above", colours[1]);
    studio_program_vec3(program, "below", colours[0]);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glEnable(GL_DEPTH_TEST);
}

static void draw_floor(const Shot *shot, const StudioCamera *camera) {
    GLuint program = shot->renderer->floor;
    glUseProgram(program);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    studio_program_matrix(program, "clip", &shot->clip);
    studio_program_float(program, "extent", (float)(3.2 * fmax(shot->radius, camera->distance)));
    studio_program_vec2(program, "centre", (float)camera->target[0], (float)camera->target[1]);
    studio_program_float(program, "cell", (float)shot->display->cell);
    static const float dark[3] = {0.27f, 0.285f, 0.275f}, light[3] = {0.80f, 0.815f, 0.79f};
    studio_program_int(program, "has_grid", shot->display->has_grid);
    studio_program_vec3(program, "ground", shot->display->is_dark ? dark : light);
    use_shadow(shot, program);
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
    glDepthMask(GL_FALSE);
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
}

static void draw_skeleton(void *user, const mat4s *model, GLuint points, uint32_t count) {
    const Shot *shot = user;
    GLuint program = shot->renderer->line;
    studio_program_matrix(program, "model", model);
    glBindBuffer(GL_ARRAY_BUFFER, points);
    studio_piece_attribute(0, 3, sizeof(StudioPoint), 0, 0);
    studio_piece_attribute(1, 1, sizeof(StudioPoint), offsetof(StudioPoint, order), 0);
    glDrawArrays(GL_LINES, 0, (GLsizei)count);
}

static void draw_skeletons(Shot *shot) {
    GLuint program = shot->renderer->line;
    glUseProgram(program);
    studio_program_matrix(program, "clip", &shot->clip);
    use_wind(shot, program);
    studio_store_each_skeleton(shot->renderer->store, draw_skeleton, shot);
}

// ---- pictures ----------------------------------------------------------------------------------

static void open_target(const StudioTarget *target) {
    glBindFramebuffer(GL_FRAMEBUFFER, target->frame);
    glViewport(0, 0, target->width, target->height);
    glEnable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glDisable(GL_BLEND);
    glDepthFunc(GL_LEQUAL);
}

static void begin_picture(const Shot *shot, const StudioTarget *target,
                          const StudioCamera *camera) {
    open_target(target);
    glClear(GL_DEPTH_BUFFER_BIT);
    draw_backdrop(shot);
    draw_floor(shot, camera);
}

static void draw_coarse(StudioRenderer *renderer, Shot *shot, const StudioCamera *camera) {
    double began = now();
    begin_picture(shot, &renderer->coarse, camera);
    renderer->pace.coarse_triangles = 0;
    if (shot->display->mode == STUDIO_SKELETON) {
        draw_skeletons(shot);
    } else {
        GArray *list =
            studio_store_list_coarse(renderer->store, (uint64_t)renderer->budget, UINT32_MAX);
        StudioPen pen = studio_pen_begin(begin_surfaces(shot), false);
        for (guint i = 0; i < list->len; i++) {
            const StudioPiece *piece = &g_array_index(list, StudioPiece, i);
            studio_pen_draw(&pen, piece);
            renderer->pace.coarse_triangles += piece->triangles;
        }
        glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
        g_array_unref(list);
    }
    glFinish();
    double seconds = now() - began;
    renderer->pace.coarse_seconds = seconds;
    double factor = CLAMP(frame_seconds / fmax(seconds, 1e-4), 0.6, 1.3);
    if ((double)renderer->pace.coarse_triangles > 0.5 * renderer->budget || factor < 1) {
        renderer->budget = CLAMP(renderer->budget * factor, LEAST_BUDGET, MOST_BUDGET);
    }
    renderer->is_coarse_old = false;
}

// The sun sees the ball around everything.
static void aim_shadow(StudioRenderer *renderer) {
    double min[3], max[3];
    float sun[3];
    studio_store_bounds(renderer->store, min, max);
    studio_store_sun(renderer->store, sun);
    vec3s centre = {{0}}, up = {{0, 0, 1}};
    float radius = 0;
    for (int i = 0; i < 3; i++) {
        bool is_empty = !(max[i] >= min[i]);
        centre.raw[i] = is_empty ? 0 : (float)(0.5 * (min[i] + max[i]));
        float half = is_empty ? 0.5f : (float)(0.5 * (max[i] - min[i]));
        radius += half * half;
    }
    radius = 1.05f * sqrtf(fmaxf(radius, 1e-6f));
    if (fabsf(sun[2]) > 0.99f) {
        up = (vec3s){{0, 1, 0}};
    }
    vec3s eye = {{centre.x + 2 * radius * sun[0], centre.y + 2 * radius * sun[1],
                  centre.z + 2 * radius * sun[2]}};
    renderer->to_shadow =
        glms_mat4_mul(glms_ortho(-radius, radius, -radius, radius, 0.5f * radius, 5 * radius),
                      glms_lookat(eye, centre, up));
}

static void begin_stage(StudioRenderer *renderer, Stage stage, GArray *slices) {
    g_clear_pointer(&renderer->slices, g_array_unref);
    renderer->slices = slices;
    renderer->stage = stage;
    renderer->next = 0;
}

static void begin_shadow(StudioRenderer *renderer) {
    aim_shadow(renderer);
    open_target(&renderer->shadow_map);
    glClear(GL_DEPTH_BUFFER_BIT);
    renderer->has_shadow_map = false;
    begin_stage(renderer, STAGE_SHADOW,
                studio_store_list_coarse(renderer->store, SHADOW_TRIANGLES, SLICE_TRIANGLES));
}

// Lines of more triangles would fill the picture: then those of the coarse scene are drawn.
static GArray *list_fine(const StudioRenderer *renderer, StudioMode mode) {
    if (mode == STUDIO_SKELETON) {
        return g_array_new(FALSE, FALSE, sizeof(StudioPiece));
    }
    bool is_dense = studio_store_amount(renderer->store).triangles > WIRE_TRIANGLES;
    return mode == STUDIO_WIREFRAME && is_dense
               ? studio_store_list_coarse(renderer->store, WIRE_TRIANGLES, SLICE_TRIANGLES)
               : studio_store_list_fine(renderer->store, SLICE_TRIANGLES);
}

static void begin_fine(StudioRenderer *renderer, const Shot *shot, const StudioCamera *camera) {
    begin_picture(shot, &renderer->fine, camera);
    begin_stage(renderer, STAGE_FINE, list_fine(renderer, shot->display->mode));
}

static void end_fine(StudioRenderer *renderer, Shot *shot) {
    if (shot->display->mode == STUDIO_SKELETON) {
        draw_skeletons(shot);
    }
    renderer->stage = STAGE_DONE;
    renderer->pace.fine_seconds = renderer->fine_spent;
    renderer->pace.fine_triangles = 0;
    for (guint i = 0; i < renderer->slices->len; i++) {
        renderer->pace.fine_triangles += g_array_index(renderer->slices, StudioPiece, i).triangles;
    }
}

// Draws slices of the stage until `until`; true if they are all drawn.
static bool draw_slices(StudioRenderer *renderer, const Shot *shot, double until) {
    bool is_shadow = renderer->stage == STAGE_SHADOW;
    open_target(is_shadow ? &renderer->shadow_map : &renderer->fine);
    GLuint program = renderer->shadow;
    if (is_shadow) {
        glUseProgram(program);
        studio_program_matrix(program, "clip", &renderer->to_shadow);
        glEnable(GL_POLYGON_OFFSET_FILL);
        glPolygonOffset(1.5f, 2.0f);
    } else {
        program = begin_surfaces(shot);
    }
    StudioPen pen = studio_pen_begin(program, !is_shadow);
    uint64_t waiting = 0; // triangles; small pieces are waited for together
    while (renderer->next < renderer->slices->len) {
        const StudioPiece *piece = &g_array_index(renderer->slices, StudioPiece, renderer->next++);
        studio_pen_draw(&pen, piece);
        waiting += piece->triangles + PIECE_COST;
        if (waiting < SLICE_TRIANGLES) {
            continue;
        }
        waiting = 0;
        glFinish();
        if (now() >= until) {
            break;
        }
    }
    glDisable(GL_POLYGON_OFFSET_FILL);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    return renderer->next == renderer->slices->len;
}

static void refine(StudioRenderer *renderer, Shot *shot, const StudioCamera *camera) {
    double began = now(), until = began + slice_seconds;
    if (renderer->stage == STAGE_NOTHING) {
        renderer->fine_spent = 0;
        if (renderer->is_shadow_old && shot->display->has_shadow &&
            shot->display->mode != STUDIO_SKELETON) {
            begin_shadow(renderer);
        } else {
            begin_fine(renderer, shot, camera);
        }
    }
    bool is_stage_done = draw_slices(renderer, shot, until);
    if (is_stage_done && renderer->stage == STAGE_SHADOW) {
        renderer->is_shadow_old = false;
        renderer->has_shadow_map = true;
        begin_fine(renderer, shot, camera);
        is_stage_done = now() < until && draw_slices(renderer, shot, until);
    }
    if (is_stage_done && renderer->stage == STAGE_FINE) {
        end_fine(renderer, shot);
    }
    glFinish();
    renderer->fine_spent += now() - began;
}

static void show(const Shot *shot, const StudioTarget *target, GLuint frame, bool has_occlusion) {
    GLuint program = shot->renderer->show;
    glBindFramebuffer(GL_FRAMEBUFFER, frame);
    glViewport(0, 0, shot->renderer->width, shot->renderer->height);
    glDisable(GL_DEPTH_TEST);
    glUseProgram(program);
    glActiveTexture(GL_TEXTURE1);
    glBindTexture(GL_TEXTURE_2D, target->depth);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, target->colour);
    studio_program_int(program, "drawn", 0);
    studio_program_int(program, "depths", 1);
    studio_program_vec2(program, "planes", shot->near, shot->far);
    studio_program_float(program, "reach", shot->reach);
    studio_program_int(program, "has_occlusion", has_occlusion);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    StudioUnder under = {.clip = shot->clip,
                         .depths = target->depth,
                         .near = shot->near,
                         .far = shot->far,
                         .width = shot->renderer->width,
                         .height = shot->renderer->height,
                         .scale = (float)shot->display->scale};
    studio_overlays_draw(shot->renderer->overlays, &under);
}

static Shot shot_of(const StudioRenderer *renderer, const StudioCamera *camera,
                    const StudioDisplay *display) {
    double min[3], max[3], radius = 0;
    studio_store_bounds(renderer->store, min, max);
    for (int i = 0; i < 3; i++) {
        double far = fmax(fabs(min[i] - camera->target[i]), fabs(max[i] - camera->target[i]));
        radius += max[i] >= min[i] ? far * far : 1;
    }
    radius = sqrt(radius);
    double aspect = (double)renderer->width / renderer->height;
    Shot shot = {.renderer = renderer, .display = display, .radius = radius};
    mat4s projection = studio_camera_projection(camera, aspect, radius);
    shot.clip = glms_mat4_mul(projection, studio_camera_view(camera));
    float a = projection.raw[2][2], b = projection.raw[3][2];
    shot.near = b / (a - 1);
    shot.far = b / (a + 1);
    shot.reach = (float)(0.02 * camera->distance);
    double eye[3];
    studio_camera_eye(camera, eye);
    for (int i = 0; i < 3; i++) {
        shot.eye[i] = (float)eye[i];
    }
    return shot;
}

bool studio_renderer_draw(StudioRenderer *renderer, const StudioCamera *camera,
                          const StudioDisplay *display, bool is_moving) {
    GLint frame;
    glGetIntegerv(GL_FRAMEBUFFER_BINDING, &frame);
    glBindVertexArray(renderer->array);
    Shot shot = shot_of(renderer, camera, display);
    if (is_moving) {
        renderer->stage = STAGE_NOTHING;
    }
    if (renderer->is_coarse_old || is_moving) {
        draw_coarse(renderer, &shot, camera);
    } else if (renderer->stage != STAGE_DONE) {
        refine(renderer, &shot, camera);
    }
    bool is_fine = renderer->stage == STAGE_DONE;
    bool has_occlusion = is_fine && display->has_occlusion && display->mode == STUDIO_SHADED;
    show(&shot, is_fine ? &renderer->fine : &renderer->coarse, (GLuint)frame, has_occlusion);
    return !is_fine;
}
