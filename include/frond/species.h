/// @file species.h
/// How a kind of plant grows: three tables of parameters.
///
/// A *species* says everything; its *orders* say how axes of each order are built (architecture
/// after Hallé and Oldeman); its *sliders* are six plain numbers that change the species as a
/// whole. Angles are degrees in documents and radians in the structs.
#pragma once

#include "frond/distance.h"
#include "frond/param.h"
#include "frond/plant.h"

/// A `<species>`.
#define FR_SPECIES_PARAMS(X)                                                                       \
    X(TEXT, preset, "", 0, 0, "", "", "species that ships with the program, to start from")        \
    X(CHOICE, model, "leeuwenberg", 0, 0, "",                                                      \
      "holttum corner tomlinson schoute chamberlain leeuwenberg koriba prevost fagerlind petit "   \
      "nozeran aubreville massart roux cook scarrone stone rauh attims mangenot champagnat troll " \
      "mcclure open",                                                                              \
      "architecture after Hallé and Oldeman; open: one order, given by the attributes below")      \
    /* elongation */                                                                               \
    X(REAL, step, "0.25", 0.001, 20, "m", "", "length of an internode in even light")              \
    X(REAL, step_ratio, "0.9", 0.05, 2, "", "", "times the length for each order")                 \
    X(REAL, length_noise, "0.1", 0, 1, "", "", "deviation of lengths, in lengths")                 \
    X(INTEGER, start, "0", 0, 100000, "", "", "steps before its seeds sprout")                     \
    /* branching */                                                                                \
    X(INTEGER, laterals, "2", 0, 8, "", "", "buds beside each node; a model's tiers times half")   \
    X(REAL, divergence, "137.508", -360, 360, "deg", "", "from a node's buds to the next node's")  \
    X(REAL, branching_angle, "45", 0, 175, "deg", "", "of a bud; a model's times this / 45")       \
    X(REAL, twist, "0", -360, 360, "deg", "", "of an axis about itself, per internode")            \
    X(INTEGER, dormancy, "1", 0, 1000, "", "", "steps that a bud sleeps at least")                 \
    X(INTEGER, patience, "12", 1, 10000, "", "", "steps after which a sleeping bud dies")          \
    X(INTEGER, max_order, "6", 0, 60, "", "", "axes of this order bear no branches")               \
    /* fate of buds */                                                                             \
    X(CHOICE, fate, "auxin", 0, 0, "", "auxin flux priority colonize",                             \
      "what lets buds grow: distance from a growing apex; vigour shared out at forks "             \
      "(Borchert and Honda) or by rank; or attraction particles alone")                            \
    X(REAL, auxin_reach, "2", 0, 1000, "", "",                                                     \
      "internodes below a growing apex that it keeps "                                             \
      "asleep")                                                                                    \
    X(REAL, auxin, "0", 0, 100, "", "",                                                            \
      "made by each growing apex; above 0 buds wake by chance exp(-auxin that reaches them)")      \
    X(REAL, auxin_left, "0.6", 0, 1, "", "", "part of the auxin left after each internode")        \
    X(REAL, apical_control, "1", 0.2, 5, "", "",                                                   \
      "above 1 inner orders outgrow outer ones, below 1 the reverse")                              \
    X(REAL, vigour, "2", 0, 1000, "", "", "flux, priority: vigour for each unit of light")         \
    X(REAL, vigour_base, "0", 0, 1000, "", "", "flux, priority: vigour besides")                   \
    X(REAL, favour, "0.54", 0, 1, "", "", "flux: share of the axis against its laterals, young")   \
    X(REAL, favour_old, "0.5", 0, 1, "", "", "flux: the same when old")                            \
    X(INTEGER, favour_from, "1000000", 0, 1000000, "", "", "steps after which favour changes")     \
    X(INTEGER, favour_over, "7", 1, 1000000, "", "", "steps over which it changes")                \
    X(REAL, rank_first, "1", 0, 100, "", "", "priority: weight of the first rank")                 \
    X(REAL, rank_last, "0.1", 0, 100, "", "", "priority: weight of the last ranks")                \
    X(REAL, rank_part, "0.5", 0, 1, "", "", "priority: part of the ranks that the fall takes")     \
    X(REAL, shoot, "4", 1, 50, "", "", "flux, priority: most internodes of a shoot in a step")     \
    /* direction */                                                                                \
    X(REAL, phototropism, "0.3", -10, 10, "", "", "turns towards the light")                       \
    X(REAL, gravitropism, "0.15", -10, 10, "", "", "turns up, against gravity; below 0 down")      \
    X(REAL, attraction, "0.5", 0, 10, "", "", "turns towards attraction particles")                \
    X(REAL, wander, "6", 0, 90, "deg", "", "turns by chance")                                      \
    X(CHOICE, turning, "sum", 0, 0, "", "sum part",                                                \
      "internodes go along the sum of all directions, or turn a part of the way to light and up")  \
    X(REAL, turn_part, "0.4", 0, 1, "", "", "turning part: at most so much of the way")            \
    X(REAL, turn_limit, "180", 0, 180, "deg", "", "turns at most in an internode")                 \
    /* climbing */                                                                                 \
    X(REAL, climb, "0", 0, 100, "m", "",                                                           \
      "from how far it feels a surface to hold on to; 0: it does not climb")                       \
    X(REAL, cling, "0.5", 0, 1, "", "",                                                            \
      "climb: how firmly internodes turn to the surface and along it")                             \
    X(REAL, climb_wind, "0", -10, 10, "", "",                                                      \
      "climb: turns to the right, as seen from outside, around what it holds on to")               \
    X(REAL, climb_free, "0.6", 0.001, 1000, "m", "",                                               \
      "climb: length of shoots without a hold at which they end")                                  \
    X(REAL, climb_sag, "1", 0, 10, "", "", "climb: how much they hang down by then")               \
    X(REAL, climb_wood, "0.02", 0, 1000, "m", "",                                                  \
      "climb: radius of the thinnest wood of grown plants that it holds on to")                    \
    /* light */                                                                                    \
    X(REAL, search, "0.5", 0, 5, "", "", "how much longer internodes are in shade")                \
    X(REAL, min_length, "0.3", 0.01, 1, "", "", "shortest internode, in steps")                    \
    X(REAL, max_length, "1.5", 1, 10, "", "", "longest internode, in steps")                       \
    X(REAL, branch_dark, "0.1", 0, 1, "", "", "no buds beside nodes in less light …")              \
    X(REAL, branch_light, "0.6", 0, 1, "", "", "… and all of them in more than this")              \
    X(REAL, wake_light, "0.15", 0, 1, "", "", "buds in less light do not wake")                    \
    /* shedding */                                                                                 \
    X(CHOICE, shed, "light", 0, 0, "", "none light vigour both", "what drops branches")            \
    X(REAL, shed_share, "0.8", 0, 1, "", "", "of its buds that must be dark")                      \
    X(REAL, shed_light, "0.2", 0, 1, "", "", "below which a bud is dark")                          \
    X(REAL, shed_vigour, "0.3", 0, 1000, "", "", "vigour per internode below which it drops")      \
    X(INTEGER, shed_age, "3", 0, 1000, "", "", "steps before a branch may drop")                   \
    X(INTEGER, shed_dead, "4", 0, 10000, "", "",                                                   \
      "steps after which branches without live buds drop; 0: never")                               \
    /* death */                                                                                    \
    X(REAL, upkeep, "0", 0, 1, "", "",                                                             \
      "light that each live bud takes; a plant whose buds gather less than that and …")            \
    X(REAL, wood_upkeep, "0", 0, 100, "1/m", "",                                                   \
      "… this for each metre of wood from each of them to the ground starves; both 0: none does")  \
    X(INTEGER, endurance, "3", 1, 10000, "", "", "steps in a row that it starves before it dies")  \
    X(CHOICE, dead, "stands", 0, 0, "", "stands falls",                                            \
      "a plant that has starved stays as bare wood, or is gone")                                   \
    /* attraction particles */                                                                     \
    X(INTEGER, particles, "0", 0, 10000000, "", "", "that its envelope is filled with at first")   \
    X(CHOICE, particle_rule, "space", 0, 0, "", "space bud",                                       \
      "what a reached particle takes along: nothing, or the bud that reached it")                  \
    X(CHOICE, particle_mean, "all", 0, 0, "", "all nearest", "which particles a bud turns to")     \
    X(REAL, influence, "2", 0.001, 100000, "m", "", "from how far they attract")                   \
    X(REAL, kill, "0.5", 0, 100000, "m", "", "how near a particle is reached")                     \
    /* space */                                                                                    \
    X(POINTS, envelope, "", 0, 1000000, "m", "",                                                   \
      "radius,height … of the outline that it grows within; empty: unbounded")                     \
    X(TEXT, envelope_file, "", 0, 0, "", "",                                                       \
      "closed mesh to grow within instead, about the seed: .stl with z up, .obj .gltf .glb with "  \
      "y up")                                                                                      \
    X(SWITCH, collide, "yes", 0, 1, "", "", "keeps off what is in the way and other branches")     \
    X(INTEGER, box, "3", 1, 9, "", "", "cells of free space around a new tip: odd")                \
    X(CHOICE, keeps_off, "tip", 0, 0, "", "tip internode",                                         \
      "the box is kept free around the new tip alone, or all along the new internode")             \
    X(INTEGER, trials, "4", 1, 32, "", "", "directions that a bud tries before it gives up")       \
    X(REAL, trial_angle, "25", 0, 180, "deg", "", "how far they lie apart")                        \
    X(REAL, apex_distance, "0", 0, 1000, "m", "", "stops near an apex of more vigour (Honda)")     \
    /* wood */                                                                                     \
    X(REAL, tip_radius, "0.004", 0.00001, 1, "m", "", "of last internodes")                        \
    X(REAL, pipe_exponent, "2.3", 1, 4, "", "", "of radii at forks; 2 keeps areas")                \
    X(REAL, taper, "0.15", 0, 10, "", "", "tips' worth of wood that each internode adds")          \
    X(CHOICE, fallen_wood, "kept", 0, 0, "", "kept reused",                                        \
      "wood of fallen branches stays in what bore them beside that of later ones, or later ones "  \
      "take its place")                                                                            \
    X(SWITCH, smooth, "yes", 0, 1, "", "", "axes are drawn as splines through their nodes")        \
    X(TEXT, bark, "", 0, 0, "", "", "id of the material of wood")                                  \
    /* leaves */                                                                                   \
    X(INTEGER, leaves, "4", 0, 64, "", "", "at each leafy node")                                   \
    X(INTEGER, leaf_life, "5", 1, 10000, "", "", "steps that a node stays leafy")                  \
    X(REAL, leaf_light, "0.1", 0, 1, "", "", "nodes in less light have none")                      \
    X(REAL, leaf_length, "0.17", 0.0001, 100, "m", "", "of a blade")                               \
    X(REAL, leaf_width, "0.1", 0.0001, 100, "m", "", "of a blade")                                 \
    X(REAL, leaf_angle, "50", 0, 180, "deg", "", "between a blade and its axis")                   \
    X(CHOICE, leaf_facing, "natural", 0, 0, "", "natural horizontal lit outward",                  \
      "blades turn as they grow, lie level, face the light, or turn away from what is climbed")    \
    X(REAL, foliage, "0.04", 0, 1000, "m", "", "area in m² that a leafy node shades")              \
    X(TEXT, leaf, "", 0, 0, "", "", "id of the material of leaves")

