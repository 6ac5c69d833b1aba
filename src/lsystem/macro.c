// Macro replacement as C does it: arguments are replaced first, the body is replaced again with
// the macro itself switched off; `#` and `##` work where a formal name stands beside them.
#include "lsystem/macro.h"

#include <ctype.h>
#include <string.h>

#define DEEPEST 64

/// The macros being replaced, innermost first.
typedef struct Active {
    const FrLmacro *macro;
    const struct Active *outer;
    int depth;
} Active;

static bool is_name_start(char c) {
    return g_ascii_isalpha(c) || c == '_';
}

static bool is_name_part(char c) {
    return g_ascii_isalnum(c) || c == '_';
}

static size_t name_length(const char *text, size_t size) {
    size_t length = 0;
    while (length < size && is_name_part(text[length])) {
        length++;
    }
    return length;
}

static void macro_free(gpointer data) {
    FrLmacro *macro = data;
    g_free(macro->body);
    g_strfreev(macro->formals);
    g_free(macro);
}

void fr_lmacros_init(FrLmacros *macros, uint64_t most) {
    *macros = (FrLmacros){
        .table = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, macro_free), .most = most};
}

void fr_lmacros_clear(FrLmacros *macros) {
    g_hash_table_unref(macros->table);
}

bool fr_lmacros_define(FrLmacros *macros, const char *text) {
    while (g_ascii_isspace(*text)) {
        text++;
    }
    size_t length = name_length(text, strlen(text));
    if (length == 0 || !is_name_start(*text)) {
        return false;
    }
    char *name = g_strndup(text, length);
    const char *rest = text + length;
    char **formals = NULL;
    if (*rest == '(') {
        const char *close = strchr(rest, ')');
        if (close == NULL) {
            g_free(name);
            return false;
        }
        char *inside = g_strndup(rest + 1, (gsize)(close - rest - 1));
        formals = g_strsplit(g_strstrip(inside), ",", -1);
        for (char **formal = formals; *formal != NULL; formal++) {
            g_strstrip(*formal);
        }
        g_free(inside);
        rest = close + 1;
    }
    FrLmacro *macro = g_new(FrLmacro, 1);
    *macro = (FrLmacro){g_strstrip(g_strdup(rest)), formals};
    g_hash_table_replace(macros->table, name, macro);
    return true;
}

static void expand(FrLmacros *macros, const char *text, size_t size, const Active *active,
                   GString *out, FrLmacroSink sink, void *data);

static bool is_active(const Active *active, const FrLmacro *macro) {
    for (; active != NULL; active = active->outer) {
        if (active->macro == macro) {
            return true;
        }
    }
    return false;
}

/// The arguments behind a macro's name; `end` is set behind the closing bracket. NULL: no call.
static GPtrArray *read_arguments(const char *text, size_t size, size_t *end) {
    size_t at = 0;
    while (at < size && g_ascii_isspace(text[at])) {
        at++;
    }
    if (at == size || text[at] != '(') {
        return NULL;
    }
    GPtrArray *arguments = g_ptr_array_new_with_free_func(g_free);
    size_t begin = ++at;
    for (int depth = 0; at < size; at++) {
        if (depth == 0 && (text[at] == ',' || text[at] == ')')) {
            g_ptr_array_add(arguments, g_strstrip(g_strndup(text + begin, at - begin)));
            begin = at + 1;
            if (text[at] == ')') {
                *end = at + 1;
                return arguments;
            }
        } else {
            depth += (text[at] == '(') - (text[at] == ')');
        }
    }
    g_ptr_array_unref(arguments);
    return NULL;
}

static int formal_index(const FrLmacro *macro, const char *name, size_t length) {
    for (int i = 0; macro->formals != NULL && macro->formals[i] != NULL; i++) {
        if (strlen(macro->formals[i]) == length && memcmp(macro->formals[i], name, length) == 0) {
            return i;
        }
    }
    return -1;
}

static bool follows_paste(const char *body, size_t at) {
    while (body[at] == ' ' || body[at] == '\t') {
        at++;
    }
    return body[at] == '#' && body[at + 1] == '#';
}

