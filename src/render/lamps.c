// Light from lamps (Pharr, Jakob, Humphreys 2016, Physically Based Rendering, sections 6.2
// and 12.2). A lamp of power Φ gives a radiance of Φ / πA from an area, and of I / πr² from a ball,
// where I is Φ over the solid angle that it shines into. A ball is sampled as the disc that faces
// the point.
#include "render/lamps.h"

#include "frond/scene.h"
#include "render/colour.h"

#include <math.h>

// Pictures count light in parts of the sun's outside the atmosphere, W/m².
#define SOLAR_CONSTANT 1361.0
// How often the walls of a light room see the light of its lamps.
#define LAMPLIGHT 2.5f

/// The lamp's colour, of luminance 1.
static vec3s tint_of(const FrLampParams *params) {
    vec3s colour = fr_srgb_decode3(params->colour);
    return glms_vec3_scale(colour, 1 / fmaxf(fr_luminance(colour), 1e-3f));
}

static FrShiningLamp shining(const FrLampParams *params, const double origin[3]) {
    FrLamp lamp = fr_scene_lamp(params);
    vec3s shift = {{(float)origin[0], (float)origin[1], (float)origin[2]}};
    FrShiningLamp made = {.is_area = lamp.kind == FR_LAMP_AREA,
                          .at = glms_vec3_sub(lamp.position, shift),
                          .side = {lamp.side[0], lamp.side[1]},
                          .axis = glms_vec3_normalize(lamp.direction),
                          .cosine = lamp.kind == FR_LAMP_SPOT ? cosf(lamp.angle) : -1,
                          .radius = (float)params->radius};
    float power = (float)(lamp.power / SOLAR_CONSTANT);
    float brightness;
    if (made.is_area) {
        made.area = glms_vec3_norm(glms_vec3_cross(lamp.side[0], lamp.side[1]));
        brightness = power / (FR_PI_F * made.area);
    } else {
        made.area = FR_PI_F * made.radius * made.radius;
        brightness = power / (2 * FR_PI_F * (1 - made.cosine) * made.area);
    }
    made.radiance = glms_vec3_scale(tint_of(params), brightness);
    made.chance = power;
    return made;
}

FrLampSet fr_lamps_new(const FrSurroundings *surroundings, const double origin[3]) {
    FrLampSet set = {0};
    guint count = surroundings == NULL ? 0 : surroundings->lamps->len;
    set.lamps = g_new(FrShiningLamp, count);
    float power = 0;
    for (guint i = 0; i < count; i++) {
        const FrLampParams *params = g_ptr_array_index(surroundings->lamps, i);
        if (params->power > 0) {
            FrShiningLamp *lamp = &set.lamps[set.count++];
            *lamp = shining(params, origin);
            power += lamp->chance;
            set.power = glms_vec3_muladds(tint_of(params), lamp->chance, set.power);
        }
    }
    for (uint32_t i = 0; i < set.count; i++) {
        set.lamps[i].chance /= power;
    }
    return set;
}

vec3s fr_lamps_light(const FrLampSet *set, vec3s size) {
    float surface = 2.0f * (size.x * size.y + size.y * size.z + size.z * size.x);
    bool is_room = surface > 1e-6f && isfinite(surface);
    return glms_vec3_scale(set->power, LAMPLIGHT / (is_room ? surface : 1.0f));
}

void fr_lamps_clear(FrLampSet *set) {
    g_free(set->lamps);
}

/// The light of a lamp along `direction`, which leads to it over `distance`.
static void look_at(const FrShiningLamp *lamp, vec3s direction, float distance,
                    FrLampSight *sight) {
    float cosine = -glms_vec3_dot(lamp->axis, direction);
    float facing = lamp->is_area ? cosine : 1;
    bool is_lit = lamp->is_area ? cosine > 1e-4f : lamp->cosine <= -1 || cosine >= lamp->cosine;
    *sight = (FrLampSight){.direction = direction, .distance = distance};
    if (is_lit) {
        sight->radiance = lamp->radiance;
        sight->density = lamp->chance * distance * distance / (facing * lamp->area);
    }
}

FrLampSight fr_lamps_sample(const FrLampSet *set, vec3s point, float choice, float u, float v) {
    uint32_t chosen = 0;
    for (; chosen + 1 < set->count && choice >= set->lamps[chosen].chance; chosen++) {
        choice -= set->lamps[chosen].chance;
    }
    const FrShiningLamp *lamp = &set->lamps[chosen];
    vec3s at = lamp->at;
    if (lamp->is_area) {
        at = glms_vec3_muladds(lamp->side[0], u, at);
        at = glms_vec3_muladds(lamp->side[1], v, at);
    }
    vec3s way = glms_vec3_sub(at, point);
    float distance = fmaxf(glms_vec3_norm(way), 1e-4f);
    FrLampSight sight;
    vec3s direction = glms_vec3_scale(way, 1 / distance);
    look_at(lamp, direction, distance, &sight);
    if (!lamp->is_area) {
        vec3s x, y;
        fr_basis(direction, &x, &y);
        float radius = lamp->radius * sqrtf(u), turn = 2 * FR_PI_F * v;
        way = glms_vec3_muladds(x, radius * cosf(turn), way);
        way = glms_vec3_muladds(y, radius * sinf(turn), way);
        sight.distance = glms_vec3_norm(way) - lamp->radius;
        sight.direction = glms_vec3_normalize(way);
    }
    return sight;
}

/// How far along a ray a lamp is; INFINITY if it is not met.
static float distance_to(const FrShiningLamp *lamp, vec3s origin, vec3s direction) {
    vec3s way = glms_vec3_sub(lamp->at, origin);
    if (!lamp->is_area) {
        float middle = glms_vec3_dot(way, direction);
        float beside = glms_vec3_dot(way, way) - middle * middle;
        float half = lamp->radius * lamp->radius - beside;
        return half >= 0 && middle > 0 ? middle - sqrtf(half) : INFINITY;
    }
    float slope = glms_vec3_dot(lamp->axis, direction);
    float distance = glms_vec3_dot(lamp->axis, way) / slope;
    vec3s at = glms_vec3_sub(glms_vec3_scale(direction, distance), way);
    float u = glms_vec3_dot(at, lamp->side[0]) / glms_vec3_dot(lamp->side[0], lamp->side[0]);
    float v = glms_vec3_dot(at, lamp->side[1]) / glms_vec3_dot(lamp->side[1], lamp->side[1]);
    bool is_met = distance > 0 && u >= 0 && u <= 1 && v >= 0 && v <= 1;
    return is_met ? distance : INFINITY;
}

bool fr_lamps_meet(const FrLampSet *set, vec3s origin, vec3s direction, float far,
                   FrLampSight *sight) {
    const FrShiningLamp *met = NULL;
    for (uint32_t i = 0; i < set->count; i++) {
        float distance = distance_to(&set->lamps[i], origin, direction);
        if (distance > 0 && distance < far) {
            far = distance;
            met = &set->lamps[i];
        }
    }
    if (met != NULL) {
        look_at(met, direction, far, sight);
    }
    return met != NULL;
}
