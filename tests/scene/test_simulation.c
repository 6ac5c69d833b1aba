/// Scenes that grow step by step, are looked at, changed, taken back and saved.
#include "built.h"
#include "run.h"
#include "scene/solids.h"

#include <cglm/struct.h>
#include <math.h>

#define SPECIES(attributes) "<species model='open' step='0.4' auxin-reach='2' " attributes "/>"
#define WORLD "<growth steps='9' min='-6,-6,-1' max='6,6,9' cell='0.05'/>"
#define SCENE(attributes, scene)                                                                   \
    "<frond version='1'><plant id='a'>" SPECIES(attributes) "</plant><plant id='b'>" SPECIES(      \
        "laterals='3'") "</plant><scene>" WORLD scene "</scene></frond>"

static FrDigest digest(const Run *run) {
    return fr_simulation_stats(run->simulation).digest;
}

static const FrPlant *plant_of(Run *run, guint index) {
    return g_array_index(scene_of(run)->plants, FrScenePlant, index).plant;
}

/// Mean height that internodes born after a step win over their length.
static double rise_after(const FrPlant *plant, uint16_t birth) {
    double rise = 0, length = 0;
    for (uint32_t i = 0; i < plant->nodes.count; i++) {
        if (plant->nodes.birth[i] > birth) {
            vec3s heading = fr_frame_heading(plant->nodes.frame[i]);
            rise += (double)(heading.z * plant->nodes.length[i]);
            length += (double)plant->nodes.length[i];
        }
    }
    return rise / length;
}

static void test_change(void) {
    Run run = begin(SCENE("shed='none' smooth='no'", "<place plant='a'/>"), 0);
    step(&run, 6);
    FrPlant *before = fr_plant_copy(plant_of(&run, 0));
    FrDocument *changed = parse(SCENE("shed='none' smooth='no' gravitropism='-1'",
                                      "<place plant='a'/><place plant='b' at='3,0,0'/>"),
                                &run.context);
    g_assert_cmpint(fr_simulation_change(run.simulation, changed, &run.context), ==, FR_OK);
    step(&run, 3);
    const FrPlant *after = plant_of(&run, 0);
    // Old wood stands where it stood.
    g_assert_cmpuint(after->nodes.count, >, before->nodes.count);
    guint found = 0;
    for (uint32_t i = 0; i < before->nodes.count; i++) {
        for (uint32_t k = 0; k < after->nodes.count; k++) {
            if (glms_vec3_distance(before->nodes.position[i], after->nodes.position[k]) < 1e-5F) {
                found++;
                break;
            }
        }
    }
    g_assert_cmpuint(found, ==, before->nodes.count);
    // New wood bends down, and what was placed anew grows.
    Run same = begin(SCENE("shed='none' smooth='no'", "<place plant='a'/>"), 0);
    step(&same, 9);
    g_assert_cmpfloat(rise_after(after, 6), <, rise_after(plant_of(&same, 0), 6) - 0.2);
    g_assert_cmpuint(plant_of(&run, 1)->nodes.count, >=, 3);
    end(&same);
    fr_plant_free(before);
    end(&run);
    fr_document_free(changed);
}

static void test_change_refused(void) {
    Run run = begin(SCENE("", "<place plant='a'/>"), 0);
    step(&run, 2);
    FrDigest before = digest(&run);
    FrDocument *fewer = parse("<frond version='1'><plant id='a'><species/></plant><scene>" WORLD
                              "<place plant='a'/></scene></frond>",
                              &run.context);
    g_assert_cmpint(fr_simulation_change(run.simulation, fewer, &run.context), ==, FR_ERR_DOCUMENT);
    g_assert_cmpuint(digest(&run), ==, before);
    step(&run, 1);
    end(&run);
    fr_document_free(fewer);
}

