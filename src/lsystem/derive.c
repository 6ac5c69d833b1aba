// One step of a derivation, module after module: for L-systems whose productions write variables,
// draw numbers, decompose, cut or call other L-systems.
#include "lsystem/derive.h"

#include <math.h>

#define DEEPEST_CALL 100

/// A step at work.
typedef struct Step {
    FrLderivation *derivation;
    const FrContext *context;
    const FrLstring *from;
    FrLstring *to;
    FrLindex index;
    FrLmatcher matcher;
    FrLinstance *instance;
    const FrLsection *section, *decomposition;
    uint32_t depth; ///< of decomposition
    FrLinstance *callers[DEEPEST_CALL];
    uint32_t calls;
    GArray *scratch; ///< uint32_t: successors being decomposed
    uint64_t work;   ///< productions applied
    FrStatus status;
    bool needs_index;
} Step;

static void refuse(Step *step, uint64_t wanted, uint64_t limit, const char *limit_name,
                   const FrLproduction *production) {
    if (step->status == FR_OK) {
        step->status = fr_lderive_limit(step->derivation, MAX(wanted, limit + 1), limit, limit_name,
                                        production, "the string", step->derivation->machine.module,
                                        step->context);
    }
}

/// Room for `words` more words that belong to `modules` modules.
static uint32_t *make_room(Step *step, uint64_t words, uint64_t modules,
                           const FrLproduction *production) {
    FrLstring *to = step->to;
    if (to->modules + modules > step->context->limits.modules) {
        refuse(step, to->modules + modules, step->context->limits.modules, "modules", production);
        return NULL;
    }
    if (to->count + words > to->capacity) {
        uint64_t wanted = MAX(to->count + words, to->capacity + to->capacity / 2);
        uint64_t most = MIN(step->context->limits.bytes, (uint64_t)UINT32_MAX * 4);
        wanted = MIN(wanted, most / 4);
        if (to->count + words > wanted) {
            refuse(step, (to->count + words) * 4, most, "bytes", production);
            return NULL;
        }
        if (!fr_lstring_reserve(to, wanted)) {
            fr_diags_add(step->context->diags, FR_ERROR, "memory",
                         production == NULL ? (FrSpan){0} : production->span,
                         "there is no memory for the string");
            step->status = FR_ERR_MACHINE;
            return NULL;
        }
    }
    uint32_t *room = to->words + to->count;
    to->count += words;
    to->modules += modules;
    return room;
}

static void copy_module(Step *step, const uint32_t *module) {
    uint32_t words = 1 + fr_lhead_count(*module);
    uint32_t *room = make_room(step, words, 1, NULL);
    if (room != NULL) {
        memcpy(room, module, words * sizeof *room);
    }
}

/// Appends modules, each decomposed as far as it goes; `offset` and `count` are in the scratch.
static void decompose(Step *step, guint offset, guint count, const FrLsite *site, uint32_t depth) {
    guint at = offset;
    while (at < offset + count && step->status == FR_OK) {
        const uint32_t *words = (const uint32_t *)(const void *)step->scratch->data;
        uint32_t taken;
        const FrLproduction *production = fr_lmatch_first(
            &step->matcher, step->decomposition, words + at, words + offset + count, site, &taken);
        if (production != NULL && depth >= step->depth) {
            if (step->decomposition->warns && step->depth > 0) {
                fr_lmachine_fault_depth(step->matcher.machine, "decomposition-depth", production);
            }
            production = NULL;
        }
        if (production == NULL) {
            copy_module(step, words + at);
            at += 1 + fr_lhead_count(words[at]);
            continue;
        }
        if (++step->work > step->context->limits.modules) {
            refuse(step, step->work, step->context->limits.modules, "modules", production);
            return;
        }
        step->status = fr_lderive_check_depth(step->derivation, depth + 1, production,
                                              step->derivation->machine.module, step->context);
        if (step->status != FR_OK) {
            return;
        }
        guint begin = step->scratch->len;
        g_array_set_size(step->scratch, begin + production->word_count);
        fr_lmatch_produce(&step->matcher, production,
                          &g_array_index(step->scratch, uint32_t, begin));
        decompose(step, begin, production->word_count, site, depth + 1);
        g_array_set_size(step->scratch, begin);
        at += taken;
    }
}

