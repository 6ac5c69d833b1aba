#include "studio/material_picker.h"

#include "studio/accessible.h"
#include "studio/model/borrowed.h"
#include "studio/model/materials.h"

enum { BUTTON_SIZE = 20, ROW_SIZE = 32, SHARPER = 2 };

struct _StudioMaterialPicker {
    GtkBox parent;
    StudioSwatches *swatches; // borrowed
    const StudioDocument *document;
    char *value;
    GtkWidget *button, *swatch, *list, *copy;
};

enum { SIGNAL_CHOSEN, SIGNAL_WANTED, SIGNAL_COUNT };

static guint signals[SIGNAL_COUNT];

G_DEFINE_TYPE(StudioMaterialPicker, studio_material_picker, GTK_TYPE_BOX)

static const char key[] = "studio-material";

static GtkWidget *new_swatch(int size) {
    GtkWidget *picture = gtk_picture_new();
    gtk_picture_set_can_shrink(GTK_PICTURE(picture), TRUE);
    gtk_widget_set_size_request(picture, size, size);
    gtk_widget_set_halign(picture, GTK_ALIGN_CENTER);
    gtk_widget_set_valign(picture, GTK_ALIGN_CENTER);
    return picture;
}

static void paint(StudioMaterialPicker *picker, GtkWidget *swatch, uint32_t material, int size) {
    GdkTexture *texture = material == FR_NONE
                              ? NULL
                              : studio_swatches_get(picker->swatches, picker->document, material,
                                                    (uint32_t)(SHARPER * size));
    gtk_picture_set_paintable(GTK_PICTURE(swatch), GDK_PAINTABLE(texture));
    if (texture == NULL) {
        gtk_widget_add_css_class(swatch, "no-material");
    } else {
        gtk_widget_remove_css_class(swatch, "no-material");
    }
    g_clear_object(&texture);
}

// ---- the list ----------------------------------------------------------------------------------

static void on_row(GtkListBox *list, GtkListBoxRow *row, StudioMaterialPicker *picker) {
    (void)list;
    char *id = g_strdup(g_object_get_data(G_OBJECT(row), key)); // the list may be filled anew
    gtk_menu_button_popdown(GTK_MENU_BUTTON(picker->button));
    g_signal_emit(picker, signals[SIGNAL_CHOSEN], 0, id);
    g_free(id);
}

static void want(StudioMaterialPicker *picker, gboolean is_copy) {
    gtk_menu_button_popdown(GTK_MENU_BUTTON(picker->button));
    g_signal_emit(picker, signals[SIGNAL_WANTED], 0, is_copy);
}

static void on_new(GtkButton *button, StudioMaterialPicker *picker) {
    (void)button;
    want(picker, FALSE);
}

static void on_copy(GtkButton *button, StudioMaterialPicker *picker) {
    (void)button;
    want(picker, TRUE);
}

static void add_row(StudioMaterialPicker *picker, uint32_t material) {
    const FrContents *contents = studio_document_contents(picker->document);
    const char *id = material == FR_NONE ? NULL : fr_contents_at(contents, material)->id;
    GtkWidget *box = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 10);
    GtkWidget *swatch = new_swatch(ROW_SIZE);
    paint(picker, swatch, material, ROW_SIZE);
    gtk_box_append(GTK_BOX(box), swatch);
    gtk_box_append(GTK_BOX(box), gtk_label_new(id != NULL ? id : "None"));
    GtkWidget *row = gtk_list_box_row_new();
    gtk_list_box_row_set_child(GTK_LIST_BOX_ROW(row), box);
    char *name = g_strconcat("material:", id != NULL ? id : "", NULL);
    gtk_widget_set_name(row, name);
    g_free(name);
    g_object_set_data_full(G_OBJECT(row), key, g_strdup(id), g_free);
    studio_name(row, id != NULL ? id : "None");
    gtk_list_box_append(GTK_LIST_BOX(picker->list), row);
    if (g_strcmp0(id, picker->value) == 0) {
        gtk_list_box_select_row(GTK_LIST_BOX(picker->list), GTK_LIST_BOX_ROW(row));
    }
}

static void on_open(GtkWidget *popover, StudioMaterialPicker *picker) {
    (void)popover;
    GtkWidget *child;
    while ((child = gtk_widget_get_first_child(picker->list)) != NULL) {
        gtk_list_box_remove(GTK_LIST_BOX(picker->list), child);
    }
    const FrContents *contents = studio_document_contents(picker->document);
    add_row(picker, FR_NONE);
    for (uint32_t i = fr_contents_child(contents, 0, "material"); i != FR_NONE;
         i = fr_contents_sibling(contents, i)) {
        if (fr_contents_at(contents, i)->id != NULL) {
            add_row(picker, i);
        }
    }
    gtk_widget_set_sensitive(
        picker->copy, studio_tag_find(contents, 0, STUDIO_TAG_MATERIAL, picker->value) != FR_NONE);
}

