#include "studio/model/commands_private.h"

#include <stdarg.h>
#include <string.h>

static const FrContents *contents_of(const StudioDocument *document) {
    return studio_document_contents(document);
}

static const FrContentsElement *at(const StudioDocument *document, uint32_t element) {
    return fr_contents_at(contents_of(document), element);
}

static GArray *new_splices(void) {
    return g_array_new(FALSE, FALSE, sizeof(FrSplice));
}

static void add_splice(GArray *splices, FrSplice splice) {
    g_array_append_val(splices, splice);
}

static bool do_splices(StudioDocument *document, GArray *splices, const char *format,
                       const char *what, const char *key) {
    char *name = g_strdup_printf(format, what);
    bool is_changed = studio_document_splice(document, splices, name, key);
    g_free(name);
    g_array_unref(splices);
    return is_changed;
}

static const char *title_of(const FrContentsElement *element) {
    return element->id != NULL ? element->id : element->name;
}

// ---- attributes --------------------------------------------------------------------------------

static bool is_default(const FrContentsElement *element, const char *attribute, const char *value) {
    const FrParam *row = element->table == NULL ? NULL : fr_params_find(element->table, attribute);
    return row != NULL && strcmp(row->default_text, value) == 0;
}

bool studio_set(StudioDocument *document, uint32_t element, const char *attribute,
                const char *value, bool is_drag) {
    const FrContents *contents = contents_of(document);
    const FrContentsElement *what = fr_contents_at(contents, element);
    char *old = fr_contents_get(contents, element, attribute);
    bool is_away = value == NULL || (old == NULL && is_default(what, attribute, value));
    FrSplice splice = fr_contents_set(contents, element, attribute, is_away ? NULL : value);
    char *name =
        g_strdup_printf(is_away ? "Reset %s of %s" : "Change %s of %s", attribute, title_of(what));
    char *key = is_drag ? g_strdup_printf("%u.%s", element, attribute) : NULL;
    bool is_changed = studio_document_splice_one(document, splice, name, key);
    g_free(key);
    g_free(name);
    g_free(old);
    return is_changed;
}

bool studio_reset_all(StudioDocument *document, uint32_t element) {
    const FrContents *contents = contents_of(document);
    const FrContentsElement *what = fr_contents_at(contents, element);
    GArray *splices = new_splices();
    for (size_t i = 0; what->table != NULL && i < what->table->count; i++) {
        char *attribute = fr_param_attribute(&what->table->rows[i]);
        char *old = fr_contents_get(contents, element, attribute);
        if (old != NULL && !g_str_equal(attribute, "plant") && !g_str_equal(attribute, "at")) {
            add_splice(splices, fr_contents_set(contents, element, attribute, NULL));
        }
        g_free(old);
        g_free(attribute);
    }
    return do_splices(document, splices, "Reset %s", title_of(what), NULL);
}

// ---- components --------------------------------------------------------------------------------

uint32_t studio_graph_of(const StudioDocument *document, uint32_t plant) {
    return plant == FR_NONE ? FR_NONE : fr_contents_child(contents_of(document), plant, "pgraph");
}

char *studio_free_id(const StudioDocument *document, uint32_t plant, const char *stem) {
    const FrContents *contents = contents_of(document);
    char *id = g_strdup(stem);
    size_t length = strlen(stem);
    while (length > 1 && g_ascii_isdigit(stem[length - 1])) {
        length--;
    }
    for (uint32_t k = 2; fr_contents_find(contents, plant, id) != FR_NONE; k++) {
        g_free(id);
        id = g_strdup_printf("%.*s%u", (int)length, stem, k);
    }
    return id;
}

FrLinkKind studio_likely_link(FrComponentKind from, FrComponentKind to) {
    bool is_along = to == FR_COMPONENT_TREE || to == FR_COMPONENT_LEAF || to == FR_COMPONENT_HORN;
    return from == FR_COMPONENT_TREE && is_along ? FR_LINK_BRANCH : FR_LINK_CHILD;
}

