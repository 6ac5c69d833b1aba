// What the turtle draws, against the definitions of its symbols, and how it becomes a plant.
#include "lsystems.h"

#include <math.h>

static FrPlant *draw(Derived *d, const char *text, uint64_t steps, FrLdrawn *drawn) {
    *d = begin(text, 1);
    step(d, steps);
    FrPlant *plant;
    g_assert_cmpint(fr_lderivation_plant(d->derivation, &d->context, &plant, drawn), ==, FR_OK);
    char *why = NULL;
    if (!fr_plant_is_valid(plant, &why)) {
        g_error("%s", why);
    }
    return plant;
}

static void check_point(vec3s point, float x, float y, float z) {
    g_assert_cmpfloat_with_epsilon(point.x, x, 1e-5F);
    g_assert_cmpfloat_with_epsilon(point.y, y, 1e-5F);
    g_assert_cmpfloat_with_epsilon(point.z, z, 1e-5F);
}

/// Where the last internode of an axiom ends, in the plant's coordinates.
static void check_end(const char *axiom, float x, float y, float z) {
    char *text = g_strdup_printf("w : %s\n", axiom);
    Derived d;
    FrPlant *plant = draw(&d, text, 0, NULL);
    check_point(plant->nodes.position[plant->nodes.count - 1], x, y, z);
    fr_plant_free(plant);
    end(&d);
    g_free(text);
}

// H = (0,1,0), L = (−1,0,0), U = (0,0,−1) in the file; its y is the plant's z, its −z the y.
static void test_symbols(void) {
    check_end("F(2)", 0, 0, 2);
    check_end("+(90)F", -1, 0, 0);
    check_end("-(90)F", 1, 0, 0);
    check_end("&(90)F", 0, 1, 0);
    check_end("^(90)F", 0, -1, 0);
    check_end("/(90)+(90)F", 0, 1, 0);
    check_end("\\(90)+(90)F", 0, -1, 0);
    check_end("|F", 0, 0, -1);
    check_end("FF(3)", 0, 0, 4);
    check_end("Ff(2)F", 0, 0, 4);
    check_end("[+(90)F]F", 0, 0, 1);
    check_end("@D(3)F", 0, 0, 3);
    check_end("@M(1,2,3)F", 1, -3, 3);
    check_end("@R(1,0,0)F", 1, 0, 0);
    check_end("+(30)@v&(90)F", -0.8660254F, 0, -0.5F);
}

static void test_axes(void) {
    Derived d;
    FrLdrawn drawn;
    FrPlant *plant = draw(&d, "w : F[+F[-F]F]F[-F]F\n", 0, &drawn);
    // The stem goes on behind its branches.
    g_assert_cmpuint(plant->axes.count, ==, 4);
    g_assert_cmpuint(plant->nodes.count, ==, 7);
    g_assert_cmpuint(drawn.segments, ==, 7);
    g_assert_cmpfloat_with_epsilon(drawn.length, 7, 1e-9);
    uint32_t length = 0;
    for (uint32_t n = plant->axes.first[0]; n != FR_NONE; n = plant->nodes.next[n]) {
        length++;
    }
    g_assert_cmpuint(length, ==, 3);
    g_assert_cmpuint(plant->axes.order[1], ==, 1);
    g_assert_cmpuint(plant->axes.order[2], ==, 2);
    fr_plant_free(plant);
    end(&d);
}

static void test_jump(void) {
    Derived d;
    FrPlant *plant = draw(&d, "w : F+(90)f(2)F\n", 0, NULL);
    g_assert_cmpuint(plant->axes.count, ==, 2);
    check_point(fr_plant_axis_origin(plant, 1), -2, 0, 1);
    fr_plant_free(plant);
    end(&d);
}

// A width set between two segments ends the first one: a cone.
static void test_taper(void) {
    Derived d;
    FrPlant *plant = draw(&d, "w : !(0.4)F!(0.2)F\n", 0, NULL);
    g_assert_cmpfloat_with_epsilon(plant->nodes.radius[0], plant->nodes.radius[1], 1e-7F);
    g_assert_cmpfloat_with_epsilon(plant->axes.base_radius[0], 2 * plant->nodes.radius[0], 1e-6F);
    fr_plant_free(plant);
    end(&d);
}