/// A seed comes in when the document's obstacle has gone, and undoing and saving agree.
static void test_freed(void) {
    Run run = begin(SCENE("", "<place plant='a'/><place plant='b' at='2,0,0'/>"
                              "<obstacle at='2,0,0' size='1,1,1'/>"),
                    9);
    step(&run, 2);
    FrDigest before = digest(&run);
    FrDocument *freed =
        parse(SCENE("", "<place plant='a'/><place plant='b' at='2,0,0'/>"), &run.context);
    g_assert_cmpint(fr_simulation_change(run.simulation, freed, &run.context), ==, FR_OK);
    g_assert_cmpuint(plant_of(&run, 1)->nodes.count, ==, 0);
    GBytes *saved = fr_simulation_save(run.simulation, &run.context);
    step(&run, 2);
    g_assert_cmpuint(plant_of(&run, 1)->nodes.count, >=, 2);
    FrDigest after = digest(&run);
    g_assert_true(fr_simulation_undo(run.simulation) && fr_simulation_undo(run.simulation));
    g_assert_cmpuint(digest(&run), ==, before);
    step(&run, 2);
    g_assert_cmpuint(digest(&run), ==, after);
    Run other = begin(SCENE("", "<place plant='a'/><place plant='b' at='2,0,0'/>"), 0);
    gsize size;
    const void *data = g_bytes_get_data(saved, &size);
    g_assert_cmpint(
        fr_simulation_restore(other.simulation, data, size, (FrSpan){0}, &other.context), ==,
        FR_OK);
    step(&other, 2);
    g_assert_cmpuint(digest(&other), ==, after);
    g_bytes_unref(saved);
    end(&other);
    end(&run);
    fr_document_free(freed);
}

static void test_undo(void) {
    Run run = begin(SCENE("", "<place plant='a'/><place plant='b' at='1,0,0'/>"), 3);
    FrDigest digests[8];
    for (int i = 0; i < 8; i++) {
        step(&run, 1);
        digests[i] = digest(&run);
    }
    for (int i = 6; i >= 4; i--) {
        g_assert_true(fr_simulation_undo(run.simulation));
        g_assert_cmpuint(digest(&run), ==, digests[i]);
    }
    g_assert_false(fr_simulation_undo(run.simulation));
    step(&run, 3);
    g_assert_cmpuint(digest(&run), ==, digests[7]);
    end(&run);
}

static void test_save(void) {
    Run run = begin(SCENE("", "<strew plants='a, b' number='9' width='9' depth='9'/>"), 0);
    step(&run, 4);
    GBytes *saved = fr_simulation_save(run.simulation, &run.context);
    step(&run, 4);
    FrDigest end_digest = digest(&run);
    gsize size;
    const void *data = g_bytes_get_data(saved, &size);
    Run other = begin(SCENE("", "<strew plants='a, b' number='9' width='9' depth='9'/>"), 0);
    g_assert_cmpint(
        fr_simulation_restore(other.simulation, data, size, (FrSpan){0}, &other.context), ==,
        FR_OK);
    step(&other, 4);
    g_assert_cmpuint(digest(&other), ==, end_digest);
    end(&other);
    Run stranger = begin(SCENE("", "<place plant='a'/>"), 0);
    g_assert_cmpint(
        fr_simulation_restore(stranger.simulation, data, size, (FrSpan){0}, &stranger.context), ==,
        FR_ERR_DOCUMENT);
    step(&stranger, 1);
    end(&stranger);
    g_bytes_unref(saved);
    end(&run);
}

static void test_order(void) {
    Run one = begin(SCENE("", "<place plant='a'/><place plant='b' at='0.8,0,0'/>"
                              "<place plant='a' at='0,1,0'/>"),
                    0);
    Run two = begin(SCENE("", "<place plant='a' at='0,1,0'/><place plant='a'/>"
                              "<place plant='b' at='0.8,0,0'/>"),
                    0);
    step(&one, 9);
    step(&two, 9);
    g_assert_cmpuint(digest(&one), ==, digest(&two));
    end(&one);
    end(&two);
}

// ---- what is in the way -----------------------------------------------------------------------

