#include "studio/model/carry.h"

#include "studio/model/companions.h"
#include "studio/model/file_copy.h"

#include <glib/gstdio.h>
#include <string.h>

enum { MEBIBYTE = 1 << 20, MOST_FILES = 200, LONGEST_NAME = 200, MOST_NUMBERS = 1000 };

static const size_t most_bytes = (size_t)64 * MEBIBYTE;   // of a file
static const size_t most_in_all = (size_t)256 * MEBIBYTE; // of all

// Attributes that name files.
static const char *const rows[] = {"picture",      "normal-map",    "roughness-map", "file",
                                   "density-file", "envelope-file", "view",          "colour-map"};

// A file that is copied, with those that it names itself.
typedef struct Bundle {
    GPtrArray *names; // char *: the file's own first, then relative to its folder
    GPtrArray *bytes; // GBytes *, of each
} Bundle;

typedef struct Carrier {
    const StudioCarry *how;
    StudioCarried *carried;
    GHashTable *taken; // name → new name
    guint files;
    size_t bytes;
} Carrier;

// ---- what is named -----------------------------------------------------------------------------

static bool is_wanted(const FrContents *contents, uint32_t element, GHashTable *wanted) {
    bool is_it = wanted == NULL;
    for (uint32_t at = element; !is_it && at != FR_NONE;
         at = fr_contents_at(contents, at)->parent) {
        is_it = g_hash_table_contains(wanted, GUINT_TO_POINTER(at));
    }
    return is_it;
}

// The file that an attribute names; NULL: none. Free with g_free().
static char *named(const FrContents *contents, uint32_t element, const char *attribute) {
    const FrParamTable *table = fr_contents_at(contents, element)->table;
    char *row = g_strdelimit(g_strdup(attribute), "-", '_');
    const FrParam *param = table == NULL ? NULL : fr_params_find(table, row);
    char *value = param != NULL && param->kind == FR_PARAM_TEXT
                      ? fr_contents_get(contents, element, attribute)
                      : NULL;
    g_free(row);
    if (value != NULL && *value == '\0') {
        g_clear_pointer(&value, g_free);
    }
    return value;
}

GPtrArray *studio_named_files(const FrContents *contents) {
    GPtrArray *names = g_ptr_array_new_with_free_func(g_free);
    for (uint32_t i = 0; i < fr_contents_count(contents); i++) {
        for (size_t r = 0; r < G_N_ELEMENTS(rows); r++) {
            char *name = named(contents, i, rows[r]);
            if (name != NULL) {
                g_ptr_array_add(names, name);
            }
        }
    }
    return names;
}

bool studio_names_files(const FrContents *contents, GHashTable *wanted) {
    bool is_any = false;
    for (uint32_t i = 0; i < fr_contents_count(contents) && !is_any; i++) {
        for (size_t r = 0; r < G_N_ELEMENTS(rows) && !is_any; r++) {
            char *name = is_wanted(contents, i, wanted) ? named(contents, i, rows[r]) : NULL;
            is_any = name != NULL;
            g_free(name);
        }
    }
    return is_any;
}

static void unref_bytes(gpointer bytes) {
    g_bytes_unref(bytes);
}

static Bundle new_bundle(void) {
    return (Bundle){g_ptr_array_new_with_free_func(g_free),
                    g_ptr_array_new_with_free_func(unref_bytes)};
}

static void free_bundle(Bundle *bundle) {
    g_ptr_array_unref(bundle->names);
    g_ptr_array_unref(bundle->bytes);
}

// ---- reading -----------------------------------------------------------------------------------

static void refuse(Carrier *carrier, const char *name, const char *why) {
    if (carrier->carried->refusal == NULL) {
        carrier->carried->refusal = g_strdup_printf("The file %s %s", name, why);
    }
}

