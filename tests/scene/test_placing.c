/// Rows of plants and plants strewn over areas.
#include "built.h"

#include <math.h>
#include <unistd.h>

#define POLE(id)                                                                                   \
    "<plant id='" id "'><pgraph><camera id='root'/><horn id='stem' length='2 ~ 1'/>"               \
    "<link from='root' to='stem'/></pgraph></plant>"
#define WOOD(scene) "<frond version='1'>" POLE("oak") POLE("elm") "<scene>" scene "</scene></frond>"

static uint32_t stands(const Built *built) {
    g_assert_cmpint(built->status, ==, FR_OK);
    return built->scene->stands->len;
}

static void test_row(void) {
    Built built = build(WOOD("<row plants='oak' spacing='2' turn='0'>0,0,0 6,0,0 6,4,1</row>"), -1);
    static const double places[][3] = {
        {0, 0, 0}, {2, 0, 0}, {4, 0, 0}, {6, 0, 0}, {6, 1.940285, 0.48507}, {6, 3.880570, 0.97014}};
    g_assert_cmpuint(stands(&built), ==, G_N_ELEMENTS(places));
    for (guint i = 0; i < G_N_ELEMENTS(places); i++) {
        for (int k = 0; k < 3; k++) {
            g_assert_cmpfloat_with_epsilon(stand_at(&built, i)->at[k], places[i][k], 1e-4);
        }
    }
    // A row turns its plants with its line.
    g_assert_cmpfloat_with_epsilon(stand_at(&built, 5)->turn, G_PI / 2, 1e-6);
    forget(&built);
}

static void test_rows(void) {
    Built built = build(
        WOOD("<row plants='oak' rows='3' between='5' spacing='10' staggered='yes'>0,0,0 40,0,0"
             "</row>"),
        -1);
    g_assert_cmpuint(stands(&built), ==, 14); // 5 + 4 + 5
    g_assert_cmpfloat(stand_at(&built, 0)->at[1], ==, -5);
    g_assert_cmpfloat(stand_at(&built, 5)->at[0], ==, 5);
    g_assert_cmpfloat(stand_at(&built, 13)->at[1], ==, 5);
    forget(&built);
}

/// A curve through three points of a circle leaves the chords.
static void test_curve(void) {
    Built built =
        build(WOOD("<row plants='oak' line='smooth' spacing='1'>-10,0,0 0,10,0 10,0,0</row>"), -1);
    guint count = stands(&built);
    g_assert_cmpuint(count, >, 28); // the chords are 28.3 m long
    double highest = 0;
    for (guint i = 0; i < count; i++) {
        const double *at = stand_at(&built, i)->at;
        highest = fmax(highest, fabs(at[0]) + fabs(at[1]));
        if (i > 0) {
            const double *last = stand_at(&built, i - 1)->at;
            g_assert_cmpfloat_with_epsilon(hypot(at[0] - last[0], at[1] - last[1]), 1, 0.02);
        }
    }
    g_assert_cmpfloat(highest, >, 10.3);
    forget(&built);
}

static double nearest(const Built *built) {
    double least = INFINITY;
    for (guint i = 0; i < built->scene->stands->len; i++) {
        for (guint k = 0; k < i; k++) {
            const double *a = stand_at(built, i)->at, *b = stand_at(built, k)->at;
            least = fmin(least, hypot(a[0] - b[0], a[1] - b[1]));
        }
    }
    return least;
}

static void test_blue_noise(void) {
    Built even = build(WOOD("<strew plants='oak' number='400' width='100' depth='25'/>"), -1);
    Built chance =
        build(WOOD("<strew plants='oak' number='400' width='100' depth='25' evenness='1'/>"), -1);
    g_assert_cmpuint(stands(&even), ==, 400);
    g_assert_cmpuint(stands(&chance), ==, 400);
    // 2500 m² for 400: a hexagonal lattice would stand 2.69 m apart.
    g_assert_cmpfloat(nearest(&even), >, 1.0);
    g_assert_cmpfloat(nearest(&chance), <, 0.5);
    for (guint i = 0; i < 400; i++) {
        const double *at = stand_at(&even, i)->at;
        g_assert_true(fabs(at[0]) <= 50 && fabs(at[1]) <= 12.5);
    }
    forget(&even);
    forget(&chance);
    Built apart = build(WOOD("<strew plants='oak' number='400' spacing='2' width='30' depth='30' "
                             "area='disc'/>"),
                        -1);
    g_assert_cmpuint(stands(&apart), <, 400);
    g_assert_cmpuint(stands(&apart), >, 80);
    g_assert_cmpfloat(nearest(&apart), >=, 2);
    forget(&apart);
}

