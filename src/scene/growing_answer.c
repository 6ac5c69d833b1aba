/// Answers to the open symbols of L-systems: the light of the scene, and how much room there is.
#include "scene/growing_parts.h"

#include <cglm/struct.h>

/// What asks for light; everything else is the model's own environment's.
static bool is_light(const FrGrowing *growing, const FrLquery *query) {
    return growing->lighting != NULL &&
           (query->symbol == 'R' || query->symbol == 'I' || query->symbol == 'E');
}

static vec3s turned(vec3s v, double angle) {
    return glms_vec3_rotate(v, (float)angle, (vec3s){{0, 0, 1}});
}

static vec3s place_of(const FrSprout *sprout, const FrLquery *query) {
    const double *at = sprout->stand.at;
    vec3s origin = {{(float)at[0], (float)at[1], (float)at[2]}};
    vec3s local = glms_vec3_scale(query->position, (float)sprout->stand.scale);
    return glms_vec3_add(turned(local, sprout->stand.turn), origin);
}

static void tell(const FrLquery *query, unsigned k, float value) {
    if (k < query->count && (query->asked >> k & 1) != 0) {
        query->parameters[k] = value;
    }
}

/// `direction` is in the plant's coordinates.
static void answer_light(const FrLquery *query, const FrLightAnswer *light, vec3s direction) {
    if (query->symbol == 'R') {
        fr_lquery_bend(query, direction);
        return;
    }
    const float told[FR_LFIRST_OF_SPACE] = {light->intensity, direction.x, direction.y, direction.z,
                                            light->confidence};
    for (unsigned k = 0; k < FR_LFIRST_OF_SPACE; k++) {
        tell(query, k, told[k]);
    }
}

static FrStatus answer_lights(FrGrowing *growing, const FrLquery *queries, size_t count,
                              const FrContext *context) {
    const FrSprout *sprout = growing->asking;
    vec3s *points = g_new(vec3s, count);
    FrLightAnswer *answers = g_new0(FrLightAnswer, count);
    size_t lit = 0;
    for (size_t i = 0; i < count; i++) {
        if (is_light(growing, &queries[i])) {
            points[lit++] = place_of(sprout, &queries[i]);
        }
    }
    FrStatus status = FR_OK;
    if (growing->lighting != NULL) {
        status = fr_lighting_query(growing->lighting, points, lit, context, answers);
    }
    lit = 0;
    for (size_t i = 0; i < count && status == FR_OK; i++) {
        if (is_light(growing, &queries[i])) {
            vec3s direction = turned(answers[lit].direction, -sprout->stand.turn);
            answer_light(&queries[i], &answers[lit++], direction);
        }
    }
    growing->queries += lit;
    g_free(points);
    g_free(answers);
    return status;
}

/// Lengths are in metres of the plant, before it is scaled.
static float told_length(const FrSprout *sprout, double length) {
    return (float)(length >= FR_CLEARANCE_FREE ? FR_CLEARANCE_FREE : length / sprout->stand.scale);
}

/// D(around, ahead), or what follows the light in ?E. What the model measures itself may be nearer.
static void answer_space(const FrGrowing *growing, const FrLquery *query) {
    const FrSprout *sprout = growing->asking;
    unsigned first = query->symbol == 'D' ? 0 : FR_LFIRST_OF_SPACE;
    vec3s place = place_of(sprout, query), along = turned(query->heading, sprout->stand.turn);
    double at[3], way[3];
    for (int axis = 0; axis < 3; axis++) {
        at[axis] = (double)place.raw[axis];
        way[axis] = (double)along.raw[axis];
    }
    if (query->count > first && (query->asked >> first & 1) != 0) {
        float own = query->symbol == 'D' ? query->parameters[0] : (float)FR_CLEARANCE_FREE;
        double around = fr_clearance_around(growing->clearance, at, sprout->plant);
        tell(query, first, fminf(own, told_length(sprout, around)));
    }
    if (query->count > first + 1 && (query->asked >> (first + 1) & 1) != 0) {
        double ahead = fr_clearance_ahead(growing->clearance, at, way, sprout->plant);
        tell(query, first + 1, told_length(sprout, ahead));
    }
}

typedef struct Asking {
    const FrGrowing *growing;
    const FrLquery *queries;
} Asking;

static void answer_spaces(void *data, size_t begin, size_t end, int worker) {
    (void)worker;
    const Asking *asking = data;
    for (size_t i = begin; i < end; i++) {
        const FrLquery *query = &asking->queries[i];
        if (query->symbol == 'D' || query->symbol == 'E') {
            answer_space(asking->growing, query);
        }
    }
}

static FrStatus answer_anew(FrGrowing *growing, const FrLquery *queries, size_t count,
                            const FrContext *context) {
    const FrSprout *sprout = growing->asking;
    FrLsettings plain = fr_lmodel_settings(sprout->definition->lsystem);
    FrStatus status = FR_OK;
    for (size_t i = 0; i < count && status == FR_OK; i++) {
        if (!is_light(growing, &queries[i])) {
            status = plain.environment->answer(plain.environment->data, &queries[i], 1, context);
        }
    }
    if (status == FR_OK) {
        status = answer_lights(growing, queries, count, context);
    }
    if (status == FR_OK && growing->clearance != NULL) {
        enum { GRAIN = 64 };
        Asking asking = {growing, queries};
        fr_parallel_for(context->pool, count, GRAIN, answer_spaces, &asking, NULL);
    }
    return status;
}

FrStatus fr_growing_answer(void *data, const FrLquery *queries, size_t count,
                           const FrContext *context) {
    FrGrowing *growing = data;
    FrSprout *sprout = growing->asking;
    uint64_t step = fr_lderivation_step(sprout->derivation);
    if (growing->is_regrowing) {
        bool is_same = fr_answers_give(&sprout->answers, step, queries, count);
        return is_same ? FR_OK : FR_ERR_DOCUMENT;
    }
    FrStatus status = answer_anew(growing, queries, count, context);
    if (status == FR_OK) {
        fr_answers_note(&sprout->answers, step, queries, count);
    }
    return status;
}
