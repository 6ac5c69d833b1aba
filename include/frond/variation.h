/// @file variation.h
/// New plants from a given one by the shape of its branches: strokes drawn in space, indicators of
/// motion, and growth that senses and reacts late.
///
/// After: Sketch-based plant variation (Streit et al.), on a base plant of any engine. What a
/// variation changes is the direction of internodes and nothing else: which branch bears which, how
/// long and thick they are and at which angle a branch leaves its bearer stay the base's. Straight
/// branches of few internodes are first cut into more, to have joints to bend at. The base is never
/// written to.
///
///     base plant ─┬─ skeleton ── selection (pen over a view) ──┐
///                 │              strokes (pen in space) ───────┤
///                 │              indicators ───────────────────┴─ FrVary
///                 └──────────── fr_vary_prepare ── FrVaryPlan ── fr_vary_instance(seed) ── plant
///
/// A *branch* is an axis of the plant; it is chosen by name. A choice is a list of words separated
/// by blanks: `limb` is every axis that component made, `limb:3` the third of them (in the order of
/// the plant, from 1), `#0123456789abcdef` the axis of that path. Nothing is the whole plant.
#pragma once

#include "frond/param.h"
#include "frond/plant.h"
#include "frond/skeleton.h"

#include <cglm/types-struct.h>

// ---- selection --------------------------------------------------------------------------------

/// Which branch is seen at every pixel of a view.
typedef struct FrIdBuffer {
    uint32_t width, height;
    uint32_t *branch; ///< axis in front, FR_NONE; rows from the top
    float *depth;     ///< of what is in front, as `project` gives it; INFINITY
} FrIdBuffer;

/// Draws the skeleton, every internode as a line of `thickness` pixels (at least 1), what is in
/// front covering what is behind. `project` takes the plant's coordinates to a cube from −1 to 1, x
/// to the right, y up, z away (after division by w). Reads the cache.
FR_API FR_MUST_USE FrStatus fr_id_buffer_draw(const FrPlant *plant, mat4s project, uint32_t width,
                                              uint32_t height, double thickness,
                                              const FrContext *context, FrIdBuffer **buffer);
FR_API void fr_id_buffer_free(FrIdBuffer *buffer);

typedef enum FrSelectionState {
    FR_UNSELECTED,
    FR_SELECTED,
    FR_UNDETERMINED, ///< touched, but what follows decides
} FrSelectionState;

/// What becomes of undetermined branches when the pen is lifted.
typedef enum FrSelectionEnd {
    FR_END_KEEPS_PATH, ///< the one most touched is selected: the result is always one path
    FR_END_PUBLISHED,  ///< all are selected, as the paper has it
} FrSelectionEnd;

/// The selection of a path of branches, each borne by the one before, by one stroke of a pen.
typedef struct FrSelection FrSelection;

/// Nothing selected. The plant must outlive the selection and keep its axes.
FR_API FrSelection *fr_selection_new(const FrPlant *plant);
FR_API void fr_selection_free(FrSelection *selection);
/// Begins anew: nothing selected, the pen is lifted.
FR_API void fr_selection_clear(FrSelection *selection);
/// The pen touches a branch (FR_NONE: none).
FR_API void fr_selection_touch(FrSelection *selection, uint32_t branch);
/// The pen moves in a straight line to a pixel and touches what is in front at every pixel on its
/// way; the first point of a stroke only touches. Points outside the view touch nothing.
FR_API void fr_selection_move(FrSelection *selection, const FrIdBuffer *view, double x, double y);
/// The pen is lifted. A further stroke goes on from the end of the path.
FR_API void fr_selection_end(FrSelection *selection, FrSelectionEnd end);
/// Selects the path between two branches, in either order. False, and nothing changes, if neither
/// bears the other.
FR_API bool fr_selection_between(FrSelection *selection, uint32_t one, uint32_t other);
FR_API FrSelectionState fr_selection_state(const FrSelection *selection, uint32_t branch);
/// The selected branches from the base on, as a choice of paths. Free with g_free().
FR_API char *fr_selection_choice(const FrSelection *selection);

// ---- strokes ----------------------------------------------------------------------------------

typedef struct FrStrokePoint {
    vec3s at;       ///< m, in any place and size: a stroke is scaled and turned to its branch
    float pressure; ///< 0 to 1
    double time;    ///< s
} FrStrokePoint;

/// A line drawn in space, kept as the hand drew it. Immutable, reference counted.
typedef struct FrStroke FrStroke;

