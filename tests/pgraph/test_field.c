// World and Force: stems held against the lines that fields should lead them along.
#include "graphs.h"

#include "frond/skin.h"

#include <cglm/struct.h>
#include <math.h>

#define DEGREES (180 / G_PI)

// The angle between the direction at the tip of a stem and the vertical.
static double tip_angle(const Built *built) {
    vec3s at;
    versors rotation;
    fr_plant_organ_pose(built->plant, built_organ(built, "tip"), &at, &rotation);
    vec3s heading = fr_frame_heading(rotation);
    return atan2(hypot((double)heading.x, (double)heading.y), (double)heading.z) * DEGREES;
}

static void published_vector(void) {
    // The same light, given as a field: α₀ e^−κ for any number of segments.
    for (int segments = 4; segments <= 256; segments *= 4) {
        char *text = g_strdup_printf("world w\nhorn stem rotate-x=100;phototropism=1.2;"
                                     "segments=%d\nsimple tip size=.01\nw - stem\nstem - tip",
                                     segments);
        Built built = build(text);
        g_assert_cmpfloat_with_epsilon(tip_angle(&built), 30.119421, 2e-3);
        built_free(built);
        g_free(text);
    }
}

static void as_plain(void) {
    // A World of plain gravity and light is no change, but for how the turn is computed.
    const char *stem = "horn stem length=2;rotate-x=70;gravitropism=.8;phototropism=.5;"
                       "plagiotropism=.4;curvature=30;segments=40\n";
    char *with = g_strconcat("world w\n", stem, "w - stem", NULL);
    Built plain = build(stem), world = build(with);
    for (uint32_t k = 0; k < 40; k++) {
        for (int d = 0; d < 3; d++) {
            g_assert_cmpfloat_with_epsilon(plain.plant->nodes.position[k].raw[d],
                                           world.plant->nodes.position[k].raw[d], 1e-4);
        }
    }
    g_free(with);
    built_free(plain);
    built_free(world);
}

// How far nodes from the last two thirds of the stem are from where they should be, in mean.
static double mean_miss(const FrPlant *plant, double radius) {
    double sum = 0;
    uint32_t first = plant->nodes.count / 3;
    for (uint32_t k = first; k < plant->nodes.count; k++) {
        vec3s at = plant->nodes.position[k];
        sum += fabs(hypot((double)at.x, (double)at.y) - radius);
    }
    return sum / (plant->nodes.count - first);
}

static void assert_helix(const FrPlant *plant, double radius, double pitch) {
    g_assert_cmpfloat(mean_miss(plant, radius), <, 0.1 * radius);
    uint32_t first = plant->nodes.count / 3, last = plant->nodes.count - 1;
    double azimuth = 0;
    for (uint32_t k = first; k < last; k++) {
        vec3s a = plant->nodes.position[k], b = plant->nodes.position[k + 1];
        double turn = atan2((double)(a.x * b.y - a.y * b.x), (double)(a.x * b.x + a.y * b.y));
        g_assert_cmpfloat(turn, >, 0); // always the same way round
        azimuth += turn;
    }
    double rise = (double)(plant->nodes.position[last].z - plant->nodes.position[first].z);
    g_assert_cmpfloat_with_epsilon(rise / (azimuth * radius), tan(pitch), 0.1);
    g_assert_cmpfloat(azimuth, >, 4 * G_PI);
}

static void vortex(void) {
    Built built = build("force f kind=vortex;radius=.3;pitch=30;strength=30;reach=.1\n"
                        "horn stem length=8;radius=.01;translate-x=.3\nf - stem");
    assert_helix(built.plant, 0.3, 30 / DEGREES);
    built_free(built);
}

static void world_vortex(void) {
    // Gravity that goes round, up, and back to a distance of 0.3 m.
    Built built =
        build("world w gravity-x=40*(-y + 4*x*(.3 - sqrt(x^2 + y^2)));"
              "gravity-y=40*(x + 4*y*(.3 - sqrt(x^2 + y^2)));gravity-z=12*tan(pi/6);step=.05\n"
              "horn stem length=8;radius=.01;translate-x=.3;gravitropism=20\nw - stem");
    assert_helix(built.plant, 0.3, 30 / DEGREES);
    built_free(built);
}

static void segments_do_not_matter(void) {
    vec3s tips[3];
    for (int k = 0; k < 3; k++) {
        char *text = g_strdup_printf("force f kind=vortex;radius=.3;pitch=30;strength=12\n"
                                     "horn stem length=2;segments=%d;translate-x=.3\nf - stem",
                                     32 << k);
        Built built = build(text);
        tips[k] = built.plant->nodes.position[built.plant->nodes.count - 1];
        built_free(built);
        g_free(text);
    }
    g_assert_cmpfloat(glms_vec3_distance(tips[0], tips[2]), <, 0.03F);
    g_assert_cmpfloat(glms_vec3_distance(tips[1], tips[2]), <, 0.01F);
}

