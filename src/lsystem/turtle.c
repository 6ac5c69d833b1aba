// What each symbol does to the turtle.
#include "lsystem/turtle.h"

#include "lsystem/build.h"

#include <math.h>

// Of brackets within brackets: 40 MB of poses.
#define MOST_BRACKETS 100000
#define LEAST_WIDTH 1e-7F

static void set_tropisms(FrLpose *pose, const FrLview *view) {
    for (guint i = 0; i < MIN(view->tropisms->len, FR_LTROPISMS); i++) {
        pose->elasticities[i] = g_array_index(view->tropisms, FrLtropism, i).elasticity;
    }
}

/// What a symbol does, if it is not one of those that obey_plain() names.
enum { DEED_NONE = 0, DEED_OTHER = 1 };

/// `$` only ends calls in cpfg.
static void set_deeds(FrLturtle *turtle, const FrLsystem *system) {
    bool ends_calls = system->is_paper || system->units->len > 1;
    for (int symbol = 1; symbol < FR_LSYMBOLS; symbol++) {
        bool is_plain = strchr("FfGg+-&^/\\|#![]", symbol) != NULL;
        bool is_other = strchr("{}.;,_%~@?", symbol) != NULL || (symbol == '$' && ends_calls);
        bool is_site = turtle->has_sites && strchr(turtle->builder->sites, symbol) != NULL;
        turtle->deeds[symbol] = is_other || is_site ? DEED_OTHER
                                : is_plain          ? (uint8_t)symbol
                                                    : DEED_NONE;
    }
}

