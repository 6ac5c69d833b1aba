/// @file borrowed.h
/// By what names the things of a document use one another, and how they are taken to another
/// document where some of the names mean something else.
#pragma once

#include "studio/model/document.h"

typedef enum StudioTag {
    STUDIO_TAG_CURVE,
    STUDIO_TAG_FUNCTION,
    STUDIO_TAG_MATERIAL,
    STUDIO_TAG_PLANT,
    STUDIO_TAG_SLIDER,    ///< within a plant, as is
    STUDIO_TAG_COMPONENT, ///< of its p-graph
    STUDIO_TAG_COUNT,
} StudioTag;

/// What is called otherwise in the other document: by kind, id → new id.
typedef struct StudioNames {
    GHashTable *by_tag[STUDIO_TAG_COUNT];
    uint32_t plant;    ///< whose sliders and components are meant; FR_NONE: none
    GHashTable *taken; ///< all new ids
} StudioNames;

void studio_names_init(StudioNames *names, uint32_t plant);
void studio_names_clear(StudioNames *names);
/// The new id of a thing, or the id that it has.
const char *studio_names_get(const StudioNames *names, StudioTag tag, const char *id);
/// Gives `element` of `theirs` an id that nothing within `inside` of `mine` has, nor any of
/// `theirs`: `stem`, or that with a number.
void studio_names_add(StudioNames *names, const FrContents *mine, uint32_t inside,
                      const FrContents *theirs, uint32_t element, const char *stem);

/// STUDIO_TAG_COUNT: none of these.
StudioTag studio_tag_of(const FrContents *contents, uint32_t element);
/// Whether it is one of those that stand at the top of a document.
bool studio_tag_is_top(StudioTag tag);
/// The thing of that kind and id among the children of `parent`; FR_NONE.
uint32_t studio_tag_find(const FrContents *contents, uint32_t parent, StudioTag tag,
                         const char *id);
/// Whether `own` (FR_NONE: nothing) is what `element` of the others is, to the byte.
bool studio_is_same(const FrContents *mine, uint32_t own, const FrContents *theirs,
                    uint32_t element);
/// The text of an element; lines after its first without the indent that it has. Free with
/// g_free().
char *studio_element_text(const FrContents *contents, uint32_t element);
/// Adds to a set of elements (by GUINT_TO_POINTER) what an element, and all within it, use of the
/// top of the document and of the sliders of `plant`, and what that uses in turn.
void studio_add_used(const FrContents *contents, uint32_t plant, uint32_t element,
                     GHashTable *used);
/// The elements (uint32_t) that name a curve, function, material, plant or slider. Free with
/// g_array_unref().
GArray *studio_users_of(const FrContents *contents, uint32_t element);
/// The contents with the new names in them: their elements have the same numbers. NULL: broken.
FrContents *studio_renamed(const FrContents *contents, const StudioNames *names);
