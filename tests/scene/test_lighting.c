/// The light of a document's scene, asked for at points.
#include "frond/lighting.h"

#include "built.h"

#include <cglm/struct.h>
#include <math.h>

#define SCENE(attributes, inside)                                                                  \
    "<frond version='1'>\n"                                                                        \
    "<material id='grey' colour='#bcbcbc'/>\n"                                                     \
    "<material id='silver' colour='#ffffff' mirror='1'/>\n"                                        \
    "<material id='glass' colour='#ffffff' clear='0.5'/>\n"                                        \
    "<plant id='p'><pgraph><camera id='root'/><horn id='s' length='0.01' radius='0.001'/>"         \
    "<link from='root' to='s'/></pgraph></plant>\n"                                                \
    "<scene ground='no' " attributes ">\n" inside                                                  \
    "<place plant='p' at='0, 0, -1'/></scene></frond>"
#define DARK "sun-strength='0' sky-strength='0'"
// A spot that shines down on everything below, a watt for each steradian of its cone.
#define SPOT "<lamp kind='spot' at='0, 0, 4' angle='30' power='0.84178721'/>\n"

/// The light at a point.
static FrLightAnswer light_at(const char *text, vec3s point) {
    FrContext context = fr_context_default();
    Built built = build(text, -1);
    g_assert_cmpint(built.status, ==, FR_OK);
    FrLighting *lighting;
    FrLightAnswer answer;
    g_assert_cmpint(fr_lighting_new(built.scene, &context, &lighting), ==, FR_OK);
    g_assert_cmpint(fr_lighting_update(lighting, built.scene, &context), ==, FR_OK);
    g_assert_cmpint(fr_lighting_query(lighting, &point, 1, &context, &answer), ==, FR_OK);
    fr_lighting_free(lighting);
    forget(&built);
    return answer;
}

// Below a pane half of the light is left. What a mirror throws back goes past the lamp: close above
// it there is as much light again as came down.
static void test_materials(void) {
    static const char *const kinds[2] = {"<light by='density' photons='200000' distance='0.1'/>\n",
                                         "<light by='views' near='0.001'/>\n"};
    for (int k = 0; k < 2; k++) {
        char *glass = g_strconcat(SCENE(DARK, "%s" SPOT "<obstacle shape='box' at='0, 0, 2' "
                                              "size='9, 9, 0.0001' material='%s'/>\n"),
                                  NULL);
        char *panes = g_strdup_printf(glass, kinds[k], "glass");
        char *mirror = g_strdup_printf(glass, kinds[k], "silver");
        // The two sides of the box are a pane each, and scatter the other half.
        FrLightAnswer below = light_at(panes, (vec3s){{0, 0, 0.5f}});
        double straight = 0.25 / (3.5 * 3.5);
        g_assert_cmpfloat((double)below.intensity, >, 0.93 * straight);
        if (k == 1) {
            g_assert_cmpfloat_with_epsilon((double)below.intensity, straight, 1e-3 * straight);
        }
        g_assert_cmpfloat(below.direction.z, >, 0.99f);
        FrLightAnswer above = light_at(mirror, (vec3s){{0, 0, 2.1f}});
        double once = 1 / (1.9 * 1.9), twice = once + 1 / (2.1 * 2.1);
        double want = k == 0 ? twice : once;
        g_assert_cmpfloat_with_epsilon((double)above.intensity, want, 0.08 * want);
        g_assert_cmpfloat(light_at(mirror, (vec3s){{0, 0, 1.9f}}).intensity, ==, 0);
        g_free(glass);
        g_free(panes);
        g_free(mirror);
    }
}

#define RADIAN (G_PI / 180.0)

// An area lamp far above, on its axis and 60 degrees beside it: P cos θ / (π d²).
static void test_area(void) {
    static const char *const kinds[2] = {"<light by='density' photons='400000' distance='0.2'/>\n",
                                         "<light by='views' near='0.001'/>\n"};
    for (int k = 0; k < 2; k++) {
        char *text = g_strdup_printf(SCENE(DARK, "%s<lamp kind='area' at='0, 0, 4' width='0.2' "
                                                 "height='0.4' turn='30' power='80'/>\n"),
                                     kinds[k]);
        for (int side = 0; side < 2; side++) {
            double angle = side * 60 * RADIAN, d = 3;
            vec3s at = {{(float)(d * sin(angle)), 0, (float)(4 - d * cos(angle))}};
            FrLightAnswer answer = light_at(text, at);
            double want = 80 * cos(angle) / (G_PI * d * d);
            double tolerance = k == 0 ? 0.1 : 0.01;
            g_assert_cmpfloat_with_epsilon((double)answer.intensity, want, tolerance * want);
            g_assert_cmpfloat_with_epsilon((double)answer.direction.z, cos(angle), 0.05);
        }
        g_assert_cmpfloat(light_at(text, (vec3s){{0, 0, 5}}).intensity, ==, 0);
        g_free(text);
    }
}

