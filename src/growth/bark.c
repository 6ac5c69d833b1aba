// The wood that climbers hold on to: internodes of plants that carry themselves, as they are drawn,
// where a climber can come to in a step. Made anew when wood has changed; from its plants alone, so
// that saved and resumed growth has the same.
#include "growth/climbing.h"
#include "growth/spline.h"

#include <math.h>
#include <string.h>

/// What a climber can feel in the next step, in a box.
typedef struct Reach {
    double min[3], max[3];
} Reach;

typedef struct Gathering {
    const FrGrowth *growth;
    GArray *reaches; ///< Reach
    double thinnest;
    GArray **stems; ///< FrStem, by plant; NULL: none
} Gathering;

static bool climbs(const FrGrowth *growth, const FrGrownPlant *plant) {
    return fr_species_climbs(&fr_species_of(growth, plant)->params);
}

static Reach box_of(const FrGrownPlant *plant, double around) {
    Reach box;
    for (int r = 0; r < 3; r++) {
        double low = 0, high = 0;
        for (uint32_t i = 0; i < plant->nodes.count; i++) {
            low = fmin(low, (double)plant->nodes.at[i].raw[r]);
            high = fmax(high, (double)plant->nodes.at[i].raw[r]);
        }
        box.min[r] = plant->seed.at[r] + low - around;
        box.max[r] = plant->seed.at[r] + high + around;
    }
    return box;
}

/// True if one of the climbers' boxes comes so near to a box.
static bool is_reached(const Gathering *gathering, const Reach *box, double radius) {
    bool is_any = false;
    for (uint32_t i = 0; i < gathering->reaches->len && !is_any; i++) {
        const Reach *reach = &g_array_index(gathering->reaches, Reach, i);
        is_any = true;
        for (int r = 0; r < 3; r++) {
            is_any &=
                box->min[r] - radius <= reach->max[r] && box->max[r] + radius >= reach->min[r];
        }
    }
    return is_any;
}

static void add_part(const Gathering *gathering, const FrGrownPlant *plant,
                     const FrInternodeParts *parts, uint32_t part, GArray *stems) {
    FrStem stem = {.radius = {(double)parts->radius[part - 1], (double)parts->radius[part]}};
    double radius = fmax(stem.radius[0], stem.radius[1]);
    Reach box;
    for (int r = 0; r < 3; r++) {
        stem.from[r] = plant->seed.at[r] + (double)parts->at[part - 1].raw[r];
        stem.to[r] = plant->seed.at[r] + (double)parts->at[part].raw[r];
        box.min[r] = fmin(stem.from[r], stem.to[r]);
        box.max[r] = fmax(stem.from[r], stem.to[r]);
    }
    if (radius >= gathering->thinnest && is_reached(gathering, &box, radius)) {
        g_array_append_val(stems, stem);
    }
}

static GArray *stems_of(const Gathering *gathering, const FrGrownPlant *plant) {
    const FrSpeciesParams *params = &fr_species_of(gathering->growth, plant)->params;
    float *radii = fr_growth_radii_of(gathering->growth, plant);
    FrTangents tangents = fr_spline_tangents(plant);
    GArray *stems = g_array_new(FALSE, FALSE, sizeof(FrStem));
    for (uint32_t i = 0; i < plant->nodes.count; i++) {
        uint32_t parent = plant->nodes.parent[i];
        float thickest = parent == FR_NONE ? radii[i] : fmaxf(radii[i], radii[parent]);
        if ((double)thickest >= gathering->thinnest) {
            FrInternodeParts parts = fr_spline_parts(plant, params, &tangents, radii, i);
            for (uint32_t part = 1; part <= parts.count; part++) {
                add_part(gathering, plant, &parts, part, stems);
            }
        }
    }
    fr_spline_clear(&tangents);
    g_free(radii);
    return stems;
}

/// No wood is farther from the box of a plant's nodes: a bend, and the radius of all strands in
/// one.
static double most_around(const FrGrowth *growth, const FrGrownPlant *plant) {
    const FrSpeciesParams *params = &fr_species_of(growth, plant)->params;
    double pipes = (double)plant->nodes.count * (1 + params->taper);
    for (uint32_t i = 0; i < plant->nodes.count; i++) {
        pipes += (double)plant->nodes.wood[i];
    }
    double radius = params->tip_radius * pow(MAX(pipes, 1), 1 / params->pipe_exponent);
    return fr_growth_longest(params) + radius;
}

static void gather_range(void *data, size_t begin, size_t end, int worker) {
    (void)worker;
    const Gathering *gathering = data;
    for (size_t p = begin; p < end; p++) {
        const FrGrownPlant *plant = &gathering->growth->plants[p];
        bool is_wood = plant->nodes.count > 0 && !climbs(gathering->growth, plant);
        gathering->stems[p] = NULL;
        if (is_wood) {
            Reach box = box_of(plant, most_around(gathering->growth, plant));
            bool is_near = is_reached(gathering, &box, 0);
            gathering->stems[p] = is_near ? stems_of(gathering, plant) : NULL;
        }
    }
}

/// Where climbers can come to: a step's internodes, and as much again that wood may carry them.
static void find_reaches(Gathering *gathering) {
    const FrGrowth *growth = gathering->growth;
    for (uint32_t p = 0; p < growth->plant_count; p++) {
        const FrGrownPlant *plant = &growth->plants[p];
        const FrSpeciesParams *params = &fr_species_of(growth, plant)->params;
        if (climbs(growth, plant)) { // seeds that wait may begin in the next step
            bool by_vigour = params->fate == FR_FATE_FLUX || params->fate == FR_FATE_PRIORITY;
            double shoot = by_vigour ? ceil(params->shoot) : 1;
            Reach reach = box_of(plant, params->climb + (shoot + 1) * fr_growth_longest(params));
            g_array_append_val(gathering->reaches, reach);
            gathering->thinnest = fmin(gathering->thinnest, params->climb_wood);
        }
    }
}

void fr_growth_find_bark(FrGrowth *growth, const FrContext *context) {
    fr_stems_free(growth->bark);
    growth->bark = NULL;
    Gathering gathering = {.growth = growth,
                           .reaches = g_array_new(FALSE, FALSE, sizeof(Reach)),
                           .thinnest = INFINITY};
    find_reaches(&gathering);
    if (gathering.reaches->len > 0) {
        gathering.stems = g_new0(GArray *, growth->plant_count);
        fr_parallel_for(context->pool, growth->plant_count, 1, gather_range, &gathering, NULL);
        GArray *all = g_array_new(FALSE, FALSE, sizeof(FrStem));
        for (uint32_t p = 0; p < growth->plant_count; p++) {
            if (gathering.stems[p] != NULL) {
                g_array_append_vals(all, gathering.stems[p]->data, gathering.stems[p]->len);
                g_array_free(gathering.stems[p], TRUE);
            }
        }
        growth->bark = fr_stems_new((const FrStem *)(void *)all->data, all->len);
        g_array_free(all, TRUE);
        g_free(gathering.stems);
    }
    g_array_free(gathering.reaches, TRUE);
}
