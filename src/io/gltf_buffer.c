// The buffer of a glTF asset and what describes it: views, accessors, meshes.
#include "io/gltf.h"

#include "io/tangents.h"

int fr_gltf_add_view(FrGltf *gltf, const void *data, uint64_t size, int stride, int target) {
    static const char zeros[4];
    FrChunk chunk = {data, (size_t)size};
    g_array_append_val(gltf->chunks, chunk);
    json_t *view = json_pack("{s:i, s:I, s:I}", "buffer", 0, "byteOffset", (json_int_t)gltf->size,
                             "byteLength", (json_int_t)size);
    if (stride != 0) {
        json_object_set_new(view, "byteStride", json_integer(stride));
    }
    if (target != 0) {
        json_object_set_new(view, "target", json_integer(target));
    }
    json_array_append_new(gltf->views, view);
    gltf->size += size;
    if (size % 4 != 0) {
        FrChunk padding = {zeros, (size_t)(4 - size % 4)};
        g_array_append_val(gltf->chunks, padding);
        gltf->size += padding.size;
    }
    return (int)json_array_size(gltf->views) - 1;
}

int fr_gltf_add_accessor(FrGltf *gltf, int view, uint64_t offset, int component_type,
                         uint64_t count, const char *type) {
    json_t *accessor = json_pack("{s:i, s:i, s:I, s:s}", "bufferView", view, "componentType",
                                 component_type, "count", (json_int_t)count, "type", type);
    if (offset != 0) {
        json_object_set_new(accessor, "byteOffset", json_integer((json_int_t)offset));
    }
    json_array_append_new(gltf->accessors, accessor);
    return (int)json_array_size(gltf->accessors) - 1;
}

json_t *fr_gltf_name(const char *name) {
    char *valid = g_utf8_make_valid(name, -1);
    json_t *string = json_string(valid);
    g_free(valid);
    return string;
}

static json_t *triple(const float value[3]) {
    return json_pack("[f, f, f]", (double)value[0], (double)value[1], (double)value[2]);
}

uint32_t fr_gltf_add_arrays(FrGltf *gltf, const FrMesh *mesh, FrGltfPart *parts) {
    if (mesh->index_count == 0) {
        return 0;
    }
    int vertices = fr_gltf_add_view(gltf, mesh->vertices, mesh->vertex_count * sizeof(FrVertex),
                                    sizeof(FrVertex), FR_GLTF_VERTICES);
    int indices = fr_gltf_add_view(gltf, mesh->indices, mesh->index_count * sizeof(uint32_t), 0,
                                   FR_GLTF_INDICES);
    gltf->vertices += mesh->vertex_count;
    uint32_t count = 0;
    for (uint32_t p = 0; p < mesh->part_count; p++) {
        const FrMeshPart *part = &mesh->parts[p];
        if (part->index_count == 0) {
            continue;
        }
        uint64_t at = part->first_vertex * sizeof(FrVertex);
        uint64_t n = part->vertex_count;
        FrGltfPart *made = &parts[count++];
        made->material = part->material;
        made->is_foliage = part->is_foliage;
        made->mesh = mesh;
        made->part = part;
        made->tangent = -1;
        made->position = fr_gltf_add_accessor(gltf, vertices, at, FR_GLTF_FLOAT, n, "VEC3");
        json_t *position = json_array_get(gltf->accessors, (size_t)made->position);
        json_object_set_new(position, "min", triple(part->min));
        json_object_set_new(position, "max", triple(part->max));
        made->normal = fr_gltf_add_accessor(gltf, vertices, at + offsetof(FrVertex, normal),
                                            FR_GLTF_FLOAT, n, "VEC3");
        made->uv = fr_gltf_add_accessor(gltf, vertices, at + offsetof(FrVertex, uv), FR_GLTF_FLOAT,
                                        n, "VEC2");
        made->indices = fr_gltf_add_accessor(gltf, indices, part->first_index * sizeof(uint32_t),
                                             FR_GLTF_UINT, part->index_count, "SCALAR");
    }
    return count;
}

/// Without tangents each reader would make its own for a normal map, each in its own way.
static void add_tangents(FrGltf *gltf, FrGltfPart *part) {
    if (part->tangent < 0) {
        uint64_t count = part->part->vertex_count;
        float(*tangents)[4] = fr_tangents_new(part->mesh, part->part, gltf->context);
        g_ptr_array_add(gltf->kept, tangents);
        int view = fr_gltf_add_view(gltf, tangents, count * sizeof *tangents, sizeof *tangents,
                                    FR_GLTF_VERTICES);
        part->tangent = fr_gltf_add_accessor(gltf, view, 0, FR_GLTF_FLOAT, count, "VEC4");
    }
}

static json_t *primitive_of(const FrGltfPart *part, uint32_t surface, bool has_tangents) {
    json_t *attributes = json_pack("{s:i, s:i, s:i}", "POSITION", part->position, "NORMAL",
                                   part->normal, "TEXCOORD_0", part->uv);
    if (has_tangents) {
        json_object_set_new(attributes, "TANGENT", json_integer(part->tangent));
    }
    return json_pack("{s:o, s:i, s:I}", "attributes", attributes, "indices", part->indices,
                     "material", (json_int_t)surface);
}

FrStatus fr_gltf_add_mesh(FrGltf *gltf, const char *name, const FrPlant *plant, FrGltfPart *parts,
                          uint32_t count, int *mesh) {
    *mesh = -1;
    if (count == 0) {
        return FR_OK;
    }
    json_t *primitives = json_array();
    for (uint32_t p = 0; p < count; p++) {
        uint32_t surface;
        FrStatus status = fr_surfaces_find(&gltf->surfaces, plant, parts[p].material,
                                           parts[p].is_foliage, gltf->context, &surface);
        if (status != FR_OK) {
            json_decref(primitives);
            return status;
        }
        bool has_tangents =
            fr_surfaces_get(&gltf->surfaces, surface)->picture[FR_MAP_NORMAL] != FR_NONE;
        if (has_tangents) {
            add_tangents(gltf, &parts[p]);
        }
        json_array_append_new(primitives, primitive_of(&parts[p], surface, has_tangents));
    }
    json_array_append_new(gltf->meshes, json_pack("{s:o, s:o}", "name", fr_gltf_name(name),
                                                  "primitives", primitives));
    *mesh = (int)json_array_size(gltf->meshes) - 1;
    return FR_OK;
}
