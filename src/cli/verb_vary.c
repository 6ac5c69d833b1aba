/// frond vary: a collection of instances of one plant, each a model, all in one scene, and a sheet
/// of their pictures.
#include "cli/cli.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

enum {
    INSTANCES = 7,
    TILE_WIDTH = 240,
    TILE_HEIGHT = 300,
    TILE_SAMPLES = 16,
    LONGEST_ROW = 8,
};

typedef struct Sheet {
    FrImage *image;
    uint32_t columns;
    FrRenderParams params;
} Sheet;

/// The plant to vary: the one that is named, else the first variation, else the first plant.
static const FrPlantDef *find_plant(const CliSession *session, const FrDocument *document) {
    const char *wanted = session->options->plant;
    const GPtrArray *plants = fr_document_plants(document);
    const FrPlantDef *found = NULL;
    const char **names = g_new(const char *, plants->len + 1);
    for (guint i = 0; i < plants->len; i++) {
        const FrPlantDef *plant = g_ptr_array_index(plants, i);
        names[i] = plant->id;
        bool is_better = wanted != NULL ? strcmp(plant->id, wanted) == 0
                                        : plant->kind == FR_PLANT_VARIED &&
                                              (found == NULL || found->kind != FR_PLANT_VARIED);
        found = is_better || (wanted == NULL && found == NULL) ? plant : found;
    }
    if (found == NULL) {
        char *hint = wanted == NULL ? g_strdup("") : cli_hint(wanted, names, plants->len);
        cli_message("there is no plant %s%s%s%s in the document", wanted == NULL ? "" : "'",
                    wanted == NULL ? "" : wanted, wanted == NULL ? "" : "'", hint);
        g_free(hint);
    }
    g_free(names);
    return found;
}

static FrStatus make_folder(CliSession *session, const char *folder) {
    if (g_mkdir_with_parents(folder, 0777) == 0) {
        return FR_OK;
    }
    fr_diags_add(session->context.diags, FR_ERROR, "write", (FrSpan){0},
                 "cannot make the folder '%s': %s", folder, g_strerror(errno));
    return FR_ERR_MACHINE;
}

static FrStatus begin_sheet(CliSession *session, uint32_t count, Sheet *sheet) {
    const CliOptions *options = session->options;
    fr_params_init(fr_render_table(), &sheet->params);
    sheet->params.width = options->width > 0 ? options->width : TILE_WIDTH;
    sheet->params.height = options->height > 0 ? options->height : TILE_HEIGHT;
    sheet->params.samples = options->samples > 0 ? options->samples : TILE_SAMPLES;
    sheet->columns = MIN(count, LONGEST_ROW);
    uint64_t rows = (count + sheet->columns - 1) / sheet->columns;
    uint64_t width = fr_count_multiply(sheet->columns, (uint64_t)sheet->params.width);
    uint64_t height = fr_count_multiply(rows, (uint64_t)sheet->params.height);
    FrStatus status =
        fr_limit_check(fr_count_multiply(width, height), session->context.limits.pixels, "pixels",
                       "the sheet", (FrSpan){0}, session->context.diags);
    if (status == FR_OK) {
        sheet->image = fr_image_new((uint32_t)width, (uint32_t)height, 3);
    }
    return status;
}

/// Copies a picture to its place on the sheet.
static void put_tile(Sheet *sheet, const FrImage *tile, uint32_t index) {
    size_t x = (size_t)(index % sheet->columns) * tile->width;
    size_t y = (size_t)(index / sheet->columns) * tile->height;
    for (size_t row = 0; row < tile->height; row++) {
        uint8_t *to = sheet->image->pixels + 3 * ((y + row) * sheet->image->width + x);
        const uint8_t *from = tile->pixels + tile->channels * row * tile->width;
        for (size_t i = 0; i < tile->width; i++) {
            memcpy(to + 3 * i, from + tile->channels * i, 3);
        }
    }
}

static FrStatus write_model(CliSession *session, const FrScene *scene, const char *path,
                            FrIoStats *total) {
    FrIoOptions io = fr_io_options_default();
    io.leaves = session->options->leaves;
    io.skin.lod = session->options->lod;
    FrIoStats stats = {0};
    FrStatus status = fr_io_write(scene, path, &io, &session->context, &stats);
    if (status == FR_OK && !session->options->is_quiet) {
        char *triangles = cli_count_text(stats.triangles);
        printf("%s: %s triangles\n", path, triangles);
        g_free(triangles);
    }
    total->meshes += stats.meshes;
    total->vertices += stats.vertices;
    total->triangles += stats.triangles;
    total->bytes += stats.bytes;
    total->skin_seconds += stats.skin_seconds;
    total->write_seconds += stats.write_seconds;
    return status;
}

