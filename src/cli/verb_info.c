/// frond info: what is in a document or a model.
#include "cli/cli.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/// One plant of a document, grown, with its i-tree.
typedef struct Grown {
    const FrPlantDef *definition;
    FrPlant *plant;
    FrPgraphCounts counts;
    CliChains *chains;
    uint64_t seed, modules;
    FrLdrawn drawn;
    uint64_t *made; ///< by an L-system's productions
} Grown;

static void clear_grown(Grown *grown) {
    fr_plant_free(grown->plant);
    fr_pgraph_counts_clear(&grown->counts);
    g_free(grown->chains);
    g_free(grown->made);
}

static FrStatus grow(const CliSession *session, const FrDocument *document,
                     const FrPlantDef *definition, Grown *grown) {
    int64_t seed = session->options->seed;
    *grown =
        (Grown){.definition = definition, .seed = seed < 0 ? definition->seed : (uint64_t)seed};
    uint32_t wanted = 0; // any address asks for the i-tree
    grown->counts.parent = &wanted;
    FrScenePlant plant;
    FrStatus status = fr_scene_grow(document, definition, seed, session->options->time,
                                    &session->context, &plant, &grown->counts);
    grown->plant = plant.plant;
    grown->modules = plant.modules;
    grown->drawn = plant.drawn;
    grown->made = plant.by_component;
    if (grown->counts.parent == &wanted) {
        grown->counts.parent = NULL;
    }
    if (status == FR_OK) {
        grown->chains = cli_chains_count(&grown->counts, fr_pgraph_count(definition->pgraph));
    }
    return status;
}

static const char *kind_name(const FrPgraph *graph, uint32_t component) {
    return fr_pgraph_table(fr_pgraph_kind(graph, component))->element;
}

/// "3 chains of 3", "40 chains of 2 to 5", or "" for what is in no recursion.
static char *chains_text(const CliChains *chains) {
    if (chains->longest <= 1) {
        return g_strdup("");
    }
    char *count = cli_count_text(chains->count);
    const char *noun = chains->count == 1 ? "chain" : "chains";
    char *text =
        chains->shortest == chains->longest
            ? g_strdup_printf("%s %s of %u", count, noun, chains->longest)
            : g_strdup_printf("%s %s of %u to %u", count, noun, chains->shortest, chains->longest);
    g_free(count);
    return text;
}

static void print_components(const Grown *grown) {
    const FrPgraph *graph = grown->definition->pgraph;
    printf("  %-20s %-10s %12s\n", "component", "kind", "instances");
    for (uint32_t i = 0; i < fr_pgraph_count(graph); i++) {
        char *count = cli_count_text(grown->counts.by_component[i]);
        char *chains = chains_text(&grown->chains[i]);
        printf("  %-20s %-10s %12s%s%s\n", fr_pgraph_id(graph, i), kind_name(graph, i), count,
               *chains == '\0' ? "" : "  in ", chains);
        g_free(chains);
        g_free(count);
    }
}

static const char *label_of(const FrSlider *slider) {
    return slider->label == NULL ? "" : slider->label;
}

static void print_sliders(const FrPlantDef *definition) {
    for (guint i = 0; i < definition->sliders->len; i++) {
        const FrSlider *slider = g_ptr_array_index(definition->sliders, i);
        if (i == 0) {
            printf("  %-20s %10s %12s\n", "slider", "value", "range");
        }
        char *choice = fr_slider_choice(slider);
        char *value = choice != NULL ? choice : g_strdup_printf("%g", slider->value);
        char *range = choice != NULL ? g_strdelimit(g_strdup(slider->choices), " ", '|')
                                     : g_strdup_printf("%g to %g", slider->min, slider->max);
        printf("  %-20s %10s %12s  %s\n", slider->id, value, range, label_of(slider));
        g_free(value);
        g_free(range);
    }
}

