// The backend of ray density: surfaces, paths, octree and estimate put together in the order of
// Listing 1 of Van Haevre, Di Fiore, Bekaert, Van Reeth 2004.
#include "light/density.h"

#include <cglm/struct.h>

#define FR_PARAM_STRUCT FrDensityParams
static const FrParam density_rows[] = {FR_DENSITY_PARAMS(FR_PARAM_ROW)};
#undef FR_PARAM_STRUCT

static const FrParamTable density_table = {
    .element = "photons",
    .meaning = "light as the density of rays",
    .rows = density_rows,
    .count = G_N_ELEMENTS(density_rows),
    .struct_size = sizeof(FrDensityParams),
};

const FrParamTable *fr_density_table(void) {
    return &density_table;
}

FrDensityParams fr_density_default(void) {
    FrDensityParams params = {.span = {0}};
    fr_params_init(&density_table, &params);
    return params;
}

static FrDensity *density_of(FrLight *light) {
    return (FrDensity *)(void *)light;
}

static const FrDensity *density_in(const FrLight *light) {
    return (const FrDensity *)(const void *)light;
}

FrEstimator fr_density_estimator(const FrDensity *density) {
    const FrDensityParams *params = &density->params;
    FrEstimator how = {
        .kind = (FrEstimatorKind)params->estimator,
        .distance = params->distance,
        .neighbours = (uint32_t)params->neighbours,
        .power = density->power / (double)params->photons,
        .level = 1,
    };
    // Cells of at most twice the distance: a ball touches no more than 27.
    while (how.level < 20 && fr_octree_cell_width(density->tree, how.level) > 2.0 * how.distance) {
        how.level++;
    }
    return how;
}

// The box around all stands, from the corners of the boxes around the parts of their meshes.
static void bounds_of(const FrLightScene *scene, vec3s *min, vec3s *max) {
    *min = (vec3s){{INFINITY, INFINITY, INFINITY}};
    *max = (vec3s){{-INFINITY, -INFINITY, -INFINITY}};
    for (uint32_t s = 0; s < scene->stand_count; s++) {
        const FrMesh *mesh = scene->meshes[scene->stands[s].mesh].mesh;
        for (uint64_t v = 0; v < mesh->vertex_count; v++) {
            const float *p = mesh->vertices[v].position;
            vec3s at =
                glms_mat4_mulv3(scene->stands[s].transform, (vec3s){{p[0], p[1], p[2]}}, 1.0f);
            for (int c = 0; c < 3 && isfinite(at.x + at.y + at.z); c++) {
                min->raw[c] = fminf(min->raw[c], at.raw[c]);
                max->raw[c] = fmaxf(max->raw[c], at.raw[c]);
            }
        }
    }
    if (!(min->x <= max->x)) {
        *min = (vec3s){{-1, -1, -1}};
        *max = (vec3s){{1, 1, 1}};
    }
}

// A cube about the box, twice as wide, so that points beside what stands there are inside too.
static void place_tree(FrDensity *density, vec3s min, vec3s max) {
    double width = 0.0, corner[3];
    for (int c = 0; c < 3; c++) {
        width = fmax(width, 2.0 * ((double)max.raw[c] - (double)min.raw[c]));
    }
    width = fmax(width, 8.0 * density->params.distance);
    for (int c = 0; c < 3; c++) {
        corner[c] = 0.5 * ((double)min.raw[c] + (double)max.raw[c] - width);
    }
    fr_octree_reset(density->tree, corner, width);
}

// What each element absorbs: the part that its surface takes of all photons that met it.
static void sum_absorbed(FrDensity *density) {
    const FrSoup *soup = fr_surfaces_soup(density->surfaces);
    density->element_count = fr_surfaces_element_count(density->surfaces);
    g_free(density->absorbed);
    density->absorbed = g_new0(double, MAX(density->element_count, 1));
    double power = density->power / (double)density->params.photons;
    for (uint32_t i = 0; i < fr_soup_count(soup); i++) {
        const uint64_t *met = &density->paths->met[2 * (uint64_t)i];
        for (int side = 0; side < 2; side++) {
            if (met[side] > 0) {
                const FrOptics *optics = fr_surfaces_optics(density->surfaces, i, side == 1);
                double kept =
                    1.0 - ((double)optics->diffuse + (double)optics->specular +
                           (double)optics->transmit_diffuse + (double)optics->transmit_specular);
                density->absorbed[fr_surfaces_element(density->surfaces, i)] +=
                    fmax(0.0, kept) * (double)met[side] * power;
            }
        }
    }
}

static FrStatus trace_paths(FrDensity *density, const FrLightScene *scene, vec3s min, vec3s max,
                            uint32_t added, uint32_t removed, const FrContext *context) {
    FrEmitters *emitters = fr_emitters_new(scene->lamps, scene->lamp_count, min, max);
    FrDigest lit_by = fr_emitters_digest(emitters);
    FrStatus status;
    density->power = fr_emitters_power(emitters);
    if (density->is_whole && lit_by == density->lit_by) {
        density->is_whole = false;
        status = fr_paths_update(density->paths, density->surfaces, added, removed, context);
    } else {
        density->is_whole = false;
        place_tree(density, min, max);
        status = fr_paths_trace(density->paths, emitters, density->surfaces, context);
    }
    density->lit_by = lit_by;
    fr_emitters_free(emitters);
    return status;
}

