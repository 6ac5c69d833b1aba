/// @file drive_private.h
/// What the files of the driver share.
#pragma once

#include "studio/drive.h"
#include "studio/window_private.h"

typedef struct StudioDrive {
    StudioWindow *window;
    GIOChannel *input;
    int settled; ///< checks in a row that found nothing to wait for
    int frames;  ///< still to be drawn by orbit or hear
    gint64 began;
} StudioDrive;

/// Does a command: its words, and the line after the first one.
typedef void StudioOrder(StudioDrive *drive, char *const *words, const char *rest);

/// Drives that window from now on; NULL: one that is left.
void studio_drive_take(StudioDrive *drive, StudioWindow *window);
/// Writes a line to who drives.
void studio_answer(const char *format, ...) G_GNUC_PRINTF(1, 2);

// drive_parts.c

StudioOrder studio_drive_where, studio_drive_needs, studio_drive_focus, studio_drive_text,
    studio_drive_dialog, studio_drive_picture_of_dialog, studio_drive_close_dialog,
    studio_drive_windows, studio_drive_window, studio_drive_pen;
