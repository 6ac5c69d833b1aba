// Files of triangles: everything about them but assimp (mesh_file_assimp.c).
#include "material/mesh_file.h"
#include "material/nurbs_file.h"

#include <cglm/struct.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

/// Farther than this from the origin nothing of a plant stands, in metres.
#define FARTHEST 1e6f

static const char *const suffixes[] = {".obj", ".stl", ".gltf", ".glb", ".igs", ".iges"};

static bool has_suffix(const char *name) {
    const char *dot = strrchr(name, '.');
    for (size_t k = 0; dot != NULL && k < G_N_ELEMENTS(suffixes); k++) {
        if (g_ascii_strcasecmp(dot, suffixes[k]) == 0) {
            return true;
        }
    }
    return false;
}

bool fr_mesh_path_is_inside(const char *name) {
    if (name[0] == '\0' || g_path_is_absolute(name)) {
        return false;
    }
    char **parts = g_strsplit_set(name, "/\\", -1);
    bool is_inside = true;
    for (char **part = parts; *part != NULL; part++) {
        is_inside &= strcmp(*part, "..") != 0;
    }
    g_strfreev(parts);
    return is_inside;
}

bool fr_mesh_name_check(const char *name, FrSpan span, FrDiags *diags) {
    if (name == NULL || !fr_mesh_path_is_inside(name)) {
        fr_diags_add(diags, FR_ERROR, "wrong-path", span,
                     "'%.80s' is no path of a file below the document's folder",
                     name != NULL ? name : "");
        return false;
    }
    if (!has_suffix(name)) {
        fr_diags_add(diags, FR_ERROR, "unknown-format", span,
                     "'%.80s' is no file of triangles: .obj, .stl, .gltf, .glb or .igs", name);
        return false;
    }
    return true;
}

// ---- what follows from the triangles ------------------------------------------------------------

static bool is_sound(vec3s v) {
    return fabsf(v.x) <= FARTHEST && fabsf(v.y) <= FARTHEST && fabsf(v.z) <= FARTHEST;
}

// Leaves out triangles with corners that are no places, and parts that are left without any.
static void drop_unsound(FrMeshFile *file) {
    uint32_t kept = 0, parts = 0;
    for (uint32_t p = 0; p < file->part_count; p++) {
        FrMeshFilePart part = file->parts[p];
        uint32_t first = kept;
        for (uint32_t i = part.first_index; i < part.first_index + part.index_count; i += 3) {
            const uint32_t *corner = &file->indices[i];
            bool is_kept = true;
            for (int k = 0; k < 3; k++) {
                is_kept &= corner[k] < file->vertex_count && is_sound(file->positions[corner[k]]);
            }
            memmove(&file->indices[kept], corner, 3 * sizeof *corner);
            kept += is_kept ? 3 : 0;
        }
        part.first_index = first;
        part.index_count = kept - first;
        if (part.index_count > 0) {
            file->parts[parts++] = part;
        } else {
            fr_material_unref(part.material);
        }
        if (p == 0 && part.index_count == 0) {
            g_clear_pointer(&file->surfaces, g_array_unref);
        }
    }
    file->part_count = parts;
    file->index_count = kept;
}

static void mend_normals(FrMeshFile *file) {
    for (uint32_t k = 0; k < file->vertex_count; k++) {
        vec3s *n = &file->normals[k];
        float size = sqrtf(n->x * n->x + n->y * n->y + n->z * n->z);
        bool is_fine = size > 1e-6f && size < FARTHEST;
        *n = is_fine ? (vec3s){{n->x / size, n->y / size, n->z / size}} : (vec3s){{0, 0, 1}};
        for (int c = 0; c < 2; c++) {
            file->uvs[k][c] = fabsf(file->uvs[k][c]) <= FARTHEST ? file->uvs[k][c] : 0;
        }
    }
}

static void bound(FrMeshFile *file) {
    file->min = (vec3s){{INFINITY, INFINITY, INFINITY}};
    file->max = (vec3s){{-INFINITY, -INFINITY, -INFINITY}};
    for (uint32_t i = 0; i < file->index_count; i++) {
        for (int r = 0; r < 3; r++) {
            float at = file->positions[file->indices[i]].raw[r];
            file->min.raw[r] = fminf(file->min.raw[r], at);
            file->max.raw[r] = fmaxf(file->max.raw[r], at);
        }
    }
}

