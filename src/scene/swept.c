/// A section drawn along a line. It stands on the line and keeps its sides upright; corners are
/// mitred.
#include "scene/swept.h"

#include <cglm/struct.h>
#include <math.h>
#include <string.h>

enum {
    ROUND_SIDES = 32,
    PIECES_A_WIDTH = 4, // of a smooth line
};
#define LONGEST_MITRE 3.0F

/// Stations of the line: places, with the directions that the section lies across.
typedef struct Line {
    vec3s *at, *side, *up; ///< side is as long as its mitre makes it
    float *along;          ///< m from the first
    uint32_t count;
} Line;

/// Points of the section, x aside and y up, and their normals; a corner has two points.
typedef struct Section {
    vec2s at[ROUND_SIDES + 1], normal[ROUND_SIDES + 1];
    float around[ROUND_SIDES + 1]; ///< m
    uint32_t count;
    bool is_smooth; ///< points follow each other; else every two are a side
} Section;

static Section make_section(const FrObstacle *obstacle) {
    float width = obstacle->size.x, height = obstacle->size.z;
    Section section = {.is_smooth = obstacle->section == FR_SECTION_ROUND};
    if (section.is_smooth) {
        section.count = ROUND_SIDES + 1;
        for (uint32_t i = 0; i < section.count; i++) {
            float angle = 2 * (float)G_PI * (float)(i % ROUND_SIDES) / ROUND_SIDES;
            float x = sinf(angle), y = -cosf(angle);
            section.at[i] = (vec2s){{0.5F * width * x, 0.5F * height * (1 + y)}};
            section.normal[i] = glms_vec2_normalize((vec2s){{x / width, y / height}});
        }
    } else {
        const vec2s corners[5] = {{{-0.5F * width, 0}},
                                  {{0.5F * width, 0}},
                                  {{0.5F * width, height}},
                                  {{-0.5F * width, height}},
                                  {{-0.5F * width, 0}}};
        section.count = 8;
        for (uint32_t i = 0; i < 8; i++) {
            section.at[i] = corners[(i + 1) / 2];
            static const vec2s normals[] = {{{0, -1}}, {{1, 0}}, {{0, 1}}, {{-1, 0}}};
            section.normal[i] = normals[i / 2];
        }
    }
    for (uint32_t i = 1; i < section.count; i++) {
        section.around[i] =
            section.around[i - 1] + glms_vec2_distance(section.at[i - 1], section.at[i]);
    }
    return section;
}

// ---- the line ---------------------------------------------------------------------------------

static uint64_t count_smooth(const FrPath *path, const FrObstacle *obstacle) {
    double piece = (double)obstacle->size.x / PIECES_A_WIDTH;
    return (uint64_t)fmin(ceil(fr_path_length(path) / piece) + 1, 1e18);
}

static void place_stations(Line *line, const FrStroke *stroke, const FrPath *path) {
    size_t count;
    const FrStrokePoint *points = fr_stroke_points(stroke, &count);
    if (path != NULL) {
        for (uint32_t i = 0; i < line->count; i++) {
            double part = (double)i / (double)MAX(line->count - 1, 1);
            vec3s tangent;
            fr_path_at(path, part * fr_path_length(path), &line->at[i], &tangent);
        }
        return;
    }
    line->count = 0;
    for (size_t i = 0; i < count; i++) {
        bool is_new = i == 0 || memcmp(&points[i].at, &line->at[line->count - 1], sizeof(vec3s));
        if (is_new) {
            line->at[line->count++] = points[i].at;
        }
    }
}

/// The level direction to the right of one who goes along `direction`.
static vec3s right_of(vec3s direction, vec3s last) {
    vec3s right = {{direction.y, -direction.x, 0}};
    float size = glms_vec3_norm(right);
    return size > 1e-6F ? glms_vec3_scale(right, 1 / size) : last;
}

static void turn_stations(Line *line) {
    vec3s last = {{0, -1, 0}};
    for (uint32_t i = 0; i < line->count; i++) {
        uint32_t before = i == 0 ? 0 : i - 1, after = MIN(i + 1, line->count - 1);
        vec3s in = glms_vec3_normalize(glms_vec3_sub(line->at[i], line->at[before]));
        vec3s out = glms_vec3_normalize(glms_vec3_sub(line->at[after], line->at[i]));
        in = i == 0 ? out : in;
        out = after == i ? in : out;
        vec3s between = glms_vec3_normalize(glms_vec3_add(in, out));
        vec3s right = right_of(glms_vec3_norm(between) > 0 ? between : in, last);
        last = right;
        // A mitre is wider by the cosine of half the turn.
        float half = glms_vec3_dot(right, right_of(in, right));
        line->side[i] = glms_vec3_scale(right, fminf(1 / fmaxf(half, 1e-3F), LONGEST_MITRE));
        line->up[i] = glms_vec3_normalize(glms_vec3_cross(right, between));
        line->along[i] =
            i == 0 ? 0 : line->along[i - 1] + glms_vec3_distance(line->at[i], line->at[before]);
    }
}

// ---- the surface ------------------------------------------------------------------------------

