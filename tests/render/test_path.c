#include "render/path.h"

#include "render/camera.h"
#include "world_by_hand.h"

static const vec3s down = {{0, 0, -1}};

static vec3s grey(float value) {
    return (vec3s){{value, value, value}};
}

/// The mean light along a ray.
static vec3s look_along(const FrWorld *world, vec3s origin, vec3s direction, uint32_t samples,
                        uint32_t bounces) {
    double sum[3] = {0, 0, 0};
    for (uint32_t i = 0; i < samples; i++) {
        FrSampler sampler = fr_sampler(5, 9, i, samples);
        FrPathSample sample = fr_path_trace(world, origin, direction, &sampler, bounces);
        for (int c = 0; c < 3; c++) {
            sum[c] += (double)sample.radiance.raw[c] / samples;
        }
    }
    return (vec3s){{(float)sum[0], (float)sum[1], (float)sum[2]}};
}

static void test_furnace_ground(void) {
    FrWorld *world =
        fr_world_new(fr_sky_new_uniform(grey(0.7f), false), fr_ground_new(grey(1.0f), 0.0f));
    fr_world_commit(world);
    vec3s slant = glms_vec3_normalize((vec3s){{0.5f, 0.3f, -0.6f}});
    vec3s seen = look_along(world, (vec3s){{1, 2, 3}}, slant, 1024, 6);
    g_assert_cmpfloat_with_epsilon(seen.g, 0.7, 0.007);
    vec3s hazy = {{1.0f, 0.0f, -0.01f}};
    world->ground->haze = 50.0f;
    seen = look_along(world, (vec3s){{1, 2, 3}}, glms_vec3_normalize(hazy), 1024, 6);
    g_assert_cmpfloat_with_epsilon(seen.g, 0.7, 0.007);
    fr_world_free(world);
}

// Two white blades in a sharp groove: light goes to and fro many times and none may get lost.
static void test_furnace_groove(void) {
    FrWorld *world = fr_world_new(fr_sky_new_uniform(grey(1.0f), true), NULL);
    uint32_t mesh = fr_world_add_mesh(world, square(), matt(grey(1.0f), 0.0f));
    mat4s identity = glms_mat4_identity();
    fr_world_add_stand(world, mesh, glms_rotate(identity, 0.6f, (vec3s){{1, 0, 0}}));
    fr_world_add_stand(world, mesh, glms_rotate(identity, -0.6f, (vec3s){{1, 0, 0}}));
    fr_world_commit(world);
    vec3s seen = look_along(world, (vec3s){{0.2f, -0.3f, 4}}, down, 4096, 64);
    g_assert_cmpfloat_with_epsilon(seen.g, 1.0, 0.01);
    fr_world_free(world);
}

// Half of the light goes through the blade, half comes back: seen from anywhere it is as bright as
// what surrounds it.
static void test_furnace_leaf(void) {
    FrWorld *world = fr_world_new(fr_sky_new_uniform(grey(1.0f), true), NULL);
    uint32_t mesh = fr_world_add_mesh(world, square(), matt(grey(1.0f), 0.5f));
    fr_world_add_stand(world, mesh, glms_mat4_identity());
    fr_world_commit(world);
    vec3s seen = look_along(world, (vec3s){{0.2f, -0.3f, 4}}, down, 1024, 6);
    g_assert_cmpfloat_with_epsilon(seen.g, 1.0, 0.01);
    fr_world_free(world);
}

