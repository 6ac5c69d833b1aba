// The parser's memory and the tools its two halves share: parse.c knows the grammar, parse_name.c
// what names mean.
#pragma once

#include "expr/lexer.h"
#include "expr/tree.h"

typedef struct FrParser {
    FrLexer lexer;
    FrTree *tree;
    const FrScope *scope;
    const char *const *arguments;
    size_t argument_count;
    unsigned nesting;
    unsigned errors;
    bool has_stopped; // a syntax error was met: nothing more is read or reported
} FrParser;

/// Reports an error at bytes [begin, end) of the text, unless the parser has stopped.
void fr_parser_report(FrParser *parser, const char *code, size_t begin, size_t end,
                      const char *format, ...) FR_PRINTF(5, 6);
/// Reports that something else should stand where the token is, and stops. Returns FR_NONE.
uint32_t fr_parser_expected(FrParser *parser, const char *what);
void fr_parser_next(FrParser *parser);
/// Moves on if the token is `token`.
bool fr_parser_accept(FrParser *parser, FrToken token);

// Nodes may be FR_NONE after an error: then the text is read on only to find more errors.

uint32_t fr_parser_add(FrParser *parser, FrNodeKind kind, uint32_t index, size_t begin, size_t end);
uint32_t fr_parser_number(FrParser *parser, double value, size_t begin, size_t end);
void fr_parser_adopt(FrParser *parser, uint32_t node, uint32_t child);
uint32_t fr_parser_operation(FrParser *parser, FrOp op, uint32_t left, uint32_t right);
uint32_t fr_parser_condition(FrParser *parser, uint32_t test, uint32_t yes, uint32_t no);

/// A whole expression, as an argument is one.
uint32_t fr_parse_condition(FrParser *parser);
/// The token is a name: a variable, a constant or a call.
uint32_t fr_parse_name(FrParser *parser);
