#include "pgraph/flags.h"

#include <string.h>

enum { MOST_RANGES = 4096, MOST_RESTS = 16 };

// Reads a whole number without sign at *text and moves past it.
static bool read_number(const char **text, uint32_t *number) {
    if (!g_ascii_isdigit(**text)) {
        return false;
    }
    guint64 value = g_ascii_strtoull(*text, (char **)text, 10);
    *number = (uint32_t)MIN(value, UINT32_MAX - 1);
    return true;
}

static bool add_range(FrFlags *flags, uint32_t from, uint32_t to) {
    FrFlagRange range = {from, to};
    if (from > to || flags->ranges->len >= MOST_RANGES) {
        return false;
    }
    g_array_append_val(flags->ranges, range);
    return true;
}

static bool add_rest(FrFlags *flags, uint32_t step, uint32_t rest) {
    FrFlagRest term = {step, rest};
    if (rest >= step || flags->rests->len >= MOST_RESTS) {
        return false;
    }
    g_array_append_val(flags->rests, term);
    return true;
}

static bool add_term(FrFlags *flags, const char *word) {
    uint32_t a, b;
    if (strcmp(word, "all") == 0) {
        return add_range(flags, 0, UINT32_MAX);
    }
    if (strcmp(word, "odd") == 0 || strcmp(word, "even") == 0) {
        return add_rest(flags, 2, word[0] == 'o');
    }
    if (strcmp(word, "first") == 0) {
        return add_range(flags, 0, 0);
    }
    if (strcmp(word, "last") == 0) {
        return flags->has_last = true;
    }
    if (*word == '%') {
        word++;
        return read_number(&word, &a) && *word++ == '=' && read_number(&word, &b) &&
               *word == '\0' && add_rest(flags, a, b);
    }
    if (!read_number(&word, &a)) {
        return false;
    }
    b = a;
    if (strncmp(word, "..", 2) == 0) {
        word += 2;
        if (!read_number(&word, &b)) {
            return false;
        }
    }
    return *word == '\0' && add_range(flags, a, b);
}

static gint compare_ranges(gconstpointer a, gconstpointer b) {
    uint32_t from = ((const FrFlagRange *)a)->from;
    uint32_t other = ((const FrFlagRange *)b)->from;
    return from < other ? -1 : from > other;
}

// Sorts the ranges and joins those that overlap, so that one search answers for all.
static void join_ranges(GArray *ranges) {
    g_array_sort(ranges, compare_ranges);
    guint kept = 0;
    for (guint k = 1; k < ranges->len; k++) {
        FrFlagRange *last = &g_array_index(ranges, FrFlagRange, kept);
        const FrFlagRange *range = &g_array_index(ranges, FrFlagRange, k);
        if (range->from <= last->to) {
            last->to = MAX(last->to, range->to);
        } else {
            g_array_index(ranges, FrFlagRange, ++kept) = *range;
        }
    }
    if (ranges->len > 0) {
        g_array_set_size(ranges, kept + 1);
    }
}

FrStatus fr_flags_parse(FrFlags *flags, const char *text, const char *what, FrSpan span,
                        FrDiags *diags) {
    const char *list = text != NULL ? text : "";
    while (g_ascii_isspace(*list)) {
        list++;
    }
    *flags = (FrFlags){
        .ranges = g_array_new(FALSE, FALSE, sizeof(FrFlagRange)),
        .rests = g_array_new(FALSE, FALSE, sizeof(FrFlagRest)),
        .is_inverted = *list == '!',
    };
    FrStatus status = FR_OK;
    char **words = g_strsplit_set(list + (*list == '!'), ", \t\n\r", -1);
    for (char **word = words; *word != NULL && status == FR_OK; word++) {
        if (**word != '\0' && !add_term(flags, *word)) {
            fr_diags_add(diags, FR_ERROR, "wrong-flags", span,
                         "'%.40s' in the list `only` of '%s' is none of all, odd, even, first, "
                         "last, 2, 0..4, %%3=1",
                         *word, what);
            status = FR_ERR_DOCUMENT;
        }
    }
    g_strfreev(words);
    join_ranges(flags->ranges);
    if (flags->ranges->len == 0 && flags->rests->len == 0 && !flags->has_last) {
        flags->is_inverted = false;
        add_range(flags, 0, UINT32_MAX);
    }
    const FrFlagRange *first = flags->ranges->len > 0 ? (void *)flags->ranges->data : NULL;
    flags->is_all =
        !flags->is_inverted && first != NULL && first->from == 0 && first->to == UINT32_MAX;
    return status;
}

void fr_flags_clear(FrFlags *flags) {
    g_clear_pointer(&flags->ranges, g_array_unref);
    g_clear_pointer(&flags->rests, g_array_unref);
}

static bool in_ranges(const GArray *ranges, uint32_t i) {
    guint low = 0, high = ranges->len;
    while (low < high) { // the first range that does not end before i
        guint middle = (low + high) / 2;
        if (g_array_index(ranges, FrFlagRange, middle).to < i) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low < ranges->len && g_array_index(ranges, FrFlagRange, low).from <= i;
}

bool fr_flags_allow(const FrFlags *flags, uint32_t i, uint32_t n) {
    if (flags->is_all) {
        return true;
    }
    bool is_listed = in_ranges(flags->ranges, i) || (flags->has_last && i + 1 == n);
    for (guint k = 0; k < flags->rests->len && !is_listed; k++) {
        const FrFlagRest *term = &g_array_index(flags->rests, FrFlagRest, k);
        is_listed = i % term->step == term->rest;
    }
    return is_listed != flags->is_inverted;
}

uint32_t fr_flags_count(const FrFlags *flags, uint32_t n) {
    if (flags->is_all) {
        return n;
    }
    uint32_t count = 0;
    for (uint32_t i = 0; i < n; i++) {
        count += fr_flags_allow(flags, i, n);
    }
    return count;
}
