/// The reference page of elements and attributes, from the same rows as everything else.
#include "document/format.h"

#include <string.h>

static const char head[] =
    "# The `.frond` document\n"
    "\n"
    "*Made by `frond reference` from the parameter tables; do not edit.*\n"
    "\n"
    "A document is XML in UTF-8 without a document type. Ids are a letter or `_` followed by\n"
    "letters, digits, `-` and `_`. Lengths are metres, angles degrees, colours `#rrggbb` in sRGB;\n"
    "files are named relative to the document. Unknown elements and attributes are errors.\n"
    "\n"
    "How values are written:\n"
    "\n"
    "| kind | text |\n"
    "|---|---|\n"
    "| number | `45`, from first to last `80..30`, plus or minus `45 ~ 5`, walked by a function "
    "`80..30 ~ 5 : t^2` or a curve `80..30 : crown`, or an expression `= 3 + 2*i`; with \\* it may "
    "also differ along the component itself: `90 \\| self ramp` |\n"
    "| real, integer | `3.5`, `12`: the same for all; also an expression of numbers and sliders, "
    "`= 2*size` |\n"
    "| switch | `yes` or `no`, or such an expression: not 0 is yes |\n"
    "| choice | one of the words listed |\n"
    "| text | anything; also ids of other things |\n"
    "| curve | the id of a `<curve>`, a built-in one, or points |\n"
    "| points | `0,0.3 0.4,1 1,0.1` |\n"
    "| vector | `1, 0, 2.5`, or one number for all three |\n"
    "| colour | `#6b5844` |\n"
    "| choice, text, curve, points, vector, colour | also one of several, by a number or slider: "
    "`= pick(shape, conical; flame)`; a vector also `= 2*size, 0, 1` |\n"
    "| formula | an expression of the variables that are listed, without random numbers |\n";

static const char *kind_name(FrParamKind kind) {
    static const char *const names[] = {
        [FR_PARAM_NUMBER] = "number",   [FR_PARAM_REAL] = "real",
        [FR_PARAM_INTEGER] = "integer", [FR_PARAM_SWITCH] = "switch",
        [FR_PARAM_CHOICE] = "choice",   [FR_PARAM_TEXT] = "text",
        [FR_PARAM_CURVE] = "curve",     [FR_PARAM_POINTS] = "points",
        [FR_PARAM_VECTOR] = "vector",   [FR_PARAM_COLOUR] = "colour",
        [FR_PARAM_FORMULA] = "formula",
    };
    return names[kind];
}

/// Text of a table cell.
static void append_cell(GString *out, const char *text) {
    for (; *text != '\0'; text++) {
        g_string_append(out, *text == '|' ? "\\|" : (char[]){*text, '\0'});
    }
}

static void append_choices(GString *out, const char *choices) {
    char **names = g_strsplit(choices, " ", -1);
    char *joined = g_strjoinv("`, `", names);
    g_string_append_printf(out, "`%s`", joined);
    g_free(joined);
    g_strfreev(names);
}

static void append_range(GString *out, const FrParam *row) {
    if (row->kind == FR_PARAM_CHOICE || row->kind == FR_PARAM_FORMULA) {
        append_choices(out, row->choices);
    } else if (row->min < row->max && row->kind != FR_PARAM_SWITCH &&
               row->kind != FR_PARAM_COLOUR) {
        char min[G_ASCII_DTOSTR_BUF_SIZE], max[G_ASCII_DTOSTR_BUF_SIZE];
        g_string_append_printf(out, "%s to %s", g_ascii_formatd(min, sizeof min, "%.10g", row->min),
                               g_ascii_formatd(max, sizeof max, "%.10g", row->max));
    }
}

static void append_row(GString *out, const FrParam *row, const FrElement *element) {
    char *name = fr_param_attribute(row);
    bool is_along = row->kind == FR_PARAM_NUMBER && strcmp(row->choices, "self") == 0;
    g_string_append_printf(out, "| `%s` | %s%s | ", name, kind_name(row->kind),
                           is_along ? " \\*" : "");
    if (fr_element_requires(element, name)) {
        g_string_append(out, "required");
    } else if (*row->default_text != '\0') {
        g_string_append_c(out, '`');
        append_cell(out, row->default_text);
        g_string_append_c(out, '`');
    }
    g_string_append(out, " | ");
    append_range(out, row);
    g_string_append_printf(out, " | %s | ", row->unit);
    append_cell(out, row->meaning);
    g_string_append(out, " |\n");
    g_free(name);
}

static void append_element(GString *out, FrElementId id) {
    FrElement element = fr_element(id);
    g_string_append_printf(out, "\n## `<%s>`\n\n%c%s.\n", element.name,
                           g_ascii_toupper(element.meaning[0]), element.meaning + 1);
    const char *before = "\nHolds ";
    for (FrElementId child = 0; child < FR_ELEMENT_COUNT; child++) {
        if ((element.children >> child & 1) != 0) {
            g_string_append_printf(out, "%s`<%s>`", before, fr_element(child).name);
            before = ", ";
        }
    }
    g_string_append(out, element.children != 0 ? ".\n" : "");
    if (element.table == NULL && !element.has_id) {
        return;
    }
    g_string_append(out, "\n| attribute | kind | default | range | unit | meaning |\n"
                         "|---|---|---|---|---|---|\n");
    if (element.has_id) {
        g_string_append(out, "| `id` | id | required |  |  | its name |\n");
    }
    for (size_t i = 0; element.table != NULL && i < element.table->count; i++) {
        append_row(out, &element.table->rows[i], &element);
    }
}

char *fr_document_reference(void) {
    GString *out = g_string_new(head);
    for (FrElementId id = 0; id < FR_ELEMENT_COUNT; id++) {
        append_element(out, id);
    }
    return g_string_free(out, FALSE);
}
