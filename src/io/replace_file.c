// Write beside, flush, rename: a reader sees the old file or the whole new one, never a part, even
// after a power cut.
#include "io/replace_file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <sys/stat.h>
#include <unistd.h>

static FrStatus failed(const char *path, int error, FrDiags *diags) {
    if (error == ECANCELED) {
        return FR_CANCELLED;
    }
    fr_diags_add(diags, FR_ERROR, "cannot-write", (FrSpan){0}, "cannot write '%s': %s", path,
                 g_strerror(error));
    return FR_ERR_MACHINE;
}

/// A link is followed, so that what it points to is replaced and not the link.
static char *resolved(const char *path) {
    char *real = realpath(path, NULL);
    char *copy = g_strdup(real != NULL ? real : path);
    free(real);
    return copy;
}

/// Opens a new file of an unused name beside `path`; −1 with errno if that cannot be done.
static int open_beside(const char *path, char **temporary) {
    char *folder = g_path_get_dirname(path);
    char *name = g_path_get_basename(path);
    int descriptor = -1;
    for (int tries = 0; tries < 100 && descriptor < 0; tries++) {
        *temporary = g_strdup_printf("%s/.%.200s.%08x.tmp", folder, name, g_random_int());
        descriptor = open(*temporary, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (descriptor < 0) {
            int error = errno;
            g_clear_pointer(temporary, g_free);
            errno = error;
            if (error != EEXIST) {
                break;
            }
        }
    }
    int error = errno;
    g_free(folder);
    g_free(name);
    errno = error;
    return descriptor;
}

static int write_and_close(int descriptor, bool flushes, bool (*write)(void *user, int descriptor),
                           void *user) {
    errno = 0;
    int error = 0;
    if (!write(user, descriptor)) {
        error = errno != 0 ? errno : EIO;
    } else if (flushes && fsync(descriptor) != 0) {
        error = errno;
    }
    if (close(descriptor) != 0 && error == 0) {
        error = errno;
    }
    return error;
}

FrStatus fr_replacement_write(FrReplacement *replacement, const char *path,
                              bool (*write)(void *user, int descriptor), void *user,
                              FrDiags *diags) {
    *replacement = (FrReplacement){.path = resolved(path)};
    struct stat old;
    bool exists = stat(path, &old) == 0;
    bool is_file = !exists || S_ISREG(old.st_mode);
    int descriptor = -1;
    if (exists && S_ISDIR(old.st_mode)) {
        errno = EISDIR;
    } else if (is_file) {
        descriptor = open_beside(replacement->path, &replacement->temporary);
    } else {
        descriptor = open(replacement->path, O_WRONLY | O_CLOEXEC);
    }
    int error = descriptor < 0 ? errno : 0;
    if (error == 0) {
        if (exists && is_file) {
            // Where that is not allowed it keeps the permissions of any new file.
            (void)fchmod(descriptor, old.st_mode & 07777);
        }
        error = write_and_close(descriptor, is_file, write, user);
    }
    if (error != 0) {
        fr_replacement_clear(replacement);
        return failed(path, error, diags);
    }
    return FR_OK;
}

/// After a rename the folder too has to reach the disk. Not every file system can do that.
static void flush_folder(const char *path) {
    char *folder = g_path_get_dirname(path);
    int descriptor = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor >= 0) {
        (void)fsync(descriptor);
        close(descriptor);
    }
    g_free(folder);
}

FrStatus fr_replacement_commit(FrReplacement *replacement, FrDiags *diags) {
    if (replacement->temporary == NULL) {
        return FR_OK;
    }
    if (rename(replacement->temporary, replacement->path) != 0) {
        return failed(replacement->path, errno, diags);
    }
    g_clear_pointer(&replacement->temporary, g_free);
    flush_folder(replacement->path);
    return FR_OK;
}

void fr_replacement_clear(FrReplacement *replacement) {
    if (replacement->temporary != NULL) {
        unlink(replacement->temporary);
    }
    g_clear_pointer(&replacement->temporary, g_free);
    g_clear_pointer(&replacement->path, g_free);
}

static void clear(gpointer replacement) {
    fr_replacement_clear(replacement);
}

GArray *fr_replacements_new(void) {
    GArray *replacements = g_array_new(FALSE, FALSE, sizeof(FrReplacement));
    g_array_set_clear_func(replacements, clear);
    return replacements;
}

FrStatus fr_replacements_write(GArray *replacements, const char *path,
                               bool (*write)(void *user, int descriptor), void *user,
                               FrDiags *diags) {
    FrReplacement replacement;
    FrStatus status = fr_replacement_write(&replacement, path, write, user, diags);
    if (status == FR_OK) {
        g_array_append_val(replacements, replacement);
    }
    return status;
}

FrStatus fr_replacements_commit(GArray *replacements, FrDiags *diags) {
    FrStatus status = FR_OK;
    for (guint i = 0; i < replacements->len && status == FR_OK; i++) {
        status = fr_replacement_commit(&g_array_index(replacements, FrReplacement, i), diags);
    }
    return status;
}

FrStatus fr_io_replace_file(const char *path, bool (*write)(void *user, int descriptor), void *user,
                            FrDiags *diags) {
    FrReplacement replacement;
    FrStatus status = fr_replacement_write(&replacement, path, write, user, diags);
    if (status == FR_OK) {
        status = fr_replacement_commit(&replacement, diags);
        fr_replacement_clear(&replacement);
    }
    return status;
}