static json_t *sliders_json(const FrPlantDef *definition) {
    json_t *sliders = json_array();
    for (guint i = 0; i < definition->sliders->len; i++) {
        const FrSlider *slider = g_ptr_array_index(definition->sliders, i);
        json_array_append_new(sliders,
                              json_pack("{s:s, s:s, s:f, s:f, s:f, s:f, s:s*}", "id", slider->id,
                                        "label", label_of(slider), "value", slider->value, "min",
                                        slider->min, "max", slider->max, "initial", slider->initial,
                                        "choices", slider->choices));
    }
    return sliders;
}

static void print_drawn(const FrLdrawn *drawn) {
    char *modules = cli_count_text(drawn->modules), *segments = cli_count_text(drawn->segments);
    printf("  drawn: %s modules after homomorphism, %s segments, %g long, "
           "from (%g, %g, %g) to (%g, %g, %g)\n",
           modules, segments, drawn->length, drawn->min[0], drawn->min[1], drawn->min[2],
           drawn->max[0], drawn->max[1], drawn->max[2]);
    g_free(modules);
    g_free(segments);
}

static void print_productions(const Grown *grown) {
    const GArray *components = grown->plant->components;
    printf("  %-31s %12s\n", "production", "drawn");
    for (guint i = 0; i < components->len; i++) {
        char *count = cli_count_text(grown->made[i]);
        printf("  %-31s %12s\n", g_array_index(components, FrComponent, i).id, count);
        g_free(count);
    }
}

// What an edit does: its attributes that are not neutral, as documents write them.
static char *edit_text(const FrEditParams *edit) {
    GString *text = g_string_new(NULL);
    const struct {
        const char *name;
        bool is_set;
    } words[] = {
        {"prune", edit->prune},
        {"hide", edit->hide},
        {"rotate", edit->rotate_x != 0 || edit->rotate_y != 0 || edit->rotate_z != 0},
        {"bend", edit->bend != 0 || edit->bend_aside != 0},
        {"scale", edit->scale != 1},
        {"replace", edit->replace != NULL && *edit->replace != '\0'},
        {"redraw", edit->redraw != 0},
        {"axis", edit->axis != NULL && *edit->axis != '\0'},
    };
    for (size_t k = 0; k < G_N_ELEMENTS(words); k++) {
        if (words[k].is_set) {
            g_string_append_printf(text, "%s%s", text->len > 0 ? " " : "", words[k].name);
        }
    }
    return g_string_free(text, FALSE);
}

static void print_edits(const Grown *grown) {
    const FrPgraph *graph = grown->definition->pgraph;
    for (uint32_t k = 0; k < fr_pgraph_edit_count(graph); k++) {
        const FrEditParams *edit = fr_pgraph_edit_at(graph, k);
        char *what = edit_text(edit);
        printf("  edit %-40s %s%s\n", edit->at, what,
               grown->counts.edits[k] == FR_EDIT_WAITS       ? "  (has no place now)"
               : grown->counts.edits[k] == FR_EDIT_OVERRULED ? "  (a later one has its place)"
                                                             : "");
        g_free(what);
    }
}

static json_t *edits_json(const Grown *grown) {
    const FrPgraph *graph = grown->definition->pgraph;
    json_t *edits = json_array();
    for (uint32_t k = 0; k < fr_pgraph_edit_count(graph); k++) {
        const FrEditParams *edit = fr_pgraph_edit_at(graph, k);
        char *what = edit_text(edit);
        json_array_append_new(edits,
                              json_pack("{s:s, s:s, s:b}", "at", edit->at, "does", what,
                                        "has_place", grown->counts.edits[k] == FR_EDIT_STANDS));
        g_free(what);
    }
    return edits;
}

