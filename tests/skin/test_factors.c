// Global factors and weights: what changes a plant before its surfaces are made.
#include "nurbs_plants.h"

#include <math.h>
#include <string.h>

static FrNurbsParams blown(float x, float y, float z) {
    FrNurbsParams params = fr_nurbs_default();
    params.wind = (vec3s){{x, y, z}};
    params.gust = 0;
    return params;
}

static void identity(void) {
    FrPlant *plant = bush();
    FrNurbsParams calm = fr_nurbs_default();
    g_assert_null(fr_nurbs_posed(plant, &calm));
    FrNurbsSkin *before = skinned(plant, &calm);
    calm.yield = 3;
    calm.phase = 1;
    FrNurbsSkin *after = skinned(plant, &calm);
    g_assert_true(fr_nurbs_skin_digest(before) == fr_nurbs_skin_digest(after));
    fr_nurbs_skin_free(before);
    fr_nurbs_skin_free(after);
    fr_plant_free(plant);
}

static double lean(const FrPlant *plant) {
    vec3s heading = fr_frame_heading(plant->nodes.frame[plant->nodes.count - 1]);
    return atan2((double)heading.x, (double)heading.z);
}

static FrPlant *posed_stem(float radius, const FrNurbsParams *params) {
    FrPlant *plant = stem();
    for (uint32_t i = 0; i < plant->nodes.count; i++) {
        plant->nodes.radius[i] = radius;
    }
    FrPlant *posed = fr_nurbs_posed(plant, params);
    fr_plant_free(plant);
    return posed;
}

static void formula(void) {
    FrNurbsParams params = blown(1, 0, 0);
    params.yield = 0.02;
    params.yield_radius = 0.0625;
    FrPlant *plain = posed_stem(0.0625F, &params), *thick = posed_stem(0.125F, &params);
    // The tip of a branch of the yield radius turns by `yield`; twice as thick by a quarter.
    g_assert_cmpfloat_with_epsilon(lean(plain), 0.02, 1e-5);
    g_assert_cmpfloat_with_epsilon(lean(thick), 0.005, 1e-5);
    params.yield_exponent = 4;
    FrPlant *beam = posed_stem(0.125F, &params);
    g_assert_cmpfloat_with_epsilon(lean(beam), 0.00125, 1e-5);
    params = blown(2, 0, 0);
    params.yield = 0.02;
    params.yield_radius = 0.0625;
    FrPlant *strong = posed_stem(0.0625F, &params);
    g_assert_cmpfloat_with_epsilon(lean(strong), 0.04, 1e-4);
    // Half way up it has turned by a quarter, as (σ/L)² says.
    double length = 0;
    for (uint32_t i = 0; i < plain->nodes.count; i++) {
        length += (double)plain->nodes.length[i];
        vec3s heading = fr_frame_heading(plain->nodes.frame[i]);
        double wanted = 0.02 * pow(length / 2.0, 2);
        g_assert_cmpfloat_with_epsilon(atan2((double)heading.x, (double)heading.z), wanted, 1e-5);
    }
    g_assert_cmpfloat_with_epsilon(length, 2, 1e-6);
    fr_plant_free(plain);
    fr_plant_free(thick);
    fr_plant_free(beam);
    fr_plant_free(strong);
}

static void directions(void) {
    FrNurbsParams params = fr_nurbs_default();
    params.gravity = (vec3s){{0, 0, -1}};
    params.yield_radius = 1;
    FrPlant *plant = forked(), *down = fr_nurbs_posed(plant, &params);
    params.gravity = (vec3s){{0, 0, 0}};
    params.light = (vec3s){{0, 0, 1}};
    FrPlant *up = fr_nurbs_posed(plant, &params);
    float before = plant->nodes.position[plant->nodes.count - 1].z;
    g_assert_cmpfloat(down->nodes.position[down->nodes.count - 1].z, <, before);
    g_assert_cmpfloat(up->nodes.position[up->nodes.count - 1].z, >, before);
    // A strong wind turns everything its way and no further.
    params.light = (vec3s){{0, 0, 0}};
    params.wind = (vec3s){{100, 0, 0}};
    params.yield = 3;
    FrPlant *storm = fr_nurbs_posed(plant, &params);
    vec3s heading = fr_frame_heading(storm->nodes.frame[storm->nodes.count - 1]);
    g_assert_cmpfloat(heading.x, >, 0.99F);
    char *why = NULL;
    g_assert_true(fr_plant_is_valid(storm, &why));
    fr_plant_free(plant);
    fr_plant_free(down);
    fr_plant_free(up);
    fr_plant_free(storm);
}

