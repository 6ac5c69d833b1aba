#include "studio/model/subgraph.h"

#include "studio/model/adopt.h"
#include "studio/model/borrowed.h"
#include "studio/model/commands_private.h"

#include <string.h>

// ---- graphs ------------------------------------------------------------------------------------

static uint32_t graph_of(const FrContents *contents, uint32_t plant) {
    return plant == FR_NONE ? FR_NONE : fr_contents_child(contents, plant, "pgraph");
}

// The ends of a link as elements of the graph; false if one is nowhere.
static bool link_ends(const FrContents *contents, uint32_t graph, uint32_t link, uint32_t *from,
                      uint32_t *to) {
    char *a = fr_contents_get(contents, link, "from"), *b = fr_contents_get(contents, link, "to");
    *from = a == NULL ? FR_NONE : fr_contents_find(contents, graph, a);
    *to = b == NULL ? FR_NONE : fr_contents_find(contents, graph, b);
    g_free(a);
    g_free(b);
    return *from != FR_NONE && *to != FR_NONE;
}

static bool is_camera(const FrContents *contents, uint32_t element) {
    return fr_contents_at(contents, element)->component == FR_COMPONENT_CAMERA;
}

static bool has(GHashTable *set, uint32_t element) {
    return g_hash_table_contains(set, GUINT_TO_POINTER(element));
}

// What a component leads to, and itself.
static void add_beneath(const FrContents *contents, uint32_t graph, uint32_t component,
                        GHashTable *set) {
    if (!g_hash_table_add(set, GUINT_TO_POINTER(component))) {
        return;
    }
    for (uint32_t link = fr_contents_child(contents, graph, "link"); link != FR_NONE;
         link = fr_contents_sibling(contents, link)) {
        uint32_t from, to;
        if (link_ends(contents, graph, link, &from, &to) && from == component) {
            add_beneath(contents, graph, to, set);
        }
    }
}

static void add_line(GString *out, const char *indent, const char *text) {
    char **lines = g_strsplit(text, "\n", -1);
    for (char **line = lines; *line != NULL; line++) {
        g_string_append_printf(out, "%s%s\n", **line == '\0' ? "" : indent, *line);
    }
    g_strfreev(lines);
}

// ---- taken out ---------------------------------------------------------------------------------

// The material that a component without one of its own takes from what it grows on. Free with
// g_free(); NULL: none.
static char *inherited_material(const FrContents *contents, uint32_t graph, uint32_t component,
                                uint32_t steps) {
    char *own = fr_contents_get(contents, component, "material");
    uint32_t link = fr_contents_child(contents, graph, "link");
    for (; own == NULL && steps > 0 && link != FR_NONE;
         link = fr_contents_sibling(contents, link)) {
        uint32_t from, to;
        if (link_ends(contents, graph, link, &from, &to) && to == component && from != to) {
            own = inherited_material(contents, graph, from, steps - 1);
        }
    }
    return own;
}

static char *plant_tag(const FrContents *contents, uint32_t plant, const char *id) {
    const FrParamTable *table = fr_contents_at(contents, plant)->table;
    GString *tag = g_string_new(NULL);
    g_string_append_printf(tag, "<plant id=\"%s\"", id);
    for (size_t r = 0; table != NULL && r < table->count; r++) {
        char *attribute = fr_param_attribute(&table->rows[r]);
        char *value = fr_contents_get(contents, plant, attribute);
        char *pair = value == NULL ? NULL : g_markup_printf_escaped(" %s=\"%s\"", attribute, value);
        g_string_append(tag, pair == NULL ? "" : pair);
        g_free(pair);
        g_free(value);
        g_free(attribute);
    }
    g_string_append(tag, ">");
    return g_string_free(tag, FALSE);
}

static char *id_of_name(const char *name) {
    char *id = g_strdup(name);
    for (char *at = id; *at != '\0'; at++) {
        *at = g_ascii_isalnum(*at) || *at == '-' ? *at : '_';
    }
    if (!fr_contents_is_id(id)) {
        char *whole = g_strconcat("plant_", id, NULL);
        g_free(id);
        id = whole;
    }
    return id;
}

