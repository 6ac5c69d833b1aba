// Expressions, compiled while they are read: what operators join, and the code that comes of it.
#include "lsystem/parse.h"

#include "lsystem/vm.h"

#include <string.h>

#define DEEPEST 100
#define MOST_ARGUMENTS 32

static FrLcode *last_code(const FrLparser *parser, size_t back) {
    GArray *code = parser->system->code;
    return code->len < parser->barrier + back ? NULL
                                              : &g_array_index(code, FrLcode, code->len - back);
}

uint32_t fr_lparse_code_here(const FrLparser *parser) {
    return parser->system->code->len;
}

static void append(FrLparser *parser, FrLop op, uint32_t a, uint32_t n, double value, size_t at) {
    FrLcode code = {(uint16_t)op, (uint16_t)n, a, value};
    uint32_t place = (uint32_t)at;
    g_array_append_val(parser->system->code, code);
    g_array_append_val(parser->system->places, place);
}

static void drop_code(FrLparser *parser, guint count) {
    g_array_set_size(parser->system->code, parser->system->code->len - count);
    g_array_set_size(parser->system->places, parser->system->places->len - count);
}

// Constants are computed here and now. True if nothing is left to emit.
static bool fold(FrLparser *parser, FrLop op, size_t at) {
    FrLcode *b = last_code(parser, 1), *a = last_code(parser, 2);
    if (b == NULL) {
        return false;
    }
    if (op == FR_LOP_NEGATE && b->op == FR_LOP_CONST) {
        b->value = -b->value;
        return true;
    }
    if (op < FR_LOP_ADD || op > FR_LOP_UNEQUAL) {
        return false;
    }
    bool is_fault = false;
    if (a != NULL && a->op == FR_LOP_CONST && b->op == FR_LOP_CONST) {
        double value = fr_lmachine_binary(op, a->value, b->value, &is_fault);
        if (!is_fault) {
            drop_code(parser, 2);
            append(parser, FR_LOP_CONST, 0, 0, value, at);
            return true;
        }
        return false;
    }
    if (op == FR_LOP_MULTIPLY && (b->op == FR_LOP_CONST || b->op == FR_LOP_VAR)) {
        b->op = b->op == FR_LOP_CONST ? FR_LOP_CONST_MULTIPLY : FR_LOP_VAR_MULTIPLY;
        return true;
    }
    return false;
}

static int stack_effect(FrLop op, uint32_t n) {
    switch (op) {
    case FR_LOP_CONST:
    case FR_LOP_VAR:
        return 1;
    case FR_LOP_INDEX:
    case FR_LOP_CALL:
    case FR_LOP_PRINT:
    case FR_LOP_USER:
        return 1 - (int)n;
    case FR_LOP_INDEX_STORE:
        return -1 - (int)n;
    case FR_LOP_JUMP_TRUE:
        return 0;
    case FR_LOP_SCAN_END:
        return 1;
    case FR_LOP_SCAN_BEGIN:
    case FR_LOP_STORE:
    case FR_LOP_DROP:
    case FR_LOP_JUMP_ZERO:
    case FR_LOP_PUT:
        return -1;
    default:
        return op >= FR_LOP_ADD && op <= FR_LOP_UNEQUAL ? -1 : 0;
    }
}

void fr_lparse_emit(FrLparser *parser, FrLop op, uint32_t a, uint32_t n, double value, size_t at) {
    parser->stack += stack_effect(op, n);
    if (parser->stack >= FR_LSTACK - 2) {
        fr_lparse_error(parser, at, at + 1, "too-deep", "this expression holds too many values");
        parser->stack = 0;
    }
    if (!fold(parser, op, at)) {
        append(parser, op, a, n, value, at);
    }
    if (op == FR_LOP_JUMP || op == FR_LOP_JUMP_ZERO || op == FR_LOP_JUMP_TRUE) {
        parser->barrier = parser->system->code->len;
    }
}

void fr_lparse_land(FrLparser *parser, uint32_t jump) {
    g_array_index(parser->system->code, FrLcode, jump).a = parser->system->code->len;
    parser->barrier = parser->system->code->len;
}

uint32_t fr_lparse_new_variable(FrLparser *parser, uint64_t count, size_t at) {
    uint64_t wanted = fr_count_add(parser->unit->variables, count);
    if (wanted > 16000000) {
        fr_lparse_error(parser, at, at + 1, "limit-variables",
                        "this needs %" G_GUINT64_FORMAT " variables; 16000000 are allowed", wanted);
        return FR_LVAR_FIRST;
    }
    uint32_t variable = parser->unit->variables;
    parser->unit->variables = (uint32_t)wanted;
    return variable;
}

