/// @file lsystem.h
/// Plants written as L-systems: strings of modules that productions rewrite in parallel
/// (Prusinkiewicz, Lindenmayer 1990, The Algorithmic Beauty of Plants), in the language of cpfg,
/// with open symbols that an environment answers (Měch, Prusinkiewicz 1996).
///
///     FrLsystem *system;                                  the compiled file
///     FrLderivation *derivation;                          a string and what it needs to go on
///     fr_lsystem_compile(source, &options, &context, &system);
///     fr_lderivation_new(system, &settings, &context, &derivation);
///     fr_lderivation_run(derivation, 5, &context);
///     fr_lderivation_plant(derivation, &context, &plant, NULL);
///
/// The language: docs/lsystems.md. Where cpfg's manual and cpfg itself differ, this follows cpfg.
#pragma once

#include "frond/plant.h"

typedef struct FrLsystem FrLsystem;
typedef struct FrLview FrLview;

/// How a file is written.
typedef enum FrLnotation {
    FR_LNOTATION_AUTO,  ///< cpfg if its first word is Lsystem, else the notation of papers
    FR_LNOTATION_CPFG,  ///< `Lsystem: 1` … `endlsystem`, productions `A(x) : x > 1 --> B`
    FR_LNOTATION_PAPER, ///< `w : A` and `p1 : lc < A > rc : cond -> B : prob`
} FrLnotation;

/// A number that is set from outside: where the file defines or uses the name, it has this value.
typedef struct FrLvalue {
    const char *name; ///< letter or `_`, then letters, digits, `_`
    double value;
    FrSpan span; ///< where it is set
} FrLvalue;

typedef struct FrLoptions {
    FrLnotation notation;
    const char *folder;     ///< where #include looks; NULL: nothing can be included
    const FrLview *view;    ///< its function names are known to the file; may be NULL
    bool round_brackets;    ///< `(` and `)` branch, as in F(+F)F; then modules have no parameters
    const FrLvalue *values; ///< set from outside; a #define of such a name has no effect
    size_t value_count;     ///< at most 1000
} FrLoptions;

/// Reads and compiles a file; `options` may be NULL. All errors of the file are told in one run.
FR_API FR_MUST_USE FrStatus fr_lsystem_compile(FrSource *source, const FrLoptions *options,
                                               const FrContext *context, FrLsystem **system);
FR_API void fr_lsystem_free(FrLsystem *system);

// ---- strings ----------------------------------------------------------------------------------

/// A string of modules. A module is one symbol and its parameters, kept in single precision.
typedef struct FrLstring FrLstring;

/// One module, as seen while walking a string.
typedef struct FrLmodule {
    char symbol;
    uint8_t count;           ///< of parameters
    uint16_t mark;           ///< of what made it, for fr_lderivation_maker()
    const float *parameters; ///< `count` of them; NaN: open, not answered yet
} FrLmodule;

FR_API uint64_t fr_lstring_count(const FrLstring *string);
/// Bytes that the string occupies.
FR_API uint64_t fr_lstring_bytes(const FrLstring *string);
/// Walks the string: start with *at = 0; false at its end.
FR_API bool fr_lstring_next(const FrLstring *string, uint64_t *at, FrLmodule *module);
/// Appends the string as text, parameters as %g, open ones as `?`.
FR_API void fr_lstring_print(const FrLstring *string, GString *out);
/// Appends one module as fr_lstring_print() does.
FR_API void fr_lmodule_print(const FrLmodule *module, GString *out);
/// Digest of symbols and parameters.
FR_API FrDigest fr_lstring_digest(const FrLstring *string);

// ---- environment ------------------------------------------------------------------------------

/// Parameters of ?E in a scene: light, its direction (3), how sure that is; then how far it is to
/// what stands nearest, and to what stands straight ahead, m.
enum { FR_LFIRST_OF_SPACE = 5 };