// Puts arguments in the place of formals. `out` may not grow beyond what is left of the work.
static void substitute(FrLmacros *macros, const FrLmacro *macro, GPtrArray *raw,
                       const Active *active, GString *out) {
    const char *body = macro->body;
    size_t size = strlen(body);
    bool is_pasted = false;
    for (size_t at = 0; at < size && !macros->is_full;) {
        if (body[at] == '#' && body[at + 1] == '#') {
            while (out->len > 0 && g_ascii_isspace(out->str[out->len - 1])) {
                g_string_truncate(out, out->len - 1);
            }
            for (at += 2; g_ascii_isspace(body[at]);) {
                at++;
            }
            is_pasted = true;
            continue;
        }
        bool is_quoted = body[at] == '#' && is_name_start(body[at + 1]);
        size_t name = at + is_quoted;
        size_t length = is_name_start(body[name]) ? name_length(body + name, size - name) : 0;
        int index = length > 0 ? formal_index(macro, body + name, length) : -1;
        if (index < 0) {
            size_t plain = is_quoted || length == 0 ? 1 : length;
            g_string_append_len(out, body + at, (gssize)plain);
            at += plain;
        } else {
            const char *argument = (guint)index < raw->len ? g_ptr_array_index(raw, index) : "";
            at = name + length;
            if (is_quoted) {
                g_string_append_printf(out, "\"%s\"", argument);
            } else if (is_pasted || follows_paste(body, at)) {
                g_string_append(out, argument);
            } else {
                expand(macros, argument, strlen(argument), active, out, NULL, NULL);
            }
        }
        is_pasted = false;
        macros->is_full |= out->len > macros->most;
    }
}

// Tells what stands at `text` to the sink or appends it.
static void emit(FrLmacros *macros, const char *text, size_t size, size_t from, GString *out,
                 FrLmacroSink sink, void *data) {
    macros->work += size;
    macros->is_full |= macros->work > macros->most;
    if (macros->is_full) {
        return;
    }
    if (sink != NULL) {
        sink(data, text, size, from);
    } else {
        g_string_append_len(out, text, (gssize)size);
    }
}

/// Replaces the name at text[at]; returns how many bytes of `text` that took, 0 for none.
static size_t expand_name(FrLmacros *macros, const char *text, size_t size, size_t at,
                          size_t length, const Active *active, GString *out, FrLmacroSink sink,
                          void *data) {
    char *name = g_strndup(text + at, length);
    const FrLmacro *macro = g_hash_table_lookup(macros->table, name);
    g_free(name);
    if (macro == NULL || is_active(active, macro)) {
        return 0;
    }
    int depth = active == NULL ? 1 : active->depth + 1;
    if (depth > DEEPEST) {
        macros->is_deep = true;
        return 0;
    }
    size_t end = 0;
    GPtrArray *arguments = NULL;
    if (macro->formals != NULL) {
        arguments = read_arguments(text + at + length, size - at - length, &end);
        if (arguments == NULL) {
            return 0;
        }
    }
    Active here = {macro, active, depth};
    Active guard = {NULL, active, depth}; // arguments may name the macro, but not without end
    GString *body = g_string_new(NULL);
    if (arguments != NULL) {
        substitute(macros, macro, arguments, &guard, body);
        g_ptr_array_unref(arguments);
    } else {
        g_string_append(body, macro->body);
    }
    GString *result = g_string_new(NULL);
    expand(macros, body->str, body->len, &here, result, NULL, NULL);
    emit(macros, result->str, result->len, at, out, sink, data);
    g_string_free(body, TRUE);
    g_string_free(result, TRUE);
    return length + end;
}

static size_t quoted_length(const char *text, size_t size) {
    size_t at = 1;
    while (at < size && text[at] != '"') {
        at += text[at] == '\\' && at + 1 < size ? 2 : 1;
    }
    return MIN(at + 1, size);
}

static void expand(FrLmacros *macros, const char *text, size_t size, const Active *active,
                   GString *out, FrLmacroSink sink, void *data) {
    size_t at = 0;
    while (at < size && !macros->is_full) {
        size_t length = 1;
        if (is_name_start(text[at])) {
            length = name_length(text + at, size - at);
            size_t used = expand_name(macros, text, size, at, length, active, out, sink, data);
            if (used > 0) {
                at += used;
                continue;
            }
        } else if (g_ascii_isdigit(text[at])) {
            while (at + length < size &&
                   (is_name_part(text[at + length]) || text[at + length] == '.')) {
                length++;
            }
        } else if (text[at] == '"') {
            length = quoted_length(text + at, size - at);
        }
        emit(macros, text + at, length, at, out, sink, data);
        at += length;
    }
}

void fr_lmacros_expand(FrLmacros *macros, const char *line, size_t size, FrLmacroSink sink,
                       void *data) {
    expand(macros, line, size, NULL, NULL, sink, data);
}

// ---- #if --------------------------------------------------------------------------------------

typedef struct Condition {
    const char *at;
    bool is_valid;
    int depth;
} Condition;

static long long read_binary(Condition *condition, int level);

static void skip_blanks(Condition *condition) {
    while (g_ascii_isspace(*condition->at)) {
        condition->at++;
    }
}

