// Nodes of a glTF asset: one for each stand, and its leaves as far as they are not part of the
// plant's mesh. Nodes are written as text at once, for there may be millions of leaves.
#include "io/gltf.h"

#include <math.h>

/// A rigid motion and a size, y up.
typedef struct FrGltfPose {
    double at[3];
    double rotation[4];
    double scale;
} FrGltfPose;

static void add_number(GString *text, double value) {
    char buffer[G_ASCII_DTOSTR_BUF_SIZE];
    g_string_append(text, g_ascii_formatd(buffer, sizeof buffer, "%.9g", value));
}

static void add_numbers(GString *text, const char *key, const double *values, int count) {
    g_string_append_printf(text, ",\"%s\":[", key);
    for (int i = 0; i < count; i++) {
        if (i > 0) {
            g_string_append_c(text, ',');
        }
        add_number(text, values[i]);
    }
    g_string_append_c(text, ']');
}

static void add_pose(GString *text, const FrGltfPose *pose) {
    if (pose->at[0] != 0.0 || pose->at[1] != 0.0 || pose->at[2] != 0.0) {
        add_numbers(text, "translation", pose->at, 3);
    }
    if (pose->rotation[3] != 1.0) {
        add_numbers(text, "rotation", pose->rotation, 4);
    }
    if (pose->scale != 1.0) {
        add_numbers(text, "scale", (double[3]){pose->scale, pose->scale, pose->scale}, 3);
    }
}

/// The name as a JSON string, quotes and all. Free with free().
static char *quoted(const char *name) {
    json_t *string = fr_gltf_name(name);
    char *text = json_dumps(string, JSON_ENCODE_ANY);
    json_decref(string);
    return text;
}

/// Begins a node; the caller adds members and closes it with `}`. Returns its index.
static uint32_t begin_node(FrGltf *gltf, const char *quoted_name, int mesh) {
    if (gltf->node_count > 0) {
        g_string_append_c(gltf->nodes, ',');
    }
    g_string_append_printf(gltf->nodes, "{\"name\":%s", quoted_name);
    if (mesh >= 0) {
        g_string_append_printf(gltf->nodes, ",\"mesh\":%d", mesh);
    }
    return gltf->node_count++;
}

static FrGltfPose stand_pose(const FrStand *stand) {
    return (FrGltfPose){
        .at = {stand->at[0], stand->at[2], -stand->at[1]},
        .rotation = {0.0, sin(stand->turn / 2.0), 0.0, cos(stand->turn / 2.0)},
        .scale = stand->scale,
    };
}

static FrGltfPose organ_pose(const FrPlant *plant, uint32_t organ) {
    vec3s at;
    versors q;
    fr_plant_organ_pose(plant, organ, &at, &q);
    // The first-order normalization of frames is not quite exact enough for the validator.
    double norm = sqrt((double)q.x * (double)q.x + (double)q.y * (double)q.y +
                       (double)q.z * (double)q.z + (double)q.w * (double)q.w);
    return (FrGltfPose){
        .at = {(double)at.x, (double)at.z, -(double)at.y},
        .rotation = {(double)q.x / norm, (double)q.z / norm, -(double)q.y / norm,
                     (double)q.w / norm},
        .scale = (double)plant->organs.scale[organ],
    };
}

/// Organs of one shape and material, which share a mesh.
typedef struct FrOrganGroup {
    uint32_t shape, material;
    int mesh; ///< −1: nothing to see
    uint64_t triangles;
    char *name;                       ///< quoted
    GArray *organs;                   ///< uint32_t
    int translation, rotation, scale; ///< accessors, for instancing
} FrOrganGroup;

static void group_clear(gpointer data) {
    FrOrganGroup *group = data;
    g_array_unref(group->organs);
    free(group->name);
}

static const char *group_word(const FrPlant *plant, uint32_t organ) {
    uint32_t component = plant->organs.component[organ];
    if (component != FR_NONE) {
        return g_array_index(plant->components, FrComponent, component).id;
    }
    const FrShape *shape = &g_array_index(plant->shapes, FrShape, plant->organs.shape[organ]);
    return shape->kind == FR_SHAPE_BLADE ? "leaf" : "organ";
}

/// Which nodes are shed or borne by something shed: skin leaves those out, and so must we.
static bool *gone_nodes(const FrPlant *plant) {
    const FrNodes *nodes = &plant->nodes;
    bool *gone = g_new(bool, nodes->count);
    for (uint32_t i = 0; i < nodes->count; i++) {
        uint32_t parent = nodes->parent[i];
        gone[i] = ((nodes->flags[i] | plant->axes.flags[nodes->axis[i]]) & FR_SHED) != 0 ||
                  (parent != FR_NONE && gone[parent]);
    }
    return gone;
}

static bool is_seen(const FrPlant *plant, const bool *gone, uint32_t organ) {
    uint32_t node = plant->organs.node[organ];
    return (plant->organs.flags[organ] & (FR_SHED | FR_HIDDEN)) == 0 &&
           (node == FR_NONE || !gone[node]);
}