static void around_a_stick(void) {
    // From half a metre away a stem comes to a stick of 4 cm and grows up along it.
    Built built = build("force f kind=line;radius=.04;strength=25;reach=.25\n"
                        "horn stem length=4;radius=.008;translate-x=.5;rotate-y=-40\nf - stem");
    g_assert_cmpfloat(mean_miss(built.plant, 0.04), <, 0.01);
    uint32_t last = built.plant->nodes.count - 1;
    g_assert_cmpfloat(built.plant->nodes.position[last].z, >, 3);
    built_free(built);
}

static void behind_the_wall(void) {
    // Wind presses a stem against a wall across y: along it, never through it.
    Built built = build("force wall kind=plane;action=align;strength=0;solid=yes;rotate-x=90\n"
                        "force wind kind=direction;direction=.2,0,-1;strength=4;step=.04\n"
                        "horn stem length=3;radius=.04;translate-z=.5;rotate-x=-90;gnarl=30\n"
                        "wall - wind\nwind - stem");
    FrSkinParams params = fr_skin_default();
    FrContext context = fr_context_default();
    FrMesh *mesh;
    FrStatus status = fr_skin_plant(built.plant, &params, FR_UP_Z, &context, &mesh);
    g_assert_cmpint(status, ==, FR_OK);
    float nearest = 1;
    for (uint64_t i = 0; i < mesh->vertex_count; i++) {
        // The wall's front looks along −y.
        g_assert_cmpfloat(-mesh->vertices[i].position[1], >=, -1e-4F);
        nearest = fminf(nearest, -mesh->vertices[i].position[1]);
    }
    g_assert_cmpfloat(nearest, <, 0.02F); // it has reached the wall
    fr_mesh_free(mesh);
    built_free(built);
}

// The digest of a tree in the wind; `force` are attributes of it, `trunk` and `twig` of its stems.
static FrDigest in_wind(const char *force, const char *trunk, const char *twig) {
    char *text = g_strdup_printf(
        "force wind kind=direction;direction=1,0,0;strength=2;%s\n"
        "tree trunk length=2;number=6;%s\nhorn top length=.4;%s\nhorn twig length=.6;%s\n"
        "wind - trunk\ntrunk - top\ntrunk = twig",
        force, trunk, trunk, twig);
    Built built = build(text);
    FrDigest digest = fr_plant_digest(built.plant);
    built_free(built);
    g_free(text);
    return digest;
}

static void apply_to(void) {
    // As if the other stems did not heed it.
    FrDigest self = in_wind("apply-to=self", "", ""), both = in_wind("apply-to=both", "", "");
    FrDigest children = in_wind("apply-to=children", "", "");
    g_assert_true(both == in_wind("", "", ""));
    g_assert_true(self == in_wind("", "", "force-weight=0"));
    g_assert_true(children == in_wind("", "force-weight=0", ""));
    g_assert_true(self != both && children != both && self != children);
}

static void prunes_children(void) {
    // A hedge that only branches are cut to: the trunk stands out of it, no branch does.
    Built built = build("force hedge kind=box;size=.6,.6,1;inverted=yes;solid=prune;strength=0;"
                        "apply-to=children\n"
                        "tree trunk length=2;number=12;end=.45\nhorn twig length=1;radius=.004\n"
                        "hedge - trunk\ntrunk = twig");
    const FrPlant *plant = built.plant;
    float top = 0, side = 0;
    for (uint32_t k = 0; k < plant->nodes.count; k++) {
        vec3s at = plant->nodes.position[k];
        bool is_trunk = plant->axes.order[plant->nodes.axis[k]] == 0;
        top = is_trunk ? fmaxf(top, at.z) : top;
        side = is_trunk ? side : fmaxf(side, fmaxf(fabsf(at.x), fabsf(at.y)));
    }
    g_assert_cmpfloat_with_epsilon(top, 2, 1e-4F);
    g_assert_cmpfloat(side, >, 0.25F);
    g_assert_cmpfloat(side, <, 0.302F);
    built_free(built);
}

static void solid_ball(void) {
    Built built = build("force ball kind=point;action=pull;strength=20;radius=.3;solid=yes\n"
                        "horn stem length=3;radius=.01;translate-z=-1\nball - stem");
    for (uint32_t k = 0; k < built.plant->nodes.count; k++) {
        g_assert_cmpfloat(glms_vec3_norm(built.plant->nodes.position[k]), >=, 0.3F);
    }
    built_free(built);
}

static void curve(void) {
    Built built = build("force f kind=curve;path=0,0,0 0,0,1 1,0,1 1,0,2;strength=40;reach=.1\n"
                        "horn stem length=2.9;radius=.01\nf - stem");
    vec3s tip = built.plant->nodes.position[built.plant->nodes.count - 1];
    g_assert_cmpfloat_with_epsilon(tip.x, 1, 0.1);
    g_assert_cmpfloat(tip.z, >, 1.7F);
    built_free(built);
    built = build_graph(graph_read("force f kind=curve;path=0,0"), NULL);
    g_assert_cmpint(built.status, ==, FR_ERR_DOCUMENT);
    built_free(built);
}

