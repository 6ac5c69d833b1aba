// Interpretation: homomorphism module after module, then the turtle. The string is only read.
#include "lsystem/build.h"

#include <math.h>

#define DEEPEST 4096

typedef struct Reading {
    FrLderivation *derivation;
    const FrContext *context;
    FrLmatcher matcher;
    const FrLsection *section;
    FrLindex index;
    uint32_t depth;
    FrLtake take;
    const bool *is_raw;
    void *data;
    GArray *scratch; ///< uint32_t
    uint64_t work;
    uint64_t origin;
    bool goes_on;
    FrStatus status;
    FrLinstance *callers[100];
    uint32_t calls;
} Reading;

static void work_in(Reading *reading, FrLinstance *instance) {
    fr_linstance_enter(reading->derivation, instance);
    reading->matcher =
        fr_lmatcher(reading->derivation->system, &reading->derivation->machine, instance->unit);
    reading->section = &instance->unit->sections[FR_LHOMOMORPHISM];
    reading->depth = 1;
    if (reading->section->depth != FR_NONE) {
        double depth = fr_lmachine_run(&reading->derivation->machine, reading->section->depth);
        reading->depth =
            (uint32_t)CLAMP(depth, 0, (double)MIN(reading->context->limits.depth, DEEPEST));
    }
}

static void give(Reading *reading, const uint32_t *module) {
    reading->goes_on = reading->take(reading->data, module, reading->origin);
}

/// Replaces the modules in the scratch and gives what remains to the turtle.
static void replace(Reading *reading, guint offset, guint count, const FrLsite *site,
                    uint32_t depth) {
    for (guint at = offset; at < offset + count && reading->goes_on;) {
        const uint32_t *words = (const uint32_t *)(const void *)reading->scratch->data;
        uint32_t own = 1 + fr_lhead_count(words[at]), taken;
        const FrLproduction *production =
            *reading->is_raw ? NULL
                             : fr_lmatch_first(&reading->matcher, reading->section, words + at,
                                               words + offset + count, site, &taken);
        if (production != NULL && depth >= reading->depth) {
            if (reading->section->warns) {
                fr_lmachine_fault(reading->matcher.machine, "homomorphism-depth",
                                  production->values == FR_NONE ? 0 : production->values);
            }
            production = NULL;
        }
        if (production == NULL) {
            bool is_cut = words[at] == fr_lhead('%', 0); // made here, it means nothing
            if (!is_cut || *reading->is_raw) {
                give(reading, words + at);
            }
            at += own;
            continue;
        }
        if (++reading->work > reading->context->limits.modules) {
            reading->status =
                fr_limit_check(reading->work, reading->context->limits.modules, "modules",
                               production->name, production->span, reading->context->diags);
            reading->goes_on = false;
            return;
        }
        guint begin = reading->scratch->len;
        g_array_set_size(reading->scratch, begin + production->word_count);
        fr_lmatch_produce(&reading->matcher, production,
                          &g_array_index(reading->scratch, uint32_t, begin));
        replace(reading, begin, production->word_count, site, depth + 1);
        g_array_set_size(reading->scratch, begin);
        at += taken;
    }
}

/// Enters or leaves a called L-system, whose homomorphism holds within.
static void follow_call(Reading *reading, const uint32_t *here) {
    unsigned symbol = fr_lhead_symbol(*here), count = fr_lhead_count(*here);
    FrLderivation *derivation = reading->derivation;
    if (symbol == '$' && reading->calls > 0) {
        work_in(reading, reading->callers[--reading->calls]);
        return;
    }
    uint32_t number = *here >> 16;
    if (symbol != '?' || count < 1 || count > 2 || number == 0 ||
        number >= derivation->instances->len || reading->calls == G_N_ELEMENTS(reading->callers)) {
        return;
    }
    FrLinstance *called = g_ptr_array_index(derivation->instances, number);
    if (called != NULL) {
        FrLinstance *caller = g_ptr_array_index(derivation->instances, 0);
        for (guint i = 0; i < derivation->instances->len; i++) {
            FrLinstance *instance = g_ptr_array_index(derivation->instances, i);
            caller =
                instance != NULL && instance->unit == reading->matcher.unit ? instance : caller;
        }
        reading->callers[reading->calls++] = caller;
        work_in(reading, called);
    }
}

static void read_string(Reading *reading) {
    const FrLstring *string = reading->derivation->string;
    const uint32_t *end = string->words + string->count;
    uint64_t module = 0;
    bool has_calls = reading->derivation->system->units->len > 1;
    for (uint64_t at = 0; at < string->count && reading->goes_on;) {
        const uint32_t *here = string->words + at;
        uint32_t own = 1 + fr_lhead_count(*here), taken;
        reading->origin = module;
        reading->matcher.machine->module = module;
        if ((module & 0xFFFF) == 0 && fr_progress_is_cancelled(reading->context->progress)) {
            reading->status = FR_CANCELLED;
            return;
        }
        if (has_calls) {
            follow_call(reading, here);
        }
        FrLsite site = {&reading->index, (uint32_t)module, FR_NONE};
        const FrLproduction *production =
            reading->section->list->len == 0 || *reading->is_raw || reading->depth == 0
                ? NULL
                : fr_lmatch_first(&reading->matcher, reading->section, here, end, &site, &taken);
        if (production == NULL) {
            give(reading, here);
            at += own;
            module++;
            continue;
        }
        site.behind = (uint32_t)module + production->strict.count;
        g_array_set_size(reading->scratch, production->word_count);
        fr_lmatch_produce(&reading->matcher, production,
                          (uint32_t *)(void *)reading->scratch->data);
        replace(reading, 0, production->word_count, &site, 1);
        at += taken;
        module += production->strict.count;
    }
}

