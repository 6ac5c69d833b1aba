#include "studio/inspector_private.h"

#include "studio/accessible.h"
#include "studio/model/commands.h"
#include "studio/model/keys.h"
#include "studio/model/materials.h"
#include "studio/model/place.h"

#include <adwaita.h>
#include <math.h>
#include <string.h>

static guint followed, said;

G_DEFINE_TYPE(StudioInspector, studio_inspector, GTK_TYPE_BOX)

uint32_t studio_inspector_element(StudioInspector *inspector) {
    return inspector->document == NULL
               ? FR_NONE
               : studio_place_find(studio_document_contents(inspector->document), inspector->place);
}

// ---- what the user does ------------------------------------------------------------------------

static void on_set(StudioParamRow *row, const char *value, gboolean is_drag,
                   StudioInspector *inspector) {
    uint32_t element = studio_inspector_element(inspector);
    if (element != FR_NONE) {
        studio_set(inspector->document, element, studio_param_row_attribute(row), value, is_drag);
    }
}

// The age of the element at the time that is shown; NAN: it has no key frames.
static double age_of(StudioInspector *inspector, uint32_t element) {
    if (!studio_has_keys(inspector->document, element)) {
        return NAN;
    }
    StudioClock clock = studio_clock_of(inspector->document, element);
    double time =
        isnan(inspector->time) ? studio_clock_shown(inspector->document, element) : inspector->time;
    return clock.scale * time + clock.offset;
}

static void on_key(StudioParamRow *row, double value, gboolean is_drag,
                   StudioInspector *inspector) {
    uint32_t element = studio_inspector_element(inspector);
    if (element != FR_NONE) {
        studio_set_key(inspector->document, element, studio_param_row_attribute(row),
                       age_of(inspector, element), value, is_drag);
    }
}

static void on_unkey(StudioParamRow *row, StudioInspector *inspector) {
    uint32_t element = studio_inspector_element(inspector);
    if (element != FR_NONE) {
        studio_remove_key(inspector->document, element, studio_param_row_attribute(row),
                          age_of(inspector, element));
    }
}

static void on_sealed(StudioParamRow *row, StudioInspector *inspector) {
    (void)row;
    studio_document_seal(inspector->document);
}

void studio_inspector_follow(StudioInspector *inspector, const char *id) {
    uint32_t element = fr_contents_find(studio_document_contents(inspector->document), 0, id);
    if (element != FR_NONE) {
        g_signal_emit(inspector, followed, 0, element);
    }
}

static void on_follow(StudioParamRow *row, const char *id, StudioInspector *inspector) {
    (void)row;
    studio_inspector_follow(inspector, id);
}

// Tells why an element is not called so, and shows its name again.
static void refuse_name(StudioInspector *inspector, const char *id, const char *to) {
    char *reason = fr_contents_is_id(to)
                       ? g_strdup_printf("There is something else that is called %s", to)
                       : g_strdup("A name is a letter followed by letters, digits, - and _, at "
                                  "most 64 bytes");
    g_signal_emit(inspector, said, 0, reason);
    gtk_editable_set_text(GTK_EDITABLE(inspector->id), id);
    g_free(reason);
}

static void on_renamed(GtkEntry *entry, StudioInspector *inspector) {
    uint32_t element = studio_inspector_element(inspector);
    if (element == FR_NONE) {
        return;
    }
    const FrContents *contents = studio_document_contents(inspector->document);
    const FrContentsElement *at = fr_contents_at(contents, element);
    uint32_t plant = studio_place_plant(contents, element);
    char *to = g_strdup(gtk_editable_get_text(GTK_EDITABLE(entry)));
    bool is_material = at->table == fr_material_table();
    bool has_name = at->id != NULL && (is_material || (at->component >= 0 && plant != FR_NONE));
    if (has_name && strcmp(at->id, to) != 0) {
        bool is_renamed = is_material
                              ? studio_rename_material(inspector->document, element, to)
                              : studio_rename_component(inspector->document, plant, at->id, to);
        if (is_renamed) {
            contents = studio_document_contents(inspector->document);
            g_signal_emit(inspector, followed, 0,
                          is_material ? element : fr_contents_find(contents, plant, to));
        } else {
            refuse_name(inspector, at->id, to);
        }
    }
    g_free(to);
}

