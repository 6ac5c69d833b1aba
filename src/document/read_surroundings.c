/// What stands and shines around plants: `<obstacle>`, `<terrain>`, `<lamp>`, `<sun>` and `<light>`
/// of a scene.
#include "document/reader.h"
#include "frond/daylight.h"

#include <math.h>

/// Of the choices of <light estimator>.
enum { ESTIMATE_NEAREST = 1 };

/// Names that `--set` may call lamps and obstacles by, in the order of the document; none is as
/// good.
static void check_names(FrReader *reader, uint32_t scene) {
    GHashTable *names = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, NULL);
    const FrXmlTree *tree = reader->tree;
    for (uint32_t node = tree->nodes[scene].first; node != FR_NONE; node = tree->nodes[node].next) {
        bool is_named = tree->nodes[node].kind == FR_XML_ELEMENT &&
                        (fr_xml_equals(tree, tree->nodes[node].name, "lamp") ||
                         fr_xml_equals(tree, tree->nodes[node].name, "obstacle"));
        const FrXmlAttribute *id = is_named ? fr_xml_attribute(tree, node, "id") : NULL;
        bool is_empty = id == NULL || id->value.begin == id->value.end;
        char *name = is_empty ? NULL : fr_read_id(reader, node);
        if (name != NULL && g_hash_table_contains(names, name)) {
            fr_read_error(reader, "duplicate-id", id->value,
                          "there is a lamp or an obstacle '%s' already", name);
        }
        if (name != NULL) {
            g_hash_table_add(names, name);
        }
    }
    g_hash_table_unref(names);
}

/// Pictures that the file's own materials name must be there where these materials are used.
static FrStatus check_pictures(const FrObstacle *obstacle, const FrContext *context) {
    FrStatus status = FR_OK;
    bool are_used = obstacle->mesh != NULL && obstacle->made_of == NULL;
    for (uint32_t i = 0; are_used && i < obstacle->mesh->part_count && status == FR_OK; i++) {
        FrMaterial *material = obstacle->mesh->parts[i].material;
        const char *type;
        if (material != NULL && fr_material_has(material, FR_MAP_COLOUR)) {
            GBytes *file = fr_material_image_file(material, FR_MAP_COLOUR, context, &type, &status);
            g_clear_pointer(&file, g_bytes_unref);
        }
    }
    return status;
}

static void read_obstacle_mesh(FrReader *reader, uint32_t node, FrObstacle *obstacle) {
    if (obstacle->file == NULL) {
        fr_read_error(reader, "missing-attribute", reader->tree->nodes[node].name,
                      "an <obstacle> with shape='mesh' needs a 'file'");
        return;
    }
    FrStatus status = FR_OK;
    FrSpan span = fr_xml_span(reader->tree, fr_read_value_place(reader, node, "file"));
    obstacle->mesh =
        fr_mesh_file_load(reader->document->folder, obstacle->file, span, reader->context, &status);
    if (status == FR_OK) {
        status = check_pictures(obstacle, reader->context);
    }
    fr_read_note(reader, status);
}

static void read_obstacle(FrReader *reader, uint32_t node) {
    fr_read_check_children(reader, node, FR_ELEMENT_OBSTACLE);
    FrObstacle *obstacle = g_new0(FrObstacle, 1);
    fr_params_init(fr_obstacle_table(), obstacle);
    obstacle->span = fr_xml_span(reader->tree, reader->tree->nodes[node].name);
    fr_read_attributes(reader, node, FR_ELEMENT_OBSTACLE, obstacle);
    obstacle->made_of = fr_read_material(reader, node, "material", obstacle->material);
    if (obstacle->shape == FR_OBSTACLE_MESH) {
        read_obstacle_mesh(reader, node, obstacle);
    }
    if (obstacle->shape == FR_OBSTACLE_SWEEP) {
        obstacle->along = fr_read_line(reader, node);
    } else {
        fr_read_check_no_line(reader, node, "only an <obstacle> with shape='sweep' has a text");
    }
    g_ptr_array_add(reader->document->surroundings.obstacles, obstacle);
}

