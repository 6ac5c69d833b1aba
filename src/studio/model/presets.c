#include "studio/model/presets.h"

#include "frond/document.h"
#include "frond/presets.h"
#include "frond/render.h"
#include "studio/model/carry.h"

#include <glib/gstdio.h>
#include <string.h>

static const char ending[] = ".frond";
static const char picture[] = ".png";

enum {
    PICTURE_WIDTH = 240,
    PICTURE_HEIGHT = 300,
    PICTURE_SAMPLES = 8,
    LONGEST_NAME = 80,
    MOST_FOLDERS = 1000
};

const char *studio_presets_name_refusal(const char *name) {
    if (*name == '\0') {
        return "Give it a name";
    }
    if (strlen(name) > LONGEST_NAME || !g_utf8_validate(name, -1, NULL)) {
        return "The name is too long";
    }
    for (const char *at = name; *at != '\0'; at++) {
        if (*at == '/' || g_ascii_iscntrl(*at)) {
            return "A name has no slashes";
        }
    }
    bool is_odd = *name == '.' || *name == '-' || g_ascii_isspace(*name) ||
                  g_ascii_isspace(name[strlen(name) - 1]);
    return is_odd ? "A name begins with a letter or digit" : NULL;
}

char *studio_presets_problem(const char *file) {
    FrContext context = fr_context_default();
    context.diags = fr_diags_new();
    FrDocument *document;
    char *problem = NULL;
    if (fr_document_load(file, &context, &document) != FR_OK) {
        for (size_t i = 0; i < fr_diags_count(context.diags) && problem == NULL; i++) {
            const FrDiag *diag = fr_diags_get(context.diags, i);
            uint32_t line, column;
            if (diag->severity == FR_ERROR && diag->span.source != NULL) {
                fr_source_position(diag->span.source, diag->span.begin, &line, &column);
                problem = g_strdup_printf("line %u: %s", line, diag->text);
            } else if (diag->severity == FR_ERROR) {
                problem = g_strdup(diag->text);
            }
        }
    }
    fr_document_free(document);
    fr_diags_free(context.diags);
    return problem;
}

// ---- files beside them -------------------------------------------------------------------------

static const char beside_ending[] = ".files";

// The contents of a text; NULL: it has none that can be read.
static FrContents *contents_of(const char *text, size_t size, const char *name) {
    FrSource *source = fr_source_new(name, text, size);
    FrContext context = fr_context_default();
    FrContents *contents;
    if (fr_contents_read(source, &context, &contents) != FR_OK) {
        contents = NULL;
    }
    fr_source_unref(source);
    return contents;
}

// Names of the folders within the presets' that a preset has files in. A name with parts is not one
// of ours.
static GPtrArray *folders_of(const char *folder, const char *name) {
    char *file = fr_presets_file(folder, name, ending), *text = NULL;
    gsize size = 0;
    FrContents *contents =
        g_file_get_contents(file, &text, &size, NULL) ? contents_of(text, size, name) : NULL;
    GPtrArray *folders = g_ptr_array_new_with_free_func(g_free);
    GPtrArray *named = contents == NULL ? NULL : studio_named_files(contents);
    for (guint i = 0; named != NULL && i < named->len; i++) {
        const char *path = g_ptr_array_index(named, i), *slash = strchr(path, '/');
        char *first = g_strndup(path, slash == NULL ? 0 : (size_t)(slash - path));
        if (g_str_has_suffix(first, beside_ending) && *first != '.' &&
            !g_ptr_array_find_with_equal_func(folders, first, g_str_equal, NULL)) {
            g_ptr_array_add(folders, g_strdup(first));
        }
        g_free(first);
    }
    g_clear_pointer(&named, g_ptr_array_unref);
    fr_contents_free(contents);
    g_free(text);
    g_free(file);
    return folders;
}

