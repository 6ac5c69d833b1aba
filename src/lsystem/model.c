// An L-system together with what a document or a folder of files says of it.
#include "frond/lsystem_model.h"

#include "lsystem/palette.h"

#include <cglm/struct.h>

#include <string.h>

#define FR_PARAM_STRUCT FrLsystemParams
static const FrParam rows[] = {FR_LSYSTEM_PARAMS(FR_PARAM_ROW)};
#undef FR_PARAM_STRUCT

static const FrParamTable table = {.element = "lsystem",
                                   .meaning = "an L-system; its text is the L-system itself",
                                   .rows = rows,
                                   .count = G_N_ELEMENTS(rows),
                                   .struct_size = sizeof(FrLsystemParams)};

enum { MOST_VALUES = 1000, LONGEST_NAME = 64 };

struct FrLmodel {
    FrLsystemParams params;
    GArray *values;  ///< FrLvalue, names owned
    GArray *numbers; ///< FrNumber, one for each
    FrMaterial *axes, *organs;
    GPtrArray *colours; ///< FrMaterial *
    FrLview *view;
    FrMaterial **palette; ///< by colour index; NULL
    FrLsystem *system;
    FrLsimple simple;
    FrEnvironment environment;
    void (*print)(void *user, const char *text);
    void *print_user;
};

const FrParamTable *fr_lsystem_table(void) {
    return &table;
}

static void value_clear(gpointer data) {
    FrLvalue *value = data;
    g_free((char *)value->name);
    fr_source_unref(value->span.source);
}

static void number_clear(gpointer data) {
    fr_number_clear(data);
}

static void material_unref(void *material) {
    fr_material_unref(material);
}

FrLmodel *fr_lmodel_new(const FrLsystemParams *params) {
    FrLmodel *model = g_new0(FrLmodel, 1);
    fr_params_copy(&table, &model->params, params);
    model->values = g_array_new(FALSE, FALSE, sizeof(FrLvalue));
    g_array_set_clear_func(model->values, value_clear);
    model->numbers = g_array_new(FALSE, FALSE, sizeof(FrNumber));
    g_array_set_clear_func(model->numbers, number_clear);
    model->colours = g_ptr_array_new_with_free_func(material_unref);
    float length = glms_vec3_norm(params->light);
    vec3s up = {{0, 0, 1}};
    model->simple = (FrLsimple){
        .intensity = (float)params->light_strength,
        .light = length > 0 ? glms_vec3_divs(params->light, length) : up,
        .obstacle = params->obstacle,
        .obstacle_radius = (float)params->obstacle_radius,
        .shade_height = (float)params->shade_height,
        .shade = (float)params->shade,
    };
    model->environment = fr_lsimple_environment(&model->simple);
    return model;
}

void fr_lmodel_free(FrLmodel *model) {
    if (model != NULL) {
        fr_lsystem_free(model->system);
        fr_lview_free(model->view);
        fr_lpalette_free(model->palette);
        fr_material_unref(model->axes);
        fr_material_unref(model->organs);
        g_ptr_array_unref(model->colours);
        g_array_unref(model->values);
        g_array_unref(model->numbers);
        fr_params_clear(&table, &model->params);
        g_free(model);
    }
}

static bool is_name(const char *name) {
    bool is_valid = g_ascii_isalpha(*name) || *name == '_';
    for (const char *at = name; *at != '\0'; at++) {
        is_valid &= g_ascii_isalnum(*at) || *at == '_';
    }
    return is_valid && strlen(name) <= LONGEST_NAME;
}

uint32_t fr_lmodel_find_value(const FrLmodel *model, const char *name) {
    for (guint i = 0; i < model->values->len; i++) {
        if (strcmp(g_array_index(model->values, FrLvalue, i).name, name) == 0) {
            return i;
        }
    }
    return FR_NONE;
}

