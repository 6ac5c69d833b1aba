// Cross-sections: what is swept along an axis.
#pragma once

#include "frond/plant.h"

/// One vertex column of a tube, for radius 1.
typedef struct FrColumn {
    float x, y;               ///< in the ring's plane
    float normal_x, normal_y; ///< unit, outwards
    float u;                  ///< 0 to 1 around
} FrColumn;

enum { FR_REACH_COUNT = 64 };

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
void fr_section_clear(FrSection *section);
/// Distance of the margin from the centre towards (x, y), which need not be of length 1.
float fr_section_reach(const FrSection *section, float x, float y);
