/// @file builder.h
/// Builds documents off the main thread. Every request is a snapshot of a text with its revision;
/// of those that wait only the last is built. What was built last and right stays while something
/// is wrong. Pictures of materials are made on a thread of their own, once for each look.
#pragma once

#include "frond/growth.h"
#include "studio/model/counts.h"
#include "studio/model/ground.h"
#include "studio/model/overlay.h"
#include "studio/model/patch.h"
#include "studio/model/view.h"

typedef struct StudioBuilder StudioBuilder;

/// Something can be collected. Called from other threads: it only wakes the main one.
typedef void (*StudioWake)(void *user);

/// Where the time of a build went, in seconds.
typedef struct StudioTimes {
    double read, build, view;
} StudioTimes;

/// The outcome of a request.
typedef struct StudioBuilt {
    uint64_t revision;
    FrStatus status;
    FrDiags *diags;         ///< what is wrong, and warnings; with places in the text
    const StudioView *view; ///< NULL: nothing new to draw. Valid until studio_builder_release()
    GArray *counts;         ///< StudioCount; NULL without a view
    GArray *loads;          ///< StudioPlantLoad; NULL without a view
    StudioTimes times;
    bool is_growing;           ///< its plants grow bud by bud, …
    uint64_t step, step_count; ///< … are at this step, of so many that the document asks for
    uint64_t round;            ///< of the builder's own
    bool is_forgotten;         ///< asked for before studio_builder_forget()
} StudioBuilt;

/// A map of a material.
typedef struct StudioPicture {
    FrDigest digest; ///< of the look
    FrMap map;
    FrImage *image;  ///< a reference; NULL: it has none
    bool is_clamped; ///< not repeated: leaves
} StudioPicture;

/// What was picked, and lines that show it.
typedef struct StudioPicked {
    char *plant, *component; ///< ids; NULL: none
    FrKey path;
    bool is_organ;
    double distance;
    GArray *lines; ///< float[3], in pairs, in the scene's coordinates
} StudioPicked;

/// What stands, for who looks at it between builds; borrowed for the time of the call.
typedef struct StudioSeen {
    const FrScene *scene;
    const FrGrowth *growth; ///< NULL: nothing grows bud by bud
} StudioSeen;

/// Looks at what stands. Called on the builder's thread, when it has changed or
/// studio_builder_look() was called, and nothing is to be built; cancelled by the next request.
/// `seen` NULL: what stands is about to change or go, and nothing of it may be kept.
typedef void (*StudioWatch)(void *user, const StudioSeen *seen, const FrContext *context);

StudioBuilder *studio_builder_new(StudioWake wake, void *user);
/// Cancels what runs, waits for it and frees everything.
void studio_builder_free(StudioBuilder *builder);
/// What of a document is shown: `time` in years for the clocks of all plants, NAN: as it says;
/// `step` for plants that grow bud by bud, < 0: as it says.
typedef struct StudioMoment {
    double time;
    int64_t step;
} StudioMoment;

/// Who looks; before the first request.
void studio_builder_watch(StudioBuilder *builder, StudioWatch watch, void *user);
/// Asks for another look.
void studio_builder_look(StudioBuilder *builder);
/// Asks for a document at a moment.
void studio_builder_request(StudioBuilder *builder, FrSource *source, const char *folder,
                            uint64_t revision, StudioMoment moment);
/// Another document comes: what waits is dropped and what runs is stopped. What was made already
/// is still handed out, as forgotten, since the next view may tell only how it differs from it.
void studio_builder_forget(StudioBuilder *builder);
/// Stops what runs; its status will be FR_CANCELLED.
void studio_builder_cancel(StudioBuilder *builder);
/// Whether something runs or waits, and how far it is (0 to 1); `seconds` since it began.
bool studio_builder_is_busy(StudioBuilder *builder, double *fraction, double *seconds);
/// Whether what runs is a look.
bool studio_builder_is_looking(StudioBuilder *builder);
/// The next outcome that is newer than those collected before, or NULL. The builder goes on only
/// after studio_builder_release().
const StudioBuilt *studio_builder_collect(StudioBuilder *builder);
void studio_builder_release(StudioBuilder *builder);
/// What is being built, as lines, where its surfaces will take longer than an eye waits; NULL:
/// there is nothing to show ahead. Taken before what is collected.
StudioOverlay *studio_builder_take_ahead(StudioBuilder *builder);
/// The next picture; free `image`. False: none is ready.
bool studio_builder_take_picture(StudioBuilder *builder, StudioPicture *picture);
/// Asks for the pictures of a material that no plant need have.
void studio_builder_paint(StudioBuilder *builder, FrMaterial *material);
/// Whether pictures are still being made.
bool studio_builder_is_painting(StudioBuilder *builder);
/// What of the last view a ray meets first, as in fr_scene_pick(). False: nothing, or the view is
/// just being replaced. Otherwise free with studio_picked_clear().
bool studio_builder_pick(StudioBuilder *builder, const double origin[3], const double direction[3],
                         double spread, StudioPicked *picked);
void studio_picked_clear(StudioPicked *picked);

/// Reads a scene, NULL: the view is just being replaced.
typedef void (*StudioUse)(void *user, const FrScene *scene);
/// Lets someone read what is shown; nothing is built meanwhile.
void studio_builder_use(StudioBuilder *builder, StudioUse use, void *user);

// ---- the scene below the pointer; see ground.h --------------------------------------------------

/// A plant that stands somewhere, of the last build.
typedef struct StudioStand {
    double at[3];
    uint32_t origin, number; ///< as of FrStand
} StudioStand;

/// What a ray meets first; while a build runs, of the ground alone.
StudioHit studio_builder_hit(StudioBuilder *builder, const double origin[3],
                             const double direction[3], double spread);
/// The ground of the last build, a reference; NULL: level, before the first.
StudioGround *studio_builder_ground(StudioBuilder *builder);
/// Where a component that deforms stands first, in the last build; false: nowhere.
bool studio_builder_footing(StudioBuilder *builder, const char *plant, const char *component,
                            StudioFooting *footing);
/// The box around all that an element of the document has placed (its byte, as FrStand.origin).
/// False: nothing, or a build runs.
bool studio_builder_bounds(StudioBuilder *builder, uint32_t origin, double min[3], double max[3]);
/// Where plants stand (StudioStand). Free with g_array_unref().
GArray *studio_builder_stands(StudioBuilder *builder);