// Lambert's law: a matt sphere of albedo ρ under a sun of irradiance E shows ρ E cos θ / π.
static void test_sphere(void) {
    FrSky *sky = fr_sky_new_uniform(glms_vec3_zero(), true);
    fr_sky_set_sun(sky, (vec3s){{0, 0, 1}}, (vec3s){{3.0f, 2.0f, 1.0f}});
    FrWorld *world = fr_world_new(sky, NULL);
    uint32_t mesh = fr_world_add_mesh(world, sphere(), matt(grey(0.6f), 0.0f));
    fr_world_add_stand(world, mesh, glms_scale_uni(glms_mat4_identity(), 2.0f));
    fr_world_commit(world);
    for (float degrees = 10.0f; degrees < 80.0f; degrees += 15.0f) {
        float angle = degrees * FR_PI_F / 180.0f;
        vec3s outwards = {{sinf(angle) * 0.8f, sinf(angle) * 0.6f, cosf(angle)}};
        vec3s seen =
            look_along(world, glms_vec3_scale(outwards, 5.0f), glms_vec3_negate(outwards), 64, 0);
        float want = 0.6f * cosf(angle) / FR_PI_F;
        g_assert_cmpfloat_with_epsilon(seen.r, 3.0f * want, 0.01);
        g_assert_cmpfloat_with_epsilon(seen.g, 2.0f * want, 0.01);
        g_assert_cmpfloat_with_epsilon(seen.b, want, 0.01);
    }
    vec3s dark = look_along(world, (vec3s){{0, 0.1f, -5}}, (vec3s){{0, 0, 1}}, 16, 6);
    g_assert_true(fr_is_black(dark));
    fr_world_free(world);
}

// What comes through a blade lit from behind is its translucent part.
static void test_backlight(void) {
    FrSky *sky = fr_sky_new_uniform(glms_vec3_zero(), true);
    fr_sky_set_sun(sky, (vec3s){{0, 0, 1}}, grey(1.0f));
    FrWorld *world = fr_world_new(sky, NULL);
    uint32_t mesh = fr_world_add_mesh(world, square(), matt(grey(0.8f), 0.25f));
    fr_world_add_stand(world, mesh, glms_mat4_identity());
    fr_world_commit(world);
    vec3s above = look_along(world, (vec3s){{0.3f, 0.3f, 2}}, down, 16, 0);
    vec3s below = look_along(world, (vec3s){{0.3f, 0.3f, -2}}, (vec3s){{0, 0, 1}}, 16, 0);
    g_assert_cmpfloat_with_epsilon(above.g, 0.8 * 0.75 / G_PI, 1e-4);
    g_assert_cmpfloat_with_epsilon(below.g, 0.8 * 0.25 / G_PI, 1e-4);
    fr_world_free(world);
}

// The parts of a surface that is mirror, clear glass, blade and matt at once sum up to its colour.
static void test_furnace_straight(void) {
    static const float parts[4][3] = {{1, 0, 0}, {0, 1, 0}, {0.3f, 0.6f, 0.5f}, {0.5f, 0.5f, 0}};
    for (int i = 0; i < 4; i++) {
        FrWorld *world = fr_world_new(fr_sky_new_uniform(grey(1.0f), true), NULL);
        FrLook *look = matt(grey(1.0f), parts[i][2]);
        look->mirror = parts[i][0];
        look->clear = parts[i][1];
        uint32_t mesh = fr_world_add_mesh(world, square(), look);
        mat4s identity = glms_mat4_identity();
        fr_world_add_stand(world, mesh, glms_rotate(identity, 0.6f, (vec3s){{1, 0, 0}}));
        fr_world_add_stand(world, mesh, glms_rotate(identity, -0.6f, (vec3s){{1, 0, 0}}));
        fr_world_commit(world);
        vec3s seen = look_along(world, (vec3s){{0.2f, -0.3f, 4}}, down, 4096, 64);
        g_assert_cmpfloat_with_epsilon(seen.g, 1.0, 0.01);
        fr_world_free(world);
    }
}

