#include "render/bsdf.h"

#include "render/colour.h"
#include "render/sampler.h"

#include <glib.h>
#include <math.h>

enum { SAMPLES = 1 << 15 };

static FrBsdf plain(vec3s reflectance, vec3s transmittance) {
    vec3s up = glms_vec3_normalize((vec3s){{0.2f, -0.4f, 0.9f}});
    return (FrBsdf){.normal = up,
                    .side = up,
                    .reflectance = reflectance,
                    .transmittance = transmittance,
                    .rough_a = 1.0f};
}

static vec3s tilted(const FrBsdf *bsdf, float degrees) {
    vec3s x;
    vec3s y;
    fr_basis(bsdf->normal, &x, &y);
    float angle = degrees * FR_PI_F / 180.0f;
    return glms_vec3_add(glms_vec3_scale(bsdf->normal, cosf(angle)),
                         glms_vec3_scale(x, sinf(angle)));
}

static vec3s uniform_direction(uint32_t i, float *density) {
    FrSampler sampler = fr_sampler(0, 0, i, SAMPLES);
    float u;
    float v;
    fr_sampler_pair(&sampler, &u, &v);
    float z = 2.0f * u - 1.0f;
    float side = sqrtf(fmaxf(0.0f, 1.0f - z * z));
    float turn = 2.0f * FR_PI_F * v;
    *density = 0.25f / FR_PI_F;
    return (vec3s){{side * cosf(turn), side * sinf(turn), z}};
}

/// The part of the light of a uniform white surrounding that is scattered, by sampling.
static double albedo(const FrBsdf *bsdf, vec3s out) {
    double sum = 0.0;
    for (uint32_t i = 0; i < SAMPLES; i++) {
        FrSampler sampler = fr_sampler(1, 0, i, SAMPLES);
        float u;
        float v;
        float density;
        vec3s in;
        vec3s factor;
        fr_sampler_pair(&sampler, &u, &v);
        if (fr_bsdf_sample(bsdf, out, fr_sampler_single(&sampler), u, v, &in, &factor, &density)) {
            sum += (double)factor.g;
        }
    }
    return sum / SAMPLES;
}

/// The same by directions spread evenly; `densities` receives the integral of the density.
static double albedo_evenly(const FrBsdf *bsdf, vec3s out, double *densities) {
    double sum = 0.0;
    *densities = 0.0;
    for (uint32_t i = 0; i < SAMPLES; i++) {
        float density;
        vec3s in = uniform_direction(i, &density);
        sum += (double)(fr_bsdf_eval(bsdf, out, in).g / density);
        *densities += (double)(fr_bsdf_density(bsdf, out, in) / density) / SAMPLES;
    }
    return sum / SAMPLES;
}

static void test_matt(void) {
    vec3s grey = {{0.4f, 0.4f, 0.4f}};
    vec3s rest = {{0.6f, 0.6f, 0.6f}};
    FrBsdf bsdf = plain(grey, glms_vec3_zero());
    g_assert_cmpfloat_with_epsilon(albedo(&bsdf, tilted(&bsdf, 30)), 0.4, 1e-4);
    bsdf = plain(grey, rest);
    g_assert_cmpfloat_with_epsilon(albedo(&bsdf, tilted(&bsdf, 70)), 1.0, 1e-4);
}

static void test_sides(void) {
    vec3s grey = {{0.4f, 0.4f, 0.4f}};
    vec3s rest = {{0.3f, 0.3f, 0.3f}};
    FrBsdf bsdf = plain(grey, rest);
    vec3s out = tilted(&bsdf, 10);
    vec3s front = tilted(&bsdf, 60);
    vec3s back = tilted(&bsdf, 120);
    g_assert_cmpfloat_with_epsilon(fr_bsdf_eval(&bsdf, out, front).g, 0.4f * 0.5f / FR_PI_F, 1e-6);
    g_assert_cmpfloat_with_epsilon(fr_bsdf_eval(&bsdf, out, back).g, 0.3f * 0.5f / FR_PI_F, 1e-6);
}

