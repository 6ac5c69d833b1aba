/// @file keys.h
/// Key frames of numbers: values at ages of a component, as `keys 0,10 5,80 ~ 2`.
#pragma once

#include "studio/model/document.h"

typedef struct StudioKeys {
    GArray *points; ///< double[2]: age in years, value; by age
    char *rest;     ///< what stands behind them: a variance, curves; "" for nothing
} StudioKeys;

/// Reads the keys of a value, or a plain number (NULL points then become none, `*plain` is it; else
/// NAN). False for anything else, as ranges and expressions are.
bool studio_keys_read(const char *text, StudioKeys *keys, double *plain);
void studio_keys_clear(StudioKeys *keys);
/// The text of the value; of the last of its numbers if no key is left, `plain`. Free with
/// g_free().
char *studio_keys_write(const StudioKeys *keys, double plain);
/// The value at an age; there is a key.
double studio_keys_value(const StudioKeys *keys, double age);
/// The key at an age; FR_NONE.
uint32_t studio_keys_find(const StudioKeys *keys, double age);
/// Sets the value at an age: of the key there, or a new one.
void studio_keys_set(StudioKeys *keys, double age, double value);

/// The age of a component is `scale` times the plant's clock plus `offset`, as far as plain numbers
/// say: births and scales that vary count by their first number.
typedef struct StudioClock {
    double scale, offset;
} StudioClock;

StudioClock studio_clock_of(const StudioDocument *document, uint32_t element);
/// What the clock of the plant around an element shows, in years, as the document says.
double studio_clock_shown(const StudioDocument *document, uint32_t element);

/// Whether the numbers of an element may have keys: it is a component.
bool studio_has_keys(const StudioDocument *document, uint32_t element);
/// The ages at which an element has keys, each once, in order. Free with g_array_unref().
GArray *studio_key_ages(const StudioDocument *document, uint32_t element);
/// Moves all keys of an element at an age to another, but not over other keys; calls of the same
/// `key` in a row are one step. `*to` (may be NULL) receives where they have come to.
bool studio_move_keys(StudioDocument *document, uint32_t element, double from, double *to,
                      const char *key);
/// Removes all keys of an element at an age. The last one leaves its value.
bool studio_remove_keys(StudioDocument *document, uint32_t element, double age);
/// Sets a key of an attribute at an age; a plain number becomes one. `value` NAN: what it is there.
/// False if the value is none that can have keys. With `is_drag` calls in a row are one step.
bool studio_set_key(StudioDocument *document, uint32_t element, const char *attribute, double age,
                    double value, bool is_drag);
/// Removes the key of an attribute at an age.
bool studio_remove_key(StudioDocument *document, uint32_t element, const char *attribute,
                       double age);