/// Copies the points. NULL if there are fewer than two different ones, or one is not finite or
/// farther than 10⁹ m from the origin.
FR_API FrStroke *fr_stroke_new(const FrStrokePoint *points, size_t count);
FR_API FrStroke *fr_stroke_ref(FrStroke *stroke);
FR_API void fr_stroke_unref(FrStroke *stroke);
FR_API const FrStrokePoint *fr_stroke_points(const FrStroke *stroke, size_t *count);
FR_API double fr_stroke_length(const FrStroke *stroke);
/// The point so many metres along the stroke, and the unit direction there (may be NULL); clamped
/// to its ends.
FR_API void fr_stroke_at(const FrStroke *stroke, double distance, double point[3],
                         double direction[3]);
/// Reads `x,y,z x,y,z …`, each point with a pressure and a time if it has more numbers. NULL with
/// a diagnostic at `span` if the text is wrong.
FR_API FrStroke *fr_stroke_parse(const char *text, FrSpan span, FrDiags *diags);
/// The text that fr_stroke_parse() reads. Free with g_free().
FR_API char *fr_stroke_text(const FrStroke *stroke);
/// Directions of `count` internodes that go along the whole stroke: the stroke is cut by arc length
/// as the branch is by its joints; `lengths` are the internodes'. Where all are 0, evenly.
FR_API void fr_stroke_resample(const FrStroke *stroke, const float *lengths, size_t count,
                               vec3s *headings);

// ---- pens -------------------------------------------------------------------------------------

/// What a pen does. Position and height may come from different devices at different times.
typedef enum FrPenEventKind {
    FR_PEN_DOWN,   ///< a stroke begins
    FR_PEN_MOVE,   ///< x, y, pressure and time are new
    FR_PEN_HEIGHT, ///< height and time are new: a wheel, a tilt, a slider, a potentiometer
    FR_PEN_UP,     ///< the stroke ends
} FrPenEventKind;

typedef struct FrPenEvent {
    FrPenEventKind kind;
    double x, y;     ///< m on the drawing board
    double pressure; ///< 0 to 1
    double height;   ///< m, of the board
    double time;     ///< s
} FrPenEvent;

/// A device with (x, y, pressure, height).
typedef struct FrPen {
    /// The next event, in the order of time; false if there is none (yet).
    bool (*next)(void *device, FrPenEvent *event);
    void (*free)(void *device);
    void *device;
    FrPenEvent height; ///< the last height heard of; kept by fr_pen_stroke(), begins as zeros
} FrPen;

/// A device that speaks the line protocol (docs/variation.md) in `text`. Lines that make no sense
/// are left out; *wrong (may be NULL) counts them.
FR_API FrPen *fr_pen_from_lines(const char *text, size_t size, size_t *wrong);
/// A device that replays events. Copies them.
FR_API FrPen *fr_pen_simulated(const FrPenEvent *events, size_t count);
FR_API void fr_pen_free(FrPen *pen);
/// The line of the protocol for an event, with its line end. Free with g_free().
FR_API char *fr_pen_line(const FrPenEvent *event);
/// Reads on until a stroke has ended and returns it; NULL if there is no whole one (a stroke of
/// fewer than two points is passed over). Board and height become x, y and z. Where the height
/// comes less often than the position it is drawn evenly between the times it was heard of.
FR_API FrStroke *fr_pen_stroke(FrPen *pen);

// ---- growth -----------------------------------------------------------------------------------

/// Settings of growth. X rows as in param.h; in the struct angles are in radians.
#define FR_VARY_PARAMS(X)                                                                          \
    X(TEXT, base, "", 0, 0, "", "", "id of the plant that is varied")                              \
    X(REAL, scatter, "2", 0, 45, "deg", "", "random turn at every joint; 0: none")                 \
    X(REAL, persistence, "0.5", 0, 0.95, "", "", "how much of a joint's random turn the next has") \
    X(INTEGER, delay, "2", 0, 8, "", "", "joints from sensing a direction to reacting to it")      \
    X(REAL, feedback, "0.243", 0, 0.95, "", "",                                                    \
      "strength of the reaction; 1 would be the least that swings for ever")                       \
    X(REAL, proprioception, "0", 0, 0.9, "", "",                                                   \
      "how much of a joint's turn the next one takes back: straightens")                           \
    X(REAL, anticipation, "0.9", 0, 1, "", "",                                                     \
      "how much of a stroke's turns is followed at once; the rest is sensed late")                 \
    X(INTEGER, joints, "4", 1, 64, "", "",                                                         \
      "least number of internodes of a branch that is varied; longer ones are cut into as many")   \
    X(REAL, tilt, "10", 0, 80, "deg", "",                                                          \
      "lasting tilt of a branch under an indicator of one metre across it")

typedef struct FrVaryParams {
    FR_VARY_PARAMS(FR_PARAM_FIELD)
} FrVaryParams;

FR_API const FrParamTable *fr_vary_table(void);

/// Which branches something is for, starting from those chosen.
typedef enum FrApply {
    FR_APPLY_SELECTED,
    FR_APPLY_DESCENDANTS, ///< all that they bear, directly or not
    FR_APPLY_BOTH,
} FrApply;

