#include "studio/model/view.h"

#include "studio/model/extent.h"

#include "material/texture.h"

#include <math.h>
#include <string.h>

enum {
    COARSE_LEVEL = 4,      // of leaves
    COARSE_WOOD_LEVEL = 2, // without relief; a coarser one would straighten a curved trunk
    COARSE_SIDES = 12,     // 5 at that level
    COARSE_NODES = 4000,   // of one plant
    ALL_COARSE_NODES = 40000,
    LEAST_COARSE_NODES = 32,
    COARSER = 5, // times, from one level to the next
};

// ---- leaves ------------------------------------------------------------------------------------

// Organs with something to see are drawn by their shape; those within a deformation are not
// placements of it any more.
static bool is_drawn(const FrPlant *plant, uint32_t organ) {
    return plant->organs.shape[organ] < plant->shapes->len &&
           (plant->organs.flags[organ] & (FR_SHED | FR_HIDDEN)) == 0;
}

static bool has_deformed_leaves(const FrPlant *plant) {
    for (uint32_t i = 0; i < plant->organs.count; i++) {
        if (plant->organs.deformer[i] != FR_NONE) {
            return true;
        }
    }
    return false;
}

static uint32_t key_of(const FrPlant *plant, uint32_t organ) {
    uint32_t material = plant->organs.material[organ];
    uint32_t materials = plant->materials->len + 1;
    return plant->organs.shape[organ] * materials +
           (material < plant->materials->len ? material : materials - 1);
}

static StudioLeaf leaf_of(const FrPlant *plant, uint32_t organ) {
    vec3s at;
    versors turn;
    fr_plant_organ_pose(plant, organ, &at, &turn);
    return (StudioLeaf){
        {at.x, at.y, at.z}, plant->organs.scale[organ], {turn.x, turn.y, turn.z, turn.w}};
}

// A step through `count` that meets every number once and leaves no gaps for long: near the golden
// section of it, and without a common divisor.
static uint32_t even_step(uint32_t count) {
    uint32_t step = (uint32_t)(0.6180339887 * count) | 1;
    for (;; step++) {
        uint32_t a = count, b = step;
        while (b != 0) {
            uint32_t rest = a % b;
            a = b;
            b = rest;
        }
        if (a == 1) {
            return step;
        }
    }
}

// Sorts leaves into batches by counting, and spreads each batch.
static void fill_leaves(StudioPlant *view) {
    const FrPlant *plant = view->plant;
    uint32_t materials = plant->materials->len + 1;
    uint32_t keys = plant->shapes->len * materials;
    uint32_t *of_key = g_new0(uint32_t, (gsize)keys + 1); // batch + 1
    for (uint32_t i = 0; i < plant->organs.count; i++) {
        if (!is_drawn(plant, i)) {
            continue;
        }
        uint32_t key = key_of(plant, i);
        if (of_key[key] == 0) {
            uint32_t material = key % materials;
            StudioBatch batch = {.shape = key / materials,
                                 .material = material == materials - 1 ? FR_NONE : material};
            g_array_append_val(view->batches, batch);
            of_key[key] = view->batches->len;
        }
        g_array_index(view->batches, StudioBatch, of_key[key] - 1).count++;
    }
    uint32_t total = 0;
    uint32_t *steps = g_new(uint32_t, view->batches->len + 1);
    uint32_t *places = g_new0(uint32_t, view->batches->len + 1);
    for (guint b = 0; b < view->batches->len; b++) {
        StudioBatch *batch = &g_array_index(view->batches, StudioBatch, b);
        batch->first = total;
        total += batch->count;
        steps[b] = even_step(batch->count);
    }
    g_array_set_size(view->leaves, total);
    for (uint32_t i = 0; i < plant->organs.count; i++) {
        if (is_drawn(plant, i)) {
            uint32_t b = of_key[key_of(plant, i)] - 1;
            const StudioBatch *batch = &g_array_index(view->batches, StudioBatch, b);
            g_array_index(view->leaves, StudioLeaf, batch->first + places[b]) = leaf_of(plant, i);
            places[b] = (uint32_t)(((uint64_t)places[b] + steps[b]) % batch->count);
        }
    }
    g_free(steps);
    g_free(places);
    g_free(of_key);
}