typedef struct Edge {
    vec3s a, b; // the lesser place first
} Edge;

static int compare_places(const vec3s *a, const vec3s *b) {
    for (int r = 0; r < 3; r++) {
        if (a->raw[r] != b->raw[r]) {
            return a->raw[r] < b->raw[r] ? -1 : 1;
        }
    }
    return 0;
}

static int compare_edges(const void *a, const void *b) {
    const Edge *p = a, *q = b;
    int first = compare_places(&p->a, &q->a);
    return first != 0 ? first : compare_places(&p->b, &q->b);
}

static bool is_closed(const FrMeshFile *file) {
    Edge *edges = g_new(Edge, MAX(file->index_count, 1));
    for (uint32_t i = 0; i < file->index_count; i++) {
        vec3s a = file->positions[file->indices[i]];
        vec3s b = file->positions[file->indices[i % 3 == 2 ? i - 2 : i + 1]];
        edges[i] = compare_places(&a, &b) < 0 ? (Edge){a, b} : (Edge){b, a};
    }
    qsort(edges, file->index_count, sizeof *edges, compare_edges);
    bool is_whole = true;
    for (uint32_t first = 0, end; first < file->index_count && is_whole; first = end) {
        for (end = first; end < file->index_count && compare_edges(&edges[end], &edges[first]) == 0;
             end++) {
        }
        is_whole = (end - first) % 2 == 0;
    }
    g_free(edges);
    return is_whole;
}

static FrDigest digest_of(const FrMeshFile *file) {
    size_t vertices = file->vertex_count;
    FrDigest digest = fr_digest(0, file->positions, vertices * sizeof *file->positions);
    digest = fr_digest(digest, file->normals, vertices * sizeof *file->normals);
    digest = fr_digest(digest, file->uvs, vertices * sizeof *file->uvs);
    digest = fr_digest(digest, file->indices, file->index_count * sizeof *file->indices);
    for (uint32_t p = 0; p < file->part_count; p++) {
        digest = fr_digest(digest, &file->parts[p].index_count, sizeof(uint32_t));
    }
    return digest;
}

// What is known of triangles once they are there.
static void settle(FrMeshFile *file) {
    mend_normals(file);
    bound(file);
    file->is_closed = is_closed(file);
    file->digest = digest_of(file);
}

// ---- made ---------------------------------------------------------------------------------------

static vec3s *smooth_normals(const FrMeshFile *file) {
    vec3s *normals = g_new0(vec3s, MAX(file->vertex_count, 1));
    for (uint32_t i = 0; i < file->index_count; i += 3) {
        const uint32_t *corner = &file->indices[i];
        vec3s a = file->positions[corner[0]];
        vec3s normal = glms_vec3_cross(glms_vec3_sub(file->positions[corner[1]], a),
                                       glms_vec3_sub(file->positions[corner[2]], a));
        for (int k = 0; k < 3; k++) {
            normals[corner[k]] = glms_vec3_add(normals[corner[k]], normal);
        }
    }
    for (uint32_t i = 0; i < file->vertex_count; i++) {
        normals[i] = glms_vec3_normalize(normals[i]);
    }
    return normals;
}

FrMeshFile *fr_mesh_file_new(vec3s *positions, vec3s *normals, float (*uvs)[2],
                             uint32_t vertex_count, uint32_t *indices, uint32_t index_count,
                             FrMaterial *material) {
    FrMeshFile *file = g_new0(FrMeshFile, 1);
    g_atomic_ref_count_init(&file->references);
    file->positions = positions;
    file->uvs = uvs;
    file->indices = indices;
    file->vertex_count = vertex_count;
    file->index_count = index_count;
    file->normals = normals != NULL ? normals : smooth_normals(file);
    file->parts = g_new0(FrMeshFilePart, 1);
    file->parts[0] =
        (FrMeshFilePart){.index_count = index_count,
                         .material = material != NULL ? fr_material_ref(material) : NULL};
    file->part_count = 1;
    settle(file);
    return file;
}

// ---- text of .obj -------------------------------------------------------------------------------