/// Sorts a plant's organs into groups, in the order in which each first occurs.
static GArray *group_organs(const FrPlant *plant) {
    GArray *groups = g_array_new(FALSE, FALSE, sizeof(FrOrganGroup));
    g_array_set_clear_func(groups, group_clear);
    GHashTable *index = g_hash_table_new_full(g_int64_hash, g_int64_equal, g_free, NULL);
    bool *gone = gone_nodes(plant);
    for (uint32_t o = 0; o < plant->organs.count; o++) {
        if (!is_seen(plant, gone, o)) {
            continue;
        }
        uint64_t key = (uint64_t)plant->organs.shape[o] << 32 | plant->organs.material[o];
        gpointer at;
        if (!g_hash_table_lookup_extended(index, &key, NULL, &at)) {
            FrOrganGroup group = {
                .shape = plant->organs.shape[o],
                .material = plant->organs.material[o],
                .mesh = -1,
                .name = quoted(group_word(plant, o)),
                .organs = g_array_new(FALSE, FALSE, sizeof(uint32_t)),
            };
            at = GUINT_TO_POINTER(groups->len);
            g_hash_table_insert(index, g_memdup2(&key, sizeof key), at);
            g_array_append_val(groups, group);
        }
        g_array_append_val(g_array_index(groups, FrOrganGroup, GPOINTER_TO_UINT(at)).organs, o);
    }
    g_hash_table_unref(index);
    g_free(gone);
    return groups;
}

/// Arrays of a shape, made once for all groups that show it.
typedef struct FrShapeArrays {
    bool is_made;
    uint32_t part_count; ///< 0 or 1
    uint64_t triangles;
    FrGltfPart part;
} FrShapeArrays;

static FrStatus make_shape(FrGltf *gltf, const FrPlant *plant, uint32_t shape,
                           const FrSkinParams *skin, FrShapeArrays *arrays) {
    if (arrays->is_made) {
        return FR_OK;
    }
    FrMesh *mesh = NULL;
    FrStatus status = fr_skin_shape(plant, shape, skin, FR_UP_Y, gltf->context, &mesh);
    if (status != FR_OK) {
        return status;
    }
    g_ptr_array_add(gltf->kept_meshes, mesh);
    FR_ASSERT(mesh->part_count <= 1);
    arrays->part_count = fr_gltf_add_arrays(gltf, mesh, &arrays->part);
    arrays->triangles = mesh->index_count / 3;
    arrays->is_made = true;
    return FR_OK;
}

static FrStatus make_group_meshes(FrGltf *gltf, const FrPlant *plant, GArray *groups,
                                  const FrSkinParams *skin) {
    FrShapeArrays *shapes = g_new0(FrShapeArrays, plant->shapes->len);
    FrStatus status = FR_OK;
    for (guint g = 0; g < groups->len && status == FR_OK; g++) {
        FrOrganGroup *group = &g_array_index(groups, FrOrganGroup, g);
        FrShapeArrays *arrays = &shapes[group->shape];
        status = make_shape(gltf, plant, group->shape, skin, arrays);
        if (status != FR_OK) {
            break;
        }
        arrays->part.material = group->material;
        uint32_t first = g_array_index(group->organs, uint32_t, 0);
        char *name = g_strdup_printf("%s %s", plant->name, group_word(plant, first));
        status =
            fr_gltf_add_mesh(gltf, name, plant, &arrays->part, arrays->part_count, &group->mesh);
        g_free(name);
        group->triangles = arrays->triangles;
    }
    g_free(shapes);
    return status;
}

/// The accessors of EXT_mesh_gpu_instancing for the organs of a group.
static void make_instances(FrGltf *gltf, const FrPlant *plant, FrOrganGroup *group) {
    guint count = group->organs->len;
    vec3s *at = g_new(vec3s, count);
    float(*rotation)[4] = g_malloc_n(count, sizeof *rotation);
    vec3s *scale = g_new(vec3s, count);
    for (guint i = 0; i < count; i++) {
        FrGltfPose pose = organ_pose(plant, g_array_index(group->organs, uint32_t, i));
        for (int k = 0; k < 3; k++) {
            at[i].raw[k] = (float)pose.at[k];
            scale[i].raw[k] = (float)pose.scale;
        }
        for (int k = 0; k < 4; k++) {
            rotation[i][k] = (float)pose.rotation[k];
        }
    }
    g_ptr_array_add(gltf->kept, at);
    g_ptr_array_add(gltf->kept, rotation);
    g_ptr_array_add(gltf->kept, scale);
    int view = fr_gltf_add_view(gltf, at, count * sizeof *at, 0, 0);
    group->translation = fr_gltf_add_accessor(gltf, view, 0, FR_GLTF_FLOAT, count, "VEC3");
    view = fr_gltf_add_view(gltf, rotation, count * sizeof *rotation, 0, 0);
    group->rotation = fr_gltf_add_accessor(gltf, view, 0, FR_GLTF_FLOAT, count, "VEC4");
    view = fr_gltf_add_view(gltf, scale, count * sizeof *scale, 0, 0);
    group->scale = fr_gltf_add_accessor(gltf, view, 0, FR_GLTF_FLOAT, count, "VEC3");
    gltf->instances = true;
}

