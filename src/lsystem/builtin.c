// The functions of the language. Angles in degrees; random numbers from stream B, the generator
// of drand48 (POSIX), started as cpfg starts it.
#include "lsystem/scan.h"
#include "lsystem/view.h"
#include "lsystem/vm.h"

#include <math.h>
#include <string.h>

#define MOST_DRAWS 10000000

typedef enum Function {
    F_SIN,
    F_COS,
    F_TAN,
    F_ASIN,
    F_ACOS,
    F_ATAN,
    F_ATAN2,
    F_EXP,
    F_LOG,
    F_SQRT,
    F_FABS,
    F_FLOOR,
    F_CEIL,
    F_SIGN,
    F_TRUNC,
    F_SRAND,
    F_RAN,
    F_NRAN,
    F_BRAN,
    F_BIRAN,
    F_FUNC,
    F_CURVE_X,
    F_CURVE_Y,
    F_CURVE_Z,
    F_CURVE_GAL,
    F_PRINTF,
    F_STOP,
    F_SET_LENGTH,
    F_GET_LENGTH,
    F_OPEN,
    F_CLOSE,
    F_SCAN, ///< compiled to operators of its own
    F_LEFT_OUT
} Function;

// clang-format off
static const struct {
    const char *name;
    Function function;
    uint32_t least, most;
} functions[] = {
    {"sin", F_SIN, 1, 1}, {"cos", F_COS, 1, 1}, {"tan", F_TAN, 1, 1}, {"asin", F_ASIN, 1, 1},
    {"acos", F_ACOS, 1, 1}, {"atan", F_ATAN, 1, 2}, {"atan2", F_ATAN2, 2, 2}, {"exp", F_EXP, 1, 1},
    {"log", F_LOG, 1, 1}, {"sqrt", F_SQRT, 1, 1}, {"fabs", F_FABS, 1, 1},
    {"floor", F_FLOOR, 1, 1}, {"ceil", F_CEIL, 1, 1}, {"sign", F_SIGN, 1, 1},
    {"trunc", F_TRUNC, 1, 1}, {"srand", F_SRAND, 1, 1}, {"ran", F_RAN, 1, 1},
    {"nran", F_NRAN, 2, 2}, {"bran", F_BRAN, 2, 2}, {"biran", F_BIRAN, 2, 2},
    {"func", F_FUNC, 2, 2}, {"curveX", F_CURVE_X, 2, 2}, {"curveY", F_CURVE_Y, 2, 2},
    {"curveZ", F_CURVE_Z, 2, 2}, {"curveGAL", F_CURVE_GAL, 1, 1}, {"printf", F_PRINTF, 0, 32},
    {"stop", F_STOP, 1, 1}, {"SetDerivationLength", F_SET_LENGTH, 1, 1},
    {"GetDerivationLength", F_GET_LENGTH, 0, 1},
    {"fopen", F_OPEN, 2, 2}, {"fclose", F_CLOSE, 1, 1}, {"fprintf", F_LEFT_OUT, 0, 32},
    {"fscanf", F_SCAN, 2, 32}, {"fflush", F_LEFT_OUT, 0, 32}, {"play", F_LEFT_OUT, 0, 32},
    {"Display", F_LEFT_OUT, 0, 32}, {"inblob", F_LEFT_OUT, 0, 32},
    {"vvXmin", F_LEFT_OUT, 0, 1}, {"vvXmax", F_LEFT_OUT, 0, 1}, {"vvYmin", F_LEFT_OUT, 0, 1},
    {"vvYmax", F_LEFT_OUT, 0, 1}, {"vvZmin", F_LEFT_OUT, 0, 1}, {"vvZmax", F_LEFT_OUT, 0, 1},
    {"vvScale", F_LEFT_OUT, 0, 1},
};
// clang-format on

uint32_t fr_lbuiltin_find(const char *name, uint32_t *least, uint32_t *most) {
    for (uint32_t i = 0; i < G_N_ELEMENTS(functions); i++) {
        if (strcmp(functions[i].name, name) == 0) {
            *least = functions[i].least;
            *most = functions[i].most;
            return i;
        }
    }
    return FR_NONE;
}

bool fr_lbuiltin_is_pure(uint32_t function) {
    Function f = functions[function].function;
    bool draws = f >= F_SRAND && f <= F_BIRAN;
    return !draws && f != F_STOP && f != F_SET_LENGTH && f != F_PRINTF && f != F_OPEN &&
           f != F_CLOSE;
}

bool fr_lbuiltin_is_left_out(uint32_t function) {
    return functions[function].function == F_LEFT_OUT;
}

static double uniform(FrLmachine *machine) {
    return fr_lrandom_next(&machine->random.state);
}

