// What Lintermann and Deussen say of all components together, by the ids of docs/paper-1.md.
#include "graphs.h"

#include "../skin/mesh_check.h"

#include <cglm/struct.h>
#include <math.h>

// ---- S1 ---------------------------------------------------------------------------------------

enum { GEOMETRY = 1, MULTIPLIER = 2 };

// What a component with one leaf on it by a branch link turns out to do.
static int class_of(FrComponentKind kind) {
    char *text = g_strdup_printf("%s K %s\nleaf L\nK = L", fr_pgraph_table(kind)->element,
                                 kind == FR_COMPONENT_REVO ? "outline=0.1,0 0.1,0.2" : "");
    Built built = build(text);
    uint32_t component = fr_pgraph_find(built.graph, "K");
    bool is_there = false;
    for (uint32_t i = 0; i < built.plant->axes.count; i++) {
        is_there |= built.plant->axes.component[i] == component;
    }
    for (uint32_t i = 0; i < built.plant->organs.count; i++) {
        is_there |= built.plant->organs.component[i] == component;
    }
    int found = (is_there ? GEOMETRY : 0) | (built_count(&built, "L") > 1 ? MULTIPLIER : 0);
    built_free(built);
    g_free(text);
    return found;
}

static void classes(void) {
    static const struct {
        FrComponentKind kind;
        int what;
    } rows[] = {
        {FR_COMPONENT_CAMERA, 0},           {FR_COMPONENT_SIMPLE, GEOMETRY},
        {FR_COMPONENT_REVO, GEOMETRY},      {FR_COMPONENT_HORN, GEOMETRY},
        {FR_COMPONENT_LEAF, GEOMETRY},      {FR_COMPONENT_TREE, GEOMETRY | MULTIPLIER},
        {FR_COMPONENT_HYDRA, MULTIPLIER},   {FR_COMPONENT_WREATH, MULTIPLIER},
        {FR_COMPONENT_PHIBALL, MULTIPLIER}, {FR_COMPONENT_FFD, 0},
        {FR_COMPONENT_HYPERPATCH, 0},       {FR_COMPONENT_WORLD, 0},
    };
    for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
        g_test_message("%s", fr_pgraph_table(rows[i].kind)->element);
        g_assert_cmpint(class_of(rows[i].kind), ==, rows[i].what);
    }
}

// ---- S8 ---------------------------------------------------------------------------------------

static FrMesh *skinned(const Built *built) {
    FrSkinParams params = fr_skin_default();
    FrContext context = fr_context_default();
    FrMesh *mesh;
    g_assert_cmpint(fr_skin_plant(built->plant, &params, FR_UP_Z, &context, &mesh), ==, FR_OK);
    return mesh;
}

static void joined_sets(void) {
    // A square as cross-section, so that its sides can be counted; the first set stands at 0.5.
    Built chain = build("simple A primitive=tube;size=.2;section=1,1 -1,1 -1,-1 1,-1;depth=4;"
                        "translate-z=.5\nA - A");
    Built horn = build("horn H course=steps;steps=4;step-translate=0,0,.5;radius=.1;"
                       "section=1,1 -1,1 -1,-1 1,-1;translate-z=.5");
    FrMesh *a = skinned(&chain), *b = skinned(&horn);
    // Three bands of four quads, and two ends of two triangles.
    g_assert_cmpuint(a->index_count / 3, ==, 3 * 4 * 2 + 2 * 2);
    CheckTopology topology = check_topology(a);
    g_assert_cmpint(topology.euler, ==, 2);
    g_assert_cmpuint(topology.open, ==, 0);
    g_assert_cmpuint(a->vertex_count, ==, b->vertex_count);
    for (uint64_t i = 0; i < a->vertex_count; i++) {
        g_assert_cmpfloat(glms_vec3_distance(check_at(&a->vertices[i]), check_at(&b->vertices[i])),
                          <, 1e-5F);
    }
    fr_mesh_free(a);
    fr_mesh_free(b);
    built_free(chain);
    built_free(horn);
}

// ---- B7 ---------------------------------------------------------------------------------------

static void every_number_varies(void) {
    uint32_t numbers = 0;
    for (int kind = 0; kind < FR_COMPONENT_COUNT; kind++) {
        const FrParamTable *table = fr_pgraph_table((FrComponentKind)kind);
        char *params = g_malloc(table->struct_size);
        fr_params_init(table, params);
        for (size_t i = 0; i < table->count; i++) {
            const FrParam *row = &table->rows[i];
            if (row->kind != FR_PARAM_NUMBER) {
                continue;
            }
            double from = MAX(row->min, -3), to = MIN(row->max, 5);
            char *text = g_strdup_printf("%.9g..%.9g : t^2 | order 0,1 1,0.5", from, to);
            FrDiags *diags = fr_diags_new();
            g_assert_cmpint(fr_params_set(table, params, row, text, (FrSpan){0}, NULL, diags), ==,
                            FR_OK);
            FrVars vars = {.value = {[FR_VAR_t] = 0.5, [FR_VAR_order] = 1}};
            const FrNumber *number = (const FrNumber *)(const void *)(params + row->offset);
            double scale = strcmp(row->unit, "deg") == 0 ? G_PI / 180 : 1;
            double expected = CLAMP((from + 0.25 * (to - from)) * 0.5, row->min, row->max) * scale;
            g_assert_cmpfloat_with_epsilon(fr_number_eval(number, &vars, 0, NULL), expected, 1e-6);
            fr_diags_free(diags);
            g_free(text);
            numbers++;
        }
        fr_params_clear(table, params);
        g_free(params);
    }
    g_assert_cmpuint(numbers, >, 250);
}

