#include "studio/curve_menu.h"

#include "frond/curve.h"
#include "studio/accessible.h"
#include "studio/model/values.h"
#include "studio/widgets.h"

static GdkClipboard *clipboard_of(StudioCurveBox *box) {
    return gtk_widget_get_clipboard(GTK_WIDGET(box));
}

static void on_copy(GSimpleAction *action, GVariant *value, void *user) {
    (void)action;
    (void)value;
    char *text = studio_curve_box_text(user);
    if (text != NULL) {
        gdk_clipboard_set_text(clipboard_of(user), text);
    }
    g_free(text);
}

static void on_pasted(GObject *clipboard, GAsyncResult *result, void *user) {
    StudioCurveBox *box = user;
    char *text = gdk_clipboard_read_text_finish(GDK_CLIPBOARD(clipboard), result, NULL);
    bool is_there = gtk_widget_get_root(GTK_WIDGET(box)) != NULL;
    if (is_there && (text == NULL || !studio_curve_box_put(box, text))) {
        gtk_widget_error_bell(GTK_WIDGET(box));
    }
    g_free(text);
    g_object_unref(box);
}

static void on_paste(GSimpleAction *action, GVariant *value, void *user) {
    (void)action;
    (void)value;
    gdk_clipboard_read_text_async(clipboard_of(user), NULL, on_pasted, g_object_ref(user));
}

static void on_shape(GSimpleAction *action, GVariant *name, void *user) {
    (void)action;
    char *points = studio_points_of_shape(g_variant_get_string(name, NULL));
    if (points != NULL) {
        studio_curve_box_put(user, points);
    }
    g_free(points);
}

// "Tapered cylindrical" of "tapered-cylindrical".
static char *words_of(const char *name) {
    char *words = g_strdelimit(g_strdup(name), "-", ' ');
    words[0] = g_ascii_toupper(words[0]);
    return words;
}

static GMenuModel *make_menu(bool has_shapes) {
    GMenu *menu = g_menu_new(), *hand = g_menu_new(), *shapes = g_menu_new();
    g_menu_append(hand, "Copy Points", "curve.copy");
    g_menu_append(hand, "Paste Points", "curve.paste");
    g_menu_append_section(menu, NULL, G_MENU_MODEL(hand));
    size_t count;
    const char *const *names = fr_curve_builtin_names(&count);
    for (size_t i = 0; i < count; i++) {
        char *words = words_of(names[i]);
        GMenuItem *item = g_menu_item_new(words, NULL);
        g_menu_item_set_action_and_target(item, "curve.shape", "s", names[i]);
        g_menu_append_item(shapes, item);
        g_object_unref(item);
        g_free(words);
    }
    if (has_shapes) {
        g_menu_append_section(menu, "Begin as", G_MENU_MODEL(shapes));
    }
    g_object_unref(hand);
    g_object_unref(shapes);
    return G_MENU_MODEL(menu);
}

static void on_menu(GtkGestureClick *gesture, int count, double x, double y,
                    GtkMenuButton *button) {
    (void)gesture;
    (void)count;
    (void)x;
    (void)y;
    gtk_menu_button_popup(button);
}

GtkWidget *studio_curve_menu_new(StudioCurveBox *box) {
    static const GActionEntry entries[] = {{.name = "copy", .activate = on_copy},
                                           {.name = "paste", .activate = on_paste},
                                           {"shape", on_shape, "s", NULL, NULL, {0}}};
    GtkWidget *button = gtk_menu_button_new();
    GSimpleActionGroup *group = g_simple_action_group_new();
    g_action_map_add_action_entries(G_ACTION_MAP(group), entries, G_N_ELEMENTS(entries), box);
    gtk_widget_insert_action_group(button, "curve", G_ACTION_GROUP(group));
    g_object_unref(group);
    GMenuModel *menu = make_menu(studio_curve_box_is_function(box));
    gtk_menu_button_set_icon_name(GTK_MENU_BUTTON(button), "view-more-symbolic");
    gtk_menu_button_set_menu_model(GTK_MENU_BUTTON(button), menu);
    g_object_unref(menu);
    gtk_menu_button_set_has_frame(GTK_MENU_BUTTON(button), FALSE);
    gtk_widget_add_css_class(button, "row-button");
    gtk_widget_set_valign(button, GTK_ALIGN_CENTER);
    studio_tell(button, "Copy, paste, or begin as a known shape");
    studio_listen_for_menu(GTK_WIDGET(box), G_CALLBACK(on_menu), button);
    return button;
}