static FrStatus set_scene(FrLight *light, const FrLightScene *scene, const FrContext *context) {
    FrDensity *density = density_of(light);
    uint32_t added = 0, removed = 0;
    FrStatus status =
        fr_surfaces_set(density->surfaces, scene, density->params.span, context, &added, &removed);
    if (status != FR_OK) {
        density->is_whole = false;
        return status;
    }
    vec3s min = scene->min, max = scene->max;
    if (!(min.x <= max.x && min.y <= max.y && min.z <= max.z)) {
        bounds_of(scene, &min, &max);
    }
    status = trace_paths(density, scene, min, max, added, removed, context);
    if (status != FR_OK) {
        return status;
    }
    status = fr_octree_update(density->tree, density->paths, context);
    if (status != FR_OK) {
        return status;
    }
    density->recast = density->paths->traced;
    fr_paths_settle(density->paths);
    uint32_t *remap = fr_surfaces_compact(density->surfaces);
    if (remap != NULL) {
        fr_paths_renumber(density->paths, remap,
                          fr_soup_count(fr_surfaces_soup(density->surfaces)));
        g_free(remap);
    }
    sum_absorbed(density);
    density->is_whole = true;
    return FR_OK;
}

static FrStatus query(FrLight *light, const vec3s *points, size_t count, const FrContext *context,
                      FrLightAnswer *answers) {
    FrDensity *density = density_of(light);
    FrEstimator how = fr_density_estimator(density);
    uint64_t bytes = fr_count_multiply(count, 27 * sizeof(FrCell));
    FrStatus status = fr_limit_check(bytes, context->limits.bytes, "bytes", "the light",
                                     density->params.span, context->diags);
    if (status != FR_OK) {
        return status;
    }
    if (density->is_pruning) {
        fr_octree_next_round(density->tree);
    }
    for (size_t i = 0; i < count; i++) {
        double at[3] = {(double)points[i].x, (double)points[i].y, (double)points[i].z};
        fr_want_ball(density->tree, how.level, at, how.distance);
    }
    if (density->is_pruning) {
        fr_octree_prune(density->tree);
        density->is_pruning = false;
    }
    status = fr_octree_fill(density->tree, density->paths, context);
    if (status != FR_OK) {
        return status;
    }
    density->point_count += count;
    return how.kind == FR_ESTIMATE_NEAREST
               ? fr_estimate_nearest(density->tree, density->paths, &how, points, count, context,
                                     answers)
               : fr_estimate(density->tree, density->paths, &how, points, count, context, answers);
}

// Cells stay until the next query tells which of them it wants again.
static void forget(FrLight *light) {
    FrDensity *density = density_of(light);
    density->is_pruning = true;
    density->point_count = 0;
}

static const double *absorbed(const FrLight *light, uint32_t stand) {
    const FrDensity *density = density_in(light);
    return density->absorbed + fr_surfaces_first_element(density->surfaces, stand);
}

static void stats(const FrLight *light, FrLightStats *stats) {
    const FrDensity *density = density_in(light);
    stats->photons = density->paths->photon_count;
    stats->rays = fr_paths_ray_count(density->paths);
    stats->recast = density->recast;
    stats->cells = fr_octree_cell_count(density->tree);
    stats->references = fr_octree_reference_count(density->tree);
    stats->points = density->point_count;
    stats->bytes = fr_paths_bytes(density->paths) + fr_octree_bytes(density->tree) +
                   fr_surfaces_bytes(density->surfaces) + density->element_count * sizeof(double);
}

static void free_density(FrLight *light) {
    FrDensity *density = density_of(light);
    fr_surfaces_free(density->surfaces);
    fr_paths_free(density->paths);
    fr_octree_free(density->tree);
    fr_params_clear(&density_table, &density->params);
    g_free(density->absorbed);
    g_free(density);
}

FrStatus fr_light_density_new(const FrDensityParams *params, const FrContext *context,
                              FrLight **light) {
    static const FrLightBackend backend = {
        .set_scene = set_scene,
        .query = query,
        .forget = forget,
        .absorbed = absorbed,
        .rays = fr_density_rays,
        .cells = fr_density_cells,
        .stats = stats,
        .free = free_density,
    };
    *light = NULL;
    FrStatus status = fr_limit_check((uint64_t)params->photons, context->limits.photons, "photons",
                                     "the light", params->span, context->diags);
    if (status == FR_OK) {
        // Every photon has a ray at least; how many more, only tracing them tells.
        status = fr_limit_check((uint64_t)params->photons * FR_PHOTON_BYTES, context->limits.bytes,
                                "bytes", "the light", params->span, context->diags);
    }
    if (status != FR_OK) {
        return status;
    }
    FrDensity *density = g_new0(FrDensity, 1);
    density->light.backend = &backend;
    fr_params_copy(&density_table, &density->params, params);
    density->params.span = params->span;
    density->surfaces = fr_surfaces_new(fr_pool_threads(context->pool));
    density->paths =
        fr_paths_new((uint32_t)params->photons, (uint32_t)params->bounces, (uint64_t)params->seed);
    density->paths->span = params->span;
    density->tree = fr_octree_new();
    *light = &density->light;
    return FR_OK;
}
