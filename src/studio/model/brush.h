/// @file brush.h
/// A brush that strews plants: none nearer to another than its density allows, so that painting a
/// place again fills gaps and no more.
#pragma once

#include <glib.h>

#include <stdbool.h>
#include <stdint.h>

typedef struct StudioBrush {
    double radius;  ///< m
    double density; ///< plants on a square metre, at most
    uint64_t seed;  ///< of a stroke
} StudioBrush;

/// How near plants may stand at a density: as many as so dense a strewing has.
double studio_brush_spacing(double density);
/// New places (double[2]) of dab number `dab` of a stroke about a point; `taken` (double[2]) are
/// those of what stands there, and receives them. The same for the same seed and dab. Free with
/// g_array_unref().
GArray *studio_brush_dab(const StudioBrush *brush, uint64_t dab, const double at[2], GArray *taken);
