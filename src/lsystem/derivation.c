// A derivation from its axiom on: instances, blocks, the choice between sequential and parallel
// steps, and what went wrong told with places.
#include "lsystem/derive.h"

#include "lsystem/ask.h"
#include "lsystem/scan.h"

#include <math.h>

#define MOST_INSTANCES 65535
#define MOST_VARIABLES 64000000
#define DEEPEST 4096 // replacements within each other

FrLsettings fr_lsettings_default(void) {
    return (FrLsettings){.seed = -1, .steps = -1, .unit = 1};
}

const FrLunit *fr_lsystem_unit(const FrLsystem *system, double id) {
    for (guint u = 0; u < system->units->len; u++) {
        const FrLunit *unit = g_ptr_array_index(system->units, u);
        if ((double)unit->id == id) {
            return unit;
        }
    }
    return NULL;
}

// ---- instances --------------------------------------------------------------------------------

/// The state that a seed from outside begins with. The streams of files know 16 or 32 bits of a
/// seed; of larger ones every bit counts.
static uint64_t seed_of(const FrLderivation *derivation, uint64_t plain) {
    uint64_t seed = (uint64_t)derivation->settings.seed;
    return seed <= 0xFFFF ? plain : fr_key_root(seed) & ((UINT64_C(1) << 48) - 1);
}

uint32_t fr_linstance_new(FrLderivation *derivation, const FrLunit *unit,
                          const FrContext *context) {
    GPtrArray *instances = derivation->instances;
    guint slot = MIN(MAX(derivation->used, 1), instances->len);
    while (slot < instances->len && g_ptr_array_index(instances, slot) != NULL) {
        slot++;
    }
    derivation->used = slot;
    uint64_t variables = derivation->variables + unit->variables;
    if (slot > MOST_INSTANCES || variables > MOST_VARIABLES) {
        FrStatus status =
            fr_limit_check(slot > MOST_INSTANCES ? slot : variables,
                           slot > MOST_INSTANCES ? MOST_INSTANCES : MOST_VARIABLES, "calls",
                           "calling L-systems", unit->axiom_span, context->diags);
        return status == FR_OK ? 0 : FR_NONE;
    }
    FrLinstance *instance = g_new0(FrLinstance, 1);
    instance->unit = unit;
    instance->variables = g_new0(double, unit->variables);
    for (guint i = 0; i < derivation->system->values->len; i++) {
        instance->variables[FR_LVAR_FIRST + i] = derivation->settings.values[i];
    }
    derivation->variables = variables;
    if (slot == instances->len) {
        g_ptr_array_add(instances, instance);
    } else {
        instances->pdata[slot] = instance;
    }
    fr_linstance_enter(derivation, instance);
    for (guint i = 0; i < unit->initializers->len; i++) {
        fr_lmachine_run(&derivation->machine, g_array_index(unit->initializers, uint32_t, i));
    }
    return slot;
}

void fr_linstance_enter(FrLderivation *derivation, FrLinstance *instance) {
    derivation->machine.variables = instance->variables;
    instance->variables[FR_LVAR_Q] = (double)derivation->step;
    instance->variables[FR_LVAR_Z] = (double)derivation->length;
    derivation->machine.length = (uint64_t)derivation->length;
}

void fr_linstance_block(FrLderivation *derivation, FrLinstance *instance, int block) {
    if (instance->unit->blocks[block] != FR_NONE) {
        fr_lmachine_run(&derivation->machine, instance->unit->blocks[block]);
    }
}

// ---- faults -----------------------------------------------------------------------------------

static const char *fault_text(const char *code) {
    if (strcmp(code, "division-by-zero") == 0) {
        return "division by zero; the divisor is taken as 1";
    }
    if (strcmp(code, "index-range") == 0) {
        return "an index is out of range; the nearest element is taken";
    }
    if (strcmp(code, "recursive-call") == 0) {
        return "an L-system cannot call itself, nor more than 100 one another";
    }
    if (strcmp(code, "unknown-call") == 0) {
        return "there is no L-system of that label; the call does nothing";
    }
    if (strcmp(code, "missing-file") == 0) {
        return "this file is not there, beside the L-system; nothing is read";
    }
    if (strcmp(code, "negative-length") == 0) {
        return "a derivation length is not negative; it stays as it is";
    }
    if (strcmp(code, "left-out") == 0) {
        return "files are read but not written";
    }
    if (strcmp(code, "no-number") == 0) {
        return "this parameter is infinite or no number";
    }
    if (strcmp(code, "negative-weight") == 0) {
        return "this weight is negative or no number, so that the chances of all are wrong";
    }
    return "a module could be decomposed or replaced further, but 'maximum depth' is reached";
}