static long long read_unary(Condition *condition) {
    skip_blanks(condition);
    char c = *condition->at;
    if (++condition->depth > 200) {
        condition->is_valid = false;
    } else if (c == '!' || c == '-' || c == '+' || c == '~') {
        condition->at++;
        long long value = read_unary(condition);
        condition->depth--;
        unsigned long long bits = (unsigned long long)value;
        return c == '!' ? !value : c == '-' ? (long long)(0 - bits) : c == '~' ? ~value : value;
    } else if (c == '(') {
        condition->at++;
        long long value = read_binary(condition, 0);
        skip_blanks(condition);
        condition->is_valid &= *condition->at == ')';
        condition->at += *condition->at == ')';
        condition->depth--;
        return value;
    } else if (g_ascii_isdigit(c)) {
        char *end;
        long long value = (long long)g_ascii_strtoull(condition->at, &end, 0);
        condition->at = end;
        condition->depth--;
        return value;
    } else if (is_name_start(c)) {
        condition->at += name_length(condition->at, strlen(condition->at));
        condition->depth--;
        return 0; // a name that is no macro
    }
    condition->is_valid = false;
    return 0;
}

static const struct {
    const char *text;
    int level;
} operators[] = {{"||", 1}, {"&&", 2}, {"==", 6}, {"!=", 6}, {"<=", 7}, {">=", 7}, {"<", 7},
                 {">", 7},  {"+", 9},  {"-", 9},  {"*", 10}, {"/", 10}, {"%", 10}};

static long long apply(Condition *condition, const char *op, long long a, long long b) {
    unsigned long long x = (unsigned long long)a, y = (unsigned long long)b;
    bool is_undefined = b == 0 || (b == -1 && a == G_MININT64);
    switch (op[0]) {
    case '|':
        return a || b;
    case '&':
        return a && b;
    case '=':
        return a == b;
    case '!':
        return a != b;
    case '<':
        return op[1] == '=' ? a <= b : a < b;
    case '>':
        return op[1] == '=' ? a >= b : a > b;
    case '+':
        return (long long)(x + y);
    case '-':
        return (long long)(x - y);
    case '*':
        return (long long)(x * y);
    default:
        condition->is_valid &= !is_undefined;
        return is_undefined ? 0 : op[0] == '/' ? a / b : a % b;
    }
}

static long long read_binary(Condition *condition, int level) {
    long long value = read_unary(condition);
    while (condition->is_valid) {
        skip_blanks(condition);
        size_t found = G_N_ELEMENTS(operators);
        for (size_t i = 0; i < G_N_ELEMENTS(operators) && found == G_N_ELEMENTS(operators); i++) {
            if (g_str_has_prefix(condition->at, operators[i].text)) {
                found = i;
            }
        }
        if (found == G_N_ELEMENTS(operators) || operators[found].level <= level) {
            return value;
        }
        condition->at += strlen(operators[found].text);
        long long right = read_binary(condition, operators[found].level);
        value = apply(condition, operators[found].text, value, right);
    }
    return 0;
}

static void collect(void *data, const char *bytes, size_t size, size_t from) {
    (void)from;
    g_string_append_len(data, bytes, (gssize)size);
}

// `defined X` becomes 0 or 1 before macros are replaced.
static char *resolve_defined(const FrLmacros *macros, const char *text) {
    GString *out = g_string_new(NULL);
    size_t size = strlen(text);
    for (size_t at = 0; at < size;) {
        size_t length = is_name_start(text[at]) ? name_length(text + at, size - at) : 0;
        if (length == 7 && memcmp(text + at, "defined", 7) == 0) {
            at += 7;
            while (g_ascii_isspace(text[at]) || text[at] == '(') {
                at++;
            }
            length = name_length(text + at, size - at);
            char *name = g_strndup(text + at, length);
            g_string_append(out, g_hash_table_contains(macros->table, name) ? " 1 " : " 0 ");
            g_free(name);
            for (at += length; g_ascii_isspace(text[at]);) {
                at++;
            }
            at += text[at] == ')';
        } else {
            length = MAX(length, 1);
            g_string_append_len(out, text + at, (gssize)length);
            at += length;
        }
    }
    return g_string_free(out, FALSE);
}

long long fr_lmacros_condition(FrLmacros *macros, const char *text, bool *is_valid) {
    char *resolved = resolve_defined(macros, text);
    GString *expanded = g_string_new(NULL);
    expand(macros, resolved, strlen(resolved), NULL, NULL, collect, expanded);
    Condition condition = {expanded->str, true, 0};
    long long value = read_binary(&condition, 0);
    skip_blanks(&condition);
    *is_valid = condition.is_valid && *condition.at == '\0';
    g_string_free(expanded, TRUE);
    g_free(resolved);
    return value;
}
