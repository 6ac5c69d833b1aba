#include "random_document.h"

#include "document/format.h"
#include "frond/random.h"

#include <math.h>
#include <string.h>

enum {
    MOST_COMPONENTS = 8,
    MOST_ATTRIBUTES = 9,
    MOST_LEVELS = 4, // of brackets in an expression
};

/// A document on its way. Draws come from a counter: nothing else needs the same ones.
typedef struct Maker {
    GString *out;
    FrKey key;
    uint32_t draws;
    uint32_t materials, sliders, curves;
    bool has_function;
} Maker;

static double draw(Maker *maker) {
    return fr_random(maker->key, 0, maker->draws++);
}

/// A whole number below `count`.
static uint32_t pick(Maker *maker, uint32_t count) {
    return (uint32_t)(draw(maker) * count);
}

static bool one_in(Maker *maker, uint32_t count) {
    return pick(maker, count) == 0;
}

static void append(Maker *maker, const char *format, ...) G_GNUC_PRINTF(2, 3);
static void append(Maker *maker, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    g_string_append_vprintf(maker->out, format, arguments);
    va_end(arguments);
}

static void append_real(Maker *maker, double value) {
    char text[G_ASCII_DTOSTR_BUF_SIZE];
    g_string_append(maker->out, g_ascii_formatd(text, sizeof text, "%.6g", value));
}

// ---- values -----------------------------------------------------------------------------------

/// Within a hard range: often its ends, 0 or 1, else of any size.
static double value_within(Maker *maker, double min, double max) {
    double value;
    switch (pick(maker, 12)) {
    case 0:
        value = min;
        break;
    case 1:
        value = max;
        break;
    case 2:
        value = min + draw(maker) * (max - min);
        break;
    case 3:
        value = 0;
        break;
    case 4:
        value = 1;
        break;
    default: // sizes as plants have them
        value = exp(-7 + 12 * draw(maker)) * (min < 0 && one_in(maker, 3) ? -1 : 1);
        break;
    }
    // What is printed with six digits must not be beyond the end.
    double inner = 1e-5 * (fabs(min) + fabs(max));
    bool is_end = value == min || value == max;
    return is_end ? value : CLAMP(value, MIN(min + inner, max), MAX(max - inner, min));
}

static const char *const variables[] = {"t",     "i",      "n",     "i1", "n1", "i2",     "n2",
                                        "depth", "order",  "x",     "s",  "v",  "height", "age",
                                        "time",  "season", "light", "pi", "phi"};
static const char *const curves[] = {"flat",      "ramp",    "fall",      "bell",  "dome",
                                     "s",         "conical", "spherical", "flame", "hemispherical",
                                     "tend-flame"};

static void append_expression(Maker *maker, int levels);

static void append_call(Maker *maker, int levels) {
    static const char *const one[] = {"abs",  "sign", "floor", "ceil", "round", "frac", "sqrt",
                                      "exp",  "log",  "sin",   "cos",  "tan",   "sind", "asin",
                                      "acos", "atan", "noise", "bell", "dome"};
    static const char *const two[] = {"mod", "pow", "min", "max", "step", "atan2", "noise"};
    static const char *const none[] = {"rand", "gauss"};
    uint32_t kind = pick(maker, 10);
    if (kind < 6) {
        append(maker, "%s(", one[pick(maker, G_N_ELEMENTS(one))]);
        append_expression(maker, levels);
    } else if (kind < 9) {
        append(maker, "%s(", two[pick(maker, G_N_ELEMENTS(two))]);
        append_expression(maker, levels);
        append(maker, ", ");
        append_expression(maker, levels);
    } else {
        append(maker, "%s(", none[pick(maker, G_N_ELEMENTS(none))]);
    }
    append(maker, ")");
}

static void append_name(Maker *maker) {
    if (maker->sliders > 0 && one_in(maker, 4)) {
        append(maker, "slide%u", pick(maker, maker->sliders));
    } else {
        append(maker, "%s", variables[pick(maker, G_N_ELEMENTS(variables))]);
    }
}

static void append_expression(Maker *maker, int levels) {
    static const char *const operators[] = {"+", "-", "*", "/", "%", "^", "&gt;", "==", " or "};
    switch (levels == 0 ? pick(maker, 2) : pick(maker, 6)) {
    case 0:
        append_real(maker, value_within(maker, 0, 100));
        break;
    case 1:
        append_name(maker);
        break;
    case 2:
        append_call(maker, levels - 1);
        break;
    case 3:
        append(maker, "(");
        append_expression(maker, levels - 1);
        append(maker, " &gt; 0.5 ? ");
        append_expression(maker, levels - 1);
        append(maker, " : ");
        append_expression(maker, levels - 1);
        append(maker, ")");
        break;
    default:
        append(maker, "(");
        append_expression(maker, levels - 1);
        append(maker, "%s", operators[pick(maker, G_N_ELEMENTS(operators))]);
        append_expression(maker, levels - 1);
        append(maker, ")");
        break;
    }
}

