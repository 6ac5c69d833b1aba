// Modules and productions. A symbol is one character; what follows in brackets are parameters.
#include "lsystem/parse.h"

#include <string.h>

#define MOST_PARAMETERS 255
#define MOST_PRODUCTIONS 65000

/// How many bytes an arrow takes here; 0 if none begins here.
static size_t arrow_length(const FrLparser *parser) {
    const char *here = parser->bytes + parser->at;
    if (g_str_has_prefix(here, "-->") || g_str_has_prefix(here, "-o>")) {
        return 3;
    }
    if (parser->system->is_paper) {
        return g_str_has_prefix(here, "->") ? 2 : g_str_has_prefix(here, "\xe2\x86\x92") ? 3 : 0;
    }
    return 0;
}

/// Takes the symbol of a module; -1 where none begins.
static int read_symbol(FrLparser *parser) {
    char c = fr_lparse_peek(parser);
    if (c == '\0' || c == '\n' || strchr("<>:*", c) != NULL || arrow_length(parser) > 0) {
        return -1;
    }
    if ((c == '(' || c == ')') && !parser->is_round) {
        fr_lparse_error(parser, parser->at, parser->at + 1, "syntax",
                        "a '%c' stands alone; parameters follow a symbol", c);
        return -1;
    }
    if ((unsigned char)c >= FR_LSYMBOLS || (unsigned char)c < ' ') {
        fr_lparse_error(parser, parser->at, parser->at + 1, "syntax",
                        "symbols are ASCII characters");
        return -1;
    }
    parser->at++;
    return c == '(' ? '[' : c == ')' ? ']' : c;
}

// ---- successors -------------------------------------------------------------------------------

static void put_word(FrLparser *parser, uint32_t word) {
    g_array_append_val(parser->system->words, word);
}

static bool accept_open(FrLparser *parser) {
    if (fr_lparse_peek(parser) != '?') {
        return false;
    }
    size_t before = parser->at++;
    char next = fr_lparse_peek(parser);
    if (next != ',' && next != ')') {
        parser->at = before;
        return false;
    }
    parser->system->is_open = true;
    return true;
}

// One parameter: a number goes into the template, an expression becomes code that puts it there.
static void read_parameter(FrLparser *parser, uint32_t first_word) {
    GArray *code = parser->system->code;
    uint32_t text = fr_lparse_string(parser);
    if (text != FR_NONE) {
        put_word(parser, fr_lword(text));
        return;
    }
    if (accept_open(parser)) {
        put_word(parser, FR_LOPEN);
        return;
    }
    size_t begin = parser->at;
    uint32_t before = code->len;
    parser->barrier = before;
    parser->stack = 0;
    fr_lparse_expression(parser);
    bool is_constant =
        code->len == before + 1 && g_array_index(code, FrLcode, before).op == FR_LOP_CONST;
    if (is_constant) {
        put_word(parser, fr_lword(g_array_index(code, FrLcode, before).value));
        g_array_set_size(code, before);
        g_array_set_size(parser->system->places, before);
    } else {
        uint32_t place = parser->system->words->len - first_word;
        put_word(parser, 0);
        fr_lparse_emit(parser, FR_LOP_PUT, place, 0, 0, begin);
    }
}

static void check_count(FrLparser *parser, unsigned count, size_t begin) {
    if (count == MOST_PARAMETERS && fr_lparse_peek(parser) == ',') {
        fr_lparse_error(parser, begin, parser->at, "too-many-parameters",
                        "a module has at most %d parameters", MOST_PARAMETERS);
    }
}

/// D(?), or the E of a ?E that has places for free space.
static bool asks_space(const FrLparser *parser, guint head, int symbol, int before) {
    const uint32_t *words = (const uint32_t *)(const void *)parser->system->words->data + head;
    bool is_open = false;
    for (unsigned k = 0; k < fr_lhead_count(*words); k++) {
        is_open |= words[1 + k] == FR_LOPEN;
    }
    return (symbol == 'D' && is_open) ||
           (before == '?' && symbol == 'E' && fr_lhead_count(*words) >= FR_LFIRST_OF_SPACE + 1);
}

static void read_module(FrLparser *parser, int symbol, FrLmodules *modules) {
    guint head = parser->system->words->len;
    unsigned count = 0;
    size_t begin = parser->at - 1;
    put_word(parser, 0);
    if (!parser->is_round && fr_lparse_accept(parser, "(")) {
        do {
            read_parameter(parser, modules->words);
            count++;
        } while (!parser->has_failed && count < MOST_PARAMETERS && fr_lparse_accept(parser, ","));
        check_count(parser, count, begin);
        fr_lparse_expect(parser, ")");
    }
    g_array_index(parser->system->words, uint32_t, head) = fr_lhead((unsigned)symbol, count);
    modules->modules++;
}

