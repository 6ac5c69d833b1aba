// Diagnostics as people read them, with the line and a caret, and as tools do, in JSON.
#include "base/diag.h"

#include "base/text.h"

#include <jansson.h>
#include <string.h>

enum {
    WIDEST_LINE = 160, // columns of a source line shown; more is cut around the span
    LEAD = 60,         // characters shown before the span of a cut line
    TAB_WIDTH = 4,
};

static const char *severity_name(FrSeverity severity) {
    return severity == FR_ERROR ? "error" : severity == FR_WARNING ? "warning" : "note";
}

// A span made to lie within its source.
static FrSpan clamp_span(FrSpan span) {
    size_t size = 0;
    fr_source_text(span.source, &size);
    uint32_t limit = (uint32_t)size;
    span.begin = span.begin < limit ? span.begin : limit;
    span.end = span.end < limit ? span.end : limit;
    span.end = span.end > span.begin ? span.end : span.begin;
    return span;
}

// The piece of one line that is shown, and the part of it to underline.
typedef struct Excerpt {
    const char *line_begin, *line_end; // without the line break
    const char *begin, *end;           // of the span, within the line
} Excerpt;

static Excerpt find_excerpt(FrSpan span) {
    size_t size = 0;
    const char *text = fr_source_text(span.source, &size);
    Excerpt excerpt = {.begin = text + span.begin, .end = text + span.end};
    const char *line_break = memrchr(text, '\n', span.begin);
    excerpt.line_begin = line_break != NULL ? line_break + 1 : text;
    excerpt.line_end = memchr(excerpt.begin, '\n', size - span.begin);
    if (excerpt.line_end == NULL) {
        excerpt.line_end = text + size;
    }
    if (excerpt.line_end > excerpt.line_begin && excerpt.line_end[-1] == '\r') {
        excerpt.line_end--;
    }
    if (excerpt.begin > excerpt.line_end) {
        excerpt.begin = excerpt.line_end;
    }
    if (excerpt.end > excerpt.line_end) {
        excerpt.end = excerpt.line_end;
    }
    return excerpt;
}

static int char_width(gunichar code, int column) {
    if (code == '\t') {
        return TAB_WIDTH - column % TAB_WIDTH;
    }
    if (!g_unichar_isprint(code)) {
        return 1; // shown as U+FFFD
    }
    return g_unichar_iszerowidth(code) ? 0 : g_unichar_iswide(code) ? 2 : 1;
}

static bool fits(const Excerpt *excerpt) {
    // A column takes at least a byte, so a short line needs no count.
    if (excerpt->line_end - excerpt->line_begin > 4 * WIDEST_LINE) {
        return false;
    }
    int column = 0;
    for (const char *at = excerpt->line_begin; at < excerpt->line_end;) {
        TextChar c = fr_text_char(at, excerpt->line_end);
        column += char_width(c.code, column);
        at += c.size;
    }
    return column <= WIDEST_LINE;
}

// LEAD characters before the span, never further than the line's begin.
static const char *step_back(const Excerpt *excerpt) {
    const char *at = excerpt->begin;
    for (int i = 0; i < LEAD && at > excerpt->line_begin; i++) {
        at--;
        for (int k = 0; k < 3 && at > excerpt->line_begin && ((unsigned char)*at & 0xc0) == 0x80;
             k++) {
            at--;
        }
    }
    return at;
}

