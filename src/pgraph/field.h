/// @file field.h
/// Fields that turn stems and leaves: gravity and light as functions of position, and forces.
#pragma once

#include "pgraph/evaluate.h"
#include "pgraph/prepare.h"
#include "pgraph/tropism.h"

/// One instance of a World or a Force. Fields act on all that follows on them.
typedef struct FrField {
    uint32_t outer;                 ///< the field around it, FR_NONE
    uint32_t component;             ///< what it is an instance of
    double at[3];                   ///< where it stands, in the plant's coordinates …
    double axes[3][3];              ///< … columns are its axes
    double scale;                   ///< metres of a unit of its coordinates
    uint32_t order;                 ///< of the stems that stand on it
    double strength, radius, pitch; ///< of a Force
    double sun[3];                  ///< of a World: towards it, in its own coordinates
} FrField;

/// What acts on one stem or leaf.
typedef struct FrFields {
    const FrField *fields;
    const FrPrepared *prepared; ///< by component
    uint32_t innermost;         ///< FR_NONE: plain gravity and light
    uint32_t order;             ///< of the stem or leaf
    FrEvaluator *evaluator;     ///< takes note of formulas without value
    const FrLightField *light;  ///< for Worlds that sample it; NULL
} FrFields;

/// What turns a stem on its way.
typedef struct FrDraw {
    FrTropism tropism; ///< over the stem's length
    double length;     ///< m, of the stem
    double finest;     ///< m, > 0: the longest internode that its fields allow
    double weight;     ///< factor of forces
} FrDraw;

/// Gravity, 1 where it is plain, at a point in the plant's coordinates.
void fr_field_gravity(const FrFields *fields, const double at[3], double gravity[3]);
/// Towards the light, in the same way.
void fr_field_light(const FrFields *fields, const double at[3], double light[3]);
/// The rotation, in the plant's coordinates, of a stem that has `frame` at `from` and grows on for
/// a part `step` of its length. Independent of how a stem is cut into steps but for second order.
versors fr_field_turn(const FrFields *fields, const FrDraw *draw, versors frame, vec3s from,
                      double step);
/// How far an internode of `length` metres may go from `from` until it meets what stems end at or
/// are cut off at; `length` if it meets nothing. What begins inside of a force has gone no way at
/// all, but where its bit of *out is not set; that is set as soon as one is outside of it. *is_cut
/// receives which of both.
double fr_field_free(const FrFields *fields, versors frame, vec3s from, double length,
                     uint64_t *out, bool *is_cut);
/// The rotation that keeps an internode of `length` metres, `radius` thick, out of solid forces.
/// False if it need not turn.
bool fr_field_deflect(const FrFields *fields, versors frame, vec3s from, double length,
                      double radius, versors *turn);
