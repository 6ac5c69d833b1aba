/// --stats: one JSON object. What does not apply is left out.
#include "cli/cli.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

/// Counts of a scene, each plant as often as it stands there.
typedef struct Totals {
    uint64_t instances, modules, plants, axes, nodes, organs, shapes;
    json_t *by_component, *by_production;
} Totals;

void cli_count_made(json_t *object, const FrPlant *plant, const uint64_t *made) {
    for (guint c = 0; c < plant->components->len; c++) {
        char *id = g_utf8_make_valid(g_array_index(plant->components, FrComponent, c).id, -1);
        json_int_t before = json_integer_value(json_object_get(object, id));
        json_object_set_new(object, id, json_integer(before + (json_int_t)made[c]));
        g_free(id);
    }
}

static Totals count_scene(const FrScene *scene) {
    guint stands = fr_scene_stand_count(scene);
    Totals totals = {
        .plants = stands, .by_component = json_object(), .by_production = json_object()};
    for (guint i = 0; i < stands; i++) {
        uint32_t index = g_array_index(scene->stands, FrStand, i).plant;
        const FrScenePlant *built = &g_array_index(scene->plants, FrScenePlant, index);
        const FrPlant *plant = built->plant;
        totals.instances += built->instances;
        totals.modules += built->modules;
        totals.axes += plant->axes.count;
        totals.nodes += fr_plant_internodes(plant);
        totals.organs += plant->organs.count;
        cli_count_made(built->modules > 0 ? totals.by_production : totals.by_component, plant,
                       built->by_component);
    }
    for (guint i = 0; i < fr_scene_plant_count(scene); i++) {
        totals.shapes += g_array_index(scene->plants, FrScenePlant, i).plant->shapes->len;
    }
    return totals;
}

static void set_count(json_t *object, const char *key, uint64_t count) {
    json_object_set_new(object, key, json_integer((json_int_t)count));
}

static void set_text(json_t *object, const char *key, const char *text) {
    json_object_set_new(object, key, json_string(text));
}

json_t *cli_drawn_json(const FrLdrawn *drawn) {
    return json_pack("{s:I, s:I, s:f, s:[fff], s:[fff], s:I, s:I, s:I, s:I, s:I}", "modules",
                     (json_int_t)drawn->modules, "segments", (json_int_t)drawn->segments, "length",
                     drawn->length, "min", drawn->min[0], drawn->min[1], drawn->min[2], "max",
                     drawn->max[0], drawn->max[1], drawn->max[2], "spheres",
                     (json_int_t)drawn->spheres, "discs", (json_int_t)drawn->discs, "polygons",
                     (json_int_t)drawn->polygons, "surfaces", (json_int_t)drawn->surfaces,
                     "cylinders", (json_int_t)drawn->cylinders);
}

static json_t *seconds_of(const CliSession *session, const FrScene *scene, const FrIoStats *io) {
    json_t *seconds = json_object();
    json_object_set_new(seconds, "read", json_real(session->read_seconds));
    json_object_set_new(seconds, "build", json_real(session->build_seconds));
    if (scene->light_seconds > 0) {
        json_object_set_new(seconds, "light", json_real(scene->light_seconds));
    }
    if (io != NULL) {
        json_object_set_new(seconds, "skin", json_real(io->skin_seconds));
        json_object_set_new(seconds, "write", json_real(io->write_seconds));
    }
    if (session->render_seconds > 0) {
        json_object_set_new(seconds, "render", json_real(session->render_seconds));
    }
    json_object_set_new(seconds, "total", json_real(cli_now() - session->began));
    return seconds;
}

/// What light was made for plants that answer it.
static void set_light(json_t *stats, const FrScene *scene) {
    if (scene->light_seconds > 0) {
        set_count(stats, "photons", scene->light.photons);
        set_count(stats, "rays", scene->light.rays);
    }
}

/// What a step of plants that grow bud by bud has done.
static void set_buds(json_t *row, const FrSceneStep *step) {
    set_count(row, "active_buds", step->active_buds);
    set_count(row, "shed", step->shed);
    set_count(row, "collisions", step->collisions);
    char digest[17];
    g_snprintf(digest, sizeof digest, "%016" G_GINT64_MODIFIER "x", step->digest);
    set_text(row, "digest", digest);
}

static void set_stand(json_t *row, uint64_t living, double wood) {
    set_count(row, "living", living);
    json_object_set_new(row, "wood", json_real(wood));
}

/// Steps that a run was resumed after have no stands.
static void set_stand_of_step(json_t *row, const CliSession *session, uint64_t step) {
    const CliStand *first = (const CliStand *)(void *)session->stands->data;
    if (session->stands->len > 0 && step >= first->step) {
        const CliStand *stand = &first[step - first->step];
        set_stand(row, stand->living, stand->wood);
    }
}

static bool is_alive(const FrPlant *plant) {
    bool is_alive = false;
    for (uint32_t i = 0; i < plant->buds.count; i++) {
        is_alive |= plant->buds.state[i] == FR_BUD_ACTIVE;
    }
    return is_alive;
}

static double wood_of(const FrPlant *plant) {
    double sum = 0;
    for (uint32_t i = 0; i < plant->nodes.count; i++) {
        double radius = (double)plant->nodes.radius[i];
        sum += G_PI * radius * radius * (double)plant->nodes.length[i];
    }
    return sum;
}