/// Where a point is when it is turned about a foot towards x by its angle to x, at most `angle`.
static void turned_to_x(const double foot[3], const double point[3], double angle, double out[3]) {
    double way[3], length = 0;
    for (int k = 0; k < 3; k++) {
        way[k] = point[k] - foot[k];
        length += way[k] * way[k];
    }
    length = sqrt(length);
    double beside = hypot(way[1], way[2]), now = atan2(beside, way[0]);
    double then = now - fmin(angle, now);
    out[0] = foot[0] + length * cos(then);
    out[1] = foot[1] + (beside > 0 ? length * sin(then) * way[1] / beside : 0);
    out[2] = foot[2] + (beside > 0 ? length * sin(then) * way[2] / beside : 0);
}

// The net is deformed here by the formula and evaluated: the skin's surface is the same.
static void blades(void) {
    FrShape shape = leaf_shape();
    shape.blade.petiole_length = 0;
    shape.blade.fold = 0.9F;
    FrPlant *plant = with_organ(&shape);
    FrNurbsParams calm = fr_nurbs_default(), windy = blown(1, 0, 0);
    FrNurbsSkin *before = skinned(plant, &calm), *after = skinned(plant, &windy);
    g_assert_cmpuint(before->count, ==, 2);
    double half = 0;
    for (uint64_t i = 0; i < 2; i++) {
        const FrNurbsSurface *s = &before->pieces[i].surface;
        for (uint32_t c = 0; c < s->count_u; c++) {
            const double *a = s->points[c], *b = s->points[s->count_u * (s->count_v - 1) + c];
            half =
                fmax(half, sqrt(pow(a[0] - b[0], 2) + pow(a[1] - b[1], 2) + pow(a[2] - b[2], 2)));
        }
    }
    for (uint64_t i = 0; i < 2; i++) {
        FrNurbsSurface s = before->pieces[i].surface;
        uint32_t midrib = before->pieces[i].kind == FR_NURBS_RIGHT ? s.count_v - 1 : 0;
        double(*net)[4] = g_memdup2(s.points, sizeof(double[4]) * s.count_u * s.count_v);
        for (uint32_t n = 0; n < s.count_u * s.count_v; n++) {
            const double *foot = s.points[midrib * s.count_u + n % s.count_u], *p = s.points[n];
            double way[3] = {p[0] - foot[0], p[1] - foot[1], p[2] - foot[2]};
            double reach = sqrt(way[0] * way[0] + way[1] * way[1] + way[2] * way[2]);
            double across = reach > 0 ? hypot(way[1], way[2]) / reach : 0;
            turned_to_x(foot, p, windy.blade_yield * reach / half * across, net[n]);
        }
        s.points = (const double(*)[4])net;
        for (int n = 0; n < 100; n++) {
            double wanted[3], made[3], u = (n % 10) / 9.0, v = (n / 10) / 9.0;
            fr_nurbs_surface_at(&s, u, v, wanted, NULL, NULL);
            fr_nurbs_surface_at(&after->pieces[i].surface, u, v, made, NULL, NULL);
            for (int k = 0; k < 3; k++) {
                g_assert_cmpfloat_with_epsilon(made[k], wanted[k], 1e-7);
            }
        }
        g_free(net);
    }
    fr_nurbs_skin_free(before);
    fr_nurbs_skin_free(after);
    fr_plant_free(plant);
}

