// What each symbol does to the turtle.
#include "lsystem/turtle.h"

#include "lsystem/build.h"

#include <math.h>

#define MOST_BRACKETS 1000000
#define LEAST_WIDTH 1e-7

/// A polygon or cylinder that is open.
typedef struct Open {
    uint32_t kind;  ///< 0: polygon; else FrLcylinderKind
    uint32_t first; ///< point
    uint32_t strips;
    FrLpose pose;
} Open;

void fr_lturtle_init(FrLturtle *turtle, const FrLderivation *derivation, FrLbuilder *builder,
                     const FrContext *context) {
    const FrLview *view = derivation->view;
    *turtle = (FrLturtle){.view = view,
                          .context = context,
                          .builder = builder,
                          .status = FR_OK,
                          .has_sites = builder != NULL && builder->sites != NULL,
                          .is_dollar_vertical = derivation->system->is_paper};
    turtle->pose = (FrLpose){.heading = {0, 1, 0},
                             .left = {-1, 0, 0},
                             .up = {0, 0, -1},
                             .last_heading = {0, 1, 0},
                             .last_up = {0, 0, -1},
                             .width = view->width,
                             .scale = view->scale,
                             .elasticity = view->old_elasticity,
                             .arrive = 1.2,
                             .leave = 1.2,
                             .colour = view->colour,
                             .sides = view->contour_sides,
                             .node = FR_NONE,
                             .is_lateral = true};
    for (guint i = 0; i < MIN(view->tropisms->len, FR_LTROPISMS); i++) {
        turtle->pose.elasticities[i] = g_array_index(view->tropisms, FrLtropism, i).elasticity;
    }
    turtle->stack = g_array_new(FALSE, FALSE, sizeof(FrLpose));
    turtle->points = g_array_new(FALSE, FALSE, sizeof(FrLpoint));
    turtle->shapes = g_array_new(FALSE, FALSE, sizeof(Open));
    turtle->scales = g_array_new(FALSE, FALSE, sizeof(double));
    for (size_t i = 0; i < G_N_ELEMENTS(turtle->turns); i++) {
        turtle->turns[i].cosine = 1;
    }
}

void fr_lturtle_clear(FrLturtle *turtle) {
    g_array_unref(turtle->stack);
    g_array_unref(turtle->points);
    g_array_unref(turtle->shapes);
    g_array_unref(turtle->scales);
}

void fr_lturtle_turn(double a[3], double b[3], double sine, double cosine) {
    for (int k = 0; k < 3; k++) {
        double x = a[k];
        a[k] = x * cosine + b[k] * sine;
        b[k] = b[k] * cosine - x * sine;
    }
}

void fr_lturtle_sine(FrLturtle *turtle, float degrees, double *sine, double *cosine) {
    uint32_t bits;
    memcpy(&bits, &degrees, sizeof bits);
    size_t slot = (bits ^ bits >> 13 ^ bits >> 19) % G_N_ELEMENTS(turtle->turns);
    if (turtle->turns[slot].angle != degrees) {
        double radians = isfinite(degrees) ? (double)degrees * (G_PI / 180) : 0;
        turtle->turns[slot].angle = degrees;
        turtle->turns[slot].sine = sin(radians);
        turtle->turns[slot].cosine = cos(radians);
    }
    *sine = turtle->turns[slot].sine;
    *cosine = turtle->turns[slot].cosine;
}

static void turn(FrLturtle *turtle, const uint32_t *module, double a[3], double b[3], int sign) {
    double sine, cosine;
    fr_lturtle_sine(turtle, (float)fr_lturtle_value(module, 0, turtle->view->angle), &sine,
                    &cosine);
    fr_lturtle_turn(a, b, sign * sine, cosine);
}

// ---- moving -----------------------------------------------------------------------------------

void fr_lturtle_close_segment(FrLturtle *turtle) {
    if (!turtle->has_segment) {
        return;
    }
    turtle->has_segment = false;
    turtle->segment.end_width =
        turtle->view->tapers ? turtle->pose.width : turtle->segment.start_width;
    if (turtle->builder != NULL) {
        fr_lbuilder_segment(turtle->builder, &turtle->pose, &turtle->segment);
        turtle->status = MAX(turtle->status, turtle->builder->status);
    }
}