static void print_plant(const Grown *grown) {
    bool is_lsystem = grown->definition->kind == FR_PLANT_LSYSTEM;
    char *made = cli_count_text(is_lsystem ? grown->modules : grown->counts.instances);
    char *axes = cli_count_text(grown->plant->axes.count);
    char *nodes = cli_count_text(fr_plant_internodes(grown->plant));
    char *organs = cli_count_text(grown->plant->organs.count);
    printf("plant %s, seed %" G_GUINT64_FORMAT ": %s %s, %s axes, %s nodes, %s organs of "
           "%u shapes, digest %016" G_GINT64_MODIFIER "x\n",
           grown->definition->id, grown->seed, made, is_lsystem ? "modules" : "instances", axes,
           nodes, organs, grown->plant->shapes->len, fr_plant_digest(grown->plant));
    g_free(made);
    g_free(axes);
    g_free(nodes);
    g_free(organs);
    if (is_lsystem) {
        print_drawn(&grown->drawn);
        print_productions(grown);
    }
    if (grown->definition->kind == FR_PLANT_PGRAPH) {
        print_components(grown);
        print_edits(grown);
    } else {
        cli_branches_print(grown->plant);
    }
    print_sliders(grown->definition);
}

static json_t *components_json(const Grown *grown) {
    const FrPgraph *graph = grown->definition->pgraph;
    json_t *components = json_array();
    for (uint32_t i = 0; i < fr_pgraph_count(graph); i++) {
        const CliChains *chains = &grown->chains[i];
        json_t *component =
            json_pack("{s:s, s:s, s:I}", "id", fr_pgraph_id(graph, i), "kind", kind_name(graph, i),
                      "instances", (json_int_t)grown->counts.by_component[i]);
        if (chains->longest > 1) {
            json_object_set_new(component, "chains",
                                json_pack("{s:I, s:I, s:I}", "count", (json_int_t)chains->count,
                                          "shortest", (json_int_t)chains->shortest, "longest",
                                          (json_int_t)chains->longest));
        }
        json_array_append_new(components, component);
    }
    return components;
}

static json_t *plant_json(const Grown *grown) {
    char digest[17];
    g_snprintf(digest, sizeof digest, "%016" G_GINT64_MODIFIER "x", fr_plant_digest(grown->plant));
    json_t *plant = json_pack(
        "{s:s, s:I, s:s, s:I, s:I, s:I, s:I}", "id", grown->definition->id, "seed",
        (json_int_t)grown->seed, "digest", digest, "axes", (json_int_t)grown->plant->axes.count,
        "nodes", (json_int_t)fr_plant_internodes(grown->plant), "organs",
        (json_int_t)grown->plant->organs.count, "shapes", (json_int_t)grown->plant->shapes->len);
    if (grown->definition->kind == FR_PLANT_LSYSTEM) {
        json_object_set_new(plant, "modules", json_integer((json_int_t)grown->modules));
        json_object_set_new(plant, "drawn", cli_drawn_json(&grown->drawn));
        json_t *productions = json_object();
        cli_count_made(productions, grown->plant, grown->made);
        json_object_set_new(plant, "productions", productions);
    } else {
        json_object_set_new(plant, "instances", json_integer((json_int_t)grown->counts.instances));
        json_object_set_new(plant, "components", components_json(grown));
        json_object_set_new(plant, "edits", edits_json(grown));
    }
    if (grown->definition->kind != FR_PLANT_PGRAPH) {
        json_object_set_new(plant, "branches", cli_branches_json(grown->plant));
    }
    json_object_set_new(plant, "sliders", sliders_json(grown->definition));
    return plant;
}

/// A varied plant has the components of its base; what is told is which base that is.
static FrStatus describe_varied(CliSession *session, const FrDocument *document,
                                const FrPlantDef *definition, json_t *plants) {
    FrScene *scene;
    FrStatus status = fr_scene_collect(document, definition, session->options->seed,
                                       session->options->time, 1, &session->context, &scene);
    if (status != FR_OK) {
        return status;
    }
    const FrPlant *plant = g_array_index(scene->plants, FrScenePlant, 0).plant;
    const char *base = fr_vary_params(definition->vary)->base;
    char digest[17];
    g_snprintf(digest, sizeof digest, "%016" G_GINT64_MODIFIER "x", fr_plant_digest(plant));
    if (plants != NULL) {
        json_array_append_new(plants,
                              json_pack("{s:s, s:s, s:I, s:s, s:I, s:I, s:I}", "id", definition->id,
                                        "base", base, "seed", (json_int_t)scene->seed, "digest",
                                        digest, "axes", (json_int_t)plant->axes.count, "nodes",
                                        (json_int_t)fr_plant_internodes(plant), "organs",
                                        (json_int_t)plant->organs.count));
    } else {
        printf("plant %s, seed %" G_GUINT64_FORMAT ": %s varied, digest %s\n", definition->id,
               scene->seed, base, digest);
    }
    fr_scene_free(scene);
    return FR_OK;
}

