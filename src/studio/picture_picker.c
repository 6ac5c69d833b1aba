#include "studio/picture_picker.h"

#include "studio/model/materials.h"
#include "studio/swatches.h"
#include "studio/widgets.h"

enum { THUMBNAIL = 48, SHOWN = 24 };

struct _StudioPicturePicker {
    GtkBox parent;
    char *folder, *path; // NULL: none
    GtkWidget *picture;
    GtkFileChooserNative *dialog; // NULL: it is not open
};

static guint chosen;

G_DEFINE_TYPE(StudioPicturePicker, studio_picture_picker, GTK_TYPE_BOX)

static void on_response(GtkNativeDialog *dialog, int response, StudioPicturePicker *picker) {
    char *path = studio_chosen_path(dialog, response);
    char *name = path == NULL ? NULL : studio_file_from(picker->folder, path);
    if (name != NULL) {
        g_signal_emit(picker, chosen, 0, name);
    }
    g_free(name);
    g_free(path);
    g_clear_object(&picker->dialog);
}

static void on_clicked(GtkButton *button, StudioPicturePicker *picker) {
    GtkRoot *root = gtk_widget_get_root(GTK_WIDGET(button));
    g_clear_object(&picker->dialog);
    picker->dialog = gtk_file_chooser_native_new("Choose a Picture", GTK_WINDOW(root),
                                                 GTK_FILE_CHOOSER_ACTION_OPEN, "Choose", "Cancel");
    GtkFileFilter *filter = gtk_file_filter_new();
    gtk_file_filter_set_name(filter, "PNG and JPEG pictures");
    gtk_file_filter_add_mime_type(filter, "image/png");
    gtk_file_filter_add_mime_type(filter, "image/jpeg");
    gtk_file_chooser_add_filter(GTK_FILE_CHOOSER(picker->dialog), filter);
    g_object_unref(filter);
    const char *beside = picker->path != NULL ? picker->path : picker->folder;
    GFile *file = beside == NULL ? NULL : g_file_new_for_path(beside);
    if (picker->path != NULL && g_file_query_exists(file, NULL)) {
        gtk_file_chooser_set_file(GTK_FILE_CHOOSER(picker->dialog), file, NULL);
    } else if (picker->folder != NULL) {
        GFile *folder = g_file_new_for_path(picker->folder);
        gtk_file_chooser_set_current_folder(GTK_FILE_CHOOSER(picker->dialog), folder, NULL);
        g_object_unref(folder);
    }
    g_clear_object(&file);
    g_signal_connect(picker->dialog, "response", G_CALLBACK(on_response), picker);
    gtk_native_dialog_show(GTK_NATIVE_DIALOG(picker->dialog));
}

// A picture that cannot be read has none here; what is wrong stands below the row.
static GdkTexture *thumbnail_of(const char *path) {
    FrContext context = fr_context_default();
    FrStatus status;
    FrImage *image = fr_image_load(path, (FrSpan){0}, &context, &status);
    if (image == NULL) {
        return NULL;
    }
    uint32_t longer = MAX(image->width, image->height);
    FrImage *small =
        studio_thumbnail(image, MAX(1, (uint32_t)((uint64_t)THUMBNAIL * image->width / longer)),
                         MAX(1, (uint32_t)((uint64_t)THUMBNAIL * image->height / longer)));
    GdkTexture *texture = studio_texture_of(small);
    fr_image_unref(small);
    fr_image_unref(image);
    return texture;
}

void studio_picture_picker_show(StudioPicturePicker *picker, const char *folder, const char *file) {
    char *path = file == NULL || *file == '\0'
                     ? NULL
                     : g_build_filename(folder == NULL || g_path_is_absolute(file) ? "" : folder,
                                        file, NULL);
    g_free(picker->folder);
    picker->folder = g_strdup(folder);
    if (g_strcmp0(path, picker->path) == 0) {
        g_free(path);
        return;
    }
    g_free(picker->path);
    picker->path = path;
    GdkTexture *texture = path == NULL ? NULL : thumbnail_of(path);
    gtk_widget_set_visible(picker->picture, texture != NULL);
    gtk_picture_set_paintable(GTK_PICTURE(picker->picture), GDK_PAINTABLE(texture));
    g_clear_object(&texture);
}

static void studio_picture_picker_finalize(GObject *object) {
    StudioPicturePicker *picker = STUDIO_PICTURE_PICKER(object);
    g_clear_object(&picker->dialog);
    g_free(picker->folder);
    g_free(picker->path);
    G_OBJECT_CLASS(studio_picture_picker_parent_class)->finalize(object);
}

static void studio_picture_picker_class_init(StudioPicturePickerClass *class) {
    G_OBJECT_CLASS(class)->finalize = studio_picture_picker_finalize;
    chosen = g_signal_new("chosen", G_TYPE_FROM_CLASS(class), G_SIGNAL_RUN_LAST, 0, NULL, NULL,
                          NULL, G_TYPE_NONE, 1, G_TYPE_STRING);
}

static void studio_picture_picker_init(StudioPicturePicker *picker) {
    picker->picture = gtk_picture_new();
    gtk_picture_set_can_shrink(GTK_PICTURE(picker->picture), TRUE);
    gtk_widget_set_size_request(picker->picture, SHOWN, SHOWN);
    gtk_widget_set_visible(picker->picture, FALSE);
    GtkWidget *button = studio_row_button("document-open-symbolic", "Choose a picture");
    g_signal_connect(button, "clicked", G_CALLBACK(on_clicked), picker);
    gtk_box_append(GTK_BOX(picker), picker->picture);
    gtk_box_append(GTK_BOX(picker), button);
}

GtkWidget *studio_picture_picker_new(void) {
    return g_object_new(STUDIO_TYPE_PICTURE_PICKER, NULL);
}
