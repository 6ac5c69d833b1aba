// Rational skins: exact tubes, joints, joins, leaves, shapes, promises.
#include "nurbs_plants.h"

#include <math.h>
#include <string.h>

/// The middle of the control ring of row j, for the seven points of a triangle.
static void middle(const FrNurbsSurface *surface, uint32_t j, double out[4]) {
    const double(*row)[4] = surface->points + (size_t)j * surface->count_u;
    for (int k = 0; k < 3; k++) {
        out[k] = (row[0][k] + row[2][k] + row[4][k]) / 3;
    }
    out[3] = 1;
}

/// The path that a tube was swept along, as a curve. Free its points.
static FrNurbsCurve path_of(const FrNurbsSurface *surface) {
    FrNurbsCurve curve = {.degree = 3, .count = surface->count_v};
    curve.points = g_malloc_n(curve.count, sizeof *curve.points);
    curve.knots = g_memdup2(surface->knots_v, sizeof(double) * ((size_t)surface->count_v + 4));
    for (uint32_t j = 0; j < curve.count; j++) {
        middle(surface, j, curve.points[j]);
    }
    return curve;
}

static void exact_tube(void) {
    FrPlant *plant = stem();
    for (int form = 0; form < 4; form++) {
        FrNurbsParams params = fr_nurbs_default();
        params.circle = form;
        FrNurbsSkin *skin = skinned(plant, &params);
        g_assert_cmpuint(skin->count, ==, 3);
        g_assert_cmpuint(skin->pieces[0].kind, ==, FR_NURBS_TUBE);
        for (int n = 0; n < 400; n++) {
            double p[3], du[3], dv[3], u = (n % 20) / 19.0, v = (n / 20) / 19.0;
            fr_nurbs_surface_at(&skin->pieces[0].surface, u, v, p, du, dv);
            g_assert_cmpfloat_with_epsilon(hypot(p[0], p[1]), 0.0625, 1e-16);
            // Outwards.
            double nx = du[1] * dv[2] - du[2] * dv[1], ny = du[2] * dv[0] - du[0] * dv[2];
            g_assert_cmpfloat(nx * p[0] + ny * p[1], >, 0);
        }
        double low[3], high[3];
        fr_nurbs_surface_at(&skin->pieces[0].surface, 0.3, 0, low, NULL, NULL);
        fr_nurbs_surface_at(&skin->pieces[0].surface, 0.3, 1, high, NULL, NULL);
        g_assert_cmpfloat_with_epsilon(low[2], 0, 1e-15);
        g_assert_cmpfloat_with_epsilon(high[2], 2, 1e-15);
        fr_nurbs_skin_free(skin);
    }
    fr_plant_free(plant);
}

static void caps_close(void) {
    FrPlant *plant = stem();
    FrNurbsParams params = fr_nurbs_default();
    FrNurbsSkin *skin = skinned(plant, &params);
    for (int end = 0; end < 2; end++) {
        const FrNurbsSurface *cap = &skin->pieces[1 + end].surface;
        double centre[3], du[3], dv[3];
        fr_nurbs_surface_at(cap, 0.2, end == 0 ? 0 : 1, centre, NULL, NULL);
        g_assert_cmpfloat_with_epsilon(centre[2], 2.0 * end, 1e-15);
        fr_nurbs_surface_at(cap, 0.2, 0.5, NULL, du, dv);
        double up = du[0] * dv[1] - du[1] * dv[0];
        g_assert_true(end == 0 ? up < 0 : up > 0);
        for (int i = 0; i <= 20; i++) {
            double rim[3], tube[3];
            fr_nurbs_surface_at(cap, i / 20.0, end == 0 ? 1 : 0, rim, NULL, NULL);
            fr_nurbs_surface_at(&skin->pieces[0].surface, i / 20.0, end, tube, NULL, NULL);
            g_assert_true(memcmp(rim, tube, sizeof rim) == 0);
        }
    }
    fr_nurbs_skin_free(skin);
    fr_plant_free(plant);
}

