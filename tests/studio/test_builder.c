/// Builds off the main thread: the newest is shown, the last good one stays, all can be stopped.
#include "building.h"
#include "studio/model/place.h"

#include <cglm/struct.h>
#include <math.h>

static StudioCount counted(const StudioBuilt *built, const char *component) {
    for (guint i = 0; i < built->counts->len; i++) {
        const StudioCount *count = &g_array_index(built->counts, StudioCount, i);
        if (strcmp(count->component, component) == 0) {
            return *count;
        }
    }
    return (StudioCount){0};
}

static uint64_t count_of(const StudioBuilt *built, const char *component) {
    return counted(built, component).instances;
}

static void test_builds(Fixture *fixture, gconstpointer data) {
    (void)data;
    StudioDocument *document = open_example("examples/figure2.frond");
    request(fixture, document, NAN);
    const StudioBuilt *built = await(fixture);
    g_assert_cmpint(built->status, ==, FR_OK);
    g_assert_cmpuint(built->revision, ==, studio_document_revision(document));
    g_assert_cmpuint(built->view->plants->len, ==, 1);
    g_assert_cmpuint(count_of(built, "D"), ==, 9);
    g_assert_cmpfloat(counted(built, "D").seconds, >, 0);
    g_assert_cmpfloat(counted(built, "D").seconds, <, 1);
    studio_builder_release(fixture->builder);
    g_assert_cmpint(g_atomic_int_get(&fixture->wakes), >=, 1);
    studio_document_free(document);
}

static StudioPlantLoad load_of(const StudioBuilt *built, const char *plant) {
    for (guint i = 0; i < built->loads->len; i++) {
        const StudioPlantLoad *load = &g_array_index(built->loads, StudioPlantLoad, i);
        if (strcmp(load->plant, plant) == 0) {
            return *load;
        }
    }
    return (StudioPlantLoad){0};
}

// Times are those of all there is; how long it takes is the machine's.
static void test_times(Fixture *fixture, gconstpointer data) {
    (void)data;
    static const char text[] =
        "<frond version='1'><plant id='leafy'><pgraph><horn id='stem'/></pgraph></plant>"
        "<plant id='host'><pgraph><horn id='trunk'/><graft id='scion' plant='leafy'/>"
        "<leaf id='leaf'/><link from='trunk' to='scion'/><link from='trunk' to='leaf'/></pgraph>"
        "</plant><scene><row plants='host' spacing='1' individuals='2'>0,0,0 3,0,0</row></scene>"
        "</frond>";
    StudioDocument *document = studio_document_new(text, strlen(text), "t", NULL);
    request(fixture, document, NAN);
    const StudioBuilt *built = await(fixture);
    static const char *const components[] = {"trunk", "scion", "leaf"};
    for (size_t i = 0; i < G_N_ELEMENTS(components); i++) {
        StudioCount count = counted(built, components[i]);
        g_assert_cmpfloat(count.seconds, >=, count.skin_seconds); // and no NAN
    }
    g_assert_cmpfloat(counted(built, "trunk").skin_seconds, >, 0);
    StudioPlantLoad host = load_of(built, "host");
    g_assert_cmpuint(host.stands, ==, 4);
    double sum = 0;
    for (guint i = 0; i < built->counts->len; i++) {
        sum += g_array_index(built->counts, StudioCount, i).seconds;
    }
    g_assert_cmpfloat_with_epsilon(host.seconds, sum, 1e-9);
    g_assert_null(load_of(built, "leafy").plant); // it stands nowhere by itself
    studio_builder_release(fixture->builder);
    studio_document_free(document);
}

static void test_species_times(Fixture *fixture, gconstpointer data) {
    (void)data;
    static const char text[] =
        "<frond version='1'><plant id='a'><species/></plant><plant id='b'><species/></plant>"
        "<scene><growth steps='5'/><place plant='a'/><place plant='a' at='9,0,0'/>"
        "<place plant='b' at='0,9,0'/></scene></frond>";
    StudioDocument *document = studio_document_new(text, strlen(text), "t", NULL);
    request_step(fixture, document, 5);
    const StudioBuilt *built = await(fixture);
    StudioPlantLoad a = load_of(built, "a"), b = load_of(built, "b");
    g_assert_cmpuint(a.stands, ==, 2);
    g_assert_cmpuint(b.stands, ==, 1);
    double growth = 0;
    for (guint i = 0; i < built->view->scene->steps->len; i++) {
        growth += g_array_index(built->view->scene->steps, FrSceneStep, i).seconds;
    }
    g_assert_cmpfloat(a.seconds, >, 0);
    g_assert_cmpfloat(b.seconds, >, 0);
    g_assert_cmpfloat(a.seconds + b.seconds, >=, growth * (1 - 1e-9)); // and the skins
    studio_builder_release(fixture->builder);
    studio_document_free(document);
}

