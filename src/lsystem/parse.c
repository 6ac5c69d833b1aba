// Files of L-systems: the grammar of cpfg (Lsystem: … endlsystem) and the notation of papers
// (label : predecessor -> successor). After an error the parser goes on with the next line.
#include "lsystem/parse.h"

#include "lsystem/parse_file.h"

#include <stdarg.h>
#include <string.h>

#define MOST_ERRORS 1000

static void complain(FrLparser *parser, FrSeverity severity, size_t begin, size_t end,
                     const char *code, const char *format, va_list values) {
    char *text = g_strdup_vprintf(format, values);
    fr_diags_add(parser->context->diags, severity, code, fr_ltext_span(parser->text, begin, end),
                 "%s", text);
    g_free(text);
}

void fr_lparse_error(FrLparser *parser, size_t begin, size_t end, const char *code,
                     const char *format, ...) {
    if (parser->has_failed || (parser->text->is_cut && begin >= parser->size)) {
        return; // one error a line, none where a comment hides the text; what follows is noise
    }
    va_list values;
    va_start(values, format);
    complain(parser, FR_ERROR, begin, end, code, format, values);
    va_end(values);
    parser->has_failed = true;
    parser->errors++;
}

void fr_lparse_warning(FrLparser *parser, size_t begin, size_t end, const char *code,
                       const char *format, ...) {
    va_list values;
    va_start(values, format);
    complain(parser, FR_WARNING, begin, end, code, format, values);
    va_end(values);
}

void fr_lparse_blanks(FrLparser *parser) {
    for (;;) {
        char c = parser->bytes[parser->at];
        bool is_continued = c == '\n' && parser->bytes[parser->at + 1] == '\t';
        if (c == ' ' || c == '\t' || c == '\f' || c == '\v' || is_continued ||
            (parser->is_block && c == '\n')) {
            parser->at++;
        } else {
            return;
        }
    }
}

char fr_lparse_peek(FrLparser *parser) {
    fr_lparse_blanks(parser);
    return parser->at < parser->size ? parser->bytes[parser->at] : '\0';
}

bool fr_lparse_accept(FrLparser *parser, const char *text) {
    fr_lparse_blanks(parser);
    size_t length = strlen(text);
    if (strncmp(parser->bytes + parser->at, text, length) != 0) {
        return false;
    }
    parser->at += length;
    return true;
}

bool fr_lparse_expect(FrLparser *parser, const char *text) {
    if (parser->has_failed) {
        return false;
    }
    if (fr_lparse_accept(parser, text)) {
        return true;
    }
    fr_lparse_error(parser, parser->at, parser->at + 1, "syntax", "'%s' is wanted here", text);
    return false;
}

char *fr_lparse_name(FrLparser *parser) {
    fr_lparse_blanks(parser);
    const char *begin = parser->bytes + parser->at, *end = begin;
    if (!g_ascii_isalpha(*begin) && *begin != '_') {
        return NULL;
    }
    while (g_ascii_isalnum(*end) || *end == '_') {
        end++;
    }
    parser->at += (size_t)(end - begin);
    return g_strndup(begin, (gsize)(end - begin));
}

bool fr_lparse_at_line_end(FrLparser *parser) {
    char c = fr_lparse_peek(parser);
    return c == '\0' || c == '\n';
}

void fr_lparse_skip_line(FrLparser *parser) {
    const char *bytes = parser->bytes;
    while (parser->at < parser->size &&
           (bytes[parser->at] != '\n' || bytes[parser->at + 1] == '\t')) {
        parser->at++;
    }
    parser->at += parser->at < parser->size;
    parser->has_failed = false;
}

// ---- keywords ---------------------------------------------------------------------------------

bool fr_lparse_keyword(FrLparser *parser, const char *keyword) {
    fr_lparse_blanks(parser);
    const char *at = parser->bytes + parser->at;
    for (const char *k = keyword; *k != '\0'; k++) {
        bool is_first = k == keyword || k[-1] == ' ';
        if (*k == ' ') {
            while (*at == ' ' || *at == '\t') {
                at++;
            }
            continue;
        }
        if (*k == ':') {
            while (*at == ' ' || *at == '\t') {
                at++;
            }
        }
        if (*at != *k && !(is_first && g_ascii_tolower(*at) == *k)) {
            return false;
        }
        at++;
    }
    parser->at = (size_t)(at - parser->bytes);
    return true;
}

