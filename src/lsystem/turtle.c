// What each symbol does to the turtle.
#include "lsystem/turtle.h"

#include "lsystem/build.h"

#include <math.h>

#define MOST_BRACKETS 1000000
#define LEAST_WIDTH 1e-7F
#define MOST_LENGTH 1e9F

static void set_tropisms(FrLpose *pose, const FrLview *view) {
    for (guint i = 0; i < MIN(view->tropisms->len, FR_LTROPISMS); i++) {
        pose->elasticities[i] = g_array_index(view->tropisms, FrLtropism, i).elasticity;
    }
}

/// `$` only ends calls in cpfg.
static void set_idle(FrLturtle *turtle, const FrLsystem *system) {
    bool ends_calls = system->is_paper || system->units->len > 1;
    for (int symbol = 1; symbol < FR_LSYMBOLS; symbol++) {
        bool is_known = strchr("FfGg+-&^/\\|#![]{}.;,_%~@?", symbol) != NULL;
        bool is_site = turtle->has_sites && strchr(turtle->builder->sites, symbol) != NULL;
        turtle->is_idle[symbol] = !is_known && !is_site && (symbol != '$' || !ends_calls);
    }
}

void fr_lturtle_init(FrLturtle *turtle, const FrLderivation *derivation, FrLbuilder *builder,
                     const FrContext *context) {
    const FrLview *view = derivation->view;
    *turtle = (FrLturtle){.view = view,
                          .context = context,
                          .builder = builder,
                          .keeps_all = view->tropisms->len > 0 || derivation->system->has_at,
                          .is_moved = true,
                          .status = FR_OK,
                          .has_sites = builder != NULL && builder->sites != NULL,
                          .is_dollar_vertical = derivation->system->is_paper,
                          .sine = sin(view->angle * (G_PI / 180)),
                          .cosine = cos(view->angle * (G_PI / 180))};
    turtle->pose = (FrLpose){.heading = {0, 1, 0},
                             .left = {-1, 0, 0},
                             .up = {0, 0, -1},
                             .last_heading = {0, 1, 0},
                             .last_up = {0, 0, -1},
                             .width = (float)view->width,
                             .scale = (float)view->scale,
                             .elasticity = (float)view->old_elasticity,
                             .arrive = 1.2F,
                             .leave = 1.2F,
                             .colour = view->colour,
                             .sides = view->contour_sides,
                             .stand = FR_NONE | FR_LSTAND_LATERAL};
    set_tropisms(&turtle->pose, view);
    turtle->corners = g_array_new(FALSE, FALSE, 3 * sizeof(double));
    turtle->polygons = g_array_new(FALSE, FALSE, sizeof(FrLpolygon));
    turtle->splines = g_array_new(FALSE, FALSE, sizeof(FrLtube));
    turtle->patches = g_array_new(FALSE, FALSE, sizeof(FrLpatch));
    turtle->scales = g_array_new(FALSE, FALSE, sizeof(float));
    g_array_append_val(turtle->scales, turtle->pose.scale);
    for (size_t i = 0; i < G_N_ELEMENTS(turtle->turns); i++) {
        turtle->turns[i].cosine = 1;
    }
    set_idle(turtle, derivation->system);
}