static void filter_rows(StudioInspector *inspector) {
    const char *words = gtk_editable_get_text(GTK_EDITABLE(inspector->search));
    bool is_given_only = gtk_toggle_button_get_active(GTK_TOGGLE_BUTTON(inspector->given));
    for (guint i = 0; i < inspector->rows->len; i++) {
        StudioParamRow *row = g_ptr_array_index(inspector->rows, i);
        bool is_shown = (!is_given_only || studio_param_row_is_given(row)) &&
                        (*words == '\0' || studio_param_row_matches(row, words));
        gtk_widget_set_visible(GTK_WIDGET(row), is_shown);
    }
}

static void on_search(GtkSearchEntry *search, StudioInspector *inspector) {
    (void)search;
    filter_rows(inspector);
}

static void on_given(GtkToggleButton *button, StudioInspector *inspector) {
    (void)button;
    filter_rows(inspector);
}

// ---- rows --------------------------------------------------------------------------------------

static GtkWidget *add_section(StudioInspector *inspector, const char *title, bool is_open) {
    GtkWidget *expander = gtk_expander_new(title);
    studio_name(expander, title);
    gtk_expander_set_expanded(GTK_EXPANDER(expander), is_open);
    gtk_widget_add_css_class(expander, "section");
    GtkWidget *box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 0);
    gtk_expander_set_child(GTK_EXPANDER(expander), box);
    gtk_box_append(GTK_BOX(inspector->sections), expander);
    return box;
}

static void add_row(StudioInspector *inspector, GtkWidget *section, const FrParam *param) {
    GtkWidget *row = studio_param_row_new(param);
    g_signal_connect(row, "set", G_CALLBACK(on_set), inspector);
    g_signal_connect(row, "sealed", G_CALLBACK(on_sealed), inspector);
    g_signal_connect(row, "follow", G_CALLBACK(on_follow), inspector);
    g_signal_connect(row, "key", G_CALLBACK(on_key), inspector);
    g_signal_connect(row, "unkey", G_CALLBACK(on_unkey), inspector);
    gtk_box_append(GTK_BOX(section), row);
    studio_inspector_put_picker(inspector, STUDIO_PARAM_ROW(row));
    g_ptr_array_add(inspector->rows, row);
}

// Those of a table from `begin` to before `end` that name a material, or that name none.
static void add_rows(StudioInspector *inspector, GtkWidget *section, size_t begin, size_t end,
                     bool names_material) {
    for (size_t i = begin; i < end; i++) {
        if (studio_names_material(&inspector->table->rows[i]) == names_material) {
            add_row(inspector, section, &inspector->table->rows[i]);
        }
    }
}

// Rows that a component shares with all others come first in its table: they end with those of a
// Camera, which has no others. Its own stand above them here, and its materials above those.
static size_t count_shared(const FrParamTable *table) {
    const FrParamTable *least = fr_pgraph_table(FR_COMPONENT_CAMERA);
    size_t count = 0;
    while (count < table->count && count < least->count &&
           strcmp(table->rows[count].name, least->rows[count].name) == 0) {
        count++;
    }
    return count;
}

static size_t first_of_life(const FrParamTable *table) {
    const FrParam *birth = fr_params_find(table, "birth");
    return birth == NULL ? table->count : (size_t)(birth - table->rows);
}

