// What names mean. They are resolved while the text is read, so that every error is found even in
// parts that are never evaluated.
#include "expr/parser.h"

#include "expr/builtin.h"

#include <string.h>

// ---- values ------------------------------------------------------------------------------------

static const struct {
    const char *name;
    FrVar id;
} variables[] = {
#define ROW(name, meaning) {#name, FR_VAR_##name},
    FR_VARS(ROW)
#undef ROW
        {"u", FR_VAR_x}, // the place on the parent, as textbooks of surfaces call it
    {"r", FR_VAR_depth}, // recursion
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

static void report_unknown(FrParser *parser, const char *code, const char *kind, const char *name,
                           GPtrArray *names, size_t begin, size_t end) {
    const char *near = fr_nearest_name(name, (const char *const *)names->pdata, names->len);
    if (near != NULL) {
        fr_parser_report(parser, code, begin, end, "there is no %s '%s'; did you mean '%s'?", kind,
                         name, near);
    } else {
        fr_parser_report(parser, code, begin, end, "there is no %s '%s'", kind, name);
    }
    g_ptr_array_unref(names);
}

static void report_unknown_value(FrParser *parser, const char *name, size_t begin, size_t end) {
    if (fr_builtin_find(name) != FR_NONE || fr_scope_function(parser->scope, name) != NULL) {
        fr_parser_report(parser, "unknown-name", begin, end, "'%s' is a function: write %s(…)",
                         name, name);
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
    fr_scope_list_values(parser->scope, names);
    report_unknown(parser, "unknown-name", "variable", name, names, begin, end);
}

static uint32_t place_number(FrParser *parser, size_t begin, size_t end);

static uint32_t resolve_value(FrParser *parser, const char *name, size_t begin, size_t end) {
    // Own names first: a production may call its parameters x, t or n.
    for (size_t i = 0; i < parser->argument_count; i++) {
        if (strcmp(parser->arguments[i], name) == 0) {
            return fr_parser_add(parser, FR_NODE_ARGUMENT, (uint32_t)i, begin, end);
        }
    }
    FrVar variable;
    if (fr_variable_find(name, &variable)) {
        return fr_parser_add(parser, FR_NODE_VARIABLE, variable, begin, end);
    }
    if (strcmp(name, "rnd") == 0) {
        return place_number(parser, begin, end);
    }
    double value;
    if (fr_builtin_constant(name, &value) || fr_scope_value(parser->scope, name, &value)) {
        return fr_parser_number(parser, value, begin, end);
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
static void parse_arguments(FrParser *parser, Call *call) {
    if (parser->lexer.token != FR_TOKEN_CLOSE) {
        do {
            uint32_t argument = fr_parse_condition(parser);
            if (call->count < FR_MOST_ARGUMENTS) {
                call->arguments[call->count] = argument;
            }
            call->count++;
        } while (fr_parser_accept(parser, FR_TOKEN_COMMA));
    }
    call->end = parser->lexer.end;
    if (!fr_parser_accept(parser, FR_TOKEN_CLOSE)) {
        fr_parser_expected(parser, "a closing parenthesis or a comma");
    }
}

static bool check_count(FrParser *parser, const Call *call, uint32_t fewest, uint32_t most) {
    if (call->count >= fewest && call->count <= most) {
        return true;
    }
    char *wanted =
        fewest == most ? g_strdup_printf("%u", fewest) : g_strdup_printf("%u to %u", fewest, most);
    fr_parser_report(parser, "argument-count", call->begin, call->end,
                     "%s() takes %s argument%s, not %u", call->name, wanted, most == 1 ? "" : "s",
                     call->count);
    g_free(wanted);
    return false;
}

static uint32_t finish_call(FrParser *parser, const Call *call, FrNodeKind kind, uint32_t index) {
    uint32_t node = fr_parser_add(parser, kind, index, call->begin, call->end);
    for (uint32_t i = 0; i < call->count; i++) {
        if (call->arguments[i] == FR_NONE) {
            return FR_NONE;
        }
        fr_parser_adopt(parser, node, call->arguments[i]);
    }
    return node;
}

// `rnd` alone is the random number 0 of its place.
static uint32_t place_number(FrParser *parser, size_t begin, size_t end) {
    Call call = {.begin = begin, .name_end = end, .end = end, .count = 1};
    call.arguments[0] = fr_parser_number(parser, 0, begin, end);
    return finish_call(parser, &call, FR_NODE_BUILTIN, fr_builtin_find("rnd"));
}

static uint32_t finish_curve(FrParser *parser, const Call *call, FrCurve *curve) {
    g_ptr_array_add(parser->tree->curves, curve);
    return finish_call(parser, call, FR_NODE_CURVE, parser->tree->curves->len - 1);
}

static uint32_t call_builtin(FrParser *parser, const Call *call, uint32_t index) {
    const FrBuiltin *builtin = &fr_builtins[index];
    if (!check_count(parser, call, builtin->fewest, builtin->most)) {
        return FR_NONE;
    }
    const uint32_t *argument = call->arguments;
    uint32_t node = FR_NONE;
    switch (builtin->kind) {
    case FR_BUILTIN_POWER:
    case FR_BUILTIN_REMAINDER:
        node = fr_parser_operation(
            parser, builtin->kind == FR_BUILTIN_POWER ? FR_OP_POWER : FR_OP_REMAINDER, argument[0],
            argument[1]);
        break;
    case FR_BUILTIN_SELECT:
        node = fr_parser_condition(parser, argument[0], argument[1], argument[2]);
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
static uint32_t parse_curve(FrParser *parser, Call *call) {
    FrLexer *lexer = &parser->lexer;
    if (lexer->token != FR_TOKEN_STRING) {
        return fr_parser_expected(parser, "the name of a curve in quotation marks");
    }
    size_t begin = lexer->begin, end = lexer->end;
    char *name = g_strndup(lexer->text + begin + 1, end - begin - 2);
    FrCurve *curve = fr_scope_find_curve(parser->scope, name);
    fr_parser_next(parser);
    if (curve == NULL) {
        GPtrArray *names = g_ptr_array_new();
        fr_scope_list_curves(parser->scope, names);
        report_unknown(parser, "unknown-curve", "curve", name, names, begin, end);
    }
    g_free(name);
    if (fr_parser_accept(parser, FR_TOKEN_COMMA)) {
        parse_arguments(parser, call);
    } else {
        fr_parser_expected(parser, "a comma and the place on the curve");
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

static uint32_t call_function(FrParser *parser, const Call *call, const FrFunction *function) {
    if (!check_count(parser, call, function->count, function->count)) {
        return FR_NONE;
    }
    g_ptr_array_add(parser->tree->functions, (void *)function);
    return finish_call(parser, call, FR_NODE_FUNCTION, parser->tree->functions->len - 1);
}

// The call of `call->name`; the opening parenthesis has been read.
static uint32_t parse_call(FrParser *parser, Call *call) {
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

uint32_t fr_parse_name(FrParser *parser) {
    FrLexer *lexer = &parser->lexer;
    Call call = {.begin = lexer->begin, .name_end = lexer->end};
    call.name = g_strndup(lexer->text + call.begin, call.name_end - call.begin);
    fr_parser_next(parser);
    uint32_t node = fr_parser_accept(parser, FR_TOKEN_OPEN)
                        ? parse_call(parser, &call)
                        : resolve_value(parser, call.name, call.begin, call.name_end);
    g_free(call.name);
    return node;
}
