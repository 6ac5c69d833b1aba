/// @file profile.h
/// What to write for which program: the formats and settings that a host opens best.
#pragma once

#include "frond/io.h"
#include "studio/model/copy.h"

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
    bool is_behind; ///< as studio_copy_take() has it
} StudioExported;

/// How it is written.
typedef struct StudioExport {
    FrLeaves leaves;
    int lod;
} StudioExport;

/// Waits for a copy of what stands and writes it in the format of `path`: all of it, or nothing
/// where it fails or is cancelled. Called from any thread but the main one, with a context of its
/// own.
StudioExported studio_export(StudioCopy *copy, const char *path, const StudioExport *how,
                             const FrContext *context);
