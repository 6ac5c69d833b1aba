#include "expr/lexer.h"

#include <math.h>
#include <string.h>

FrSpan fr_place(FrSpan outer, size_t begin, size_t end) {
    if (outer.source == NULL) {
        return (FrSpan){.begin = (uint32_t)begin, .end = (uint32_t)end};
    }
    return fr_span_inside(outer, begin, end);
}

// ---- numbers ----------------------------------------------------------------------------------

static size_t skip_digits(const char *text, size_t size, size_t at) {
    while (at < size && g_ascii_isdigit(text[at])) {
        at++;
    }
    return at;
}

// The end of an exponent at `at`, or `at` if there is none: `2e` is 2 times nothing.
static size_t skip_exponent(const char *text, size_t size, size_t at) {
    size_t digits = at + 1;
    if (at >= size || (text[at] != 'e' && text[at] != 'E')) {
        return at;
    }
    if (digits < size && (text[digits] == '+' || text[digits] == '-')) {
        digits++;
    }
    size_t end = skip_digits(text, size, digits);
    return end > digits ? end : at;
}

FrScan fr_scan_number(const char *text, size_t size, size_t *at, double *value) {
    size_t whole = skip_digits(text, size, *at);
    size_t end = whole;
    bool is_range = whole + 1 < size && text[whole] == '.' && text[whole + 1] == '.';
    if (whole < size && text[whole] == '.' && !is_range) {
        end = skip_digits(text, size, whole + 1);
        if (end == whole + 1 && whole == *at) {
            return FR_SCAN_NONE; // a point alone
        }
    }
    if (end == *at) {
        return FR_SCAN_NONE;
    }
    end = skip_exponent(text, size, end);
    // Copied, because strtod would read on: `80.` of `80..30`, the hexadecimal of `0x10`.
    char *copy = g_strndup(text + *at, end - *at);
    *value = g_ascii_strtod(copy, NULL);
    g_free(copy);
    *at = end;
    if (!isfinite(*value)) {
        *value = 0;
        return FR_SCAN_TOO_LARGE;
    }
    return FR_SCAN_NUMBER;
}

// ---- tokens -----------------------------------------------------------------------------------

static const struct {
    char text[3];
    FrToken token;
} signs[] = {
    // Longer ones first.
    {"<=", FR_TOKEN_LESS_EQUAL}, {">=", FR_TOKEN_GREATER_EQUAL}, {"==", FR_TOKEN_EQUAL},
    {"!=", FR_TOKEN_NOT_EQUAL},  {"&&", FR_TOKEN_AND},           {"||", FR_TOKEN_OR},
    {"+", FR_TOKEN_PLUS},        {"-", FR_TOKEN_MINUS},          {"*", FR_TOKEN_TIMES},
    {"/", FR_TOKEN_DIVIDE},      {"%", FR_TOKEN_REMAINDER},      {"^", FR_TOKEN_POWER},
    {"<", FR_TOKEN_LESS},        {">", FR_TOKEN_GREATER},        {"!", FR_TOKEN_NOT},
    {"?", FR_TOKEN_QUESTION},    {":", FR_TOKEN_COLON},          {",", FR_TOKEN_COMMA},
    {"(", FR_TOKEN_OPEN},        {")", FR_TOKEN_CLOSE},
};

// Words that stand for signs, for use in XML, where & has to be escaped.
static const struct {
    const char *word;
    FrToken token;
} words[] = {{"and", FR_TOKEN_AND}, {"or", FR_TOKEN_OR}, {"not", FR_TOKEN_NOT}};

static void fail(FrLexer *lexer, const char *code, const char *format, int length) {
    lexer->token = FR_TOKEN_END;
    lexer->has_failed = true;
    fr_diags_add(lexer->diags, FR_ERROR, code, fr_place(lexer->span, lexer->begin, lexer->end),
                 "%s '%.*s'", format, length, lexer->text + lexer->begin);
}

static bool scan_sign(FrLexer *lexer) {
    size_t left = lexer->size - lexer->begin;
    for (size_t i = 0; i < G_N_ELEMENTS(signs); i++) {
        size_t length = strlen(signs[i].text);
        if (length <= left && memcmp(lexer->text + lexer->begin, signs[i].text, length) == 0) {
            lexer->token = signs[i].token;
            lexer->end = lexer->begin + length;
            return true;
        }
    }
    return false;
}

static void scan_word(FrLexer *lexer) {
    size_t at = lexer->begin;
    while (at < lexer->size && (g_ascii_isalnum(lexer->text[at]) || lexer->text[at] == '_')) {
        at++;
    }
    lexer->end = at;
    lexer->token = FR_TOKEN_NAME;
    for (size_t i = 0; i < G_N_ELEMENTS(words); i++) {
        size_t length = strlen(words[i].word);
        if (length == at - lexer->begin &&
            memcmp(lexer->text + lexer->begin, words[i].word, length) == 0) {
            lexer->token = words[i].token;
        }
    }
}

static void scan_string(FrLexer *lexer) {
    const char *text = lexer->text + lexer->begin;
    const char *close = memchr(text + 1, *text, lexer->size - lexer->begin - 1);
    if (close == NULL) {
        lexer->end = lexer->size;
        fail(lexer, "syntax", "the closing quotation mark is missing after", 1);
        return;
    }
    lexer->token = FR_TOKEN_STRING;
    lexer->end = lexer->begin + (size_t)(close - text) + 1;
}

// Reports what no token begins with, as one whole character.
static void reject(FrLexer *lexer) {
    const char *text = lexer->text + lexer->begin;
    size_t left = lexer->size - lexer->begin;
    gunichar code = g_utf8_get_char_validated(text, (gssize)left);
    bool is_character = code != (gunichar)-1 && code != (gunichar)-2;
    size_t length = is_character ? (size_t)(g_utf8_next_char(text) - text) : 1;
    lexer->end = lexer->begin + MIN(length, left);
    if (*text == '=') {
        fail(lexer, "unexpected-character", "to compare write '==', not", 1);
    } else {
        fail(lexer, "unexpected-character", "an expression cannot contain", (int)length);
    }
}

void fr_lexer_next(FrLexer *lexer) {
    size_t at = lexer->end;
    while (at < lexer->size && g_ascii_isspace(lexer->text[at])) {
        at++;
    }
    lexer->begin = lexer->end = at;
    if (at == lexer->size) {
        lexer->token = FR_TOKEN_END;
        return;
    }
    char first = lexer->text[at];
    switch (fr_scan_number(lexer->text, lexer->size, &lexer->end, &lexer->number)) {
    case FR_SCAN_TOO_LARGE:
        fail(lexer, "number-too-large",
             "this number is too large:", (int)MIN(lexer->end - lexer->begin, 40));
        return;
    case FR_SCAN_NUMBER:
        lexer->token = FR_TOKEN_NUMBER;
        return;
    case FR_SCAN_NONE:
        break;
    }
    if (g_ascii_isalpha(first) || first == '_') {
        scan_word(lexer);
    } else if (first == '"' || first == '\'') {
        scan_string(lexer);
    } else if (!scan_sign(lexer)) {
        reject(lexer);
    }
}
