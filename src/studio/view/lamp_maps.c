#include "studio/view/lamp_maps.h"

#include "studio/view/program.h"

#include <math.h>
#include <string.h>

enum { ACROSS = 4, DOWN = 3, SIZE = 512, UNIT = 4 }; // maps in the picture, their pixels, its unit

static const float widest = 150 * (float)G_PI / 180; // of one map
static const float area_opening = 140 * (float)G_PI / 180;
static const float margin = 6 * (float)G_PI / 180;

void studio_lamp_maps_clear(StudioLampMaps *maps) {
    studio_target_clear(&maps->depths);
}

// The opening of the one map of a lamp; 0: it shines to all sides.
static float opening_of(const FrShadingLamp *lamp) {
    if (lamp->is_area) {
        return area_opening;
    }
    float opening = 2 * acosf(fminf(fmaxf(lamp->cosine, -1), 1)) + margin;
    return opening > widest ? 0 : opening;
}

// The farthest corner of the box.
static float reach_of(vec3s at, const double min[3], const double max[3]) {
    double square = 0;
    for (int i = 0; i < 3; i++) {
        double place = (double)at.raw[i];
        double far = fmax(fabs(min[i] - place), fabs(max[i] - place));
        square += far * far;
    }
    return (float)sqrt(square);
}

static void add_map(StudioLampMaps *maps, const FrShadingLamp *lamp, vec3s way, float opening,
                    float far) {
    float near = fmaxf(fmaxf(0.25f * lamp->near, 0.002f * far), 1e-4f);
    vec3s up = fabsf(way.z) > 0.9f ? (vec3s){{0, 1, 0}} : (vec3s){{0, 0, 1}};
    maps->to_map[maps->count] =
        glms_mat4_mul(glms_perspective(opening, 1, near, fmaxf(far, 2 * near)),
                      glms_lookat(lamp->at, glms_vec3_add(lamp->at, way), up));
    maps->eye[maps->count++] = lamp->at;
}

static void add_lamp(StudioLampMaps *maps, const FrShadingLamp *lamp, uint32_t index, float far) {
    // In the order in which the shader counts them.
    static const vec3s sides[6] = {{{1, 0, 0}},  {{-1, 0, 0}}, {{0, 1, 0}},
                                   {{0, -1, 0}}, {{0, 0, 1}},  {{0, 0, -1}}};
    float opening = opening_of(lamp);
    uint32_t faces = opening > 0 ? 1 : 6;
    bool is_shining = lamp->intensity.r + lamp->intensity.g + lamp->intensity.b > 0;
    if (!is_shining || maps->count + faces > STUDIO_LAMP_MAPS) {
        return;
    }
    float face = opening > 0 ? opening : (float)G_PI / 2;
    maps->first[index] = maps->count;
    maps->faces[index] = faces;
    maps->wide[index] = 0.5f * lamp->near / tanf(0.5f * face);
    for (uint32_t i = 0; i < faces; i++) {
        add_map(maps, lamp, faces == 1 ? lamp->axis : sides[i], face, far);
    }
}

void studio_lamp_maps_aim(StudioLampMaps *maps, const FrShading *shading, const double min[3],
                          const double max[3]) {
    maps->count = maps->ready = 0;
    memset(maps->faces, 0, sizeof maps->faces);
    for (uint32_t i = 0; max[0] >= min[0] && i < shading->lamp_count; i++) {
        const FrShadingLamp *lamp = &shading->lamps[i];
        add_lamp(maps, lamp, i, 1.01f * reach_of(lamp->at, min, max));
    }
    if (maps->count > 0 && maps->depths.frame == 0) {
        studio_target_make_shadow(&maps->depths, ACROSS * SIZE, DOWN * SIZE);
    }
}

void studio_lamp_maps_open(const StudioLampMaps *maps, uint32_t map) {
    studio_target_open(&maps->depths);
    glViewport(SIZE * (GLint)(map % ACROSS), SIZE * (GLint)(map / ACROSS), SIZE, SIZE);
}

void studio_lamp_maps_begin(const StudioLampMaps *maps, uint32_t map) {
    studio_lamp_maps_open(maps, map);
    glEnable(GL_SCISSOR_TEST);
    glScissor(SIZE * (GLint)(map % ACROSS), SIZE * (GLint)(map / ACROSS), SIZE, SIZE);
    glClear(GL_DEPTH_BUFFER_BIT);
    glDisable(GL_SCISSOR_TEST);
}

StudioOutlook studio_lamp_maps_outlook(const StudioLampMaps *maps, uint32_t map) {
    StudioOutlook outlook = {.clip = maps->to_map[map]};
    memcpy(outlook.eye, maps->eye[map].raw, sizeof outlook.eye);
    return outlook;
}

void studio_lamp_maps_use(const StudioLampMaps *maps, GLuint program, bool is_shown) {
    float about[FR_SHADING_LAMPS][3] = {0}; // first, faces, wide
    for (int i = 0; i < FR_SHADING_LAMPS; i++) {
        bool is_ready = is_shown && maps->first[i] + maps->faces[i] <= maps->ready;
        about[i][0] = (float)maps->first[i];
        about[i][1] = is_ready ? (float)maps->faces[i] : 0;
        about[i][2] = maps->wide[i];
    }
    glActiveTexture(GL_TEXTURE0 + UNIT);
    glBindTexture(GL_TEXTURE_2D, maps->depths.depth);
    studio_program_int(program, "lamp_maps", UNIT);
    glUniform3fv(glGetUniformLocation(program, "lamp_map"), FR_SHADING_LAMPS, about[0]);
    glUniformMatrix4fv(glGetUniformLocation(program, "to_lamp"), STUDIO_LAMP_MAPS, GL_FALSE,
                       maps->to_map[0].raw[0]);
}