static void test_forget(Fixture *fixture, gconstpointer data) {
    (void)data;
    StudioDocument *first = open_example("examples/figure2.frond");
    StudioDocument *second = open_example("examples/figure2.frond");
    request(fixture, first, NAN);
    double fraction, seconds = 0;
    while (seconds == 0) { // until it has begun; done it waits to be collected
        studio_builder_is_busy(fixture->builder, &fraction, &seconds);
    }
    studio_builder_forget(fixture->builder);
    request(fixture, second, NAN);
    const StudioBuilt *built = await(fixture);
    g_assert_true(built->is_forgotten);
    studio_builder_release(fixture->builder);
    built = await(fixture);
    g_assert_false(built->is_forgotten);
    g_assert_nonnull(built->view);
    studio_builder_release(fixture->builder);
    studio_document_free(first);
    studio_document_free(second);
}

static void test_leaves(Fixture *fixture, gconstpointer data) {
    (void)data;
    StudioDocument *document = open_example("examples/chestnut.frond");
    request(fixture, document, NAN);
    const StudioBuilt *built = await(fixture);
    const StudioPlant *plant = g_ptr_array_index(built->view->plants, 0);
    g_assert_cmpuint(plant->leaves->len, ==, 207000);
    // A tenth of each batch is spread over the whole crown.
    const StudioBatch *batch = &g_array_index(plant->batches, StudioBatch, 0);
    float low = INFINITY, high = -INFINITY, lowest = INFINITY, highest = -INFINITY;
    for (uint32_t i = 0; i < batch->count; i++) {
        float z = g_array_index(plant->leaves, StudioLeaf, batch->first + i).at[2];
        lowest = MIN(lowest, z);
        highest = MAX(highest, z);
        if (i < batch->count / 10) {
            low = MIN(low, z);
            high = MAX(high, z);
        }
    }
    g_assert_cmpfloat(high - low, >, 0.9f * (highest - lowest));
    // What is drawn while it moves has wood, too, but little.
    g_assert_nonnull(plant->coarse_wood[0]);
    g_assert_cmpuint(plant->coarse_wood[0]->index_count, >, 3 * 1000);
    g_assert_cmpuint(plant->coarse_wood[0]->index_count, <, 3 * 60000);
    studio_builder_release(fixture->builder);
    // An edit of leaves leaves it as it is.
    studio_set(document,
               studio_place_find(studio_document_contents(document),
                                 "frond/plant:chestnut/pgraph/leaf:leaf"),
               "width", "0.06", false);
    const FrMesh *wood = plant->coarse_wood[0];
    request(fixture, document, NAN);
    built = await(fixture);
    plant = g_ptr_array_index(built->view->plants, 0);
    g_assert_true(plant->coarse_wood[0] == wood);
    studio_builder_release(fixture->builder);
    studio_document_free(document);
}

// What is shown ahead of the next outcome, which is waited for; NULL: nothing.
static StudioOverlay *ahead_of(Fixture *fixture, const StudioDocument *document) {
    request(fixture, document, NAN);
    StudioOverlay *ahead = NULL;
    const StudioBuilt *built = NULL;
    while (built == NULL) {
        ahead = ahead != NULL ? ahead : studio_builder_take_ahead(fixture->builder);
        built = studio_builder_collect(fixture->builder);
        g_usleep(500);
    }
    g_assert_nonnull(built->view);
    studio_builder_release(fixture->builder);
    return ahead;
}

static void test_ahead(Fixture *fixture, gconstpointer data) {
    (void)data;
    StudioDocument *document = open_example("examples/chestnut.frond");
    g_assert_null(ahead_of(fixture, document)); // nothing is known of it yet
    const FrContents *contents = studio_document_contents(document);
    studio_set(document, fr_contents_find(contents, 0, "trunk"), "length", "14", false);
    StudioOverlay *skeleton = ahead_of(fixture, document);
    g_assert_nonnull(skeleton);
    g_assert_cmpuint(skeleton->lines->len, >, 2 * 500);
    float top = 0;
    for (guint i = 0; i < skeleton->lines->len; i++) {
        top = MAX(top, g_array_index(skeleton->lines, StudioMark, i).at[2]);
    }
    g_assert_cmpfloat(top, >, 12); // it is the new trunk
    studio_overlay_free(skeleton);
    contents = studio_document_contents(document);
    studio_set(document, studio_place_find(contents, "frond/plant:chestnut/pgraph/leaf:leaf"),
               "width", "0.06", false);
    g_assert_null(ahead_of(fixture, document)); // leaves are no part of it
    studio_document_free(document);
}