static void fill(StudioInspector *inspector, const FrContentsElement *element) {
    GtkWidget *child;
    while ((child = gtk_widget_get_first_child(inspector->sections)) != NULL) {
        gtk_box_remove(GTK_BOX(inspector->sections), child);
    }
    g_ptr_array_set_size(inspector->rows, 0);
    const FrParamTable *table = element->table;
    inspector->table = table;
    if (table == NULL) {
        return;
    }
    bool is_component = element->component >= 0;
    size_t shared = is_component ? count_shared(table) : 0;
    size_t life = is_component ? MIN(first_of_life(table), shared) : 0;
    if (table->count > shared) {
        GtkWidget *own = add_section(inspector, is_component ? "Form" : "Settings", true);
        add_rows(inspector, own, 0, life, true);
        add_rows(inspector, own, shared, table->count, true);
        add_rows(inspector, own, shared, table->count, false);
    }
    if (shared > 0) {
        GtkWidget *place = add_section(inspector, "Place and size", table->count == shared);
        add_rows(inspector, place, 0, life, false);
        if (table->count == shared) {
            add_rows(inspector, place, 0, life, true);
        }
        GtkWidget *time = add_section(inspector, "Life", false);
        add_rows(inspector, time, life, shared, false);
    }
}

static void show_values(StudioInspector *inspector, uint32_t element) {
    const FrContents *contents = studio_document_contents(inspector->document);
    static const char *const kinds[] = {"smooth", "linear", "step"};
    char *kind = fr_contents_get(contents, element, "kind");
    double age = age_of(inspector, element);
    for (guint i = 0; i < inspector->rows->len; i++) {
        StudioParamRow *row = g_ptr_array_index(inspector->rows, i);
        char *value = fr_contents_get(contents, element, studio_param_row_attribute(row));
        studio_param_row_set_age(row, age);
        studio_param_row_show(row, value);
        for (int k = 0; k < 3; k++) {
            if (g_strcmp0(kind, kinds[k]) == 0) {
                studio_param_row_set_curve_kind(row, k);
            }
        }
        g_free(value);
    }
    g_free(kind);
    studio_inspector_show_looks(inspector);
}

static void show_heading(StudioInspector *inspector, const FrContentsElement *element) {
    bool is_component = element->component >= 0;
    gtk_editable_set_text(GTK_EDITABLE(inspector->id), element->id != NULL ? element->id : "");
    bool is_named = is_component || element->table == fr_material_table();
    gtk_editable_set_editable(GTK_EDITABLE(inspector->id), is_named);
    gtk_widget_set_can_focus(inspector->id, is_named);
    gtk_widget_set_visible(inspector->id, element->id != NULL);
    char *kind = g_strdup(element->name);
    kind[0] = g_ascii_toupper(kind[0]);
    gtk_label_set_text(GTK_LABEL(inspector->kind), kind);
    g_free(kind);
    char *meaning = g_strdup(element->table == NULL ? "" : element->table->meaning);
    if (*meaning != '\0') {
        meaning[0] = g_ascii_toupper(meaning[0]);
    }
    gtk_label_set_text(GTK_LABEL(inspector->meaning), meaning);
    gtk_widget_set_visible(inspector->meaning, *meaning != '\0');
    g_free(meaning);
}

void studio_inspector_show(StudioInspector *inspector, StudioDocument *document, uint32_t element,
                           const FrDiags *diags) {
    inspector->document = document;
    if (element == FR_NONE) {
        g_clear_pointer(&inspector->place, g_free);
        gtk_stack_set_visible_child_name(GTK_STACK(inspector->stack), "nothing");
        return;
    }
    const FrContents *contents = studio_document_contents(document);
    const FrContentsElement *at = fr_contents_at(contents, element);
    char *place = studio_place_of(contents, element);
    bool is_other = g_strcmp0(place, inspector->place) != 0;
    g_free(inspector->place);
    inspector->place = place;
    if (is_other) {
        gtk_editable_set_text(GTK_EDITABLE(inspector->search), "");
        GtkAdjustment *scroll =
            gtk_scrolled_window_get_vadjustment(GTK_SCROLLED_WINDOW(inspector->scrolled));
        gtk_adjustment_set_value(scroll, 0);
    }
    if (at->table != inspector->table) {
        fill(inspector, at);
    }
    show_heading(inspector, at);
    show_values(inspector, element);
    studio_inspector_set_diags(inspector, diags);
    filter_rows(inspector);
    gtk_stack_set_visible_child_name(GTK_STACK(inspector->stack), "element");
}

