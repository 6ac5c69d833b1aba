// Evaluations of expressions: the interpreter beside the same formula compiled by the C compiler.
#include "bench.h"

#include <math.h>

enum { EVALUATIONS = 100000 };

typedef struct Work {
    FrExpr *expr;
    FrNumber number;
    double (*formula)(const FrVars *vars);
    FrVars vars;
} Work;

// The next child, so that no evaluation repeats the one before.
static void next_child(FrVars *vars, uint32_t i) {
    vars->value[FR_VAR_t] = (double)(i & 1023) * (1.0 / 1023);
    vars->value[FR_VAR_i] = i & 1023;
    vars->key = i;
}

static void evaluate(void *data) {
    Work *work = data;
    double sum = 0;
    for (uint32_t i = 0; i < EVALUATIONS; i++) {
        next_child(&work->vars, i);
        sum += fr_expr_eval(work->expr, &work->vars, NULL);
    }
    bench_keep(&sum);
}

static void compute(void *data) {
    Work *work = data;
    double sum = 0;
    for (uint32_t i = 0; i < EVALUATIONS; i++) {
        next_child(&work->vars, i);
        bench_keep(&work->vars);
        sum += work->formula(&work->vars);
    }
    bench_keep(&sum);
}

static void evaluate_number(void *data) {
    Work *work = data;
    double sum = 0;
    for (uint32_t i = 0; i < EVALUATIONS; i++) {
        next_child(&work->vars, i);
        sum += fr_number_eval(&work->number, &work->vars, 1, NULL);
    }
    bench_keep(&sum);
}

static double polynomial(const FrVars *vars) {
    double t = vars->value[FR_VAR_t];
    return ((((t * 0.3 + 0.7) * t - 1.1) * t + 0.5) * t - 0.2) * t + 0.1;
}

static double wave(const FrVars *vars) {
    return 30 + 10 * sin(6.283185307179586 * vars->value[FR_VAR_t]);
}

static double choice(const FrVars *vars) {
    return fmod(vars->value[FR_VAR_i], 2) == 0 ? 60 + 5 * vars->value[FR_VAR_t] : 50;
}

static double draw(const FrVars *vars) {
    return 2 * fr_random(vars->key, vars->purpose, 0) - 1;
}

void bench_expr(void) {
    static const struct {
        const char *name, *text;
        double (*formula)(const FrVars *vars);
    } expressions[] = {
        {"expr.polynomial", "((((t*0.3 + 0.7)*t - 1.1)*t + 0.5)*t - 0.2)*t + 0.1", polynomial},
        {"expr.sine", "30 + 10*sin(2*pi*t)", wave},
        {"expr.choice", "i % 2 == 0 ? 60 + 5*t : 50", choice},
        {"expr.random", "2*rand() - 1", draw},
    };
    for (size_t i = 0; i < G_N_ELEMENTS(expressions); i++) {
        Work work = {.formula = expressions[i].formula};
        work.expr = fr_expr_compile(expressions[i].text, (FrSpan){0}, NULL, NULL);
        double rate = EVALUATIONS / bench_shortest(60, evaluate, &work);
        double limit = EVALUATIONS / bench_shortest(60, compute, &work);
        bench_tell(expressions[i].name, rate, limit, "evaluations/s", "%s; limit: the same in C",
                   expressions[i].text);
        fr_expr_unref(work.expr);
    }
    static const char *const numbers[][2] = {
        {"expr.number", "80..30 ~ 5"},
        {"expr.number-function", "80..30 ~ 5 : t^2"},
        {"expr.number-curve", "80..30 : bell"},
    };
    for (size_t i = 0; i < G_N_ELEMENTS(numbers); i++) {
        Work work = {0};
        fr_number_parse(&work.number, numbers[i][1], (FrSpan){0}, 1, 0, 90, NULL, NULL);
        double rate = EVALUATIONS / bench_shortest(60, evaluate_number, &work);
        bench_tell(numbers[i][0], rate, 0, "numbers/s", "%s", numbers[i][1]);
        fr_number_clear(&work.number);
    }
}
