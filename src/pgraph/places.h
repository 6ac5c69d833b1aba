/// @file places.h
/// Where along a stem its branches stand.
///
/// Place k of K is where the share (k + ½)/K of the density between start and end lies below it;
/// with a given internode it is k internodes from start, so that a longer stem keeps its places.
/// At each place stands a whorl; from place to place the stem is turned by the divergence.
#pragma once

#include "frond/random.h"

enum { FR_DENSITY_STEPS = 256 };

/// Cumulated density at 0, 1/256 … 1 of the stem.
typedef struct FrDensity {
    double below[FR_DENSITY_STEPS + 1];
} FrDensity;

typedef struct FrPlaces {
    uint32_t branches;        ///< in all
    uint32_t whorl;           ///< branches at a place
    uint32_t count;           ///< places
    double start, end;        ///< along the stem, 0 to 1
    double pitch;             ///< first gap over the stem's length; 0: spread by density
    double ratio;             ///< each gap over the one before
    double irregularity;      ///< 0 even … 1 anywhere within its gap
    double divergence;        ///< turn from place to place
    bool is_at_ends;          ///< first and last stand at start and end
    const FrDensity *density; ///< NULL: even
    FrKey key;
} FrPlaces;

/// Places on a stretch of so many first gaps, the first at its beginning.
double fr_places_within(double stretch, double ratio);
/// Place k along the stem, 0 to 1, rising with k.
double fr_place_at(const FrPlaces *places, uint32_t k);
/// Where the share `part` of the density between start and end lies below.
double fr_density_place(const FrDensity *density, double start, double end, double part);
