// Statements within { } and the arrays of define:.
#include "lsystem/parse.h"

#include <string.h>

#define DEEPEST 64

static void read_block(FrLparser *parser);

static uint32_t emit_jump(FrLparser *parser, FrLop op, uint32_t to) {
    uint32_t here = fr_lparse_code_here(parser);
    fr_lparse_emit(parser, op, to, 0, 0, parser->at);
    return here;
}

static bool accept_word(FrLparser *parser, const char *word) {
    fr_lparse_blanks(parser);
    size_t length = strlen(word);
    const char *here = parser->bytes + parser->at;
    if (strncmp(here, word, length) != 0 || g_ascii_isalnum(here[length]) || here[length] == '_') {
        return false;
    }
    parser->at += length;
    return true;
}

static void read_condition(FrLparser *parser) {
    fr_lparse_expect(parser, "(");
    fr_lparse_expression(parser);
    fr_lparse_expect(parser, ")");
}

static void read_if(FrLparser *parser) {
    read_condition(parser);
    uint32_t skip = emit_jump(parser, FR_LOP_JUMP_ZERO, 0);
    read_block(parser);
    if (accept_word(parser, "else")) {
        uint32_t end = emit_jump(parser, FR_LOP_JUMP, 0);
        fr_lparse_land(parser, skip);
        if (accept_word(parser, "if")) {
            read_if(parser);
        } else {
            read_block(parser);
        }
        fr_lparse_land(parser, end);
    } else {
        fr_lparse_land(parser, skip);
    }
}

static void read_while(FrLparser *parser) {
    uint32_t begin = fr_lparse_code_here(parser);
    parser->barrier = begin;
    read_condition(parser);
    uint32_t skip = emit_jump(parser, FR_LOP_JUMP_ZERO, 0);
    read_block(parser);
    emit_jump(parser, FR_LOP_BACK, begin);
    fr_lparse_land(parser, skip);
}

static void read_do(FrLparser *parser) {
    uint32_t begin = fr_lparse_code_here(parser);
    parser->barrier = begin;
    read_block(parser);
    if (!accept_word(parser, "while")) {
        fr_lparse_error(parser, parser->at, parser->at + 1, "syntax", "do { } needs a while");
        return;
    }
    read_condition(parser);
    uint32_t skip = emit_jump(parser, FR_LOP_JUMP_ZERO, 0);
    emit_jump(parser, FR_LOP_BACK, begin);
    fr_lparse_land(parser, skip);
    fr_lparse_expect(parser, ";");
}

// Whether a name and its indices stand before a single '='.
static bool is_assignment(const FrLparser *parser) {
    const char *at = parser->bytes + parser->at;
    if (!g_ascii_isalpha(*at) && *at != '_') {
        return false;
    }
    while (g_ascii_isalnum(*at) || *at == '_') {
        at++;
    }
    for (int depth = 0; *at != '\0' && *at != ';'; at++) {
        depth += (*at == '[') - (*at == ']');
        if (depth == 0 && *at != ']' && !g_ascii_isspace(*at)) {
            break;
        }
    }
    return at[0] == '=' && at[1] != '=';
}

static void read_assignment(FrLparser *parser) {
    size_t begin = parser->at;
    char *name = fr_lparse_name(parser);
    uint32_t array = fr_lparse_find_array(parser, name), count = 0;
    // Known from here on: its own value may stand behind the '='.
    uint32_t variable = array == FR_NONE ? fr_lparse_variable(parser, name, true, begin) : FR_NONE;
    if (array != FR_NONE) {
        count = fr_lparse_indices(parser, array, begin);
    }
    fr_lparse_expect(parser, "=");
    fr_lparse_expression(parser);
    if (array != FR_NONE) {
        fr_lparse_emit(parser, FR_LOP_INDEX_STORE, array, count, 0, begin);
    } else {
        fr_lparse_emit(parser, FR_LOP_STORE, variable, 0, 0, begin);
    }
    parser->is_impure = true;
    fr_lparse_expect(parser, ";");
    g_free(name);
}

static void read_statement(FrLparser *parser) {
    fr_lparse_blanks(parser);
    if (fr_lparse_accept(parser, ";")) {
        return;
    }
    if (accept_word(parser, "if")) {
        read_if(parser);
    } else if (accept_word(parser, "while")) {
        read_while(parser);
    } else if (accept_word(parser, "do")) {
        read_do(parser);
    } else if (is_assignment(parser)) {
        read_assignment(parser);
    } else {
        fr_lparse_expression(parser);
        fr_lparse_emit(parser, FR_LOP_DROP, 0, 0, 0, parser->at);
        fr_lparse_expect(parser, ";");
    }
    parser->stack = 0;
}

static void read_block(FrLparser *parser) {
    size_t begin = parser->at;
    if (parser->has_failed || !fr_lparse_expect(parser, "{")) {
        return;
    }
    if (++parser->depth > DEEPEST) {
        fr_lparse_error(parser, begin, begin + 1, "too-deep", "blocks are nested too deeply");
    }
    while (!parser->has_failed && !fr_lparse_accept(parser, "}")) {
        if (fr_lparse_peek(parser) == '\0') {
            fr_lparse_error(parser, begin, begin + 1, "syntax", "this '{' has no '}'");
        } else {
            read_statement(parser);
        }
    }
    parser->depth--;
}

