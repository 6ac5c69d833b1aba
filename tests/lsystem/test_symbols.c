// Every symbol of the turtle by what it does to the turtle (?P, ?H, ?L, ?U report its state) and
// to what is drawn.
#include "lsystems.h"

#include "frond/lsystem_model.h"

#include <glib/gstdio.h>
#include <math.h>
#include <unistd.h>

typedef struct State {
    double p[3], h[3], l[3], u[3];
} State;

static State state_of(const char *symbols) {
    char *text = g_strdup_printf("w : %s?P(0,0,0)?H(0,0,0)?L(0,0,0)?U(0,0,0)\n", symbols);
    Derived d = begin(text, 1);
    g_assert_cmpint(fr_lderivation_ask(d.derivation, &d.context), ==, FR_OK);
    State state = {0};
    uint64_t at = 0;
    FrLmodule module;
    while (fr_lstring_next(fr_lderivation_string(d.derivation), &at, &module)) {
        double *to = module.symbol == 'P'   ? state.p
                     : module.symbol == 'H' ? state.h
                     : module.symbol == 'L' ? state.l
                                            : state.u;
        for (int k = 0; k < 3 && module.count == 3 && strchr("PHLU", module.symbol) != NULL; k++) {
            to[k] = (double)module.parameters[k];
        }
    }
    end(&d);
    g_free(text);
    return state;
}

static void near3(const double a[3], const double b[3]) {
    for (int k = 0; k < 3; k++) {
        g_assert_cmpfloat_with_epsilon(a[k], b[k], 1e-6);
    }
}

// cos 30°, sin 30°
#define C 0.8660254037844387
#define S 0.5

static void poses(void) {
    static const struct {
        const char *symbols;
        State state;
    } rows[] = {
        {"", {{0, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, 0, -1}}},
        {"F(2)", {{0, 2, 0}, {0, 1, 0}, {-1, 0, 0}, {0, 0, -1}}},
        {"f(2)", {{0, 2, 0}, {0, 1, 0}, {-1, 0, 0}, {0, 0, -1}}},
        {"G", {{0, 1, 0}, {0, 1, 0}, {-1, 0, 0}, {0, 0, -1}}},
        {"g(3)", {{0, 3, 0}, {0, 1, 0}, {-1, 0, 0}, {0, 0, -1}}},
        {"+(30)", {{0, 0, 0}, {-S, C, 0}, {-C, -S, 0}, {0, 0, -1}}},
        {"-(30)", {{0, 0, 0}, {S, C, 0}, {-C, S, 0}, {0, 0, -1}}},
        {"&(30)", {{0, 0, 0}, {0, C, -S}, {-1, 0, 0}, {0, -S, -C}}},
        {"^(30)", {{0, 0, 0}, {0, C, S}, {-1, 0, 0}, {0, S, -C}}},
        {"/(30)", {{0, 0, 0}, {0, 1, 0}, {-C, 0, -S}, {S, 0, -C}}},
        {"\\(30)", {{0, 0, 0}, {0, 1, 0}, {-C, 0, S}, {-S, 0, -C}}},
        {"|(30)", {{0, 0, 0}, {0, -1, 0}, {1, 0, 0}, {0, 0, -1}}},
        {"[+(30)F]", {{0, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, 0, -1}}},
        {"&(90)+(90)@v", {{0, 0, 0}, {-1, 0, 0}, {0, 0, 1}, {0, -1, 0}}},
        {"@R(0,0,2)", {{0, 0, 0}, {0, 0, 1}, {-1, 0, 0}, {0, 1, 0}}},
        {"@R(1,0,0,0,0,1)", {{0, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 0, 1}}},
        {"@M(1,2,3)", {{1, 2, 3}, {0, 1, 0}, {-1, 0, 0}, {0, 0, -1}}},
        {"@D(3)f", {{0, 3, 0}, {0, 1, 0}, {-1, 0, 0}, {0, 0, -1}}},
        {"@D(3)@Di(2)f", {{0, 6, 0}, {0, 1, 0}, {-1, 0, 0}, {0, 0, -1}}},
        {"@D(3)@Dd(2)f", {{0, 1.5, 0}, {0, 1, 0}, {-1, 0, 0}, {0, 0, -1}}},
        {"?(7,2)f", {{0, 2, 0}, {0, 1, 0}, {-1, 0, 0}, {0, 0, -1}}},
        {"XYZ", {{0, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, 0, -1}}},
    };
    for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
        State state = state_of(rows[i].symbols);
        g_test_message("%s: P %g %g %g, H %g %g %g, L %g %g %g, U %g %g %g", rows[i].symbols,
                       state.p[0], state.p[1], state.p[2], state.h[0], state.h[1], state.h[2],
                       state.l[0], state.l[1], state.l[2], state.u[0], state.u[1], state.u[2]);
        near3(state.p, rows[i].state.p);
        near3(state.h, rows[i].state.h);
        near3(state.l, rows[i].state.l);
        near3(state.u, rows[i].state.u);
    }
}

