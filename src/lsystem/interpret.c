// Interpretation: homomorphism module after module, then the turtle. The string is only read.
#include "lsystem/split.h"

#include <math.h>

typedef struct Reading {
    FrLderivation *derivation;
    const FrContext *context;
    FrLmatcher matcher; ///< with the ignored symbols of the main L-system
    FrLinstance *instance;
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
    uint64_t *random; ///< streams of the L-systems whose homomorphism has a seed
    bool *is_seeded;
    FrLinstance *callers[100];
    uint32_t calls;
} Reading;

static void work_in(Reading *reading, FrLinstance *instance) {
    FrLderivation *derivation = reading->derivation;
    reading->instance = instance;
    fr_linstance_enter(derivation, instance);
    reading->matcher = fr_lmatcher(derivation->system, &derivation->machine,
                                   g_ptr_array_index(derivation->system->units, 0));
    reading->section = &instance->unit->sections[FR_LHOMOMORPHISM];
    reading->depth = fr_lderive_depth(derivation, reading->section, reading->context);
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
                fr_lmachine_fault_depth(reading->matcher.machine, "homomorphism-depth", production);
            }
            production = NULL;
        }
        if (production == NULL) {
            // A cut that is made here means nothing.
            bool is_cut = (words[at] & FR_LHEAD_KEY) == fr_lhead('%', 0);
            if (!is_cut || *reading->is_raw) {
                give(reading, words + at);
            }
            at += own;
            continue;
        }
        if (++reading->work > reading->context->limits.modules) {
            reading->status = fr_lderive_limit(reading->derivation, reading->work,
                                               reading->context->limits.modules, "modules",
                                               production, NULL, reading->origin, reading->context);
            reading->goes_on = false;
            return;
        }
        reading->status = fr_lderive_check_depth(reading->derivation, depth + 1, production,
                                                 reading->origin, reading->context);
        reading->goes_on &= reading->status == FR_OK;
        if (!reading->goes_on) {
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

/// Enters or leaves a called L-system, whose homomorphism holds within. `here` is of the string.
static void follow_call(Reading *reading, uint32_t *here) {
    unsigned symbol = fr_lhead_symbol(*here), count = fr_lhead_count(*here);
    FrLderivation *derivation = reading->derivation;
    if (symbol == '$' && reading->calls > 0) {
        work_in(reading, reading->callers[--reading->calls]);
        return;
    }
    const FrLunit *unit = symbol == '?' && count > 0
                              ? fr_lsystem_unit(derivation->system, trunc(fr_lword_float(here[1])))
                              : NULL;
    if (unit == NULL || reading->calls == G_N_ELEMENTS(reading->callers)) {
        return;
    }
    uint32_t number = *here >> 16;
    if (number == 0 || number >= derivation->instances->len) {
        number = fr_linstance_new(derivation, unit, reading->context);
        if (number == FR_NONE) {
            reading->status = FR_ERR_LIMIT;
            reading->goes_on = false;
            return;
        }
        *here = (*here & FR_LHEAD_KEY) | number << 16;
    }
    FrLinstance *called = g_ptr_array_index(derivation->instances, number);
    if (called != NULL) {
        reading->callers[reading->calls++] = reading->instance;
        work_in(reading, called);
    }
}

static void exchange_random(Reading *reading) {
    GPtrArray *units = reading->derivation->system->units;
    for (guint u = 0; u < units->len; u++) {
        if (g_ptr_array_index(units, u) == reading->instance->unit && reading->is_seeded[u]) {
            uint64_t kept = reading->derivation->machine.random.state;
            reading->derivation->machine.random.state = reading->random[u];
            reading->random[u] = kept;
        }
    }
}

/// Replaces modules of the string by what a production gives, with the homomorphism's own random
/// numbers if it has a seed; its condition drew from the common ones.
static void apply(Reading *reading, const FrLproduction *production, FrLsite *site) {
    site->behind = site->before + 1;
    exchange_random(reading);
    g_array_set_size(reading->scratch, production->word_count);
    fr_lmatch_produce(&reading->matcher, production, (uint32_t *)(void *)reading->scratch->data);
    replace(reading, 0, production->word_count, site, 1);
    exchange_random(reading);
}

static void read_string(Reading *reading) {
    const FrLstring *string = reading->derivation->string;
    const uint32_t *end = string->words + string->count;
    uint64_t module = 0;
    bool has_calls = reading->derivation->system->units->len > 1;
    for (uint64_t at = 0; at < string->count && reading->goes_on;) {
        uint32_t *here = string->words + at;
        uint32_t own = 1 + fr_lhead_count(*here), taken;
        reading->origin = module;
        reading->matcher.machine->module = module;
        if ((module & 0xFFFF) == 0 && fr_progress_is_cancelled(reading->context->progress)) {
            reading->status = FR_CANCELLED;
            return;
        }
        FrLsite site = {&reading->index, (uint32_t)module, (uint32_t)module + 1};
        const FrLproduction *production =
            reading->section->list->len == 0 || *reading->is_raw
                ? NULL
                : fr_lmatch_first(&reading->matcher, reading->section, here, end, &site, &taken);
        if (production != NULL && reading->depth > 0) {
            apply(reading, production, &site);
            at += taken;
            module += production->strict.count;
            continue;
        }
        give(reading, here);
        if (has_calls && !*reading->is_raw) {
            follow_call(reading, here);
        }
        at += own;
        module++;
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

/// Streams of homomorphisms with a seed begin anew with every reading.
static void seed_streams(Reading *reading) {
    FrLderivation *derivation = reading->derivation;
    GPtrArray *units = derivation->system->units;
    reading->random = g_new0(uint64_t, units->len);
    reading->is_seeded = g_new0(bool, units->len);
    for (guint u = 0; u < units->len; u++) {
        const FrLunit *unit = g_ptr_array_index(units, u);
        uint32_t code = unit->sections[FR_LHOMOMORPHISM].seed;
        double seed = code == FR_NONE ? -1 : trunc(fr_lmachine_run(&derivation->machine, code));
        reading->is_seeded[u] = seed >= 0 && seed < 9e18;
        reading->random[u] = reading->is_seeded[u] ? fr_lrandom_seed_b((int64_t)seed) : 0;
    }
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
    FrLinstance *instance = g_ptr_array_index(derivation->instances, 0);
    derivation->machine.loops = 0;
    work_in(&reading, instance);
    seed_streams(&reading);
    if (any_context(derivation->system)) {
        fr_lindex_build(&reading.index, derivation->string->words, derivation->string->count,
                        derivation->string->modules);
    }
    read_string(&reading);
    fr_lindex_clear(&reading.index);
    g_array_unref(reading.scratch);
    g_free(reading.random);
    g_free(reading.is_seeded);
    fr_linstance_enter(derivation, instance);
    fr_lderive_report(derivation, &derivation->machine, context);
    FrStatus checked = fr_lderive_check(derivation, context);
    return MAX(reading.status, checked);
}

// ---- what it is used for ----------------------------------------------------------------------

typedef struct Copy {
    const FrLderivation *derivation;
    FrLstring *to;
    const FrContext *context;
    FrStatus status;
} Copy;

static bool copy_module(void *data, const uint32_t *module, uint64_t origin) {
    Copy *copy = data;
    FrLstring *to = copy->to;
    uint32_t words = 1 + fr_lhead_count(*module);
    copy->status =
        fr_lderive_limit(copy->derivation, to->modules + 1, copy->context->limits.modules,
                         "modules", fr_lderive_maker(copy->derivation, fr_lhead_mark(*module)),
                         "the homomorphism", origin, copy->context);
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
    Copy copy = {derivation, fr_lstring_new(), context, FR_OK};
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

static bool has_homomorphism(const FrLsystem *system, bool is_impure) {
    bool has_any = false;
    for (guint u = 0; u < system->units->len; u++) {
        const FrLunit *unit = g_ptr_array_index(system->units, u);
        const GArray *list = unit->sections[FR_LHOMOMORPHISM].list;
        for (guint i = 0; i < list->len; i++) {
            const FrLproduction *production = &g_array_index(system->productions, FrLproduction,
                                                             g_array_index(list, uint32_t, i));
            has_any |= !is_impure || !production->is_pure;
        }
    }
    return has_any;
}

static bool count_module(void *data, const uint32_t *module, uint64_t origin) {
    (void)module;
    (void)origin;
    return ++*(uint64_t *)data < UINT64_MAX;
}

/// What a homomorphism may change.
typedef struct Kept {
    FrLrandom random;
    GPtrArray *variables; ///< double *, by instance; NULL
} Kept;

static Kept keep(const FrLderivation *derivation) {
    Kept kept = {derivation->machine.random, g_ptr_array_new_with_free_func(g_free)};
    for (guint i = 0; i < derivation->instances->len; i++) {
        const FrLinstance *instance = g_ptr_array_index(derivation->instances, i);
        g_ptr_array_add(kept.variables,
                        instance == NULL ? NULL
                                         : g_memdup2(instance->variables,
                                                     instance->unit->variables * sizeof(double)));
    }
    return kept;
}

static void put_back(FrLderivation *derivation, Kept *kept) {
    for (guint i = 0; i < kept->variables->len; i++) {
        FrLinstance *instance = g_ptr_array_index(derivation->instances, i);
        const double *variables = g_ptr_array_index(kept->variables, i);
        if (instance != NULL && variables != NULL) {
            memcpy(instance->variables, variables, instance->unit->variables * sizeof(double));
        }
    }
    g_ptr_array_unref(kept->variables);
    derivation->machine.random = kept->random;
}

FrStatus fr_lderivation_count(FrLderivation *derivation, const FrContext *context,
                              uint64_t *modules) {
    *modules = fr_lstring_count(derivation->string);
    if (!has_homomorphism(derivation->system, false)) {
        return FR_OK;
    }
    Kept kept = keep(derivation); // who counts must not decide what is drawn
    *modules = 0;
    FrStatus status = fr_lderive_interpret(derivation, count_module, NULL, modules, context);
    put_back(derivation, &kept);
    return status;
}

FrStatus fr_lderivation_look(FrLderivation *derivation, const FrContext *context, FrPlant **plant,
                             FrLdrawn *drawn) {
    Kept kept = keep(derivation);
    FrStatus status = fr_lderivation_draw(derivation, context, plant, drawn);
    put_back(derivation, &kept);
    return status;
}

FrStatus fr_lderivation_plant(FrLderivation *derivation, const FrContext *context, FrPlant **plant,
                              FrLdrawn *drawn) {
    *plant = NULL;
    // In papers what an environment tells is drawn; cpfg asks no more after the last step unless
    // its view says so.
    bool is_asked = derivation->system->is_paper || derivation->view->answers_before;
    FrStatus status = is_asked ? fr_lderivation_ask(derivation, context) : FR_OK;
    return status == FR_OK ? fr_lderivation_draw(derivation, context, plant, drawn) : status;
}

FrStatus fr_lderivation_draw(FrLderivation *derivation, const FrContext *context, FrPlant **plant,
                             FrLdrawn *drawn) {
    *plant = NULL;
    FrLturtle turtle;
    FrStatus status = FR_OK;
    // Where no box is given, cpfg reads the string once to find one, and again to draw it.
    if (!derivation->view->is_framed && has_homomorphism(derivation->system, true)) {
        fr_lturtle_init(&turtle, derivation, NULL, context);
        status = fr_lderive_interpret(derivation, take_module, &turtle.is_raw, &turtle, context);
        status = MAX(status, turtle.status);
        fr_lturtle_clear(&turtle);
    }
    if (status != FR_OK) {
        return status;
    }
    FrLbuilder *builder = fr_lbuilder_new(derivation, context);
    fr_lturtle_init(&turtle, derivation, builder, context);
    if (has_homomorphism(derivation->system, false)) {
        status = fr_lderive_interpret(derivation, take_module, &turtle.is_raw, &turtle, context);
    } else if (!fr_lturtle_read_split(&turtle, derivation->string)) {
        const FrLstring *string = derivation->string;
        fr_lbuilder_reserve(builder, string);
        fr_lturtle_walk(&turtle, string->words, 0, string->count, 0);
    }
    fr_lturtle_end_node(&turtle);
    status = MAX(status, MAX(turtle.status, builder->status));
    builder->drawn.modules = turtle.modules;
    if (drawn != NULL) {
        *drawn = builder->drawn;
    }
    if (status == FR_OK) {
        fr_lturtle_warn_of_open(&turtle);
        g_clear_pointer(&derivation->origins, g_array_unref);
        derivation->origins = g_steal_pointer(&builder->origins);
        g_clear_pointer(&derivation->organ_origins, g_array_unref);
        derivation->organ_origins = g_steal_pointer(&builder->organ_origins);
        *plant = fr_lbuilder_end(builder);
    }
    fr_lturtle_clear(&turtle);
    fr_lbuilder_free(builder);
    return status;
}