const char *studio_link_words(FrLinkKind kind, FrComponentKind from) {
    bool is_stem = from == FR_COMPONENT_TREE || from == FR_COMPONENT_HORN;
    bool is_many = from == FR_COMPONENT_PHIBALL || from == FR_COMPONENT_HYDRA ||
                   from == FR_COMPONENT_WREATH || from == FR_COMPONENT_PHYLLOTAXIS ||
                   from == FR_COMPONENT_SCATTER;
    switch (kind) {
    case FR_LINK_BRANCH:
        return from == FR_COMPONENT_TREE ? "along the stem" : "as a child";
    case FR_LINK_LEAF:
        return "after the last repetition";
    case FR_LINK_SYMBOL:
        return "at each symbol";
    default:
        return is_stem ? "at the tip" : is_many ? "on each place" : "on it";
    }
}

// The `<link>` behind the last element that may stand before links; all of a graph.
char *studio_link_xml(const char *from, const char *to, FrLinkKind kind) {
    static const char *const kinds[] = {"", " kind=\"branch\"", " kind=\"leaf\"", ""};
    char *ends = g_markup_printf_escaped("<link from=\"%s\" to=\"%s\"", from, to);
    char *xml =
        g_strconcat(ends, kinds[kind], "/>", NULL); // a kind is markup, so it is not escaped
    g_free(ends);
    return xml;
}

static uint32_t last_component(const FrContents *contents, uint32_t graph) {
    uint32_t last = FR_NONE;
    for (uint32_t i = fr_contents_at(contents, graph)->first; i != FR_NONE;
         i = fr_contents_at(contents, i)->next) {
        last = fr_contents_at(contents, i)->component >= 0 ? i : last;
    }
    return last;
}

static uint32_t find_component(const StudioDocument *document, uint32_t plant, const char *id) {
    uint32_t graph = studio_graph_of(document, plant);
    return graph == FR_NONE ? FR_NONE : fr_contents_find(contents_of(document), graph, id);
}

// Puts a component, and links if `links` is not empty, into a graph. Where both go to the same
// place they are one insertion.
void studio_insert_component(const StudioDocument *document, uint32_t graph, const char *xml,
                             const char *links, GArray *splices) {
    const FrContents *contents = contents_of(document);
    uint32_t after = last_component(contents, graph);
    bool has_links = fr_contents_child(contents, graph, "link") != FR_NONE;
    if (has_links && *links != '\0' && after != FR_NONE) {
        add_splice(splices, fr_contents_insert(contents, graph, after, xml));
        add_splice(splices, fr_contents_insert(contents, graph, FR_NONE, links));
    } else {
        char *both = g_strconcat(xml, *links == '\0' ? "" : "\n", links, NULL);
        add_splice(splices, fr_contents_insert(contents, graph, after, both));
        g_free(both);
    }
}

// A material of the document that suits: of a leaf's picture for leaves, of a bark's for stems.
static char *suiting_material(const FrContents *contents, FrComponentKind kind) {
    bool is_stem = kind == FR_COMPONENT_TREE || kind == FR_COMPONENT_HORN;
    const char *wanted = is_stem ? "bark" : kind == FR_COMPONENT_LEAF ? "leaf" : NULL;
    uint32_t material = fr_contents_child(contents, 0, "material");
    for (; wanted != NULL && material != FR_NONE;
         material = fr_contents_sibling(contents, material)) {
        char *texture = fr_contents_get(contents, material, "texture");
        bool is_it = texture != NULL && g_str_has_prefix(texture, wanted);
        g_free(texture);
        if (is_it) {
            return g_strdup(fr_contents_at(contents, material)->id);
        }
    }
    return NULL;
}