// ---- what is drawn ----------------------------------------------------------------------------

typedef struct Drawn {
    FrPlant *plant;
    FrLdrawn drawn;
    char *said;
} Drawn;

/// A view and an axiom, drawn.
static Drawn draw(const char *view_text, const char *axiom, FrMaterial *const *palette) {
    FrContext context = fr_context_default();
    context.diags = fr_diags_new();
    char *text = g_strdup_printf("w : %s\n", axiom);
    FrSource *view_source = fr_source_new("test.v", view_text, strlen(view_text));
    FrSource *source = fr_source_new("test.l", text, strlen(text));
    FrLview *view;
    FrLsystem *system;
    FrLderivation *derivation;
    Drawn made;
    g_assert_cmpint(fr_lview_read(view_source, NULL, &context, &view), ==, FR_OK);
    FrLoptions options = {.view = view};
    g_assert_cmpint(fr_lsystem_compile(source, &options, &context, &system), ==, FR_OK);
    FrLsettings settings = fr_lsettings_default();
    settings.view = view;
    settings.palette = palette;
    g_assert_cmpint(fr_lderivation_new(system, &settings, &context, &derivation), ==, FR_OK);
    g_assert_cmpint(fr_lderivation_plant(derivation, &context, &made.plant, &made.drawn), ==,
                    FR_OK);
    g_assert_true(fr_plant_is_valid(made.plant, NULL));
    made.said = diag_text(context.diags);
    fr_lderivation_free(derivation);
    fr_lsystem_free(system);
    fr_lview_free(view);
    fr_source_unref(source);
    fr_source_unref(view_source);
    fr_diags_free(context.diags);
    g_free(text);
    return made;
}

static void forget(Drawn *made) {
    fr_plant_free(made->plant);
    g_free(made->said);
}

#define CYLINDERS "line style: cylinder\n"

static float radius_of(const char *view, const char *axiom) {
    Drawn made = draw(view, axiom, NULL);
    float radius = made.plant->nodes.radius[made.plant->nodes.count - 1];
    forget(&made);
    return radius;
}

static void widths(void) {
    const char *view = CYLINDERS "initial line width: 1 s\nline width increment: 0.2\n";
    g_assert_cmpfloat_with_epsilon(radius_of(view, "#(3)F"), 1.5, 1e-6);
    g_assert_cmpfloat_with_epsilon(radius_of(view, "!(3)F"), 1.5, 1e-6);
    g_assert_cmpfloat_with_epsilon(radius_of(view, "#F"), 0.6, 1e-6);
    g_assert_cmpfloat_with_epsilon(radius_of(view, "!F"), 0.4, 1e-6);
    g_assert_cmpfloat_with_epsilon(radius_of(view, "@D(2)#(3)F"), 3, 1e-6);
    g_assert_cmpfloat_with_epsilon(radius_of(view, "!(0)F"), 0, 1e-6);
    g_assert_cmpfloat_with_epsilon(radius_of(view, "[#(3)]F"), 0.5, 1e-6);
}

static void cuts(void) {
    Drawn past = draw(CYLINDERS, "F[F%F]F", NULL);
    Drawn cut = draw(CYLINDERS "interpretation past %: off\n", "F[F%F]F", NULL);
    Drawn conditional = draw(CYLINDERS, "F[F@mc(1)F]F[F@mc(0)F]", NULL);
    g_assert_cmpuint(past.drawn.segments, ==, 4);
    g_assert_cmpuint(cut.drawn.segments, ==, 3);
    g_assert_cmpuint(conditional.drawn.segments, ==, 5);
    forget(&past);
    forget(&cut);
    forget(&conditional);
}

static float end_x(const char *view, const char *axiom) {
    Drawn made = draw(view, axiom, NULL);
    float x = made.plant->nodes.position[made.plant->nodes.count - 1].x;
    forget(&made);
    return x;
}

