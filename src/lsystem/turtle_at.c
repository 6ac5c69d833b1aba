// Symbols of two and three letters that begin with `@`.
#include "lsystem/build.h"

#include <math.h>

/// Roll until left is horizontal.
void fr_lturtle_level(FrLpose *pose) {
    static const double vertical[3] = {0, 1, 0};
    double left[3];
    fr_lvector_cross(vertical, pose->heading, left);
    if (fr_lvector_dot(left, left) < 1e-20) {
        return;
    }
    fr_lvector_unit(left);
    memcpy(pose->left, left, sizeof left);
    fr_lvector_cross(pose->left, pose->heading, pose->up);
}

static void set_heading(FrLpose *pose, const uint32_t *module) {
    double heading[3], up[3];
    for (unsigned k = 0; k < 3; k++) {
        heading[k] = fr_lturtle_value(module, k, 0);
        up[k] = fr_lturtle_value(module, 3 + k, 0);
    }
    double length = fr_lvector_dot(heading, heading);
    if (!(length > 0) || !isfinite(length)) {
        memcpy(heading, (double[3]){0, 1, 0}, sizeof heading);
    }
    fr_lvector_unit(heading);
    memcpy(pose->heading, heading, sizeof heading);
    // Only an up that is exactly perpendicular is taken.
    bool is_up = fr_lhead_count(*module) >= 6 && isfinite(fr_lvector_dot(up, up)) &&
                 fr_lvector_dot(up, up) > 0 && fr_lvector_dot(up, heading) == 0;
    if (is_up) {
        fr_lvector_unit(up);
        memcpy(pose->up, up, sizeof up);
        fr_lvector_cross(pose->heading, pose->up, pose->left);
    } else {
        fr_lturtle_untwist(pose);
    }
}

static void set_position(FrLturtle *turtle, const uint32_t *module) {
    FrLpose *pose = &turtle->pose;
    if (fr_lhead_count(*module) < 2) {
        return;
    }
    for (unsigned k = 0; k < 3; k++) {
        double value = fr_lturtle_value(module, k, 0);
        pose->position[k] = isfinite(value) ? CLAMP(value, -1e12, 1e12) : 0;
    }
    pose->stand &= ~FR_LSTAND_TIP;
    turtle->is_moved = true;
    fr_lturtle_end_node(turtle);
}

static void set_elasticity(FrLturtle *turtle, char symbol, const uint32_t *module) {
    FrLpose *pose = &turtle->pose;
    if (symbol == 'p') {
        fr_lturtle_untwist(pose);
        return;
    }
    if (symbol == 'f') {
        memcpy(pose->last_heading, pose->heading, sizeof pose->last_heading);
        memcpy(pose->last_up, pose->up, sizeof pose->last_up);
        return;
    }
    double id = fr_lturtle_value(module, 0, 0);
    if (strchr("isd", symbol) == NULL ||
        !(id >= 1 && id <= MIN(turtle->view->tropisms->len, FR_LTROPISMS))) {
        return;
    }
    unsigned i = (unsigned)id - 1;
    double step = g_array_index(turtle->view->tropisms, FrLtropism, i).step;
    double value = fr_lturtle_value(module, 1, symbol == 's' ? 0 : step);
    pose->elasticities[i] = symbol == 's'   ? value
                            : symbol == 'd' ? pose->elasticities[i] - value
                                            : pose->elasticities[i] + value;
}

static void set_scale(FrLturtle *turtle, char symbol, const uint32_t *module) {
    float value = (float)fr_lturtle_value(module, 0, turtle->view->scale_step);
    float scale = symbol == 'i'   ? turtle->pose.scale * value
                  : symbol == 'd' ? turtle->pose.scale / value
                                  : value;
    if (isfinite(scale) && scale != 0) {
        turtle->pose.scale = scale;
    }
}

static void draw_ball(FrLturtle *turtle, char symbol, bool is_ring, const uint32_t *module) {
    const FrLpose *pose = &turtle->pose;
    bool is_given = fr_lhead_count(*module) > 0;
    float diameter = is_given ? fr_lword_float(module[1]) * pose->scale : pose->width;
    if (turtle->builder == NULL) {
        return;
    }
    if (symbol == 'O') {
        fr_lbuilder_sphere(turtle->builder, pose, (double)diameter);
    } else {
        double hole = is_ring ? (double)(diameter - 2 * pose->width) : 0;
        fr_lbuilder_disc(turtle->builder, pose, (double)diameter, fmax(hole, 0), symbol == 'o');
    }
    turtle->status = MAX(turtle->status, turtle->builder->status);
}

/// Letters that take a second one: @Gs, @Ts, @Di, @bo, @PS, @mc.
static bool takes_another(char symbol) {
    return strchr("GTDbPm", symbol) != NULL;
}

void fr_lturtle_qualified(FrLturtle *turtle, char symbol, const uint32_t *module) {
    char qualifier = turtle->qualifier;
    turtle->qualifier = 0;
    turtle->prefix = 0;
    if (qualifier == 'G') {
        fr_lspline_obey(turtle, symbol, module);
    } else if (qualifier == 'T') {
        set_elasticity(turtle, symbol, module);
    } else if (qualifier == 'D') {
        set_scale(turtle, symbol, module);
    } else if (qualifier == 'b') {
        draw_ball(turtle, symbol, true, module);
    } else if (qualifier == 'P') {
        fr_lturtle_patch(turtle, symbol, module);
    } else if (qualifier == 'm' && symbol == 'c' && fr_lturtle_value(module, 0, 0) == 1) {
        turtle->skip = 1;
    }
}

/// Sets contour and sides of generalized cylinders.
static void set_contour(FrLpose *pose, char symbol, const uint32_t *module) {
    if (symbol == '#') {
        pose->contour = fr_lturtle_int(fr_lturtle_value(module, 0, 0));
    } else {
        pose->sides = (uint32_t)CLAMP(fr_lturtle_value(module, 0, 8), 3, 128);
    }
}

bool fr_lturtle_at(FrLturtle *turtle, char symbol, const uint32_t *module) {
    FrLpose *pose = &turtle->pose;
    bool has_value = fr_lhead_count(*module) > 0;
    if (takes_another(symbol) && !has_value) {
        turtle->qualifier = symbol;
        return true;
    }
    turtle->prefix = 0;
    switch (symbol) {
    case 'v':
        fr_lturtle_level(pose);
        return true;
    case 'R':
        if (fr_lhead_count(*module) >= 2) {
            set_heading(pose, module);
        }
        return true;
    case 'M':
        set_position(turtle, module);
        return true;
    case 'D':
        set_scale(turtle, 's', module);
        return true;
    case 'T':
        set_elasticity(turtle, 'i', module);
        return true;
    case '#':
    case '!':
        set_contour(pose, symbol, module);
        return true;
    case 'O':
    case 'o':
    case 'c':
        draw_ball(turtle, symbol, false, module);
        return true;
    default:
        // Read but without effect: colours of the back, labels, objects of renderers (warn.c).
        return strchr(",;LSIJbPm", symbol) != NULL;
    }
}
