// The branches of a Tree.
#include "pgraph/spread.h"

#include "plant/frames.h"

#include <math.h>

#define PI 3.14159265358979323846

// As many branches before one are kept apart from, at turns so far from each other.
enum { FEET = 16, ASIDE_TRIES = 36 };
#define ASIDE (10 * PI / 180)

// Where a branch begins on the surface of its stem.
typedef struct Foot {
    double along, azimuth;
} Foot;

typedef struct Branching {
    const FrExpansion *expansion;
    const FrStem *stem;
    const FrLimb *limb;
    const FrTreeParams *tree;
    FrPose base;
    uint32_t row;
    uint32_t place; // the one that `at` is of
    double at;      // along the stem
    double sweep;
    const FrCurve *crown; // NULL: none
    Foot feet[FEET];      // of the last branches, where they keep apart
    uint32_t foot_count;
    bool keeps_apart;
} Branching;

static bool is_on_surface(const FrTreeParams *tree, const FrPrepared *child) {
    if (tree->placement != FR_PLACE_AUTO) {
        return tree->placement == FR_PLACE_ON_SURFACE;
    }
    return !child->is_stem && !child->is_point_set;
}

// Where along what has grown the place is.
static inline double place_now(const Branching *branching) {
    double reach = branching->stem->reach;
    return reach < 1 ? fmin(branching->at / reach, 1) : branching->at;
}

// The point of the stem at a place, as an offset on the internode that holds it.
static void stand_at(Branching *branching, uint32_t place, FrPose *site) {
    const FrStem *stem = branching->stem;
    if (place != branching->place) {
        branching->place = place;
        branching->at = fr_place_at(&stem->places, place);
    }
    *site = branching->base;
    if (stem->internodes == 0) {
        return;
    }
    double back, at = place_now(branching);
    uint32_t k = fr_limb_node_of(stem, branching->limb, at, place, &back);
    uint32_t node = branching->expansion->level.node_count[branching->row];
    node += branching->limb->first + k;
    float length = branching->expansion->plant->nodes.length[node];
    site->bearer = node;
    site->offset = (vec3s){{0, 0, -(float)back * length}};
    site->rotation = (versors){{0, 0, 0, 1}};
}

static vec3s place_of(const FrPlant *plant, FrPose site) {
    if (site.bearer == FR_NONE) {
        return site.offset;
    }
    return fr_advanced(plant->nodes.position[site.bearer], plant->nodes.frame[site.bearer],
                       site.offset.z);
}

// All around the stem the turn is as it is; a narrower sector has it drawn together about the y
// axis, the upper side.
static double swept(double azimuth, double sweep) {
    if (sweep >= 2 * PI - 1e-9) {
        return azimuth;
    }
    double turns = azimuth / (2 * PI) + 0.5;
    return PI / 2 + (turns - floor(turns) - 0.5) * sweep;
}

static double crown_at(const Branching *branching) {
    const FrPlaces *places = &branching->stem->places;
    double reach = places->end - places->start;
    if (branching->crown == NULL) {
        return 1;
    }
    return fmax(0, fr_curve_eval(branching->crown,
                                 reach > 0 ? (branching->at - places->start) / reach : 0));
}

// From a foot to the nearest of the last branches', over the surface, m; as if unrolled.
static double room_at(const Branching *branching, Foot foot, double radius) {
    double room = INFINITY;
    for (uint32_t k = 0; k < MIN(branching->foot_count, FEET); k++) {
        Foot other = branching->feet[k];
        double turn = foot.azimuth - other.azimuth;
        turn -= 2 * PI * floor(turn / (2 * PI) + 0.5);
        room = fmin(room, hypot(foot.along - other.along, turn * radius));
    }
    return room;
}

// The azimuth nearest to one wanted at which a branch is far enough from the last ones, or where it
// is farthest.
static G_GNUC_NO_INLINE double kept_apart(Branching *branching, double azimuth, double radius,
                                          double apart) {
    Foot foot = {branching->at * branching->stem->length, azimuth}, best = foot;
    double most = -1;
    for (int k = 0; k <= ASIDE_TRIES && most < apart; k++) {
        foot.azimuth = azimuth + (k % 2 == 0 ? -1 : 1) * ((k + 1) / 2) * ASIDE;
        double room = room_at(branching, foot, radius);
        if (room > most) {
            most = room;
            best = foot;
        }
    }
    branching->feet[branching->foot_count++ % FEET] = best;
    return best.azimuth;
}