/// The branches whose paths are asked for, of a plant that is no p-graph; NULL: none.
static const char *asked_branches(const CliSession *session, const Grown *grown) {
    return grown->definition->kind != FR_PLANT_PGRAPH ? session->options->paths : NULL;
}

/// The component whose paths are asked for, FR_NONE if this plant has none of that name.
static uint32_t asked_component(const CliSession *session, const Grown *grown) {
    bool has_tree = session->options->paths != NULL && grown->counts.component != NULL;
    return has_tree ? fr_pgraph_find(grown->definition->pgraph, session->options->paths) : FR_NONE;
}

static void print_paths(const CliSession *session, const Grown *grown) {
    uint32_t component = asked_component(session, grown);
    for (uint32_t k = 0; k < grown->counts.instances && component != FR_NONE; k++) {
        if (grown->counts.component[k] == component) {
            char *path = fr_pgraph_path(grown->definition->pgraph, &grown->counts, k);
            printf("  %s\n", path);
            g_free(path);
        }
    }
}

static json_t *paths_json(const CliSession *session, const Grown *grown) {
    uint32_t component = asked_component(session, grown);
    json_t *paths = json_array();
    cli_branches_add_paths(grown->plant, asked_branches(session, grown), paths);
    for (uint32_t k = 0; k < grown->counts.instances && component != FR_NONE; k++) {
        if (grown->counts.component[k] == component) {
            char *path = fr_pgraph_path(grown->definition->pgraph, &grown->counts, k);
            json_array_append_new(paths, json_string(path));
            g_free(path);
        }
    }
    return paths;
}

static FrStatus describe_grown(CliSession *session, const FrDocument *document,
                               const FrPlantDef *definition, json_t *plants) {
    Grown grown;
    FrStatus status = grow(session, document, definition, &grown);
    if (status == FR_OK && plants != NULL) {
        json_t *plant = plant_json(&grown);
        json_t *paths = session->options->paths != NULL ? paths_json(session, &grown) : NULL;
        if (paths != NULL) {
            json_object_set_new(plant, "paths", paths);
        }
        json_array_append_new(plants, plant);
    } else if (status == FR_OK) {
        print_plant(&grown);
        print_paths(session, &grown);
        cli_branches_print_paths(grown.plant, asked_branches(session, &grown));
    }
    clear_grown(&grown);
    return status;
}

static FrStatus describe_plants(CliSession *session, const FrDocument *document, json_t *plants) {
    const GPtrArray *definitions = fr_document_plants(document);
    FrStatus status = FR_OK;
    for (guint i = 0; i < definitions->len && status == FR_OK; i++) {
        const FrPlantDef *definition = g_ptr_array_index(definitions, i);
        status = definition->kind == FR_PLANT_VARIED
                     ? describe_varied(session, document, definition, plants)
                     : describe_grown(session, document, definition, plants);
    }
    return status;
}

static void print_names(const char *heading, const GPtrArray *things,
                        const char *(*name)(const void *thing)) {
    for (guint i = 0; i < things->len; i++) {
        printf("%s%s", i == 0 ? heading : ", ", name(g_ptr_array_index(things, i)));
    }
    printf("%s", things->len > 0 ? "\n" : "");
}

static json_t *names_json(const GPtrArray *things, const char *(*name)(const void *thing)) {
    json_t *names = json_array();
    for (guint i = 0; i < things->len; i++) {
        json_array_append_new(names, json_string(name(g_ptr_array_index(things, i))));
    }
    return names;
}

static const char *material_name(const void *thing) {
    return fr_material_name(thing);
}

