#include "studio/things_panel.h"

#include "studio/model/graph.h"
#include "studio/model/place.h"

#include <string.h>

enum { INDENT = 16 };

// What a row says.
typedef struct Thing {
    char *name;
    const char *kind; // a tag; NULL: that is its name
    guint depth;
} Thing;

// ---- the list ----------------------------------------------------------------------------------

// Only the rows that are seen have widgets, and only those that change are made anew: a document
// may place thousands of plants.
#define STUDIO_TYPE_THINGS (studio_things_get_type())
G_DECLARE_FINAL_TYPE(StudioThings, studio_things, STUDIO, THINGS, GObject)

struct _StudioThings {
    GObject parent;
    GArray *things; // Thing, of element 1 and those behind it
};

static GType things_item_type(GListModel *model) {
    (void)model;
    return G_TYPE_OBJECT;
}

static guint things_count(GListModel *model) {
    return STUDIO_THINGS(model)->things->len;
}

// A row knows what it shows by its position.
static gpointer things_item(GListModel *model, guint position) {
    return position < things_count(model) ? g_object_new(G_TYPE_OBJECT, NULL) : NULL;
}

static void things_model_init(GListModelInterface *interface) {
    interface->get_item_type = things_item_type;
    interface->get_n_items = things_count;
    interface->get_item = things_item;
}

G_DEFINE_TYPE_WITH_CODE(StudioThings, studio_things, G_TYPE_OBJECT,
                        G_IMPLEMENT_INTERFACE(G_TYPE_LIST_MODEL, things_model_init))

static void clear_thing(gpointer data) {
    g_free(((Thing *)data)->name);
}

static GArray *new_things(void) {
    GArray *things = g_array_new(FALSE, FALSE, sizeof(Thing));
    g_array_set_clear_func(things, clear_thing);
    return things;
}

static void studio_things_finalize(GObject *object) {
    g_array_unref(STUDIO_THINGS(object)->things);
    G_OBJECT_CLASS(studio_things_parent_class)->finalize(object);
}

static void studio_things_class_init(StudioThingsClass *class) {
    G_OBJECT_CLASS(class)->finalize = studio_things_finalize;
}

static void studio_things_init(StudioThings *list) {
    list->things = new_things();
}

static bool is_same(const GArray *a, guint i, const GArray *b, guint k) {
    const Thing *one = &g_array_index(a, Thing, i), *other = &g_array_index(b, Thing, k);
    return one->depth == other->depth && g_strcmp0(one->kind, other->kind) == 0 &&
           strcmp(one->name, other->name) == 0;
}

// Takes other things; what is the same before and behind the change stays as it is.
static void set_things(StudioThings *list, GArray *things) {
    GArray *old = list->things;
    guint first = 0, last = 0, both = MIN(old->len, things->len);
    while (first < both && is_same(old, first, things, first)) {
        first++;
    }
    while (last < both - first &&
           is_same(old, old->len - 1 - last, things, things->len - 1 - last)) {
        last++;
    }
    list->things = things;
    guint removed = old->len - first - last, added = things->len - first - last;
    if (removed > 0 || added > 0) {
        g_list_model_items_changed(G_LIST_MODEL(list), first, removed, added);
    }
    g_array_unref(old);
}

// ---- reading -----------------------------------------------------------------------------------

// What it is called, or what tells it from others of its tag; NULL: nothing.
static char *called(const FrContents *contents, uint32_t element) {
    static const char *const telling[][2] = {
        {"edit", "at"}, {"obstacle", "shape"}, {NULL, "name"}, {NULL, "plant"}, {NULL, "plants"},
    };
    const FrContentsElement *at = fr_contents_at(contents, element);
    if (at->id != NULL) {
        return g_strdup(at->id);
    }
    if (strcmp(at->name, "link") == 0) {
        char *from = fr_contents_get(contents, element, "from");
        char *to = fr_contents_get(contents, element, "to");
        char *both = g_strdup_printf("%s → %s", from, to);
        g_free(from);
        g_free(to);
        return both;
    }
    for (size_t i = 0; i < G_N_ELEMENTS(telling); i++) {
        bool may = telling[i][0] == NULL || strcmp(at->name, telling[i][0]) == 0;
        char *told = may ? fr_contents_get(contents, element, telling[i][1]) : NULL;
        if (told != NULL && *told != '\0') {
            return told;
        }
        g_free(told);
    }
    return NULL;
}

// Else its tag, with its number where it has others beside it.
static char *numbered(const char *tag, uint32_t number) {
    return number == 0 ? g_strdup(tag) : g_strdup_printf("%s %u", tag, number);
}

