// Recursive descent from text to tree. Names are resolved here, so that every error of the text
// is found even in parts that are never evaluated.
#include "expr/builtin.h"
#include "expr/lexer.h"
#include "expr/tree.h"

#include <string.h>

// So many wrong names are reported before the rest of the text is given up.
#define MOST_ERRORS 20

typedef struct Parser {
    FrLexer lexer;
    FrTree *tree;
    const FrScope *scope;
    const char *const *arguments;
    size_t argument_count;
    unsigned nesting;
    unsigned errors;
    bool has_stopped; // a syntax error was met: nothing more is read or reported
} Parser;

static uint32_t parse_condition(Parser *parser);
static uint32_t parse_unary(Parser *parser);

// ---- errors -----------------------------------------------------------------------------------

static void report(Parser *parser, const char *code, size_t begin, size_t end, const char *format,
                   ...) FR_PRINTF(5, 6);

static void stop(Parser *parser) {
    parser->has_stopped = true;
    parser->lexer.token = FR_TOKEN_END;
}

static void report(Parser *parser, const char *code, size_t begin, size_t end, const char *format,
                   ...) {
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
static uint32_t expected(Parser *parser, const char *what) {
    FrLexer *lexer = &parser->lexer;
    int length = (int)MIN(lexer->end - lexer->begin, 40);
    if (lexer->token == FR_TOKEN_END) {
        report(parser, "syntax", lexer->begin, lexer->end, "the expression ends where %s should be",
               what);
    } else {
        report(parser, "syntax", lexer->begin, lexer->end, "here should be %s, not '%.*s'", what,
               length, lexer->text + lexer->begin);
    }
    stop(parser);
    return FR_NONE;
}

static void next(Parser *parser) {
    if (!parser->has_stopped && !parser->lexer.has_failed) {
        fr_lexer_next(&parser->lexer);
    }
}

static bool accept(Parser *parser, FrToken token) {
    if (parser->lexer.token != token) {
        return false;
    }
    next(parser);
    return true;
}

static bool is_too_deep(Parser *parser) {
    if (parser->nesting < FR_EXPR_NESTING) {
        return false;
    }
    report(parser, "expression-nesting", parser->lexer.begin, parser->lexer.end,
           "the expression is nested over %d deep", FR_EXPR_NESTING);
    stop(parser);
    return true;
}

// ---- making nodes -----------------------------------------------------------------------------

// A node may be FR_NONE after an error: then the text is read on only to find more errors.
static uint32_t add(Parser *parser, FrNodeKind kind, uint32_t index, size_t begin, size_t end) {
    return fr_tree_add(parser->tree, kind, index, begin, end);
}

static uint32_t number(Parser *parser, double value, size_t begin, size_t end) {
    uint32_t node = add(parser, FR_NODE_NUMBER, 0, begin, end);
    fr_tree_node(parser->tree, node)->number = value;
    return node;
}

static void adopt(Parser *parser, uint32_t node, uint32_t child) {
    if (node == FR_NONE || child == FR_NONE) {
        return;
    }
    fr_tree_adopt(parser->tree, node, child);
    const FrNode *parent = fr_tree_node(parser->tree, node);
    if (parent->depth > FR_EXPR_DEPTH) {
        report(parser, "expression-nesting", parent->begin, parent->end,
               "the expression has over %d operations in a row", FR_EXPR_DEPTH);
        stop(parser);
    }
}

static uint32_t operation(Parser *parser, FrOp op, uint32_t left, uint32_t right) {
    if (left == FR_NONE || right == FR_NONE) {
        return FR_NONE;
    }
    uint32_t node = add(parser, FR_NODE_OPERATION, op, fr_tree_node(parser->tree, left)->begin,
                        fr_tree_node(parser->tree, right)->end);
    adopt(parser, node, left);
    adopt(parser, node, right);
    return node;
}

static uint32_t condition(Parser *parser, uint32_t test, uint32_t yes, uint32_t no) {
    if (test == FR_NONE || yes == FR_NONE || no == FR_NONE) {
        return FR_NONE;
    }
    uint32_t node = add(parser, FR_NODE_CONDITION, 0, fr_tree_node(parser->tree, test)->begin,
                        fr_tree_node(parser->tree, no)->end);
    adopt(parser, node, test);
    adopt(parser, node, yes);
    adopt(parser, node, no);
    return node;
}

static uint32_t truth(Parser *parser, uint32_t child) {
    if (child == FR_NONE) {
        return FR_NONE;
    }
    const FrNode *inner = fr_tree_node(parser->tree, child);
    uint32_t node = add(parser, FR_NODE_TRUTH, 0, inner->begin, inner->end);
    adopt(parser, node, child);
    return node;
}

// ---- names ------------------------------------------------------------------------------------

static const struct {
    const char *name;
    FrVar id;
} variables[] = {
#define ROW(name, meaning) {#name, FR_VAR_##name},
    FR_VARS(ROW)
#undef ROW
        {"u", FR_VAR_x}, // the place on the parent, as textbooks of surfaces call it
};

static const char *const constants[] = {"pi", "e", "phi"};

bool fr_variable_find(const char *name, FrVar *variable) {
    for (size_t i = 0; i < G_N_ELEMENTS(variables); i++) {
        if (strcmp(variables[i].name, name) == 0) {
            *variable = variables[i].id;
            return true;
        }
    }
    return false;
}

static void report_unknown(Parser *parser, const char *code, const char *kind, const char *name,
                           GPtrArray *names, size_t begin, size_t end) {
    const char *near = fr_nearest_name(name, (const char *const *)names->pdata, names->len);
    if (near != NULL) {
        report(parser, code, begin, end, "there is no %s '%s'; did you mean '%s'?", kind, name,
               near);
    } else {
        report(parser, code, begin, end, "there is no %s '%s'", kind, name);
    }
    g_ptr_array_unref(names);
}

static void report_unknown_value(Parser *parser, const char *name, size_t begin, size_t end) {
    if (fr_builtin_find(name) != FR_NONE || fr_scope_function(parser->scope, name) != NULL) {
        report(parser, "unknown-name", begin, end, "'%s' is a function: write %s(…)", name, name);
        return;
    }
    GPtrArray *names = g_ptr_array_new();
    for (size_t i = 0; i < parser->argument_count; i++) {
        g_ptr_array_add(names, (char *)parser->arguments[i]);
    }
    for (size_t i = 0; i < G_N_ELEMENTS(variables); i++) {
        g_ptr_array_add(names, (char *)variables[i].name);
    }
    for (size_t i = 0; i < G_N_ELEMENTS(constants); i++) {
        g_ptr_array_add(names, (char *)constants[i]);
    }
    report_unknown(parser, "unknown-name", "variable", name, names, begin, end);
}

static uint32_t resolve_value(Parser *parser, const char *name, size_t begin, size_t end) {
    // Own names first: a production may call its parameters x, t or n.
    for (size_t i = 0; i < parser->argument_count; i++) {
        if (strcmp(parser->arguments[i], name) == 0) {
            return add(parser, FR_NODE_ARGUMENT, (uint32_t)i, begin, end);
        }
    }
    FrVar variable;
    if (fr_variable_find(name, &variable)) {
        return add(parser, FR_NODE_VARIABLE, variable, begin, end);
    }
    double value;
    if (fr_builtin_constant(name, &value)) {
        return number(parser, value, begin, end);
    }
    report_unknown_value(parser, name, begin, end);
    return FR_NONE;
}

// ---- calls ------------------------------------------------------------------------------------

typedef struct Call {
    char *name;
    size_t begin, name_end, end;
    uint32_t arguments[FR_MOST_ARGUMENTS];
    uint32_t count; // may exceed the arguments kept
} Call;

// The arguments up to and with the closing parenthesis; the opening one has been read.
static void parse_arguments(Parser *parser, Call *call) {
    if (parser->lexer.token != FR_TOKEN_CLOSE) {
        do {
            uint32_t argument = parse_condition(parser);
            if (call->count < FR_MOST_ARGUMENTS) {
                call->arguments[call->count] = argument;
            }
            call->count++;
        } while (accept(parser, FR_TOKEN_COMMA));
    }
    call->end = parser->lexer.end;
    if (!accept(parser, FR_TOKEN_CLOSE)) {
        expected(parser, "a closing parenthesis or a comma");
    }
}

static bool check_count(Parser *parser, const Call *call, uint32_t fewest, uint32_t most) {
    if (call->count >= fewest && call->count <= most) {
        return true;
    }
    char *wanted =
        fewest == most ? g_strdup_printf("%u", fewest) : g_strdup_printf("%u to %u", fewest, most);
    report(parser, "argument-count", call->begin, call->end, "%s() takes %s argument%s, not %u",
           call->name, wanted, most == 1 ? "" : "s", call->count);
    g_free(wanted);
    return false;
}

static uint32_t finish_call(Parser *parser, const Call *call, FrNodeKind kind, uint32_t index) {
    uint32_t node = add(parser, kind, index, call->begin, call->end);
    for (uint32_t i = 0; i < call->count; i++) {
        if (call->arguments[i] == FR_NONE) {
            return FR_NONE;
        }
        adopt(parser, node, call->arguments[i]);
    }
    return node;
}

static uint32_t finish_curve(Parser *parser, const Call *call, FrCurve *curve) {
    g_ptr_array_add(parser->tree->curves, curve);
    return finish_call(parser, call, FR_NODE_CURVE, parser->tree->curves->len - 1);
}

static uint32_t call_builtin(Parser *parser, const Call *call, uint32_t index) {
    const FrBuiltin *builtin = &fr_builtins[index];
    if (!check_count(parser, call, builtin->fewest, builtin->most)) {
        return FR_NONE;
    }
    const uint32_t *argument = call->arguments;
    uint32_t node = FR_NONE;
    switch (builtin->kind) {
    case FR_BUILTIN_POWER:
    case FR_BUILTIN_REMAINDER:
        node = operation(parser, builtin->kind == FR_BUILTIN_POWER ? FR_OP_POWER : FR_OP_REMAINDER,
                         argument[0], argument[1]);
        break;
    case FR_BUILTIN_SELECT:
        node = condition(parser, argument[0], argument[1], argument[2]);
        break;
    default:
        return finish_call(parser, call, FR_NODE_BUILTIN, index);
    }
    if (node != FR_NONE) {
        fr_tree_node(parser->tree, node)->begin = (uint32_t)call->begin;
        fr_tree_node(parser->tree, node)->end = (uint32_t)call->end;
    }
    return node;
}

// curve("name", x): the name has been found wanting in no other place, so it is read here.
static uint32_t parse_curve(Parser *parser, Call *call) {
    FrLexer *lexer = &parser->lexer;
    if (lexer->token != FR_TOKEN_STRING) {
        return expected(parser, "the name of a curve in quotation marks");
    }
    size_t begin = lexer->begin, end = lexer->end;
    char *name = g_strndup(lexer->text + begin + 1, end - begin - 2);
    FrCurve *curve = fr_scope_find_curve(parser->scope, name);
    next(parser);
    if (curve == NULL) {
        GPtrArray *names = g_ptr_array_new();
        fr_scope_list_curves(parser->scope, names);
        report_unknown(parser, "unknown-curve", "curve", name, names, begin, end);
    }
    g_free(name);
    if (accept(parser, FR_TOKEN_COMMA)) {
        parse_arguments(parser, call);
    } else {
        expected(parser, "a comma and the place on the curve");
    }
    call->count++;
    bool is_good = curve != NULL && check_count(parser, call, 2, 2);
    call->count--;
    if (!is_good) {
        fr_curve_unref(curve);
        return FR_NONE;
    }
    return finish_curve(parser, call, curve);
}

static uint32_t call_function(Parser *parser, const Call *call, const FrFunction *function) {
    if (!check_count(parser, call, function->count, function->count)) {
        return FR_NONE;
    }
    g_ptr_array_add(parser->tree->functions, (void *)function);
    return finish_call(parser, call, FR_NODE_FUNCTION, parser->tree->functions->len - 1);
}

// The call of `call->name`; the opening parenthesis has been read.
static uint32_t parse_call(Parser *parser, Call *call) {
    uint32_t builtin = fr_builtin_find(call->name);
    if (builtin != FR_NONE && fr_builtins[builtin].kind == FR_BUILTIN_CURVE) {
        return parse_curve(parser, call);
    }
    parse_arguments(parser, call);
    if (parser->has_stopped || parser->lexer.has_failed) {
        return FR_NONE;
    }
    if (builtin != FR_NONE) {
        return call_builtin(parser, call, builtin);
    }
    const FrFunction *function = fr_scope_function(parser->scope, call->name);
    if (function != NULL) {
        return call_function(parser, call, function);
    }
    FrCurve *curve = fr_scope_find_curve(parser->scope, call->name);
    if (curve == NULL) {
        GPtrArray *names = g_ptr_array_new();
        fr_scope_list_functions(parser->scope, names);
        fr_scope_list_curves(parser->scope, names);
        report_unknown(parser, "unknown-function", "function or curve", call->name, names,
                       call->begin, call->name_end);
        return FR_NONE;
    }
    if (!check_count(parser, call, 1, 1)) {
        fr_curve_unref(curve);
        return FR_NONE;
    }
    return finish_curve(parser, call, curve);
}

// ---- the grammar ------------------------------------------------------------------------------

static uint32_t parse_name(Parser *parser) {
    FrLexer *lexer = &parser->lexer;
    Call call = {.begin = lexer->begin, .name_end = lexer->end};
    call.name = g_strndup(lexer->text + call.begin, call.name_end - call.begin);
    next(parser);
    uint32_t node = accept(parser, FR_TOKEN_OPEN)
                        ? parse_call(parser, &call)
                        : resolve_value(parser, call.name, call.begin, call.name_end);
    g_free(call.name);
    return node;
}

static uint32_t parse_primary(Parser *parser) {
    FrLexer *lexer = &parser->lexer;
    size_t begin = lexer->begin;
    uint32_t node;
    switch (lexer->token) {
    case FR_TOKEN_NUMBER:
        node = number(parser, lexer->number, begin, lexer->end);
        next(parser);
        return node;
    case FR_TOKEN_NAME:
        return parse_name(parser);
    case FR_TOKEN_OPEN:
        next(parser);
        node = parse_condition(parser);
        if (node != FR_NONE) {
            fr_tree_node(parser->tree, node)->begin = (uint32_t)begin;
            fr_tree_node(parser->tree, node)->end = (uint32_t)lexer->end;
        }
        if (!accept(parser, FR_TOKEN_CLOSE)) {
            return expected(parser, "a closing parenthesis");
        }
        return node;
    default:
        return expected(parser, "a number, a name or a parenthesis");
    }
}

// -x^2 is -(x^2), 2^-x is 2^(-x), 2^3^2 is 2^(3^2).
static uint32_t parse_unary(Parser *parser) {
    if (is_too_deep(parser)) {
        return FR_NONE;
    }
    parser->nesting++;
    FrToken sign = parser->lexer.token;
    size_t begin = parser->lexer.begin;
    uint32_t node;
    if (sign == FR_TOKEN_MINUS || sign == FR_TOKEN_NOT) {
        next(parser);
        uint32_t child = parse_unary(parser);
        node = FR_NONE;
        if (child != FR_NONE) {
            size_t end = fr_tree_node(parser->tree, child)->end;
            FrOp op = sign == FR_TOKEN_MINUS ? FR_OP_NEGATE : FR_OP_NOT;
            node = add(parser, FR_NODE_OPERATION, op, begin, end);
            adopt(parser, node, child);
        }
    } else if (accept(parser, FR_TOKEN_PLUS)) {
        node = parse_unary(parser);
    } else {
        node = parse_primary(parser);
        if (accept(parser, FR_TOKEN_POWER)) {
            node = operation(parser, FR_OP_POWER, node, parse_unary(parser));
        }
    }
    parser->nesting--;
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

// `a and b` is `a ? truth(b) : 0`: what a decides, b is not asked.
static uint32_t combine(Parser *parser, int level, FrOp op, uint32_t left, uint32_t right) {
    if (left == FR_NONE || right == FR_NONE) {
        return FR_NONE;
    }
    size_t begin = fr_tree_node(parser->tree, left)->begin;
    size_t end = fr_tree_node(parser->tree, right)->end;
    if (level == LEVEL_OR) {
        return condition(parser, left, number(parser, 1, begin, end), truth(parser, right));
    }
    if (level == LEVEL_AND) {
        return condition(parser, left, truth(parser, right), number(parser, 0, begin, end));
    }
    return operation(parser, op, left, right);
}

static uint32_t parse_binary(Parser *parser, int lowest) {
    uint32_t left = parse_unary(parser);
    int last = LEVEL_NONE;
    for (;;) {
        FrOp op;
        int level = level_of(parser->lexer.token, &op);
        if (level == LEVEL_NONE || level < lowest) {
            return left;
        }
        if (level == LEVEL_COMPARISON && last == LEVEL_COMPARISON) {
            report(parser, "chained-comparison", parser->lexer.begin, parser->lexer.end,
                   "comparisons cannot be chained: write a < b && b < c");
        }
        last = level;
        next(parser);
        left = combine(parser, level, op, left, parse_binary(parser, level + 1));
    }
}

static uint32_t parse_condition(Parser *parser) {
    if (is_too_deep(parser)) {
        return FR_NONE;
    }
    parser->nesting++;
    uint32_t node = parse_binary(parser, LEVEL_OR);
    if (accept(parser, FR_TOKEN_QUESTION)) {
        uint32_t yes = parse_condition(parser);
        if (!accept(parser, FR_TOKEN_COLON)) {
            expected(parser, "the ':' of the condition");
        }
        node = condition(parser, node, yes, parse_condition(parser));
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
    Parser parser = {
        .lexer = {.text = text, .size = size, .span = span, .diags = diags},
        .tree = fr_tree_new(span),
        .scope = scope,
        .arguments = arguments,
        .argument_count = count,
    };
    next(&parser);
    parser.tree->root = parse_condition(&parser);
    if (parser.lexer.token != FR_TOKEN_END) {
        expected(&parser, parser.lexer.token == FR_TOKEN_CLOSE ? "an opening parenthesis before"
                                                               : "an operator");
    }
    if (parser.errors > 0 || parser.has_stopped || parser.lexer.has_failed) {
        fr_tree_free(parser.tree);
        return NULL;
    }
    return parser.tree;
}