bool fr_lmodel_define(FrLmodel *model, const char *name, const FrNumber *number, FrSpan span) {
    if (!is_name(name) || model->values->len >= MOST_VALUES ||
        fr_lmodel_find_value(model, name) != FR_NONE) {
        return false;
    }
    FrLvalue value = {g_strdup(name), 0, span};
    FrNumber copy = fr_number_copy(number);
    fr_source_ref(span.source);
    g_array_append_val(model->values, value);
    g_array_append_val(model->numbers, copy);
    return true;
}

void fr_lmodel_set_print(FrLmodel *model, void (*print)(void *user, const char *text), void *user) {
    model->print = print;
    model->print_user = user;
}

void fr_lmodel_set_materials(FrLmodel *model, FrMaterial *axes, FrMaterial *organs) {
    model->axes = axes == NULL ? NULL : fr_material_ref(axes);
    model->organs = organs == NULL ? NULL : fr_material_ref(organs);
}

void fr_lmodel_set_colours(FrLmodel *model, FrMaterial *const *materials, size_t count) {
    FR_ASSERT(count <= 255);
    g_ptr_array_set_size(model->colours, 0);
    for (size_t i = 0; i < count; i++) {
        g_ptr_array_add(model->colours, fr_material_ref(materials[i]));
    }
}

// ---- reading ----------------------------------------------------------------------------------

static FrSource *load(const char *name, const char *folder, FrSpan span, const FrContext *context,
                      char **own_folder, FrStatus *status) {
    FrSource *source = fr_source_load_beside(name, folder, span, context->limits.document_bytes,
                                             context->diags, status);
    *own_folder = source == NULL ? NULL : g_path_get_dirname(fr_source_name(source));
    return source;
}

/// The file beside that of the L-system with another extension; NULL if there is none.
static char *name_beside(const FrLsystemParams *params, const char *folder, const char *extension) {
    const char *file = params->file == NULL ? "" : params->file, *dot = strrchr(file, '.');
    if (*file == '\0') {
        return NULL;
    }
    bool has_extension = dot != NULL && dot != file && strchr(dot, '/') == NULL;
    size_t stem = has_extension ? (size_t)(dot - file) : strlen(file);
    char *name = g_strdup_printf("%.*s%s", (int)stem, file, extension);
    char *path = g_path_is_absolute(name) ? g_strdup(name) : g_build_filename(folder, name, NULL);
    if (!g_file_test(path, G_FILE_TEST_IS_REGULAR)) {
        g_clear_pointer(&name, g_free);
    }
    g_free(path);
    return name;
}

char *fr_lmodel_view_name(const FrLmodel *model, const char *folder) {
    const FrLsystemParams *params = &model->params;
    return params->view != NULL ? g_strdup(params->view) : name_beside(params, folder, ".v");
}

static FrStatus read_view(FrLmodel *model, const char *folder, FrSpan span,
                          const FrContext *context) {
    FrStatus status = FR_OK;
    char *name = fr_lmodel_view_name(model, folder), *own_folder = NULL;
    if (name != NULL) {
        FrSource *source = load(name, folder, span, context, &own_folder, &status);
        if (source != NULL) {
            status = fr_lview_read(source, own_folder, context, &model->view);
            fr_source_unref(source);
        }
    }
    g_free(own_folder);
    g_free(name);
    return status;
}

static FrStatus read_palette(FrLmodel *model, const char *folder, FrSpan span,
                             const FrContext *context) {
    FrStatus status = FR_OK;
    char *name = g_strdup(model->params.colour_map), *own_folder = NULL;
    name = name == NULL ? name_beside(&model->params, folder, ".mat") : name;
    name = name == NULL ? name_beside(&model->params, folder, ".map") : name;
    if (name != NULL) {
        FrSource *source = load(name, folder, span, context, &own_folder, &status);
        model->palette = source == NULL ? NULL : fr_lpalette_read(source, context->diags);
        status = source != NULL && model->palette == NULL ? FR_ERR_DOCUMENT : status;
        fr_source_unref(source);
    }
    g_free(own_folder);
    g_free(name);
    return status;
}