static FrSpan place_span(const FrLsystem *system, uint32_t place) {
    uint32_t production = place ^ FR_LPLACE_PRODUCTION;
    if (place == FR_LPLACE_AXIOM) {
        return ((const FrLunit *)g_ptr_array_index(system->units, 0))->axiom_span;
    }
    if (production < system->productions->len) {
        return g_array_index(system->productions, FrLproduction, production).span;
    }
    if (place >= system->places->len) {
        return (FrSpan){0};
    }
    size_t at = g_array_index(system->places, uint32_t, place);
    return fr_ltext_span(system->text, at, at + 1);
}

void fr_lderive_report(FrLderivation *derivation, FrLmachine *machine, const FrContext *context) {
    const FrLsystem *system = derivation->system;
    for (uint32_t i = 0; i < machine->fault_count; i++) {
        const FrLfault *fault = &machine->faults[i];
        if (!g_hash_table_add(derivation->told, GUINT_TO_POINTER(fault->place + 1))) {
            continue;
        }
        fr_diags_add(context->diags, FR_WARNING, fault->code, place_span(system, fault->place),
                     "%s (step %" G_GUINT64_FORMAT ", module %" G_GUINT64_FORMAT ")",
                     fault_text(fault->code), derivation->step, fault->module + 1);
    }
    machine->fault_count = 0;
}

FrStatus fr_lderive_check(FrLderivation *derivation, const FrContext *context) {
    FrLmachine *machine = &derivation->machine;
    if (!machine->is_endless) {
        return FR_OK;
    }
    machine->is_endless = false;
    char *who = g_strdup_printf("the loop at step %" G_GUINT64_FORMAT ", module %" G_GUINT64_FORMAT,
                                derivation->step, machine->endless.module + 1);
    FrStatus status =
        fr_limit_check(machine->loops, machine->most_loops, "iterations", who,
                       place_span(derivation->system, machine->endless.place), context->diags);
    g_free(who);
    return status;
}

FrStatus fr_lderive_limit(const FrLderivation *derivation, uint64_t wanted, uint64_t limit,
                          const char *limit_name, const FrLproduction *production, const char *what,
                          uint64_t module, const FrContext *context) {
    if (wanted <= limit) {
        return FR_OK;
    }
    char *who =
        g_strdup_printf("%s (step %" G_GUINT64_FORMAT ", module %" G_GUINT64_FORMAT ")",
                        production == NULL ? what : production->name, derivation->step, module + 1);
    FrSpan span =
        production == NULL ? place_span(derivation->system, FR_LPLACE_AXIOM) : production->span;
    FrStatus status = fr_limit_check(wanted, limit, limit_name, who, span, context->diags);
    g_free(who);
    return status;
}

const FrLproduction *fr_lderive_maker(const FrLderivation *derivation, uint32_t mark) {
    const GArray *productions = derivation->system->productions;
    return mark == 0 || mark > productions->len
               ? NULL
               : &g_array_index(productions, FrLproduction, mark - 1);
}

const char *fr_lderivation_maker(const FrLderivation *derivation, uint16_t mark, FrSpan *span) {
    const FrLproduction *production = fr_lderive_maker(derivation, mark);
    const FrLunit *unit = g_ptr_array_index(derivation->system->units, 0);
    *span = production == NULL ? unit->axiom_span : production->span;
    return production == NULL ? NULL : production->name;
}

static bool find_origin(const FrLderivation *derivation, const GArray *origins, uint32_t index,
                        FrLorigin *origin) {
    if (origins == NULL || index >= origins->len) {
        return false;
    }
    uint64_t kept = g_array_index(origins, uint64_t, index);
    origin->module = kept >> 16;
    origin->production = fr_lderivation_maker(derivation, kept & 0xFFFF, &origin->span);
    return true;
}

bool fr_lderivation_origin(const FrLderivation *derivation, uint32_t node, FrLorigin *origin) {
    return find_origin(derivation, derivation->origins, node, origin);
}

bool fr_lderivation_organ_origin(const FrLderivation *derivation, uint32_t organ,
                                 FrLorigin *origin) {
    return find_origin(derivation, derivation->organ_origins, organ, origin);
}

uint32_t fr_lderive_depth(FrLderivation *derivation, const FrLsection *section,
                          const FrContext *context) {
    if (section->depth == FR_NONE) {
        return 1;
    }
    double wanted = fr_lmachine_run(&derivation->machine, section->depth);
    return (uint32_t)CLAMP(wanted, 0, (double)MIN(context->limits.depth, DEEPEST) + 1);
}

FrStatus fr_lderive_check_depth(const FrLderivation *derivation, uint32_t depth,
                                const FrLproduction *production, uint64_t module,
                                const FrContext *context) {
    return fr_lderive_limit(derivation, depth, MIN(context->limits.depth, DEEPEST), "depth",
                            production, NULL, module, context);
}