static void test_extent(Fixture *fixture, gconstpointer data) {
    (void)data;
    StudioDocument *document = open_example("examples/figure2.frond");
    request(fixture, document, NAN);
    const StudioView *view = await(fixture)->view;
    const StudioPlant *plant = g_ptr_array_index(view->plants, 0);
    FrSkinParams skin = fr_skin_default();
    FrContext context = fr_context_default();
    FrMesh *mesh;
    const FrScenePlant *built = &g_array_index(view->scene->plants, FrScenePlant, 0);
    g_assert_cmpint(fr_scene_mesh(built, &skin, FR_UP_Z, &context, &mesh), ==, FR_OK);
    float farthest = 0;
    for (uint64_t i = 0; i < mesh->vertex_count; i++) {
        const float *at = mesh->vertices[i].position;
        farthest = MAX(farthest, glms_vec3_distance((vec3s){{at[0], at[1], at[2]}}, plant->middle));
    }
    g_assert_cmpfloat(plant->radius, >=, farthest);
    g_assert_cmpfloat(plant->radius, <, 1.6f * farthest);
    fr_mesh_free(mesh);
    studio_builder_release(fixture->builder);
    studio_document_free(document);
}

static void test_stands(Fixture *fixture, gconstpointer data) {
    (void)data;
    static const char text[] =
        "<frond version='1'><plant id='tree'><pgraph>"
        "<tree id='trunk' length='6' radius='0.2' gnarl='30' number='60'/>"
        "<tree id='limb' length='2' radius='0.06..0.02' gnarl='30' number='9'/>"
        "<tree id='twig' length='0.5' radius='0.01'/><link from='trunk' to='limb' kind='branch'/>"
        "<link from='limb' to='twig' kind='branch'/></pgraph></plant>"
        "<scene><row plants='tree' spacing='1'>0,0,0 %d,0,0</row></scene></frond>";
    uint64_t indices[2];
    for (int i = 0; i < 2; i++) {
        char *some = g_strdup_printf(text, i == 0 ? 40 : 400);
        StudioDocument *document = studio_document_new(some, strlen(some), "row", NULL);
        request(fixture, document, NAN);
        const StudioView *view = await(fixture)->view;
        indices[i] = 0;
        for (guint s = 0; s < view->scene->stands->len; s++) {
            uint32_t plant = g_array_index(view->scene->stands, FrStand, s).plant;
            const StudioPlant *seen = g_ptr_array_index(view->plants, plant);
            const FrMesh *wood = seen->coarse_wood[i == 0 ? 0 : STUDIO_COARSE_LEVELS - 1];
            g_assert_nonnull(wood);
            g_assert_cmpuint(wood->index_count, >, 0);
            indices[i] += wood->index_count;
        }
        studio_document_free(document);
        g_free(some);
    }
    g_assert_cmpuint(indices[0], >, 3 * 500);
    g_assert_cmpuint(indices[1], <, 3 * 60000);
}

static void test_surfaces(Fixture *fixture, gconstpointer data) {
    (void)data;
    StudioDocument *document = open_example("examples/nurbs/star.frond");
    request(fixture, document, NAN);
    const StudioBuilt *built = await(fixture);
    const StudioPlant *plant = g_ptr_array_index(built->view->plants, 0);
    g_assert_true(plant->is_rational);
    g_assert_null(plant->coarse_wood[0]);
    FrContext context = fr_context_default();
    FrSkinParams skin = fr_skin_default();
    FrMesh *mesh;
    const FrScenePlant *shown = &g_array_index(built->view->scene->plants, FrScenePlant, 0);
    g_assert_cmpint(fr_scene_mesh(shown, &skin, FR_UP_Z, &context, &mesh), ==, FR_OK);
    g_assert_cmphex(fr_mesh_digest(plant->foliage), ==, fr_mesh_digest(mesh));
    fr_mesh_free(mesh);
    studio_builder_release(fixture->builder);
    studio_document_free(document);
}