/// The normal of a control ring in the plane of y and z, as an angle from z towards −y.
static double ring_angle(const FrNurbsSurface *surface, uint32_t j) {
    const double(*p)[4] = surface->points + (size_t)j * surface->count_u;
    double a[3], b[3];
    for (int k = 0; k < 3; k++) {
        a[k] = p[2][k] - p[0][k];
        b[k] = p[4][k] - p[0][k];
    }
    return atan2(-(a[2] * b[0] - a[0] * b[2]), a[0] * b[1] - a[1] * b[0]);
}

// Equation 1 at a joint of 60°: w_out / (w_in + w_out) of the way.
static void joints(void) {
    const float out[] = {0.04F, 0.02F, 0.0008F};
    for (int i = 0; i < 3; i++) {
        FrPlant *plant = fr_plant_new("bent");
        uint32_t axis = fr_plant_add_axis(plant, FR_NONE, (vec3s){{0, 0, 0}}, 0.04F);
        fr_plant_add_node(plant, axis, GLMS_QUAT_IDENTITY, 1, 0.04F);
        fr_plant_add_node(plant, axis, GLMS_QUAT_IDENTITY, 1, 0.04F);
        fr_plant_add_node(plant, axis, about_x(60), 1, out[i]);
        fr_plant_add_node(plant, axis, GLMS_QUAT_IDENTITY, 1, out[i]);
        FrNurbsParams params = fr_nurbs_default();
        params.corners = false;
        FrNurbsSkin *skin = skinned(plant, &params);
        g_assert_cmpuint(skin->pieces[0].surface.count_v, ==, 5);
        double share = (double)out[i] / (0.04 + (double)out[i]);
        double angle = ring_angle(&skin->pieces[0].surface, 2) * 180 / G_PI;
        g_assert_cmpfloat_with_epsilon(angle, 60 * share, 1e-4);
        fr_nurbs_skin_free(skin);
        fr_plant_free(plant);
    }
}

