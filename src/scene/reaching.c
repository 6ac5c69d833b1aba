/// Growing keeps the middle line of wood out of obstacles; how thick the wood becomes is known only
/// in the end. An internode is round: across its middle line it reaches towards a surface by its
/// radius times the sine of the angle between the two, so a trunk that stands on something upright
/// does not reach into it.
#include "scene/reaching.h"

#include "base/span.h"
#include "frond/distance.h"
#include "scene/clearance.h"
#include "scene/solids.h"

#include <math.h>
#include <string.h>

/// An obstacle, put into order when something comes near.
typedef struct Wall {
    const FrGrowthObstacle *solid;
    const FrObstacle *obstacle;
    double min[3], max[3];
    FrDistance *surface; ///< NULL: nothing has come near, or it takes too much memory
    bool is_tried;
} Wall;

typedef struct Walls {
    Wall *at;
    guint count;
} Walls;

/// What is told of the plants of one element.
typedef struct Reaching {
    FrSpan span;
    uint32_t seeds, plants; ///< that it has placed; whose wood reaches in
    double length;          ///< of that wood, m
    double depth, at[3];    ///< where it reaches in deepest
    double radius, away;    ///< of the wood there; from its middle line to the obstacle
    const FrObstacle *obstacle;
} Reaching;

static void bound(Wall *wall) {
    for (int axis = 0; axis < 3; axis++) {
        wall->min[axis] = INFINITY;
        wall->max[axis] = -INFINITY;
        for (uint32_t i = 0; i < wall->solid->vertex_count; i++) {
            double at = (double)wall->solid->positions[i].raw[axis];
            wall->min[axis] = fmin(wall->min[axis], at);
            wall->max[axis] = fmax(wall->max[axis], at);
        }
    }
}

static bool is_near(const Wall *wall, const FrStem *stem, double radius) {
    bool is_near = true;
    for (int axis = 0; axis < 3; axis++) {
        is_near &= fmin(stem->from[axis], stem->to[axis]) - radius <= wall->max[axis] &&
                   fmax(stem->from[axis], stem->to[axis]) + radius >= wall->min[axis];
    }
    return is_near;
}

static const FrDistance *surface_of(Wall *wall, const FrContext *context) {
    const FrGrowthObstacle *solid = wall->solid;
    if (!wall->is_tried && fr_distance_bytes(solid->index_count / 3) <= context->limits.bytes) {
        wall->surface = fr_distance_new(solid->positions, solid->vertex_count, solid->indices,
                                        solid->index_count);
    }
    wall->is_tried = true;
    return wall->surface;
}

static double length_of(const FrStem *stem) {
    double square = 0;
    for (int axis = 0; axis < 3; axis++) {
        double along = stem->to[axis] - stem->from[axis];
        square += along * along;
    }
    return sqrt(square);
}

/// How deep an internode reaches in at one of its ends; `away` receives how far its middle line is
/// from the surface there.
static double depth_at(const FrDistance *surface, const FrStem *stem, int end, double *away) {
    const double steep = 0.5; // what a foot stands on is rather below than beside it
    const double *at = end == 0 ? stem->from : stem->to;
    double outward[3], cosine = 0, radius = stem->radius[end];
    *away = fr_distance_within(surface, at, radius, outward);
    if (!(*away < radius)) {
        return 0;
    }
    for (int axis = 0; axis < 3; axis++) {
        double along = stem->to[axis] - stem->from[axis];
        cosine += along * outward[axis];
    }
    cosine /= fmax(length_of(stem), 1e-12);
    bool stands_on = end == 0 && cosine > steep;
    return stands_on ? 0 : radius * sqrt(fmax(1 - cosine * cosine, 0)) - *away;
}

/// Holds one end of an internode against all obstacles. True if it reaches into one.
static bool note_end(Reaching *reaching, const Walls *walls, const FrStem *stem, int end,
                     const FrContext *context) {
    const double touching = 0.1; // part of the radius: less is not seen
    double radius = stem->radius[end];
    bool reaches_in = false;
    for (guint i = 0; i < walls->count; i++) {
        Wall *wall = &walls->at[i];
        const FrDistance *surface = wall->obstacle->visible && is_near(wall, stem, radius)
                                        ? surface_of(wall, context)
                                        : NULL;
        double away = 0, depth = surface == NULL ? 0 : depth_at(surface, stem, end, &away);
        if (depth > touching * radius) {
            reaches_in = true;
            if (depth > reaching->depth) {
                reaching->depth = depth;
                reaching->radius = radius;
                reaching->away = away;
                reaching->obstacle = wall->obstacle;
                memcpy(reaching->at, end == 0 ? stem->from : stem->to, sizeof reaching->at);
            }
        }
    }
    return reaches_in;
}

