/// Plants taken out of a scene by the names of what has placed them.
#include "frond/only.h"

#include "scene/grow.h"
#include "scene/placing.h"

#include <string.h>

enum { LISTED_NAMES = 12 };

struct FrOnly {
    GHashTable *stands; ///< gint64: see key_of()
};

static gint64 key_of(uint32_t origin, uint32_t number) {
    return (gint64)origin << 32 | number;
}

static FrOnly *new_only(void) {
    FrOnly *only = g_new0(FrOnly, 1);
    only->stands = g_hash_table_new_full(g_int64_hash, g_int64_equal, g_free, NULL);
    return only;
}

static void add(FrOnly *only, uint32_t origin, uint32_t number) {
    gint64 key = key_of(origin, number);
    g_hash_table_add(only->stands, g_memdup2(&key, sizeof key));
}

FrOnly *fr_only_one(uint32_t origin, uint32_t number) {
    FrOnly *only = new_only();
    add(only, origin, number);
    return only;
}

void fr_only_free(FrOnly *only) {
    if (only != NULL) {
        g_hash_table_unref(only->stands);
        g_free(only);
    }
}

// ---- names ------------------------------------------------------------------------------------

/// What places plants, by the byte where it begins: char *, "row-2".
static void name_element(GHashTable *elements, const char *kind, guint index, guint count,
                         FrSpan span) {
    char *name = count == 1 ? g_strdup(kind) : g_strdup_printf("%s-%u", kind, index + 1);
    g_hash_table_insert(elements, GUINT_TO_POINTER(fr_span_outermost(span).begin), name);
}

static GHashTable *name_elements(const FrDocument *document) {
    GHashTable *elements = g_hash_table_new_full(NULL, NULL, NULL, g_free);
    const GPtrArray *places = fr_document_places(document);
    const GPtrArray *rows = fr_document_rows(document);
    const GPtrArray *strews = fr_document_strews(document);
    for (guint i = 0; i < places->len; i++) {
        const FrPlace *place = g_ptr_array_index(places, i);
        name_element(elements, "place", i, places->len, place->span);
    }
    for (guint i = 0; i < rows->len; i++) {
        name_element(elements, "row", i, rows->len, ((FrRow *)g_ptr_array_index(rows, i))->span);
    }
    for (guint i = 0; i < strews->len; i++) {
        const FrStrew *strew = g_ptr_array_index(strews, i);
        name_element(elements, "strew", i, strews->len, strew->span);
    }
    return elements;
}

/// The names that a stand answers to: its plant's, that of what has placed it, and among others of
/// a row or an area its own. Free with g_strfreev().
static char **names_of(GHashTable *elements, const char *plant, const FrStand *stand) {
    const char *element = g_hash_table_lookup(elements, GUINT_TO_POINTER(stand->origin));
    char **names = g_new0(char *, 4);
    names[0] = g_strdup(plant);
    names[1] = g_strdup(element);
    if (element != NULL && !g_str_has_prefix(element, "place")) {
        names[2] = g_strdup_printf("%s.%u", element, stand->number);
    }
    return names;
}

/// A name that is listed: of a plant or of an element, with the numbers of those that it stands
/// for.
typedef struct Listed {
    char *name;
    GString *ranges;      ///< that are full: "row.0 to row.3"
    uint32_t first, last; ///< of the range that is not
    uint32_t range_count; ///< with that
    bool is_numbered;
} Listed;

static void clear_listed(void *data) {
    Listed *listed = data;
    g_free(listed->name);
    g_string_free(listed->ranges, TRUE);
}

/// Ends a range; those that are too many are left out.
static void end_range(Listed *listed) {
    if (listed->range_count > LISTED_NAMES) {
        return;
    }
    g_string_append_printf(listed->ranges, "%s%s.%u", listed->range_count > 1 ? ", " : "",
                           listed->name, listed->first);
    if (listed->last > listed->first) {
        g_string_append_printf(listed->ranges, " to %s.%u", listed->name, listed->last);
    }
    if (listed->range_count == LISTED_NAMES) {
        g_string_append(listed->ranges, ", …");
    }
}

/// `known` tells where in the list a name is, and 1.
static void list_name(GArray *listed, GHashTable *known, const char *name, const FrStand *stand,
                      bool is_numbered) {
    guint found = GPOINTER_TO_UINT(g_hash_table_lookup(known, name));
    uint32_t number = stand->number;
    if (found == 0) {
        Listed made = {g_strdup(name), g_string_new(NULL), number, number, 1, is_numbered};
        g_array_append_val(listed, made);
        g_hash_table_insert(known, made.name, GUINT_TO_POINTER(listed->len));
        return;
    }
    Listed *at = &g_array_index(listed, Listed, found - 1);
    if (at->is_numbered && (number < at->first || number > at->last + 1)) {
        end_range(at);
        at->range_count++;
        at->first = number;
    }
    at->last = number;
}