// Poses branch b. *reach receives the way from axis to surface.
static FrChild pose_branch(Branching *branching, uint32_t b, FrEvaluator *evaluator,
                           FrEvaluator *place, vec3s *reach) {
    const FrTreeParams *tree = branching->tree;
    const FrStem *stem = branching->stem;
    const FrLevel *level = &branching->expansion->level;
    const FrPlaces *places = &stem->places;
    FrPose site;
    stand_at(branching, b / places->whorl, &site);
    // The stem's own axis has the keys it would have without forks.
    FrKey stem_key = branching->limb->axis > 0 ? branching->limb->key : level->key[branching->row];
    FrKey key = fr_key_child(stem_key, b);
    place->vars.key = key;
    double age = (double)level->age[branching->row];
    if (stem->growth_time > 0) {
        age = fr_stem_age_at(stem, age, branching->at);
    }
    if (stem->prepared->varies) {
        fr_place_enter(place, evaluator, level, branching->row, b, places->branches, key);
        place->vars.value[FR_VAR_x] = branching->at;
        place->vars.value[FR_VAR_age] = age;
        if (stem->prepared->uses_place) {
            fr_place_set(&place->vars, place_of(branching->expansion->plant, site));
        }
    }
#define FR_GET(field) fr_value(place, &tree->field, FR_TREE_##field)
    double jitter = FR_GET(azimuth_jitter);
    double azimuth = swept(fr_branch_azimuth(places, b), branching->sweep) + FR_GET(azimuth);
    azimuth +=
        jitter != 0 ? jitter * fr_random_signed(key, fr_purpose(FR_TREE_azimuth_jitter), 1) : 0;
    double now = place_now(branching);
    double radius = fr_limb_radius(stem, branching->limb, now), out = 1 - FR_GET(sink);
    if (branching->keeps_apart) {
        azimuth = kept_apart(branching, azimuth, radius, FR_GET(apart) * branching->base.scale);
    }
    versors turn = fr_turned_zyz(azimuth, FR_GET(branching_angle), PI / 2 + FR_GET(roll));
    azimuth -= 2 * PI * floor(azimuth / (2 * PI));
    *reach =
        (vec3s){{(float)(out * radius) * cosf((float)azimuth),
                 (float)(out * radius * fr_stem_flatness(stem, now)) * sinf((float)azimuth), 0}};
    if (stem->internodes > 0) {
        site.rotation = turn; // internodes have the stem's frame
    } else {
        *reach = fr_turned(site.rotation, *reach);
        site.rotation = fr_frame_step(site.rotation, turn);
    }
    site.scale = branching->base.scale * FR_GET(child_scale);
#undef FR_GET
    return (FrChild){
        .site = site,
        .key = key,
        .i = b,
        .n = places->branches,
        .is_multiplied = true,
        .arms = branching->limb->arms,
        .order = (uint16_t)MIN(level->order[branching->row] + 1, UINT16_MAX),
        .x = (float)branching->at,
        .parent_length = (float)(stem->length / stem->reach / branching->base.scale),
        .parent_radius = (float)(radius / branching->base.scale),
        .stretch = (float)crown_at(branching),
        .age = (float)age,
        .axis = FR_NONE,
    };
}

// Writes what hangs on branch b.
static uint32_t make_branch(Branching *branching, uint32_t b, FrEvaluator *evaluator,
                            FrEvaluator *place, uint32_t at) {
    const FrExpansion *expansion = branching->expansion;
    const FrStage *stage = fr_instance_stage(expansion, branching->row);
    uint32_t count = branching->stem->places.branches;
    vec3s reach;
    FrChild child = pose_branch(branching, b, evaluator, place, &reach);
    for (uint32_t k = 0; k < stage->link_count; k++) {
        const FrStageLink *link = fr_stage_link(expansion, stage, k);
        const FrPrepared *to = fr_stage_prepared(expansion, link->stage);
        if (link->kind != FR_LINK_BRANCH || !fr_flags_allow(&to->flags, b, count)) {
            continue;
        }
        FrChild one = child;
        if (is_on_surface(branching->tree, to)) {
            one.site.offset.x += reach.x;
            one.site.offset.y += reach.y;
            one.site.offset.z += reach.z;
        }
        fr_child_write(expansion, branching->row, link, &one, at++);
    }
    return at;
}

uint32_t fr_make_branches(const FrExpansion *expansion, uint32_t row, const FrStem *stem,
                          FrPose base, FrEvaluator *evaluator, FrEvaluator *place, uint32_t at) {
    const FrStage *stage = fr_instance_stage(expansion, row);
    uint32_t count = stem->places.branches;
    FrLimb whole = fr_stem_whole(stem);
    Branching branching = {
        .expansion = expansion,
        .stem = stem,
        .tree = stem->prepared->params,
        .base = base,
        .row = row,
        .place = FR_NONE,
        .crown = stem->prepared->crown,
    };
    const FrNumber *apart = &branching.tree->apart;
    branching.keeps_apart = !apart->is_constant || apart->constant > 0;
    branching.sweep = fr_value(evaluator, &branching.tree->sweep, FR_TREE_sweep);
    for (uint32_t l = 0; l < stem->limb_count; l++) {
        branching.limb = fr_stem_limb(stem, &whole, l);
        branching.foot_count = 0;
        for (uint32_t b = branching.limb->first_branch; b < branching.limb->end_branch; b++) {
            // Those that flags leave out are kept apart from as if they were there.
            if (branching.keeps_apart || fr_is_wanted(expansion, stage, b, count)) {
                at = make_branch(&branching, b, evaluator, place, at);
            }
        }
    }
    return at;
}
