/// What the light layer sees on the builder's thread.
#include "studio.h"
#include "studio/model/light_layer.h"

#include <math.h>

static const char room[] =
    "<frond version=\"1\">\n"
    "  <plant id=\"p\"><pgraph><horn id=\"h\" length=\"0.5\"/></pgraph></plant>\n"
    "  <scene sun-strength=\"0\" sky-strength=\"0\">\n"
    "    <light by=\"density\" photons=\"2000\" distance=\"0.2\" reference=\"0, 0.3, 0.6\"/>\n"
    "    <lamp at=\"0, 0.3, 1.2\"/>\n"
    "    <obstacle at=\"0, 0, -0.1\" size=\"3, 3, 0.1\"/>\n"
    "    <place plant=\"p\"/>\n"
    "  </scene>\n"
    "</frond>\n";

static void wake(void *user) {
    g_atomic_int_inc((gint *)user);
}

typedef struct Fixture {
    gint wakes;
    StudioBuilder *builder;
    StudioLightLayer *layer;
    StudioDocument *document;
} Fixture;

static void set_up(Fixture *fixture, gconstpointer data) {
    fixture->wakes = 0;
    fixture->builder = studio_builder_new(wake, &fixture->wakes);
    fixture->layer = studio_light_layer_new(wake, &fixture->wakes);
    studio_builder_watch(fixture->builder, studio_light_layer_look, fixture->layer);
    const char *text = data == NULL ? room : data;
    fixture->document = studio_document_new(text, strlen(text), "room", NULL);
}

static void tear_down(Fixture *fixture, gconstpointer data) {
    (void)data;
    studio_builder_free(fixture->builder);
    studio_light_layer_free(fixture->layer);
    studio_document_free(fixture->document);
}

static void build(Fixture *fixture) {
    studio_builder_request(fixture->builder, studio_document_source(fixture->document), NULL,
                           studio_document_revision(fixture->document), (StudioMoment){NAN, 2});
    const StudioBuilt *built = NULL;
    for (int i = 0; i < 60000 && built == NULL; i++) {
        g_usleep(1000);
        built = studio_builder_collect(fixture->builder);
    }
    g_assert_nonnull(built);
    g_assert_cmpint(built->status, ==, FR_OK);
    studio_builder_release(fixture->builder);
}

static StudioSight *see(Fixture *fixture, const StudioLightWish *wish) {
    double fraction, seconds;
    while (studio_builder_is_busy(fixture->builder, &fraction, &seconds)) {
        g_usleep(1000);
    }
    studio_sight_free(studio_light_layer_take(fixture->layer));
    studio_light_layer_set(fixture->layer, wish);
    studio_builder_look(fixture->builder);
    StudioSight *sight = NULL;
    for (int i = 0; i < 60000 && sight == NULL; i++) {
        g_usleep(1000);
        sight = studio_light_layer_take(fixture->layer);
    }
    g_assert_nonnull(sight);
    return sight;
}

static void test_rays(Fixture *fixture, gconstpointer data) {
    (void)data;
    build(fixture);
    StudioLightWish wish = {.rays = true, .cells = true, .photons = 25, .slice = 0.5};
    StudioSight *sight = see(fixture, &wish);
    g_assert_true(sight->has_rays);
    g_assert_cmpuint(sight->layers[STUDIO_SIGHT_RAYS]->lines->len, >=, 50);
    g_assert_cmpuint(sight->layers[STUDIO_SIGHT_CELLS]->lines->len, >=, 8 * 24);
    g_assert_null(sight->layers[STUDIO_SIGHT_FIELD]);
    g_assert_cmpuint(sight->stats.photons, ==, 2000);
    g_assert_true(sight->has_probe);
    g_assert_cmpfloat((double)sight->probe.intensity, >, 0);
    g_assert_cmpfloat((double)sight->probe.direction.z, >, 0.8); // the lamp hangs above it
    studio_sight_free(sight);
}

static void test_field(Fixture *fixture, gconstpointer data) {
    (void)data;
    build(fixture);
    StudioLightWish wish = {.field = STUDIO_FIELD_Z, .slice = 1, .photons = 1};
    StudioSight *sight = see(fixture, &wish);
    const GArray *marks = sight->layers[STUDIO_SIGHT_FIELD]->triangles;
    g_assert_cmpuint(marks->len, >, 3000);
    for (guint i = 0; i < marks->len; i += 97) {
        g_assert_cmpfloat_with_epsilon((double)g_array_index(marks, StudioMark, i).at[2],
                                       sight->slice_at, 1e-5);
    }
    g_assert_cmpfloat(sight->top, >, 0);
    studio_sight_free(sight);
    wish.field = STUDIO_FIELD_ORGANS;
    sight = see(fixture, &wish);
    g_assert_cmpuint(sight->layers[STUDIO_SIGHT_FIELD]->points->len, ==, 1); // the tip of the horn
    studio_sight_free(sight);
}