/// Whether a piece of a line crosses a triangle: signs of volumes, exact but for rounding (Segura
/// and Feito 2001).
static double volume(vec3s a, vec3s b, vec3s c, vec3s d) {
    double m[3][3];
    for (int r = 0; r < 3; r++) {
        m[0][r] = (double)b.raw[r] - (double)a.raw[r];
        m[1][r] = (double)c.raw[r] - (double)a.raw[r];
        m[2][r] = (double)d.raw[r] - (double)a.raw[r];
    }
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
           m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

static bool crosses(vec3s p, vec3s q, vec3s a, vec3s b, vec3s c) {
    if ((volume(a, b, c, p) > 0) == (volume(a, b, c, q) > 0)) {
        return false;
    }
    bool first = volume(p, q, a, b) > 0, second = volume(p, q, b, c) > 0,
         third = volume(p, q, c, a) > 0;
    return first == second && second == third;
}

static bool is_free(const FrSolids *solids, vec3s p, vec3s q) {
    for (guint s = 0; s < solids->all->len; s++) {
        const FrGrowthObstacle *solid = &g_array_index(solids->all, FrGrowthObstacle, s);
        for (uint32_t i = 0; i < solid->index_count && !solid->is_ground; i += 3) {
            const uint32_t *corner = &solid->indices[i];
            if (crosses(p, q, solid->positions[corner[0]], solid->positions[corner[1]],
                        solid->positions[corner[2]])) {
                return false;
            }
        }
    }
    return true;
}

static void test_obstacles(void) {
    Run run = begin(SCENE("", "<obstacle shape='sphere' at='0.2,0.3,1' size='1.5,1.5,1.5'/>"
                              "<obstacle at='-1.5,0,0.7' size='1,2,2' turn='20' visible='no'/>"
                              "<obstacle shape='sweep' size='0.5,1,0.5'>-3,1.5,2 3,1.5,2</obstacle>"
                              "<row plants='a, b' rows='3' between='1.1' spacing='1.1'>-2,0,0 2,0,0"
                              "</row>"),
                    0);
    step(&run, 9);
    const FrScene *scene;
    g_assert_cmpint(fr_simulation_scene(run.simulation, &run.context, &scene), ==, FR_OK);
    FrSolids solids = fr_solids_new();
    const vec3s box[2] = {{{-6, -6, -1}}, {{6, 6, 9}}};
    g_assert_cmpint(fr_solids_add_surroundings(&solids, scene, NULL, box, &run.context), ==, FR_OK);
    uint64_t looked_at = 0;
    for (guint i = 0; i < scene->stands->len - scene->obstacles; i++) {
        const FrStand *stand = &g_array_index(scene->stands, FrStand, i);
        const FrPlant *plant = g_array_index(scene->plants, FrScenePlant, stand->plant).plant;
        vec3s at = {{(float)stand->at[0], (float)stand->at[1], (float)stand->at[2]}};
        for (uint32_t n = 0; n < plant->nodes.count; n++) {
            uint32_t parent = plant->nodes.parent[n];
            vec3s from = parent == FR_NONE ? at : glms_vec3_add(at, plant->nodes.position[parent]);
            g_assert_true(is_free(&solids, from, glms_vec3_add(at, plant->nodes.position[n])));
            looked_at++;
        }
    }
    g_assert_cmpuint(looked_at, >, 500);
    g_assert_cmpuint(fr_simulation_stats(run.simulation).collisions, >, 0);
    fr_solids_clear(&solids);
    end(&run);
}

static FrDigest grown(const char *scene) {
    Run run = begin(scene, 0);
    step(&run, 8);
    FrDigest found = digest(&run);
    end(&run);
    return found;
}

/// A lid over a plant darkens it, unless it cannot be seen.
static void test_clear(void) {
    FrDigest open = grown(SCENE("", "<place plant='a'/>"));
    FrDigest lid = grown(SCENE("", "<place plant='a'/><obstacle at='0,0,5' size='11,11,0.2'/>"));
    FrDigest clear =
        grown(SCENE("", "<place plant='a'/><obstacle at='0,0,5' size='11,11,0.2' visible='no'/>"));
    g_assert_cmpuint(clear, ==, open);
    g_assert_cmpuint(lid, !=, open);
}

static void test_envelope(void) {
    Run run = begin("<frond version='1'><plant id='a'><species model='open' step='0.2' "
                    "laterals='3' auxin-reach='1' shed='none' smooth='no' "
                    "envelope='0.3,0 0.3,0.5 1.2,0.7 0.1,2.5'/></plant><scene>" WORLD
                    "<place plant='a'/></scene></frond>",
                    0);
    step(&run, 18);
    const FrPlant *plant = plant_of(&run, 0);
    g_assert_cmpuint(plant->nodes.count, >, 300);
    for (uint32_t i = 0; i < plant->nodes.count; i++) {
        vec3s at = plant->nodes.position[i];
        double radius = at.z < 0.5F   ? 0.3
                        : at.z < 0.7F ? 0.3 + ((double)at.z - 0.5) / 0.2 * 0.9
                                      : 1.2 - ((double)at.z - 0.7) / 1.8 * 1.1;
        g_assert_cmpfloat(hypot((double)at.x, (double)at.y), <=, radius + 1e-4);
        g_assert_cmpfloat((double)at.z, <=, 2.5 + 1e-4);
    }
    end(&run);
}

/// An L-system that tells the light, beside a plant that grows bud by bud, and the other way round.
static void test_lsystem(void) {
    static const char text[] = "<frond version='1'><plant id='a'>" SPECIES(
        "laterals='3' leaves='6' leaf-length='0.5' leaf-width='0.4'") "</plant>"
                                                                      "<plant "
                                                                      "id='l'><lsystem><![CDATA["
                                                                      "\nlsystem: 1\nderivation "
                                                                      "length: 9\n"
                                                                      "Axiom: F(0.4)?E(0)\n?E(x) "
                                                                      "--> "
                                                                      "F(0.1*x)?E(0)\nendlsystem\n]"
                                                                      "]></lsystem></"
                                                                      "plant><scene>" WORLD
                                                                      "<light/><place plant='l' "
                                                                      "at='0.25,0,0'/>%s</scene></"
                                                                      "frond>";
    char *alone = g_strdup_printf(text, "");
    char *beside = g_strdup_printf(text, "<place plant='a'/>");
    FrContext context = fr_context_default();
    double heights[2];
    uint64_t steps = 0;
    for (int i = 0; i < 2; i++) {
        FrDocument *document = parse(i == 0 ? alone : beside, &context);
        FrScene *scene;
        g_assert_cmpint(fr_scene_build(document, -1, &context, &scene), ==, FR_OK);
        vec3s min, max;
        fr_plant_bounds(g_array_index(scene->plants, FrScenePlant, 0).plant, &min, &max);
        heights[i] = (double)max.z;
        steps = scene->steps->len;
        fr_scene_free(scene);
        fr_document_free(document);
    }
    g_assert_cmpuint(steps, ==, 9); // both take the same steps
    g_assert_cmpfloat(heights[1], <, heights[0] - 0.05);
    g_free(alone);
    g_free(beside);
}

/// E23: three plants that have grown together; shown apart each is the same to the last bit.
static void test_apart(void) {
    static const double places[3] = {-0.5, 0, 0.5};
    FrDigest digests[3];
    for (int apart = 0; apart <= 3; apart += 3) {
        char *text = g_strdup_printf("<frond version='1'><plant id='a'>" SPECIES(
                                         "") "</plant><scene apart='%d'>" WORLD
                                             "<place plant='a' at='-0.5,0,0'/><place plant='a'/>"
                                             "<place plant='a' at='0.5,0,0'/></scene></frond>",
                                     apart);
        Run run = begin(text, 0);
        step(&run, 9);
        g_assert_cmpuint(fr_simulation_stats(run.simulation).collisions, >, 0);
        const FrScene *scene;
        g_assert_cmpint(fr_simulation_scene(run.simulation, &run.context, &scene), ==, FR_OK);
        g_assert_cmpuint(scene->stands->len, ==, 3);
        for (guint i = 0; i < 3; i++) {
            const FrStand *stand = &g_array_index(scene->stands, FrStand, i);
            // The middle of all stays; each is three times as far away beyond where it has grown.
            g_assert_cmpfloat(fabs(stand->at[0] - (1 + apart) * places[i]), <, 1e-9);
            g_assert_cmpfloat(fabs(stand->at[1]), <, 1e-9);
            FrDigest shown =
                fr_plant_digest(g_array_index(scene->plants, FrScenePlant, stand->plant).plant);
            digests[i] = apart == 0 ? shown : digests[i];
            g_assert_cmpuint(shown, ==, digests[i]);
        }
        g_assert_cmpuint(digests[0], !=, digests[1]);
        end(&run);
        g_free(text);
    }
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/scene/simulation/E01 a change lets old wood stand and bends what is new",
                    test_change);
    g_test_add_func("/scene/simulation/a change of the number of species is refused",
                    test_change_refused);
    g_test_add_func("/scene/simulation/a seed comes in when what stood on it has gone", test_freed);
    g_test_add_func("/scene/simulation/steps are taken back as far as is kept", test_undo);
    g_test_add_func("/scene/simulation/E01 a saved state goes on as if nothing had been",
                    test_save);
    g_test_add_func("/scene/simulation/E22 places in another order grow the same plants",
                    test_order);
    g_test_add_func("/scene/simulation/E02 no internode crosses an obstacle", test_obstacles);
    g_test_add_func("/scene/simulation/E23 plants shown apart keep what they have grown together",
                    test_apart);
    g_test_add_func("/scene/simulation/what cannot be seen gives no shade", test_clear);
    g_test_add_func("/scene/simulation/E04 nothing grows out of an envelope", test_envelope);
    g_test_add_func("/scene/simulation/L-systems and growing plants see each other", test_lsystem);
    return g_test_run();
}