static void add_point(FrLturtle *turtle, uint32_t strips) {
    if (turtle->builder == NULL) {
        return;
    }
    if (turtle->points->len >= 4000000) {
        turtle->status = fr_limit_check(turtle->points->len + UINT64_C(1), 4000000, "corners",
                                        "an open polygon", (FrSpan){0}, turtle->context->diags);
        return;
    }
    const FrLpose *pose = &turtle->pose;
    FrLpoint point = {
        .width = pose->width, .arrive = pose->arrive, .leave = pose->leave, .strips = strips};
    memcpy(point.position, pose->position, sizeof point.position);
    memcpy(point.heading, pose->heading, sizeof point.heading);
    memcpy(point.up, pose->up, sizeof point.up);
    g_array_append_val(turtle->points, point);
}

static void move(FrLturtle *turtle, const uint32_t *module, char symbol, uint64_t origin) {
    FrLpose *pose = &turtle->pose;
    bool draws = symbol == 'F' || symbol == 'G';
    fr_lturtle_close_segment(turtle);
    if (turtle->view->tropisms->len > 0) {
        fr_lturtle_bend(turtle);
    }
    double length = fr_lturtle_value(module, 0, 1) * pose->scale;
    FrLsegment *segment = &turtle->segment;
    if (draws) {
        memcpy(segment->start, pose->position, sizeof segment->start);
        memcpy(segment->heading, pose->heading, sizeof segment->heading);
        memcpy(segment->left, pose->left, sizeof segment->left);
        memcpy(segment->up, pose->up, sizeof segment->up);
        segment->start_width = pose->width;
        segment->module = origin;
        segment->symbol = symbol;
    }
    memcpy(pose->last_heading, pose->heading, sizeof pose->last_heading);
    memcpy(pose->last_up, pose->up, sizeof pose->last_up);
    for (int k = 0; k < 3; k++) {
        pose->position[k] += pose->heading[k] * length;
        pose->position[k] = CLAMP(pose->position[k], -1e12, 1e12);
    }
    if (!isfinite(length)) {
        length = 0;
        memcpy(pose->position, (double[3]){0, 0, 0}, sizeof pose->position);
    }
    if (draws) {
        memcpy(segment->end, pose->position, sizeof segment->end);
        turtle->has_segment = true;
    } else {
        pose->is_at_tip &= length == 0;
    }
    fr_lturtle_bend_old(turtle);
    if (turtle->shapes->len > 0 && (symbol == 'F' || symbol == 'f')) {
        const Open *open = &g_array_index(turtle->shapes, Open, turtle->shapes->len - 1);
        add_point(turtle, open->strips);
    }
}

// ---- polygons and cylinders -------------------------------------------------------------------

static void open_shape(FrLturtle *turtle, const uint32_t *module) {
    double kind = fr_lturtle_value(module, 0, 0), strips = fr_lturtle_value(module, 1, 4);
    fr_lturtle_close_segment(turtle);
    if (turtle->shapes->len >= 1000) {
        return;
    }
    Open open = {kind >= 1 && kind < 5 ? (uint32_t)kind : 0, turtle->points->len,
                 strips >= 1 && strips <= 100 ? (uint32_t)strips : 1, turtle->pose};
    g_array_append_val(turtle->shapes, open);
    if (open.kind > 0) {
        add_point(turtle, open.strips);
    }
}

static void close_shape(FrLturtle *turtle) {
    fr_lturtle_close_segment(turtle);
    if (turtle->shapes->len == 0) {
        return;
    }
    Open open = g_array_index(turtle->shapes, Open, turtle->shapes->len - 1);
    g_array_set_size(turtle->shapes, turtle->shapes->len - 1);
    if (turtle->builder != NULL) {
        const FrLpoint *points = &g_array_index(turtle->points, FrLpoint, open.first);
        uint32_t count = turtle->points->len - open.first;
        if (open.kind == 0) {
            fr_lbuilder_polygon(turtle->builder, &open.pose, points, count);
        } else {
            fr_lbuilder_cylinder(turtle->builder, &open.pose, (FrLcylinderKind)open.kind, points,
                                 count);
        }
        turtle->status = MAX(turtle->status, turtle->builder->status);
    }
    g_array_set_size(turtle->points, open.first);
}

