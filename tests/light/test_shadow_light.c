/// Shadow voxels as a backend of light.
#include "frond/shadows.h"

#include "rectangles.h"

#include <math.h>

static FrLightAnswer ask(const FrLightScene *scene, vec3s at) {
    FrContext context = fr_context_default();
    FrShadowLightSettings settings = fr_shadow_light_default();
    FrLight *light = fr_shadow_light_new(&settings);
    FrLightAnswer answer;
    g_assert_cmpint(fr_light_set_scene(light, scene, &context), ==, FR_OK);
    g_assert_cmpint(fr_light_query(light, &at, 1, &context, &answer), ==, FR_OK);
    fr_light_free(light);
    return answer;
}

static const FrLamp sky = {.kind = FR_LAMP_SKY, .power = 1};

static Plate *table(float half) {
    Plate *plate = g_new(Plate, 1);
    plate_init(plate,
               rectangle((vec3s){{-half, -half, 1.1f}}, (vec3s){{2 * half, 0, 0}},
                         (vec3s){{0, 2 * half, 0}}),
               &sky, 1);
    return plate;
}

static void test_below_plate(void) {
    Plate *plate = table(1);
    FrLightAnswer below = ask(&plate->scene, (vec3s){{0, 0, 0.9f}});
    FrLightAnswer lower = ask(&plate->scene, (vec3s){{0, 0, 0.5f}});
    FrLightAnswer above = ask(&plate->scene, (vec3s){{0, 0, 1.5f}});
    FrLightAnswer beside = ask(&plate->scene, (vec3s){{3, 0, 0.5f}});
    g_assert_cmpfloat(below.intensity, <, 0.95f);
    g_assert_cmpfloat(lower.intensity, >, below.intensity);
    g_assert_cmpfloat(above.intensity, ==, 1);
    g_assert_cmpfloat(above.direction.z, ==, 1);
    g_assert_cmpfloat(beside.intensity, ==, 1);
    // In the open light comes from all of the sky alike, at an edge rather from one side.
    g_assert_cmpfloat(above.confidence, ==, 0);
    g_assert_cmpfloat(beside.confidence, ==, 0);
    FrLightAnswer edge = ask(&plate->scene, (vec3s){{1, 0, 0.7f}});
    g_assert_cmpfloat(edge.direction.x, >, 0);
    g_assert_cmpfloat(edge.confidence, >, 0);
    g_assert_cmpfloat(edge.confidence, <=, 1);
    plate_clear(plate);
    g_free(plate);
}

/// The same table in many triangles casts the same shadow: what counts is its area.
static void test_triangles(void) {
    Plate *whole = table(1);
    FrMesh *quarter = rectangle((vec3s){{0, 0, 1.1f}}, (vec3s){{1, 0, 0}}, (vec3s){{0, 1, 0}});
    Plate parts;
    plate_init(&parts, quarter, &sky, 1);
    FrLightStand stands[4];
    for (int i = 0; i < 4; i++) {
        vec3s by = {{(float)(i % 2) - 1, (float)(i / 2) - 1, 0}};
        stands[i] = (FrLightStand){0, glms_translate(glms_mat4_identity(), by)};
    }
    parts.scene.stands = stands;
    parts.scene.stand_count = 4;
    vec3s at = {{0.13f, 0.31f, 0.7f}};
    g_assert_cmpfloat_with_epsilon(ask(&parts.scene, at).intensity,
                                   ask(&whole->scene, at).intensity, 0.02f);
    plate_clear(whole);
    g_free(whole);
    plate_clear(&parts);
}

/// Shadows fall from suns and skies; lamps alone leave it dark, and then nothing is relative to it.
static void test_dark(void) {
    static const FrLamp lamps[2] = {{.kind = FR_LAMP_POINT, .power = 9, .position = {{0, 0, 3}}},
                                    {.kind = FR_LAMP_SUN, .direction = {{0, 0, -1}}}};
    Plate *plate = table(1);
    plate->scene.lamps = lamps;
    plate->scene.lamp_count = 2; // the sun has no power
    FrLightAnswer answer = ask(&plate->scene, (vec3s){{0, 0, 3}});
    g_assert_cmpfloat(answer.intensity, ==, 0);
    g_assert_cmpfloat(glms_vec3_norm(answer.direction), ==, 0);
    plate->scene.has_reference = true;
    plate->scene.reference = (vec3s){{0, 0, 3}};
    FrSource *source = fr_source_new("x", "reference", 9);
    plate->scene.span = (FrSpan){source, 0, 9};
    FrContext context = fr_context_default();
    context.diags = fr_diags_new();
    FrShadowLightSettings settings = fr_shadow_light_default();
    FrLight *light = fr_shadow_light_new(&settings);
    g_assert_cmpint(fr_light_set_scene(light, &plate->scene, &context), ==, FR_ERR_DOCUMENT);
    g_assert_cmpstr(fr_diags_get(context.diags, 0)->code, ==, "dark-reference");
    g_assert_cmpuint(fr_diags_get(context.diags, 0)->span.end, ==, 9);
    fr_light_free(light);
    fr_diags_free(context.diags);
    fr_source_unref(source);
    plate_clear(plate);
    g_free(plate);
}

/// What the voxels take is counted first, and said where they were asked for.
static void test_limit(void) {
    Plate *plate = table(1);
    FrContext context = fr_context_default();
    context.diags = fr_diags_new();
    context.limits.bytes = 10000;
    FrSource *source = fr_source_new("x", "light", 5);
    FrShadowLightSettings settings = fr_shadow_light_default();
    settings.span = (FrSpan){source, 1, 5};
    FrLight *light = fr_shadow_light_new(&settings);
    g_assert_cmpint(fr_light_set_scene(light, &plate->scene, &context), ==, FR_ERR_LIMIT);
    g_assert_cmpstr(fr_diags_get(context.diags, 0)->code, ==, "limit-bytes");
    g_assert_cmpuint(fr_diags_get(context.diags, 0)->span.begin, ==, 1);
    context.limits = fr_limits_default();
    g_assert_cmpint(fr_light_set_scene(light, &plate->scene, &context), ==, FR_OK);
    fr_light_free(light);
    fr_diags_free(context.diags);
    fr_source_unref(source);
    plate_clear(plate);
    g_free(plate);
}

static void test_huge(void) {
    Plate *plate = table(1e6f);
    FrLightAnswer below = ask(&plate->scene, (vec3s){{0, 0, 0.5f}});
    g_assert_true(isfinite(below.intensity));
    plate_clear(plate);
    g_free(plate);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/light/shadow_light/it is darker below a plate and lighter beside it",
                    test_below_plate);
    g_test_add_func("/light/shadow_light/shadows go by area, not by triangles", test_triangles);
    g_test_add_func("/light/shadow_light/it is dark without sun and sky", test_dark);
    g_test_add_func("/light/shadow_light/voxels are counted before they are made", test_limit);
    g_test_add_func("/light/shadow_light/voxels grow with a huge scene", test_huge);
    return g_test_run();
}
