#include "trees.h"

#include <math.h>
#include <string.h>

static void fresh_rows(void) {
    FrPlant *plant = fr_plant_new("rows");
    g_assert_cmpuint(fr_plant_append_nodes(plant, 3), ==, 0);
    g_assert_cmpuint(fr_plant_append_nodes(plant, 100), ==, 3);
    for (uint32_t i = 0; i < 103; i++) {
        g_assert_cmpuint(plant->nodes.parent[i], ==, FR_NONE);
        g_assert_cmpfloat(plant->nodes.rotation[i].w, ==, 1);
        g_assert_cmpfloat(plant->nodes.frame[i].w, ==, 1);
        g_assert_cmpfloat(plant->nodes.flatness[i], ==, 1);
        g_assert_cmpfloat(plant->nodes.length[i], ==, 0);
    }
    uint32_t organ = fr_plant_append_organs(plant, 2);
    g_assert_cmpfloat(plant->organs.scale[organ + 1], ==, 1);
    g_assert_cmpuint(plant->organs.material[organ + 1], ==, FR_NONE);
    uint32_t bud = fr_plant_append_buds(plant, 1);
    g_assert_cmpuint(plant->buds.node[bud], ==, FR_NONE);
    g_assert_cmpuint(fr_plant_append_axes(plant, 0), ==, 0);
    fr_plant_free(plant);
}

static void budget(void) {
    FrPlant *plant = fr_plant_new("budget");
    fr_plant_append_nodes(plant, 1000);
    g_assert_cmpuint(fr_plant_bytes(plant), <=, 72 * 1000);
    fr_plant_free(plant);
}

static FrShape leaf(float length) {
    FrShape shape = {.kind = FR_SHAPE_BLADE};
    shape.blade = (FrBlade){.length = length,
                            .width = 0.05f,
                            .outline = FR_NONE,
                            .along_curve = FR_NONE,
                            .across_curve = FR_NONE,
                            .segments_along = 4,
                            .segments_across = 1};
    return shape;
}

static void equal_shapes(void) {
    FrPlant *plant = fr_plant_new("shapes");
    FrShape a = leaf(0.1f);
    FrShape b = leaf(0.2f);
    FrShape box = {.kind = FR_SHAPE_BOX, .size = {{1, 1, 1}}, .detail = 4};
    g_assert_cmpuint(fr_plant_add_shape(plant, &a), ==, 0);
    g_assert_cmpuint(fr_plant_add_shape(plant, &b), ==, 1);
    g_assert_cmpuint(fr_plant_add_shape(plant, &a), ==, 0);
    g_assert_cmpuint(fr_plant_add_shape(plant, &box), ==, 2);
    box.blade.length = 3; // means nothing for a box
    g_assert_cmpuint(fr_plant_add_shape(plant, &box), ==, 2);
    box.size.x = 2;
    g_assert_cmpuint(fr_plant_add_shape(plant, &box), ==, 3);
    a.detail = 7; // means nothing for a blade
    g_assert_cmpuint(fr_plant_add_shape(plant, &a), ==, 0);
    g_assert_cmpuint(plant->shapes->len, ==, 4);
    fr_plant_free(plant);
}

static void equal_profiles(void) {
    static const double square[4][2] = {{1, 1}, {-1, 1}, {-1, -1}, {1, -1}};
    double own[4][2];
    memcpy(own, square, sizeof own);
    FrPlant *plant = fr_plant_new("profiles");
    g_assert_cmpuint(fr_plant_add_profile(plant, (const double(*)[2])own, 4, true), ==, 0);
    own[0][0] = 2; // the plant has its own copy
    g_assert_cmpuint(fr_plant_add_profile(plant, square, 4, true), ==, 0);
    g_assert_cmpuint(fr_plant_add_profile(plant, square, 4, false), ==, 1);
    g_assert_cmpuint(fr_plant_add_profile(plant, square, 3, true), ==, 2);
    g_assert_cmpuint(fr_plant_add_profile(plant, NULL, 0, true), ==, 3);
    g_assert_cmpuint(fr_plant_add_profile(plant, NULL, 0, true), ==, 3);
    fr_plant_free(plant);
}

static void materials(void) {
    FrMaterialParams params;
    fr_params_init(fr_material_table(), &params);
    FrMaterial *bark = fr_material_new("bark", &params, ".", (FrSpan){0});
    FrMaterial *other = fr_material_new("bark", &params, ".", (FrSpan){0});
    FrPlant *plant = fr_plant_new("materials");
    g_assert_cmpuint(fr_plant_add_material(plant, bark), ==, 0);
    g_assert_cmpuint(fr_plant_add_material(plant, other), ==, 1);
    g_assert_cmpuint(fr_plant_add_material(plant, bark), ==, 0);
    fr_material_unref(bark);
    fr_material_unref(other);
    FrPlant *copy = fr_plant_copy(plant);
    fr_plant_free(plant);
    g_assert_cmpstr(fr_material_name(g_ptr_array_index(copy->materials, 1)), ==, "bark");
    fr_plant_free(copy);
    fr_params_clear(fr_material_table(), &params);
}