typedef struct Cut {
    const FrContents *contents;
    uint32_t plant, graph, root;
    GHashTable *components, *used; // sets of elements
} Cut;

// The component that the cut begins at says of what material it is: nothing above it does.
static char *component_text(const Cut *cut, uint32_t component) {
    char *text = studio_element_text(cut->contents, component);
    char *own = fr_contents_get(cut->contents, component, "material"), *dressed = NULL;
    if (component == cut->root && own == NULL) {
        char *material = inherited_material(cut->contents, cut->graph, component,
                                            fr_contents_count(cut->contents));
        size_t name = strlen("<") + strlen(fr_contents_at(cut->contents, component)->name);
        if (material != NULL) {
            char *pair = g_markup_printf_escaped(" material=\"%s\"", material);
            dressed = g_strdup_printf("%.*s%s%s", (int)name, text, pair, text + name);
            g_free(pair);
        }
        g_free(material);
    }
    g_free(own);
    if (dressed != NULL) {
        g_free(text);
    }
    return dressed != NULL ? dressed : text;
}

static void write_graph(const Cut *cut, GString *out) {
    static const char indent[] = "      ";
    const FrContents *contents = cut->contents;
    bool has_camera = is_camera(contents, cut->root);
    char *camera = g_strdup("root");
    for (uint32_t k = 2; fr_contents_find(contents, cut->graph, camera) != FR_NONE; k++) {
        g_free(camera);
        camera = g_strdup_printf("root%u", k);
    }
    g_string_append(out, "    <pgraph>\n");
    if (!has_camera) {
        g_string_append_printf(out, "%s<camera id=\"%s\"/>\n", indent, camera);
    }
    for (uint32_t i = fr_contents_at(contents, cut->graph)->first; i != FR_NONE;
         i = fr_contents_at(contents, i)->next) {
        if (has(cut->components, i)) {
            char *text = component_text(cut, i);
            add_line(out, indent, text);
            g_free(text);
        }
    }
    if (!has_camera) {
        char *link =
            studio_link_xml(camera, fr_contents_at(contents, cut->root)->id, FR_LINK_CHILD);
        add_line(out, indent, link);
        g_free(link);
    }
    for (uint32_t link = fr_contents_child(contents, cut->graph, "link"); link != FR_NONE;
         link = fr_contents_sibling(contents, link)) {
        uint32_t from, to;
        if (link_ends(contents, cut->graph, link, &from, &to) && has(cut->components, from)) {
            char *text = studio_element_text(contents, link);
            add_line(out, indent, text);
            g_free(text);
        }
    }
    g_string_append(out, "    </pgraph>\n");
    g_free(camera);
}

static char *write_cut(const Cut *cut, const char *name) {
    const FrContents *contents = cut->contents;
    GString *out = g_string_new("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                                "<frond version=\"1\">\n");
    char *id = id_of_name(name);
    for (uint32_t i = fr_contents_at(contents, 0)->first; i != FR_NONE;
         i = fr_contents_at(contents, i)->next) {
        if (has(cut->used, i)) {
            char *text = studio_element_text(contents, i);
            add_line(out, "  ", text);
            g_free(text);
        }
    }
    while (studio_tag_find(contents, 0, STUDIO_TAG_PLANT, id) != FR_NONE &&
           has(cut->used, studio_tag_find(contents, 0, STUDIO_TAG_PLANT, id))) {
        char *other = g_strconcat(id, "_", NULL); // a plant that is grafted has the name
        g_free(id);
        id = other;
    }
    char *tag = plant_tag(contents, cut->plant, id);
    add_line(out, "  ", tag);
    for (uint32_t i = fr_contents_at(contents, cut->plant)->first; i != FR_NONE;
         i = fr_contents_at(contents, i)->next) {
        if (has(cut->used, i)) {
            char *text = studio_element_text(contents, i);
            add_line(out, "    ", text);
            g_free(text);
        }
    }
    write_graph(cut, out);
    g_string_append(out, "  </plant>\n</frond>\n");
    g_free(tag);
    g_free(id);
    return g_string_free(out, FALSE);
}

