// One step on all threads: first every module chooses its production and the result is counted,
// then memory is taken once and each piece is written to its final place. For L-systems in which
// nothing depends on the order of modules; the bits are those of the sequential step.
#include "lsystem/derive.h"

// Words of a piece of work: a quarter of a second-level cache.
#define GRAIN 16384

/// A piece of the string and what becomes of it.
typedef struct Piece {
    uint64_t word, module, word_end;
    uint64_t out_word, out_module;   ///< first counts, then where they begin
    uint64_t out_words, out_modules; ///< sizes
    uint64_t mark;                   ///< first of its marks
    uint64_t marks;
} Piece;

typedef struct Step {
    FrLderivation *derivation;
    const FrLunit *unit;
    const FrLsection *section;
    const FrLstring *from;
    FrLstring *to;
    FrLindex index;
    bool has_index;
    uint16_t *choices;
    Piece *pieces;
    size_t count;
    FrLmark *marks;
    FrLmachine *machines; ///< one a worker
    uint64_t random;      ///< stream A before the step
} Step;

static void count_piece(Step *step, Piece *piece, FrLmachine *machine) {
    FrLmatcher matcher = fr_lmatcher(step->derivation->system, machine, step->unit);
    const uint32_t *words = step->from->words, *end = words + step->from->count;
    uint64_t module = piece->module, out_words = 0, out_modules = 0;
    bool is_random = step->unit->is_stochastic;
    uint64_t random = is_random ? fr_lrandom_skip(step->random, module) : 0;
    for (uint64_t at = piece->word; at < piece->word_end; module++) {
        uint32_t words_here = 1 + fr_lhead_count(words[at]), taken;
        FrLsite site = {&step->index, (uint32_t)module, FR_NONE};
        const FrLproduction *production;
        machine->module = module;
        if (is_random) {
            double draw = fr_lrandom_next(&random);
            production =
                fr_lmatch_random(&matcher, step->section, words + at, end, &site, draw, &taken);
        } else {
            production = fr_lmatch_first(&matcher, step->section, words + at, end, &site, &taken);
        }
        step->choices[module] =
            production == NULL ? 0 : (uint16_t)(production - matcher.productions + 1);
        out_words += production == NULL ? words_here : production->word_count;
        out_modules += production == NULL ? 1 : production->modules;
        at += words_here;
    }
    piece->out_words = out_words;
    piece->out_modules = out_modules;
    piece->marks = out_words / GRAIN + 1;
}

static void write_piece(Step *step, Piece *piece, FrLmachine *machine) {
    FrLmatcher matcher = fr_lmatcher(step->derivation->system, machine, step->unit);
    const uint32_t *words = step->from->words, *end = words + step->from->count;
    uint32_t *out = step->to->words;
    uint64_t module = piece->module, copied = piece->word, next_mark = 0;
    uint64_t to = piece->out_word, to_module = piece->out_module, first = piece->mark;
    piece->marks = 0;
    for (uint64_t at = piece->word; at < piece->word_end; module++) {
        uint64_t position = to + (at - copied);
        if (position - piece->out_word >= next_mark) {
            step->marks[first + piece->marks++] = (FrLmark){position, to_module};
            next_mark = position - piece->out_word + GRAIN;
        }
        uint32_t words_here = 1 + fr_lhead_count(words[at]), choice = step->choices[module];
        to_module++;
        if (choice > 0) {
            const FrLproduction *production = matcher.productions + choice - 1;
            FrLsite site = {&step->index, (uint32_t)module, FR_NONE};
            machine->module = module;
            memcpy(out + to, words + copied, (at - copied) * sizeof *out);
            to = position;
            fr_lmatch_bind(&matcher, production, words + at, end, &site);
            fr_lmatch_produce(&matcher, production, out + to);
            to += production->word_count;
            to_module += production->modules - UINT64_C(1);
            copied = at + words_here;
        }
        at += words_here;
    }
    memcpy(out + to, words + copied, (piece->word_end - copied) * sizeof *out);
}

