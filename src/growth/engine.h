/// @file engine.h
/// The state of a growth, shared by the files of this folder: columns of nodes, axes and live buds
/// for each plant, and the world they stand in.
#pragma once

#include "frond/growth.h"
#include "frond/shadows.h"
#include "frond/voxels.h"

/// What chance is asked for; part of the key of every draw.
enum {
    FR_CHANCE_BIRTH = 1,
    FR_CHANCE_LENGTH,
    FR_CHANCE_TURN,
    FR_CHANCE_TRIAL,
    FR_CHANCE_CLAIM,
    FR_CHANCE_WAKE,
    FR_CHANCE_ROLL,
    FR_CHANCE_PARTICLE,
    FR_CHANCE_LEAF,
    FR_CHANCE_LATERALS,
};

typedef enum FrLiveState {
    FR_LIVE_GROWING, ///< apex of its axis
    FR_LIVE_ASLEEP,  ///< beside a node, or below an ended apex
    FR_LIVE_DONE,    ///< dead: leaves the list at the end of the step
} FrLiveState;

/// A live bud.
typedef struct FrLiveBud {
    FrKey key;
    uint32_t node;      ///< at whose tip it sits; FR_NONE: on the ground
    uint32_t axis;      ///< whose apex it is; asleep: the axis beside which it sits
    vec3s direction;    ///< unit: that of its last internode, or the one it will begin with
    vec3s side;         ///< unit, perpendicular to it: from where divergence counts
    vec3s brightest;    ///< unit: to the light; 0 if there is none
    vec3s attraction;   ///< unit: to its particles; 0 if there are none
    float light;        ///< 0 to 1
    float vigour;       ///< of the shoot that it makes in this step
    float length;       ///< of the shoot's internodes, m
    float slope;        ///< how much lighter it is over there; 1 where only the direction is known
    uint16_t age;       ///< steps since it came to be, or woke
    uint16_t place;     ///< asleep: internodes of the axis below it
    uint8_t state;      ///< FrLiveState
    uint8_t row;        ///< order of the species that its axis is built by
    uint8_t shoot;      ///< internodes to make in this step
    uint8_t is_relay;   ///< follows an ended axis
    uint8_t is_resting; ///< for a stronger apex ahead of it, in this step
    uint8_t is_reached; ///< has reached a particle
    float unheld;       ///< climbing: wood since the last hold, m
} FrLiveBud;

/// A branch.
typedef struct FrGrownAxis {
    FrKey key;
    uint32_t bearer;      ///< node; FR_NONE: the ground
    uint32_t first, last; ///< nodes, FR_NONE before the first
    uint32_t owner;       ///< its number in the voxels
    uint32_t internodes;  ///< so far
    uint16_t birth;       ///< step
    uint8_t row;          ///< order of the species it is built by
    uint8_t order;        ///< botanical
    float vigour;         ///< flux, priority: that entered it in this step
    uint8_t is_growing;   ///< has an apex
} FrGrownAxis;

/// Nodes of one plant, parents before children.
typedef struct FrGrownNodes {
    uint32_t count, capacity;
    uint32_t *parent;
    uint32_t *axis;
    vec3s *at; ///< tip, relative to the seed
    uint16_t *birth;
    uint8_t *light; ///< at birth and as long as a bud sits there, 255 full
    float *wood;    ///< r^e of branches that have fallen off here, in tips
} FrGrownNodes;

/// Whether a plant has a place to stand.
typedef enum FrPlace {
    FR_PLACE_FREE, ///< it grows, or has grown
    FR_PLACE_NONE, ///< its seed waits until the place is free
    FR_PLACE_LOST, ///< the same, but it has begun once: its particles are there
} FrPlace;