/// A stroke in a document; its text is its points.
#define FR_STROKE_PARAMS(X)                                                                        \
    X(TEXT, select, "", 0, 0, "", "",                                                              \
      "branches it shapes: ids of components, `id:3` for the third, `#path`; empty: all")          \
    X(CHOICE, apply, "selected", 0, 0, "", "selected descendants both",                            \
      "the branches selected, all that they bear, or both; later strokes win")

/// What an indicator stands for. Only its vector counts.
#define FR_INDICATOR_PARAMS(X)                                                                     \
    X(CHOICE, kind, "wind", 0, 0, "", "wind sun rain", "what it stands for")                       \
    X(VECTOR, from, "0, 0, 0", -1000000, 1000000, "m", "", "where it was begun")                   \
    X(VECTOR, to, "0, 0, 0", -1000000, 1000000, "m", "", "where it was ended")                     \
    X(TEXT, select, "", 0, 0, "", "", "branches it is mapped to, as for strokes; empty: all")      \
    X(CHOICE, apply, "both", 0, 0, "", "selected descendants both",                                \
      "the branches selected, all that they bear, or both")

typedef struct FrStrokeParams {
    FR_STROKE_PARAMS(FR_PARAM_FIELD)
} FrStrokeParams;
typedef struct FrIndicatorParams {
    FR_INDICATOR_PARAMS(FR_PARAM_FIELD)
} FrIndicatorParams;

FR_API const FrParamTable *fr_stroke_table(void);
FR_API const FrParamTable *fr_indicator_table(void);

/// The largest gain of the reaction, in turns per turn, with which no direction swings for ever:
/// for proprioception 0 it is 2 cos(dπ / (2d + 1)). `feedback` is a part of it.
FR_API double fr_vary_gain_limit(uint32_t delay, double proprioception);
/// The largest gain with which nothing swings at all, without proprioception:
/// d^d / (d + 1)^(d + 1).
FR_API double fr_vary_calm_limit(uint32_t delay);

/// Settings, strokes and indicators, for any plant.
typedef struct FrVary FrVary;

/// Copies the settings.
FR_API FrVary *fr_vary_new(const FrVaryParams *params);
FR_API void fr_vary_free(FrVary *vary);
FR_API FrVaryParams *fr_vary_params(FrVary *vary);
/// Adds a stroke for the branches chosen (NULL or "": all). Takes a reference.
FR_API void fr_vary_add_stroke(FrVary *vary, FrStroke *stroke, const char *choice, FrApply apply,
                               FrSpan span);
/// Adds an indicator, a vector in the plant's coordinates. All that meet on a branch are summed.
FR_API void fr_vary_add_indicator(FrVary *vary, vec3s vector, const char *choice, FrApply apply,
                                  FrSpan span);

/// A variation made ready for one plant.
typedef struct FrVaryPlan FrVaryPlan;

/// Finds the branches chosen. FR_ERR_DOCUMENT with "unknown-branch" where a choice names none. Base
/// and vary must outlive the plan, unchanged; the base's cache must be up to date.
FR_API FR_MUST_USE FrStatus fr_vary_prepare(const FrVary *vary, const FrPlant *base,
                                            const FrContext *context, FrVaryPlan **plan);
FR_API void fr_vary_plan_free(FrVaryPlan *plan);
/// What instances are copies of: the base or, where branches had too few joints to bend at, the
/// base with more of them. Lives as long as the plan and the base.
FR_API const FrPlant *fr_vary_plan_base(const FrVaryPlan *plan);
/// The number of the stroke that shapes an axis, in the order they were added; FR_NONE.
FR_API uint32_t fr_vary_stroke_of(const FrVaryPlan *plan, uint32_t axis);
/// One instance: a copy of the base with other rotations, its cache up to date. The same plan and
/// seed give the same bits, and each branch its own draws, whatever else the plant bears.
FR_API FrPlant *fr_vary_instance(const FrVaryPlan *plan, uint64_t seed);
/// The same, written over a copy of the plan's base or another instance of the plan.
FR_API void fr_vary_into(const FrVaryPlan *plan, uint64_t seed, FrPlant *instance);
/// Instances of seeds `seed`, `seed` + 1, …, in parallel. FR_ERR_LIMIT if together they would take
/// more than the limits allow. `instances` has room for `count`; on failure all are NULL.
FR_API FR_MUST_USE FrStatus fr_vary_collection(const FrVaryPlan *plan, uint64_t seed,
                                               uint32_t count, const FrContext *context,
                                               FrPlant **instances);
/// Digest of what no variation changes: topology, lengths, radii, attachment, organs.
FR_API FrDigest fr_vary_topology_digest(const FrPlant *plant);