static void end_line(FrLparser *parser) {
    if (!parser->has_failed && !fr_lparse_at_line_end(parser)) {
        fr_lparse_error(parser, parser->at, parser->at + 1, "syntax", "the line should end here");
    }
    fr_lparse_skip_line(parser);
}

/// `endlsystem`, with either part in capitals.
static bool accept_end(FrLparser *parser) {
    return fr_lparse_keyword(parser, "endlsystem") || fr_lparse_keyword(parser, "endLsystem");
}

static void read_symbols(FrLparser *parser, bool is_consider) {
    FrLunit *unit = parser->unit;
    for (int symbol = 0; symbol < FR_LSYMBOLS; symbol++) {
        unit->is_ignored[symbol] = is_consider;
    }
    for (char c; (c = fr_lparse_peek(parser)) != '\0' && c != '\n'; parser->at++) {
        if ((unsigned char)c < FR_LSYMBOLS) {
            unit->is_ignored[(unsigned char)c] = !is_consider;
        }
    }
}

void fr_lparse_axiom(FrLparser *parser) {
    fr_lparse_blanks(parser);
    size_t begin = parser->at;
    FrLmodules modules = fr_lparse_modules(parser);
    if (modules.modules == 0) {
        fr_lparse_error(parser, parser->at, parser->at + 1, "syntax", "the axiom is empty");
    }
    parser->unit->axiom = modules.words;
    parser->unit->axiom_words = modules.word_count;
    parser->unit->axiom_modules = modules.modules;
    parser->unit->axiom_values = modules.values;
    parser->unit->axiom_span = fr_ltext_span(parser->text, begin, parser->at);
    end_line(parser);
}

bool fr_lparse_header(FrLparser *parser) {
    static const char *const blocks[FR_LBLOCKS] = {[FR_LSTART] = "start:",
                                                   [FR_LSTART_EACH] = "start each:",
                                                   [FR_LEND_EACH] = "end each:",
                                                   [FR_LEND] = "end:"};
    FrLunit *unit = parser->unit;
    if (fr_lparse_keyword(parser, "seed:")) {
        unit->seed = fr_lparse_value(parser);
        unit->is_stochastic = true;
    } else if (fr_lparse_keyword(parser, "derivation length:")) {
        unit->length = fr_lparse_value(parser);
        g_hash_table_insert(unit->globals, g_strdup("Z"), GUINT_TO_POINTER(FR_LVAR_Z + 1));
    } else if (fr_lparse_keyword(parser, "ring lsystem") ||
               fr_lparse_keyword(parser, "ring l-system")) {
        unit->is_ring = true;
    } else if (fr_lparse_keyword(parser, "ignore:")) {
        read_symbols(parser, false);
    } else if (fr_lparse_keyword(parser, "consider:")) {
        read_symbols(parser, true);
    } else if (fr_lparse_keyword(parser, "define:")) {
        fr_lparse_define(parser);
    } else {
        for (int block = 0; block < FR_LBLOCKS; block++) {
            if (fr_lparse_keyword(parser, blocks[block])) {
                unit->blocks[block] = fr_lparse_block(parser);
                end_line(parser);
                return true;
            }
        }
        return false;
    }
    end_line(parser);
    return true;
}

static void report_no_header(FrLparser *parser) {
    static const char *const keywords[] = {
        "seed",  "derivation length", "ignore",  "consider", "define", "axiom",
        "Start", "StartEach",         "EndEach", "End"};
    size_t begin = parser->at, end = begin;
    while (end < parser->size && parser->bytes[end] != ':' && parser->bytes[end] != '\n') {
        end++;
    }
    char *word = g_strndup(parser->bytes + begin, end - begin);
    const char *near = fr_nearest_name(word, keywords, G_N_ELEMENTS(keywords));
    fr_lparse_error(parser, begin, MAX(end, begin + 1), "syntax",
                    "no such item before the axiom%s%s%s", near == NULL ? "" : "; did you mean '",
                    near == NULL ? "" : near, near == NULL ? "" : ":'?");
    g_free(word);
    fr_lparse_skip_line(parser);
}

static bool read_head(FrLparser *parser) {
    for (;;) {
        char c = fr_lparse_peek(parser);
        if (c == '\n') {
            parser->at++;
        } else if (c == '\0') {
            fr_lparse_error(parser, parser->at, parser->at, "syntax", "there is no axiom:");
            return false;
        } else if (fr_lparse_keyword(parser, "axiom:")) {
            fr_lparse_axiom(parser);
            return true;
        } else if (accept_end(parser)) {
            fr_lparse_error(parser, parser->at - 10, parser->at, "syntax",
                            "this L-system has no axiom:");
            return false;
        } else if (!fr_lparse_header(parser)) {
            report_no_header(parser);
        }
    }
}