// A disc above a point hides the sky up to the angle α from the zenith: of a uniform sky 1 − cos α
// of the fluence, of an overcast one (1 − cos α + sin² α) / 2. Some 900 rays tell of the first.
static void test_skies(void) {
    static const struct {
        const char *sky;
        double hidden;
    } rows[] = {{"uniform", 0.5}, {"overcast", 0.625}};
    static const char *const kinds[2] = {"<light by='density' photons='1500000' distance='0.15' "
                                         "relative='yes' reference='0, 0, 3'/>",
                                         "<light by='views' views='4000' near='0.001'/>"};
    for (int k = 0; k < 2; k++) {
        for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
            // 60 degrees: the disc's radius is √3 times its height.
            char *text = g_strdup_printf(SCENE("sky='%s' sun-strength='0'",
                                               "%s<obstacle shape='circle' tilt='-90' "
                                               "at='0, -0.8660254, 0.5' "
                                               "size='1.7320508, 1, 1.7320508'/>"),
                                         rows[i].sky, kinds[k]);
            FrLightAnswer answer = light_at(text, (vec3s){{0, 0, 0}});
            g_test_message("%s, %d: %.4f", rows[i].sky, k, (double)answer.intensity);
            g_assert_cmpfloat_with_epsilon((double)answer.intensity, 1 - rows[i].hidden,
                                           k == 0 ? 0.06 : 0.005);
            g_free(text);
        }
    }
}

// The middle of the sun's path over a day is in the south, 90° − latitude + declination high; a
// clear sky is brightest on the side on which the sun goes its way.
static void test_day(void) {
    FrLightAnswer noon = light_at(SCENE("sky='clear' sky-strength='0'",
                                        "<sun date='2025-06-21' time='9' latitude='52.5'/>"
                                        "<light by='views' suns='1' near='0.001'/>"),
                                  (vec3s){{0, 0, 2}});
    double height = (90 - 52.5 + 23.436) * RADIAN;
    g_assert_cmpfloat_with_epsilon((double)noon.direction.z, sin(height), 1e-3);
    g_assert_cmpfloat_with_epsilon((double)noon.direction.y, -cos(height), 1e-3);
    g_assert_cmpfloat_with_epsilon((double)noon.direction.x, 0, 1e-3);
    FrLightAnswer sky = light_at(SCENE("sky='clear' sun-strength='0'",
                                       "<sun date='2025-06-21' time='9' latitude='52.5'/>"
                                       "<light by='views' views='500' towards='mean'/>"),
                                 (vec3s){{0, 0, 2}});
    g_assert_cmpfloat(sky.direction.y, <, -0.05f);
    g_assert_cmpfloat(fabsf(sky.direction.x), <, 0.02f);
    // South of the equator it is in the north.
    noon = light_at(SCENE("sky='clear' sky-strength='0'",
                          "<sun date='2025-06-21' time='9' latitude='-33.9'/>"
                          "<light by='views' suns='1' near='0.001'/>"),
                    (vec3s){{0, 0, 2}});
    g_assert_cmpfloat_with_epsilon((double)noon.direction.y, cos((90 - 33.9 - 23.436) * RADIAN),
                                   1e-3);
}

// A growing plant that needs light; what it derives from is checked, but it does not grow.
#define GROWING                                                                                    \
    "<frond version='1'>\n<plant id='p'><lsystem><![CDATA[\n"                                      \
    "Lsystem: 1\nderivation length: 3\naxiom: A\nA --> I(?)F(1)A\nendlsystem\n"                    \
    "]]></lsystem></plant>\n<scene ground='no'>"                                                   \
    "<light by='density' photons='5000' relative='yes' reference='0, 0, 3'/>"                      \
    "<place plant='p'/><place plant='p' at='1, 0, 0'/></scene></frond>"