// A matt square below a pane: light of sun and sky comes down through the pane and up again.
static void test_glass(void) {
    FrSky *sky = fr_sky_new_uniform(grey(0.2f), true);
    fr_sky_set_sun(sky, (vec3s){{0, 0, 1}}, grey(1.0f));
    FrWorld *world = fr_world_new(sky, NULL);
    FrLook *glass = matt((vec3s){{0.9f, 0.8f, 0.5f}}, 0.0f);
    glass->clear = 1.0f;
    uint32_t floor = fr_world_add_mesh(world, square(), matt(grey(0.6f), 0.0f));
    uint32_t pane = fr_world_add_mesh(world, square(), glass);
    fr_world_add_stand(world, floor, glms_mat4_identity());
    mat4s above = glms_translate(glms_mat4_identity(), (vec3s){{0, 0, 0.5f}});
    fr_world_add_stand(world, pane, glms_scale_uni(above, 200.0f));
    fr_world_commit(world);
    for (uint32_t bounces = 0; bounces < 4; bounces += 3) {
        vec3s seen = look_along(world, (vec3s){{0.2f, 0.3f, 2}}, down, 4096, bounces);
        for (int c = 0; c < 3; c++) {
            double through = (double)glass->tint.raw[c];
            double want = through * through * 0.6 * (1.0 / G_PI + 0.2);
            g_assert_cmpfloat_with_epsilon((double)seen.raw[c], want, 0.01 * want);
        }
    }
    fr_world_free(world);
}

// In a mirror at 45 degrees a matt square below is as bright as seen straight, times what the
// mirror throws back; and the sun is seen in it.
static void test_mirror(void) {
    FrSky *sky = fr_sky_new_uniform(glms_vec3_zero(), true);
    fr_sky_set_sun(sky, (vec3s){{-0.6f, 0, 0.8f}}, grey(1.0f));
    FrWorld *world = fr_world_new(sky, NULL);
    FrLook *silver = matt(grey(0.8f), 0.0f);
    silver->mirror = 1.0f;
    uint32_t floor = fr_world_add_mesh(world, square(), matt(grey(0.6f), 0.0f));
    uint32_t mirror = fr_world_add_mesh(world, square(), silver);
    fr_world_add_stand(world, floor, glms_mat4_identity());
    mat4s high = glms_translate(glms_mat4_identity(), (vec3s){{0, 0, 5}});
    fr_world_add_stand(world, mirror, glms_rotate(high, 0.25f * FR_PI_F, (vec3s){{0, 1, 0}}));
    fr_world_commit(world);
    vec3s seen = look_along(world, (vec3s){{-4, 0.2f, 5}}, (vec3s){{1, 0, 0}}, 64, 1);
    g_assert_cmpfloat_with_epsilon(seen.g, 0.8 * 0.6 * 0.8 / G_PI, 1e-4);
    FrSampler sampler = fr_sampler(5, 9, 0, 1);
    FrPathSample sample =
        fr_path_trace(world, (vec3s){{-4, 0.2f, 5}}, (vec3s){{1, 0, 0}}, &sampler, 1);
    g_assert_cmpfloat_with_epsilon(sample.albedo.g, 0.6, 1e-6);
    fr_sky_set_sun(sky, (vec3s){{-1, 0, 0}}, grey(1.0f));
    seen = look_along(world, (vec3s){{0, 0.2f, 2}}, (vec3s){{0, 0, 1}}, 64, 1);
    g_assert_cmpfloat(seen.g, >, 5.0f);
    fr_world_free(world);
}

// A green leaf lit from behind is yellower and more saturated than lit from the front.
static void test_leaf_colours(void) {
    FrDecoder decoder;
    fr_decoder_init(&decoder);
    FrLook *look = matt((vec3s){{0.08f, 0.2f, 0.04f}}, 0.5f);
    FrBsdf bsdf;
    fr_look_scattering(look, &decoder, 0, 0, true, &bsdf);
    g_assert_cmpfloat(bsdf.transmittance.g, >, bsdf.reflectance.g);
    g_assert_cmpfloat(bsdf.transmittance.b / bsdf.transmittance.g, <,
                      0.5f * bsdf.reflectance.b / bsdf.reflectance.g);
    for (int c = 0; c < 3; c++) {
        g_assert_cmpfloat(bsdf.transmittance.raw[c] + bsdf.reflectance.raw[c], <=, 1.0f);
    }
    look->tint = (vec3s){{0.9f, 0.4f, 0.5f}};
    fr_look_scattering(look, &decoder, 0, 0, true, &bsdf);
    g_assert_cmpfloat_with_epsilon(bsdf.transmittance.r, 0.45f, 1e-6);
    g_assert_cmpfloat_with_epsilon(bsdf.transmittance.g, 0.2f, 1e-6);
    g_free(look);
}