// Reads one of a bundle. What a mesh names and is not there is left out: the mesh does without.
static bool read_file(Carrier *carrier, Bundle *bundle, const char *folder, const char *name,
                      bool is_inside) {
    bool is_companion = bundle->names->len > 0;
    const char *why = NULL;
    GBytes *bytes = studio_file_read(folder, name, is_inside, most_bytes, &why);
    carrier->files++;
    carrier->bytes += bytes == NULL ? 0 : g_bytes_get_size(bytes);
    if (carrier->files > MOST_FILES || carrier->bytes > most_in_all) {
        g_clear_pointer(&bytes, g_bytes_unref);
        why = carrier->files > MOST_FILES ? "is one of too many" : "makes them too large in all";
        is_companion = false;
    }
    if (bytes == NULL) {
        if (!is_companion) {
            refuse(carrier, name, why);
        }
        return is_companion;
    }
    g_ptr_array_add(bundle->names, g_strdup(name));
    g_ptr_array_add(bundle->bytes, bytes);
    return true;
}

// A file and all that it names, which must lie beside or beneath it.
static bool read_bundle(Carrier *carrier, const char *name, Bundle *bundle) {
    const StudioCarry *how = carrier->how;
    if (!read_file(carrier, bundle, how->from, name, how->is_inside)) {
        return false;
    }
    char *path =
        g_path_is_absolute(name) ? g_strdup(name) : g_build_filename(how->from, name, NULL);
    char *folder = g_path_get_dirname(path);
    GPtrArray *companions = g_ptr_array_new_with_free_func(g_free);
    studio_add_companions(name, g_ptr_array_index(bundle->bytes, 0), companions);
    bool is_read = true;
    for (guint i = 0; i < companions->len && is_read; i++) {
        const char *companion = g_ptr_array_index(companions, i);
        guint before = bundle->names->len;
        is_read = !studio_name_is_inside(companion) ||
                  read_file(carrier, bundle, folder, companion, how->is_inside);
        if (is_read && bundle->names->len > before) { // the list grows while it is gone through
            studio_add_companions(companion, g_ptr_array_index(bundle->bytes, before), companions);
        }
    }
    g_ptr_array_unref(companions);
    g_free(folder);
    g_free(path);
    return is_read;
}

// ---- writing -----------------------------------------------------------------------------------

// The last part of a name, without what a file's name should not have.
static char *plain_name(const char *name) {
    char *plain = g_path_get_basename(name);
    for (char *at = plain; *at != '\0'; at++) {
        bool is_odd = g_ascii_iscntrl(*at) || *at == '/' || *at == '\\' ||
                      (at == plain && (*at == '.' || *at == '-'));
        *at = is_odd ? '_' : *at;
    }
    return plain;
}

// "bark.png" with a number: "bark-2.png". Free with g_free().
static char *numbered(const char *plain, int number, bool has_ending) {
    const char *dot = has_ending ? strrchr(plain, '.') : NULL;
    size_t stem = dot == NULL ? strlen(plain) : (size_t)(dot - plain);
    return number == 1 ? g_strdup(plain)
                       : g_strdup_printf("%.*s-%d%s", (int)stem, plain, number, plain + stem);
}

static bool create(Carrier *carrier, const char *path, GBytes *bytes) {
    bool is_there = studio_file_create(path, bytes);
    if (is_there) {
        g_ptr_array_add(carrier->carried->made, g_strdup(path));
    }
    return is_there;
}

// Writes a file on its own; its new name, or NULL.
static char *write_alone(Carrier *carrier, const Bundle *bundle, const char *plain) {
    GBytes *bytes = g_ptr_array_index(bundle->bytes, 0);
    StudioTarget state = STUDIO_TARGET_OTHER;
    char *name = NULL;
    for (int number = 1; state == STUDIO_TARGET_OTHER && number <= MOST_NUMBERS; number++) {
        g_free(name);
        name = numbered(plain, number, true);
        char *path = g_build_filename(carrier->how->to, name, NULL);
        state = studio_target_state(path, bytes);
        if (state == STUDIO_TARGET_FREE && !create(carrier, path, bytes)) {
            state = STUDIO_TARGET_OTHER;
            number = MOST_NUMBERS;
        }
        g_free(path);
    }
    if (state == STUDIO_TARGET_OTHER) {
        g_clear_pointer(&name, g_free);
    }
    return name;
}

// What a file of a bundle is called within the bundle's folder. Free with g_free().
static char *name_within(const Bundle *bundle, guint index, const char *plain) {
    return g_strdup(index == 0 ? plain : g_ptr_array_index(bundle->names, index));
}