/// What there is stays when there is more.
static void test_stable(void) {
    Built few = build(WOOD("<strew plants='oak 2, elm' number='30'/>"), -1);
    Built more = build(WOOD("<place plant='elm'/><strew plants='oak 2, elm' number='40'/>"), -1);
    g_assert_cmpuint(stands(&few), ==, 30);
    g_assert_cmpuint(stands(&more), ==, 41);
    for (guint i = 0; i < 30; i++) {
        const FrStand *a = stand_at(&few, i), *b = stand_at(&more, i + 1);
        g_assert_true(memcmp(a->at, b->at, sizeof a->at) == 0);
        g_assert_cmpfloat(a->turn, ==, b->turn);
        const FrPlant *p = plant_at(&few, a->plant)->plant, *q = plant_at(&more, b->plant)->plant;
        g_assert_cmpuint(fr_plant_digest(p), ==, fr_plant_digest(q));
    }
    forget(&few);
    forget(&more);
}

// The stands of one that has gaps are those of another without them, to the last bit.
static void check_gaps(const char *whole, const char *with_gaps, const uint32_t *gaps,
                       guint gap_count) {
    Built all = build(whole, -1), some = build(with_gaps, -1);
    g_assert_cmpuint(stands(&some), ==, stands(&all) - gap_count);
    for (guint i = 0, k = 0, gap = 0; i < stands(&all); i++) {
        FrStand one = *stand_at(&all, i);
        if (gap < gap_count && one.number == gaps[gap]) {
            gap++;
            continue;
        }
        const FrStand *other = stand_at(&some, k++);
        g_assert_true(memcmp(one.at, other->at, sizeof one.at) == 0);
        g_assert_cmpfloat(one.turn, ==, other->turn);
        g_assert_cmpuint(one.number, ==, other->number);
        g_assert_cmpuint(
            fr_plant_digest(g_array_index(all.scene->plants, FrScenePlant, one.plant).plant), ==,
            fr_plant_digest(g_array_index(some.scene->plants, FrScenePlant, other->plant).plant));
    }
    forget(&all);
    forget(&some);
}

static void test_except(void) {
    static const uint32_t gaps[] = {2, 7}, first[] = {0};
    check_gaps(WOOD("<strew plants='oak, elm' number='20' spacing='2'/>"),
               WOOD("<strew plants='oak, elm' number='20' spacing='2' except=' 7 2 1000 '/>"), gaps,
               2);
    check_gaps(WOOD("<row plants='oak, elm' spacing='1' rows='3' scatter='1'>0,0,0 9,0,0</row>"),
               WOOD("<row plants='oak, elm' spacing='1' rows='3' scatter='1' except='2 7 7'>0,0,0 "
                    "9,0,0</row>"),
               gaps, 2);
    Built none = build(WOOD("<place plant='elm'/><strew plants='oak' number='1' except='0'/>"), -1);
    g_assert_cmpuint(stands(&none), ==, 1);
    g_assert_cmpuint(fr_diags_count(none.diags), ==, 0);
    forget(&none);
    check_gaps(WOOD("<strew plants='oak' number='2'/>"),
               WOOD("<strew plants='oak' number='2' except='0'/>"), first, 1);
}

