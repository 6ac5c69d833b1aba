/// Branches of plants that are no p-graphs, as `select` of strokes and indicators names them.
#include "cli/cli.h"

#include <stdio.h>
#include <string.h>

static uint32_t count_axes(const FrPlant *plant, uint32_t component) {
    uint32_t count = 0;
    for (uint32_t a = 0; a < plant->axes.count; a++) {
        count += plant->axes.component[a] == component;
    }
    return count;
}

static const char *name_of(const FrPlant *plant, uint32_t component) {
    return g_array_index(plant->components, FrComponent, component).id;
}

void cli_branches_print(const FrPlant *plant) {
    for (uint32_t c = 0; c < plant->components->len; c++) {
        uint32_t count = count_axes(plant, c);
        const char *name = name_of(plant, c);
        if (count > 0) {
            char *text = cli_count_text(count);
            printf("  %-20s %-10s %12s  select=\"%s\", \"%s:1\" to \"%s:%u\"\n", name, "branches",
                   text, name, name, name, count);
            g_free(text);
        }
    }
}

json_t *cli_branches_json(const FrPlant *plant) {
    json_t *branches = json_array();
    for (uint32_t c = 0; c < plant->components->len; c++) {
        json_array_append_new(branches, json_pack("{s:s, s:I}", "id", name_of(plant, c), "axes",
                                                  (json_int_t)count_axes(plant, c)));
    }
    return branches;
}

/// Whether an axis is of that component; of none if it is NULL.
static bool is_of(const FrPlant *plant, uint32_t axis, const char *component) {
    uint32_t own = plant->axes.component[axis];
    return component != NULL && own < plant->components->len &&
           strcmp(name_of(plant, own), component) == 0;
}

void cli_branches_print_paths(const FrPlant *plant, const char *component) {
    uint32_t ordinal = 0;
    for (uint32_t a = 0; a < plant->axes.count; a++) {
        if (is_of(plant, a, component)) {
            printf("  %s:%u  #%016" G_GINT64_MODIFIER "x\n", component, ++ordinal,
                   (uint64_t)plant->axes.path[a]);
        }
    }
}

void cli_branches_add_paths(const FrPlant *plant, const char *component, json_t *paths) {
    for (uint32_t a = 0; a < plant->axes.count; a++) {
        if (is_of(plant, a, component)) {
            char path[18];
            g_snprintf(path, sizeof path, "#%016" G_GINT64_MODIFIER "x",
                       (uint64_t)plant->axes.path[a]);
            json_array_append_new(paths, json_string(path));
        }
    }
}