static bool is_same_bundle(const Bundle *bundle, const char *folder, const char *plain) {
    bool is_same = !g_file_test(folder, G_FILE_TEST_IS_SYMLINK);
    for (guint i = 0; i < bundle->names->len && is_same; i++) {
        char *name = name_within(bundle, i, plain);
        const char *why;
        GBytes *bytes = studio_file_read(folder, name, true, most_bytes, &why);
        is_same = bytes != NULL && g_bytes_equal(bytes, g_ptr_array_index(bundle->bytes, i));
        g_clear_pointer(&bytes, g_bytes_unref);
        g_free(name);
    }
    return is_same;
}

// Makes the folders on the way to a file in a folder that is new.
static void make_way(Carrier *carrier, const char *folder, const char *name) {
    char **parts = g_strsplit(name, "/", -1);
    char *at = g_strdup(folder);
    for (char **part = parts; part[0] != NULL && part[1] != NULL; part++) {
        char *next = g_build_filename(at, *part, NULL);
        if (g_mkdir(next, 0777) == 0) {
            g_ptr_array_add(carrier->carried->made, g_strdup(next));
        }
        g_free(at);
        at = next;
    }
    g_free(at);
    g_strfreev(parts);
}

static bool fill_folder(Carrier *carrier, const Bundle *bundle, const char *folder,
                        const char *plain) {
    bool is_written = true;
    for (guint i = 0; i < bundle->names->len && is_written; i++) {
        char *name = name_within(bundle, i, plain);
        char *path = g_build_filename(folder, name, NULL);
        GBytes *bytes = g_ptr_array_index(bundle->bytes, i);
        make_way(carrier, folder, name);
        is_written = create(carrier, path, bytes) ||
                     studio_target_state(path, bytes) == STUDIO_TARGET_SAME; // named twice
        g_free(path);
        g_free(name);
    }
    return is_written;
}

// Writes a file with those that it names into a folder of their own; its new name, or NULL.
static char *write_together(Carrier *carrier, const Bundle *bundle, const char *plain) {
    const char *dot = strrchr(plain, '.');
    char *stem = g_strndup(plain, dot == NULL ? strlen(plain) : (size_t)(dot - plain));
    char *name = NULL;
    bool is_over = false;
    for (int number = 1; !is_over && number <= MOST_NUMBERS; number++) {
        char *folder = numbered(stem, number, false);
        char *path = g_build_filename(carrier->how->to, folder, NULL);
        bool is_new = g_mkdir(path, 0777) == 0;
        if (is_new) {
            g_ptr_array_add(carrier->carried->made, g_strdup(path));
        }
        bool is_there = is_new ? fill_folder(carrier, bundle, path, plain)
                               : is_same_bundle(bundle, path, plain);
        name = is_there ? g_build_filename(folder, plain, NULL) : NULL;
        is_over = is_new || is_there;
        g_free(path);
        g_free(folder);
    }
    g_free(stem);
    return name;
}

// ---- all of it ---------------------------------------------------------------------------------

// The new name of a file; NULL after a refusal. Owned by the carrier.
static const char *carry(Carrier *carrier, const char *name) {
    char *known = g_hash_table_lookup(carrier->taken, name);
    if (known != NULL) {
        return known;
    }
    char *plain = plain_name(name), *own = NULL;
    Bundle bundle = new_bundle();
    if (strlen(plain) > LONGEST_NAME) {
        refuse(carrier, plain, "has too long a name");
    } else if (read_bundle(carrier, name, &bundle)) {
        own = bundle.names->len == 1 ? write_alone(carrier, &bundle, plain)
                                     : write_together(carrier, &bundle, plain);
        if (own == NULL) {
            refuse(carrier, name, "cannot be copied");
        }
    }
    char *whole = own == NULL ? NULL : g_strconcat(carrier->how->prefix, own, NULL);
    if (whole != NULL) {
        g_hash_table_insert(carrier->taken, g_strdup(name), whole);
    }
    free_bundle(&bundle);
    g_free(own);
    g_free(plain);
    return whole;
}

// L-systems name files in ways that are not followed here.
static bool is_followed(const FrContents *contents, uint32_t element) {
    return strcmp(fr_contents_at(contents, element)->name, "lsystem") != 0;
}