static void test_homomorphism(void) {
    Derived d;
    FrLdrawn drawn;
    const char text[] = "Lsystem: 1\naxiom: A\nB --> B\nhomomorphism\nmaximum depth: 3\n"
                        "A --> FB\nB --> FC\nC --> F\nendlsystem\n";
    FrPlant *plant = draw(&d, text, 0, &drawn);
    g_assert_cmpuint(drawn.segments, ==, 3);
    check_now(&d, "A");
    FrLstring *string;
    g_assert_cmpint(fr_lderivation_homomorphism(d.derivation, &d.context, &string), ==, FR_OK);
    GString *out = g_string_new(NULL);
    fr_lstring_print(string, out);
    g_assert_cmpstr(out->str, ==, "FFF");
    g_string_free(out, TRUE);
    fr_lstring_free(string);
    fr_plant_free(plant);
    end(&d);
}

static void test_polygons(void) {
    Derived d;
    FrLdrawn drawn;
    FrPlant *plant =
        draw(&d, "w : F[+{.f-(90)f-(90)f-(90)f}]F[&{.f-(90)f-(90)f-(90)f}]\n", 0, &drawn);
    g_assert_cmpuint(drawn.polygons, ==, 2);
    g_assert_cmpuint(plant->organs.count, ==, 2);
    g_assert_cmpuint(plant->shapes->len, ==, 1); // equal leaves share a shape
    vec3s position;
    versors rotation;
    fr_plant_organ_pose(plant, 1, &position, &rotation);
    check_point(position, 0, 0, 2);
    fr_plant_free(plant);
    end(&d);
}

static void test_monopodial(void) {
    Derived d;
    FrLdrawn drawn;
    const char text[] = "w : A(1,10)\n"
                        "p1 : A(l,w) -> !(w)F(l)[&(45)B(l*0.6,w*0.707)]/(137.5)A(l*0.9,w*0.707)\n"
                        "p2 : B(l,w) -> !(w)F(l)[-(45)$C(l*0.6,w*0.707)]C(l*0.9,w*0.707)\n"
                        "p3 : C(l,w) -> !(w)F(l)[+(45)$B(l*0.6,w*0.707)]B(l*0.9,w*0.707)\n";
    FrPlant *plant = draw(&d, text, 10, &drawn);
    g_assert_cmpuint(drawn.segments, ==, (1 << 10) - 1);
    g_assert_cmpuint(plant->nodes.count, ==, (1 << 10) - 1);
    g_assert_cmpuint(plant->axes.count, ==, 1 << 9);
    // The stem is straight: Σ 0.9^k for k < 10.
    uint32_t tip = plant->axes.last[0];
    check_point(plant->nodes.position[tip], 0, 0, (float)((1 - pow(0.9, 10)) / 0.1));
    fr_plant_free(plant);
    end(&d);
}

static void test_queries(void) {
    Derived d = begin("w : F?P(0,0,0)[+(90)F?P(0,0,0)]?H(0,0,0)X\np1 : X -> X\n", 1);
    step(&d, 1);
    check_now(&d, "F?P(0,1,0)[+(90)F?P(-1,1,0)]?H(0,1,0)X");
    end(&d);
}

static void check_open(const char *text, FrLsimple *simple, const char *const *expected,
                       size_t count) {
    FrContext context = fr_context_default();
    FrSource *source = fr_source_new("open.l", text, strlen(text));
    FrLsystem *system;
    FrLderivation *derivation;
    g_assert_cmpint(fr_lsystem_compile(source, NULL, &context, &system), ==, FR_OK);
    FrEnvironment environment = fr_lsimple_environment(simple);
    FrLsettings settings = fr_lsettings_default();
    settings.environment = &environment;
    g_assert_cmpint(fr_lderivation_new(system, &settings, &context, &derivation), ==, FR_OK);
    for (size_t i = 0; i < count; i++) {
        GString *out = g_string_new(NULL);
        fr_lstring_print(fr_lderivation_string(derivation), out);
        g_assert_cmpstr(out->str, ==, expected[2 * i]);
        g_assert_cmpint(fr_lderivation_ask(derivation, &context), ==, FR_OK);
        g_string_truncate(out, 0);
        fr_lstring_print(fr_lderivation_string(derivation), out);
        g_assert_cmpstr(out->str, ==, expected[2 * i + 1]);
        g_string_free(out, TRUE);
        g_assert_cmpint(fr_lderivation_run(derivation, 1, &context), ==, FR_OK);
    }
    fr_lderivation_free(derivation);
    fr_lsystem_free(system);
    fr_source_unref(source);
}

