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

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/document/surroundings/obstacles and lamps are read", test_read);
    g_test_add_func("/document/surroundings/the sun stands where the date puts it", test_sun);
    g_test_add_func("/document/surroundings/what is wrong has its code", test_wrong);
    return g_test_run();
}
