// What can be wrong with a p-graph before anything is made of it.
#include "material/mesh_file.h"
#include "pgraph/choice.h"
#include "pgraph/global.h"
#include "pgraph/prepare.h"

#include <cglm/struct.h>
#include <string.h>

static FrStatus check_roots(const FrPgraph *graph, const FrRecursions *recursions, FrDiags *diags,
                            bool with_warnings) {
    uint32_t count = fr_pgraph_count(graph);
    if (count == 0) {
        fr_diags_add(diags, FR_ERROR, "no-component", (FrSpan){0}, "the plant '%s' is empty",
                     graph->name);
        return FR_ERR_DOCUMENT;
    }
    for (uint32_t k = 1; k < recursions->roots->len; k++) {
        uint32_t root = g_array_index(recursions->roots, uint32_t, k);
        if (fr_pgraph_kind(graph, root) == FR_COMPONENT_CAMERA) {
            fr_diags_add(diags, FR_ERROR, "second-camera", fr_pgraph_prototype(graph, root)->span,
                         "'%s' is a second camera; a plant has one root",
                         fr_pgraph_id(graph, root));
            return FR_ERR_DOCUMENT;
        }
    }
    for (uint32_t c = 0; c < count && with_warnings; c++) {
        if (!recursions->is_reached[c]) {
            fr_diags_add(diags, FR_WARNING, "unreachable-component",
                         fr_pgraph_prototype(graph, c)->span,
                         "no way from the camera leads to '%s', so it is never made",
                         fr_pgraph_id(graph, c));
        }
    }
    return FR_OK;
}

static FrStatus check_recursions(const FrPgraph *graph, const FrRecursions *recursions,
                                 FrDiags *diags, bool with_warnings) {
    uint32_t endless = fr_recursions_endless_link(recursions, graph);
    if (endless != FR_NONE) {
        const FrPgraphLink *link = fr_pgraph_link_at(graph, endless);
        fr_diags_add(diags, FR_ERROR, "endless-recursion", link->span,
                     "the link from '%s' to '%s' closes a recursion that never ends; give one of "
                     "its components a depth",
                     fr_pgraph_id(graph, link->from), fr_pgraph_id(graph, link->to));
        return FR_ERR_DOCUMENT;
    }
    for (uint32_t c = 0; c < fr_pgraph_count(graph) && with_warnings; c++) {
        if (fr_pgraph_basic(graph, c)->depth > 1 && !recursions->is_recursive[c]) {
            fr_diags_add(diags, FR_WARNING, "depth-without-recursion",
                         fr_pgraph_prototype(graph, c)->span,
                         "'%s' has a depth but no link leads back to it, so it is made once",
                         fr_pgraph_id(graph, c));
        }
    }
    return FR_OK;
}

// What is read from a file must name one.
static FrStatus check_file(const FrPrototype *prototype, FrDiags *diags) {
    const FrStemParams *stem = prototype->params;
    const FrSimpleParams *simple = prototype->params;
    const FrForceParams *force = prototype->params;
    const FrScatterParams *scatter = prototype->params;
    const char *name = NULL;
    bool is_wanted = false;
    switch (prototype->kind) {
    case FR_COMPONENT_HORN:
    case FR_COMPONENT_TREE:
        is_wanted = stem->primitive == FR_PRIMITIVE_MESH;
        name = stem->file;
        break;
    case FR_COMPONENT_SIMPLE:
        is_wanted = simple->primitive == FR_PRIMITIVE_MESH;
        name = simple->file;
        break;
    case FR_COMPONENT_SCATTER:
        is_wanted = scatter->surface == FR_SCATTER_MESH;
        name = scatter->file;
        break;
    case FR_COMPONENT_FORCE:
        is_wanted = force->kind == FR_FORCE_TO_MESH;
        name = force->file;
        break;
    default:
        break;
    }
    if (is_wanted && (name == NULL || *name == '\0')) {
        fr_diags_add(diags, FR_ERROR, "missing-attribute", prototype->span,
                     "'%s' needs the attribute 'file': what its triangles are read from",
                     prototype->id);
        return FR_ERR_DOCUMENT;
    }
    bool is_fine = !is_wanted || fr_mesh_name_check(name, prototype->span, diags);
    return is_fine ? FR_OK : FR_ERR_DOCUMENT;
}

static bool is_in_one_place(const GArray *points) {
    const vec3s *at = (const vec3s *)(const void *)points->data;
    bool is_one = true;
    for (guint k = 1; k < points->len && is_one; k++) {
        is_one = memcmp(at[k].raw, at[0].raw, sizeof at[0].raw) == 0;
    }
    return is_one;
}

// The path that a component follows, if it does.
static const char *path_of(const FrPrototype *prototype) {
    const FrStemParams *stem = prototype->params;
    const FrForceParams *force = prototype->params;
    const FrFfdParams *ffd = prototype->params;
    switch (prototype->kind) {
    case FR_COMPONENT_HORN:
    case FR_COMPONENT_TREE:
        return stem->course == FR_COURSE_PATH ? stem->path : NULL;
    case FR_COMPONENT_FORCE:
        return force->kind == FR_FORCE_TO_CURVE ? force->path : NULL;
    case FR_COMPONENT_FFD:
        return ffd->preset == FR_PRESET_CURVE ? ffd->path : NULL;
    default:
        return NULL;
    }
}

