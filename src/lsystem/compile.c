// From a source to a compiled L-system: preprocessing, parsing, the index of productions.
#include "frond/lsystem.h"

#include "lsystem/parse_file.h"
#include "lsystem/view.h"
#include "lsystem/warn.h"

#include <string.h>

static void production_clear(gpointer data) {
    g_free(((FrLproduction *)data)->name);
}

static void function_clear(gpointer data) {
    g_free(((FrLfunction *)data)->name);
}

static void external_clear(gpointer data) {
    g_free(((FrLexternal *)data)->name);
}

static void unit_free(gpointer data) {
    FrLunit *unit = data;
    for (int s = 0; s < FR_LSECTIONS; s++) {
        g_array_unref(unit->sections[s].list);
        g_free(unit->sections[s].sorted);
    }
    g_array_unref(unit->initializers);
    g_array_unref(unit->externals);
    g_hash_table_unref(unit->globals);
    g_free(unit);
}

void fr_lparse_begin_unit(FrLparser *parser) {
    FrLunit *unit = g_new0(FrLunit, 1);
    unit->variables = FR_LVAR_FIRST + (uint32_t)parser->value_count;
    unit->globals = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, NULL);
    g_hash_table_insert(unit->globals, g_strdup("Q"), GUINT_TO_POINTER(FR_LVAR_Q + 1));
    for (size_t i = 0; i < parser->value_count; i++) {
        g_hash_table_insert(unit->globals, g_strdup(parser->values[i].name),
                            GUINT_TO_POINTER(FR_LVAR_FIRST + i + 1));
    }
    unit->externals = g_array_new(FALSE, FALSE, sizeof(FrLexternal));
    g_array_set_clear_func(unit->externals, external_clear);
    unit->initializers = g_array_new(FALSE, FALSE, sizeof(uint32_t));
    unit->seed = unit->length = unit->axiom_values = FR_NONE;
    for (int b = 0; b < FR_LBLOCKS; b++) {
        unit->blocks[b] = FR_NONE;
    }
    for (int s = 0; s < FR_LSECTIONS; s++) {
        unit->sections[s] = (FrLsection){.list = g_array_new(FALSE, FALSE, sizeof(uint32_t)),
                                         .depth = FR_NONE,
                                         .seed = FR_NONE,
                                         .warns = true};
    }
    g_ptr_array_add(parser->system->units, unit);
    parser->unit = unit;
    parser->locals = NULL;
}

static unsigned first_symbol(const FrLsystem *system, uint32_t production) {
    const FrLproduction *p = &g_array_index(system->productions, FrLproduction, production);
    return fr_lhead_symbol(g_array_index(system->patterns, FrLpattern, p->strict.first).key);
}

static void index_section(const FrLsystem *system, FrLsection *section) {
    section->sorted = g_new(uint32_t, section->list->len + 1);
    uint32_t count = 0;
    for (unsigned symbol = 0; symbol < FR_LSYMBOLS; symbol++) {
        section->start[symbol] = count;
        for (guint i = 0; i < section->list->len; i++) {
            uint32_t production = g_array_index(section->list, uint32_t, i);
            if (first_symbol(system, production) == symbol) {
                section->sorted[count++] = production;
            }
        }
    }
    section->start[FR_LSYMBOLS] = count;
}

static FrLsystem *system_new(FrLtext *text) {
    FrLsystem *system = g_new0(FrLsystem, 1);
    system->text = text;
    system->code = g_array_new(FALSE, FALSE, sizeof(FrLcode));
    system->places = g_array_new(FALSE, FALSE, sizeof(uint32_t));
    system->patterns = g_array_new(FALSE, FALSE, sizeof(FrLpattern));
    system->formals = g_array_new(FALSE, FALSE, sizeof(FrLformal));
    system->words = g_array_new(FALSE, FALSE, sizeof(uint32_t));
    system->productions = g_array_new(FALSE, FALSE, sizeof(FrLproduction));
    g_array_set_clear_func(system->productions, production_clear);
    system->arrays = g_array_new(FALSE, FALSE, sizeof(FrLarray));
    system->functions = g_array_new(FALSE, FALSE, sizeof(FrLfunction));
    g_array_set_clear_func(system->functions, function_clear);
    system->strings = g_ptr_array_new_with_free_func(g_free);
    system->units = g_ptr_array_new_with_free_func(unit_free);
    system->values = g_array_new(FALSE, FALSE, sizeof(double));
    return system;
}

