// Where a stem forks, and into what.
// After the stem splits of: Weber, Penn. Creation and Rendering of Realistic Trees. SIGGRAPH 1995.
//
// A fork ends a limb and begins as many as it has arms. All arms go on to where the stem would have
// ended. The first keeps the stem's axis and key, so that a stem that forks is the same stem up to
// there and along its first arms; each other arm has an axis and a key of its own.
#include "pgraph/fork.h"

#include <math.h>
#include <string.h>

#define PI 3.14159265358979323846

enum { MOST_LIMB_INTERNODES = 24 };

// A limb is at least so long, as a part of the stem.
#define SHORTEST 0.01
// A fork lies at most this far off its place, in distances between forks.
#define JITTER 0.3
// So many radii of a limb get an internode, so that its arms are bent where they are thick.
#define RADII_PER_INTERNODE 5.0

typedef struct Forking {
    FrStem *stem;
    FrEvaluator *evaluator;
    const FrStemParams *params;
    double start, end, forks;
    uint32_t most; ///< forks on the way to a tip
    GArray *limbs; ///< FrLimb
} Forking;

static double value_of(const Forking *forking, const FrNumber *number, uint32_t parameter,
                       const FrLimb *limb, double at) {
    FrVars *vars = &forking->evaluator->vars;
    FrKey key = vars->key;
    double x = vars->value[FR_VAR_x];
    vars->key = fr_key_child(limb->key, limb->forks);
    vars->value[FR_VAR_x] = at;
    double value = fr_value(forking->evaluator, number, parameter);
    vars->key = key;
    vars->value[FR_VAR_x] = x;
    return value;
}