/// "oak, place-1, row.0 to row.8"
static char *list_all(const GArray *listed) {
    GString *text = g_string_new(listed->len == 0 ? "none" : NULL);
    for (guint i = 0; i < listed->len && i < LISTED_NAMES; i++) {
        Listed *at = &g_array_index(listed, Listed, i);
        if (at->is_numbered) {
            end_range(at);
        }
        g_string_append(text, i == 0 ? "" : ", ");
        g_string_append(text, at->is_numbered ? at->ranges->str : at->name);
    }
    g_string_append(text, listed->len > LISTED_NAMES ? ", …" : "");
    return g_string_free(text, FALSE);
}

static void report_unknown(const char *name, const GArray *listed, FrDiags *diags) {
    GPtrArray *names = g_ptr_array_new();
    for (guint i = 0; i < listed->len; i++) {
        g_ptr_array_add(names, g_array_index(listed, Listed, i).name);
    }
    const char *near = fr_nearest_name(name, (const char *const *)names->pdata, names->len);
    char *all = list_all(listed);
    if (near != NULL) {
        fr_diags_add(diags, FR_ERROR, "unknown-stand", (FrSpan){0},
                     "nothing stands in the scene as '%.64s'; did you mean '%s'? There are: %s",
                     name, near, all);
    } else {
        fr_diags_add(diags, FR_ERROR, "unknown-stand", (FrSpan){0},
                     "nothing stands in the scene as '%.64s'; there are: %s", name, all);
    }
    g_free(all);
    g_ptr_array_unref(names);
}

/// Adds all stands of which one of the names is meant; `is_met` tells which names have been.
static void match(FrOnly *only, const GArray *placed, GHashTable *elements,
                  const char *const *names, size_t count, bool *is_met) {
    for (guint i = 0; i < placed->len; i++) {
        const FrPlaced *one = &g_array_index(placed, FrPlaced, i);
        char **own = names_of(elements, one->plant->id, &one->stand);
        for (size_t k = 0; k < count; k++) {
            if (g_strv_contains((const char *const *)own, names[k])) {
                add(only, one->stand.origin, one->stand.number);
                is_met[k] = true;
            }
        }
        g_strfreev(own);
    }
}

static GArray *list_names(const GArray *placed, GHashTable *elements) {
    GArray *listed = g_array_new(FALSE, FALSE, sizeof(Listed));
    g_array_set_clear_func(listed, clear_listed);
    GHashTable *known = g_hash_table_new(g_str_hash, g_str_equal);
    for (guint i = 0; i < placed->len; i++) {
        const FrPlaced *one = &g_array_index(placed, FrPlaced, i);
        list_name(listed, known, one->plant->id, &one->stand, false);
    }
    for (guint i = 0; i < placed->len; i++) {
        const FrPlaced *one = &g_array_index(placed, FrPlaced, i);
        char **own = names_of(elements, one->plant->id, &one->stand);
        if (own[1] != NULL) {
            list_name(listed, known, own[1], &one->stand, own[2] != NULL);
        }
        g_strfreev(own);
    }
    g_hash_table_unref(known);
    return listed;
}

/// Without places the first plant stands alone, and nothing has placed it.
static void place_first(const FrDocument *document, GArray *placed) {
    const GPtrArray *plants = fr_document_plants(document);
    guint elements = fr_document_places(document)->len + fr_document_rows(document)->len +
                     fr_document_strews(document)->len;
    if (elements == 0 && plants->len > 0) {
        FrPlaced first = {.plant = g_ptr_array_index(plants, 0)};
        g_array_append_val(placed, first);
    }
}

/// All that is to stand; warnings come when it is built.
static FrStatus find_placed(const FrDocument *document, const FrContext *context, GArray **placed) {
    FrContext inner = *context;
    inner.diags = fr_diags_new();
    FrStatus status = fr_scene_places(document, NULL, &inner, placed);
    for (size_t i = 0; status != FR_OK && i < fr_diags_count(inner.diags); i++) {
        const FrDiag *diag = fr_diags_get(inner.diags, i);
        fr_diags_add(context->diags, diag->severity, diag->code, diag->span, "%s", diag->text);
    }
    fr_diags_free(inner.diags);
    if (status == FR_OK) {
        place_first(document, *placed);
    }
    return status;
}

