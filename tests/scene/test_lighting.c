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

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/scene/lighting/light goes through panes and comes back from mirrors",
                    test_materials);
    return g_test_run();
}
