// Shipped species: what each sets besides the defaults.
#include "growth/engine.h"

#include <string.h>

typedef struct Preset {
    const char *name;
    const char *settings; ///< attribute=value, separated by semicolons
} Preset;

static const Preset presets[] = {
    // The constants of Beneš, Andrysco, Šťava 2009, section 4, as they are printed, with the rules
    // of its section 3: particles draw and kill the bud that comes near.
    {"published", "model=open;step=1;step-ratio=1;length-noise=0;taper=0;laterals=2;"
                  "branching-angle=45;dormancy=2;auxin-reach=3;phototropism=0.01;gravitropism=0.5;"
                  "wander=0;kill=2;influence=1;particle-rule=bud;particle-mean=nearest;"
                  "shed=light;shed-share=0.8;shed-light=0.2;trials=1;pipe-exponent=2;"
                  "tip-radius=0.005;leaf-facing=horizontal"},
};

bool fr_species_preset(const char *name, FrSpeciesParams *params) {
    for (size_t i = 0; i < G_N_ELEMENTS(presets); i++) {
        if (strcmp(presets[i].name, name) != 0) {
            continue;
        }
        char **settings = g_strsplit(presets[i].settings, ";", -1);
        for (char **setting = settings; *setting != NULL; setting++) {
            char *value = strchr(*setting, '=');
            FR_ASSERT(value != NULL);
            *value++ = '\0';
            const FrParam *row = fr_params_find(fr_species_table(), *setting);
            FR_ASSERT(row != NULL);
            FrStatus status =
                fr_params_set(fr_species_table(), params, row, value, (FrSpan){0}, NULL, NULL);
            FR_ASSERT(status == FR_OK);
        }
        g_strfreev(settings);
        return true;
    }
    return false;
}

const char *const *fr_species_presets(void) {
    static const char *const names[] = {"published", NULL};
    return names;
}
