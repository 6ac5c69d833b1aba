/// Wood that has become thicker than its middle line is far from an obstacle is told.
#include "built.h"

/// A tree whose trunk becomes 0.2 m thick or more in eight steps.
#define TREE(place)                                                                                \
    "<frond version='1'><plant id='tree'><species model='open' step='0.3' tip-radius='0.03' "      \
    "pipe-exponent='2'/></plant>\n<scene><growth steps='8' min='-4,-4,-1' max='4,4,5' "            \
    "cell='0.03'/>\n<obstacle id='wall' at='0,1,0' size='6,0.3,2'/>\n" place "</scene></frond>"

#define BESIDE TREE("<place plant='tree' at='0,0.78,0'/>")

/// The same document with something else in place of `old`.
static char *with(const char *text, const char *old, const char *new) {
    GString *changed = g_string_new(text);
    g_assert_cmpuint(g_string_replace(changed, old, new, 1), ==, 1);
    return g_string_free(changed, FALSE);
}

static guint count_told(const char *text, const char **said) {
    static char kept[1024];
    Built built = build(text, -1);
    g_assert_cmpint(built.status, ==, FR_OK);
    guint told = 0;
    for (size_t i = 0; i < fr_diags_count(built.diags); i++) {
        const FrDiag *diag = fr_diags_get(built.diags, i);
        if (strcmp(diag->code, "thick-wood") == 0) {
            g_strlcpy(kept, diag->text, sizeof kept);
            told++;
        }
    }
    *said = kept;
    forget(&built);
    return told;
}

static void test_beside(void) {
    const char *said;
    g_assert_cmpuint(count_told(TREE("<place plant='tree' at='0,0.78,0'/>"
                                     "<place plant='tree' at='-2,-2,0'/>"),
                                &said),
                     ==, 1);
    g_assert_nonnull(strstr(said, "1 of 1 plants"));
    g_assert_nonnull(strstr(said, "wall of line 3"));
    // It is 7 cm from the face, which is at y = 0.85.
    const char *middle = strstr(said, "its middle is ");
    g_assert_nonnull(middle);
    double away = g_ascii_strtod(middle + strlen("its middle is "), NULL);
    g_assert_cmpfloat(away, <, 0.12);
    const char *thick = strstr(said, "there it is ");
    g_assert_nonnull(thick);
    g_assert_cmpfloat(g_ascii_strtod(thick + strlen("there it is "), NULL), >, 2 * away);
}

static void test_by_element(void) {
    const char *said;
    g_assert_cmpuint(count_told(TREE("<row plants='tree' spacing='1.5'>-2,0.78,0 2,0.78,0</row>"
                                     "<place plant='tree' at='3,0.8,0'/>"),
                                &said),
                     ==, 2);
}

static void test_clear(void) {
    const char *said;
    g_assert_cmpuint(count_told(TREE("<place plant='tree' at='0,-2,0'/>"), &said), ==, 0);
    g_assert_cmpuint(count_told(TREE("<obstacle at='0,-2,0' size='1,1,0.5'/>"
                                     "<place plant='tree' at='0,-2,0.5'/>"),
                                &said),
                     ==, 0);
}

static void test_meant(void) {
    static const char *const changes[][2] = {{"<species ", "<species collide='no' "},
                                             {"<species ", "<species climb='0.5' "},
                                             {"id='wall'", "visible='no'"}};
    for (size_t i = 0; i < G_N_ELEMENTS(changes); i++) {
        const char *said;
        char *text = with(BESIDE, changes[i][0], changes[i][1]);
        g_assert_cmpuint(count_told(text, &said), ==, 0);
        g_free(text);
    }
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/scene/reaching/wood that reaches into a wall beside it is told", test_beside);
    g_test_add_func("/scene/reaching/once for each element that has placed plants",
                    test_by_element);
    g_test_add_func("/scene/reaching/neither far from obstacles nor standing on one is it told",
                    test_clear);
    g_test_add_func("/scene/reaching/nor of species that go through or climb, or of what is unseen",
                    test_meant);
    return g_test_run();
}