static FrMesh *shape_at(const FrPlant *plant, uint32_t shape, int64_t lod,
                        const FrContext *context) {
    FrSkinParams params = fr_skin_default();
    params.lod = lod;
    FrMesh *mesh;
    FrStatus status = fr_skin_shape(plant, shape, &params, FR_UP_Z, context, &mesh);
    return status == FR_OK ? mesh : NULL;
}

// ---- looks -------------------------------------------------------------------------------------

FrDigest studio_look_digest(const FrMaterialParams *params) {
    static const char *const others[] = {"roughness", "translucency", "mirror",
                                         "clear",     "alpha_cutoff", "relief"};
    const FrParamTable *table = fr_material_table();
    FrDigest digest = 0;
    for (size_t i = 0; i < table->count; i++) {
        bool is_other = false;
        for (size_t k = 0; k < G_N_ELEMENTS(others); k++) {
            is_other = is_other || strcmp(table->rows[i].name, others[k]) == 0;
        }
        if (!is_other) {
            digest = fr_param_digest(digest, &table->rows[i], params);
        }
    }
    return digest;
}

// Until its picture is there, what is made by the program has a typical colour.
static vec3s tint_of(const FrMaterial *material) {
    const FrMaterialParams *params = fr_material_params(material);
    vec3s colour = params->colour;
    bool is_white = colour.x > 0.99f && colour.y > 0.99f && colour.z > 0.99f;
    if (is_white && params->texture == FR_TEXTURE_LEAF) {
        colour = (vec3s){{0.30f, 0.46f, 0.18f}};
    } else if (is_white && params->texture >= FR_TEXTURE_BARK_FURROWED) {
        colour = (vec3s){{0.42f, 0.35f, 0.28f}};
    }
    return colour;
}

static StudioLook look_of(FrMaterial *material) {
    const FrMaterialParams *params = fr_material_params(material);
    vec3s tint = fr_colour_linear(tint_of(material));
    vec3s over = fr_colour_linear(fr_material_tint(material));
    return (StudioLook){
        .material = fr_material_ref(material),
        .digest = studio_look_digest(params),
        .tint = {tint.x, tint.y, tint.z},
        .picture_tint = {over.x, over.y, over.z},
        .alpha_cutoff = (float)params->alpha_cutoff,
        .translucency = (float)params->translucency,
        .roughness = (float)params->roughness,
        .relief = (float)params->relief,
        .mirror = (float)params->mirror,
        .clear = (float)params->clear,
    };
}

static void look_clear(gpointer look) {
    fr_material_unref(((StudioLook *)look)->material);
}

// ---- skeleton ----------------------------------------------------------------------------------

static void add_point(GArray *points, vec3s at, float order) {
    StudioPoint point = {{at.x, at.y, at.z}, order};
    g_array_append_val(points, point);
}

static void fill_points(StudioPlant *view) {
    const FrPlant *plant = view->plant;
    for (uint32_t i = 0; i < plant->nodes.count; i++) {
        uint32_t axis = plant->nodes.axis[i];
        if (((plant->nodes.flags[i] | plant->axes.flags[axis]) & (FR_SHED | FR_HIDDEN)) != 0) {
            continue;
        }
        bool is_first = plant->axes.first[axis] == i;
        uint32_t parent = plant->nodes.parent[i];
        float order = (float)plant->axes.order[axis];
        add_point(view->points,
                  is_first ? fr_plant_axis_origin(plant, axis) : plant->nodes.position[parent],
                  order);
        add_point(view->points, plant->nodes.position[i], order);
    }
}

// ---- views -------------------------------------------------------------------------------------

static void shape_clear(gpointer shape) {
    fr_mesh_free(((StudioShape *)shape)->fine);
    fr_mesh_free(((StudioShape *)shape)->coarse);
}

static void plant_free(gpointer data) {
    StudioPlant *view = data;
    fr_mesh_free(view->foliage);
    for (int level = 0; level < STUDIO_COARSE_LEVELS; level++) {
        fr_mesh_free(view->coarse_wood[level]);
    }
    g_array_unref(view->leaves);
    g_array_unref(view->batches);
    g_array_unref(view->shapes);
    g_array_unref(view->looks);
    g_array_unref(view->points);
    g_free(view);
}