FrStatus fr_only_new(const FrDocument *document, const char *const *names, size_t count,
                     const FrContext *context, FrOnly **only) {
    *only = NULL;
    GArray *placed;
    FrStatus status = find_placed(document, context, &placed);
    if (status != FR_OK) {
        return status;
    }
    FrOnly *made = new_only();
    GHashTable *elements = name_elements(document);
    bool *is_met = g_new0(bool, count + 1);
    match(made, placed, elements, names, count, is_met);
    GArray *listed = NULL;
    for (size_t k = 0; k < count && status == FR_OK; k++) {
        if (!is_met[k]) {
            listed = list_names(placed, elements);
            report_unknown(names[k], listed, context->diags);
            status = FR_ERR_USAGE;
        }
    }
    g_clear_pointer(&listed, g_array_unref);
    g_free(is_met);
    g_hash_table_unref(elements);
    g_array_unref(placed);
    if (status != FR_OK) {
        g_clear_pointer(&made, fr_only_free);
    }
    *only = made;
    return status;
}

// ---- the scene --------------------------------------------------------------------------------

/// Keeps stands, in their order. Returns how many there are.
static guint keep_stands(const FrOnly *only, FrScene *scene) {
    guint kept = 0, count = fr_scene_stand_count(scene);
    FrStand *stands = (FrStand *)(void *)scene->stands->data;
    for (guint i = 0; i < count; i++) {
        gint64 key = key_of(stands[i].origin, stands[i].number);
        if (!stands[i].is_waiting && g_hash_table_contains(only->stands, &key)) {
            stands[kept++] = stands[i];
        }
    }
    if (kept > 0) {
        g_array_set_size(scene->stands, kept);
    }
    return kept;
}

/// Frees the plants that stand nowhere.
static void drop_plants(FrScene *scene) {
    FrStand *stands = (FrStand *)(void *)scene->stands->data;
    FrScenePlant *plants = (FrScenePlant *)(void *)scene->plants->data;
    uint32_t *place = g_new0(uint32_t, scene->plants->len + 1); // where each goes, and 1
    for (guint i = 0; i < scene->stands->len; i++) {
        place[stands[i].plant] = 1;
    }
    guint kept = 0;
    for (guint i = 0; i < scene->plants->len; i++) {
        if (place[i] != 0) {
            FrScenePlant other = plants[kept];
            plants[kept] = plants[i];
            plants[i] = other;
            place[i] = ++kept;
        }
    }
    for (guint i = 0; i < scene->stands->len; i++) {
        stands[i].plant = place[stands[i].plant] - 1;
    }
    g_array_set_size(scene->plants, kept);
    g_free(place);
}

bool fr_only_apply(const FrOnly *only, FrScene *scene, bool in_place) {
    guint kept = keep_stands(only, scene);
    if (kept == 0) {
        return false;
    }
    scene->obstacles = 0;
    drop_plants(scene);
    FrStand *stands = (FrStand *)(void *)scene->stands->data;
    double foot[3];
    memcpy(foot, stands[0].at, sizeof foot);
    for (guint i = 0; i < kept && !in_place; i++) {
        for (int k = 0; k < 3; k++) {
            stands[i].at[k] -= foot[k];
        }
    }
    return true;
}

// ---- copies -----------------------------------------------------------------------------------

/// The columns that a plant of a scene has for its components, on their own.
static void own_columns(FrScenePlant *plant) {
    guint components = plant->plant->components->len;
    plant->by_component = g_memdup2(plant->by_component, components * sizeof *plant->by_component);
    plant->seconds = g_memdup2(plant->seconds, components * sizeof *plant->seconds);
}

FrScene *fr_only_copy(const FrOnly *only, const FrScene *scene, bool in_place) {
    FrScene *copy = g_new(FrScene, 1);
    *copy = *scene;
    copy->plants = g_array_new(FALSE, FALSE, sizeof(FrScenePlant));
    copy->stands = g_array_new(FALSE, FALSE, sizeof(FrStand));
    copy->views = g_ptr_array_new();
    copy->name = g_strdup(scene->name);
    copy->params = NULL;
    copy->surroundings = NULL;
    copy->steps = NULL;
    g_array_append_vals(copy->plants, scene->plants->data, scene->plants->len);
    g_array_append_vals(copy->stands, scene->stands->data, scene->stands->len);
    if (only != NULL && !fr_only_apply(only, copy, in_place)) {
        g_array_set_size(copy->plants, 0); // they are the scene's
        g_clear_pointer(&copy, fr_scene_free);
        return NULL;
    }
    for (guint i = 0; i < copy->plants->len; i++) {
        FrScenePlant *plant = &g_array_index(copy->plants, FrScenePlant, i);
        own_columns(plant);
        plant->nurbs_span = (FrSpan){0}; // places of the document's text
        plant->plant = fr_plant_copy(plant->plant);
    }
    g_array_set_clear_func(copy->plants, fr_scene_plant_clear);
    return copy;
}
