#include "studio/model/sketch_edit.h"

#include "studio/model/commands.h"
#include "studio/model/scene_edit.h"

#include <math.h>
#include <string.h>

enum { LINE = 80 }; // characters of a line of points, about

void studio_sketch_of_clear(StudioSketchOf *of) {
    g_clear_pointer(&of->base, g_free);
    g_clear_pointer(&of->varied, g_free);
}

// ---- what there is -----------------------------------------------------------------------------

uint32_t studio_sketch_vary(const FrContents *contents, const char *varied) {
    uint32_t plant = FR_NONE;
    for (uint32_t p = varied == NULL ? FR_NONE : fr_contents_child(contents, 0, "plant");
         p != FR_NONE && plant == FR_NONE; p = fr_contents_sibling(contents, p)) {
        plant = g_strcmp0(fr_contents_at(contents, p)->id, varied) == 0 ? p : FR_NONE;
    }
    return plant == FR_NONE ? FR_NONE : fr_contents_child(contents, plant, "vary");
}

GPtrArray *studio_sketch_variations(const FrContents *contents, const char *base) {
    GPtrArray *found = g_ptr_array_new();
    for (uint32_t p = fr_contents_child(contents, 0, "plant"); p != FR_NONE;
         p = fr_contents_sibling(contents, p)) {
        uint32_t vary = fr_contents_child(contents, p, "vary");
        char *of = vary == FR_NONE ? NULL : fr_contents_get(contents, vary, "base");
        const char *id = fr_contents_at(contents, p)->id;
        if (id != NULL && of != NULL && g_strcmp0(of, base) == 0) {
            g_ptr_array_add(found, (gpointer)id);
        }
        g_free(of);
    }
    return found;
}

StudioSketchOf studio_sketch_of(const FrContents *contents, uint32_t plant) {
    StudioSketchOf of = {NULL, NULL};
    const char *id = plant == FR_NONE ? NULL : fr_contents_at(contents, plant)->id;
    uint32_t vary = plant == FR_NONE ? FR_NONE : fr_contents_child(contents, plant, "vary");
    if (vary != FR_NONE) {
        of = (StudioSketchOf){fr_contents_get(contents, vary, "base"), g_strdup(id)};
    } else if (id != NULL) {
        GPtrArray *variations = studio_sketch_variations(contents, id);
        const char *first = variations->len == 0 ? NULL : g_ptr_array_index(variations, 0);
        of = (StudioSketchOf){g_strdup(id), g_strdup(first)};
        g_ptr_array_unref(variations);
    }
    return of;
}

GArray *studio_sketch_marks(const FrContents *contents, uint32_t vary) {
    GArray *marks = g_array_new(FALSE, FALSE, sizeof(uint32_t));
    for (uint32_t e = vary == FR_NONE ? FR_NONE : fr_contents_at(contents, vary)->first;
         e != FR_NONE; e = fr_contents_at(contents, e)->next) {
        const char *name = fr_contents_at(contents, e)->name;
        if (strcmp(name, "stroke") == 0 || strcmp(name, "indicator") == 0) {
            g_array_append_val(marks, e);
        }
    }
    return marks;
}

// ---- drawing -----------------------------------------------------------------------------------

// The points of a stroke in lines of a handy length, as the hand drew them. Free with g_free().
static char *points_of(const FrStroke *stroke) {
    GString *text = g_string_new("\n  ");
    size_t count, begin = text->len;
    const FrStrokePoint *points = fr_stroke_points(stroke, &count);
    for (size_t i = 0; i < count; i++) {
        double numbers[] = {(double)points[i].at.x, (double)points[i].at.y, (double)points[i].at.z,
                            (double)points[i].pressure, points[i].time};
        if (text->len > begin) {
            bool is_full = text->len - begin > LINE;
            g_string_append(text, is_full ? "\n  " : " ");
            begin = is_full ? text->len : begin;
        }
        for (size_t n = 0; n < G_N_ELEMENTS(numbers); n++) {
            char number[G_ASCII_DTOSTR_BUF_SIZE];
            g_ascii_formatd(number, sizeof number, n < 3 ? "%.6g" : "%.4g", numbers[n]);
            g_string_append_printf(text, "%s%s", n > 0 ? "," : "", number);
        }
    }
    g_string_append_c(text, '\n');
    return g_string_free(text, FALSE);
}