bool studio_add_component(StudioDocument *document, uint32_t plant, FrComponentKind kind,
                          const char *parent, char **id) {
    uint32_t graph = studio_graph_of(document, plant);
    const char *element = fr_pgraph_table(kind)->element;
    uint32_t on = parent == NULL ? FR_NONE : find_component(document, plant, parent);
    if (graph == FR_NONE || (parent != NULL && on == FR_NONE)) {
        return false;
    }
    char *own = studio_free_id(document, plant, element);
    char *material = suiting_material(contents_of(document), kind);
    char *dress =
        material == NULL ? g_strdup("") : g_markup_printf_escaped(" material=\"%s\"", material);
    char *xml = g_strdup_printf("<%s id=\"%s\"%s/>", element, own, dress);
    g_free(dress);
    g_free(material);
    char *link = on == FR_NONE
                     ? g_strdup("")
                     : studio_link_xml(
                           parent, own,
                           studio_likely_link((FrComponentKind)at(document, on)->component, kind));
    GArray *splices = new_splices();
    studio_insert_component(document, graph, xml, link, splices);
    bool is_changed = do_splices(document, splices, "Add %s", own, NULL);
    g_free(link);
    g_free(xml);
    if (id != NULL) {
        *id = own;
    } else {
        g_free(own);
    }
    return is_changed;
}

static bool link_is(const FrContents *contents, uint32_t link, const char *end, const char *id) {
    char *value = fr_contents_get(contents, link, end);
    bool is_it = g_strcmp0(value, id) == 0;
    g_free(value);
    return is_it;
}

static uint32_t first_link(const StudioDocument *document, uint32_t plant) {
    uint32_t graph = studio_graph_of(document, plant);
    return graph == FR_NONE ? FR_NONE : fr_contents_child(contents_of(document), graph, "link");
}

const char *studio_link_refusal(const StudioDocument *document, uint32_t plant, const char *from,
                                const char *to) {
    const FrContents *contents = contents_of(document);
    uint32_t second = find_component(document, plant, to);
    if (second == FR_NONE || find_component(document, plant, from) == FR_NONE) {
        return "There is no such component";
    }
    if (at(document, second)->component == FR_COMPONENT_CAMERA) {
        return "Everything begins at the camera: nothing leads to it";
    }
    for (uint32_t link = first_link(document, plant); link != FR_NONE;
         link = fr_contents_sibling(contents, link)) {
        if (link_is(contents, link, "from", from) && link_is(contents, link, "to", to)) {
            return "The two are linked already";
        }
    }
    return NULL;
}

bool studio_add_link(StudioDocument *document, uint32_t plant, const char *from, const char *to,
                     FrLinkKind kind) {
    if (studio_link_refusal(document, plant, from, to) != NULL) {
        return false;
    }
    const FrContents *contents = contents_of(document);
    uint32_t target = find_component(document, plant, to);
    GArray *splices = new_splices();
    char *xml = studio_link_xml(from, to, kind);
    add_splice(splices,
               fr_contents_insert(contents, studio_graph_of(document, plant), FR_NONE, xml));
    char *depth = fr_contents_get(contents, target, "depth");
    if (strcmp(from, to) == 0 && depth == NULL) {
        add_splice(splices, fr_contents_set(contents, target, "depth", "3"));
    }
    g_free(depth);
    g_free(xml);
    return do_splices(document, splices, "Link to %s", to, NULL);
}

bool studio_set_link_kind(StudioDocument *document, uint32_t link, FrLinkKind kind) {
    static const char *const kinds[] = {NULL, "branch", "leaf", NULL};
    return studio_document_splice_one(
        document, fr_contents_set(contents_of(document), link, "kind", kinds[kind]),
        "Change a link", NULL);
}

bool studio_remove_link(StudioDocument *document, uint32_t link) {
    return studio_document_splice_one(document, fr_contents_remove(contents_of(document), link),
                                      "Remove a link", NULL);
}

