/// @file bark.h
/// Tileable fields that barks are made of. Coordinates u, v run from 0 to 1 over the tile, v down,
/// and every field continues over all four edges.
#pragma once

#include "material/texture.h"

/// Gradient noise in about [-1, 1] with `across` cells in u and `along` cells in v: unlike
/// fr_noise2_tiled() it may be stretched along the stem.
float fr_bark_noise(FrKey key, float u, float v, int across, int along);
/// Sum of `octaves` noises, each twice as fine and half as strong, in about [-1, 1].
float fr_bark_fractal(FrKey key, float u, float v, int across, int along, int octaves);

/// Jittered sites, one a cell of a grid over the tile.
typedef struct FrBarkCells {
    int across, along;
    float *sites;  ///< two a cell, within the cell, 0 to 1
    float *random; ///< one a cell, 0 to 1
} FrBarkCells;

void fr_bark_cells_init(FrBarkCells *cells, FrKey key, int across, int along, float jitter);
void fr_bark_cells_clear(FrBarkCells *cells);

/// A place in the Voronoi diagram of the sites, in which a grid cell is a unit square.
typedef struct FrBarkPlate {
    float edge;    ///< distance to the nearest border
    float upright; ///< of the borders near: 1 runs along the stem, 0 across
    float random;  ///< of the plate, 0 to 1
    float other;   ///< the same of the plates beyond the borders near
} FrBarkPlate;

FrBarkPlate fr_bark_plate(const FrBarkCells *cells, float u, float v);

float fr_bark_smooth(float low, float high, float value);