static void warn_of_outline(const FrPrototype *prototype, const FrPoints *outline, FrDiags *diags) {
    for (size_t k = 0; k < outline->count; k++) {
        if (outline->at[k][0] < 0) {
            fr_diags_add(diags, FR_WARNING, "negative-radius", prototype->span,
                         "a radius of the outline of '%s' is %g; less than 0 counts as 0",
                         prototype->id, outline->at[k][0]);
            return;
        }
    }
}

// What is allowed and yet comes to nothing.
static void warn_of_own(const FrPrototype *prototype, FrDiags *diags) {
    const FrStemParams *stem = prototype->params;
    const FrRevoParams *revo = prototype->params;
    const FrPhyllotaxisParams *phyllotaxis = prototype->params;
    const char *path = path_of(prototype);
    GArray *points = path != NULL ? fr_path_points(path, prototype, NULL) : NULL;
    if (points != NULL && is_in_one_place(points)) {
        fr_diags_add(diags, FR_WARNING, "path-without-length", prototype->span,
                     "the points of the path of '%s' are all in one place, so it has no length",
                     prototype->id);
    }
    g_clear_pointer(&points, g_array_unref);
    if (prototype->kind == FR_COMPONENT_REVO) {
        warn_of_outline(prototype, &revo->outline, diags);
    } else if (prototype->kind == FR_COMPONENT_PHYLLOTAXIS) {
        warn_of_outline(prototype, &phyllotaxis->outline, diags);
    }
    bool aims = (prototype->kind == FR_COMPONENT_HORN || prototype->kind == FR_COMPONENT_TREE) &&
                !(stem->aim.is_constant && stem->aim.constant == 0);
    if (aims && glms_vec3_norm(stem->aim_at) == 0) {
        fr_diags_add(diags, FR_WARNING, "aim-without-direction", prototype->span,
                     "'%s' aims at 0,0,0, which is no direction, so it turns nowhere",
                     prototype->id);
    }
}

static FrStatus check_own(const FrPgraph *graph, uint32_t component, FrDiags *diags) {
    const FrPrototype *prototype = fr_pgraph_prototype(graph, component);
    if (prototype->kind == FR_COMPONENT_VARIATION) {
        GArray *weights = fr_weights_new(graph, component, diags);
        FrStatus status = weights != NULL ? FR_OK : FR_ERR_DOCUMENT;
        g_clear_pointer(&weights, g_array_unref);
        return status;
    }
    if (fr_is_global(prototype->kind)) {
        return fr_check_global(prototype, diags);
    }
    const FrRevoParams *revo = prototype->params;
    if (prototype->kind == FR_COMPONENT_REVO &&
        (revo->outline.count < 2 || revo->outline.count > FR_MOST_OUTLINE_POINTS)) {
        fr_diags_add(diags, FR_ERROR, "wrong-outline", prototype->span,
                     "the outline of '%s' must be two to %d points radius,height", prototype->id,
                     FR_MOST_OUTLINE_POINTS);
        return FR_ERR_DOCUMENT;
    }
    return FR_OK;
}

static FrStatus check_texts(const FrPgraph *graph, FrDiags *diags) {
    FrStatus status = FR_OK;
    for (uint32_t c = 0; c < fr_pgraph_count(graph); c++) {
        const FrPrototype *prototype = fr_pgraph_prototype(graph, c);
        uint32_t material;
        FrFlags flags;
        if (fr_find_material(graph, c, &material, diags) != FR_OK ||
            fr_flags_parse(&flags, fr_pgraph_basic(graph, c)->only, prototype->id, prototype->span,
                           diags) != FR_OK) {
            status = FR_ERR_DOCUMENT;
            continue;
        }
        fr_flags_clear(&flags);
        status = check_own(graph, c, diags) == FR_OK ? status : FR_ERR_DOCUMENT;
        status = check_file(prototype, diags) == FR_OK ? status : FR_ERR_DOCUMENT;
        bool is_stem = prototype->kind == FR_COMPONENT_HORN || prototype->kind == FR_COMPONENT_TREE;
        const FrStemParams *stem = prototype->params;
        if (is_stem && stem->course == FR_COURSE_PATH) {
            GArray *points = fr_path_points(stem->path, prototype, diags);
            status = points == NULL ? FR_ERR_DOCUMENT : status;
            g_clear_pointer(&points, g_array_unref);
        }
    }
    return status;
}

FrStatus fr_pgraph_check_all(const FrPgraph *graph, const FrRecursions *recursions, FrDiags *diags,
                             bool with_warnings) {
    FrStatus roots = check_roots(graph, recursions, diags, with_warnings);
    FrStatus endless = check_recursions(graph, recursions, diags, with_warnings);
    FrStatus texts = check_texts(graph, diags);
    for (uint32_t c = 0; c < fr_pgraph_count(graph) && with_warnings; c++) {
        warn_of_own(fr_pgraph_prototype(graph, c), diags);
    }
    return roots != FR_OK ? roots : endless != FR_OK ? endless : texts;
}

FrStatus fr_pgraph_check(const FrPgraph *graph, FrDiags *diags) {
    FrRecursions recursions;
    fr_recursions_find(&recursions, graph);
    FrStatus status = fr_pgraph_check_all(graph, &recursions, diags, true);
    fr_recursions_clear(&recursions);
    return status;
}