/// Decomposes the modules at `here`, which no production has rewritten. How many words of the old
/// string that takes; 0 if nothing applies.
static uint32_t decompose_kept(Step *step, const uint32_t *here, FrLsite *site, uint32_t *modules) {
    uint32_t taken;
    site->behind = site->before + 1;
    const FrLproduction *production =
        step->decomposition->list->len == 0
            ? NULL
            : fr_lmatch_first(&step->matcher, step->decomposition, here,
                              step->from->words + step->from->count, site, &taken);
    if (production == NULL || step->depth == 0) {
        return 0;
    }
    g_array_set_size(step->scratch, production->word_count);
    fr_lmatch_produce(&step->matcher, production, (uint32_t *)(void *)step->scratch->data);
    decompose(step, 0, production->word_count, site, 1);
    *modules = production->strict.count;
    return taken;
}

static void apply(Step *step, const FrLproduction *production, const FrLsite *site) {
    if (step->decomposition->list->len > 0) {
        g_array_set_size(step->scratch, production->word_count);
        fr_lmatch_produce(&step->matcher, production, (uint32_t *)(void *)step->scratch->data);
        decompose(step, 0, production->word_count, site, 0);
        return;
    }
    uint32_t *room = make_room(step, production->word_count, production->modules, production);
    if (room != NULL) {
        fr_lmatch_produce(&step->matcher, production, room);
    }
}

// ---- sub-L-systems ----------------------------------------------------------------------------

static void work_in(Step *step, FrLinstance *instance) {
    step->instance = instance;
    fr_linstance_enter(step->derivation, instance);
    step->matcher =
        fr_lmatcher(step->derivation->system, &step->derivation->machine, instance->unit);
    step->section = &instance->unit->sections[FR_LDERIVE];
    step->decomposition = &instance->unit->sections[FR_LDECOMPOSE];
    step->depth = fr_lderive_depth(step->derivation, step->decomposition, step->context);
}

// Variables that belong to the caller are copied in on entry and back on return.
static void exchange(const FrLinstance *caller, FrLinstance *called, bool is_return) {
    const GArray *externals = called->unit->externals;
    for (guint i = 0; i < externals->len; i++) {
        const FrLexternal *external = &g_array_index(externals, FrLexternal, i);
        uint32_t theirs =
            GPOINTER_TO_UINT(g_hash_table_lookup(caller->unit->globals, external->name));
        if (theirs == 0 || theirs - 1 + (uint64_t)external->size > caller->unit->variables) {
            continue;
        }
        double *outer = caller->variables + theirs - 1;
        double *inner = called->variables + external->variable;
        memcpy(is_return ? outer : inner, is_return ? inner : outer,
               external->size * sizeof *outer);
    }
}

static bool is_active(const Step *step, const FrLunit *unit) {
    bool is_found = step->instance->unit == unit;
    for (uint32_t i = 0; i < step->calls; i++) {
        is_found |= step->callers[i]->unit == unit;
    }
    return is_found;
}

/// The instance of a called L-system: that of the module, or a new one.
static FrLinstance *instance_of(Step *step, const FrLunit *unit, uint32_t *number) {
    GPtrArray *instances = step->derivation->instances;
    FrLinstance *instance =
        *number == 0 || *number >= instances->len ? NULL : g_ptr_array_index(instances, *number);
    if (instance == NULL || instance->unit != unit) {
        *number = fr_linstance_new(step->derivation, unit, step->context);
        if (*number == FR_NONE) {
            step->status = FR_ERR_LIMIT;
            return NULL;
        }
        instance = g_ptr_array_index(instances, *number);
    }
    return instance;
}

/// Whether a production calls the L-system, by its label or by one that is computed.
static bool may_call(const FrLsystem *system, uint32_t production, uint32_t id) {
    const FrLproduction *p = &g_array_index(system->productions, FrLproduction, production);
    for (uint32_t at = 0; at < p->word_count;) {
        const uint32_t *here = &g_array_index(system->words, uint32_t, p->words + at);
        if (fr_lhead_calls(*here) && (here[1] == id || here[1] == 0)) {
            return true;
        }
        at += 1 + fr_lhead_count(*here);
    }
    return false;
}