static void read_terrain(FrReader *reader, uint32_t node) {
    fr_read_check_children(reader, node, FR_ELEMENT_TERRAIN);
    FrTerrain *terrain = g_new0(FrTerrain, 1);
    fr_params_init(fr_terrain_table(), terrain);
    terrain->span = fr_xml_span(reader->tree, reader->tree->nodes[node].name);
    fr_read_attributes(reader, node, FR_ELEMENT_TERRAIN, terrain);
    terrain->made_of = fr_read_material(reader, node, "material", terrain->material);
    reader->document->surroundings.terrain = terrain;
    FrSpan span = fr_xml_span(reader->tree, fr_read_value_place(reader, node, "file"));
    FrStatus status = FR_OK;
    char *path = fr_read_path(reader, node, "file", terrain->file);
    if (path != NULL && g_str_has_suffix(path, ".png")) {
        terrain->heights = fr_height_map_load(path, span, reader->context, &status);
    } else if (path != NULL) {
        terrain->mesh = fr_mesh_file_load(reader->document->folder, terrain->file, span,
                                          reader->context, &status);
    }
    fr_read_note(reader, status);
    g_free(path);
}

static void read_lamp(FrReader *reader, uint32_t node) {
    fr_read_check_children(reader, node, FR_ELEMENT_LAMP);
    FrLampParams *lamp = g_new0(FrLampParams, 1);
    fr_params_init(fr_lamp_table(), lamp);
    lamp->span = fr_xml_span(reader->tree, reader->tree->nodes[node].name);
    fr_read_attributes(reader, node, FR_ELEMENT_LAMP, lamp);
    vec3s d = lamp->direction;
    if (d.x == 0 && d.y == 0 && d.z == 0) {
        fr_read_error(reader, "no-direction", fr_read_value_place(reader, node, "direction"),
                      "this lamp shines in no direction");
    }
    g_ptr_array_add(reader->document->surroundings.lamps, lamp);
}

/// Year, month and day of a text; false if it is no date of the years that the sun is known for.
static bool parse_date(const char *text, int date[3]) {
    char **parts = g_strsplit(text == NULL ? "" : text, "-", 4);
    guint64 numbers[3] = {0, 0, 0};
    bool is_date = g_strv_length(parts) == 3;
    for (int i = 0; i < 3 && is_date; i++) {
        is_date = g_ascii_string_to_unsigned(parts[i], 10, 1, 2100, &numbers[i], NULL);
        date[i] = (int)numbers[i];
    }
    g_strfreev(parts);
    return is_date && date[0] >= 1900 && date[1] <= 12 && date[2] <= 31 &&
           g_date_valid_dmy((GDateDay)date[2], (GDateMonth)date[1], (GDateYear)date[0]);
}

bool fr_sun_where(const FrSunParams *sun, double *azimuth, double *elevation) {
    int date[3];
    if (!parse_date(sun->date, date)) {
        return false;
    }
    FrSunPosition position = fr_light_sun(date[0], date[1], date[2] + (sun->time - sun->zone) / 24,
                                          sun->latitude, sun->longitude);
    *azimuth = position.azimuth;
    *elevation = position.elevation;
    return true;
}

/// The sun's angles follow from the date; whoever gives both is told.
static void read_sun(FrReader *reader, uint32_t node, uint32_t scene) {
    fr_read_check_children(reader, node, FR_ELEMENT_SUN);
    FrSunParams *sun = &reader->document->surroundings.sun;
    fr_read_attributes(reader, node, FR_ELEMENT_SUN, sun);
    static const char *const angles[] = {"sun-azimuth", "sun-elevation"};
    for (size_t i = 0; i < G_N_ELEMENTS(angles); i++) {
        const FrXmlAttribute *given = fr_xml_attribute(reader->tree, scene, angles[i]);
        if (given != NULL) {
            fr_read_error(reader, "two-suns", given->name, "<sun> says where the sun stands");
        }
    }
    FrSceneParams *params = &reader->document->scene;
    if (!fr_sun_where(sun, &params->sun_azimuth, &params->sun_elevation)) {
        fr_read_error(reader, "bad-date", fr_read_value_place(reader, node, "date"),
                      "a date is year-month-day, like 2025-06-21, from 1900 to 2100");
    }
}

