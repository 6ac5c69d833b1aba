// Recursive descent from text to tree.
#include "expr/parser.h"

#include <string.h>

// So many wrong names are reported before the rest of the text is given up.
#define MOST_ERRORS 20

static uint32_t parse_unary(FrParser *parser);

// ---- errors -----------------------------------------------------------------------------------

static void stop(FrParser *parser) {
    parser->has_stopped = true;
    parser->lexer.token = FR_TOKEN_END;
}

void fr_parser_report(FrParser *parser, const char *code, size_t begin, size_t end,
                      const char *format, ...) {
    if (parser->has_stopped || parser->lexer.has_failed) {
        return;
    }
    va_list list;
    va_start(list, format);
    char *text = g_strdup_vprintf(format, list);
    va_end(list);
    fr_diags_add(parser->lexer.diags, FR_ERROR, code, fr_place(parser->lexer.span, begin, end),
                 "%s", text);
    g_free(text);
    if (++parser->errors == MOST_ERRORS) {
        stop(parser);
    }
}

// Reports that something else should stand where the token is.
uint32_t fr_parser_expected(FrParser *parser, const char *what) {
    FrLexer *lexer = &parser->lexer;
    int length = (int)MIN(lexer->end - lexer->begin, 40);
    if (lexer->token == FR_TOKEN_END) {
        fr_parser_report(parser, "syntax", lexer->begin, lexer->end,
                         "the expression ends where %s should be", what);
    } else {
        fr_parser_report(parser, "syntax", lexer->begin, lexer->end,
                         "here should be %s, not '%.*s'", what, length, lexer->text + lexer->begin);
    }
    stop(parser);
    return FR_NONE;
}

void fr_parser_next(FrParser *parser) {
    if (!parser->has_stopped && !parser->lexer.has_failed) {
        fr_lexer_next(&parser->lexer);
    }
}

bool fr_parser_accept(FrParser *parser, FrToken token) {
    if (parser->lexer.token != token) {
        return false;
    }
    fr_parser_next(parser);
    return true;
}

static bool is_too_deep(FrParser *parser) {
    if (parser->nesting <= FR_EXPR_NESTING) {
        return false;
    }
    fr_parser_report(parser, "expression-nesting", parser->lexer.begin, parser->lexer.end,
                     "the expression is nested over %d deep", FR_EXPR_NESTING);
    stop(parser);
    return true;
}

// ---- making nodes -----------------------------------------------------------------------------

uint32_t fr_parser_add(FrParser *parser, FrNodeKind kind, uint32_t index, size_t begin,
                       size_t end) {
    return fr_tree_add(parser->tree, kind, index, begin, end);
}

uint32_t fr_parser_number(FrParser *parser, double value, size_t begin, size_t end) {
    uint32_t node = fr_parser_add(parser, FR_NODE_NUMBER, 0, begin, end);
    fr_tree_node(parser->tree, node)->number = value;
    return node;
}

void fr_parser_adopt(FrParser *parser, uint32_t node, uint32_t child) {
    if (node == FR_NONE || child == FR_NONE) {
        return;
    }
    fr_tree_adopt(parser->tree, node, child);
    const FrNode *parent = fr_tree_node(parser->tree, node);
    if (parent->depth > FR_EXPR_DEPTH) {
        fr_parser_report(parser, "expression-nesting", parent->begin, parent->end,
                         "the expression has over %d operations in a row", FR_EXPR_DEPTH);
        stop(parser);
    }
}

uint32_t fr_parser_operation(FrParser *parser, FrOp op, uint32_t left, uint32_t right) {
    if (left == FR_NONE || right == FR_NONE) {
        return FR_NONE;
    }
    uint32_t node =
        fr_parser_add(parser, FR_NODE_OPERATION, op, fr_tree_node(parser->tree, left)->begin,
                      fr_tree_node(parser->tree, right)->end);
    fr_parser_adopt(parser, node, left);
    fr_parser_adopt(parser, node, right);
    return node;
}

uint32_t fr_parser_condition(FrParser *parser, uint32_t test, uint32_t yes, uint32_t no) {
    if (test == FR_NONE || yes == FR_NONE || no == FR_NONE) {
        return FR_NONE;
    }
    uint32_t node =
        fr_parser_add(parser, FR_NODE_CONDITION, 0, fr_tree_node(parser->tree, test)->begin,
                      fr_tree_node(parser->tree, no)->end);
    fr_parser_adopt(parser, node, test);
    fr_parser_adopt(parser, node, yes);
    fr_parser_adopt(parser, node, no);
    return node;
}

