// Shipped species: what each sets besides the defaults.
#include "growth/engine.h"

#include <string.h>

typedef struct Preset {
    const char *name;
    const char *settings; ///< attribute=value, separated by semicolons
} Preset;

static const Preset presets[] = {
    {"fir", "model=massart;shed=none;step=0.25;step-ratio=0.8;auxin-reach=1;gravitropism=0.2;"
            "leaves=6;leaf-length=0.1;leaf-width=0.03;leaf-life=30"},
    {"frangipani", "model=leeuwenberg;step=0.3;step-ratio=0.92;dormancy=0;gravitropism=0.1;"
                   "leaves=4;leaf-length=0.18;leaf-width=0.06;tip-radius=0.01"},
    // Common ivy: clings to what stands near, leaves in two rows along it.
    {"ivy",
     "model=open;step=0.08;step-ratio=0.95;length-noise=0.25;laterals=1;divergence=180;"
     "branching-angle=42;dormancy=3;patience=30;auxin-reach=6;max-order=5;climb=0.35;"
     "cling=0.7;climb-free=0.5;gravitropism=0.14;phototropism=0.05;wander=20;"
     "branch-dark=0.05;branch-light=0.2;wake-light=0.1;shed=none;box=1;trials=8;trial-angle=40;"
     "tip-radius=0.002;pipe-exponent=2.5;taper=0.05;leaves=1;leaf-life=200;"
     "leaf-light=0.02;leaf-length=0.11;leaf-width=0.11;leaf-facing=outward;"
     "foliage=0.006"},
    {"maple", "model=rauh;step=0.2;step-ratio=0.9;auxin-reach=2;dormancy=0;phototropism=0.25;"
              "leaves=3;leaf-life=6"},
    {"oak", "model=open;laterals=1;step=0.25;step-ratio=0.93;apical-control=1.05;auxin-reach=2;"
            "branching-angle=60;phototropism=0.5;gravitropism=-0.02;leaves=3;leaf-life=4"},
    {"poplar", "model=attims;step=0.25;step-ratio=0.85;auxin-reach=4;phototropism=0.4;"
               "branching-angle=35;gravitropism=0.1;leaves=4;leaf-length=0.14;leaf-width=0.1"},
    // The constants of Beneš, Andrysco, Šťava 2009, section 4, as they are printed, with the rules
    // of its section 3: particles draw and kill the bud that comes near.
    {"published", "model=open;step=1;step-ratio=1;length-noise=0;taper=0;laterals=2;"
                  "branching-angle=45;dormancy=2;auxin-reach=3;phototropism=0.01;gravitropism=0.5;"
                  "wander=0;kill=2;influence=1;particle-rule=bud;particle-mean=nearest;"
                  "shed=light;shed-share=0.8;shed-light=0.2;shed-dead=0;trials=1;pipe-exponent=2;"
                  "tip-radius=0.015;leaf-length=0.6;leaf-width=0.4;leaf-facing=horizontal"},
    // The constants of the program that the authors of Palubicki et al. 2009 gave away, for a world
    // in shadows with cells of an internode.
    {"self-organizing", "model=open;step=1;step-ratio=1;length-noise=0;wander=0;laterals=1;"
                        "divergence=137.52;branching-angle=65;dormancy=0;patience=10000;"
                        "max-order=60;fate=flux;vigour=2;vigour-base=5;favour=0.65;"
                        "favour-old=0.51;favour-from=7;favour-over=7;shoot=19.9;turning=part;"
                        "turn-part=0.4;phototropism=0.4;gravitropism=0.02;search=0;branch-dark=0;"
                        "branch-light=0;shed=vigour;shed-vigour=0.3;shed-dead=0;collide=no;"
                        "trials=1;tip-radius=0.03;pipe-exponent=2.6;taper=0;leaves=2;"
                        "leaf-length=0.7;leaf-width=0.45;leaf-life=3;leaf-light=0;foliage=0.3"},
    // Fills the vase of its envelope, drawn by particles alone.
    {"vase", "fate=colonize;model=open;particles=2500;step=0.14;step-ratio=1;influence=1;kill=0.3;"
             "gravitropism=0;wander=3;collide=no;leaves=3;leaf-life=8;leaf-light=0;taper=0;"
             "envelope=0,1.5 1.5,2 2.2,3.5 1.8,5 0,6"},
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
    static const char *const names[] = {"fir",  "frangipani", "ivy",       "maple",
                                        "oak",  "poplar",     "published", "self-organizing",
                                        "vase", NULL};
    return names;
}