typedef struct FrGrownPlant {
    FrSeed seed;
    FrKey key;
    FrGrownNodes nodes;
    FrGrownAxis *axes;
    uint32_t axis_count, axis_capacity;
    FrLiveBud *buds;
    uint32_t bud_count, bud_capacity;
    uint8_t is_drawn;                           ///< colonize: particles have drawn it
    uint8_t max_order;                          ///< of its axes
    uint8_t place;                              ///< FrPlace
    uint8_t is_dead;                            ///< has starved
    uint16_t starving;                          ///< steps in a row
    uint32_t live_count, growing_count;         ///< gathered buds
    uint32_t first_growing, first_asleep;       ///< of them, among those of all plants
    uint32_t first_proposal, proposal_count;    ///< in this round
    uint32_t longest_shoot;                     ///< of those that propose, in internodes
    uint32_t first_owner, owner_count;          ///< new ones of this round
    uint32_t first_shade, shade_count;          ///< nodes with leaves
    uint32_t born, shed, collisions, contested; ///< in this step
} FrGrownPlant;

/// A species made ready.
typedef struct FrReadySpecies {
    FrSpeciesParams params; ///< own copy
    FrOrderParams orders[FR_MAX_ORDERS];
    uint32_t order_count; ///< ≥ 1
    // What every bud would work out anew.
    float cosine[FR_MAX_ORDERS], sine[FR_MAX_ORDERS]; ///< of the orders' angles
    float shorter[256];                               ///< lengths by botanical order
    float wander, trial;                              ///< tangents of the angles
    float turn_cosine, turn_sine;                     ///< of the limit
    FrMaterial *bark, *leaf;
    const FrDistance *envelope;
    char *name;
} FrReadySpecies;

/// A live bud where it stands, gathered from all plants for a phase of the step.
typedef struct FrLiveBudAt {
    FrLiveBud *bud;
    const FrSpeciesParams *params;
    vec3s world;
    float influence; ///< m
    float own_shade; ///< how far its own leaves reach, m
} FrLiveBudAt;

/// Bytes still to be read.
typedef struct FrBytesReader {
    const uint8_t *at;
    size_t left;
} FrBytesReader;

/// Memory of one worker, kept from use to use.
typedef struct FrScratch {
    void *memory;
    size_t size;
} FrScratch;

/// Whose number an owner of voxels is.
typedef struct FrOwner {
    uint32_t plant, axis;
    uint32_t bearer; ///< of the axis
    uint32_t node;   ///< that its apex proposes from in this round
    uint64_t key;    ///< of the proposal: the smallest comes first
} FrOwner;

typedef struct FrProposal FrProposal;

struct FrGrowth {
    FrGrowthParams params;
    FrReadySpecies *species;
    uint32_t species_count;
    vec3s up; ///< against gravity
    FrVoxels *voxels;
    FrGrowthObstacle *obstacles; ///< own copies
    uint32_t obstacle_count;
    FrDistance *support, *support_ground; ///< what can be climbed; NULL: nothing, or nobody climbs
    struct FrStems *bark;                 ///< of plants that can be climbed; NULL: none
    vec3s *suns;
    FrLight *light; ///< borrowed, NULL: that of the parameters
    const FrLamp *lamps;
    uint32_t lamp_count;
    FrParticles *particles;           ///< NULL: none
    struct FrColony *colony;          ///< of plants that colonize space; NULL: to be made anew
    struct FrOtherScene *other_scene; ///< that `light` reads; NULL: none yet
    FrShadows *shadows;               ///< that nodes cast; NULL: none yet
    GArray **fallen;                  ///< by worker: where fallen internodes cast shadows
    FrGrownPlant *plants;
    uint32_t plant_count;
    FrOwner *owners; ///< by number in the voxels
    uint32_t owner_count, owner_capacity;
    // Memory of a step, kept from step to step.
    FrProposal *proposals;
    uint32_t *open;                    ///< those that are not settled yet
    uint8_t *steps;                    ///< between the cells of each proposal's segment
    uint32_t step_stride;              ///< room for the longest
    FrLiveBudAt *live;                 ///< all live buds, the growing ones first
    FrScratch *scratch, *drop_scratch; ///< by worker
    FrScratch live_memory, proposal_memory, shade_memory, sky_memory, known_memory;
    int scratch_count;
    uint64_t step;
    double seconds, light_seconds; ///< of the last step
    GPtrArray *history;            ///< GBytes of states before steps, the last one last
    uint32_t older_states;         ///< how many of them are older than the last change of the world
    bool is_world_new;             ///< the next step looks whether places of seeds are free
};

