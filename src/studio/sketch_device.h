/// @file sketch_device.h
/// A device that writes lines of text: a drawing board with a height, a potentiometer, a script.
/// It is a file that lines come from: a serial port, a named pipe. The lines are those of
/// docs/variation.md.
#pragma once

#include "frond/variation.h"

#include <glib.h>

typedef struct StudioDevice StudioDevice;

/// Called on the main thread for every event, and once with NULL when the device has gone.
typedef void (*StudioDeviceEvent)(void *user, const FrPenEvent *event);

/// Begins to listen, and never waits. NULL with an error if it cannot be opened.
StudioDevice *studio_device_open(const char *path, StudioDeviceEvent heard, void *user,
                                 GError **error);
void studio_device_close(StudioDevice *device);
