#include "studio/model/standing.h"

#include "studio/model/place.h"
#include "studio/model/scene_edit.h"
#include "studio/model/values.h"

#include <math.h>
#include <string.h>

// Which attributes of a tag are what a handle changes; NULL: none.
typedef struct Kind {
    const char *tag, *turn, *sizes[2]; ///< sizes: a vector or up to two numbers
    bool is_on_ground, is_line;
} Kind;

static const Kind kinds[] = {
    {"place", "turn", {"scale"}, true, false},
    {"strew", "aside", {"width", "depth"}, true, false},
    {"row", NULL, {NULL}, true, true},
    {"obstacle", "turn", {"size"}, false, false},
    {"terrain", "turn", {"size"}, false, false},
    {"particles", NULL, {"size"}, false, false},
};

static const Kind *kind_of(const FrContentsElement *element) {
    for (size_t i = 0; i < G_N_ELEMENTS(kinds); i++) {
        if (strcmp(kinds[i].tag, element->name) == 0) {
            return &kinds[i];
        }
    }
    return NULL;
}

static const FrParam *row_of(const FrContentsElement *element, const char *attribute) {
    return element->table == NULL ? NULL : fr_params_find(element->table, attribute);
}

// What an attribute says, or its default. Free with g_free().
static char *text_of(const FrContents *contents, uint32_t element, const char *attribute) {
    char *text = fr_contents_get(contents, element, attribute);
    const FrParam *row = row_of(fr_contents_at(contents, element), attribute);
    return text != NULL ? text : row != NULL ? g_strdup(row->default_text) : NULL;
}

static bool read_number(const FrContents *contents, uint32_t element, const char *attribute,
                        double *value) {
    char *text = text_of(contents, element, attribute);
    bool is_number = text != NULL && studio_value_is_number(text, value);
    g_free(text);
    return is_number;
}

static bool read_vector(const FrContents *contents, uint32_t element, const char *attribute,
                        double vector[3]) {
    char *text = text_of(contents, element, attribute);
    char **parts = g_strsplit(text == NULL ? "" : text, ",", 4);
    bool is_vector = g_strv_length(parts) == 3;
    for (int k = 0; is_vector && k < 3; k++) {
        is_vector = studio_value_is_number(parts[k], &vector[k]);
    }
    g_strfreev(parts);
    g_free(text);
    return is_vector;
}

// The points (double[3]) of a line; NULL if it is none.
static GArray *read_line(const FrContents *contents, uint32_t element) {
    char *text = fr_contents_text(contents, element, NULL);
    GArray *points = g_array_new(FALSE, FALSE, 3 * sizeof(double));
    const char *at = text;
    bool is_right = text != NULL;
    while (is_right) {
        double point[3];
        while (g_ascii_isspace(*at)) {
            at++;
        }
        if (*at == '\0') {
            break;
        }
        for (int k = 0; k < 3 && is_right; k++) {
            char *end;
            point[k] = g_ascii_strtod(at, &end);
            is_right = end != at && (k == 2 || *end == ',') && isfinite(point[k]);
            at = end + (k < 2 && is_right);
        }
        if (is_right) {
            g_array_append_val(points, point);
        }
    }
    g_free(text);
    if (!is_right || points->len == 0) {
        g_clear_pointer(&points, g_array_unref);
    }
    return points;
}

static bool read_middle(const FrContents *contents, uint32_t element, double at[3]) {
    GArray *points = read_line(contents, element);
    at[0] = at[1] = at[2] = 0;
    for (guint i = 0; points != NULL && i < points->len; i++) {
        for (int k = 0; k < 3; k++) {
            at[k] += g_array_index(points, double, 3 * i + (guint)k) / points->len;
        }
    }
    bool is_line = points != NULL;
    g_clear_pointer(&points, g_array_unref);
    return is_line;
}

// A species grows upright and of its own size.
static bool is_rigid(const StudioDocument *document, uint32_t element) {
    const FrContents *contents = studio_document_contents(document);
    char *plant = fr_contents_get(contents, element, "plant");
    bool is_species =
        plant != NULL && studio_scene_is_species(document, fr_contents_find(contents, 0, plant));
    g_free(plant);
    return is_species;
}

bool studio_standing_read(const StudioDocument *document, uint32_t element,
                          StudioStanding *standing) {
    const FrContents *contents = studio_document_contents(document);
    if (contents == NULL || element == FR_NONE || element >= fr_contents_count(contents)) {
        return false;
    }
    const Kind *kind = kind_of(fr_contents_at(contents, element));
    *standing = (StudioStanding){.scale = 1};
    if (kind == NULL || !(kind->is_line ? read_middle(contents, element, standing->at)
                                        : read_vector(contents, element, "at", standing->at))) {
        return false;
    }
    bool can_change = !is_rigid(document, element);
    bool is_place = strcmp(kind->tag, "place") == 0;
    double size[3];
    standing->is_on_ground = kind->is_on_ground;
    standing->can_turn = can_change && kind->turn != NULL &&
                         read_number(contents, element, kind->turn, &standing->turn);
    standing->can_scale =
        can_change && kind->sizes[0] != NULL &&
        (is_place                 ? read_number(contents, element, "scale", &standing->scale)
         : kind->sizes[1] != NULL ? read_number(contents, element, kind->sizes[0], &size[0])
                                  : read_vector(contents, element, kind->sizes[0], size));
    return true;
}

static void add(GArray *splices, const FrContents *contents, uint32_t element,
                const char *attribute, char *text) {
    const FrParam *row = row_of(fr_contents_at(contents, element), attribute);
    bool is_default = row != NULL && strcmp(row->default_text, text) == 0;
    FrSplice splice = fr_contents_set(contents, element, attribute, is_default ? NULL : text);
    g_array_append_val(splices, splice);
    g_free(text);
}

