/// @file lstring.h
/// The string of a plant that is an L-system, as a person reads it beside the picture: its modules
/// as text, what each drew, and what made it.
#pragma once

#include "frond/pick.h"

typedef struct StudioLstring StudioLstring;

enum { STUDIO_LSTRING_MOST = 1000000 }; ///< modules of a string that is shown

/// Derives the plant of that id as the document says, with the seed of its first place.
/// FR_ERR_USAGE if it is no L-system; otherwise on a failure the context's diagnostics tell why.
FR_MUST_USE FrStatus studio_lstring_new(FrSource *source, const char *folder, const char *plant,
                                        const FrContext *context, StudioLstring **string);
void studio_lstring_free(StudioLstring *string);

uint64_t studio_lstring_count(const StudioLstring *string);
/// Steps done, and how many the text alone asks for.
uint64_t studio_lstring_step(const StudioLstring *string);
uint64_t studio_lstring_length(const StudioLstring *string);
/// These three for a person: "Step 3 of 4 · 25 modules". Free with g_free().
char *studio_lstring_words(const StudioLstring *string);
/// False: it has more modules than are shown; what follows may not be asked for then.
bool studio_lstring_is_shown(const StudioLstring *string);

/// The text of modules [first, end). Borrowed, `*size` bytes.
const char *studio_lstring_text(const StudioLstring *string, uint32_t first, uint32_t end,
                                size_t *size);
/// Where a module begins in the whole text; of the count, the end.
uint32_t studio_lstring_begin(const StudioLstring *string, uint32_t module);
/// The module around a byte of the whole text; the last one behind its end.
uint32_t studio_lstring_at(const StudioLstring *string, uint32_t byte);
/// One behind what belongs together with a module: a bracket that opens goes to the one that
/// closes it, anything else is alone.
uint32_t studio_lstring_end_of(const StudioLstring *string, uint32_t module);
/// The production that made a module, NULL: the axiom; and its place, in the document's text if it
/// stands there.
const char *studio_lstring_maker(const StudioLstring *string, uint32_t module, FrSpan *span);

// ---- in the scene ------------------------------------------------------------------------------

/// Looks which plants of a scene are drawn by this very string. False: none; then nothing of the
/// scene is found in the string. Linear in the scene: once for each scene.
bool studio_lstring_match(StudioLstring *string, const FrScene *scene);
/// The module that drew what a ray meets first, FR_NONE; as fr_scene_pick().
uint32_t studio_lstring_pick(const StudioLstring *string, const FrScene *scene,
                             const double origin[3], const double direction[3], double spread);
/// Lines (float[3], in pairs) along all that modules [first, end) drew, wherever it stands. Free
/// with g_array_unref().
GArray *studio_lstring_lines(const StudioLstring *string, const FrScene *scene, uint32_t first,
                             uint32_t end);