static void count_pieces(void *data, size_t begin, size_t end, int worker) {
    Step *step = data;
    for (size_t i = begin; i < end; i++) {
        count_piece(step, &step->pieces[i], &step->machines[worker]);
    }
}

static void write_pieces(void *data, size_t begin, size_t end, int worker) {
    Step *step = data;
    for (size_t i = begin; i < end; i++) {
        write_piece(step, &step->pieces[i], &step->machines[worker]);
    }
}

static void cut_pieces(Step *step) {
    const FrLstring *from = step->from;
    size_t marks = from->marks->len;
    step->count = MAX(marks, 1);
    step->pieces = g_new0(Piece, step->count);
    for (size_t i = 0; i < step->count; i++) {
        FrLmark mark = marks == 0 ? (FrLmark){0} : g_array_index(from->marks, FrLmark, i);
        step->pieces[i] = (Piece){.word = mark.word, .module = mark.module};
    }
    for (size_t i = 0; i < step->count; i++) {
        step->pieces[i].word_end = i + 1 < step->count ? step->pieces[i + 1].word : from->count;
    }
}

/// What brings the string beyond so many modules or words: the module whose successor does.
static const FrLproduction *culprit(const Step *step, uint64_t most_modules, uint64_t most_words,
                                    uint64_t *module) {
    const FrLproduction *productions =
        (const FrLproduction *)(const void *)step->derivation->system->productions->data;
    size_t i = 0;
    while (i + 1 < step->count && step->pieces[i + 1].out_module <= most_modules &&
           step->pieces[i + 1].out_word <= most_words) {
        i++;
    }
    const Piece *piece = &step->pieces[i];
    const FrLproduction *production = NULL;
    uint64_t modules = piece->out_module, words = piece->out_word;
    *module = piece->module;
    for (uint64_t at = piece->word; at < piece->word_end; (*module)++) {
        uint32_t choice = step->choices[*module], own = 1 + fr_lhead_count(step->from->words[at]);
        production = choice == 0 ? NULL : productions + choice - 1;
        modules += choice == 0 ? 1 : production->modules;
        words += choice == 0 ? own : production->word_count;
        if (modules > most_modules || words > most_words) {
            break;
        }
        at += own;
    }
    return production;
}

/// Refuses what is too much, with the module that first was.
static FrStatus check(const Step *step, uint64_t modules, uint64_t words,
                      const FrContext *context) {
    uint64_t most_modules = MIN(context->limits.modules, UINT32_MAX - 1), module = 0;
    uint64_t most_bytes = MIN(context->limits.bytes, (uint64_t)UINT32_MAX * 4);
    if (modules <= most_modules && words <= most_bytes / 4) {
        return FR_OK;
    }
    const FrLproduction *production = culprit(step, most_modules, most_bytes / 4, &module);
    FrStatus status = fr_lderive_limit(step->derivation, modules, most_modules, "modules",
                                       production, "the string", module, context);
    return status != FR_OK
               ? status
               : fr_lderive_limit(step->derivation, fr_count_multiply(words, 4), most_bytes,
                                  "bytes", production, "the string", module, context);
}

/// Gives each piece its place; takes the memory if it is allowed.
static FrStatus lay_out(Step *step, const FrContext *context) {
    uint64_t words = 0, modules = 0, marks = 0;
    for (size_t i = 0; i < step->count; i++) {
        Piece *piece = &step->pieces[i];
        piece->out_word = words;
        piece->out_module = modules;
        piece->mark = marks;
        words = fr_count_add(words, piece->out_words);
        modules = fr_count_add(modules, piece->out_modules);
        marks += piece->marks;
    }
    FrStatus status = check(step, modules, words, context);
    if (status != FR_OK) {
        return status;
    }
    if (!fr_lstring_reserve(step->to, words)) {
        fr_diags_add(context->diags, FR_ERROR, "memory", (FrSpan){0},
                     "there is no memory for the string");
        return FR_ERR_MACHINE;
    }
    step->to->count = words;
    step->to->modules = modules;
    step->marks = g_new(FrLmark, marks + 1);
    return FR_OK;
}