static void move_line(GArray *splices, const FrContents *contents, uint32_t element,
                      const double by[3]) {
    GArray *points = read_line(contents, element);
    GString *text = g_string_new(NULL);
    for (guint i = 0; i < points->len; i++) {
        for (guint k = 0; k < 3; k++) {
            char *number = studio_value_text(g_array_index(points, double, 3 * i + k) + by[k], 1);
            g_string_append_printf(text, "%s%s", k > 0 ? "," : i > 0 ? " " : "", number);
            g_free(number);
        }
    }
    FrSplice splice = fr_contents_set_text(contents, element, text->str);
    g_array_append_val(splices, splice);
    g_string_free(text, TRUE);
    g_array_unref(points);
}

static void scale_sizes(GArray *splices, const FrContents *contents, uint32_t element,
                        const Kind *kind, double factor) {
    double size[3];
    if (kind->sizes[1] == NULL && read_vector(contents, element, kind->sizes[0], size)) {
        for (int k = 0; k < 3; k++) {
            size[k] = fmax(size[k] * factor, 0.001);
        }
        add(splices, contents, element, kind->sizes[0], studio_vector_text(size, 0.1));
    }
    for (int i = 0; kind->sizes[1] != NULL && i < 2; i++) {
        if (read_number(contents, element, kind->sizes[i], &size[i])) {
            add(splices, contents, element, kind->sizes[i],
                studio_value_text(fmax(size[i] * factor, 0.001), 0.1));
        }
    }
}

// Whether two elements are equal in their text and in where they stand, and one is not seen.
static bool are_twins(const FrContents *contents, uint32_t a, uint32_t b) {
    static const char *const shared[] = {"shape", "at", "turn"};
    char *lines[2] = {fr_contents_text(contents, a, NULL), fr_contents_text(contents, b, NULL)};
    bool are_equal = lines[0] != NULL && g_strcmp0(lines[0], lines[1]) == 0;
    for (size_t i = 0; are_equal && i < G_N_ELEMENTS(shared); i++) {
        char *one = text_of(contents, a, shared[i]), *other = text_of(contents, b, shared[i]);
        are_equal = g_strcmp0(one, other) == 0;
        g_free(one);
        g_free(other);
    }
    char *seen[2] = {text_of(contents, a, "visible"), text_of(contents, b, "visible")};
    are_equal = are_equal && g_strcmp0(seen[0], seen[1]) != 0;
    for (int k = 0; k < 2; k++) {
        g_free(seen[k]);
        g_free(lines[k]);
    }
    return are_equal;
}

uint32_t studio_standing_twin(const StudioDocument *document, uint32_t element) {
    const FrContents *contents = studio_document_contents(document);
    const FrContentsElement *at = fr_contents_at(contents, element);
    char *shape = strcmp(at->name, "obstacle") == 0 ? text_of(contents, element, "shape") : NULL;
    uint32_t twin = g_strcmp0(shape, "sweep") == 0
                        ? fr_contents_child(contents, at->parent, "obstacle")
                        : FR_NONE;
    while (twin != FR_NONE && (twin == element || !are_twins(contents, element, twin))) {
        twin = fr_contents_sibling(contents, twin);
    }
    g_free(shape);
    return twin;
}

// What moves an element by a drag, as splices.
static void add_moves(GArray *splices, const FrContents *contents, uint32_t element,
                      const StudioStanding *now, const StudioStanding *from,
                      const StudioStanding *to) {
    const Kind *kind = kind_of(fr_contents_at(contents, element));
    const double by[3] = {to->at[0] - from->at[0], to->at[1] - from->at[1],
                          to->at[2] - from->at[2]};
    bool is_moved = by[0] != 0 || by[1] != 0 || by[2] != 0;
    if (is_moved && kind->is_line) {
        move_line(splices, contents, element, by);
    } else if (is_moved) {
        add(splices, contents, element, "at", studio_vector_text(to->at, 0.1));
    }
    if (now->can_turn && to->turn != from->turn) {
        add(splices, contents, element, kind->turn,
            studio_value_text(remainder(to->turn, 360), 100));
    }
    if (now->can_scale && to->scale != from->scale) {
        if (strcmp(kind->tag, "place") == 0) {
            add(splices, contents, element, "scale",
                studio_value_text(CLAMP(to->scale, 0.001, 1000), 1));
        } else {
            scale_sizes(splices, contents, element, kind, to->scale / from->scale);
        }
    }
}

bool studio_standing_move(StudioDocument *document, uint32_t element, const StudioStanding *from,
                          const StudioStanding *to, const char *key) {
    StudioStanding now;
    if (!studio_standing_read(document, element, &now)) {
        return false;
    }
    const FrContents *contents = studio_document_contents(document);
    uint32_t twin = studio_standing_twin(document, element);
    GArray *splices = g_array_new(FALSE, FALSE, sizeof(FrSplice));
    add_moves(splices, contents, element, &now, from, to);
    if (twin != FR_NONE) {
        add_moves(splices, contents, twin, &now, from, to);
    }
    bool is_moved = memcmp(to->at, from->at, sizeof to->at) != 0;
    const char *name = is_moved                 ? "Move %s"
                       : to->turn != from->turn ? "Turn %s"
                                                : "Change the size of %s";
    char *step = g_strdup_printf(name, fr_contents_at(contents, element)->name);
    bool is_changed = studio_document_splice(document, splices, step, key);
    g_free(step);
    g_array_unref(splices);
    return is_changed;
}
