#include "pgraph/prepare.h"

#include "frond/distance.h"
#include "pgraph/along.h"
#include "pgraph/choice.h"
#include "pgraph/edit.h"
#include "pgraph/global.h"
#include "pgraph/life.h"
#include "pgraph/ramp.h"
#include "pgraph/revolved.h"
#include "pgraph/strewn.h"

#include <math.h>
#include <string.h>

enum { CURVE_POINTS = 33, MOST_PATH_INTERNODES = 1000, INTERNODES_PER_SPAN = 8 };
enum { MOST_SUGGESTIONS = 20 }; // as many errors as are shown

static bool is_always(const FrNumber *number, double value) {
    return number->is_constant && number->constant == value;
}

static void note_variation(FrPrepared *made, const FrParamTable *table, bool has_ramps) {
    for (size_t row = 0; row < table->count; row++) {
        if (table->rows[row].kind == FR_PARAM_NUMBER && (has_ramps || row != FR_BASIC_ramp_at)) {
            const FrNumber *number =
                (const FrNumber *)((const char *)made->params + table->rows[row].offset);
            made->varies |= !number->is_constant;
            made->uses_place |= fr_uses_place(number);
        }
    }
    const FrBasicParams *basic = made->params;
    made->is_unmoved = is_always(&basic->translate_x, 0) && is_always(&basic->translate_y, 0) &&
                       is_always(&basic->translate_z, 0) && is_always(&basic->rotate_x, 0) &&
                       is_always(&basic->rotate_y, 0) && is_always(&basic->rotate_z, 0);
    made->is_drawn = !is_always(&basic->tropism_x, 0) || !is_always(&basic->tropism_y, 0) ||
                     !is_always(&basic->tropism_z, 0);
}

// The number of children, where it is given.
static void note_number(FrPrepared *made) {
    made->number_times = 1;
    if (made->kind == FR_COMPONENT_PHIBALL || made->kind == FR_COMPONENT_PHYLLOTAXIS) {
        made->number = &((const FrGoldenParams *)made->params)->number;
        made->number_parameter = FR_GOLDEN_number;
    } else if (made->kind == FR_COMPONENT_HYDRA || made->kind == FR_COMPONENT_WREATH) {
        const FrRingParams *ring = made->params;
        made->number = &ring->number;
        made->number_parameter = FR_RING_number;
        made->number_times = (uint32_t)ring->rings;
    } else if (made->kind == FR_COMPONENT_SCATTER) {
        const FrScatterParams *scatter = made->params;
        made->number = scatter->mode == FR_SCATTER_BY_NUMBER ? &scatter->number : NULL;
    }
}