uint32_t fr_lparse_block(FrLparser *parser) {
    bool was_block = parser->is_block;
    parser->is_block = true;
    uint32_t begin = fr_lparse_code_here(parser);
    parser->barrier = begin;
    parser->stack = 0;
    read_block(parser);
    fr_lparse_emit(parser, FR_LOP_END, 0, 0, 0, parser->at);
    parser->is_block = was_block;
    return begin;
}

// ---- define: ----------------------------------------------------------------------------------

/// A dimension: a constant of at least 1; 0 after a complaint.
static uint32_t read_dimension(FrLparser *parser) {
    size_t begin = parser->at;
    uint32_t code = fr_lparse_value(parser);
    const FrLcode *value = &g_array_index(parser->system->code, FrLcode, code);
    bool is_constant = fr_lparse_code_here(parser) == code + 2 && value->op == FR_LOP_CONST;
    if (!parser->has_failed && (!is_constant || !(value->value >= 1 && value->value <= 1e9))) {
        fr_lparse_error(parser, begin, parser->at, "array-size",
                        "the size of an array is a constant of at least 1");
    }
    fr_lparse_expect(parser, "]");
    return parser->has_failed ? 0 : (uint32_t)value->value;
}

static void read_dimensions(FrLparser *parser, FrLarray *array) {
    uint64_t size = 1;
    while (!parser->has_failed && fr_lparse_accept(parser, "[")) {
        uint32_t dimension = read_dimension(parser);
        if (array->dimension_count == G_N_ELEMENTS(array->dimensions)) {
            fr_lparse_error(parser, parser->at, parser->at + 1, "array-size",
                            "an array has at most 8 dimensions");
            return;
        }
        array->dimensions[array->dimension_count++] = dimension;
        size = fr_count_multiply(size, dimension);
    }
    if (!parser->has_failed) {
        array->first = fr_lparse_new_variable(parser, size, parser->at);
        array->size = parser->has_failed ? 0 : (uint32_t)size;
    }
}

/// Name and dimensions; adds the array and returns its index, FR_NONE after a complaint.
static uint32_t read_array_name(FrLparser *parser, char **name) {
    FrLarray array = {0};
    *name = fr_lparse_name(parser);
    if (*name == NULL) {
        fr_lparse_error(parser, parser->at, parser->at + 1, "syntax", "a name is wanted here");
        return FR_NONE;
    }
    read_dimensions(parser, &array);
    if (parser->has_failed || array.dimension_count == 0) {
        return FR_NONE;
    }
    g_array_append_val(parser->system->arrays, array);
    g_hash_table_insert(parser->unit->globals, g_strconcat(*name, "[]", NULL),
                        GUINT_TO_POINTER(parser->system->arrays->len));
    return parser->system->arrays->len - 1;
}

// The initial values become code that runs before Start.
static void read_initializer(FrLparser *parser, uint32_t index) {
    FrLarray array = g_array_index(parser->system->arrays, FrLarray, index);
    uint32_t count = 0, code = fr_lparse_code_here(parser);
    int depth = 1;
    parser->barrier = code;
    parser->stack = 0;
    fr_lparse_expect(parser, "{");
    while (!parser->has_failed && depth > 0) {
        if (fr_lparse_accept(parser, "{")) {
            depth++;
        } else if (fr_lparse_accept(parser, "}")) {
            depth--;
        } else if (!fr_lparse_accept(parser, ",")) {
            size_t begin = parser->at;
            fr_lparse_expression(parser);
            fr_lparse_emit(parser, FR_LOP_STORE, array.first + count, 0, 0, begin);
            if (++count > array.size) {
                fr_lparse_error(parser, begin, parser->at, "array-size",
                                "the array has only %u elements", array.size);
            }
        }
    }
    fr_lparse_emit(parser, FR_LOP_END, 0, 0, 0, parser->at);
    g_array_append_val(parser->unit->initializers, code);
}

static void read_definition(FrLparser *parser) {
    bool is_array = accept_word(parser, "array"), is_external = accept_word(parser, "external");
    if (!is_array && !is_external) {
        fr_lparse_error(parser, parser->at, parser->at + 1, "syntax",
                        "'array' or 'external' is wanted here");
        return;
    }
    do {
        size_t begin = parser->at;
        char *name = NULL;
        uint32_t array = read_array_name(parser, &name);
        if (is_external && !parser->has_failed) {
            FrLexternal external = {g_strdup(name), 0, 1};
            if (array == FR_NONE) {
                external.variable = fr_lparse_variable(parser, name, true, begin);
            } else {
                const FrLarray *found = &g_array_index(parser->system->arrays, FrLarray, array);
                external.variable = found->first;
                external.size = found->size;
            }
            g_array_append_val(parser->unit->externals, external);
        } else if (array == FR_NONE && !parser->has_failed) {
            fr_lparse_error(parser, begin, parser->at, "array-size",
                            "an array needs its size, as in a[3]");
        } else if (!parser->has_failed && fr_lparse_accept(parser, "=")) {
            read_initializer(parser, array);
        }
        g_free(name);
    } while (!parser->has_failed && fr_lparse_accept(parser, ","));
    fr_lparse_expect(parser, ";");
}

void fr_lparse_define(FrLparser *parser) {
    bool was_block = parser->is_block;
    parser->is_block = true;
    fr_lparse_expect(parser, "{");
    while (!parser->has_failed && !fr_lparse_accept(parser, "}")) {
        if (fr_lparse_peek(parser) == '\0') {
            fr_lparse_error(parser, parser->at, parser->at, "syntax", "define: has no '}'");
        } else {
            read_definition(parser);
        }
    }
    parser->is_block = was_block;
}
