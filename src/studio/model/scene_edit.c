#include "studio/model/scene_edit.h"

#include "studio/model/lamps.h"
#include "studio/model/standing.h"
#include "studio/model/values.h"

#include <math.h>
#include <string.h>

static const double fine = 0.1; // numbers are written to a thousandth of it

static const FrContents *contents_of(const StudioDocument *document) {
    return studio_document_contents(document);
}

static uint32_t scene_of(const StudioDocument *document) {
    const FrContents *contents = contents_of(document);
    return contents == NULL ? FR_NONE : fr_contents_child(contents, 0, "scene");
}

uint32_t studio_scene_last(const StudioDocument *document, const char *tag) {
    uint32_t scene = scene_of(document), last = FR_NONE;
    for (uint32_t i = scene == FR_NONE ? FR_NONE
                                       : fr_contents_child(contents_of(document), scene, tag);
         i != FR_NONE; i = fr_contents_sibling(contents_of(document), i)) {
        last = i;
    }
    return last;
}

bool studio_scene_has_places(const StudioDocument *document) {
    return studio_scene_last(document, "place") != FR_NONE ||
           studio_scene_last(document, "row") != FR_NONE ||
           studio_scene_last(document, "strew") != FR_NONE;
}

bool studio_scene_is_species(const StudioDocument *document, uint32_t plant) {
    return plant != FR_NONE &&
           fr_contents_child(contents_of(document), plant, "species") != FR_NONE;
}

char *studio_file_name(const StudioDocument *document, const char *path) {
    char *folder = g_canonicalize_filename(studio_document_folder(document), NULL);
    char *whole = g_canonicalize_filename(path, studio_document_folder(document));
    size_t length = strlen(folder);
    bool is_inside = strncmp(whole, folder, length) == 0 && whole[length] == G_DIR_SEPARATOR;
    char *name = g_strdup(is_inside ? whole + length + 1 : whole);
    g_free(whole);
    g_free(folder);
    return name;
}

FrSplice studio_scene_insert(const FrContents *contents, uint32_t after, const char *xml) {
    uint32_t scene = fr_contents_child(contents, 0, "scene");
    if (scene != FR_NONE) {
        return fr_contents_insert(contents, scene, after, xml);
    }
    char **lines = g_strsplit(xml, "\n", -1);
    char *inside = g_strjoinv("\n  ", lines);
    char *whole = g_strdup_printf("<scene>\n  %s\n</scene>", inside);
    FrSplice splice = fr_contents_insert(contents, 0, FR_NONE, whole);
    g_free(whole);
    g_free(inside);
    g_strfreev(lines);
    return splice;
}

// Puts elements of a tag into the scene, behind those that it has.
static FrSplice into_scene(const StudioDocument *document, const char *tag, const char *xml) {
    return studio_scene_insert(contents_of(document), studio_scene_last(document, tag), xml);
}

static bool add_to_scene(StudioDocument *document, const char *tag, const char *xml,
                         const char *name, const char *key) {
    return !studio_document_is_broken(document) && contents_of(document) != NULL &&
           studio_document_splice_one(document, into_scene(document, tag, xml), name, key);
}

// ---- plants ------------------------------------------------------------------------------------

static void append_number(GString *xml, const char *name, double value, double usual, double span) {
    char *text = studio_value_text(value, span);
    char *otherwise = studio_value_text(usual, span);
    if (strcmp(text, otherwise) != 0) {
        g_string_append_printf(xml, " %s=\"%s\"", name, text);
    }
    g_free(otherwise);
    g_free(text);
}

static void append_place(GString *xml, const char *plant, const StudioSpot *spot, bool is_species) {
    char *at = studio_vector_text(spot->at, fine);
    char *id = g_markup_escape_text(plant, -1);
    g_string_append_printf(xml, "%s<place plant=\"%s\" at=\"%s\"", xml->len > 0 ? "\n" : "", id,
                           at);
    if (!is_species) {
        append_number(xml, "turn", spot->turn, 0, 100);
        append_number(xml, "scale", spot->scale, 1, 1);
    }
    if (spot->seed >= 0 && !is_species) {
        g_string_append_printf(xml, " seed=\"%" G_GINT64_FORMAT "\"", spot->seed);
    }
    g_string_append(xml, "/>");
    g_free(id);
    g_free(at);
}

char *studio_place_xml(const StudioDocument *document, const char *plant, const StudioSpot *spot) {
    uint32_t element = fr_contents_find(contents_of(document), 0, plant);
    GString *xml = g_string_new(NULL);
    append_place(xml, plant, spot, studio_scene_is_species(document, element));
    return g_string_free(xml, FALSE);
}

