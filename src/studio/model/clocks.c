#include "studio/model/clocks.h"

#include "frond/contents.h"

#include <glib.h>
#include <math.h>
#include <string.h>

// Appends bytes of a text, or what takes the place of `origin`, with where they come from.
static void append_from(GString *out, GArray *origins, const char *text, size_t size,
                        uint32_t origin, bool is_copy) {
    g_string_append_len(out, text, (gssize)size);
    for (size_t i = 0; i < size; i++) {
        uint32_t place = origin + (is_copy ? (uint32_t)i : 0);
        g_array_append_val(origins, place);
    }
}

FrSource *studio_source_at_time(FrSource *source, double time, const FrContext *context) {
    FrContents *contents;
    FrContext silent = *context;
    silent.diags = NULL;
    if (isnan(time) || fr_contents_read(source, &silent, &contents) != FR_OK) {
        return fr_source_ref(source);
    }
    char value[G_ASCII_DTOSTR_BUF_SIZE];
    g_ascii_dtostr(value, sizeof value, time);
    size_t size;
    const char *text = fr_source_text(source, &size);
    GString *out = g_string_sized_new(size + 64);
    GArray *origins = g_array_sized_new(FALSE, FALSE, sizeof(uint32_t), (guint)size + 64);
    uint32_t at = 0;
    for (uint32_t plant = fr_contents_child(contents, 0, "plant"); plant != FR_NONE;
         plant = fr_contents_sibling(contents, plant)) {
        FrSplice splice = fr_contents_set(contents, plant, "time", value);
        append_from(out, origins, text + at, splice.begin - at, at, true);
        append_from(out, origins, splice.text, strlen(splice.text), splice.begin, false);
        at = splice.end;
        g_free(splice.text);
    }
    append_from(out, origins, text + at, size - at + 1, at, true); // with the zero behind it
    FrSource *result = fr_source_within(source, out->str, out->len - 1,
                                        (const uint32_t *)(const void *)origins->data);
    g_string_free(out, TRUE);
    g_array_unref(origins);
    fr_contents_free(contents);
    return result;
}
