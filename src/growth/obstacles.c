#include "growth/obstacles.h"

FrStatus fr_obstacles_join(const FrGrowthObstacle *obstacles, uint32_t count,
                           FrObstacleIs is_wanted, const char *what, const FrContext *context,
                           FrDistance **joined) {
    *joined = NULL;
    uint64_t vertices = 0, corners = 0;
    for (uint32_t i = 0; i < count; i++) {
        vertices += is_wanted(&obstacles[i]) ? obstacles[i].vertex_count : 0;
        corners += is_wanted(&obstacles[i]) ? obstacles[i].index_count : 0;
    }
    bool is_countable = vertices <= UINT32_MAX && corners <= UINT32_MAX;
    FrStatus status =
        fr_limit_check(is_countable ? fr_distance_bytes(corners / 3) : UINT64_MAX,
                       context->limits.bytes, "bytes", what, (FrSpan){0}, context->diags);
    if (status != FR_OK || corners == 0) {
        return status;
    }
    vec3s *positions = g_new(vec3s, vertices);
    uint32_t *indices = g_new(uint32_t, corners);
    uint32_t vertex = 0, corner = 0;
    for (uint32_t i = 0; i < count; i++) {
        const FrGrowthObstacle *obstacle = &obstacles[i];
        if (!is_wanted(obstacle)) {
            continue;
        }
        for (uint32_t k = 0; k < obstacle->index_count; k++) {
            indices[corner++] = vertex + obstacle->indices[k];
        }
        for (uint32_t k = 0; k < obstacle->vertex_count; k++) {
            positions[vertex++] = obstacle->positions[k];
        }
    }
    *joined = fr_distance_new(positions, vertex, indices, corner);
    g_free(positions);
    g_free(indices);
    return FR_OK;
}
