/// A bar with an estimate, drawn where standard error is a terminal.
#include "cli/cli.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

enum { BAR_CELLS = 28 };

// A program shows one bar; threads report to it in turn.
static struct {
    GMutex mutex;
    char stage[32];
    double stage_began;
    bool is_drawn;
} bar;

static void draw(const char *stage, double fraction) {
    if (strncmp(bar.stage, stage, sizeof bar.stage - 1) != 0) {
        g_strlcpy(bar.stage, stage, sizeof bar.stage);
        bar.stage_began = cli_now();
    }
    double elapsed = cli_now() - bar.stage_began;
    char left[32] = "";
    if (fraction > 0.02 && elapsed > 0.5) {
        int seconds = (int)CLAMP(elapsed * (1 - fraction) / fraction, 0, 359999);
        g_snprintf(left, sizeof left, "%d:%02d left", seconds / 60, seconds % 60);
    }
    char cells[BAR_CELLS + 1];
    int filled = (int)(CLAMP(fraction, 0, 1) * BAR_CELLS);
    memset(cells, '.', BAR_CELLS);
    memset(cells, '#', (size_t)filled);
    cells[BAR_CELLS] = '\0';
    fprintf(stderr, "\r%-8s [%s] %3d %%  %-14s", bar.stage, cells, (int)(100 * fraction), left);
    fflush(stderr);
    bar.is_drawn = true;
}

static void report(void *user, const char *stage, double fraction) {
    (void)user;
    g_mutex_lock(&bar.mutex);
    draw(stage, fraction);
    g_mutex_unlock(&bar.mutex);
}

FrProgress *cli_progress_new(bool is_quiet) {
    bool is_shown = !is_quiet && isatty(STDERR_FILENO) == 1;
    return fr_progress_new(is_shown ? report : NULL, NULL);
}

void cli_progress_free(FrProgress *progress) {
    fr_progress_free(progress);
    if (bar.is_drawn) {
        fprintf(stderr, "\r%*s\r", BAR_CELLS + 36, "");
        bar.is_drawn = false;
    }
}