// What the components of a cut use; the material of its root, too, which may come from above.
static void find_used(Cut *cut) {
    GHashTableIter all;
    gpointer component;
    g_hash_table_iter_init(&all, cut->components);
    while (g_hash_table_iter_next(&all, &component, NULL)) {
        studio_add_used(cut->contents, cut->plant, GPOINTER_TO_UINT(component), cut->used);
    }
    char *material =
        inherited_material(cut->contents, cut->graph, cut->root, fr_contents_count(cut->contents));
    uint32_t element = studio_tag_find(cut->contents, 0, STUDIO_TAG_MATERIAL, material);
    if (material != NULL && element != FR_NONE) {
        g_hash_table_add(cut->used, GUINT_TO_POINTER(element));
        studio_add_used(cut->contents, cut->plant, element, cut->used);
    }
    g_free(material);
}

char *studio_subgraph_text(const StudioDocument *document, uint32_t plant, const char *id,
                           const char *name) {
    const FrContents *contents = studio_document_contents(document);
    uint32_t graph = studio_document_is_broken(document) ? FR_NONE : graph_of(contents, plant);
    uint32_t root = graph == FR_NONE ? FR_NONE : fr_contents_find(contents, graph, id);
    if (root == FR_NONE || fr_contents_at(contents, root)->component < 0) {
        return NULL;
    }
    Cut cut = {
        contents, plant, graph, root, g_hash_table_new(NULL, NULL), g_hash_table_new(NULL, NULL)};
    add_beneath(contents, graph, root, cut.components);
    find_used(&cut);
    char *text = write_cut(&cut, name);
    g_hash_table_unref(cut.components);
    g_hash_table_unref(cut.used);
    return text;
}

// ---- put in ------------------------------------------------------------------------------------

static bool is_led_to(const FrContents *contents, uint32_t graph, uint32_t component) {
    bool is_it = false;
    for (uint32_t link = fr_contents_child(contents, graph, "link"); link != FR_NONE && !is_it;
         link = fr_contents_sibling(contents, link)) {
        uint32_t from, to;
        is_it = link_ends(contents, graph, link, &from, &to) && to == component && from != to &&
                !is_camera(contents, from);
    }
    return is_it;
}

// The components of a graph that stand on nothing but its Camera, in order.
static GArray *roots_of(const FrContents *contents, uint32_t graph) {
    GArray *roots = g_array_new(FALSE, FALSE, sizeof(uint32_t));
    for (uint32_t i = fr_contents_at(contents, graph)->first; i != FR_NONE;
         i = fr_contents_at(contents, i)->next) {
        if (fr_contents_at(contents, i)->component > FR_COMPONENT_CAMERA &&
            !is_led_to(contents, graph, i)) {
            g_array_append_val(roots, i);
        }
    }
    return roots;
}

static void name_clashes(StudioNames *names, const FrContents *mine, uint32_t plant,
                         const FrContents *theirs, GHashTable *used) {
    const char *own = fr_contents_at(theirs, names->plant)->id;
    for (uint32_t i = 1; i < fr_contents_count(theirs); i++) {
        const FrContentsElement *at = fr_contents_at(theirs, i);
        StudioTag tag = studio_tag_of(theirs, i);
        bool is_part = tag == STUDIO_TAG_COMPONENT && at->component != FR_COMPONENT_CAMERA &&
                       fr_contents_at(theirs, at->parent)->parent == names->plant;
        if (at->id == NULL || (!is_part && !has(used, i))) {
            continue;
        }
        uint32_t inside = studio_tag_is_top(tag) ? 0 : plant;
        uint32_t same = is_part ? fr_contents_find(mine, plant, at->id)
                                : studio_tag_find(mine, inside, tag, at->id);
        if (same != FR_NONE && (is_part || !studio_is_same(mine, same, theirs, i))) {
            char *stem = is_part ? g_strdup(at->id) : g_strdup_printf("%s_%s", own, at->id);
            if (!is_part) {
                g_strdelimit(stem, "-", '_'); // in formulas it would be a minus
            }
            studio_names_add(names, mine, inside, theirs, i, stem);
            g_free(stem);
        }
    }
}

