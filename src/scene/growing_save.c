/// The state of plants that grow together as bytes: of each, how many steps it has done and what it
/// has been answered. From that and its seed it is derived again.
#include "scene/growing_parts.h"

#include <math.h>
#include <string.h>

/// What stands before all plants.
typedef struct GrowingHead {
    uint64_t done, sprouts;
    vec3s room[2]; ///< of the light
} GrowingHead;

/// What stands before the answers of a plant.
typedef struct SproutHead {
    uint64_t step, words;
    FrDigest string; ///< that it has come to
} SproutHead;

void fr_growing_save(const FrGrowing *growing, GByteArray *out) {
    GrowingHead head = {.done = growing->done, .sprouts = growing->sprouts->len};
    if (growing->lighting != NULL) {
        fr_lighting_room(growing->lighting, head.room);
    }
    g_byte_array_append(out, (const guint8 *)&head, sizeof head);
    for (guint i = 0; i < growing->sprouts->len; i++) {
        const FrSprout *sprout = g_ptr_array_index(growing->sprouts, i);
        const GArray *words = sprout->answers.words;
        const SproutHead own = {fr_lderivation_step(sprout->derivation), words->len,
                                fr_lstring_digest(fr_lderivation_string(sprout->derivation))};
        g_byte_array_append(out, (const guint8 *)&own, sizeof own);
        g_byte_array_append(out, (const guint8 *)words->data, words->len * sizeof(uint32_t));
    }
}

/// Takes so many bytes; false if there are not.
static bool take(const uint8_t **at, size_t *left, void *into, size_t size) {
    if (size > *left) {
        return false;
    }
    if (size > 0) {
        memcpy(into, *at, size);
    }
    *at += size;
    *left -= size;
    return true;
}

FrStatus fr_growing_regrow(FrGrowing *growing, FrSprout *sprout, uint64_t step,
                           const FrDigest *string, const FrContext *context) {
    FrStatus status =
        fr_growing_derive(growing, sprout->definition, sprout->seed, context, &sprout->derivation);
    if (status != FR_OK) {
        return status;
    }
    growing->asking = sprout;
    bool is_right = step <= fr_lderivation_length(sprout->derivation);
    for (uint64_t i = 0; i < step && is_right && status == FR_OK; i++) {
        status = fr_lderivation_run(sprout->derivation, 1, context);
        is_right = fr_lderivation_step(sprout->derivation) == i + 1;
    }
    is_right = is_right && sprout->answers.read == sprout->answers.words->len;
    is_right =
        is_right &&
        (string == NULL || fr_lstring_digest(fr_lderivation_string(sprout->derivation)) == *string);
    return status == FR_OK && !is_right ? FR_ERR_DOCUMENT : status;
}

/// A plant like `old`, grown from the bytes.
static FrStatus take_sprout(FrGrowing *growing, const FrSprout *old, const uint8_t **at,
                            size_t *left, const FrContext *context, FrSprout *sprout) {
    SproutHead head;
    *sprout = *old;
    sprout->id = g_strdup(old->id);
    sprout->derivation = NULL;
    sprout->ahead = NULL;
    sprout->answers = fr_answers_new();
    if (!take(at, left, &head, sizeof head) || head.words > *left / sizeof(uint32_t)) {
        return FR_ERR_DOCUMENT;
    }
    g_array_set_size(sprout->answers.words, (guint)head.words);
    bool is_there = take(at, left, sprout->answers.words->data, head.words * sizeof(uint32_t));
    return is_there ? fr_growing_regrow(growing, sprout, head.step, &head.string, context)
                    : FR_ERR_DOCUMENT;
}

static bool is_room(const vec3s room[2]) {
    bool is_right = true;
    for (int axis = 0; axis < 3; axis++) {
        is_right &= isfinite(room[0].raw[axis]) && isfinite(room[1].raw[axis]) &&
                    room[0].raw[axis] <= room[1].raw[axis];
    }
    return is_right;
}

FrStatus fr_growing_restore(FrGrowing *growing, const void *bytes, size_t size, FrSpan span,
                            const FrContext *context) {
    const uint8_t *at = bytes;
    GrowingHead head;
    bool has_head = take(&at, &size, &head, sizeof head) && head.done <= UINT32_MAX &&
                    head.sprouts == growing->sprouts->len && is_room(head.room);
    FrStatus status = has_head ? FR_OK : FR_ERR_DOCUMENT;
    GPtrArray *sprouts = g_ptr_array_new_with_free_func(fr_sprout_free);
    growing->is_regrowing = true;
    for (guint i = 0; i < growing->sprouts->len && status == FR_OK; i++) {
        FrSprout *sprout = g_new0(FrSprout, 1);
        g_ptr_array_add(sprouts, sprout);
        status = take_sprout(growing, g_ptr_array_index(growing->sprouts, i), &at, &size, context,
                             sprout);
    }
    growing->is_regrowing = false;
    growing->asking = NULL;
    status = status == FR_OK && size > 0 ? FR_ERR_DOCUMENT : status;
    if (status == FR_OK) {
        GPtrArray *old = growing->sprouts;
        growing->sprouts = sprouts;
        growing->done = head.done;
        if (growing->lighting != NULL) {
            fr_lighting_set_room(growing->lighting, head.room);
        }
        sprouts = old;
    } else if (status == FR_ERR_DOCUMENT) {
        fr_diags_add(context->diags, FR_ERROR, "damaged-checkpoint", span,
                     "the L-systems of this saved growth do not grow again as they were");
    }
    g_ptr_array_unref(sprouts);
    return status;
}