static void waves(void) {
    FrPlant *plant = bush();
    FrNurbsParams params = blown(0, 1, 0);
    params.gust = 0.8;
    FrNurbsSkin *first = skinned(plant, &params);
    params.phase = 1;
    FrNurbsSkin *later = skinned(plant, &params);
    params.phase = 2 * G_PI;
    FrNurbsSkin *again = skinned(plant, &params);
    g_assert_true(fr_nurbs_skin_digest(first) != fr_nurbs_skin_digest(later));
    double most = 0;
    for (uint64_t i = 0; i < first->point_count; i++) {
        for (int k = 0; k < 3; k++) {
            most = fmax(most, fabs(first->points[i][k] - again->points[i][k]));
        }
    }
    g_assert_cmpfloat(most, <, 1e-5);
    fr_nurbs_skin_free(first);
    fr_nurbs_skin_free(later);
    fr_nurbs_skin_free(again);
    fr_plant_free(plant);
}

/// Figure 1: F(+F(+F)(-F))F(-F)F.
static FrPlant *published(void) {
    FrPlant *plant = fr_plant_new("figure 1");
    uint32_t main = fr_plant_add_axis(plant, FR_NONE, (vec3s){{0, 0, 0}}, 0.01F);
    uint32_t a = fr_plant_add_node(plant, main, GLMS_QUAT_IDENTITY, 1, 0.01F);
    uint32_t b = fr_plant_add_node(plant, main, GLMS_QUAT_IDENTITY, 1, 0.01F);
    fr_plant_add_node(plant, main, GLMS_QUAT_IDENTITY, 1, 0.01F);
    uint32_t branch = fr_plant_add_axis(plant, a, (vec3s){{0, 0, 0}}, 0.01F);
    uint32_t c = fr_plant_add_node(plant, branch, about_x(35), 1, 0.01F);
    for (int side = -1; side <= 1; side += 2) {
        uint32_t twig = fr_plant_add_axis(plant, c, (vec3s){{0, 0, 0}}, 0.01F);
        fr_plant_add_node(plant, twig, about_x((float)side * 35), 1, 0.01F);
    }
    uint32_t last = fr_plant_add_axis(plant, b, (vec3s){{0, 0, 0}}, 0.01F);
    fr_plant_add_node(plant, last, about_x(-35), 1, 0.01F);
    return plant;
}

// By hand, for the nodes in their order: the main axis, the branch, its twigs, the last branch.
static void weights(void) {
    static const double exponents[][7] = {
        [FR_WEIGHTS_WEIBEL] = {2, 1, 0, 1, 0, 0, 0},
        [FR_WEIGHTS_STRAHLER] = {2, 1, 0, 1, 0, 0, 0},
    };
    static const double tips[7] = {4, 2, 1, 2, 1, 1, 1};
    FrPlant *plant = published();
    FrNurbsParams params = fr_nurbs_default();
    params.thinnest = 0.01;
    params.ratio = 2;
    params.pipe_exponent = 3;
    for (int kind = FR_WEIGHTS_WEIBEL; kind <= FR_WEIGHTS_PIPE; kind++) {
        params.weights = kind;
        FrPlant *posed = fr_nurbs_posed(plant, &params);
        g_assert_cmpuint(posed->nodes.count, ==, 7);
        for (uint32_t i = 0; i < 7; i++) {
            double wanted = kind == FR_WEIGHTS_STRANDS ? sqrt(tips[i])
                            : kind == FR_WEIGHTS_PIPE  ? cbrt(tips[i])
                                                       : pow(2, exponents[kind][i]);
            g_assert_cmpfloat_with_epsilon((double)posed->nodes.radius[i], 0.01 * wanted, 1e-8);
        }
        fr_plant_free(posed);
    }
    fr_plant_free(plant);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/skin/factors/vectors of length zero change nothing", identity);
    g_test_add_func("/skin/factors/a branch yields by distance and radius and keeps its length",
                    formula);
    g_test_add_func(
        "/skin/factors/gravity pulls down, light up, and a storm no further than it blows",
        directions);
    g_test_add_func(
        "/skin/factors/a blade yields by the distance of its control points from the midrib",
        blades);
    g_test_add_func("/skin/factors/the wind comes in waves that come round", waves);
    g_test_add_func("/skin/factors/weights are the radii of branches", weights);
    return g_test_run();
}