static void components_keep_their_source(void) {
    FrSource *source = fr_source_new("oak.frond", "<tree id='trunk'/>", 18);
    FrPlant *plant = fr_plant_new("components");
    fr_plant_add_component(plant, "trunk", (FrSpan){source, 1, 5});
    fr_source_unref(source);
    FrPlant *copy = fr_plant_copy(plant);
    fr_plant_free(plant);
    const FrComponent *component = &g_array_index(copy->components, FrComponent, 0);
    g_assert_cmpstr(component->id, ==, "trunk");
    g_assert_cmpstr(fr_source_name(component->span.source), ==, "oak.frond");
    fr_plant_free(copy);
}

static void copies(void) {
    static const double line[2][2] = {{0, 0}, {1, 1}};
    FrPlant *plant = tree_perfect(6);
    FrShape shape = leaf(0.1f);
    fr_plant_append_organs(plant, 5);
    for (uint32_t o = 0; o < 5; o++) {
        plant->organs.shape[o] = fr_plant_add_shape(plant, &shape);
    }
    fr_plant_add_profile(plant, line, 2, false);
    FrPlant *copy = fr_plant_copy(plant);
    assert_valid(copy);
    g_assert_cmpuint(fr_plant_digest(copy), ==, fr_plant_digest(plant));
    g_assert_cmpstr(copy->name, ==, "tree");
    // It is its own: changing and growing it leaves the first alone.
    FrDigest before = fr_plant_digest(plant);
    copy->nodes.length[3] = 9;
    fr_plant_add_node(copy, 0, GLMS_QUAT_IDENTITY, 1, 1);
    g_assert_cmpuint(fr_plant_add_shape(copy, &shape), ==, 0);
    g_assert_cmpuint(fr_plant_digest(plant), ==, before);
    assert_valid(copy);
    fr_plant_free(plant);
    fr_plant_free(copy);
}

static FrPlant *sound(void) {
    FrPlant *plant = tree_perfect(4);
    FrShape shape = leaf(0.1f);
    fr_plant_append_organs(plant, 2);
    fr_plant_append_buds(plant, 1);
    plant->organs.node[0] = 3;
    plant->organs.shape[0] = plant->organs.shape[1] = fr_plant_add_shape(plant, &shape);
    plant->buds.node[0] = 1;
    assert_valid(plant);
    return plant;
}

static void wrong_plants(void) {
    // Each row spoils one thing of a sound plant.
#define SPOIL(statement, words)                                                                    \
    {                                                                                              \
        FrPlant *plant = sound();                                                                  \
        char *why = NULL;                                                                          \
        statement;                                                                                 \
        g_assert_false(fr_plant_is_valid(plant, &why));                                            \
        g_assert_nonnull(strstr(why, words));                                                      \
        g_assert_false(fr_plant_is_valid(plant, NULL));                                            \
        g_free(why);                                                                               \
        fr_plant_free(plant);                                                                      \
    }
    SPOIL(plant->nodes.parent[3] = 5, "comes before its parent");
    SPOIL(plant->nodes.parent[3] = 3, "comes before its parent");
    SPOIL(plant->nodes.next[3] = 2, "next node");
    SPOIL(plant->nodes.next[0] = 99, "next node");
    SPOIL(plant->nodes.next[0] = FR_NONE, "ends at node");
    SPOIL(plant->nodes.axis[2] = 77, "is on axis");
    SPOIL(plant->nodes.axis[1] = 1, "of axis");
    SPOIL(plant->nodes.parent[3] = 0, "has parent");
    SPOIL(plant->nodes.length[2] = -1, "length");
    SPOIL(plant->nodes.length[2] = NAN, "length");
    SPOIL(plant->nodes.radius[2] = INFINITY, "radius");
    SPOIL(plant->nodes.rotation[2].w = 0.5f, "unit quaternion");
    SPOIL(plant->nodes.rotation[2].x = NAN, "unit quaternion");
    SPOIL(plant->axes.first[1] = 400, "runs from");
    SPOIL(plant->axes.last[1] = FR_NONE, "runs from");
    SPOIL(plant->axes.bearer[1] = 15, "is borne by");
    SPOIL(plant->axes.bearer[1] = plant->axes.first[2], "that bears it");
    SPOIL(plant->axes.material[1] = 0, "out of range");
    SPOIL(plant->axes.offset[1].y = NAN, "offset");
    SPOIL(fr_plant_append_nodes(plant, 1); plant->nodes.axis[15] = 0, "on no axis");
    SPOIL(plant->organs.node[1] = 15, "is borne by");
    SPOIL(plant->organs.shape[1] = FR_NONE, "has shape");
    SPOIL(plant->organs.scale[1] = 0, "organ 1");
    SPOIL(plant->organs.component[1] = 0, "out of range");
    SPOIL(plant->buds.node[0] = 15, "sits on");
    SPOIL(plant->buds.kind[0] = 9, "has kind");
    SPOIL(g_array_index(plant->shapes, FrShape, 0).blade.outline = 0, "shape 0");
#undef SPOIL
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/plant/builder/fresh rows hold neutral values", fresh_rows);
    g_test_add_func("/plant/builder/an internode takes at most 72 bytes", budget);
    g_test_add_func("/plant/builder/equal shapes are one", equal_shapes);
    g_test_add_func("/plant/builder/equal profiles are one and copied", equal_profiles);
    g_test_add_func("/plant/builder/the same material is one, with a reference of the plant's",
                    materials);
    g_test_add_func("/plant/builder/components keep the text they point into",
                    components_keep_their_source);
    g_test_add_func("/plant/builder/a copy is equal and independent", copies);
    g_test_add_func("/plant/builder/every kind of broken plant is found", wrong_plants);
    return g_test_run();
}