static double angle_between(const double a[3], const double b[3]) {
    double x = a[1] * b[2] - a[2] * b[1], y = a[2] * b[0] - a[0] * b[2];
    double z = a[0] * b[1] - a[1] * b[0];
    return atan2(sqrt(x * x + y * y + z * z), a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
}

static void tangent_join(void) {
    FrPlant *plant = forked();
    FrNurbsParams params = fr_nurbs_default();
    params.join = FR_JOIN_TANGENT;
    FrNurbsSkin *skin = skinned(plant, &params);
    g_assert_cmpuint(skin->count, ==, 6);
    FrNurbsCurve path = path_of(&skin->pieces[3].surface);
    double at[3], way[3], internode[3];
    fr_nurbs_curve_at(&path, 0, at, way);
    for (int k = 0; k < 3; k++) {
        double base = (double)plant->nodes.position[1].raw[k];
        internode[k] = (double)plant->nodes.position[2].raw[k] - base;
        g_assert_cmpfloat_with_epsilon(at[k], base, 1e-9);
    }
    g_assert_cmpfloat(angle_between(way, internode), <, 1e-6);
    // The second shared point is the fork.
    for (int k = 0; k < 3; k++) {
        g_assert_cmpfloat_with_epsilon(path.points[1][k], (double)plant->nodes.position[2].raw[k],
                                       1e-9);
    }
    fr_nurbs_curve_clear(&path);
    fr_nurbs_skin_free(skin);
    fr_plant_free(plant);
}

// By default a branch begins two radii before the fork.
static void near_join(void) {
    FrPlant *plant = forked();
    FrNurbsParams params = fr_nurbs_default();
    FrNurbsSkin *skin = skinned(plant, &params);
    FrNurbsCurve path = path_of(&skin->pieces[3].surface);
    double at[3], way[3], internode[3], off[3];
    fr_nurbs_curve_at(&path, 0, at, way);
    for (int k = 0; k < 3; k++) {
        double base = (double)plant->nodes.position[1].raw[k];
        double tip = (double)plant->nodes.position[2].raw[k];
        internode[k] = tip - base;
        off[k] = tip - at[k];
    }
    g_assert_cmpfloat(angle_between(way, internode), <, 1e-6);
    g_assert_cmpfloat(angle_between(off, internode), <, 1e-6);
    double length = sqrt(off[0] * off[0] + off[1] * off[1] + off[2] * off[2]);
    g_assert_cmpfloat_with_epsilon(length, 2 * 0.05, 1e-6);
    fr_nurbs_curve_clear(&path);
    fr_nurbs_skin_free(skin);
    fr_plant_free(plant);
}

// Where a smooth branch begins it has the place, tangent and curvature of its parent's path.
static void smooth_join(void) {
    FrPlant *plant = forked();
    FrNurbsParams params = fr_nurbs_default();
    params.join = FR_JOIN_SMOOTH;
    FrNurbsSkin *skin = skinned(plant, &params);
    FrNurbsCurve parent = path_of(&skin->pieces[0].surface);
    FrNurbsCurve branch = path_of(&skin->pieces[3].surface);
    double range[2], nearest = INFINITY, begin[3], way[3], found;
    fr_nurbs_range(parent.knots, 3, parent.count, range);
    fr_nurbs_curve_at(&branch, 0, begin, way);
    // One internode is one piece of the parent's uniform knots: the node is at 2 of 5.
    found = 2.0 / 5;
    double at[3], parent_way[3];
    fr_nurbs_curve_at(&parent, found, at, parent_way);
    nearest = hypot(hypot(at[0] - begin[0], at[1] - begin[1]), at[2] - begin[2]);
    g_assert_cmpfloat(nearest, <, 1e-7);
    g_assert_cmpfloat(angle_between(way, parent_way), <, 1e-6);
    double h = 1e-4, scale_branch = branch.count - 3, scale_parent = parent.count - 3;
    double a[3], b[3];
    fr_nurbs_curve_at(&branch, h / scale_branch, NULL, a);
    fr_nurbs_curve_at(&parent, found + h / scale_parent, NULL, b);
    for (int k = 0; k < 3; k++) {
        double bend_branch = (a[k] - way[k]) / scale_branch / h;
        double bend_parent = (b[k] - parent_way[k]) / scale_parent / h;
        g_assert_cmpfloat_with_epsilon(bend_branch, bend_parent, 1e-4);
    }
    fr_nurbs_curve_clear(&parent);
    fr_nurbs_curve_clear(&branch);
    fr_nurbs_skin_free(skin);
    fr_plant_free(plant);
}

static void twisting(void) {
    FrPlant *plant = letter_s();
    for (int frames = 0; frames < 2; frames++) {
        FrNurbsParams params = fr_nurbs_default();
        params.frames = frames;
        FrNurbsSkin *skin = skinned(plant, &params);
        const FrNurbsSurface *tube = &skin->pieces[0].surface;
        double most = 0;
        for (uint32_t j = 1; j + 1 < tube->count_v; j++) {
            double side[2][3];
            for (uint32_t k = 0; k < 2; k++) {
                double centre[4];
                middle(tube, j - k, centre);
                const double *p = tube->points[(size_t)(j - k) * tube->count_u + 1];
                for (int d = 0; d < 3; d++) {
                    side[k][d] = p[d] - centre[d];
                }
            }
            // All of the bend is about x, so x of a side changes only by twisting.
            most = fmax(most, fabs(side[0][0] - side[1][0]) / 0.04);
        }
        if (frames == FR_FRAMES_MINIMAL) {
            g_assert_cmpfloat(most, <, 1e-3);
        } else {
            g_assert_cmpfloat(most, >, 0.5);
        }
        fr_nurbs_skin_free(skin);
    }
    fr_plant_free(plant);
}

// A branch that goes on from a round one with a star as its profile turns into the star.
static void changing_profile(void) {
    FrPlant *plant = stem();
    double star[10][2];
    for (int i = 0; i < 10; i++) {
        double radius = i % 2 == 0 ? 1.4 : 0.5;
        star[i][0] = radius * cos(G_PI * i / 5);
        star[i][1] = radius * sin(G_PI * i / 5);
    }
    uint32_t profile = fr_plant_add_profile(plant, (const double(*)[2])star, 10, true);
    uint32_t axis = fr_plant_add_axis(plant, 3, (vec3s){{0, 0, 0}}, 0.0625F);
    plant->axes.flags[axis] = FR_CONTINUES;
    plant->axes.profile[axis] = profile;
    for (int i = 0; i < 6; i++) {
        fr_plant_add_node(plant, axis, GLMS_QUAT_IDENTITY, 0.2F, 0.0625F);
    }
    FrNurbsParams params = fr_nurbs_default();
    FrNurbsSkin *skin = skinned(plant, &params);
    g_assert_cmpuint(skin->count, ==, 6);
    const FrNurbsSurface *tube = &skin->pieces[3].surface;
    double low[2] = {INFINITY, INFINITY}, high[2] = {0, 0};
    for (int i = 0; i < 200; i++) {
        for (int end = 0; end < 2; end++) {
            double p[3];
            fr_nurbs_surface_at(tube, i / 200.0, end, p, NULL, NULL);
            low[end] = fmin(low[end], hypot(p[0], p[1]));
            high[end] = fmax(high[end], hypot(p[0], p[1]));
        }
    }
    g_assert_cmpfloat_with_epsilon(low[0], 0.0625, 1e-12);
    g_assert_cmpfloat_with_epsilon(high[0], 0.0625, 1e-12);
    // A cubic is (a + 4b + a) / 6 at its corners.
    g_assert_cmpfloat_with_epsilon(high[1], 0.0625 * (4 * 1.4 + 2 * 0.5 * cos(G_PI / 5)) / 6, 1e-4);
    g_assert_cmpfloat(low[1], <, 0.8 * high[1]);
    fr_nurbs_skin_free(skin);
    fr_plant_free(plant);
}

static void leaf(void) {
    FrShape shape = leaf_shape();
    FrPlant *plant = with_organ(&shape);
    FrNurbsParams params = fr_nurbs_default();
    FrNurbsSkin *skin = skinned(plant, &params);
    g_assert_cmpuint(skin->count, ==, 3);
    const FrNurbsSurface *right = &skin->pieces[1].surface, *left = &skin->pieces[2].surface;
    g_assert_cmpuint(right->degree_v, ==, 1);
    double widest = 0;
    for (int i = 0; i <= 100; i++) {
        double a[3], b[3], r[3], l[3], du[3], dv[3];
        fr_nurbs_surface_at(right, i / 100.0, 1, a, NULL, NULL);
        fr_nurbs_surface_at(left, i / 100.0, 0, b, NULL, NULL);
        g_assert_true(memcmp(a, b, sizeof a) == 0);
        g_assert_cmpfloat_with_epsilon(a[0], 0, 1e-15);
        fr_nurbs_surface_at(right, i / 100.0, 0, r, NULL, NULL);
        fr_nurbs_surface_at(left, i / 100.0, 1, l, NULL, NULL);
        g_assert_cmpfloat_with_epsilon(r[0], -l[0], 1e-12);
        widest = fmax(widest, l[0] - r[0]);
        // A straight line from midrib to margin.
        double m[3];
        fr_nurbs_surface_at(left, i / 100.0, 0.25, m, NULL, NULL);
        for (int k = 0; k < 3; k++) {
            g_assert_cmpfloat_with_epsilon(m[k], 0.75 * b[k] + 0.25 * l[k], 1e-15);
        }
        fr_nurbs_surface_at(left, 0.01 + 0.98 * i / 100.0, 0.5, NULL, du, dv);
        g_assert_cmpfloat(du[2] * dv[0] - du[0] * dv[2], >, 0); // upwards
    }
    g_assert_cmpfloat_with_epsilon(widest, 0.05 * cos(0.3), 0.0015);
    fr_nurbs_skin_free(skin);
    fr_plant_free(plant);
}

// The margin of a polygon's patch runs through the corners of the outline's rows.
static void curved_leaf(void) {
    FrShape shape = leaf_shape();
    shape.blade.curvature_across = 0.8F;
    shape.blade.twist = 0.4F;
    FrPlant *plant = with_organ(&shape);
    FrNurbsParams params = fr_nurbs_default();
    FrNurbsSkin *skin = skinned(plant, &params);
    g_assert_cmpuint(skin->count, ==, 3);
    g_assert_cmpuint(skin->pieces[1].surface.degree_v, ==, 3);
    for (int i = 0; i <= 50; i++) {
        double a[3], b[3];
        fr_nurbs_surface_at(&skin->pieces[1].surface, i / 50.0, 1, a, NULL, NULL);
        fr_nurbs_surface_at(&skin->pieces[2].surface, i / 50.0, 0, b, NULL, NULL);
        for (int k = 0; k < 3; k++) {
            g_assert_cmpfloat_with_epsilon(a[k], b[k], 1e-15);
        }
    }
    fr_nurbs_skin_free(skin);
    fr_plant_free(plant);
}

static void primitives(void) {
    const struct {
        FrShapeKind kind;
        uint64_t surfaces;
    } wanted[] = {{FR_SHAPE_BOX, 6},      {FR_SHAPE_SPHERE, 1},  {FR_SHAPE_CONE, 2},
                  {FR_SHAPE_CYLINDER, 3}, {FR_SHAPE_TORUS, 1},   {FR_SHAPE_SQUARE, 1},
                  {FR_SHAPE_CIRCLE, 1},   {FR_SHAPE_TRIANGLE, 1}};
    for (size_t i = 0; i < G_N_ELEMENTS(wanted); i++) {
        FrShape shape = {.kind = wanted[i].kind, .size = {{0.5F, 0.5F, 0.5F}}, .detail = 12};
        FrPlant *plant = with_organ(&shape);
        FrNurbsParams params = fr_nurbs_default();
        FrNurbsSkin *skin = skinned(plant, &params);
        g_assert_cmpuint(skin->count, ==, wanted[i].surfaces);
        for (int n = 0; n < 400; n++) {
            double p[3], u = (n % 20) / 19.0, v = (n / 20) / 19.0;
            fr_nurbs_surface_at(&skin->pieces[0].surface, u, v, p, NULL, NULL);
            if (wanted[i].kind == FR_SHAPE_SPHERE) {
                double r = sqrt(p[0] * p[0] + p[1] * p[1] + (p[2] - 0.25) * (p[2] - 0.25));
                g_assert_cmpfloat_with_epsilon(r, 0.25, 1e-15);
            } else if (wanted[i].kind == FR_SHAPE_TORUS) {
                double tube = hypot(hypot(p[0], p[1]) - 0.125, p[2] - 0.25);
                g_assert_cmpfloat(tube, <, 0.25);
            }
        }
        fr_nurbs_skin_free(skin);
        fr_plant_free(plant);
    }
}

static void threads(void) {
    FrPlant *plant = bush();
    FrNurbsParams params = fr_nurbs_default();
    FrNurbsSkin *alone = skinned(plant, &params);
    g_assert_cmpuint(alone->count, ==, 300 * (3 + 3 + 3));
    FrContext context = fr_context_default();
    context.pool = fr_pool_new(3);
    FrNurbsSkin *together;
    g_assert_cmpint(fr_nurbs_plant(plant, &params, &context, &together), ==, FR_OK);
    g_assert_cmpuint(fr_nurbs_skin_digest(alone), ==, fr_nurbs_skin_digest(together));
    fr_pool_free(context.pool);
    fr_nurbs_skin_free(alone);
    fr_nurbs_skin_free(together);
    fr_plant_free(plant);
}

static void limits(void) {
    FrPlant *plant = bush();
    FrNurbsParams params = fr_nurbs_default();
    FrContext context = fr_context_default();
    context.diags = fr_diags_new();
    context.limits.bytes = 300000;
    FrNurbsSkin *skin;
    g_assert_cmpint(fr_nurbs_plant(plant, &params, &context, &skin), ==, FR_ERR_LIMIT);
    g_assert_null(skin);
    g_assert_cmpstr(fr_diags_get(context.diags, 0)->code, ==, "limit-bytes");
    fr_diags_free(context.diags);
    fr_plant_free(plant);
}

// Nothing, one point, points that repeat: no surface, no crash.
static void degenerate(void) {
    FrPlant *plant = fr_plant_new("nothing");
    fr_plant_add_axis(plant, FR_NONE, (vec3s){{0, 0, 0}}, 0.1F);
    uint32_t axis = fr_plant_add_axis(plant, FR_NONE, (vec3s){{0, 0, 0}}, 0);
    for (int i = 0; i < 5; i++) {
        fr_plant_add_node(plant, axis, GLMS_QUAT_IDENTITY, 0, 0);
    }
    axis = fr_plant_add_axis(plant, 2, (vec3s){{0, 0, 0}}, NAN);
    fr_plant_add_node(plant, axis, about_x(180), 1, NAN);
    fr_plant_add_node(plant, axis, about_x(180), 1, 1e-9F);
    for (int join = 0; join < 3; join++) {
        FrNurbsParams params = fr_nurbs_default();
        params.join = join;
        FrNurbsSkin *skin = skinned(plant, &params);
        g_assert_cmpuint(skin->count, ==, 3);
        fr_nurbs_skin_free(skin);
    }
    fr_plant_free(plant);
}

/// A stem of two long internodes with a branch in its middle.
static FrPlant *simple_fork(void) {
    FrPlant *plant = fr_plant_new("fork");
    uint32_t axis = fr_plant_add_axis(plant, FR_NONE, (vec3s){{0, 0, 0}}, 0.06F);
    fr_plant_add_node(plant, axis, GLMS_QUAT_IDENTITY, 1, 0.06F);
    fr_plant_add_node(plant, axis, GLMS_QUAT_IDENTITY, 1, 0.06F);
    uint32_t branch = fr_plant_add_axis(plant, 0, (vec3s){{0, 0, 0}}, 0.04F);
    fr_plant_add_node(plant, branch, about_x(60), 1, 0.04F);
    return plant;
}

static void ends_of(const FrNurbsSurface *s, double u, bool is_end, double p[3], double dv[3]) {
    double du[3];
    fr_nurbs_surface_at(s, u, is_end ? 1 : 0, p, du, dv);
    double length = sqrt(dv[0] * dv[0] + dv[1] * dv[1] + dv[2] * dv[2]);
    for (int k = 0; k < 3; k++) {
        dv[k] /= length;
    }
}

// Rings are circles around the limbs, patches leave them along the limbs, and share their sides.
static void ramiform(void) {
    FrPlant *plant = simple_fork();
    FrNurbsParams params = fr_nurbs_default();
    params.forks = FR_FORKS_RAMIFORM;
    FrNurbsSkin *skin = skinned(plant, &params);
    g_assert_cmpuint(skin->count, ==, 3 + 3 + 3);
    const FrNurbsSurface *back = &skin->pieces[6].surface, *below = &skin->pieces[7].surface;
    const FrNurbsSurface *above = &skin->pieces[8].surface;
    vec3s heading = fr_frame_heading(plant->nodes.frame[2]);
    const double stem[3] = {0, 0, 1};
    const double branch[3] = {(double)heading.x, (double)heading.y, (double)heading.z};
    for (int n = 0; n <= 20; n++) {
        double p[3], dv[3];
        const FrNurbsSurface *starts[] = {back, below, above};
        for (int k = 0; k < 3; k++) {
            ends_of(starts[k], n / 20.0, false, p, dv);
            g_assert_cmpfloat_with_epsilon(hypot(p[0], p[1]), 0.06 * 1.01, 1e-7);
            double along = dv[0] * stem[0] + dv[1] * stem[1] + dv[2] * stem[2];
            g_assert_cmpfloat_with_epsilon(fabs(along), 1, 1e-9);
        }
        for (int k = 1; k < 3; k++) {
            ends_of(starts[k], n / 20.0, true, p, dv);
            double along = p[0] * branch[0] + p[1] * branch[1] + (p[2] - 1) * branch[2];
            double off = 0;
            for (int d = 0; d < 3; d++) {
                double at = p[d] - (d == 2) - along * branch[d];
                off += at * at;
            }
            g_assert_cmpfloat_with_epsilon(sqrt(off), 0.04 * 1.01, 1e-7);
            g_assert_cmpfloat_with_epsilon(
                dv[0] * branch[0] + dv[1] * branch[1] + dv[2] * branch[2], 1, 1e-6);
        }
    }
    for (int n = 0; n <= 20; n++) { // in front of the fork, from below to above and to the branch
        double v = n / 20.0, p[3], q[3];
        fr_nurbs_surface_at(n <= 10 ? below : above, n <= 10 ? 1 : 0, v <= 0.5 ? v : 1 - v, q, NULL,
                            NULL);
        fr_nurbs_surface_at(back, 0, v, p, NULL, NULL);
        for (int d = 0; d < 3; d++) {
            g_assert_cmpfloat_with_epsilon(p[d], q[d], 1e-7);
        }
    }
    fr_nurbs_skin_free(skin);
    fr_plant_free(plant);
}

// A toothed outline: the margin of an exact half is the outline.
static void exact_margin(void) {
    double teeth[33][2];
    for (int i = 0; i <= 32; i++) {
        teeth[i][0] = i / 32.0;
        teeth[i][1] = 0.5 * sin(G_PI * teeth[i][0]) * (i % 2 == 0 ? 1 : 0.8);
    }
    FrPlant *plant = fr_plant_new("toothed");
    FrShape shape = leaf_shape();
    shape.blade.petiole_length = 0;
    shape.blade.curvature_along = 0;
    shape.blade.fold = 0;
    shape.blade.outline = fr_plant_add_profile(plant, (const double(*)[2])teeth, 33, false);
    uint32_t organ = fr_plant_append_organs(plant, 1);
    plant->organs.shape[organ] = fr_plant_add_shape(plant, &shape);
    FrNurbsParams params = fr_nurbs_default();
    params.margins = FR_MARGINS_EXACT;
    FrNurbsSkin *skin = skinned(plant, &params);
    const FrNurbsSurface *right = &skin->pieces[0].surface;
    g_assert_cmpuint(skin->pieces[0].kind, ==, FR_NURBS_RIGHT);
    // Points of the surface on its margin are on the polygon; the base is as wide as it must be.
    for (int n = 0; n <= 400; n++) {
        double p[3];
        fr_nurbs_surface_at(right, n / 400.0, 0, p, NULL, NULL);
        double along = CLAMP(p[2] / 0.1 * 32, 0, 31.999), part = along - floor(along);
        int i = (int)along;
        double wanted = 0.05 * ((1 - part) * teeth[i][1] + part * teeth[i + 1][1]);
        g_assert_cmpfloat_with_epsilon(fabs(p[0]), wanted, i < 2 ? 1e-3 : 5e-5);
    }
    fr_nurbs_skin_free(skin);
    fr_plant_free(plant);
}

// Where a long stem bends, its surface stays at the fork, where a branch begins.
static void corners(void) {
    FrPlant *plant = fr_plant_new("bent");
    uint32_t axis = fr_plant_add_axis(plant, FR_NONE, (vec3s){{0, 0, 0}}, 0.02F);
    for (int i = 0; i < 5; i++) {
        fr_plant_add_node(plant, axis, about_x(i == 2 ? 60 : 0), 1, 0.02F);
    }
    FrNurbsParams params = fr_nurbs_default();
    double nearest[2];
    for (int is_kept = 0; is_kept < 2; is_kept++) {
        params.corners = is_kept;
        FrNurbsSkin *skin = skinned(plant, &params);
        FrNurbsCurve path = path_of(&skin->pieces[0].surface);
        nearest[is_kept] = INFINITY;
        for (int n = 0; n <= 2000; n++) {
            double at[3];
            fr_nurbs_curve_at(&path, n / 2000.0, at, NULL);
            vec3s bend = plant->nodes.position[1];
            double y = at[1] - (double)bend.y, z = at[2] - (double)bend.z;
            nearest[is_kept] = fmin(nearest[is_kept], hypot(y, z));
        }
        fr_nurbs_curve_clear(&path);
        fr_nurbs_skin_free(skin);
    }
    g_assert_cmpfloat(nearest[0], >, 0.1);
    g_assert_cmpfloat(nearest[1], <, 0.5 * 0.02);
    fr_plant_free(plant);
}

// Equal leaves are one shape and its places: where a copy is placed, the leaf is.
static void copies(void) {
    FrPlant *plant = bush();
    for (uint32_t i = 0; i < plant->organs.count; i++) {
        plant->organs.scale[i] = 0.5F + 0.001F * (float)(i % 100);
    }
    FrNurbsParams params = fr_nurbs_default();
    FrContext context = fr_context_default();
    FrNurbsSkin *whole = skinned(plant, &params), *shared;
    const struct {
        int share;
        uint64_t least, most;
        double within;
    } cases[] = {{FR_SHARE_NO, 0, 0, 0},
                 {FR_SHARE_EQUAL, 300, 100 * 3, 1e-7},
                 {FR_SHARE_NEAR, 300, 12 * 3, 0.02 * 0.13}};
    for (size_t c = 0; c < G_N_ELEMENTS(cases); c++) {
        params.share = cases[c].share;
        g_assert_cmpint(fr_nurbs_plant_shared(plant, &params, &context, &shared), ==, FR_OK);
        g_assert_cmpuint(shared->copy_count, ==, cases[c].least);
        g_assert_cmpuint(fr_nurbs_skin_surfaces(shared), ==, whole->count);
        uint64_t kept = 0;
        for (uint64_t i = 0; i < shared->copy_count; i++) {
            const FrNurbsCopy *copy = &shared->copies[i];
            kept = MAX(kept, copy->first_piece + copy->piece_count - shared->count);
            const FrNurbsPiece *piece = &shared->pieces[copy->first_piece + 1];
            const FrNurbsPiece *own = &whole->pieces[shared->count + 3 * i + 1];
            g_assert_cmpuint(own->organ, ==, copy->organ);
            double p[3], wanted[3];
            fr_nurbs_surface_at(&piece->surface, 0.4, 0.3, p, NULL, NULL);
            fr_nurbs_surface_at(&own->surface, 0.4, 0.3, wanted, NULL, NULL);
            for (int k = 0; k < 3; k++) {
                double at = copy->at[k] + p[0] * copy->axes[0][k] + p[1] * copy->axes[1][k] +
                            p[2] * copy->axes[2][k];
                g_assert_cmpfloat_with_epsilon(at, wanted[k], cases[c].within);
            }
        }
        g_assert_cmpuint(kept, <=, cases[c].most);
        fr_nurbs_skin_free(shared);
    }
    fr_nurbs_skin_free(whole);
    fr_plant_free(plant);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/skin/nurbs/a straight stem is an exact cylinder", exact_tube);
    g_test_add_func("/skin/nurbs/caps share the rims of their tube", caps_close);
    g_test_add_func("/skin/nurbs/joints turn by the weights of equation 1", joints);
    g_test_add_func("/skin/nurbs/a branch leaves along its parent's internode", tangent_join);
    g_test_add_func("/skin/nurbs/a branch begins near the fork it leaves", near_join);
    g_test_add_func("/skin/nurbs/a smooth branch has its parent's curvature", smooth_join);
    g_test_add_func("/skin/nurbs/minimal frames never twist and Frenet frames flip", twisting);
    g_test_add_func("/skin/nurbs/a profile turns from circle to star", changing_profile);
    g_test_add_func("/skin/nurbs/a leaf is a petiole and two ruled halves", leaf);
    g_test_add_func("/skin/nurbs/a leaf curved across has cubic arcs", curved_leaf);
    g_test_add_func("/skin/nurbs/every primitive is exact", primitives);
    g_test_add_func("/skin/nurbs/fork surfaces join three limbs with their tangents", ramiform);
    g_test_add_func("/skin/nurbs/exact margins have all teeth of the outline", exact_margin);
    g_test_add_func("/skin/nurbs/a surface stays at the corners of its path", corners);
    g_test_add_func("/skin/nurbs/equal organs are copies of one shape", copies);
    g_test_add_func("/skin/nurbs/any number of threads makes the same surfaces", threads);
    g_test_add_func("/skin/nurbs/too many surfaces are refused before they are made", limits);
    g_test_add_func("/skin/nurbs/nothing makes no surface", degenerate);
    return g_test_run();
}