static char *components_xml(const FrContents *theirs, uint32_t graph) {
    GString *xml = g_string_new(NULL);
    for (uint32_t i = fr_contents_at(theirs, graph)->first; i != FR_NONE;
         i = fr_contents_at(theirs, i)->next) {
        if (fr_contents_at(theirs, i)->component > FR_COMPONENT_CAMERA) {
            char *text = studio_element_text(theirs, i);
            g_string_append_printf(xml, "%s%s", xml->len > 0 ? "\n" : "", text);
            g_free(text);
        }
    }
    return g_string_free(xml, FALSE);
}

static char *links_xml(const FrContents *theirs, uint32_t graph, const GArray *roots,
                       const char *parent, FrComponentKind parent_kind) {
    GString *xml = g_string_new(NULL);
    for (guint i = 0; parent != NULL && i < roots->len; i++) {
        const FrContentsElement *root = fr_contents_at(theirs, g_array_index(roots, uint32_t, i));
        char *text = studio_link_xml(
            parent, root->id, studio_likely_link(parent_kind, (FrComponentKind)root->component));
        g_string_append_printf(xml, "%s%s", xml->len > 0 ? "\n" : "", text);
        g_free(text);
    }
    for (uint32_t link = fr_contents_child(theirs, graph, "link"); link != FR_NONE;
         link = fr_contents_sibling(theirs, link)) {
        uint32_t from, to;
        if (link_ends(theirs, graph, link, &from, &to) && !is_camera(theirs, from)) {
            char *text = studio_element_text(theirs, link);
            g_string_append_printf(xml, "%s%s", xml->len > 0 ? "\n" : "", text);
            g_free(text);
        }
    }
    return g_string_free(xml, FALSE);
}

static char *sliders_xml(const FrContents *mine, uint32_t plant, const FrContents *theirs,
                         uint32_t their_plant, GHashTable *used) {
    GString *xml = g_string_new(NULL);
    for (uint32_t i = fr_contents_at(theirs, their_plant)->first; i != FR_NONE;
         i = fr_contents_at(theirs, i)->next) {
        uint32_t own =
            studio_tag_find(mine, plant, STUDIO_TAG_SLIDER, fr_contents_at(theirs, i)->id);
        if (has(used, i) && !studio_is_same(mine, own, theirs, i)) {
            char *text = studio_element_text(theirs, i);
            g_string_append_printf(xml, "%s%s", xml->len > 0 ? "\n" : "", text);
            g_free(text);
        }
    }
    return g_string_free(xml, FALSE);
}

static uint32_t last_slider(const FrContents *mine, uint32_t plant) {
    uint32_t last = FR_NONE;
    for (uint32_t i = fr_contents_child(mine, plant, "slider"); i != FR_NONE;
         i = fr_contents_sibling(mine, i)) {
        last = i;
    }
    return last;
}

static void add_insertion(GArray *splices, const FrContents *mine, uint32_t parent, uint32_t after,
                          char *xml) {
    if (*xml != '\0') {
        FrSplice splice = fr_contents_insert(mine, parent, after, xml);
        g_array_append_val(splices, splice);
    }
    g_free(xml);
}

