// 3MF, for printers: a zip archive with a model in XML. 3MF Consortium, Core Specification 1.3.
// The plants are objects, their stands items of the build. Corners at one place are one vertex, as
// the format wants of the surface of a solid; what is not closed is said.
#include "io/formats.h"
#include "io/meshes.h"
#include "skin/closed.h"

#include <minizip/zip.h>

#include <errno.h>
#include <string.h>
#include <unistd.h>

/// Text on its way into the archive.
enum { TEXT_BUFFER = 1 << 16, TEXT_ROOM = 512, COLOUR_ID = 1, FIRST_OBJECT = 2 };
/// The first of January 1980, so that the same plant makes the same file.
enum { NO_DATE = 1 << 21 | 1 << 16 };

typedef struct FrThreeMf {
    const FrScene *scene;
    const FrContext *context;
    FrIoMeshes meshes;
    uint32_t *first_colour; ///< by plant
    zipFile zip;
    char *buffer;
    size_t used;
    int descriptor, error;
    uint64_t bytes;
} FrThreeMf;

// ---- the archive -------------------------------------------------------------------------------

static voidpf open_archive(voidpf opaque, const void *name, int mode) {
    (void)name, (void)mode;
    return opaque;
}

static uLong read_archive(voidpf opaque, voidpf stream, void *to, uLong size) {
    (void)opaque, (void)stream, (void)to, (void)size;
    return 0; // what is written is not read again
}

static uLong write_archive(voidpf opaque, voidpf stream, const void *from, uLong size) {
    (void)stream;
    FrThreeMf *file = opaque;
    uLong done = 0;
    while (done < size && file->error == 0) {
        ssize_t written = write(file->descriptor, (const char *)from + done, size - done);
        if (written > 0) {
            done += (uLong)written;
        } else if (errno != EINTR) {
            file->error = errno != 0 ? errno : EIO;
        }
    }
    return done;
}

static ZPOS64_T tell_archive(voidpf opaque, voidpf stream) {
    (void)stream;
    return (ZPOS64_T)lseek(((FrThreeMf *)opaque)->descriptor, 0, SEEK_CUR);
}

static long seek_archive(voidpf opaque, voidpf stream, ZPOS64_T offset, int origin) {
    (void)stream;
    static const int origins[] = {SEEK_SET, SEEK_CUR, SEEK_END};
    FrThreeMf *file = opaque;
    bool is_done = lseek(file->descriptor, (off_t)offset, origins[origin]) >= 0;
    file->error = is_done || file->error != 0 ? file->error : errno;
    return is_done ? 0 : -1;
}

static int close_archive(voidpf opaque, voidpf stream) {
    (void)opaque, (void)stream;
    return 0;
}

static int error_of_archive(voidpf opaque, voidpf stream) {
    (void)stream;
    return ((FrThreeMf *)opaque)->error;
}

static void note(FrThreeMf *file, int answer) {
    if (answer != ZIP_OK && file->error == 0) {
        file->error = EIO;
    }
}

static void begin_entry(FrThreeMf *file, const char *name, bool is_large) {
    zip_fileinfo info = {.dosDate = NO_DATE};
    note(file, zipOpenNewFileInZip64(file->zip, name, &info, NULL, 0, NULL, 0, NULL, Z_DEFLATED, 4,
                                     is_large));
}

static void flush_text(FrThreeMf *file) {
    if (file->error == 0) {
        note(file, zipWriteInFileInZip(file->zip, file->buffer, (unsigned)file->used));
    }
    if (fr_progress_is_cancelled(file->context->progress) && file->error == 0) {
        file->error = ECANCELED;
    }
    file->used = 0;
}

static void end_entry(FrThreeMf *file) {
    flush_text(file);
    note(file, zipCloseFileInZip(file->zip));
}

static void put(FrThreeMf *file, const char *format, ...) FR_PRINTF(2, 3);
static void put(FrThreeMf *file, const char *format, ...) {
    if (file->used + TEXT_ROOM > TEXT_BUFFER) {
        flush_text(file);
    }
    va_list arguments;
    va_start(arguments, format);
    int length = g_vsnprintf(file->buffer + file->used, TEXT_ROOM, format, arguments);
    va_end(arguments);
    file->used += (size_t)CLAMP(length, 0, TEXT_ROOM - 1);
}

static void put_number(FrThreeMf *file, const char *before, double value, const char *after) {
    char text[G_ASCII_DTOSTR_BUF_SIZE];
    put(file, "%s%s%s", before, g_ascii_formatd(text, sizeof text, "%.9g", value), after);
}