static const char *view_name(const void *thing) {
    const char *name = ((const FrViewParams *)thing)->name;
    return name == NULL ? "" : name;
}

static FrStatus describe_as_text(CliSession *session, const FrDocument *document) {
    char *title = fr_document_title(document);
    printf("%s%s%s\n", fr_document_name(document), title == NULL ? "" : ": ",
           title == NULL ? "" : title);
    g_free(title);
    FrStatus status = describe_plants(session, document, NULL);
    if (status == FR_OK) {
        print_names("materials: ", fr_document_materials(document), material_name);
        print_names("views: ", fr_document_views(document), view_name);
        uint64_t stands;
        status = fr_scene_count(document, &session->context, &stands);
        if (status == FR_OK && stands > 0) {
            char *count = cli_count_text(stands);
            printf("scene: %s %s\n", count, stands == 1 ? "plant stands" : "plants stand");
            g_free(count);
        }
    }
    return status;
}

static FrStatus describe_as_json(CliSession *session, const FrDocument *document) {
    json_t *plants = json_array();
    FrStatus status = describe_plants(session, document, plants);
    uint64_t stands = 0;
    if (status == FR_OK) {
        status = fr_scene_count(document, &session->context, &stands);
    }
    char *title = fr_document_title(document);
    char *name = g_utf8_make_valid(fr_document_name(document), -1);
    json_t *info = json_pack(
        "{s:s, s:s?, s:o, s:o, s:o, s:I}", "document", name, "title", title, "plants", plants,
        "materials", names_json(fr_document_materials(document), material_name), "views",
        names_json(fr_document_views(document), view_name), "places", (json_int_t)stands);
    if (status == FR_OK) {
        json_dumpf(info, stdout, JSON_INDENT(2));
        printf("\n");
    }
    json_decref(info);
    g_free(title);
    g_free(name);
    return status;
}

/// False after a message if no plant has the component that --paths names.
static bool check_paths(const CliOptions *options, const FrDocument *document) {
    const GPtrArray *plants = fr_document_plants(document);
    GPtrArray *names = g_ptr_array_new();
    bool is_known = options->paths == NULL;
    for (guint i = 0; i < plants->len && !is_known; i++) {
        const FrPlantDef *plant = g_ptr_array_index(plants, i);
        const FrPgraph *graph = plant->pgraph;
        // What branches other plants have is known once they are grown.
        is_known = plant->kind == FR_PLANT_LSYSTEM || plant->kind == FR_PLANT_SKELETON ||
                   plant->kind == FR_PLANT_RAMIFIED ||
                   fr_pgraph_find(graph, options->paths) != FR_NONE;
        for (uint32_t c = 0; c < fr_pgraph_count(graph); c++) {
            g_ptr_array_add(names, (char *)fr_pgraph_id(graph, c));
        }
    }
    if (!is_known) {
        char *hint = cli_hint(options->paths, (const char *const *)names->pdata, names->len);
        cli_message("there is no component '%s' in the document%s", options->paths, hint);
        g_free(hint);
    }
    g_ptr_array_unref(names);
    return is_known;
}

FrStatus cli_info(CliSession *session) {
    const CliOptions *options = session->options;
    const char *path = g_ptr_array_index(options->files, 0);
    if (options->only->len > 0 && (options->paths != NULL || cli_is_model(path))) {
        cli_message(options->paths != NULL
                        ? "--paths and --only do not go together"
                        : "--only names what grows in a document, not in a model");
        return FR_ERR_USAGE;
    }
    if (cli_is_model(path)) {
        return cli_model_info(session, path);
    }
    FrDocument *document;
    FrStatus status = cli_session_read(session, path, &document);
    if (status == FR_OK && !check_paths(options, document)) {
        status = FR_ERR_USAGE;
    }
    if (status == FR_OK && options->only->len > 0) {
        status = cli_standing_info(session, document);
    } else if (status == FR_OK) {
        status = options->is_json ? describe_as_json(session, document)
                                  : describe_as_text(session, document);
    }
    fr_document_free(document);
    return status;
}
