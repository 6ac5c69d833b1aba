/// `--set`: one attribute's bytes are replaced, everything else stays as the user wrote it.
#include "document/reader.h"
#include "document/splice.h"

#include <string.h>

enum { LISTED_PATHS = 12 };

#define SET(id) ((FrElementSet)1 << FR_ELEMENT_##id)

/// An element that a path may name, with the names to reach it by.
typedef struct Target {
    uint32_t node;
    FrElementId element;
    char *name;  ///< its id or name; "scene", "lsystem", "vary", "lamp-2"
    char *plant; ///< id of the plant around it, NULL
    bool is_own; ///< the name is that of the element
} Target;

static void clear_target(void *data) {
    Target *target = data;
    g_free(target->name);
    g_free(target->plant);
}

/// Elements that a path calls by what they are.
static bool has_own_name(FrElementId element) {
    const FrElementSet named = SET(SCENE) | SET(SUN) | SET(LIGHT) | SET(TERRAIN) | SET(LSYSTEM) |
                               SET(RAMIFIED) | SET(NURBS) | SET(SPECIES) | SET(SLIDERS) |
                               SET(GROWTH) | SET(VARY);
    return (named >> element & 1) != 0;
}

/// What a path calls an element, or NULL.
static char *name_of(const FrXmlTree *tree, uint32_t node, FrElementId element) {
    if (has_own_name(element)) {
        return g_strdup(fr_element(element).name);
    }
    const FrXmlAttribute *attribute =
        fr_xml_attribute(tree, node, element == FR_ELEMENT_VIEW ? "name" : "id");
    return attribute == NULL ? NULL : fr_xml_decode(tree, attribute->value, true);
}

/// Lamps and obstacles without ids are called by what they are, and by their numbers where there
/// are several.
static void name_unnamed(const FrXmlTree *tree, GArray *targets, FrElementId element) {
    guint last = 0, count = 0;
    for (uint32_t node = 0; node < tree->node_count; node++) {
        if (tree->nodes[node].kind != FR_XML_ELEMENT ||
            !fr_xml_equals(tree, tree->nodes[node].name, fr_element(element).name)) {
            continue;
        }
        count++;
        if (fr_xml_attribute(tree, node, "id") == NULL) {
            const char *kind = fr_element(element).name;
            Target target = {node, element, g_strdup_printf("%s-%u", kind, count), NULL, false};
            g_array_append_val(targets, target);
            last = targets->len;
        }
    }
    if (count == 1 && last > 0) {
        Target *only = &g_array_index(targets, Target, last - 1);
        g_free(only->name);
        only->name = g_strdup(fr_element(element).name);
    }
}

static GArray *collect_targets(const FrXmlTree *tree) {
    GArray *targets = g_array_new(FALSE, FALSE, sizeof(Target));
    g_array_set_clear_func(targets, clear_target);
    char *plant = NULL;
    uint32_t plant_end = 0;
    for (uint32_t node = 0; node < tree->node_count; node++) {
        const FrXmlNode *at = &tree->nodes[node];
        if (at->kind != FR_XML_ELEMENT) {
            continue;
        }
        char *tag = fr_xml_name(tree, at->name);
        FrElementId element = fr_element_find(tag);
        g_free(tag);
        char *name = element == FR_ELEMENT_COUNT ? NULL : name_of(tree, node, element);
        if (name == NULL) {
            continue;
        }
        bool is_inside = plant != NULL && at->all.begin < plant_end;
        Target target = {node, element, name, is_inside ? g_strdup(plant) : NULL,
                         has_own_name(element)};
        g_array_append_val(targets, target);
        if (element == FR_ELEMENT_PLANT) {
            g_free(plant);
            plant = g_strdup(name);
            plant_end = at->all.end;
        }
    }
    g_free(plant);
    name_unnamed(tree, targets, FR_ELEMENT_LAMP);
    name_unnamed(tree, targets, FR_ELEMENT_OBSTACLE);
    return targets;
}

/// True if an element stands in a plant so called, or in the scene.
static bool is_within(const Target *target, const char *around) {
    const FrElementSet of_scene =
        SET(GROWTH) | SET(SUN) | SET(LIGHT) | SET(TERRAIN) | SET(LAMP) | SET(OBSTACLE);
    if (target->plant != NULL) {
        return strcmp(target->plant, around) == 0;
    }
    return (of_scene >> target->element & 1) != 0 && strcmp(around, "scene") == 0;
}