// ---- the model ---------------------------------------------------------------------------------

static void put_colours(FrThreeMf *file) {
    put(file, "<basematerials id=\"%d\">\n", COLOUR_ID);
    for (uint32_t p = 0; p < file->meshes.length; p++) {
        const GPtrArray *materials = fr_io_plant(file->scene, p)->materials;
        for (uint32_t m = 0; m <= materials->len; m++) {
            double rgb[3] = {0.45, 0.36, 0.28};
            for (int k = 0; k < 3 && m > 0; k++) {
                const FrMaterial *material = g_ptr_array_index(materials, m - 1);
                double value = (double)fr_material_params(material)->colour.raw[k];
                rgb[k] = CLAMP(value, 0.0, 1.0);
            }
            put(file, "<base name=\"%u\" displaycolor=\"#%02X%02X%02X\"/>\n", m,
                (unsigned)(255.0 * rgb[0] + 0.5), (unsigned)(255.0 * rgb[1] + 0.5),
                (unsigned)(255.0 * rgb[2] + 0.5));
        }
    }
    put(file, "</basematerials>\n");
}

static void put_vertices(FrThreeMf *file, const FrMesh *mesh, const uint32_t *places,
                         uint32_t *numbers) {
    uint32_t count = 0;
    put(file, "<vertices>\n");
    for (uint64_t i = 0; i < mesh->index_count; i++) {
        if (numbers[places[i]] == FR_NONE) {
            const float *at = mesh->vertices[places[i]].position;
            numbers[places[i]] = count++;
            put_number(file, "<vertex x=\"", (double)at[0], "\"");
            put_number(file, " y=\"", (double)at[1], "\"");
            put_number(file, " z=\"", (double)at[2], "\"/>\n");
        }
    }
    put(file, "</vertices>\n");
}

static void put_object(FrThreeMf *file, uint32_t plant, const FrMesh *mesh) {
    uint32_t *places = fr_mesh_places(mesh), *numbers = g_new(uint32_t, mesh->vertex_count + 1);
    memset(numbers, 0xff, mesh->vertex_count * sizeof *numbers); // FR_NONE
    put(file, "<object id=\"%u\" type=\"model\" pid=\"%d\" pindex=\"%u\"><mesh>\n",
        FIRST_OBJECT + plant, COLOUR_ID, file->first_colour[plant]);
    put_vertices(file, mesh, places, numbers);
    put(file, "<triangles>\n");
    for (uint32_t p = 0; p < mesh->part_count; p++) {
        const FrMeshPart *part = &mesh->parts[p];
        uint32_t own = part->material == FR_NONE ? 0 : part->material + 1;
        for (uint64_t i = part->first_index; i < part->first_index + part->index_count; i += 3) {
            uint32_t a = places[i], b = places[i + 1], c = places[i + 2];
            if (a != b && b != c && c != a) {
                put(file, "<triangle v1=\"%u\" v2=\"%u\" v3=\"%u\" pid=\"%d\" p1=\"%u\"/>\n",
                    numbers[a], numbers[b], numbers[c], COLOUR_ID, file->first_colour[plant] + own);
            }
        }
    }
    put(file, "</triangles>\n</mesh></object>\n");
    g_free(places);
    g_free(numbers);
}

static void put_item(FrThreeMf *file, const FrStand *stand) {
    FrPose pose = fr_io_pose(stand, FR_UP_Z);
    double c = pose.scale * pose.cosine, s = pose.scale * pose.sine;
    const double map[12] = {c, s, 0,          -s,         c,          0,
                            0, 0, pose.scale, pose.at[0], pose.at[1], pose.at[2]};
    put(file, "<item objectid=\"%u\" transform=\"", FIRST_OBJECT + stand->plant);
    for (int i = 0; i < 12; i++) {
        put_number(file, i > 0 ? " " : "", map[i] + 0.0, "");
    }
    put(file, "\"/>\n");
}

static bool is_there(const FrThreeMf *file, uint32_t plant) {
    return file->meshes.meshes[plant] != NULL && file->meshes.meshes[plant]->index_count > 0;
}