/// What an open symbol tells about its place, in the plant's coordinates (metres, z up).
typedef struct FrLquery {
    char symbol;       ///< 'E' of ?E, or the symbol that has open parameters: R, I, …
    char following;    ///< symbol of the module behind it, 0 at the end
    uint8_t count;     ///< of parameters
    uint64_t asked;    ///< bit i: parameter i is open; for ?E all are
    float *parameters; ///< what the module says; answers are written here
    uint64_t module;   ///< index in the string
    vec3s position, heading, left, up; ///< up as cpfg has it: −(heading × left)
    float width, scale;                ///< of the turtle
} FrLquery;

/// Answers R(?,?): roll and pitch, in degrees, that turn the heading to `light` (a unit vector in
/// the plant's coordinates) by `\(roll) &(pitch) /(roll)`. A second parameter that is not open is
/// the most that it pitches; a zero vector turns nothing.
FR_API void fr_lquery_bend(const FrLquery *query, vec3s light);

/// Who answers open symbols: all of a step in one batch, in the order of the string.
typedef struct FrEnvironment {
    void *data;
    FrStatus (*answer)(void *data, const FrLquery *queries, size_t count, const FrContext *context);
} FrEnvironment;

/// A simple environment. `I(?)` and the first parameter of `?E` receive `intensity`; R(?,?)
/// receives roll and pitch (degrees) towards `light`, the pitch at most the second parameter
/// where that is given; `D(?)` the distance to the obstacle and `Y(?)` the height.
typedef struct FrLsimple {
    float intensity;       ///< of light, everywhere
    vec3s light;           ///< unit vector towards it
    vec3s obstacle;        ///< middle of a ball
    float obstacle_radius; ///< ≤ 0: there is none, the distance is 1e6
    float shade_height;    ///< below it the intensity is `shade` times as much; 0: no shade
    float shade;
} FrLsimple;

/// Full light from straight above, nothing else. `simple` must outlive the environment.
FR_API FrLsimple fr_lsimple_default(void);
FR_API FrEnvironment fr_lsimple_environment(FrLsimple *simple);

// ---- derivation -------------------------------------------------------------------------------

typedef struct FrLsettings {
    int64_t seed;                     ///< of all random numbers; < 0: what the file says
    int64_t steps;                    ///< derivation length; < 0: what the file says
    const FrLview *view;              ///< functions, curves, turtle; NULL: defaults
    const FrEnvironment *environment; ///< who answers; NULL: nobody, open parameters stay open
    void (*print)(void *user, const char *text); ///< where printf() of the language goes; NULL
    void *print_user;
    const double *values; ///< for the names of FrLoptions.values, in their order; NULL: those there
    double unit;          ///< metres of one unit of the file
    FrMaterial *axes, *organs;  ///< their materials, borrowed; NULL: brown and green ones
    FrMaterial *const *colours; ///< of organs in colour 1, 2, … of `;(n)`, borrowed
    size_t colour_count;        ///< in other colours they are of `organs`
    FrMaterial *const *palette; ///< 256 materials by colour index, some NULL, for what those do not
                                ///< say and for axes; NULL: none
    bool inherits;      ///< where those are NULL there is none: that of what bears the plant
    const char *sites;  ///< symbols that place something: organs without a shape, scaled by the
                        ///< first parameter, whose component is called like the symbol; NULL: none
    bool keeps_origins; ///< fr_lderivation_origin() will be asked; 8 bytes an internode or organ
} FrLsettings;

FR_API FrLsettings fr_lsettings_default(void);

typedef struct FrLderivation FrLderivation;

/// Runs Start and makes the axiom. The system, view and environment must outlive the derivation.
FR_API FR_MUST_USE FrStatus fr_lderivation_new(const FrLsystem *system, const FrLsettings *settings,
                                               const FrContext *context,
                                               FrLderivation **derivation);
FR_API void fr_lderivation_free(FrLderivation *derivation);
/// The derivation length that the file or the settings ask for.
FR_API uint64_t fr_lderivation_length(const FrLderivation *derivation);
/// Steps done so far.
FR_API uint64_t fr_lderivation_step(const FrLderivation *derivation);
/// True after stop() of the language; stop(1) goes on.
FR_API bool fr_lderivation_is_stopped(const FrLderivation *derivation);
/// Does `steps` more steps. The bits do not depend on the number of threads. On a failure the
/// string is that of the last whole step.
FR_API FR_MUST_USE FrStatus fr_lderivation_run(FrLderivation *derivation, uint64_t steps,
                                               const FrContext *context);