static GArray *read_things(const FrContents *contents) {
    GArray *things = new_things();
    guint *depths = g_new0(guint, fr_contents_count(contents));
    uint32_t *numbers = studio_place_numbers(contents);
    for (uint32_t i = 1; i < fr_contents_count(contents); i++) {
        const FrContentsElement *at = fr_contents_at(contents, i);
        const char *tag = g_intern_string(at->name);
        char *name = called(contents, i);
        depths[i] = depths[at->parent] + 1; // which comes before it
        Thing thing = {name != NULL ? name : numbered(tag, numbers[i]), name != NULL ? tag : NULL,
                       depths[i] - 1};
        g_array_append_val(things, thing);
    }
    g_free(numbers);
    g_free(depths);
    return things;
}

// ---- the panel ---------------------------------------------------------------------------------

struct _StudioThingsPanel {
    GtkBox parent;
    GtkWidget *list;
    StudioThings *things;
    GtkSingleSelection *selection;
    uint64_t revision; // of what is listed
    const StudioDocument *document;
    gboolean is_showing;
    GHashTable *bound; // GtkListItem *, that have a widget
    GHashTable *loads; // id of a plant → "12 · 85 ms"
};

static guint selected_signal;

G_DEFINE_TYPE(StudioThingsPanel, studio_things_panel, GTK_TYPE_BOX)

static void on_selected(GtkSingleSelection *selection, GParamSpec *spec, StudioThingsPanel *panel) {
    (void)spec;
    guint position = gtk_single_selection_get_selected(selection);
    if (position != GTK_INVALID_LIST_POSITION && !panel->is_showing) {
        g_signal_emit(panel, selected_signal, 0, position + 1);
    }
}

static void on_setup(GtkSignalListItemFactory *factory, GtkListItem *item, gpointer data) {
    (void)factory;
    (void)data;
    GtkWidget *box = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 8);
    GtkWidget *name = gtk_label_new(NULL), *kind = gtk_label_new(NULL);
    gtk_label_set_xalign(GTK_LABEL(name), 0);
    gtk_label_set_ellipsize(GTK_LABEL(name), PANGO_ELLIPSIZE_END);
    gtk_widget_set_hexpand(name, TRUE);
    gtk_widget_add_css_class(kind, "dim-label");
    gtk_widget_add_css_class(kind, "caption");
    gtk_box_append(GTK_BOX(box), name);
    gtk_box_append(GTK_BOX(box), kind);
    gtk_list_item_set_child(item, box);
}

// "plant", or "12 · 85 ms · plant". Free with g_free().
static char *kind_text(const StudioThingsPanel *panel, const Thing *thing) {
    const char *load = g_strcmp0(thing->kind, "plant") == 0
                           ? g_hash_table_lookup(panel->loads, thing->name)
                           : NULL;
    return load == NULL ? g_strdup(thing->kind) : g_strdup_printf("%s · %s", load, thing->kind);
}

static void show_kind(const StudioThingsPanel *panel, GtkListItem *item) {
    guint position = gtk_list_item_get_position(item);
    GtkWidget *kind = gtk_widget_get_last_child(gtk_list_item_get_child(item));
    if (position < panel->things->things->len) {
        const Thing *thing = &g_array_index(panel->things->things, Thing, position);
        char *text = kind_text(panel, thing);
        gtk_label_set_text(GTK_LABEL(kind), text == NULL ? "" : text);
        gtk_widget_set_visible(kind, text != NULL);
        g_free(text);
    }
}

static void on_unbind(GtkSignalListItemFactory *factory, GtkListItem *item,
                      StudioThingsPanel *panel) {
    (void)factory;
    g_hash_table_remove(panel->bound, item);
}

static void on_bind(GtkSignalListItemFactory *factory, GtkListItem *item,
                    StudioThingsPanel *panel) {
    (void)factory;
    g_hash_table_add(panel->bound, item);
    const Thing *thing =
        &g_array_index(panel->things->things, Thing, gtk_list_item_get_position(item));
    GtkWidget *box = gtk_list_item_get_child(item);
    GtkWidget *name = gtk_widget_get_first_child(box);
    gtk_widget_set_margin_start(box, (int)(thing->depth * INDENT + 4));
    gtk_label_set_text(GTK_LABEL(name), thing->name);
    show_kind(panel, item);
    gtk_accessible_update_property(GTK_ACCESSIBLE(gtk_widget_get_parent(box)),
                                   GTK_ACCESSIBLE_PROPERTY_LABEL, thing->name, -1);
}