static void tropisms(void) {
    const char *view = CYLINDERS "tropism: T: 1 0 0 E: 0.2 S: 0.1\n";
    float plain = end_x(view, "F");
    g_assert_cmpfloat_with_epsilon(plain, sinf(0.2F), 1e-5);
    g_assert_cmpfloat_with_epsilon(end_x(view, "@Ts(1,0.4)F"), sinf(0.4F), 1e-5);
    g_assert_cmpfloat_with_epsilon(end_x(view, "@Ts(1)F"), 0, 1e-5);
    g_assert_cmpfloat_with_epsilon(end_x(view, "@Ti(1)F"), sinf(0.3F), 1e-5);
    g_assert_cmpfloat_with_epsilon(end_x(view, "@T(1,0.2)F"), sinf(0.4F), 1e-5);
    g_assert_cmpfloat_with_epsilon(end_x(view, "@Td(1,0.05)F"), sinf(0.15F), 1e-5);
    g_assert_cmpfloat_with_epsilon(end_x(view, "@Tx(1)F"), plain, 1e-7);
    const char *old = CYLINDERS "tropism direction: 1,0,0\nelasticity increment: 0.3\n";
    g_assert_cmpfloat_with_epsilon(end_x(old, "FF"), 0, 1e-6);
    g_assert_cmpfloat(fabsf(end_x(old, "_(0.3)FF")), >, 0.1);
    g_assert_cmpfloat_with_epsilon(end_x(old, "_FF"), end_x(old, "_(0.3)FF"), 1e-6);
}

static void solids(void) {
    Drawn ball = draw(CYLINDERS, "f(2)@O(0.5)", NULL);
    g_assert_cmpuint(ball.drawn.spheres, ==, 1);
    g_assert_cmpfloat_with_epsilon(ball.drawn.max[1], 2.25, 1e-6);
    forget(&ball);
    Drawn discs = draw(CYLINDERS "initial line width: 0.1 s\n", "@o(1)@c(2)@bo(1)@bc(2)@o", NULL);
    g_assert_cmpuint(discs.drawn.discs, ==, 5);
    g_assert_cmpuint(discs.plant->organs.count, ==, 5);
    // A ring is hollow: no corner is nearer than half its diameter less the line width.
    const FrShape *ring =
        &g_array_index(discs.plant->shapes, FrShape, discs.plant->organs.shape[3]);
    g_assert_cmpint(ring->kind, ==, FR_SHAPE_MESH);
    const FrProfile *corners = &g_array_index(discs.plant->profiles, FrProfile, ring->detail);
    for (uint32_t i = 0; i < corners->count; i += 2) {
        double x = corners->points[i][0], y = corners->points[i][1], z = corners->points[i + 1][0];
        g_assert_cmpfloat_with_epsilon(y, 0, 1e-6);
        g_assert_cmpfloat(hypot(x, z), >, 0.9 - 1e-3);
    }
    forget(&discs);
}

static void patches(void) {
    // The control points lie on a plane square of side 3: so does the patch.
    GString *axiom = g_string_new("@PS(1)");
    for (int row = 0; row < 4; row++) {
        for (int column = 0; column < 4; column++) {
            g_string_append_printf(axiom, "[@M(%d,%d,0)@PC(1,%d,%d)]", row, column, row, column);
        }
    }
    g_string_append(axiom, "@PD(1,3,2)");
    Drawn made = draw(CYLINDERS, axiom->str, NULL);
    g_assert_cmpuint(made.drawn.surfaces, ==, 1);
    g_assert_cmpuint(made.plant->organs.count, ==, 1);
    g_assert_cmpfloat_with_epsilon(made.drawn.max[0], 3, 1e-6);
    g_assert_cmpfloat_with_epsilon(made.drawn.max[1], 3, 1e-6);
    const FrShape *shape = &g_array_index(made.plant->shapes, FrShape, 0);
    g_assert_cmpuint(g_array_index(made.plant->profiles, FrProfile, shape->detail).count, ==,
                     2 * 6 * 3 * 2);
    forget(&made);
    // A uniform B-spline only reaches the middle square; without all 16 points nothing is drawn.
    g_string_assign(axiom, "@PS(1,2)");
    for (int i = 0; i < 16; i++) {
        g_string_append_printf(axiom, "[@M(%d,%d,0)@PC(1,%d,%d)]", i / 4, i % 4, i / 4, i % 4);
    }
    g_string_append(axiom, "@PD(1)");
    made = draw(CYLINDERS, axiom->str, NULL);
    shape = &g_array_index(made.plant->shapes, FrShape, 0);
    const FrProfile *corners = &g_array_index(made.plant->profiles, FrProfile, shape->detail);
    double least = INFINITY, most = 0;
    for (uint32_t i = 0; i < corners->count; i += 2) {
        double x = fabs(corners->points[i][0]) * (double)made.plant->organs.scale[0];
        least = fmin(least, x);
        most = fmax(most, x);
    }
    g_assert_cmpfloat_with_epsilon(least, 1, 1e-3);
    g_assert_cmpfloat_with_epsilon(most, 2, 1e-3);
    forget(&made);
    g_string_free(axiom, TRUE);
    Drawn none = draw(CYLINDERS, "@PS(1)@PC(1,0,0)@PD(1)", NULL);
    g_assert_cmpuint(none.plant->organs.count, ==, 0);
    forget(&none);
}