/// Lets the environment answer the open symbols of the string at hand. run() does so by itself
/// before each step; calling it again changes nothing.
FR_API FR_MUST_USE FrStatus fr_lderivation_ask(FrLderivation *derivation, const FrContext *context);
/// True if the system has symbols that ask.
FR_API bool fr_lsystem_is_open(const FrLsystem *system);
/// True if some of them ask for free space: D(?), or a ?E of six or more parameters.
FR_API bool fr_lsystem_asks_space(const FrLsystem *system);
FR_API const FrLstring *fr_lderivation_string(const FrLderivation *derivation);
/// The string after homomorphism, to be freed with fr_lstring_free().
FR_API FR_MUST_USE FrStatus fr_lderivation_homomorphism(FrLderivation *derivation,
                                                        const FrContext *context,
                                                        FrLstring **string);
/// How many modules the string has after homomorphism. Changes nothing, not even random numbers.
FR_API FR_MUST_USE FrStatus fr_lderivation_count(FrLderivation *derivation,
                                                 const FrContext *context, uint64_t *modules);
FR_API void fr_lstring_free(FrLstring *string);

// ---- turtle -----------------------------------------------------------------------------------

/// What the turtle drew. Lengths in units of the file, the box in its coordinates (y up).
typedef struct FrLdrawn {
    uint64_t modules;      ///< interpreted, after homomorphism
    uint64_t segments;     ///< of F and G and, as lines, of generalized cylinders; none that is
                           ///< shorter than 0.00316 (its square 0.00001)
    double length;         ///< of all segments
    double min[3], max[3]; ///< in the file's axes, y up: of the turtle's places, the control points
                           ///< of surfaces, the boxes of balls and discs, the rings of
                           ///< cylinders; not of line widths
    uint64_t spheres, discs, polygons, surfaces;
    uint64_t cylinders; ///< spans of generalized cylinders
} FrLdrawn;

/// Draws the string: homomorphism, then the turtle. `drawn` may be NULL. The file's y axis is the
/// plant's z axis.
FR_API FR_MUST_USE FrStatus fr_lderivation_plant(FrLderivation *derivation,
                                                 const FrContext *context, FrPlant **plant,
                                                 FrLdrawn *drawn);

/// Draws the string as it is: open symbols stay open until fr_lderivation_ask().
FR_API FR_MUST_USE FrStatus fr_lderivation_draw(FrLderivation *derivation, const FrContext *context,
                                                FrPlant **plant, FrLdrawn *drawn);
/// The same for who looks on while it grows: variables and random numbers are then as before, so
/// the derivation goes on as if nobody had looked.
FR_API FR_MUST_USE FrStatus fr_lderivation_look(FrLderivation *derivation, const FrContext *context,
                                                FrPlant **plant, FrLdrawn *drawn);

/// Where an internode or an organ comes from.
typedef struct FrLorigin {
    uint64_t module;        ///< index in the string of what drew it, itself or by homomorphism
    const char *production; ///< in whose successor the symbol stood, borrowed; NULL: the axiom
    FrSpan span;            ///< of the production or the axiom
} FrLorigin;

/// Where a node of the plant drawn last comes from; false where that is not kept (FrLsettings).
FR_API bool fr_lderivation_origin(const FrLderivation *derivation, uint32_t node,
                                  FrLorigin *origin);
/// The same of an organ.
FR_API bool fr_lderivation_organ_origin(const FrLderivation *derivation, uint32_t organ,
                                        FrLorigin *origin);
/// The production in whose successor a module of this mark stood, and its place; NULL: the axiom.
FR_API const char *fr_lderivation_maker(const FrLderivation *derivation, uint16_t mark,
                                        FrSpan *span);

/// Reads a view file (.v) and what it names, relative to `folder`: functions, contours, surfaces.
/// Commands that only concern pictures are read over; unknown ones are warnings.
FR_API FR_MUST_USE FrStatus fr_lview_read(FrSource *source, const char *folder,
                                          const FrContext *context, FrLview **view);
FR_API void fr_lview_free(FrLview *view);