static uint32_t find_variable(FrLparser *parser, const char *name) {
    gpointer found = parser->locals == NULL ? NULL : g_hash_table_lookup(parser->locals, name);
    if (found == NULL) {
        found = g_hash_table_lookup(parser->unit->globals, name);
    }
    uint32_t variable = found == NULL ? FR_NONE : GPOINTER_TO_UINT(found) - 1;
    if (variable >= FR_LVAR_FIRST && variable - FR_LVAR_FIRST < parser->value_count) {
        parser->is_used[variable - FR_LVAR_FIRST] = true;
    }
    return variable;
}

uint32_t fr_lparse_variable(FrLparser *parser, const char *name, bool is_assigned, size_t at) {
    uint32_t variable = find_variable(parser, name);
    if (variable != FR_NONE) {
        return variable;
    }
    if (!is_assigned) {
        fr_lparse_warning(parser, at, at + strlen(name), "unknown-name",
                          "nothing is called '%s' here; it is 0", name);
    }
    variable = fr_lparse_new_variable(parser, 1, at);
    GHashTable *table = parser->locals != NULL ? parser->locals : parser->unit->globals;
    g_hash_table_insert(table, g_strdup(name), GUINT_TO_POINTER(variable + 1));
    return variable;
}

uint32_t fr_lparse_find_array(FrLparser *parser, const char *name) {
    char *key = g_strconcat(name, "[]", NULL);
    gpointer found = g_hash_table_lookup(parser->unit->globals, key);
    g_free(key);
    return found == NULL ? FR_NONE : GPOINTER_TO_UINT(found) - 1;
}

uint32_t fr_lparse_string(FrLparser *parser) {
    if (fr_lparse_peek(parser) != '"') {
        return FR_NONE;
    }
    GString *text = g_string_new(NULL);
    size_t begin = parser->at++;
    while (parser->at < parser->size && parser->bytes[parser->at] != '"' &&
           parser->bytes[parser->at] != '\n') {
        char c = parser->bytes[parser->at++];
        if (c == '\\' && parser->at < parser->size) {
            c = parser->bytes[parser->at++];
            c = c == 'n' ? '\n' : c == 't' ? '\t' : c == 'r' ? '\r' : c;
        }
        g_string_append_c(text, c);
    }
    if (parser->at >= parser->size || parser->bytes[parser->at] != '"') {
        fr_lparse_error(parser, begin, parser->at, "syntax", "this text has no closing quote");
    } else {
        parser->at++;
    }
    g_ptr_array_add(parser->system->strings, g_string_free(text, FALSE));
    return parser->system->strings->len - 1;
}

/// Arguments up to the closing bracket, which is taken; returns how many.
static uint32_t read_arguments(FrLparser *parser) {
    uint32_t count = 0;
    if (fr_lparse_accept(parser, ")")) {
        return 0;
    }
    do {
        uint32_t text = fr_lparse_string(parser);
        if (text != FR_NONE) {
            fr_lparse_emit(parser, FR_LOP_CONST, 0, 0, text, parser->at);
        } else {
            fr_lparse_expression(parser);
        }
        count++;
    } while (!parser->has_failed && count < MOST_ARGUMENTS && fr_lparse_accept(parser, ","));
    fr_lparse_expect(parser, ")");
    return count;
}

uint32_t fr_lparse_indices(FrLparser *parser, uint32_t array, size_t begin) {
    uint32_t count = 0;
    while (!parser->has_failed && fr_lparse_accept(parser, "[")) {
        fr_lparse_expression(parser);
        fr_lparse_expect(parser, "]");
        count++;
    }
    uint32_t wanted = g_array_index(parser->system->arrays, FrLarray, array).dimension_count;
    if (count != wanted) {
        fr_lparse_error(parser, begin, parser->at, "argument-count",
                        "this array has %u dimensions, here are %u", wanted, count);
    }
    return count;
}

static void read_index(FrLparser *parser, uint32_t array, size_t begin) {
    uint32_t count = fr_lparse_indices(parser, array, begin);
    fr_lparse_emit(parser, FR_LOP_INDEX, array, count, 0, begin);
}

