#include "io/output.h"
#include "scenes.h"

#include <math.h>
#include <stdio.h>
#include <unistd.h>

static FrScene *garden(void) {
    FrScene *scene = scene_new();
    FrPlant *oak = plant_with_leaves("red oak", 5, FR_TEXTURE_BARK_SMOOTH, FR_TEXTURE_LEAF);
    uint32_t plant = scene_add(scene, oak);
    scene_stand(scene, plant, 0, 0, 0, 1);
    scene_stand(scene, plant, 100, 0, G_PI / 2, 2);
    return scene;
}

typedef struct ObjCount {
    size_t vertices, normals, coordinates, faces, objects;
    double low[3], high[3];
} ObjCount;

static void read_obj(const char *folder, const char *name, ObjCount *count) {
    *count = (ObjCount){.low = {1e9, 1e9, 1e9}, .high = {-1e9, -1e9, -1e9}};
    char *text = file_bytes(folder, name, NULL);
    char **lines = g_strsplit(text, "\n", -1);
    for (char **line = lines; *line != NULL; line++) {
        double x, y, z;
        unsigned long a[9];
        if (sscanf(*line, "v %lf %lf %lf", &x, &y, &z) == 3) {
            count->vertices++;
            double point[3] = {x, y, z};
            for (int k = 0; k < 3; k++) {
                count->low[k] = fmin(count->low[k], point[k]);
                count->high[k] = fmax(count->high[k], point[k]);
            }
        } else if (sscanf(*line, "vn %lf %lf %lf", &x, &y, &z) == 3) {
            g_assert_cmpfloat_with_epsilon(x * x + y * y + z * z, 1.0, 1e-3);
            count->normals++;
        } else if (sscanf(*line, "vt %lf %lf", &x, &y) == 2) {
            count->coordinates++;
        } else if (sscanf(*line, "f %lu/%lu/%lu %lu/%lu/%lu %lu/%lu/%lu", &a[0], &a[1], &a[2],
                          &a[3], &a[4], &a[5], &a[6], &a[7], &a[8]) == 9) {
            for (int k = 0; k < 9; k++) {
                g_assert_cmpuint(a[k], >=, 1);
                g_assert_cmpuint(a[k], <=, count->vertices);
            }
            count->faces++;
        } else if (g_str_has_prefix(*line, "o ")) {
            count->objects++;
        }
    }
    g_strfreev(lines);
    g_free(text);
}

static void obj(void) {
    char *folder = folder_new();
    FrScene *scene = garden();
    FrIoStats stats = write_scene(scene, folder, "oak.obj", FR_LEAVES_MERGED);
    ObjCount count;
    read_obj(folder, "oak.obj", &count);
    g_assert_cmpuint(count.vertices, ==, stats.vertices);
    g_assert_cmpuint(count.normals, ==, stats.vertices);
    g_assert_cmpuint(count.coordinates, ==, stats.vertices);
    g_assert_cmpuint(count.faces, ==, stats.triangles);
    g_assert_cmpuint(count.objects, ==, 2);
    // Twice as tall as the first, standing 100 m along x on 0.25 m of ground; y is up.
    g_assert_cmpfloat(count.high[0], >, 99);
    g_assert_cmpfloat(count.high[1], >, 2);
    g_assert_cmpfloat(count.low[1], >, -1);
    char *text = file_bytes(folder, "oak.obj", NULL);
    g_assert_nonnull(strstr(text, "mtllib oak.mtl\n"));
    g_assert_nonnull(strstr(text, "usemtl green_leaf\n"));
    g_assert_nonnull(strstr(text, "o red_oak_2\n"));
    g_free(text);
    char *library = file_bytes(folder, "oak.mtl", NULL);
    static const char *const words[] = {"map_Kd ", "map_d ", "norm -bm 1 ", "newmtl bark\n"};
    for (size_t i = 0; i < G_N_ELEMENTS(words); i++) {
        char *at = strstr(library, words[i]);
        g_assert_nonnull(at);
        if (i < 3) { // the picture is there
            char *name = g_strndup(at + strlen(words[i]), strcspn(at + strlen(words[i]), "\n"));
            g_free(file_bytes(folder, name, NULL));
            g_free(name);
        }
    }
    g_free(library);
    fr_scene_free(scene);
    remove_folder(folder);
}

