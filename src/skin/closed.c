// Whether surfaces of triangles are closed: every edge is passed as often one way as the other.
#include "skin/closed.h"

#include <stdlib.h>
#include <string.h>

static size_t hash_of(const float position[3]) {
    uint64_t hash = 0;
    for (int k = 0; k < 3; k++) {
        uint32_t bits;
        float value = position[k] + 0.0F; // the zeros are one
        memcpy(&bits, &value, sizeof bits);
        hash = (hash ^ bits) * UINT64_C(0x9e3779b97f4a7c15);
        hash ^= hash >> 29;
    }
    return (size_t)hash;
}

static bool is_same(const float a[3], const float b[3]) {
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

/// By vertex: the first at its place.
static uint32_t *weld(const FrMesh *mesh) {
    size_t mask = 1;
    while (mask < 2 * mesh->vertex_count) {
        mask *= 2;
    }
    uint32_t *slots = g_new0(uint32_t, mask); // of a hash table: vertex + 1
    uint32_t *first = g_new(uint32_t, mesh->vertex_count + 1);
    mask--;
    for (uint32_t v = 0; v < mesh->vertex_count; v++) {
        const float *at = mesh->vertices[v].position;
        size_t slot = hash_of(at) & mask;
        while (slots[slot] != 0 && !is_same(mesh->vertices[slots[slot] - 1].position, at)) {
            slot = (slot + 1) & mask;
        }
        slots[slot] = slots[slot] == 0 ? v + 1 : slots[slot];
        first[v] = slots[slot] - 1;
    }
    g_free(slots);
    return first;
}

uint32_t *fr_mesh_places(const FrMesh *mesh) {
    uint32_t *first = weld(mesh), *places = g_new(uint32_t, mesh->index_count + 1);
    for (uint32_t p = 0; p < mesh->part_count; p++) {
        const FrMeshPart *part = &mesh->parts[p];
        for (uint64_t i = part->first_index; i < part->first_index + part->index_count; i++) {
            places[i] = first[part->first_vertex + mesh->indices[i]];
        }
    }
    g_free(first);
    return places;
}

/// An edge of a triangle, its lower end first.
typedef struct FrEdge {
    uint32_t low, high;
    bool is_turned;
} FrEdge;

static int compare_edges(const void *a, const void *b) {
    const FrEdge *p = a, *q = b;
    int first = (p->low > q->low) - (p->low < q->low);
    return first != 0 ? first : (p->high > q->high) - (p->high < q->high);
}

static uint32_t root_of(uint32_t *parents, uint32_t v) {
    while (parents[v] != v) {
        parents[v] = parents[parents[v]];
        v = parents[v];
    }
    return v;
}

static FrEdge *edges_of(const uint32_t *places, uint64_t count) {
    FrEdge *edges = g_new(FrEdge, count + 1);
    for (uint64_t i = 0; i < count; i++) {
        uint32_t a = places[i], b = places[i % 3 == 2 ? i - 2 : i + 1];
        edges[i] = (FrEdge){MIN(a, b), MAX(a, b), a > b};
    }
    if (count > 0) {
        qsort(edges, count, sizeof *edges, compare_edges);
    }
    return edges;
}

uint64_t fr_mesh_open_edges(const FrMesh *mesh, bool *is_closed) {
    uint32_t *places = fr_mesh_places(mesh);
    FrEdge *edges = edges_of(places, mesh->index_count);
    uint32_t *parents = g_new(uint32_t, mesh->vertex_count + 1); // of connected places
    for (uint32_t v = 0; v < mesh->vertex_count; v++) {
        parents[v] = v;
    }
    for (uint64_t i = 0; i < mesh->index_count; i++) {
        uint32_t a = root_of(parents, places[i]), b = root_of(parents, places[i - i % 3]);
        parents[MAX(a, b)] = MIN(a, b);
    }
    bool *is_open = g_new0(bool, mesh->vertex_count + 1);
    uint64_t open = 0;
    for (uint64_t i = 0, end; i < mesh->index_count; i = end) {
        int64_t balance = 0;
        for (end = i; end < mesh->index_count && compare_edges(&edges[i], &edges[end]) == 0;
             end++) {
            balance += edges[end].is_turned ? 1 : -1;
        }
        if (balance != 0 && edges[i].low != edges[i].high) {
            open++;
            is_open[root_of(parents, edges[i].low)] = true;
        }
    }
    for (uint64_t i = 0; is_closed != NULL && i + 2 < mesh->index_count; i += 3) {
        is_closed[i / 3] = !is_open[root_of(parents, places[i])];
    }
    g_free(is_open);
    g_free(edges);
    g_free(places);
    g_free(parents);
    return open;
}
