#include "studio/view/renderer.h"

#include "studio/model/pace.h"
#include "studio/view/overlays.h"
#include "studio/view/piece.h"
#include "studio/view/shot.h"

#include <math.h>

enum {
    SHADOW_SIZE = 2048,
    SHADOW_TRIANGLES = 250000,
    LAMP_TRIANGLES = 60000, // of each map
    SLICE_TRIANGLES = 12000,
    PIECE_COST = 500,         // of a piece by itself, in triangles
    WIRE_TRIANGLES = 1000000, // from which on a wireframe is a coarse one
    SAMPLES = 2,              // of the fine picture, a side of a pixel of the desktop
};

static const double slice_seconds = 0.022; // of the fine picture, between two frames

typedef enum Stage { STAGE_NOTHING, STAGE_SHADOW, STAGE_FINE, STAGE_DONE } Stage;

struct StudioRenderer {
    StudioStore *store;
    GLuint array; // the one vertex array object
    StudioPrograms programs;
    StudioTarget coarse, fine, shadow_map;
    int width, height;
    int across, down;    // pixels of the desktop
    StudioPacing pacing; // of coarse pictures
    Stage stage;         // of the fine picture
    bool is_coarse_old;
    guint map; // of shadows that is to be drawn next: that of the sun, then those of lamps
    StudioLampMaps lamps;
    GArray *slices; // StudioPiece of the stage
    guint next;     // slice
    double fine_began, fine_spent;
    mat4s to_shadow;
    StudioOverlays *overlays;
    StudioPace pace;
};

static double now(void) {
    return (double)g_get_monotonic_time() * 1e-6;
}

// ---- life --------------------------------------------------------------------------------------

StudioRenderer *studio_renderer_new(GError **error) {
    StudioRenderer *renderer = g_new0(StudioRenderer, 1);
    bool is_good = studio_programs_new(&renderer->programs, error);
    renderer->overlays = is_good ? studio_overlays_new(error) : NULL;
    if (renderer->overlays == NULL) {
        studio_renderer_free(renderer);
        return NULL;
    }
    glGenVertexArrays(1, &renderer->array);
    renderer->store = studio_store_new();
    renderer->pacing = studio_pacing_new();
    renderer->is_coarse_old = true;
    studio_target_make_shadow(&renderer->shadow_map, SHADOW_SIZE, SHADOW_SIZE);
    return renderer;
}

void studio_renderer_free(StudioRenderer *renderer) {
    if (renderer == NULL) {
        return;
    }
    studio_store_free(renderer->store);
    studio_overlays_free(renderer->overlays);
    studio_programs_clear(&renderer->programs);
    glDeleteVertexArrays(1, &renderer->array);
    studio_target_clear(&renderer->coarse);
    studio_target_clear(&renderer->fine);
    studio_target_clear(&renderer->shadow_map);
    studio_lamp_maps_clear(&renderer->lamps);
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
    renderer->across = MAX(width / scale, 1);
    renderer->down = MAX(height / scale, 1);
    studio_target_resize(&renderer->fine, SAMPLES * renderer->across, SAMPLES * renderer->down);
    studio_renderer_invalidate(renderer, false);
}

void studio_renderer_invalidate(StudioRenderer *renderer, bool is_geometry) {
    renderer->stage = STAGE_NOTHING;
    renderer->is_coarse_old = true;
    renderer->map = is_geometry ? 0 : renderer->map;
}

// ---- pictures ----------------------------------------------------------------------------------

// In this order: what stands still, all else, and what is clear.
enum { GROUP_STILL, GROUP_OTHER, GROUP_CLEAR, GROUP_COUNT };

static int group_of(const StudioPiece *piece) {
    return piece->look.clear > 0 ? GROUP_CLEAR : piece->is_still ? GROUP_STILL : GROUP_OTHER;
}

static void draw_group(const StudioShot *shot, GLuint program, const GArray *list, int group) {
    studio_shot_use(shot, program);
    StudioPen pen = studio_pen_begin(program, false);
    for (guint i = 0; i < list->len; i++) {
        const StudioPiece *piece = &g_array_index(list, StudioPiece, i);
        if (group_of(piece) == group) {
            studio_pen_draw(&pen, piece);
        }
    }
    studio_pen_end(&pen);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
}

static uint64_t triangles_of(const GArray *list) {
    uint64_t triangles = 0;
    for (guint i = 0; i < list->len; i++) {
        triangles += g_array_index(list, StudioPiece, i).triangles;
    }
    return triangles;
}

