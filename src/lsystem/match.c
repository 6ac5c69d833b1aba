// Matching as cpfg does it. The strict predecessor is read in place, contexts in the old string:
// to the right branches are skipped unless the pattern names them, to the left the way leads from
// a branch into its mother axis.
#include "lsystem/match.h"

#define MOST_CANDIDATES 1000

void fr_lindex_build(FrLindex *index, const uint32_t *words, uint64_t count, uint64_t modules) {
    index->words = words;
    index->modules = (uint32_t)modules;
    index->at = g_new(uint32_t, modules + 1);
    index->partner = g_new(uint32_t, modules + 1);
    uint64_t at = 0;
    uint32_t open = FR_NONE; // a chain through `partner` of the brackets that are open
    for (uint32_t i = 0; i < index->modules; i++) {
        index->at[i] = (uint32_t)at;
        uint32_t symbol = fr_lhead_symbol(words[at]);
        if (symbol == '[') {
            index->partner[i] = open;
            open = i;
        } else if (symbol == ']') {
            uint32_t outer = open == FR_NONE ? FR_NONE : index->partner[open];
            index->partner[i] = open;
            if (open != FR_NONE) {
                index->partner[open] = i;
            }
            open = outer;
        }
        at += 1 + fr_lhead_count(words[at]);
    }
    index->at[index->modules] = (uint32_t)count;
    while (open != FR_NONE) {
        uint32_t outer = index->partner[open];
        index->partner[open] = FR_NONE;
        open = outer;
    }
}

void fr_lindex_clear(FrLindex *index) {
    g_free(index->at);
    g_free(index->partner);
    *index = (FrLindex){0};
}

FrLmatcher fr_lmatcher(const FrLsystem *system, FrLmachine *machine, const FrLunit *unit) {
    return (FrLmatcher){machine, unit,
                        (const FrLproduction *)(const void *)system->productions->data,
                        (const FrLpattern *)(const void *)system->patterns->data,
                        (const FrLformal *)(const void *)system->formals->data};
}

/// Binds the parameters of one module; false if a literal differs.
static bool bind(const FrLmatcher *matcher, const FrLpattern *pattern, const uint32_t *module) {
    unsigned count = fr_lhead_count(pattern->key);
    if (count == 0) {
        return true;
    }
    const FrLformal *formal = matcher->formals + pattern->formal;
    double *variables = matcher->machine->variables;
    for (unsigned i = 0; i < count; i++) {
        float value = fr_lword_float(module[1 + i]);
        if (formal[i].variable != FR_NONE) {
            variables[formal[i].variable] = value;
        } else if (!(formal[i].literal == value)) {
            return false;
        }
    }
    return true;
}

/// Words of the strict predecessor, 0 if it does not match.
static inline uint32_t match_strict(const FrLmatcher *matcher, const FrLproduction *production,
                                    const uint32_t *here, const uint32_t *end) {
    const FrLpattern *pattern = matcher->patterns + production->strict.first;
    const uint32_t *at = here;
    for (uint32_t i = 0; i < production->strict.count; i++) {
        if (at >= end || (*at & FR_LHEAD_KEY) != pattern[i].key ||
            !bind(matcher, &pattern[i], at)) {
            return 0;
        }
        at += 1 + fr_lhead_count(*at);
    }
    return (uint32_t)(at - here);
}

static unsigned symbol_at(const FrLindex *index, uint32_t module) {
    return fr_lhead_symbol(index->words[index->at[module]]);
}

/// The first module from `at` on that closes the level; the end of the string if none does.
static uint32_t level_end(const FrLindex *index, uint32_t at) {
    while (at < index->modules && symbol_at(index, at) != ']') {
        at = symbol_at(index, at) == '[' ? index->partner[at] : at;
        at = at == FR_NONE ? index->modules : at + 1;
    }
    return at;
}

/// The module that a pattern is compared with: branches it does not name are passed over, and what
/// is ignored before them. FR_NONE: there is none. In a ring the end leads to the beginning.
static uint32_t seek_right(const FrLmatcher *matcher, const FrLindex *index, uint32_t at,
                           unsigned wanted) {
    bool may_wrap = matcher->unit->is_ring;
    for (;;) {
        if (at >= index->modules) {
            if (!may_wrap || index->modules == 0) {
                return FR_NONE;
            }
            may_wrap = false;
            at = 0;
        }
        unsigned symbol = symbol_at(index, at);
        if (matcher->unit->is_ignored[symbol]) {
            at++;
        } else if (symbol == '[' && wanted != '[') {
            at = index->partner[at];
            if (at == FR_NONE) {
                return FR_NONE;
            }
            at++;
        } else {
            return at;
        }
    }
}

static bool match_right(const FrLmatcher *matcher, const FrLproduction *production,
                        const FrLindex *index, uint32_t at) {
    const FrLpattern *pattern = matcher->patterns + production->right.first;
    for (uint32_t i = 0; i < production->right.count; i++) {
        unsigned wanted = fr_lhead_symbol(pattern[i].key);
        if (wanted == '=') {
            at = level_end(index, at);
            continue;
        }
        at = seek_right(matcher, index, at, wanted);
        if (at == FR_NONE) {
            return false;
        }
        const uint32_t *module = index->words + index->at[at++];
        if ((*module & FR_LHEAD_KEY) != pattern[i].key || !bind(matcher, &pattern[i], module)) {
            return false;
        }
    }
    return true;
}

