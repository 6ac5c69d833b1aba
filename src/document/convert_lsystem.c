/// L-systems between documents and files of their own.
#include "document/reader.h"

#include <string.h>

// ---- from a file to a document ----------------------------------------------------------------

char *fr_document_wrap_lsystem(const char *id, const char *text, const char *view) {
    GString *out =
        g_string_new("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<frond version=\"1\">\n");
    char *head =
        view == NULL
            ? g_markup_printf_escaped("  <plant id=\"%s\">\n    <lsystem>", id)
            : g_markup_printf_escaped("  <plant id=\"%s\">\n    <lsystem view=\"%s\">", id, view);
    g_string_append_printf(out, "%s<![CDATA[\n", head);
    g_free(head);
    // What ends a CDATA section is cut in two.
    char **parts = g_strsplit(text, "]]>", -1);
    char *joined = g_strjoinv("]]]]><![CDATA[>", parts);
    g_string_append(out, joined);
    g_string_append_printf(out, "%s]]></lsystem>\n  </plant>\n</frond>\n",
                           g_str_has_suffix(text, "\n") ? "" : "\n");
    g_free(joined);
    g_strfreev(parts);
    return g_string_free(out, FALSE);
}

// ---- from a document to a file ----------------------------------------------------------------

/// A line that the file must have: found by how it begins, else put in.
typedef struct Setting {
    char *keyword; ///< "derivation length:", "#define angle"
    char *line;
    bool is_before; ///< stands before `Lsystem:`
    bool is_set;
} Setting;

static void setting_clear(void *data) {
    g_free(((Setting *)data)->keyword);
    g_free(((Setting *)data)->line);
}

static void add_setting(GArray *settings, bool is_before, char *keyword, char *line) {
    Setting setting = {keyword, line, is_before, false};
    g_array_append_val(settings, setting);
}

/// The numbers that the document sets, for the plant's seed, and what replaces header lines.
static GArray *settings_of(const FrPlantDef *plant, FrDiags *diags) {
    const FrLmodel *model = plant->lsystem;
    const FrLsystemParams *params = fr_lmodel_params(model);
    GArray *settings = g_array_new(FALSE, FALSE, sizeof(Setting));
    g_array_set_clear_func(settings, setting_clear);
    size_t count = fr_lmodel_value_count(model);
    double *values = g_new(double, count + 1);
    fr_lmodel_evaluate(model, fr_key_root(plant->has_seed ? plant->seed : 0), values);
    for (uint32_t i = 0; i < count; i++) {
        char number[G_ASCII_DTOSTR_BUF_SIZE];
        const char *name = fr_lmodel_value_name(model, i);
        // A number with an exponent needs a decimal point, a negative one brackets.
        g_ascii_formatd(number, sizeof number, "%.15g", values[i]);
        bool is_plain = strchr(number, 'e') == NULL;
        if (!is_plain) {
            g_ascii_formatd(number, sizeof number, "%.15f", values[i]);
        }
        add_setting(
            settings, true, g_strdup_printf("#define %s", name),
            g_strdup_printf(values[i] < 0 ? "#define %s (%s)" : "#define %s %s", name, number));
    }
    if (params->steps >= 0) {
        add_setting(settings, false, g_strdup("derivation length:"),
                    g_strdup_printf("derivation length: %" G_GINT64_FORMAT, params->steps));
    }
    if (plant->has_seed) {
        add_setting(settings, false, g_strdup("seed:"),
                    g_strdup_printf("seed: %" G_GUINT64_FORMAT, plant->seed));
    }
    if (params->brackets == 1) {
        add_setting(settings, false, g_strdup("brackets:"), g_strdup("brackets: round"));
    }
    if (params->unit != 1 || params->material != NULL || params->leaf_material != NULL) {
        fr_diags_add(diags, FR_WARNING, "left-out", plant->span,
                     "unit and materials of '%s' have no place in a file of an L-system",
                     plant->id);
    }
    g_free(values);
    return settings;
}

