#include "cli/cli.h"

#include <stdarg.h>
#include <stdio.h>

void cli_message(const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    char *text = g_strdup_vprintf(format, arguments);
    va_end(arguments);
    fprintf(stderr, "frond: %s\n", text);
    g_free(text);
}

char *cli_hint(const char *name, const char *const *candidates, size_t count) {
    const char *near = fr_nearest_name(name, candidates, count);
    return near == NULL ? g_strdup("") : g_strdup_printf("; did you mean '%s'?", near);
}

double cli_now(void) {
    return (double)g_get_monotonic_time() / G_USEC_PER_SEC;
}

char *cli_count_text(uint64_t count) {
    char *digits = g_strdup_printf("%" G_GUINT64_FORMAT, count);
    GString *text = g_string_new(digits);
    for (gssize at = (gssize)text->len - 3; at > 0; at -= 3) {
        g_string_insert(text, at, " ");
    }
    g_free(digits);
    return g_string_free(text, FALSE);
}