static inline const FrReadySpecies *fr_species_of(const FrGrowth *growth,
                                                  const FrGrownPlant *plant) {
    return &growth->species[plant->seed.species];
}

static inline const FrOrderParams *fr_order_of(const FrReadySpecies *species, uint32_t row) {
    return &species->orders[MIN(row, species->order_count - 1)];
}

// ---- save.c -----------------------------------------------------------------------------------
/// False if there is not so much left.
bool fr_bytes_take(FrBytesReader *reader, void *into, size_t size);
/// False also if the number is above `limit`.
bool fr_bytes_take_count(FrBytesReader *reader, uint64_t limit, uint64_t *count);

// ---- gather.c ---------------------------------------------------------------------------------
/// Gathers all live buds in growth->live, the growing ones first. Returns how many grow.
uint32_t fr_growth_gather_live(FrGrowth *growth, uint32_t *count, const FrContext *context);
/// Gathers a proposal for every shoot that has this internode still to make, plant by plant.
/// Returns how many, and tells whether some shoot has a further one to make.
uint32_t fr_growth_gather_proposals(FrGrowth *growth, uint32_t internode, bool *goes_on,
                                    const FrContext *context);

// ---- sense.c ----------------------------------------------------------------------------------
/// What buds learn before plants change: light, particles, stronger apices. FR_CANCELLED leaves
/// everything as it was.
FR_MUST_USE FrStatus fr_growth_sense(FrGrowth *growth, const FrContext *context);

// ---- scatter.c, attract.c -----------------------------------------------------------------------
void fr_growth_save_particles(const FrGrowth *growth, GByteArray *out);
bool fr_growth_take_particles(FrGrowth *growth, FrBytesReader *reader);
/// The particles all over the arena that the parameters ask for.
FrStatus fr_growth_strew_particles(FrGrowth *growth, const FrContext *context);
/// The particles that a new plant's envelope is filled with.
FrStatus fr_growth_fill_envelope(const FrGrowth *growth, const FrGrownPlant *plant,
                                 GArray *particles, const FrContext *context);
/// Kills what the new nodes of this step have reached.
void fr_growth_reach_particles(FrGrowth *growth, const FrContext *context);
typedef struct FrColony FrColony;

void fr_colony_free(FrColony *colony);
/// Buds where particles draw the nodes of plants that colonize space. FR_CANCELLED if that came
/// before any changed.
FR_MUST_USE FrStatus fr_growth_colonize(FrGrowth *growth, const FrContext *context,
                                        bool *has_colonizers);
/// Turns buds towards their particles.
FR_MUST_USE FrStatus fr_growth_attract(FrGrowth *growth, const FrLiveBudAt *buds, uint32_t count,
                                       const FrContext *context);

// ---- other_light.c ----------------------------------------------------------------------------
typedef struct FrOtherScene FrOtherScene;

void fr_other_scene_free(FrOtherScene *scene);
/// The light of buds as the caller's backend sees it.
FrStatus fr_growth_ask_light(FrGrowth *growth, const FrLiveBudAt *buds, uint32_t count,
                             const FrContext *context);

// ---- light.c, sky.c -----------------------------------------------------------------------------
/// Takes the shadows of what has fallen back, and casts those of this step's internodes.
void fr_growth_recast(FrGrowth *growth, const FrContext *context);
/// Brightest direction and slope at a bud in the shadows.
void fr_growth_look_around(const FrGrowth *growth, const FrGrownPlant *plant, FrLiveBud *bud);
/// The light of all live buds, and where it is brightest.
FrStatus fr_growth_light(FrGrowth *growth, const FrLiveBudAt *buds, uint32_t count,
                         const FrContext *context);

