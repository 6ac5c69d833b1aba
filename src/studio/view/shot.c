#include "studio/view/shot.h"

#include "studio/view/piece.h"
#include "studio/view/shaders.h"
#include "studio/view/surface_shader.h"

#include <math.h>
#include <string.h>

bool studio_programs_new(StudioPrograms *programs, GError **error) {
    const struct {
        GLuint *program;
        const char *vertex, *fragment;
    } all[] = {
        {&programs->surface, studio_surface_vertex, studio_surface_fragment},
        {&programs->plain, studio_plain_vertex, studio_plain_fragment},
        {&programs->still, studio_still_vertex, studio_still_fragment},
        {&programs->shadow, studio_shadow_vertex, studio_shadow_fragment},
        {&programs->floor, studio_floor_vertex, studio_floor_fragment},
        {&programs->line, studio_line_vertex, studio_line_fragment},
        {&programs->backdrop, studio_whole_vertex, studio_backdrop_fragment},
        {&programs->show, studio_whole_vertex, studio_show_fragment},
    };
    for (size_t i = 0; i < G_N_ELEMENTS(all); i++) {
        *all[i].program = studio_program_new(all[i].vertex, all[i].fragment, error);
        if (*all[i].program == 0) {
            return false;
        }
    }
    return true;
}

void studio_programs_clear(StudioPrograms *programs) {
    const GLuint all[] = {programs->surface, programs->plain, programs->still,    programs->shadow,
                          programs->floor,   programs->line,  programs->backdrop, programs->show};
    for (size_t i = 0; i < G_N_ELEMENTS(all); i++) {
        glDeleteProgram(all[i]);
    }
}

static void use_shadow(const StudioShot *shot, GLuint program) {
    glActiveTexture(GL_TEXTURE1);
    glBindTexture(GL_TEXTURE_2D, shot->shadow);
    studio_program_int(program, "shadow", 1);
    studio_program_int(program, "has_shadow", shot->has_shadow);
    studio_program_matrix(program, "to_shadow", &shot->to_shadow);
}

static void use_wind(const StudioShot *shot, GLuint program) {
    double min[3], max[3];
    studio_store_bounds(shot->store, min, max);
    float gust[4];
    studio_wind_gust(&shot->display->wind, shot->display->has_wind ? fmax(max[2], 0) : 0, gust);
    studio_program_vec4(program, "gust", gust);
}

void studio_shot_use(const StudioShot *shot, GLuint program) {
    float sun[3];
    studio_store_sun(shot->store, sun);
    glUseProgram(program);
    studio_program_matrix(program, "clip", &shot->clip);
    studio_program_vec3(program, "eye", shot->eye);
    studio_program_vec3(program, "sun", sun);
    studio_program_int(program, "is_wire", shot->display->mode == STUDIO_WIREFRAME);
    studio_piece_light(program, studio_store_shading(shot->store));
    studio_lamp_maps_use(shot->lamps, program, shot->display->has_shadow);
    use_wind(shot, program);
    use_shadow(shot, program);
    glPolygonMode(GL_FRONT_AND_BACK, shot->display->mode == STUDIO_WIREFRAME ? GL_LINE : GL_FILL);
}

// ---- around the plants -------------------------------------------------------------------------

static void draw_backdrop(const StudioShot *shot) {
    static const float dark[2][3] = {{0.205f, 0.215f, 0.235f}, {0.115f, 0.120f, 0.132f}};
    static const float light[2][3] = {{0.86f, 0.88f, 0.90f}, {0.66f, 0.68f, 0.70f}};
    const float(*colours)[3] = shot->display->is_dark ? dark : light;
    GLuint program = shot->programs->backdrop;
    glDisable(GL_DEPTH_TEST);
    glUseProgram(program);
    studio_program_vec3(program, "above", colours[1]);
    studio_program_vec3(program, "below", colours[0]);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glEnable(GL_DEPTH_TEST);
}