bool studio_remove_component(StudioDocument *document, uint32_t plant, const char *id) {
    uint32_t component = find_component(document, plant, id);
    if (component == FR_NONE) {
        return false;
    }
    const FrContents *contents = contents_of(document);
    GArray *splices = new_splices();
    add_splice(splices, fr_contents_remove(contents, component));
    for (uint32_t link = first_link(document, plant); link != FR_NONE;
         link = fr_contents_sibling(contents, link)) {
        if (link_is(contents, link, "from", id) || link_is(contents, link, "to", id)) {
            add_splice(splices, fr_contents_remove(contents, link));
        }
    }
    return do_splices(document, splices, "Remove %s", id, NULL);
}

// The element's text with another id. Free with g_free().
static char *copied_xml(const StudioDocument *document, uint32_t component, const char *id) {
    const FrContents *contents = contents_of(document);
    const FrContentsElement *element = at(document, component);
    FrSpan old = fr_contents_span(contents, component, "id");
    const char *text = fr_source_text(fr_contents_source(contents), NULL);
    return g_strdup_printf("%.*s%s%.*s", (int)(old.begin - element->begin), text + element->begin,
                           id, (int)(element->end - old.end), text + old.end);
}

bool studio_duplicate_component(StudioDocument *document, uint32_t plant, const char *id,
                                bool with_children, char **copy) {
    uint32_t component = find_component(document, plant, id);
    if (component == FR_NONE || at(document, component)->component == FR_COMPONENT_CAMERA) {
        return false;
    }
    const FrContents *contents = contents_of(document);
    char *own = studio_free_id(document, plant, id);
    GString *links = g_string_new(NULL);
    for (uint32_t link = first_link(document, plant); link != FR_NONE;
         link = fr_contents_sibling(contents, link)) {
        bool is_from = link_is(contents, link, "from", id),
             is_to = link_is(contents, link, "to", id);
        if (!is_to && !(is_from && with_children)) {
            continue;
        }
        char *kind = fr_contents_get(contents, link, "kind");
        char *from = fr_contents_get(contents, link, "from"),
             *to = fr_contents_get(contents, link, "to");
        FrLinkKind which = g_strcmp0(kind, "branch") == 0 ? FR_LINK_BRANCH
                           : g_strcmp0(kind, "leaf") == 0 ? FR_LINK_LEAF
                                                          : FR_LINK_CHILD;
        char *xml = studio_link_xml(is_from ? own : from, is_to ? own : to, which);
        g_string_append_printf(links, "%s%s", links->len == 0 ? "" : "\n", xml);
        g_free(xml);
        g_free(kind);
        g_free(from);
        g_free(to);
    }
    char *xml = copied_xml(document, component, own);
    GArray *splices = new_splices();
    studio_insert_component(document, studio_graph_of(document, plant), xml, links->str, splices);
    bool is_changed = do_splices(document, splices, "Duplicate %s", id, NULL);
    g_string_free(links, TRUE);
    g_free(xml);
    if (copy != NULL) {
        *copy = own;
    } else {
        g_free(own);
    }
    return is_changed;
}

bool studio_enable_component(StudioDocument *document, uint32_t plant, const char *id,
                             bool is_enabled) {
    uint32_t component = find_component(document, plant, id);
    GArray *splices = new_splices();
    if (component != FR_NONE) {
        add_splice(splices, fr_contents_set(contents_of(document), component, "enabled",
                                            is_enabled ? NULL : "no"));
    }
    return do_splices(document, splices, is_enabled ? "Enable %s" : "Disable %s", id, NULL);
}

// ---- names -------------------------------------------------------------------------------------

// A path with one id replaced by another. Free with g_free().
static char *renamed_path(const char *path, const char *id, const char *to) {
    char **steps = g_strsplit(path, "/", -1);
    for (char **step = steps; *step != NULL; step++) {
        size_t size = strcspn(*step, "[~");
        if (size == strlen(id) && strncmp(*step, id, size) == 0) {
            char *new = g_strconcat(to, *step + size, NULL);
            g_free(*step);
            *step = new;
        }
    }
    char *joined = g_strjoinv("/", steps);
    g_strfreev(steps);
    return joined;
}

