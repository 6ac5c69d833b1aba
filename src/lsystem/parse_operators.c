// Operators in the order of cpfg:
// ?:  ||  &&  == != <>  < <= > >=  + -  * / %  ^ (to the left)  unary -  !
#include "lsystem/parse.h"

#include <string.h>

#define DEEPEST 100

typedef struct Operator {
    const char *text;
    int level;
    FrLop op;
} Operator;

static const Operator binary[] = {
    {"==", 3, FR_LOP_EQUAL},         {"!=", 3, FR_LOP_UNEQUAL},
    {"<>", 3, FR_LOP_UNEQUAL},       {"<=", 4, FR_LOP_LESS_EQUAL},
    {">=", 4, FR_LOP_GREATER_EQUAL}, {"<", 4, FR_LOP_LESS},
    {">", 4, FR_LOP_GREATER},        {"+", 5, FR_LOP_ADD},
    {"-", 5, FR_LOP_SUBTRACT},       {"*", 6, FR_LOP_MULTIPLY},
    {"/", 6, FR_LOP_DIVIDE},         {"%", 6, FR_LOP_MODULO},
    {"^", 7, FR_LOP_POWER},
};

static const Operator *next_operator(FrLparser *parser) {
    fr_lparse_peek_value(parser);
    const char *here = parser->bytes + parser->at;
    if (here[0] == '-' && (here[1] == '>' || (here[1] != '\0' && here[2] == '>'))) {
        bool is_arrow =
            here[1] == '-' || here[1] == 'o' || (here[1] == '>' && parser->system->is_paper);
        if (is_arrow) {
            return NULL;
        }
    }
    for (size_t i = 0; i < G_N_ELEMENTS(binary); i++) {
        if (g_str_has_prefix(here, binary[i].text)) {
            return &binary[i];
        }
    }
    return NULL;
}

static void read_binary(FrLparser *parser, int level) {
    fr_lparse_unary(parser);
    while (!parser->has_failed) {
        const Operator *operator= next_operator(parser);
        if (operator== NULL || operator->level <= level) {
            return;
        }
        size_t begin = parser->at;
        parser->at += strlen(operator->text);
        read_binary(parser, operator->level);
        parser->is_leaf = false;
        fr_lparse_emit(parser, operator->op, 0, 0, 0, begin);
    }
}

// As cpfg does it: behind a number or a name both sides are computed, which matters where the right
// one draws a random number; behind anything else the right side is only run where it decides.
static void read_and(FrLparser *parser) {
    read_binary(parser, 2);
    while (!parser->has_failed && fr_lparse_accept(parser, "&&")) {
        bool runs_both = parser->is_leaf;
        uint32_t skip = fr_lparse_code_here(parser);
        if (runs_both) {
            parser->barrier = skip;
            read_binary(parser, 2);
            fr_lparse_emit(parser, FR_LOP_AND, 0, 0, 0, parser->at);
            parser->is_leaf = false;
            continue;
        }
        fr_lparse_emit(parser, FR_LOP_JUMP_ZERO, 0, 0, 0, parser->at);
        read_binary(parser, 2);
        fr_lparse_emit(parser, FR_LOP_TRUTH, 0, 0, 0, parser->at);
        uint32_t end = fr_lparse_code_here(parser);
        fr_lparse_emit(parser, FR_LOP_JUMP, 0, 0, 0, parser->at);
        fr_lparse_land(parser, skip);
        parser->stack--;
        fr_lparse_emit(parser, FR_LOP_CONST, 0, 0, 0, parser->at);
        fr_lparse_land(parser, end);
        parser->is_leaf = false;
    }
}

// What is skipped leaves the left side's value as it is, else the value is 0 or 1; and cpfg tells
// whether to skip by that value as a byte.
static void read_or(FrLparser *parser) {
    read_and(parser);
    while (!parser->has_failed && fr_lparse_accept(parser, "||")) {
        bool runs_both = parser->is_leaf;
        uint32_t skip = fr_lparse_code_here(parser);
        parser->barrier = skip;
        if (!runs_both) {
            fr_lparse_emit(parser, FR_LOP_JUMP_TRUE, 0, 0, 0, parser->at);
        }
        read_and(parser);
        fr_lparse_emit(parser, FR_LOP_OR, 0, 0, 0, parser->at);
        if (!runs_both) {
            fr_lparse_land(parser, skip);
        }
        parser->is_leaf = false;
    }
}

void fr_lparse_expression(FrLparser *parser) {
    if (++parser->depth > DEEPEST) {
        fr_lparse_error(parser, parser->at, parser->at + 1, "too-deep",
                        "expressions are nested too deeply");
    } else {
        read_or(parser);
    }
    if (!parser->has_failed && fr_lparse_accept(parser, "?")) {
        uint32_t skip = fr_lparse_code_here(parser);
        fr_lparse_emit(parser, FR_LOP_JUMP_ZERO, 0, 0, 0, parser->at);
        fr_lparse_expression(parser);
        uint32_t end = fr_lparse_code_here(parser);
        fr_lparse_emit(parser, FR_LOP_JUMP, 0, 0, 0, parser->at);
        fr_lparse_land(parser, skip);
        parser->stack--;
        fr_lparse_expect(parser, ":");
        fr_lparse_expression(parser);
        fr_lparse_land(parser, end);
        parser->is_leaf = false;
    }
    parser->depth--;
}

uint32_t fr_lparse_value(FrLparser *parser) {
    uint32_t begin = fr_lparse_code_here(parser);
    parser->barrier = begin;
    parser->stack = 0;
    fr_lparse_expression(parser);
    fr_lparse_emit(parser, FR_LOP_END, 0, 0, 0, parser->at);
    return begin;
}
