#include "studio/model/keys.h"

#include "frond/number.h"
#include "studio.h"

#include <math.h>

#define PLANT                                                                                      \
    "<frond version=\"1\"><plant id=\"p\" age=\"2\" time=\"1\"><pgraph>"                           \
    "<camera id=\"root\"/>"                                                                        \
    "<horn id=\"stem\" birth=\"1\" length=\"0.5 ~ 0.1 | self fall\" radius=\"0.01..0.02\"/>"       \
    "<leaf id=\"leaf\" time-scale=\"2\" birth=\"0.5 ~ 0.2\" length=\"keys 0,0.1 1,0.3\" "          \
    "width=\"keys 0,0.05 2,0.2\"/>"                                                                \
    "<link from=\"root\" to=\"stem\"/><link from=\"stem\" to=\"leaf\"/>"                           \
    "</pgraph></plant></frond>"

static StudioDocument *new_document(void) {
    return studio_document_new(PLANT, strlen(PLANT), "test", NULL);
}

static void assert_value(const StudioDocument *document, const char *id, const char *attribute,
                         const char *expected) {
    char *value =
        fr_contents_get(studio_document_contents(document), element_of(document, id), attribute);
    g_assert_cmpstr(value, ==, expected);
    g_free(value);
}

static void test_text(void) {
    static const struct {
        const char *text, *written;
        guint count;
    } rows[] = {
        {"keys 0,10 5,80", "keys 0,10 5,80", 2},
        {"keys  -1,10   5.25,80~3 | parent fall", "keys -1,10 5.25,80 ~3 | parent fall", 2},
        {"45", "45", 0},
        {"45 | age 0,0 1,1", "45 | age 0,0 1,1", 0},
    };
    for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
        StudioKeys keys;
        double plain;
        g_assert_true(studio_keys_read(rows[i].text, &keys, &plain));
        g_assert_cmpuint(keys.points->len, ==, rows[i].count);
        char *text = studio_keys_write(&keys, plain);
        g_assert_cmpstr(text, ==, rows[i].written);
        g_free(text);
        studio_keys_clear(&keys);
    }
    static const char *const others[] = {"80..30", "= 3 + i", "keys dome", "list 1 2", "", "keys"};
    for (size_t i = 0; i < G_N_ELEMENTS(others); i++) {
        StudioKeys keys;
        double plain;
        g_assert_false(studio_keys_read(others[i], &keys, &plain));
    }
}

// The library's own number is what it is held against.
static void test_value(void) {
    static const char text[] = "keys 0,10 2,40 5,30";
    StudioKeys keys;
    double plain;
    g_assert_true(studio_keys_read(text, &keys, &plain));
    FrNumber number = fr_number_constant(0, 1);
    g_assert_cmpint(fr_number_parse(&number, text, (FrSpan){0}, 1, -100, 100, NULL, NULL), ==,
                    FR_OK);
    for (double age = -1; age < 7; age += 0.25) {
        FrVars vars = {0};
        FrExprFault fault = {0};
        vars.value[FR_VAR_age] = age;
        g_assert_cmpfloat_with_epsilon(studio_keys_value(&keys, age),
                                       fr_number_eval(&number, &vars, 0, &fault), 1e-12);
    }
    fr_number_clear(&number);
    studio_keys_clear(&keys);
}

static void test_clock(void) {
    StudioDocument *document = new_document();
    StudioClock stem = studio_clock_of(document, element_of(document, "stem"));
    g_assert_cmpfloat(stem.scale, ==, 1);
    g_assert_cmpfloat(stem.offset, ==, 1); // 2 of the plant less 1 of its birth
    StudioClock leaf = studio_clock_of(document, element_of(document, "leaf"));
    g_assert_cmpfloat(leaf.scale, ==, 2);
    g_assert_cmpfloat(leaf.offset, ==, 1); // (1 − 0.5) × 2
    g_assert_cmpfloat(studio_clock_shown(document, element_of(document, "leaf")), ==, 1);
    studio_document_free(document);
}

