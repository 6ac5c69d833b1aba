// The triangles of a light scene, compared with those of the scene before.
#include "light/surfaces.h"

#include "frond/digest.h"
#include "light/key_table.h"

#include <cglm/struct.h>
#include <math.h>

/// What tells triangles apart.
typedef struct Triangle {
    float corners[9];
    float uv[6]; ///< 0 if it has no mask
    uint32_t material;
} Triangle;

/// A stand as it was baked.
typedef struct Stand {
    FrDigest digest;
    uint32_t *triangles; ///< the number of each in the soup; FR_NONE: without an area
    uint64_t triangle_count;
} Stand;

struct FrSurfaces {
    FrSoup *soup;
    GArray *materials; ///< FrLightMaterial, distinct
    FrKeyTable table;  ///< key of a triangle → its number, also of some that are gone
    uint32_t *material;
    uint64_t *element; ///< of its first owner
    float (*uv)[6];
    bool *is_seen; ///< in the scene being set
    uint32_t count, capacity;
    GArray *stands;          ///< Stand
    GArray *first_elements;  ///< uint64_t, one more than stands
    GArray *corners, *keys;  ///< what will be added
    uint32_t last, last_end; ///< triangles of the last batch
    float (*last_corners)[9];
    FrMaskFn mask;
    void *mask_user;
};

static bool is_hole(void *user, uint32_t triangle, double u, double v) {
    const FrSurfaces *surfaces = user;
    const FrLightMaterial *material =
        &g_array_index(surfaces->materials, FrLightMaterial, surfaces->material[triangle]);
    if (material->mask == 0 || surfaces->mask == NULL) {
        return false;
    }
    const float *uv = surfaces->uv[triangle];
    float b = (float)u, c = (float)v, a = 1.0f - b - c;
    return surfaces->mask(surfaces->mask_user, material->mask, a * uv[0] + b * uv[2] + c * uv[4],
                          a * uv[1] + b * uv[3] + c * uv[5]);
}

FrSurfaces *fr_surfaces_new(int threads) {
    FrSurfaces *surfaces = g_new0(FrSurfaces, 1);
    surfaces->soup = fr_soup_new(threads, is_hole, surfaces);
    surfaces->materials = g_array_new(FALSE, FALSE, sizeof(FrLightMaterial));
    surfaces->stands = g_array_new(FALSE, FALSE, sizeof(Stand));
    surfaces->first_elements = g_array_new(FALSE, FALSE, sizeof(uint64_t));
    return surfaces;
}

static void free_stands(GArray *stands) {
    for (guint i = 0; i < stands->len; i++) {
        g_free(g_array_index(stands, Stand, i).triangles);
    }
    g_array_unref(stands);
}

void fr_surfaces_free(FrSurfaces *surfaces) {
    if (surfaces == NULL) {
        return;
    }
    fr_soup_free(surfaces->soup);
    g_array_unref(surfaces->materials);
    fr_key_table_clear(&surfaces->table);
    g_free(surfaces->material);
    g_free(surfaces->element);
    g_free(surfaces->uv);
    g_free(surfaces->is_seen);
    free_stands(surfaces->stands);
    g_array_unref(surfaces->first_elements);
    g_free(surfaces);
}

// Bytes between the fields of a struct would make digests differ, so the fields are compared.
static bool is_same_material(const FrLightMaterial *a, const FrLightMaterial *b) {
    return memcmp(&a->front, &b->front, sizeof a->front) == 0 &&
           memcmp(&a->back, &b->back, sizeof a->back) == 0 && a->mask == b->mask;
}

static uint32_t find_material(FrSurfaces *surfaces, const FrLightMaterial *wanted) {
    for (guint i = 0; i < surfaces->materials->len; i++) {
        if (is_same_material(&g_array_index(surfaces->materials, FrLightMaterial, i), wanted)) {
            return i;
        }
    }
    g_array_append_vals(surfaces->materials, wanted, 1);
    return surfaces->materials->len - 1;
}

static uint64_t triangles_of(const FrMesh *mesh) {
    uint64_t count = 0;
    for (uint32_t i = 0; i < mesh->part_count; i++) {
        count += mesh->parts[i].index_count / 3;
    }
    return count;
}

static FrDigest digest_of_stand(FrSurfaces *surfaces, const FrLightMesh *mesh, mat4s transform) {
    const FrMesh *of = mesh->mesh;
    FrDigest digest = fr_digest(0, transform.raw, sizeof transform.raw);
    digest = fr_digest(digest, of->vertices, of->vertex_count * sizeof *of->vertices);
    digest = fr_digest(digest, of->indices, of->index_count * sizeof *of->indices);
    for (uint32_t i = 0; i < of->part_count; i++) {
        const FrMeshPart *part = &of->parts[i];
        uint64_t range[4] = {part->first_vertex, part->first_index, part->index_count,
                             find_material(surfaces, &mesh->materials[i])};
        digest = fr_digest(digest, range, sizeof range);
    }
    return digest;
}

