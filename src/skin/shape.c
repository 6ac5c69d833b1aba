// The small meshes of organ shapes.
#include "skin/shape.h"

#include "skin/margin.h"

#include <string.h>

uint32_t fr_shape_vertex(FrShapeMesh *mesh, vec3s position, vec3s normal, float u, float v) {
    if (mesh->vertex_count == mesh->vertex_room) {
        mesh->vertex_room = MAX(64, 2 * mesh->vertex_room);
        mesh->vertices = g_renew(FrVertex, mesh->vertices, mesh->vertex_room);
    }
    FrVertex *vertex = &mesh->vertices[mesh->vertex_count];
    memcpy(vertex->position, position.raw, sizeof position.raw);
    memcpy(vertex->normal, normal.raw, sizeof normal.raw);
    vertex->uv[0] = u;
    vertex->uv[1] = v;
    return mesh->vertex_count++;
}

void fr_shape_triangle(FrShapeMesh *mesh, uint32_t a, uint32_t b, uint32_t c) {
    if (a == b || b == c || c == a) {
        return;
    }
    if (mesh->index_count + 3 > mesh->index_room) {
        mesh->index_room = MAX(192, 2 * mesh->index_room);
        mesh->indices = g_renew(uint32_t, mesh->indices, mesh->index_room);
    }
    mesh->indices[mesh->index_count++] = a;
    mesh->indices[mesh->index_count++] = b;
    mesh->indices[mesh->index_count++] = c;
}

uint32_t fr_shape_segments(uint32_t wanted, uint32_t least, uint32_t most, const FrDetail *detail) {
    double count = MIN(wanted, UINT16_MAX);
    for (int i = 0; i < detail->lod; i++) {
        count *= 0.7;
    }
    return CLAMP((uint32_t)(count + 0.5), least, most);
}

uint64_t fr_shape_bytes_most(const FrPlant *plant, const FrShape *shape, const FrDetail *detail) {
    // A primitive has at most a grid of 128 × 64 quads and two discs.
    uint64_t vertices = 129 * 65 + 2 * 128;
    if (shape->kind == FR_SHAPE_BLADE) {
        uint32_t along, across;
        fr_blade_segments(&shape->blade, detail, &along, &across);
        vertices =
            (uint64_t)(along + 1) * (2 * across + 1) + 12 + fr_margin_vertices_most(&shape->blade);
        vertices = fr_count_multiply(vertices + 64, fr_compound_leaflets(&shape->blade));
    }
    if (shape->kind == FR_SHAPE_FILE) {
        vertices = fr_shape_file_vertices(plant, shape);
    }
    // Two triangles a vertex; arrays grow by doubling.
    return 2 * vertices * (sizeof(FrVertex) + 6 * sizeof(uint32_t));
}

void fr_shape_mesh_init(FrShapeMesh *mesh, const FrPlant *plant, uint32_t shape,
                        const FrDetail *detail) {
    *mesh = (FrShapeMesh){0};
    const FrShape *form = &g_array_index(plant->shapes, FrShape, shape);
    if (form->kind == FR_SHAPE_BLADE) {
        fr_shape_blade(mesh, plant, &form->blade, detail);
    } else if (form->kind == FR_SHAPE_REVOLUTION) {
        fr_shape_revolution(mesh, plant, form, detail);
    } else if (form->kind == FR_SHAPE_MESH) {
        fr_shape_triangles(mesh, plant, form);
    } else if (form->kind == FR_SHAPE_FILE) {
        fr_shape_file(mesh, plant, form, detail);
    } else {
        fr_shape_primitive(mesh, form, detail);
    }
}

void fr_shape_mesh_clear(FrShapeMesh *mesh) {
    g_clear_pointer(&mesh->vertices, g_free);
    g_clear_pointer(&mesh->indices, g_free);
}
