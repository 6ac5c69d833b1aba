// The form of a blade: where its points are, whoever makes a surface of them.
#pragma once

#include "frond/plant.h"

enum { FR_BLADE_FINE = 64 };

enum { FR_LOBES_MOST = 20 };

/// A plane curve with the turn and the position at even steps.
typedef struct FrBent {
    double angle[FR_BLADE_FINE + 1], x[FR_BLADE_FINE + 1], y[FR_BLADE_FINE + 1]; ///< x straight on
} FrBent;

typedef struct FrBladeForm {
    const FrBlade *blade;
    double width, half;                                      ///< m
    FrBent petiole;                                          ///< of length 1; set if there is one
    FrBent along;                                            ///< of length 1
    FrBent across;                                           ///< of half a width, length 1
    vec3s base;                                              ///< end of the petiole
    const FrProfile *across_along, *fold_along, *wave_along; ///< NULL: the same all along
    double twist[FR_BLADE_FINE + 1];                         ///< up to even steps
} FrBladeForm;

/// False if the blade has no length or width: then it is but a petiole.
bool fr_blade_form_init(FrBladeForm *form, const FrPlant *plant, const FrBlade *blade);
/// The point of the blade at `along` (0 to 1) and `aside` metres to the right of the midrib.
void fr_blade_point(const FrBladeForm *form, double along, double aside, double point[3]);
/// The point of the petiole at `along`.
void fr_blade_petiole(const FrBladeForm *form, double along, double point[3]);
/// The surface's unit normal there.
vec3s fr_blade_normal(const FrBladeForm *form, double along, double aside);
