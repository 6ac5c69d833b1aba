// What made what: every axis and organ names the production whose successor its symbol was in.
#include "lsystems.h"

static FrPlant *drawn(Derived *d, uint64_t steps) {
    FrPlant *plant;
    step(d, steps);
    g_assert_cmpint(fr_lderivation_plant(d->derivation, &d->context, &plant, NULL), ==, FR_OK);
    g_assert_true(fr_plant_is_valid(plant, NULL));
    return plant;
}

static const char *component(const FrPlant *plant, uint32_t index) {
    return g_array_index(plant->components, FrComponent, index).id;
}

static void axes(void) {
    Derived d = begin("w : FA\np1 : A -> [+B]FA\np2 : B -> F@O(1)\n", 1);
    FrPlant *plant = drawn(&d, 3);
    g_assert_cmpuint(plant->axes.count, ==, 3);
    g_assert_cmpstr(component(plant, plant->axes.component[0]), ==, "axiom");
    g_assert_cmpstr(component(plant, plant->axes.component[1]), ==, "p2");
    g_assert_cmpstr(component(plant, plant->axes.component[2]), ==, "p2");
    g_assert_cmpuint(plant->organs.count, ==, 2);
    g_assert_cmpstr(component(plant, plant->organs.component[1]), ==, "p2");
    FrSpan span = g_array_index(plant->components, FrComponent, plant->organs.component[0]).span;
    uint32_t line, column;
    fr_source_position(span.source, span.begin, &line, &column);
    g_assert_cmpuint(line, ==, 3);
    fr_plant_free(plant);
    end(&d);
}

// Modules that nothing rewrites stay what they were made by.
static void kept(void) {
    Derived d = begin("w : A\np1 : A -> B[+F]\np2 : B -> C\np3 : C -> [-F]\n", 1);
    FrPlant *plant = drawn(&d, 3);
    g_assert_cmpuint(plant->axes.count, ==, 2);
    g_assert_cmpstr(component(plant, plant->axes.component[0]), ==, "p3");
    g_assert_cmpstr(component(plant, plant->axes.component[1]), ==, "p1");
    fr_plant_free(plant);
    end(&d);
}

static void replaced(void) {
    Derived d = begin("Lsystem: 1\naxiom: A\nA --> FB\nA --> F\nhomomorphism\n"
                      "B --> [+F]\nendlsystem\n",
                      1);
    FrPlant *plant = drawn(&d, 1);
    g_assert_cmpuint(plant->axes.count, ==, 2);
    g_assert_cmpstr(component(plant, plant->axes.component[0]), ==, "A");
    g_assert_cmpstr(component(plant, plant->axes.component[1]), ==, "B");
    fr_plant_free(plant);
    end(&d);
}

static void check_origin(const Derived *d, uint32_t node, uint64_t module, const char *production) {
    FrLorigin origin;
    g_assert_true(fr_lderivation_origin(d->derivation, node, &origin));
    g_assert_cmpuint(origin.module, ==, module);
    g_assert_cmpstr(origin.production, ==, production);
}

// F F F[+F]F, of which all but the branch are one axis.
static void internodes(void) {
    Derived d = begin("w : FA\np1 : A -> FB\np2 : B -> F[+F]F\n", 1);
    FrLsettings settings = fr_lsettings_default();
    FrLorigin origin;
    g_assert_false(fr_lderivation_origin(d.derivation, 0, &origin));
    settings.keeps_origins = true;
    fr_lderivation_free(d.derivation);
    g_assert_cmpint(fr_lderivation_new(d.system, &settings, &d.context, &d.derivation), ==, FR_OK);
    FrPlant *plant = drawn(&d, 2);
    g_assert_cmpuint(plant->axes.count, ==, 2);
    check_origin(&d, 0, 0, NULL);
    check_origin(&d, 1, 1, "p1");
    check_origin(&d, 2, 2, "p2");
    check_origin(&d, 3, 5, "p2");
    check_origin(&d, 4, 7, "p2");
    g_assert_false(fr_lderivation_origin(d.derivation, 5, &origin));
    fr_plant_free(plant);
    end(&d);
}

