/// Command-line options: one row each says what it is called, which verbs take it and what it does.
#include "cli/cli.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

typedef struct OptionRow {
    const char *name;
    char letter;          ///< 0: none
    const char *argument; ///< NULL: takes none
    int verbs;            ///< of CliVerbId
    const char *meaning;
    bool (*take)(CliOptions *options, const char *value);
} OptionRow;

static bool take_integer(const char *name, const char *value, int64_t min, int64_t max,
                         int64_t *number) {
    GError *error = NULL;
    gint64 parsed;
    if (!g_ascii_string_to_signed(value, 10, min, max, &parsed, &error)) {
        cli_message("--%s takes a whole number from %" G_GINT64_FORMAT " to %" G_GINT64_FORMAT
                    ", not '%s'",
                    name, min, max, value);
        g_error_free(error);
        return false;
    }
    *number = parsed;
    return true;
}

static bool take_seed(CliOptions *options, const char *value) {
    return take_integer("seed", value, 0, UINT32_MAX, &options->seed);
}

static bool take_threads(CliOptions *options, const char *value) {
    int64_t threads;
    bool is_right = take_integer("threads", value, 1, 1024, &threads);
    options->threads = is_right ? (int)threads : 0;
    return is_right;
}

static bool take_lod(CliOptions *options, const char *value) {
    return take_integer("lod", value, 0, 8, &options->lod);
}

static bool take_count(CliOptions *options, const char *value) {
    return take_integer("count", value, 1, 1000000, &options->count);
}

static bool take_samples(CliOptions *options, const char *value) {
    return take_integer("samples", value, 1, 65536, &options->samples);
}

static bool take_size(CliOptions *options, const char *value) {
    char **sides = g_strsplit(value, "x", 3);
    guint64 width = 0, height = 0;
    bool is_right = g_strv_length(sides) == 2 &&
                    g_ascii_string_to_unsigned(sides[0], 10, 1, 32768, &width, NULL) &&
                    g_ascii_string_to_unsigned(sides[1], 10, 1, 32768, &height, NULL);
    g_strfreev(sides);
    if (!is_right) {
        cli_message(
            "--size takes WIDTHxHEIGHT in pixels, like 960x1200, each from 1 to 32768, not '%s'",
            value);
    }
    options->width = (int64_t)width;
    options->height = (int64_t)height;
    return is_right;
}

static bool take_leaves(CliOptions *options, const char *value) {
    static const char *const names[] = {"merged", "nodes", "gpu"};
    for (size_t i = 0; i < G_N_ELEMENTS(names); i++) {
        if (strcmp(value, names[i]) == 0) {
            options->leaves = (FrLeaves)i;
            return true;
        }
    }
    char *hint = cli_hint(value, names, G_N_ELEMENTS(names));
    cli_message("--leaves takes merged, nodes or gpu, not '%s'%s", value, hint);
    g_free(hint);
    return false;
}

static bool take_diag(CliOptions *options, const char *value) {
    options->is_diag_json = strcmp(value, "json") == 0;
    bool is_right = options->is_diag_json || strcmp(value, "text") == 0;
    if (!is_right) {
        cli_message("--diag takes text or json, not '%s'", value);
    }
    return is_right;
}

static bool take_limit(CliOptions *options, const char *value) {
    const char *equals = strchr(value, '=');
    if (equals == NULL) {
        cli_message("--limit takes NAME=VALUE, not '%s'", value);
        return false;
    }
    char *name = g_strndup(value, (gsize)(equals - value));
    FrDiags *diags = fr_diags_new();
    FrStatus status = fr_limits_set(&options->limits, name, equals + 1, diags);
    if (status != FR_OK && fr_diags_count(diags) > 0) {
        cli_message("%s", fr_diags_get(diags, 0)->text);
    }
    fr_diags_free(diags);
    g_free(name);
    return status == FR_OK;
}

static bool take_nurbs(CliOptions *options, const char *value) {
    FrNurbsParams params = fr_nurbs_default();
    bool is_right = cli_nurbs_set(&params, value);
    if (is_right) {
        g_ptr_array_add(options->nurbs, g_strdup(value));
    }
    return is_right;
}

static bool take_set(CliOptions *options, const char *value) {
    if (strchr(value, '=') == NULL) {
        cli_message("--set takes PATH=VALUE, like trunk.length=9, not '%s'", value);
        return false;
    }
    g_ptr_array_add(options->sets, g_strdup(value));
    return true;
}

static bool take_only(CliOptions *options, const char *value) {
    g_ptr_array_add(options->only, g_strdup(value));
    return true;
}

static bool take_in_place(CliOptions *options, const char *value) {
    (void)value;
    return options->in_place = true;
}

static bool take_output(CliOptions *options, const char *value) {
    g_ptr_array_add(options->outputs, g_strdup(value));
    return true;
}