FrLmodules fr_lparse_modules(FrLparser *parser) {
    FrLsystem *system = parser->system;
    FrLmodules modules = {.words = system->words->len, .values = fr_lparse_code_here(parser)};
    uint32_t code = modules.values;
    int before = 0;
    if (!fr_lparse_accept(parser, "*")) {
        for (int symbol; !parser->has_failed && (symbol = read_symbol(parser)) >= 0;) {
            guint head = system->words->len;
            read_module(parser, symbol, &modules);
            system->asks_space |= asks_space(parser, head, symbol, before);
            system->has_cut |= symbol == '%';
            system->has_at |= symbol == '@';
            system->is_open |= before == '?' && strchr("PHLUQE", symbol) != NULL;
            before = symbol;
        }
    }
    modules.word_count = system->words->len - modules.words;
    if (fr_lparse_code_here(parser) == code) {
        modules.values = FR_NONE;
    } else {
        fr_lparse_emit(parser, FR_LOP_END, 0, 0, 0, parser->at);
    }
    return modules;
}

// ---- predecessors -----------------------------------------------------------------------------

static void read_formal(FrLparser *parser) {
    FrLformal formal = {FR_NONE, 0};
    size_t begin = parser->at;
    bool is_negative = fr_lparse_accept(parser, "-");
    if (g_ascii_isdigit(fr_lparse_peek(parser)) || fr_lparse_peek(parser) == '.') {
        char *end;
        double value = g_ascii_strtod(parser->bytes + parser->at, &end);
        parser->at = (size_t)(end - parser->bytes);
        formal.literal = (float)(is_negative ? -value : value);
    } else {
        fr_lparse_peek(parser);
        begin = parser->at;
        char *name = is_negative ? NULL : fr_lparse_name(parser);
        if (name == NULL) {
            fr_lparse_error(parser, begin, begin + 1, "syntax",
                            "a predecessor has names as parameters");
            return;
        }
        // A formal hides a global variable of its name.
        gpointer found = g_hash_table_lookup(parser->locals, name);
        formal.variable =
            found != NULL ? GPOINTER_TO_UINT(found) - 1 : fr_lparse_new_variable(parser, 1, begin);
        g_hash_table_insert(parser->locals, name, GUINT_TO_POINTER(formal.variable + 1));
    }
    g_array_append_val(parser->system->formals, formal);
}

static FrLpatterns read_patterns(FrLparser *parser) {
    FrLpatterns patterns = {parser->system->patterns->len, 0};
    if (fr_lparse_accept(parser, "*")) {
        return patterns;
    }
    for (int symbol; !parser->has_failed && (symbol = read_symbol(parser)) >= 0;) {
        FrLpattern pattern = {0, parser->system->formals->len};
        size_t begin = parser->at - 1;
        unsigned count = 0;
        if (!parser->is_round && fr_lparse_accept(parser, "(")) {
            do {
                read_formal(parser);
                count++;
            } while (!parser->has_failed && count < MOST_PARAMETERS &&
                     fr_lparse_accept(parser, ","));
            check_count(parser, count, begin);
            fr_lparse_expect(parser, ")");
        }
        pattern.key = fr_lhead((unsigned)symbol, count);
        g_array_append_val(parser->system->patterns, pattern);
        patterns.count++;
    }
    return patterns;
}

static void read_predecessor(FrLparser *parser, FrLproduction *production) {
    size_t begin = parser->at;
    production->strict = read_patterns(parser);
    if (fr_lparse_accept(parser, "<")) {
        production->left = production->strict;
        production->strict = read_patterns(parser);
    }
    if (fr_lparse_accept(parser, ">")) {
        production->right = read_patterns(parser);
    }
    if (!parser->has_failed && production->strict.count == 0) {
        fr_lparse_error(parser, begin, MAX(parser->at, begin + 1), "syntax",
                        "this production has no predecessor");
    }
    const GArray *patterns = parser->system->patterns;
    for (uint32_t i = 0; i < production->left.count; i++) {
        unsigned symbol =
            fr_lhead_symbol(g_array_index(patterns, FrLpattern, production->left.first + i).key);
        if (symbol == '[' || symbol == ']') {
            fr_lparse_error(parser, begin, parser->at, "syntax",
                            "a left context has no brackets: it is the way back to the root");
            return;
        }
    }
}