// The left half of the picture is a hole: sun and eye go through it.
static void test_mask(void) {
    FrImage *picture = fr_image_new(64, 4, 4);
    for (int i = 0; i < 64 * 4; i++) {
        memset(picture->pixels + 4 * i, 255, 3);
        picture->pixels[4 * i + 3] = i % 64 < 32 ? 0 : 255;
    }
    FrSky *sky = fr_sky_new_uniform(glms_vec3_zero(), false);
    fr_sky_set_sun(sky, (vec3s){{0, 0, 1}}, grey(FR_PI_F));
    FrWorld *world = fr_world_new(sky, fr_ground_new(grey(0.5f), 0.0f));
    FrLook *look = matt(grey(0.1f), 0.0f);
    look->colour = picture;
    look->has_holes = true;
    look->cutoff = 127.5f;
    uint32_t mesh = fr_world_add_mesh(world, square(), look);
    fr_world_add_stand(world, mesh, glms_translate(glms_mat4_identity(), (vec3s){{0, 0, 1}}));
    fr_world_commit(world);
    // From above: ground through the hole, the blade beside it; u = 0 is at x = −1.
    vec3s hole = look_along(world, (vec3s){{-0.5f, 0, 3}}, down, 16, 0);
    vec3s blade = look_along(world, (vec3s){{0.5f, 0, 3}}, down, 16, 0);
    g_assert_cmpfloat_with_epsilon(hole.g, 0.5, 1e-3);
    g_assert_cmpfloat_with_epsilon(blade.g, 0.1, 1e-3);
    // From below the blade: the ground lies in its shadow.
    vec3s shade = look_along(world, (vec3s){{0.5f, 0, 0.5f}}, down, 16, 0);
    g_assert_true(fr_is_black(shade));
    fr_world_free(world);
    fr_image_unref(picture);
}

// A green stem often has its leaves' material: their picture's border is no gap in the stem.
static void test_stem_with_picture_of_leaf(void) {
    FrMaterialParams params;
    fr_params_init(fr_material_table(), &params);
    params.texture = FR_TEXTURE_LEAF;
    params.size = 64;
    FrMaterial *material = fr_material_new("green", &params, ".", (FrSpan){0});
    FrContext context = fr_context_default();
    for (int is_foliage = 0; is_foliage < 2; is_foliage++) {
        FrLook look;
        g_assert_cmpint(fr_look_init(&look, material, is_foliage == 1, &context), ==, FR_OK);
        g_assert_true(fr_look_is_hole(&look, 0.02f, 0.02f) == (is_foliage == 1));
        g_assert_false(fr_look_is_hole(&look, 0.5f, 0.5f));
    }
    fr_material_unref(material);
    fr_params_clear(fr_material_table(), &params);
}