// ---- beginning --------------------------------------------------------------------------------

// Whether the modules of a step may be rewritten in any order.
static bool can_be_parallel(const FrLsystem *system) {
    const FrLunit *unit = g_ptr_array_index(system->units, 0);
    if (system->units->len > 1 || system->has_cut || unit->sections[FR_LDECOMPOSE].list->len > 0) {
        return false;
    }
    const GArray *list = unit->sections[FR_LDERIVE].list;
    for (guint i = 0; i < list->len; i++) {
        const FrLproduction *production =
            &g_array_index(system->productions, FrLproduction, g_array_index(list, uint32_t, i));
        if (!production->is_pure || production->strict.count != 1) {
            return false;
        }
    }
    return true;
}

static FrStatus make_axiom(FrLderivation *derivation, const FrContext *context) {
    const FrLsystem *system = derivation->system;
    const FrLunit *unit = g_ptr_array_index(system->units, 0);
    FrLstring *string = derivation->string;
    FrStatus status = fr_limit_check(unit->axiom_modules, context->limits.modules, "modules",
                                     "the axiom", unit->axiom_span, context->diags);
    if (status != FR_OK) {
        return status;
    }
    if (!fr_lstring_reserve(string, unit->axiom_words + 1)) {
        return FR_ERR_MACHINE;
    }
    if (unit->axiom_words > 0) {
        memcpy(string->words, &g_array_index(system->words, uint32_t, unit->axiom),
               unit->axiom_words * sizeof *string->words);
    }
    string->count = unit->axiom_words;
    string->modules = unit->axiom_modules;
    if (unit->axiom_values != FR_NONE) {
        derivation->machine.out = string->words;
        fr_lmachine_run(&derivation->machine, unit->axiom_values);
    }
    return FR_OK;
}

/// Starts stream A; only the main L-system's seed counts.
static void seed_choice(FrLderivation *derivation, const FrLunit *unit) {
    double seed =
        unit->seed == FR_NONE ? 0 : trunc(fr_lmachine_run(&derivation->machine, unit->seed));
    bool is_given = unit->is_stochastic && derivation->settings.seed >= 0;
    derivation->random =
        is_given ? seed_of(derivation, fr_lrandom_seed_a(derivation->settings.seed))
                 : fr_lrandom_seed_a(isfinite(seed) ? (int64_t)CLAMP(seed, -9e18, 9e18) : 0);
}

static FrStatus check_length(const FrLderivation *derivation, const FrLunit *unit,
                             const FrContext *context) {
    // Beyond 10^15 bits may have been lost.
    uint64_t wanted =
        derivation->length > 1000000000000000 ? UINT64_MAX : (uint64_t)derivation->length;
    return fr_limit_check(wanted, context->limits.steps, "steps", "the derivation length",
                          place_span(derivation->system, unit->length), context->diags);
}

/// The derivation length of the text or the settings.
static void find_length(FrLderivation *derivation, const FrLunit *unit, const FrContext *context) {
    double length =
        unit->length == FR_NONE ? 0 : fr_lmachine_run(&derivation->machine, unit->length);
    derivation->length = length >= 0 ? (int64_t)MIN(length, 9e15) : 0;
    if (derivation->settings.steps >= 0) {
        derivation->length = derivation->settings.steps;
    } else if (!(length >= 0)) {
        fr_diags_add(context->diags, FR_WARNING, "negative-length",
                     place_span(derivation->system, unit->length),
                     "the derivation length is %s; no step is done",
                     isnan(length) ? "no number" : "negative");
    }
}

static FrStatus begin(FrLderivation *derivation, const FrContext *context) {
    const FrLunit *unit = g_ptr_array_index(derivation->system->units, 0);
    FrLmachine *machine = &derivation->machine;
    if (fr_linstance_new(derivation, unit, context) == FR_NONE) {
        return FR_ERR_LIMIT;
    }
    FrLinstance *instance = g_ptr_array_index(derivation->instances, 0);
    seed_choice(derivation, unit);
    find_length(derivation, unit, context);
    fr_linstance_enter(derivation, instance);
    machine->set_length = derivation->settings.steps < 0 ? &derivation->length : NULL;
    instance->has_started = instance->was_seen = true;
    fr_linstance_block(derivation, instance, FR_LSTART);
    fr_linstance_enter(derivation, instance);
    FrStatus status = check_length(derivation, unit, context);
    status = status == FR_OK ? make_axiom(derivation, context) : status;
    fr_lderive_report(derivation, machine, context);
    FrStatus checked = fr_lderive_check(derivation, context);
    return MAX(status, checked);
}

static void file_free(void *file) {
    fr_lfile_free(file);
}