/// The nodes of a plant's organs below one stand of it.
static void add_organ_nodes(FrGltf *gltf, const FrPlant *plant, const GArray *groups,
                            FrLeaves leaves) {
    for (guint g = 0; g < groups->len; g++) {
        const FrOrganGroup *group = &g_array_index(groups, FrOrganGroup, g);
        if (group->mesh < 0) {
            continue;
        }
        gltf->triangles += group->triangles * group->organs->len;
        if (leaves == FR_LEAVES_GPU) {
            begin_node(gltf, group->name, group->mesh);
            g_string_append_printf(gltf->nodes,
                                   ",\"extensions\":{\"EXT_mesh_gpu_instancing\":{\"attributes\":"
                                   "{\"TRANSLATION\":%d,\"ROTATION\":%d,\"SCALE\":%d}}}}",
                                   group->translation, group->rotation, group->scale);
            continue;
        }
        for (guint i = 0; i < group->organs->len; i++) {
            FrGltfPose pose = organ_pose(plant, g_array_index(group->organs, uint32_t, i));
            begin_node(gltf, group->name, group->mesh);
            add_pose(gltf->nodes, &pose);
            g_string_append_c(gltf->nodes, '}');
        }
    }
}

static void add_stand(FrGltf *gltf, const FrStand *stand, const char *name, int mesh,
                      const GArray *groups, FrLeaves leaves) {
    uint32_t first = gltf->node_count;
    if (groups != NULL) {
        add_organ_nodes(gltf, fr_io_plant(gltf->scene, stand->plant), groups, leaves);
    }
    uint32_t end = gltf->node_count;
    char *quoted_name = quoted(name);
    uint32_t node = begin_node(gltf, quoted_name, mesh);
    free(quoted_name);
    FrGltfPose pose = stand_pose(stand);
    add_pose(gltf->nodes, &pose);
    for (uint32_t child = first; child < end; child++) {
        g_string_append_printf(gltf->nodes, child == first ? ",\"children\":[%u" : ",%u", child);
    }
    g_string_append(gltf->nodes, end > first ? "]}" : "}");
    json_array_append_new(gltf->roots, json_integer(node));
}

/// Everything of one plant: its meshes, then a node for each of its stands.
static FrStatus add_plant(FrGltf *gltf, uint32_t p, const FrMesh *mesh,
                          const FrIoOptions *options) {
    const FrPlant *plant = fr_io_plant(gltf->scene, p);
    FrGltfPart *parts = g_new(FrGltfPart, MAX(mesh->part_count, 1));
    uint32_t part_count = fr_gltf_add_arrays(gltf, mesh, parts);
    int wood = -1;
    FrStatus status = fr_gltf_add_mesh(gltf, plant->name, plant, parts, part_count, &wood);
    g_free(parts);
    GArray *groups = NULL;
    if (status == FR_OK && options->leaves != FR_LEAVES_MERGED && options->skin.foliage) {
        groups = group_organs(plant);
        status = make_group_meshes(gltf, plant, groups, &options->skin);
        for (guint g = 0; g < groups->len && status == FR_OK; g++) {
            FrOrganGroup *group = &g_array_index(groups, FrOrganGroup, g);
            if (options->leaves == FR_LEAVES_GPU && group->mesh >= 0) {
                make_instances(gltf, plant, group);
            }
        }
    }
    uint32_t stands = fr_io_stand_count(gltf->scene, p);
    uint32_t number = 0;
    for (guint s = 0; s < gltf->scene->stands->len && status == FR_OK; s++) {
        const FrStand *stand = fr_io_stand(gltf->scene, s);
        if (stand->plant == p) {
            char *name = stands == 1 ? g_strdup(plant->name)
                                     : g_strdup_printf("%s %u", plant->name, ++number);
            add_stand(gltf, stand, name, wood, groups, options->leaves);
            gltf->triangles += mesh->index_count / 3;
            g_free(name);
        }
    }
    if (groups != NULL) {
        g_array_unref(groups);
    }
    return status;
}

/// Counts the nodes of leaves before any is made.
static FrStatus check_nodes(const FrGltf *gltf) {
    uint64_t organs = 0;
    for (guint s = 0; s < gltf->scene->stands->len; s++) {
        const FrPlant *plant = fr_io_plant(gltf->scene, fr_io_stand(gltf->scene, s)->plant);
        organs = fr_count_add(organs, plant->organs.count);
    }
    return fr_limit_check(organs, gltf->context->limits.organs, "organs",
                          "leaves as nodes of their own", (FrSpan){0}, gltf->context->diags);
}

FrStatus fr_gltf_add_scene(FrGltf *gltf, const FrIoMeshes *meshes, const FrIoOptions *options) {
    FrStatus status = options->leaves == FR_LEAVES_NODES ? check_nodes(gltf) : FR_OK;
    for (uint32_t p = 0; p < meshes->length && status == FR_OK; p++) {
        if (meshes->meshes[p] != NULL) {
            status = add_plant(gltf, p, meshes->meshes[p], options);
        }
    }
    return status;
}
