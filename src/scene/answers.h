/// @file answers.h
/// What an L-system has been answered, step by step: with that, and its seed, it can be grown again
/// without asking. Private to scene.
#pragma once

#include "frond/lsystem.h"

/// Words: of each step that asked, its number, how many words follow, and the parameters of all
/// queries as they were after the answer.
typedef struct FrAnswers {
    GArray *words; ///< uint32_t
    guint read;    ///< given again so far
} FrAnswers;

FrAnswers fr_answers_new(void);
void fr_answers_clear(FrAnswers *answers);
/// Notes what queries have been answered in a step.
void fr_answers_note(FrAnswers *answers, uint64_t step, const FrLquery *queries, size_t count);
/// Answers queries as they were in that step. False if they are not those that were noted.
bool fr_answers_give(FrAnswers *answers, uint64_t step, const FrLquery *queries, size_t count);
