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

/// Builds a snapshot of a document and writes it in the format of `path`. May be called from any
/// thread, with a context of its own.
StudioExported studio_export(FrSource *source, const char *folder, const char *path,
                             FrLeaves leaves, int lod, const FrContext *context);