static bool replace_text(char **text, const char *value) {
    g_free(*text);
    *text = g_strdup(value);
    return true;
}

static bool take_time(CliOptions *options, const char *value) {
    char *end;
    options->time = g_ascii_strtod(value, &end);
    bool is_right = end != value && *end == '\0' && options->time >= 0 && options->time <= 1e6;
    if (!is_right) {
        cli_message("--time takes years from 0 to 1000000, not '%s'", value);
    }
    return is_right;
}

static bool take_frames(CliOptions *options, const char *value) {
    enum { LAST = 999999 };
    const char *dots = strstr(value, "..");
    char *first = g_strndup(value, dots != NULL ? (gsize)(dots - value) : strlen(value));
    const char *last = dots != NULL ? dots + 2 : first;
    bool is_right =
        g_ascii_string_to_signed(first, 10, 0, LAST, &options->first_frame, NULL) &&
        g_ascii_string_to_signed(last, 10, options->first_frame, LAST, &options->last_frame, NULL);
    if (!is_right) {
        cli_message("--frames takes FIRST..LAST, from 0 to %d, the first not after the last, "
                    "not '%s'",
                    LAST, value);
    }
    options->has_frames = is_right;
    g_free(first);
    return is_right;
}

/// "points", "points=24", "organs".
static bool take_light_points(CliOptions *options, const char *value) {
    options->light_axis = -1;
    options->light_where = *value == 'o' ? FR_LIGHT_AT_ORGANS : FR_LIGHT_AT_GRID;
    options->light_count = 16;
    bool is_right = strcmp(value, "organs") == 0 || strcmp(value, "points") == 0 ||
                    (g_str_has_prefix(value, "points=") &&
                     g_ascii_string_to_signed(value + strlen("points="), 10, 1, 128,
                                              &options->light_count, NULL));
    options->has_light = is_right;
    return is_right;
}

static bool take_light(CliOptions *options, const char *value) {
    if (take_light_points(options, value)) {
        return true;
    }
    const char *axis = *value == '\0' ? NULL : strchr("xyz", *value);
    char *end = NULL;
    double at = axis != NULL && value[1] == '=' ? g_ascii_strtod(value + 2, &end) : 0;
    if (end == NULL || end == value + 2 || *end != '\0' || !(at >= -1e6 && at <= 1e6)) {
        cli_message("--light takes a slice like z=1.2, from -1000000 to 1000000, points, points=N "
                    "from 1 to 128, or organs, not '%s'",
                    value);
        return false;
    }
    options->has_light = true;
    options->light_axis = *value - 'x';
    options->light_at = at;
    return true;
}

static bool take_steps(CliOptions *options, const char *value) {
    return take_integer("steps", value, 0, 1000000000, &options->steps);
}

static bool take_checkpoint(CliOptions *options, const char *value) {
    return replace_text(&options->checkpoint, value);
}

static bool take_resume(CliOptions *options, const char *value) {
    return replace_text(&options->resume, value);
}

static bool take_view(CliOptions *options, const char *value) {
    return replace_text(&options->view, value);
}

static bool take_print(CliOptions *options, const char *value) {
    options->prints_count = strcmp(value, "count") == 0;
    options->prints_steps = strcmp(value, "steps") == 0;
    bool is_right = options->prints_count || options->prints_steps || strcmp(value, "string") == 0;
    if (!is_right) {
        cli_message("--print takes string, count or steps, not '%s'", value);
    }
    return is_right;
}

static bool take_plant(CliOptions *options, const char *value) {
    return replace_text(&options->plant, value);
}

static bool take_paths(CliOptions *options, const char *value) {
    return replace_text(&options->paths, value);
}

static bool take_camera(CliOptions *options, const char *value) {
    return replace_text(&options->camera, value);
}

static bool take_stats(CliOptions *options, const char *value) {
    return replace_text(&options->stats, value);
}

static bool take_preset(CliOptions *options, const char *value) {
    return replace_text(&options->preset, value);
}

static bool take_json(CliOptions *options, const char *value) {
    (void)value;
    return options->is_json = true;
}

static bool take_quiet(CliOptions *options, const char *value) {
    (void)value;
    return options->is_quiet = true;
}

static bool take_verbose(CliOptions *options, const char *value) {
    (void)value;
    return options->is_verbose = true;
}

static bool take_help(CliOptions *options, const char *value) {
    (void)value;
    return options->wants_help = true;
}

static bool take_version(CliOptions *options, const char *value) {
    (void)value;
    return options->wants_version = true;
}

enum {
    READING = CLI_BUILD | CLI_RENDER | CLI_CHECK | CLI_INFO | CLI_DERIVE | CLI_CONVERT | CLI_VARY,
    MAKING = CLI_BUILD | CLI_RENDER | CLI_VARY,
};

