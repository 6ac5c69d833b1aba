// Primitives: what the program makes, and what files hold.
#include "pgraph/prepare.h"

#include "frond/distance.h"
#include "pgraph/strewn.h"

#include <math.h>

FrStatus fr_prepare_file(FrPrepared *made, const FrPgraph *graph, const FrPrototype *prototype,
                         const char *name, const FrContext *context) {
    FrStatus status = FR_OK;
    made->file = fr_mesh_file_load(graph->folder, name, prototype->span, context, &status);
    return status;
}

static void add_piece(FrPrepared *made, uint32_t shape, uint32_t material) {
    made->pieces[made->piece_count++] = (FrPiece){shape, material};
}

// The parts of a file. What the component is made of is made of that alone.
static void add_parts(FrPrepared *made, vec3s size, FrPlant *plant) {
    const FrMeshFile *file = made->file;
    uint32_t index = fr_plant_add_file(plant, made->file);
    made->pieces = g_new(FrPiece, file->part_count);
    for (uint32_t part = 0; part < file->part_count; part++) {
        FrShape shape = {
            .kind = FR_SHAPE_FILE,
            .size = size,
            .detail = index,
            .outline = part,
        };
        FrMaterial *material = file->parts[part].material;
        bool has_own = material != NULL && made->material == FR_NONE;
        add_piece(made, fr_plant_add_shape(plant, &shape),
                  has_own ? fr_plant_add_material(plant, material) : FR_NONE);
    }
}

void fr_prepare_pieces(FrPrepared *made, int primitive, vec3s size, int64_t detail,
                       FrPlant *plant) {
    if (primitive == FR_PRIMITIVE_MESH) {
        add_parts(made, size, plant);
        return;
    }
    if (primitive < FR_PRIMITIVE_FIRST_SHAPE || primitive == FR_PRIMITIVE_NONE) {
        return;
    }
    FrShape shape = {
        .kind = (FrShapeKind)(primitive - FR_PRIMITIVE_FIRST_SHAPE + FR_SHAPE_BOX),
        .size = size,
        .detail = (uint32_t)detail,
    };
    made->pieces = g_new(FrPiece, 1);
    add_piece(made, fr_plant_add_shape(plant, &shape), FR_NONE);
}

FrStatus fr_prepare_body(FrPrepared *made, const FrPgraph *graph, const FrPrototype *prototype,
                         const FrContext *context) {
    const FrForceParams *force = prototype->params;
    if (force->kind != FR_FORCE_TO_MESH) {
        return FR_OK;
    }
    FrStatus status = fr_prepare_file(made, graph, prototype, force->file, context);
    if (status == FR_OK) {
        const FrMeshFile *file = made->file;
        status = fr_limit_check(fr_distance_bytes(file->index_count / 3), context->limits.bytes,
                                "bytes", prototype->id, prototype->span, context->diags);
    }
    if (status == FR_OK) {
        const FrMeshFile *file = made->file;
        made->distance =
            fr_distance_new(file->positions, file->vertex_count, file->indices, file->index_count);
        if (made->distance == NULL) {
            fr_diags_add(context->diags, FR_ERROR, "empty-mesh", prototype->span,
                         "'%s' has no triangle with an area", force->file);
            status = FR_ERR_DOCUMENT;
        } else if (force->inverted && !fr_distance_is_closed(made->distance)) {
            fr_diags_add(context->diags, FR_WARNING, "open-obstacle", prototype->span,
                         "'%s' is not closed: it has no outside that could be solid", force->file);
        }
    }
    return status;
}

FrStatus fr_prepare_scatter(FrPrepared *made, const FrPgraph *graph, const FrPrototype *prototype,
                            const FrContext *context) {
    const FrScatterParams *scatter = prototype->params;
    if (scatter->surface != FR_SCATTER_MESH) {
        return FR_OK;
    }
    FrStatus status = fr_prepare_file(made, graph, prototype, scatter->file, context);
    if (status != FR_OK) {
        return status;
    }
    made->strewn = g_new(FrStrewnSurface, 1);
    *made->strewn = (FrStrewnSurface){
        .file = made->file,
        .least_slope = scatter->slope_from,
        .most_slope = scatter->slope_to,
        .least_height = scatter->height_from,
        .most_height = scatter->height_to,
    };
    const char *map = scatter->density_file;
    if (map != NULL && *map != '\0') {
        char *path = g_build_filename(graph->folder != NULL ? graph->folder : ".", map, NULL);
        made->strewn->map = fr_image_load(path, prototype->span, context, &status);
        g_free(path);
    }
    fr_strewn_init(made->strewn);
    return status;
}
