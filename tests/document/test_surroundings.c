/// Obstacles, lamps, the sun by date, and how plants sense light, in documents.
#include "documents.h"

#include <math.h>

#define DEGREE (G_PI / 180.0)
#define SCENE(inside)                                                                              \
    "<frond version='1'><material id='wood' colour='#8a5a33'/><plant id='p'><pgraph>"              \
    "<camera id='root'/></pgraph></plant><scene>" inside "</scene></frond>"

static void test_read(void) {
    Parsed parsed = parse(SCENE("<obstacle shape='sphere' at='1,2,3' size='2' material='wood'/>"
                                "<lamp kind='area' power='40' width='0.3'/>"
                                "<light by='shadows' cell='0.5'/>"));
    g_assert_cmpint(parsed.status, ==, FR_OK);
    const FrSurroundings *around = fr_document_surroundings(parsed.document);
    g_assert_cmpuint(around->obstacles->len, ==, 1);
    const FrObstacle *obstacle = g_ptr_array_index(around->obstacles, 0);
    g_assert_cmpstr(fr_material_name(obstacle->made_of), ==, "wood");
    g_assert_cmpfloat(obstacle->size.z, ==, 2);
    const FrLampParams *lamp = g_ptr_array_index(around->lamps, 0);
    g_assert_cmpfloat(lamp->power, ==, 40);
    g_assert_true(around->light.is_given);
    g_assert_cmpint(around->light.by, ==, FR_LIGHT_BY_SHADOWS);
    forget(&parsed);
}

/// Noon of the June solstice on the meridian of Greenwich: the sun is in the south.
static void test_sun(void) {
    Parsed parsed = parse(SCENE("<sun date='2025-06-21' time='14' zone='2' latitude='52.5'/>"));
    g_assert_cmpint(parsed.status, ==, FR_OK);
    const FrSceneParams *scene = fr_document_scene(parsed.document);
    g_assert_cmpfloat_with_epsilon(scene->sun_elevation / DEGREE, 90 - 52.5 + 23.436, 0.05);
    g_assert_cmpfloat_with_epsilon(scene->sun_azimuth / DEGREE, 180, 2);
    forget(&parsed);
}

/// The place in the example A.5 of Reda, Andreas 2004, Solar Position Algorithm: their elevation,
/// 39.88838 degrees, has the refraction, 0.016 degrees, added.
static void test_sun_published(void) {
    Parsed parsed = parse(SCENE("<sun date='2003-10-17' time='12.5083333' zone='-7' "
                                "latitude='39.742476' longitude='-105.1786'/>"));
    g_assert_cmpint(parsed.status, ==, FR_OK);
    const FrSceneParams *scene = fr_document_scene(parsed.document);
    g_assert_cmpfloat_with_epsilon(scene->sun_azimuth / DEGREE, 194.34024, 0.01);
    g_assert_cmpfloat_with_epsilon(scene->sun_elevation / DEGREE, 39.88838 - 0.016, 0.01);
    forget(&parsed);
}

static void assert_wrong(const char *text, const char *code) {
    Parsed parsed = parse(text);
    g_assert_cmpint(parsed.status, ==, FR_ERR_DOCUMENT);
    g_assert_cmpuint(fr_diags_count(parsed.diags), ==, 1);
    g_assert_cmpstr(fr_diags_get(parsed.diags, 0)->code, ==, code);
    forget(&parsed);
}

static void test_wrong(void) {
    assert_wrong(SCENE("<obstacle material='wod'/>"), "unknown-material");
    assert_wrong(SCENE("<obstacle size='0'/>"), "out-of-range");
    assert_wrong(SCENE("<obstacle shape='mesh'/>"), "missing-attribute");
    assert_wrong(SCENE("<obstacle shape='mesh' file='none.obj'/>"), "missing-file");
    assert_wrong(SCENE("<obstacle shape='mesh' file='../out.obj'/>"), "wrong-path");
    assert_wrong(SCENE("<lamp direction='0'/>"), "no-direction");
    assert_wrong(SCENE("<sun date='2025-02-30'/>"), "bad-date");
    assert_wrong(SCENE("<sun date='25-2-3'/>"), "bad-date");
    assert_wrong(SCENE("<sun date='2025-6-21-1'/>"), "bad-date");
    assert_wrong(SCENE("<sun date=''/>"), "bad-date");
    assert_wrong(SCENE("<sun/><sun/>"), "repeated-element");
    assert_wrong(SCENE("<light><lamp/></light>"), "misplaced-element");
    Parsed parsed = parse("<frond version='1'><plant id='p'><pgraph><camera id='root'/></pgraph>"
                          "</plant><scene sun-azimuth='3'><sun/></scene></frond>");
    g_assert_cmpstr(fr_diags_get(parsed.diags, 0)->code, ==, "two-suns");
    forget(&parsed);
}