static bool match_left(const FrLmatcher *matcher, const FrLproduction *production,
                       const FrLindex *index, uint32_t at) {
    const FrLpattern *pattern = matcher->patterns + production->left.first;
    const bool *is_ignored = matcher->unit->is_ignored;
    for (uint32_t i = production->left.count; i-- > 0;) {
        bool may_wrap = matcher->unit->is_ring;
        for (;;) {
            if (at == 0) {
                if (!may_wrap || index->modules == 0) {
                    return false;
                }
                may_wrap = false;
                at = index->modules;
            }
            unsigned symbol = symbol_at(index, --at);
            if (symbol == ']') {
                at = index->partner[at];
                if (at == FR_NONE) {
                    return false;
                }
            } else if (symbol != '[' && !is_ignored[symbol]) {
                break;
            }
        }
        const uint32_t *module = index->words + index->at[at];
        if ((*module & FR_LHEAD_KEY) != pattern[i].key || !bind(matcher, &pattern[i], module)) {
            return false;
        }
    }
    return true;
}

/// Words of the predecessor if the production applies, else 0.
static uint32_t match(const FrLmatcher *matcher, const FrLproduction *production,
                      const uint32_t *here, const uint32_t *end, const FrLsite *site) {
    uint32_t taken = match_strict(matcher, production, here, end);
    if (taken == 0 || production->is_plain) {
        return taken;
    }
    uint32_t modules = production->strict.count;
    if (production->right.count > 0 &&
        !match_right(matcher, production, site->index,
                     site->behind == FR_NONE ? site->before + modules : site->behind)) {
        return 0;
    }
    if (production->left.count > 0 && !match_left(matcher, production, site->index, site->before)) {
        return 0;
    }
    if (production->before != FR_NONE) {
        fr_lmachine_run(matcher->machine, production->before);
    }
    if (production->condition != FR_NONE &&
        fr_lmachine_run(matcher->machine, production->condition) == 0) {
        return 0;
    }
    return taken;
}

const FrLproduction *fr_lmatch_first(const FrLmatcher *matcher, const FrLsection *section,
                                     const uint32_t *here, const uint32_t *end, const FrLsite *site,
                                     uint32_t *taken) {
    unsigned symbol = fr_lhead_symbol(*here);
    for (uint32_t i = section->start[symbol]; i < section->start[symbol + 1]; i++) {
        const FrLproduction *production = matcher->productions + section->sorted[i];
        *taken = match(matcher, production, here, end, site);
        if (*taken > 0) {
            return production;
        }
    }
    return NULL;
}

// The sums are single precision, as in cpfg; rounding may leave all productions untaken.
const FrLproduction *fr_lmatch_random(const FrLmatcher *matcher, const FrLsection *section,
                                      const uint32_t *here, const uint32_t *end,
                                      const FrLsite *site, double draw, uint32_t *taken) {
    unsigned symbol = fr_lhead_symbol(*here);
    uint32_t found[MOST_CANDIDATES], words[MOST_CANDIDATES], count = 0;
    float weights[MOST_CANDIDATES], total = 0;
    for (uint32_t i = section->start[symbol]; i < section->start[symbol + 1]; i++) {
        const FrLproduction *production = matcher->productions + section->sorted[i];
        uint32_t matched = match(matcher, production, here, end, site);
        if (matched > 0 && count < MOST_CANDIDATES) {
            weights[count] = production->weight == FR_NONE
                                 ? 1
                                 : (float)fr_lmachine_run(matcher->machine, production->weight);
            if (!(weights[count] >= 0)) {
                fr_lmachine_fault(matcher->machine, "negative-weight", production->weight);
            }
            total += weights[count];
            words[count] = matched;
            found[count++] = section->sorted[i];
        }
    }
    float rest = (float)((double)total * draw);
    for (uint32_t i = 0; i < count; i++) {
        rest -= weights[i];
        if (rest <= 0) {
            *taken = words[i];
            return matcher->productions + found[i];
        }
    }
    return NULL;
}

void fr_lmatch_bind(const FrLmatcher *matcher, const FrLproduction *production,
                    const uint32_t *here, const uint32_t *end, const FrLsite *site) {
    match_strict(matcher, production, here, end);
    if (production->right.count > 0) {
        match_right(matcher, production, site->index,
                    site->behind == FR_NONE ? site->before + production->strict.count
                                            : site->behind);
    }
    if (production->left.count > 0) {
        match_left(matcher, production, site->index, site->before);
    }
}

void fr_lmatch_produce(const FrLmatcher *matcher, const FrLproduction *production, uint32_t *out) {
    const FrLsystem *system = matcher->machine->system;
    if (production->after != FR_NONE) {
        fr_lmachine_run(matcher->machine, production->after);
    }
    if (production->word_count == 0) {
        return;
    }
    memcpy(out, &g_array_index(system->words, uint32_t, production->words),
           production->word_count * sizeof *out);
    if (production->values != FR_NONE) {
        matcher->machine->out = out;
        fr_lmachine_run(matcher->machine, production->values);
    }
}