static const OptionRow rows[] = {
    {"output", 'o', "FILE", MAKING, "write FILE; its extension says the format; vary: a folder",
     take_output},
    {"seed", 0, "N", READING, "grow all plants from this seed", take_seed},
    {"set", 0, "PATH=VALUE", READING, "change an attribute, like trunk.length=9; in .l a number",
     take_set},
    {"lod", 0, "N", MAKING, "level of detail: 0 finest, to 8", take_lod},
    {"leaves", 0, "HOW", CLI_BUILD | CLI_VARY, "in glTF: merged (default), nodes, gpu",
     take_leaves},
    {"nurbs", 0, "NAME=VALUE", MAKING,
     "plants as rational surfaces, like circle=nine; the names of <nurbs>", take_nurbs},
    {"time", 0, "YEARS", CLI_BUILD | CLI_RENDER | CLI_INFO | CLI_VARY,
     "what the clocks of all plants show", take_time},
    {"paths", 0, "COMPONENT", CLI_INFO, "list the paths of its instances, for edits", take_paths},
    {"frames", 0, "A..B", CLI_RENDER,
     "a picture for each frame of a growth sequence, for each step of an L-system", take_frames},
    {"steps", 0, "N", READING, "steps of an L-system, and of growth bud by bud", take_steps},
    {"checkpoint", 0, "FILE", CLI_BUILD | CLI_RENDER,
     "write what has grown bud by bud to FILE after every step", take_checkpoint},
    {"only", 0, "NAME", CLI_BUILD | CLI_RENDER | CLI_INFO,
     "grow all, show of it only what is called so: oak, place-2, row.3", take_only},
    {"in-place", 0, NULL, CLI_BUILD | CLI_RENDER,
     "what --only shows stays where it stands, else it is moved to the origin", take_in_place},
    {"resume", 0, "FILE", CLI_BUILD | CLI_RENDER, "go on from such a FILE", take_resume},
    {"view", 0, "FILE", READING, "the view (.v) of an L-system", take_view},
    {"print", 0, "WHAT", CLI_DERIVE, "string (default), count, or steps: counts of each",
     take_print},
    {"count", 0, "N", CLI_VARY, "instances; 7 if not given", take_count},
    {"plant", 0, "NAME", CLI_VARY | CLI_DERIVE | CLI_CONVERT,
     "the plant to vary, derive or convert", take_plant},
    {"size", 0, "WxH", CLI_RENDER | CLI_VARY, "pixels of the picture, of each picture of a sheet",
     take_size},
    {"samples", 0, "N", CLI_RENDER | CLI_VARY, "paths per pixel", take_samples},
    {"light", 0, "WHERE", CLI_RENDER,
     "the light in false colours: in a slice like z=1.2, at points or at organs", take_light},
    {"camera", 0, "NAME", CLI_RENDER, "the view of that name", take_camera},
    {"preset", 0, "NAME", CLI_NEW,
     "the species to begin with, else a young tree; see frond presets", take_preset},
    {"json", 0, NULL, CLI_INFO | CLI_PRESETS, "for programs instead of people", take_json},
    {"threads", 0, "N", READING, "threads to use; all processors if not given", take_threads},
    {"limit", 0, "NAME=VALUE", READING, "allow more or less, like instances=1000000", take_limit},
    {"stats", 0, "FILE", MAKING, "write statistics as JSON; - is standard output", take_stats},
    {"diag", 0, "text|json", READING, "how errors are printed", take_diag},
    {"quiet", 'q', NULL, CLI_ALL, "errors only", take_quiet},
    {"verbose", 'v', NULL, READING, "say what is done and how long it took", take_verbose},
    {"help", 'h', NULL, CLI_ALL, "this help", take_help},
    {"version", 0, NULL, CLI_ALL, "the version of the program", take_version},
};

/// The default limits, but no single plant or mesh of more than three quarters of the memory.
static FrLimits limits_here(void) {
    FrLimits limits = fr_limits_default();
    long pages = sysconf(_SC_PHYS_PAGES), size = sysconf(_SC_PAGE_SIZE);
    if (pages > 0 && size > 0) {
        uint64_t memory = fr_count_multiply((uint64_t)pages, (uint64_t)size);
        limits.bytes = MIN(limits.bytes, memory / 4 * 3);
    }
    return limits;
}

CliOptions cli_options_new(void) {
    return (CliOptions){.files = g_ptr_array_new_with_free_func(g_free),
                        .outputs = g_ptr_array_new_with_free_func(g_free),
                        .sets = g_ptr_array_new_with_free_func(g_free),
                        .only = g_ptr_array_new_with_free_func(g_free),
                        .seed = -1,
                        .time = NAN,
                        .steps = -1,
                        .limits = limits_here(),
                        .nurbs = g_ptr_array_new_with_free_func(g_free)};
}

