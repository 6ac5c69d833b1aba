/// The view as a picture of any size.
#include "studio/view/target.h"
#include "studio/viewport_private.h"

#include "frond/image.h"

enum { MOST_SLICES = 100000 };

// From the framebuffer, whose rows begin at the bottom and whose colours are dimmed by alpha.
static void read_back(FrImage *image) {
    uint32_t width = image->width, height = image->height, channels = image->channels;
    uint8_t *pixels = g_malloc((gsize)width * height * 4);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, (GLsizei)width, (GLsizei)height, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
    for (uint32_t y = 0; y < height; y++) {
        for (uint32_t x = 0; x < width; x++) {
            const uint8_t *from = pixels + 4 * ((gsize)(height - 1 - y) * width + x);
            uint8_t *to = image->pixels + channels * ((gsize)y * width + x);
            for (uint32_t k = 0; k < 3; k++) {
                unsigned whole = from[3] == 0 ? 0 : (from[k] * 255u + from[3] / 2u) / from[3];
                to[k] = channels == 4 ? (uint8_t)MIN(whole, 255u) : from[k];
            }
            if (channels == 4) {
                to[3] = from[3];
            }
        }
    }
    g_free(pixels);
}

FrImage *studio_viewport_picture(StudioViewport *viewport, int width, int height, bool is_clear) {
    GtkGLArea *area = GTK_GL_AREA(viewport);
    if (viewport->renderer == NULL) {
        return NULL;
    }
    gtk_gl_area_make_current(area);
    StudioDisplay display = viewport->display;
    display.is_clear = is_clear;
    display.is_bare = true;
    display.scale = 1;
    StudioTarget target = {0};
    studio_target_resize(&target, width, height);
    studio_renderer_resize(viewport->renderer, width, height, 1);
    glBindFramebuffer(GL_FRAMEBUFFER, target.frame);
    bool is_whole = glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
    bool has_more = is_whole;
    for (int i = 0; has_more && i < MOST_SLICES; i++) {
        has_more = studio_renderer_draw(viewport->renderer, &viewport->camera, &display, false);
    }
    FrImage *image = NULL;
    if (is_whole && !has_more) {
        image = fr_image_new((uint32_t)width, (uint32_t)height, is_clear ? 4 : 3);
        glBindFramebuffer(GL_FRAMEBUFFER, target.frame);
        read_back(image);
    }
    studio_target_clear(&target);
    gtk_gl_area_attach_buffers(area);
    int scale = gtk_widget_get_scale_factor(GTK_WIDGET(area));
    studio_renderer_resize(viewport->renderer, scale * gtk_widget_get_width(GTK_WIDGET(area)),
                           scale * gtk_widget_get_height(GTK_WIDGET(area)), scale);
    studio_viewport_wake(viewport);
    return image;
}
