// Cross-sections: what is swept along an axis.
#pragma once

#include "frond/plant.h"

/// One vertex column of a tube, for radius 1.
typedef struct FrColumn {
    float x, y;               ///< in the ring's plane
    float normal_x, normal_y; ///< unit, outwards
    float u;                  ///< 0 to 1 around
} FrColumn;

enum { FR_REACH_COUNT = 64, FR_SECTION_FARTHEST = 1000000 };

/// Counter-clockwise seen from the tip. A closed section repeats its first column at its end with
/// u = 1, so that a texture has a seam to wrap at.
typedef struct FrSection {
    FrColumn *columns; ///< owned
    uint32_t count;    ///< columns: bands have count − 1 quads
    uint32_t *cap;     ///< owned: (count − 3) triangles over the first count − 1 columns
    bool is_closed;
    bool is_round;               ///< position and normal are the same
    float reach[FR_REACH_COUNT]; ///< distance of the margin from the centre by direction
} FrSection;

/// A regular polygon in the unit circle.
void fr_section_round(FrSection *section, uint32_t sides);
/// The polygon of a profile. False if too few distinct finite points are left of it.
bool fr_section_profile(FrSection *section, const FrProfile *profile);
/// True for a point that is not left out.
bool fr_section_is_near(const double point[2]);
/// Finite points of a profile without repetitions, written to `points`, which has room for all.
/// Answers how many.
uint32_t fr_section_points(const FrProfile *profile, double (*points)[2]);

/// What a profile has that no sound surface comes of; the first that is found.
typedef enum FrSectionFault {
    FR_SECTION_SOUND,
    FR_SECTION_FEW,     ///< too few distinct points: it is not used
    FR_SECTION_FAR,     ///< points that are no numbers or too far away, which are left out
    FR_SECTION_TOUCHES, ///< closed, but crosses, touches or runs back over itself
} FrSectionFault;

enum { FR_SECTION_LOOKED_MOST = 1000 };
/// Of more than FR_SECTION_LOOKED_MOST points it is not looked whether they touch.
FrSectionFault fr_section_fault(const FrProfile *profile);
void fr_section_clear(FrSection *section);
/// Distance of the margin from the centre towards (x, y), which need not be of length 1.
float fr_section_reach(const FrSection *section, float x, float y);