static void put_model(FrThreeMf *file) {
    // A vertex takes some 60 bytes of text, a triangle some 70.
    bool is_large =
        file->meshes.count.vertices * 60 + file->meshes.count.triangles * 70 > 2000000000;
    begin_entry(file, "3D/3dmodel.model", is_large);
    put(file, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
              "<model unit=\"meter\" xml:lang=\"en-US\" "
              "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\">\n"
              "<metadata name=\"Application\">Frond " FR_VERSION "</metadata>\n<resources>\n");
    put_colours(file);
    for (uint32_t p = 0; p < file->meshes.length; p++) {
        if (is_there(file, p)) {
            put_object(file, p, file->meshes.meshes[p]);
        }
    }
    put(file, "</resources>\n<build>\n");
    for (guint s = 0; s < file->scene->stands->len; s++) {
        const FrStand *stand = fr_io_stand(file->scene, s);
        if (is_there(file, stand->plant)) {
            put_item(file, stand);
        }
    }
    put(file, "</build>\n</model>\n");
    end_entry(file);
}

static void put_frame(FrThreeMf *file) {
    begin_entry(file, "[Content_Types].xml", false);
    put(file, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
              "<Types xmlns=\"http://schemas.openxmlformats.org/package/2006/content-types\">"
              "<Default Extension=\"rels\" "
              "ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/>");
    put(file, "<Default Extension=\"model\" "
              "ContentType=\"application/vnd.ms-package.3dmanufacturing-3dmodel+xml\"/></Types>\n");
    end_entry(file);
    begin_entry(file, "_rels/.rels", false);
    put(file, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<Relationships "
              "xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">");
    put(file, "<Relationship Target=\"/3D/3dmodel.model\" Id=\"model\" "
              "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/>"
              "</Relationships>\n");
    end_entry(file);
}

static bool write_archive_of(void *user, int descriptor) {
    FrThreeMf *file = user;
    file->descriptor = descriptor;
    zlib_filefunc64_def functions = {open_archive, read_archive,  write_archive,    tell_archive,
                                     seek_archive, close_archive, error_of_archive, file};
    file->zip = zipOpen2_64("", APPEND_STATUS_CREATE, NULL, &functions);
    if (file->zip == NULL) {
        errno = ENOMEM;
        return false;
    }
    file->buffer = g_malloc(TEXT_BUFFER);
    put_frame(file);
    put_model(file);
    note(file, zipClose(file->zip, NULL));
    off_t size = lseek(descriptor, 0, SEEK_END);
    file->bytes = size > 0 ? (uint64_t)size : 0;
    g_free(file->buffer);
    errno = file->error;
    return file->error == 0;
}

static void warn_of_open(const FrThreeMf *file) {
    for (uint32_t p = 0; p < file->meshes.length; p++) {
        uint64_t open = is_there(file, p) ? fr_mesh_open_edges(file->meshes.meshes[p], NULL) : 0;
        if (open > 0) {
            fr_diags_add(
                file->context->diags, FR_WARNING, "not-closed", (FrSpan){0},
                "the surface of '%s' is open at %" G_GUINT64_FORMAT
                " edges; printers want it closed: --nurbs caps=yes closes tubes, "
                "thickness=0.004 blades, and voxel=0.002 makes one solid of what is closed",
                fr_io_plant(file->scene, p)->name, open);
        }
    }
}

FrStatus fr_three_mf_write(const FrScene *scene, const char *path, const FrIoOptions *options,
                           const FrContext *context, FrIoStats *stats) {
    FrThreeMf file = {.scene = scene, .context = context};
    gint64 start = g_get_monotonic_time();
    FrStatus status =
        fr_io_meshes_make(&file.meshes, scene, &options->skin, FR_UP_Z, false, context);
    if (status != FR_OK) {
        return status;
    }
    gint64 skinned = g_get_monotonic_time();
    file.first_colour = g_new(uint32_t, (size_t)file.meshes.length + 1);
    for (uint32_t p = 0, colours = 0; p < file.meshes.length; p++) {
        file.first_colour[p] = colours;
        colours += fr_io_plant(scene, p)->materials->len + 1;
    }
    warn_of_open(&file);
    status = fr_io_replace_file(path, write_archive_of, &file, context->diags);
    const FrIoCount *count = &file.meshes.count;
    *stats = (FrIoStats){
        .meshes = count->meshes,
        .vertices = count->vertices,
        .triangles = count->triangles_everywhere,
        .bytes = file.bytes,
        .skin_seconds = (double)(skinned - start) * 1e-6,
        .write_seconds = (double)(g_get_monotonic_time() - skinned) * 1e-6,
    };
    g_free(file.first_colour);
    fr_io_meshes_clear(&file.meshes);
    return status;
}