static void test_camera(void) {
    FrWorld *world = fr_world_new(fr_sky_new_uniform(grey(1), true), NULL);
    uint32_t mesh = fr_world_add_mesh(world, sphere(), matt(grey(1), 0));
    fr_world_add_stand(
        world, mesh,
        glms_scale(glms_translate(glms_mat4_identity(), (vec3s){{3, -2, 7}}), (vec3s){{1, 2, 5}}));
    fr_world_commit(world);
    static const float aspects[] = {0.2f, 0.8f, 3.0f};
    for (size_t a = 0; a < G_N_ELEMENTS(aspects); a++) {
        FrViewParams view = {.azimuth = 0.7, .elevation = 0.35, .field_of_view = 0.87, .zoom = 1};
        FrCamera camera = fr_camera_frame(world, &view, aspects[a]);
        float min_x = 1, max_x = 0, min_y = 1, max_y = 0;
        for (int y = 0; y < 200; y++) {
            for (int x = 0; x < 200; x++) {
                float px = ((float)x + 0.5f) / 200;
                float py = ((float)y + 0.5f) / 200;
                FrSurface surface;
                if (fr_world_trace(world, camera.origin, fr_camera_direction(&camera, px, py),
                                   &surface) == FR_MET_PLANT) {
                    min_x = fminf(min_x, px);
                    max_x = fmaxf(max_x, px);
                    min_y = fminf(min_y, py);
                    max_y = fmaxf(max_y, py);
                }
            }
        }
        // The tighter pair of margins has 6 %; perspective leaves the other a little uneven.
        g_assert_cmpfloat_with_epsilon(fminf(min_x, min_y), 0.06, 0.012);
        g_assert_cmpfloat_with_epsilon(min_x, 1 - max_x, 0.04);
        g_assert_cmpfloat_with_epsilon(min_y, 1 - max_y, 0.04);
    }
    fr_world_free(world);
}

// Azimuth counts from −y, counter-clockwise seen from above, as the document says.
static void test_camera_side(void) {
    FrWorld *world = fr_world_new(fr_sky_new_uniform(grey(1), true), NULL);
    fr_world_commit(world);
    FrViewParams view = {.azimuth = 0, .elevation = 0, .field_of_view = 0.7, .zoom = 1};
    FrCamera camera = fr_camera_frame(world, &view, 1);
    g_assert_cmpfloat(camera.origin.y, <, -1.0f);
    g_assert_cmpfloat_with_epsilon(camera.origin.x, 0, 1e-4);
    view.azimuth = 0.5 * G_PI;
    FrCamera right = fr_camera_frame(world, &view, 1);
    g_assert_cmpfloat(right.origin.x, >, 1.0f);
    view.zoom = 2;
    FrCamera near = fr_camera_frame(world, &view, 1);
    g_assert_cmpfloat_with_epsilon(near.distance, 0.5f * right.distance, 1e-4);
    view.look_at = (vec3s){{0, 0, 5}};
    FrCamera lifted = fr_camera_frame(world, &view, 1);
    g_assert_cmpfloat_with_epsilon(lifted.origin.z, near.origin.z + 5, 1e-4);
    fr_world_free(world);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/render/path/white ground is as bright as a uniform sky", test_furnace_ground);
    g_test_add_func("/render/path/no light is lost in a white groove", test_furnace_groove);
    g_test_add_func("/render/path/a white blade vanishes in a white surrounding",
                    test_furnace_leaf);
    g_test_add_func("/render/path/a matt sphere in the sun follows Lambert's law", test_sphere);
    g_test_add_func("/render/path/light from behind shines through by its part", test_backlight);
    g_test_add_func("/render/path/mirror, glass, blade and matt share one light",
                    test_furnace_straight);
    g_test_add_func("/render/path/sun and sky shine through glass, and are seen through it",
                    test_glass);
    g_test_add_func("/render/path/a mirror shows what is around the corner", test_mirror);
    g_test_add_func("/render/path/light through leaves is yellower, through petals unchanged",
                    test_leaf_colours);
    g_test_add_func("/render/path/holes let sun and eye through", test_mask);
    g_test_add_func("/render/path/a stem shows no gaps of its leaves' picture",
                    test_stem_with_picture_of_leaf);
    g_test_add_func("/render/camera/a scene fills its frame but for six per cent", test_camera);
    g_test_add_func("/render/camera/views count from −y and from the middle", test_camera_side);
    return g_test_run();
}
