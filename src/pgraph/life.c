#include "pgraph/life.h"

#include <math.h>

static bool is_always(const FrNumber *number, double value) {
    return number->is_constant && number->constant == value;
}

void fr_prepare_life(FrPrepared *made) {
    const FrBasicParams *basic = made->params;
    made->grows = !is_always(&basic->growth, 0);
    made->is_timed = made->grows || !is_always(&basic->birth, 0) ||
                     !is_always(&basic->lifetime, 0) || !is_always(&basic->time_scale, 1) ||
                     !is_always(&basic->chance, 1);
    made->varies |= made->is_timed; // by its age
}

bool fr_instance_lives(const FrExpansion *expansion, uint32_t row, FrEvaluator *evaluator) {
    const FrLevel *level = &expansion->level;
    const FrPrepared *prepared = fr_stage_prepared(expansion, level->stage[row]);
    double around = (double)level->clock[row];
    level->age[row] = level->clock[row];
    if (!prepared->is_timed || around < 0) {
        return around >= 0;
    }
    fr_instance_enter(expansion, row, evaluator);
    const FrBasicParams *basic = prepared->params;
#define FR_GET(field) fr_value(evaluator, &basic->field, FR_BASIC_##field)
    double age = (around - FR_GET(birth)) * FR_GET(time_scale);
    age = fmin(age, 1e9);
    level->age[row] = (float)age;
    evaluator->vars.value[FR_VAR_age] = age;
    double lifetime = FR_GET(lifetime), chance = FR_GET(chance);
    // What grows is nothing at the moment of its birth.
    bool is_born = prepared->grows && FR_GET(growth) > 0 ? age > 0 : age >= 0;
#undef FR_GET
    bool is_chosen =
        chance >= 1 || fr_random(level->key[row], fr_purpose(FR_BASIC_chance), 1) < chance;
    return is_born && is_chosen && (lifetime <= 0 || age <= lifetime);
}

double fr_growth_now(const FrPrepared *prepared, FrEvaluator *evaluator) {
    const FrBasicParams *basic = prepared->params;
    double time = fr_value(evaluator, &basic->growth, FR_BASIC_growth);
    double age = evaluator->vars.value[FR_VAR_age];
    if (age >= time && basic->growth_curve == NULL) {
        return 1;
    }
    double part = time > 0 ? fmin(age / time, 1) : 1;
    part = basic->growth_curve != NULL ? fr_curve_eval(basic->growth_curve, part) : part;
    return fmax(0, fmin(part, 1));
}

double fr_growth_when(const FrCurve *curve, double part) {
    enum { HALVINGS = 40 };
    if (curve == NULL) {
        return part;
    }
    double early = 0, late = 1;
    for (int k = 0; k < HALVINGS; k++) {
        double middle = 0.5 * (early + late);
        *(fr_curve_eval(curve, middle) < part ? &early : &late) = middle;
    }
    return late;
}
