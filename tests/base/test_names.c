// Suggestions for misspelt names.
#include "frond/diag.h"

static const char *const NAMES[] = {"length", "branching-angle", "gravity", "leaf", "tree", "t"};

static const char *nearest(const char *name) {
    return fr_nearest_name(name, NAMES, G_N_ELEMENTS(NAMES));
}

static void test_slips(void) {
    g_assert_cmpstr(nearest("lenght"), ==, "length");  // transposed
    g_assert_cmpstr(nearest("lengt"), ==, "length");   // missing
    g_assert_cmpstr(nearest("lengthh"), ==, "length"); // doubled
    g_assert_cmpstr(nearest("gravitx"), ==, "gravity");
    g_assert_cmpstr(nearest("branching_angel"), ==, "branching-angle");
    g_assert_cmpstr(nearest("Leaf"), ==, "leaf");
}

static void test_strangers(void) {
    g_assert_null(nearest("colour"));
    g_assert_null(nearest("x")); // one wrong letter of one is another name
    g_assert_null(nearest(""));
    g_assert_null(fr_nearest_name("leaf", NULL, 0));
}

static void test_nearest_wins(void) {
    const char *const names[] = {"internode", "internodes", "intermode"};
    g_assert_cmpstr(fr_nearest_name("internodes", names, 3), ==, "internodes");
    g_assert_cmpstr(fr_nearest_name("internod", names, 3), ==, "internode");
}

static void test_huge(void) {
    char *name = g_strnfill(10000000, 'a');
    g_assert_null(nearest(name));
    const char *const names[] = {name, "aaa"};
    g_assert_cmpstr(fr_nearest_name("aab", names, 2), ==, "aaa");
    g_free(name);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/base/names/slips of the finger are recognized", test_slips);
    g_test_add_func("/base/names/another word is not a slip", test_strangers);
    g_test_add_func("/base/names/the nearest of several is taken", test_nearest_wins);
    g_test_add_func("/base/names/names of any length are harmless", test_huge);
    return g_test_run();
}
