// L-systems: reading, deriving with small limits, drawing, and reading as a view.
#include "fuzz.h"

#include "frond/lsystem.h"

static void derive(const FrLsystem *system, const FrContext *context) {
    FrLsimple simple = fr_lsimple_default();
    FrEnvironment environment = fr_lsimple_environment(&simple);
    FrLsettings settings = fr_lsettings_default();
    settings.environment = &environment;
    FrLderivation *derivation;
    if (fr_lderivation_new(system, &settings, context, &derivation) != FR_OK) {
        return;
    }
    FrStatus status = fr_lderivation_run(derivation, 6, context);
    FrPlant *plant = NULL;
    if (status == FR_OK && fr_lderivation_plant(derivation, context, &plant, NULL) == FR_OK) {
        FR_ASSERT(fr_plant_is_valid(plant, NULL));
        fr_plant_free(plant);
    }
    GString *text = g_string_new(NULL);
    fr_lstring_print(fr_lderivation_string(derivation), text);
    g_string_free(text, TRUE);
    fr_lderivation_free(derivation);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    FrContext context = fr_context_default();
    context.diags = fr_diags_new();
    context.limits.modules = 20000;
    context.limits.iterations = 20000;
    context.limits.document_bytes = 100000;
    FrSource *source = fr_source_new("fuzz.l", (const char *)data, size);
    FrLoptions options = {0};
    FrLsystem *system;
    if (fr_lsystem_compile(source, &options, &context, &system) == FR_OK) {
        derive(system, &context);
        fr_lsystem_free(system);
    }
    FrLview *view;
    if (fr_lview_read(source, "/nonexistent", &context, &view) == FR_OK) {
        fr_lview_free(view);
    }
    fr_diags_free(context.diags);
    fr_source_unref(source);
    return 0;
}
