/// @file cli.h
/// What the verbs of the `frond` program share: its options, and the session around a verb.
#pragma once

#include "frond/io.h"
#include "frond/lsystem.h"
#include "frond/render.h"

#include <jansson.h>

/// One bit for each verb, for tables that say what belongs to which.
typedef enum CliVerbId {
    CLI_BUILD = 1 << 0,
    CLI_RENDER = 1 << 1,
    CLI_CHECK = 1 << 2,
    CLI_INFO = 1 << 3,
    CLI_PRESETS = 1 << 4,
    CLI_NEW = 1 << 5,
    CLI_SCHEMA = 1 << 6,
    CLI_REFERENCE = 1 << 7,
    CLI_DERIVE = 1 << 8,
    CLI_VARY = 1 << 9,
    CLI_CONVERT = 1 << 10,
    CLI_ALL = (1 << 11) - 1
} CliVerbId;

typedef struct CliOptions {
    GPtrArray *files;   ///< char *, what stands without an option
    GPtrArray *outputs; ///< char *, of -o
    GPtrArray *sets;    ///< char *, "path=value"
    GPtrArray *only;    ///< char *, what of the scene is wanted; empty: all
    bool in_place;      ///< that stays where it stands
    int64_t seed;       ///< < 0: as the document says
    bool has_light;     ///< a picture of the light is wanted
    int light_axis;     ///< of a slice of light: 0, 1, 2 are x, y, z; < 0: points
    double light_at;    ///< m, along that axis
    FrLightAt light_where;
    int64_t light_count; ///< points along the longest side of a grid
    double time;         ///< years, of all plants' clocks; NAN: as the document says
    bool has_frames;
    int64_t first_frame, last_frame;
    int threads;   ///< 0: one per processor
    int64_t steps; ///< < 0: as the L-system says
    int64_t count; ///< instances of a collection; 0: the default
    int64_t lod;
    int64_t samples, width, height; ///< 0: the default
    FrLeaves leaves;
    FrLimits limits;
    GPtrArray *nurbs;              ///< char *, NAME=VALUE of --nurbs
    char *camera, *stats, *preset; ///< NULL: not given
    char *checkpoint, *resume;     ///< files of a growth; NULL
    char *plant;                   ///< to vary, NULL: the first that is a variation
    char *view;                    ///< of an L-system, NULL: the .v beside it if there is one
    bool prints_count;             ///< derive --print count
    bool prints_steps;             ///< derive --print steps
    char *paths;                   ///< component whose instances info lists; NULL
    bool is_json, is_diag_json, is_quiet, is_verbose, wants_help, wants_version;
} CliOptions;

typedef struct CliSession CliSession;

typedef struct CliVerb {
    CliVerbId id;
    const char *name;
    const char *synopsis;
    const char *meaning;
    FrStatus (*run)(CliSession *session);
    guint least_files, most_files;
} CliVerb;

/// The plants that still grow after a step, and the volume of their wood.
typedef struct CliStand {
    uint64_t step, living;
    double wood; ///< m³
} CliStand;

/// What a verb works with. `context` has a pool, a progress and diagnostics.
struct CliSession {
    const CliVerb *verb;
    const CliOptions *options;
    FrContext context;
    FrSource *unwritten; ///< the document that an L-system was read as; what it says has no place
    GArray *stands;      ///< CliStand: of each step of plants that grow bud by bud, for --stats
    double began;        ///< seconds of the monotonic clock
    double read_seconds, build_seconds, render_seconds;
};

// ---- options.c --------------------------------------------------------------------------------

CliOptions cli_options_new(void);
void cli_options_clear(CliOptions *options);
/// Reads all arguments; what is no option is added to `files`. False after a message.
bool cli_options_parse(CliOptions *options, const CliVerb *verb, int count, char **arguments);
/// Prints the options that belong to a verb.
void cli_options_print(CliVerbId verb, FILE *out);

// ---- nurbs.c ----------------------------------------------------------------------------------

/// Sets one NAME=VALUE; false after a message.
bool cli_nurbs_set(FrNurbsParams *params, const char *text);
/// Shows all plants as rational surfaces if --nurbs was given, as it says; `plain` is for writers.
void cli_nurbs_apply(const CliOptions *options, FrScene *scene, FrNurbsParams *plain);

// ---- message.c --------------------------------------------------------------------------------

/// A message on stderr: `frond: …`.
void cli_message(const char *format, ...) FR_PRINTF(1, 2);
/// "; did you mean 'x'?" or "". Free with g_free().
char *cli_hint(const char *name, const char *const *candidates, size_t count);
double cli_now(void);
/// 1234567 → "1 234 567". Free with g_free().
char *cli_count_text(uint64_t count);

// ---- session.c --------------------------------------------------------------------------------

void cli_session_open(CliSession *session, const CliVerb *verb, const CliOptions *options);
/// Prints what is left to say and frees everything.
void cli_session_close(CliSession *session);
/// Prints the diagnostics so far to stderr and begins anew.
void cli_session_flush(CliSession *session);
/// The signal that asked to stop, 0 if none did.
int cli_session_signal(void);
/// False after a message if `input` is a file that -o or --stats names.
bool cli_check_spared(const CliOptions *options, const char *input);
/// Reads a document or an L-system and applies --set, --steps and --view.
FR_MUST_USE FrStatus cli_session_read(CliSession *session, const char *path, FrDocument **document);
/// Builds as the options say; clocks show `time`, NAN: what the document says.
FR_MUST_USE FrStatus cli_session_grow(CliSession *session, const FrDocument *document, double time,
                                      FrScene **scene);