/// An `<order>` of a species: how axes of that order are built; the last is also that of all
/// further ones. What is given here replaces the row of the species' model.
#define FR_ORDER_PARAMS(X)                                                                         \
    X(CHOICE, axis, "monopodial", 0, 0, "", "monopodial sympodial",                                \
      "goes on by its own apex, or ends and is gone on with by relays")                            \
    X(CHOICE, growth, "continuous", 0, 0, "", "continuous rhythmic basal",                         \
      "buds beside every node, tiers of buds at ends of units, or buds at its base alone")         \
    X(INTEGER, unit, "1", 1, 100, "", "", "internodes of a unit of growth")                        \
    X(INTEGER, tier, "2", 0, 8, "", "", "buds beside a node that bears any")                       \
    X(INTEGER, relays, "2", 0, 8, "", "", "axes that follow where one has ended")                  \
    X(INTEGER, life, "0", 0, 100000, "", "",                                                       \
      "internodes after which the axis ends, and relays go on for it; 0: never")                   \
    X(CHOICE, bearing, "upright", 0, 0, "", "upright level bent",                                  \
      "how it stands: grows up; grows level; rises, then bends over")                              \
    X(REAL, angle, "45", 0, 175, "deg", "", "between its bearer and it")                           \
    X(REAL, divergence, "137.508", -360, 360, "deg", "", "from tier to tier")                      \
    X(REAL, length, "1", 0.01, 10, "", "", "its internodes, in those of the species")              \
    X(SWITCH, in_axils, "yes", 0, 1, "", "", "its buds may grow out to branches")