/// Whether a line begins with the words of a keyword, blanks as one likes.
static bool begins_with(const char *line, const char *keyword) {
    line += strspn(line, " \t");
    for (; *keyword != '\0'; keyword++) {
        if (*keyword == ' ' && (*line == ' ' || *line == '\t')) {
            line += strspn(line, " \t");
        } else if (g_ascii_tolower(*line++) != g_ascii_tolower(*keyword)) {
            return false;
        }
    }
    bool is_name = g_ascii_isalnum(keyword[-1]) || keyword[-1] == '_';
    return !is_name || !(g_ascii_isalnum(*line) || *line == '_');
}

static void append_missing(GArray *settings, bool is_before, GString *out) {
    for (guint i = 0; i < settings->len; i++) {
        Setting *setting = &g_array_index(settings, Setting, i);
        if (setting->is_before == is_before && !setting->is_set) {
            g_string_append_printf(out, "%s\n", setting->line);
            setting->is_set = true;
        }
    }
}

/// Marks the settings that the text has lines for.
static void find_lines(char *const *lines, GArray *settings) {
    for (; *lines != NULL; lines++) {
        for (guint i = 0; i < settings->len; i++) {
            Setting *setting = &g_array_index(settings, Setting, i);
            setting->is_set |= begins_with(*lines, setting->keyword);
        }
    }
}

static char *with_settings(const char *text, GArray *settings) {
    GString *out = g_string_new(NULL);
    char **lines = g_strsplit(text, "\n", -1);
    find_lines(lines, settings);
    append_missing(settings, true, out);
    bool is_cpfg = false;
    for (char **line = lines; *line != NULL; line++) {
        is_cpfg |= begins_with(*line, "lsystem:");
    }
    if (!is_cpfg) {
        append_missing(settings, false, out);
    }
    for (char **line = lines; *line != NULL; line++) {
        const char *written = *line;
        for (guint i = 0; i < settings->len; i++) {
            const Setting *setting = &g_array_index(settings, Setting, i);
            written = begins_with(*line, setting->keyword) ? setting->line : written;
        }
        g_string_append_printf(out, "%s%s", written, line[1] == NULL ? "" : "\n");
        if (begins_with(*line, "lsystem:")) {
            append_missing(settings, false, out);
        }
    }
    g_strfreev(lines);
    return g_string_free(out, FALSE);
}

/// The text as it was written, without the blank line and the indentation around it.
static char *trimmed(const char *text) {
    const char *begin = text;
    for (const char *at = text; *at == ' ' || *at == '\t' || *at == '\r' || *at == '\n'; at++) {
        begin = *at == '\n' ? at + 1 : begin;
    }
    char *copy = g_strchomp(g_strdup(begin)), *whole = g_strconcat(copy, "\n", NULL);
    g_free(copy);
    return whole;
}

FrStatus fr_document_extract_lsystem(const FrDocument *document, const FrPlantDef *plant,
                                     const FrContext *context, char **text) {
    FR_ASSERT(plant->kind == FR_PLANT_LSYSTEM);
    FrReader reader; // which only reads
    fr_reader_open(&reader, (FrDocument *)document, context->diags);
    uint32_t node = fr_read_find_plant(document->tree, plant);
    FrSource *source = fr_read_source(&reader, fr_read_first(&reader, node, FR_ELEMENT_LSYSTEM));
    fr_reader_close(&reader);
    FrStatus status = FR_OK;
    if (source == NULL) {
        const char *file = fr_lmodel_params(plant->lsystem)->file;
        char *path = g_path_is_absolute(file) ? g_strdup(file)
                                              : g_build_filename(document->folder, file, NULL);
        source = fr_source_load(path, context->limits.document_bytes, context->diags, &status);
        g_free(path);
    }
    if (source != NULL) {
        GArray *settings = settings_of(plant, context->diags);
        char *own = trimmed(fr_source_text(source, NULL));
        *text = with_settings(own, settings);
        g_free(own);
        g_array_unref(settings);
        fr_source_unref(source);
    }
    return status;
}
