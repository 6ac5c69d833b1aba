// Nodes of a glTF asset: one for each stand, and its leaves as far as they are not part of the
// plant's mesh. Nodes are written as text at once, for there may be millions of leaves.
#include "io/gltf.h"
#include "io/organ_groups.h"

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

static FrGltfPose organ_pose(const FrPlant *plant, const FrOrganGroup *group, uint32_t organ) {
    double at[3], q[4], scale;
    fr_organ_group_pose(plant, group, organ, at, q, &scale);
    return (FrGltfPose){
        .at = {at[0], at[2], -at[1]}, .rotation = {q[0], q[2], -q[1], q[3]}, .scale = scale};
}

/// The shared mesh of a group of organs.
typedef struct FrGltfGroup {
    const FrOrganGroup *group;
    int mesh; ///< −1: nothing to see
    uint64_t triangles;
    char *name;                       ///< quoted
    int translation, rotation, scale; ///< accessors, for instancing
} FrGltfGroup;

/// All groups of a plant.
typedef struct FrGltfGroups {
    GArray *organs; ///< FrOrganGroup
    FrGltfGroup *meshes;
} FrGltfGroups;

static FrStatus groups_init(FrGltfGroups *groups, const FrPlant *plant, const FrSkinParams *skin,
                            const FrContext *context) {
    FrStatus status = fr_organ_groups_new(plant, skin, context, &groups->organs);
    groups->meshes = g_new0(FrGltfGroup, MAX(groups->organs->len, 1));
    for (guint g = 0; g < groups->organs->len; g++) {
        const FrOrganGroup *group = &g_array_index(groups->organs, FrOrganGroup, g);
        groups->meshes[g] = (FrGltfGroup){.group = group, .mesh = -1, .name = quoted(group->word)};
    }
    return status;
}

static void groups_clear(FrGltfGroups *groups) {
    for (guint g = 0; g < groups->organs->len; g++) {
        free(groups->meshes[g].name);
    }
    g_free(groups->meshes);
    g_array_unref(groups->organs);
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

static FrStatus make_group_meshes(FrGltf *gltf, const FrPlant *plant, FrGltfGroups *groups,
                                  const FrSkinParams *skin) {
    FrShapeArrays *shapes = g_new0(FrShapeArrays, plant->shapes->len);
    FrStatus status = FR_OK;
    for (guint g = 0; g < groups->organs->len && status == FR_OK; g++) {
        FrGltfGroup *group = &groups->meshes[g];
        FrShapeArrays *arrays = &shapes[group->group->shape];
        status = make_shape(gltf, plant, group->group->shape, skin, arrays);
        if (status != FR_OK) {
            break;
        }
        arrays->part.material = group->group->material;
        char *name = g_strdup_printf("%s %s", plant->name, group->group->word);
        status =
            fr_gltf_add_mesh(gltf, name, plant, &arrays->part, arrays->part_count, &group->mesh);
        g_free(name);
        group->triangles = arrays->triangles;
    }
    g_free(shapes);
    return status;
}

/// The accessors of EXT_mesh_gpu_instancing for the organs of a group.
static void make_instances(FrGltf *gltf, const FrPlant *plant, FrGltfGroup *group) {
    const GArray *organs = group->group->organs;
    guint count = organs->len;
    vec3s *at = g_new(vec3s, count);
    float(*rotation)[4] = g_malloc_n(count, sizeof *rotation);
    vec3s *scale = g_new(vec3s, count);
    for (guint i = 0; i < count; i++) {
        FrGltfPose pose = organ_pose(plant, group->group, g_array_index(organs, uint32_t, i));
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
static void add_organ_nodes(FrGltf *gltf, const FrPlant *plant, const FrGltfGroups *groups,
                            FrLeaves leaves) {
    for (guint g = 0; g < groups->organs->len; g++) {
        const FrGltfGroup *group = &groups->meshes[g];
        const GArray *organs = group->group->organs;
        if (group->mesh < 0) {
            continue;
        }
        gltf->triangles += group->triangles * organs->len;
        if (leaves == FR_LEAVES_GPU) {
            begin_node(gltf, group->name, group->mesh);
            g_string_append_printf(gltf->nodes,
                                   ",\"extensions\":{\"EXT_mesh_gpu_instancing\":{\"attributes\":"
                                   "{\"TRANSLATION\":%d,\"ROTATION\":%d,\"SCALE\":%d}}}}",
                                   group->translation, group->rotation, group->scale);
            continue;
        }
        for (guint i = 0; i < organs->len; i++) {
            FrGltfPose pose = organ_pose(plant, group->group, g_array_index(organs, uint32_t, i));
            begin_node(gltf, group->name, group->mesh);
            add_pose(gltf->nodes, &pose);
            g_string_append_c(gltf->nodes, '}');
        }
    }
}

static void add_stand(FrGltf *gltf, const FrStand *stand, const char *name, int mesh,
                      const FrGltfGroups *groups, FrLeaves leaves) {
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
static FrStatus add_plant(FrGltf *gltf, uint32_t p, const FrIoMeshes *meshes,
                          const FrIoOptions *options) {
    const FrMesh *mesh = meshes->meshes[p];
    const FrPlant *plant = fr_io_plant(gltf->scene, p);
    FrGltfPart *parts = g_new(FrGltfPart, MAX(mesh->part_count, 1));
    uint32_t part_count = fr_gltf_add_arrays(gltf, mesh, parts);
    int wood = -1;
    FrStatus status = fr_gltf_add_mesh(gltf, plant->name, plant, parts, part_count, &wood);
    g_free(parts);
    FrGltfGroups groups = {0};
    // Leaves of rational surfaces are part of the plant's mesh: each may be bent its own way.
    bool is_grouped = options->leaves != FR_LEAVES_MERGED && options->skin.foliage &&
                      !g_array_index(gltf->scene->plants, FrScenePlant, p).has_nurbs;
    if (is_grouped) {
        FrStatus grouped = groups_init(&groups, plant, &options->skin, gltf->context);
        status = status == FR_OK ? grouped : status;
    }
    if (status == FR_OK && is_grouped) {
        status = make_group_meshes(gltf, plant, &groups, &options->skin);
        for (guint g = 0; g < groups.organs->len && status == FR_OK; g++) {
            FrGltfGroup *group = &groups.meshes[g];
            if (options->leaves == FR_LEAVES_GPU && group->mesh >= 0) {
                make_instances(gltf, plant, group);
            }
        }
    }
    uint32_t count = status == FR_OK ? fr_io_stand_count(&meshes->stands, p) : 0;
    const uint32_t *stands = meshes->stands.number + meshes->stands.first[p];
    for (uint32_t s = 0; s < count; s++) {
        char *name =
            count == 1 ? g_strdup(plant->name) : g_strdup_printf("%s %u", plant->name, s + 1);
        add_stand(gltf, fr_io_stand(gltf->scene, stands[s]), name, wood,
                  is_grouped ? &groups : NULL, options->leaves);
        gltf->triangles += mesh->index_count / 3;
        g_free(name);
    }
    if (is_grouped) {
        groups_clear(&groups);
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
            status = add_plant(gltf, p, meshes, options);
        }
    }
    return status;
}
