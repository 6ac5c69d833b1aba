// The turtle's pass before a step. ?P, ?H, ?L, ?U and ?Q are filled from the turtle; ?E and open
// parameters become one batch of queries in the order of the string.
#include "lsystem/ask.h"

#include <cglm/struct.h>
#include <math.h>

typedef struct Pass {
    FrLderivation *derivation;
    FrLturtle turtle;
    GArray *queries; ///< FrLquery
} Pass;

static void put(uint32_t *module, unsigned k, double value) {
    if (k < fr_lhead_count(*module)) {
        module[1 + k] = fr_lword(value);
    }
}

static void fill_vector(uint32_t *module, const double v[3]) {
    for (unsigned k = 0; k < 3; k++) {
        put(module, k, v[k]);
    }
}

static void fill_quaternion(uint32_t *module, const FrLpose *pose) {
    versors q = fr_lbuilder_frame(pose->heading, pose->left);
    for (unsigned k = 0; k < 4; k++) {
        put(module, k, (double)q.raw[k]);
    }
}

static uint64_t open_parameters(const uint32_t *module) {
    uint64_t asked = 0;
    for (unsigned k = 0; k < MIN(fr_lhead_count(*module), 64); k++) {
        asked |= (uint64_t)(module[1 + k] == FR_LOPEN) << k;
    }
    return asked;
}

static void add_query(Pass *pass, uint32_t *module, uint64_t asked, uint64_t origin) {
    const FrLpose *pose = &pass->turtle.pose;
    const FrLstring *string = pass->derivation->string;
    const uint32_t *next = module + 1 + fr_lhead_count(*module);
    float unit = (float)pass->derivation->settings.unit;
    bool is_last = next >= string->words + string->count;
    FrLquery query = {.symbol = (char)fr_lhead_symbol(*module),
                      .following = is_last ? '\0' : (char)fr_lhead_symbol(*next),
                      .count = (uint8_t)fr_lhead_count(*module),
                      .asked = asked,
                      .parameters = (float *)(void *)(module + 1),
                      .module = origin,
                      .position = glms_vec3_scale(fr_lturtle_world(pose->position), unit),
                      .heading = fr_lturtle_world(pose->heading),
                      .left = fr_lturtle_world(pose->left),
                      .up = fr_lturtle_world(pose->up),
                      .width = (float)pose->width,
                      .scale = (float)pose->scale};
    g_array_append_val(pass->queries, query);
}

/// s(x,y) and s(x,y,z), which cpfg fills as ?P where it fills any.
static bool is_old_query(const Pass *pass, uint32_t head) {
    unsigned count = fr_lhead_count(head);
    return fr_lhead_symbol(head) == 's' && (count == 2 || count == 3) && !pass->turtle.is_raw &&
           pass->turtle.skip == 0 && !pass->derivation->system->is_paper;
}

static bool take(void *data, const uint32_t *module, uint64_t origin) {
    Pass *pass = data;
    FrLstring *string = pass->derivation->string;
    bool is_own = module >= string->words && module < string->words + string->count;
    if (is_own) {
        uint32_t *own = string->words + (module - string->words);
        const FrLpose *pose = &pass->turtle.pose;
        char symbol = pass->turtle.prefix == '?' ? (char)fr_lhead_symbol(*module) : '\0';
        uint64_t asked = open_parameters(module);
        unsigned count = fr_lhead_count(*module);
        if (symbol == 'P' || symbol == 'H' || symbol == 'L' || symbol == 'U') {
            fill_vector(own, symbol == 'P'   ? pose->position
                             : symbol == 'H' ? pose->heading
                             : symbol == 'L' ? pose->left
                                             : pose->up);
        } else if (symbol == 'Q') {
            fill_quaternion(own, pose);
        } else if (symbol == 'E') {
            add_query(pass, own, count >= 64 ? UINT64_MAX : (UINT64_C(1) << count) - 1, origin);
        } else if (asked != 0) {
            add_query(pass, own, asked, origin);
        } else if (is_old_query(pass, *module)) {
            fill_vector(own, pose->position);
        }
    }
    return fr_lturtle_take(&pass->turtle, module, origin);
}

FrStatus fr_lderivation_ask(FrLderivation *derivation, const FrContext *context) {
    if (derivation->is_answered || !derivation->system->is_open) {
        return FR_OK;
    }
    Pass pass = {.derivation = derivation, .queries = g_array_new(FALSE, FALSE, sizeof(FrLquery))};
    fr_lturtle_init(&pass.turtle, derivation, NULL, context);
    FrStatus status = fr_lderive_interpret(derivation, take, &pass.turtle.is_raw, &pass, context);
    status = MAX(status, pass.turtle.status);
    const FrEnvironment *environment = derivation->settings.environment;
    if (status == FR_OK && environment != NULL && pass.queries->len > 0) {
        status = environment->answer(environment->data,
                                     (const FrLquery *)(const void *)pass.queries->data,
                                     pass.queries->len, context);
    }
    fr_lturtle_clear(&pass.turtle);
    g_array_unref(pass.queries);
    derivation->is_answered = status == FR_OK;
    return status;
}