// `theirs` with the names that it has here.
static bool insert(StudioDocument *document, uint32_t plant, const FrContents *theirs,
                   uint32_t their_plant, const char *parent, GHashTable *used, char **id) {
    const FrContents *mine = studio_document_contents(document);
    uint32_t graph = graph_of(theirs, their_plant), own = graph_of(mine, plant);
    uint32_t on = parent == NULL ? FR_NONE : fr_contents_find(mine, own, parent);
    FrComponentKind kind =
        on == FR_NONE ? FR_COMPONENT_CAMERA : (FrComponentKind)fr_contents_at(mine, on)->component;
    GArray *roots = roots_of(theirs, graph);
    GArray *splices = g_array_new(FALSE, FALSE, sizeof(FrSplice));
    add_insertion(splices, mine, 0, studio_adopt_behind(mine),
                  studio_adopt_xml(mine, theirs, used));
    add_insertion(splices, mine, plant, last_slider(mine, plant),
                  sliders_xml(mine, plant, theirs, their_plant, used));
    char *components = components_xml(theirs, graph);
    char *links = links_xml(theirs, graph, roots, on == FR_NONE ? NULL : parent, kind);
    studio_insert_component(document, own, components, links, splices);
    char *step = g_strdup_printf("Insert %s", fr_contents_at(theirs, their_plant)->id);
    if (id != NULL && roots->len > 0) {
        *id = g_strdup(fr_contents_at(theirs, g_array_index(roots, uint32_t, 0))->id);
    }
    bool is_changed = studio_document_splice(document, splices, step, NULL);
    g_free(step);
    g_free(links);
    g_free(components);
    g_array_unref(splices);
    g_array_unref(roots);
    return is_changed;
}

// What the components of a plant's graph use; not the plant itself.
static GHashTable *used_by(const FrContents *contents, uint32_t plant) {
    GHashTable *used = g_hash_table_new(NULL, NULL);
    studio_add_used(contents, plant, graph_of(contents, plant), used);
    g_hash_table_remove(used, GUINT_TO_POINTER(plant));
    return used;
}

static const char *why_not(const FrContents *theirs) {
    uint32_t plant = fr_contents_child(theirs, 0, "plant");
    if (plant == FR_NONE || fr_contents_at(theirs, plant)->id == NULL) {
        return "It has no plant";
    }
    uint32_t graph = graph_of(theirs, plant);
    if (graph == FR_NONE) {
        return "Its plant is not made of components";
    }
    GArray *roots = roots_of(theirs, graph);
    bool is_empty = roots->len == 0;
    g_array_unref(roots);
    return is_empty ? "Its graph has no components" : NULL;
}

GHashTable *studio_subgraph_elements(const FrContents *from) {
    uint32_t plant = fr_contents_child(from, 0, "plant");
    GHashTable *elements =
        why_not(from) == NULL ? used_by(from, plant) : g_hash_table_new(NULL, NULL);
    if (why_not(from) == NULL) {
        g_hash_table_add(elements, GUINT_TO_POINTER(graph_of(from, plant)));
    }
    return elements;
}

static FrContents *read_silently(FrSource *from) {
    FrContext context = fr_context_default();
    FrContents *contents;
    return fr_contents_read(from, &context, &contents) == FR_OK ? contents : NULL;
}

const char *studio_subgraph_refusal(FrSource *from) {
    FrContents *theirs = read_silently(from);
    const char *refusal = theirs == NULL ? "Its text is not right" : why_not(theirs);
    fr_contents_free(theirs);
    return refusal;
}

bool studio_insert_subgraph(StudioDocument *document, uint32_t plant, FrSource *from,
                            const char *parent, char **id) {
    if (id != NULL) {
        *id = NULL;
    }
    const FrContents *mine = studio_document_contents(document);
    FrContents *theirs =
        studio_document_is_broken(document) || mine == NULL || graph_of(mine, plant) == FR_NONE
            ? NULL
            : read_silently(from);
    bool is_changed = false;
    if (theirs != NULL && why_not(theirs) == NULL) {
        StudioNames names;
        uint32_t their_plant = fr_contents_child(theirs, 0, "plant");
        studio_names_init(&names, their_plant);
        GHashTable *used = used_by(theirs, their_plant);
        name_clashes(&names, mine, plant, theirs, used);
        FrContents *renamed = studio_renamed(theirs, &names);
        is_changed =
            renamed != NULL && insert(document, plant, renamed, their_plant, parent, used, id);
        fr_contents_free(renamed);
        g_hash_table_unref(used);
        studio_names_clear(&names);
    }
    fr_contents_free(theirs);
    return is_changed;
}