static void note_plant(Reaching *reaching, const Walls *walls, const FrPlant *plant,
                       const FrSeed *seed, const FrContext *context) {
    const FrStand stand = {.at = {seed->at[0], seed->at[1], seed->at[2]}, .scale = 1};
    FrStem *stems = g_new(FrStem, (size_t)plant->nodes.count + 1);
    uint32_t count = fr_clearance_stems(plant, &stand, stems);
    double length = 0;
    for (uint32_t i = 0; i < count; i++) {
        // All others begin where one ends.
        bool foot = i == 0 && note_end(reaching, walls, &stems[i], 0, context);
        bool tip = note_end(reaching, walls, &stems[i], 1, context);
        length += foot || tip ? length_of(&stems[i]) : 0;
    }
    reaching->length += length;
    reaching->plants += length > 0;
    g_free(stems);
}

static void tell(const Reaching *reaching, const FrContext *context) {
    if (reaching->plants == 0) {
        return;
    }
    const FrObstacle *obstacle = reaching->obstacle;
    uint32_t line, column;
    const char *id = obstacle->id == NULL ? "" : obstacle->id;
    fr_source_position(obstacle->span.source, obstacle->span.begin, &line, &column);
    fr_diags_add(context->diags, FR_WARNING, "thick-wood", reaching->span,
                 "the wood of %u of %u plants reaches into obstacles, %.3g m of it, deepest at "
                 "%.3g,%.3g,%.3g: there it is %.3g m thick and its middle is %.3g m from the "
                 "obstacle%s%s of line %u; place it farther away, or make `tip-radius` smaller or "
                 "`pipe-exponent` larger",
                 reaching->plants, reaching->seeds, reaching->length, reaching->at[0],
                 reaching->at[1], reaching->at[2], 2 * reaching->radius, reaching->away,
                 id[0] == '\0' ? "" : " ", id, line);
}

/// All obstacles; the ground and plants are none.
static Walls find_walls(const FrSolids *solids, const GPtrArray *obstacles) {
    FR_ASSERT(solids->all->len >= obstacles->len);
    Walls walls = {g_new0(Wall, obstacles->len + 1u), obstacles->len};
    for (guint i = 0; i < walls.count; i++) {
        guint at = solids->all->len - walls.count + i;
        walls.at[i].solid = &g_array_index(solids->all, FrGrowthObstacle, at);
        walls.at[i].obstacle = g_ptr_array_index(obstacles, i);
        bound(&walls.at[i]);
    }
    return walls;
}

static void clear_walls(Walls *walls) {
    for (guint i = 0; i < walls->count; i++) {
        fr_distance_free(walls->at[i].surface);
    }
    g_free(walls->at);
}

static void tell_all(const FrScene *scene, const Walls *walls, const FrSeeds *seeds,
                     const FrContext *context) {
    Reaching reaching = {0};
    for (uint32_t i = 0; i < seeds->count; i++) {
        const FrSeed *seed = &seeds->at[i];
        if (reaching.seeds == 0 || !fr_span_is_same(seed->span, reaching.span)) {
            tell(&reaching, context);
            reaching = (Reaching){.span = seed->span};
        }
        reaching.seeds++;
        const FrPlantDef *definition = g_ptr_array_index(seeds->definitions, seed->species);
        const FrSpeciesParams *params = &definition->species->params;
        if (params->collide && params->climb <= 0) {
            const FrPlant *plant =
                g_array_index(scene->plants, FrScenePlant, seeds->plants[i]).plant;
            note_plant(&reaching, walls, plant, seed, context);
        }
    }
    tell(&reaching, context);
}

void fr_reaching_tell(const FrScene *scene, const FrSeeds *seeds, const FrContext *context) {
    const GPtrArray *obstacles = scene->surroundings->obstacles;
    if (obstacles->len == 0 || seeds->count == 0) {
        return;
    }
    FrSolids solids = fr_solids_new();
    const vec3s nowhere[2] = {0};
    FrStatus status = fr_solids_add_surroundings(&solids, scene, NULL, nowhere, context);
    if (status == FR_OK) {
        Walls walls = find_walls(&solids, obstacles);
        tell_all(scene, &walls, seeds, context);
        clear_walls(&walls);
    }
    fr_solids_clear(&solids);
}