// The attributes of what a mark is for; `usual` need not be said. Free with g_free().
static char *reach_of(const char *choice, FrApply apply, FrApply usual) {
    static const char *const names[] = {"selected", "descendants", "both"};
    GString *text = g_string_new(NULL);
    if (choice != NULL && *choice != '\0') {
        char *select = g_markup_printf_escaped(" select=\"%s\"", choice);
        g_string_append(text, select);
        g_free(select);
    }
    if (apply != usual) {
        g_string_append_printf(text, " apply=\"%s\"", names[apply]);
    }
    return g_string_free(text, FALSE);
}

// Every line of a text further in.
static char *indented(const char *xml) {
    char **lines = g_strsplit(xml, "\n", -1);
    char *joined = g_strjoinv("\n    ", lines);
    g_strfreev(lines);
    return joined;
}

static bool add_mark(StudioDocument *document, StudioSketchOf *of, const char *mark,
                     const char *name) {
    const FrContents *contents = studio_document_contents(document);
    if (contents == NULL || of->base == NULL || studio_document_is_broken(document)) {
        return false;
    }
    uint32_t vary = studio_sketch_vary(contents, of->varied);
    if (vary != FR_NONE) {
        return studio_document_splice_one(
            document, fr_contents_insert(contents, vary, FR_NONE, mark), name, NULL);
    }
    char *stem = g_strconcat(of->base, "-drawn", NULL);
    char *id = studio_free_id(document, 0, stem);
    char *inner = indented(mark);
    char *xml = g_strdup_printf("<plant id=\"%s\" seed=\"1\">\n  <vary base=\"%s\">\n    %s\n"
                                "  </vary>\n</plant>",
                                id, of->base, inner);
    uint32_t after = fr_contents_child(contents, 0, "plant");
    for (uint32_t p = after; p != FR_NONE; p = fr_contents_sibling(contents, p)) {
        after = p;
    }
    bool is_done = studio_document_splice_one(document, fr_contents_insert(contents, 0, after, xml),
                                              name, NULL);
    if (is_done) {
        g_free(of->varied);
        of->varied = g_strdup(id);
    }
    g_free(xml);
    g_free(inner);
    g_free(id);
    g_free(stem);
    return is_done;
}

bool studio_sketch_add_stroke(StudioDocument *document, StudioSketchOf *of, const FrStroke *stroke,
                              const char *choice, FrApply apply) {
    char *lines = points_of(stroke), *reach = reach_of(choice, apply, FR_APPLY_SELECTED);
    char *mark = g_strdup_printf("<stroke%s>%s</stroke>", reach, lines);
    bool is_done = add_mark(document, of, mark, "Draw a stroke");
    g_free(mark);
    g_free(reach);
    g_free(lines);
    return is_done;
}

bool studio_sketch_add_indicator(StudioDocument *document, StudioSketchOf *of, StudioPen pen,
                                 vec3s vector, const char *choice, FrApply apply) {
    static const char *const kinds[] = {NULL, "wind", "sun", "rain"};
    static const char *const names[] = {NULL, "Draw wind", "Draw sun", "Draw rain"};
    if (pen == STUDIO_PEN_STROKE) {
        return false;
    }
    char number[3][G_ASCII_DTOSTR_BUF_SIZE];
    for (int i = 0; i < 3; i++) {
        g_ascii_formatd(number[i], sizeof number[i], "%.6g", (double)vector.raw[i]);
    }
    char *reach = reach_of(choice, apply, FR_APPLY_BOTH);
    char *mark = g_strdup_printf("<indicator kind=\"%s\" to=\"%s,%s,%s\"%s/>", kinds[pen],
                                 number[0], number[1], number[2], reach);
    bool is_done = add_mark(document, of, mark, names[pen]);
    g_free(mark);
    g_free(reach);
    return is_done;
}

bool studio_sketch_remove(StudioDocument *document, uint32_t mark) {
    const FrContents *contents = studio_document_contents(document);
    bool is_stroke = strcmp(fr_contents_at(contents, mark)->name, "stroke") == 0;
    return studio_document_splice_one(document, fr_contents_remove(contents, mark),
                                      is_stroke ? "Remove a stroke" : "Remove an indicator", NULL);
}

// ---- standing somewhere ------------------------------------------------------------------------

static void append_place(GString *xml, const char *plant, gint64 seed, double x, double y) {
    char across[G_ASCII_DTOSTR_BUF_SIZE], along[G_ASCII_DTOSTR_BUF_SIZE];
    g_ascii_formatd(across, sizeof across, "%.4g", x);
    g_ascii_formatd(along, sizeof along, "%.4g", y);
    g_string_append_printf(xml, "%s<place plant=\"%s\"", xml->len > 0 ? "\n" : "", plant);
    if (seed >= 0) {
        g_string_append_printf(xml, " seed=\"%" G_GINT64_FORMAT "\"", seed);
    }
    if (x != 0 || y != 0) {
        g_string_append_printf(xml, " at=\"%s,%s,0\"", across, along);
    }
    g_string_append(xml, "/>");
}

