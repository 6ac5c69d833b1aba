/// Comments stand nowhere but between tags and texts: `<` cannot be part of an attribute's value.
#include "scene/contents.h"

#include <string.h>

static bool begins(const char *at, const char *end, const char *word) {
    size_t length = strlen(word);
    return (size_t)(end - at) >= length && memcmp(at, word, length) == 0;
}

/// Behind the next `word`, or the end.
static const char *behind(const char *at, const char *end, const char *word) {
    while (at < end && !begins(at, end, word)) {
        at++;
    }
    return at < end ? at + strlen(word) : end;
}

/// Behind a comment or a blank that may be left out there; `at` if there is none. Blanks are left
/// out between tags only: `from` is where the text after the last tag begins.
static const char *behind_idle(const char *at, const char *end, bool follows_tag) {
    const char *next = at;
    if (begins(at, end, "<!--")) {
        return behind(at + 4, end, "-->");
    }
    while (follows_tag && next < end && g_ascii_isspace(*next)) {
        next++;
    }
    return next == end || *next == '<' ? next : at;
}

FrDigest fr_contents_digest(FrDigest seed, const FrDocument *document) {
    size_t size;
    char *text = fr_document_text(document, &size);
    GByteArray *kept = g_byte_array_sized_new((guint)MIN(size, G_MAXUINT / 2));
    const char *end = text + size;
    bool follows_tag = true;
    for (const char *at = text; at < end;) {
        const char *next = behind_idle(at, end, follows_tag);
        if (next > at) {
            at = next;
            continue;
        }
        next = begins(at, end, "<![CDATA[") ? behind(at, end, "]]>") : at + 1;
        g_byte_array_append(kept, (const guint8 *)at, (guint)(next - at));
        follows_tag = next[-1] == '>';
        at = next;
    }
    FrDigest digest = fr_digest(seed, kept->data, kept->len);
    g_byte_array_unref(kept);
    g_free(text);
    return digest;
}