// What a place would say of one of a row makes that very plant there.
static void test_found(void) {
    Built row =
        build(WOOD("<row plants='oak, elm' spacing='3' scale='1 ~ 0.2'>0,0,0 9,0,0</row>"), -1);
    g_assert_cmpuint(stands(&row), ==, 4);
    const FrStand *stand = stand_at(&row, 2);
    FrContext context = fr_context_default();
    FrPlace place;
    g_assert_true(fr_scene_find_placed(row.document, stand->origin, 2, &context, &place));
    char *text = g_strdup_printf(
        WOOD("<place plant='%s' at='%.9g, %.9g, 0' turn='%.9g' scale='%.9g' seed='%.0f'/>"),
        place.plant, (double)place.at.x, (double)place.at.y, place.turn * 180 / G_PI, place.scale,
        (double)place.seed);
    Built one = build(text, -1);
    g_assert_cmpuint(stands(&one), ==, 1);
    g_assert_cmpfloat_with_epsilon(stand_at(&one, 0)->at[0], stand->at[0], 1e-5);
    g_assert_cmpfloat_with_epsilon(stand_at(&one, 0)->turn, stand->turn, 1e-6);
    g_assert_cmpuint(
        fr_plant_digest(g_array_index(one.scene->plants, FrScenePlant, 0).plant), ==,
        fr_plant_digest(g_array_index(row.scene->plants, FrScenePlant, stand->plant).plant));
    g_assert_false(fr_scene_find_placed(row.document, stand->origin, 4, &context, &place));
    g_assert_false(fr_scene_find_placed(row.document, stand->origin + 1, 2, &context, &place));
    g_free(text);
    forget(&one);
    forget(&row);
}

static void test_mix(void) {
    Built built = build(WOOD("<strew plants='oak 3, elm' number='4000' evenness='1' "
                             "individuals='2'/>"),
                        -1);
    g_assert_cmpuint(stands(&built), ==, 4000);
    g_assert_cmpuint(built.scene->plants->len, ==, 4); // two of each
    guint oaks = 0;
    for (guint i = 0; i < 4000; i++) {
        const FrPlant *plant = plant_at(&built, stand_at(&built, i)->plant)->plant;
        oaks += strcmp(plant->name, "oak") == 0;
    }
    g_assert_cmpuint(oaks, >, 2890); // 3000 ± 4 standard deviations
    g_assert_cmpuint(oaks, <, 3110);
    forget(&built);
    Built own = build(WOOD("<strew plants='oak' number='50' individuals='0'/>"), -1);
    g_assert_cmpuint(own.scene->plants->len, ==, 50);
    forget(&own);
}

/// A picture whose left half is white and whose right half is black or grey.
static char *write_picture(const char *folder, uint8_t right) {
    FrImage *image = fr_image_new(64, 64, 1);
    for (uint32_t i = 0; i < 64 * 64; i++) {
        image->pixels[i] = i % 64 < 32 ? 255 : right;
    }
    GBytes *png = fr_image_to_png(image);
    char *path = g_build_filename(folder, "map.png", NULL);
    gsize size;
    const void *data = g_bytes_get_data(png, &size);
    g_assert_true(g_file_set_contents(path, data, (gssize)size, NULL));
    g_bytes_unref(png);
    fr_image_unref(image);
    return path;
}

static guint count_left(const char *folder, const char *scene) {
    FrContext context = fr_context_default();
    Built built = {.diags = fr_diags_new()};
    context.diags = built.diags;
    FrSource *source = fr_source_new("wood.frond", scene, strlen(scene));
    g_assert_cmpint(fr_document_parse(source, folder, &context, &built.document), ==, FR_OK);
    built.status = fr_scene_build(built.document, -1, &context, &built.scene);
    guint left = 0;
    for (guint i = 0; i < stands(&built); i++) {
        left += stand_at(&built, i)->at[0] < 0;
    }
    g_assert_cmpuint(stands(&built), ==, 1000);
    forget(&built);
    fr_source_unref(source);
    return left;
}

static void test_density(void) {
    char *folder = g_dir_make_tmp("frond-XXXXXX", NULL);
    static const char scene[] = WOOD("<strew plants='oak' number='1000' density='map.png'/>");
    char *path = write_picture(folder, 0);
    g_assert_cmpuint(count_left(folder, scene), >=, 990); // the border is a pixel wide
    g_free(path);
    path = write_picture(folder, 85); // a third as dense
    guint left = count_left(folder, scene);
    g_assert_cmpuint(left, >, 700);
    g_assert_cmpuint(left, <, 800);
    unlink(path);
    rmdir(folder);
    g_free(path);
    g_free(folder);
}

