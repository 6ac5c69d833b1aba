/// @file profile.h
/// What to write for which program: the formats and settings that a host opens best.
#pragma once

#include "frond/io.h"

typedef struct StudioProfile {
    const char *name;      ///< of the host
    const char *note;      ///< one line for the user
    const char *extension; ///< ".glb"
    FrLeaves leaves;
    int lod;
} StudioProfile;

/// All profiles; `count` receives how many.
const StudioProfile *studio_profiles(size_t *count);

/// What came of an export.
typedef struct StudioExported {
    FrStatus status;
    FrIoStats stats;
} StudioExported;

/// What is written, and how.
typedef struct StudioExport {
    FrLeaves leaves;
    int lod;
    double time;  ///< of all clocks, in years; NAN: as the document says
    int64_t step; ///< of plants that grow bud by bud; < 0: as the document says
    bool is_one;  ///< only the plant with this origin and number, as in FrStand …
    uint32_t origin, number;
    bool in_place; ///< … where it stands, else at the origin
} StudioExport;

/// Builds a snapshot of a document and writes it in the format of `path`. May be called from any
/// thread, with a context of its own.
StudioExported studio_export(FrSource *source, const char *folder, const char *path,
                             const StudioExport *how, const FrContext *context);
