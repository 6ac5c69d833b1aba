// Tables of lines and multiscale tree graphs from any text: finite lines that weld to a valid
// plant, or a diagnostic.
#include "fuzz.h"

#include "variation/skeleton_mtg.h"

#include <math.h>

static void weld(const FrSegment *lines, size_t count, const FrContext *context) {
    for (size_t i = 0; i < count; i++) {
        FR_ASSERT(isfinite(lines[i].radius));
        for (int k = 0; k < 3; k++) {
            FR_ASSERT(isfinite(lines[i].from.raw[k]) && isfinite(lines[i].to.raw[k]));
        }
    }
    FrPlant *plant = NULL;
    FrStatus status = fr_skeleton_weld(lines, count, -1, "scan", (FrSpan){0}, context, &plant);
    FR_ASSERT(status != FR_OK || fr_plant_is_valid(plant, NULL));
    fr_plant_free(plant);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    if (size > 1 << 16) {
        return 0;
    }
    FrSource *source = fr_source_new("input", (const char *)data, size);
    for (int way = 0; way < 2; way++) {
        FrContext context = fr_context_default();
        context.diags = fr_diags_new();
        FrSegment *lines = NULL;
        size_t count = 0;
        FrStatus status =
            (way == 0 ? fr_skeleton_read : fr_skeleton_read_mtg)(source, &context, &lines, &count);
        FR_ASSERT(status == FR_OK || fr_diags_error_count(context.diags) > 0);
        if (status == FR_OK) {
            weld(lines, count, &context);
        }
        g_free(lines);
        fr_diags_free(context.diags);
    }
    fr_source_unref(source);
    return 0;
}
