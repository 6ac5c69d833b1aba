// What the parts of tube writing share: the state that goes along a run, and its rings.
#pragma once

#include "skin/bark.h"
#include "skin/tube.h"

#include <string.h>

/// Where a ring stands before it has a direction.
typedef struct FrStation {
    vec3s at;
    float radius, flatness;
    float v;
    uint32_t node; ///< whose frame turns it
} FrStation;

/// A ring ready to be written.
typedef struct FrRing {
    vec3s at;
    vec3s tangent, x, y;   ///< unit
    vec3s across, upwards; ///< x and y times the radii, stretched at joints
    float slope;           ///< of the radius
    float flatness;
    float v;
} FrRing;

/// What goes along a run.
typedef struct FrSweep {
    const FrPlan *plan;
    const FrRun *run;
    const FrTube *tube;
    const FrSection *section;
    FrUpAxis up;
    FrBark bark;
    vec3s heading; ///< of the band that was last, and …
    vec3s side;    ///< … the x direction carried along it; both unit
    FrRing ring;   ///< the last one written
    bool has_ring;
    uint32_t node;          ///< the next to be looked at; FR_NONE: past the end
    bool is_before_tip;     ///< only the tip is left, after its shoulder
    float radius;           ///< at the node before
    float v;                ///< there
    const FrFinish *finish; ///< with ridges or relief, NULL
    float foot;             ///< … radius of the run's base, m
    float along;            ///< … m from its base to the last ring
    FrKey key;              ///< … of the run
    FrVertex *vertex;
    uint32_t *index;
    uint32_t count; ///< of vertices so far, from the part's first
} FrSweep;

/// Stores a vector of the plant as the mesh wants it.
static inline void fr_put(float out[3], vec3s v, FrUpAxis up) {
    v = fr_upright(v, up);
    memcpy(out, v.raw, sizeof v.raw);
}

// ---- ring.c: vertices and triangles ------------------------------------------------------------

/// Writes a ring and, with `has_band`, the quads to the ring written before.
void fr_write_ring(FrSweep *sweep, const FrRing *ring, bool has_band);
/// Counts a ring whose vertices the caller has written.
void fr_ring_done(FrSweep *sweep, bool has_band);
/// Closes the last ring to a point.
void fr_write_apex(FrSweep *sweep, const FrStation *tip, float slope);
/// The normal of a ring where its section has the normal (x, y).
vec3s fr_ring_normal(const FrRing *ring, float x, float y);

// ---- relief.c: ridges and relief ---------------------------------------------------------------

/// Writes the vertices of a ring that stand out from its section.
void fr_write_rough(const FrSweep *sweep, const FrRing *ring);

// ---- cap.c: ends -------------------------------------------------------------------------------

/// Writes what closes a tube whose rings are written, the first of them `first`.
void fr_write_ends(FrSweep *sweep, const FrRing *first);

// ---- joint.c: directions -----------------------------------------------------------------------

/// Turns `v`, which is across unit `from`, by the smallest rotation from `from` to `to`.
vec3s fr_carried_any(vec3s v, vec3s from, vec3s to);
/// The same for a unit vector, without drifting from length 1.
vec3s fr_carried(vec3s v, vec3s from, vec3s to);
/// The x direction of `frame`, made perpendicular to `tangent`.
vec3s fr_frame_side(versors frame, vec3s tangent);
/// The ring at a joint, from the heading so far to `onward`, which becomes the heading.
FrRing fr_joint_ring(FrSweep *sweep, const FrStation *station, vec3s onward, float slope);

// ---- station.c: where rings stand --------------------------------------------------------------

FrStation fr_station_at(const FrSweep *sweep, uint32_t node, float v);
/// The node of the tube after `from` where a ring stands, its shoulder or its last.
FrStation fr_next_station(FrSweep *sweep, const FrStation *from);
/// v of the bark `distance` metres along the tube.
float fr_v_at(const FrSweep *sweep, float distance);

// ---- base.c: how branches begin ----------------------------------------------------------------

/// Writes what comes before the first station; sets `station` to it. False if the station's ring
/// has been written too.
bool fr_start_branch(FrSweep *sweep, FrStation *station);
