// Architectural models after Hallé and Oldeman 1970 (Hallé, Oldeman, Tomlinson 1978, Tropical Trees
// and Forests) as rows of a table: how axes of each order are built. A sympodial axis ends after
// its unit and is gone on with by relays of its own row; tiers are of the next row.
#include "growth/engine.h"

#define DEGREES (G_PI / 180)

typedef struct Row {
    int axis, growth;
    int unit, tier, relays, life;
    int bearing;
    double angle, divergence, length;
} Row;

typedef struct Model {
    int count;
    Row rows[3];
} Model;

enum { MONO = FR_AXIS_MONOPODIAL, SYMP = FR_AXIS_SYMPODIAL };
enum { EVEN = FR_GROWTH_CONTINUOUS, TIERS = FR_GROWTH_RHYTHMIC, BASE = FR_GROWTH_BASAL };
enum { UP = FR_BEARING_UPRIGHT, LEVEL = FR_BEARING_LEVEL, BENT = FR_BEARING_BENT };

#define GOLDEN 137.508

static const Model models[] = {
    // One stem: ends by flowering, or bears flowers beside and never ends.
    [FR_MODEL_HOLTTUM] = {1, {{MONO, EVEN, 1, 0, 0, 14, UP, 0, GOLDEN, 1}}},
    [FR_MODEL_CORNER] = {1, {{MONO, EVEN, 1, 0, 0, 0, UP, 0, GOLDEN, 1}}},
    // Equal stems from the base.
    [FR_MODEL_TOMLINSON] = {1, {{MONO, BASE, 2, 2, 0, 0, UP, 50, GOLDEN, 1}}},
    // Apices divide into equal halves.
    [FR_MODEL_SCHOUTE] = {1, {{SYMP, EVEN, 5, 0, 2, 5, UP, 28, 90, 1}}},
    // One module upon the other.
    [FR_MODEL_CHAMBERLAIN] = {1, {{SYMP, EVEN, 4, 0, 1, 4, UP, 30, 180, 1}}},
    // Equal modules, several upon each.
    [FR_MODEL_LEEUWENBERG] = {1, {{SYMP, EVEN, 3, 0, 3, 3, UP, 40, GOLDEN, 1}}},
    // Modules alike at first, then one goes on as the trunk.
    [FR_MODEL_KORIBA] = {2,
                         {{SYMP, TIERS, 3, 2, 1, 3, UP, 12, GOLDEN, 1},
                          {SYMP, EVEN, 3, 0, 2, 3, LEVEL, 55, 90, 0.9}}},
    // Trunk of modules that each bear tiers of level branches of modules.
    [FR_MODEL_PREVOST] = {2,
                          {{SYMP, TIERS, 3, 3, 1, 3, UP, 12, GOLDEN, 1},
                           {SYMP, EVEN, 2, 0, 2, 2, LEVEL, 60, 180, 0.9}}},
    // Rhythmic trunk, level branches of modules.
    [FR_MODEL_FAGERLIND] = {2,
                            {{MONO, TIERS, 4, 4, 0, 0, UP, 0, GOLDEN, 1},
                             {SYMP, EVEN, 3, 0, 2, 3, LEVEL, 60, 180, 0.9}}},
    // The same with a trunk that never rests.
    [FR_MODEL_PETIT] = {2,
                        {{MONO, EVEN, 1, 1, 0, 0, UP, 0, GOLDEN, 1},
                         {SYMP, EVEN, 3, 0, 2, 3, LEVEL, 60, 180, 0.9}}},
    // Trunk of modules, each with one tier of level branches that go on.
    [FR_MODEL_NOZERAN] = {3,
                          {{SYMP, TIERS, 4, 4, 1, 4, UP, 8, GOLDEN, 1},
                           {MONO, EVEN, 1, 1, 0, 0, LEVEL, 65, 180, 0.9},
                           {MONO, EVEN, 1, 1, 0, 8, LEVEL, 50, 180, 0.8}}},
    // Rhythmic trunk, branches that rise at their ends, module upon module.
    [FR_MODEL_AUBREVILLE] = {2,
                             {{MONO, TIERS, 4, 4, 0, 0, UP, 0, 45, 1},
                              {SYMP, EVEN, 3, 0, 2, 3, BENT, 70, 180, 0.9}}},
    // Rhythmic trunk, tiers of level branches.
    [FR_MODEL_MASSART] = {3,
                          {{MONO, TIERS, 3, 5, 0, 0, UP, 0, 36, 1},
                           {MONO, EVEN, 1, 2, 0, 0, LEVEL, 75, 180, 0.85},
                           {MONO, EVEN, 1, 1, 0, 10, LEVEL, 45, 180, 0.8}}},
    // Trunk that never rests, level branches.
    [FR_MODEL_ROUX] = {3,
                       {{MONO, EVEN, 1, 1, 0, 0, UP, 0, GOLDEN, 1},
                        {MONO, EVEN, 1, 1, 0, 0, LEVEL, 70, 180, 0.85},
                        {MONO, EVEN, 1, 1, 0, 8, LEVEL, 50, 180, 0.8}}},
    // The same with branches that are shed like leaves.
    [FR_MODEL_COOK] = {2,
                       {{MONO, EVEN, 1, 2, 0, 0, UP, 0, 90, 1},
                        {MONO, EVEN, 1, 0, 0, 6, LEVEL, 75, 180, 0.7}}},
    // Rhythmic trunk, upright branches of modules.
    [FR_MODEL_SCARRONE] = {2,
                           {{MONO, TIERS, 4, 3, 0, 0, UP, 0, GOLDEN, 1},
                            {SYMP, EVEN, 3, 0, 2, 3, UP, 45, 90, 0.9}}},
    // The same with a trunk that never rests.
    [FR_MODEL_STONE] = {2,
                        {{MONO, EVEN, 1, 1, 0, 0, UP, 0, GOLDEN, 1},
                         {SYMP, EVEN, 3, 0, 2, 3, UP, 45, 90, 0.9}}},
    // Rhythmic trunk, branches built like it.
    [FR_MODEL_RAUH] = {1, {{MONO, TIERS, 3, 4, 0, 0, UP, 45, 61, 1}}},
    // Trunk that never rests, branches built like it.
    [FR_MODEL_ATTIMS] = {1, {{MONO, EVEN, 1, 1, 0, 0, UP, 45, GOLDEN, 1}}},
    // Axes that rise first and then lie level; the next rises where they bend.
    [FR_MODEL_MANGENOT] = {1, {{SYMP, EVEN, 7, 0, 1, 7, BENT, 20, 180, 1}}},
    // Axes that bow under their weight; the next rises from the bow.
    [FR_MODEL_CHAMPAGNAT] = {2,
                             {{MONO, EVEN, 1, 1, 0, 16, BENT, 40, GOLDEN, 1},
                              {MONO, EVEN, 1, 1, 0, 12, BENT, 45, GOLDEN, 0.9}}},
    // All axes lie level, one upon the other.
    [FR_MODEL_TROLL] = {2,
                        {{MONO, EVEN, 1, 1, 0, 0, BENT, 30, 180, 1},
                         {MONO, EVEN, 1, 1, 0, 0, LEVEL, 50, 180, 0.9}}},
    // Upright stems from the base with level branches.
    [FR_MODEL_MCCLURE] = {3,
                          {{MONO, BASE, 2, 3, 0, 0, UP, 25, GOLDEN, 1},
                           {MONO, EVEN, 1, 1, 0, 0, UP, 40, GOLDEN, 0.95},
                           {MONO, EVEN, 1, 1, 0, 6, LEVEL, 60, 180, 0.6}}},
};

uint32_t fr_species_model(int model, FrOrderParams *orders) {
    FR_ASSERT(model >= 0 && model < (int)G_N_ELEMENTS(models));
    for (int i = 0; i < models[model].count; i++) {
        const Row *row = &models[model].rows[i];
        fr_params_init(fr_order_table(), &orders[i]);
        orders[i].axis = row->axis;
        orders[i].growth = row->growth;
        orders[i].unit = row->unit;
        orders[i].tier = row->tier;
        orders[i].relays = row->relays;
        orders[i].life = row->life;
        orders[i].bearing = row->bearing;
        orders[i].angle = row->angle * DEGREES;
        orders[i].divergence = row->divergence * DEGREES;
        orders[i].length = row->length;
    }
    return (uint32_t)models[model].count;
}
