#include "studio/view/store.h"

#include "studio/view/pictures.h"

#include "frond/daylight.h"

#include <math.h>
#include <string.h>

static const float most_enlarged = 2.2f;

// A mesh or a part of one.
typedef struct Part {
    GLuint vertices, indices;
    size_t vertex_size, index_size; // bytes of the buffers
    uint64_t index_count;
    uint32_t material;
    bool is_blade;
} Part;

typedef struct Look {
    FrDigest digest;
    StudioDress dress;
    float picture_tint[3];
} Look;

typedef struct Plant {
    const FrSkin *skin; // whose parts are held; never followed
    GArray *wood;       // Part
    GArray *coarse;     // Part; empty: there is none yet
    GArray *foliage;    // Part
    GArray *shapes;     // Part: fine and coarse in turn
    GArray *batches;    // StudioBatch
    GArray *looks;      // Look
    GLuint leaves, points;
    uint32_t point_count;
    uint64_t leaf_triangles, wood_triangles;
} Plant;

typedef struct Stand {
    mat4s model;
    uint32_t plant;
    bool is_still; // an obstacle
} Stand;

struct StudioStore {
    GPtrArray *plants; // Plant *
    GArray *stands;    // Stand
    StudioPictures *pictures;
    FrShading shading;
    double min[3], max[3];
    float sun[3];
    StudioAmount amount;
};

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
    g_array_unref(plant->coarse);
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
    plant->coarse = new_parts();
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
                              .mirror = look->mirror}};
        memcpy(own.dress.tint, look->tint, sizeof own.dress.tint);
        memcpy(own.picture_tint, look->picture_tint, sizeof own.picture_tint);
        g_array_append_val(plant->looks, own);
    }
}

