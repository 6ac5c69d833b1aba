/// What has grown in a scene, told of single plants.
#include "cli/cli.h"

#include <math.h>
#include <stdio.h>

/// The measures of a plant where it stands.
typedef struct Measures {
    const FrStand *stand;
    const FrPlant *plant;
    double height, width; ///< m
} Measures;

static Measures measure(const FrScene *scene, guint index) {
    const FrStand *stand = &g_array_index(scene->stands, FrStand, index);
    const FrPlant *plant = g_array_index(scene->plants, FrScenePlant, stand->plant).plant;
    Measures made = {.stand = stand, .plant = plant};
    vec3s min, max;
    fr_plant_bounds(plant, &min, &max);
    if (min.z <= max.z) {
        made.height = stand->scale * (double)(max.z - min.z);
        made.width = stand->scale * (double)fmaxf(max.x - min.x, max.y - min.y);
    }
    return made;
}

static void print(const Measures *of) {
    const FrPlant *plant = of->plant;
    char *nodes = cli_count_text(fr_plant_internodes(plant)),
         *axes = cli_count_text(plant->axes.count);
    char *organs = cli_count_text(plant->organs.count);
    printf(
        "%s at %g, %g, %g: %s internodes of %s branches, %s leaves and other organs, %.3g m high, "
        "%.3g m wide\n",
        plant->name, of->stand->at[0], of->stand->at[1], of->stand->at[2], nodes, axes, organs,
        of->height, of->width);
    g_free(nodes);
    g_free(axes);
    g_free(organs);
}

static json_t *to_json(const Measures *of) {
    const double *at = of->stand->at;
    return json_pack("{s:s, s:[f, f, f], s:I, s:I, s:I, s:f, s:f}", "plant", of->plant->name, "at",
                     at[0], at[1], at[2], "nodes", (json_int_t)fr_plant_internodes(of->plant),
                     "axes", (json_int_t)of->plant->axes.count, "organs",
                     (json_int_t)of->plant->organs.count, "height", of->height, "width", of->width);
}

FrStatus cli_standing_info(CliSession *session, const FrDocument *document) {
    FrScene *scene;
    FrStatus status = cli_session_grow(session, document, session->options->time, &scene);
    if (status != FR_OK) {
        return status;
    }
    json_t *stands = session->options->is_json ? json_array() : NULL;
    for (guint i = 0; i < scene->stands->len; i++) {
        const Measures of = measure(scene, i);
        if (stands != NULL) {
            json_array_append_new(stands, to_json(&of));
        } else {
            print(&of);
        }
    }
    if (stands != NULL) {
        char *name = g_utf8_make_valid(fr_document_name(document), -1);
        json_t *info = json_pack("{s:s, s:o}", "document", name, "stands", stands);
        json_dumpf(info, stdout, JSON_INDENT(2));
        printf("\n");
        json_decref(info);
        g_free(name);
    }
    fr_scene_free(scene);
    return FR_OK;
}