void fr_lturtle_init(FrLturtle *turtle, const FrLderivation *derivation, FrLbuilder *builder,
                     const FrContext *context) {
    const FrLview *view = derivation->view;
    *turtle = (FrLturtle){.view = view,
                          .derivation = derivation,
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
    set_deeds(turtle, derivation->system);
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

/// Which two axes of a pose a symbol turns, and to which side: read from a table, as a jump for
/// each symbol would often be foreseen wrongly.
typedef struct Turn {
    uint16_t from, to; ///< offsets in the pose
    double sign;
} Turn;

#define TURN(from, to, sign)                                                                       \
    { offsetof(FrLpose, from), offsetof(FrLpose, to), sign }

static const Turn TURNS[FR_LSYMBOLS] = {
    ['+'] = TURN(heading, left, 1), ['-'] = TURN(heading, left, -1), ['&'] = TURN(heading, up, 1),
    ['^'] = TURN(heading, up, -1),  ['/'] = TURN(left, up, 1),       ['\\'] = TURN(left, up, -1)};

static inline void turn(FrLturtle *turtle, unsigned symbol, const uint32_t *module) {
    double sine = turtle->sine, cosine = turtle->cosine;
    if (fr_lhead_count(*module) > 0) {
        fr_lturtle_sine(turtle, fr_lword_float(module[1]), &sine, &cosine);
    }
    const Turn *turn = &TURNS[symbol];
    char *pose = (char *)&turtle->pose;
    fr_lturtle_turn((double *)(void *)(pose + turn->from), (double *)(void *)(pose + turn->to),
                    turn->sign * sine, cosine);
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
    FrLpose *pose = &turtle->pose;
    FrLbuilder *builder = turtle->builder;
    turtle->has_segment = false;
    if (builder == NULL || builder->status != FR_OK) {
        return;
    }
    float width = turtle->view->tapers ? pose->width : turtle->start_width;
    fr_lbuilder_count(builder, turtle->segment.length, width);
    if (turtle->node != FR_NONE) {
        fr_lbuilder_finish(builder, turtle->node, width, pose->position);
    } else {
        fr_lbuilder_node(builder, &pose->stand, &turtle->segment,
                         (float[2]){turtle->start_width, width}, pose->position);
        turtle->status = MAX(turtle->status, builder->status);
    }
}

/// Begins a segment at the turtle's place. Its node is written at once, but within a cylinder,
/// whose own nodes come before it and may end it.
static inline void begin_segment(FrLturtle *turtle, uint32_t head, uint64_t origin, float length) {
    FrLpose *pose = &turtle->pose;
    turtle->has_segment = true;
    turtle->node = FR_NONE;
    turtle->start_width = pose->width;
    turtle->segment = (FrLsegment){.start = pose->position,
                                   .heading = pose->heading,
                                   .left = pose->left,
                                   .length = fabs((double)length),
                                   .module = origin,
                                   .maker = fr_lhead_mark(head),
                                   .colour = pose->colour,
                                   .is_backward = length < 0};
    if (pose->spline != 0) {
        const double **vectors[3] = {&turtle->segment.start, &turtle->segment.heading,
                                     &turtle->segment.left};
        for (int k = 0; k < 3; k++) {
            memcpy(turtle->vectors[k], *vectors[k], sizeof turtle->vectors[k]);
            *vectors[k] = turtle->vectors[k];
        }
    } else if (turtle->builder != NULL && length != 0) {
        turtle->node =
            fr_lbuilder_begin(turtle->builder, &pose->stand, &turtle->segment, pose->width);
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
    float length = fr_lturtle_length(pose, module);
    begin_segment(turtle, *module, origin, length);
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
    float length = fr_lturtle_length(pose, module);
    pose->stand &= length == 0 ? ~UINT64_C(0) : ~FR_LSTAND_TIP;
    advance(turtle, (double)length, symbol == 'f', *module, origin);
}

// ---- symbols ----------------------------------------------------------------------------------

static void change_width(FrLturtle *turtle, const uint32_t *module, int sign) {
    FrLpose *pose = &turtle->pose;
    float width = fr_lhead_count(*module) > 0
                      ? fr_lword_float(module[1]) * pose->scale
                      : pose->width + (float)sign * (float)turtle->view->width_step * pose->scale;
    pose->width = width > LEAST_WIDTH ? MIN(width, FR_LMOST_LENGTH) : LEAST_WIDTH;
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

static void push(FrLturtle *turtle, uint32_t head, uint64_t origin) {
    end_node(turtle);
    if (turtle->depth == turtle->capacity) {
        if (turtle->depth >= MOST_BRACKETS) {
            const FrLderivation *derivation = turtle->derivation;
            turtle->status =
                fr_lderive_limit(derivation, MOST_BRACKETS + UINT64_C(1), MOST_BRACKETS, "brackets",
                                 fr_lderive_maker(derivation, fr_lhead_mark(head)), "the string",
                                 origin, turtle->context);
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
    pose->width = fabsf(width) < FR_LMOST_LENGTH ? width : 1;
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

/// What only moves, turns or branches; false for any other symbol.
static inline __attribute__((always_inline)) bool
obey_plain(FrLturtle *turtle, unsigned symbol, const uint32_t *module, uint64_t origin) {
    FrLpose *pose = &turtle->pose;
    switch (symbol) {
    case 'F':
    case 'G':
        draw(turtle, module, (char)symbol, origin);
        break;
    case 'f':
    case 'g':
        jump(turtle, module, (char)symbol, origin);
        break;
    case '+':
    case '-':
    case '&':
    case '^':
    case '/':
    case '\\':
        turn(turtle, symbol, module);
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
        push(turtle, *module, origin);
        break;
    case ']':
        pop(turtle);
        break;
    default:
        return false;
    }
    return true;
}

static void obey(FrLturtle *turtle, char symbol, const uint32_t *module, uint64_t origin) {
    bool is_placed = turtle->has_sites && place(turtle, symbol, module, origin);
    if (!is_placed && !obey_plain(turtle, (unsigned char)symbol, module, origin)) {
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

static void take(FrLturtle *turtle, const uint32_t *module, uint64_t origin) {
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

void fr_lturtle_walk(FrLturtle *turtle, const uint32_t *words, uint64_t from, uint64_t to,
                     uint64_t module_index) {
    uint64_t origin = module_index;
    bool is_special = false; // nothing is what it is behind a prefix or a cut
    for (uint64_t at = from; at < to && turtle->status == FR_OK; origin++) {
        const uint32_t *module = words + at;
        at += 1 + fr_lhead_count(*module);
        unsigned deed = is_special ? DEED_OTHER : turtle->deeds[fr_lhead_symbol(*module)];
        if (!obey_plain(turtle, deed, module, origin) && deed == DEED_OTHER) {
            take(turtle, module, origin);
            is_special = turtle->is_raw || turtle->skip > 0;
        }
        if ((origin & 0xFFFF) == 0 && fr_progress_is_cancelled(turtle->context->progress)) {
            turtle->status = FR_CANCELLED;
        }
    }
    turtle->modules += origin - module_index;
}