static void send_plant(Plant *plant, const StudioPlant *from) {
    send_wood(plant, from->is_rational ? NULL : from->wood);
    send_mesh(plant->coarse, from->is_rational ? NULL : from->coarse_wood);
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

static void dress(const StudioStore *store, const Plant *plant, uint32_t material,
                  StudioPiece *piece) {
    if (material >= plant->looks->len) { // of no material: as pictures show it
        piece->look = piece->is_blade
                          ? (StudioDress){.tint = {0.12f, 0.25f, 0.05f},
                                          .roughness = 0.5f,
                                          .translucency = 0.45f}
                          : (StudioDress){.tint = {0.22f, 0.17f, 0.12f}, .roughness = 0.9f};
        return;
    }
    const Look *look = &g_array_index(plant->looks, Look, material);
    piece->picture = studio_pictures_find(store->pictures, look->digest, FR_MAP_COLOUR);
    piece->bumps = studio_pictures_find(store->pictures, look->digest, FR_MAP_NORMAL);
    piece->gloss = studio_pictures_find(store->pictures, look->digest, FR_MAP_ROUGHNESS);
    piece->look = look->dress;
    if (piece->picture != 0) {
        memcpy(piece->look.tint, look->picture_tint, sizeof piece->look.tint);
    }
}

static StudioPiece piece_of(const StudioStore *store, const Stand *stand, const Plant *plant,
                            const Part *part, uint32_t material) {
    StudioPiece piece = {.model = stand->model,
                         .vertices = part->vertices,
                         .indices = part->indices,
                         .index_count = part->index_count,
                         .enlarge = 1,
                         .is_blade = part->is_blade,
                         .is_still = stand->is_still,
                         .triangles = part->index_count / 3};
    dress(store, plant, material, &piece);
    return piece;
}

static void list_parts(const StudioStore *store, const Stand *stand, const Plant *plant,
                       const GArray *parts, uint64_t most, GArray *list) {
    for (guint i = 0; i < parts->len; i++) {
        const Part *part = &g_array_index(parts, Part, i);
        StudioPiece piece = piece_of(store, stand, plant, part, part->material);
        for (uint64_t first = 0; first < part->index_count; first += 3 * most) {
            piece.first_index = first;
            piece.index_count = MIN(3 * most, part->index_count - first);
            piece.triangles = piece.index_count / 3;
            g_array_append_val(list, piece);
        }
    }
}

// The first `part` of each batch, in pieces of at most `most` triangles.
static void list_leaves(const StudioStore *store, const Stand *stand, const Plant *plant,
                        bool is_coarse, double part, uint64_t most, GArray *list) {
    for (guint b = 0; b < plant->batches->len; b++) {
        const StudioBatch *batch = &g_array_index(plant->batches, StudioBatch, b);
        const Part *shape =
            &g_array_index(plant->shapes, Part, 2 * batch->shape + (is_coarse ? 1 : 0));
        uint64_t wanted = MAX(1, (uint64_t)(part * batch->count));
        uint64_t each = shape->index_count / 3;
        if (each == 0) {
            continue;
        }
        StudioPiece piece = piece_of(store, stand, plant, shape, batch->material);
        piece.leaves = plant->leaves;
        piece.enlarge = fminf((float)sqrt((double)batch->count / (double)wanted), most_enlarged);
        uint64_t step = MAX(1, most / each);
        for (uint64_t first = 0; first < wanted; first += step) {
            piece.first_leaf = batch->first + first;
            piece.leaf_count = MIN(step, wanted - first);
            piece.triangles = piece.leaf_count * each;
            g_array_append_val(list, piece);
        }
    }
}

static GArray *new_list(void) {
    return g_array_new(FALSE, FALSE, sizeof(StudioPiece));
}

static const Plant *plant_of(const StudioStore *store, const Stand *stand) {
    return g_ptr_array_index(store->plants, stand->plant);
}

GArray *studio_store_list_fine(const StudioStore *store, uint64_t most) {
    GArray *list = new_list();
    for (guint i = 0; i < store->stands->len; i++) {
        const Stand *stand = &g_array_index(store->stands, Stand, i);
        const Plant *plant = plant_of(store, stand);
        list_parts(store, stand, plant, plant->wood, most, list);
        list_parts(store, stand, plant, plant->foliage, most, list);
        list_leaves(store, stand, plant, false, 1, most, list);
    }
    return list;
}

static uint64_t coarse_leaf_triangles(const StudioStore *store) {
    uint64_t sum = 0;
    for (guint i = 0; i < store->stands->len; i++) {
        const Plant *plant = plant_of(store, &g_array_index(store->stands, Stand, i));
        for (guint b = 0; b < plant->batches->len; b++) {
            const StudioBatch *batch = &g_array_index(plant->batches, StudioBatch, b);
            sum += batch->count *
                   (g_array_index(plant->shapes, Part, 2 * batch->shape + 1).index_count / 3);
        }
    }
    return sum;
}

static const GArray *coarse_wood_of(const Plant *plant) {
    return plant->coarse->len > 0 ? plant->coarse : plant->wood;
}

static uint64_t coarse_wood_triangles(const StudioStore *store) {
    uint64_t sum = 0;
    for (guint i = 0; i < store->stands->len; i++) {
        const GArray *parts =
            coarse_wood_of(plant_of(store, &g_array_index(store->stands, Stand, i)));
        for (guint p = 0; p < parts->len; p++) {
            sum += g_array_index(parts, Part, p).index_count / 3;
        }
    }
    return sum;
}

GArray *studio_store_list_coarse(const StudioStore *store, uint64_t budget, uint64_t most) {
    GArray *list = new_list();
    uint64_t leaves = coarse_leaf_triangles(store);
    double left = fmax(0.4 * (double)budget, (double)budget - (double)coarse_wood_triangles(store));
    double part = leaves == 0 ? 1 : fmin(1, left / (double)leaves);
    for (guint i = 0; i < store->stands->len; i++) {
        const Stand *stand = &g_array_index(store->stands, Stand, i);
        const Plant *plant = plant_of(store, stand);
        list_parts(store, stand, plant, coarse_wood_of(plant), most, list);
        list_parts(store, stand, plant, plant->foliage, most, list);
        list_leaves(store, stand, plant, true, part, most, list);
    }
    return list;
}

void studio_store_each_skeleton(const StudioStore *store,
                                void (*draw)(void *user, const mat4s *model, GLuint points,
                                             uint32_t count),
                                void *user) {
    for (guint i = 0; i < store->stands->len; i++) {
        const Stand *stand = &g_array_index(store->stands, Stand, i);
        const Plant *plant = plant_of(store, stand);
        draw(user, &stand->model, plant->points, plant->point_count);
    }
}