// How many and how long, of what of both is worth a word. Free with g_free(); NULL: nothing is.
static char *load_text(const StudioPlantLoad *load) {
    char *time = studio_time_text(load->seconds), *text = NULL;
    if (load->stands > 1) {
        text = g_strdup_printf("%" G_GUINT64_FORMAT "%s%s", load->stands,
                               *time == '\0' ? "" : " · ", time);
    } else if (*time != '\0') {
        text = g_strdup(time);
    }
    g_free(time);
    return text;
}

void studio_things_panel_set_loads(StudioThingsPanel *panel, const GArray *loads) {
    g_hash_table_remove_all(panel->loads);
    for (guint i = 0; i < loads->len; i++) {
        const StudioPlantLoad *load = &g_array_index(loads, StudioPlantLoad, i);
        char *text = load_text(load);
        if (text != NULL) {
            g_hash_table_insert(panel->loads, g_strdup(load->plant), text);
        }
    }
    GHashTableIter all;
    gpointer item;
    g_hash_table_iter_init(&all, panel->bound);
    while (g_hash_table_iter_next(&all, &item, NULL)) {
        show_kind(panel, item);
    }
}

void studio_things_panel_show(StudioThingsPanel *panel, StudioDocument *document,
                              uint32_t selected) {
    panel->is_showing = TRUE;
    if (panel->document != document || panel->revision != studio_document_revision(document)) {
        set_things(panel->things, read_things(studio_document_contents(document)));
        panel->document = document;
        panel->revision = studio_document_revision(document);
    }
    guint position =
        selected == FR_NONE || selected == 0 ? GTK_INVALID_LIST_POSITION : selected - 1;
    if (position != gtk_single_selection_get_selected(panel->selection)) {
        gtk_single_selection_set_selected(panel->selection, position);
        if (position != GTK_INVALID_LIST_POSITION) {
            gtk_widget_activate_action(panel->list, "list.scroll-to-item", "u", position);
        }
    }
    panel->is_showing = FALSE;
}

static void studio_things_panel_finalize(GObject *object) {
    StudioThingsPanel *panel = STUDIO_THINGS_PANEL(object);
    g_hash_table_unref(panel->bound);
    g_hash_table_unref(panel->loads);
    G_OBJECT_CLASS(studio_things_panel_parent_class)->finalize(object);
}

static void studio_things_panel_class_init(StudioThingsPanelClass *class) {
    G_OBJECT_CLASS(class)->finalize = studio_things_panel_finalize;
    selected_signal = g_signal_new("selected", G_TYPE_FROM_CLASS(class), G_SIGNAL_RUN_LAST, 0, NULL,
                                   NULL, NULL, G_TYPE_NONE, 1, G_TYPE_UINT);
}

static void studio_things_panel_init(StudioThingsPanel *panel) {
    panel->bound = g_hash_table_new(NULL, NULL);
    panel->loads = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, g_free);
    panel->things = g_object_new(STUDIO_TYPE_THINGS, NULL);
    panel->selection = gtk_single_selection_new(G_LIST_MODEL(panel->things));
    gtk_single_selection_set_autoselect(panel->selection, FALSE);
    gtk_single_selection_set_can_unselect(panel->selection, TRUE);
    gtk_single_selection_set_selected(panel->selection, GTK_INVALID_LIST_POSITION);
    GtkListItemFactory *factory = gtk_signal_list_item_factory_new();
    g_signal_connect(factory, "setup", G_CALLBACK(on_setup), NULL);
    g_signal_connect(factory, "bind", G_CALLBACK(on_bind), panel);
    g_signal_connect(factory, "unbind", G_CALLBACK(on_unbind), panel);
    panel->list = gtk_list_view_new(GTK_SELECTION_MODEL(panel->selection), factory);
    gtk_widget_add_css_class(panel->list, "navigation-sidebar");
    gtk_widget_set_name(panel->list, "things");
    gtk_accessible_update_property(GTK_ACCESSIBLE(panel->list), GTK_ACCESSIBLE_PROPERTY_LABEL,
                                   "Contents of the document", -1);
    g_signal_connect(panel->selection, "notify::selected", G_CALLBACK(on_selected), panel);
    GtkWidget *scrolled = gtk_scrolled_window_new();
    gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(scrolled), panel->list);
    gtk_widget_set_vexpand(scrolled, TRUE);
    gtk_widget_set_hexpand(scrolled, TRUE);
    gtk_box_append(GTK_BOX(panel), scrolled);
}

GtkWidget *studio_things_panel_new(void) {
    return g_object_new(STUDIO_TYPE_THINGS_PANEL, NULL);
}