#define FR_GET(field, limb, at)                                                                    \
    value_of(forking, &forking->params->field, FR_STEM_##field, limb, at)

// The fork at the end of a limb, 1 if it goes on to the tip.
static double fork_of(const Forking *forking, const FrLimb *limb) {
    double left = forking->forks - limb->forks;
    if (!(left > 0) ||
        (left < 1 && fr_random(limb->key, fr_purpose(FR_STEM_forks), limb->forks) >= left)) {
        return 1;
    }
    double gap = (forking->end - forking->start) / forking->most;
    double off = JITTER * fr_random_signed(limb->key, fr_purpose(FR_STEM_fork_start), limb->forks);
    double at = (forking->start + (limb->forks + 0.5 + off) * gap) / forking->stem->whole;
    at = fmax(at, limb->start + SHORTEST);
    return at < 1 - SHORTEST ? at : 1;
}

static void divide(const Forking *forking, FrLimb *limb) {
    const FrStem *stem = forking->stem;
    double span = limb->end - limb->start;
    double count = span * stem->internodes;
    if (forking->params->segments == 0) {
        double radius = fr_stem_radius(stem, limb->start) * limb->thinner;
        double wanted = span * stem->length / (RADII_PER_INTERNODE * radius);
        count = fmax(count, fmin(wanted, MOST_LIMB_INTERNODES));
    }
    limb->internodes = (uint32_t)fmax(1, ceil(count - 1e-9));
}

// Appends the arms of a fork at the end of limb `from`.
static void add_arms(Forking *forking, uint32_t from, uint32_t *axes) {
    const FrLimb before = g_array_index(forking->limbs, FrLimb, from);
    double at = before.end;
    uint32_t count = (uint32_t)forking->params->fork_arms;
    double angle = FR_GET(fork_angle, &before, at), balance = FR_GET(fork_balance, &before, at);
    double azimuth = FR_GET(fork_azimuth, &before, at);
    for (uint32_t arm = 0; arm < count; arm++) {
        FrLimb limb = {
            .start = at,
            .before = from,
            .forks = before.forks + 1,
            .axis = arm == 0 ? before.axis : (*axes)++,
            .begins_axis = arm > 0,
            .arms = (uint16_t)(before.arms | arm << 2 * MIN(before.forks, 6u)),
            .key = arm == 0 ? before.key
                            : fr_key_child(fr_key_child(before.key, fr_purpose(FR_STEM_forks)),
                                           before.forks * 4ull + arm),
        };
        limb.turn = arm == 0 ? 0.5 * balance * angle : angle - 0.5 * balance * angle;
        double towards = azimuth + 2 * PI * arm / count;
        limb.turn_x = -sin(towards) * limb.turn;
        limb.turn_y = cos(towards) * limb.turn;
        limb.straightness = FR_GET(fork_straightness, &limb, at);
        limb.thinner = before.thinner * FR_GET(fork_radius, &limb, at);
        limb.end = fork_of(forking, &limb);
        divide(forking, &limb);
        g_array_append_val(forking->limbs, limb);
    }
}

// The first place at or above `at`.
static uint32_t place_from(const FrPlaces *places, double at) {
    uint32_t low = 0, high = places->count;
    while (low < high) {
        uint32_t middle = low + (high - low) / 2;
        if (fr_place_at(places, middle) < at) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low;
}

// Numbers the limbs' rows and hands each the places along it.
static void settle(FrStem *stem) {
    uint32_t node = 0;
    const FrPlaces *places = &stem->places;
    for (uint32_t k = 0; k < stem->limb_count; k++) {
        FrLimb *limb = &stem->limbs[k];
        limb->first = node;
        limb->span = limb->end - limb->start;
        node += limb->internodes;
        stem->axes = MAX(stem->axes, limb->axis + 1);
        stem->tips += limb->end >= 1;
        if (places->branches > 0) {
            uint64_t from = (uint64_t)place_from(places, limb->start) * places->whorl;
            uint64_t to = limb->end < 1 ? place_from(places, limb->end) : places->count;
            limb->first_branch = (uint32_t)MIN(from, places->branches);
            limb->end_branch = (uint32_t)MIN(to * places->whorl, places->branches);
        }
    }
    stem->internodes = node;
}

void fr_stem_fork(FrStem *stem, FrEvaluator *evaluator) {
    const FrStemParams *params = stem->prepared->params;
    if (!(stem->forks > 0) || stem->course != FR_COURSE_GROWN || !(stem->length > 0)) {
        return;
    }
    double start = fr_value(evaluator, &params->fork_start, FR_STEM_fork_start);
    double end = fr_value(evaluator, &params->fork_end, FR_STEM_fork_end);
    Forking forks = {
        .stem = stem,
        .evaluator = evaluator,
        .params = params,
        .start = fmin(start, end),
        .end = fmax(start, end),
        .forks = stem->forks,
        .most = (uint32_t)ceil(stem->forks),
        .limbs = g_array_new(FALSE, FALSE, sizeof(FrLimb)),
    };
    FrLimb trunk = {.before = FR_NONE, .thinner = 1, .begins_axis = true, .key = stem->key};
    uint32_t axes = 1;
    trunk.end = fork_of(&forks, &trunk);
    divide(&forks, &trunk);
    g_array_append_val(forks.limbs, trunk);
    for (uint32_t k = 0; k < forks.limbs->len; k++) {
        if (g_array_index(forks.limbs, FrLimb, k).end < 1) {
            add_arms(&forks, k, &axes);
        }
    }
    stem->limb_count = forks.limbs->len;
    stem->limbs = (FrLimb *)(void *)g_array_free(forks.limbs, FALSE);
    stem->axes = stem->tips = 0;
    stem->gaps = 0;
    settle(stem);
}

void fr_stem_grow_limbs(FrStem *stem) {
    uint32_t count = 0, node = 0, axes = 0;
    uint32_t *kept = g_new(uint32_t, stem->limb_count), *axis = g_new(uint32_t, stem->axes);
    memset(axis, 0xff, stem->axes * sizeof *axis); // FR_NONE
    stem->tips = 0;
    for (uint32_t k = 0; k < stem->limb_count; k++) {
        FrLimb limb = stem->limbs[k];
        kept[k] = FR_NONE;
        if (limb.before != FR_NONE && limb.start >= stem->reach) {
            continue;
        }
        kept[k] = count;
        limb.before = limb.before != FR_NONE ? kept[limb.before] : FR_NONE;
        if (axis[limb.axis] == FR_NONE) {
            axis[limb.axis] = axes++;
        }
        limb.axis = axis[limb.axis];
        limb.start /= stem->reach;
        limb.span /= stem->reach;
        limb.end = fmin(limb.end / stem->reach, 1);
        limb.first = node;
        node += limb.internodes;
        stem->tips += limb.end >= 1;
        stem->limbs[count++] = limb;
    }
    stem->limb_count = count;
    stem->axes = axes;
    stem->internodes = node;
    g_free(kept);
    g_free(axis);
}

void fr_stem_clear(FrStem *stem) {
    g_clear_pointer(&stem->limbs, g_free);
}