static void assert_wrong(const char *scene, FrStatus status, const char *code) {
    Built built = build(scene, -1);
    g_test_message("%s", scene);
    g_assert_cmpint(built.status, ==, status);
    g_assert_cmpuint(fr_diags_error_count(built.diags), ==, 1);
    g_assert_cmpstr(fr_diags_get(built.diags, 0)->code, ==, code);
    g_assert_nonnull(fr_diags_get(built.diags, 0)->span.source);
    forget(&built);
}

static void test_wrong(void) {
    assert_wrong(WOOD("<row plants='ok'>0,0,0 1,0,0</row>"), FR_ERR_DOCUMENT, "unknown-plant");
    assert_wrong(WOOD("<row plants='oak'>0,0,0</row>"), FR_ERR_DOCUMENT, "bad-stroke");
    assert_wrong(WOOD("<row plants='oak'/>"), FR_ERR_DOCUMENT, "bad-stroke");
    assert_wrong(WOOD("<row>0,0,0 1,0,0</row>"), FR_ERR_DOCUMENT, "missing-attribute");
    assert_wrong(WOOD("<strew plants=''/>"), FR_ERR_DOCUMENT, "bad-mix");
    assert_wrong(WOOD("<strew plants='oak, '/>"), FR_ERR_DOCUMENT, "bad-mix");
    assert_wrong(WOOD("<strew plants='oak 0'/>"), FR_ERR_DOCUMENT, "bad-mix");
    assert_wrong(WOOD("<strew plants='oak nan'/>"), FR_ERR_DOCUMENT, "bad-mix");
    assert_wrong(WOOD("<strew plants='oak 1 1'/>"), FR_ERR_DOCUMENT, "bad-mix");
    assert_wrong(WOOD("<strew plants='oak' except='1 -2'/>"), FR_ERR_DOCUMENT, "bad-except");
    assert_wrong(WOOD("<strew plants='oak' except='3.5'/>"), FR_ERR_DOCUMENT, "bad-except");
    assert_wrong(WOOD("<strew plants='oak' except='99999999999999999999'/>"), FR_ERR_DOCUMENT,
                 "bad-except");
    assert_wrong(WOOD("<row plants='oak' except='1,2'>0,0,0 9,0,0</row>"), FR_ERR_DOCUMENT,
                 "bad-except");
    assert_wrong(WOOD("<strew plants='oak' density='no.png'/>"), FR_ERR_DOCUMENT,
                 "picture-missing");
    assert_wrong(WOOD("<strew plants='oak' number='100001'/>"), FR_ERR_LIMIT, "limit-plants");
    assert_wrong(WOOD("<row plants='oak' rows='1000000' spacing='0.001'>-1e6,0,0 1e6,0,0</row>"),
                 FR_ERR_LIMIT, "limit-plants");
    assert_wrong(WOOD("<strew plants='oak' number='60000'/><row plants='oak' spacing='0.01'>0,0,0 "
                      "900,0,0</row>"),
                 FR_ERR_LIMIT, "limit-plants");
}

static void test_many(void) {
    Built built =
        build(WOOD("<strew plants='oak, elm' number='10000' width='1000' depth='1000'/>"), -1);
    g_assert_cmpuint(stands(&built), ==, 10000);
    g_assert_cmpfloat(nearest(&built), >, 3);
    forget(&built);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/scene/placing/a row stands along its line and turns with it", test_row);
    g_test_add_func("/scene/placing/rows stand side by side, on gaps if wished", test_rows);
    g_test_add_func("/scene/placing/a smooth row follows a curve at even distances", test_curve);
    g_test_add_func("/scene/placing/strewn plants keep away from each other", test_blue_noise);
    g_test_add_func("/scene/placing/plants stay as they are when others are added", test_stable);
    g_test_add_func("/scene/placing/what is left out changes no other plant", test_except);
    g_test_add_func("/scene/placing/one of a row is found as a place of its own", test_found);
    g_test_add_func("/scene/placing/a mix has its shares", test_mix);
    g_test_add_func("/scene/placing/a picture says where plants are dense", test_density);
    g_test_add_func("/scene/placing/wrong rows and areas have a place and a code", test_wrong);
    g_test_add_func("/scene/placing/ten thousand plants find places", test_many);
    return g_test_run();
}