static void test_set(void) {
    StudioDocument *document = new_document();
    uint32_t stem = element_of(document, "stem");
    g_assert_true(studio_set_key(document, stem, "length", 2, NAN, false));
    assert_value(document, "stem", "length", "keys 2,0.5 ~ 0.1 | self fall");
    g_assert_cmpstr(studio_document_undo_name(document), ==, "Set a key of length of stem");
    for (int i = 0; i <= 10; i++) {
        g_assert_true(studio_set_key(document, stem, "length", 4, 0.6 + 0.02 * i, true));
    }
    g_assert_cmpuint(studio_document_steps(document), ==, 2);
    assert_value(document, "stem", "length", "keys 2,0.5 4,0.8 ~ 0.1 | self fall");
    g_assert_true(studio_set_key(document, stem, "length", 3, NAN, false));
    assert_value(document, "stem", "length", "keys 2,0.5 3,0.65 4,0.8 ~ 0.1 | self fall");
    g_assert_true(studio_set_key(document, stem, "taper", 0, NAN, false)); // not given before
    assert_value(document, "stem", "taper", "keys 0,0.8");
    g_assert_false(studio_set_key(document, stem, "radius", 0, NAN, false)); // a range
    g_assert_false(studio_set_key(document, stem, "material", 0, NAN, false));
    g_assert_false(studio_set_key(document, first_plant(document), "season", 0, NAN, false));
    studio_document_free(document);
}

static void test_remove(void) {
    StudioDocument *document = new_document();
    uint32_t leaf = element_of(document, "leaf");
    g_assert_false(studio_remove_key(document, leaf, "length", 0.5));
    g_assert_true(studio_remove_key(document, leaf, "length", 0));
    assert_value(document, "leaf", "length", "keys 1,0.3");
    g_assert_true(studio_remove_key(document, leaf, "length", 1));
    assert_value(document, "leaf", "length", "0.3");
    g_assert_true(studio_document_undo(document));
    g_assert_true(studio_document_undo(document));
    g_assert_true(studio_remove_keys(document, leaf, 0));
    assert_value(document, "leaf", "length", "keys 1,0.3");
    assert_value(document, "leaf", "width", "keys 2,0.2");
    g_assert_cmpuint(studio_document_steps(document), ==, 1);
    studio_document_free(document);
}

static void test_move(void) {
    StudioDocument *document = new_document();
    uint32_t leaf = element_of(document, "leaf");
    GArray *ages = studio_key_ages(document, leaf);
    g_assert_cmpuint(ages->len, ==, 3); // 0 of both is one
    g_assert_cmpfloat(g_array_index(ages, double, 1), ==, 1);
    g_array_unref(ages);
    double at = 0;
    for (int i = 1; i <= 5; i++) {
        double to = 0.1 * i;
        g_assert_true(studio_move_keys(document, leaf, at, &to, "drag"));
        at = to;
    }
    assert_value(document, "leaf", "length", "keys 0.5,0.1 1,0.3");
    assert_value(document, "leaf", "width", "keys 0.5,0.05 2,0.2");
    g_assert_cmpuint(studio_document_steps(document), ==, 1);
    double beyond = 7;
    g_assert_true(studio_move_keys(document, leaf, at, &beyond, "drag"));
    g_assert_cmpfloat(beyond, <, 1); // not over the next
    g_assert_true(studio_document_undo(document));
    g_assert_cmpstr(text_of(document), ==, PLANT);
    studio_document_free(document);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/studio/keys/keys are read and written, all else is let be", test_text);
    g_test_add_func("/studio/keys/between keys the value is that of the library", test_value);
    g_test_add_func("/studio/keys/clocks within clocks tell the age", test_clock);
    g_test_add_func("/studio/keys/a key is set, and a drag of it is one step", test_set);
    g_test_add_func("/studio/keys/the last key that is removed leaves its value", test_remove);
    g_test_add_func("/studio/keys/keys of one age are moved together and not over others",
                    test_move);
    return g_test_run();
}
