// Reads files of triangles by the Open Asset Import Library. The one file that knows it.
#include "material/mesh_file.h"

#include <assimp/cfileio.h>
#include <assimp/cimport.h>
#include <assimp/config.h>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/texture.h>

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

/// What one import may open: files beside or below the first, together no more than a limit.
typedef struct Folder {
    char *path, *first;
    const GBytes *text; ///< of the first, in the place of what is in the file; NULL
    uint64_t left;      ///< bytes
    char *missing;      ///< what was looked for and is not there; NULL
} Folder;

/// A file in memory.
typedef struct Bytes {
    char *data;
    size_t size, at;
} Bytes;

static size_t bytes_read(struct aiFile *file, char *out, size_t width, size_t count) {
    Bytes *bytes = (Bytes *)(void *)file->UserData;
    size_t whole = width > 0 ? (bytes->size - bytes->at) / width : 0;
    count = MIN(count, whole);
    memcpy(out, bytes->data + bytes->at, width * count);
    bytes->at += width * count;
    return count;
}

static size_t bytes_write(struct aiFile *file, const char *in, size_t width, size_t count) {
    (void)file, (void)in, (void)width, (void)count;
    return 0;
}

static size_t bytes_tell(struct aiFile *file) {
    return ((Bytes *)(void *)file->UserData)->at;
}

static size_t bytes_size(struct aiFile *file) {
    return ((Bytes *)(void *)file->UserData)->size;
}

static void bytes_flush(struct aiFile *file) {
    (void)file;
}

static enum aiReturn bytes_seek(struct aiFile *file, size_t offset, enum aiOrigin origin) {
    Bytes *bytes = (Bytes *)(void *)file->UserData;
    size_t from = origin == aiOrigin_CUR ? bytes->at : origin == aiOrigin_END ? bytes->size : 0;
    size_t to = from + offset; // may wrap round: then it goes back
    if (to > bytes->size) {
        return aiReturn_FAILURE;
    }
    bytes->at = to;
    return aiReturn_SUCCESS;
}

// The file's path below the folder, NULL if it is elsewhere.
static char *path_below(const Folder *folder, const char *name) {
    if (strcmp(name, folder->first) == 0) {
        return g_strdup(name);
    }
    size_t length = strlen(folder->path);
    if (strncmp(name, folder->path, length) == 0 && name[length] == '/') {
        name += length + 1;
    }
    return fr_mesh_path_is_inside(name) ? g_build_filename(folder->path, name, NULL) : NULL;
}

static struct aiFile *folder_open(struct aiFileIO *io, const char *name, const char *mode) {
    Folder *folder = (Folder *)(void *)io->UserData;
    char *path = strchr(mode, 'r') != NULL ? path_below(folder, name) : NULL;
    struct stat stat_of;
    bool is_fine = path != NULL && stat(path, &stat_of) == 0 && S_ISREG(stat_of.st_mode) &&
                   (uint64_t)stat_of.st_size <= folder->left;
    gsize size = 0;
    char *data = NULL;
    if (is_fine && folder->text != NULL && strcmp(name, folder->first) == 0) {
        const void *text = g_bytes_get_data((GBytes *)folder->text, &size);
        data = g_memdup2(text, size);
    } else if (is_fine && g_file_get_contents(path, &data, &size, NULL) && size <= folder->left) {
        folder->left -= size;
    } else {
        g_clear_pointer(&data, g_free);
    }
    g_free(path);
    if (folder->missing == NULL && data == NULL) {
        folder->missing = g_path_get_basename(name);
    } else if (data != NULL) {
        g_clear_pointer(&folder->missing, g_free); // another name for the same
    }
    if (data == NULL) {
        return NULL;
    }
    Bytes *bytes = g_new(Bytes, 1);
    *bytes = (Bytes){.data = data, .size = size};
    struct aiFile *file = g_new(struct aiFile, 1);
    *file = (struct aiFile){
        .ReadProc = bytes_read,
        .WriteProc = bytes_write,
        .TellProc = bytes_tell,
        .FileSizeProc = bytes_size,
        .SeekProc = bytes_seek,
        .FlushProc = bytes_flush,
        .UserData = (aiUserData)(void *)bytes,
    };
    return file;
}

static void folder_close(struct aiFileIO *io, struct aiFile *file) {
    (void)io;
    Bytes *bytes = (Bytes *)(void *)file->UserData;
    g_free(bytes->data);
    g_free(bytes);
    g_free(file);
}

// ---- materials ----------------------------------------------------------------------------------

// A picture that the file holds itself.
static GBytes *embedded_picture(const struct aiScene *scene, const char *name) {
    char *end;
    guint64 index = name[0] == '*' ? g_ascii_strtoull(name + 1, &end, 10) : G_MAXUINT64;
    if (index >= scene->mNumTextures) {
        return NULL;
    }
    const struct aiTexture *texture = scene->mTextures[index];
    return texture->mHeight == 0 ? g_bytes_new(texture->pcData, texture->mWidth) : NULL;
}