static int compare_names(const void *a, const void *b) {
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

FrStatus fr_find_material(const FrPgraph *graph, uint32_t component, uint32_t *material,
                          FrDiags *diags) {
    const char *name = fr_pgraph_basic(graph, component)->material;
    *material = FR_NONE;
    if (name == NULL || *name == '\0') {
        return FR_OK;
    }
    guint known = GPOINTER_TO_UINT(g_hash_table_lookup(graph->material_names, name));
    if (known > 0) {
        *material = known - 1;
        return FR_OK;
    }
    const char *near_name = NULL;
    if (fr_diags_error_count(diags) < MOST_SUGGESTIONS) {
        guint count;
        gpointer *names = g_hash_table_get_keys_as_array(graph->material_names, &count);
        qsort(names, count, sizeof *names, compare_names);
        near_name = fr_nearest_name(name, (const char *const *)names, count);
        g_free(names);
    }
    fr_diags_add(diags, FR_ERROR, "unknown-material", fr_pgraph_prototype(graph, component)->span,
                 "there is no material '%s' for '%s'%s%s%s", name, fr_pgraph_id(graph, component),
                 near_name != NULL ? "; is it '" : "", near_name != NULL ? near_name : "",
                 near_name != NULL ? "'?" : "");
    return FR_ERR_DOCUMENT;
}

static uint32_t add_section(FrPlant *plant, const FrPoints *section, bool is_closed) {
    static const double flat[2][2] = {{-1, 0}, {1, 0}};
    if (section->count >= 2) {
        return fr_plant_add_profile(plant, (const double(*)[2])section->at,
                                    (uint32_t)section->count, is_closed);
    }
    return is_closed ? FR_NONE : fr_plant_add_profile(plant, flat, 2, false);
}

static FrDensity *cumulate_density(const FrCurve *curve) {
    if (curve == NULL) {
        return NULL;
    }
    FrDensity *density = g_new(FrDensity, 1);
    double before = fmax(0, fr_curve_eval(curve, 0));
    density->below[0] = 0;
    for (int k = 1; k <= FR_DENSITY_STEPS; k++) {
        double here = fmax(0, fr_curve_eval(curve, (double)k / FR_DENSITY_STEPS));
        density->below[k] = density->below[k - 1] + 0.5 * (before + here);
        before = here;
    }
    return density;
}

static double total_bend(const FrCurve *curve) {
    if (curve == NULL) {
        return 1;
    }
    double bend = 0;
    for (int k = 0; k < CURVE_POINTS; k++) {
        bend += fabs(fr_curve_eval(curve, (k + 0.5) / CURVE_POINTS)) / CURVE_POINTS;
    }
    return bend;
}

GArray *fr_path_points(const char *path, const FrPrototype *prototype, FrDiags *diags) {
    GArray *points = g_array_new(FALSE, FALSE, sizeof(vec3s));
    char **words = g_strsplit_set(path != NULL ? path : "", " \t\r\n", -1);
    bool is_right = true;
    for (char **word = words; *word != NULL && is_right; word++) {
        vec3s point;
        char *at = *word;
        for (int k = 0; k < 3 && *at != '\0'; k++) {
            char *end;
            point.raw[k] = (float)g_ascii_strtod(at, &end);
            is_right &= end != at && fabsf(point.raw[k]) <= 1e6f && *end == (k < 2 ? ',' : '\0');
            at = end + (*end != '\0');
        }
        if (**word != '\0' && is_right) {
            g_array_append_val(points, point);
        }
    }
    g_strfreev(words);
    if (!is_right || points->len < 2 || points->len > MOST_PATH_INTERNODES) {
        fr_diags_add(diags, FR_ERROR, "wrong-path", prototype->span,
                     "the path of '%s' must be two to %d points written x,y,z x,y,z", prototype->id,
                     MOST_PATH_INTERNODES);
        g_array_unref(points);
        return NULL;
    }
    return points;
}

// Evenly spaced points of the spline through some: the ends of `segments` internodes, or of as many
// as it needs. Takes the points.
static GArray *sample_points(GArray *points, uint32_t segments) {
    FrPath *path = fr_path_new((const vec3s *)(void *)points->data, points->len);
    uint32_t count = segments > 0
                         ? segments
                         : MIN((points->len - 1) * INTERNODES_PER_SPAN, MOST_PATH_INTERNODES);
    g_array_set_size(points, count + 1);
    double length = path != NULL ? fr_path_length(path) : 0;
    for (uint32_t k = 0; k <= count; k++) {
        vec3s tangent;
        vec3s point = {{0, 0, 0}};
        if (path != NULL) {
            fr_path_at(path, length * k / count, &point, &tangent);
        }
        g_array_index(points, vec3s, k) = point;
    }
    fr_path_unref(path);
    return points;
}

// The ends of the internodes of a stem along its path.
static GArray *sample_path(const FrPrototype *prototype) {
    const FrStemParams *stem = prototype->params;
    GArray *points = fr_path_points(stem->path, prototype, NULL);
    FR_ASSERT(points != NULL);
    return sample_points(points, (uint32_t)stem->segments);
}

GArray *fr_drawn_axis(const char *text) {
    static const FrPrototype nameless = {.id = ""};
    GArray *points = fr_path_points(text, &nameless, NULL);
    return points != NULL ? sample_points(points, 0) : NULL;
}

static FrCurve *crown_curve(int crown) {
    if (crown == FR_CROWN_NONE) {
        return NULL;
    }
    const FrParam *row = &fr_pgraph_table(FR_COMPONENT_TREE)->rows[FR_TREE_crown];
    char *name = fr_param_choice(row, crown);
    FrCurve *curve = fr_curve_builtin(name);
    FR_ASSERT(curve != NULL);
    g_free(name);
    return curve;
}

// A circle with grooves, as wide as 1.
static uint32_t add_lobes(FrPlant *plant, int64_t lobes, double depth) {
    enum { POINTS_OF_LOBE = 8, MOST_LOBES = 32 };
    double points[POINTS_OF_LOBE * MOST_LOBES][2];
    uint32_t count = (uint32_t)MIN(lobes, MOST_LOBES) * POINTS_OF_LOBE;
    for (uint32_t k = 0; k < count; k++) {
        double angle = 2 * G_PI * k / count;
        double radius = 1 - 0.5 * depth * (1 - cos((double)lobes * angle));
        points[k][0] = radius * cos(angle);
        points[k][1] = radius * sin(angle);
    }
    return fr_plant_add_profile(plant, (const double(*)[2])points, count, true);
}

// The size that makes a file as wide as radius 1, whatever its own.
static vec3s bead_size(const FrMeshFile *file) {
    float width = fmaxf(file->max.x - file->min.x, file->max.y - file->min.y);
    float factor = width > 1e-6f ? 2 / width : 1;
    return (vec3s){{factor, factor, factor}};
}

static FrFinishParams finish_of(const FrPrototype *prototype) {
#define FR_TAKE(kind, field, ...) .field = params->field,
    if (prototype->kind == FR_COMPONENT_TREE) {
        const FrTreeParams *params = prototype->params;
        return (FrFinishParams){FR_FINISH_PARAMS(FR_TAKE)};
    }
    const FrHornParams *params = prototype->params;
    return (FrFinishParams){FR_FINISH_PARAMS(FR_TAKE)};
#undef FR_TAKE
}

// The material of a stem's ends as FrFinish has it.
static uint32_t face_of(const FrPgraph *graph, const FrStemParams *stem, FrPlant *plant) {
    const char *name = stem->face_material != NULL ? stem->face_material : "";
    guint known = GPOINTER_TO_UINT(g_hash_table_lookup(graph->material_names, name));
    return known == 0
               ? 0
               : fr_plant_add_material(plant, g_ptr_array_index(graph->materials, known - 1)) + 1;
}

// What is plain has no finish; else there are two, the odd one that of what is broken.
static uint32_t add_finishes(FrPlant *plant, int tip, uint32_t face, const FrFinishParams *params) {
    FrFinish finish = {
        .cap = tip > FR_TIP_FLAT ? (uint32_t)(tip - FR_TIP_FLAT) : FR_CAP_FLAT,
        .junction = (uint32_t)params->junction,
        .is_open = params->foot != 0,
        .buttresses = (uint32_t)params->buttresses,
        .cap_height = (float)params->tip_height,
        .wall = (float)params->wall,
        .buttress_depth = (float)params->buttress_depth,
        .buttress_height = (float)params->buttress_height,
        .buttress_width = (float)params->buttress_width,
        .irregularity = (float)params->buttress_jitter,
        .relief = (float)params->relief,
        .relief_count = (float)params->relief_count,
        .relief_stretch = (float)params->relief_stretch,
        .face = face,
    };
    bool is_plain = finish.cap == FR_CAP_FLAT && params->break_tip == 0 && finish.junction == 0 &&
                    finish.face == 0 && finish.is_open == 0 && finish.buttresses == 0 &&
                    !(finish.wall > 0) && !(finish.relief > 0);
    if (is_plain) {
        return FR_NONE;
    }
    if (plant->finishes->len % 2 != 0) {
        fr_plant_add_finish(plant, &finish); // behind those of a graft
    }
    uint32_t first = fr_plant_add_finish(plant, &finish);
    finish.cap = params->break_tip != 0 ? FR_CAP_BROKEN : FR_CAP_FLAT;
    fr_plant_add_finish(plant, &finish);
    return first;
}

static FrStatus prepare_stem(FrPrepared *made, const FrPgraph *graph, const FrPrototype *prototype,
                             FrPlant *plant, const FrContext *context) {
    const FrStemParams *stem = prototype->params;
    made->is_stem = true;
    made->is_string =
        stem->primitive >= FR_PRIMITIVE_FIRST_SHAPE && stem->primitive != FR_PRIMITIVE_NONE;
    made->profile = stem->primitive <= FR_PRIMITIVE_AREA
                        ? add_section(plant, &stem->section, stem->primitive == FR_PRIMITIVE_TUBE)
                        : FR_NONE;
    if (stem->lobes > 1 && stem->section.count < 2 && stem->primitive == FR_PRIMITIVE_TUBE) {
        made->profile = add_lobes(plant, stem->lobes, stem->lobe_depth);
    }
    // Objects of radius 1, placed with the stem's radius as their scale.
    vec3s size = {{2, 2, 2}};
    if (stem->primitive == FR_PRIMITIVE_MESH) {
        FrStatus status = fr_prepare_file(made, graph, prototype, stem->file, context);
        if (status != FR_OK) {
            return status;
        }
        size = bead_size(made->file);
    }
    fr_prepare_pieces(made, stem->primitive, size, stem->detail, plant);
    made->finished = finish_of(prototype);
    if (stem->primitive <= FR_PRIMITIVE_AREA && stem->course != FR_COURSE_STEPS) {
        made->finish = add_finishes(plant, stem->tip, face_of(graph, stem, plant), &made->finished);
    }
    made->along = fr_along_find(stem);
    made->is_ahead = stem->length_mode == FR_SIZE_TO_OBSTACLE;
    made->is_aligned = !is_always(&stem->align, 0);
    made->bend_factor = total_bend(stem->curvature_curve);
    if (stem->course == FR_COURSE_PATH) {
        made->path = sample_path(prototype);
    }
    if (prototype->kind == FR_COMPONENT_TREE) {
        const FrTreeParams *tree = prototype->params;
        made->density = cumulate_density(tree->density_curve);
        made->crown = crown_curve(tree->crown);
    }
    return FR_OK;
}

static FrStatus prepare_simple(FrPrepared *made, const FrPgraph *graph,
                               const FrPrototype *prototype, FrPlant *plant,
                               const FrContext *context) {
    const FrSimpleParams *simple = prototype->params;
    vec3s size = simple->size;
    made->is_point_set = simple->primitive <= FR_PRIMITIVE_AREA;
    if (simple->primitive == FR_PRIMITIVE_MESH) {
        FrStatus status = fr_prepare_file(made, graph, prototype, simple->file, context);
        if (status != FR_OK) {
            return status;
        }
        size = (vec3s){{1, 1, 1}};
    }
    fr_prepare_pieces(made, simple->primitive, size, simple->detail, plant);
    made->top =
        simple->primitive == FR_PRIMITIVE_MESH ? (double)made->file->max.z : (double)simple->size.z;
    if (made->is_point_set) {
        made->profile =
            add_section(plant, &simple->section, simple->primitive == FR_PRIMITIVE_TUBE);
    }
    return FR_OK;
}

static void prepare_graft(FrPrepared *made, const FrPgraph *graph, uint32_t component) {
    made->defines = fr_pgraph_prototype(graph, component)->defines;
    for (guint k = 0; k < made->defines->len; k++) {
        const FrNumber *number = &g_array_index(made->defines, FrGraftDefine, k).number;
        made->varies |= !number->is_constant;
        made->uses_place |= fr_uses_place(number);
    }
    GString *symbols = g_string_new(NULL);
    for (uint32_t k = 0; k < graph->links->len; k++) {
        const FrPgraphLink *link = fr_pgraph_link_at(graph, k);
        if (link->from == component && link->kind == FR_LINK_SYMBOL &&
            strchr(symbols->str, link->symbol) == NULL) {
            g_string_append_c(symbols, link->symbol);
        }
    }
    made->symbols = g_string_free(symbols, symbols->len == 0);
}

static FrStatus prepare_one(FrPrepared *made, const FrPgraph *graph, uint32_t component,
                            FrPlant *plant, GHashTable *faults, const FrContext *context) {
    const FrPrototype *prototype = fr_pgraph_prototype(graph, component);
    const FrBasicParams *basic = prototype->params;
    *made = (FrPrepared){
        .kind = prototype->kind,
        .params = prototype->params,
        .key_word = fr_key_child(fr_key_name(prototype->id), (uint64_t)basic->seed),
        .material = FR_NONE,
        .profile = FR_NONE,
        .finish = FR_NONE,
        .shape = FR_NONE,
    };
    FrStatus status = fr_flags_parse(&made->flags, basic->only, prototype->id, (FrSpan){0}, NULL);
    uint32_t material;
    FR_ASSERT(status == FR_OK && fr_find_material(graph, component, &material, NULL) == FR_OK);
    if (material != FR_NONE) {
        made->material =
            fr_plant_add_material(plant, g_ptr_array_index(graph->materials, material));
    }
    note_variation(made, fr_pgraph_table(prototype->kind), fr_has_ramps(graph));
    note_number(made);
    fr_prepare_life(made);
    switch (prototype->kind) {
    case FR_COMPONENT_SIMPLE:
        return prepare_simple(made, graph, prototype, plant, context);
    case FR_COMPONENT_HORN:
    case FR_COMPONENT_TREE:
        return prepare_stem(made, graph, prototype, plant, context);
    case FR_COMPONENT_PHYLLOTAXIS:
        made->revolved = fr_revolved_new(prototype->params);
        break;
    case FR_COMPONENT_REVO:
        fr_prepare_revo(made, plant);
        break;
    case FR_COMPONENT_GRAFT:
        prepare_graft(made, graph, component);
        break;
    case FR_COMPONENT_VARIATION:
        made->weights = fr_weights_new(graph, component, NULL);
        FR_ASSERT(made->weights != NULL);
        break;
    case FR_COMPONENT_LEAF:
        fr_prepare_leaf(made, graph, prototype, plant, faults);
        break;
    case FR_COMPONENT_SCATTER:
        return fr_prepare_scatter(made, graph, prototype, context);
    case FR_COMPONENT_FORCE:
        fr_prepare_global(made, prototype, component, plant, faults);
        return fr_prepare_body(made, graph, prototype, context);
    default:
        fr_prepare_global(made, prototype, component, plant, faults);
        break;
    }
    return FR_OK;
}

// What only passes on what follows stands where a stem does if a stem follows.
static void note_stems(FrPrepared *prepared, const FrPgraph *graph) {
    bool is_new = true;
    while (is_new) {
        is_new = false;
        for (uint32_t k = 0; k < graph->links->len; k++) {
            const FrPgraphLink *link = fr_pgraph_link_at(graph, k);
            FrPrepared *from = &prepared[link->from];
            bool passes_on = from->kind == FR_COMPONENT_VARIATION || fr_is_global(from->kind);
            if (passes_on && !from->is_stem && prepared[link->to].is_stem) {
                from->is_stem = is_new = true;
            }
        }
    }
}

FrStatus fr_prepare(FrPrepared **prepared_out, const FrPgraph *graph,
                    const FrRecursions *recursions, FrPlant *plant, GHashTable *faults,
                    const FrContext *context) {
    uint32_t count = fr_pgraph_count(graph);
    FrPrepared *prepared = *prepared_out = g_new0(FrPrepared, count);
    for (uint32_t c = 0; c < count; c++) {
        const FrPrototype *prototype = fr_pgraph_prototype(graph, c);
        fr_plant_add_component(plant, prototype->id, prototype->span);
        if (!recursions->is_reached[c]) {
            continue;
        }
        FrStatus status = prepare_one(&prepared[c], graph, c, plant, faults, context);
        if (status != FR_OK) {
            return status;
        }
        status = fr_limit_check(plant->shapes->len, context->limits.shapes, "shapes", prototype->id,
                                prototype->span, context->diags);
        if (status != FR_OK) {
            return status;
        }
    }
    for (uint32_t k = 0; k < graph->links->len; k++) {
        const FrPgraphLink *link = fr_pgraph_link_at(graph, k);
        bool is_branch = link->kind == FR_LINK_BRANCH;
        FrPrepared *from = &prepared[link->from];
        from->bears |=
            fr_is_spreading(from->kind) || (from->kind == FR_COMPONENT_TREE && is_branch);
        from->bears_welded |= from->kind == FR_COMPONENT_TREE && is_branch &&
                              prepared[link->to].finished.junction == FR_JUNCTION_WELDED;
    }
    note_stems(prepared, graph);
    return FR_OK;
}

void fr_prepared_free(FrPrepared *prepared, uint32_t count) {
    for (uint32_t c = 0; c < count; c++) {
        fr_flags_clear(&prepared[c].flags);
        g_free(prepared[c].variants);
        g_free(prepared[c].symbols);
        g_free(prepared[c].pieces);
        fr_mesh_file_unref(prepared[c].file);
        fr_distance_free(prepared[c].distance);
        fr_strewn_free(prepared[c].strewn);
        g_free(prepared[c].density);
        fr_curve_unref(prepared[c].crown);
        fr_revolved_free(prepared[c].revolved);
        g_clear_pointer(&prepared[c].weights, g_array_unref);
        if (prepared[c].path != NULL) {
            g_array_unref(prepared[c].path);
        }
    }
    g_free(prepared);
}