// Removes a folder with all in it; a link is removed, and what it leads to stays.
static void remove_tree(const char *path) {
    GDir *directory = g_file_test(path, G_FILE_TEST_IS_SYMLINK) ? NULL : g_dir_open(path, 0, NULL);
    const char *name;
    while (directory != NULL && (name = g_dir_read_name(directory)) != NULL) {
        char *within = g_build_filename(path, name, NULL);
        remove_tree(within);
        g_free(within);
    }
    if (directory != NULL) {
        g_dir_close(directory);
        g_rmdir(path);
    } else {
        g_unlink(path);
    }
}

// Removes folders that no preset has files in.
static void drop_folders(const char *folder, GPtrArray *folders) {
    GPtrArray *names = fr_presets_list(folder);
    for (guint i = 0; i < names->len && folders->len > 0; i++) {
        GPtrArray *others = folders_of(folder, g_ptr_array_index(names, i));
        for (guint k = folders->len; k-- > 0;) {
            if (g_ptr_array_find_with_equal_func(others, g_ptr_array_index(folders, k), g_str_equal,
                                                 NULL)) {
                g_ptr_array_remove_index(folders, k);
            }
        }
        g_ptr_array_unref(others);
    }
    for (guint k = 0; k < folders->len; k++) {
        char *path = g_build_filename(folder, g_ptr_array_index(folders, k), NULL);
        remove_tree(path);
        g_free(path);
    }
    g_ptr_array_unref(names);
}

// A folder for the files of a preset, which is new: its name, to be freed with g_free(); NULL: it
// cannot be made.
static char *new_folder(const char *folder, const char *name, GPtrArray *made) {
    char *own = NULL;
    for (int number = 1; own == NULL && number <= MOST_FOLDERS; number++) {
        char *other = number == 1 ? g_strconcat(name, beside_ending, NULL)
                                  : g_strdup_printf("%s-%d%s", name, number, beside_ending);
        char *path = g_build_filename(folder, other, NULL);
        if (g_mkdir(path, 0777) == 0) {
            own = g_strdup(other);
            g_ptr_array_insert(made, 0, g_strdup(path));
        }
        g_free(path);
        g_free(other);
    }
    return own;
}

// Copies the files that a text names; its new text is in the result.
static StudioCarried take_files(const char *folder, const char *name, const FrContents *contents,
                                const char *beside) {
    GPtrArray *made = g_ptr_array_new_with_free_func(g_free);
    char *own = new_folder(folder, name, made);
    char *to = own == NULL ? NULL : g_build_filename(folder, own, NULL);
    char *prefix = own == NULL ? NULL : g_strconcat(own, "/", NULL);
    StudioCarried carried = {NULL, NULL, made};
    if (own == NULL) {
        carried.refusal = g_strdup("There is no room for its files");
    } else {
        carried =
            studio_carry(contents, &(StudioCarry){.from = beside, .to = to, .prefix = prefix});
        g_ptr_array_extend_and_steal(made, carried.made);
        carried.made = made;
        if (carried.source == NULL) {
            studio_carried_undo(&carried);
        }
    }
    g_free(prefix);
    g_free(to);
    g_free(own);
    return carried;
}

// ---- keeping -----------------------------------------------------------------------------------

// Whether a text is a document without errors where its files are.
static FrStatus check(const char *name, const char *text, const char *folder, FrDiags *diags) {
    FrContext context = fr_context_default();
    context.diags = diags;
    FrSource *source = fr_source_new(name, text, strlen(text));
    FrDocument *document;
    FrStatus status = fr_document_parse(source, folder, &context, &document);
    fr_document_free(document);
    fr_source_unref(source);
    return status;
}

// Writes the text of a preset; what was beside the one in whose place it comes goes.
static FrStatus write_preset(const char *folder, const char *name, FrSource *source,
                             FrDiags *diags) {
    size_t size;
    const char *text = fr_source_text(source, &size);
    GPtrArray *before = folders_of(folder, name);
    char *file = fr_presets_file(folder, name, ending);
    char *old = fr_presets_file(folder, name, picture);
    FrStatus status = fr_contents_save(text, size, file, diags);
    if (status == FR_OK) {
        g_unlink(old); // it shows what was called so before
        drop_folders(folder, before);
    }
    g_free(old);
    g_free(file);
    g_ptr_array_unref(before);
    return status;
}

