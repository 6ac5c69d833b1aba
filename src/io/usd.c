// USD as text (.usda): Pixar's Universal Scene Description, https://openusd.org, z up, metres.
//
// A plant that stands once is written where it stands; one that stands more often is a class that
// its places refer to as instances.
#include "io/usd.h"

#include "io/formats.h"
#include "io/replace_file.h"

#include <string.h>

static void add_head(FrUsd *usd, const char *root) {
    char digest[17];
    g_snprintf(digest, sizeof digest, "%016" G_GINT64_MODIFIER "x", fr_scene_digest(usd->scene));
    fr_usd_line(usd, "#usda 1.0");
    fr_usd_line(usd, "(");
    fr_usd_line(usd, "    customLayerData = {");
    fr_usd_line(usd, "        string digest = \"%s\"", digest);
    fr_usd_line(usd, "        uint64 seed = %" G_GUINT64_FORMAT, usd->scene->seed);
    fr_usd_line(usd, "    }");
    fr_usd_line(usd, "    defaultPrim = \"%s\"", root);
    fr_usd_line(usd, "    doc = \"Frond " FR_VERSION "\"");
    fr_usd_line(usd, "    metersPerUnit = 1");
    fr_usd_line(usd, "    upAxis = \"Z\"");
    fr_usd_line(usd, ")");
}

/// The name of a plant's prim: of a class where it stands more than once.
static char *plant_name(const FrUsd *usd, uint32_t plant) {
    char *plain = fr_usd_name(fr_io_plant(usd->scene, plant)->name);
    char *name = g_strdup_printf("%s_%u", plain, plant + 1);
    g_free(plain);
    return name;
}

static void add_classes(FrUsd *usd) {
    for (uint32_t p = 0; p < usd->meshes.length && usd->output.error == 0; p++) {
        if (fr_io_stand_count(&usd->meshes.stands, p) > 1) {
            char *name = plant_name(usd, p), *path = g_strconcat("/_class_", name, NULL);
            fr_usd_line(usd, "%s", "");
            fr_usd_open(usd, "class Xform \"%s\"", path + 1);
            fr_usd_plant(usd, p, path);
            fr_usd_close(usd);
            g_free(name);
            g_free(path);
        }
    }
}

static void add_pose(FrUsd *usd, const FrStand *stand) {
    fr_usd_line(usd, "double3 xformOp:translate = (%.9g, %.9g, %.9g)", stand->at[0], stand->at[1],
                stand->at[2]);
    fr_usd_line(usd, "float xformOp:rotateZ = %.9g", stand->turn * 180 / G_PI);
    fr_usd_line(usd, "float3 xformOp:scale = (%.9g, %.9g, %.9g)", stand->scale, stand->scale,
                stand->scale);
    fr_usd_line(usd, "uniform token[] xformOpOrder = [\"xformOp:translate\", \"xformOp:rotateZ\", "
                     "\"xformOp:scale\"]");
}

static void add_stand(FrUsd *usd, const char *root, guint number) {
    const FrStand *stand = fr_io_stand(usd->scene, number);
    char *name = plant_name(usd, stand->plant);
    if (fr_io_stand_count(&usd->meshes.stands, stand->plant) > 1) {
        fr_usd_line(usd, "def Xform \"%s_%u\" (", name, number + 1);
        fr_usd_line(usd, "    instanceable = true");
        fr_usd_line(usd, "    kind = \"component\"");
        fr_usd_line(usd, "    prepend references = </_class_%s>", name);
        fr_usd_open(usd, ")");
        add_pose(usd, stand);
    } else {
        char *path = g_strdup_printf("/%s/%s", root, name);
        fr_usd_line(usd, "def Xform \"%s\" (", name);
        fr_usd_line(usd, "    kind = \"component\"");
        fr_usd_open(usd, ")");
        add_pose(usd, stand);
        fr_usd_plant(usd, stand->plant, path);
        g_free(path);
    }
    fr_usd_close(usd);
    g_free(name);
}