static void read_condition(FrLparser *parser, FrLproduction *production) {
    if (fr_lparse_peek(parser) == '{') {
        production->before = fr_lparse_block(parser);
    }
    if (!fr_lparse_accept(parser, "*") && fr_lparse_peek(parser) != '{' &&
        arrow_length(parser) == 0) {
        production->condition = fr_lparse_value(parser);
    }
    if (fr_lparse_peek(parser) == '{') {
        production->after = fr_lparse_block(parser);
    }
}

static void read_arrow(FrLparser *parser) {
    fr_lparse_peek(parser);
    size_t length = arrow_length(parser);
    if (length == 0 && !parser->has_failed) {
        fr_lparse_error(parser, parser->at, parser->at + 1, "syntax", "%s is wanted here",
                        parser->system->is_paper ? "->" : "-->");
    }
    parser->at += length;
}

/// The label, or the text of the predecessor; numbered where it has been used before.
static char *name_of(const FrLparser *parser, size_t begin, size_t end, char *label) {
    char *name = label != NULL ? label : g_strndup(parser->bytes + begin, MIN(end - begin, 60));
    for (char *c = name; *c != '\0'; c++) {
        *c = g_ascii_isspace(*c) ? ' ' : *c;
    }
    g_strstrip(name);
    guint times = GPOINTER_TO_UINT(g_hash_table_lookup(parser->names, name)) + 1;
    g_hash_table_insert(parser->names, g_strdup(name), GUINT_TO_POINTER(times));
    if (times > 1) {
        char *plain = name;
        name = g_strdup_printf("%s #%u", plain, times);
        g_free(plain);
    }
    return name;
}

/// Marks the modules of a successor as made by production `index`; calls get their instance later.
static void mark_modules(const FrLparser *parser, const FrLmodules *modules, uint32_t index) {
    for (uint32_t at = 0; at < modules->word_count;) {
        uint32_t *head = &g_array_index(parser->system->words, uint32_t, modules->words + at);
        *head |= fr_lhead_calls(*head) ? 0 : (index + 1) << 16;
        at += 1 + fr_lhead_count(*head);
    }
}

void fr_lparse_production(FrLparser *parser, FrLsection *section, char *label) {
    FrLsystem *system = parser->system;
    FrLproduction production = {
        .before = FR_NONE, .condition = FR_NONE, .after = FR_NONE, .weight = FR_NONE};
    fr_lparse_peek(parser);
    size_t begin = parser->at;
    parser->locals = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, NULL);
    parser->is_impure = false;
    read_predecessor(parser, &production);
    size_t end = parser->at;
    if (fr_lparse_accept(parser, ":")) {
        read_condition(parser, &production);
    }
    read_arrow(parser);
    FrLmodules modules = {0};
    if (!parser->has_failed) {
        modules = fr_lparse_modules(parser);
    }
    if (!parser->has_failed && fr_lparse_accept(parser, ":")) {
        production.weight = fr_lparse_value(parser);
    }
    production.words = modules.words;
    production.word_count = modules.word_count;
    production.modules = modules.modules;
    production.values = modules.values;
    production.is_pure = !parser->is_impure;
    production.is_plain = production.strict.count == 1 && production.left.count == 0 &&
                          production.right.count == 0 && production.condition == FR_NONE &&
                          production.before == FR_NONE && production.after == FR_NONE;
    production.span = fr_ltext_span(parser->text, begin, MAX(parser->at, begin + 1));
    g_hash_table_unref(parser->locals);
    parser->locals = NULL;
    if (system->productions->len >= MOST_PRODUCTIONS) {
        fr_lparse_error(parser, begin, end, "limit-productions",
                        "a file has at most %d productions", MOST_PRODUCTIONS);
    }
    if (parser->has_failed || !fr_lparse_at_line_end(parser)) {
        if (!parser->has_failed) {
            fr_lparse_error(parser, parser->at, parser->at + 1, "syntax",
                            "the production should end here");
        }
        g_free(label);
        return;
    }
    section->has_context |= production.left.count > 0 || production.right.count > 0;
    production.name = name_of(parser, begin, end, label);
    uint32_t index = system->productions->len;
    g_array_append_val(system->productions, production);
    mark_modules(parser, &modules, index);
    g_array_append_val(section->list, index);
}
