#include "scenes.h"

#include <errno.h>
#include <sys/stat.h>
#include <unistd.h>

static bool write_new(void *user, int descriptor) {
    const char *text = user;
    return write(descriptor, text, strlen(text)) == (ssize_t)strlen(text);
}

static bool write_half(void *user, int descriptor) {
    ssize_t written = write(descriptor, "half", 4);
    errno = *(int *)user;
    return written < 0;
}

static void assert_file(const char *folder, const char *name, const char *text) {
    char *bytes = file_bytes(folder, name, NULL);
    g_assert_cmpstr(bytes, ==, text);
    g_free(bytes);
}

static void assert_names(const char *folder, const char *wanted) {
    char *names = folder_names(folder);
    g_assert_cmpstr(names, ==, wanted);
    g_free(names);
}

static void new_and_old(void) {
    char *folder = folder_new();
    char *path = g_build_filename(folder, "a.txt", NULL);
    g_assert_cmpint(fr_io_replace_file(path, write_new, "first", NULL), ==, FR_OK);
    assert_file(folder, "a.txt", "first");
    g_assert_cmpint(fr_io_replace_file(path, write_new, "second", NULL), ==, FR_OK);
    assert_file(folder, "a.txt", "second");
    assert_names(folder, "a.txt");
    g_free(path);
    remove_folder(folder);
}

static void failure(void) {
    char *folder = folder_new();
    char *path = g_build_filename(folder, "a.txt", NULL);
    char *other = g_build_filename(folder, "b.txt", NULL);
    int full = ENOSPC;
    int stopped = ECANCELED;
    FrDiags *diags = fr_diags_new();
    g_assert_cmpint(fr_io_replace_file(path, write_new, "old", diags), ==, FR_OK);
    g_assert_cmpint(fr_io_replace_file(path, write_half, &full, diags), ==, FR_ERR_MACHINE);
    g_assert_cmpint(fr_io_replace_file(other, write_half, &full, diags), ==, FR_ERR_MACHINE);
    g_assert_cmpuint(fr_diags_error_count(diags), ==, 2);
    g_assert_cmpstr(fr_diags_get(diags, 0)->code, ==, "cannot-write");
    g_assert_nonnull(strstr(fr_diags_get(diags, 0)->text, "a.txt"));
    // Stopping is no error.
    g_assert_cmpint(fr_io_replace_file(path, write_half, &stopped, diags), ==, FR_CANCELLED);
    g_assert_cmpuint(fr_diags_error_count(diags), ==, 2);
    assert_file(folder, "a.txt", "old");
    assert_names(folder, "a.txt");
    fr_diags_free(diags);
    g_free(other);
    g_free(path);
    remove_folder(folder);
}

static void impossible_places(void) {
    char *folder = folder_new();
    char *nowhere = g_build_filename(folder, "none", "a.txt", NULL);
    FrDiags *diags = fr_diags_new();
    g_assert_cmpint(fr_io_replace_file(nowhere, write_new, "x", diags), ==, FR_ERR_MACHINE);
    g_assert_cmpint(fr_io_replace_file(folder, write_new, "x", diags), ==, FR_ERR_MACHINE);
    g_assert_cmpuint(fr_diags_error_count(diags), ==, 2);
    assert_names(folder, "");
    fr_diags_free(diags);
    g_free(nowhere);
    remove_folder(folder);
}

static void links_and_permissions(void) {
    char *folder = folder_new();
    char *path = g_build_filename(folder, "real.txt", NULL);
    char *link_path = g_build_filename(folder, "link.txt", NULL);
    g_assert_cmpint(fr_io_replace_file(path, write_new, "old", NULL), ==, FR_OK);
    g_assert_cmpint(chmod(path, 0640), ==, 0);
    g_assert_cmpint(symlink("real.txt", link_path), ==, 0);
    g_assert_cmpint(fr_io_replace_file(link_path, write_new, "new", NULL), ==, FR_OK);
    assert_file(folder, "real.txt", "new");
    g_assert_true(g_file_test(link_path, G_FILE_TEST_IS_SYMLINK));
    struct stat now;
    g_assert_cmpint(stat(path, &now), ==, 0);
    g_assert_cmpuint(now.st_mode & 07777, ==, 0640);
    g_free(link_path);
    g_free(path);
    remove_folder(folder);
}

static void devices(void) {
    g_assert_cmpint(fr_io_replace_file("/dev/null", write_new, "x", NULL), ==, FR_OK);
    struct stat now;
    g_assert_cmpint(stat("/dev/null", &now), ==, 0);
    g_assert_true(S_ISCHR(now.st_mode));
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/io/replace/a file is new or replaced, and nothing else is left", new_and_old);
    g_test_add_func("/io/replace/a failed write leaves the old file and no other", failure);
    g_test_add_func("/io/replace/folders that are none or are the path itself are errors",
                    impossible_places);
    g_test_add_func("/io/replace/links are followed and permissions kept", links_and_permissions);
    g_test_add_func("/io/replace/a device is written, not replaced", devices);
    return g_test_run();
}