// ---- species.c --------------------------------------------------------------------------------
/// What a model is times the attributes of a species: radius of tips, length and width of blades,
/// leaves at a node, steps that they stay.
typedef struct FrHabit {
    double girth, blade_length, blade_width, leaves, leaf_life;
} FrHabit;
FrHabit fr_species_habit(int model);
FrReadySpecies fr_species_make_ready(const FrSpecies *species);
void fr_species_clear_ready(FrReadySpecies *ready);

// ---- seeds.c ----------------------------------------------------------------------------------
/// Seeds that stand wrong.
typedef struct FrMisplaced {
    uint32_t count;
    const FrSeed *first;
} FrMisplaced;
bool fr_seed_is_in_arena(const FrGrowthParams *params, const FrSeed *seed);
/// False on the border of the arena where nothing can rise, with cells of this width.
bool fr_seed_can_rise(const FrGrowthParams *params, vec3s up, double width, const FrSeed *seed);
/// True for species whose plants do not stand beside their envelope: a trunk that begins below it,
/// or nearer to it than an internode is long, may grow into it. The caller frees it.
bool *fr_species_come_within(const FrGrowthParams *params, const FrReadySpecies *species,
                             uint32_t count, vec3s up);
void fr_misplaced_note(FrMisplaced *misplaced, const FrSeed *seed);
void fr_misplaced_tell_outside(const FrMisplaced *outside, uint32_t count,
                               const FrContext *context);
void fr_misplaced_tell_hindered(const FrMisplaced *hindered, uint32_t count,
                                const FrContext *context);
/// Which seeds have no room straight above them, in the arena and in their envelope, for their
/// first internode and the box around its tip. Plants that colonize space or climb are not told.
/// The caller frees it.
bool *fr_seeds_find_hindered(const FrGrowthSetup *setup, const FrReadySpecies *species,
                             double width, vec3s up, const FrSeed *seeds, uint32_t count);
/// Which seeds have no place: outside the arena, on its upper border, in an obstacle, or with no
/// free cell within two above. Those on an obstacle have one. Cells are of this width and begin at
/// `origin`, which an arena that has changed since may not. The caller frees it.
bool *fr_seeds_find_left_out(const FrGrowthSetup *setup, const double origin[3], double width,
                             vec3s up, const FrSeed *seeds, uint32_t count);
/// Tells which seeds of a world that is yet to be made stand wrong.
void fr_seeds_check(const FrGrowthSetup *setup, double width, vec3s up, const FrSeed *seeds,
                    uint32_t count, const FrContext *context);

// ---- left_out.c -------------------------------------------------------------------------------
/// Where seeds are looked at; as for fr_seeds_find_left_out().
typedef struct FrSowing {
    const FrGrowthSetup *setup;
    const double *origin;
    double width;
    vec3s up;
} FrSowing;
/// Tells, for each element, which seeds have no place and why the first of them has none. `is_all`:
/// there are no others.
void fr_seeds_tell_left_out(const FrSowing *sowing, const FrSeed *seeds, uint32_t count,
                            const bool *has_none, bool is_all, const FrContext *context);

// ---- bare.c -----------------------------------------------------------------------------------
/// Tells seeds that stand less than half a cell from another one; cells are `width` wide. O(n log
/// n) unless many stand above each other.
void fr_seeds_tell_crowded(const FrReadySpecies *species, double width, const FrSeed *seeds,
                           uint32_t count, const FrContext *context);

// ---- sow.c ------------------------------------------------------------------------------------
FrStatus fr_growth_limit_plants(uint64_t count, const FrContext *context);
/// True if the world is new to a seed that has not sprouted.
bool fr_growth_has_waiting(const FrGrowth *growth);
/// Begins plants whose place has become free, and lets seeds wait whose place is taken. After a
/// failure the state is to be restored.
FR_MUST_USE FrStatus fr_growth_sow_waiting(FrGrowth *growth, const FrContext *context);

