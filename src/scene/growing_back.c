/// Steps back of plants that grow together, and plants that go on in another document. Both derive
/// plants again from what they have been answered.
#include "scene/growing_parts.h"

#include <cglm/struct.h>
#include <string.h>

/// Where one plant is.
typedef struct Place {
    uint64_t step;
    guint words; ///< of answers so far
} Place;

struct FrGrowingMark {
    uint64_t done;
    vec3s room[2]; ///< of the light
    GArray *places;
};

FrGrowingMark *fr_growing_mark(const FrGrowing *growing) {
    FrGrowingMark *mark = g_new0(FrGrowingMark, 1);
    mark->done = growing->done;
    if (growing->lighting != NULL) {
        fr_lighting_room(growing->lighting, mark->room);
    }
    mark->places = g_array_new(FALSE, FALSE, sizeof(Place));
    for (guint i = 0; i < growing->sprouts->len; i++) {
        const FrSprout *sprout = g_ptr_array_index(growing->sprouts, i);
        const Place place = {fr_lderivation_step(sprout->derivation), sprout->answers.words->len};
        g_array_append_val(mark->places, place);
    }
    return mark;
}

void fr_growing_mark_free(FrGrowingMark *mark) {
    if (mark != NULL) {
        g_array_unref(mark->places);
        g_free(mark);
    }
}

/// Derives a plant anew by the first answers of `from`. False, and nothing has changed, if it does
/// not come to that step by them.
static bool go_to(FrGrowing *growing, FrSprout *sprout, const FrAnswers *from, const Place *place,
                  const FrContext *context) {
    FR_ASSERT(place->words <= from->words->len);
    FrSprout made = *sprout;
    made.derivation = NULL;
    made.ahead = NULL;
    made.answers = fr_answers_new();
    g_array_append_vals(made.answers.words, from->words->data, place->words);
    growing->is_regrowing = true;
    FrStatus status = fr_growing_regrow(growing, &made, place->step, NULL, context);
    growing->is_regrowing = false;
    growing->asking = NULL;
    FrSprout *dropped = status == FR_OK ? sprout : &made;
    fr_lderivation_free(dropped->derivation);
    fr_answers_clear(&dropped->answers);
    if (status == FR_OK) {
        fr_plant_free(sprout->ahead);
        *sprout = made;
    }
    return status == FR_OK;
}

void fr_growing_return(FrGrowing *growing, const FrGrowingMark *mark, const FrContext *context) {
    for (guint i = 0; i < growing->sprouts->len; i++) {
        FrSprout *sprout = g_ptr_array_index(growing->sprouts, i);
        const Place *place = &g_array_index(mark->places, Place, i);
        if (fr_lderivation_step(sprout->derivation) != place->step ||
            sprout->answers.words->len != place->words) {
            bool is_there = go_to(growing, sprout, &sprout->answers, place, context);
            FR_ASSERT(is_there);
        }
    }
    growing->done = mark->done;
    if (growing->lighting != NULL) {
        fr_lighting_set_room(growing->lighting, mark->room);
    }
}

// ---- another document -------------------------------------------------------------------------

/// True for the same plant at the same place.
static bool is_same(const FrSprout *a, const FrSprout *b) {
    return strcmp(a->id, b->id) == 0 && a->seed == b->seed &&
           memcmp(a->stand.at, b->stand.at, sizeof a->stand.at) == 0 &&
           a->stand.turn == b->stand.turn && a->stand.scale == b->stand.scale;
}

/// Where the old plant stands among the others; FR_NONE if there is none, or it is taken.
static uint32_t find_old(const FrGrowing *old, const FrSprout *sprout, uint8_t *is_taken) {
    for (guint i = 0; i < old->sprouts->len; i++) {
        if (!is_taken[i] && is_same(g_ptr_array_index(old->sprouts, i), sprout)) {
            is_taken[i] = true;
            return i;
        }
    }
    return FR_NONE;
}

/// Lets a plant go on from the old one. False if it is another L-system by now.
static bool go_on(FrGrowing *growing, FrSprout *sprout, const FrSprout *old,
                  const FrContext *context) {
    const Place place = {fr_lderivation_step(old->derivation), old->answers.words->len};
    return place.step <= fr_lderivation_length(sprout->derivation) &&
           go_to(growing, sprout, &old->answers, &place, context) &&
           fr_lstring_digest(fr_lderivation_string(sprout->derivation)) ==
               fr_lstring_digest(fr_lderivation_string(old->derivation));
}

/// Widens what suns shine on to what they have shone on.
static void keep_room(FrLighting *lighting, const FrLighting *old) {
    vec3s room[2], before[2];
    fr_lighting_room(lighting, room);
    fr_lighting_room(old, before);
    room[0] = glms_vec3_minv(room[0], before[0]);
    room[1] = glms_vec3_maxv(room[1], before[1]);
    fr_lighting_set_room(lighting, room);
}

uint32_t *fr_growing_inherit(FrGrowing *growing, const FrGrowing *old, const FrContext *context) {
    FrContext silent = *context;
    silent.diags = NULL;
    uint8_t *is_taken = g_new0(uint8_t, old->sprouts->len + 1);
    uint32_t *origins = g_new(uint32_t, growing->sprouts->len + 1);
    static const Place axiom = {0, 0};
    for (guint i = 0; i < growing->sprouts->len; i++) {
        FrSprout *sprout = g_ptr_array_index(growing->sprouts, i);
        origins[i] = find_old(old, sprout, is_taken);
        if (origins[i] != FR_NONE &&
            !go_on(growing, sprout, g_ptr_array_index(old->sprouts, origins[i]), &silent)) {
            origins[i] = FR_NONE;
            bool is_there = go_to(growing, sprout, &sprout->answers, &axiom, &silent);
            FR_ASSERT(is_there);
        }
    }
    growing->done = old->done;
    if (growing->lighting != NULL && old->lighting != NULL) {
        keep_room(growing->lighting, old->lighting);
    }
    g_free(is_taken);
    return origins;
}

void fr_growing_mark_inherit(FrGrowingMark *mark, const FrGrowing *growing,
                             const uint32_t *origins) {
    GArray *places = g_array_new(FALSE, TRUE, sizeof(Place));
    g_array_set_size(places, growing->sprouts->len);
    for (guint i = 0; i < growing->sprouts->len; i++) {
        if (origins[i] != FR_NONE) {
            g_array_index(places, Place, i) = g_array_index(mark->places, Place, origins[i]);
        }
    }
    g_array_unref(mark->places);
    mark->places = places;
    if (growing->lighting != NULL) {
        fr_lighting_room(growing->lighting, mark->room);
    }
}
