/// Runs the frond program in a folder of its own and looks at what it did.
#pragma once

#include <glib.h>
#include <glib/gstdio.h>

#include <fcntl.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#if defined(__SANITIZE_ADDRESS__)
#define IS_SANITIZED true
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define IS_SANITIZED true
#endif
#endif
#ifndef IS_SANITIZED
#define IS_SANITIZED false
#endif

typedef struct Run {
    char *out, *err; ///< what it printed
    int exit;        ///< its exit code, −1 if a signal ended it
    int signal;
    uint64_t peak_bytes;
} Run;

/// Starts `frond` with arguments as a shell would read them; "$S" is the source folder.
static inline pid_t start(const char *arguments) {
    char **parts = g_strsplit(arguments, "$S", -1);
    char *source = g_shell_quote(g_getenv("FROND_SOURCE"));
    char *joined = g_strjoinv(source, parts);
    char *line = g_strconcat("frond ", joined, NULL);
    char **argv;
    g_assert_true(g_shell_parse_argv(line, NULL, &argv, NULL));
    pid_t child = fork();
    if (child == 0) {
        int out = open("out.txt", O_WRONLY | O_CREAT | O_TRUNC, 0666);
        int err = open("err.txt", O_WRONLY | O_CREAT | O_TRUNC, 0666);
        if (dup2(out, STDOUT_FILENO) >= 0 && dup2(err, STDERR_FILENO) >= 0) {
            execv(g_getenv("FROND"), argv);
        }
        _exit(99);
    }
    g_strfreev(argv);
    g_free(line);
    g_free(joined);
    g_free(source);
    g_strfreev(parts);
    return child;
}

static inline Run finish(pid_t child) {
    int status;
    struct rusage usage;
    g_assert_cmpint(wait4(child, &status, 0, &usage), ==, child);
    Run run = {.exit = WIFEXITED(status) ? WEXITSTATUS(status) : -1,
               .signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0,
               .peak_bytes = (uint64_t)usage.ru_maxrss * 1024};
    g_assert_true(g_file_get_contents("out.txt", &run.out, NULL, NULL));
    g_assert_true(g_file_get_contents("err.txt", &run.err, NULL, NULL));
    g_test_message("exit %d, %" G_GUINT64_FORMAT " bytes\n%s%s", run.exit, run.peak_bytes, run.out,
                   run.err);
    return run;
}

static inline void clear(Run *run) {
    g_free(run->out);
    g_free(run->err);
}

static inline Run run(const char *arguments) {
    g_test_message("frond %s", arguments);
    return finish(start(arguments));
}

/// Goes to a new folder; `previous` is where it was.
static inline char *enter_folder(char **previous) {
    *previous = g_get_current_dir();
    char *folder = g_dir_make_tmp("frond-XXXXXX", NULL);
    g_assert_cmpint(g_chdir(folder), ==, 0);
    return folder;
}

/// Deletes the folder's files and the folder.
static inline void leave_folder(char *folder, char *previous) {
    GDir *directory = g_dir_open(".", 0, NULL);
    const char *name;
    while ((name = g_dir_read_name(directory)) != NULL) {
        g_remove(name);
    }
    g_dir_close(directory);
    g_assert_cmpint(g_chdir(previous), ==, 0);
    g_rmdir(folder);
    g_free(folder);
    g_free(previous);
}