static GtkWidget *flat_button(const char *title, const char *name, GCallback clicked,
                              StudioMaterialPicker *picker) {
    GtkWidget *button = gtk_button_new_with_label(title);
    gtk_widget_add_css_class(button, "flat");
    gtk_widget_set_name(button, name);
    g_signal_connect(button, "clicked", clicked, picker);
    return button;
}

static GtkWidget *make_popover(StudioMaterialPicker *picker) {
    picker->list = gtk_list_box_new();
    gtk_widget_add_css_class(picker->list, "material-list");
    g_signal_connect(picker->list, "row-activated", G_CALLBACK(on_row), picker);
    GtkWidget *scrolled = gtk_scrolled_window_new();
    gtk_scrolled_window_set_policy(GTK_SCROLLED_WINDOW(scrolled), GTK_POLICY_NEVER,
                                   GTK_POLICY_AUTOMATIC);
    gtk_scrolled_window_set_propagate_natural_height(GTK_SCROLLED_WINDOW(scrolled), TRUE);
    gtk_scrolled_window_set_max_content_height(GTK_SCROLLED_WINDOW(scrolled), 320);
    gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(scrolled), picker->list);
    picker->copy = flat_button("Copy of this one", "material-copy", G_CALLBACK(on_copy), picker);
    GtkWidget *box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 4);
    gtk_box_append(GTK_BOX(box), scrolled);
    gtk_box_append(GTK_BOX(box), gtk_separator_new(GTK_ORIENTATION_HORIZONTAL));
    gtk_box_append(GTK_BOX(box),
                   flat_button("New material", "material-new", G_CALLBACK(on_new), picker));
    gtk_box_append(GTK_BOX(box), picker->copy);
    GtkWidget *popover = gtk_popover_new();
    gtk_popover_set_child(GTK_POPOVER(popover), box);
    g_signal_connect(popover, "show", G_CALLBACK(on_open), picker);
    return popover;
}

// ---- life --------------------------------------------------------------------------------------

void studio_material_picker_show(StudioMaterialPicker *picker, const StudioDocument *document,
                                 const char *value) {
    picker->document = document;
    char *own = g_strdup(value);
    g_free(picker->value);
    picker->value = own;
    paint(picker, picker->swatch,
          studio_tag_find(studio_document_contents(document), 0, STUDIO_TAG_MATERIAL, own),
          BUTTON_SIZE);
}

static void studio_material_picker_finalize(GObject *object) {
    g_free(STUDIO_MATERIAL_PICKER(object)->value);
    G_OBJECT_CLASS(studio_material_picker_parent_class)->finalize(object);
}

static void studio_material_picker_class_init(StudioMaterialPickerClass *class) {
    G_OBJECT_CLASS(class)->finalize = studio_material_picker_finalize;
    GType type = G_TYPE_FROM_CLASS(class);
    signals[SIGNAL_CHOSEN] = g_signal_new("chosen", type, G_SIGNAL_RUN_LAST, 0, NULL, NULL, NULL,
                                          G_TYPE_NONE, 1, G_TYPE_STRING);
    signals[SIGNAL_WANTED] = g_signal_new("wanted", type, G_SIGNAL_RUN_LAST, 0, NULL, NULL, NULL,
                                          G_TYPE_NONE, 1, G_TYPE_BOOLEAN);
}

static void studio_material_picker_init(StudioMaterialPicker *picker) {
    picker->button = gtk_menu_button_new();
    picker->swatch = new_swatch(BUTTON_SIZE);
    gtk_menu_button_set_child(GTK_MENU_BUTTON(picker->button), picker->swatch);
    gtk_menu_button_set_popover(GTK_MENU_BUTTON(picker->button), make_popover(picker));
    gtk_widget_add_css_class(picker->button, "flat");
    gtk_widget_set_valign(picker->button, GTK_ALIGN_CENTER);
    studio_tell(picker->button, "Choose a material");
    gtk_box_append(GTK_BOX(picker), picker->button);
}

GtkWidget *studio_material_picker_new(StudioSwatches *swatches) {
    StudioMaterialPicker *picker = g_object_new(STUDIO_TYPE_MATERIAL_PICKER, NULL);
    picker->swatches = swatches;
    return GTK_WIDGET(picker);
}
