// Edits by hand: what they do, and that they survive.
#include "graphs.h"

#include <cglm/struct.h>
#include <math.h>

#define DEGREES (180 / G_PI)

static const char plant[] = "camera R\ntree T length=2;number=6;gnarl=20\n"
                            "tree B length=.5;number=5;gnarl=30;scale=1 ~ .3\n"
                            "leaf L scale=1 ~ .4\nhorn H length=.3;gnarl=40\n"
                            "R - T\nT = B\nB = L\nB - H";

// An edit with one attribute besides its path.
static void add_edit(FrPgraph *graph, const char *at, const char *name, const char *value) {
    FrEditParams params;
    const FrParamTable *table = fr_edit_table();
    fr_params_init(table, &params);
    params.at = g_strdup(at);
    g_assert_cmpint(
        fr_params_set(table, &params, fr_params_find(table, name), value, (FrSpan){0}, NULL, NULL),
        ==, FR_OK);
    g_assert_cmpint(fr_pgraph_edit(graph, &params, (FrSpan){0}, NULL), ==, FR_OK);
    fr_params_clear(table, &params);
}

static Built build_edited(const char *text, const char *at, const char *name, const char *value) {
    FrPgraph *graph = graph_read(text);
    if (at != NULL) {
        add_edit(graph, at, name, value);
    }
    Built built = build_graph(graph, NULL);
    g_assert_cmpint(built.status, ==, FR_OK);
    assert_sound(built.plant);
    return built;
}

static uint32_t instance_at(const Built *built, const char *path) {
    for (uint32_t k = 0; k < built->counts.instances; k++) {
        char *own = fr_pgraph_path(built->graph, &built->counts, k);
        bool is_found = strcmp(own, path) == 0;
        g_free(own);
        if (is_found) {
            return k;
        }
    }
    return FR_NONE;
}

static void paths(void) {
    Built built = build_edited(plant, NULL, NULL, NULL);
    g_assert_cmpuint(instance_at(&built, "T"), ==, 1);
    g_assert_cmpuint(instance_at(&built, "T/B[5]/L[4]"), !=, FR_NONE);
    g_assert_cmpuint(instance_at(&built, "T/B[0]/H"), !=, FR_NONE);
    g_assert_cmpuint(instance_at(&built, "T/B[6]"), ==, FR_NONE);
    // Every instance but the camera has a path of its own.
    GHashTable *seen = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, NULL);
    for (uint32_t k = 0; k < built.counts.instances; k++) {
        g_hash_table_add(seen, fr_pgraph_path(built.graph, &built.counts, k));
    }
    g_assert_cmpuint(g_hash_table_size(seen), ==, built.counts.instances);
    g_hash_table_unref(seen);
    built_free(built);
}

static void every_path_is_found(void) {
    // What is printed is what edits read: pruning it leaves out what stands below it.
    static const char *const texts[] = {
        plant,
        "tree A depth=3;number=2\nleaf L\nA = A\nA . L",
        "tree T number=3\nffd F\nleaf L\nforce G\nT = F\nF - L\nT - G\nG - L",
        "tree T number=6;forks=2;length=2;start=0\nleaf L\nT = L\nT - L",
        "phiball P number=4\nvariation V\nleaf A\nsimple B\nP - V\nV - A\nV - B",
    };
    for (size_t t = 0; t < G_N_ELEMENTS(texts); t++) {
        Built whole = build_edited(texts[t], NULL, NULL, NULL);
        for (uint32_t k = 0; k < whole.counts.instances; k++) {
            char *path = fr_pgraph_path(whole.graph, &whole.counts, k);
            FrComponentKind kind = fr_pgraph_kind(whole.graph, whole.counts.component[k]);
            bool is_named = kind != FR_COMPONENT_CAMERA && kind != FR_COMPONENT_FFD &&
                            kind != FR_COMPONENT_FORCE;
            if (is_named) {
                Built cut = build_edited(texts[t], path, "prune", "yes");
                g_test_message("%s", path);
                g_assert_cmpuint(cut.counts.edits[0], ==, 1);
                g_assert_cmpuint(cut.counts.instances, <, whole.counts.instances);
                built_free(cut);
            }
            g_free(path);
        }
        built_free(whole);
    }
}

