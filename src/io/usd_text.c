// Lines, braces and lists of a USD layer as text.
#include "io/usd.h"

void fr_usd_indent(FrUsd *usd) {
    for (int i = 0; i < usd->depth; i++) {
        fr_output_text(&usd->output, "    ");
    }
}

static void add_formatted(FrUsd *usd, const char *format, va_list values) {
    char *text = g_strdup_vprintf(format, values);
    fr_usd_indent(usd);
    fr_output_text(&usd->output, text);
    fr_output_text(&usd->output, "\n");
    g_free(text);
}

void fr_usd_line(FrUsd *usd, const char *format, ...) {
    va_list values;
    va_start(values, format);
    add_formatted(usd, format, values);
    va_end(values);
}

void fr_usd_open(FrUsd *usd, const char *format, ...) {
    va_list values;
    va_start(values, format);
    add_formatted(usd, format, values);
    va_end(values);
    fr_usd_line(usd, "{");
    usd->depth++;
}

void fr_usd_close(FrUsd *usd) {
    usd->depth--;
    fr_usd_line(usd, "}");
}

char *fr_usd_name(const char *name) {
    char *plain = g_strdup(name);
    for (char *c = plain; *c != '\0'; c++) {
        *c = g_ascii_isalnum(*c) ? *c : '_';
    }
    if (!g_ascii_isalpha(*plain) && *plain != '_') {
        char *longer = g_strconcat("_", plain, NULL);
        g_free(plain);
        return longer;
    }
    return plain;
}

void fr_usd_tuple(FrUsd *usd, const float *values, int count, int decimals, bool first) {
    FrOutput *output = &usd->output;
    fr_output_text(output, first ? "(" : ", (");
    for (int k = 0; k < count; k++) {
        fr_output_text(output, k > 0 ? ", " : "");
        fr_output_fixed(output, (double)values[k], decimals);
    }
    fr_output_text(output, ")");
}

void fr_usd_begin_list(FrUsd *usd, const char *what) {
    fr_usd_indent(usd);
    fr_output_text(&usd->output, what);
    fr_output_text(&usd->output, " = [");
}

void fr_usd_end_list(FrUsd *usd, const char *about) {
    fr_output_text(&usd->output, "]");
    if (about != NULL) {
        fr_output_text(&usd->output, about);
    }
    fr_output_text(&usd->output, "\n");
}