// ---- plant_store.c ----------------------------------------------------------------------------
uint32_t fr_grown_add_node(FrGrownPlant *plant, uint32_t parent, uint32_t axis, vec3s at);
uint32_t fr_grown_add_axis(FrGrownPlant *plant, uint32_t bearer, uint8_t row, FrKey key);
FrLiveBud *fr_grown_add_bud(FrGrownPlant *plant);
void fr_grown_clear(FrGrownPlant *plant);
FrDigest fr_grown_digest(const FrGrownPlant *plant);
void fr_grown_reserve(FrGrownPlant *plant, uint32_t nodes, uint32_t axes, uint32_t buds);
/// Where an internode ends, in the world, and where it begins.
vec3s fr_grown_tip(const FrGrownPlant *plant, uint32_t node);
vec3s fr_grown_base(const FrGrownPlant *plant, uint32_t node);
uint64_t fr_grown_bytes(const FrGrownPlant *plant);

/// At least so many bytes, as they are.
void *fr_scratch_take(FrScratch *scratch, size_t size);
void fr_scratch_clear(FrScratch *scratch);
/// Cells of an internode from the tip of `parent` (FR_NONE: the seed) to a place; none if it is too
/// long.
uint32_t fr_growth_walk(const FrGrowth *growth, const FrGrownPlant *plant, uint32_t parent,
                        vec3s to, FrCell *cells);

// ---- growth.c ---------------------------------------------------------------------------------
/// Where a bud stands.
vec3s fr_bud_world(const FrGrownPlant *plant, const FrLiveBud *bud);
/// Frees plants, voxels and particles.
void fr_growth_drop_state(FrGrowth *growth);
/// Stands the obstacles in the voxels.
FrStatus fr_growth_stand_obstacles(FrGrowth *growth, const FrContext *context);
/// Room for so many owners of voxels.
void fr_growth_reserve_owners(FrGrowth *growth, uint32_t count);
/// True if a node bears leaves now.
static inline bool fr_grown_is_leafy(const FrGrowth *growth, const FrGrownPlant *plant,
                                     uint32_t node) {
    const FrSpeciesParams *params = &fr_species_of(growth, plant)->params;
    const FrGrownNodes *nodes = &plant->nodes;
    return params->leaves > 0 &&
           growth->step < (uint64_t)nodes->birth[node] + (uint64_t)params->leaf_life &&
           nodes->light[node] >= params->leaf_light * 255;
}

// ---- direction.c, sprout.c, wake.c --------------------------------------------------------------
/// Direction of a growing bud's next internode; trials above 0 lie around the wanted one.
vec3s fr_growth_direction(const FrGrowth *growth, const FrGrownPlant *plant, const FrLiveBud *bud,
                          uint32_t trial);
/// Turns a bud to a unit direction, and about itself.
void fr_growth_turn(FrLiveBud *bud, vec3s direction, float twist);
/// Longer than this no internode becomes, m.
double fr_growth_longest(const FrSpeciesParams *params);
/// Length of the next internode, m.
double fr_growth_length(const FrGrowth *growth, const FrGrownPlant *plant, const FrLiveBud *bud);
/// Adds the buds of a node that growing bud `index` has just made.
void fr_growth_sprout(const FrGrowth *growth, FrGrownPlant *plant, uint32_t index, uint32_t node);
/// Makes a sleeping bud the apex of a new axis.
void fr_growth_wake_bud(FrGrownPlant *plant, FrLiveBud *bud, uint64_t step);
/// Ages all buds and wakes those that may.
void fr_growth_wake(const FrGrowth *growth, FrGrownPlant *plant, FrScratch *scratch);

// ---- climb.c ----------------------------------------------------------------------------------
/// What a plant may hold on to near a place.
typedef struct FrHold {
    bool is_near;    ///< within reach
    bool is_grown;   ///< the wood of a plant that grows in this world
    vec3s at;        ///< where this was felt
    double distance; ///< m; below 0 inside
    vec3s away;      ///< unit, from the surface
    double gap;      ///< m: how far off stems lie
    double radius;   ///< of grown wood there, m
} FrHold;

