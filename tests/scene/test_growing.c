/// L-systems that grow in the light of their scene.
#include "frond/scene.h"

#include <cglm/struct.h>
#include <glib/gstdio.h>
#include <math.h>
#include <string.h>

typedef struct Built {
    FrDocument *document;
    FrScene *scene;
} Built;

static Built build_with(const char *text, FrContext context) {
    Built built = {0};
    context.diags = fr_diags_new();
    FrSource *source = fr_source_new("grow.frond", text, strlen(text));
    FrStatus status = fr_document_parse(source, NULL, &context, &built.document);
    if (status == FR_OK) {
        status = fr_scene_build(built.document, -1, &context, &built.scene);
    }
    GString *said = g_string_new(NULL);
    fr_diags_print(context.diags, said);
    g_test_message("%s", said->str);
    g_string_free(said, TRUE);
    g_assert_cmpint(status, ==, FR_OK);
    fr_source_unref(source);
    fr_diags_free(context.diags);
    return built;
}

static Built build(const char *text) {
    return build_with(text, fr_context_default());
}

static void forget(Built *built) {
    fr_scene_free(built->scene);
    fr_document_free(built->document);
}

static const FrPlant *plant_at(const Built *built, guint index) {
    return g_array_index(built->scene->plants, FrScenePlant, index).plant;
}

#define DOCUMENT(lsystem, scene)                                                                   \
    "<frond version='1'><plant id='p'><lsystem><![CDATA[\n" lsystem                                \
    "\n]]></lsystem></plant><scene ground='no' sun-strength='0' sky-strength='0'>" scene           \
    "</scene></frond>"
#define LAMP "<lamp at='8, 0, 4' power='100'/>"
// L-system 1 of the paper, word for word but for the length of F.
#define BENDING                                                                                    \
    "derivation length: 30\nw : A\np1 : A -> F(0.2)R(?,8)A\np2 : R(r,p) -> \\(r)&(p)/(r)"

/// R12: every bend is at most 8 degrees, and in the end the branch points to the lamp.
static void test_bending(void) {
    Built built = build(DOCUMENT(BENDING, "<light near='0.1'/>" LAMP "<place plant='p'/>"));
    const FrPlant *plant = plant_at(&built, 0);
    g_assert_cmpuint(plant->nodes.count, ==, 30);
    float sum = 0;
    for (uint32_t i = 1; i < 30; i++) {
        float bend = glms_vec3_angle(fr_frame_heading(plant->nodes.frame[i - 1]),
                                     fr_frame_heading(plant->nodes.frame[i]));
        g_assert_cmpfloat(glm_deg(bend), <, 8.05f);
        sum += bend;
    }
    g_assert_cmpfloat(glm_deg(sum), >, 30);
    vec3s way = glms_vec3_sub((vec3s){{8, 0, 4}}, plant->nodes.position[28]);
    float off = glms_vec3_angle(way, fr_frame_heading(plant->nodes.frame[29]));
    g_assert_cmpfloat(glm_deg(off), <, 3);
    g_assert_cmpuint(built.scene->steps->len, ==, 30);
    forget(&built);
}

/// Branches are as long as it is bright: under open sky all alike, however high.
static void test_tall(void) {
    Built built = build(
        "<frond version='1'><plant id='p'><lsystem><![CDATA[\nLsystem: 1\nderivation length: 10\n"
        "axiom: I(?)A\nI(i) < A --> "
        "!(0.01)F(1)[&(90)F(0.01+i/5000)]I(?)A\nendlsystem\n]]></lsystem></plant>"
        "<scene ground='no'><light by='density' photons='50000' distance='0.5'/><place plant='p'/>"
        "</scene></frond>");
    const FrPlant *plant = plant_at(&built, 0);
    g_assert_cmpuint(plant->nodes.count, ==, 20);
    float shortest = INFINITY, longest = 0;
    for (uint32_t axis = 1; axis < plant->axes.count; axis++) {
        float length = plant->nodes.length[plant->axes.last[axis]];
        shortest = fminf(shortest, length);
        longest = fmaxf(longest, length);
    }
    g_assert_cmpfloat(shortest, >, 0.7f * longest);
    forget(&built);
}