static bool matches(const Target *target, const char *plant, const char *name) {
    return strcmp(target->name, name) == 0 && (plant == NULL || is_within(target, plant));
}

/// `plant.component` or `component` for messages.
static char *path_of(const Target *target) {
    return target->plant == NULL ? g_strdup(target->name)
                                 : g_strdup_printf("%s.%s", target->plant, target->name);
}

/// `plant` may be NULL.
static void report_unknown(const GArray *targets, const char *plant, const char *asked,
                           FrDiags *diags) {
    GPtrArray *names = g_ptr_array_new_with_free_func(g_free);
    char *name = plant == NULL ? g_strdup(asked) : g_strdup_printf("%s.%s", plant, asked);
    GString *listed = g_string_new(NULL);
    for (guint i = 0; i < targets->len; i++) {
        const Target *target = &g_array_index(targets, Target, i);
        char *path = path_of(target);
        if (i < LISTED_PATHS) {
            g_string_append_printf(listed, "%s%s", i == 0 ? "" : ", ", path);
        }
        g_ptr_array_add(names, plant == NULL ? g_strdup(target->name) : g_strdup(path));
        g_free(path);
    }
    g_string_append(listed, targets->len > LISTED_PATHS ? ", …" : "");
    const char *near = fr_nearest_name(name, (const char *const *)names->pdata, names->len);
    if (near != NULL) {
        fr_diags_add(diags, FR_ERROR, "unknown-path", (FrSpan){0},
                     "nothing is called '%.64s'; did you mean '%s'?", name, near);
    } else {
        fr_diags_add(diags, FR_ERROR, "unknown-path", (FrSpan){0},
                     "nothing is called '%.64s'; there are: %s", name, listed->str);
    }
    g_string_free(listed, TRUE);
    g_ptr_array_unref(names);
    g_free(name);
}

/// The one element that `plant` (may be NULL) and `name` mean: what is of that name comes before
/// what has been given it as an id.
static const Target *find_target(const GArray *targets, const char *plant, const char *name,
                                 FrDiags *diags) {
    const Target *found = NULL;
    bool is_own = false;
    for (guint i = 0; i < targets->len; i++) {
        const Target *target = &g_array_index(targets, Target, i);
        is_own |= target->is_own && matches(target, plant, name);
    }
    for (guint i = 0; i < targets->len; i++) {
        const Target *target = &g_array_index(targets, Target, i);
        if (target->is_own != is_own || !matches(target, plant, name)) {
            continue;
        }
        if (found != NULL) {
            char *first = path_of(found), *second = path_of(target);
            fr_diags_add(diags, FR_ERROR, "ambiguous-path", (FrSpan){0},
                         "more than one thing is called '%s': '%s' and '%s'", name, first, second);
            g_free(first);
            g_free(second);
            return NULL;
        }
        found = target;
    }
    if (found == NULL) {
        report_unknown(targets, plant, name, diags);
    }
    return found;
}

/// The nearest slider of the plant that a target is, else the nearest attribute; NULL. Free with
/// g_free().
static char *suggest(const GArray *targets, const Target *target, const FrElement *element,
                     const char *name) {
    GPtrArray *sliders = g_ptr_array_new();
    for (guint i = 0; i < targets->len; i++) {
        const Target *other = &g_array_index(targets, Target, i);
        if (other->element == FR_ELEMENT_SLIDER && other->plant != NULL &&
            strcmp(other->plant, target->name) == 0) {
            g_ptr_array_add(sliders, other->name);
        }
    }
    bool is_plant = target->element == FR_ELEMENT_PLANT;
    char *near = g_strdup(
        fr_nearest_name(name, (const char *const *)sliders->pdata, is_plant ? sliders->len : 0));
    g_ptr_array_unref(sliders);
    return near != NULL || element->table == NULL ? near : fr_params_suggest(element->table, name);
}