/// Radii along the only axis.
static void check_radii(const char *axiom, double quarter, double half) {
    Drawn made = draw(CYLINDERS, axiom, NULL);
    g_assert_cmpuint(made.drawn.cylinders, ==, 1);
    g_assert_cmpuint(made.plant->nodes.count, ==, 4);
    g_assert_cmpfloat_with_epsilon(made.plant->nodes.radius[0], quarter, 1e-5);
    g_assert_cmpfloat_with_epsilon(made.plant->nodes.radius[1], half, 1e-5);
    forget(&made);
}

static void cylinders(void) {
    check_radii("#(2)@Gsf(4)#(4)@Ge(4)", 1.25, 1.5);
    check_radii("#(2){(1,4).#(4)f(4)}(1)", 1.25, 1.5);
    // Radius tangents along the axis at both ends: it goes over from 1 to 2 as a Hermite curve,
    // 3t² − 2t³ where the axis is followed evenly (a third of the span each).
    check_radii("@Gr(1)@Gr(0,1)#(2)@Gsf(4)#(4)@Ge(4)", 1 + 3.0 / 16 - 2.0 / 64, 1.5);
    // Rising by 45° at its begin.
    Drawn made = draw(CYLINDERS, "@Gr(1)@Gr(0,1,45,1)#(1)@Gsf(4)#(1)@Ge(8)", NULL);
    g_assert_cmpfloat(made.plant->nodes.radius[1], >, 0.6);
    forget(&made);
    Drawn closed = draw(CYLINDERS, "{(2).+(90)f(1)+(90)f(1)+(90)f(1)}(2)", NULL);
    const FrNodes *nodes = &closed.plant->nodes;
    vec3s last = nodes->position[nodes->count - 1];
    g_assert_cmpfloat_with_epsilon(last.x, 0, 1e-4);
    g_assert_cmpfloat_with_epsilon(last.z, 0, 1e-4);
    forget(&closed);
}

// ---- colours ----------------------------------------------------------------------------------

static void colours(void) {
    FrMaterial *materials[256] = {0};
    FrMaterialParams params;
    fr_params_init(fr_material_table(), &params);
    const unsigned indices[] = {3, 4, 128};
    for (size_t i = 0; i < G_N_ELEMENTS(indices); i++) {
        char *name = g_strdup_printf("c%u", indices[i]);
        materials[indices[i]] = fr_material_new(name, &params, NULL, (FrSpan){0});
        g_free(name);
    }
    Drawn made = draw(CYLINDERS, "F;(3)F;F,F[;(128)F]F@O", materials);
    const FrAxes *axes = &made.plant->axes;
    static const char *const expected[] = {"c128", "c3", "c4", "c3", "c128"};
    g_assert_cmpuint(axes->count, ==, G_N_ELEMENTS(expected));
    for (uint32_t i = 0; i < axes->count; i++) {
        const FrMaterial *material = g_ptr_array_index(made.plant->materials, axes->material[i]);
        g_assert_cmpstr(fr_material_name(material), ==, expected[i]);
    }
    g_assert_cmpstr(
        fr_material_name(g_ptr_array_index(made.plant->materials, made.plant->organs.material[0])),
        ==, "c3");
    forget(&made);
    Drawn plain = draw(CYLINDERS, "F;(3)F;F", NULL);
    g_assert_cmpuint(plain.plant->axes.count, ==, 1);
    forget(&plain);
    for (size_t i = 0; i < G_N_ELEMENTS(indices); i++) {
        fr_material_unref(materials[indices[i]]);
    }
    fr_params_clear(fr_material_table(), &params);
}