FrStatus fr_lderivation_new(const FrLsystem *system, const FrLsettings *settings,
                            const FrContext *context, FrLderivation **out) {
    *out = NULL;
    FrLderivation *derivation = g_new0(FrLderivation, 1);
    derivation->system = system;
    derivation->settings = settings == NULL ? fr_lsettings_default() : *settings;
    if (derivation->settings.values == NULL) {
        derivation->settings.values = (const double *)(const void *)system->values->data;
    }
    derivation->settings.values =
        g_memdup2(derivation->settings.values, system->values->len * sizeof(double));
    derivation->default_view = derivation->settings.view == NULL ? fr_lview_new() : NULL;
    derivation->view =
        derivation->settings.view == NULL ? derivation->default_view : derivation->settings.view;
    derivation->string = fr_lstring_new();
    derivation->other = fr_lstring_new();
    derivation->instances = g_ptr_array_new();
    derivation->choices = g_array_new(FALSE, FALSE, sizeof(uint16_t));
    derivation->told = g_hash_table_new(NULL, NULL);
    derivation->files = g_ptr_array_new_with_free_func(file_free);
    derivation->is_parallel = can_be_parallel(system);
    derivation->machine = (FrLmachine){.system = system,
                                       .view = derivation->view,
                                       .files = derivation->files,
                                       .random = {.state = FR_LSTREAM_START},
                                       .most_loops = context->limits.iterations,
                                       .print = derivation->settings.print,
                                       .print_user = derivation->settings.print_user};
    if (derivation->settings.seed >= 0) {
        uint64_t state = fr_lrandom_seed_b(derivation->settings.seed);
        derivation->machine.random =
            (FrLrandom){.state = seed_of(derivation, state), .is_seeded = true};
    }
    FrStatus status = begin(derivation, context);
    if (status != FR_OK) {
        fr_lderivation_free(derivation);
        return status;
    }
    *out = derivation;
    return FR_OK;
}

void fr_lderivation_free(FrLderivation *derivation) {
    if (derivation == NULL) {
        return;
    }
    for (guint i = 0; i < derivation->instances->len; i++) {
        FrLinstance *instance = g_ptr_array_index(derivation->instances, i);
        if (instance != NULL) {
            g_free(instance->variables);
            g_free(instance);
        }
    }
    g_ptr_array_unref(derivation->instances);
    g_array_unref(derivation->choices);
    g_ptr_array_unref(derivation->files);
    g_hash_table_unref(derivation->told);
    g_clear_pointer(&derivation->origins, g_array_unref);
    g_clear_pointer(&derivation->organ_origins, g_array_unref);
    fr_lstring_free(derivation->string);
    fr_lstring_free(derivation->other);
    fr_lview_free(derivation->default_view);
    g_free((double *)derivation->settings.values);
    g_free(derivation);
}

// ---- steps ------------------------------------------------------------------------------------

static FrStatus take_step(FrLderivation *derivation, const FrContext *context) {
    FrLmachine *machine = &derivation->machine;
    FrLinstance *instance = g_ptr_array_index(derivation->instances, 0);
    derivation->step++;
    machine->loops = 0;
    fr_linstance_enter(derivation, instance);
    fr_linstance_block(derivation, instance, FR_LSTART_EACH);
    FrStatus status = derivation->is_parallel ? fr_lderive_parallel(derivation, context)
                                              : fr_lderive_sequential(derivation, context);
    if (status == FR_OK) {
        fr_linstance_enter(derivation, instance);
        fr_linstance_block(derivation, instance, FR_LEND_EACH);
        if ((int64_t)derivation->step == derivation->length) {
            fr_linstance_block(derivation, instance, FR_LEND);
        }
        derivation->is_answered = false;
    }
    fr_lderive_report(derivation, machine, context);
    FrStatus checked = fr_lderive_check(derivation, context);
    return MAX(status, checked);
}

FrStatus fr_lderivation_run(FrLderivation *derivation, uint64_t steps, const FrContext *context) {
    FrStatus status = FR_OK;
    for (uint64_t i = 0; i < steps && status == FR_OK && !derivation->machine.is_stopped; i++) {
        if (fr_progress_is_cancelled(context->progress)) {
            return FR_CANCELLED;
        }
        status = fr_lderivation_ask(derivation, context);
        if (status == FR_OK) {
            status = take_step(derivation, context);
            derivation->step -= status != FR_OK;
        }
        fr_progress_report(context->progress, "derive", (double)(i + 1) / (double)steps);
    }
    return status;
}

uint64_t fr_lderivation_length(const FrLderivation *derivation) {
    return (uint64_t)derivation->length;
}

uint64_t fr_lderivation_step(const FrLderivation *derivation) {
    return derivation->step;
}

bool fr_lderivation_is_stopped(const FrLderivation *derivation) {
    return derivation->machine.is_stopped;
}

const FrLstring *fr_lderivation_string(const FrLderivation *derivation) {
    return derivation->string;
}
