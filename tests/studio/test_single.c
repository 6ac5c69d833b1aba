/// One plant of a row or an area is taken out of it.
#include "frond/scene.h"
#include "studio.h"
#include "studio/model/scene_single.h"

#include <math.h>

#define STEM "<plant id=\"stem\"><pgraph><horn id=\"h\" length=\"2 ~ 1\"/></pgraph></plant>"
#define ROW "<row plants=\"stem\" spacing=\"2\" scale=\"1 ~ 0.3\">0,0,0 8,0,0</row>"
#define WOOD(scene) "<frond version=\"1\">\n" STEM "\n<scene>\n" scene "\n</scene>\n</frond>\n"

typedef struct Wood {
    FrDocument *read;
    FrScene *scene;
} Wood;

static Wood build(const StudioDocument *document) {
    Wood wood;
    FrContext context = fr_context_default();
    g_assert_cmpint(fr_document_parse(studio_document_source(document), ".", &context, &wood.read),
                    ==, FR_OK);
    g_assert_cmpint(fr_scene_build(wood.read, -1, &context, &wood.scene), ==, FR_OK);
    return wood;
}

static void clear(Wood *wood) {
    fr_scene_free(wood->scene);
    fr_document_free(wood->read);
}

static StudioDocument *document_of(const char *text) {
    return studio_document_new(text, strlen(text), "wood", NULL);
}

static uint32_t find(const StudioDocument *document, const char *tag) {
    const FrContents *contents = studio_document_contents(document);
    return fr_contents_child(contents, fr_contents_child(contents, 0, "scene"), tag);
}

static const FrStand *stand(const Wood *wood, guint index) {
    return &g_array_index(wood->scene->stands, FrStand, index);
}

static FrDigest digest(const Wood *wood, guint index) {
    return fr_plant_digest(
        g_array_index(wood->scene->plants, FrScenePlant, stand(wood, index)->plant).plant);
}

// The place comes before what is left of the row.
static void test_release(void) {
    StudioDocument *document = document_of(WOOD(ROW));
    Wood before = build(document);
    g_assert_true(studio_release(document, find(document, "row"), 3));
    g_assert_cmpuint(studio_document_steps(document), ==, 1);
    Wood after = build(document);
    g_assert_cmpuint(after.scene->stands->len, ==, 5);
    g_assert_cmpuint(digest(&after, 0), ==, digest(&before, 3));
    g_assert_cmpfloat_with_epsilon(stand(&after, 0)->at[0], 6, 1e-6);
    g_assert_cmpfloat_with_epsilon(stand(&after, 0)->scale, stand(&before, 3)->scale, 1e-3);
    g_assert_cmpfloat_with_epsilon(
        remainder(stand(&after, 0)->turn - stand(&before, 3)->turn, 2 * G_PI), 0, 2e-3);
    static const guint others[] = {0, 1, 2, 4};
    for (guint i = 0; i < 4; i++) {
        const FrStand *a = stand(&before, others[i]), *b = stand(&after, i + 1);
        g_assert_cmpuint(digest(&before, others[i]), ==, digest(&after, i + 1));
        g_assert_true(memcmp(a->at, b->at, sizeof a->at) == 0);
        g_assert_cmpfloat(a->scale, ==, b->scale);
    }
    clear(&after);
    clear(&before);
    g_assert_true(studio_document_undo(document));
    g_assert_cmpstr(text_of(document), ==, WOOD(ROW));
    studio_document_free(document);
}

static void test_leave_out(void) {
    static const uint32_t some[] = {1, 4};
    StudioDocument *document = document_of(WOOD(ROW));
    g_assert_true(studio_leave_out(document, find(document, "row"), some, 2, "stroke"));
    g_assert_true(studio_leave_out(document, find(document, "row"), (uint32_t[]){2}, 1, "stroke"));
    g_assert_cmpuint(studio_document_steps(document), ==, 1);
    g_assert_nonnull(strstr(text_of(document), " except=\"1 4 2\">"));
    Wood after = build(document);
    g_assert_cmpuint(after.scene->stands->len, ==, 2);
    g_assert_cmpuint(stand(&after, 1)->number, ==, 3);
    clear(&after);
    studio_document_free(document);
}

// An area that is turned, on its own line, with a comment behind it.
static void test_strew(void) {
    StudioDocument *document = document_of(
        WOOD("  <strew plants=\"stem\" number=\"30\" aside=\"20\" at=\"3, 4, 0\"/> <!-- all -->"));
    Wood before = build(document);
    const FrStand *seventh = stand(&before, 7);
    g_assert_true(studio_release(document, find(document, "strew"), 7));
    Wood after = build(document);
    for (int k = 0; k < 2; k++) {
        g_assert_cmpfloat_with_epsilon(stand(&after, 0)->at[k], seventh->at[k], 1e-4);
    }
    g_assert_cmpuint(digest(&after, 0), ==, digest(&before, 7));
    clear(&after);
    clear(&before);
    studio_document_free(document);
}

static void test_refused(void) {
    StudioDocument *document = document_of(WOOD(ROW "\n<place plant=\"stem\"/>"));
    g_assert_false(studio_release(document, find(document, "row"), 5));
    g_assert_false(studio_release(document, find(document, "place"), 0));
    g_assert_false(studio_release(document, FR_NONE, 0));
    g_assert_false(studio_leave_out(document, find(document, "row"), NULL, 0, NULL));
    g_assert_cmpuint(studio_document_steps(document), ==, 0);
    studio_document_free(document);
    document = document_of(WOOD("<row plants=\"elm\">0,0,0 8,0,0</row>"));
    g_assert_false(studio_release(document, find(document, "row"), 0));
    g_assert_cmpuint(studio_document_steps(document), ==, 0);
    studio_document_free(document);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/studio/single/one of a row becomes a place and no other changes",
                    test_release);
    g_test_add_func("/studio/single/a stroke that leaves plants out is one step", test_leave_out);
    g_test_add_func("/studio/single/one of an area stays where it stood", test_strew);
    g_test_add_func("/studio/single/what is not there is not taken out", test_refused);
    return g_test_run();
}