static void draw_coarse(StudioRenderer *renderer, StudioShot *shot, const StudioCamera *camera) {
    double began = now();
    StudioPacing *pacing = &renderer->pacing;
    studio_target_resize(&renderer->coarse, MAX((int)(pacing->scale * renderer->across), 1),
                         MAX((int)(pacing->scale * renderer->down), 1));
    shot->is_plain = pacing->is_plain;
    studio_shot_begin(shot, &renderer->coarse, camera);
    renderer->pace.coarse_triangles = 0;
    if (shot->display->mode == STUDIO_SKELETON) {
        studio_shot_draw_skeletons(shot);
    } else {
        StudioOutlook outlook = studio_shot_outlook(shot);
        const StudioPrograms *programs = &renderer->programs;
        const GLuint plain[GROUP_COUNT] = {programs->still, programs->plain, programs->still};
        GArray *list = studio_store_list_coarse(renderer->store, &outlook,
                                                (uint64_t)pacing->triangles, UINT32_MAX);
        for (int group = 0; group < GROUP_COUNT; group++) {
            draw_group(shot, shot->is_plain ? plain[group] : programs->surface, list, group);
        }
        renderer->pace.coarse_triangles = triangles_of(list);
        g_array_unref(list);
    }
    glFinish();
    renderer->pace.coarse_seconds = now() - began;
    studio_pacing_learn(pacing, renderer->pace.coarse_seconds, renderer->pace.coarse_triangles);
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

static bool has_sun(const StudioRenderer *renderer) {
    vec3s sun = studio_store_shading(renderer->store)->sun;
    return sun.r + sun.g + sun.b > 0;
}

static GArray *begin_sun_map(StudioRenderer *renderer) {
    double min[3], max[3];
    studio_store_bounds(renderer->store, min, max);
    studio_lamp_maps_aim(&renderer->lamps, studio_store_shading(renderer->store), min, max);
    aim_shadow(renderer);
    studio_target_open(&renderer->shadow_map);
    glClear(GL_DEPTH_BUFFER_BIT);
    if (!has_sun(renderer)) {
        return g_array_new(FALSE, FALSE, sizeof(StudioPiece));
    }
    return studio_store_list_coarse(renderer->store, NULL, SHADOW_TRIANGLES, SLICE_TRIANGLES);
}

static GArray *begin_lamp_map(StudioRenderer *renderer) {
    uint32_t map = renderer->map - 1;
    StudioOutlook outlook = studio_lamp_maps_outlook(&renderer->lamps, map);
    studio_lamp_maps_begin(&renderer->lamps, map);
    return studio_store_list_coarse(renderer->store, &outlook, LAMP_TRIANGLES, SLICE_TRIANGLES);
}

static void begin_map(StudioRenderer *renderer) {
    begin_stage(renderer, STAGE_SHADOW,
                renderer->map == 0 ? begin_sun_map(renderer) : begin_lamp_map(renderer));
}

// Lines of more triangles would fill the picture: then those of the coarse scene are drawn.
static GArray *list_fine(const StudioShot *shot) {
    StudioMode mode = shot->display->mode;
    StudioOutlook outlook = studio_shot_outlook(shot);
    if (mode == STUDIO_SKELETON) {
        return g_array_new(FALSE, FALSE, sizeof(StudioPiece));
    }
    bool is_dense = studio_store_amount(shot->store).triangles > WIRE_TRIANGLES;
    return mode == STUDIO_WIREFRAME && is_dense
               ? studio_store_list_coarse(shot->store, &outlook, WIRE_TRIANGLES, SLICE_TRIANGLES)
               : studio_store_list_fine(shot->store, &outlook, SLICE_TRIANGLES);
}

static void begin_fine(StudioRenderer *renderer, const StudioShot *shot,
                       const StudioCamera *camera) {
    studio_shot_begin(shot, &renderer->fine, camera);
    begin_stage(renderer, STAGE_FINE, list_fine(shot));
}

static void end_fine(StudioRenderer *renderer, StudioShot *shot) {
    if (shot->display->mode == STUDIO_SKELETON) {
        studio_shot_draw_skeletons(shot);
    }
    renderer->stage = STAGE_DONE;
    renderer->pace.fine_triangles = triangles_of(renderer->slices);
}

// What is drawn from then on goes to the map of shadows.
static void use_map(const StudioRenderer *renderer) {
    const mat4s *clip = &renderer->to_shadow;
    if (renderer->map == 0) {
        studio_target_open(&renderer->shadow_map);
    } else {
        studio_lamp_maps_open(&renderer->lamps, renderer->map - 1);
        clip = &renderer->lamps.to_map[renderer->map - 1];
    }
    glUseProgram(renderer->programs.shadow);
    studio_program_matrix(renderer->programs.shadow, "clip", clip);
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(renderer->map == 0 ? 1.5f : 3,
                    2); // what lamps see is wide, and steep at its edge
}

// Draws slices of the stage until `until`; true if they are all drawn.
static bool draw_slices(StudioRenderer *renderer, const StudioShot *shot, double until) {
    bool is_shadow = renderer->stage == STAGE_SHADOW;
    GLuint program = is_shadow ? renderer->programs.shadow : renderer->programs.surface;
    if (is_shadow) {
        use_map(renderer);
    } else {
        studio_target_open(&renderer->fine);
        studio_shot_use(shot, program);
    }
    StudioPen pen = studio_pen_begin(program, !is_shadow);
    uint64_t waiting = 0; // triangles; small pieces are waited for together
    while (renderer->next < renderer->slices->len) {
        const StudioPiece *piece = &g_array_index(renderer->slices, StudioPiece, renderer->next++);
        if (!is_shadow || piece->look.clear < 0.5f) { // clear glass lets light through
            studio_pen_draw(&pen, piece);
        }
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
    studio_pen_end(&pen);
    glDisable(GL_POLYGON_OFFSET_FILL);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    return renderer->next == renderer->slices->len;
}

// Shadows are shown where there is a sun and a map of what it sees.
static void use_shadow_maps(const StudioRenderer *renderer, StudioShot *shot) {
    shot->shadow = renderer->shadow_map.depth;
    shot->to_shadow = renderer->to_shadow;
    shot->has_shadow = has_sun(renderer) && shot->display->has_shadow && renderer->map > 0;
    shot->lamps = &renderer->lamps;
}

// Shadows come first, as the fine picture needs them.
static void begin_next(StudioRenderer *renderer, StudioShot *shot, const StudioCamera *camera) {
    bool has_maps = shot->display->has_shadow && shot->display->mode != STUDIO_SKELETON;
    if (has_maps && renderer->map <= renderer->lamps.count) {
        begin_map(renderer);
    } else {
        use_shadow_maps(renderer, shot);
        begin_fine(renderer, shot, camera);
    }
}

static void end_stage(StudioRenderer *renderer, StudioShot *shot, const StudioCamera *camera) {
    if (renderer->stage == STAGE_FINE) {
        end_fine(renderer, shot);
        return;
    }
    renderer->lamps.ready = renderer->map++;
    begin_next(renderer, shot, camera);
}

static void refine(StudioRenderer *renderer, StudioShot *shot, const StudioCamera *camera) {
    double began = now(), until = began + slice_seconds;
    if (renderer->stage == STAGE_NOTHING) {
        renderer->fine_spent = 0;
        begin_next(renderer, shot, camera);
    }
    while (draw_slices(renderer, shot, until)) {
        end_stage(renderer, shot, camera);
        if (renderer->stage == STAGE_DONE || now() >= until) {
            break;
        }
    }
    glFinish();
    renderer->fine_spent += now() - began;
    if (renderer->stage == STAGE_DONE) {
        renderer->pace.fine_seconds = renderer->fine_spent;
    }
}

static void show(const StudioRenderer *renderer, const StudioShot *shot, const StudioTarget *target,
                 GLuint frame, bool has_occlusion) {
    GLuint program = renderer->programs.show;
    glBindFramebuffer(GL_FRAMEBUFFER, frame);
    glViewport(0, 0, renderer->width, renderer->height);
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
    if (shot->display->is_bare) {
        return;
    }
    StudioUnder under = {.clip = shot->clip,
                         .depths = target->depth,
                         .near = shot->near,
                         .far = shot->far,
                         .width = renderer->width,
                         .height = renderer->height,
                         .scale = (float)shot->display->scale};
    studio_overlays_draw(renderer->overlays, &under);
}

bool studio_renderer_draw(StudioRenderer *renderer, const StudioCamera *camera,
                          const StudioDisplay *display, bool is_moving) {
    GLint frame;
    glGetIntegerv(GL_FRAMEBUFFER_BINDING, &frame);
    glBindVertexArray(renderer->array);
    double aspect = (double)renderer->width / renderer->height;
    StudioShot shot = studio_shot_new(renderer->store, camera, display, aspect);
    shot.programs = &renderer->programs;
    use_shadow_maps(renderer, &shot);
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
    show(renderer, &shot, is_fine ? &renderer->fine : &renderer->coarse, (GLuint)frame,
         has_occlusion);
    return !is_fine;
}