static bool has_area(const float corners[9]) {
    float longest = 0.0f;
    double edge[2][3], normal[3];
    for (int c = 0; c < 3; c++) {
        edge[0][c] = (double)corners[3 + c] - (double)corners[c];
        edge[1][c] = (double)corners[6 + c] - (double)corners[c];
    }
    for (int i = 0; i < 9; i++) {
        if (!isfinite(corners[i])) {
            return false;
        }
        longest = fmaxf(longest, fabsf(corners[i]));
    }
    for (int c = 0; c < 3; c++) {
        int d = (c + 1) % 3, e = (c + 2) % 3;
        normal[c] = edge[0][d] * edge[1][e] - edge[0][e] * edge[1][d];
    }
    double square = normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2];
    return longest < 1e15f && square > 1e-60;
}

// The corners of a mirrored mesh turn the other way; its outer side stays the outer side.
static Triangle bake(const FrMesh *mesh, const FrMeshPart *part, uint64_t index, mat4s transform,
                     bool is_mirrored, bool has_mask) {
    Triangle triangle = {0};
    const uint32_t *corner = mesh->indices + part->first_index + 3 * index;
    for (int i = 0; i < 3; i++) {
        int from = is_mirrored && i > 0 ? 3 - i : i;
        const FrVertex *vertex = mesh->vertices + part->first_vertex + corner[from];
        vec3s at = glms_mat4_mulv3(
            transform, (vec3s){{vertex->position[0], vertex->position[1], vertex->position[2]}},
            1.0f);
        memcpy(triangle.corners + 3 * i, at.raw, sizeof at.raw);
        if (has_mask) {
            memcpy(triangle.uv + 2 * i, vertex->uv, sizeof vertex->uv);
        }
    }
    return triangle;
}

static void reserve(FrSurfaces *surfaces, uint64_t more) {
    uint64_t wanted = surfaces->count + more;
    if (wanted > surfaces->capacity) {
        uint32_t capacity = (uint32_t)wanted;
        surfaces->material = g_renew(uint32_t, surfaces->material, capacity);
        surfaces->element = g_renew(uint64_t, surfaces->element, capacity);
        surfaces->uv = g_realloc_n(surfaces->uv, capacity, sizeof *surfaces->uv);
        surfaces->is_seen = g_renew(bool, surfaces->is_seen, capacity);
        surfaces->capacity = capacity;
    }
    fr_key_table_reserve(&surfaces->table, (uint32_t)more);
}

static uint32_t find_triangle(FrSurfaces *surfaces, const Triangle *triangle) {
    // Materials are told by their own digest, not by a number that depends on what came before.
    const FrLightMaterial *material =
        &g_array_index(surfaces->materials, FrLightMaterial, triangle->material);
    FrDigest key = fr_digest(material->mask, &material->front, 2 * sizeof(FrOptics));
    key = fr_digest(key, triangle, offsetof(Triangle, material));
    uint32_t *value = fr_key_table_at(&surfaces->table, key);
    if (*value == FR_NONE || (*value < surfaces->last && !fr_soup_has(surfaces->soup, *value))) {
        *value = surfaces->count++;
        surfaces->material[*value] = triangle->material;
        memcpy(surfaces->uv[*value], triangle->uv, sizeof triangle->uv);
        surfaces->is_seen[*value] = false;
        g_array_append_vals(surfaces->corners, triangle->corners, 9);
        g_array_append_val(surfaces->keys, key);
    }
    return *value;
}

static void bake_stand(FrSurfaces *surfaces, const FrLightMesh *mesh, mat4s transform,
                       Stand *stand) {
    const FrMesh *of = mesh->mesh;
    stand->triangles = g_new(uint32_t, stand->triangle_count);
    reserve(surfaces, stand->triangle_count);
    bool is_mirrored = glms_mat3_det(glms_mat4_pick3(transform)) < 0.0f;
    uint64_t next = 0;
    for (uint32_t i = 0; i < of->part_count; i++) {
        uint32_t material = find_material(surfaces, &mesh->materials[i]);
        for (uint64_t k = 0; k < of->parts[i].index_count / 3; k++) {
            Triangle triangle =
                bake(of, &of->parts[i], k, transform, is_mirrored, mesh->materials[i].mask != 0);
            triangle.material = material;
            stand->triangles[next++] =
                has_area(triangle.corners) ? find_triangle(surfaces, &triangle) : FR_NONE;
        }
    }
}

