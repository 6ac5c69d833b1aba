#include "studio/view/store_private.h"

#include "frond/daylight.h"

#include <math.h>
#include <string.h>

// ---- life --------------------------------------------------------------------------------------

static void part_clear(gpointer data) {
    Part *part = data;
    glDeleteBuffers(1, &part->vertices);
    glDeleteBuffers(1, &part->indices);
}

static GArray *new_parts(void) {
    GArray *parts = g_array_new(FALSE, TRUE, sizeof(Part));
    g_array_set_clear_func(parts, part_clear);
    return parts;
}

static void plant_free(gpointer data) {
    Plant *plant = data;
    g_array_unref(plant->wood);
    for (int level = 0; level < STUDIO_COARSE_LEVELS; level++) {
        g_array_unref(plant->coarse[level]);
    }
    g_array_unref(plant->foliage);
    g_array_unref(plant->shapes);
    g_array_unref(plant->batches);
    g_array_unref(plant->looks);
    glDeleteBuffers(1, &plant->leaves);
    glDeleteBuffers(1, &plant->points);
    g_free(plant);
}

static Plant *plant_new(void) {
    Plant *plant = g_new0(Plant, 1);
    plant->wood = new_parts();
    for (int level = 0; level < STUDIO_COARSE_LEVELS; level++) {
        plant->coarse[level] = new_parts();
    }
    plant->foliage = new_parts();
    plant->shapes = new_parts();
    plant->batches = g_array_new(FALSE, FALSE, sizeof(StudioBatch));
    plant->looks = g_array_new(FALSE, FALSE, sizeof(Look));
    glGenBuffers(1, &plant->leaves);
    glGenBuffers(1, &plant->points);
    return plant;
}

StudioStore *studio_store_new(void) {
    StudioStore *store = g_new0(StudioStore, 1);
    store->plants = g_ptr_array_new_with_free_func(plant_free);
    store->stands = g_array_new(FALSE, FALSE, sizeof(Stand));
    store->pictures = studio_pictures_new();
    store->sun[2] = 1;
    studio_store_clear(store);
    return store;
}

void studio_store_free(StudioStore *store) {
    if (store != NULL) {
        g_ptr_array_unref(store->plants);
        g_array_unref(store->stands);
        studio_pictures_free(store->pictures);
        g_free(store);
    }
}

// ---- sending -----------------------------------------------------------------------------------

// Sends bytes [begin, end) of an array of `size` bytes; all of it where the buffer is too small.
static void send(GLenum target, GLuint buffer, size_t *held, const void *data, size_t size,
                 size_t begin, size_t end) {
    glBindBuffer(target, buffer);
    if (size > *held) {
        *held = size + size / 4;
        glBufferData(target, (GLsizeiptr)*held, NULL, GL_DYNAMIC_DRAW);
        begin = 0;
        end = size;
    }
    if (end > begin) {
        glBufferSubData(target, (GLintptr)begin, (GLsizeiptr)(end - begin),
                        (const char *)data + begin);
    }
}

static void part_make(Part *part) {
    if (part->vertices == 0) {
        glGenBuffers(1, &part->vertices);
        glGenBuffers(1, &part->indices);
    }
}

static void send_part(Part *part, const FrVertex *vertices, const uint32_t *indices,
                      const FrMeshPart *from, const uint64_t changed[4]) {
    part_make(part);
    send(GL_ARRAY_BUFFER, part->vertices, &part->vertex_size, vertices,
         from->vertex_count * sizeof(FrVertex), changed[0] * sizeof(FrVertex),
         changed[1] * sizeof(FrVertex));
    send(GL_ELEMENT_ARRAY_BUFFER, part->indices, &part->index_size, indices,
         from->index_count * sizeof(uint32_t), changed[2] * sizeof(uint32_t),
         changed[3] * sizeof(uint32_t));
    part->index_count = from->index_count;
    part->material = from->material;
    part->is_blade = from->is_foliage;
}

static void send_mesh_part(Part *part, const FrMesh *mesh, const FrMeshPart *from) {
    const uint64_t all[4] = {0, from->vertex_count, 0, from->index_count};
    send_part(part, mesh->vertices + from->first_vertex, mesh->indices + from->first_index, from,
              all);
}