/// A variable that fscanf() fills: it keeps its value where the file has no number.
static void read_target(FrLparser *parser) {
    fr_lparse_accept(parser, "&");
    fr_lparse_blanks(parser);
    size_t begin = parser->at;
    char *name = fr_lparse_name(parser);
    if (name == NULL) {
        fr_lparse_error(parser, begin, begin + 1, "syntax", "'&' and a variable are wanted here");
        return;
    }
    uint32_t array = fr_lparse_find_array(parser, name);
    if (array == FR_NONE) {
        uint32_t variable = fr_lparse_variable(parser, name, true, begin);
        fr_lparse_emit(parser, FR_LOP_VAR, variable, 0, 0, begin);
        fr_lparse_emit(parser, FR_LOP_SCAN_NEXT, 0, 0, 0, begin);
        fr_lparse_emit(parser, FR_LOP_STORE, variable, 0, 0, begin);
    } else {
        // Its indices once to store, once for the value it has.
        size_t indices = parser->at;
        uint32_t count = fr_lparse_indices(parser, array, begin);
        parser->at = indices;
        read_index(parser, array, begin);
        fr_lparse_emit(parser, FR_LOP_SCAN_NEXT, 0, 0, 0, begin);
        fr_lparse_emit(parser, FR_LOP_INDEX_STORE, array, count, 0, begin);
    }
    g_free(name);
}

/// fscanf(file, "format", &variable, …) behind its bracket.
static void read_scan(FrLparser *parser, size_t begin) {
    fr_lparse_expression(parser);
    fr_lparse_expect(parser, ",");
    uint32_t text = parser->has_failed ? FR_NONE : fr_lparse_string(parser);
    if (text == FR_NONE) {
        fr_lparse_error(parser, parser->at, parser->at + 1, "syntax", "fscanf needs a text");
        return;
    }
    fr_lparse_emit(parser, FR_LOP_SCAN_BEGIN, text, 0, 0, begin);
    while (!parser->has_failed && fr_lparse_accept(parser, ",")) {
        read_target(parser);
    }
    fr_lparse_expect(parser, ")");
    fr_lparse_emit(parser, FR_LOP_SCAN_END, 0, 0, 0, begin);
    parser->is_impure = true;
}

static void read_builtin(FrLparser *parser, uint32_t function, const char *name, uint32_t least,
                         uint32_t most, size_t begin) {
    if (strcmp(name, "fscanf") == 0) {
        read_scan(parser, begin);
        return;
    }
    bool is_print = strcmp(name, "printf") == 0;
    uint32_t text = FR_NONE, count;
    if (is_print) {
        text = fr_lparse_string(parser);
        if (text == FR_NONE) {
            fr_lparse_error(parser, parser->at, parser->at + 1, "syntax", "printf needs a text");
            return;
        }
        if (fr_lparse_accept(parser, ",")) {
            count = read_arguments(parser);
        } else {
            fr_lparse_expect(parser, ")");
            count = 0;
        }
    } else {
        count = read_arguments(parser);
    }
    if (count < least || count > most) {
        fr_lparse_error(parser, begin, begin + strlen(name), "argument-count",
                        "%s takes %u argument%s, here are %u", name, most, most == 1 ? "" : "s",
                        count);
    }
    if (fr_lbuiltin_is_left_out(function)) {
        fr_lparse_warning(parser, begin, begin + strlen(name), "left-out",
                          "%s is read but does nothing here; its value is 0", name);
    }
    parser->is_impure |= is_print || !fr_lbuiltin_is_pure(function);
    fr_lparse_emit(parser, is_print ? FR_LOP_PRINT : FR_LOP_CALL, is_print ? text : function, count,
                   0, begin);
}

static uint32_t find_function(const FrLparser *parser, const char *name) {
    const GArray *functions = parser->system->functions;
    for (guint i = 0; i < functions->len; i++) {
        if (strcmp(g_array_index(functions, FrLfunction, i).name, name) == 0) {
            return i;
        }
    }
    return FR_NONE;
}

static void read_call(FrLparser *parser, const char *name, size_t begin) {
    uint32_t least, most, function = find_function(parser, name);
    if (function != FR_NONE) {
        uint32_t wanted = g_array_index(parser->system->functions, FrLfunction, function).count;
        uint32_t count = read_arguments(parser);
        if (count != wanted) {
            fr_lparse_error(parser, begin, begin + strlen(name), "argument-count",
                            "%s takes %u arguments, here are %u", name, wanted, count);
        }
        fr_lparse_emit(parser, FR_LOP_USER, function, count, 0, begin);
        return;
    }
    function = fr_lbuiltin_find(name, &least, &most);
    if (function == FR_NONE) {
        bool is_own = parser->function != NULL && strcmp(parser->function, name) == 0;
        fr_lparse_error(
            parser, begin, begin + strlen(name), is_own ? "recursive-call" : "unknown-function",
            is_own ? "the function '%s' cannot call itself" : "there is no function '%s'", name);
        return;
    }
    read_builtin(parser, function, name, least, most, begin);
}