/// `<sliders>` of a species: each changes many parameters at once. The middle leaves all as they
/// are.
#define FR_SPECIES_SLIDERS(X)                                                                      \
    X(REAL, randomize, "0", 0, 1, "", "", "irregular: lengths, angles, hidden particles")          \
    X(REAL, density, "0", -1, 1, "", "", "open … dense crown")                                     \
    X(REAL, branching, "0", -1, 1, "", "", "few … many branches")                                  \
    X(REAL, twist, "0", -1, 1, "", "", "left … right turn of its axes")                            \
    X(REAL, light, "0", -1, 1, "", "", "indifferent … sensitive to light")                         \
    X(REAL, gravity, "0", -1, 1, "", "", "weeping … upright")

enum {
    FR_MODEL_HOLTTUM,
    FR_MODEL_CORNER,
    FR_MODEL_TOMLINSON,
    FR_MODEL_SCHOUTE,
    FR_MODEL_CHAMBERLAIN,
    FR_MODEL_LEEUWENBERG,
    FR_MODEL_KORIBA,
    FR_MODEL_PREVOST,
    FR_MODEL_FAGERLIND,
    FR_MODEL_PETIT,
    FR_MODEL_NOZERAN,
    FR_MODEL_AUBREVILLE,
    FR_MODEL_MASSART,
    FR_MODEL_ROUX,
    FR_MODEL_COOK,
    FR_MODEL_SCARRONE,
    FR_MODEL_STONE,
    FR_MODEL_RAUH,
    FR_MODEL_ATTIMS,
    FR_MODEL_MANGENOT,
    FR_MODEL_CHAMPAGNAT,
    FR_MODEL_TROLL,
    FR_MODEL_MCCLURE,
    FR_MODEL_OPEN,
};
enum { FR_FATE_AUXIN, FR_FATE_FLUX, FR_FATE_PRIORITY, FR_FATE_COLONIZE };
enum { FR_SHED_NONE, FR_SHED_LIGHT, FR_SHED_VIGOUR, FR_SHED_BOTH };
enum { FR_WOOD_KEPT, FR_WOOD_REUSED };
enum { FR_DEAD_STANDS, FR_DEAD_FALLS };
enum { FR_PARTICLE_SPACE, FR_PARTICLE_BUD };
enum { FR_PARTICLES_ALL, FR_PARTICLES_NEAREST };
enum { FR_TURN_SUM, FR_TURN_PART };
enum { FR_AXIS_MONOPODIAL, FR_AXIS_SYMPODIAL };
enum { FR_GROWTH_CONTINUOUS, FR_GROWTH_RHYTHMIC, FR_GROWTH_BASAL };
enum { FR_BEARING_UPRIGHT, FR_BEARING_LEVEL, FR_BEARING_BENT };
enum { FR_KEEPS_OFF_TIP, FR_KEEPS_OFF_INTERNODE };
enum { FR_LEAVES_NATURAL, FR_LEAVES_HORIZONTAL, FR_LEAVES_LIT, FR_LEAVES_OUTWARD };
enum { FR_MAX_ORDERS = 8 };