// What assimp reads as 0 is told here: a place of a vertex that is no number.
static bool is_vertex_sound(const char *line, const char *end) {
    for (int k = 0; k < 3; k++) {
        char *rest;
        double value = g_ascii_strtod(line, &rest);
        if (rest == line || rest > end || !isfinite(value)) {
            return false;
        }
        line = rest;
    }
    return true;
}

/// True if a file is no .obj, or one whose numbers are right and that has what can be read.
static bool check_obj(const char *path, const char *name, FrSpan span, FrDiags *diags) {
    gchar *text;
    gsize size;
    const char *dot = strrchr(name, '.');
    if (dot == NULL || g_ascii_strcasecmp(dot, ".obj") != 0 ||
        !g_file_get_contents(path, &text, &size, NULL)) {
        return true; // reading it will tell
    }
    bool is_sound = true;
    unsigned number = 1;
    const char *end = text + size;
    for (const char *line = text; line < end && is_sound; number++) {
        const char *stop = line + fr_line_length(line, (size_t)(end - line));
        bool is_vertex = line[0] == 'v' && (line[1] == ' ' || line[1] == '\t');
        if (is_vertex && !is_vertex_sound(line + 1, stop)) {
            fr_diags_add(diags, FR_ERROR, "wrong-mesh", span,
                         "'%s' has a vertex in line %u whose place is not three numbers", name,
                         number);
            is_sound = false;
        }
        line = stop + fr_line_end(stop, (size_t)(end - stop));
    }
    if (is_sound && !fr_obj_has_faces(text, size) && !fr_obj_has_surfaces(text, size)) {
        fr_diags_add(diags, FR_ERROR, "empty-mesh", span,
                     "'%s' has no faces ('f') and no surfaces ('surf')", name);
        is_sound = false;
    }
    g_free(text);
    return is_sound;
}

// ---- files --------------------------------------------------------------------------------------

FrMeshFile *fr_mesh_file_load(const char *folder, const char *name, FrSpan span,
                              const FrContext *context, FrStatus *status) {
    if (!fr_mesh_name_check(name, span, context->diags)) {
        *status = FR_ERR_DOCUMENT;
        return NULL;
    }
    char *path = g_build_filename(folder != NULL ? folder : ".", name, NULL);
    struct stat stat_of;
    FrMeshFile *file = NULL;
    bool is_there = stat(path, &stat_of) == 0;
    if (!is_there || !S_ISREG(stat_of.st_mode)) {
        fr_diags_add(context->diags, FR_ERROR, "missing-file", span,
                     is_there ? "'%s' is not a file" : "there is no file '%s'", path);
        *status = FR_ERR_DOCUMENT;
    } else {
        *status = fr_limit_check((uint64_t)stat_of.st_size, context->limits.document_bytes,
                                 "document-bytes", name, span, context->diags);
        if (*status == FR_OK && !check_obj(path, name, span, context->diags)) {
            *status = FR_ERR_DOCUMENT;
        }
        bool has_surfaces = *status == FR_OK && fr_nurbs_file_is(path);
        file = *status != FR_OK ? NULL
               : has_surfaces   ? fr_nurbs_file_import(path, name, span, context, status)
                                : fr_mesh_file_import(path, name, NULL, span, context, status);
    }
    g_free(path);
    if (file == NULL) {
        return NULL;
    }
    drop_unsound(file);
    if (file->index_count == 0) {
        fr_diags_add(context->diags, FR_ERROR, "empty-mesh", span, "'%s' has no triangles", name);
        *status = FR_ERR_DOCUMENT;
        fr_mesh_file_unref(file);
        return NULL;
    }
    settle(file);
    return file;
}

FrMeshFile *fr_mesh_file_ref(FrMeshFile *file) {
    g_atomic_ref_count_inc(&file->references);
    return file;
}

void fr_mesh_file_unref(FrMeshFile *file) {
    if (file == NULL || !g_atomic_ref_count_dec(&file->references)) {
        return;
    }
    for (uint32_t p = 0; p < file->part_count; p++) {
        fr_material_unref(file->parts[p].material);
    }
    g_clear_pointer(&file->surfaces, g_array_unref);
    g_free(file->positions);
    g_free(file->normals);
    g_free(file->uvs);
    g_free(file->indices);
    g_free(file->parts);
    g_free(file);
}
