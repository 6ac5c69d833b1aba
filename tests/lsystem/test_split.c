// The walk in parts, held against the walk in one piece: every column, and what was drawn.
#include "lsystems.h"

#include "plant/columns.h"

/// Each grows a string of some hundred thousand words that branches.
static const struct {
    const char *text;
    uint64_t steps;
} models[] = {
    // Turns of all kinds, widths, and axes that go on behind branches.
    {"w : A(1,10)\np1 : A(l,w) -> !(w)F(l)[&(45)B(l*0.6,w*0.7)]/(137.5)A(l*0.9,w*0.7)\n"
     "p2 : B(l,w) -> !(w)F(l)[-(45)C(l*0.6,w*0.7)]C(l*0.9,w*0.7)\n"
     "p3 : C(l,w) -> !(w)F(l)[+(45)B(l*0.6,w*0.7)]|B(l*0.9,w*0.7)\n",
     13},
    // Jumps with and without length begin axes beside the tip, or do not; moves without length.
    {"w : A(1)\np1 : A(x) -> "
     "f(x)F(x)[+(30)A(x*0.8)][^(20)f(0)F(0)A(x*0.7)]F(0)G(-x)[[f(0.1)F]F]F\n",
     10},
    // Branches that begin on nodes of parts long before.
    {"w : F[A][B]F(2)[[A]B]\np1 : A -> [+F]AA\np2 : B -> F[-(3)F][&F]\\\\(9)BB\n", 13},
    // More ends of branches than there are branches.
    {"w : F]]A(1)\np1 : A(x) -> F(x)[+(30)A(x*0.8)][-(20)A(x*0.9)]F\n", 13},
    // One line: nothing of it ends.
    {"w : F\np1 : F -> F+F-F\n", 11},
    // A polygon among it.
    {"w : {F+F}A(1)\np1 : A(x) -> F(x)[+(30)A(x*0.8)][-(20)A(x*0.9)]F\n", 13},
};

static void compare(const void *a, const void *b, const FrColumns *columns, const char *table,
                    uint32_t count) {
    for (size_t c = 0; c < columns->count; c++) {
        const FrColumn *column = &columns->columns[c];
        const char *x = fr_column_data(a, column), *y = fr_column_data(b, column);
        for (uint32_t i = 0; i < count; i++) {
            if (memcmp(x + i * column->width, y + i * column->width, column->width) != 0) {
                g_error("column %zu of %s differs in row %u", c, table, i);
            }
        }
    }
}

static FrPlant *drawn_by(const char *text, uint64_t steps, int threads, FrLdrawn *drawn) {
    Derived d = begin(text, threads);
    step(&d, steps);
    FrPlant *plant;
    g_assert_cmpint(fr_lderivation_plant(d.derivation, &d.context, &plant, drawn), ==, FR_OK);
    end(&d);
    return plant;
}

static void same_bits(void) {
    for (size_t i = 0; i < G_N_ELEMENTS(models); i++) {
        FrLdrawn one, many;
        FrPlant *whole = drawn_by(models[i].text, models[i].steps, 1, &one);
        for (int threads = 2; threads <= 8; threads += threads == 3 ? 5 : 1) {
            FrPlant *plant = drawn_by(models[i].text, models[i].steps, threads, &many);
            g_test_message("model %zu, %d threads", i, threads);
            g_assert_cmpuint(plant->nodes.count, ==, whole->nodes.count);
            g_assert_cmpuint(plant->axes.count, ==, whole->axes.count);
            compare(&plant->nodes, &whole->nodes, &fr_node_columns, "nodes", whole->nodes.count);
            compare(&plant->axes, &whole->axes, &fr_axis_columns, "axes", whole->axes.count);
            g_assert_cmpuint(fr_plant_digest(plant), ==, fr_plant_digest(whole));
            g_assert_true(memcmp(&one, &many, sizeof one) == 0);
            fr_plant_free(plant);
        }
        fr_plant_free(whole);
    }
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/lsystem/split/parts on any number of threads have the bits of one walk",
                    same_bits);
    return g_test_run();
}