static void print_excerpt(const Excerpt *excerpt, uint32_t line, GString *out) {
    bool is_whole = fits(excerpt);
    const char *at = is_whole ? excerpt->line_begin : step_back(excerpt);
    g_string_append_printf(out, "%5u | ", line);
    GString *marks = g_string_new("      | ");
    int column = 0;
    if (at > excerpt->line_begin) {
        g_string_append(out, "…");
        g_string_append_c(marks, ' ');
        column = 1;
    }
    bool is_marked = false;
    while (at < excerpt->line_end) {
        if (!is_whole && column >= WIDEST_LINE) {
            g_string_append(out, "…");
            break;
        }
        TextChar c = fr_text_char(at, excerpt->line_end);
        int width = char_width(c.code, column);
        bool is_inside = at + c.size > excerpt->begin && at < excerpt->end;
        for (int i = 0; i < width; i++) {
            bool is_first = !is_marked && (is_inside || at == excerpt->begin);
            g_string_append_c(marks, is_first ? '^' : is_inside ? '~' : ' ');
            is_marked |= is_first;
        }
        if (c.code == '\t') {
            g_string_append_printf(out, "%*s", width, "");
        } else {
            fr_text_append_visible(out, c.code);
        }
        column += width;
        at += c.size;
    }
    if (!is_marked) {
        g_string_append_c(marks, '^');
    }
    while (marks->str[marks->len - 1] == ' ') {
        g_string_truncate(marks, marks->len - 1);
    }
    g_string_append_printf(out, "\n%s\n", marks->str);
    g_string_free(marks, TRUE);
}

static void append_name(const char *name, GString *out) {
    const char *end = name + strlen(name);
    for (const char *at = name; at < end;) {
        TextChar c = fr_text_char(at, end);
        fr_text_append_visible(out, c.code);
        at += c.size;
    }
}

static void print_diag(const FrDiag *diag, GString *out) {
    if (diag->span.source == NULL) {
        g_string_append_printf(out, "%s: %s [%s]\n", severity_name(diag->severity), diag->text,
                               diag->code);
        return;
    }
    FrSpan span = clamp_span(diag->span);
    uint32_t line, column;
    fr_source_position(span.source, span.begin, &line, &column);
    append_name(fr_source_name(span.source), out);
    g_string_append_printf(out, ":%u:%u: %s: %s [%s]\n", line, column,
                           severity_name(diag->severity), diag->text, diag->code);
    size_t size;
    fr_source_text(span.source, &size);
    if (size > 0) { // what has no lines has none to show
        Excerpt excerpt = find_excerpt(span);
        print_excerpt(&excerpt, line, out);
    }
}

void fr_diags_print(const FrDiags *diags, GString *out) {
    if (diags == NULL) {
        return;
    }
    for (size_t i = 0; i < diags->count; i++) {
        print_diag(&diags->kept[i], out);
    }
    if (diags->total > diags->count) {
        g_string_append_printf(out, "and %zu more like these\n", diags->total - diags->count);
    }
}

static json_t *json_text(const char *text) {
    char *valid = g_utf8_make_valid(text, -1);
    json_t *json = json_string(valid);
    g_free(valid);
    return json;
}

static json_t *json_diag(const FrDiag *diag) {
    json_t *object = json_object();
    json_object_set_new(object, "severity", json_string(severity_name(diag->severity)));
    json_object_set_new(object, "code", json_string(diag->code));
    if (diag->span.source != NULL) {
        FrSpan span = clamp_span(diag->span);
        uint32_t line, column, end_line, end_column;
        fr_source_position(span.source, span.begin, &line, &column);
        fr_source_position(span.source, span.end, &end_line, &end_column);
        json_object_set_new(object, "file", json_text(fr_source_name(span.source)));
        json_object_set_new(object, "line", json_integer(line));
        json_object_set_new(object, "column", json_integer(column));
        json_object_set_new(object, "end_line", json_integer(end_line));
        json_object_set_new(object, "end_column", json_integer(end_column));
    }
    json_object_set_new(object, "text", json_text(diag->text));
    return object;
}

void fr_diags_print_json(const FrDiags *diags, GString *out) {
    json_t *array = json_array();
    for (size_t i = 0; i < fr_diags_count(diags); i++) {
        json_array_append_new(array, json_diag(&diags->kept[i]));
    }
    char *text = json_dumps(array, JSON_INDENT(2) | JSON_PRESERVE_ORDER);
    g_string_append(out, text);
    g_string_append_c(out, '\n');
    free(text);
    json_decref(array);
}