/// Prepares what climbing species feel, if there are any.
FR_MUST_USE FrStatus fr_growth_take_supports(FrGrowth *growth, const FrContext *context);
static inline bool fr_species_climbs(const FrSpeciesParams *params) {
    return params->climb > 0 && params->fate != FR_FATE_COLONIZE;
}
FrHold fr_climb_feel(const FrGrowth *growth, const FrSpeciesParams *params, vec3s world);
/// What gravity does to a shoot that it would pull by `gravity` where it is held.
vec3s fr_climb_pull(const FrGrowth *growth, const FrSpeciesParams *params, const FrLiveBud *bud,
                    vec3s gravity);
/// The direction of a bud that wants to grow along the unit vector `wanted`.
vec3s fr_climb_direction(const FrGrowth *growth, const FrSpeciesParams *params,
                         const FrLiveBud *bud, const FrHold *hold, vec3s wanted, uint32_t trial);
/// True if the way of a bud to a place, relative to the seed, does not lead through grown wood.
bool fr_climb_is_clear(const FrGrowth *growth, const FrGrownPlant *plant, const FrLiveBud *bud,
                       vec3s to);
/// Notes whether a bud has a hold at its new node. False if it has gone too far without.
bool fr_climb_note(const FrGrowth *growth, const FrGrownPlant *plant, FrLiveBud *bud);

// ---- auxin.c, honda.c -------------------------------------------------------------------------
/// Auxin that reaches each node; in the scratch memory.
double *fr_growth_auxin(const FrGrownPlant *plant, const FrSpeciesParams *params,
                        FrScratch *scratch);
/// Tells growing buds to rest for stronger ones ahead of them.
FR_MUST_USE FrStatus fr_growth_compete(FrGrowth *growth, const FrLiveBudAt *buds, uint32_t count,
                                       const FrContext *context);

// ---- pipe.c -----------------------------------------------------------------------------------
/// Wood of each node in tips: r^e over that of a tip.
void fr_growth_pipes(const FrGrownPlant *plant, const FrSpeciesParams *params, double *pipes);
/// Radii of so much wood, m.
void fr_growth_radii(const FrReadySpecies *species, const double *pipes, uint32_t count,
                     float *radii);
/// Radii of all nodes of a plant, m. Free with g_free().
float *fr_growth_radii_of(const FrGrowth *growth, const FrGrownPlant *plant);

// ---- fates.c ----------------------------------------------------------------------------------
/// What each bud will do in this step: how many internodes it makes, and how long they are.
void fr_growth_fates(FrGrowth *growth, FrGrownPlant *plant, int worker);

// ---- shed.c -----------------------------------------------------------------------------------
/// Drops branches, and takes them out of the columns.
void fr_growth_shed(FrGrowth *growth, FrGrownPlant *plant, int worker);
/// Frees the cells of the marked internodes.
void fr_growth_free_cells(const FrGrowth *growth, const FrGrownPlant *plant,
                          const uint8_t *is_freed);
/// Drops the marked internodes; on what bears one that has fallen, all must have.
void fr_growth_drop(FrGrowth *growth, FrGrownPlant *plant, const uint8_t *has_fallen, int worker);

// ---- starve.c ---------------------------------------------------------------------------------
/// Lets a plant die that has gathered too little light for its wood for too long. True if it has.
bool fr_growth_starve(FrGrowth *growth, FrGrownPlant *plant, int worker);

// ---- envelope.c -------------------------------------------------------------------------------
/// True if a place, relative to the seed, is within the species' envelope.
bool fr_envelope_holds(const FrReadySpecies *species, vec3s at, vec3s up);
/// Radius of an outline at a height; < 0 above and below it.
double fr_envelope_radius(const FrPoints *outline, double height);
