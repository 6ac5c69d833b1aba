#include "studio/model/settings.h"

#include <string.h>

static const char group[] = "Studio", recent[] = "recent";

struct StudioSettings {
    GKeyFile *values;
    char *file;
    bool is_changed;
};

char *studio_settings_file(void) {
    return g_build_filename(g_get_user_config_dir(), "frond", "studio.ini", NULL);
}

StudioSettings *studio_settings_new(const char *file) {
    StudioSettings *settings = g_new0(StudioSettings, 1);
    settings->values = g_key_file_new();
    settings->file = g_strdup(file);
    g_key_file_load_from_file(settings->values, file, G_KEY_FILE_KEEP_COMMENTS, NULL);
    return settings;
}

bool studio_settings_save(StudioSettings *settings) {
    if (!settings->is_changed) {
        return true;
    }
    char *folder = g_path_get_dirname(settings->file);
    g_mkdir_with_parents(folder, 0700);
    g_free(folder);
    settings->is_changed = !g_key_file_save_to_file(settings->values, settings->file, NULL);
    return !settings->is_changed;
}

void studio_settings_free(StudioSettings *settings) {
    if (settings != NULL) {
        studio_settings_save(settings);
        g_key_file_unref(settings->values);
        g_free(settings->file);
        g_free(settings);
    }
}

int studio_settings_int(const StudioSettings *settings, const char *name, int otherwise) {
    GError *error = NULL;
    int value = g_key_file_get_integer(settings->values, group, name, &error);
    bool is_there = error == NULL;
    g_clear_error(&error);
    return is_there ? value : otherwise;
}

void studio_settings_set_int(StudioSettings *settings, const char *name, int value) {
    if (studio_settings_int(settings, name, ~value) != value) {
        g_key_file_set_integer(settings->values, group, name, value);
        settings->is_changed = true;
    }
}

bool studio_settings_bool(const StudioSettings *settings, const char *name, bool otherwise) {
    return studio_settings_int(settings, name, otherwise) != 0;
}

void studio_settings_set_bool(StudioSettings *settings, const char *name, bool value) {
    studio_settings_set_int(settings, name, value);
}

char **studio_settings_recent(const StudioSettings *settings) {
    char **all = g_key_file_get_string_list(settings->values, group, recent, NULL, NULL);
    GPtrArray *there = g_ptr_array_new();
    for (char **path = all; path != NULL && *path != NULL; path++) {
        if (there->len < STUDIO_MOST_RECENT && g_file_test(*path, G_FILE_TEST_IS_REGULAR)) {
            g_ptr_array_add(there, g_strdup(*path));
        }
    }
    g_ptr_array_add(there, NULL);
    g_strfreev(all);
    return (char **)g_ptr_array_free(there, FALSE);
}

void studio_settings_add_recent(StudioSettings *settings, const char *path) {
    char **old = studio_settings_recent(settings);
    GPtrArray *list = g_ptr_array_new();
    g_ptr_array_add(list, (char *)path);
    for (char **other = old; *other != NULL; other++) {
        if (strcmp(*other, path) != 0 && list->len < STUDIO_MOST_RECENT) {
            g_ptr_array_add(list, *other);
        }
    }
    g_key_file_set_string_list(settings->values, group, recent, (const char *const *)list->pdata,
                               list->len);
    settings->is_changed = true;
    g_ptr_array_unref(list);
    g_strfreev(old);
}