FrStatus studio_presets_save(const char *folder, const char *name, const char *text,
                             const char *beside, FrDiags *diags) {
    FrStatus status = check(name, text, beside, diags);
    if (status != FR_OK) {
        return status;
    }
    FrContents *contents = contents_of(text, strlen(text), name);
    g_mkdir_with_parents(folder, 0777);
    StudioCarried carried = {fr_source_new(name, text, strlen(text)), NULL,
                             g_ptr_array_new_with_free_func(g_free)};
    if (contents != NULL && studio_names_files(contents, NULL)) {
        studio_carried_clear(&carried);
        carried = take_files(folder, name, contents, beside);
    }
    if (carried.source == NULL) {
        fr_diags_add(diags, FR_ERROR, "file", (FrSpan){0}, "%s", carried.refusal);
        status = FR_ERR_DOCUMENT;
    } else {
        status = write_preset(folder, name, carried.source, diags);
    }
    if (status != FR_OK) {
        studio_carried_undo(&carried);
    }
    studio_carried_clear(&carried);
    fr_contents_free(contents);
    return status;
}

static bool is_there(const char *folder, const char *name) {
    char *file = fr_presets_file(folder, name, ending);
    bool is_it = g_file_test(file, G_FILE_TEST_EXISTS);
    g_free(file);
    return is_it;
}

bool studio_presets_rename(const char *folder, const char *name, const char *to) {
    if (studio_presets_name_refusal(to) != NULL || is_there(folder, to)) {
        return false;
    }
    static const char *const endings[] = {picture, ending}; // the picture has no place of its own
    bool is_renamed = is_there(folder, name);
    for (int i = 0; is_renamed && i < 2; i++) {
        char *from = fr_presets_file(folder, name, endings[i]);
        char *into = fr_presets_file(folder, to, endings[i]);
        is_renamed = g_rename(from, into) == 0 || endings[i] == picture;
        g_free(into);
        g_free(from);
    }
    return is_renamed;
}

bool studio_presets_remove(const char *folder, const char *name) {
    char *file = fr_presets_file(folder, name, ending);
    char *drawn = fr_presets_file(folder, name, picture);
    GPtrArray *folders = folders_of(folder, name);
    bool is_removed = g_unlink(file) == 0;
    if (is_removed) {
        g_unlink(drawn);
        drop_folders(folder, folders);
    }
    g_ptr_array_unref(folders);
    g_free(drawn);
    g_free(file);
    return is_removed;
}

// ---- its picture -------------------------------------------------------------------------------

static FrStatus draw(const FrScene *scene, const FrContext *context, FrImage **image) {
    FrRenderParams params;
    fr_params_init(fr_render_table(), &params);
    params.width = PICTURE_WIDTH;
    params.height = PICTURE_HEIGHT;
    params.samples = PICTURE_SAMPLES;
    FrSkinParams skin = fr_skin_default();
    FrStatus status = fr_render(scene, &params, &skin, context, image);
    fr_params_clear(fr_render_table(), &params);
    return status;
}

FrStatus studio_presets_draw(const char *folder, const char *name, const FrContext *context) {
    char *file = fr_presets_file(folder, name, ending);
    char *drawn = fr_presets_file(folder, name, picture);
    FrDocument *document;
    FrScene *scene = NULL;
    FrImage *image = NULL;
    FrStatus status = fr_document_load(file, context, &document);
    status = status == FR_OK ? fr_scene_build(document, -1, context, &scene) : status;
    status = status == FR_OK ? draw(scene, context, &image) : status;
    if (status == FR_OK) {
        GBytes *png = fr_image_to_png(image);
        gsize size;
        const char *bytes = g_bytes_get_data(png, &size);
        bool is_written = g_file_set_contents(drawn, bytes, (gssize)size, NULL);
        status = is_written ? FR_OK : FR_ERR_MACHINE;
        g_bytes_unref(png);
        fr_image_unref(image);
    }
    fr_scene_free(scene);
    fr_document_free(document);
    g_free(drawn);
    g_free(file);
    return status;
}