void fr_lturtle_clear(FrLturtle *turtle) {
    g_free(turtle->stack);
    g_array_unref(turtle->corners);
    g_array_unref(turtle->polygons);
    g_array_unref(turtle->splines);
    g_array_unref(turtle->patches);
    g_array_unref(turtle->scales);
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

static inline void turn(FrLturtle *turtle, const uint32_t *module, double a[4], double b[4],
                        int sign) {
    double sine = turtle->sine, cosine = turtle->cosine;
    if (fr_lhead_count(*module) > 0) {
        fr_lturtle_sine(turtle, fr_lword_float(module[1]), &sine, &cosine);
    }
    fr_lturtle_turn(a, b, sign * sine, cosine);
}

/// What is drawn next is told to come from this module.
static inline void note_maker(FrLturtle *turtle, uint32_t head, uint64_t origin) {
    if (turtle->builder != NULL) {
        turtle->builder->maker = fr_lhead_mark(head);
        turtle->builder->module = origin;
    }
}

// ---- moving -----------------------------------------------------------------------------------

static void close_segment(FrLturtle *turtle) {
    FrLsegment *segment = &turtle->segment;
    turtle->has_segment = false;
    segment->end_width = turtle->view->tapers ? turtle->pose.width : segment->start_width;
    memcpy(segment->end, turtle->pose.position, sizeof segment->end);
    if (turtle->builder != NULL) {
        fr_lbuilder_segment(turtle->builder, &turtle->pose.stand, segment);
        turtle->status = MAX(turtle->status, turtle->builder->status);
    }
}

static inline void end_node(FrLturtle *turtle) {
    if (turtle->has_segment) {
        close_segment(turtle);
    }
    if (turtle->is_moved && turtle->builder != NULL) {
        fr_lbuilder_include(turtle->builder, turtle->pose.position);
        turtle->is_moved = false;
    }
}

void fr_lturtle_end_node(FrLturtle *turtle) {
    end_node(turtle);
}

/// Length of a move: single precision, as cpfg has it.
static inline float length_of(const FrLpose *pose, const uint32_t *module) {
    float length =
        fr_lhead_count(*module) > 0 ? fr_lword_float(module[1]) * pose->scale : pose->scale;
    return fabsf(length) <= MOST_LENGTH ? length : 0;
}

static inline void advance(FrLturtle *turtle, double length, bool adds_points, uint32_t head,
                           uint64_t origin) {
    FrLpose *pose = &turtle->pose;
    for (int k = 0; k < 4; k++) {
        pose->position[k] += length * pose->heading[k];
    }
    turtle->is_moved = true;
    if (pose->elasticity != 0) {
        fr_lturtle_bend_old(turtle);
    }
    if (adds_points && turtle->polygons->len > 0) {
        fr_lturtle_corner(turtle);
    }
    if (adds_points && pose->spline == 1) {
        note_maker(turtle, head, origin);
        fr_lspline_point(turtle, 0);
    }
}

static inline void draw(FrLturtle *turtle, const uint32_t *module, char symbol, uint64_t origin) {
    FrLpose *pose = &turtle->pose;
    if (turtle->view->tropisms->len > 0) {
        fr_lturtle_bend(turtle);
    }
    end_node(turtle);
    float length = length_of(pose, module);
    FrLsegment *segment = &turtle->segment;
    memcpy(segment->start, pose->position, sizeof segment->start);
    memcpy(segment->heading, pose->heading, sizeof segment->heading);
    memcpy(segment->left, pose->left, sizeof segment->left);
    segment->start_width = pose->width;
    segment->module = origin;
    segment->maker = fr_lhead_mark(*module);
    segment->colour = pose->colour;
    segment->is_backward = length < 0;
    segment->length = fabs((double)length);
    turtle->has_segment = true;
    advance(turtle, (double)length, symbol == 'F', *module, origin);
    if (turtle->keeps_all) {
        memcpy(pose->last_heading, pose->heading, sizeof pose->last_heading);
        memcpy(pose->last_up, pose->up, sizeof pose->last_up);
    }
}

static void jump(FrLturtle *turtle, const uint32_t *module, char symbol, uint64_t origin) {
    FrLpose *pose = &turtle->pose;
    if (turtle->view->tropisms->len > 0) {
        fr_lturtle_bend(turtle);
    }
    end_node(turtle);
    float length = length_of(pose, module);
    pose->stand &= length == 0 ? ~UINT64_C(0) : ~FR_LSTAND_TIP;
    advance(turtle, (double)length, symbol == 'f', *module, origin);
}

// ---- symbols ----------------------------------------------------------------------------------

static void change_width(FrLturtle *turtle, const uint32_t *module, int sign) {
    FrLpose *pose = &turtle->pose;
    float width = fr_lhead_count(*module) > 0
                      ? fr_lword_float(module[1]) * pose->scale
                      : pose->width + (float)sign * (float)turtle->view->width_step * pose->scale;
    pose->width = width > LEAST_WIDTH ? MIN(width, MOST_LENGTH) : LEAST_WIDTH;
}

static void change_colour(FrLturtle *turtle, const uint32_t *module, int sign) {
    int32_t step = sign * turtle->view->colour_step;
    double colour = fr_lturtle_value(module, 0, turtle->pose.colour + step);
    turtle->pose.colour = isfinite(colour) ? (int32_t)CLAMP(colour, -1e6, 1e6) & 255 : 0;
}

static inline void copy_pose(FrLpose *to, const FrLpose *from, bool keeps_all) {
    if (keeps_all) {
        *to = *from;
        return;
    }
    memcpy(to, from, offsetof(FrLpose, stand));
    // One by one: a load of both would wait for the last store to either.
    *(volatile FrLstand *)&to->stand = from->stand;
    *(volatile float *)&to->width = from->width;
}

static void push(FrLturtle *turtle) {
    end_node(turtle);
    if (turtle->depth == turtle->capacity) {
        if (turtle->depth >= MOST_BRACKETS) {
            turtle->status = fr_limit_check(MOST_BRACKETS + UINT64_C(1), MOST_BRACKETS, "brackets",
                                            "the string", (FrSpan){0}, turtle->context->diags);
            return;
        }
        turtle->capacity = MIN(MAX(64, 2 * turtle->capacity), MOST_BRACKETS);
        turtle->stack = g_renew(FrLpose, turtle->stack, turtle->capacity);
    }
    copy_pose(&turtle->stack[turtle->depth++], &turtle->pose, turtle->keeps_all);
    if (turtle->pose.spline != 0) {
        fr_lspline_push(turtle);
    }
    turtle->pose.stand |= FR_LSTAND_LATERAL;
}

static void pop(FrLturtle *turtle) {
    end_node(turtle);
    if (turtle->depth > 0) {
        bool is_open = turtle->pose.spline != 0;
        copy_pose(&turtle->pose, &turtle->stack[--turtle->depth], turtle->keeps_all);
        if (is_open) {
            fr_lspline_pop(turtle);
        }
    }
}

/// Takes a scale from the stack of called L-systems for the turtle's, and adjusts the width.
static void use_scale(FrLturtle *turtle, float before) {
    FrLpose *pose = &turtle->pose;
    pose->scale = g_array_index(turtle->scales, float, turtle->scales->len - 1);
    float width = pose->width * pose->scale / before;
    pose->width = fabsf(width) < MOST_LENGTH ? width : 1;
}

static void enter_call(FrLturtle *turtle, const uint32_t *module) {
    float before = g_array_index(turtle->scales, float, turtle->scales->len - 1);
    float scale = before * (float)fr_lturtle_value(module, 1, 1);
    if (turtle->scales->len <= 100 && isfinite(scale) && scale != 0) {
        g_array_append_val(turtle->scales, scale);
        use_scale(turtle, before);
    }
}

static void end_call(FrLturtle *turtle) {
    if (turtle->scales->len > 1) {
        float before = g_array_index(turtle->scales, float, turtle->scales->len - 1);
        g_array_set_size(turtle->scales, turtle->scales->len - 1);
        use_scale(turtle, before);
    } else if (turtle->is_dollar_vertical) {
        fr_lturtle_level(&turtle->pose);
    }
}

/// Symbols that neither move, turn nor branch.
static void obey_other(FrLturtle *turtle, char symbol, const uint32_t *module, uint64_t origin) {
    note_maker(turtle, *module, origin);
    switch (symbol) {
    case '{':
        fr_lturtle_open_shape(turtle, module);
        break;
    case '}':
        fr_lturtle_close_shape(turtle, module);
        break;
    case '.':
        fr_lturtle_dot(turtle, module);
        break;
    case ';':
    case ',':
        change_colour(turtle, module, symbol == ';' ? 1 : -1);
        break;
    case '_':
        turtle->pose.elasticity = fr_lhead_count(*module) > 0
                                      ? fr_lword_float(module[1])
                                      : turtle->pose.elasticity + (float)turtle->view->old_step;
        turtle->pose.elasticity = isfinite(turtle->pose.elasticity) ? turtle->pose.elasticity : 0;
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
        end_node(turtle);
        turtle->prefix = symbol;
        turtle->is_raw = true;
        break;
    case '?':
        if (fr_lhead_count(*module) > 0) {
            enter_call(turtle, module);
        } else {
            turtle->prefix = symbol;
            turtle->is_raw = true;
        }
        break;
    default:
        break;
    }
}

/// A symbol that places something of another engine.
static bool place(FrLturtle *turtle, char symbol, const uint32_t *module, uint64_t origin) {
    if (strchr(turtle->builder->sites, symbol) == NULL) {
        return false;
    }
    end_node(turtle);
    note_maker(turtle, *module, origin);
    fr_lbuilder_site(turtle->builder, &turtle->pose, symbol,
                     fr_lturtle_value(module, 0, 1) * (double)turtle->pose.scale);
    turtle->status = MAX(turtle->status, turtle->builder->status);
    return true;
}

static inline __attribute__((always_inline)) void obey(FrLturtle *turtle, char symbol,
                                                       const uint32_t *module, uint64_t origin) {
    FrLpose *pose = &turtle->pose;
    if (turtle->has_sites && place(turtle, symbol, module, origin)) {
        return;
    }
    switch (symbol) {
    case 'F':
    case 'G':
        draw(turtle, module, symbol, origin);
        break;
    case 'f':
    case 'g':
        jump(turtle, module, symbol, origin);
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
    case '#':
    case '!':
        change_width(turtle, module, symbol == '#' ? 1 : -1);
        break;
    case '[':
        push(turtle);
        break;
    case ']':
        pop(turtle);
        break;
    default:
        obey_other(turtle, symbol, module, origin);
    }
}

/// Obeys what follows a prefix, and counts brackets behind a cut.
static G_GNUC_NO_INLINE void obey_rest(FrLturtle *turtle, char symbol, const uint32_t *module,
                                       uint64_t origin) {
    if (turtle->skip > 0) {
        // Behind a cut only brackets count, up to the one that closes the branch.
        turtle->skip += symbol == '[';
        turtle->skip -= symbol == ']';
        turtle->skip = symbol == '$' && turtle->skip == 1 ? 0 : turtle->skip;
        if (turtle->skip > 0) {
            return;
        }
    }
    note_maker(turtle, *module, origin);
    if (turtle->qualifier != 0) {
        fr_lturtle_qualified(turtle, symbol, module);
    } else if (turtle->prefix == '@') {
        if (!fr_lturtle_at(turtle, symbol, module)) {
            obey(turtle, symbol, module, origin);
        }
    } else if (turtle->prefix == '~') {
        turtle->prefix = 0;
        fr_lturtle_surface(turtle, symbol, module);
    } else if (turtle->prefix == '?') {
        turtle->prefix = 0;
    } else {
        obey(turtle, symbol, module, origin);
    }
}

static inline void take(FrLturtle *turtle, const uint32_t *module, uint64_t origin) {
    char symbol = (char)fr_lhead_symbol(*module);
    if (turtle->skip == 0 && !turtle->is_raw) {
        obey(turtle, symbol, module, origin);
    } else {
        obey_rest(turtle, symbol, module, origin);
        turtle->is_raw = turtle->prefix != 0 || turtle->qualifier != 0;
    }
}

bool fr_lturtle_take(FrLturtle *turtle, const uint32_t *module, uint64_t origin) {
    turtle->modules++;
    take(turtle, module, origin);
    return turtle->status == FR_OK;
}

void fr_lturtle_read(FrLturtle *turtle, const FrLstring *string) {
    uint64_t origin = 0;
    for (uint64_t at = 0; at < string->count && turtle->status == FR_OK; origin++) {
        const uint32_t *module = string->words + at;
        bool is_special = turtle->is_raw || turtle->skip > 0;
        if (is_special || !turtle->is_idle[fr_lhead_symbol(*module)]) {
            take(turtle, module, origin);
        }
        at += 1 + fr_lhead_count(*module);
        if ((origin & 0xFFFF) == 0 && fr_progress_is_cancelled(turtle->context->progress)) {
            turtle->status = FR_CANCELLED;
        }
    }
    turtle->modules += origin;
}