/// Light is that of the world: turned and scaled plants lean to the same lamp.
static void test_stands(void) {
    Built built = build(DOCUMENT(BENDING, "<light near='0.1'/>" LAMP "<place plant='p'/>"
                                          "<place plant='p' turn='90' scale='0.5'/>"));
    g_assert_cmpuint(built.scene->plants->len, ==, 2);
    const FrPlant *turned = plant_at(&built, 1);
    vec3s heading = fr_frame_heading(turned->nodes.frame[29]);
    vec3s world = glms_vec3_rotate(heading, GLM_PI_2f, (vec3s){{0, 0, 1}});
    g_assert_cmpfloat(world.x, >, 0.8f);
    g_assert_cmpfloat(fabsf(world.y), <, 0.05f);
    forget(&built);
}

// R14 and R15: long internodes in the dark, a flower (a sphere) only where there is light.
#define SHADE                                                                                      \
    "derivation length: 6\nh(i) = 1 - 0.8*i\nw : I(?)A\n"                                          \
    "p1 : I(i) < A : i < 0.5 -> F(h(i))I(?)A\np2 : I(i) < A : i >= 0.5 -> F(h(i))@O(0.1)"

static void test_shade(void) {
    Built built = build(DOCUMENT(SHADE, "<light near='0.01' relative='yes' reference='0, 0, 1'/>"
                                        "<lamp at='0, 0, 50' power='1000'/>"
                                        "<obstacle at='32, 0, 20' size='40, 20, 0.1'/>"
                                        "<place plant='p'/><place plant='p' at='40, 0, 0'/>"));
    const FrPlant *lit = plant_at(&built, 0), *dark = plant_at(&built, 1);
    g_assert_cmpuint(lit->nodes.count, ==, 1);
    g_assert_cmpuint(lit->organs.count, ==, 1);
    g_assert_cmpfloat(lit->nodes.length[0], <, 0.3f);
    g_assert_cmpuint(dark->nodes.count, ==, 6);
    g_assert_cmpuint(dark->organs.count, ==, 0);
    g_assert_cmpfloat(dark->nodes.length[0], ==, 1);
    forget(&built);
}

/// Notes the string of a plant as it stands in the end.
static FrStatus note_string(void *user, FrLderivation *derivation, bool is_answered) {
    GString *text = user;
    if (!is_answered) {
        g_string_truncate(text, 0);
        fr_lstring_print(fr_lderivation_string(derivation), text);
    }
    return FR_OK;
}

/// The string in the end; the plant is the only one of the scene.
static GString *string_of(const char *text) {
    FrContext context = fr_context_default();
    FrDocument *document;
    FrSource *source = fr_source_new("grow.frond", text, strlen(text));
    g_assert_cmpint(fr_document_parse(source, NULL, &context, &document), ==, FR_OK);
    const FrPlantDef *plant = g_ptr_array_index(fr_document_plants(document), 0);
    GString *string = g_string_new(NULL);
    g_assert_cmpint(fr_scene_derive(document, plant, -1, &context, note_string, string), ==, FR_OK);
    fr_document_free(document);
    fr_source_unref(source);
    return string;
}

// L-system 2 of the paper, word for word, with functions for f, g and h.
#define SIZES                                                                                      \
    "derivation length: 6\nf(i) = 2 + 4*i\ng(i) = 1 + 2*i\nh(i) = 0.8 - 0.6*i\n"                   \
    "w : AI(?)F(0)I(?)W(0)\np1 : A -> I(?)F(0)[+(8)I(?)L(0)]A\np2 : I(i) < W(0) -> W(fi)\n"        \
    "p3 : I(i) < L(0) -> L(gi)\np4 : I(i) < F(0) -> F(hi)"