/// Where an L-system writes its calls of another.
static uint32_t place_of_call(const FrLsystem *system, const FrLunit *unit, uint32_t id) {
    for (int s = FR_LDERIVE; s <= FR_LDECOMPOSE; s++) {
        const GArray *list = unit->sections[s].list;
        for (guint i = 0; i < list->len; i++) {
            uint32_t production = g_array_index(list, uint32_t, i);
            if (may_call(system, production, id)) {
                return FR_LPLACE_PRODUCTION | production;
            }
        }
    }
    return FR_LPLACE_AXIOM;
}

/// Enters the L-system that the module `?(id, …)` of the old string calls. `kept` is the module of
/// the new string that goes on with its instance; NULL: the instance ends with this step.
static void call(Step *step, const uint32_t *module, uint32_t *kept) {
    FrLderivation *derivation = step->derivation;
    const FrLunit *unit = fr_lsystem_unit(derivation->system, trunc(fr_lword_float(module[1])));
    if (unit == NULL || is_active(step, unit) || step->calls == DEEPEST_CALL) {
        fr_lmachine_fault(&derivation->machine, unit == NULL ? "unknown-call" : "recursive-call",
                          place_of_call(derivation->system, step->instance->unit, module[1]));
        return;
    }
    uint32_t number = *module >> 16;
    FrLinstance *instance = instance_of(step, unit, &number);
    if (instance == NULL) {
        return;
    }
    if (kept != NULL) {
        *kept = (*kept & FR_LHEAD_KEY) | number << 16;
    }
    instance->was_seen = kept != NULL;
    exchange(step->instance, instance, false);
    step->callers[step->calls++] = step->instance;
    work_in(step, instance);
    if (!instance->has_started) {
        instance->has_started = true;
        fr_linstance_block(derivation, instance, FR_LSTART);
    }
    fr_linstance_block(derivation, instance, FR_LSTART_EACH);
}

static void leave(Step *step) {
    FrLinstance *called = step->instance;
    fr_linstance_block(step->derivation, called, FR_LEND_EACH);
    if ((int64_t)step->derivation->step == step->derivation->length) {
        fr_linstance_block(step->derivation, called, FR_LEND);
    }
    work_in(step, step->callers[--step->calls]);
    exchange(step->instance, called, true);
}

/// The first `?(id, …)` among the words from `at` on; NULL if it calls another L-system.
static uint32_t *find_kept(Step *step, uint64_t at, const uint32_t *module) {
    FrLstring *to = step->to;
    while (at < to->count) {
        uint32_t *here = to->words + at;
        if (fr_lhead_symbol(*here) == '?' && fr_lhead_count(*here) > 0) {
            return here[1] == module[1] ? here : NULL;
        }
        at += 1 + fr_lhead_count(*here);
    }
    return NULL;
}

/// Calls and returns of the modules from `here` to `end`, whose successor begins at word `out`.
static void follow(Step *step, const uint32_t *here, const uint32_t *end, uint64_t out) {
    while (here < end && step->status == FR_OK) {
        unsigned symbol = fr_lhead_symbol(*here), count = fr_lhead_count(*here);
        if (symbol == '?' && count > 0) {
            call(step, here, find_kept(step, out, here));
        } else if (symbol == '$' && step->calls > 0) {
            leave(step);
        }
        here += 1 + count;
    }
}

// ---- the scan ---------------------------------------------------------------------------------

/// Words from a cut to the end of its branch or called L-system (what ends it stays).
static uint64_t cut(const Step *step, uint64_t at, uint64_t *module) {
    const FrLstring *from = step->from;
    uint32_t depth = 1, calls = 1;
    bool is_paper = step->derivation->system->is_paper; // there $ only turns
    for (at += 1, (*module)++; at < from->count; (*module)++) {
        unsigned symbol = fr_lhead_symbol(from->words[at]);
        unsigned count = fr_lhead_count(from->words[at]);
        depth += symbol == '[';
        calls += symbol == '?' && count > 0;
        if ((symbol == ']' && --depth == 0) || (symbol == '$' && !is_paper && --calls == 0) ||
            (symbol == '%' && count > 0)) {
            break;
        }
        at += 1 + count;
    }
    return at;
}

static const FrLproduction *choose(Step *step, const uint32_t *here, const FrLsite *site,
                                   uint32_t *taken) {
    const uint32_t *end = step->from->words + step->from->count;
    if (step->instance->unit->is_stochastic) {
        double draw = fr_lrandom_next(&step->derivation->random);
        return fr_lmatch_random(&step->matcher, step->section, here, end, site, draw, taken);
    }
    return fr_lmatch_first(&step->matcher, step->section, here, end, site, taken);
}

