/// --nurbs: what `<nurbs>` says in a document, said on the command line.
#include "cli/cli.h"

#include <string.h>

bool cli_nurbs_set(FrNurbsParams *params, const char *text) {
    const char *equals = strchr(text, '=');
    char *name = g_strndup(text, equals != NULL ? (gsize)(equals - text) : strlen(text));
    const FrParam *param = fr_params_find(fr_nurbs_table(), name);
    bool is_right = equals != NULL && param != NULL;
    if (!is_right) {
        char *near = param == NULL ? fr_params_suggest(fr_nurbs_table(), name) : NULL;
        cli_message("--nurbs takes NAME=VALUE, like circle=nine, not '%s'%s%s%s", text,
                    near != NULL ? "; did you mean '" : "", near != NULL ? near : "",
                    near != NULL ? "'?" : "");
        g_free(near);
    } else {
        FrDiags *diags = fr_diags_new();
        is_right = fr_params_set(fr_nurbs_table(), params, param, equals + 1, (FrSpan){0}, NULL,
                                 diags) == FR_OK;
        if (!is_right && fr_diags_count(diags) > 0) {
            cli_message("%s", fr_diags_get(diags, 0)->text);
        }
        fr_diags_free(diags);
    }
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