// Whether the axes and organs of all paths but those below are the same in both.
static uint32_t differing(const FrPlant *a, const FrPlant *b) {
    GHashTable *rows = g_hash_table_new(g_int64_hash, g_int64_equal);
    for (uint32_t k = 0; k < b->organs.count; k++) {
        g_hash_table_insert(rows, &b->organs.path[k], GUINT_TO_POINTER(k + 1));
    }
    uint32_t count = 0;
    for (uint32_t k = 0; k < a->organs.count; k++) {
        guint found = GPOINTER_TO_UINT(g_hash_table_lookup(rows, &a->organs.path[k]));
        vec3s p, q;
        versors r, s;
        bool is_same = found != 0;
        if (is_same) {
            fr_plant_organ_pose(a, k, &p, &r);
            fr_plant_organ_pose(b, found - 1, &q, &s);
            is_same = memcmp(&p, &q, sizeof p) == 0 && memcmp(&r, &s, sizeof r) == 0 &&
                      memcmp(&a->organs.scale[k], &b->organs.scale[found - 1], sizeof(float)) == 0;
        }
        count += !is_same;
    }
    g_hash_table_unref(rows);
    return count;
}

static void others_stay(void) {
    // Whatever is done to one branch, the leaves of all others are bit by bit what they were.
    static const char *const edits[][2] = {
        {"prune", "yes"}, {"rotate-x", "30"}, {"bend", "60"},   {"bend-aside", "40"},
        {"scale", "1.5"}, {"redraw", "7"},    {"replace", "L"}, {"axis", "0,0,0 0,.2,.3 .1,.3,.6"},
    };
    Built whole = build_edited(plant, NULL, NULL, NULL);
    for (size_t k = 0; k < G_N_ELEMENTS(edits); k++) {
        Built built = build_edited(plant, "T/B[3]", edits[k][0], edits[k][1]);
        g_test_message("%s", edits[k][0]);
        g_assert_cmpuint(differing(whole.plant, built.plant), ==, 5);
        built_free(built);
    }
    Built one = build_edited(plant, "T/B[3]/L[2]", "scale", "2");
    g_assert_cmpuint(differing(whole.plant, one.plant), ==, 1);
    built_free(one);
    built_free(whole);
}

static void survives(void) {
    // A child more, another number, other sliders, another seed: the edit stays where it is.
    static const char *const changes[][3] = {
        {"T", "number", "9"}, {"T", "length", "3"}, {"B", "number", "3"}, {"T", "seed", "5"},
        {"B", "gnarl", "5"},  {"T", "gnarl", "0"},  {"B", "seed", "9"},
    };
    for (size_t k = 0; k <= G_N_ELEMENTS(changes); k++) {
        FrPgraph *graphs[2];
        for (int with = 0; with < 2; with++) {
            FrPgraph *graph = graph_read(plant);
            if (with != 0) {
                add_edit(graph, "T/B[3]", "scale", "2");
            }
            if (k < G_N_ELEMENTS(changes)) {
                graph_set(graph, changes[k][0], changes[k][1], changes[k][2]);
            } else { // another component under the same tree
                fr_pgraph_add(graph, FR_COMPONENT_LEAF, "N", (FrSpan){0}, NULL);
                fr_pgraph_link(graph, fr_pgraph_find(graph, "T"), fr_pgraph_find(graph, "N"),
                               FR_LINK_BRANCH, (FrSpan){0}, NULL);
            }
            graphs[with] = graph;
        }
        Built without = build_graph(graphs[0], NULL), built = build_graph(graphs[1], NULL);
        g_assert_cmpuint(built.counts.edits[0], ==, 1);
        uint32_t leaves = k == 2 ? 3 : 5;
        g_assert_cmpuint(differing(without.plant, built.plant), ==, leaves);
        built_free(without);
        built_free(built);
    }
}

static void waits(void) {
    // Without its place it is kept and told of; with it, it is as before.
    FrPgraph *graph = graph_read(plant);
    add_edit(graph, "T/B[5]", "prune", "yes");
    add_edit(graph, "T/nothing[1]", "prune", "yes");
    Built before = build_graph(graph, NULL);
    g_assert_cmpuint(built_count(&before, "B"), ==, 5);
    g_assert_cmpuint(fr_diags_count(before.diags), ==, 1);
    g_assert_cmpstr(fr_diags_get(before.diags, 0)->code, ==, "edit-without-place");
    graph_set(graph, "T", "number", "4");
    Built fewer = build_graph(graph, NULL);
    g_assert_cmpuint(fewer.counts.edits[0], ==, 0);
    g_assert_cmpuint(fr_diags_count(fewer.diags), ==, 2);
    g_assert_cmpuint(built_count(&fewer, "B"), ==, 4);
    graph_set(graph, "T", "number", "6");
    Built again = build_graph(graph, NULL);
    g_assert_cmpuint(fr_plant_digest(again.plant), ==, fr_plant_digest(before.plant));
    fewer.graph = again.graph = NULL;
    built_free(fewer);
    built_free(again);
    built_free(before);
}

