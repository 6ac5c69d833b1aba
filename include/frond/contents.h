/// @file contents.h
/// A document's elements as an editor sees them, and edits of its text that touch nothing else.
///
/// Contents are read from any well-formed text, right or wrong in what it says. Edits do not
/// change it: they are *splices*, bytes of the text and what takes their place. Apply some, read
/// the contents of the result, and go on. What no splice names stays as the user wrote it.
#pragma once

#include "frond/context.h"
#include "frond/param.h"

typedef struct FrContents FrContents;

typedef struct FrContentsElement {
    const char *name;             ///< of its tag
    const char *id;               ///< what it is called; NULL: nothing
    const FrParamTable *table;    ///< its attributes but `id`; NULL: unknown or none
    int component;                ///< FrComponentKind, −1 for what is no component
    bool has_text;                ///< its content is text
    uint32_t parent, first, next; ///< elements, FR_NONE
    uint32_t begin, end;          ///< bytes of the whole element
} FrContentsElement;

/// Bytes [begin, end) of a text, and what takes their place.
typedef struct FrSplice {
    uint32_t begin, end;
    char *text; ///< owned
} FrSplice;

/// Keeps a reference to `source`. What is not well-formed gives a diagnostic and NULL.
FR_API FR_MUST_USE FrStatus fr_contents_read(FrSource *source, const FrContext *context,
                                             FrContents **contents);
FR_API void fr_contents_free(FrContents *contents);
FR_API FrSource *fr_contents_source(const FrContents *contents);
/// Elements are numbered in document order; 0 is the root.
FR_API uint32_t fr_contents_count(const FrContents *contents);
FR_API const FrContentsElement *fr_contents_at(const FrContents *contents, uint32_t element);
/// The first element of that tag among the children of `parent`, FR_NONE.
FR_API uint32_t fr_contents_child(const FrContents *contents, uint32_t parent, const char *name);
/// The next element of the same tag after it, with the same parent; FR_NONE.
FR_API uint32_t fr_contents_sibling(const FrContents *contents, uint32_t element);
/// The first element within `inside` (the root: all) that is called so, FR_NONE.
FR_API uint32_t fr_contents_find(const FrContents *contents, uint32_t inside, const char *id);
/// The innermost element around a byte, FR_NONE; `attribute` (may be NULL) receives the name of the
/// attribute around it, to be freed with g_free(), or NULL.
FR_API uint32_t fr_contents_around(const FrContents *contents, uint32_t offset, char **attribute);
/// What an attribute says, NULL if it is not given. Free with g_free().
FR_API char *fr_contents_get(const FrContents *contents, uint32_t element, const char *attribute);
/// The place of an attribute's value; of the element's name if it is not given.
FR_API FrSpan fr_contents_span(const FrContents *contents, uint32_t element, const char *attribute);
/// The text within an element, with the bytes it stands at. Free with g_free().
FR_API char *fr_contents_text(const FrContents *contents, uint32_t element, FrSpan *place);

/// True for what an id may be: a letter or `_`, then letters, digits, `_` and `-`.
FR_API bool fr_contents_is_id(const char *id);

// ---- edits ------------------------------------------------------------------------------------

/// Gives an attribute this value; NULL takes it away. An attribute that is not there stays away: an
/// empty splice.
FR_API FrSplice fr_contents_set(const FrContents *contents, uint32_t element, const char *attribute,
                                const char *value);
/// Makes this the text within an element; in a CDATA section if that is what is there or if it has
/// markup. Elements before and behind the text stay. A text that others part stays, too: an empty
/// splice.
FR_API FrSplice fr_contents_set_text(const FrContents *contents, uint32_t element,
                                     const char *text);
/// Puts an element (its XML) into `parent`, on a line of its own, behind the child `after`;
/// FR_NONE: behind the last. Lines of `xml` after its first are indented as it is.
FR_API FrSplice fr_contents_insert(const FrContents *contents, uint32_t parent, uint32_t after,
                                   const char *xml);
/// Takes an element away, with the line it stands on alone.
FR_API FrSplice fr_contents_remove(const FrContents *contents, uint32_t element);
/// The text with all splices (FrSplice) done; they may not overlap. Frees their texts and empties
/// the array. Free with g_free().
FR_API char *fr_contents_apply(const FrContents *contents, GArray *splices, size_t *size);

/// Writes a document's text beside `path`, flushes, renames: the file as it was, or the whole text.
FR_API FR_MUST_USE FrStatus fr_contents_save(const char *text, size_t size, const char *path,
                                             FrDiags *diags);
