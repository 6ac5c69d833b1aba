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
    double step;             ///< m, most of an internode; 0: any
    bool is_in_field;        ///< other than plain gravity and light
    double bend, bend_aside; ///< radians, by hand
    const GArray *axis;      ///< drawn by hand, vec3s; NULL
    uint32_t order;
    bool is_on_ground; ///< borne by nothing
    double ahead;      ///< m, to what stems end at; less than 0: to nothing
    double place;      ///< on the parent, 0 to 1
    vec3s heading;     ///< of what it stands on, if it is aligned with that
} FrStemBase;

/// A stretch of a stem that forks: between two forks, or a fork and an end.
typedef struct FrLimb {
    double start, end;     ///< along the stem; an end of 1 is a tip
    double span;           ///< between them when all has grown
    uint32_t before;       ///< limb it grows from, FR_NONE
    uint32_t axis;         ///< which of the stem's axes it is on
    bool begins_axis;      ///< … as its first
    uint32_t forks;        ///< passed on the way to it
    uint32_t first;        ///< internode, of the stem's
    uint32_t internodes;   ///< ≥ 1
    double thinner;        ///< factor of radii
    double turn;           ///< radians, at its start
    double turn_x, turn_y; ///< … about x and y
    double straightness;   ///< part of it that is taken back up to its end
    FrKey key;
    uint16_t arms;                     ///< at each fork on the way which arm, two bits each
    uint32_t first_branch, end_branch; ///< of a Tree: those of the stem's that it bears
} FrLimb;

/// One stem, measured.
typedef struct FrStem {
    const FrPrepared *prepared;
    FrEvaluator *evaluator; ///< has the instance's variables, for what differs along the stem
    uint32_t internodes;
    double length;      ///< m
    double radius;      ///< m, at the base, without flare
    double radius_unit; ///< m of radius 1
    double taper, min_radius, flatness, flare;
    double whole; ///< part of the stem that is there; less than 1 where it is broken off or grows
    bool is_broken;
    double slim;        ///< part of its profile that is there; less than 1 where it is broken off
    double reach;       ///< how much of what will be there has grown; places are parts of that
    double growth_time; ///< years it grows for
    double curvature, twist, gnarl, gnarl_frequency; ///< radians; gnarls over the length
    double deviation;                                ///< radians; then places bend the stem
    double bend, bend_aside;                         ///< radians, by hand
    int course;                                      ///< FR_COURSE_…
    const GArray *path; ///< ends of internodes for FR_COURSE_PATH, vec3s
    uint32_t gaps;      ///< stretches between places where it bends; 0: evenly divided
    FrTropism tropism;
    double step; ///< m, most of an internode; 0: any
    bool is_in_field;
    double step_length, step_scale; ///< for FR_COURSE_STEPS
    double scale;
    versors step_chord, step_turn; ///< … first internode's rotation, each further's
    FrKey key;
    FrPlaces places;                         ///< of a Tree
    double gnarl_fine, gnarl_fine_frequency; ///< radians; over the length
    double curvature_back;                   ///< radians
    double align;                            ///< strength …
    vec3s align_to;                          ///< … and direction, in the plant's coordinates
    double aim;                              ///< the same to a direction given; 0 without one …
    vec3s aim_at;                            ///< … of length 1
    double elasticity;                       ///< Pa; 0: rigid
    double load;                             ///< in weights of its own
    double force_weight;
    uint32_t order;
    bool is_on_ground;
    double forks;
    FrLimb *limbs;       ///< parents first; owned; NULL: it does not fork
    uint32_t limb_count; ///< 1 unless it forks
    uint32_t axes, tips; ///< the same
} FrStem;

/// Measures the stem of the instance whose variables are set; to be cleared.
FrStem fr_stem_measure(const FrPrepared *prepared, FrEvaluator *evaluator, FrStemBase base);
void fr_stem_clear(FrStem *stem);
/// Age of what stands at a place of a growing stem, whose own age is given: it is born when the tip
/// comes there; less than 0 before.
double fr_stem_age_at(const FrStem *stem, double age, double at);
/// Radius at `at`, 0 at the base to 1 at the tip, m.
double fr_stem_radius(const FrStem *stem, double at);
/// How fast the stem sags at `at`, over its length and the sine of its angle from the vertical.
double fr_stem_sag(const FrStem *stem, double at);
/// Internodes that show how a measured stem bends and what its surface is like.
uint32_t fr_stem_internodes(const FrStem *stem);
/// Thickness along y over that along x at `at`.
double fr_stem_flatness(const FrStem *stem, double at);
/// The one limb of a stem that does not fork.
FrLimb fr_stem_whole(const FrStem *stem);
/// Limb k of a stem; `whole` is fr_stem_whole() of it.
static inline const FrLimb *fr_stem_limb(const FrStem *stem, const FrLimb *whole, uint32_t k) {
    return stem->limbs != NULL ? &stem->limbs[k] : whole;
}
/// Where internode k ends along a stem that does not fork, 0 to 1.
double fr_stem_node_end(const FrStem *stem, uint32_t k);
/// Where internode k of a limb ends along the stem.
double fr_limb_node_end(const FrStem *stem, const FrLimb *limb, uint32_t k);
/// Radius of a limb at `at` of the stem, m.
double fr_limb_radius(const FrStem *stem, const FrLimb *limb, double at);
/// The internode of a limb that holds the point `at` of the stem, for place k of the stem's places;
/// *back receives how far before its end that is, in internodes.
uint32_t fr_limb_node_of(const FrStem *stem, const FrLimb *limb, double at, uint32_t place,
                         double *back);
/// Fills rows first … of the plant's nodes, all on `axis`, whose offset and bearer are set, with
/// `start` the rotation from the bearer's frame to the stem's. The limb it grows from has grown.
/// Brings their cache up to date. Returns the rotation from the last internode's frame to that of
/// the very tip. A limb that has met what it ends at has short last rows that are marked FR_SHED;
/// *end receives the node that what follows stands on.
versors fr_limb_grow(const FrStem *stem, const FrLimb *limb, FrPlant *plant, uint32_t axis,
                     uint32_t first, versors start, const FrFields *fields, uint32_t *end);
/// Rotation of branch b about the stem at its place, without azimuth of its own, radians.
static inline double fr_branch_azimuth(const FrPlaces *places, uint32_t b) {
    uint32_t place = b / places->whorl;
    uint32_t member = b % places->whorl;
    return (double)place * places->divergence + (double)member * 6.283185307179586 / places->whorl;
}