static void ply(void) {
    char *folder = folder_new();
    FrScene *scene = garden();
    FrIoStats stats = write_scene(scene, folder, "oak.ply", FR_LEAVES_MERGED);
    size_t size;
    char *bytes = file_bytes(folder, "oak.ply", &size);
    char *wanted = g_strdup_printf("element vertex %" G_GUINT64_FORMAT "\n", stats.vertices);
    g_assert_nonnull(strstr(bytes, wanted));
    g_free(wanted);
    char *body = strstr(bytes, "end_header\n") + strlen("end_header\n");
    g_assert_cmpuint(size, ==, (size_t)(body - bytes) + stats.vertices * 32 + stats.triangles * 13);
    float height = 0;
    for (uint64_t v = 0; v < stats.vertices; v++) {
        float vertex[8];
        memcpy(vertex, body + v * 32, 32);
        height = fmaxf(height, vertex[2]);
    }
    g_assert_cmpfloat(height, >, 2.0f); // z is up
    const char *faces = body + stats.vertices * 32;
    uint32_t largest = 0;
    for (uint64_t f = 0; f < stats.triangles; f++) {
        uint32_t corners[3];
        g_assert_cmpint(faces[f * 13], ==, 3);
        memcpy(corners, faces + f * 13 + 1, 12);
        largest = MAX(largest, MAX(corners[0], MAX(corners[1], corners[2])));
    }
    g_assert_cmpuint(largest, ==, stats.vertices - 1);
    g_free(bytes);
    fr_scene_free(scene);
    remove_folder(folder);
}

static void stl(void) {
    char *folder = folder_new();
    FrScene *scene = garden();
    FrIoStats stats = write_scene(scene, folder, "oak.stl", FR_LEAVES_MERGED);
    size_t size;
    char *bytes = file_bytes(folder, "oak.stl", &size);
    uint32_t count;
    memcpy(&count, bytes + 80, 4);
    g_assert_cmpuint(count, ==, stats.triangles);
    g_assert_cmpuint(size, ==, 84 + 50 * (size_t)count);
    g_assert_false(g_str_has_prefix(bytes, "solid"));
    for (uint32_t f = 0; f < count; f++) {
        float face[12];
        memcpy(face, bytes + 84 + 50 * (size_t)f, sizeof face);
        float norm = face[0] * face[0] + face[1] * face[1] + face[2] * face[2];
        g_assert_true(norm == 0.0f || fabsf(norm - 1.0f) < 1e-4f);
    }
    g_free(bytes);
    fr_scene_free(scene);
    remove_folder(folder);
}

/// Text that fr_output_fixed() makes of a number.
static void assert_fixed(double value, int decimals, const char *wanted) {
    FILE *file = tmpfile();
    FrOutput output;
    fr_output_start(&output, fileno(file), NULL);
    fr_output_fixed(&output, value, decimals);
    g_assert_true(fr_output_finish(&output));
    char text[64] = {0};
    rewind(file);
    g_assert_cmpuint(fread(text, 1, sizeof text - 1, file), ==, strlen(wanted));
    g_assert_cmpstr(text, ==, wanted);
    fclose(file);
}

static void fixed_numbers(void) {
    assert_fixed(0, 6, "0");
    assert_fixed(-0.0, 6, "0");
    assert_fixed(1, 6, "1");
    assert_fixed(-1.5, 6, "-1.5");
    assert_fixed(0.05, 6, "0.05");
    assert_fixed(0.000001, 6, "0.000001");
    assert_fixed(0.0000004, 6, "0");
    assert_fixed(-0.0000004, 6, "0");
    assert_fixed(1234.56789, 2, "1234.57");
    assert_fixed(99.999, 2, "100");
    assert_fixed(1e12, 6, "1000000000000");
    assert_fixed(NAN, 6, "0");
    assert_fixed(INFINITY, 6, "0");
}

static void chunks(void) {
    // More pieces than one call takes, one of them empty, arrive in order.
    enum { COUNT = 1000 };
    FILE *file = tmpfile();
    uint16_t numbers[COUNT];
    FrChunk list[COUNT + 1];
    for (uint16_t i = 0; i < COUNT; i++) {
        numbers[i] = i;
        list[i] = (FrChunk){&numbers[i], sizeof numbers[i]};
    }
    list[COUNT] = list[500];
    list[500] = (FrChunk){numbers, 0};
    g_assert_true(fr_write_chunks(fileno(file), list, COUNT + 1, NULL));
    uint16_t read_back[COUNT];
    rewind(file);
    g_assert_cmpuint(fread(read_back, sizeof(uint16_t), COUNT, file), ==, COUNT);
    for (uint16_t i = 0; i < COUNT; i++) {
        g_assert_cmpuint(read_back[i], ==, i < 500 ? i : i < COUNT - 1 ? i + 1 : 500);
    }
    fclose(file);
    g_assert_false(fr_write_chunks(-1, list, 3, NULL));
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/io/obj/vertices, faces, materials and pictures are all there", obj);
    g_test_add_func("/io/ply/counts match the bytes and corners the vertices", ply);
    g_test_add_func("/io/stl/counts match the bytes and normals are unit", stl);
    g_test_add_func("/io/output/numbers are short, rounded and never in a locale's way",
                    fixed_numbers);
    g_test_add_func("/io/output/many pieces arrive in order", chunks);
    return g_test_run();
}