/// How many plants that grow bud by bud still grow, and the volume of their wood in m³.
static void set_living(json_t *stats, const FrScene *scene) {
    uint64_t living = 0;
    double wood = 0;
    for (guint i = 0; i < fr_scene_stand_count(scene); i++) {
        uint32_t index = g_array_index(scene->stands, FrStand, i).plant;
        const FrPlant *plant = g_array_index(scene->plants, FrScenePlant, index).plant;
        if (is_alive(plant)) {
            living++;
            wood += wood_of(plant);
        }
    }
    set_stand(stats, living, wood);
}

/// What every step of plants that grow in the light took and made.
static void set_steps(json_t *stats, const CliSession *session, const FrScene *scene) {
    if (scene->steps == NULL || scene->steps->len == 0) {
        return;
    }
    set_count(stats, "steps", scene->steps->len);
    const FrSceneStep *last = NULL; // of those that grew buds: L-systems may grow longer
    json_t *steps = json_array();
    for (guint i = 0; i < scene->steps->len; i++) {
        const FrSceneStep *step = &g_array_index(scene->steps, FrSceneStep, i);
        json_t *row =
            json_pack("{s:I, s:f, s:f, s:I, s:I, s:I, s:I}", "step", (json_int_t)step->step,
                      "seconds", step->seconds, "light", step->light_seconds, "nodes",
                      (json_int_t)step->nodes, "organs", (json_int_t)step->organs, "queries",
                      (json_int_t)step->queries, "rays_recast", (json_int_t)step->rays_recast);
        if (step->grows_buds) {
            set_buds(row, step);
            set_stand_of_step(row, session, step->step);
            last = step;
        }
        json_array_append_new(steps, row);
    }
    if (last != NULL) {
        set_count(stats, "active_buds", last->active_buds);
        set_living(stats, scene);
    }
    json_object_set_new(stats, "per_step", steps);
}

static uint64_t peak_bytes(void) {
    struct rusage usage;
    return getrusage(RUSAGE_SELF, &usage) == 0 ? (uint64_t)usage.ru_maxrss * 1024 : 0;
}

/// What the turtle of each L-system drew, in the order of the plants.
static json_t *drawn_of(const FrScene *scene) {
    json_t *list = json_array();
    for (guint i = 0; i < fr_scene_plant_count(scene); i++) {
        const FrScenePlant *built = &g_array_index(scene->plants, FrScenePlant, i);
        if (built->drawn.modules > 0) {
            json_array_append_new(list, cli_drawn_json(&built->drawn));
        }
    }
    return list;
}

static json_t *make_stats(const CliSession *session, const char *document, const FrScene *scene,
                          const FrIoStats *io) {
    Totals totals = count_scene(scene);
    json_t *stats = json_object();
    set_text(stats, "frond", FR_VERSION);
    char *name = g_utf8_make_valid(document, -1);
    set_text(stats, "document", name);
    g_free(name);
    set_count(stats, "seed", scene->seed);
    set_count(stats, "threads", (uint64_t)fr_pool_threads(session->context.pool));
    char digest[17];
    g_snprintf(digest, sizeof digest, "%016" G_GINT64_MODIFIER "x", fr_scene_digest(scene));
    set_text(stats, "digest", digest);
    if (totals.instances > 0) {
        set_count(stats, "instances", totals.instances);
        json_object_set(stats, "by_component", totals.by_component);
    }
    if (totals.modules > 0) {
        set_count(stats, "modules", totals.modules);
        json_object_set(stats, "by_production", totals.by_production);
        json_object_set_new(stats, "drawn", drawn_of(scene));
    }
    json_decref(totals.by_component);
    json_decref(totals.by_production);
    set_count(stats, "plants", totals.plants);
    set_count(stats, "axes", totals.axes);
    set_count(stats, "nodes", totals.nodes);
    set_count(stats, "organs", totals.organs);
    set_count(stats, "shapes", totals.shapes);
    if (io != NULL && io->surfaces > 0) {
        set_count(stats, "surfaces", io->surfaces);
    } else if (io != NULL && io->entities == 0) {
        set_count(stats, "meshes", io->meshes);
        set_count(stats, "vertices", io->vertices);
        set_count(stats, "triangles", io->triangles);
    }
    set_light(stats, scene);
    set_steps(stats, session, scene);
    json_object_set_new(stats, "seconds", seconds_of(session, scene, io));
    set_count(stats, "peak_bytes", peak_bytes());
    return stats;
}

FrStatus cli_stats_write(CliSession *session, const char *document, const FrScene *scene,
                         const FrIoStats *io) {
    json_t *stats = make_stats(session, document, scene, io);
    char *text = json_dumps(stats, JSON_INDENT(2) | JSON_REAL_PRECISION(9));
    json_decref(stats);
    FrStatus status = FR_OK;
    if (strcmp(session->options->stats, "-") == 0) {
        printf("%s\n", text);
    } else {
        char *lines = g_strconcat(text, "\n", NULL);
        status = cli_session_save(session, session->options->stats, lines, strlen(lines));
        g_free(lines);
    }
    free(text);
    return status;
}
