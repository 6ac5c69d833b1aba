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
    FrHabit habit; ///< all 0: that of the species
} Model;

enum { MONO = FR_AXIS_MONOPODIAL, SYMP = FR_AXIS_SYMPODIAL };
enum { EVEN = FR_GROWTH_CONTINUOUS, TIERS = FR_GROWTH_RHYTHMIC, BASE = FR_GROWTH_BASAL };
enum { UP = FR_BEARING_UPRIGHT, LEVEL = FR_BEARING_LEVEL, BENT = FR_BEARING_BENT };

#define GOLDEN 137.508

static const Model models[] = {
    // One stem: ends by flowering, or bears flowers beside and never ends.
    [FR_MODEL_HOLTTUM] = {1, {{MONO, EVEN, 1, 0, 0, 24, UP, 0, GOLDEN, 1}}, {11, 5, 3.5, 3, 0.4}},
    [FR_MODEL_CORNER] = {1, {{MONO, EVEN, 1, 0, 0, 0, UP, 0, GOLDEN, 1}}, {10, 5.5, 1.6, 4, 0.4}},
    // Equal stems from the base.
    [FR_MODEL_TOMLINSON] = {1, {{MONO, BASE, 1, 3, 0, 0, UP, 50, GOLDEN, 1}}, {6, 5, 2.5, 1, 0.6}},
    // Apices divide into equal halves.
    [FR_MODEL_SCHOUTE] = {1, {{SYMP, EVEN, 5, 0, 2, 5, UP, 60, 90, 1}}, {7, 3.5, 1.3, 3, 0.4}},
    // One module upon the other.
    [FR_MODEL_CHAMBERLAIN] = {1, {{SYMP, EVEN, 4, 0, 1, 4, UP, 45, 180, 1}}, {9, 4, 1.2, 4, 0.4}},
    // Equal modules, several upon each.
    [FR_MODEL_LEEUWENBERG] = {1, {{SYMP, EVEN, 3, 0, 3, 3, UP, 40, GOLDEN, 1}}},
    // Modules alike at first, then one goes on as the trunk.
    [FR_MODEL_KORIBA] = {2,
                         {{SYMP, TIERS, 4, 2, 1, 4, UP, 20, GOLDEN, 1},
                          {SYMP, EVEN, 3, 0, 2, 3, UP, 60, 90, 0.7}}},
    // Trunk of modules that each bear tiers of level branches of modules.
    [FR_MODEL_PREVOST] = {2,
                          {{SYMP, TIERS, 4, 4, 1, 4, UP, 25, GOLDEN, 1},
                           {SYMP, EVEN, 2, 0, 2, 2, LEVEL, 70, 180, 0.6}}},
    // Rhythmic trunk, level branches of modules.
    [FR_MODEL_FAGERLIND] = {2,
                            {{MONO, TIERS, 4, 4, 0, 0, UP, 0, GOLDEN, 1},
                             {SYMP, EVEN, 3, 0, 2, 3, LEVEL, 70, 180, 0.6}}},
    // The same with a trunk that never rests.
    [FR_MODEL_PETIT] = {2,
                        {{MONO, EVEN, 1, 1, 0, 0, UP, 0, GOLDEN, 1},
                         {SYMP, EVEN, 3, 0, 2, 3, LEVEL, 70, 180, 0.55}}},
    // Trunk of modules, each with one tier of level branches that go on.
    [FR_MODEL_NOZERAN] = {3,
                          {{SYMP, TIERS, 5, 4, 1, 5, UP, 20, GOLDEN, 1},
                           {MONO, EVEN, 1, 1, 0, 0, LEVEL, 75, 180, 0.6},
                           {MONO, EVEN, 1, 1, 0, 5, LEVEL, 50, 180, 0.5}}},
    // Rhythmic trunk, branches that rise at their ends, module upon module.
    [FR_MODEL_AUBREVILLE] = {2,
                             {{MONO, TIERS, 5, 5, 0, 0, UP, 0, 36, 1},
                              {SYMP, EVEN, 3, 0, 2, 3, LEVEL, 65, 180, 0.6}}},
    // Rhythmic trunk, tiers of level branches.
    [FR_MODEL_MASSART] = {3,
                          {{MONO, TIERS, 3, 5, 0, 0, UP, 0, 36, 1},
                           {MONO, EVEN, 1, 2, 0, 0, LEVEL, 80, 180, 0.55},
                           {MONO, EVEN, 1, 1, 0, 6, LEVEL, 50, 180, 0.5}}},
    // Trunk that never rests, level branches.
    [FR_MODEL_ROUX] = {3,
                       {{MONO, EVEN, 1, 1, 0, 0, UP, 0, GOLDEN, 1},
                        {MONO, EVEN, 1, 1, 0, 0, LEVEL, 80, 180, 0.6},
                        {MONO, EVEN, 1, 1, 0, 4, LEVEL, 50, 180, 0.5}}},
    // The same with branches that are shed like leaves.
    [FR_MODEL_COOK] = {2,
                       {{MONO, EVEN, 1, 2, 0, 0, UP, 0, 90, 1},
                        {MONO, EVEN, 1, 0, 0, 6, LEVEL, 80, 180, 0.7}}},
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
    [FR_MODEL_MANGENOT] = {1, {{MONO, TIERS, 4, 2, 0, 14, BENT, 50, 180, 1}}},
    // Axes that bow under their weight; the next rises from the bow.
    [FR_MODEL_CHAMPAGNAT] = {1, {{MONO, TIERS, 2, 2, 0, 12, BENT, 50, GOLDEN, 1}}},
    // All axes lie level, one upon the other, and are raised afterwards.
    [FR_MODEL_TROLL] = {2,
                        {{MONO, EVEN, 1, 1, 0, 0, BENT, 40, 180, 1},
                         {MONO, EVEN, 1, 1, 0, 0, BENT, 50, 180, 0.9}}},
    // Upright stems from the base with short level branches.
    [FR_MODEL_MCCLURE] = {3,
                          {{MONO, BASE, 1, 4, 0, 0, UP, 0, GOLDEN, 1},
                           {MONO, EVEN, 1, 1, 0, 0, UP, 25, GOLDEN, 1},
                           {MONO, EVEN, 1, 1, 0, 4, LEVEL, 65, 180, 0.45}},
                          {1.5, 1, 0.35, 1, 1}},
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

FrHabit fr_species_habit(int model) {
    bool is_own = model < (int)G_N_ELEMENTS(models) && models[model].habit.girth > 0;
    return is_own ? models[model].habit : (FrHabit){1, 1, 1, 1, 1};
}