static void later_one_counts(void) {
    FrPgraph *graph = graph_read(plant);
    add_edit(graph, "T/B[5]", "prune", "yes");
    add_edit(graph, "T/B[5]", "scale", "2");
    Built built = build_graph(graph, NULL);
    g_assert_cmpuint(built_count(&built, "B"), ==, 6);
    g_assert_cmpuint(fr_diags_count(built.diags), ==, 1);
    g_assert_cmpstr(fr_diags_get(built.diags, 0)->code, ==, "duplicate-edit");
    built_free(built);
}

static void bends(void) {
    // 60 degrees more from base to tip, the middle of the last internode counts.
    Built built = build_edited("horn H segments=30", "H", "bend", "60");
    vec3s up = {{0, 0, 1}}, heading = glms_quat_rotatev(built.plant->nodes.frame[29], up);
    double middle = 60 * (29.5 / 30);
    g_assert_cmpfloat_with_epsilon(atan2((double)heading.y, (double)heading.z) * DEGREES, middle,
                                   1e-3);
    built_free(built);
    built = build_edited("horn H segments=30", "H", "bend-aside", "60");
    heading = glms_quat_rotatev(built.plant->nodes.frame[29], up);
    g_assert_cmpfloat_with_epsilon(atan2((double)heading.x, (double)heading.z) * DEGREES, middle,
                                   1e-3);
    built_free(built);
}

static void hides(void) {
    Built built = build_edited(plant, "T/B[2]", "hide", "yes");
    uint32_t hidden = 0;
    for (uint32_t k = 0; k < built.plant->axes.count; k++) {
        hidden += (built.plant->axes.flags[k] & FR_HIDDEN) != 0;
    }
    g_assert_cmpuint(hidden, ==, 1);
    g_assert_cmpuint(built_count(&built, "L"), ==, 30);
    built_free(built);
    built = build_edited(plant, "T/B[2]/L[1]", "hide", "yes");
    hidden = 0;
    for (uint32_t k = 0; k < built.plant->organs.count; k++) {
        hidden += (built.plant->organs.flags[k] & FR_HIDDEN) != 0;
    }
    g_assert_cmpuint(hidden, ==, 1);
    built_free(built);
}

static void replaces(void) {
    // By what stands elsewhere, by what no link leads to, with all that follows on it.
    Built built = build_edited("camera R\ntree T number=4\nleaf L\nhydra F number=5\nsimple P\n"
                               "R - T\nT = L\nF - P",
                               "T/L[2]", "replace", "F");
    g_assert_cmpuint(built_count(&built, "L"), ==, 3);
    g_assert_cmpuint(built_count(&built, "F"), ==, 1);
    g_assert_cmpuint(built_count(&built, "P"), ==, 5);
    g_assert_cmpuint(instance_at(&built, "T/F[2]/P[4]"), !=, FR_NONE);
    built_free(built);
}

static void draws(void) {
    Built whole = build_edited(plant, NULL, NULL, NULL);
    Built a = build_edited(plant, "T/B[3]", "redraw", "1");
    Built b = build_edited(plant, "T/B[3]", "redraw", "2");
    g_assert_cmpuint(fr_plant_digest(a.plant), !=, fr_plant_digest(whole.plant));
    g_assert_cmpuint(fr_plant_digest(a.plant), !=, fr_plant_digest(b.plant));
    built_free(whole);
    built_free(a);
    built_free(b);
}

static void drawn_axis(void) {
    Built built = build_edited(plant, "T/B[3]", "axis", "0,0,0 0,0.3,0.4 0,0.3,0.9");
    double length = 0;
    for (uint32_t axis = 0; axis < built.plant->axes.count; axis++) {
        if (built.plant->axes.last[axis] - built.plant->axes.first[axis] == 15) {
            for (uint32_t k = built.plant->axes.first[axis]; k <= built.plant->axes.last[axis];
                 k++) {
                length += (double)built.plant->nodes.length[k];
            }
        }
    }
    g_assert_cmpfloat(length, >, 0.6);
    g_assert_cmpuint(built_count(&built, "L"), ==, 30);
    built_free(built);
}

