// Wavefront OBJ with its .mtl: text, y up, every stand written out, an object for each stand.
#include "io/formats.h"
#include "io/meshes.h"
#include "io/output.h"
#include "io/replace_file.h"
#include "io/surfaces.h"

#include <string.h>

typedef struct FrObj {
    const FrScene *scene;
    const FrContext *context;
    FrIoMeshes meshes;
    FrSurfaces surfaces;
    GPtrArray *masks; ///< char *: file of each surface's holes, or NULL
    char *library;    ///< file name of the .mtl
    uint64_t bytes;
} FrObj;

static void add_fixed(FrOutput *output, const char *word, const double *values, int count,
                      int decimals) {
    fr_output_text(output, word);
    for (int i = 0; i < count; i++) {
        fr_output_text(output, " ");
        fr_output_fixed(output, values[i], decimals);
    }
    fr_output_text(output, "\n");
}

static void add_vertex(FrOutput *output, const FrVertex *vertex) {
    double position[3] = {(double)vertex->position[0], (double)vertex->position[1],
                          (double)vertex->position[2]};
    double normal[3] = {(double)vertex->normal[0], (double)vertex->normal[1],
                        (double)vertex->normal[2]};
    // Rows of a picture count from the bottom in OBJ.
    double uv[2] = {(double)vertex->uv[0], 1.0 - (double)vertex->uv[1]};
    add_fixed(output, "v", position, 3, 6);
    add_fixed(output, "vn", normal, 3, 4);
    add_fixed(output, "vt", uv, 2, 5);
}

static void add_triangle(FrOutput *output, uint64_t first, const uint32_t corners[3]) {
    fr_output_text(output, "f");
    for (int k = 0; k < 3; k++) {
        uint64_t number = first + corners[k] + 1;
        fr_output_text(output, " ");
        fr_output_integer(output, number);
        fr_output_text(output, "/");
        fr_output_integer(output, number);
        fr_output_text(output, "/");
        fr_output_integer(output, number);
    }
    fr_output_text(output, "\n");
}

static uint32_t surface_of(FrObj *obj, const FrPlant *plant, const FrMeshPart *part,
                           FrStatus *status) {
    uint32_t index = 0;
    *status = fr_surfaces_find(&obj->surfaces, plant, part->material, part->is_foliage,
                               obj->context, &index);
    return index;
}

/// Finds all materials before anything is written, for they may fail to load.
static FrStatus find_surfaces(FrObj *obj) {
    FrStatus status = FR_OK;
    for (uint32_t p = 0; p < obj->meshes.length; p++) {
        const FrMesh *mesh = obj->meshes.meshes[p];
        for (uint32_t k = 0; mesh != NULL && k < mesh->part_count && status == FR_OK; k++) {
            surface_of(obj, fr_io_plant(obj->scene, p), &mesh->parts[k], &status);
        }
    }
    return status;
}

static void add_stand(FrObj *obj, FrOutput *output, const FrStand *stand, guint number,
                      uint64_t *written) {
    const FrMesh *mesh = obj->meshes.meshes[stand->plant];
    const FrPlant *plant = fr_io_plant(obj->scene, stand->plant);
    FrPose pose = fr_io_pose(stand, FR_UP_Y);
    char *name = g_strdelimit(g_strdup(plant->name), " \t\r\n", '_');
    fr_output_text(output, "o ");
    fr_output_text(output, name);
    fr_output_text(output, "_");
    fr_output_integer(output, number + 1);
    fr_output_text(output, "\n");
    g_free(name);
    for (uint32_t p = 0; p < mesh->part_count; p++) {
        const FrMeshPart *part = &mesh->parts[p];
        FrStatus status;
        uint32_t surface = surface_of(obj, plant, part, &status);
        for (uint64_t v = 0; v < part->vertex_count; v++) {
            FrVertex vertex = fr_io_posed(&pose, &mesh->vertices[part->first_vertex + v]);
            add_vertex(output, &vertex);
        }
        fr_output_text(output, "usemtl ");
        fr_output_text(output, fr_surfaces_get(&obj->surfaces, surface)->name);
        fr_output_text(output, "\n");
        for (uint64_t i = 0; i + 2 < part->index_count; i += 3) {
            add_triangle(output, *written, &mesh->indices[part->first_index + i]);
        }
        *written += part->vertex_count;
    }
}

