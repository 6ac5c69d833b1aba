/// `<place>`, `<row>` and `<strew>`: where the plants of a scene stand.
#include "document/reader.h"

#include <string.h>

#define FR_PARAM_STRUCT FrRow
static const FrParam row_rows[] = {FR_SPREAD_PARAMS(FR_PARAM_ROW) FR_ROW_PARAMS(FR_PARAM_ROW)};
#undef FR_PARAM_STRUCT
#define FR_PARAM_STRUCT FrStrew
static const FrParam strew_rows[] = {FR_SPREAD_PARAMS(FR_PARAM_ROW) FR_STREW_PARAMS(FR_PARAM_ROW)};
#undef FR_PARAM_STRUCT

const FrParamTable *fr_row_table(void) {
    static const FrParamTable table = {.element = "row",
                                       .meaning = "plants in rows along a line; its text is the "
                                                  "points of the line, x,y,z each",
                                       .rows = row_rows,
                                       .count = G_N_ELEMENTS(row_rows),
                                       .struct_size = sizeof(FrRow)};
    return &table;
}

const FrParamTable *fr_strew_table(void) {
    static const FrParamTable table = {.element = "strew",
                                       .meaning = "plants strewn over an area, none near another",
                                       .rows = strew_rows,
                                       .count = G_N_ELEMENTS(strew_rows),
                                       .struct_size = sizeof(FrStrew)};
    return &table;
}

static void clear_part(void *data) {
    g_free(((FrMixPart *)data)->plant);
}

static void free_row(void *data) {
    FrRow *row = data;
    g_array_unref(row->mix);
    g_array_unref(row->gaps);
    fr_stroke_unref(row->along);
    fr_params_clear(fr_row_table(), row);
    g_free(row);
}

static void free_strew(void *data) {
    FrStrew *strew = data;
    g_array_unref(strew->mix);
    g_array_unref(strew->gaps);
    if (strew->picture != NULL) {
        fr_image_unref(strew->picture);
    }
    fr_params_clear(fr_strew_table(), strew);
    g_free(strew);
}

GPtrArray *fr_rows_new(void) {
    return g_ptr_array_new_with_free_func(free_row);
}

GPtrArray *fr_strews_new(void) {
    return g_ptr_array_new_with_free_func(free_strew);
}

static void check_plant_exists(FrReader *reader, FrXmlRange place, const char *id) {
    if (g_hash_table_contains(reader->plant_ids, id)) {
        return;
    }
    const GPtrArray *plants = reader->document->plants;
    uint32_t count = fr_read_candidates(plants->len);
    const char **names = g_new(const char *, count + 1);
    for (uint32_t i = 0; i < count; i++) {
        names[i] = ((const FrPlantDef *)g_ptr_array_index(plants, i))->id;
    }
    char *hint = fr_read_hint(reader, id, names, count);
    fr_read_error(reader, "unknown-plant", place, "there is no plant '%.64s'%s", id, hint);
    g_free(hint);
    g_free(names);
}

static void read_place(FrReader *reader, uint32_t node) {
    fr_read_check_children(reader, node, FR_ELEMENT_PLACE);
    FrPlace *place = g_new0(FrPlace, 1);
    fr_params_init(fr_place_table(), place);
    place->span = fr_xml_span(reader->tree, reader->tree->nodes[node].name);
    fr_read_attributes(reader, node, FR_ELEMENT_PLACE, place);
    g_ptr_array_add(reader->document->places, place);
    if (place->plant != NULL) {
        check_plant_exists(reader, fr_read_value_place(reader, node, "plant"), place->plant);
    }
}

/// The share of "oak 3"; < 0 if it is none. `words` has two at most.
static double share_of(char **words) {
    if (words[0] == NULL || words[1] == NULL) {
        return 1;
    }
    char *end;
    double share = g_ascii_strtod(words[1], &end);
    return *end == '\0' && share > 0 && share <= 1e9 && words[2] == NULL ? share : -1;
}

/// The words of a text without empty ones; free with g_strfreev().
static char **split_words(const char *text) {
    char **all = g_strsplit_set(text, " \t\r\n", 64);
    guint kept = 0;
    for (guint i = 0; all[i] != NULL; i++) {
        if (*all[i] == '\0') {
            g_free(all[i]);
        } else {
            all[kept++] = all[i];
        }
    }
    all[kept] = NULL;
    return all;
}