static FrStatus render_tile(CliSession *session, const FrScene *single, Sheet *sheet,
                            uint32_t index) {
    FrSkinParams skin = fr_skin_default();
    skin.lod = session->options->lod;
    double began = cli_now();
    FrImage *tile = NULL;
    FrStatus status = fr_render(single, &sheet->params, &skin, &session->context, &tile);
    session->render_seconds += cli_now() - began;
    if (status == FR_OK) {
        put_tile(sheet, tile, index);
        fr_image_unref(tile);
    }
    return status;
}

/// Writes every instance and its picture. One after the other: each uses all threads itself.
static FrStatus write_instances(CliSession *session, const FrScene *scene, const char *folder,
                                Sheet *sheet, FrIoStats *total) {
    int digits = g_snprintf(NULL, 0, "%u", scene->plants->len);
    FrStatus status = FR_OK;
    for (guint i = 0; i < scene->plants->len && status == FR_OK; i++) {
        FrScene *single = fr_scene_single(scene, i);
        char *path = g_strdup_printf("%s/%s-%0*u.glb", folder, scene->name, digits, i + 1);
        status = write_model(session, single, path, total);
        if (status == FR_OK) {
            status = render_tile(session, single, sheet, i);
        }
        g_free(path);
        fr_scene_free(single);
    }
    return status;
}

static FrStatus save_sheet(CliSession *session, const Sheet *sheet, const char *path) {
    GBytes *png = fr_image_to_png(sheet->image);
    gsize size;
    const void *data = g_bytes_get_data(png, &size);
    FrStatus status = cli_session_save(session, path, data, size);
    g_bytes_unref(png);
    if (status == FR_OK && !session->options->is_quiet) {
        printf("%s: %u x %u pixels\n", path, sheet->image->width, sheet->image->height);
    }
    return status;
}

static FrStatus write_all(CliSession *session, const char *document, const FrScene *scene) {
    const char *folder = g_ptr_array_index(session->options->outputs, 0);
    Sheet sheet = {0};
    FrIoStats total = {0};
    FrStatus status = begin_sheet(session, scene->plants->len, &sheet);
    if (status == FR_OK) {
        status = make_folder(session, folder);
    }
    if (status == FR_OK) {
        status = write_instances(session, scene, folder, &sheet, &total);
    }
    char *model = g_strdup_printf("%s/%s.glb", folder, scene->name);
    char *picture = g_strdup_printf("%s/%s.png", folder, scene->name);
    if (status == FR_OK) {
        status = write_model(session, scene, model, &total);
    }
    if (status == FR_OK) {
        status = save_sheet(session, &sheet, picture);
    }
    if (status == FR_OK && session->options->stats != NULL) {
        status = cli_stats_write(session, document, scene, &total);
    }
    g_free(model);
    g_free(picture);
    fr_image_unref(sheet.image);
    fr_params_clear(fr_render_table(), &sheet.params);
    return status;
}

FrStatus cli_vary(CliSession *session) {
    const CliOptions *options = session->options;
    const char *path = g_ptr_array_index(options->files, 0);
    if (options->outputs->len != 1) {
        cli_message("vary needs one folder to write to: -o FOLDER");
        return FR_ERR_USAGE;
    }
    FrDocument *document;
    FrStatus status = cli_session_read(session, path, &document);
    if (status != FR_OK) {
        return status;
    }
    const FrPlantDef *plant = find_plant(session, document);
    FrScene *scene = NULL;
    double began = cli_now();
    if (plant == NULL) {
        status = options->plant != NULL ? FR_ERR_USAGE : FR_ERR_DOCUMENT;
    } else {
        uint32_t count = options->count > 0 ? (uint32_t)options->count : INSTANCES;
        status = fr_scene_collect(document, plant, options->seed, options->time, count,
                                  &session->context, &scene);
        session->build_seconds += cli_now() - began;
    }
    if (status == FR_OK) {
        FrNurbsParams plain = fr_nurbs_default();
        cli_nurbs_apply(options, scene, &plain);
        status = write_all(session, path, scene);
    }
    fr_scene_free(scene);
    fr_document_free(document);
    return status;
}