/// Takes the heading of a section; false if none stands here.
static bool read_heading(FrLparser *parser, const char *keyword, FrLsection *section) {
    if (!fr_lparse_keyword(parser, keyword)) {
        return false;
    }
    fr_lparse_accept(parser, ":");
    section->warns = !fr_lparse_accept(parser, "no warnings");
    fr_lparse_accept(parser, "warnings");
    end_line(parser);
    return true;
}

static void read_sections(FrLparser *parser) {
    FrLunit *unit = parser->unit;
    FrLsection *section = &unit->sections[FR_LDERIVE];
    for (;;) {
        char c = fr_lparse_peek(parser);
        if (c == '\n') {
            parser->at++;
        } else if (c == '\0') {
            fr_lparse_error(parser, parser->at, parser->at, "syntax", "there is no endlsystem");
            return;
        } else if (accept_end(parser)) {
            end_line(parser);
            return;
        } else if (read_heading(parser, "decomposition", &unit->sections[FR_LDECOMPOSE])) {
            section = &unit->sections[FR_LDECOMPOSE];
        } else if (read_heading(parser, "homomorphism", &unit->sections[FR_LHOMOMORPHISM])) {
            section = &unit->sections[FR_LHOMOMORPHISM];
        } else if (section != unit->sections && fr_lparse_keyword(parser, "maximum depth:")) {
            section->depth = fr_lparse_value(parser);
            end_line(parser);
        } else if (section != unit->sections && fr_lparse_keyword(parser, "seed:")) {
            section->seed = fr_lparse_value(parser);
            end_line(parser);
        } else {
            fr_lparse_production(parser, section, NULL);
            fr_lparse_skip_line(parser);
        }
    }
}

/// Of two L-systems with one number only the first can be called.
static void check_label(FrLparser *parser, size_t begin, size_t end) {
    const GPtrArray *units = parser->system->units;
    for (guint u = 0; u + 1 < units->len; u++) {
        const FrLunit *unit = g_ptr_array_index(units, u);
        if (unit->id == parser->unit->id) {
            fr_lparse_warning(parser, begin, end, "duplicate-label",
                              "there is an L-system %" G_GINT64_FORMAT
                              " already; calls lead to that one",
                              unit->id);
            return;
        }
    }
}

static void read_label(FrLparser *parser) {
    fr_lparse_blanks(parser);
    size_t begin = parser->at;
    char *end;
    parser->unit->id = g_ascii_strtoll(parser->bytes + begin, &end, 10);
    if (fr_lparse_at_line_end(parser)) {
        fr_lparse_error(parser, begin, begin + 1, "syntax", "an L-system needs a label");
    } else if (end != parser->bytes + begin) {
        check_label(parser, begin, (size_t)(end - parser->bytes));
    }
    fr_lparse_skip_line(parser);
}

/// `Lsystem:`; a colon that is not there is told. What else stands before is told once.
static bool begin_lsystem(FrLparser *parser, bool *is_told) {
    size_t begin = parser->at;
    if (fr_lparse_keyword(parser, "lsystem:")) {
        return true;
    }
    if (fr_lparse_keyword(parser, "lsystem") || fr_lparse_keyword(parser, "l-system")) {
        size_t end = parser->at;
        fr_lparse_accept(parser, ":");
        fr_lparse_error(parser, begin, end, "syntax",
                        "an L-system begins with 'Lsystem:' and its label");
        parser->has_failed = false;
        return true;
    }
    if (!*is_told) {
        fr_lparse_error(parser, begin, begin + 1, "syntax", "'Lsystem:' is wanted here");
        *is_told = true;
    }
    fr_lparse_skip_line(parser);
    return false;
}

void fr_lparse_cpfg(FrLparser *parser) {
    bool is_told = false;
    while (parser->errors < MOST_ERRORS) {
        char c = fr_lparse_peek(parser);
        if (c == '\n') {
            parser->at++;
        } else if (c == '\0') {
            return;
        } else if (begin_lsystem(parser, &is_told)) {
            fr_lparse_begin_unit(parser);
            read_label(parser);
            if (read_head(parser)) {
                read_sections(parser);
            }
            parser->has_failed = false;
        }
    }
}