// Sampling and evaluation must be of the same function, and densities must integrate to one (to
// less where sampled facets reflect below the horizon).
static void test_coat(void) {
    static const float widths[] = {0.15f, 0.4f, 1.0f};
    static const float angles[] = {5, 45, 75};
    for (size_t w = 0; w < G_N_ELEMENTS(widths); w++) {
        for (size_t a = 0; a < G_N_ELEMENTS(angles); a++) {
            vec3s white = {{0.5f, 0.5f, 0.5f}};
            FrBsdf bsdf = plain(white, white);
            bsdf.coat = 0.04f;
            bsdf.coat_width = widths[w];
            vec3s out = tilted(&bsdf, angles[a]);
            double densities;
            double evenly = albedo_evenly(&bsdf, out, &densities);
            double sampled = albedo(&bsdf, out);
            g_assert_cmpfloat_with_epsilon(sampled, evenly, 0.01);
            g_assert_cmpfloat(sampled, <, 1.0);
            g_assert_cmpfloat(sampled, >, 0.7);
            g_assert_cmpfloat(densities, <, 1.01);
            g_assert_cmpfloat(densities, >, 0.85);
        }
    }
}

static void test_reciprocity(void) {
    vec3s grey = {{0.4f, 0.4f, 0.4f}};
    FrBsdf bsdf = plain(grey, grey);
    bsdf.coat = 0.04f;
    bsdf.coat_width = 0.3f;
    fr_bsdf_set_roughness(&bsdf, 0.5f);
    for (uint32_t i = 0; i < 1000; i++) {
        float density;
        vec3s out = uniform_direction(i, &density);
        vec3s in = uniform_direction(SAMPLES - 1 - i, &density);
        float out_cosine = glms_vec3_dot(bsdf.normal, out);
        float in_cosine = glms_vec3_dot(bsdf.normal, in);
        if (out_cosine < 0.05f || in_cosine < 0.05f) {
            continue;
        }
        float forth = fr_bsdf_eval(&bsdf, out, in).g / in_cosine;
        float back = fr_bsdf_eval(&bsdf, in, out).g / out_cosine;
        g_assert_cmpfloat_with_epsilon(forth, back, 1e-4 * (double)fmaxf(forth, 1.0f));
    }
}

// Oren and Nayar 1994: σ = 0 is Lambert; σ = 30° has A = 1 − 0.5 σ²/(σ² + 0.33) = 0.7731 and
// B = 0.45 σ²/(σ² + 0.09) = 0.3388; light from the viewer's side at grazing angles is brighter.
static void test_rough(void) {
    FrBsdf bsdf = plain(glms_vec3_one(), glms_vec3_zero());
    fr_bsdf_set_roughness(&bsdf, 0.0f);
    g_assert_cmpfloat(bsdf.rough_a, ==, 1.0f);
    g_assert_cmpfloat(bsdf.rough_b, ==, 0.0f);
    fr_bsdf_set_roughness(&bsdf, FR_PI_F / 6.0f);
    g_assert_cmpfloat_with_epsilon(bsdf.rough_a, 0.7731, 2e-4);
    g_assert_cmpfloat_with_epsilon(bsdf.rough_b, 0.3388, 2e-4);
    vec3s out = tilted(&bsdf, 60);
    float retro = fr_bsdf_eval(&bsdf, out, out).g;
    // α = β = 60°: A + B sin 60° tan 60° = 0.7731 + 0.3388 · 1.5.
    g_assert_cmpfloat_with_epsilon(retro, 0.5f / FR_PI_F * 1.2813f, 3e-4);
    g_assert_cmpfloat(fr_bsdf_eval(&bsdf, out, tilted(&bsdf, -60)).g, <, retro);
}

static void test_black(void) {
    FrBsdf bsdf = plain(glms_vec3_zero(), glms_vec3_zero());
    vec3s in;
    vec3s factor;
    float density;
    g_assert_false(fr_bsdf_sample(&bsdf, bsdf.normal, 0.5f, 0.3f, 0.2f, &in, &factor, &density));
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/render/bsdf/a white matt blade keeps all light", test_matt);
    g_test_add_func("/render/bsdf/both sides get their share", test_sides);
    g_test_add_func("/render/bsdf/a coat is sampled as it is evaluated", test_coat);
    g_test_add_func("/render/bsdf/reflection is reciprocal", test_reciprocity);
    g_test_add_func("/render/bsdf/rough matt surfaces are Oren and Nayar's", test_rough);
    g_test_add_func("/render/bsdf/black scatters nothing", test_black);
    return g_test_run();
}