// ---- the grammar ------------------------------------------------------------------------------

static uint32_t parse_primary(FrParser *parser) {
    FrLexer *lexer = &parser->lexer;
    size_t begin = lexer->begin;
    uint32_t node;
    switch (lexer->token) {
    case FR_TOKEN_NUMBER:
        node = fr_parser_number(parser, lexer->number, begin, lexer->end);
        fr_parser_next(parser);
        return node;
    case FR_TOKEN_NAME:
        return fr_parse_name(parser);
    case FR_TOKEN_OPEN:
        fr_parser_next(parser);
        node = fr_parse_condition(parser);
        if (node != FR_NONE) {
            fr_tree_node(parser->tree, node)->begin = (uint32_t)begin;
            fr_tree_node(parser->tree, node)->end = (uint32_t)lexer->end;
        }
        if (!fr_parser_accept(parser, FR_TOKEN_CLOSE)) {
            return fr_parser_expected(parser, "a closing parenthesis");
        }
        return node;
    default:
        return fr_parser_expected(parser, "a number, a name or a parenthesis");
    }
}

static uint32_t parse_unary(FrParser *parser);

// What a sign or a power acts on. A parenthesis alone is a level already: here it is not counted.
static uint32_t parse_operand(FrParser *parser) {
    if (is_too_deep(parser)) {
        return FR_NONE;
    }
    parser->nesting++;
    uint32_t node = parse_unary(parser);
    parser->nesting--;
    return node;
}

// -x^2 is -(x^2), 2^-x is 2^(-x), 2^3^2 is 2^(3^2).
static uint32_t parse_unary(FrParser *parser) {
    FrToken sign = parser->lexer.token;
    size_t begin = parser->lexer.begin;
    uint32_t node;
    if (sign == FR_TOKEN_MINUS || sign == FR_TOKEN_NOT) {
        fr_parser_next(parser);
        uint32_t child = parse_operand(parser);
        node = FR_NONE;
        if (child != FR_NONE) {
            size_t end = fr_tree_node(parser->tree, child)->end;
            FrOp op = sign == FR_TOKEN_MINUS ? FR_OP_NEGATE : FR_OP_NOT;
            node = fr_parser_add(parser, FR_NODE_OPERATION, op, begin, end);
            fr_parser_adopt(parser, node, child);
        }
    } else if (fr_parser_accept(parser, FR_TOKEN_PLUS)) {
        node = parse_operand(parser);
    } else {
        node = parse_primary(parser);
        if (fr_parser_accept(parser, FR_TOKEN_POWER)) {
            node = fr_parser_operation(parser, FR_OP_POWER, node, parse_operand(parser));
        }
    }
    return node;
}

// Binary operators, loosest first.
enum { LEVEL_OR, LEVEL_AND, LEVEL_COMPARISON, LEVEL_SUM, LEVEL_PRODUCT, LEVEL_NONE };

static int level_of(FrToken token, FrOp *op) {
    *op = FR_OP_END;
    switch (token) {
    case FR_TOKEN_OR:
        return LEVEL_OR;
    case FR_TOKEN_AND:
        return LEVEL_AND;
    case FR_TOKEN_LESS:
        *op = FR_OP_LESS;
        return LEVEL_COMPARISON;
    case FR_TOKEN_LESS_EQUAL:
        *op = FR_OP_LESS_EQUAL;
        return LEVEL_COMPARISON;
    case FR_TOKEN_GREATER:
        *op = FR_OP_GREATER;
        return LEVEL_COMPARISON;
    case FR_TOKEN_GREATER_EQUAL:
        *op = FR_OP_GREATER_EQUAL;
        return LEVEL_COMPARISON;
    case FR_TOKEN_EQUAL:
        *op = FR_OP_EQUAL;
        return LEVEL_COMPARISON;
    case FR_TOKEN_NOT_EQUAL:
        *op = FR_OP_NOT_EQUAL;
        return LEVEL_COMPARISON;
    case FR_TOKEN_PLUS:
        *op = FR_OP_ADD;
        return LEVEL_SUM;
    case FR_TOKEN_MINUS:
        *op = FR_OP_SUBTRACT;
        return LEVEL_SUM;
    case FR_TOKEN_TIMES:
        *op = FR_OP_MULTIPLY;
        return LEVEL_PRODUCT;
    case FR_TOKEN_DIVIDE:
        *op = FR_OP_DIVIDE;
        return LEVEL_PRODUCT;
    case FR_TOKEN_REMAINDER:
        *op = FR_OP_REMAINDER;
        return LEVEL_PRODUCT;
    default:
        return LEVEL_NONE;
    }
}