/// Lamps and obstacles can be set by their ids, or by what they are and their numbers.
static void test_set(void) {
    static const char text[] =
        SCENE("<lamp id='desk' power='1'/><lamp power='2'/><lamp power='3'/><obstacle size='1'/>");
    static const struct {
        const char *path;
        guint lamp;
    } rows[] = {{"desk.power", 0}, {"lamp-2.power", 1}, {"lamp-3.power", 2}};
    for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
        Parsed parsed = parse(text);
        FrContext context = fr_context_default();
        context.diags = parsed.diags;
        g_assert_cmpint(fr_document_set(parsed.document, rows[i].path, "7", &context), ==, FR_OK);
        g_assert_cmpint(fr_document_set(parsed.document, "obstacle.size", "4", &context), ==,
                        FR_OK);
        const FrSurroundings *around = fr_document_surroundings(parsed.document);
        const FrObstacle *obstacle = g_ptr_array_index(around->obstacles, 0);
        g_assert_cmpfloat(obstacle->size.x, ==, 4);
        for (guint lamp = 0; lamp < 3; lamp++) {
            double power = ((const FrLampParams *)g_ptr_array_index(around->lamps, lamp))->power;
            g_assert_cmpfloat(power, ==, lamp == rows[i].lamp ? 7 : lamp + 1.0);
        }
        g_assert_cmpint(fr_document_set(parsed.document, "lamp.power", "4", &context), ==,
                        FR_ERR_USAGE);
        g_assert_nonnull(
            strstr(fr_diags_get(parsed.diags, 0)->text, "nothing is called 'lamp'; did you mean"));
        forget(&parsed);
    }
    assert_wrong(SCENE("<lamp id='a.b'/>"), "bad-id");
    assert_wrong(SCENE("<obstacle id='9'/>"), "bad-id");
    assert_wrong(SCENE("<lamp id='desk'/><obstacle/><obstacle/><obstacle id='desk'/>"),
                 "duplicate-id");
}

/// Whatever is read first, the later one in the document is the one too many.
static void test_duplicate(void) {
    static const char text[] = SCENE("<lamp id='desk'/><obstacle id='desk'/>");
    Parsed parsed = parse(text);
    g_assert_cmpuint(fr_diags_count(parsed.diags), ==, 1);
    const FrDiag *diag = fr_diags_get(parsed.diags, 0);
    g_assert_cmpstr(diag->code, ==, "duplicate-id");
    const char *second = strstr(text, "<obstacle id='desk'");
    g_assert_cmpuint(diag->span.begin, ==, (size_t)(second - text) + strlen("<obstacle id='"));
    forget(&parsed);
}

/// A lamp that is called 'light' does not hide the light.
static void test_set_own_name(void) {
    Parsed parsed = parse(SCENE("<light/><lamp id='light'/>"));
    FrContext context = fr_context_default();
    context.diags = parsed.diags;
    g_assert_cmpint(fr_document_set(parsed.document, "light.photons", "7", &context), ==, FR_OK);
    g_assert_cmpint(fr_document_surroundings(parsed.document)->light.photons, ==, 7);
    forget(&parsed);
}

/// The nearest 50 of 20 rays are all there are, wherever one looks.
static void test_few_photons(void) {
    static const struct {
        const char *text;
        bool is_told;
    } rows[] = {
        {SCENE("<light by='density' estimator='nearest' photons='20'/>"), true},
        {SCENE("<light by='density' estimator='nearest' photons='50'/>"), false},
        {SCENE("<light by='density' estimator='fixed' photons='20'/>"), false},
        {SCENE("<light by='views' estimator='nearest' photons='20'/>"), false},
    };
    for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
        Parsed parsed = parse(rows[i].text);
        g_assert_cmpint(parsed.status, ==, FR_OK);
        bool is_told = false;
        for (size_t k = 0; k < fr_diags_count(parsed.diags); k++) {
            is_told |= strcmp(fr_diags_get(parsed.diags, k)->code, "few-photons") == 0;
        }
        g_assert_cmpint(is_told, ==, rows[i].is_told);
        forget(&parsed);
    }
}

/// Shadow voxels do not see lamps.
static void test_unseen(void) {
    Parsed parsed = parse(SCENE("<light by='shadows'/><lamp/><lamp power='0'/>"));
    g_assert_cmpint(parsed.status, ==, FR_OK);
    g_assert_cmpuint(fr_diags_count(parsed.diags), ==, 1);
    const FrDiag *diag = fr_diags_get(parsed.diags, 0);
    g_assert_cmpstr(diag->code, ==, "unseen-lamp");
    g_assert_cmpint(diag->severity, ==, FR_WARNING);
    g_assert_cmpuint(diag->span.end - diag->span.begin, ==, strlen("lamp"));
    forget(&parsed);
    parsed = parse(SCENE("<light by='views'/><lamp/>"));
    g_assert_cmpuint(fr_diags_count(parsed.diags), ==, 0);
    forget(&parsed);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/document/surroundings/obstacles and lamps are read", test_read);
    g_test_add_func("/document/surroundings/the sun stands where the date puts it", test_sun);
    g_test_add_func("/document/surroundings/the sun stands where it was published to",
                    test_sun_published);
    g_test_add_func("/document/surroundings/lamps and obstacles have paths to be set by", test_set);
    g_test_add_func("/document/surroundings/an id twice is told at the second", test_duplicate);
    g_test_add_func("/document/surroundings/the light is set where a lamp is called so",
                    test_set_own_name);
    g_test_add_func("/document/surroundings/more neighbours than photons are told of",
                    test_few_photons);
    g_test_add_func("/document/surroundings/who senses shadows is told of lamps", test_unseen);
    g_test_add_func("/document/surroundings/what is wrong has its code", test_wrong);
    return g_test_run();
}