/// The attribute's name as documents write it, or NULL with an error. Free with g_free().
static char *find_attribute_name(const GArray *targets, const Target *target, const char *name,
                                 FrDiags *diags) {
    FrElement element = fr_element(target->element);
    const FrParam *row = element.table == NULL ? NULL : fr_params_find(element.table, name);
    if (row != NULL) {
        return fr_param_attribute(row);
    }
    char *near = suggest(targets, target, &element, name);
    if (near != NULL) {
        fr_diags_add(diags, FR_ERROR, "unknown-path", (FrSpan){0},
                     "<%s> '%s' has no attribute '%.64s'; did you mean '%s'?", element.name,
                     target->name, name, near);
    } else {
        fr_diags_add(diags, FR_ERROR, "unknown-path", (FrSpan){0},
                     "<%s> '%s' has no attribute '%.64s'", element.name, target->name, name);
    }
    g_free(near);
    return NULL;
}

/// Passes on what is new: all if the edit failed, else only what concerns the value itself.
static void pass_on(const FrDiags *from, FrStatus status, FrXmlRange value, FrDiags *to) {
    for (size_t i = 0; i < fr_diags_count(from); i++) {
        const FrDiag *diag = fr_diags_get(from, i);
        bool is_of_value = diag->span.begin >= value.begin && diag->span.begin <= value.end;
        if (status != FR_OK || is_of_value) {
            fr_diags_add(to, diag->severity, diag->code, diag->span, "%s", diag->text);
        }
    }
}

/// Reads the edited text and, if it is right, lets the document become it.
static FrStatus replace_text(FrDocument *document, const char *text, size_t size, FrXmlRange value,
                             const FrContext *context) {
    FrSource *source = fr_source_new(fr_document_name(document), text, size);
    FrContext inner = *context;
    inner.diags = fr_diags_new();
    FrDocument *edited;
    FrStatus status = fr_document_parse(source, document->folder, &inner, &edited);
    pass_on(inner.diags, status, value, context->diags);
    if (status == FR_OK) {
        FrDocument old = *document;
        *document = *edited;
        *edited = old;
    }
    fr_document_free(edited);
    fr_diags_free(inner.diags);
    fr_source_unref(source);
    return status;
}

/// `plant.slider`: the slider, and its value as the attribute that is meant. Else the target
/// itself.
static const Target *slider_of(const GArray *targets, const Target *target,
                               const char **attribute) {
    bool is_row = fr_params_find(fr_element(FR_ELEMENT_PLANT).table, *attribute) != NULL;
    for (guint i = 0; target->element == FR_ELEMENT_PLANT && !is_row && i < targets->len; i++) {
        const Target *other = &g_array_index(targets, Target, i);
        if (other->element == FR_ELEMENT_SLIDER && matches(other, target->name, *attribute)) {
            *attribute = "value";
            return other;
        }
    }
    return target;
}

static FrStatus set_target(FrDocument *document, const GArray *targets, const Target *target,
                           const char *attribute, const char *value, const FrContext *context) {
    char *name = find_attribute_name(targets, target, attribute, context->diags);
    if (name == NULL) {
        return FR_ERR_USAGE;
    }
    FrXmlRange range;
    GArray *splices = g_array_new(FALSE, FALSE, sizeof(FrSplice));
    FrSplice splice = fr_splice_attribute(document->tree, target->node, name, value, &range);
    g_array_append_val(splices, splice);
    size_t size;
    char *text = fr_splice_apply(document->tree, splices, &size);
    FrStatus status = replace_text(document, text, size, range, context);
    g_free(text);
    g_array_unref(splices);
    g_free(name);
    return status;
}

FrStatus fr_document_set(FrDocument *document, const char *path, const char *value,
                         const FrContext *context) {
    char **parts = g_strsplit(path, ".", 4);
    guint count = g_strv_length(parts);
    FrStatus status = FR_ERR_USAGE;
    if (!g_utf8_validate(value, -1, NULL)) {
        fr_diags_add(context->diags, FR_ERROR, "encoding", (FrSpan){0},
                     "the value for '%.64s' is not UTF-8: '%.64s'", path, value);
    } else if (count < 2 || count > 3) {
        fr_diags_add(context->diags, FR_ERROR, "bad-path", (FrSpan){0},
                     "'%.64s' is not of the form id.attribute or plant.component.attribute", path);
    } else {
        GArray *targets = collect_targets(document->tree);
        const Target *target =
            find_target(targets, count == 3 ? parts[0] : NULL, parts[count - 2], context->diags);
        if (target != NULL) {
            const char *attribute = parts[count - 1];
            target = slider_of(targets, target, &attribute);
            status = set_target(document, targets, target, attribute, value, context);
        }
        g_array_unref(targets);
    }
    g_strfreev(parts);
    return status;
}