static void send_wood(Plant *plant, const FrSkin *skin) {
    if (skin == NULL) {
        plant->skin = NULL;
        plant->wood_triangles = 0;
        g_array_set_size(plant->wood, 0);
        return;
    }
    uint32_t count;
    const FrSkinPart *parts = fr_skin_parts(skin, &count);
    bool is_known = plant->skin == skin && plant->wood->len == count;
    plant->skin = skin;
    g_array_set_size(plant->wood, count);
    plant->wood_triangles = 0;
    for (uint32_t i = 0; i < count; i++) {
        const FrSkinPart *from = &parts[i];
        bool is_whole = !is_known || from->is_moved;
        const uint64_t changed[4] = {
            is_whole ? 0 : from->changed_vertex,
            is_whole ? from->part.vertex_count : from->changed_vertex_end,
            is_whole ? 0 : from->changed_index,
            is_whole ? from->part.index_count : from->changed_index_end,
        };
        send_part(&g_array_index(plant->wood, Part, i), from->vertices, from->indices, &from->part,
                  changed);
        plant->wood_triangles += from->part.index_count / 3;
    }
}

static void send_mesh(GArray *parts, const FrMesh *mesh) {
    g_array_set_size(parts, mesh == NULL ? 0 : mesh->part_count);
    for (guint i = 0; i < parts->len; i++) {
        send_mesh_part(&g_array_index(parts, Part, i), mesh, &mesh->parts[i]);
    }
}

static void send_shapes(Plant *plant, const StudioPlant *from) {
    g_array_set_size(plant->shapes, 2 * from->shapes->len);
    for (guint i = 0; i < from->shapes->len; i++) {
        const StudioShape *shape = &g_array_index(from->shapes, StudioShape, i);
        const FrMesh *meshes[] = {shape->fine, shape->coarse};
        for (guint k = 0; k < 2; k++) {
            if (meshes[k] != NULL && meshes[k]->part_count > 0) {
                send_mesh_part(&g_array_index(plant->shapes, Part, 2 * i + k), meshes[k],
                               &meshes[k]->parts[0]);
            }
        }
    }
}

static void send_array(GLuint buffer, const GArray *array, size_t element) {
    glBindBuffer(GL_ARRAY_BUFFER, buffer);
    glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(array->len * element), array->data, GL_DYNAMIC_DRAW);
}

static void copy_looks(Plant *plant, const StudioPlant *from) {
    g_array_set_size(plant->looks, 0);
    for (guint i = 0; i < from->looks->len; i++) {
        const StudioLook *look = &g_array_index(from->looks, StudioLook, i);
        Look own = {.digest = look->digest,
                    .dress = {.cutoff = look->alpha_cutoff,
                              .translucency = look->translucency,
                              .roughness = look->roughness,
                              .relief = look->relief,
                              .mirror = look->mirror,
                              .clear = look->clear}};
        memcpy(own.dress.tint, look->tint, sizeof own.dress.tint);
        memcpy(own.picture_tint, look->picture_tint, sizeof own.picture_tint);
        g_array_append_val(plant->looks, own);
    }
}

static void send_plant(Plant *plant, const StudioPlant *from) {
    send_wood(plant, from->is_rational ? NULL : from->wood);
    for (int level = 0; level < STUDIO_COARSE_LEVELS; level++) {
        send_mesh(plant->coarse[level], from->is_rational ? NULL : from->coarse_wood[level]);
    }
    plant->middle = from->middle;
    plant->radius = from->radius;
    send_mesh(plant->foliage, from->foliage);
    send_shapes(plant, from);
    g_array_set_size(plant->batches, 0);
    g_array_append_vals(plant->batches, from->batches->data, from->batches->len);
    send_array(plant->leaves, from->leaves, sizeof(StudioLeaf));
    send_array(plant->points, from->points, sizeof(StudioPoint));
    plant->point_count = from->points->len;
    copy_looks(plant, from);
    plant->leaf_triangles = 0;
    for (guint b = 0; b < plant->batches->len; b++) {
        const StudioBatch *batch = &g_array_index(plant->batches, StudioBatch, b);
        const Part *shape = &g_array_index(plant->shapes, Part, 2 * batch->shape);
        plant->leaf_triangles += batch->count * (shape->index_count / 3);
    }
}