/// Reads and builds. On failure both are NULL.
FR_MUST_USE FrStatus cli_session_build(CliSession *session, const char *path, FrDocument **document,
                                       FrScene **scene);
/// Writes a whole file or none.
FR_MUST_USE FrStatus cli_session_save(CliSession *session, const char *path, const void *data,
                                      size_t size);

// ---- progress.c -------------------------------------------------------------------------------

/// A progress bar on stderr, or nothing where that is no terminal.
FrProgress *cli_progress_new(bool is_quiet);
/// Frees the progress and wipes the bar.
void cli_progress_free(FrProgress *progress);

// ---- stats.c ----------------------------------------------------------------------------------

/// What a turtle drew, as an object.
json_t *cli_drawn_json(const FrLdrawn *drawn);
/// Adds how much each component of a plant made to an object of numbers by their ids.
void cli_count_made(json_t *object, const FrPlant *plant, const uint64_t *made);
/// Writes --stats. `io` is NULL where no model was written.
FR_MUST_USE FrStatus cli_stats_write(CliSession *session, const char *document,
                                     const FrScene *scene, const FrIoStats *io);

// ---- chains.c ---------------------------------------------------------------------------------

/// Chains of a component in an i-tree: instances that follow upon instances of the same component,
/// directly or through others. A component in no recursion has chains of one.
typedef struct CliChains {
    uint64_t count;
    uint32_t shortest, longest;
} CliChains;

/// One CliChains for each component; free with g_free().
CliChains *cli_chains_count(const FrPgraphCounts *counts, uint32_t components);

// ---- branches.c -------------------------------------------------------------------------------

/// Lists the branches of each component of a plant with how strokes select them.
void cli_branches_print(const FrPlant *plant);
json_t *cli_branches_json(const FrPlant *plant);
/// Lists the branches of one component with their paths; none for NULL.
void cli_branches_print_paths(const FrPlant *plant, const char *component);
void cli_branches_add_paths(const FrPlant *plant, const char *component, json_t *paths);

// ---- model.c ----------------------------------------------------------------------------------

bool cli_is_model(const char *path);
/// What is in a .glb or .gltf file.
FR_MUST_USE FrStatus cli_model_info(CliSession *session, const char *path);

// ---- lsystem.c --------------------------------------------------------------------------------

/// Whether a file is an L-system by its name: .l
bool cli_is_lsystem(const char *path);
/// Reads it as a document of one plant, `plant`; --set without a dot sets numbers of its own.
FR_MUST_USE FrStatus cli_lsystem_read(CliSession *session, const char *path, FrDocument **document);
/// Whether cli_lsystem_read() has seen to a --set.
bool cli_lsystem_takes(const char *path, const char *set);
/// Sets the derivation length of every L-system of a document.
FR_MUST_USE FrStatus cli_lsystem_set_steps(CliSession *session, FrDocument *document,
                                           int64_t steps);
/// Does what --steps, --view ask of the L-systems of a document, and lets them print.
FR_MUST_USE FrStatus cli_lsystem_apply(CliSession *session, FrDocument *document);
/// The L-system that --plant names, else the first; NULL with a message.
const FrPlantDef *cli_lsystem_find(const CliSession *session, const FrDocument *document);
/// Names the plants of a scene like the .l file they come from.
void cli_lsystem_name(const char *path, FrScene *scene);

// ---- growth.c ---------------------------------------------------------------------------------

/// Whether any plant of the document grows bud by bud; --steps are its then.
bool cli_growth_takes_steps(const FrDocument *document);
/// Scenes of a document at several times, as the options say; what grows is grown once for all.
typedef struct CliGrowth CliGrowth;
/// The document must outlive it. NULL after a failure.
FR_MUST_USE FrStatus cli_growth_open(CliSession *session, const FrDocument *document,
                                     CliGrowth **growth);
void cli_growth_close(CliGrowth *growth);
/// The scene with clocks that show `time`, NAN: what the document says.
FR_MUST_USE FrStatus cli_growth_scene(CliGrowth *growth, double time, FrScene **scene);

// ---- standing.c -------------------------------------------------------------------------------

/// What --only leaves of the scene, as it has grown there.
FR_MUST_USE FrStatus cli_standing_info(CliSession *session, const FrDocument *document);

// ---- verbs ------------------------------------------------------------------------------------

FrStatus cli_build(CliSession *session);
FrStatus cli_render(CliSession *session);
FrStatus cli_check(CliSession *session);
FrStatus cli_info(CliSession *session);
FrStatus cli_presets(CliSession *session);
FrStatus cli_new(CliSession *session);
FrStatus cli_derive(CliSession *session);
FrStatus cli_convert(CliSession *session);
FrStatus cli_vary(CliSession *session);
FrStatus cli_schema(CliSession *session);
FrStatus cli_reference(CliSession *session);
