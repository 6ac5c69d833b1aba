// Deformations ready made, written as a user would write them.
//
// They act over the height of the component's box, from `low` on and `tall`. After: Barr. Global
// and Local Deformations of Solid Primitives. SIGGRAPH 84.
#include "pgraph/preset.h"

#include <math.h>

typedef struct Function {
    const char *name, *parameters, *body;
} Function;

static const Function functions[] = {
    {"sinc", "a", "abs(a) < 1e-6 ? 1 : sin(a)/a"},
    {"up", "z", "(z - low)/tall"},
    {"part", "z", "clamp(up(z), 0, 1)"},
    {"beyond", "z", "z - low - tall*part(z)"},
    {"quarter", "a", "a*pi/2"},
    {"arc", "a, z", "quarter(a)*part(z)"},
    {"wide", "a, z", "max(0.001, 1 - a*part(z))"},
    {"swell", "a, z", "max(0.001, 1 + a*sin(pi*part(z)))"},
    {"foot", "a, z", "max(0.001, 1 + a*pow(1 - part(z), 3))"},
    {"long", "a", "max(0.01, 1 + a)"},
    {"middle", "z", "z - low - tall/2"},
    {"far", "x, y, z", "sqrt(x*x + y*y + middle(z)*middle(z))"},
    {"rounded", "a, x, y, z", "mix(1, tall/2/max(far(x, y, z), 1e-9), a)"},
};

// In the order of the choices, the first of which has none.
static const char *const presets[][3] = {
    [0] = {NULL},
    {"x", // bend
     "y*cos(arc(amount, z)) + tall*part(z)*sin(arc(amount, z)/2)*sinc(arc(amount, z)/2) + "
     "beyond(z)*sin(arc(amount, z))",
     "low - y*sin(arc(amount, z)) + tall*part(z)*sinc(arc(amount, z)) + "
     "beyond(z)*cos(arc(amount, z))"},
    {"x*cos(quarter(amount)*up(z)) - y*sin(quarter(amount)*up(z))", // twist
     "x*sin(quarter(amount)*up(z)) + y*cos(quarter(amount)*up(z))", "z"},
    {"x*wide(amount, z)", "y*wide(amount, z)", "z"},                                  // taper
    {"x*swell(amount, z)", "y*swell(amount, z)", "z"},                                // bulge
    {"x*foot(amount, z)", "y*foot(amount, z)", "z"},                                  // flare
    {"x", "y + amount*(z - low)", "z"},                                               // shear
    {"x/sqrt(long(amount))", "y/sqrt(long(amount))", "low + (z - low)*long(amount)"}, // stretch
    {"x", "y + 0.1*amount*tall*sin(2*pi*up(z))", "z"},                                // wave
    {"x + 0.1*amount*tall*(cos(2*pi*up(z)) - 1)",                                     // spiral
     "y + 0.1*amount*tall*sin(2*pi*up(z))", "z"},
    {"x*rounded(amount, x, y, z)", "y*rounded(amount, x, y, z)", // spherify
     "low + tall/2 + middle(z)*rounded(amount, x, y, z)"},
    {"x + 0.05*amount*tall*noise(7*x/tall, 7*y/tall, 7*z/tall)", // ruffle
     "y + 0.05*amount*tall*noise(7*x/tall + 31, 7*y/tall, 7*z/tall)",
     "z + 0.05*amount*tall*noise(7*x/tall, 7*y/tall + 57, 7*z/tall)"},
    {"mix(x, to0(x, y, z), amount)", "mix(y, to1(x, y, z), amount)", // curve
     "mix(z, to2(x, y, z), amount)"},
};

static FrScope *scope_of(const FrFfdParams *ffd, const GArray *path) {
    double from = (double)ffd->box_from.z, to = (double)ffd->box_to.z;
    FrScope *scope = fr_scope_new();
    fr_scope_add_value(scope, "low", fmin(from, to));
    fr_scope_add_value(scope, "tall", fabs(to - from));
    for (size_t k = 0; k < G_N_ELEMENTS(functions); k++) {
        FrStatus status = fr_scope_add_function(scope, functions[k].name, functions[k].parameters,
                                                functions[k].body, (FrSpan){0}, NULL);
        FR_ASSERT(status == FR_OK);
    }
    if (path != NULL) {
        fr_preset_add_curve(scope, path);
    }
    return scope;
}

bool fr_preset_map(const FrFfdParams *ffd, const GArray *path, FrExpr *map[3]) {
    static const char *const names[] = {"x", "y", "z", "amount"};
    if (ffd->preset == FR_PRESET_NONE) {
        return false;
    }
    FR_ASSERT((size_t)ffd->preset < G_N_ELEMENTS(presets));
    FrScope *scope = scope_of(ffd, path);
    for (int k = 0; k < 3; k++) {
        map[k] = fr_expr_compile_with(presets[ffd->preset][k], (FrSpan){0}, scope, names,
                                      G_N_ELEMENTS(names), NULL);
        FR_ASSERT(map[k] != NULL);
    }
    fr_scope_free(scope);
    return true;
}