static mat4s model_of(const FrStand *stand) {
    float c = (float)(stand->scale * cos(stand->turn)),
          s = (float)(stand->scale * sin(stand->turn));
    mat4s model = GLMS_MAT4_IDENTITY;
    model.raw[0][0] = c, model.raw[0][1] = s;
    model.raw[1][0] = -s, model.raw[1][1] = c;
    model.raw[2][2] = (float)stand->scale;
    for (int i = 0; i < 3; i++) {
        model.raw[3][i] = (float)stand->at[i];
    }
    return model;
}

// A sun below or on the horizon would light nothing: it stands a little above.
static void place_sun(StudioStore *store, const FrSceneParams *params) {
    static const double least = 5 * G_PI / 180;
    vec3s sun = fr_light_sun_direction(params->sun_azimuth, fmax(params->sun_elevation, least));
    memcpy(store->sun, sun.raw, sizeof store->sun);
}

static void measure(StudioStore *store) {
    StudioAmount *amount = &store->amount;
    *amount = (StudioAmount){.uploaded_seconds = amount->uploaded_seconds};
    for (guint i = 0; i < store->stands->len; i++) {
        uint32_t index = g_array_index(store->stands, Stand, i).plant;
        const Plant *plant = g_ptr_array_index(store->plants, index);
        amount->triangles += plant->wood_triangles + plant->leaf_triangles;
        amount->nodes += plant->point_count / 2;
        for (guint b = 0; b < plant->batches->len; b++) {
            amount->leaves += g_array_index(plant->batches, StudioBatch, b).count;
        }
        for (guint p = 0; p < plant->foliage->len; p++) {
            amount->triangles += g_array_index(plant->foliage, Part, p).index_count / 3;
        }
    }
}

void studio_store_update(StudioStore *store, const StudioView *view) {
    gint64 began = g_get_monotonic_time();
    g_ptr_array_set_size(store->plants, (gint)MIN(store->plants->len, view->plants->len));
    while (store->plants->len < view->plants->len) {
        g_ptr_array_add(store->plants, plant_new());
    }
    for (guint i = 0; i < view->plants->len; i++) {
        send_plant(g_ptr_array_index(store->plants, i), g_ptr_array_index(view->plants, i));
    }
    g_array_set_size(store->stands, 0);
    for (guint i = 0; i < view->scene->stands->len; i++) {
        const FrStand *from = &g_array_index(view->scene->stands, FrStand, i);
        Stand stand = {model_of(from), from->plant, i >= fr_scene_stand_count(view->scene)};
        g_array_append_val(store->stands, stand);
    }
    fr_scene_bounds(view->scene, store->min, store->max);
    store->shading = view->shading;
    place_sun(store, view->scene->params);
    glFinish();
    measure(store);
    store->amount.uploaded_seconds = (double)(g_get_monotonic_time() - began) * 1e-6;
}

void studio_store_clear(StudioStore *store) {
    g_array_set_size(store->stands, 0);
    g_ptr_array_set_size(store->plants, 0);
    store->min[0] = 1;
    store->max[0] = -1;
    store->amount = (StudioAmount){0};
}

void studio_store_add_picture(StudioStore *store, const StudioPicture *picture) {
    studio_pictures_add(store->pictures, picture);
}

// ---- looking -----------------------------------------------------------------------------------

StudioAmount studio_store_amount(const StudioStore *store) {
    return store->amount;
}

void studio_store_bounds(const StudioStore *store, double min[3], double max[3]) {
    memcpy(min, store->min, sizeof store->min);
    memcpy(max, store->max, sizeof store->max);
}

const FrShading *studio_store_shading(const StudioStore *store) {
    return &store->shading;
}

void studio_store_sun(const StudioStore *store, float sun[3]) {
    memcpy(sun, store->sun, sizeof store->sun);
}

void studio_store_each_skeleton(const StudioStore *store,
                                void (*draw)(void *user, const mat4s *model, GLuint points,
                                             uint32_t count),
                                void *user) {
    for (guint i = 0; i < store->stands->len; i++) {
        const Stand *stand = &g_array_index(store->stands, Stand, i);
        const Plant *plant = studio_store_plant(store, stand);
        draw(user, &stand->model, plant->points, plant->point_count);
    }
}