/// Reads "oak 3, birch".
static GArray *read_mix(FrReader *reader, uint32_t node, const char *text) {
    GArray *mix = g_array_new(FALSE, FALSE, sizeof(FrMixPart));
    g_array_set_clear_func(mix, clear_part);
    FrXmlRange place = fr_read_value_place(reader, node, "plants");
    char **parts = g_strsplit(text == NULL ? "" : text, ",", -1);
    for (guint i = 0; parts[i] != NULL; i++) {
        char **words = split_words(parts[i]);
        double share = share_of(words);
        if (words[0] == NULL || share < 0) {
            fr_read_error(reader, "bad-mix", place,
                          "plants are written 'oak' or 'oak 3, birch 1', not '%.64s'", parts[i]);
        } else {
            check_plant_exists(reader, place, words[0]);
            FrMixPart part = {g_strdup(words[0]), share};
            g_array_append_val(mix, part);
        }
        g_strfreev(words);
    }
    if (parts[0] == NULL && fr_xml_attribute(reader->tree, node, "plants") != NULL) {
        fr_read_error(reader, "bad-mix", place, "no plant is named");
    }
    g_strfreev(parts);
    return mix;
}

static int compare_numbers(const void *a, const void *b) {
    uint32_t left = *(const uint32_t *)a, right = *(const uint32_t *)b;
    return left == right ? 0 : left < right ? -1 : 1;
}

/// Reads "3 17 20".
static GArray *read_gaps(FrReader *reader, uint32_t node, const char *text) {
    GArray *gaps = g_array_new(FALSE, FALSE, sizeof(uint32_t));
    for (const char *at = text == NULL ? "" : text; *at != '\0';) {
        if (g_ascii_isspace(*at)) {
            at++;
            continue;
        }
        char *end = NULL;
        guint64 number = g_ascii_isdigit(*at) ? g_ascii_strtoull(at, &end, 10) : 0;
        if (end == NULL || number >= UINT32_MAX || (*end != '\0' && !g_ascii_isspace(*end))) {
            fr_read_error(reader, "bad-except", fr_read_value_place(reader, node, "except"),
                          "plants that are left out are numbers such as '3 17', not '%.64s'", at);
            break;
        }
        uint32_t gap = (uint32_t)number;
        g_array_append_val(gaps, gap);
        at = end;
    }
    g_array_sort(gaps, compare_numbers);
    return gaps;
}

static void read_row(FrReader *reader, uint32_t node) {
    fr_read_check_children(reader, node, FR_ELEMENT_ROW);
    FrRow *row = g_new0(FrRow, 1);
    fr_params_init(fr_row_table(), row);
    row->span = fr_xml_span(reader->tree, reader->tree->nodes[node].name);
    fr_read_attributes(reader, node, FR_ELEMENT_ROW, row);
    row->mix = read_mix(reader, node, row->plants);
    row->gaps = read_gaps(reader, node, row->except);
    row->along = fr_read_line(reader, node);
    g_ptr_array_add(reader->document->rows, row);
}

static void read_strew(FrReader *reader, uint32_t node) {
    fr_read_check_children(reader, node, FR_ELEMENT_STREW);
    FrStrew *strew = g_new0(FrStrew, 1);
    fr_params_init(fr_strew_table(), strew);
    strew->span = fr_xml_span(reader->tree, reader->tree->nodes[node].name);
    fr_read_attributes(reader, node, FR_ELEMENT_STREW, strew);
    strew->mix = read_mix(reader, node, strew->plants);
    strew->gaps = read_gaps(reader, node, strew->except);
    strew->picture = fr_read_picture(reader, node, "density", strew->density);
    g_ptr_array_add(reader->document->strews, strew);
}

/// Calls a reader for each such element of a scene.
static void read_each(FrReader *reader, uint32_t scene, FrElementId id,
                      void (*read)(FrReader *reader, uint32_t node)) {
    for (uint32_t node = fr_read_first(reader, scene, id); node != FR_NONE;
         node = fr_read_next(reader, node, id)) {
        read(reader, node);
    }
}

void fr_read_placing(FrReader *reader, uint32_t scene) {
    read_each(reader, scene, FR_ELEMENT_PLACE, read_place);
    read_each(reader, scene, FR_ELEMENT_ROW, read_row);
    read_each(reader, scene, FR_ELEMENT_STREW, read_strew);
}
