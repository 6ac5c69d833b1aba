#include "io/meshes.h"

#include "plant/place.h"

#include <math.h>

const FrPlant *fr_io_plant(const FrScene *scene, uint32_t plant) {
    return g_array_index(scene->plants, FrScenePlant, plant).plant;
}

const FrStand *fr_io_stand(const FrScene *scene, guint stand) {
    return &g_array_index(scene->stands, FrStand, stand);
}

FrIoStands fr_io_stands_of(const FrScene *scene) {
    uint32_t plants = scene->plants->len, count = scene->stands->len;
    FrIoStands stands = {g_new0(uint32_t, plants + 2u), g_new(uint32_t, count + 1u)};
    for (guint i = 0; i < count; i++) {
        stands.first[fr_io_stand(scene, i)->plant + 2]++;
    }
    for (uint32_t p = 0; p < plants; p++) {
        stands.first[p + 2] += stands.first[p + 1];
    }
    // Each plant's end moves from where it begins to where the next one does.
    for (guint i = 0; i < count; i++) {
        stands.number[stands.first[fr_io_stand(scene, i)->plant + 1]++] = i;
    }
    return stands;
}

void fr_io_stands_clear(FrIoStands *stands) {
    g_free(stands->first);
    g_free(stands->number);
    *stands = (FrIoStands){0};
}

static void count_mesh(FrIoCount *count, const FrMesh *mesh, uint32_t stands) {
    uint64_t triangles = mesh->index_count / 3;
    count->meshes += mesh->index_count > 0;
    count->vertices = fr_count_add(count->vertices, mesh->vertex_count);
    count->triangles = fr_count_add(count->triangles, triangles);
    count->vertices_everywhere =
        fr_count_add(count->vertices_everywhere, fr_count_multiply(mesh->vertex_count, stands));
    count->triangles_everywhere =
        fr_count_add(count->triangles_everywhere, fr_count_multiply(triangles, stands));
}

FrStatus fr_io_meshes_make(FrIoMeshes *meshes, const FrScene *scene, const FrSkinParams *skin,
                           FrUpAxis up, bool expands, const FrContext *context) {
    *meshes = (FrIoMeshes){.meshes = g_new0(FrMesh *, MAX(scene->plants->len, 1)),
                           .stands = fr_io_stands_of(scene),
                           .length = scene->plants->len};
    FrStatus status = FR_OK;
    for (uint32_t p = 0; p < meshes->length && status == FR_OK; p++) {
        uint32_t stands = fr_io_stand_count(&meshes->stands, p);
        if (stands == 0) {
            continue;
        }
        const FrPlant *plant = fr_io_plant(scene, p);
        status = fr_scene_mesh(&g_array_index(scene->plants, FrScenePlant, p), skin, up, context,
                               &meshes->meshes[p]);
        if (status == FR_OK) {
            count_mesh(&meshes->count, meshes->meshes[p], stands);
            status = fr_limit_check(expands ? meshes->count.triangles_everywhere
                                            : meshes->count.triangles,
                                    context->limits.triangles, "triangles", plant->name,
                                    fr_plant_place(plant), context->diags);
        }
    }
    if (status != FR_OK) {
        fr_io_meshes_clear(meshes);
    }
    return status;
}

FrSpan fr_io_largest_place(const FrIoMeshes *meshes, const FrScene *scene) {
    uint64_t most = 0;
    FrSpan place = {0};
    for (uint32_t p = 0; p < meshes->length; p++) {
        const FrMesh *mesh = meshes->meshes[p];
        uint64_t triangles =
            mesh == NULL
                ? 0
                : fr_count_multiply(mesh->index_count / 3, fr_io_stand_count(&meshes->stands, p));
        if (triangles > most) {
            most = triangles;
            place = fr_plant_place(fr_io_plant(scene, p));
        }
    }
    return place;
}

void fr_io_meshes_clear(FrIoMeshes *meshes) {
    for (uint32_t p = 0; p < meshes->length; p++) {
        fr_mesh_free(meshes->meshes[p]);
    }
    g_free(meshes->meshes);
    fr_io_stands_clear(&meshes->stands);
    *meshes = (FrIoMeshes){0};
}

FrPose fr_io_pose(const FrStand *stand, FrUpAxis up) {
    FrPose pose = {
        .at = {stand->at[0], stand->at[1], stand->at[2]},
        .cosine = cos(stand->turn),
        .sine = sin(stand->turn),
        .scale = stand->scale,
        .up = up,
    };
    if (up == FR_UP_Y) {
        pose.at[1] = stand->at[2];
        pose.at[2] = -stand->at[1];
    }
    return pose;
}

static void turned(const FrPose *pose, const float from[3], double to[3]) {
    if (pose->up == FR_UP_Z) {
        to[0] = pose->cosine * (double)from[0] - pose->sine * (double)from[1];
        to[1] = pose->sine * (double)from[0] + pose->cosine * (double)from[1];
        to[2] = (double)from[2];
    } else {
        to[0] = pose->cosine * (double)from[0] + pose->sine * (double)from[2];
        to[1] = (double)from[1];
        to[2] = -pose->sine * (double)from[0] + pose->cosine * (double)from[2];
    }
}

FrVertex fr_io_posed(const FrPose *pose, const FrVertex *vertex) {
    double position[3];
    double normal[3];
    turned(pose, vertex->position, position);
    turned(pose, vertex->normal, normal);
    FrVertex posed = *vertex;
    for (int k = 0; k < 3; k++) {
        posed.position[k] = (float)(position[k] * pose->scale + pose->at[k]);
        posed.normal[k] = (float)normal[k];
    }
    return posed;
}