static void join_marks(Step *step) {
    g_array_set_size(step->to->marks, 0);
    for (size_t i = 0; i < step->count; i++) {
        const Piece *piece = &step->pieces[i];
        if (piece->out_words > 0) {
            g_array_append_vals(step->to->marks, step->marks + piece->mark, (guint)piece->marks);
        }
    }
}

static void open_machines(Step *step, int threads) {
    const FrLmachine *machine = &step->derivation->machine;
    step->machines = g_new(FrLmachine, (size_t)threads);
    for (int i = 0; i < threads; i++) {
        step->machines[i] = *machine;
        step->machines[i].variables =
            g_memdup2(machine->variables, step->unit->variables * sizeof(double));
        step->machines[i].fault_count = 0;
    }
}

static void close_machines(Step *step, int threads) {
    FrLmachine *machine = &step->derivation->machine;
    for (int i = 0; i < threads; i++) {
        const FrLmachine *worker = &step->machines[i];
        for (uint32_t f = 0; f < worker->fault_count; f++) {
            machine->module = worker->faults[f].module;
            fr_lmachine_fault(machine, worker->faults[f].code, worker->faults[f].place);
        }
        if (worker->is_endless && !machine->is_endless) {
            machine->is_endless = true;
            machine->endless = worker->endless;
        }
        machine->loops = MAX(machine->loops, worker->loops);
        g_free(worker->variables);
    }
    g_free(step->machines);
}

static FrStatus run(Step *step, const FrContext *context) {
    fr_parallel_for(context->pool, step->count, 1, count_pieces, step, context->progress);
    if (fr_progress_is_cancelled(context->progress)) {
        return FR_CANCELLED;
    }
    FrStatus status = lay_out(step, context);
    if (status != FR_OK) {
        return status;
    }
    fr_parallel_for(context->pool, step->count, 1, write_pieces, step, context->progress);
    if (fr_progress_is_cancelled(context->progress)) {
        return FR_CANCELLED;
    }
    join_marks(step);
    return FR_OK;
}

FrStatus fr_lderive_parallel(FrLderivation *derivation, const FrContext *context) {
    FrLinstance *instance = g_ptr_array_index(derivation->instances, 0);
    Step step = {.derivation = derivation,
                 .unit = instance->unit,
                 .section = &instance->unit->sections[FR_LDERIVE],
                 .from = derivation->string,
                 .to = derivation->other,
                 .random = derivation->random};
    int threads = fr_pool_threads(context->pool);
    fr_linstance_enter(derivation, instance);
    step.has_index = step.section->has_context;
    if (step.has_index) {
        fr_lindex_build(&step.index, step.from->words, step.from->count, step.from->modules);
    }
    if (derivation->choices->len < step.from->modules) {
        g_array_set_size(derivation->choices, (guint)step.from->modules);
    }
    step.choices = (uint16_t *)(void *)derivation->choices->data;
    cut_pieces(&step);
    open_machines(&step, threads);
    FrStatus status = run(&step, context);
    close_machines(&step, threads);
    if (status == FR_OK && derivation->machine.is_endless) {
        status = FR_ERR_LIMIT;
    }
    fr_lindex_clear(&step.index);
    g_free(step.pieces);
    g_free(step.marks);
    if (status == FR_OK) {
        derivation->random = step.unit->is_stochastic
                                 ? fr_lrandom_skip(derivation->random, step.from->modules)
                                 : derivation->random;
        derivation->other = derivation->string;
        derivation->string = step.to;
    }
    return status;
}
