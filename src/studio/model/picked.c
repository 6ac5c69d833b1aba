#include "studio/model/picked.h"

#include "studio/model/outline.h"

StudioPicked studio_picked_of(const FrScene *scene, const FrPick *pick) {
    const FrStand *stand = &g_array_index(scene->stands, FrStand, pick->stand);
    const FrPlant *plant = g_array_index(scene->plants, FrScenePlant, pick->plant).plant;
    StudioPicked picked = {
        .plant = g_strdup(plant->name),
        .component =
            pick->component < plant->components->len
                ? g_strdup(g_array_index(plant->components, FrComponent, pick->component).id)
                : NULL,
        .path = pick->path,
        .is_organ = pick->organ != FR_NONE,
        .distance = pick->distance,
        .lines = g_array_new(FALSE, FALSE, 3 * sizeof(float)),
    };
    if (picked.is_organ) {
        studio_outline_organ(picked.lines, stand, plant, pick->organ);
    } else {
        studio_outline_axis(picked.lines, stand, plant, plant->nodes.axis[pick->node]);
    }
    return picked;
}

void studio_picked_clear(StudioPicked *picked) {
    g_free(picked->plant);
    g_free(picked->component);
    g_array_unref(picked->lines);
}

typedef struct Question {
    const double *origin, *direction;
    double spread;
    StudioPicked *picked;
    bool is_met;
} Question;

static void answer(void *user, const FrScene *scene) {
    Question *question = user;
    FrPick pick;
    question->is_met = scene != NULL && fr_scene_pick(scene, question->origin, question->direction,
                                                      question->spread, &pick);
    if (question->is_met) {
        *question->picked = studio_picked_of(scene, &pick);
    }
}

bool studio_builder_pick(StudioBuilder *builder, const double origin[3], const double direction[3],
                         double spread, StudioPicked *picked) {
    Question question = {origin, direction, spread, picked, false};
    studio_builder_use(builder, answer, &question);
    return question.is_met;
}