// The simple form: @Gs begins, @Gc adds a control point, @Ge adds the last and ends.
void fr_lturtle_control(FrLturtle *turtle, char symbol, const uint32_t *module) {
    FrLpose *pose = &turtle->pose;
    double strips = fr_lturtle_value(module, 0, 4);
    if (symbol == 's') {
        Open open = {FR_LHERMITE_OPEN, turtle->points->len, 4, *pose};
        if (turtle->shapes->len < 1000) {
            g_array_append_val(turtle->shapes, open);
            add_point(turtle, 1);
        }
    } else if (symbol == 'c' || symbol == 'e') {
        add_point(turtle, strips >= 1 ? (uint32_t)MIN(strips, 100) : 1);
        if (symbol == 'e') {
            close_shape(turtle);
        }
    } else if (symbol == 't') {
        pose->arrive = fr_lturtle_value(module, 0, 1.2);
        pose->leave = fr_lturtle_value(module, 1, pose->arrive);
    }
}

// ---- symbols ----------------------------------------------------------------------------------

static void draw_surface(FrLturtle *turtle, char symbol, const uint32_t *module) {
    FrLpose *pose = &turtle->pose;
    const GArray *surfaces = turtle->view->surfaces;
    for (guint i = 0; i < surfaces->len; i++) {
        const FrLsurface *surface = &g_array_index(surfaces, FrLsurface, i);
        if (surface->symbol != symbol) {
            continue;
        }
        double first = fr_lturtle_value(module, 0, 1), scale[3];
        bool is_three = fr_lhead_count(*module) >= 3;
        for (unsigned k = 0; k < 3; k++) {
            scale[k] = (is_three ? fr_lturtle_value(module, k, 1) : first) * pose->scale;
        }
        if (turtle->builder != NULL) {
            fr_lbuilder_surface(turtle->builder, pose, surface, scale);
            turtle->status = MAX(turtle->status, turtle->builder->status);
        }
        for (int k = 0; k < 3; k++) {
            pose->position[k] += surface->end[0] * scale[0] * pose->left[k] +
                                 surface->end[1] * scale[1] * pose->heading[k] +
                                 surface->end[2] * scale[2] * pose->up[k];
            pose->is_at_tip &= surface->end[k] == 0;
        }
        return;
    }
}

static void change_width(FrLturtle *turtle, const uint32_t *module, int sign) {
    FrLpose *pose = &turtle->pose;
    double width = fr_lhead_count(*module) > 0
                       ? fr_lturtle_value(module, 0, 1) * pose->scale
                       : pose->width + sign * turtle->view->width_step * pose->scale;
    pose->width = isfinite(width) ? CLAMP(width, LEAST_WIDTH, 1e9) : LEAST_WIDTH;
}

static void change_colour(FrLturtle *turtle, const uint32_t *module, int sign) {
    int32_t step = sign * turtle->view->colour_step;
    double colour = fr_lturtle_value(module, 0, turtle->pose.colour + step);
    turtle->pose.colour = isfinite(colour) ? (int32_t)CLAMP(colour, -1e6, 1e6) & 255 : 0;
}

static void push(FrLturtle *turtle) {
    fr_lturtle_close_segment(turtle);
    if (turtle->stack->len >= MOST_BRACKETS) {
        turtle->status = fr_limit_check(MOST_BRACKETS + UINT64_C(1), MOST_BRACKETS, "brackets",
                                        "the string", (FrSpan){0}, turtle->context->diags);
        return;
    }
    g_array_append_val(turtle->stack, turtle->pose);
    turtle->pose.is_lateral = true;
}

static void pop(FrLturtle *turtle) {
    fr_lturtle_close_segment(turtle);
    if (turtle->stack->len > 0) {
        turtle->pose = g_array_index(turtle->stack, FrLpose, turtle->stack->len - 1);
        g_array_set_size(turtle->stack, turtle->stack->len - 1);
    }
}

static void enter_call(FrLturtle *turtle, const uint32_t *module) {
    double scale = fr_lturtle_value(module, 1, 1);
    scale = isfinite(scale) && scale != 0 ? scale : 1;
    if (turtle->scales->len < 100) {
        g_array_append_val(turtle->scales, scale);
        turtle->pose.scale *= scale;
        turtle->pose.width *= scale;
    }
}

static void end_call(FrLturtle *turtle) {
    if (turtle->scales->len == 0) {
        if (turtle->is_dollar_vertical) {
            fr_lturtle_level(&turtle->pose);
        }
        return;
    }
    double scale = g_array_index(turtle->scales, double, turtle->scales->len - 1);
    g_array_set_size(turtle->scales, turtle->scales->len - 1);
    turtle->pose.scale /= scale;
    turtle->pose.width /= scale;
}