/// Rewrites, decomposes, cuts or copies what stands at `at`; returns where the rest begins.
static uint64_t rewrite(Step *step, uint64_t at, uint64_t *module) {
    const uint32_t *here = step->from->words + at;
    FrLsite site = {step->needs_index ? &step->index : NULL, (uint32_t)*module, FR_NONE};
    uint32_t taken = 0, modules = 1;
    const FrLproduction *production = choose(step, here, &site, &taken);
    if (production != NULL) {
        site.behind = (uint32_t)*module + production->strict.count;
        apply(step, production, &site);
        *module += production->strict.count;
        return at + taken;
    }
    taken = decompose_kept(step, here, &site, &modules);
    if (taken == 0 && (*here & FR_LHEAD_KEY) == fr_lhead('%', 0)) {
        return cut(step, at, module);
    }
    if (taken == 0) {
        copy_module(step, here);
        taken = 1 + fr_lhead_count(*here);
    }
    *module += modules;
    return at + taken;
}

static void scan(Step *step) {
    const FrLstring *from = step->from;
    FrLmachine *machine = &step->derivation->machine;
    bool has_calls = step->derivation->system->units->len > 1;
    uint64_t at = 0, module = 0;
    while (at < from->count && step->status == FR_OK) {
        const uint32_t *here = from->words + at;
        uint64_t out = step->to->count;
        machine->module = module;
        if ((module & 0xFFFF) == 0 && fr_progress_is_cancelled(step->context->progress)) {
            step->status = FR_CANCELLED;
        }
        bool is_cut = (*here & FR_LHEAD_KEY) == fr_lhead('%', 0);
        at = rewrite(step, at, &module);
        if (has_calls && !is_cut) {
            follow(step, here, from->words + at, out);
        }
        if (machine->is_endless) {
            step->status = FR_ERR_LIMIT;
        }
    }
}

static bool any_context(const FrLsystem *system) {
    for (guint u = 0; u < system->units->len; u++) {
        const FrLunit *unit = g_ptr_array_index(system->units, u);
        if (unit->sections[FR_LDERIVE].has_context || unit->sections[FR_LDECOMPOSE].has_context) {
            return true;
        }
    }
    return false;
}

static void end_unseen(FrLderivation *derivation) {
    for (guint i = 1; i < derivation->instances->len; i++) {
        FrLinstance *instance = g_ptr_array_index(derivation->instances, i);
        if (instance != NULL && !instance->was_seen) {
            fr_linstance_enter(derivation, instance);
            fr_linstance_block(derivation, instance, FR_LEND);
            derivation->variables -= instance->unit->variables;
            g_free(instance->variables);
            g_free(instance);
            derivation->instances->pdata[i] = NULL;
            derivation->used = MIN(derivation->used, i);
        }
    }
    fr_linstance_enter(derivation, g_ptr_array_index(derivation->instances, 0));
}

FrStatus fr_lderive_sequential(FrLderivation *derivation, const FrContext *context) {
    Step step = {.derivation = derivation,
                 .context = context,
                 .from = derivation->string,
                 .to = derivation->other,
                 .status = FR_OK,
                 .needs_index = any_context(derivation->system)};
    step.to->count = step.to->modules = 0;
    for (guint i = 1; i < derivation->instances->len; i++) {
        FrLinstance *instance = g_ptr_array_index(derivation->instances, i);
        if (instance != NULL) {
            instance->was_seen = false;
        }
    }
    if (step.needs_index) {
        fr_lindex_build(&step.index, step.from->words, step.from->count, step.from->modules);
    }
    step.scratch = g_array_new(FALSE, FALSE, sizeof(uint32_t));
    work_in(&step, g_ptr_array_index(derivation->instances, 0));
    scan(&step);
    while (step.calls > 0) {
        leave(&step);
    }
    end_unseen(derivation);
    g_array_unref(step.scratch);
    fr_lindex_clear(&step.index);
    if (step.status == FR_OK) {
        g_array_set_size(step.to->marks, 0);
        derivation->other = derivation->string;
        derivation->string = step.to;
    }
    return step.status;
}
