/// Saving: beside the file, flushed, renamed; the file as it was, or the file as it is.
#include "document/reader.h"
#include "frond/contents.h"

#include <glib/gstdio.h>
#include <stdlib.h>
#include <string.h>

char *fr_document_text(const FrDocument *document, size_t *size) {
    size_t length;
    const char *text = fr_source_text(document->tree->source, &length);
    char *copy = g_malloc(length + 1);
    memcpy(copy, text, length + 1);
    if (size != NULL) {
        *size = length;
    }
    return copy;
}

FrStatus fr_document_save(const FrDocument *document, const char *path, FrDiags *diags) {
    size_t size;
    const char *text = fr_source_text(document->tree->source, &size);
    return fr_contents_save(text, size, path, diags);
}

FrStatus fr_contents_save(const char *text, size_t size, const char *path, FrDiags *diags) {
    // A link stays a link, and the file keeps its permissions.
    char *target = realpath(path, NULL);
    const char *name = target == NULL ? path : target;
    GStatBuf old;
    int mode = g_stat(name, &old) == 0 ? (int)(old.st_mode & 07777) : 0666;
    GError *error = NULL;
    bool is_saved = g_file_set_contents_full(
        name, text, (gssize)size, G_FILE_SET_CONTENTS_CONSISTENT | G_FILE_SET_CONTENTS_DURABLE,
        mode, &error);
    if (!is_saved) {
        fr_diags_add(diags, FR_ERROR, "save", (FrSpan){0}, "cannot save '%s': %s", path,
                     error->message);
        g_error_free(error);
    }
    free(target);
    return is_saved ? FR_OK : FR_ERR_MACHINE;
}
