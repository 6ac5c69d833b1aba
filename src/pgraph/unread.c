// Parameters that other parameters leave without effect.
#include "pgraph/params.h"

#include "frond/pgraph.h"

#include <string.h>

// What `parameter` of `elements` is read with: `decider` is one of `values`. For texts, points and
// curves "" is none and "*" any; for numbers and integers "0" is constantly nothing, with "!"
// before it any other.
typedef struct Condition {
    const char *elements, *parameters, *decider, *values;
} Condition;

static const Condition conditions[] = {
    // stems
    {"horn tree", "length length_mode break_chance break_at forks curvature curvature_curve",
     "course", "grown"},
    {"horn tree", "gnarl gnarl_frequency gravitropism phototropism plagiotropism force_weight",
     "course", "grown"},
    {"horn tree", "curvature_back gnarl_fine align stiffness load deviation", "course", "grown"},
    {"horn tree", "segments twist", "course", "grown path"},
    {"horn tree", "path", "course", "path"},
    {"horn tree", "steps step_translate step_rotate_x step_rotate_y step_rotate_z step_scale",
     "course", "steps"},
    {"horn tree", "profile", "course", "grown path"},
    {"horn tree", "taper", "profile", ""},
    {"horn tree", "taper profile", "radius_mode", "absolute of-parent"},
    {"horn tree", "pipe_exponent", "radius_mode", "pipe"},
    {"horn tree simple", "section", "primitive", "tube area"},
    {"horn tree", "lobes lobe_depth", "section", ""},
    {"horn tree", "lobes lobe_depth", "primitive", "tube"},
    {"horn tree simple", "file", "primitive", "mesh"},
    {"horn tree simple", "detail", "primitive", "sphere cone cylinder torus circle"},
    {"simple", "size", "primitive",
     "tube area box sphere cone cylinder torus square circle triangle"},
    {"horn tree", "fork_arms fork_start fork_end fork_angle fork_azimuth fork_balance fork_radius",
     "forks", "!0"},
    {"horn tree", "fork_straightness", "forks", "!0"},
    {"horn tree", "break_at", "break_chance", "!0"},
    {"horn tree", "flare_height", "flare", "!0"},
    {"horn tree", "gnarl_fine_frequency", "gnarl_fine", "!0"},
    {"horn tree", "load", "stiffness", "!0"},
    {"horn tree", "deviation", "forks", "0"},
    // branches
    {"tree", "number", "mode", "number proportional bifurcation"},
    {"tree scatter", "density", "mode", "density"},
    {"tree", "internode", "mode", "internode"},
    {"tree", "start whorl", "mode", "number density internode nodes proportional"},
    {"tree", "regularity gap_ratio", "mode", "number density internode proportional"},
    {"tree", "spacing density_curve", "mode", "number density proportional"},
    {"tree", "azimuth_step", "phyllotaxis", "custom"},
    // leaves
    {"leaf", "outline", "outline_points", ""},
    {"leaf", "left_points", "outline_points", "*"},
    {"leaf", "super_m super_a super_b super_n1 super_n2 super_n3", "outline_points", ""},
    {"leaf", "super_m super_a super_b super_n1 super_n2 super_n3", "outline", "superformula"},
    // what spreads, scatters and chooses
    {"phiball phyllotaxis", "radius", "radius_mode", "absolute"},
    {"phiball phyllotaxis", "child_area", "radius_mode", "by-area"},
    {"phiball phyllotaxis", "child_radius", "radius_mode", "touching"},
    {"phyllotaxis", "form", "outline", ""},
    {"phyllotaxis", "smooth", "outline", "*"},
    {"scatter", "file density_file slope_from slope_to height_from height_to align", "surface",
     "mesh"},
    {"scatter", "radius", "surface", "disc square ring"},
    {"scatter", "inner_radius", "surface", "ring"},
    {"scatter", "number", "mode", "number"},
    {"variation", "weights", "rule", "random"},
    {"variation", "choice", "rule", "choice"},
    // what acts on all that follows
    {"ffd", "to_x to_y to_z", "preset", "none"},
    {"ffd", "degree_x degree_y degree_z", "form", "lattice"},
    {"world", "light_x light_y light_z", "sun", "no"},
    {"world", "sun_azimuth sun_elevation", "sun", "yes"},
    {"force", "direction", "kind", "direction"},
    {"force", "path", "kind", "curve"},
    {"force", "size", "kind", "box cylinder"},
    {"force", "file", "kind", "mesh"},
    {"force", "pitch", "kind", "vortex"},
    {"force", "range", "falloff", "linear inverse gauss"},
    {"force", "reach", "action", "follow pull avoid"},
    // all
    {"*", "growth_curve", "growth", "!0"},
    {"*", "tropism_axis", "tropism_x tropism_y tropism_z", "!0"},
};