static void add_shapes(StudioPlant *view, const FrContext *context) {
    g_array_set_size(view->shapes, view->plant->shapes->len);
    for (guint b = 0; b < view->batches->len; b++) {
        uint32_t shape = g_array_index(view->batches, StudioBatch, b).shape;
        StudioShape *made = &g_array_index(view->shapes, StudioShape, shape);
        if (made->fine == NULL) {
            made->fine = shape_at(view->plant, shape, 0, context);
            made->coarse = shape_at(view->plant, shape, COARSE_LEVEL, context);
        }
    }
}

static StudioPlant *plant_new(const FrScenePlant *built, const FrSkin *wood,
                              const FrContext *context) {
    const FrPlant *plant = built->plant;
    StudioPlant *view = g_new0(StudioPlant, 1);
    view->plant = plant;
    view->wood = wood;
    view->is_rational = built->has_nurbs;
    view->leaves = g_array_new(FALSE, FALSE, sizeof(StudioLeaf));
    view->batches = g_array_new(FALSE, TRUE, sizeof(StudioBatch));
    view->shapes = g_array_new(FALSE, TRUE, sizeof(StudioShape));
    view->looks = g_array_new(FALSE, FALSE, sizeof(StudioLook));
    view->points = g_array_new(FALSE, FALSE, sizeof(StudioPoint));
    g_array_set_clear_func(view->shapes, shape_clear);
    g_array_set_clear_func(view->looks, look_clear);
    for (guint i = 0; i < plant->materials->len; i++) {
        StudioLook look = look_of(g_ptr_array_index(plant->materials, i));
        g_array_append_val(view->looks, look);
    }
    if (view->is_rational || has_deformed_leaves(plant)) {
        FrSkinParams params = fr_skin_default();
        FrStatus status = fr_scene_mesh(built, &params, FR_UP_Z, context, &view->foliage);
        view->foliage = status == FR_OK ? view->foliage : NULL;
    } else {
        gint64 began = g_get_monotonic_time();
        fill_leaves(view);
        view->leaf_seconds = (double)(g_get_monotonic_time() - began) * 1e-6;
        add_shapes(view, context);
    }
    fill_points(view);
    studio_view_measure(view);
    return view;
}

// All plants share ALL_COARSE_NODES. Shares are halved at powers of two only: one plant more seldom
// changes what is made of the others.
static uint32_t share_of_coarse(const FrScene *scene) {
    uint32_t share = ALL_COARSE_NODES;
    for (uint64_t plants = 1; plants < scene->plants->len; plants *= 2) {
        share /= 2;
    }
    return CLAMP(share, LEAST_COARSE_NODES, COARSE_NODES);
}

StudioView *studio_view_of(const FrScene *scene, const FrSkin *const *skins,
                           const FrContext *context) {
    StudioView *view = g_new0(StudioView, 1);
    view->scene = scene;
    view->coarse_nodes = share_of_coarse(scene);
    view->plants = g_ptr_array_new_with_free_func(plant_free);
    for (guint i = 0; i < scene->plants->len; i++) {
        const FrScenePlant *built = &g_array_index(scene->plants, FrScenePlant, i);
        g_ptr_array_add(view->plants, plant_new(built, skins[i], context));
    }
    return view;
}

StudioView *studio_view_new(const FrRebuild *rebuild, const FrContext *context) {
    const FrScene *scene = fr_rebuild_scene(rebuild);
    const FrSkin **skins = g_new(const FrSkin *, scene->plants->len + 1);
    for (guint i = 0; i < scene->plants->len; i++) {
        skins[i] = fr_rebuild_skin(rebuild, i);
    }
    StudioView *view = studio_view_of(scene, skins, context);
    g_free(skins);
    return view;
}