static uint32_t truth(FrParser *parser, uint32_t child) {
    if (child == FR_NONE) {
        return FR_NONE;
    }
    const FrNode *inner = fr_tree_node(parser->tree, child);
    uint32_t node = fr_parser_add(parser, FR_NODE_TRUTH, 0, inner->begin, inner->end);
    fr_parser_adopt(parser, node, child);
    return node;
}

// `a and b` is `a ? truth(b) : 0`: what a decides, b is not asked.
static uint32_t combine(FrParser *parser, int level, FrOp op, uint32_t left, uint32_t right) {
    if (left == FR_NONE || right == FR_NONE) {
        return FR_NONE;
    }
    size_t begin = fr_tree_node(parser->tree, left)->begin;
    size_t end = fr_tree_node(parser->tree, right)->end;
    if (level == LEVEL_OR) {
        return fr_parser_condition(parser, left, fr_parser_number(parser, 1, begin, end),
                                   truth(parser, right));
    }
    if (level == LEVEL_AND) {
        return fr_parser_condition(parser, left, truth(parser, right),
                                   fr_parser_number(parser, 0, begin, end));
    }
    return fr_parser_operation(parser, op, left, right);
}

static uint32_t parse_binary(FrParser *parser, int lowest) {
    uint32_t left = parse_unary(parser);
    int last = LEVEL_NONE;
    for (;;) {
        FrOp op;
        int level = level_of(parser->lexer.token, &op);
        if (level == LEVEL_NONE || level < lowest) {
            return left;
        }
        if (level == LEVEL_COMPARISON && last == LEVEL_COMPARISON) {
            fr_parser_report(parser, "chained-comparison", parser->lexer.begin, parser->lexer.end,
                             "comparisons cannot be chained: write a < b && b < c");
        }
        last = level;
        fr_parser_next(parser);
        left = combine(parser, level, op, left, parse_binary(parser, level + 1));
    }
}

uint32_t fr_parse_condition(FrParser *parser) {
    if (is_too_deep(parser)) {
        return FR_NONE;
    }
    parser->nesting++;
    uint32_t node = parse_binary(parser, LEVEL_OR);
    if (fr_parser_accept(parser, FR_TOKEN_QUESTION)) {
        uint32_t yes = fr_parse_condition(parser);
        if (!fr_parser_accept(parser, FR_TOKEN_COLON)) {
            fr_parser_expected(parser, "the ':' of the condition");
        }
        node = fr_parser_condition(parser, node, yes, fr_parse_condition(parser));
    }
    parser->nesting--;
    return node;
}

FrTree *fr_tree_parse(const char *text, FrSpan span, const FrScope *scope,
                      const char *const *arguments, size_t count, FrDiags *diags) {
    size_t size = strlen(text);
    if (size > FR_EXPR_LONGEST) {
        fr_diags_add(diags, FR_ERROR, "expression-size", span,
                     "the expression has %zu characters; at most %d are allowed", size,
                     FR_EXPR_LONGEST);
        return NULL;
    }
    FrParser parser = {
        .lexer = {.text = text, .size = size, .span = span, .diags = diags},
        .tree = fr_tree_new(span),
        .scope = scope,
        .arguments = arguments,
        .argument_count = count,
    };
    fr_parser_next(&parser);
    parser.tree->root = fr_parse_condition(&parser);
    if (parser.lexer.token != FR_TOKEN_END) {
        fr_parser_expected(&parser, parser.lexer.token == FR_TOKEN_CLOSE
                                        ? "an opening parenthesis before"
                                        : "an operator");
    }
    if (parser.errors > 0 || parser.has_stopped || parser.lexer.has_failed) {
        fr_tree_free(parser.tree);
        return NULL;
    }
    return parser.tree;
}
