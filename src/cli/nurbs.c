/// --nurbs: what `<nurbs>` says in a document, said on the command line.
#include "cli/cli.h"

#include <string.h>

/// The nearest name, or all there are.
static void say_unknown(const char *name) {
    const FrParamTable *table = fr_nurbs_table();
    char *near = fr_params_suggest(table, name);
    GString *hint = g_string_new(NULL);
    for (size_t i = 0; near == NULL && i < table->count; i++) {
        char *attribute = fr_param_attribute(&table->rows[i]);
        g_string_append_printf(hint, "%s%s", i > 0 ? ", " : "there are ", attribute);
        g_free(attribute);
    }
    if (near != NULL) {
        g_string_printf(hint, "did you mean '%s'?", near);
    }
    cli_message("--nurbs has no setting '%s'; %s", name, hint->str);
    g_string_free(hint, TRUE);
    g_free(near);
}

bool cli_nurbs_set(FrNurbsParams *params, const char *text) {
    const char *equals = strchr(text, '=');
    if (equals == NULL) {
        cli_message("--nurbs takes NAME=VALUE, like circle=nine, not '%s'", text);
        return false;
    }
    char *name = g_strndup(text, (gsize)(equals - text));
    const FrParam *param = fr_params_find(fr_nurbs_table(), name);
    FrDiags *diags = fr_diags_new();
    bool is_right = param != NULL && fr_params_set(fr_nurbs_table(), params, param, equals + 1,
                                                   (FrSpan){0}, NULL, diags) == FR_OK;
    if (param == NULL) {
        say_unknown(name);
    } else if (!is_right && fr_diags_count(diags) > 0) {
        cli_message("--nurbs %s: %s", name, fr_diags_get(diags, 0)->text);
    }
    fr_diags_free(diags);
    g_free(name);
    return is_right;
}

void cli_nurbs_apply(const CliOptions *options, FrScene *scene, FrNurbsParams *plain) {
    uint32_t plants = options->nurbs->len > 0 ? fr_scene_plant_count(scene) : 0;
    for (guint i = 0; i < options->nurbs->len; i++) {
        cli_nurbs_set(plain, g_ptr_array_index(options->nurbs, i));
    }
    for (uint32_t p = 0; p < plants; p++) {
        FrScenePlant *plant = &g_array_index(scene->plants, FrScenePlant, p);
        plant->nurbs = plant->has_nurbs ? plant->nurbs : fr_nurbs_default();
        plant->has_nurbs = true;
        for (guint i = 0; i < options->nurbs->len; i++) {
            cli_nurbs_set(&plant->nurbs, g_ptr_array_index(options->nurbs, i));
        }
    }
}