static void rename_edits(const StudioDocument *document, uint32_t plant, const char *id,
                         const char *to, GArray *splices) {
    const FrContents *contents = contents_of(document);
    uint32_t edits = fr_contents_child(contents, plant, "edits");
    uint32_t edit = edits == FR_NONE ? FR_NONE : fr_contents_child(contents, edits, "edit");
    for (; edit != FR_NONE; edit = fr_contents_sibling(contents, edit)) {
        char *path = fr_contents_get(contents, edit, "at");
        char *new = path == NULL ? NULL : renamed_path(path, id, to);
        if (new != NULL && strcmp(new, path) != 0) {
            add_splice(splices, fr_contents_set(contents, edit, "at", new));
        }
        if (link_is(contents, edit, "replace", id)) {
            add_splice(splices, fr_contents_set(contents, edit, "replace", to));
        }
        g_free(new);
        g_free(path);
    }
}

bool studio_rename_component(StudioDocument *document, uint32_t plant, const char *id,
                             const char *to) {
    const FrContents *contents = contents_of(document);
    uint32_t component = find_component(document, plant, id);
    if (component == FR_NONE || !fr_contents_is_id(to) ||
        fr_contents_find(contents, plant, to) != FR_NONE) {
        return false;
    }
    GArray *splices = new_splices();
    add_splice(splices, fr_contents_set(contents, component, "id", to));
    for (uint32_t link = first_link(document, plant); link != FR_NONE;
         link = fr_contents_sibling(contents, link)) {
        if (link_is(contents, link, "from", id)) {
            add_splice(splices, fr_contents_set(contents, link, "from", to));
        }
        if (link_is(contents, link, "to", id)) {
            add_splice(splices, fr_contents_set(contents, link, "to", to));
        }
    }
    rename_edits(document, plant, id, to, splices);
    return do_splices(document, splices, "Rename %s", id, NULL);
}

// ---- edits by hand -----------------------------------------------------------------------------

static uint32_t find_edit(const FrContents *contents, uint32_t edits, const char *path) {
    uint32_t edit = edits == FR_NONE ? FR_NONE : fr_contents_child(contents, edits, "edit");
    while (edit != FR_NONE && !link_is(contents, edit, "at", path)) {
        edit = fr_contents_sibling(contents, edit);
    }
    return edit;
}

bool studio_edit_instance(StudioDocument *document, uint32_t plant, const char *path,
                          const char *name, ...) {
    const FrContents *contents = contents_of(document);
    uint32_t edits = fr_contents_child(contents, plant, "edits");
    uint32_t edit = find_edit(contents, edits, path);
    GArray *splices = new_splices();
    GString *xml = g_string_new(NULL);
    va_list list;
    va_start(list, name);
    const char *attribute;
    while ((attribute = va_arg(list, const char *)) != NULL) {
        const char *value = va_arg(list, const char *);
        if (edit != FR_NONE) {
            add_splice(splices, fr_contents_set(contents, edit, attribute, value));
        } else {
            char *pair = g_markup_printf_escaped(" %s=\"%s\"", attribute, value);
            g_string_append(xml, pair);
            g_free(pair);
        }
    }
    va_end(list);
    if (edit == FR_NONE) {
        char *element = g_markup_printf_escaped("<edit at=\"%s\"", path);
        char *whole = g_strdup_printf(edits == FR_NONE ? "<edits>\n  %s%s/>\n</edits>" : "%s%s/>",
                                      element, xml->str);
        add_splice(splices,
                   fr_contents_insert(contents, edits == FR_NONE ? plant : edits, FR_NONE, whole));
        g_free(whole);
        g_free(element);
    }
    g_string_free(xml, TRUE);
    return do_splices(document, splices, name, path, NULL);
}