// The place of what is shown because nothing is placed.
static void append_first(const StudioDocument *document, GString *xml) {
    static const StudioSpot origin = {{0, 0, 0}, 0, 1, -1};
    uint32_t first = fr_contents_child(contents_of(document), 0, "plant");
    if (!studio_scene_has_places(document) && first != FR_NONE) {
        append_place(xml, fr_contents_at(contents_of(document), first)->id, &origin, true);
    }
}

bool studio_plant(StudioDocument *document, const char *plant, const StudioSpot *spots,
                  size_t count, const char *key) {
    if (count == 0 || contents_of(document) == NULL) {
        return false;
    }
    uint32_t element = fr_contents_find(contents_of(document), 0, plant);
    bool is_species = studio_scene_is_species(document, element);
    GString *xml = g_string_new(NULL);
    append_first(document, xml);
    for (size_t i = 0; i < count; i++) {
        append_place(xml, plant, &spots[i], is_species);
    }
    char *name = g_strdup_printf("Plant %s", plant);
    bool is_changed = add_to_scene(document, "place", xml->str, name, key);
    g_free(name);
    g_string_free(xml, TRUE);
    return is_changed;
}

bool studio_place_first(StudioDocument *document) {
    GString *xml = g_string_new(NULL);
    if (contents_of(document) != NULL) {
        append_first(document, xml);
    }
    bool is_changed = xml->len > 0 && add_to_scene(document, "place", xml->str, "Place it", NULL);
    g_string_free(xml, TRUE);
    return is_changed;
}

uint32_t studio_copy(StudioDocument *document, uint32_t element, const char *key) {
    const FrContents *contents = contents_of(document);
    if (element == FR_NONE || contents == NULL ||
        fr_contents_at(contents, element)->parent != scene_of(document) ||
        fr_contents_at(contents, element)->id != NULL ||
        studio_standing_twin(document, element) != FR_NONE) {
        return FR_NONE;
    }
    const FrContentsElement *at = fr_contents_at(contents, element);
    const char *text = fr_source_text(fr_contents_source(contents), NULL);
    char *xml = g_strndup(text + at->begin, at->end - at->begin);
    FrSplice splice = fr_contents_insert(contents, at->parent, element, xml);
    bool is_changed = studio_document_splice_one(document, splice, "Copy", key);
    g_free(xml);
    return is_changed ? fr_contents_at(contents_of(document), element)->next : FR_NONE;
}

bool studio_take_out(StudioDocument *document, const uint32_t *elements, size_t count,
                     const char *key) {
    GArray *splices = g_array_new(FALSE, FALSE, sizeof(FrSplice));
    for (size_t i = 0; i < count; i++) {
        uint32_t both[2] = {elements[i], studio_standing_twin(document, elements[i])};
        for (int k = 0; k < 2 && both[k] != FR_NONE; k++) {
            FrSplice splice = fr_contents_remove(contents_of(document), both[k]);
            g_array_append_val(splices, splice);
        }
    }
    bool is_changed = count > 0 && studio_document_splice(document, splices, "Take out", key);
    g_array_unref(splices);
    return is_changed;
}

// ---- what they stand among ---------------------------------------------------------------------

bool studio_add_obstacle(StudioDocument *document, const char *shape, const double at[3],
                         const double size[3], const char *file) {
    char *where = studio_vector_text(at, fine), *extent = studio_vector_text(size, fine);
    char *name = file == NULL ? NULL : studio_file_name(document, file);
    char *from = name == NULL ? g_strdup("") : g_markup_printf_escaped(" file=\"%s\"", name);
    char *xml = g_strdup_printf("<obstacle shape=\"%s\"%s at=\"%s\" size=\"%s\"/>", shape, from,
                                where, extent);
    bool is_changed = add_to_scene(document, "obstacle", xml, "Add an obstacle", NULL);
    g_free(xml);
    g_free(from);
    g_free(name);
    g_free(extent);
    g_free(where);
    return is_changed;
}

static char *points_text(const GArray *points) {
    GString *text = g_string_new(NULL);
    for (guint i = 0; i < points->len; i++) {
        const double *at = &g_array_index(points, double, 3 * i);
        for (int k = 0; k < 3; k++) {
            char *number = studio_value_text(at[k], 1);
            g_string_append_printf(text, "%s%s", k > 0 ? "," : i > 0 ? " " : "", number);
            g_free(number);
        }
    }
    return g_string_free(text, FALSE);
}