static void append_curve(Maker *maker) {
    if (maker->curves > 0 && one_in(maker, 4)) {
        append(maker, "curve%u", pick(maker, maker->curves));
    } else if (one_in(maker, 3)) {
        double x = 0;
        for (uint32_t i = 0, count = 1 + pick(maker, 4); i < count; i++) {
            append(maker, i == 0 ? "" : " ");
            append_real(maker, x);
            append(maker, ",");
            append_real(maker, value_within(maker, -2, 4));
            x += 0.01 + draw(maker);
        }
    } else {
        append(maker, "%s", curves[pick(maker, G_N_ELEMENTS(curves))]);
    }
}

static void append_factors(Maker *maker) {
    static const char *const over[] = {"parent", "self", "depth", "order", "age", "season", "time"};
    while (one_in(maker, 5)) {
        append(maker, " | ");
        if (maker->sliders > 0 && one_in(maker, 2)) {
            append(maker, "slide%u", pick(maker, maker->sliders));
        } else {
            append(maker, "%s ", over[pick(maker, G_N_ELEMENTS(over))]);
            append_curve(maker);
        }
    }
}

static void append_number(Maker *maker, double min, double max) {
    uint32_t kind = pick(maker, 12);
    if (kind == 0) {
        append(maker, "= ");
        append_expression(maker, (int)pick(maker, MOST_LEVELS));
    } else if (kind == 1) {
        append(maker, "keys 0,");
        append_real(maker, value_within(maker, min, max));
        append(maker, " 5,");
        append_real(maker, value_within(maker, min, max));
    } else {
        append_real(maker, value_within(maker, min, max));
        if (kind < 6) {
            append(maker, "..");
            append_real(maker, value_within(maker, min, max));
        }
        if (one_in(maker, 4)) {
            append(maker, " ~ ");
            append_real(maker, value_within(maker, 0, MIN(max, 100)));
        }
        if (kind == 2) {
            append(maker, " : ");
            append_expression(maker, (int)pick(maker, MOST_LEVELS));
        }
    }
    append_factors(maker);
}

static void append_points(Maker *maker, const char *name) {
    bool is_blade = g_str_has_prefix(name, "outline");
    for (uint32_t i = 0, count = one_in(maker, 9) ? 0 : 2 + pick(maker, 6); i < count; i++) {
        append(maker, i == 0 ? "" : " ");
        append_real(maker, is_blade ? (double)i / 6 : value_within(maker, -2, 2));
        append(maker, ",");
        append_real(maker, is_blade ? 0.5 * draw(maker) : value_within(maker, -2, 2));
    }
}

static void append_formula(Maker *maker, const char *choices) {
    char **names = g_strsplit(choices, " ", -1);
    uint32_t count = g_strv_length(names);
    static const char *const forms[] = {"%s", "2*%s", "%s^2", "sin(%s)", "1/%s", "exp(%s)", "-%s"};
    for (uint32_t i = 0, terms = 1 + pick(maker, 3); i < terms; i++) {
        append(maker, i == 0 ? "" : " + ");
        char *form = g_strdup(forms[pick(maker, G_N_ELEMENTS(forms))]);
        char **halves = g_strsplit(form, "%s", 2);
        append(maker, "%s%s%s", halves[0], names[pick(maker, count)], halves[1]);
        g_strfreev(halves);
        g_free(form);
    }
    g_strfreev(names);
}

/// What texts mean is known to their readers only; these are right for one of them.
static void append_text(Maker *maker, const char *name) {
    static const char *const only[] = {"all",  "odd",   "even", "first", "last",
                                       "2,13", "!2,13", "0..4", "%3=1"};
    if (strcmp(name, "material") == 0 && maker->materials > 0) {
        append(maker, "material%u", pick(maker, maker->materials));
    } else if (strcmp(name, "only") == 0) {
        append(maker, "%s", only[pick(maker, G_N_ELEMENTS(only))]);
    } else if (strcmp(name, "path") == 0) {
        for (uint32_t i = 0, count = 2 + pick(maker, 5); i < count; i++) {
            for (int axis = 0; axis < 3; axis++) {
                append(maker, axis > 0 ? "," : i > 0 ? " " : "");
                append_real(maker, value_within(maker, -5, 5));
            }
        }
    } else if (strcmp(name, "weights") == 0) {
        append(maker, one_in(maker, 4) ? "2" : "");
    } else if (strcmp(name, "points") == 0) {
        append(maker, "0,1,1:%u,0,0.5 1,1,1:0,%u,0", pick(maker, 3), pick(maker, 3));
    }
}

