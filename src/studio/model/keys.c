#include "studio/model/keys.h"

#include "frond/curve.h"
#include "studio/model/place.h"
#include "studio/model/values.h"

#include <math.h>
#include <string.h>

static const double same_age = 0.0015; // ages are written with three digits
static const double age_span = 1;

static const double *point_at(const StudioKeys *keys, guint index) {
    return &g_array_index(keys->points, double, 2 * index);
}

// ---- text --------------------------------------------------------------------------------------

// Where a variance or curves begin.
static size_t length_of_head(const char *text) {
    return strcspn(text, "~|");
}

bool studio_keys_read(const char *text, StudioKeys *keys, double *plain) {
    static const char word[] = "keys ";
    size_t begin = strspn(text, " \t\r\n"), size = length_of_head(text);
    bool has_keys = strncmp(text + begin, word, strlen(word)) == 0;
    begin += has_keys ? strlen(word) : 0;
    char *head = g_strndup(text + begin, size > begin ? size - begin : 0);
    *plain = NAN;
    *keys = (StudioKeys){NULL, NULL};
    if (has_keys) {
        keys->points = studio_points_read(head);
    } else if (studio_value_is_number(head, plain)) {
        keys->points = g_array_new(FALSE, FALSE, 2 * sizeof(double));
    }
    g_free(head);
    if (keys->points != NULL) {
        keys->rest = g_strstrip(g_strdup(text + size));
    }
    return keys->points != NULL;
}

void studio_keys_clear(StudioKeys *keys) {
    g_clear_pointer(&keys->points, g_array_unref);
    g_clear_pointer(&keys->rest, g_free);
}

// As many digits as tell a value from others of its size.
static char *value_text(double value) {
    char text[G_ASCII_DTOSTR_BUF_SIZE];
    return g_strdup(g_ascii_formatd(text, sizeof text, "%.5g", value));
}

char *studio_keys_write(const StudioKeys *keys, double plain) {
    GString *text = g_string_new(NULL);
    for (guint i = 0; i < keys->points->len; i++) {
        char *age = studio_value_text(point_at(keys, i)[0], age_span);
        char *value = value_text(point_at(keys, i)[1]);
        g_string_append_printf(text, "%s%s,%s", i == 0 ? "keys " : " ", age, value);
        g_free(value);
        g_free(age);
    }
    if (keys->points->len == 0) {
        char *value = value_text(plain);
        g_string_append(text, value);
        g_free(value);
    }
    g_string_append_printf(text, "%s%s", *keys->rest == '\0' ? "" : " ", keys->rest);
    return g_string_free(text, FALSE);
}

// ---- keys --------------------------------------------------------------------------------------

double studio_keys_value(const StudioKeys *keys, double age) {
    FrCurve *curve = fr_curve_new(
        FR_CURVE_SMOOTH, (const double(*)[2])(const void *)keys->points->data, keys->points->len);
    double value = curve == NULL ? point_at(keys, 0)[1] : fr_curve_eval(curve, age);
    fr_curve_unref(curve);
    return value;
}

uint32_t studio_keys_find(const StudioKeys *keys, double age) {
    for (guint i = 0; i < keys->points->len; i++) {
        if (fabs(point_at(keys, i)[0] - age) < same_age) {
            return i;
        }
    }
    return FR_NONE;
}

void studio_keys_set(StudioKeys *keys, double age, double value) {
    uint32_t found = studio_keys_find(keys, age);
    if (found != FR_NONE) {
        g_array_index(keys->points, double, 2 * found + 1) = value;
        return;
    }
    guint index = 0;
    while (index < keys->points->len && point_at(keys, index)[0] < age) {
        index++;
    }
    double point[2] = {age, value};
    g_array_insert_vals(keys->points, index, point, 1);
}

// ---- clocks ------------------------------------------------------------------------------------

// The first number of a value; `usual` if it has none.
static double first_number(const FrContents *contents, uint32_t element, const char *attribute,
                           double usual) {
    char *text = fr_contents_get(contents, element, attribute);
    const char *at = text == NULL ? "" : text + (g_str_has_prefix(text, "= ") ? 2 : 0);
    char *end;
    double value = g_ascii_strtod(at, &end);
    bool is_number = end != at && isfinite(value);
    g_free(text);
    return is_number ? value : usual;
}

