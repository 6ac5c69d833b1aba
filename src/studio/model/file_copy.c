#include "studio/model/file_copy.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { FILE_MODE = 0666, READ_FLAGS = O_RDONLY | O_CLOEXEC | O_NONBLOCK };

bool studio_name_is_inside(const char *name) {
    char **parts = g_strsplit(name, "/", -1);
    bool is_inside = *name != '\0' && *name != '/';
    for (char **part = parts; *part != NULL && is_inside; part++) {
        is_inside = strcmp(*part, "..") != 0;
    }
    g_strfreev(parts);
    return is_inside;
}

// ---- reading -----------------------------------------------------------------------------------

// Opens a file beneath a folder step by step, so that no link leads out of it; -1.
static int open_inside(const char *folder, const char *name) {
    if (!studio_name_is_inside(name)) {
        errno = EXDEV;
        return -1;
    }
    int at = open(folder, O_PATH | O_DIRECTORY | O_CLOEXEC);
    char **parts = g_strsplit(name, "/", -1);
    for (char **part = parts; *part != NULL && at >= 0; part++) {
        bool is_last = part[1] == NULL;
        int next = openat(at, **part == '\0' ? "." : *part,
                          O_NOFOLLOW | (is_last ? READ_FLAGS : O_PATH | O_DIRECTORY | O_CLOEXEC));
        int error = errno;
        close(at);
        errno = error;
        at = next;
    }
    g_strfreev(parts);
    return at;
}

// All bytes, unless there are more than `most`: NULL.
static GBytes *read_all(int file, size_t size, size_t most) {
    GByteArray *bytes = g_byte_array_sized_new((guint)MIN(size, most));
    guint8 part[65536];
    ssize_t count;
    while ((count = read(file, part, sizeof part)) > 0 && bytes->len + (size_t)count <= most) {
        g_byte_array_append(bytes, part, (guint)count);
    }
    if (count != 0) {
        g_byte_array_unref(bytes);
        return NULL;
    }
    return g_byte_array_free_to_bytes(bytes);
}

GBytes *studio_file_read(const char *folder, const char *name, bool is_inside, size_t most,
                         const char **why) {
    char *path = g_path_is_absolute(name) ? g_strdup(name) : g_build_filename(folder, name, NULL);
    int file = is_inside ? open_inside(folder, name) : open(path, READ_FLAGS);
    struct stat about;
    GBytes *bytes = NULL;
    g_free(path);
    if (file < 0) {
        *why = errno == EXDEV || errno == ELOOP      ? "does not lie in its folder"
               : errno == ENOENT || errno == ENOTDIR ? "is not there"
                                                     : "cannot be read";
        return NULL;
    }
    if (fstat(file, &about) != 0 || !S_ISREG(about.st_mode)) {
        *why = "is not a file";
    } else if ((guint64)about.st_size > most) {
        *why = "is too large";
    } else {
        bytes = read_all(file, (size_t)about.st_size, most);
        *why = "cannot be read";
    }
    close(file);
    return bytes;
}

// ---- writing -----------------------------------------------------------------------------------

StudioTarget studio_target_state(const char *path, GBytes *bytes) {
    int file = open(path, READ_FLAGS | O_NOFOLLOW);
    if (file < 0) {
        return errno == ENOENT ? STUDIO_TARGET_FREE : STUDIO_TARGET_OTHER;
    }
    struct stat about;
    size_t size = g_bytes_get_size(bytes);
    bool may_be =
        fstat(file, &about) == 0 && S_ISREG(about.st_mode) && (guint64)about.st_size == size;
    GBytes *there = may_be ? read_all(file, size, size) : NULL;
    bool is_same = there != NULL && g_bytes_equal(there, bytes);
    g_clear_pointer(&there, g_bytes_unref);
    close(file);
    return is_same ? STUDIO_TARGET_SAME : STUDIO_TARGET_OTHER;
}

bool studio_file_create(const char *path, GBytes *bytes) {
    int file = open(path, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, FILE_MODE);
    if (file < 0) {
        return false;
    }
    gsize size;
    const char *at = g_bytes_get_data(bytes, &size);
    ssize_t count = 0;
    while (size > 0 && (count = write(file, at, size)) > 0) {
        at += count;
        size -= (gsize)count;
    }
    bool is_written = size == 0 && fsync(file) == 0;
    is_written = close(file) == 0 && is_written;
    if (!is_written) {
        unlink(path);
    }
    return is_written;
}