void studio_inspector_set_time(StudioInspector *inspector, double time) {
    inspector->time = time;
    uint32_t element = studio_inspector_element(inspector);
    if (element != FR_NONE) {
        show_values(inspector, element);
    }
}

// ---- what is wrong -----------------------------------------------------------------------------

void studio_inspector_set_diags(StudioInspector *inspector, const FrDiags *diags) {
    uint32_t element = studio_inspector_element(inspector);
    if (element == FR_NONE) {
        return;
    }
    const FrContents *contents = studio_document_contents(inspector->document);
    for (guint i = 0; i < inspector->rows->len; i++) {
        StudioParamRow *row = g_ptr_array_index(inspector->rows, i);
        const FrDiag *found = NULL;
        FrSpan value = {0};
        if (studio_param_row_is_given(row)) {
            value = fr_contents_span(contents, element, studio_param_row_attribute(row));
        }
        for (size_t d = 0; diags != NULL && found == NULL && d < fr_diags_count(diags); d++) {
            const FrDiag *diag = fr_diags_get(diags, d);
            bool is_here = value.source != NULL && diag->span.source != NULL &&
                           diag->span.begin >= value.begin && diag->span.begin <= value.end;
            found = is_here ? diag : NULL;
        }
        int begin = found == NULL ? 0 : (int)(found->span.begin - value.begin);
        int end = found == NULL ? 0 : (int)(MIN(found->span.end, value.end) - value.begin);
        studio_param_row_mark(row, found == NULL ? NULL : found->text, begin, end);
    }
}

void studio_inspector_reveal(StudioInspector *inspector, const char *attribute) {
    gtk_toggle_button_set_active(GTK_TOGGLE_BUTTON(inspector->given), FALSE);
    for (guint i = 0; i < inspector->rows->len; i++) {
        StudioParamRow *row = g_ptr_array_index(inspector->rows, i);
        if (strcmp(studio_param_row_attribute(row), attribute) == 0) {
            GtkWidget *section = gtk_widget_get_ancestor(GTK_WIDGET(row), GTK_TYPE_EXPANDER);
            gtk_expander_set_expanded(GTK_EXPANDER(section), TRUE);
            gtk_widget_child_focus(GTK_WIDGET(row), GTK_DIR_TAB_FORWARD);
        }
    }
}

// ---- life --------------------------------------------------------------------------------------

static GtkWidget *make_heading(StudioInspector *inspector) {
    GtkWidget *box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 4);
    gtk_widget_add_css_class(box, "inspector-heading");
    GtkWidget *line = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 8);
    inspector->kind = gtk_label_new("");
    gtk_widget_add_css_class(inspector->kind, "dim-label");
    inspector->id = gtk_entry_new();
    gtk_widget_set_hexpand(inspector->id, TRUE);
    gtk_widget_add_css_class(inspector->id, "title-entry");
    gtk_widget_set_name(inspector->id, "element-id");
    studio_name(inspector->id, "Name");
    g_signal_connect(inspector->id, "activate", G_CALLBACK(on_renamed), inspector);
    gtk_box_append(GTK_BOX(line), inspector->id);
    gtk_box_append(GTK_BOX(line), inspector->kind);
    inspector->meaning = gtk_label_new("");
    gtk_label_set_wrap(GTK_LABEL(inspector->meaning), TRUE);
    gtk_label_set_xalign(GTK_LABEL(inspector->meaning), 0);
    gtk_widget_add_css_class(inspector->meaning, "caption");
    gtk_widget_add_css_class(inspector->meaning, "dim-label");
    GtkWidget *tools = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 6);
    inspector->search = gtk_search_entry_new();
    studio_name(inspector->search, "Find a parameter");
    gtk_widget_set_hexpand(inspector->search, TRUE);
    g_signal_connect(inspector->search, "search-changed", G_CALLBACK(on_search), inspector);
    inspector->given = gtk_toggle_button_new_with_label("Changed");
    gtk_widget_set_tooltip_text(inspector->given, "Only what the document sets");
    g_signal_connect(inspector->given, "toggled", G_CALLBACK(on_given), inspector);
    gtk_box_append(GTK_BOX(tools), inspector->search);
    gtk_box_append(GTK_BOX(tools), inspector->given);
    gtk_box_append(GTK_BOX(box), line);
    gtk_box_append(GTK_BOX(box), inspector->meaning);
    inspector->look = gtk_image_new();
    gtk_image_set_pixel_size(GTK_IMAGE(inspector->look), STUDIO_LOOK_SIZE);
    gtk_widget_set_halign(inspector->look, GTK_ALIGN_CENTER);
    gtk_widget_set_name(inspector->look, "look");
    studio_name(inspector->look, "How the material looks");
    gtk_box_append(GTK_BOX(box), inspector->look);
    gtk_box_append(GTK_BOX(box), tools);
    return box;
}