// The plant without organs and thin axes: the thickest are kept, of at most `most`
// internodes. It shares all columns but `flags`.
static FrPlant thinned(const FrPlant *plant, uint32_t most, uint16_t *flags) {
    FrPlant thin = *plant;
    uint32_t *counts = g_new0(uint32_t, plant->axes.count + 1);
    float radius = 0, step = 0;
    for (uint32_t i = 0; i < plant->nodes.count; i++) {
        counts[plant->nodes.axis[i]]++;
    }
    for (uint32_t i = 0; i < plant->axes.count; i++) {
        step = fmaxf(step, plant->axes.base_radius[i]);
    }
    // The least radius that leaves few enough, to a 4096th of the greatest.
    for (step /= 2; step > 0 && radius + step > radius * 1.0002f; step /= 2) {
        uint64_t kept = 0;
        for (uint32_t i = 0; i < plant->axes.count; i++) {
            kept += plant->axes.base_radius[i] >= radius + step ? counts[i] : 0;
        }
        radius += kept > most ? step : 0;
    }
    for (uint32_t i = 0; i < plant->axes.count; i++) {
        bool is_thin = plant->nodes.count > most && plant->axes.base_radius[i] <= radius;
        flags[i] = (uint16_t)(plant->axes.flags[i] | (is_thin ? FR_HIDDEN : 0));
    }
    g_free(counts);
    thin.axes.flags = flags;
    thin.organs.count = 0;
    return thin;
}

static bool is_same_wood(const FrSkin *skin) {
    uint32_t count;
    const FrSkinPart *parts = fr_skin_parts(skin, &count);
    for (uint32_t i = 0; i < count; i++) {
        if (parts[i].is_moved || parts[i].changed_vertex < parts[i].changed_vertex_end ||
            parts[i].changed_index < parts[i].changed_index_end) {
            return false;
        }
    }
    return true;
}

void studio_view_take_coarse(StudioView *view, StudioView *old) {
    bool is_alike = old != NULL && old->coarse_nodes == view->coarse_nodes;
    for (guint i = 0; is_alike && i < MIN(old->plants->len, view->plants->len); i++) {
        StudioPlant *from = g_ptr_array_index(old->plants, i);
        StudioPlant *to = g_ptr_array_index(view->plants, i);
        if (from->wood == to->wood && is_same_wood(to->wood)) {
            memcpy(to->coarse_wood, from->coarse_wood, sizeof to->coarse_wood);
            memset(from->coarse_wood, 0, sizeof from->coarse_wood);
        }
    }
}

static FrMesh *coarse_wood(const FrPlant *plant, uint32_t most, const FrContext *context) {
    FrSkinParams params = fr_skin_default();
    params.lod = COARSE_WOOD_LEVEL;
    params.min_sides = 3;
    params.max_sides = COARSE_SIDES;
    params.side_length = 0.1;
    params.bend = 10 * G_PI / 180; // 25° at that level
    params.foliage = false;
    params.collar = 0;
    uint16_t *flags = g_new(uint16_t, plant->axes.count + 1);
    FrPlant thin = thinned(plant, most, flags);
    FrMesh *mesh = NULL;
    FrStatus status = fr_skin_plant(&thin, &params, FR_UP_Z, context, &mesh);
    g_free(flags);
    return status == FR_OK ? mesh : NULL;
}

void studio_view_add_coarse(StudioView *view, const FrContext *context) {
    for (guint i = 0; i < view->plants->len; i++) {
        StudioPlant *plant = g_ptr_array_index(view->plants, i);
        uint32_t most = view->coarse_nodes;
        if (plant->is_rational) {
            continue; // no wood is drawn
        }
        for (int level = 0; level < STUDIO_COARSE_LEVELS; level++, most /= COARSER) {
            if (plant->coarse_wood[level] == NULL) { // else taken over
                most = MAX(most, LEAST_COARSE_NODES);
                plant->coarse_wood[level] = coarse_wood(plant->plant, most, context);
            }
        }
    }
}

uint64_t studio_view_nodes(const StudioView *view) {
    uint64_t nodes = 0;
    for (guint i = 0; i < view->scene->stands->len; i++) {
        uint32_t index = g_array_index(view->scene->stands, FrStand, i).plant;
        const StudioPlant *plant = g_ptr_array_index(view->plants, index);
        nodes += plant->plant->nodes.count;
    }
    return nodes;
}

void studio_view_free(StudioView *view) {
    if (view != NULL) {
        g_ptr_array_unref(view->plants);
        g_free(view);
    }
}