static void test_last_good_stays(Fixture *fixture, gconstpointer data) {
    (void)data;
    StudioDocument *document = open_example("examples/figure2.frond");
    request(fixture, document, NAN);
    await(fixture);
    studio_builder_release(fixture->builder);
    studio_set(document, element_of(document, "B"), "length", "2 +", false);
    request(fixture, document, NAN);
    const StudioBuilt *built = await(fixture);
    g_assert_cmpint(built->status, ==, FR_ERR_DOCUMENT);
    g_assert_null(built->view);
    g_assert_cmpuint(fr_diags_error_count(built->diags), ==, 1);
    FrSpan span = fr_diags_get(built->diags, 0)->span;
    char *attribute;
    fr_contents_around(studio_document_contents(document), span.begin, &attribute);
    g_assert_cmpstr(attribute, ==, "length");
    g_free(attribute);
    studio_builder_release(fixture->builder);
    studio_document_undo(document);
    request(fixture, document, NAN);
    built = await(fixture);
    g_assert_nonnull(built->view);
    studio_builder_release(fixture->builder);
    studio_document_free(document);
}

static void test_newest_only(Fixture *fixture, gconstpointer data) {
    (void)data;
    StudioDocument *document = open_example("examples/figure2.frond");
    char value[8];
    for (int i = 1; i <= 100; i++) {
        g_snprintf(value, sizeof value, "%d", i);
        studio_set(document, element_of(document, "B"), "length", value, true);
        request(fixture, document, NAN);
    }
    uint64_t last = 0;
    int collected = 0;
    while (last != studio_document_revision(document)) {
        const StudioBuilt *built = await(fixture);
        g_assert_cmpuint(built->revision, >, last);
        last = built->revision;
        collected++;
        studio_builder_release(fixture->builder);
    }
    g_assert_cmpint(collected, <=, 3);
    studio_document_free(document);
}

static void test_cancel(Fixture *fixture, gconstpointer data) {
    (void)data;
    StudioDocument *document = open_example("examples/chestnut.frond");
    studio_set(document, element_of(document, "shoot"), "number", "700", false);
    request(fixture, document, NAN);
    double fraction, seconds;
    while (studio_builder_is_busy(fixture->builder, &fraction, &seconds) && seconds < 0.01) {
        g_usleep(500);
    }
    studio_builder_cancel(fixture->builder);
    const StudioBuilt *built = await(fixture);
    g_assert_cmpint(built->status, ==, FR_CANCELLED);
    studio_builder_release(fixture->builder);
    studio_document_free(document);
}

static void test_time(Fixture *fixture, gconstpointer data) {
    (void)data;
    static const char text[] = "<frond version='1'><plant id='p' age='0'><pgraph><camera id='r'/>"
                               "<horn id='h'/><horn id='late' birth='5'/><link from='r' to='h'/>"
                               "<link from='h' to='late'/></pgraph></plant><oops/></frond>";
    GString *right = g_string_new(text);
    g_string_replace(right, "<oops/>", "", 0);
    StudioDocument *document = studio_document_new(right->str, right->len, "t", NULL);
    request(fixture, document, NAN);
    g_assert_cmpuint(count_of(await(fixture), "late"), ==, 0);
    studio_builder_release(fixture->builder);
    request(fixture, document, 8);
    g_assert_cmpuint(count_of(await(fixture), "late"), ==, 1);
    studio_builder_release(fixture->builder);
    studio_document_free(document);
    // Places stay those of the document.
    document = studio_document_new(text, strlen(text), "t", NULL);
    request(fixture, document, 8);
    const StudioBuilt *built = await(fixture);
    FrSpan span = fr_diags_get(built->diags, 0)->span;
    g_assert_cmpint(strncmp(text + span.begin, "oops", 4), ==, 0);
    studio_builder_release(fixture->builder);
    studio_document_free(document);
    g_string_free(right, TRUE);
}

// The number of internodes at a step of three plants that grow bud by bud.
static uint64_t nodes_at(Fixture *fixture, const StudioDocument *document, int64_t step) {
    request_step(fixture, document, step);
    const StudioBuilt *built = await(fixture);
    g_assert_cmpint(built->status, ==, FR_OK);
    g_assert_true(built->is_growing);
    g_assert_cmpuint(built->step, ==, step < 0 ? built->step_count : (uint64_t)step);
    uint64_t nodes = 0;
    for (guint i = 0; i < built->view->plants->len; i++) {
        nodes +=
            ((const StudioPlant *)g_ptr_array_index(built->view->plants, i))->plant->nodes.count;
    }
    studio_builder_release(fixture->builder);
    return nodes;
}

