#include "io/nurbs_scene.h"

#include "plant/place.h"

#include <string.h>

// Before the materials: wood and leaves that have none.
enum { DEFAULT_COLOURS = 2 };

FrStatus fr_io_nurbs_make(FrIoNurbs *nurbs, const FrScene *scene, const FrNurbsParams *params,
                          bool shares, uint64_t point_bytes, const FrContext *context) {
    uint32_t plants = scene->plants->len;
    *nurbs = (FrIoNurbs){
        .skins = g_new0(FrNurbsSkin *, MAX(plants, 1)),
        .first_colour = g_new0(uint32_t, MAX(plants, 1)),
        .length = plants,
    };
    FrIoStands standing = fr_io_stands_of(scene);
    FrStatus status = FR_OK;
    for (uint32_t p = 0; p < plants && status == FR_OK; p++) {
        const FrPlant *plant = fr_io_plant(scene, p);
        uint32_t stands = fr_io_stand_count(&standing, p);
        nurbs->first_colour[p] = nurbs->colours;
        nurbs->colours += plant->materials->len + DEFAULT_COLOURS;
        if (stands == 0) {
            continue;
        }
        const FrScenePlant *built = &g_array_index(scene->plants, FrScenePlant, p);
        const FrNurbsParams *own = built->has_nurbs ? &built->nurbs : params;
        status = shares ? fr_nurbs_plant_shared(plant, own, context, &nurbs->skins[p])
                        : fr_nurbs_plant(plant, own, context, &nurbs->skins[p]);
        if (status == FR_OK) {
            const FrNurbsSkin *skin = nurbs->skins[p];
            nurbs->surfaces = fr_count_add(nurbs->surfaces,
                                           fr_count_multiply(fr_nurbs_skin_surfaces(skin), stands));
            nurbs->points =
                fr_count_add(nurbs->points, fr_count_multiply(skin->point_count, stands));
            status =
                fr_limit_check(fr_count_multiply(nurbs->points, point_bytes), context->limits.bytes,
                               "bytes", plant->name, fr_plant_place(plant), context->diags);
        }
    }
    fr_io_stands_clear(&standing);
    if (status != FR_OK) {
        fr_io_nurbs_clear(nurbs);
    }
    return status;
}

void fr_io_nurbs_clear(FrIoNurbs *nurbs) {
    for (uint32_t p = 0; p < nurbs->length; p++) {
        fr_nurbs_skin_free(nurbs->skins[p]);
    }
    g_free(nurbs->skins);
    g_free(nurbs->first_colour);
    *nurbs = (FrIoNurbs){0};
}

uint32_t fr_io_nurbs_colour(const FrIoNurbs *nurbs, uint32_t plant, const FrNurbsPiece *piece) {
    uint32_t own = piece->material == FR_NONE ? (piece->organ != FR_NONE ? 1 : 0)
                                              : DEFAULT_COLOURS + piece->material;
    return nurbs->first_colour[plant] + own;
}

bool fr_io_nurbs_rgb(const FrScene *scene, uint32_t plant, uint32_t n, double rgb[3]) {
    static const double defaults[DEFAULT_COLOURS][3] = {{0.45, 0.36, 0.28}, {0.36, 0.5, 0.2}};
    const GPtrArray *materials = fr_io_plant(scene, plant)->materials;
    if (n >= materials->len + DEFAULT_COLOURS) {
        return false;
    }
    if (n < DEFAULT_COLOURS) {
        memcpy(rgb, defaults[n], sizeof defaults[n]);
        return true;
    }
    const FrMaterial *material = g_ptr_array_index(materials, n - DEFAULT_COLOURS);
    for (int k = 0; k < 3; k++) {
        double value = (double)fr_material_params(material)->colour.raw[k];
        rgb[k] = CLAMP(value, 0.0, 1.0);
    }
    return true;
}

void fr_io_nurbs_posed(const FrPose *pose, const double point[4], double posed[4]) {
    double x = pose->cosine * point[0] - pose->sine * point[1];
    double y = pose->sine * point[0] + pose->cosine * point[1];
    posed[0] = pose->at[0] + pose->scale * x;
    posed[1] = pose->at[1] + pose->scale * y;
    posed[2] = pose->at[2] + pose->scale * point[2];
    posed[3] = point[3];
}

int fr_real_text(char text[FR_REAL_ROOM], double value, int digits) {
    const char format[] = {'%', '.', (char)('0' + digits / 10), (char)('0' + digits % 10), 'g', 0};
    char raw[FR_REAL_ROOM];
    g_ascii_formatd(raw, sizeof raw, format, value);
    int length = 0;
    bool has_point = false;
    for (const char *c = raw; *c != '\0'; c++) {
        if (*c == 'e' && !has_point) {
            text[length++] = '.';
        }
        has_point = has_point || *c == '.' || *c == 'e';
        text[length++] = *c == 'e' ? 'E' : *c;
    }
    if (!has_point) {
        text[length++] = '.';
    }
    text[length] = '\0';
    return length;
}

FrIoStats fr_io_nurbs_stats(const FrIoNurbs *nurbs, uint64_t bytes, gint64 start, gint64 skinned) {
    return (FrIoStats){
        .surfaces = nurbs->surfaces,
        .bytes = bytes,
        .skin_seconds = (double)(skinned - start) * 1e-6,
        .write_seconds = (double)(g_get_monotonic_time() - skinned) * 1e-6,
    };
}
