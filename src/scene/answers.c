/// Answers of an environment, kept and given again.
#include "scene/answers.h"

#include <math.h>
#include <string.h>

FrAnswers fr_answers_new(void) {
    return (FrAnswers){.words = g_array_new(FALSE, FALSE, sizeof(uint32_t))};
}

void fr_answers_clear(FrAnswers *answers) {
    g_clear_pointer(&answers->words, g_array_unref);
}

static uint32_t words_of(const FrLquery *queries, size_t count) {
    uint32_t words = 0;
    for (size_t i = 0; i < count; i++) {
        words += queries[i].count;
    }
    return words;
}

void fr_answers_note(FrAnswers *answers, uint64_t step, const FrLquery *queries, size_t count) {
    const uint32_t head[2] = {(uint32_t)step, words_of(queries, count)};
    g_array_append_vals(answers->words, head, 2);
    for (size_t i = 0; i < count; i++) {
        g_array_append_vals(answers->words, queries[i].parameters, queries[i].count);
    }
}

bool fr_answers_give(FrAnswers *answers, uint64_t step, const FrLquery *queries, size_t count) {
    guint left = answers->words->len - answers->read;
    if (left < 2) {
        return false;
    }
    const uint32_t *words = (const uint32_t *)(const void *)answers->words->data + answers->read;
    uint32_t wanted = words_of(queries, count);
    if (words[0] != (uint32_t)step || words[1] != wanted || left - 2 < wanted) {
        return false;
    }
    words += 2;
    for (size_t i = 0; i < count; i++) {
        for (unsigned k = 0; k < queries[i].count; k++, words++) {
            float told;
            memcpy(&told, words, sizeof told);
            // What nobody answers stays open, which is no number.
            if (!isfinite(told) && memcmp(words, &queries[i].parameters[k], sizeof told) != 0) {
                return false;
            }
            memcpy(&queries[i].parameters[k], words, sizeof told);
        }
    }
    answers->read += 2 + wanted;
    return true;
}