/// R14: in the dark internodes are long, leaves and flowers small; in full light the other way.
static void test_sizes(void) {
    static const struct {
        const char *place, *flower, *leaf;
        float length;
    } rows[] = {{"<place plant='p'/>", "W(6)", "L(3)", 0.2f},
                {"<place plant='p' at='40, 0, 0'/>", "W(2)", "L(1)", 0.8f}};
    for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
        char *text = g_strconcat(
            DOCUMENT(SIZES, "<light near='8' relative='yes' reference='9, 0, 5'/>"
                            "<lamp kind='spot' at='0, 0, 100000' angle='1' power='100000'/>"
                            "<obstacle at='40, 0, 40' size='20, 20, 0.1'/>@"),
            NULL);
        char **halves = g_strsplit(text, "@", 2);
        char *whole = g_strjoin(rows[i].place, halves[0], halves[1], NULL);
        Built built = build(whole);
        const FrPlant *plant = plant_at(&built, 0);
        g_assert_cmpuint(plant->nodes.count, >=, 6);
        g_assert_cmpfloat_with_epsilon(plant->nodes.length[0], rows[i].length, 0.002f);
        forget(&built);
        GString *string = string_of(whole);
        g_test_message("%s", string->str);
        char *flower = strstr(string->str, "W("), *leaf = strstr(string->str, "]AI(");
        g_assert_nonnull(leaf);
        double size = g_ascii_strtod(flower + 2, NULL),
               wanted = g_ascii_strtod(rows[i].flower + 2, NULL);
        g_assert_cmpfloat_with_epsilon(size, wanted, 0.02);
        // The last leaf is still to come, the one before it has its size.
        leaf = strstr(string->str, "L(");
        wanted = g_ascii_strtod(rows[i].leaf + 2, NULL);
        int grown = 0;
        for (; leaf != NULL; leaf = strstr(leaf + 1, "L(")) {
            size = g_ascii_strtod(leaf + 2, NULL);
            g_assert_true(size == 0 || fabs(size - wanted) < 0.02);
            grown += size > 0;
        }
        g_assert_cmpint(grown, ==, 5);
        g_string_free(string, TRUE);
        g_free(whole);
        g_strfreev(halves);
        g_free(text);
    }
}

// L-system 3 of the paper, word for word; p2 of L-system 1 turns the branch.
#define COMBINED                                                                                   \
    "derivation length: 20\nf(i) = 24*i\nw : A\np1 : A -> I(?)WF(1)A\np2 : I(i) < W -> R(?,fi)\n"  \
    "p3 : R(r,p) -> \\(r)&(p)/(r)"

/// R15: how far a branch bends at most is a function of the light; in the dark it stays straight.
static void test_combined(void) {
    static const float intensities[] = {0, 0.125f, 0.25f, 0.5f};
    for (int k = 0; k < 4; k++) {
        // 100 m away, 53 degrees from straight up.
        double power = 4 * G_PI * 1e4 * (double)intensities[k];
        char *text = g_strdup_printf(DOCUMENT(COMBINED, "<light near='40'/><lamp at='-80, 0, 60' "
                                                        "power='%.3f'/><place plant='p'/>"),
                                     power);
        Built built = build(text);
        const FrPlant *plant = plant_at(&built, 0);
        g_assert_cmpuint(plant->nodes.count, >=, 19);
        for (uint32_t i = 1; i < 4; i++) {
            float bend = glms_vec3_angle(fr_frame_heading(plant->nodes.frame[i - 1]),
                                         fr_frame_heading(plant->nodes.frame[i]));
            g_test_message("%.3f: %.3f degrees", (double)intensities[k], (double)glm_deg(bend));
            float limit = 24 * intensities[k];
            g_assert_cmpfloat_with_epsilon(glm_deg(bend), limit, 0.02f + 0.1f * limit);
        }
        vec3s heading = fr_frame_heading(plant->nodes.frame[18]);
        g_assert_cmpfloat(heading.x, <=, k == 0 ? 1e-6f : -0.5f);
        g_assert_cmpfloat(fabsf(heading.y), <, 0.01f);
        forget(&built);
        g_free(text);
    }
}