// Every triangle belongs to its first owner in the order of the scene.
static void own(FrSurfaces *surfaces, const Stand *stand, const FrLightMesh *mesh,
                uint64_t first_element) {
    for (uint64_t i = 0; i < stand->triangle_count; i++) {
        uint32_t triangle = stand->triangles[i];
        if (triangle != FR_NONE && !surfaces->is_seen[triangle]) {
            surfaces->is_seen[triangle] = true;
            surfaces->element[triangle] =
                first_element + (mesh->elements != NULL ? mesh->elements[i] : i);
        }
    }
}

// Where the stands of the scene before are, by their digests.
static FrKeyTable index_of_stands(const GArray *stands) {
    FrKeyTable table = {0};
    fr_key_table_reserve(&table, stands->len);
    for (guint i = 0; i < stands->len; i++) {
        *fr_key_table_at(&table, g_array_index(stands, Stand, i).digest) = i;
    }
    return table;
}

static uint32_t *triangles_before(const GArray *stands, const FrKeyTable *index,
                                  const Stand *wanted) {
    uint32_t at = fr_key_table_find(index, wanted->digest);
    if (at == FR_NONE ||
        g_array_index(stands, Stand, at).triangle_count != wanted->triangle_count) {
        return NULL;
    }
    return g_memdup2(g_array_index(stands, Stand, at).triangles,
                     wanted->triangle_count * sizeof *wanted->triangles);
}

static void set_stands(FrSurfaces *surfaces, const FrLightScene *scene) {
    GArray *before = surfaces->stands;
    FrKeyTable index = index_of_stands(before);
    surfaces->stands = g_array_new(FALSE, FALSE, sizeof(Stand));
    g_array_set_size(surfaces->first_elements, 0);
    uint64_t elements = 0;
    for (uint32_t i = 0; i < scene->stand_count; i++) {
        const FrLightMesh *mesh = &scene->meshes[scene->stands[i].mesh];
        Stand stand = {
            .digest = digest_of_stand(surfaces, mesh, scene->stands[i].transform),
            .triangle_count = triangles_of(mesh->mesh),
        };
        stand.triangles = triangles_before(before, &index, &stand);
        if (stand.triangles == NULL) {
            bake_stand(surfaces, mesh, scene->stands[i].transform, &stand);
        }
        own(surfaces, &stand, mesh, elements);
        g_array_append_val(surfaces->stands, stand);
        g_array_append_val(surfaces->first_elements, elements);
        elements += mesh->elements != NULL ? mesh->element_count : stand.triangle_count;
    }
    g_array_append_val(surfaces->first_elements, elements);
    free_stands(before);
    fr_key_table_clear(&index);
}

FrStatus fr_surfaces_set(FrSurfaces *surfaces, const FrLightScene *scene, FrSpan span,
                         const FrContext *context, uint32_t *added, uint32_t *removed) {
    uint64_t triangles = 0;
    for (uint32_t i = 0; i < scene->stand_count; i++) {
        triangles =
            fr_count_add(triangles, triangles_of(scene->meshes[scene->stands[i].mesh].mesh));
    }
    // Two triangle lists, the tree, the table of keys.
    enum { TRIANGLE_BYTES = 200 };
    FrStatus status =
        fr_limit_check(fr_count_multiply(triangles, TRIANGLE_BYTES), context->limits.bytes, "bytes",
                       "the light", span, context->diags);
    if (status != FR_OK) {
        return status;
    }
    status = fr_limit_check(triangles, MIN(context->limits.triangles, 1u << 30), "triangles",
                            "the light", span, context->diags);
    if (status != FR_OK) {
        return status;
    }
    surfaces->mask = scene->mask;
    surfaces->mask_user = scene->mask_user;
    surfaces->last = surfaces->count;
    surfaces->corners = g_array_new(FALSE, FALSE, sizeof(float));
    surfaces->keys = g_array_new(FALSE, FALSE, sizeof(uint64_t));
    for (uint32_t i = 0; i < surfaces->count; i++) {
        surfaces->is_seen[i] = false;
    }
    set_stands(surfaces, scene);
    *removed = 0;
    for (uint32_t i = 0; i < surfaces->last; i++) {
        if (!surfaces->is_seen[i] && fr_soup_has(surfaces->soup, i)) {
            fr_soup_remove(surfaces->soup, i);
            ++*removed;
        }
    }
    *added = surfaces->count - surfaces->last;
    const float padding[FR_SOUP_PADDING / sizeof(float)] = {0};
    g_array_append_vals(surfaces->corners, padding, G_N_ELEMENTS(padding));
    surfaces->last_corners = (float(*)[9])(void *)g_array_free(surfaces->corners, FALSE);
    uint64_t *keys = (uint64_t *)(void *)g_array_free(surfaces->keys, FALSE);
    if (*added > 0) {
        fr_soup_add(surfaces->soup, surfaces->last_corners, keys, *added);
    } else {
        g_free(surfaces->last_corners);
        g_free(keys);
    }
    return FR_OK;
}

