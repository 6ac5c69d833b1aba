/// @file lsystem/derive.h
/// A derivation at work: its string, its instances of L-systems, one step.
#pragma once

#include "lsystem/match.h"
#include "lsystem/view.h"

/// Where a module begins, for those who want to start in the middle.
typedef struct FrLmark {
    uint64_t word, module;
} FrLmark;

struct FrLstring {
    uint32_t *words;
    uint64_t count, capacity; ///< of words
    uint64_t modules;
    GArray *marks; ///< FrLmark: the begin and then one every few thousand words
};

/// An L-system called by `?`, or the main one, with its own variables.
typedef struct FrLinstance {
    const FrLunit *unit;
    double *variables;
    bool has_started, was_seen;
} FrLinstance;

struct FrLderivation {
    const FrLsystem *system;
    FrLsettings settings;
    FrLview *default_view; ///< owned, where the settings have none
    const FrLview *view;
    FrLstring *string, *other; ///< now, and room for the next
    GPtrArray *instances;      ///< FrLinstance *, some NULL; the first is the main one
    guint used;                ///< before this one, no instance is NULL
    uint64_t variables;        ///< of all instances
    uint64_t random;           ///< stream A, one for all L-systems of the file
    FrLmachine machine;
    GPtrArray *files; ///< FrLfile *, some NULL: that the text has open
    GArray *choices;  ///< uint16_t: production of each module + 1, in parallel steps
    int64_t length;
    uint64_t step;
    bool is_parallel;      ///< nothing that a step does depends on the order of modules
    bool is_answered;      ///< the open symbols of this string have been answered
    GHashTable *told;      ///< places of faults that were reported
    GArray *origins;       ///< uint64_t: by node of the plant drawn last, 16 bits of mark below the
                           ///< module's index; NULL: not kept
    GArray *organ_origins; ///< the same by organ
};

FrLstring *fr_lstring_new(void);
/// Room for `words` words in all; false where the machine has none.
bool fr_lstring_reserve(FrLstring *string, uint64_t words);

/// One step; on success the strings are swapped. Faults stay in the machine.
FrStatus fr_lderive_sequential(FrLderivation *derivation, const FrContext *context);
FrStatus fr_lderive_parallel(FrLderivation *derivation, const FrContext *context);
/// The string after homomorphism, one module after the other; stops where `take` returns false.
/// `raw` tells that the turtle takes the next module as it is.
typedef bool (*FrLtake)(void *data, const uint32_t *module, uint64_t origin);
FrStatus fr_lderive_interpret(FrLderivation *derivation, FrLtake take, const bool *raw, void *data,
                              const FrContext *context);

/// Makes an instance; FR_NONE and an error where there are too many.
uint32_t fr_linstance_new(FrLderivation *derivation, const FrLunit *unit, const FrContext *context);
const FrLunit *fr_lsystem_unit(const FrLsystem *system, double id);
/// Runs a block (Start, …) of an instance.
void fr_linstance_block(FrLderivation *derivation, FrLinstance *instance, int block);
/// Makes the variables of an instance those of the machine.
void fr_linstance_enter(FrLderivation *derivation, FrLinstance *instance);
/// fr_limit_check() for what is asked for at a module of the step at hand, which is told with it;
/// `production` NULL: `what` asks, and its place is the axiom.
FR_MUST_USE FrStatus fr_lderive_limit(const FrLderivation *derivation, uint64_t wanted,
                                      uint64_t limit, const char *limit_name,
                                      const FrLproduction *production, const char *what,
                                      uint64_t module, const FrContext *context);
/// The production that a module comes from by the mark of its head; NULL: the axiom.
const FrLproduction *fr_lderive_maker(const FrLderivation *derivation, uint32_t mark);
/// `maximum depth` of a section, 1 where it says nothing; at most one more than the limit allows.
uint32_t fr_lderive_depth(FrLderivation *derivation, const FrLsection *section,
                          const FrContext *context);
/// The error of replacements that go deeper than the limit, whatever `maximum depth` says.
FR_MUST_USE FrStatus fr_lderive_check_depth(const FrLderivation *derivation, uint32_t depth,
                                            const FrLproduction *production, uint64_t module,
                                            const FrContext *context);
/// Tells what went wrong and forgets it.
void fr_lderive_report(FrLderivation *derivation, FrLmachine *machine, const FrContext *context);
/// FR_OK, or the error of a loop that does not end.
FrStatus fr_lderive_check(FrLderivation *derivation, const FrContext *context);