static void carry_element(Carrier *carrier, const FrContents *contents, uint32_t element,
                          GArray *splices) {
    for (size_t r = 0; r < G_N_ELEMENTS(rows) && carrier->carried->refusal == NULL; r++) {
        char *name = named(contents, element, rows[r]);
        if (name != NULL && !is_followed(contents, element)) {
            refuse(carrier, name, "is of an L-system, which may need others");
        } else if (name != NULL) {
            const char *other = carry(carrier, name);
            if (other != NULL && strcmp(other, name) != 0) {
                FrSplice splice = fr_contents_set(contents, element, rows[r], other);
                g_array_append_val(splices, splice);
            }
        }
        g_free(name);
    }
}

StudioCarried studio_carry(const FrContents *contents, const StudioCarry *how) {
    StudioCarried carried = {NULL, NULL, g_ptr_array_new_with_free_func(g_free)};
    Carrier carrier = {how, &carried,
                       g_hash_table_new_full(g_str_hash, g_str_equal, g_free, g_free), 0, 0};
    GArray *splices = g_array_new(FALSE, FALSE, sizeof(FrSplice));
    for (uint32_t i = 0; i < fr_contents_count(contents); i++) {
        if (is_wanted(contents, i, how->wanted)) {
            carry_element(&carrier, contents, i, splices);
        }
    }
    size_t size;
    char *text = fr_contents_apply(contents, splices, &size);
    if (carried.refusal == NULL) {
        carried.source = fr_source_new(fr_source_name(fr_contents_source(contents)), text, size);
    } else {
        studio_carried_undo(&carried);
    }
    g_free(text);
    g_array_unref(splices);
    g_hash_table_unref(carrier.taken);
    return carried;
}

// Puts a file and what it names where they are looked for; false if something else is there.
static bool put_beneath(Carrier *carrier, const Bundle *bundle) {
    const char *first = g_ptr_array_index(bundle->names, 0);
    char *beside = g_path_get_dirname(first);
    bool is_put = true;
    for (guint i = 0; i < bundle->names->len && is_put; i++) {
        char *name = i == 0 ? g_strdup(first)
                            : g_build_filename(beside, g_ptr_array_index(bundle->names, i), NULL);
        char *path = g_build_filename(carrier->how->to, name, NULL);
        GBytes *bytes = g_ptr_array_index(bundle->bytes, i);
        StudioTarget state = studio_target_state(path, bytes);
        if (state == STUDIO_TARGET_FREE) {
            make_way(carrier, carrier->how->to, name);
            is_put = create(carrier, path, bytes);
        } else {
            is_put = state == STUDIO_TARGET_SAME;
        }
        g_free(path);
        g_free(name);
    }
    g_free(beside);
    return is_put;
}

char *studio_carry_along(const FrContents *contents, const char *from, const char *to,
                         GPtrArray *made) {
    StudioCarried carried = {NULL, NULL, made};
    StudioCarry how = {.from = from, .to = to, .prefix = ""};
    Carrier carrier = {&how, &carried, NULL, 0, 0};
    GPtrArray *names = studio_named_files(contents);
    char *left = NULL;
    for (guint i = 0; i < names->len; i++) {
        const char *name = g_ptr_array_index(names, i);
        Bundle bundle = new_bundle();
        bool is_put = studio_name_is_inside(name) && read_bundle(&carrier, name, &bundle) &&
                      put_beneath(&carrier, &bundle);
        left = is_put || left != NULL ? left : g_strdup(name);
        free_bundle(&bundle);
    }
    g_ptr_array_unref(names);
    g_free(carried.refusal);
    return left;
}

void studio_remove_made(GPtrArray *made) {
    for (guint i = made->len; i-- > 0;) {
        const char *path = g_ptr_array_index(made, i);
        if (g_unlink(path) != 0) {
            g_rmdir(path);
        }
    }
    g_ptr_array_set_size(made, 0);
}

void studio_carried_undo(StudioCarried *carried) {
    studio_remove_made(carried->made);
}

void studio_carried_clear(StudioCarried *carried) {
    fr_source_unref(carried->source);
    g_free(carried->refusal);
    g_ptr_array_unref(carried->made);
    *carried = (StudioCarried){0};
}
