// The notation of papers (van Haevre et al. 2004, after Prusinkiewicz, Lindenmayer 1990):
//
//     w : A                                   the axiom; also ω or axiom
//     p1 : lc < A(x) > rc : x > 1 -> FA(x/2) : 0.5
//     f(i) = 0.2 + 0.8*i                      a function, used as f(i) or, in one letter each, fi
#include "lsystem/parse_file.h"

#include <string.h>

#define MOST_CALLS 10000

/// Functions only call those before them, and yet a few lines can make calls without end.
static uint64_t count_calls(const FrLsystem *system, uint32_t code) {
    uint64_t calls = 1;
    for (; code < system->code->len; code++) {
        const FrLcode *at = &g_array_index(system->code, FrLcode, code);
        if (at->op == FR_LOP_USER) {
            uint64_t more = g_array_index(system->functions, FrLfunction, at->a).calls;
            calls = fr_count_add(calls, more);
        }
    }
    return calls;
}

static void read_function(FrLparser *parser, char *name) {
    size_t start = parser->at - strlen(name);
    FrLfunction function = {name, parser->unit->variables, 0, 0, 1};
    parser->locals = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, NULL);
    fr_lparse_expect(parser, "(");
    do {
        fr_lparse_blanks(parser);
        size_t begin = parser->at;
        char *formal = fr_lparse_name(parser);
        if (formal == NULL) {
            fr_lparse_error(parser, begin, begin + 1, "syntax", "a name is wanted here");
            break;
        }
        uint32_t variable = fr_lparse_new_variable(parser, 1, begin);
        g_hash_table_insert(parser->locals, formal, GUINT_TO_POINTER(variable + 1));
        function.count++;
    } while (!parser->has_failed && fr_lparse_accept(parser, ","));
    fr_lparse_expect(parser, ")");
    fr_lparse_expect(parser, "=");
    parser->function = name;
    function.code = fr_lparse_value(parser);
    parser->function = NULL;
    g_hash_table_unref(parser->locals);
    parser->locals = NULL;
    if (!parser->has_failed && parser->system->functions->len >= 64) {
        fr_lparse_error(parser, parser->at, parser->at, "limit-functions",
                        "a file has at most 64 functions");
    }
    function.calls = parser->has_failed ? 1 : count_calls(parser->system, function.code);
    if (function.calls > MOST_CALLS) {
        fr_lparse_error(parser, start, parser->at, "limit-calls",
                        "one call of '%s' makes more than %d calls of functions", name, MOST_CALLS);
        function.calls = 1; // told once
    }
    g_array_append_val(parser->system->functions, function);
}

/// Whether a name, formals in brackets and a single '=' stand here.
static bool is_function(const FrLparser *parser) {
    const char *at = parser->bytes + parser->at;
    if (!g_ascii_isalpha(*at) && *at != '_') {
        return false;
    }
    while (g_ascii_isalnum(*at) || *at == '_') {
        at++;
    }
    if (*at != '(') {
        return false;
    }
    while (*at != '\0' && *at != ')' && *at != '\n') {
        at++;
    }
    if (*at != ')') {
        return false;
    }
    for (at++; *at == ' ';) {
        at++;
    }
    return at[0] == '=' && at[1] != '=';
}

/// A label and its colon; NULL if there is none.
static char *read_label(FrLparser *parser) {
    const char *begin = parser->bytes + parser->at, *end = begin;
    while (g_ascii_isalnum(*end) || *end == '_' || (unsigned char)*end >= 0x80) {
        end++;
    }
    const char *colon = end;
    while (*colon == ' ' || *colon == '\t') {
        colon++;
    }
    if (end == begin || *colon != ':') {
        return NULL;
    }
    parser->at = (size_t)(colon - parser->bytes) + 1;
    return g_strndup(begin, (gsize)(end - begin));
}

static void read_labelled(FrLparser *parser) {
    size_t begin = parser->at;
    char *label = read_label(parser);
    if (label == NULL) {
        fr_lparse_error(parser, begin, begin + 1, "syntax",
                        "a line is 'label : predecessor -> successor', and 'w : axiom' once");
    } else if (strcmp(label, "w") == 0 || strcmp(label, "\xcf\x89") == 0 ||
               strcmp(label, "axiom") == 0) {
        g_free(label);
        fr_lparse_axiom(parser);
        return;
    } else {
        fr_lparse_production(parser, &parser->unit->sections[FR_LDERIVE], label);
    }
    fr_lparse_skip_line(parser);
}

static void settle_weights(FrLparser *parser) {
    const GArray *productions = parser->system->productions;
    for (guint i = 0; i < productions->len; i++) {
        parser->unit->is_stochastic |=
            g_array_index(productions, FrLproduction, i).weight != FR_NONE;
    }
}

void fr_lparse_paper(FrLparser *parser) {
    fr_lparse_begin_unit(parser);
    for (char c; (c = fr_lparse_peek(parser)) != '\0' && parser->errors < 1000;) {
        size_t begin = parser->at;
        if (c == '\n') {
            parser->at++;
        } else if (fr_lparse_keyword(parser, "brackets: round")) {
            if (parser->unit->axiom_modules > 0 || parser->system->productions->len > 0) {
                fr_lparse_error(parser, begin, parser->at, "syntax",
                                "'brackets: round' stands before the axiom and all productions");
            }
            parser->is_round = true;
            fr_lparse_skip_line(parser);
        } else if (is_function(parser)) {
            read_function(parser, fr_lparse_name(parser));
            fr_lparse_skip_line(parser);
        } else if (!fr_lparse_header(parser)) {
            read_labelled(parser);
        }
    }
    if (parser->errors == 0 && parser->unit->axiom_modules == 0) {
        fr_lparse_error(parser, 0, 1, "syntax", "there is no axiom: a line 'w : …' gives it");
    }
    settle_weights(parser);
}