/// R13: a leaf that may turn as far as it wants has its normal within five degrees of the light.
static void test_leaves(void) {
    static const vec3s lamp = {{3, -2, 4}};
    Built built = build(
        DOCUMENT("Lsystem: 1\nderivation length: 5\naxiom: A(0)\n"
                 "A(n) : n < 2 --> F(0.1)[/(40)&(70)N][/(160)&(50)N][/(280)&(80)N]F(0.1)A(n+1)\n"
                 "N --> F(0.3)^(90)R(?,?)&(90)L\nR(r,p) --> \\(r)&(p)/(r)\nhomomorphism\n"
                 "L --> {.+(30)f(0.1).-(60)f(0.1).-(120)f(0.1).}\nendlsystem",
                 "<light near='0.5'/><lamp at='3, -2, 4' power='100'/><place plant='p'/>"));
    const FrPlant *plant = plant_at(&built, 0);
    FrContext context = fr_context_default();
    FrSkinParams skin = fr_skin_default();
    FrMesh *mesh;
    g_assert_cmpint(fr_skin_plant(plant, &skin, FR_UP_Z, &context, &mesh), ==, FR_OK);
    uint32_t count = 0;
    for (uint32_t p = 0; p < mesh->part_count; p++) {
        const FrMeshPart *part = &mesh->parts[p];
        for (uint64_t i = 0; part->is_foliage && i < part->index_count; i += 3) {
            vec3s corner[3];
            for (uint64_t c = 0; c < 3; c++) {
                const uint32_t index = mesh->indices[part->first_index + i + c];
                memcpy(corner[c].raw, mesh->vertices[part->first_vertex + index].position,
                       sizeof corner[c].raw);
            }
            vec3s normal = glms_vec3_crossn(glms_vec3_sub(corner[1], corner[0]),
                                            glms_vec3_sub(corner[2], corner[0]));
            vec3s way = glms_vec3_normalize(glms_vec3_sub(lamp, corner[0]));
            g_assert_cmpfloat(fabsf(glms_vec3_dot(normal, way)), >, cosf(glm_rad(5)));
            count++;
        }
    }
    g_assert_cmpuint(count, >=, 6);
    fr_mesh_free(mesh);
    forget(&built);
}

/// A plate read from a file shades as the same plate made of a box does.
static void test_mesh_shade(void) {
    char *previous = g_get_current_dir(), *folder = g_dir_make_tmp("frond-XXXXXX", NULL);
    g_assert_cmpint(g_chdir(folder), ==, 0);
    const char *plate = "v -20 0 -10\nv 20 0 -10\nv 20 0 10\nv -20 0 10\nf 1 4 3 2\n";
    g_assert_true(g_file_set_contents("plate.obj", plate, -1, NULL));
    Built built = build(DOCUMENT(SHADE, "<light near='0.01' relative='yes' reference='0, 0, 1'/>"
                                        "<lamp at='0, 0, 50' power='1000'/>"
                                        "<obstacle shape='mesh' file='plate.obj' at='32, 0, 20'/>"
                                        "<place plant='p'/><place plant='p' at='40, 0, 0'/>"));
    g_assert_cmpuint(plant_at(&built, 0)->organs.count, ==, 1);
    g_assert_cmpuint(plant_at(&built, 1)->organs.count, ==, 0);
    g_assert_cmpuint(plant_at(&built, 1)->nodes.count, ==, 6);
    forget(&built);
    g_assert_cmpint(g_unlink("plate.obj"), ==, 0);
    g_assert_cmpint(g_chdir(previous), ==, 0);
    g_assert_cmpint(g_rmdir(folder), ==, 0);
    g_free(folder);
    g_free(previous);
}

/// A plant shades the one below it from the step on in which it spreads over it.
static void test_neighbours(void) {
    Built built =
        build(DOCUMENT("derivation length: 3\nw : I(?)A\np1 : I(i) < A : i > 0.5 -> "
                       "F(0.2)[&(90)f(-2)+(90)f(2)-(90){.f(4).-(90)f(4).-(90)f(4).}]I(?)A",
                       "<light near='0.01' relative='yes' reference='0, 9, 1'/>"
                       "<lamp at='0, 0, 50' power='1000'/><place plant='p' at='0, 0, 3'/>"
                       "<place plant='p' at='0.5, 0, 0'/>"));
    g_assert_cmpuint(plant_at(&built, 0)->nodes.count, ==, 3);
    g_assert_cmpuint(plant_at(&built, 1)->nodes.count, ==, 1);
    forget(&built);
}