// F [+F] and two balls, the second by homomorphism.
static void organs(void) {
    Derived d = begin("Lsystem: 1\naxiom: A\nA --> F@O(1)[+FB]\nhomomorphism\n"
                      "B --> @O(2)\nendlsystem\n",
                      1);
    FrLsettings settings = fr_lsettings_default();
    settings.keeps_origins = true;
    fr_lderivation_free(d.derivation);
    g_assert_cmpint(fr_lderivation_new(d.system, &settings, &d.context, &d.derivation), ==, FR_OK);
    FrPlant *plant = drawn(&d, 1);
    FrLorigin origin;
    g_assert_cmpuint(plant->organs.count, ==, 2);
    g_assert_true(fr_lderivation_organ_origin(d.derivation, 0, &origin));
    g_assert_cmpuint(origin.module, ==, 2); // @ and O are two
    g_assert_cmpstr(origin.production, ==, "A");
    g_assert_true(fr_lderivation_organ_origin(d.derivation, 1, &origin));
    g_assert_cmpuint(origin.module, ==, 6);
    g_assert_cmpstr(origin.production, ==, "B");
    g_assert_false(fr_lderivation_organ_origin(d.derivation, 2, &origin));
    fr_plant_free(plant);
    end(&d);
}

// What the turtle does not write is as in any plant.
static void fresh(void) {
    Derived d = begin("w : F[+F]F\n", 1);
    FrPlant *plant = drawn(&d, 0);
    for (uint32_t i = 0; i < plant->nodes.count; i++) {
        g_assert_cmpfloat(plant->nodes.flatness[i], ==, 1);
        g_assert_cmpuint(plant->nodes.flags[i], ==, 0);
    }
    g_assert_cmpuint(plant->axes.order[1], ==, 1);
    g_assert_cmpuint(plant->axes.flags[1], ==, 0);
    g_assert_cmpuint(plant->axes.finish[1], ==, FR_NONE);
    g_assert_cmpuint(plant->axes.deformer[1], ==, FR_NONE);
    g_assert_cmpuint(plant->axes.profile[1], ==, FR_NONE);
    fr_plant_free(plant);
    end(&d);
}

// Two productions of one predecessor are told apart.
static void numbered(void) {
    Derived d = begin("Lsystem: 1\naxiom: A(0)\nA(x) : x < 1 --> FA(x+1)\n"
                      "A(x) : x > 0 --> [+F]\nendlsystem\n",
                      1);
    FrPlant *plant = drawn(&d, 2);
    g_assert_cmpstr(component(plant, plant->axes.component[0]), ==, "A(x)");
    g_assert_cmpstr(component(plant, plant->axes.component[1]), ==, "A(x) #2");
    fr_plant_free(plant);
    end(&d);
}

static void parallel(void) {
    FrDigest first = 0;
    for (int threads = 1; threads <= 3; threads++) {
        Derived d = begin("w : A\np1 : A -> F[+A]B\np2 : B -> F[-B]A\n", threads);
        FrPlant *plant = drawn(&d, 15);
        FrDigest digest = fr_plant_digest(plant);
        first = threads == 1 ? digest : first;
        g_assert_cmpuint(plant->axes.count, >, 10000);
        g_assert_cmpuint(digest, ==, first);
        fr_plant_free(plant);
        end(&d);
    }
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/lsystem/made/axes and organs name their productions", axes);
    g_test_add_func("/lsystem/made/what nothing rewrites keeps its production", kept);
    g_test_add_func("/lsystem/made/homomorphism makes what it replaces", replaced);
    g_test_add_func("/lsystem/made/productions of one predecessor are told apart", numbered);
    g_test_add_func("/lsystem/made/every internode knows its module and production", internodes);
    g_test_add_func("/lsystem/made/every organ knows its module and production", organs);
    g_test_add_func("/lsystem/made/rows hold what those of other engines hold", fresh);
    g_test_add_func("/lsystem/made/threads make the same", parallel);
    return g_test_run();
}