/// Symbols that neither move, turn nor branch.
static void obey_other(FrLturtle *turtle, char symbol, const uint32_t *module) {
    switch (symbol) {
    case '{':
        open_shape(turtle, module);
        break;
    case '}':
        close_shape(turtle);
        break;
    case '.':
        if (turtle->shapes->len > 0) {
            double strips = fr_lturtle_value(module, 0, 4);
            add_point(turtle, strips >= 1 ? (uint32_t)MIN(strips, 100) : 1);
        }
        break;
    case '#':
    case '!':
        change_width(turtle, module, symbol == '#' ? 1 : -1);
        break;
    case ';':
    case ',':
        change_colour(turtle, module, symbol == ';' ? 1 : -1);
        break;
    case '_':
        turtle->pose.elasticity = fr_lhead_count(*module) > 0
                                      ? fr_lturtle_value(module, 0, 0)
                                      : turtle->pose.elasticity + turtle->view->old_step;
        break;
    case '$':
        end_call(turtle);
        break;
    case '%':
        if (!turtle->view->draws_past_cut && fr_lhead_count(*module) == 0) {
            turtle->skip = 1;
        }
        break;
    case '~':
    case '@':
        fr_lturtle_close_segment(turtle);
        turtle->prefix = symbol;
        break;
    case '?':
        if (fr_lhead_count(*module) > 0) {
            enter_call(turtle, module);
        } else {
            turtle->prefix = symbol;
        }
        break;
    default:
        break;
    }
}

/// A symbol that places something of another engine.
static bool place(FrLturtle *turtle, char symbol, const uint32_t *module) {
    if (strchr(turtle->builder->sites, symbol) == NULL) {
        return false;
    }
    fr_lturtle_close_segment(turtle);
    fr_lbuilder_site(turtle->builder, &turtle->pose, symbol,
                     fr_lturtle_value(module, 0, 1) * turtle->pose.scale);
    turtle->status = MAX(turtle->status, turtle->builder->status);
    return true;
}

static void obey(FrLturtle *turtle, char symbol, const uint32_t *module, uint64_t origin) {
    FrLpose *pose = &turtle->pose;
    if (turtle->has_sites && place(turtle, symbol, module)) {
        return;
    }
    switch (symbol) {
    case 'F':
    case 'f':
    case 'G':
    case 'g':
        move(turtle, module, symbol, origin);
        break;
    case '+':
        turn(turtle, module, pose->heading, pose->left, 1);
        break;
    case '-':
        turn(turtle, module, pose->heading, pose->left, -1);
        break;
    case '&':
        turn(turtle, module, pose->heading, pose->up, 1);
        break;
    case '^':
        turn(turtle, module, pose->heading, pose->up, -1);
        break;
    case '/':
        turn(turtle, module, pose->left, pose->up, 1);
        break;
    case '\\':
        turn(turtle, module, pose->left, pose->up, -1);
        break;
    case '|':
        for (int k = 0; k < 3; k++) {
            pose->heading[k] = -pose->heading[k];
            pose->left[k] = -pose->left[k];
        }
        break;
    case '[':
        push(turtle);
        break;
    case ']':
        pop(turtle);
        break;
    default:
        obey_other(turtle, symbol, module);
    }
}

bool fr_lturtle_take(FrLturtle *turtle, const uint32_t *module, uint64_t origin) {
    char symbol = (char)fr_lhead_symbol(*module);
    turtle->modules++;
    if (turtle->skip > 0) {
        // Behind a cut only brackets count, up to the one that closes the branch.
        turtle->skip += symbol == '[';
        turtle->skip -= symbol == ']';
        if (turtle->skip > 0) {
            return true;
        }
    }
    if (turtle->qualifier != 0) {
        fr_lturtle_qualified(turtle, symbol, module);
    } else if (turtle->prefix == '@') {
        fr_lturtle_at(turtle, symbol, module);
    } else if (turtle->prefix == '~') {
        turtle->prefix = 0;
        draw_surface(turtle, symbol, module);
    } else if (turtle->prefix == '?') {
        turtle->prefix = 0;
    } else {
        obey(turtle, symbol, module, origin);
    }
    turtle->is_raw = turtle->prefix != 0 || turtle->qualifier != 0;
    return turtle->status == FR_OK;
}