static void test_limits(void) {
    static const struct {
        const char *limit, *value, *place;
    } rows[] = {{"photons", "4999", "5000'"}, {"bytes", "200000", "5000'"}};
    static const char text[] = GROWING;
    for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
        FrContext context = fr_context_default();
        FrStatus set = fr_limits_set(&context.limits, rows[i].limit, rows[i].value, NULL);
        g_assert_cmpint(set, ==, FR_OK);
        Built built = build_with(text, -1, context);
        g_assert_cmpint(built.status, ==, FR_ERR_LIMIT);
        const FrDiag *diag = fr_diags_get(built.diags, 0);
        char *code = g_strconcat("limit-", rows[i].limit, NULL);
        g_assert_cmpstr(diag->code, ==, code);
        g_assert_true(g_str_has_prefix(&text[diag->span.begin], rows[i].place));
        g_free(code);
        forget(&built);
    }
}

static void test_check(void) {
    FrContext context = fr_context_default();
    context.diags = fr_diags_new();
    FrSource *source = fr_source_new("wood.frond", GROWING, strlen(GROWING));
    FrDocument *document;
    g_assert_cmpint(fr_document_parse(source, NULL, &context, &document), ==, FR_OK);
    // Dark at the reference, which only growing would find.
    FrStatus status = fr_document_set(document, "light.reference", "0, 0, -5000", &context);
    g_assert_cmpint(status, ==, FR_OK);
    FrScene *scene;
    g_assert_cmpint(fr_scene_check(document, -1, &context, &scene), ==, FR_OK);
    g_assert_cmpuint(fr_diags_count(context.diags), ==, 0);
    g_assert_cmpuint(scene->plants->len, ==, 2);
    g_assert_cmpuint(scene->steps->len, ==, 0);
    fr_scene_free(scene);
    context.limits.photons = 10;
    g_assert_cmpint(fr_scene_check(document, -1, &context, &scene), ==, FR_ERR_LIMIT);
    g_assert_null(scene);
    fr_document_free(document);
    fr_source_unref(source);
    fr_diags_free(context.diags);
}

/// Notes the strings it is shown.
static FrStatus note_string(void *user, FrLderivation *derivation, bool is_answered) {
    GString *text = user;
    g_string_append_printf(text, "%d%s ", (int)fr_lderivation_step(derivation),
                           is_answered ? "'" : "");
    fr_lstring_print(fr_lderivation_string(derivation), text);
    g_string_append_c(text, '\n');
    return FR_OK;
}

/// The last string is that of the plant that the scene builds.
static void test_derive(void) {
    FrContext context = fr_context_default();
    Built built = build(GROWING, -1);
    g_assert_cmpint(built.status, ==, FR_OK);
    const FrPlantDef *definition = g_ptr_array_index(fr_document_plants(built.document), 0);
    g_assert_true(fr_scene_is_lit(built.document, definition));
    GString *text = g_string_new(NULL);
    FrStatus status = fr_scene_derive(built.document, definition, -1, &context, note_string, text);
    g_assert_cmpint(status, ==, FR_OK);
    char **lines = g_strsplit(text->str, "\n", -1);
    g_assert_cmpuint(g_strv_length(lines), ==, 8);
    g_assert_cmpstr(lines[0], ==, "0 A");
    g_assert_cmpstr(lines[1], ==, "0' A");
    g_assert_cmpstr(lines[2], ==, "1 I(?)F(1)A");
    g_assert_true(g_str_has_prefix(lines[3], "1' I(0.") || g_str_has_prefix(lines[3], "1' I(1"));
    g_assert_true(g_str_has_suffix(lines[6], "I(?)F(1)A"));
    g_assert_cmpuint(plant_at(&built, 0)->plant->nodes.count, ==, 3);
    g_assert_cmpuint(plant_at(&built, 0)->by_component[0], ==, 3);
    g_strfreev(lines);
    g_string_free(text, TRUE);
    forget(&built);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/scene/lighting/light goes through panes and comes back from mirrors",
                    test_materials);
    g_test_add_func("/scene/lighting/an area lamp shines by Lambert's law", test_area);
    g_test_add_func("/scene/lighting/a disc hides its part of an even and an overcast sky",
                    test_skies);
    g_test_add_func("/scene/lighting/the sun goes its way by date and latitude", test_day);
    g_test_add_func("/scene/lighting/too much light is refused at its place", test_limits);
    g_test_add_func("/scene/lighting/a check does not grow anything", test_check);
    g_test_add_func("/scene/lighting/an L-system is shown as it grows in the light", test_derive);
    return g_test_run();
}
