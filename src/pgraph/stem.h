/// @file stem.h
/// The stem of Horn and Tree: how many internodes, how each turns, where places on it are.
#pragma once

#include "pgraph/field.h"
#include "pgraph/places.h"
#include "pgraph/prepare.h"
#include "pgraph/tropism.h"

/// What a stem grows from.
typedef struct FrStemBase {
    double scale;         ///< of lengths and radii
    double parent_length; ///< m at scale 1
    double parent_radius; ///< m at scale 1, where the stem is attached
    double stretch;       ///< factor of the length
    bool has_parent;
    double step;      ///< m, most of an internode; 0: any
    bool is_in_field; ///< other than plain gravity and light
} FrStemBase;

/// One stem, measured.
typedef struct FrStem {
    const FrPrepared *prepared;
    uint32_t internodes;
    double length; ///< m
    double radius; ///< m, at the base
    double taper, min_radius, flatness, flare;
    double whole; ///< part of the stem that is there; less than 1 where it is broken off
    double curvature, twist, gnarl, gnarl_frequency; ///< radians; gnarls over the length
    double deviation;                                ///< radians; then places bend the stem
    uint32_t gaps; ///< stretches between places where it bends; 0: evenly divided
    FrTropism tropism;
    double step; ///< m, most of an internode; 0: any
    bool is_in_field;
    double step_length, step_scale; ///< for FR_COURSE_STEPS
    double scale;
    versors step_chord, step_turn; ///< … first internode's rotation, each further's
    FrKey key;
    FrPlaces places; ///< of a Tree
} FrStem;

/// Measures the stem of the instance whose variables are set.
FrStem fr_stem_measure(const FrPrepared *prepared, FrEvaluator *evaluator, FrStemBase base);
/// Radius at `at`, 0 at the base to 1 at the tip, m.
double fr_stem_radius(const FrStem *stem, double at);
/// Where internode k ends along the stem, 0 to 1.
double fr_stem_node_end(const FrStem *stem, uint32_t k);
/// The internode that holds the point `at`, for place k of the stem's places.
uint32_t fr_stem_node_of(const FrStem *stem, double at, uint32_t place);
/// Fills rows first … of the plant's nodes, all on `axis`, whose offset and bearer are set, with
/// `start` the rotation from the bearer's frame to the stem's. Brings their cache up to date.
/// Returns the rotation from the last internode's frame to that of the very tip.
versors fr_stem_grow(const FrStem *stem, FrPlant *plant, uint32_t axis, uint32_t first,
                     versors start, const FrFields *fields);
/// Rotation of branch b about the stem at its place, without azimuth of its own, radians.
static inline double fr_branch_azimuth(const FrPlaces *places, uint32_t b) {
    uint32_t place = b / places->whorl;
    uint32_t member = b % places->whorl;
    return (double)place * places->divergence + (double)member * 6.283185307179586 / places->whorl;
}