static void test_growth(Fixture *fixture, gconstpointer data) {
    (void)data;
    static const char text[] = "<frond version='1'><plant id='tree' seed='1'><species/></plant>"
                               "<scene><growth steps='6'/><place plant='tree'/>"
                               "<place plant='tree' at='1, 0, 0'/></scene></frond>";
    StudioDocument *document = studio_document_new(text, strlen(text), "g", NULL);
    uint64_t grown = nodes_at(fixture, document, -1);
    uint64_t none = nodes_at(fixture, document, 0), three = nodes_at(fixture, document, 3);
    g_assert_cmpuint(none, <, three);
    g_assert_cmpuint(three, <, grown);
    g_assert_cmpuint(nodes_at(fixture, document, 6), ==, grown);
    g_assert_cmpuint(nodes_at(fixture, document, 3), ==, three);
    studio_document_free(document);
}

static void test_pictures(Fixture *fixture, gconstpointer data) {
    (void)data;
    StudioDocument *document = open_example("examples/sunflower.frond");
    request(fixture, document, NAN);
    const StudioBuilt *built = await(fixture);
    const StudioPlant *plant = g_ptr_array_index(built->view->plants, 0);
    guint looks = plant->looks->len, pictures = 0;
    g_assert_cmpuint(looks, >, 0);
    studio_builder_release(fixture->builder);
    StudioPicture picture;
    guint maps[FR_MAP_COUNT] = {0};
    for (int i = 0; i < 60000 && studio_builder_is_painting(fixture->builder); i++) {
        if (studio_builder_take_picture(fixture->builder, &picture)) {
            pictures++;
            maps[picture.map] += picture.image != NULL;
            fr_image_unref(picture.image);
        } else {
            g_usleep(1000);
        }
    }
    while (studio_builder_take_picture(fixture->builder, &picture)) {
        pictures++;
        maps[picture.map] += picture.image != NULL;
        fr_image_unref(picture.image);
    }
    g_assert_cmpuint(pictures, ==, FR_MAP_COUNT * looks);
    g_assert_cmpuint(maps[FR_MAP_NORMAL], >, 0);
    g_assert_cmpuint(maps[FR_MAP_ROUGHNESS], >, 0);
    // The same looks are not painted again.
    studio_set(document, first_plant(document), "seed", "77", false);
    request(fixture, document, NAN);
    await(fixture);
    studio_builder_release(fixture->builder);
    g_assert_false(studio_builder_is_painting(fixture->builder));
    studio_document_free(document);
}

static float red_of(const StudioBuilt *built) {
    g_assert_cmpuint(built->view->shading.lamp_count, ==, 1);
    vec3s light = built->view->shading.lamps[0].intensity;
    return light.r / light.b;
}

static void test_lamps(Fixture *fixture, gconstpointer data) {
    (void)data;
    static const char text[] = "<frond version='1'><plant id='p'><pgraph><horn id='h'/></pgraph>"
                               "</plant><scene><lamp id='bulb' colour='#ffffff'/></scene></frond>";
    StudioDocument *document = studio_document_new(text, sizeof text - 1, "lamps.frond", "");
    request(fixture, document, NAN);
    float before = red_of(await(fixture));
    studio_builder_release(fixture->builder);
    studio_set(document, element_of(document, "bulb"), "colour", "#ff4040", false);
    request(fixture, document, NAN);
    g_assert_cmpfloat(red_of(await(fixture)), >, 2 * before);
    studio_builder_release(fixture->builder);
    studio_document_free(document);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    ADD("/studio/builder/what was asked for of a document that has gone is told apart",
        test_forget);
    ADD("/studio/builder/a document becomes a view with counts", test_builds);
    ADD("/studio/builder/times are of grafts, skins and whole plants, too", test_times);
    ADD("/studio/builder/species share the time of their growth", test_species_times);
    ADD("/studio/builder/the first leaves of a batch are spread over all", test_leaves);
    ADD("/studio/builder/a ball holds all of a plant and little else", test_extent);
    ADD("/studio/builder/many plants that stand share what is drawn while the view moves",
        test_stands);
    ADD("/studio/builder/plants with surfaces are shown as surfaces", test_surfaces);
    ADD("/studio/builder/the skeleton of what takes long is there before it, if it is another",
        test_ahead);
    ADD("/studio/builder/a mistake has its place and does not stop the next build",
        test_last_good_stays);
    ADD("/studio/builder/of many requests the last is built", test_newest_only);
    ADD("/studio/builder/a long build can be stopped", test_cancel);
    ADD("/studio/builder/another time moves no place of a diagnostic", test_time);
    ADD("/studio/builder/what grows bud by bud is taken forth and back", test_growth);
    ADD("/studio/builder/maps of materials are made once", test_pictures);
    ADD("/studio/builder/the light of a view is that of the lamps as they are", test_lamps);
    return g_test_run();
}