static void test_nothing(Fixture *fixture, gconstpointer data) {
    (void)data;
    build(fixture);
    StudioLightWish wish = {.buds = true, .voxels = true, .particles = true};
    StudioSight *sight = see(fixture, &wish);
    for (int i = 0; i < STUDIO_SIGHT_COUNT; i++) {
        g_assert_null(sight->layers[i]);
    }
    g_assert_false(sight->has_growth);
    g_assert_false(sight->has_probe);
    studio_sight_free(sight);
}

static void test_growth(Fixture *fixture, gconstpointer data) {
    (void)data;
    build(fixture);
    StudioLightWish wish = {.buds = true, .voxels = true, .particles = true};
    StudioSight *sight = see(fixture, &wish);
    g_assert_true(sight->has_growth);
    g_assert_cmpuint(sight->layers[STUDIO_SIGHT_BUDS]->points->len, >, 0);
    g_assert_cmpuint(sight->layers[STUDIO_SIGHT_VOXELS]->lines->len, >, 0);
    g_assert_cmpuint(sight->layers[STUDIO_SIGHT_PARTICLES]->points->len, >=, 40);
    studio_sight_free(sight);
}

// Two seeds 2 m from each other, shown two times farther from their middle.
static const char apart[] =
    "<frond version=\"1\">\n"
    "  <plant id=\"tree\"><species/></plant>\n"
    "  <scene apart=\"2\">\n"
    "    <growth steps=\"3\" min=\"-4, -4, 0\" max=\"4, 4, 6\" particles=\"40\"/>\n"
    "    <place plant=\"tree\" at=\"-1, 0, 0\"/>\n"
    "    <place plant=\"tree\" at=\"1, 0, 0\"/>\n"
    "  </scene>\n"
    "</frond>\n";

static void test_apart(Fixture *fixture, gconstpointer data) {
    (void)data;
    build(fixture);
    StudioLightWish wish = {.buds = true, .voxels = true};
    StudioSight *sight = see(fixture, &wish);
    for (int layer = 0; layer < 2; layer++) {
        const StudioOverlay *overlay =
            sight->layers[layer == 0 ? STUDIO_SIGHT_BUDS : STUDIO_SIGHT_VOXELS];
        const GArray *marks = layer == 0 ? overlay->points : overlay->lines;
        g_assert_cmpuint(marks->len, >, 0);
        for (guint i = 0; i < marks->len; i++) {
            float x = fabsf(g_array_index(marks, StudioMark, i).at[0]);
            g_assert_cmpfloat_with_epsilon(x, 3, 0.9); // 1 and two times 1, and as far as they grew
        }
    }
    studio_sight_free(sight);
}

static void test_dark(Fixture *fixture, gconstpointer data) {
    (void)data;
    build(fixture);
    StudioLightWish wish = {.field = STUDIO_FIELD_Z, .slice = 0.5};
    StudioSight *sight = see(fixture, &wish);
    g_assert_nonnull(sight->problem);
    g_assert_nonnull(strstr(sight->problem, "no light reaches the reference"));
    g_assert_null(sight->layers[STUDIO_SIGHT_FIELD]);
    studio_sight_free(sight);
}

static const char grown[] =
    "<frond version=\"1\">\n"
    "  <plant id=\"p\"><species/></plant>\n"
    "  <scene>\n"
    "    <growth steps=\"3\" min=\"-4, -4, 0\" max=\"4, 4, 6\" particles=\"40\"/>\n"
    "    <place plant=\"p\"/>\n"
    "  </scene>\n"
    "</frond>\n";
static const char dark[] =
    "<frond version=\"1\">\n"
    "  <plant id=\"p\"><pgraph><horn id=\"h\" length=\"0.5\"/></pgraph></plant>\n"
    "  <scene sun-strength=\"0\" sky-strength=\"0\">\n"
    "    <light relative=\"yes\" reference=\"0, 1, 1\"/>\n"
    "    <place plant=\"p\"/>\n"
    "  </scene>\n"
    "</frond>\n";

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add("/studio/light/rays of so many photons are shown, and the cells around a grid",
               Fixture, NULL, set_up, test_rays, tear_down);
    g_test_add("/studio/light/a slice lies where it is said to, and organs are asked", Fixture,
               NULL, set_up, test_field, tear_down);
    g_test_add("/studio/light/what is not there or not wished is not shown", Fixture, NULL, set_up,
               test_nothing, tear_down);
    g_test_add("/studio/light/buds, occupied space and particles of a growth are shown", Fixture,
               grown, set_up, test_growth, tear_down);
    g_test_add("/studio/light/buds and cells go with plants that are shown apart", Fixture, apart,
               set_up, test_apart, tear_down);
    g_test_add("/studio/light/a dark reference is told and harms nothing", Fixture, dark, set_up,
               test_dark, tear_down);
    return g_test_run();
}
