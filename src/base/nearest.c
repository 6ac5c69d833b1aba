// What a misspelt name was meant to be.
// Damerau: A technique for computer detection and correction of spelling errors. CACM 7(3), 1964.
// Levenshtein: Binary codes capable of correcting deletions, insertions and reversals, 1966.
// This is the restricted form, where no part is edited twice ("optimal string alignment").
#include "frond/diag.h"

#include <string.h>

// Longer names are not slips of the finger, and the table's cost stays bounded.
enum { LONGEST_NAME = 64 };

static char fold(char c) {
    return c == '-' ? '_' : g_ascii_tolower(c);
}

static size_t min_size(size_t a, size_t b) {
    return a < b ? a : b;
}

static size_t edit_distance(const char *a, size_t a_size, const char *b, size_t b_size) {
    size_t rows[3][LONGEST_NAME + 1];
    size_t *before_last = rows[0], *last = rows[1], *row = rows[2];
    for (size_t j = 0; j <= b_size; j++) {
        last[j] = j;
    }
    for (size_t i = 1; i <= a_size; i++) {
        row[0] = i;
        for (size_t j = 1; j <= b_size; j++) {
            size_t replaced = last[j - 1] + (fold(a[i - 1]) != fold(b[j - 1]) ? 1 : 0);
            size_t best = min_size(replaced, 1 + min_size(last[j], row[j - 1]));
            if (i > 1 && j > 1 && fold(a[i - 1]) == fold(b[j - 2]) &&
                fold(a[i - 2]) == fold(b[j - 1])) {
                best = min_size(best, before_last[j - 2] + 1);
            }
            row[j] = best;
        }
        size_t *oldest = before_last;
        before_last = last;
        last = row;
        row = oldest;
    }
    return last[b_size];
}

const char *fr_nearest_name(const char *name, const char *const *candidates, size_t count) {
    size_t size = strlen(name);
    if (size == 0 || size > LONGEST_NAME) {
        return NULL;
    }
    const char *best = NULL;
    size_t best_distance = SIZE_MAX;
    for (size_t i = 0; i < count; i++) {
        size_t candidate_size = strlen(candidates[i]);
        if (candidate_size > LONGEST_NAME) {
            continue;
        }
        size_t distance = edit_distance(name, size, candidates[i], candidate_size);
        // A third of the letters may be wrong, and something of the name must be left.
        size_t longest = size > candidate_size ? size : candidate_size;
        bool is_plausible = distance == 0 || (distance <= (longest + 1) / 3 && distance < size);
        if (is_plausible && distance < best_distance) {
            best = candidates[i];
            best_distance = distance;
        }
    }
    return best;
}