void fr_lsystem_free(FrLsystem *system) {
    if (system == NULL) {
        return;
    }
    fr_ltext_free(system->text);
    GArray *const arrays[] = {system->code,    system->places,    system->patterns,
                              system->formals, system->words,     system->productions,
                              system->arrays,  system->functions, system->values};
    for (size_t i = 0; i < G_N_ELEMENTS(arrays); i++) {
        g_array_unref(arrays[i]);
    }
    g_ptr_array_unref(system->strings);
    g_ptr_array_unref(system->units);
    g_free(system->folder);
    g_free(system);
}

static bool begins_as_cpfg(const FrLtext *text) {
    const char *c = text->bytes->str;
    while (g_ascii_isspace(*c)) {
        c++;
    }
    return g_ascii_strncasecmp(c, "lsystem", 7) == 0 || g_ascii_strncasecmp(c, "l-system", 8) == 0;
}

/// Values that nothing in the file asks for are slips of the finger. In a text with errors what
/// asks for them may not have been read.
static void report_unused(FrLparser *parser) {
    const GPtrArray *defined = parser->text->defined;
    for (size_t i = 0; i < parser->value_count; i++) {
        const FrLvalue *value = &parser->values[i];
        if (parser->is_used[i] || g_hash_table_contains(parser->text->held, value->name)) {
            continue;
        }
        const char *near = fr_nearest_name(value->name, (const char *const *)defined->pdata,
                                           MIN(defined->len, 1000));
        fr_diags_add(parser->context->diags, FR_ERROR, "unused-value", value->span,
                     "nothing in the L-system is called '%.64s'%s%s%s", value->name,
                     near == NULL ? "" : "; did you mean '", near == NULL ? "" : near,
                     near == NULL ? "" : "'?");
        parser->errors++;
    }
}

static FrStatus parse(FrLsystem *system, const FrLoptions *options, const FrContext *context) {
    const GString *bytes = system->text->bytes;
    FrLparser parser = {.system = system,
                        .text = system->text,
                        .bytes = bytes->str,
                        .size = bytes->len,
                        .context = context,
                        .values = options->values,
                        .value_count = options->value_count,
                        .is_used = g_new0(bool, options->value_count + 1),
                        .is_round = options->round_brackets,
                        .errors = system->text->is_cut,
                        .names = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, NULL)};
    for (size_t i = 0; i < options->value_count; i++) {
        g_array_append_val(system->values, options->values[i].value);
    }
    system->is_paper = options->notation == FR_LNOTATION_PAPER ||
                       (options->notation == FR_LNOTATION_AUTO && !begins_as_cpfg(system->text));
    if (system->is_paper) {
        fr_lparse_paper(&parser);
    } else {
        fr_lparse_cpfg(&parser);
        if (parser.errors == 0 && system->units->len == 0) {
            fr_lparse_error(&parser, 0, 1, "syntax", "there is no 'Lsystem:' in this file");
        }
    }
    if (parser.errors == 0) {
        report_unused(&parser);
    }
    if (parser.errors == 0) {
        fr_lwarn(system, context->diags);
    }
    g_hash_table_unref(parser.names);
    g_free(parser.is_used);
    return parser.errors == 0 ? FR_OK : FR_ERR_DOCUMENT;
}

/// What the text may know from the start: the functions of the view, the values set from outside.
static FrLname *known_names(const FrLoptions *options, size_t *count) {
    FrLname *names = fr_lview_names(options->view, count);
    names = g_renew(FrLname, names, *count + options->value_count + 1);
    for (size_t i = 0; i < options->value_count; i++) {
        names[(*count)++] = (FrLname){options->values[i].name, 0, true};
    }
    return names;
}

FrStatus fr_lsystem_compile(FrSource *source, const FrLoptions *options, const FrContext *context,
                            FrLsystem **out) {
    *out = NULL;
    FrLoptions plain = {0};
    options = options == NULL ? &plain : options;
    FrStatus status;
    size_t count = 0;
    FrLname *names = known_names(options, &count);
    FrLtext *text = fr_ltext_new(source, options->folder, names, count, context, &status);
    g_free(names);
    if (text == NULL) {
        return status;
    }
    FrLsystem *system = system_new(text);
    system->folder = g_strdup(options->folder);
    FrStatus parsed = parse(system, options, context);
    status = MAX(status, parsed);
    if (status != FR_OK) {
        fr_lsystem_free(system);
        return status;
    }
    for (guint u = 0; u < system->units->len; u++) {
        for (int s = 0; s < FR_LSECTIONS; s++) {
            FrLunit *unit = g_ptr_array_index(system->units, u);
            index_section(system, &unit->sections[s]);
        }
    }
    *out = system;
    return FR_OK;
}

bool fr_lsystem_is_open(const FrLsystem *system) {
    return system->is_open;
}

bool fr_lsystem_asks_space(const FrLsystem *system) {
    return system->asks_space;
}
