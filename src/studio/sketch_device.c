#include "studio/sketch_device.h"

#include <errno.h>
#include <fcntl.h>
#include <glib-unix.h>
#include <string.h>
#include <unistd.h>

enum { CHUNK = 4096, LONGEST_LINE = 512 };

struct StudioDevice {
    int file;
    guint watch;
    StudioDeviceEvent heard;
    void *user;
    GString *rest; // the beginning of a line
};

// Tells the events of all whole lines.
static void tell(StudioDevice *device) {
    const char *end = memrchr(device->rest->str, '\n', device->rest->len);
    if (end == NULL) {
        if (device->rest->len > LONGEST_LINE) {
            g_string_truncate(device->rest, 0); // no line of the protocol
        }
        return;
    }
    gsize size = (gsize)(end - device->rest->str) + 1;
    FrPen *pen = fr_pen_from_lines(device->rest->str, size, NULL);
    g_string_erase(device->rest, 0, (gssize)size);
    FrPenEvent event;
    while (pen->next(pen->device, &event)) {
        device->heard(device->user, &event);
    }
    fr_pen_free(pen);
}

static gboolean on_ready(gint file, GIOCondition condition, gpointer data) {
    (void)condition;
    StudioDevice *device = data;
    char chunk[CHUNK];
    ssize_t size = read(file, chunk, sizeof chunk);
    if (size > 0) {
        g_string_append_len(device->rest, chunk, size);
        tell(device);
        return G_SOURCE_CONTINUE;
    }
    if (size < 0 && (errno == EAGAIN || errno == EINTR)) {
        return G_SOURCE_CONTINUE;
    }
    device->watch = 0;
    device->heard(device->user, NULL);
    return G_SOURCE_REMOVE;
}

StudioDevice *studio_device_open(const char *path, StudioDeviceEvent heard, void *user,
                                 GError **error) {
    int file = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY);
    if (file < 0) {
        g_set_error(error, G_FILE_ERROR, (gint)g_file_error_from_errno(errno), "%s: %s", path,
                    g_strerror(errno));
        return NULL;
    }
    StudioDevice *device = g_new0(StudioDevice, 1);
    *device = (StudioDevice){file, 0, heard, user, g_string_new(NULL)};
    device->watch = g_unix_fd_add(file, G_IO_IN | G_IO_HUP | G_IO_ERR, on_ready, device);
    return device;
}

void studio_device_close(StudioDevice *device) {
    if (device != NULL) {
        g_clear_handle_id(&device->watch, g_source_remove);
        close(device->file);
        g_string_free(device->rest, TRUE);
        g_free(device);
    }
}