#define CROWD(by)                                                                                  \
    DOCUMENT("derivation length: 5\nw : I(?)A\np1 : I(i) < A -> "                                  \
             "F(0.1+0.1*i)R(?,20)[+(40)I(?)A]/(90)[-(50)I(?)A]I(?)A\np2 : R(r,p) -> "              \
             "\\(r)&(p)/(r)",                                                                      \
             "<light by='" by "' photons='3000' distance='0.3' cell='0.1'/>" LAMP                  \
             "<place plant='p'/><place plant='p' at='0.4, 0.3, 0'/>"                               \
             "<obstacle at='0, 0, -0.2' size='3, 3, 0.1'/>")

static void test_threads(void) {
    static const char *const texts[] = {CROWD("views"), CROWD("density"), CROWD("shadows")};
    static const int threads[] = {1, 2, 3, 8};
    for (size_t k = 0; k < G_N_ELEMENTS(texts); k++) {
        FrDigest first = 0;
        for (size_t i = 0; i < G_N_ELEMENTS(threads); i++) {
            FrContext context = fr_context_default();
            context.pool = fr_pool_new(threads[i]);
            Built built = build_with(texts[k], context);
            FrDigest digest = fr_scene_digest(built.scene);
            first = i == 0 ? digest : first;
            g_assert_cmpuint(digest, ==, first);
            g_assert_cmpuint(plant_at(&built, 0)->nodes.count, >, 100);
            forget(&built);
            fr_pool_free(context.pool);
        }
    }
}

/// A clock that shows so many frames has let plants grow so many steps.
static void test_frames(void) {
    const char *text = DOCUMENT(BENDING, "<light near='0.1'/>" LAMP "<place plant='p'/>");
    FrContext context = fr_context_default();
    FrDocument *document;
    FrSource *source = fr_source_new("frames.frond", text, strlen(text));
    g_assert_cmpint(fr_document_parse(source, NULL, &context, &document), ==, FR_OK);
    double frame = fr_document_scene(document)->frame_time;
    static const uint32_t frames[] = {0, 7, 30, 99}, nodes[] = {0, 7, 30, 30};
    for (int i = 0; i < 4; i++) {
        FrScene *scene;
        g_assert_cmpint(fr_scene_build_at(document, -1, frame * frames[i], &context, &scene), ==,
                        FR_OK);
        const FrPlant *plant = g_array_index(scene->plants, FrScenePlant, 0).plant;
        g_assert_cmpuint(plant->nodes.count, ==, nodes[i]);
        fr_scene_free(scene);
    }
    fr_document_free(document);
    fr_source_unref(source);
}

/// Without a `<light>` the L-system's own environment answers, and equal plants are one.
static void test_without_light(void) {
    Built built =
        build(DOCUMENT(BENDING, LAMP "<place plant='p'/><place plant='p' at='1, 0, 0'/>"));
    g_assert_cmpuint(built.scene->plants->len, ==, 1);
    g_assert_cmpuint(built.scene->steps->len, ==, 0);
    forget(&built);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/scene/growing/a mesh from a file shades", test_mesh_shade);
    g_test_add_func("/scene/growing/a branch bends to the lamp, by so much a step", test_bending);
    g_test_add_func("/scene/growing/the sun shines on plants however tall they grow", test_tall);
    g_test_add_func("/scene/growing/turned and scaled plants lean to the same lamp", test_stands);
    g_test_add_func("/scene/growing/shade makes long internodes and no flowers", test_shade);
    g_test_add_func("/scene/growing/R14 light sets the sizes of L-system 2", test_sizes);
    g_test_add_func("/scene/growing/R15 light limits how L-system 3 bends", test_combined);
    g_test_add_func("/scene/growing/R13 a leaf turns its face to the light", test_leaves);
    g_test_add_func("/scene/growing/plants shade each other", test_neighbours);
    g_test_add_func("/scene/growing/the bits are the same for any number of threads", test_threads);
    g_test_add_func("/scene/growing/plants grow a step a frame", test_frames);
    g_test_add_func("/scene/growing/without a light everything is as before", test_without_light);
    return g_test_run();
}
