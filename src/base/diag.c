// The list of diagnostics.
#include "frond/diag.h"

#include "base/diag.h"
#include "base/text.h"

#include <string.h>

// A message quotes names the user wrote, which may be megabytes of anything.
enum { LONGEST_TEXT = 400 };

FrDiags *fr_diags_new(void) {
    FrDiags *diags = g_new0(FrDiags, 1);
    pthread_mutex_init(&diags->lock, NULL);
    return diags;
}

static void clear_diag(FrDiag *diag) {
    fr_source_unref(diag->span.source);
    g_free(diag->text);
}

void fr_diags_free(FrDiags *diags) {
    if (diags == NULL) {
        return;
    }
    for (size_t i = 0; i < diags->count; i++) {
        clear_diag(&diags->kept[i]);
    }
    pthread_mutex_destroy(&diags->lock);
    g_free(diags);
}

// Valid UTF-8 on one line, at most LONGEST_TEXT characters.
static char *clean_text(const char *text) {
    GString *clean = g_string_new(NULL);
    const char *end = text + strlen(text);
    size_t count = 0;
    for (const char *at = text; at < end;) {
        if (count++ == LONGEST_TEXT) {
            g_string_append(clean, "…");
            break;
        }
        TextChar c = fr_text_char(at, end);
        fr_text_append_visible(clean, c.code == '\n' || c.code == '\t' ? ' ' : c.code);
        at += c.size;
    }
    return g_string_free(clean, FALSE);
}

// Makes room for one more; when the list is full, an error takes the place of the last
// diagnostic that is none.
static FrDiag *claim_place(FrDiags *diags, FrSeverity severity) {
    if (diags->count < FR_DIAGS_KEPT) {
        return &diags->kept[diags->count++];
    }
    for (size_t i = severity == FR_ERROR ? diags->count : 0; i-- > 0;) {
        if (diags->kept[i].severity != FR_ERROR) {
            clear_diag(&diags->kept[i]);
            memmove(&diags->kept[i], &diags->kept[i + 1],
                    (diags->count - i - 1) * sizeof diags->kept[0]);
            return &diags->kept[diags->count - 1];
        }
    }
    return NULL;
}

void fr_diags_add(FrDiags *diags, FrSeverity severity, const char *code, FrSpan span,
                  const char *format, ...) {
    if (diags == NULL) {
        return;
    }
    pthread_mutex_lock(&diags->lock);
    diags->total++;
    diags->error_total += severity == FR_ERROR ? 1 : 0;
    FrDiag *diag = claim_place(diags, severity);
    if (diag != NULL) {
        va_list arguments;
        va_start(arguments, format);
        char *text = g_strdup_vprintf(format, arguments);
        va_end(arguments);
        span = fr_span_outermost(span);
        fr_source_ref(span.source);
        *diag =
            (FrDiag){.severity = severity, .code = code, .span = span, .text = clean_text(text)};
        g_free(text);
    }
    pthread_mutex_unlock(&diags->lock);
}

size_t fr_diags_count(const FrDiags *diags) {
    return diags != NULL ? diags->count : 0;
}

const FrDiag *fr_diags_get(const FrDiags *diags, size_t index) {
    FR_ASSERT(index < diags->count);
    return &diags->kept[index];
}

size_t fr_diags_error_count(const FrDiags *diags) {
    return diags != NULL ? diags->error_total : 0;
}