static void append_choice(Maker *maker, const char *choices) {
    char **names = g_strsplit(choices, " ", -1);
    append(maker, "%s", names[pick(maker, g_strv_length(names))]);
    g_strfreev(names);
}

/// Large numbers of things soon reach a limit; most plants shall be built.
static double most_of(Maker *maker, const FrParam *row) {
    static const char *const counts[] = {"number", "density", "steps",  "segments",
                                         "rings",  "whorl",   "detail", "size"};
    for (size_t i = 0; i < G_N_ELEMENTS(counts); i++) {
        if (strcmp(row->name, counts[i]) == 0 && !one_in(maker, 20)) {
            return CLAMP(12, row->min, row->max);
        }
    }
    return row->max;
}

static void append_value(Maker *maker, const FrParam *row) {
    double max = row->kind == FR_PARAM_VECTOR ? row->max : most_of(maker, row);
    switch (row->kind) {
    case FR_PARAM_NUMBER:
        append_number(maker, row->min, max);
        break;
    case FR_PARAM_REAL:
        append_real(maker, value_within(maker, row->min, max));
        break;
    case FR_PARAM_INTEGER:
        append(maker, "%.0f", floor(value_within(maker, row->min, max)));
        break;
    case FR_PARAM_SWITCH:
        append(maker, "%s", one_in(maker, 8) ? "no" : "yes");
        break;
    case FR_PARAM_CHOICE:
        append_choice(maker, row->choices);
        break;
    case FR_PARAM_TEXT:
        append_text(maker, row->name);
        break;
    case FR_PARAM_CURVE:
        append_curve(maker);
        break;
    case FR_PARAM_POINTS:
        append_points(maker, row->name);
        break;
    case FR_PARAM_VECTOR:
        for (int axis = 0; axis < 3; axis++) {
            append(maker, axis > 0 ? ", " : "");
            append_real(maker, value_within(maker, row->min, max));
        }
        break;
    case FR_PARAM_COLOUR:
        append(maker, "#%06x", pick(maker, 1 << 24));
        break;
    case FR_PARAM_FORMULA:
        append_formula(maker, row->choices);
        break;
    }
}

// ---- elements ---------------------------------------------------------------------------------

/// A few attributes of a table, none twice.
static void append_attributes(Maker *maker, const FrParamTable *table, uint32_t most) {
    bool is_given[256] = {false};
    for (uint32_t i = 0, count = pick(maker, most + 1); i < count; i++) {
        uint32_t index = pick(maker, (uint32_t)MIN(table->count, G_N_ELEMENTS(is_given)));
        const FrParam *row = &table->rows[index];
        bool is_file = strcmp(row->name, "picture") == 0 || g_str_has_suffix(row->name, "_map") ||
                       strcmp(row->name, "file") == 0;
        // A depth is the recursion's to give, a seed of half a million digits nobody's.
        if (is_given[index] || is_file || strcmp(row->name, "depth") == 0) {
            continue;
        }
        is_given[index] = true;
        char *name = fr_param_attribute(row);
        append(maker, " %s=\"", name);
        append_value(maker, row);
        append(maker, "\"");
        g_free(name);
    }
}

/// How likely a kind of component stands in a plant: stems and leaves more than the rest.
static FrComponentKind pick_kind(Maker *maker) {
    static const FrComponentKind usual[] = {FR_COMPONENT_TREE, FR_COMPONENT_TREE, FR_COMPONENT_HORN,
                                            FR_COMPONENT_LEAF, FR_COMPONENT_SIMPLE};
    return one_in(maker, 2) ? usual[pick(maker, G_N_ELEMENTS(usual))]
                            : (FrComponentKind)pick(maker, FR_COMPONENT_GRAFT); // needs a plant
}

static void append_link(Maker *maker, uint32_t from, uint32_t to) {
    static const char *const kinds[] = {"child", "branch", "branch", "leaf"};
    append(maker, "<link from=\"c%u\" to=\"c%u\" kind=\"%s\"/>\n", from, to,
           kinds[pick(maker, G_N_ELEMENTS(kinds))]);
}