// The polar method (Marsaglia, Bray 1964); its second value is kept for the next call.
static double normal(FrLmachine *machine) {
    FrLrandom *random = &machine->random;
    if (!random->is_seeded && !random->has_spare) {
        // Before srand() the kept value is 0: the first call gives the mean itself.
        random->is_seeded = true;
        return 0;
    }
    if (random->has_spare) {
        random->has_spare = false;
        return random->spare;
    }
    double x, y, square;
    do {
        x = 2 * uniform(machine) - 1;
        y = 2 * uniform(machine) - 1;
        square = x * x + y * y;
    } while (square >= 1 || square == 0);
    double factor = sqrt(-2 * log(square) / square);
    random->spare = x * factor;
    random->has_spare = true;
    return y * factor;
}

static double uniform_above_zero(FrLmachine *machine) {
    double value;
    do {
        value = uniform(machine);
    } while (value == 0);
    return value;
}

// Algorithm BA of Cheng (1978), which needs as many draws as it rejects; hence a bound.
static double beta(FrLmachine *machine, double a, double b) {
    if (!(a > 0 && b > 0)) {
        return 0;
    }
    double sum = a + b, least = MIN(a, b);
    double lambda = least <= 1 ? least : sqrt((2 * a * b - sum) / (sum - 2)), u = a + lambda;
    for (int draw = 0; draw < 10000; draw++) {
        double u1 = uniform_above_zero(machine), u2 = uniform_above_zero(machine);
        double v = (1 / lambda) * log(u1 / (1 - u1)), y = a * exp(v);
        if (!(sum * log(sum / (b + y)) + u * v - log(4) < log(u1 * u1 * u2))) {
            return y / (b + y);
        }
    }
    return a / (a + b);
}

static double binomial(FrLmachine *machine, double n, double p) {
    double count = 0;
    n = trunc(MIN(n, MOST_DRAWS));
    machine->loops += n > 0 ? (uint64_t)n : 0;
    for (double i = 1; i <= n; i++) {
        count += uniform(machine) <= p;
    }
    return count;
}

static double radians(double degrees) {
    return degrees * (G_PI / 180);
}

static double degrees(double radians_) {
    return radians_ * (180 / G_PI);
}

static double call_numeric(Function function, const double *x) {
    switch (function) {
    case F_SIN:
        return sin(radians(x[0]));
    case F_COS:
        return cos(radians(x[0]));
    case F_TAN:
        return tan(radians(x[0]));
    case F_ASIN:
        return degrees(asin(x[0]));
    case F_ACOS:
        return degrees(acos(x[0]));
    case F_ATAN2:
        return degrees(atan2(x[0], x[1]));
    case F_EXP:
        return exp(x[0]);
    case F_LOG:
        return log(x[0]);
    case F_SQRT:
        return sqrt(x[0]);
    case F_FABS:
        return fabs(x[0]);
    case F_FLOOR:
        return floor(x[0]);
    case F_CEIL:
        return ceil(x[0]);
    case F_SIGN:
        return (x[0] > 0) - (x[0] < 0);
    default: // trunc, which rounds
        return floor(x[0] + 0.5);
    }
}

static double call_random(FrLmachine *machine, Function function, const double *x) {
    switch (function) {
    case F_SRAND:
        machine->random = (FrLrandom){
            .state = fr_lrandom_seed_b(isfinite(x[0]) ? (int64_t)CLAMP(x[0], -9e18, 9e18) : 0),
            .is_seeded = true};
        return 0;
    case F_RAN:
        return uniform(machine) * x[0];
    case F_NRAN:
        return x[0] + x[1] * normal(machine);
    case F_BRAN:
        return beta(machine, x[0], x[1]);
    default:
        return binomial(machine, x[0], x[1]);
    }
}

double fr_lbuiltin_call(FrLmachine *machine, uint32_t index, const double *x, uint32_t count,
                        uint32_t place) {
    Function function = functions[index].function;
    if (function == F_ATAN) {
        return degrees(atan(x[count - 1]));
    }
    if (function <= F_TRUNC) {
        return call_numeric(function, x);
    }
    if (function <= F_BIRAN) {
        return call_random(machine, function, x);
    }
    switch (function) {
    case F_FUNC:
        return fr_lview_function(machine->view, x[0], x[1]);
    case F_CURVE_X:
    case F_CURVE_Y:
    case F_CURVE_Z:
        return fr_lview_curve(machine->view, x[0], x[1], (int)(function - F_CURVE_X));
    case F_CURVE_GAL:
        return fr_lview_curve_length(machine->view, x[0]);
    case F_STOP:
        // stop(1) halts what moves, to go on from there: a derivation does not end.
        machine->is_stopped = machine->is_stopped || x[0] != 1;
        return 0;
    case F_SET_LENGTH:
        if (!(x[0] >= 0)) {
            fr_lmachine_fault(machine, "negative-length", place);
        } else if (machine->set_length != NULL) {
            *machine->set_length = (int64_t)MIN(x[0], 9e18);
        }
        return 0;
    case F_GET_LENGTH:
        return (double)machine->length;
    case F_OPEN:
        return fr_lfile_open(machine, x[0], x[1], place);
    case F_CLOSE:
        fr_lfile_close(machine, x[0]);
        return 0;
    default:
        return 0;
    }
}