static void draw_floor(const StudioShot *shot, const StudioCamera *camera) {
    GLuint program = shot->programs->floor;
    glUseProgram(program);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    studio_program_matrix(program, "clip", &shot->clip);
    studio_program_float(program, "extent", (float)(3.2 * fmax(shot->radius, camera->distance)));
    studio_program_vec2(program, "centre", (float)camera->target[0], (float)camera->target[1]);
    studio_program_float(program, "cell", (float)shot->display->cell);
    static const float dark[3] = {0.27f, 0.285f, 0.275f}, light[3] = {0.80f, 0.815f, 0.79f};
    studio_program_int(program, "has_grid", shot->display->has_grid);
    studio_program_vec3(program, "ground", shot->display->is_dark ? dark : light);
    studio_program_int(program, "is_plain", shot->is_plain);
    use_shadow(shot, program);
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
    glDepthMask(GL_FALSE);
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
}

static void draw_skeleton(void *user, const mat4s *model, GLuint points, uint32_t count) {
    const StudioShot *shot = user;
    GLuint program = shot->programs->line;
    studio_program_matrix(program, "model", model);
    glBindBuffer(GL_ARRAY_BUFFER, points);
    studio_piece_attribute(0, 3, sizeof(StudioPoint), 0, 0);
    studio_piece_attribute(1, 1, sizeof(StudioPoint), offsetof(StudioPoint, order), 0);
    glDrawArrays(GL_LINES, 0, (GLsizei)count);
}

void studio_shot_draw_skeletons(StudioShot *shot) {
    GLuint program = shot->programs->line;
    glUseProgram(program);
    studio_program_matrix(program, "clip", &shot->clip);
    // From wood to green, both to be read on the backdrop.
    static const float dark[3][3] = {
        {0.93f, 0.78f, 0.55f}, {0.45f, 0.80f, 0.42f}, {0.16f, 0.17f, 0.185f}};
    static const float light[3][3] = {
        {0.42f, 0.27f, 0.10f}, {0.12f, 0.42f, 0.12f}, {0.76f, 0.78f, 0.80f}};
    const float(*colours)[3] = shot->display->is_dark ? dark : light;
    studio_program_vec3(program, "first", colours[0]);
    studio_program_vec3(program, "last", colours[1]);
    studio_program_vec3(program, "behind", colours[2]);
    double nearest = fmax(shot->distance - shot->radius, 0);
    studio_program_vec2(program, "haze", (float)nearest,
                        (float)(shot->distance + shot->radius - nearest));
    use_wind(shot, program);
    studio_store_each_skeleton(shot->store, draw_skeleton, shot);
}

void studio_shot_begin(const StudioShot *shot, const StudioTarget *target,
                       const StudioCamera *camera) {
    studio_target_open(target);
    glClear(GL_DEPTH_BUFFER_BIT);
    if (shot->display->is_clear) {
        glClearColor(0, 0, 0, 0);
        glClear(GL_COLOR_BUFFER_BIT);
    } else {
        draw_backdrop(shot);
        draw_floor(shot, camera);
    }
}

StudioOutlook studio_shot_outlook(const StudioShot *shot) {
    StudioOutlook outlook = {.clip = shot->clip, .slack = shot->display->has_wind ? 0.5f : 0.02f};
    memcpy(outlook.eye, shot->eye, sizeof outlook.eye);
    return outlook;
}

StudioShot studio_shot_new(const StudioStore *store, const StudioCamera *camera,
                           const StudioDisplay *display, double aspect) {
    double min[3], max[3], radius = 0;
    studio_store_bounds(store, min, max);
    for (int i = 0; i < 3; i++) {
        double far = fmax(fabs(min[i] - camera->target[i]), fabs(max[i] - camera->target[i]));
        radius += max[i] >= min[i] ? far * far : 1;
    }
    radius = sqrt(radius);
    StudioShot shot = {
        .store = store, .display = display, .distance = camera->distance, .radius = radius};
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
