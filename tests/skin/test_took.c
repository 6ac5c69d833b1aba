// What wood takes to skin. How long that is is the machine's; what stays is not.
#include "mesh_check.h"

enum { STEMS = 640 };

// A long stem, many short ones, and a component that has none.
static FrPlant *thicket(float radius) {
    FrPlant *plant = fr_plant_new("thicket");
    fr_plant_add_component(plant, "long", (FrSpan){0});
    fr_plant_add_component(plant, "short", (FrSpan){0});
    fr_plant_add_component(plant, "none", (FrSpan){0});
    check_stem(plant, FR_NONE, 4, 4.0F, 0.1F, radius, check_straight, check_straight);
    plant->axes.component[0] = 0;
    for (uint32_t i = 1; i <= STEMS; i++) {
        check_stem(plant, FR_NONE, 4, 1.0F, 0.1F, 0.05F, check_straight, check_straight);
        plant->axes.component[i] = 1;
        plant->axes.offset[i].x = (float)i;
    }
    g_assert_true(fr_plant_is_valid(plant, NULL));
    return plant;
}

static void seconds_of(const FrSkin *skin, const FrPlant *plant, double seconds[3]) {
    fr_skin_seconds(skin, plant, seconds);
    for (int c = 0; c < 3; c++) {
        g_assert_cmpfloat(seconds[c], >=, 0);
        g_assert_cmpfloat(seconds[c], <, 100);
    }
    g_assert_cmpfloat(seconds[2], ==, 0);
}

static void test_shares(void) {
    FrContext context = fr_context_default();
    FrSkinParams params = fr_skin_default();
    FrSkin *skin = fr_skin_new(&params, FR_UP_Z);
    FrPlant *plant = thicket(0.1F);
    double seconds[3];
    seconds_of(skin, plant, seconds); // before there is one
    g_assert_cmpfloat(seconds[1], ==, 0);
    g_assert_cmpint(fr_skin_update(skin, plant, false, &context), ==, FR_OK);
    seconds_of(skin, plant, seconds);
    g_assert_cmpfloat(seconds[0], >, 0);
    g_assert_cmpfloat(seconds[1], >, 0);
    fr_skin_free(skin);
    fr_plant_free(plant);
}

// What stands already keeps the time that it took.
static void test_kept(void) {
    FrContext context = fr_context_default();
    FrSkinParams params = fr_skin_default();
    FrSkin *skin = fr_skin_new(&params, FR_UP_Z);
    double before[3], after[3];
    FrPlant *plant = thicket(0.1F), *other = thicket(0.09F);
    g_assert_cmpint(fr_skin_update(skin, plant, false, &context), ==, FR_OK);
    seconds_of(skin, plant, before);
    g_assert_cmpint(fr_skin_update(skin, other, false, &context), ==, FR_OK);
    g_assert_cmpuint(fr_skin_work(skin).runs_written, ==, 1);
    seconds_of(skin, other, after);
    g_assert_cmpfloat(after[1], ==, before[1]);
    fr_skin_free(skin);
    fr_plant_free(plant);
    fr_plant_free(other);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/skin/took/wood has a time, and a component without any has none",
                    test_shares);
    g_test_add_func("/skin/took/what stands already keeps its time", test_kept);
    return g_test_run();
}
