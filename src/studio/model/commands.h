/// @file commands.h
/// What a person does to a document, each one step that can be undone. Elements are those of
/// studio_document_contents(). All return false if nothing changed.
#pragma once

#include "frond/pgraph.h"
#include "studio/model/document.h"

/// Sets an attribute, or takes it away where `value` is NULL or what the table has as its default.
/// With `is_drag` calls in a row for the same attribute are one step.
bool studio_set(StudioDocument *document, uint32_t element, const char *attribute,
                const char *value, bool is_drag);
/// Takes away all attributes that the table knows but the required ones.
bool studio_reset_all(StudioDocument *document, uint32_t element);

// ---- components of a <pgraph> ------------------------------------------------------------------

/// The `<pgraph>` of a plant; FR_NONE: it has none, or `plant` is FR_NONE.
uint32_t studio_graph_of(const StudioDocument *document, uint32_t plant);
/// An id that nothing within the plant has: `stem`, `stem2`, … Free with g_free().
char *studio_free_id(const StudioDocument *document, uint32_t plant, const char *stem);
/// The kind of link that most probably is meant from one component to another.
FrLinkKind studio_likely_link(FrComponentKind from, FrComponentKind to);
/// Where what is linked stands, in words: "along the stem".
const char *studio_link_words(FrLinkKind kind, FrComponentKind from);
/// Adds a component of its kind, of a material that suits if there is one, linked from `parent`
/// (its id; NULL: from nothing). `*id` (may be NULL) receives its id, to be freed with g_free().
bool studio_add_component(StudioDocument *document, uint32_t plant, FrComponentKind kind,
                          const char *parent, char **id);
/// Why the two cannot be linked, in a sentence; NULL: they can.
const char *studio_link_refusal(const StudioDocument *document, uint32_t plant, const char *from,
                                const char *to);
bool studio_add_link(StudioDocument *document, uint32_t plant, const char *from, const char *to,
                     FrLinkKind kind);
bool studio_set_link_kind(StudioDocument *document, uint32_t link, FrLinkKind kind);
bool studio_remove_link(StudioDocument *document, uint32_t link);
/// Removes a component and all links to and from it.
bool studio_remove_component(StudioDocument *document, uint32_t plant, const char *id);
/// A second component with the same parameters, linked from where the first is linked from, and
/// with `with_children` to what it is linked to. `*copy` as in studio_add_component().
bool studio_duplicate_component(StudioDocument *document, uint32_t plant, const char *id,
                                bool with_children, char **copy);
bool studio_enable_component(StudioDocument *document, uint32_t plant, const char *id,
                             bool is_enabled);
/// Gives it another id, in links and edits too. False if the new one is taken or is none.
bool studio_rename_component(StudioDocument *document, uint32_t plant, const char *id,
                             const char *to);
/// What stands at a path of the i-tree is pruned, hidden or otherwise edited by hand: attributes
/// and values in pairs, NULL at the end.
bool studio_edit_instance(StudioDocument *document, uint32_t plant, const char *path,
                          const char *name, ...) G_GNUC_NULL_TERMINATED;
