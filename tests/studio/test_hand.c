/// What is picked is edited by hand, and nothing else.
#include "frond/scene.h"
#include "studio.h"
#include "studio/model/hand.h"

static FrScene *scene_of(const StudioDocument *document, FrDocument **read) {
    FrContext context = fr_context_default();
    g_assert_cmpint(fr_document_parse(studio_document_source(document),
                                      studio_document_folder(document), &context, read),
                    ==, FR_OK);
    FrScene *scene;
    g_assert_cmpint(fr_scene_build(*read, -1, &context, &scene), ==, FR_OK);
    return scene;
}

static const FrPlant *plant_of(const FrScene *scene) {
    return g_array_index(scene->plants, FrScenePlant, 0).plant;
}

static bool has_key(const FrPlant *plant, FrKey key) {
    for (uint32_t i = 0; i < plant->axes.count; i++) {
        if (plant->axes.path[i] == key) {
            return true;
        }
    }
    for (uint32_t i = 0; i < plant->organs.count; i++) {
        if (plant->organs.path[i] == key) {
            return true;
        }
    }
    return false;
}

// Prunes some branches and leaves one by one: each vanishes, and undo brings it back.
static void test_prune(gconstpointer data) {
    StudioDocument *document = open_example(data);
    FrDocument *read;
    FrScene *scene = scene_of(document, &read);
    const FrPlant *plant = plant_of(scene);
    char *name =
        g_strdup(fr_contents_at(studio_document_contents(document), first_plant(document))->id);
    uint32_t total = plant->axes.count + plant->organs.count;
    for (uint32_t k = 1; k < total; k += total / 7 + 1) {
        bool is_axis = k < plant->axes.count;
        uint32_t row = is_axis ? k : k - plant->axes.count;
        FrKey key = is_axis ? plant->axes.path[row] : plant->organs.path[row];
        uint32_t component = is_axis ? plant->axes.component[row] : plant->organs.component[row];
        const char *id = g_array_index(plant->components, FrComponent, component).id;
        char *path = studio_hand_path(studio_document_source(document),
                                      studio_document_folder(document), name, id, key);
        g_assert_nonnull(path);
        studio_edit_instance(document, first_plant(document), path, "Prune %s", "prune", "yes",
                             NULL);
        FrDocument *pruned_read;
        FrScene *pruned = scene_of(document, &pruned_read);
        g_assert_false(has_key(plant_of(pruned), key));
        g_assert_cmpuint(plant_of(pruned)->axes.count + plant_of(pruned)->organs.count, <, total);
        fr_scene_free(pruned);
        fr_document_free(pruned_read);
        studio_document_undo(document);
        g_free(path);
    }
    g_assert_cmpuint(studio_document_steps(document), ==, 0);
    g_free(name);
    fr_scene_free(scene);
    fr_document_free(read);
    studio_document_free(document);
}

static void test_nothing(void) {
    StudioDocument *document = open_example("examples/figure2.frond");
    g_assert_null(studio_hand_path(studio_document_source(document), ".", "figure2", "B", 12345));
    g_assert_null(studio_hand_path(studio_document_source(document), ".", "none", "B", 12345));
    studio_document_free(document);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_data_func("/studio/hand/what is picked of figure 2 is pruned",
                         "examples/figure2.frond", test_prune);
    g_test_add_data_func("/studio/hand/what is picked of a sunflower is pruned",
                         "examples/sunflower.frond", test_prune);
    g_test_add_data_func("/studio/hand/what is picked of a tree that forks is pruned",
                         "data/presets/linden.frond", test_prune);
    g_test_add_func("/studio/hand/what is not there has no path", test_nothing);
    return g_test_run();
}
