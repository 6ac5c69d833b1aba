// Words of the expression language.
#pragma once

#include "frond/diag.h"

typedef enum FrToken {
    FR_TOKEN_END,
    FR_TOKEN_NUMBER,
    FR_TOKEN_NAME,
    FR_TOKEN_STRING,
    FR_TOKEN_PLUS,
    FR_TOKEN_MINUS,
    FR_TOKEN_TIMES,
    FR_TOKEN_DIVIDE,
    FR_TOKEN_REMAINDER,
    FR_TOKEN_POWER,
    FR_TOKEN_LESS,
    FR_TOKEN_LESS_EQUAL,
    FR_TOKEN_GREATER,
    FR_TOKEN_GREATER_EQUAL,
    FR_TOKEN_EQUAL,
    FR_TOKEN_NOT_EQUAL,
    FR_TOKEN_AND,
    FR_TOKEN_OR,
    FR_TOKEN_NOT,
    FR_TOKEN_QUESTION,
    FR_TOKEN_COLON,
    FR_TOKEN_COMMA,
    FR_TOKEN_OPEN,
    FR_TOKEN_CLOSE,
} FrToken;

typedef struct FrLexer {
    const char *text;
    size_t size;
    FrSpan span; // of the text
    FrDiags *diags;
    FrToken token;
    size_t begin, end; // of the token, in the text
    double number;     // value of FR_TOKEN_NUMBER
    bool has_failed;   // an error was reported
} FrLexer;

/// Moves on to the next token. What is not one is reported and skipped as FR_TOKEN_END.
void fr_lexer_next(FrLexer *lexer);

/// The place of bytes [begin, end) of a text at `outer`. Without a source they count from the
/// beginning of the text.
FrSpan fr_place(FrSpan outer, size_t begin, size_t end);

typedef enum FrScan { FR_SCAN_NONE, FR_SCAN_NUMBER, FR_SCAN_TOO_LARGE } FrScan;

/// Reads an unsigned decimal number at text[*at] and moves `at` behind it. A point that begins
/// `..` is not part of the number. The same in every locale.
FrScan fr_scan_number(const char *text, size_t size, size_t *at, double *value);