// ---- C15 --------------------------------------------------------------------------------------

static void lower_branches_only(void) {
    static const char *const text = "tree A number=20;start=0;branching-angle=%s\n"
                                    "horn B length=1;segments=1\nA = B";
    char *plain = g_strdup_printf(text, "45"), *curved = g_strdup_printf(text, "45 | x 0,2 0.3,1");
    Built one = build(plain), two = build(curved);
    for (uint32_t b = 1; b <= 20; b++) {
        double x = (b - 0.5) / 20;
        uint32_t node = one.plant->axes.first[b];
        bool is_same = memcmp(&one.plant->nodes.frame[node], &two.plant->nodes.frame[node],
                              sizeof(versors)) == 0;
        g_assert_true(is_same == (x >= 0.3));
    }
    built_free(one);
    built_free(two);
    g_free(plain);
    g_free(curved);
}

// ---- C26 --------------------------------------------------------------------------------------

/// The places of `n` children on a unit sphere's section.
static Built section_of(uint32_t n, double opening, double closing) {
    char *text = g_strdup_printf(
        "phiball P number=%u;radius=1;opening=%g;closing=%g\nsimple S\nP - S", n, opening, closing);
    Built built = build(text);
    g_free(text);
    return built;
}

static void children_keep_apart(void) {
    static const double sections[][2] = {{0, 180},  {0, 90},  {0, 20},  {10, 80},
                                         {60, 120}, {85, 95}, {30, 150}};
    static const uint32_t sizes[] = {10, 11, 20, 50, 100, 300, 700};
    for (size_t s = 0; s < G_N_ELEMENTS(sections); s++) {
        for (size_t k = 0; k < G_N_ELEMENTS(sizes); k++) {
            uint32_t n = sizes[k];
            Built built = section_of(n, sections[s][0], sections[s][1]);
            const vec3s *at = built.plant->organs.offset;
            double nearest = 10,
                   area = 2 * G_PI *
                          (cos(sections[s][0] * G_PI / 180) - cos(sections[s][1] * G_PI / 180));
            for (uint32_t a = 0; a < n; a++) {
                for (uint32_t b = 0; b < a; b++) {
                    nearest = fmin(nearest, (double)glms_vec3_distance(at[a], at[b]));
                }
            }
            g_assert_cmpfloat(nearest * sqrt(n / area), >=, 0.870);
            built_free(built);
        }
    }
}

// How evenly a whole sphere is divided: points of another spiral are counted for the nearest child.
static void children_have_equal_room(void) {
    enum { CHILDREN = 100, POINTS = 400000 };
    Built built = section_of(CHILDREN, 0, 180);
    const vec3s *at = built.plant->organs.offset;
    double room[CHILDREN] = {0};
    for (uint32_t i = 0; i < POINTS; i++) {
        double z = 1 - (2 * i + 1.0) / POINTS, ring = sqrt(1 - z * z), turn = 2.39996322973 * i;
        vec3s point = {{(float)(ring * cos(turn)), (float)(ring * sin(turn)), (float)z}};
        uint32_t best = 0;
        for (uint32_t k = 1; k < CHILDREN; k++) {
            best = glms_vec3_dot(at[k], point) > glms_vec3_dot(at[best], point) ? k : best;
        }
        room[best] += 1;
    }
    double mean = (double)POINTS / CHILDREN, squares = 0;
    for (uint32_t k = 0; k < CHILDREN; k++) {
        squares += (room[k] - mean) * (room[k] - mean);
    }
    g_assert_cmpfloat(sqrt(squares / CHILDREN) / mean, <, 0.03);
    built_free(built);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
#define TEST(name, function) g_test_add_func("/pgraph/" name, function)
    TEST("S1 components produce, multiply or do neither as the paper says", classes);
    TEST("S8 four cross-sections are one closed tube of three bands", joined_sets);
    TEST("B7 every number of every component is a range with a function", every_number_varies);
    TEST("C15 a curve changes the angle of lower branches only", lower_branches_only);
    TEST("C26 children keep 0.870 of the mean distance apart", children_keep_apart);
    TEST("C26 children have equal room", children_have_equal_room);
    return g_test_run();
}