/// Components, each following on one before it; at times shared, at times leading back.
static void append_graph(Maker *maker) {
    uint32_t count = 1 + pick(maker, MOST_COMPONENTS);
    append(maker, "<pgraph>\n<camera id=\"root\"/>\n");
    uint32_t back_from = one_in(maker, 3) ? pick(maker, count) : count;
    uint32_t back_to = back_from < count ? pick(maker, back_from + 1) : count;
    for (uint32_t i = 0; i < count; i++) {
        FrComponentKind kind = pick_kind(maker);
        kind = kind == FR_COMPONENT_CAMERA ? FR_COMPONENT_HORN : kind;
        append(maker, "<%s id=\"c%u\"", fr_pgraph_table(kind)->element, i);
        append_attributes(maker, fr_pgraph_table(kind), MOST_ATTRIBUTES);
        if (i == back_to) {
            append(maker, " depth=\"%u\"", one_in(maker, 30) ? 1000000 : 1 + pick(maker, 4));
        }
        append(maker, "/>\n");
    }
    append(maker, "<link from=\"root\" to=\"c0\"/>\n");
    for (uint32_t i = 1; i < count; i++) {
        uint32_t from = pick(maker, i);
        append_link(maker, from, i);
        if (from > 0 && one_in(maker, 6)) {
            append_link(maker, pick(maker, from), i);
        }
    }
    if (back_from < count) {
        append_link(maker, back_from, back_to);
    }
    append(maker, "</pgraph>\n");
}

/// A kind of plant that grows bud by bud, with rows of its own at times.
static void append_species(Maker *maker) {
    append(maker, "<species");
    append_attributes(maker, fr_species_table(), MOST_ATTRIBUTES);
    append(maker, ">\n");
    for (uint32_t i = 0, count = one_in(maker, 3) ? 1 + pick(maker, 3) : 0; i < count; i++) {
        append(maker, "<order");
        append_attributes(maker, fr_order_table(), 3);
        append(maker, "/>\n");
    }
    append(maker, "<sliders");
    append_attributes(maker, fr_species_sliders_table(), 2);
    append(maker, "/>\n</species>\n");
}

static void append_plant(Maker *maker, uint32_t index) {
    append(maker, "<plant id=\"plant%u\" seed=\"%u\">\n", index, pick(maker, 1000));
    maker->sliders = pick(maker, 3);
    for (uint32_t i = 0; i < maker->sliders; i++) {
        append(maker, "<slider id=\"slide%u\" max=\"2\" value=\"", i);
        append_real(maker, value_within(maker, 0, 2));
        append(maker, "\"/>\n");
    }
    if (one_in(maker, 60)) {
        append_species(maker);
    } else {
        append_graph(maker);
    }
    append(maker, "</plant>\n");
}

static void append_head(Maker *maker) {
    uint32_t curve_count = pick(maker, 3);
    for (uint32_t i = 0; i < curve_count; i++) {
        append(maker, "<curve id=\"curve%u\" points=\"0,%u 0.5,1 1,%u\"/>\n", i, pick(maker, 3),
               pick(maker, 3));
    }
    maker->curves = curve_count;
    uint32_t material_count = pick(maker, 3);
    for (uint32_t i = 0; i < material_count; i++) {
        append(maker, "<material id=\"material%u\"", i);
        append_attributes(maker, fr_material_table(), 4);
        append(maker, "/>\n");
    }
    maker->materials = material_count;
}

static void append_scene(Maker *maker, uint32_t plants) {
    append(maker, "<scene");
    append_attributes(maker, fr_scene_table(), 3);
    append(maker, ">\n<growth steps=\"%u\" views=\"6\" resolution=\"64\" seed=\"%u\"/>\n",
           pick(maker, 8), pick(maker, 9));
    for (uint32_t i = 0, count = pick(maker, 3); i < count; i++) {
        append(maker, "<place plant=\"plant%u\" at=\"%u, 0, 0\" turn=\"30\" scale=\"",
               pick(maker, plants), pick(maker, 9));
        append_real(maker, value_within(maker, 0.001, 1000));
        append(maker, "\"/>\n");
    }
    if (one_in(maker, 4)) {
        append(maker, "<row plants=\"plant%u\" individuals=\"2\" spacing=\"", pick(maker, plants));
        append_real(maker, value_within(maker, 0.1, 9));
        append(maker, "\">0,0,0 %u,3,1</row>\n", pick(maker, 9));
    }
    if (one_in(maker, 4)) {
        append(maker, "<strew plants=\"plant%u 2\" individuals=\"1\" number=\"%u\" spacing=\"",
               pick(maker, plants), pick(maker, 9));
        append_real(maker, value_within(maker, 0, 9));
        append(maker, "\"/>\n");
    }
    append(maker, "</scene>\n");
}

char *random_document(uint64_t number) {
    Maker maker = {.out = g_string_new("<frond version=\"1\">\n"), .key = fr_key_root(number)};
    append_head(&maker);
    uint32_t plants = one_in(&maker, 8) ? 2 : 1;
    for (uint32_t i = 0; i < plants; i++) {
        append_plant(&maker, i);
    }
    if (one_in(&maker, 4)) {
        append_scene(&maker, plants);
    }
    append(&maker, "</frond>\n");
    return g_string_free(maker.out, FALSE);
}
