/// The wind that is looked at.
#include "studio/model/wind.h"

#include "studio.h"

static void test_direction(void) {
    StudioWind wind = studio_wind_default();
    float gust[4], east[4];
    wind.strength = 1;
    wind.direction = 0; // towards the north, which is y
    studio_wind_gust(&wind, 7, gust);
    g_assert_cmpfloat_with_epsilon(gust[0], 0, 1e-6);
    g_assert_cmpfloat_with_epsilon(gust[1], 0.27, 1e-6);
    g_assert_cmpfloat(gust[3], ==, 7);
    wind.direction = 90;
    wind.strength = 0.5;
    studio_wind_gust(&wind, 7, east);
    g_assert_cmpfloat_with_epsilon(east[0], 0.5f * gust[1], 1e-6);
    g_assert_cmpfloat_with_epsilon(east[1], 0, 1e-6);
}

static void test_time(void) {
    StudioWind wind = studio_wind_default(), fast = wind;
    fast.speed = 2;
    for (int i = 0; i < 10; i++) {
        studio_wind_advance(&wind, 0.02);
        studio_wind_advance(&fast, 0.02);
    }
    g_assert_cmpfloat_with_epsilon(wind.phase, 0.2, 1e-9);
    g_assert_cmpfloat_with_epsilon(fast.phase, 0.4, 1e-9);
    studio_wind_advance(&wind, 1000);
    g_assert_cmpfloat_with_epsilon(wind.phase, 0.3, 1e-9);
}

static void test_own(void) {
    static const char text[] = "<frond version=\"1\"><plant id=\"p\"><pgraph/>"
                               "<nurbs wind=\"3, 4, -1\"/></plant></frond>\n";
    StudioDocument *document = studio_document_new(text, strlen(text), "wind", NULL);
    uint32_t plant = first_plant(document);
    double strength, direction;
    g_assert_true(studio_wind_read(document, plant, &strength, &direction));
    g_assert_cmpfloat_with_epsilon(strength, 5, 1e-9);
    g_assert_cmpfloat_with_epsilon(direction, 36.8698976, 1e-6);
    g_assert_true(studio_wind_write(document, plant, 0.25, 90));
    g_assert_true(studio_wind_write(document, plant, 0.5, 90));
    g_assert_cmpuint(studio_document_steps(document), ==, 1);
    g_assert_true(studio_wind_read(document, plant, &strength, &direction));
    g_assert_cmpfloat_with_epsilon(strength, 0.5, 1e-9);
    g_assert_cmpfloat_with_epsilon(direction, 90, 1e-6);
    g_assert_nonnull(strstr(text_of(document), "-1\""));
    g_assert_true(studio_document_undo(document));
    g_assert_cmpstr(text_of(document), ==, text);
    studio_document_free(document);
}

static void test_none(void) {
    static const char *const texts[] = {
        "<frond version=\"1\"><plant id=\"p\"><pgraph/></plant></frond>\n",
        "<frond version=\"1\"><plant id=\"p\"><pgraph/><nurbs wind=\"=a,0,0\"/></plant></frond>\n",
        "<frond version=\"1\"><plant id=\"p\"><pgraph/><nurbs wind=\"1, 2\"/></plant></frond>\n"};
    for (size_t i = 0; i < G_N_ELEMENTS(texts); i++) {
        StudioDocument *document = studio_document_new(texts[i], strlen(texts[i]), "none", NULL);
        double strength, direction;
        uint32_t plant = first_plant(document);
        g_assert_false(studio_wind_read(document, plant, &strength, &direction));
        g_assert_false(studio_wind_write(document, plant, 1, 0));
        g_assert_cmpstr(text_of(document), ==, texts[i]);
        studio_document_free(document);
    }
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/studio/wind/it blows where it is told, as far as it is strong",
                    test_direction);
    g_test_add_func("/studio/wind/gusts follow its speed and do not jump after a pause", test_time);
    g_test_add_func("/studio/wind/that of a plant is set as one step and keeps its height",
                    test_own);
    g_test_add_func("/studio/wind/a plant without one, or with a formula, is left alone",
                    test_none);
    return g_test_run();
}