void cli_options_clear(CliOptions *options) {
    g_ptr_array_unref(options->files);
    g_ptr_array_unref(options->outputs);
    g_ptr_array_unref(options->sets);
    g_ptr_array_unref(options->only);
    g_ptr_array_unref(options->nurbs);
    g_free(options->camera);
    g_free(options->stats);
    g_free(options->checkpoint);
    g_free(options->resume);
    g_free(options->preset);
    g_free(options->plant);
    g_free(options->view);
    g_free(options->paths);
}

/// `name` is without its dashes. No name is near a single letter.
static void report_unknown(const char *name, bool is_long, const CliVerb *verb) {
    const char *names[G_N_ELEMENTS(rows)];
    size_t count = 0;
    for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
        if (verb == NULL || (rows[i].verbs & (int)verb->id) != 0) {
            names[count++] = rows[i].name;
        }
    }
    const char *near = is_long ? fr_nearest_name(name, names, count) : NULL;
    if (near != NULL) {
        cli_message("unknown option '--%s'; did you mean '--%s'?", name, near);
    } else {
        cli_message("unknown option '%s%s'; frond %s%s-h lists them", is_long ? "--" : "-", name,
                    verb == NULL ? "" : verb->name, verb == NULL ? "" : " ");
    }
}

static const OptionRow *find_row(const char *name, size_t length, char letter) {
    for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
        bool is_named = name != NULL && strlen(rows[i].name) == length &&
                        memcmp(rows[i].name, name, length) == 0;
        if (is_named || (letter != 0 && rows[i].letter == letter)) {
            return &rows[i];
        }
    }
    return NULL;
}

static bool check_verb(const OptionRow *row, const CliVerb *verb) {
    if (verb == NULL || (row->verbs & (int)verb->id) != 0) {
        return true;
    }
    cli_message("'%s' does not take --%s", verb->name, row->name);
    return false;
}

/// Does one option; *used counts the arguments it took.
static bool take_option(CliOptions *options, const CliVerb *verb, int count, char **arguments,
                        int *used) {
    const char *argument = arguments[0];
    bool is_long = argument[1] == '-';
    const char *name = argument + 2;
    size_t length = strcspn(name, "=");
    const OptionRow *row = is_long ? find_row(name, length, 0) : find_row(NULL, 0, argument[1]);
    if (row == NULL) {
        char *unknown = is_long ? g_strndup(name, length) : g_strdup(argument + 1);
        report_unknown(unknown, is_long, verb);
        g_free(unknown);
        return false;
    }
    if (!check_verb(row, verb)) {
        return false;
    }
    const char *attached = is_long ? (name[length] == '=' ? name + length + 1 : NULL)
                                   : (argument[2] != '\0' ? argument + 2 : NULL);
    *used = 1;
    if (row->argument == NULL) {
        if (attached != NULL) {
            cli_message("--%s takes no value", row->name);
            return false;
        }
        return row->take(options, NULL);
    }
    if (attached == NULL) {
        if (count < 2) {
            cli_message("--%s needs a value: %s", row->name, row->argument);
            return false;
        }
        attached = arguments[1];
        *used = 2;
    }
    return row->take(options, attached);
}

/// Options that mean nothing without another.
static bool check_together(const CliOptions *options) {
    if (options->in_place && options->only->len == 0) {
        cli_message("--in-place says where the plants of --only stand; there is no --only");
        return false;
    }
    return true;
}

bool cli_options_parse(CliOptions *options, const CliVerb *verb, int count, char **arguments) {
    bool are_over = false;
    for (int i = 0; i < count;) {
        int used = 1;
        if (!are_over && strcmp(arguments[i], "--") == 0) {
            are_over = true;
        } else if (!are_over && arguments[i][0] == '-' && arguments[i][1] != '\0') {
            if (!take_option(options, verb, count - i, arguments + i, &used)) {
                return false;
            }
        } else {
            g_ptr_array_add(options->files, g_strdup(arguments[i]));
        }
        i += used;
    }
    return check_together(options);
}

void cli_options_print(CliVerbId verb, FILE *out) {
    for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
        if ((rows[i].verbs & (int)verb) == 0) {
            continue;
        }
        char *name = g_strdup_printf("--%s%s%s", rows[i].name, rows[i].argument == NULL ? "" : " ",
                                     rows[i].argument == NULL ? "" : rows[i].argument);
        char letter[] = {rows[i].letter == 0 ? ' ' : '-',
                         rows[i].letter == 0 ? ' ' : rows[i].letter,
                         rows[i].letter == 0 ? ' ' : ',', '\0'};
        fprintf(out, "  %s %-18s %s\n", letter, name, rows[i].meaning);
        g_free(name);
    }
}