static void read_light(FrReader *reader, uint32_t node) {
    fr_read_check_children(reader, node, FR_ELEMENT_LIGHT);
    FrLightParams *light = &reader->document->surroundings.light;
    fr_read_attributes(reader, node, FR_ELEMENT_LIGHT, light);
    light->is_given = true;
    light->span = fr_xml_span(reader->tree, reader->tree->nodes[node].name);
    light->photons_place = fr_xml_span(reader->tree, fr_read_value_place(reader, node, "photons"));
    light->reference_place =
        fr_xml_span(reader->tree, fr_read_value_place(reader, node, "reference"));
    bool is_nearest = light->by == FR_LIGHT_BY_DENSITY && light->estimator == ESTIMATE_NEAREST;
    if (is_nearest && light->neighbours > light->photons) {
        FrSpan place = fr_xml_span(reader->tree, fr_read_value_place(reader, node, "neighbours"));
        fr_diags_add(reader->diags, FR_WARNING, "few-photons", place,
                     "%" G_GINT64_FORMAT " rays are wanted, and there are %" G_GINT64_FORMAT
                     " photons",
                     light->neighbours, light->photons);
    }
}

/// Shadows fall from a sky; whoever hangs up lamps for plants that see only those is told.
static void warn_of_lamps(FrReader *reader) {
    const FrSurroundings *surroundings = &reader->document->surroundings;
    for (guint i = 0; i < surroundings->lamps->len; i++) {
        const FrLampParams *lamp = g_ptr_array_index(surroundings->lamps, i);
        if (surroundings->light.by == FR_LIGHT_BY_SHADOWS && lamp->power > 0) {
            fr_diags_add(reader->diags, FR_WARNING, "unseen-lamp", lamp->span,
                         "plants that sense light by shadows do not see lamps; views and density "
                         "do");
        }
    }
}

void fr_read_surroundings(FrReader *reader, uint32_t scene) {
    check_names(reader, scene);
    for (uint32_t node = fr_read_first(reader, scene, FR_ELEMENT_OBSTACLE); node != FR_NONE;
         node = fr_read_next(reader, node, FR_ELEMENT_OBSTACLE)) {
        read_obstacle(reader, node);
    }
    uint32_t terrain = fr_read_first(reader, scene, FR_ELEMENT_TERRAIN);
    if (terrain != FR_NONE) {
        read_terrain(reader, terrain);
    }
    for (uint32_t node = fr_read_first(reader, scene, FR_ELEMENT_LAMP); node != FR_NONE;
         node = fr_read_next(reader, node, FR_ELEMENT_LAMP)) {
        read_lamp(reader, node);
    }
    uint32_t sun = fr_read_first(reader, scene, FR_ELEMENT_SUN);
    if (sun != FR_NONE) {
        read_sun(reader, sun, scene);
    }
    uint32_t light = fr_read_first(reader, scene, FR_ELEMENT_LIGHT);
    if (light != FR_NONE) {
        read_light(reader, light);
        warn_of_lamps(reader);
    }
}

static void free_obstacle(void *obstacle) {
    fr_mesh_file_unref(((FrObstacle *)obstacle)->mesh);
    fr_stroke_unref(((FrObstacle *)obstacle)->along);
    fr_params_clear(fr_obstacle_table(), obstacle);
    g_free(obstacle);
}

static void free_terrain(FrTerrain *terrain) {
    if (terrain != NULL) {
        fr_mesh_file_unref(terrain->mesh);
        fr_height_map_free(terrain->heights);
        fr_params_clear(fr_terrain_table(), terrain);
        g_free(terrain);
    }
}

static void free_lamp(void *lamp) {
    fr_params_clear(fr_lamp_table(), lamp);
    g_free(lamp);
}

void fr_surroundings_init(FrSurroundings *surroundings) {
    *surroundings = (FrSurroundings){.obstacles = g_ptr_array_new_with_free_func(free_obstacle),
                                     .lamps = g_ptr_array_new_with_free_func(free_lamp)};
    fr_params_init(fr_sun_table(), &surroundings->sun);
    fr_params_init(fr_light_table(), &surroundings->light);
}

void fr_surroundings_clear(FrSurroundings *surroundings) {
    g_ptr_array_unref(surroundings->obstacles);
    g_ptr_array_unref(surroundings->lamps);
    free_terrain(surroundings->terrain);
    fr_params_clear(fr_sun_table(), &surroundings->sun);
    fr_params_clear(fr_light_table(), &surroundings->light);
}