static bool has_word(const char *words, const char *word) {
    size_t size = strlen(word);
    for (const char *at = words; *at != '\0'; at += strspn(at, " ")) {
        size_t length = strcspn(at, " ");
        if (length == size && memcmp(at, word, size) == 0) {
            return true;
        }
        at += length;
    }
    return false;
}

// A value as conditions write it.
static char *value_text(const FrParam *row, const void *params) {
    const void *field = (const char *)params + row->offset;
    switch (row->kind) {
    case FR_PARAM_CHOICE:
        return fr_param_choice(row, *(const int *)field);
    case FR_PARAM_SWITCH:
        return g_strdup(*(const bool *)field ? "yes" : "no");
    case FR_PARAM_NUMBER: {
        const FrNumber *number = field;
        return g_strdup(number->is_constant && number->constant == 0 ? "0" : "!0");
    }
    case FR_PARAM_POINTS:
        return g_strdup(((const FrPoints *)field)->count > 0 ? "*" : "");
    case FR_PARAM_CURVE:
        return g_strdup(*(FrCurve *const *)field != NULL ? "*" : "");
    default:
        return g_strdup("");
    }
}

// Whether any of the deciders has one of the values.
static bool is_met(const Condition *condition, const FrParamTable *table, const void *params) {
    char **names = g_strsplit(condition->decider, " ", -1);
    bool is_met = false;
    for (char **name = names; *name != NULL; name++) {
        const FrParam *row = fr_params_find(table, *name);
        FR_ASSERT(row != NULL);
        char *value = value_text(row, params);
        is_met |= *condition->values == '\0' ? *value == '\0' : has_word(condition->values, value);
        g_free(value);
    }
    g_strfreev(names);
    return is_met;
}

// "mode is density or internode".
static char *told(const Condition *condition) {
    char *name = g_strdelimit(g_strdup(condition->decider), "_", '-');
    char **names = g_strsplit(name, " ", -1);
    char *all = g_strjoinv(" or ", names);
    char **values = g_strsplit(condition->values, " ", -1);
    char *listed = g_strjoinv(" or ", values);
    bool is_given = strcmp(listed, "*") == 0;
    char *text = *listed == '\0' || is_given
                     ? g_strdup_printf("%s is %sgiven", all, is_given ? "" : "not ")
                 : *listed == '!' ? g_strdup_printf("%s is not 0", all)
                                  : g_strdup_printf("%s is %s", all, listed);
    g_free(listed);
    g_strfreev(values);
    g_free(all);
    g_strfreev(names);
    g_free(name);
    return text;
}

char *fr_pgraph_why_unread(FrComponentKind kind, const void *params, const FrParam *row) {
    const FrParamTable *table = fr_pgraph_table(kind);
    for (size_t k = 0; k < G_N_ELEMENTS(conditions); k++) {
        const Condition *condition = &conditions[k];
        bool is_about =
            has_word(condition->parameters, row->name) &&
            (*condition->elements == '*' || has_word(condition->elements, table->element));
        if (is_about && !is_met(condition, table, params)) {
            return told(condition);
        }
    }
    return NULL;
}
