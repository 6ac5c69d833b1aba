// Which organs a level of detail shows, without making triangles of the plant.
#include "skin/organs.h"

#include <string.h>

FrStatus fr_skin_organ_factors(const FrPlant *plant, const FrSkinParams *params,
                               const FrContext *context, float *factors) {
    FrPlan plan;
    FrOrganPlan organs;
    fr_plan_init(&plan, plant, NULL, params, context);
    FrStatus status = fr_organs_init(&organs, &plan, NULL);
    if (plant->organs.count > 0) {
        memset(factors, 0, plant->organs.count * sizeof *factors);
    }
    for (uint32_t piece = 0; status == FR_OK && piece < organs.piece_count; piece++) {
        factors[organs.pieces[piece].organ] = fr_piece_enlarged(&organs, piece);
    }
    fr_organs_clear(&organs);
    fr_plan_clear(&plan);
    return status;
}