// `fi` of a paper is f(i) where f is a function and i a formal parameter.
static bool read_juxtaposed(FrLparser *parser, const char *name, size_t begin) {
    if (!parser->system->is_paper || name[1] == '\0' || find_variable(parser, name) != FR_NONE) {
        return false;
    }
    const char function_name[2] = {name[0], '\0'};
    uint32_t function = find_function(parser, function_name);
    uint32_t variable = find_variable(parser, name + 1);
    if (function == FR_NONE || variable == FR_NONE ||
        g_array_index(parser->system->functions, FrLfunction, function).count != 1) {
        return false;
    }
    fr_lparse_emit(parser, FR_LOP_VAR, variable, 0, 0, begin);
    fr_lparse_emit(parser, FR_LOP_USER, function, 1, 0, begin);
    return true;
}

static void read_number(FrLparser *parser) {
    // An exponent needs a decimal point before it.
    size_t begin = parser->at, at = begin;
    while (g_ascii_isdigit(parser->bytes[at])) {
        at++;
    }
    if (parser->bytes[at] == '.') {
        at++;
        while (g_ascii_isdigit(parser->bytes[at])) {
            at++;
        }
        size_t mark = at;
        if (parser->bytes[at] == 'e' || parser->bytes[at] == 'E') {
            at++;
            at += parser->bytes[at] == '+' || parser->bytes[at] == '-';
            bool has_digits = g_ascii_isdigit(parser->bytes[at]);
            while (g_ascii_isdigit(parser->bytes[at])) {
                at++;
            }
            at = has_digits ? at : mark;
        }
    }
    if (at - begin > 100) {
        fr_lparse_error(parser, begin, at, "syntax", "this number is too long");
        return;
    }
    char digits[104];
    memcpy(digits, parser->bytes + begin, at - begin);
    digits[at - begin] = '\0';
    parser->at = at;
    fr_lparse_emit(parser, FR_LOP_CONST, 0, 0, g_ascii_strtod(digits, NULL), begin);
}

static void read_named(FrLparser *parser) {
    size_t begin = parser->at;
    char *name = fr_lparse_name(parser);
    uint32_t array = fr_lparse_find_array(parser, name);
    if (array != FR_NONE) {
        read_index(parser, array, begin);
        parser->is_leaf = false;
    } else if (fr_lparse_accept(parser, "(")) {
        read_call(parser, name, begin);
        parser->is_leaf = false;
    } else if (!read_juxtaposed(parser, name, begin)) {
        fr_lparse_emit(parser, FR_LOP_VAR, fr_lparse_variable(parser, name, false, begin), 0, 0,
                       begin);
    }
    g_free(name);
}

static void read_primary(FrLparser *parser) {
    char c = fr_lparse_peek(parser);
    size_t begin = parser->at;
    parser->is_leaf = true;
    if (fr_lparse_accept(parser, "(")) {
        fr_lparse_expression(parser);
        fr_lparse_expect(parser, ")");
    } else if (g_ascii_isdigit(c) || (c == '.' && g_ascii_isdigit(parser->bytes[begin + 1]))) {
        read_number(parser);
    } else if (g_ascii_isalpha(c) || c == '_') {
        read_named(parser);
    } else {
        fr_lparse_error(parser, begin, begin + 1, "syntax", "a number, name or '(' is wanted here");
    }
}

char fr_lparse_peek_value(FrLparser *parser) {
    char c;
    while ((c = fr_lparse_peek(parser)) == '\\') {
        parser->at++;
    }
    return c;
}

void fr_lparse_unary(FrLparser *parser) {
    char c = fr_lparse_peek_value(parser);
    size_t begin = parser->at;
    if (parser->has_failed) {
        return;
    }
    if (++parser->depth > DEEPEST) {
        fr_lparse_error(parser, begin, begin + 1, "too-deep", "expressions are nested too deeply");
    } else if (c == '-' || (c == '!' && parser->bytes[begin + 1] != '=')) {
        parser->at++;
        fr_lparse_unary(parser);
        parser->is_leaf = false;
        fr_lparse_emit(parser, c == '-' ? FR_LOP_NEGATE : FR_LOP_NOT, 0, 0, 0, begin);
    } else {
        read_primary(parser);
    }
    parser->depth--;
}