static bool any_context(const FrLsystem *system) {
    for (guint u = 0; u < system->units->len; u++) {
        const FrLunit *unit = g_ptr_array_index(system->units, u);
        if (unit->sections[FR_LHOMOMORPHISM].has_context) {
            return true;
        }
    }
    return false;
}

FrStatus fr_lderive_interpret(FrLderivation *derivation, FrLtake take, const bool *raw, void *data,
                              const FrContext *context) {
    static const bool never = false;
    Reading reading = {.derivation = derivation,
                       .context = context,
                       .take = take,
                       .is_raw = raw == NULL ? &never : raw,
                       .data = data,
                       .goes_on = true,
                       .status = FR_OK,
                       .scratch = g_array_new(FALSE, FALSE, sizeof(uint32_t))};
    FrLmachine *machine = &derivation->machine;
    FrLinstance *instance = g_ptr_array_index(derivation->instances, 0);
    FrLrandom kept = machine->random;
    machine->loops = 0;
    work_in(&reading, instance);
    uint32_t seed = reading.section->seed;
    if (seed != FR_NONE) {
        double value = fr_lmachine_run(machine, seed);
        machine->random = (FrLrandom){
            .state = fr_lrandom_seed_b(isfinite(value) ? (int64_t)CLAMP(value, -9e18, 9e18) : 0),
            .is_seeded = true};
    }
    if (any_context(derivation->system)) {
        fr_lindex_build(&reading.index, derivation->string->words, derivation->string->count,
                        derivation->string->modules);
    }
    read_string(&reading);
    fr_lindex_clear(&reading.index);
    g_array_unref(reading.scratch);
    machine->random = seed != FR_NONE ? kept : machine->random;
    fr_linstance_enter(derivation, instance);
    fr_lderive_report(derivation, machine, context);
    FrStatus checked = fr_lderive_check(derivation, context);
    return MAX(reading.status, checked);
}

// ---- what it is used for ----------------------------------------------------------------------

typedef struct Copy {
    FrLstring *to;
    const FrContext *context;
    FrStatus status;
} Copy;

static bool copy_module(void *data, const uint32_t *module, uint64_t origin) {
    (void)origin;
    Copy *copy = data;
    FrLstring *to = copy->to;
    uint32_t words = 1 + fr_lhead_count(*module);
    copy->status = fr_limit_check(to->modules + 1, copy->context->limits.modules, "modules",
                                  "the homomorphism", (FrSpan){0}, copy->context->diags);
    if (copy->status == FR_OK && to->count + words > to->capacity &&
        !fr_lstring_reserve(to, MAX(1024, 2 * to->capacity + words))) {
        copy->status = FR_ERR_MACHINE;
    }
    if (copy->status != FR_OK) {
        return false;
    }
    memcpy(to->words + to->count, module, words * sizeof *module);
    to->count += words;
    to->modules++;
    return true;
}

FrStatus fr_lderivation_homomorphism(FrLderivation *derivation, const FrContext *context,
                                     FrLstring **string) {
    Copy copy = {fr_lstring_new(), context, FR_OK};
    FrStatus status = fr_lderive_interpret(derivation, copy_module, NULL, &copy, context);
    status = MAX(status, copy.status);
    *string = status == FR_OK ? copy.to : NULL;
    if (status != FR_OK) {
        fr_lstring_free(copy.to);
    }
    return status;
}

static bool take_module(void *data, const uint32_t *module, uint64_t origin) {
    return fr_lturtle_take(data, module, origin);
}

FrStatus fr_lderivation_plant(FrLderivation *derivation, const FrContext *context, FrPlant **plant,
                              FrLdrawn *drawn) {
    *plant = NULL;
    FrStatus status = fr_lderivation_ask(derivation, context);
    if (status != FR_OK) {
        return status;
    }
    FrLbuilder *builder = fr_lbuilder_new(derivation, context);
    FrLturtle turtle;
    fr_lturtle_init(&turtle, derivation, builder, context);
    status = fr_lderive_interpret(derivation, take_module, &turtle.is_raw, &turtle, context);
    fr_lturtle_close_segment(&turtle);
    status = MAX(status, MAX(turtle.status, builder->status));
    builder->drawn.modules = turtle.modules;
    if (drawn != NULL) {
        *drawn = builder->drawn;
    }
    if (status == FR_OK) {
        *plant = fr_lbuilder_end(builder);
    }
    fr_lturtle_clear(&turtle);
    fr_lbuilder_free(builder);
    return status;
}