static bool write_obj(void *user, int descriptor) {
    FrObj *obj = user;
    FrOutput output;
    fr_output_start(&output, descriptor, obj->context->progress);
    fr_output_text(&output, "# Frond " FR_VERSION ", metres, y up\nmtllib ");
    fr_output_text(&output, obj->library);
    fr_output_text(&output, "\n");
    uint64_t written = 0;
    for (guint s = 0; s < obj->scene->stands->len && output.error == 0; s++) {
        add_stand(obj, &output, fr_io_stand(obj->scene, s), s, &written);
        fr_progress_report(obj->context->progress, "write",
                           (double)(s + 1) / (double)obj->scene->stands->len);
    }
    bool is_whole = fr_output_finish(&output);
    obj->bytes += output.done;
    return is_whole;
}

static void add_picture(FrObj *obj, FrOutput *output, const char *word, uint32_t picture) {
    if (picture != FR_NONE) {
        fr_output_text(output, word);
        fr_output_text(output, fr_surfaces_picture(&obj->surfaces, picture)->name);
        fr_output_text(output, "\n");
    }
}

static void add_normal_map(FrObj *obj, FrOutput *output, uint32_t picture, double relief) {
    if (picture != FR_NONE) {
        fr_output_text(output, "norm -bm ");
        fr_output_fixed(output, relief, 4);
        add_picture(obj, output, " ", picture);
    }
}

static bool write_library(void *user, int descriptor) {
    FrObj *obj = user;
    FrOutput output;
    fr_output_start(&output, descriptor, NULL);
    fr_output_text(&output, "# Frond " FR_VERSION "\n");
    for (guint i = 0; i < obj->surfaces.surfaces->len; i++) {
        const FrSurface *surface = fr_surfaces_get(&obj->surfaces, i);
        FrMaterialParams params = fr_surface_params(surface);
        double tint[3];
        fr_surface_tint(surface, tint);
        fr_output_text(&output, "\nnewmtl ");
        fr_output_text(&output, surface->name);
        fr_output_text(&output, params.mirror > 0 ? "\nillum 3\n" : "\nillum 2\n");
        add_fixed(&output, "Kd", tint, 3, 6);
        double mirror[3];
        for (int c = 0; c < 3; c++) {
            mirror[c] = tint[c] * params.mirror;
        }
        add_fixed(&output, "Ks", mirror, 3, 6);
        if (params.clear > 0) {
            double opaque = 1 - (1 - params.mirror) * params.clear;
            add_fixed(&output, "d", &opaque, 1, 4);
        }
        add_fixed(&output, "Pr", &params.roughness, 1, 4);
        add_picture(obj, &output, "map_Kd ", surface->picture[FR_MAP_COLOUR]);
        add_normal_map(obj, &output, surface->picture[FR_MAP_NORMAL], params.relief);
        add_picture(obj, &output, "map_Pr ", surface->picture[FR_MAP_ROUGHNESS]);
        const char *mask = g_ptr_array_index(obj->masks, i);
        if (mask != NULL) {
            fr_output_text(&output, "map_d ");
            fr_output_text(&output, mask);
            fr_output_text(&output, "\n");
        }
    }
    bool is_whole = fr_output_finish(&output);
    obj->bytes += output.done;
    return is_whole;
}