FrStatus fr_lmodel_compile(FrLmodel *model, FrSource *text, const char *folder, FrSpan span,
                           const FrContext *context) {
    FR_ASSERT(model->system == NULL && model->view == NULL);
    FrStatus seen = read_view(model, folder, span, context), status = FR_OK;
    FrStatus coloured = read_palette(model, folder, span, context);
    char *own_folder = NULL;
    FrSource *source = text != NULL
                           ? fr_source_ref(text)
                           : load(model->params.file, folder, span, context, &own_folder, &status);
    if (source != NULL) {
        FrLoptions options = {
            .notation = (FrLnotation)model->params.notation,
            .folder = own_folder != NULL ? own_folder : folder,
            .view = model->view,
            .round_brackets = model->params.brackets == 1,
            .values = (const FrLvalue *)(const void *)model->values->data,
            .value_count = model->values->len,
        };
        status = fr_lsystem_compile(source, &options, context, &model->system);
        fr_source_unref(source);
    }
    g_free(own_folder);
    return MAX(coloured, MAX(seen, status));
}

// ---- growing ----------------------------------------------------------------------------------

const FrLsystem *fr_lmodel_system(const FrLmodel *model) {
    return model->system;
}

const FrLsystemParams *fr_lmodel_params(const FrLmodel *model) {
    return &model->params;
}

size_t fr_lmodel_value_count(const FrLmodel *model) {
    return model->values->len;
}

const char *fr_lmodel_value_name(const FrLmodel *model, uint32_t value) {
    return g_array_index(model->values, FrLvalue, value).name;
}

void fr_lmodel_evaluate(const FrLmodel *model, FrKey key, double *values) {
    FrVars vars = {.key = key, .value[FR_VAR_n] = 1};
    for (guint i = 0; i < model->numbers->len; i++) {
        const FrNumber *number = &g_array_index(model->numbers, FrNumber, i);
        FrExprFault fault = {0}; // what has no value is 0
        values[i] = fr_number_eval(number, &vars, i, &fault);
    }
}

FrLsettings fr_lmodel_settings(const FrLmodel *model) {
    FrLsettings settings = fr_lsettings_default();
    settings.steps = model->params.steps;
    settings.view = model->view;
    settings.environment = &model->environment;
    settings.unit = model->params.unit;
    settings.axes = model->axes;
    settings.organs = model->organs;
    settings.colours = (FrMaterial *const *)(void *)model->colours->pdata;
    settings.colour_count = model->colours->len;
    settings.palette = model->palette;
    settings.print = model->print;
    settings.print_user = model->print_user;
    return settings;
}

FrStatus fr_lmodel_derive(const FrLmodel *model, const FrLsettings *settings,
                          const FrContext *context, FrLderivation **derivation) {
    FrLsettings own = *settings;
    double *values = g_new(double, model->values->len + 1);
    if (own.values == NULL) {
        fr_lmodel_evaluate(model, fr_key_root((uint64_t)MAX(own.seed, 0)), values);
        own.values = values;
    }
    FrStatus status = fr_lderivation_new(model->system, &own, context, derivation);
    g_free(values);
    return status;
}

FrStatus fr_lmodel_grow(const FrLmodel *model, const FrLsettings *settings,
                        const FrContext *context, FrPlant **plant, uint64_t *modules,
                        FrLdrawn *drawn) {
    *plant = NULL;
    FrLderivation *derivation;
    FrStatus status = fr_lmodel_derive(model, settings, context, &derivation);
    if (status != FR_OK) {
        return status;
    }
    status = fr_lderivation_run(derivation, fr_lderivation_length(derivation), context);
    if (status == FR_OK) {
        status = fr_lderivation_plant(derivation, context, plant, drawn);
    }
    if (status == FR_OK && modules != NULL) {
        *modules = fr_lstring_count(fr_lderivation_string(derivation));
    }
    fr_lderivation_free(derivation);
    return status;
}