static void read_colour(const struct aiMaterial *from, const char *stem, FrSpan span,
                        FrDiags *diags, FrMaterialParams *params) {
    struct aiColor4D colour;
    if (aiGetMaterialColor(from, AI_MATKEY_BASE_COLOR, &colour) != aiReturn_SUCCESS &&
        aiGetMaterialColor(from, AI_MATKEY_COLOR_DIFFUSE, &colour) != aiReturn_SUCCESS) {
        return;
    }
    const float linear[3] = {colour.r, colour.g, colour.b};
    if (!isfinite(colour.r) || !isfinite(colour.g) || !isfinite(colour.b)) {
        fr_diags_add(diags, FR_WARNING, "wrong-colour", span,
                     "'%s' has a material whose colour is not three numbers", stem);
        return;
    }
    for (int k = 0; k < 3; k++) {
        // Files have it linear, materials as sRGB.
        float c = linear[k] > 0 ? fminf(linear[k], 1) : 0;
        params->colour.raw[k] = c <= 0.0031308f ? 12.92f * c : 1.055f * powf(c, 1 / 2.4f) - 0.055f;
    }
}

static FrMaterial *read_material(const struct aiScene *scene, uint32_t index, const char *folder,
                                 const char *stem, FrSpan span, FrDiags *diags) {
    const struct aiMaterial *from = scene->mMaterials[index];
    FrMaterialParams params;
    fr_params_init(fr_material_table(), &params);
    read_colour(from, stem, span, diags, &params);
    float roughness;
    if (aiGetMaterialFloatArray(from, AI_MATKEY_ROUGHNESS_FACTOR, &roughness, NULL) ==
            aiReturn_SUCCESS &&
        roughness >= 0 && roughness <= 1) {
        params.roughness = (double)roughness;
    }
    struct aiString picture = {0}, own = {0};
    GBytes *bytes = NULL;
    bool has_picture = aiGetMaterialTexture(from, aiTextureType_BASE_COLOR, 0, &picture, NULL, NULL,
                                            NULL, NULL, NULL, NULL) == aiReturn_SUCCESS ||
                       aiGetMaterialTexture(from, aiTextureType_DIFFUSE, 0, &picture, NULL, NULL,
                                            NULL, NULL, NULL, NULL) == aiReturn_SUCCESS;
    if (has_picture) {
        bytes = embedded_picture(scene, picture.data);
        bool is_below = bytes != NULL || fr_mesh_path_is_inside(picture.data);
        g_free(params.picture);
        params.picture = is_below ? g_strdup(picture.data) : NULL;
    }
    bool is_named = aiGetMaterialString(from, AI_MATKEY_NAME, &own) == aiReturn_SUCCESS &&
                    own.length > 0 && g_utf8_validate(own.data, -1, NULL);
    char *name =
        is_named ? g_strdup_printf("%s-%s", stem, own.data) : g_strdup_printf("%s-%u", stem, index);
    FrMaterial *material = fr_material_new(name, &params, folder, span);
    if (bytes != NULL) {
        fr_material_set_file(material, FR_MAP_COLOUR, bytes);
        g_bytes_unref(bytes);
    }
    g_free(name);
    fr_params_clear(fr_material_table(), &params);
    return material;
}

// ---- triangles ----------------------------------------------------------------------------------

static void take_mesh(FrMeshFile *file, const struct aiMesh *mesh, bool is_y_up) {
    uint32_t base = file->vertex_count;
    for (uint32_t k = 0; k < mesh->mNumVertices; k++) {
        const struct aiVector3D *p = &mesh->mVertices[k];
        vec3s at = {{p->x, p->y, p->z}}, normal = {{0, 0, 1}};
        if (mesh->mNormals != NULL) {
            const struct aiVector3D *n = &mesh->mNormals[k];
            normal = (vec3s){{n->x, n->y, n->z}};
        }
        file->positions[base + k] = is_y_up ? (vec3s){{at.x, -at.z, at.y}} : at;
        file->normals[base + k] = is_y_up ? (vec3s){{normal.x, -normal.z, normal.y}} : normal;
        bool has_uv = mesh->mTextureCoords[0] != NULL;
        file->uvs[base + k][0] = has_uv ? mesh->mTextureCoords[0][k].x : 0;
        file->uvs[base + k][1] = has_uv ? 1 - mesh->mTextureCoords[0][k].y : 0;
    }
    file->vertex_count += mesh->mNumVertices;
    for (uint32_t f = 0; f < mesh->mNumFaces; f++) {
        for (uint32_t k = 0; k < 3 && mesh->mFaces[f].mNumIndices == 3; k++) {
            file->indices[file->index_count++] = base + mesh->mFaces[f].mIndices[k];
        }
    }
}

static bool is_surface(const struct aiMesh *mesh) {
    return (mesh->mPrimitiveTypes & aiPrimitiveType_TRIANGLE) != 0 && mesh->mVertices != NULL;
}

