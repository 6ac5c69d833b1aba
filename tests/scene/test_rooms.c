/// The rooms of the examples: what the paper's figures 6 to 8 show, as numbers.
#include "frond/scene.h"

#include <cglm/struct.h>
#include <math.h>
#include <string.h>

typedef struct Built {
    FrDocument *document;
    FrScene *scene;
} Built;

/// An example with fewer photons, after so many steps.
static Built build(const char *name, const char *steps) {
    Built built;
    FrContext context = fr_context_default();
    context.pool = fr_pool_new(2);
    char *path = g_build_filename(g_getenv("FROND_SOURCE"), "examples", name, NULL);
    g_assert_cmpint(fr_document_load(path, &context, &built.document), ==, FR_OK);
    g_assert_cmpint(fr_document_set(built.document, "light.photons", "30000", &context), ==, FR_OK);
    g_assert_cmpint(fr_document_set(built.document, "lsystem.steps", steps, &context), ==, FR_OK);
    g_assert_cmpint(fr_scene_build(built.document, -1, &context, &built.scene), ==, FR_OK);
    fr_pool_free(context.pool);
    g_free(path);
    return built;
}

static void forget(Built *built) {
    fr_scene_free(built->scene);
    fr_document_free(built->document);
}

static const FrPlant *plant_at(const Built *built, guint index) {
    return g_array_index(built->scene->plants, FrScenePlant, index).plant;
}

enum { UNDER_TABLE, ON_TABLE, IN_MIDDLE, BY_WALL };

/// Where the plant's hearts of flowers are, in the world.
static GArray *flowers_of(const Built *built, guint index) {
    GArray *flowers = g_array_new(FALSE, FALSE, sizeof(vec3s));
    const FrPlant *plant = plant_at(built, index);
    const double *at = g_array_index(built->scene->stands, FrStand, index).at;
    for (uint32_t i = 0; i < plant->organs.count; i++) {
        const char *name =
            fr_material_name(g_ptr_array_index(plant->materials, plant->organs.material[i]));
        if (strcmp(name, "heart") == 0) {
            vec3s position;
            versors rotation;
            fr_plant_organ_pose(plant, i, &position, &rotation);
            vec3s base = {{(float)at[0], (float)at[1], (float)at[2]}};
            position = glms_vec3_add(position, base);
            g_array_append_val(flowers, position);
        }
    }
    return flowers;
}

static guint count_flowers(const Built *built, guint index) {
    GArray *flowers = flowers_of(built, index);
    guint count = flowers->len;
    g_array_unref(flowers);
    return count;
}

/// How far the main stem's end stands from the vertical through its base, in degrees.
static double lean_of(const Built *built, guint index) {
    const FrPlant *plant = plant_at(built, index);
    vec3s tip = plant->nodes.position[plant->axes.last[0]];
    double lean = atan2(hypot((double)tip.x, (double)tip.y), (double)tip.z) * 180 / G_PI;
    g_test_message("plant %u leans by %.1f degrees", index, lean);
    return lean;
}

static void test_flowers(void) {
    Built built = build("room-flowers.frond", "30");
    double under = lean_of(&built, UNDER_TABLE), on = lean_of(&built, ON_TABLE);
    double middle = lean_of(&built, IN_MIDDLE);
    g_assert_cmpfloat(under, >, 45);
    g_assert_cmpfloat(on, >, middle);
    g_assert_cmpfloat(on, <, under);
    g_assert_cmpfloat(middle, <, 20);
    // It leans to the middle of the room.
    const FrPlant *plant = plant_at(&built, UNDER_TABLE);
    g_assert_cmpfloat(plant->nodes.position[plant->axes.last[0]].x, >, 0.3f);
    for (guint i = UNDER_TABLE; i <= BY_WALL; i++) {
        g_assert_cmpuint(count_flowers(&built, i), >, 0);
    }
    GArray *flowers = flowers_of(&built, UNDER_TABLE);
    for (guint i = 0; i < flowers->len; i++) {
        vec3s at = g_array_index(flowers, vec3s, i);
        g_test_message("a flower at %.2f, %.2f, %.2f", (double)at.x, (double)at.y, (double)at.z);
        bool is_below = at.x < -0.75f && at.y > 0.5f && at.z < 0.72f;
        g_assert_false(is_below);
    }
    g_array_unref(flowers);
    forget(&built);
}

/// Figure 8: while the plant is still below the table it has no flowers; those in the light have.
static void test_before(void) {
    Built built = build("room-flowers.frond", "14");
    g_assert_cmpuint(count_flowers(&built, UNDER_TABLE), ==, 0);
    g_assert_cmpuint(count_flowers(&built, IN_MIDDLE), >, 0);
    // In the dark internodes are long.
    const FrPlant *dark = plant_at(&built, UNDER_TABLE), *lit = plant_at(&built, IN_MIDDLE);
    g_assert_cmpfloat(dark->nodes.length[2], >, 1.3f * lit->nodes.length[2]);
    forget(&built);
}

/// Area of the leaves, in squares of their unit, on the side of the lamps and on the other.
static void leaf_area(const FrPlant *plant, double sides[2]) {
    sides[0] = sides[1] = 0;
    for (uint32_t i = 0; i < plant->organs.count; i++) {
        vec3s position;
        versors rotation;
        fr_plant_organ_pose(plant, i, &position, &rotation);
        double scale = (double)plant->organs.scale[i];
        sides[position.x > 0 ? 0 : 1] += scale * scale;
    }
}

static void test_bushes(void) {
    Built built = build("room-bushes.frond", "8");
    double all[3];
    for (guint i = 0; i < 3; i++) {
        double sides[2];
        leaf_area(plant_at(&built, i), sides);
        all[i] = sides[0] + sides[1];
        g_test_message("bush %u: %.3f to the lamps, %.3f away", i, sides[0], sides[1]);
        g_assert_cmpfloat(sides[0], >, 2.5 * sides[1]);
        g_assert_cmpfloat(sides[0], <, 3.3 * sides[1]);
    }
    g_assert_cmpfloat(all[2], >, 1.5 * all[0]);
    g_assert_cmpfloat(all[1], >, all[0]);
    forget(&built);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/scene/rooms/the plant below the table leans out and flowers in the light",
                    test_flowers);
    g_test_add_func("/scene/rooms/it does not flower before it has left the shade", test_before);
    g_test_add_func("/scene/rooms/bushes are denser where there is more light", test_bushes);
    return g_test_run();
}
