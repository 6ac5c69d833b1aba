/// @file builder_private.h
/// What the parts of a builder share.
#pragma once

#include "studio/model/ahead.h"
#include "studio/model/builder.h"
#include "studio/model/grower.h"
#include "studio/model/painter.h"

/// A document that is asked for.
typedef struct StudioRequest {
    FrSource *source;
    char *folder;
    uint64_t revision;
    StudioMoment moment;
    uint64_t round;  ///< as the builder's when it was asked
    uint64_t number; ///< requests are counted
} StudioRequest;

struct StudioBuilder {
    StudioWake wake;
    void *user;
    GThread *thread;
    StudioPainter *painter;
    GMutex lock;
    GCond changed;
    // Under the lock:
    StudioRequest *waiting; // NULL: none
    FrProgress *progress;   // of what runs; NULL: nothing runs
    gint64 began;
    StudioBuilt *built;   // to be collected; NULL: none
    bool is_held;         // collected and not released
    bool is_over;         // the thread shall end
    bool is_look_due;     // what stands shall be looked at
    bool is_looking;      // that is what runs
    bool is_changing;     // a build runs and has not been handed over: nobody may read the scene
    uint64_t round;       // how many documents have gone
    uint64_t asked;       // how many requests there were …
    uint64_t stood;       // … the one whose outcome stands …
    uint64_t stood_round; // … and its round
    GQueue copies;        // StudioCopy *, references, to be made
    uint64_t collected;   // greatest revision collected so far
    gint fraction;        // atomic, in thousandths
    StudioGround *ground; // of the last build; NULL: level
    GArray *stands;       // StudioStand, of the last build
    GArray *footings;     // StudioFooting, of the last build
    // Of the thread alone:
    StudioWatch watch; // NULL: nobody looks
    void *watcher;
    bool is_growing; // what stands grows bud by bud
    FrRebuild *rebuild;
    StudioAhead *ahead;
    StudioGrower *grower;
    FrPool *pool;
    StudioView *view;
    FrShading shading;    // of the view …
    FrDigest shaded;      // … and of what that depends on
    const FrScene *scene; // what is shown and can be picked from while nothing runs; NULL
};

/// What is shown, while nothing changes it; NULL. Under the lock.
const FrScene *studio_builder_shown(const StudioBuilder *builder);
/// Makes a copy whose time has come, on the builder's thread; under the lock, which it gives up
/// meanwhile. False: there is none.
bool studio_builder_make_copy(StudioBuilder *builder);
/// Answers all that wait with nothing. Under the lock.
void studio_builder_drop_copies(StudioBuilder *builder);