static FrStatus grow_with_colours(const char *bytes, gsize size, FrPlant **plant) {
    char *folder = g_dir_make_tmp("frond-XXXXXX", NULL);
    char *file = g_build_filename(folder, "a.map", NULL);
    g_assert_true(g_file_set_contents(file, bytes, (gssize)size, NULL));
    FrLsystemParams params;
    fr_params_init(fr_lsystem_table(), &params);
    params.colour_map = g_strdup("a.map");
    FrLmodel *model = fr_lmodel_new(&params);
    FrContext context = fr_context_default();
    FrSource *source = fr_source_new("a.l", "w : ;(7)F", 9);
    FrStatus status = fr_lmodel_compile(model, source, folder, (FrSpan){0}, &context);
    if (status == FR_OK) {
        FrLsettings settings = fr_lmodel_settings(model);
        g_assert_cmpint(fr_lmodel_grow(model, &settings, &context, plant, NULL, NULL), ==, FR_OK);
    }
    fr_source_unref(source);
    fr_lmodel_free(model);
    fr_params_clear(fr_lsystem_table(), &params);
    g_unlink(file);
    g_rmdir(folder);
    g_free(file);
    g_free(folder);
    return status;
}

static void check_colour(const char *bytes, gsize size, float r, float g, float b) {
    FrPlant *plant;
    g_assert_cmpint(grow_with_colours(bytes, size, &plant), ==, FR_OK);
    const FrMaterial *material = g_ptr_array_index(plant->materials, plant->axes.material[0]);
    vec3s colour = fr_material_params(material)->colour;
    g_assert_cmpfloat_with_epsilon(colour.x, r, 1e-6);
    g_assert_cmpfloat_with_epsilon(colour.y, g, 1e-6);
    g_assert_cmpfloat_with_epsilon(colour.z, b, 1e-6);
    fr_plant_free(plant);
}

static void colour_files(void) {
    char map[768] = {0};
    map[21] = (char)255;
    map[22] = 51;
    check_colour(map, sizeof map, 1, 0.2F, 0);
    const char record[] = {7, 0, 9, 9, 9, 0, (char)255, 51, 1, 1, 1, 2, 2, 2, 40};
    check_colour(record, sizeof record, 0, 1, 0.2F);
    FrPlant *plant;
    g_assert_cmpint(grow_with_colours(map, 700, &plant), ==, FR_ERR_DOCUMENT);
}

// ---- what is left out -------------------------------------------------------------------------

static void left_out(void) {
    static const char *const axioms[] = {"@L(1)F", "@I(1)F", "@J(1)F", "@S(1)F",
                                         "@;(3)F", "@,(3)F", "@Tx(1)F"};
    for (size_t i = 0; i < G_N_ELEMENTS(axioms); i++) {
        Drawn made = draw(CYLINDERS, axioms[i], NULL);
        g_test_message("%s: %s", axioms[i], made.said);
        g_assert_nonnull(strstr(made.said, "[left-out]"));
        g_assert_cmpuint(made.drawn.segments, ==, 1);
        forget(&made);
    }
    static const char *const views[] = {"texture: F: a.rgb\n", "initial texture: 1\n"};
    for (size_t i = 0; i < G_N_ELEMENTS(views); i++) {
        Drawn made = draw(views[i], "F", NULL);
        g_assert_nonnull(strstr(made.said, "[left-out]"));
        forget(&made);
    }
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/lsystem/symbols/each moves and turns the turtle as defined", poses);
    g_test_add_func("/lsystem/symbols/widths are set, grown and scaled", widths);
    g_test_add_func("/lsystem/symbols/cuts end a branch where they should", cuts);
    g_test_add_func("/lsystem/symbols/tropisms are set, raised and lowered", tropisms);
    g_test_add_func("/lsystem/symbols/spheres, discs and rings have their sizes", solids);
    g_test_add_func("/lsystem/symbols/patches are drawn from sixteen points", patches);
    g_test_add_func("/lsystem/symbols/cylinders follow widths and radius tangents", cylinders);
    g_test_add_func("/lsystem/symbols/colours are materials where there is a map", colours);
    g_test_add_func("/lsystem/symbols/colour maps and materials are read", colour_files);
    g_test_add_func("/lsystem/symbols/what is left out is said", left_out);
    return g_test_run();
}
