// What surfaces leave out of the finish of branches, told once for each plant.
#include "skin/nurbs_job.h"

#include <string.h>

typedef enum FrLeftOut {
    FR_LEFT_ROUND = 1,
    FR_LEFT_BROKEN = 2,
    FR_LEFT_OPEN = 4,
    FR_LEFT_HOLLOW = 8,
    FR_LEFT_BUTTRESSES = 16,
    FR_LEFT_RELIEF = 32,
    FR_LEFT_WELDED = 64,
} FrLeftOut;

static const char *const names[] = {"round ends", "broken ends", "open ends",       "hollow stems",
                                    "buttresses", "relief",      "welded junctions"};

static unsigned left_out_of(const FrNurbsJob *job, const FrTube *tube) {
    const FrFinish *finish = fr_plan_finish(&job->plan, tube->axis);
    if (finish == NULL) {
        return 0;
    }
    unsigned left = 0;
    if ((job->plan.plant->axes.flags[tube->axis] & FR_CUT) != 0) {
        static const unsigned ends[] = {0, FR_LEFT_ROUND, FR_LEFT_BROKEN, FR_LEFT_OPEN};
        left |= finish->cap < G_N_ELEMENTS(ends) ? ends[finish->cap] : 0;
        left |= finish->wall > 0.0F ? FR_LEFT_HOLLOW : 0;
    }
    left |= finish->is_open != 0 ? FR_LEFT_OPEN : 0;
    left &= job->params->caps ? ~0U : ~(unsigned)FR_LEFT_OPEN;
    left |= finish->buttresses > 0 && finish->buttress_depth > 0.0F ? FR_LEFT_BUTTRESSES : 0;
    left |= finish->relief > 0.0F ? FR_LEFT_RELIEF : 0;
    left |= finish->junction == FR_JUNCTION_WELDED ? FR_LEFT_WELDED : 0;
    return left;
}

bool fr_nurbs_is_told(const FrDiags *diags, const char *text) {
    bool is_found = false;
    for (size_t i = 0; i < fr_diags_count(diags) && !is_found; i++) {
        is_found = strcmp(fr_diags_get(diags, i)->text, text) == 0;
    }
    return is_found;
}

/// Where what made an axis is written.
static FrSpan place_of(const FrPlant *plant, uint32_t axis) {
    uint32_t component = plant->axes.component[axis];
    return component < plant->components->len
               ? g_array_index(plant->components, FrComponent, component).span
               : (FrSpan){0};
}

void fr_nurbs_tell_left_out(const FrNurbsJob *job) {
    FrDiags *diags = job->context->diags;
    FrSpan place = {0}; // of the first
    unsigned left = 0;
    for (uint32_t i = 0; i < job->plan.tubes->len; i++) {
        const FrTube *tube = &g_array_index(job->plan.tubes, FrTube, i);
        unsigned more = left_out_of(job, tube);
        place = left == 0 && more != 0 ? place_of(job->plan.plant, tube->axis) : place;
        left |= more;
    }
    if (left == 0 || diags == NULL) {
        return;
    }
    GString *text = g_string_new(NULL);
    for (size_t i = 0; i < G_N_ELEMENTS(names); i++) {
        if ((left & 1U << i) != 0) {
            g_string_append_printf(text, "%s%s", text->len > 0 ? ", " : "", names[i]);
        }
    }
    char *told =
        g_strdup_printf("'%s': its surfaces are without %s", job->plan.plant->name, text->str);
    if (!fr_nurbs_is_told(diags, told)) {
        fr_diags_add(diags, FR_WARNING, "left-out", place, "%s", told);
    }
    g_string_free(text, TRUE);
    g_free(told);
}