static GtkWidget *make_nothing(void) {
    GtkWidget *page = adw_status_page_new();
    adw_status_page_set_icon_name(ADW_STATUS_PAGE(page), "org.frond.Studio-symbolic");
    adw_status_page_set_title(ADW_STATUS_PAGE(page), "Nothing selected");
    adw_status_page_set_description(ADW_STATUS_PAGE(page),
                                    "Click a branch or leaf in the picture, or a box of the graph");
    gtk_widget_add_css_class(page, "compact");
    return page;
}

static void studio_inspector_finalize(GObject *object) {
    StudioInspector *inspector = STUDIO_INSPECTOR(object);
    g_ptr_array_unref(inspector->rows);
    g_free(inspector->place);
    studio_swatches_free(inspector->swatches);
    G_OBJECT_CLASS(studio_inspector_parent_class)->finalize(object);
}

static void studio_inspector_class_init(StudioInspectorClass *class) {
    G_OBJECT_CLASS(class)->finalize = studio_inspector_finalize;
    followed = g_signal_new("selected", G_TYPE_FROM_CLASS(class), G_SIGNAL_RUN_LAST, 0, NULL, NULL,
                            NULL, G_TYPE_NONE, 1, G_TYPE_UINT);
    said = g_signal_new("said", G_TYPE_FROM_CLASS(class), G_SIGNAL_RUN_LAST, 0, NULL, NULL, NULL,
                        G_TYPE_NONE, 1, G_TYPE_STRING);
}

static void studio_inspector_init(StudioInspector *inspector) {
    inspector->rows = g_ptr_array_new();
    inspector->time = NAN;
    inspector->swatches = studio_swatches_new(studio_inspector_show_looks, inspector);
    inspector->stack = gtk_stack_new();
    gtk_widget_set_hexpand(inspector->stack, TRUE);
    inspector->sections = gtk_box_new(GTK_ORIENTATION_VERTICAL, 6);
    inspector->scrolled = gtk_scrolled_window_new();
    gtk_scrolled_window_set_policy(GTK_SCROLLED_WINDOW(inspector->scrolled), GTK_POLICY_NEVER,
                                   GTK_POLICY_AUTOMATIC);
    gtk_scrolled_window_set_child(GTK_SCROLLED_WINDOW(inspector->scrolled), inspector->sections);
    gtk_widget_set_vexpand(inspector->scrolled, TRUE);
    GtkWidget *page = gtk_box_new(GTK_ORIENTATION_VERTICAL, 0);
    gtk_box_append(GTK_BOX(page), make_heading(inspector));
    gtk_box_append(GTK_BOX(page), inspector->scrolled);
    gtk_stack_add_named(GTK_STACK(inspector->stack), make_nothing(), "nothing");
    gtk_stack_add_named(GTK_STACK(inspector->stack), page, "element");
    gtk_box_append(GTK_BOX(inspector), inspector->stack);
    gtk_widget_add_css_class(GTK_WIDGET(inspector), "inspector");
}

GtkWidget *studio_inspector_new(void) {
    return g_object_new(STUDIO_TYPE_INSPECTOR, NULL);
}
