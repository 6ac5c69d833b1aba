/// Directions to the light on a grid.
#include "frond/light_field.h"
#include "frond/sky_views.h"

#include "rectangles.h"

#include <math.h>

static FrLight *lamp_light(Plate *plate, const FrLamp *lamp) {
    FrContext context = fr_context_default();
    FrSkyViewSettings settings = fr_sky_views_default();
    vec3s corner = {{-1, -1, -50}}, x = {{2, 0, 0}}, y = {{0, 2, 0}};
    plate_init(plate, rectangle(corner, x, y), lamp, 1);
    FrLight *light = fr_sky_views_new(&settings);
    g_assert_cmpint(fr_light_set_scene(light, &plate->scene, &context), ==, FR_OK);
    return light;
}

/// A plant that is half as large, turned by a right angle and stands at (3, 1, 2).
static void test_directions(void) {
    FrLamp lamp = {.kind = FR_LAMP_POINT, .power = 1, .position = {{9, 4, 5}}};
    Plate plate;
    FrLight *light = lamp_light(&plate, &lamp);
    FrLightPlace place = {{3, 1, 2}, G_PI_2, 0.5};
    FrContext context = fr_context_default();
    FrLightField *field;
    vec3s min = {{-1, -1, 0}}, max = {{1, 1, 4}};
    g_assert_cmpint(fr_light_field_new(light, &place, min, max, 16, &context, &field), ==, FR_OK);
    g_assert_cmpuint(field->count[0], ==, 9);
    g_assert_cmpuint(field->count[2], ==, 17);
    for (int i = 0; i < 50; i++) {
        vec3s at = {{-0.9f + 0.036f * (float)i, 0.8f - 0.03f * (float)i, 0.07f * (float)i}};
        // In the plant's coordinates the lamp is at ((4 − 1), −(9 − 3), 5 − 2) twice as far.
        vec3s to_lamp = glms_vec3_sub((vec3s){{6, -12, 6}}, at);
        float off = glms_vec3_angle(fr_light_field_at(field, at), to_lamp);
        g_assert_cmpfloat(glm_deg(off), <, 0.5f);
    }
    vec3s far = {{0.3f, 0.2f, 400}}, top = {{0.3f, 0.2f, 4}};
    g_assert_cmpfloat(
        glms_vec3_distance(fr_light_field_at(field, far), fr_light_field_at(field, top)), <, 1e-6f);
    vec3s nowhere = {{NAN, INFINITY, -INFINITY}};
    g_assert_true(isfinite(fr_light_field_at(field, nowhere).x));
    fr_light_field_free(field);
    fr_light_free(light);
    plate_clear(&plate);
}

static void test_point(void) {
    FrLamp lamp = {.kind = FR_LAMP_POINT, .power = 1, .position = {{0, 0, 5}}};
    Plate plate;
    FrLight *light = lamp_light(&plate, &lamp);
    FrLightPlace place = {.scale = 1};
    FrContext context = fr_context_default();
    FrLightField *field;
    vec3s zero = glms_vec3_zero();
    g_assert_cmpint(fr_light_field_new(light, &place, zero, zero, 1, &context, &field), ==, FR_OK);
    g_assert_cmpfloat(fr_light_field_at(field, zero).z, >, 0.999f);
    fr_light_field_free(field);
    fr_light_free(light);
    plate_clear(&plate);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/light/light_field/directions are those of the plant's own coordinates",
                    test_directions);
    g_test_add_func("/light/light_field/a box without extent has a field", test_point);
    return g_test_run();
}