/// Some readers of `map_d` take a picture's alpha, others its brightness: in this one both are the
/// leaf.
static GBytes *mask_of(const FrSurface *surface, const FrContext *context, FrStatus *status) {
    const FrImage *image = fr_material_image(surface->material, FR_MAP_COLOUR, context, status);
    if (image == NULL || image->channels != 4) {
        return NULL;
    }
    FrImage *mask = fr_image_new(image->width, image->height, 4);
    size_t count = (size_t)image->width * image->height;
    for (size_t i = 0; i < count; i++) {
        memset(mask->pixels + 4 * i, image->pixels[4 * i + 3], 4);
    }
    GBytes *bytes = fr_image_to_png(mask);
    fr_image_unref(mask);
    return bytes;
}

static bool write_mask(void *user, int descriptor) {
    gsize size;
    const void *data = g_bytes_get_data(user, &size);
    FrChunk chunk = {data, size};
    return fr_write_chunks(descriptor, &chunk, 1, NULL);
}

static FrStatus write_masks(FrObj *obj, const char *path, GArray *files) {
    FrStatus status = FR_OK;
    for (guint i = 0; i < obj->surfaces.surfaces->len && status == FR_OK; i++) {
        const FrSurface *surface = fr_surfaces_get(&obj->surfaces, i);
        GBytes *bytes = surface->has_holes ? mask_of(surface, obj->context, &status) : NULL;
        char *name = NULL;
        if (bytes != NULL) {
            name = g_strdup_printf("%s-%s-mask.png", obj->surfaces.prefix, surface->name);
            char *beside = fr_io_beside(path, name);
            status = fr_replacements_write(files, beside, write_mask, bytes, obj->context->diags);
            obj->bytes += g_bytes_get_size(bytes);
            g_free(beside);
            g_bytes_unref(bytes);
        }
        g_ptr_array_add(obj->masks, name);
    }
    return status;
}

/// Pictures, masks, library, and the model last; then all appear.
static FrStatus write_files(FrObj *obj, const char *path) {
    GArray *files = fr_replacements_new();
    FrDiags *diags = obj->context->diags;
    FrStatus status = find_surfaces(obj);
    if (status == FR_OK) {
        status = fr_surfaces_write(&obj->surfaces, path, files, obj->context, &obj->bytes);
    }
    if (status == FR_OK) {
        status = write_masks(obj, path, files);
    }
    if (status == FR_OK) {
        char *library = fr_io_beside(path, obj->library);
        status = fr_replacements_write(files, library, write_library, obj, diags);
        g_free(library);
    }
    if (status == FR_OK) {
        status = fr_replacements_write(files, path, write_obj, obj, diags);
    }
    if (status == FR_OK) {
        status = fr_replacements_commit(files, diags);
    }
    g_array_unref(files);
    return status;
}

FrStatus fr_obj_write(const FrScene *scene, const char *path, const FrIoOptions *options,
                      const FrContext *context, FrIoStats *stats) {
    FrObj obj = {.scene = scene, .context = context};
    gint64 start = g_get_monotonic_time();
    FrStatus status = fr_io_meshes_make(&obj.meshes, scene, &options->skin, FR_UP_Y, true, context);
    if (status != FR_OK) {
        return status;
    }
    gint64 skinned = g_get_monotonic_time();
    char *stem = fr_io_stem(path);
    char *plain = g_strdelimit(g_strdup(stem), " \t", '_'); // .mtl names end at a space
    fr_surfaces_init(&obj.surfaces, plain);
    obj.masks = g_ptr_array_new_with_free_func(g_free);
    obj.library = g_strconcat(plain, ".mtl", NULL);
    status = write_files(&obj, path);
    *stats = (FrIoStats){
        .meshes = obj.meshes.count.meshes,
        .vertices = obj.meshes.count.vertices_everywhere,
        .triangles = obj.meshes.count.triangles_everywhere,
        .bytes = obj.bytes,
        .skin_seconds = (double)(skinned - start) * 1e-6,
        .write_seconds = (double)(g_get_monotonic_time() - skinned) * 1e-6,
    };
    g_free(plain);
    g_free(stem);
    g_free(obj.library);
    g_ptr_array_unref(obj.masks);
    fr_surfaces_clear(&obj.surfaces);
    fr_io_meshes_clear(&obj.meshes);
    return status;
}