const FrSoup *fr_surfaces_soup(const FrSurfaces *surfaces) {
    return surfaces->soup;
}

const FrOptics *fr_surfaces_optics(const FrSurfaces *surfaces, uint32_t triangle, bool is_back) {
    const FrLightMaterial *material =
        &g_array_index(surfaces->materials, FrLightMaterial, surfaces->material[triangle]);
    return is_back ? &material->back : &material->front;
}

static void extend_box(float box[2][3], const float corners[9]) {
    for (int c = 0; c < 9; c++) {
        box[0][c % 3] = MIN(box[0][c % 3], corners[c]);
        box[1][c % 3] = MAX(box[1][c % 3], corners[c]);
    }
}

uint32_t fr_surfaces_added_boxes(const FrSurfaces *surfaces, float boxes[FR_MOST_BOXES][2][3]) {
    const float empty[2][3] = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    uint32_t count = surfaces->count - surfaces->last;
    float octants[8][2][3];
    memcpy(boxes[0], empty, sizeof empty);
    for (uint32_t i = 0; i < count; i++) {
        extend_box(boxes[0], surfaces->last_corners[i]);
    }
    for (int o = 0; o < 8; o++) {
        memcpy(octants[o], empty, sizeof empty);
    }
    for (uint32_t i = 0; i < count; i++) {
        const float *corners = surfaces->last_corners[i];
        int octant = 0;
        for (int c = 0; c < 3; c++) {
            octant |= corners[c] > 0.5f * (boxes[0][0][c] + boxes[0][1][c]) ? 1 << c : 0;
        }
        extend_box(octants[octant], corners);
    }
    uint32_t used = 1;
    for (int o = 0; o < 8; o++) {
        if (octants[o][0][0] <= octants[o][1][0]) {
            memcpy(boxes[used++], octants[o], sizeof octants[o]);
        }
    }
    return used;
}

uint64_t fr_surfaces_element_count(const FrSurfaces *surfaces) {
    return g_array_index(surfaces->first_elements, uint64_t, surfaces->first_elements->len - 1);
}

uint64_t fr_surfaces_first_element(const FrSurfaces *surfaces, uint32_t stand) {
    return g_array_index(surfaces->first_elements, uint64_t, stand);
}

uint64_t fr_surfaces_element(const FrSurfaces *surfaces, uint32_t triangle) {
    return surfaces->element[triangle];
}

static void renumber(FrSurfaces *surfaces, const uint32_t *remap) {
    for (uint32_t i = 0; i < surfaces->count; i++) {
        uint32_t to = remap[i]; // never above i
        if (to != FR_NONE) {
            surfaces->material[to] = surfaces->material[i];
            surfaces->element[to] = surfaces->element[i];
            memmove(surfaces->uv[to], surfaces->uv[i], sizeof surfaces->uv[i]);
        }
    }
    for (guint s = 0; s < surfaces->stands->len; s++) {
        Stand *stand = &g_array_index(surfaces->stands, Stand, s);
        for (uint64_t i = 0; i < stand->triangle_count; i++) {
            if (stand->triangles[i] != FR_NONE) {
                stand->triangles[i] = remap[stand->triangles[i]];
            }
        }
    }
    FrKeyTable old = surfaces->table;
    surfaces->table = (FrKeyTable){0};
    fr_key_table_reserve(&surfaces->table, fr_soup_count(surfaces->soup));
    for (uint64_t i = 0; i <= old.mask; i++) {
        if (old.slots[i].value != FR_NONE && remap[old.slots[i].value] != FR_NONE) {
            *fr_key_table_at(&surfaces->table, old.slots[i].key) = remap[old.slots[i].value];
        }
    }
    fr_key_table_clear(&old);
}

uint32_t *fr_surfaces_compact(FrSurfaces *surfaces) {
    if (!fr_soup_wants_compaction(surfaces->soup)) {
        return NULL;
    }
    uint32_t *remap = g_new(uint32_t, surfaces->count);
    fr_soup_compact(surfaces->soup, remap);
    renumber(surfaces, remap);
    surfaces->count = fr_soup_count(surfaces->soup);
    surfaces->last = surfaces->count;
    return remap;
}

uint64_t fr_surfaces_bytes(const FrSurfaces *surfaces) {
    uint64_t each = sizeof(uint32_t) + sizeof(uint64_t) + sizeof *surfaces->uv + sizeof(bool) +
                    sizeof(uint32_t);
    return surfaces->capacity * each + fr_soup_bytes(surfaces->soup) +
           ((uint64_t)surfaces->table.mask + 1) * sizeof *surfaces->table.slots;
}