// The greatest x of a place in the scene; false: nothing is placed there.
static bool rightmost(const FrContents *contents, uint32_t scene, double *x) {
    bool is_any = false;
    for (uint32_t e = scene == FR_NONE ? FR_NONE : fr_contents_at(contents, scene)->first;
         e != FR_NONE; e = fr_contents_at(contents, e)->next) {
        const char *name = fr_contents_at(contents, e)->name;
        if (strcmp(name, "place") == 0) {
            char *at = fr_contents_get(contents, e, "at");
            *x = fmax(*x, at == NULL ? 0 : g_ascii_strtod(at, NULL));
            g_free(at);
        }
        is_any = is_any || strcmp(name, "place") == 0 || strcmp(name, "row") == 0 ||
                 strcmp(name, "strew") == 0;
    }
    return is_any;
}

bool studio_sketch_place(StudioDocument *document, const StudioSketchOf *of, uint64_t seed,
                         uint32_t count, double step) {
    const FrContents *contents = studio_document_contents(document);
    if (contents == NULL || of->varied == NULL) {
        return false;
    }
    GString *xml = g_string_new(NULL);
    double x = 0;
    if (!rightmost(contents, fr_contents_child(contents, 0, "scene"), &x)) {
        uint32_t first = fr_contents_child(contents, 0, "plant");
        append_place(xml, fr_contents_at(contents, first)->id, -1, 0, 0);
    }
    for (uint32_t i = 0; i < count; i++) {
        append_place(xml, of->varied, (gint64)(seed + i), x + step * (i + 1), 0);
    }
    bool is_done =
        studio_document_splice_one(document, studio_scene_insert(contents, FR_NONE, xml->str),
                                   "Stand instances in the scene", NULL);
    g_string_free(xml, TRUE);
    return is_done;
}

// ---- what is looked at -------------------------------------------------------------------------

static FrSource *spliced(const FrContents *contents, GArray *splices) {
    size_t size;
    char *text = fr_contents_apply(contents, splices, &size);
    FrSource *source = fr_source_new(fr_source_name(fr_contents_source(contents)), text, size);
    g_free(text);
    g_array_unref(splices);
    return source;
}

// The same document with an empty scene.
static FrSource *emptied(const FrContents *contents) {
    GArray *splices = g_array_new(FALSE, FALSE, sizeof(FrSplice));
    uint32_t scene = fr_contents_child(contents, 0, "scene");
    for (uint32_t e = scene == FR_NONE ? FR_NONE : fr_contents_at(contents, scene)->first;
         e != FR_NONE; e = fr_contents_at(contents, e)->next) {
        FrSplice splice = fr_contents_remove(contents, e);
        g_array_append_val(splices, splice);
    }
    return spliced(contents, splices);
}

FrSource *studio_sketch_preview(const StudioDocument *document, const StudioSketchOf *of,
                                uint64_t seed, uint32_t count, double step) {
    const FrContents *contents = studio_document_contents(document);
    if (contents == NULL || of->base == NULL || studio_document_is_broken(document)) {
        return NULL;
    }
    FrSource *empty = emptied(contents), *source = NULL;
    FrContext context = fr_context_default();
    FrContents *rest;
    if (fr_contents_read(empty, &context, &rest) == FR_OK) {
        GString *xml = g_string_new(NULL);
        uint32_t columns = (uint32_t)ceil(sqrt(count));
        uint32_t rows = (count + columns - 1) / columns;
        for (uint32_t i = 0; i < count; i++) {
            const char *plant = of->varied != NULL ? of->varied : of->base;
            append_place(xml, plant, of->varied != NULL ? (gint64)(seed + i) : -1,
                         step * (i % columns - 0.5 * (columns - 1)),
                         step * (0.5 * (rows - 1) - i / columns));
        }
        GArray *splices = g_array_new(FALSE, FALSE, sizeof(FrSplice));
        FrSplice splice = studio_scene_insert(rest, FR_NONE, xml->str);
        g_array_append_val(splices, splice);
        source = spliced(rest, splices);
        g_string_free(xml, TRUE);
        fr_contents_free(rest);
    }
    fr_source_unref(empty);
    return source;
}