typedef struct Surface {
    vec3s *positions, *normals;
    float (*uvs)[2];
    uint32_t *indices;
    uint32_t vertices, index_count;
} Surface;

static vec3s place(const Line *line, uint32_t i, vec2s at) {
    vec3s aside = glms_vec3_scale(line->side[i], at.x);
    return glms_vec3_add(line->at[i], glms_vec3_add(aside, glms_vec3_scale(line->up[i], at.y)));
}

static void add_triangle(Surface *surface, uint32_t a, uint32_t b, uint32_t c) {
    uint32_t *index = &surface->indices[surface->index_count];
    index[0] = a;
    index[1] = b;
    index[2] = c;
    surface->index_count += 3;
}

static void add_mantle(Surface *surface, const Line *line, const Section *section, float width) {
    for (uint32_t i = 0; i < line->count; i++) {
        vec3s side = glms_vec3_normalize(line->side[i]);
        for (uint32_t k = 0; k < section->count; k++) {
            uint32_t v = surface->vertices++;
            surface->positions[v] = place(line, i, section->at[k]);
            surface->normals[v] = glms_vec3_add(glms_vec3_scale(side, section->normal[k].x),
                                                glms_vec3_scale(line->up[i], section->normal[k].y));
            surface->uvs[v][0] = section->around[k] / width;
            surface->uvs[v][1] = line->along[i] / width;
        }
    }
    uint32_t step = section->is_smooth ? 1 : 2;
    for (uint32_t i = 0; i + 1 < line->count; i++) {
        for (uint32_t k = 0; k + 1 < section->count; k += step) {
            uint32_t a = i * section->count + k, b = a + section->count;
            add_triangle(surface, a, b + 1, a + 1);
            add_triangle(surface, a, b, b + 1);
        }
    }
}

/// Closes the line's beginning or end.
static void add_lid(Surface *surface, const Line *line, const Section *section, bool is_end) {
    uint32_t i = is_end ? line->count - 1 : 0, first = surface->vertices;
    uint32_t step = section->is_smooth ? 1 : 2;
    uint32_t corners = section->is_smooth ? section->count - 1 : section->count / 2;
    vec3s out = glms_vec3_cross(line->up[i], glms_vec3_normalize(line->side[i]));
    for (uint32_t k = 0; k < corners; k++) {
        uint32_t v = surface->vertices++;
        vec2s at = section->at[k * step];
        surface->positions[v] = place(line, i, at);
        surface->normals[v] = is_end ? out : glms_vec3_negate(out);
        surface->uvs[v][0] = at.x;
        surface->uvs[v][1] = at.y;
    }
    for (uint32_t k = 1; k + 1 < corners; k++) {
        add_triangle(surface, first, first + (is_end ? k + 1 : k), first + (is_end ? k : k + 1));
    }
}

static FrMeshFile *make_mesh(const Line *line, const FrObstacle *obstacle) {
    Section section = make_section(obstacle);
    size_t vertices = ((size_t)line->count + 2) * section.count;
    Surface surface = {.positions = g_new(vec3s, vertices),
                       .normals = g_new(vec3s, vertices),
                       .uvs = g_malloc_n(vertices, sizeof *surface.uvs),
                       .indices = g_new(uint32_t, 6 * vertices)};
    add_mantle(&surface, line, &section, obstacle->size.x);
    add_lid(&surface, line, &section, false);
    add_lid(&surface, line, &section, true);
    return fr_mesh_file_new(surface.positions, surface.normals, surface.uvs, surface.vertices,
                            surface.indices, surface.index_count, NULL);
}

FrStatus fr_swept_mesh(const FrObstacle *obstacle, const FrContext *context, FrMeshFile **mesh) {
    size_t count;
    const FrStrokePoint *points = fr_stroke_points(obstacle->along, &count);
    FrPath *path = NULL;
    uint64_t stations = count;
    if (obstacle->line == FR_LINE_SMOOTH) {
        vec3s *at = g_new(vec3s, count);
        for (size_t i = 0; i < count; i++) {
            at[i] = points[i].at;
        }
        path = fr_path_new(at, count);
        g_free(at);
        stations = path != NULL ? count_smooth(path, obstacle) : count;
    }
    // Its vertices are numbered with 32 bits.
    uint64_t most = MIN(context->limits.triangles, (uint64_t)1 << 28);
    FrStatus status = fr_limit_check(fr_count_multiply(stations, 2 * ROUND_SIDES), most,
                                     "triangles", "a sweep", obstacle->span, context->diags);
    *mesh = NULL;
    if (status == FR_OK) {
        Line line = {.at = g_new(vec3s, stations),
                     .side = g_new(vec3s, stations),
                     .up = g_new(vec3s, stations),
                     .along = g_new(float, stations),
                     .count = (uint32_t)stations};
        place_stations(&line, obstacle->along, path);
        turn_stations(&line);
        *mesh = make_mesh(&line, obstacle);
        g_free(line.at);
        g_free(line.side);
        g_free(line.up);
        g_free(line.along);
    }
    fr_path_unref(path);
    return status;
}
