#include "plant/columns.h"
#include "trees.h"

/// A plant with several rows in every table, no two alike.
static FrPlant *full(void) {
    FrPlant *plant = tree_perfect(5);
    FrShape box = {.kind = FR_SHAPE_BOX, .size = {{1, 1, 1}}, .detail = 4};
    static const double line[2][2] = {{0, 0}, {1, 1}};
    fr_plant_add_shape(plant, &box);
    fr_plant_add_profile(plant, line, 2, false);
    FrDeformation deformation = {.kind = FR_DEFORM_NOTHING};
    fr_plant_add_deformation(plant, &deformation);
    fr_plant_append_deformers(plant, 1);
    g_array_index(plant->deformers, FrDeformer, 0).deformation = 0;
    fr_plant_append_organs(plant, 4);
    fr_plant_append_buds(plant, 3);
    return plant;
}

static void flip(FrPlant *plant, void *table, uint32_t count, const FrColumns *columns) {
    FrDigest before = fr_plant_digest(plant);
    for (size_t c = 0; c < columns->count; c++) {
        const FrColumn *column = &columns->columns[c];
        uint8_t *data = fr_column_data(table, column);
        size_t places[] = {0, count * column->width - 1};
        for (size_t p = 0; p < G_N_ELEMENTS(places); p++) {
            data[places[p]] ^= 1;
            FrDigest after = fr_plant_digest(plant);
            data[places[p]] ^= 1;
            g_test_message("column at offset %zu", column->offset);
            g_assert_true(column->is_cache ? after == before : after != before);
        }
    }
    g_assert_cmpuint(fr_plant_digest(plant), ==, before);
}

static void every_column(void) {
    FrPlant *plant = full();
    flip(plant, &plant->nodes, plant->nodes.count, &fr_node_columns);
    flip(plant, &plant->axes, plant->axes.count, &fr_axis_columns);
    flip(plant, &plant->organs, plant->organs.count, &fr_organ_columns);
    flip(plant, &plant->buds, plant->buds.count, &fr_bud_columns);
    fr_plant_free(plant);
}

static void small_tables(void) {
    FrPlant *plant = full();
    FrDigest before = fr_plant_digest(plant);
    g_array_index(plant->shapes, FrShape, 0).size.y = 2;
    FrDigest other_shape = fr_plant_digest(plant);
    g_assert_cmpuint(other_shape, !=, before);
    g_array_index(plant->profiles, FrProfile, 0).points[1][0] = 0.5;
    FrDigest other_profile = fr_plant_digest(plant);
    g_assert_cmpuint(other_profile, !=, other_shape);
    g_array_index(plant->profiles, FrProfile, 0).is_closed = true;
    FrDigest closed = fr_plant_digest(plant);
    g_assert_cmpuint(closed, !=, other_profile);
    g_array_index(plant->deformers, FrDeformer, 0).strength = 0.5F;
    g_assert_cmpuint(fr_plant_digest(plant), !=, closed);
    fr_plant_free(plant);
}

static void empty(void) {
    FrPlant *a = fr_plant_new("a");
    FrPlant *b = fr_plant_new("b");
    g_assert_cmpuint(fr_plant_digest(a), ==, fr_plant_digest(b));
    fr_plant_append_buds(b, 1);
    g_assert_cmpuint(fr_plant_digest(a), !=, fr_plant_digest(b));
    // Spare capacity is no part of it.
    fr_plant_append_buds(a, 1);
    for (int i = 0; i < 40; i++) {
        fr_plant_append_buds(b, 1);
    }
    b->buds.count = 1;
    g_assert_cmpuint(fr_plant_digest(a), ==, fr_plant_digest(b));
    fr_plant_free(a);
    fr_plant_free(b);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/plant/digest/one flipped bit of any column shows, of the cache it does not",
                    every_column);
    g_test_add_func("/plant/digest/shapes, profiles and deformers count", small_tables);
    g_test_add_func("/plant/digest/an empty plant has one, and spare memory is no part of it",
                    empty);
    return g_test_run();
}