// The component that a component grows on by the first link to it; FR_NONE.
static uint32_t bearer_of(const FrContents *contents, uint32_t component) {
    uint32_t graph = fr_contents_at(contents, component)->parent;
    const char *id = fr_contents_at(contents, component)->id;
    uint32_t bearer = FR_NONE;
    for (uint32_t link = fr_contents_child(contents, graph, "link");
         link != FR_NONE && bearer == FR_NONE; link = fr_contents_sibling(contents, link)) {
        char *from = fr_contents_get(contents, link, "from");
        char *to = fr_contents_get(contents, link, "to");
        if (g_strcmp0(to, id) == 0 && from != NULL && g_strcmp0(from, id) != 0) {
            bearer = fr_contents_find(contents, graph, from);
        }
        g_free(to);
        g_free(from);
    }
    return bearer;
}

StudioClock studio_clock_of(const StudioDocument *document, uint32_t element) {
    const FrContents *contents = studio_document_contents(document);
    StudioClock clock = {1, 0}; // from the clock of what bears it, downwards
    uint32_t at = element;
    for (uint32_t steps = 0; at != FR_NONE && fr_contents_at(contents, at)->component >= 0 &&
                             steps < fr_contents_count(contents);
         steps++) {
        double birth = first_number(contents, at, "birth", 0);
        double scale = first_number(contents, at, "time-scale", 1);
        clock.offset -= clock.scale * scale * birth;
        clock.scale *= scale;
        at = bearer_of(contents, at);
    }
    uint32_t plant = studio_place_plant(contents, element);
    if (plant != FR_NONE) {
        clock.offset += clock.scale * first_number(contents, plant, "age", 0);
    }
    return clock;
}

double studio_clock_shown(const StudioDocument *document, uint32_t element) {
    const FrContents *contents = studio_document_contents(document);
    uint32_t plant = studio_place_plant(contents, element);
    return plant == FR_NONE ? 0 : first_number(contents, plant, "time", 0);
}

// ---- keys of elements --------------------------------------------------------------------------

bool studio_has_keys(const StudioDocument *document, uint32_t element) {
    return element != FR_NONE &&
           fr_contents_at(studio_document_contents(document), element)->component >= 0;
}

// Reads the keys of a row of a table if it has any.
static bool read_row(const FrContents *contents, uint32_t element, const FrParam *row,
                     StudioKeys *keys) {
    double plain;
    char *attribute = fr_param_attribute(row);
    char *text =
        row->kind == FR_PARAM_NUMBER ? fr_contents_get(contents, element, attribute) : NULL;
    bool has_keys = text != NULL && studio_keys_read(text, keys, &plain);
    if (has_keys && keys->points->len == 0) {
        studio_keys_clear(keys);
        has_keys = false;
    }
    g_free(text);
    g_free(attribute);
    return has_keys;
}

