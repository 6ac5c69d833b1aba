// How the stalks and leaflets of a compound leaf stand, whoever makes something of them.
#pragma once

#include "frond/plant.h"

#include "skin/plan.h"

enum { FR_STALK_PIECES = 24 };

/// A petiole and the rachis behind it, in the plane of y and z.
typedef struct FrStalk {
    float petiole, rachis;         ///< m
    vec3s at[FR_STALK_PIECES + 1]; ///< at even steps
    float angle[FR_STALK_PIECES + 1];
    float radius; ///< m, at its base
} FrStalk;

/// A frame on a stalk: z goes on, y is its upper side.
typedef struct FrStalkPlace {
    vec3s at, x, y, z;
} FrStalkPlace;

float fr_stalk_length(const FrStalk *stalk);
FrStalkPlace fr_stalk_place(const FrStalk *stalk, float way);
float fr_stalk_radius(const FrStalk *stalk, float part);
/// A vector of the place's frame.
vec3s fr_stalk_vector(const FrStalkPlace *place, const float v[3]);

/// What makes things of stalks and leaflets, one after the other.
typedef struct FrCompoundMaker {
    uint32_t (*count)(void *user); ///< of all that has been made
    void (*stalk)(void *user, const FrStalk *stalk);
    void (*leaflet)(void *user, const FrBlade *leaflet);
    /// Puts all from `first` on, which stands at the origin, to a place.
    void (*put)(void *user, uint32_t first, const FrStalkPlace *place, float scale);
    void *user;
} FrCompoundMaker;

/// A leaf with so many pinnae and leaflets; see FrBlade.
void fr_compound_make(const FrCompoundMaker *maker, const FrPlant *plant, const FrBlade *blade,
                      uint32_t pairs, uint32_t pinnae);