bool studio_add_road(StudioDocument *document, const GArray *points, double width, double height) {
    static const double thick = 0.05; // of what is seen of it
    if (points->len < 2) {
        return false;
    }
    char *line = points_text(points);
    char *wide = studio_value_text(width, 1), *high = studio_value_text(height, 1);
    char *thin = studio_value_text(thick, 0.1);
    char *xml = g_strdup_printf(
        "<obstacle shape=\"sweep\" section=\"square\" line=\"smooth\" size=\"%s, 1, %s\" "
        "visible=\"no\">%s</obstacle>\n"
        "<obstacle shape=\"sweep\" section=\"square\" line=\"smooth\" size=\"%s, 1, %s\">%s"
        "</obstacle>",
        wide, high, line, wide, thin, line);
    bool is_changed = add_to_scene(document, "obstacle", xml, "Draw a road", NULL);
    g_free(xml);
    g_free(thin);
    g_free(high);
    g_free(wide);
    g_free(line);
    return is_changed;
}

bool studio_set_terrain(StudioDocument *document, const char *file, const double size[3]) {
    const FrContents *contents = contents_of(document);
    uint32_t old = studio_scene_last(document, "terrain");
    if (file == NULL) {
        return old != FR_NONE &&
               studio_document_splice_one(document, fr_contents_remove(contents, old),
                                          "Level the ground", NULL);
    }
    char *name = studio_file_name(document, file);
    bool is_changed;
    if (old != FR_NONE) {
        is_changed = studio_document_splice_one(
            document, fr_contents_set(contents, old, "file", name), "Change the ground", NULL);
    } else {
        char *extent = studio_vector_text(size, fine);
        char *xml = g_markup_printf_escaped("<terrain file=\"%s\" size=\"%s\"/>", name, extent);
        is_changed = add_to_scene(document, "terrain", xml, "Change the ground", NULL);
        g_free(xml);
        g_free(extent);
    }
    g_free(name);
    return is_changed;
}

bool studio_set_envelope(StudioDocument *document, uint32_t plant, const GArray *outline,
                         const char *key) {
    const FrContents *contents = contents_of(document);
    uint32_t species = plant == FR_NONE ? FR_NONE : fr_contents_child(contents, plant, "species");
    if (species == FR_NONE) {
        return false;
    }
    char *points = outline->len == 0 ? NULL : studio_points_write(outline);
    bool is_changed = studio_document_splice_one(
        document, fr_contents_set(contents, species, "envelope", points), "Draw an envelope", key);
    g_free(points);
    return is_changed;
}

// ---- views -------------------------------------------------------------------------------------

uint32_t studio_find_view(const StudioDocument *document, const char *name) {
    const FrContents *contents = contents_of(document);
    uint32_t view = contents == NULL ? FR_NONE : studio_find_in_scene(document, "view");
    for (; view != FR_NONE; view = fr_contents_sibling(contents, view)) {
        char *own = fr_contents_get(contents, view, "name");
        bool is_it = g_strcmp0(own, name) == 0;
        g_free(own);
        if (is_it) {
            break;
        }
    }
    return view;
}

bool studio_save_view(StudioDocument *document, const char *name, const StudioCamera *camera) {
    double eye[3];
    studio_camera_eye(camera, eye);
    char *from = studio_vector_text(eye, fine), *to = studio_vector_text(camera->target, fine);
    char *angle = studio_value_text(camera->field_of_view * 180 / G_PI, 10);
    char *xml = g_markup_printf_escaped(
        "<view name=\"%s\" eye=\"%s\" target=\"%s\" field-of-view=\"%s\"/>", name, from, to, angle);
    uint32_t old = studio_find_view(document, name);
    bool is_changed;
    if (old == FR_NONE) {
        is_changed = add_to_scene(document, "view", xml, "Save a view", NULL);
    } else {
        const FrContentsElement *element = fr_contents_at(contents_of(document), old);
        FrSplice splice = {element->begin, element->end, g_strdup(xml)};
        is_changed = studio_document_splice_one(document, splice, "Save a view", NULL);
    }
    g_free(xml);
    g_free(angle);
    g_free(to);
    g_free(from);
    return is_changed;
}

bool studio_rename_view(StudioDocument *document, const char *name, const char *to) {
    uint32_t view = studio_find_view(document, name);
    if (view == FR_NONE || *to == '\0' || studio_find_view(document, to) != FR_NONE) {
        return false;
    }
    return studio_document_splice_one(
        document, fr_contents_set(contents_of(document), view, "name", to), "Rename a view", NULL);
}

char *studio_free_view(const StudioDocument *document) {
    char *name = NULL;
    for (uint32_t k = 1; name == NULL || studio_find_view(document, name) != FR_NONE; k++) {
        g_free(name);
        name = g_strdup_printf("view %u", k);
    }
    return name;
}