static void leaves_see_the_field(void) {
    Built built = build("world w light-x=1;light-z=0\nleaf leaf phototropism=1;rotate-x=50\n"
                        "w - leaf");
    vec3s up = fr_frame_up(built.plant->organs.rotation[0]);
    g_assert_cmpfloat_with_epsilon(up.x, 1, 1e-5);
    built_free(built);
    built = build("world w gravity-y=-2;gravity-z=0\nleaf leaf gravitropism=1\nw - leaf");
    vec3s heading = fr_frame_heading(built.plant->organs.rotation[0]);
    g_assert_cmpfloat_with_epsilon(heading.y, -1, 1e-5);
    built_free(built);
}

static void extremes(void) {
    static const char *const texts[] = {
        "world w gravity-x=1e300*x;gravity-z=exp(900);light-x=0;light-z=0",
        "force w kind=point;strength=10000;radius=10000;reach=.00001;solid=yes",
        "force w kind=vortex;strength=-10000;scale=.000001;solid=yes;radius=100",
        "force w kind=plane;strength=10000;scale=1000000;radius=5;solid=yes",
        "force w kind=curve;path=0,0,0 0,0,0;strength=5",
        "force w kind=direction;direction=0,0,0;falloff=gauss;range=.00001",
    };
    for (size_t k = 0; k < G_N_ELEMENTS(texts); k++) {
        char *text = g_strdup_printf("%s\nhorn stem length=1000;gravitropism=20;phototropism=-20\n"
                                     "leaf leaf phototropism=1;gravitropism=1\n"
                                     "w - stem\nstem - leaf",
                                     texts[k]);
        Built built = build(text);
        for (uint32_t i = 0; i < built.plant->nodes.count; i++) {
            g_assert_true(isfinite(glms_vec3_norm(built.plant->nodes.position[i])));
        }
        built_free(built);
        g_free(text);
    }
}

static void faults(void) {
    Built built = build("world w gravity-x=1/(x - x)\nhorn stem gravitropism=1\nw - stem");
    g_assert_true(built_has(&built, "division-by-zero"));
    built_free(built);
}

static void threads(void) {
    FrDigest digest = 0;
    for (int count = 1; count <= 8; count += count < 3 ? 1 : 5) {
        FrPool *pool = fr_pool_new(count);
        Built built =
            build_graph(graph_read("force f kind=vortex;radius=.3;strength=5 ~ 2\n"
                                   "world w light-x=sin(z)\ntree stem length=2;number=300\n"
                                   "horn twig length=.3;phototropism=1 ~ 1\n"
                                   "f - w\nw - stem\nstem = twig"),
                        pool);
        g_assert_cmpint(built.status, ==, FR_OK);
        g_assert_true(digest == 0 || digest == fr_plant_digest(built.plant));
        digest = fr_plant_digest(built.plant);
        built_free(built);
        fr_pool_free(pool);
    }
}

static void sun(void) {
    // A stem that the light draws for long looks into the sun: azimuth from y over x, elevation.
    Built built = build("world w sun=yes;sun-azimuth=120;sun-elevation=35;light-x=1\n"
                        "horn stem phototropism=20\nsimple tip size=.01\nw - stem\nstem - tip");
    vec3s at;
    versors rotation;
    fr_plant_organ_pose(built.plant, built_organ(&built, "tip"), &at, &rotation);
    vec3s heading = fr_frame_heading(rotation);
    double level = cos(35 / DEGREES);
    g_assert_cmpfloat_with_epsilon((double)heading.x, level * sin(120 / DEGREES), 1e-4);
    g_assert_cmpfloat_with_epsilon((double)heading.y, level * cos(120 / DEGREES), 1e-4);
    g_assert_cmpfloat_with_epsilon((double)heading.z, sin(35 / DEGREES), 1e-4);
    built_free(built);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/pgraph/field/light as a field turns stems as the formula says",
                    published_vector);
    g_test_add_func("/pgraph/field/a world of plain gravity and light is no change", as_plain);
    g_test_add_func("/pgraph/field/C34 a vortex makes a helix", vortex);
    g_test_add_func("/pgraph/field/C34 so does gravity that goes round", world_vortex);
    g_test_add_func("/pgraph/field/internodes do not matter in fields", segments_do_not_matter);
    g_test_add_func("/pgraph/field/C34 a world's sun draws stems to it", sun);
    g_test_add_func("/pgraph/field/C35 a stem finds a stick and keeps to it", around_a_stick);
    g_test_add_func("/pgraph/field/C36 nothing grows behind a wall", behind_the_wall);
    g_test_add_func("/pgraph/field/apply-to says which stems a force turns", apply_to);
    g_test_add_func("/pgraph/field/apply-to says which stems a force cuts", prunes_children);
    g_test_add_func("/pgraph/field/nothing grows into a ball", solid_ball);
    g_test_add_func("/pgraph/field/a stem follows a curve", curve);
    g_test_add_func("/pgraph/field/leaves turn in fields", leaves_see_the_field);
    g_test_add_func("/pgraph/field/extreme fields leave everything finite", extremes);
    g_test_add_func("/pgraph/field/formulas without value are warnings", faults);
    g_test_add_func("/pgraph/field/any number of threads grows alike", threads);
    return g_test_run();
}