static FrStatus check_size(const struct aiScene *scene, const char *name, FrSpan span,
                           const FrContext *context, uint64_t *vertices, uint64_t *triangles) {
    *vertices = *triangles = 0;
    for (uint32_t m = 0; m < scene->mNumMeshes; m++) {
        if (is_surface(scene->mMeshes[m])) {
            *vertices += scene->mMeshes[m]->mNumVertices;
            *triangles += scene->mMeshes[m]->mNumFaces;
        }
    }
    uint64_t most = MIN(context->limits.triangles, UINT32_MAX / 3);
    FrStatus status = fr_limit_check(*triangles, most, "triangles", name, span, context->diags);
    uint64_t each = 2 * sizeof(vec3s) + 2 * sizeof(float);
    uint64_t bytes = *vertices * each + *triangles * 3 * sizeof(uint32_t);
    return status == FR_OK
               ? fr_limit_check(bytes, context->limits.bytes, "bytes", name, span, context->diags)
               : status;
}

static FrMeshFile *take_scene(const struct aiScene *scene, const char *path, const char *name,
                              FrSpan span, const FrContext *context, FrStatus *status) {
    uint64_t vertices, triangles;
    *status = check_size(scene, name, span, context, &vertices, &triangles);
    if (*status != FR_OK) {
        return NULL;
    }
    FrMeshFile *file = g_new0(FrMeshFile, 1);
    g_atomic_ref_count_init(&file->references);
    file->positions = g_new(vec3s, MAX(vertices, 1));
    file->normals = g_new(vec3s, MAX(vertices, 1));
    file->uvs = g_malloc_n(MAX(vertices, 1), sizeof *file->uvs);
    file->indices = g_new(uint32_t, MAX(3 * triangles, 1));
    file->parts = g_new0(FrMeshFilePart, MAX(scene->mNumMaterials, 1));
    char *folder = g_path_get_dirname(path), *stem = g_path_get_basename(name);
    bool is_y_up = strstr(stem, ".stl") == NULL && strstr(stem, ".STL") == NULL;
    for (uint32_t material = 0; material < scene->mNumMaterials; material++) {
        FrMeshFilePart part = {.first_index = file->index_count};
        for (uint32_t m = 0; m < scene->mNumMeshes; m++) {
            const struct aiMesh *mesh = scene->mMeshes[m];
            if (mesh->mMaterialIndex == material && is_surface(mesh)) {
                take_mesh(file, mesh, is_y_up);
            }
        }
        part.index_count = file->index_count - part.first_index;
        if (part.index_count > 0) {
            part.material = read_material(scene, material, folder, stem, span, context->diags);
            file->parts[file->part_count++] = part;
        }
    }
    g_free(folder);
    g_free(stem);
    return file;
}

FrMeshFile *fr_mesh_file_import(const char *path, const char *name, const GBytes *text, FrSpan span,
                                const FrContext *context, FrStatus *status) {
    Folder folder = {
        .text = text,
        .path = g_path_get_dirname(path),
        .first = g_strdup(path),
        .left = context->limits.document_bytes,
    };
    struct aiFileIO io = {
        .OpenProc = folder_open,
        .CloseProc = folder_close,
        .UserData = (aiUserData)(void *)&folder,
    };
    struct aiPropertyStore *settings = aiCreatePropertyStore();
    // Where a file has no normals, edges sharper than this stay sharp.
    aiSetImportPropertyFloat(settings, AI_CONFIG_PP_GSN_MAX_SMOOTHING_ANGLE, 50.0F);
    aiSetImportPropertyInteger(settings, AI_CONFIG_PP_SBP_REMOVE,
                               aiPrimitiveType_POINT | aiPrimitiveType_LINE);
    const struct aiScene *scene = aiImportFileExWithProperties(
        path,
        aiProcess_ValidateDataStructure | aiProcess_Triangulate | aiProcess_SortByPType |
            aiProcess_PreTransformVertices | aiProcess_GenSmoothNormals |
            aiProcess_JoinIdenticalVertices,
        &io, settings);
    aiReleasePropertyStore(settings);
    FrMeshFile *file = NULL;
    if (scene != NULL) {
        file = take_scene(scene, path, name, span, context, status);
        aiReleaseImport(scene);
        if (folder.missing != NULL) {
            fr_diags_add(context->diags, FR_WARNING, "missing-file", span,
                         "'%s' names the file '%.200s', which is not there", name, folder.missing);
        }
    } else {
        char *why = g_utf8_make_valid(aiGetErrorString(), -1);
        fr_diags_add(context->diags, FR_ERROR, "wrong-mesh", span, "'%s' cannot be read: %.200s",
                     name, why);
        g_free(why);
        *status = FR_ERR_DOCUMENT;
    }
    g_free(folder.path);
    g_free(folder.first);
    g_free(folder.missing);
    return file;
}