static bool write_usd(void *user, int descriptor) {
    FrUsd *usd = user;
    guint stands = usd->scene->stands->len;
    bool is_named = usd->scene->name != NULL && *usd->scene->name != '\0';
    char *root = fr_usd_name(is_named ? usd->scene->name : "scene");
    fr_output_start(&usd->output, descriptor, usd->context->progress);
    add_head(usd, root);
    add_classes(usd);
    fr_usd_line(usd, "%s", "");
    fr_usd_line(usd, "def Xform \"%s\" (", root);
    fr_usd_line(usd, "    kind = \"assembly\"");
    fr_usd_open(usd, ")");
    for (guint s = 0; s < stands && usd->output.error == 0; s++) {
        add_stand(usd, root, s);
        fr_progress_report(usd->context->progress, "write", (s + 1.0) / stands);
    }
    fr_usd_close(usd);
    g_free(root);
    bool is_whole = fr_output_finish(&usd->output);
    usd->bytes += usd->output.done;
    return is_whole;
}

/// What all plants need, before anything is written: pictures may fail to load.
static FrStatus make_plants(FrUsd *usd) {
    FrStatus status = FR_OK;
    for (uint32_t p = 0; p < usd->meshes.length; p++) {
        bool stands = usd->meshes.meshes[p] != NULL && status == FR_OK;
        g_ptr_array_add(usd->plants, stands ? fr_usd_plant_new(usd, p, &status) : NULL);
    }
    return status;
}

/// Pictures, and the layer last; then all appear.
static FrStatus write_files(FrUsd *usd, const char *path) {
    GArray *files = fr_replacements_new();
    FrStatus status = fr_surfaces_write(&usd->surfaces, path, files, usd->context, &usd->bytes);
    if (status == FR_OK) {
        status = fr_replacements_write(files, path, write_usd, usd, usd->context->diags);
    }
    if (status == FR_OK) {
        status = fr_replacements_commit(files, usd->context->diags);
    }
    g_array_unref(files);
    return status;
}

static void count(const FrUsd *usd, FrIoStats *stats) {
    stats->meshes = usd->meshes.count.meshes;
    stats->vertices = usd->meshes.count.vertices;
    stats->bytes = usd->bytes;
    for (guint s = 0; s < usd->scene->stands->len; s++) {
        const FrUsdPlant *own = g_ptr_array_index(usd->plants, fr_io_stand(usd->scene, s)->plant);
        stats->triangles += own->triangles;
    }
    for (uint32_t p = 0; p < usd->meshes.length; p++) {
        const FrUsdPlant *own = g_ptr_array_index(usd->plants, p);
        for (guint g = 0; own != NULL && own->groups != NULL && g < own->groups->len; g++) {
            const FrMesh *shape = own->shapes[g_array_index(own->groups, FrOrganGroup, g).shape];
            stats->meshes += shape->part_count > 0;
            stats->vertices += shape->vertex_count;
        }
    }
}

FrStatus fr_usd_write(const FrScene *scene, const char *path, const FrIoOptions *options,
                      const FrContext *context, FrIoStats *stats) {
    FrUsd usd = {.scene = scene, .context = context, .options = options};
    FrSkinParams skin = options->skin;
    skin.foliage = skin.foliage && options->leaves == FR_LEAVES_MERGED;
    gint64 start = g_get_monotonic_time();
    FrStatus status = fr_io_meshes_make(&usd.meshes, scene, &skin, FR_UP_Z, false, context);
    if (status != FR_OK) {
        return status;
    }
    gint64 skinned = g_get_monotonic_time();
    char *stem = fr_io_stem(path);
    fr_surfaces_init(&usd.surfaces, stem);
    g_free(stem);
    usd.plants = g_ptr_array_new();
    status = make_plants(&usd);
    status = status == FR_OK ? write_files(&usd, path) : status;
    if (status == FR_OK) {
        count(&usd, stats);
    }
    stats->skin_seconds = (double)(skinned - start) * 1e-6;
    stats->write_seconds = (double)(g_get_monotonic_time() - skinned) * 1e-6;
    for (guint p = 0; p < usd.plants->len; p++) {
        fr_usd_plant_free(g_ptr_array_index(usd.plants, p), fr_io_plant(scene, p));
    }
    g_ptr_array_unref(usd.plants);
    fr_surfaces_clear(&usd.surfaces);
    fr_io_meshes_clear(&usd.meshes);
    return status;
}
