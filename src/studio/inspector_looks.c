// How materials and their pictures look, beside the rows that name them and above a material's own.
#include "studio/inspector_private.h"

#include "studio/material_picker.h"
#include "studio/model/borrowed.h"
#include "studio/model/commands.h"
#include "studio/model/materials.h"
#include "studio/picture_picker.h"

static const char key[] = "studio-picker";

static StudioParamRow *row_of(GtkWidget *beside) {
    return STUDIO_PARAM_ROW(gtk_widget_get_ancestor(beside, STUDIO_TYPE_PARAM_ROW));
}

static void on_chosen(GtkWidget *picker, const char *value, StudioInspector *inspector) {
    const char *attribute = studio_param_row_attribute(row_of(picker));
    studio_set(inspector->document, studio_inspector_element(inspector), attribute, value, false);
}

static void on_wanted(GtkWidget *picker, gboolean is_copy, StudioInspector *inspector) {
    StudioParamRow *row = row_of(picker);
    const FrContents *contents = studio_document_contents(inspector->document);
    const char *value = studio_param_row_value(row);
    uint32_t like = is_copy ? studio_tag_find(contents, 0, STUDIO_TAG_MATERIAL, value) : FR_NONE;
    char *id = NULL;
    if (studio_add_material(inspector->document, like, studio_inspector_element(inspector),
                            studio_param_row_attribute(row), &id)) {
        studio_inspector_follow(inspector, id);
    }
    g_free(id);
}

void studio_inspector_put_picker(StudioInspector *inspector, StudioParamRow *row) {
    const FrParam *param = studio_param_row_param(row);
    GtkWidget *picker = NULL;
    if (studio_names_material(param)) {
        picker = studio_material_picker_new(inspector->swatches);
        g_signal_connect(picker, "wanted", G_CALLBACK(on_wanted), inspector);
    } else if (studio_names_picture(param)) {
        picker = studio_picture_picker_new();
    }
    if (picker != NULL) {
        char *name = g_strconcat(studio_param_row_attribute(row), "-picker", NULL);
        gtk_widget_set_name(picker, name);
        g_free(name);
        g_signal_connect(picker, "chosen", G_CALLBACK(on_chosen), inspector);
        studio_param_row_put(row, picker);
        g_object_set_data(G_OBJECT(row), key, picker);
    }
}

void studio_inspector_show_looks(void *user) {
    StudioInspector *inspector = user;
    uint32_t element = studio_inspector_element(inspector);
    if (element == FR_NONE) {
        return;
    }
    const FrContents *contents = studio_document_contents(inspector->document);
    for (guint i = 0; i < inspector->rows->len; i++) {
        StudioParamRow *row = g_ptr_array_index(inspector->rows, i);
        GtkWidget *beside = g_object_get_data(G_OBJECT(row), key);
        const char *value = studio_param_row_value(row);
        if (beside != NULL && STUDIO_IS_MATERIAL_PICKER(beside)) {
            studio_material_picker_show(STUDIO_MATERIAL_PICKER(beside), inspector->document, value);
        } else if (beside != NULL) {
            studio_picture_picker_show(STUDIO_PICTURE_PICKER(beside),
                                       studio_document_folder(inspector->document), value);
        }
    }
    bool is_material = fr_contents_at(contents, element)->table == fr_material_table();
    gtk_widget_set_visible(inspector->look, is_material);
    if (is_material) {
        GdkTexture *texture = studio_swatches_get(inspector->swatches, inspector->document, element,
                                                  2 * STUDIO_LOOK_SIZE);
        gtk_image_set_from_paintable(GTK_IMAGE(inspector->look), GDK_PAINTABLE(texture));
        g_object_unref(texture);
    }
}

StudioSwatches *studio_inspector_swatches(StudioInspector *inspector) {
    return inspector->swatches;
}