typedef struct FrSpeciesParams {
    FR_SPECIES_PARAMS(FR_PARAM_FIELD)
} FrSpeciesParams;
typedef struct FrOrderParams {
    FR_ORDER_PARAMS(FR_PARAM_FIELD)
} FrOrderParams;
typedef struct FrSpeciesSliders {
    FR_SPECIES_SLIDERS(FR_PARAM_FIELD)
} FrSpeciesSliders;

FR_API const FrParamTable *fr_species_table(void);
FR_API const FrParamTable *fr_order_table(void);
FR_API const FrParamTable *fr_species_sliders_table(void);

/// A species, ready to grow. What it points to is borrowed.
typedef struct FrSpecies {
    const char *name;
    FrSpeciesParams params;
    FrOrderParams orders[FR_MAX_ORDERS]; ///< what `<order>` elements say …
    uint32_t order_count;                ///< … and how many there are; 0: those of the model
    FrMaterial *bark, *leaf;             ///< NULL: plain ones
    const FrDistance *envelope;          ///< closed surface to grow within, relative to the seed;
                                         ///< NULL: the parameter `envelope`
    bool is_absent; ///< nothing of it stands: it has no say in how wide cells are
} FrSpecies;

/// The defaults, and no orders of its own.
FR_API FrSpecies fr_species_default(void);
/// Sets the parameters to those of a shipped species. False if there is none of that name.
FR_API bool fr_species_preset(const char *name, FrSpeciesParams *params);
/// Names of the shipped species, NULL at the end.
FR_API const char *const *fr_species_presets(void);
/// The architecture of a model as rows of orders, at most FR_MAX_ORDERS. Returns how many.
FR_API uint32_t fr_species_model(int model, FrOrderParams *orders);
/// What six sliders make of parameters: a pure function; in the middle `params` unchanged. Frees
/// nothing, and copies no pointers' targets.
FR_API void fr_species_apply_sliders(const FrSpeciesSliders *sliders, FrSpeciesParams *params);