// L-system 1 of van Haevre et al. with the limit of 8 degrees: light from the turtle's left.
static void test_bending(void) {
    FrLsimple simple = fr_lsimple_default();
    simple.light = (vec3s){{-1, 0, 0}};
    check_open("w : A\np1 : A -> FR(?,8)A\np2 : R(r,p) -> \\(r)&(p)/(r)\n", &simple,
               (const char *const[]){"A", "A", "FR(?,8)A", "FR(90,8)A", "F\\(90)&(8)/(90)FR(?,8)A",
                                     "F\\(90)&(8)/(90)FR(90,8)A"},
               3);
    // Bending far enough makes the heading point to the light.
    check_open("w : \\(90)&(90)/(90)R(?,?)\n", &simple,
               (const char *const[]){"\\(90)&(90)/(90)R(?,?)", "\\(90)&(90)/(90)R(0,0)"}, 1);
}

// L-system 2.
static void test_intensity(void) {
    FrLsimple simple = fr_lsimple_default();
    simple.intensity = 0.5F;
    check_open("f(i) = 2*i\ng(i) = 3*i\nh(i) = 4*i\n"
               "w : AI(?)F(0)I(?)W(0)\np1 : A -> I(?)F(0)[+(8)I(?)L(0)]A\n"
               "p2 : I(i) < W(0) -> W(f(i))\np3 : I(i) < L(0) -> L(g(i))\n"
               "p4 : I(i) < F(0) -> F(h(i))\n",
               &simple,
               (const char *const[]){"AI(?)F(0)I(?)W(0)", "AI(0.5)F(0)I(0.5)W(0)",
                                     "I(?)F(0)[+(8)I(?)L(0)]AI(0.5)F(2)I(0.5)W(1)",
                                     "I(0.5)F(0)[+(8)I(0.5)L(0)]AI(0.5)F(2)I(0.5)W(1)"},
               2);
}

// L-system 3, with fi as printed.
static void test_combined(void) {
    FrLsimple simple = fr_lsimple_default();
    simple.intensity = 0.25F;
    check_open("f(i) = 40*i\nw : A\np1 : A -> I(?)WF(1)A\np2 : I(i) < W -> R(?,fi)\n", &simple,
               (const char *const[]){"A", "A", "I(?)WF(1)A", "I(0.25)WF(1)A",
                                     "I(0.25)R(?,10)F(1)I(?)WF(1)A",
                                     "I(0.25)R(0,0)F(1)I(0.25)WF(1)A"},
               3);
}

static void open_polygons(void) {
    Derived d;
    fr_plant_free(draw(&d, "w : A\np1 : A -> {F+(90)F[{F}]\n", 1, NULL));
    g_assert_cmpuint(fr_diags_count(d.context.diags), ==, 1);
    const FrDiag *diag = fr_diags_get(d.context.diags, 0);
    g_assert_cmpstr(diag->code, ==, "polygon");
    uint32_t line, column;
    fr_source_position(diag->span.source, diag->span.begin, &line, &column);
    g_assert_cmpuint(line, ==, 2);
    end(&d);
    fr_plant_free(draw(&d, "w : {F+(90)F[{F}]}\n", 0, NULL));
    g_assert_cmpuint(fr_diags_count(d.context.diags), ==, 0);
    end(&d);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/lsystem/turtle/symbols turn and move as defined", test_symbols);
    g_test_add_func("/lsystem/turtle/axes go on behind their branches", test_axes);
    g_test_add_func("/lsystem/turtle/a jump begins an axis", test_jump);
    g_test_add_func("/lsystem/turtle/a width between segments makes a cone", test_taper);
    g_test_add_func("/lsystem/turtle/homomorphism is drawn but does not stay", test_homomorphism);
    g_test_add_func("/lsystem/turtle/polygons become organs of one shape", test_polygons);
    g_test_add_func("/lsystem/turtle/a monopodial tree has its axes", test_monopodial);
    g_test_add_func("/lsystem/turtle/queries are filled from the turtle", test_queries);
    g_test_add_func("/lsystem/turtle/branches bend to the light", test_bending);
    g_test_add_func("/lsystem/turtle/intensity sets sizes", test_intensity);
    g_test_add_func("/lsystem/turtle/intensity limits bending", test_combined);
    g_test_add_func("/lsystem/turtle/a polygon that nothing ends is told with its production",
                    open_polygons);
    return g_test_run();
}