static void nested(void) {
    // Edits above and below one another, the lower one keeps its place under a new draw.
    FrPgraph *graph = graph_read(plant);
    add_edit(graph, "R/T/B[3]", "redraw", "4");
    add_edit(graph, "T/B[3]/L[1]", "prune", "yes");
    Built built = build_graph(graph, NULL);
    g_assert_cmpuint(built.counts.edits[0] + built.counts.edits[1], ==, 2);
    g_assert_cmpuint(built_count(&built, "L"), ==, 29);
    built_free(built);
}

static void wrong(void) {
    static const char *const wrongs[][3] = {
        {"", "prune", "yes"},
        {"T/", "prune", "yes"},
        {"/T", "prune", "yes"},
        {"T/B[", "prune", "yes"},
        {"T/B[x]", "prune", "yes"},
        {"T/B[1", "prune", "yes"},
        {"T/B[99999999999]", "prune", "yes"},
        {"T~/B", "prune", "yes"},
        {"T~9/B", "prune", "yes"},
        {"T", "replace", "Q"},
        {"T", "replace", "R"},
        {"T", "axis", "0,0"},
    };
    FrPgraph *graph = graph_read(plant);
    for (size_t k = 0; k < G_N_ELEMENTS(wrongs); k++) {
        FrEditParams params;
        FrDiags *diags = fr_diags_new();
        const FrParamTable *table = fr_edit_table();
        fr_params_init(table, &params);
        params.at = g_strdup(wrongs[k][0]);
        fr_params_set(table, &params, fr_params_find(table, wrongs[k][1]), wrongs[k][2],
                      (FrSpan){0}, NULL, NULL);
        g_assert_cmpint(fr_pgraph_edit(graph, &params, (FrSpan){0}, diags), ==, FR_ERR_DOCUMENT);
        g_assert_cmpuint(fr_diags_error_count(diags), ==, 1);
        g_assert_cmpuint(fr_pgraph_edit_count(graph), ==, 0);
        fr_params_clear(table, &params);
        fr_diags_free(diags);
    }
    fr_pgraph_free(graph);
}

static void rebuilds(void) {
    // A rebuild knows of edits: with one more it is the whole build.
    FrPgraph *before = graph_read(plant), *after = graph_read(plant);
    add_edit(after, "T/B[3]", "scale", "2");
    FrContext context = fr_context_default();
    FrPgraphBuild *first, *second, *third;
    g_assert_cmpint(fr_pgraph_rebuild(before, NULL, &context, &first), ==, FR_OK);
    g_assert_cmpint(fr_pgraph_rebuild(after, first, &context, &second), ==, FR_OK);
    g_assert_cmpint(fr_pgraph_rebuild(after, second, &context, &third), ==, FR_OK);
    Built whole = build_graph(after, NULL);
    FrDigest digest = fr_plant_digest(whole.plant);
    g_assert_cmpuint(fr_plant_digest(fr_pgraph_build_plant(second)), ==, digest);
    g_assert_cmpuint(fr_plant_digest(fr_pgraph_build_plant(third)), ==, digest);
    g_assert_cmpuint(fr_pgraph_build_counts(third)->edits[0], ==, 1);
    built_free(whole);
    fr_pgraph_build_free(first);
    fr_pgraph_build_free(second);
    fr_pgraph_build_free(third);
    fr_pgraph_free(before);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/pgraph/edit/instances have readable paths", paths);
    g_test_add_func("/pgraph/edit/an edit finds every path that is printed", every_path_is_found);
    g_test_add_func("/pgraph/edit/all other instances stay as they were", others_stay);
    g_test_add_func("/pgraph/edit/an edit survives changes of number, sliders and seed", survives);
    g_test_add_func("/pgraph/edit/an edit without a place waits for it", waits);
    g_test_add_func("/pgraph/edit/of two edits of one path the later counts, with a warning",
                    later_one_counts);
    g_test_add_func("/pgraph/edit/a stem is bent over its length", bends);
    g_test_add_func("/pgraph/edit/what is hidden still bears", hides);
    g_test_add_func("/pgraph/edit/an instance is replaced with all that follows", replaces);
    g_test_add_func("/pgraph/edit/each redraw is another draw", draws);
    g_test_add_func("/pgraph/edit/a stem follows a drawn axis", drawn_axis);
    g_test_add_func("/pgraph/edit/edits lie within one another", nested);
    g_test_add_func("/pgraph/edit/wrong edits are refused", wrong);
    g_test_add_func("/pgraph/edit/a rebuild makes edits", rebuilds);
    return g_test_run();
}
