// What the parts of the rational skin share: cross-sections, paths, shapes.
#pragma once

#include "frond/nurbs_skin.h"

#include "skin/plan.h"

#include <math.h>

// ---- vectors in double precision ---------------------------------------------------------------

static inline double fr_dot3(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void fr_cross3(const double a[3], const double b[3], double out[3]) {
    double x = a[1] * b[2] - a[2] * b[1], y = a[2] * b[0] - a[0] * b[2];
    double z = a[0] * b[1] - a[1] * b[0];
    out[0] = x;
    out[1] = y;
    out[2] = z;
}

/// Makes `v` a unit vector and answers how long it was.
static inline double fr_unit3(double v[3]) {
    double length = sqrt(fr_dot3(v, v));
    for (int k = 0; k < 3 && length > 0.0; k++) {
        v[k] /= length;
    }
    return length;
}

/// For tables of 64-bit keys: GLib's own hash drops the upper half of a key.
static inline guint fr_key_hash(gconstpointer key) {
    uint64_t bits = *(const uint64_t *)key * 0x9e3779b97f4a7c15U;
    return (guint)(bits >> 32);
}

/// True if a text has been said already; nurbs_left_out.c.
bool fr_nurbs_is_told(const FrDiags *diags, const char *text);

// ---- nurbs_section.c: what is swept ------------------------------------------------------------

/// A cross-section that may turn into another along the branch: both have the same knots.
typedef struct FrNurbsSection {
    FrNurbsCurve from, to; ///< the same curve twice, shared, unless it changes
    bool is_round, is_closed, changes;
} FrNurbsSection;

typedef struct FrNurbsSections {
    GArray *sections;  ///< FrNurbsSection
    GHashTable *index; ///< from (from + 1) << 32 | to + 1 of profiles to index + 1
} FrNurbsSections;

void fr_nurbs_sections_init(FrNurbsSections *sections);
void fr_nurbs_sections_clear(FrNurbsSections *sections);
/// The section that turns from one profile into another (the same: it does not change), made if it
/// is new. FR_NONE is a circle.
uint32_t fr_nurbs_section(FrNurbsSections *sections, const FrPlan *plan, uint32_t from, uint32_t to,
                          const FrNurbsParams *params);

// ---- nurbs_path.c: where it is swept along -----------------------------------------------------

/// A point of a path.
typedef struct FrNurbsStation {
    double at[3];
    double radius, flatness;
    uint32_t node; ///< whose frame turns a profile; FR_NONE: x is the plant's
} FrNurbsStation;

/// Scratch, grown as needed.
typedef struct FrNurbsPath {
    FrNurbsStation *stations; ///< owned
    double *along; ///< owned; fr_nurbs_sweep() fills it: 0 at the beginning, 1 at the end
    uint32_t count, room;
    uint32_t shared; ///< stations at the beginning that belong to the parent
} FrNurbsPath;

/// The path of a tube: what it shares with its parent, its origin and the tips of its nodes, those
/// left out that repeat the one before. Fewer than two points: nothing to sweep.
/// `has_fork`: fork surfaces lead into it, so it shares nothing and leaves the fork straight on.
void fr_nurbs_path(FrNurbsPath *path, const FrPlan *plan, const FrTube *tube,
                   const FrNurbsParams *params, bool has_fork);
void fr_nurbs_path_clear(FrNurbsPath *path);
/// Appends a point unless it repeats the last one or is nowhere.
void fr_nurbs_path_add(FrNurbsPath *path, const double at[3], double radius, double flatness,
                       uint32_t node);
/// How many rows of control points, and with that row + 4 knots, the path makes; 0 for none.
uint32_t fr_nurbs_rows(const FrNurbsPath *path, const FrNurbsParams *params);

// ---- nurbs_sweep.c: control nets ---------------------------------------------------------------

/// Writes the net (rows × points of the section) and its knots along the path. `plan` may be NULL
/// for a path without nodes.
void fr_nurbs_sweep(FrNurbsPath *path, const FrNurbsSection *section, const FrPlan *plan,
                    const FrNurbsParams *params, double (*net)[4], double *knots);

// ---- nurbs_shape.c, nurbs_leaf.c: organs -------------------------------------------------------

/// A surface of a shape that owns its arrays.
typedef struct FrNurbsForm {
    uint32_t kind; ///< FrNurbsKind
    uint32_t degree_u, degree_v, count_u, count_v;
    double *knots_u, *knots_v;
    double (*points)[4];
    double (*texture)[2]; ///< by control point; NULL
} FrNurbsForm;

/// Appends a form with room for its arrays; answers it.
FrNurbsForm *fr_nurbs_form_add(GArray *forms, uint32_t kind, uint32_t degree_u, uint32_t count_u,
                               uint32_t degree_v, uint32_t count_v);
/// The surfaces of a shape at scale 1 in its own frame, as a GArray of FrNurbsForm that clears its
/// elements. Counted before: at most fr_nurbs_shape_bytes_most().
GArray *fr_nurbs_shape(const FrPlant *plant, const FrShape *shape, const FrNurbsParams *params);
uint64_t fr_nurbs_shape_bytes_most(const FrPlant *plant, const FrShape *shape,
                                   const FrNurbsParams *params);
uint64_t fr_nurbs_leaf_bytes_most(const FrBlade *blade, const FrNurbsParams *params);
/// Appends petiole and halves of a blade, or those of a compound leaf.
void fr_nurbs_leaf(GArray *forms, const FrPlant *plant, const FrBlade *blade,
                   const FrNurbsParams *params);

// ---- nurbs_factors.c: what changes the plant before, and organs after --------------------------

/// Wind, light or gravity act.
bool fr_nurbs_is_blown(const FrNurbsParams *params);
/// Bends the control points of an organ that has been placed; `pieces` are its surfaces and
/// `points` what they borrow.
void fr_nurbs_blow_organ(const FrNurbsParams *params, const FrPlant *plant, uint32_t organ,
                         const FrNurbsPiece *pieces, uint32_t count, double (*points)[4]);