static int compare_ages(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

GArray *studio_key_ages(const StudioDocument *document, uint32_t element) {
    GArray *ages = g_array_new(FALSE, FALSE, sizeof(double));
    const FrContents *contents = studio_document_contents(document);
    const FrParamTable *table =
        studio_has_keys(document, element) ? fr_contents_at(contents, element)->table : NULL;
    for (size_t r = 0; table != NULL && r < table->count; r++) {
        StudioKeys keys;
        if (read_row(contents, element, &table->rows[r], &keys)) {
            for (guint i = 0; i < keys.points->len; i++) {
                g_array_append_val(ages, point_at(&keys, i)[0]);
            }
            studio_keys_clear(&keys);
        }
    }
    g_array_sort(ages, compare_ages);
    for (guint i = ages->len; i-- > 1;) {
        if (g_array_index(ages, double, i) - g_array_index(ages, double, i - 1) < same_age) {
            g_array_remove_index(ages, i);
        }
    }
    return ages;
}

// Splices that write the keys of each row that has one at an age, after `change` of it.
typedef void (*Change)(StudioKeys *keys, guint index, double to);

static GArray *change_rows(const FrContents *contents, uint32_t element, double age, Change change,
                           double to) {
    GArray *splices = g_array_new(FALSE, FALSE, sizeof(FrSplice));
    const FrParamTable *table = fr_contents_at(contents, element)->table;
    for (size_t r = 0; table != NULL && r < table->count; r++) {
        StudioKeys keys;
        if (!read_row(contents, element, &table->rows[r], &keys)) {
            continue;
        }
        uint32_t index = studio_keys_find(&keys, age);
        if (index != FR_NONE) {
            double last = point_at(&keys, index)[1];
            change(&keys, index, to);
            char *attribute = fr_param_attribute(&table->rows[r]);
            char *text = studio_keys_write(&keys, last);
            FrSplice splice = fr_contents_set(contents, element, attribute, text);
            g_array_append_val(splices, splice);
            g_free(text);
            g_free(attribute);
        }
        studio_keys_clear(&keys);
    }
    return splices;
}

static void move_key(StudioKeys *keys, guint index, double to) {
    g_array_index(keys->points, double, 2 * index) = to;
}

static void remove_key(StudioKeys *keys, guint index, double to) {
    (void)to;
    g_array_remove_index(keys->points, index);
}

static bool do_named(StudioDocument *document, uint32_t element, GArray *splices,
                     const char *format, const char *key) {
    const FrContentsElement *at = fr_contents_at(studio_document_contents(document), element);
    char *name = g_strdup_printf(format, at->id != NULL ? at->id : at->name);
    bool is_changed = splices->len > 0 && studio_document_splice(document, splices, name, key);
    g_free(name);
    g_array_unref(splices);
    return is_changed;
}

bool studio_move_keys(StudioDocument *document, uint32_t element, double from, double *to,
                      const char *key) {
    if (studio_document_is_broken(document) || !studio_has_keys(document, element)) {
        return false;
    }
    GArray *ages = studio_key_ages(document, element);
    double least = -INFINITY, most = INFINITY;
    for (guint i = 0; i < ages->len; i++) {
        double age = g_array_index(ages, double, i);
        least = age < from - same_age ? age + 2 * same_age : least;
        most = age > from + same_age ? fmin(most, age - 2 * same_age) : most;
    }
    g_array_unref(ages);
    *to = least > most ? from : CLAMP(*to, least, most);
    const FrContents *contents = studio_document_contents(document);
    return do_named(document, element, change_rows(contents, element, from, move_key, *to),
                    "Move a key of %s", key);
}

bool studio_remove_keys(StudioDocument *document, uint32_t element, double age) {
    if (studio_document_is_broken(document) || !studio_has_keys(document, element)) {
        return false;
    }
    const FrContents *contents = studio_document_contents(document);
    return do_named(document, element, change_rows(contents, element, age, remove_key, 0),
                    "Remove a key of %s", NULL);
}

// ---- keys of attributes ------------------------------------------------------------------------

// Writes keys as the value of an attribute.
static bool write_keys(StudioDocument *document, uint32_t element, const char *attribute,
                       const StudioKeys *keys, double plain, const char *verb, const char *key) {
    char *text = studio_keys_write(keys, plain);
    char *format = g_strdup_printf("%s of %s of %%s", verb, attribute);
    GArray *splices = g_array_new(FALSE, FALSE, sizeof(FrSplice));
    FrSplice splice = fr_contents_set(studio_document_contents(document), element, attribute, text);
    g_array_append_val(splices, splice);
    bool is_changed = do_named(document, element, splices, format, key);
    g_free(format);
    g_free(text);
    return is_changed;
}

// Reads the value of an attribute, or its default.
static bool read_value(const StudioDocument *document, uint32_t element, const char *attribute,
                       StudioKeys *keys, double *plain) {
    const FrContents *contents = studio_document_contents(document);
    const FrParamTable *table = fr_contents_at(contents, element)->table;
    const FrParam *row = table == NULL ? NULL : fr_params_find(table, attribute);
    if (row == NULL || row->kind != FR_PARAM_NUMBER || studio_document_is_broken(document) ||
        !studio_has_keys(document, element)) {
        return false;
    }
    char *text = fr_contents_get(contents, element, attribute);
    bool is_read = studio_keys_read(text != NULL ? text : row->default_text, keys, plain);
    g_free(text);
    return is_read;
}

bool studio_set_key(StudioDocument *document, uint32_t element, const char *attribute, double age,
                    double value, bool is_drag) {
    StudioKeys keys;
    double plain;
    if (!read_value(document, element, attribute, &keys, &plain)) {
        return false;
    }
    double there = !isnan(value) ? value : isnan(plain) ? studio_keys_value(&keys, age) : plain;
    studio_keys_set(&keys, age, there);
    char *key = is_drag ? g_strdup_printf("key %u.%s", element, attribute) : NULL;
    bool is_changed = write_keys(document, element, attribute, &keys, there, "Set a key", key);
    g_free(key);
    studio_keys_clear(&keys);
    return is_changed;
}

bool studio_remove_key(StudioDocument *document, uint32_t element, const char *attribute,
                       double age) {
    StudioKeys keys;
    double plain;
    if (!read_value(document, element, attribute, &keys, &plain)) {
        return false;
    }
    uint32_t index = studio_keys_find(&keys, age);
    bool is_changed = false;
    if (index != FR_NONE) {
        double last = point_at(&keys, index)[1];
        remove_key(&keys, index, 0);
        is_changed = write_keys(document, element, attribute, &keys, last, "Remove a key", NULL);
    }
    studio_keys_clear(&keys);
    return is_changed;
}
