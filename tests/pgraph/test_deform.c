// FFD and Hyperpatch: meshes held against the maps they should have gone through.
#include "graphs.h"

#include "frond/skin.h"

#include <cglm/struct.h>
#include <math.h>

#define STEM                                                                                       \
    "tree stem length=2;radius=.1;number=9;branching-angle=60\nleaf leaf length=.4\nstem = leaf\n"
#define UNDER(attributes) "ffd ffd " attributes "\n" STEM "ffd - stem"
#define TWIST_X "x*cos(amount*z) - y*sin(amount*z)"
#define TWIST_Y "x*sin(amount*z) + y*cos(amount*z)"

static FrMesh *skin(const FrPlant *plant, FrPool *pool, FrDiags *diags) {
    FrSkinParams params = fr_skin_default();
    FrContext context = fr_context_default();
    context.pool = pool;
    context.diags = diags;
    FrMesh *mesh = NULL;
    FrStatus status = fr_skin_plant(plant, &params, FR_UP_Z, &context, &mesh);
    g_assert_cmpint(status, ==, FR_OK);
    for (uint64_t i = 0; i < mesh->vertex_count; i++) {
        const FrVertex *v = &mesh->vertices[i];
        float square = 0;
        for (int k = 0; k < 3; k++) {
            g_assert_true(isfinite(v->position[k]));
            square += v->normal[k] * v->normal[k];
        }
        g_assert_cmpfloat_with_epsilon(square, 1, 1e-3);
    }
    return mesh;
}

static FrMesh *skin_text(const char *text) {
    Built built = build(text);
    FrMesh *mesh = skin(built.plant, NULL, NULL);
    built_free(built);
    return mesh;
}

static void twist(double amount, const float from[3], double to[3]) {
    double angle = amount * (double)from[2];
    to[0] = (double)from[0] * cos(angle) - (double)from[1] * sin(angle);
    to[1] = (double)from[0] * sin(angle) + (double)from[1] * cos(angle);
    to[2] = (double)from[2];
}

static void assert_at(const float at[3], const double wanted[3], double tolerance) {
    for (int k = 0; k < 3; k++) {
        g_assert_cmpfloat_with_epsilon((double)at[k], wanted[k], tolerance);
    }
}

static void identity(void) {
    // A scope makes stems finer; after that, functions that move nothing move nothing.
    FrMesh *still = skin_text("hyperpatch ffd strength=0;box-to=1,1,2\n" STEM "ffd - stem");
    FrMesh *plain = skin_text(STEM);
    FrMesh *same = skin_text(UNDER(""));
    g_assert_cmpuint(same->vertex_count, >, plain->vertex_count);
    for (uint32_t k = 0; k < 3; k++) {
        // Leaves do not depend on how fine the stem is.
        g_assert_cmpfloat_with_epsilon(plain->parts[1].max[k], same->parts[1].max[k], 1e-5);
        g_assert_cmpfloat_with_epsilon(plain->parts[1].min[k], same->parts[1].min[k], 1e-5);
    }
    FrMesh *others[2];
    others[0] = skin_text("hyperpatch ffd degree-x=4;degree-y=1;degree-z=3\n" STEM "ffd - stem");
    others[1] = skin_text(UNDER("form=lattice;degree-z=4"));
    for (int m = 0; m < 2; m++) {
        g_assert_cmpuint(others[m]->vertex_count, ==, same->vertex_count);
        for (uint64_t i = 0; i < same->vertex_count; i++) {
            for (int k = 0; k < 3; k++) {
                g_assert_cmpfloat(others[m]->vertices[i].position[k], ==,
                                  same->vertices[i].position[k]);
            }
        }
        fr_mesh_free(others[m]);
    }
    fr_mesh_free(same);
    fr_mesh_free(plain);
    fr_mesh_free(still);
}

static void analytic_twist(void) {
    FrMesh *before = skin_text(UNDER(""));
    FrMesh *after = skin_text(UNDER("to-x=" TWIST_X ";to-y=" TWIST_Y ";amount=1.5"));
    g_assert_cmpuint(before->vertex_count, ==, after->vertex_count);
    for (uint64_t i = 0; i < before->vertex_count; i++) {
        const FrVertex *from = &before->vertices[i];
        double wanted[3];
        twist(1.5, from->position, wanted);
        assert_at(after->vertices[i].position, wanted, 2e-6);
        // The normal stays across what was along the surface: moved by the Jacobian.
        vec3s normal = {{from->normal[0], from->normal[1], from->normal[2]}};
        vec3s side = {{normal.y, normal.z, normal.x}};
        side = glms_vec3_cross(normal, side);
        float moved[3];
        double there[3], along = 0, size = 0;
        for (int k = 0; k < 3; k++) {
            moved[k] = from->position[k] + 1e-3F * side.raw[k];
        }
        twist(1.5, moved, there);
        for (int k = 0; k < 3; k++) {
            along += (there[k] - wanted[k]) * (double)after->vertices[i].normal[k];
            size += (there[k] - wanted[k]) * (there[k] - wanted[k]);
        }
        g_assert_cmpfloat(fabs(along), <=, 3e-3 * sqrt(size) + 1e-7);
    }
    fr_mesh_free(before);
    fr_mesh_free(after);
}

// The greatest relative difference between edges of leaves.
static double edge_change(const FrMesh *a, const FrMesh *b) {
    const FrMeshPart *part = &a->parts[a->part_count - 1];
    const FrMeshPart *other = &b->parts[b->part_count - 1];
    g_assert_true(part->is_foliage && other->is_foliage);
    g_assert_cmpuint(part->index_count, ==, other->index_count);
    double most = 0;
    for (uint64_t i = 0; i < part->index_count; i += 3) {
        double length[2];
        const FrMesh *meshes[2] = {a, b};
        const FrMeshPart *parts[2] = {part, other};
        for (int m = 0; m < 2; m++) {
            const FrMesh *mesh = meshes[m];
            const FrVertex *base = mesh->vertices + parts[m]->first_vertex;
            const float *p = base[mesh->indices[parts[m]->first_index + i]].position;
            const float *q = base[mesh->indices[parts[m]->first_index + i + 1]].position;
            length[m] = sqrt(pow((double)(p[0] - q[0]), 2) + pow((double)(p[1] - q[1]), 2) +
                             pow((double)(p[2] - q[2]), 2));
        }
        most = fmax(most, fabs(length[1] / length[0] - 1));
    }
    return most;
}

static void skeleton_only(void) {
    FrMesh *before = skin_text(UNDER(""));
    FrMesh *whole = skin_text(UNDER("to-x=x + .4*z^2"));
    FrMesh *skeleton = skin_text(UNDER("to-x=x + .4*z^2;moves=skeleton"));
    g_assert_cmpfloat(edge_change(before, whole), >, 0.1);
    g_assert_cmpfloat(edge_change(before, skeleton), <, 1e-3);
    // The stem's tip goes to the same place either way.
    g_assert_cmpfloat_with_epsilon(whole->parts[0].max[0], skeleton->parts[0].max[0], 0.03);
    g_assert_cmpfloat(skeleton->parts[0].max[0], >, 1.5F);
    fr_mesh_free(before);
    fr_mesh_free(whole);
    fr_mesh_free(skeleton);
}

static void moved_skeleton(void) {
    Built built = build(UNDER("to-x=x + .4*z^2;moves=skeleton"));
    FrPlant *moved = fr_plant_deformed(built.plant);
    assert_sound(moved);
    for (uint32_t i = 0; i < moved->nodes.count; i++) {
        vec3s from = built.plant->nodes.position[i], to = moved->nodes.position[i];
        g_assert_cmpfloat_with_epsilon(to.x, from.x + 0.4F * from.z * from.z, 1e-4);
        g_assert_cmpfloat_with_epsilon(to.z, from.z, 1e-4);
    }
    for (uint32_t o = 0; o < moved->organs.count; o++) {
        // Leaves stand on the moved stem: as far from the bearing internode as before.
        vec3s a = built.plant->organs.offset[o], b = moved->organs.offset[o];
        g_assert_cmpfloat_with_epsilon(hypotf(a.x, a.y), hypotf(b.x, b.y), 1e-5);
    }
    fr_plant_free(moved);
    built_free(built);
}

static void cut_off(void) {
    const char *text = "ffd bend to-x=x + .4*z^2\nffd stop preceding=no\n"
                       "tree stem length=2;radius=.1;number=9;branching-angle=60\n"
                       "leaf leaf length=.4\nbend - stem\nstem = stop\nstop - leaf";
    FrMesh *before = skin_text(UNDER(""));
    FrMesh *whole = skin_text(UNDER("to-x=x + .4*z^2"));
    FrMesh *cut = skin_text(text);
    g_assert_cmpuint(before->vertex_count, ==, cut->vertex_count);
    g_assert_cmpfloat(edge_change(before, cut), <, 1e-4);
    const FrMeshPart *part = &cut->parts[cut->part_count - 1];
    uint64_t step = part->vertex_count / 9;
    for (uint64_t leaf = 0; leaf < 9; leaf++) {
        // Needles that keep their form still begin where the bent twig bears them.
        const float *a = cut->vertices[part->first_vertex + leaf * step].position;
        const float *b = whole->vertices[part->first_vertex + leaf * step].position;
        for (int k = 0; k < 3; k++) {
            g_assert_cmpfloat_with_epsilon(a[k], b[k], 5e-3);
        }
    }
    fr_mesh_free(before);
    fr_mesh_free(whole);
    fr_mesh_free(cut);
}

static void control_points(void) {
    // One corner of a box is pulled; of a unit cube of Simple that fills it only that one moves.
    FrMesh *mesh = skin_text("hyperpatch patch degree-x=1;degree-y=1;degree-z=1;"
                             "points=1,1,1:.25,.5,.75\nsimple cube size=1\npatch - cube");
    uint32_t moved = 0;
    for (uint64_t i = 0; i < mesh->vertex_count; i++) {
        const float *at = mesh->vertices[i].position;
        bool is_corner = at[0] > 0.6F;
        if (is_corner) {
            assert_at(at, (double[3]){0.75, 1, 1.75}, 1e-6);
            moved++;
        } else {
            g_assert_cmpfloat_with_epsilon(fabsf(at[0]), 0.5, 1e-6);
            g_assert_cmpfloat_with_epsilon(fabsf(at[1]), 0.5, 1e-6);
        }
    }
    g_assert_cmpuint(moved, ==, 3);
    fr_mesh_free(mesh);
}

static void nested(void) {
    FrMesh *before = skin_text("ffd a\nffd b\n" STEM "a - b\nb - stem");
    FrMesh *after = skin_text("ffd a to-x=x + .4*z^2\nffd b to-x=" TWIST_X ";to-y=" TWIST_Y
                              "\n" STEM "a - b\nb - stem");
    for (uint64_t i = 0; i < before->vertex_count; i++) {
        double wanted[3];
        twist(1, before->vertices[i].position, wanted); // the inner one first
        wanted[0] += 0.4 * wanted[2] * wanted[2];
        assert_at(after->vertices[i].position, wanted, 3e-6);
    }
    fr_mesh_free(before);
    fr_mesh_free(after);
}

static void separate(void) {
    // What is not below it is not deformed; strength goes part of the way.
    Built built = build("camera root\nffd ffd to-x=x+1;strength=.5\nsimple a size=.2\n"
                        "simple b size=.2\nroot - ffd\nffd - a\nroot - b");
    FrMesh *mesh = skin(built.plant, NULL, NULL);
    float most = -1;
    uint32_t still = 0;
    for (uint64_t i = 0; i < mesh->vertex_count; i++) {
        most = fmaxf(most, mesh->vertices[i].position[0]);
        still += fabsf(mesh->vertices[i].position[0]) < 0.11F;
    }
    g_assert_cmpfloat_with_epsilon(most, 0.6, 1e-6);
    g_assert_cmpuint(still * 2, ==, mesh->vertex_count);
    fr_mesh_free(mesh);
    built_free(built);
}

static void own_place(void) {
    // A deformation has the coordinates of where it stands, and its size.
    FrMesh *mesh = skin_text("ffd ffd to-z=z + 1;translate-z=3;rotate-x=-90;scale=2\n"
                             "simple a size=.1\nffd - a");
    // Its z axis looks along the plant's y; a unit is two metres.
    g_assert_cmpfloat_with_epsilon(mesh->parts[0].min[1], 2.0, 1e-5);
    g_assert_cmpfloat_with_epsilon(mesh->parts[0].max[1], 2.2, 1e-5);
    g_assert_cmpfloat_with_epsilon(mesh->parts[0].max[2], 3.1, 1e-5);
    fr_mesh_free(mesh);
}

static bool warns(FrDiags *diags, const char *code) {
    for (size_t k = 0; k < fr_diags_count(diags); k++) {
        if (strcmp(fr_diags_get(diags, k)->code, code) == 0) {
            return true;
        }
    }
    return false;
}

static void flattened(void) {
    Built built = build(UNDER("to-z=0"));
    FrDiags *diags = fr_diags_new();
    FrMesh *mesh = skin(built.plant, NULL, diags);
    g_assert_true(warns(diags, "singular-deformation"));
    g_assert_cmpuint(fr_diags_error_count(diags), ==, 0);
    fr_mesh_free(mesh);
    fr_diags_free(diags);
    built_free(built);
    built = build(UNDER("to-x=x/(y-y)"));
    diags = fr_diags_new();
    mesh = skin(built.plant, NULL, diags);
    g_assert_true(warns(diags, "division-by-zero"));
    fr_mesh_free(mesh);
    fr_diags_free(diags);
    built_free(built);
}

static void mirrored(void) {
    // Turned inside out, triangles still face outwards.
    FrMesh *mesh = skin_text("ffd ffd to-x=-x\nsimple cube size=1\nffd - cube");
    double volume = 0;
    for (uint64_t i = 0; i < mesh->index_count; i += 3) {
        vec3s c[3];
        for (int k = 0; k < 3; k++) {
            const float *at = mesh->vertices[mesh->indices[i + (uint64_t)k]].position;
            c[k] = (vec3s){{at[0], at[1], at[2]}};
        }
        volume += (double)glms_vec3_dot(c[0], glms_vec3_cross(c[1], c[2])) / 6;
    }
    g_assert_cmpfloat_with_epsilon(volume, 1, 1e-5);
    fr_mesh_free(mesh);
}

static void digests(void) {
    Built a = build(UNDER("amount=1")), b = build(UNDER("amount=2")), c = build(UNDER("to-x=x+0"));
    g_assert_cmpuint(fr_plant_digest(a.plant), !=, fr_plant_digest(b.plant));
    g_assert_cmpuint(fr_plant_digest(a.plant), !=, fr_plant_digest(c.plant));
    FrPlant *copy = fr_plant_copy(b.plant);
    g_assert_cmpuint(fr_plant_digest(copy), ==, fr_plant_digest(b.plant));
    fr_plant_free(copy);
    built_free(a);
    built_free(b);
    built_free(c);
}

static void threads(void) {
    const char *text = "ffd whole to-x=x + .1*z^2;moves=skeleton\n"
                       "tree stem length=2;number=40;branching-angle=60\n"
                       "ffd part to-y=y + amount*z^2;amount=1 ~ 2\n"
                       "tree twig length=.5;radius=.01;number=12\nleaf leaf\n"
                       "whole - stem\nstem = part\npart - twig\ntwig = leaf";
    FrDigest plant = 0, mesh_digest = 0;
    for (int count = 1; count <= 8; count += count < 3 ? 1 : 5) {
        FrPool *pool = fr_pool_new(count);
        Built built = build_graph(graph_read(text), pool);
        g_assert_cmpint(built.status, ==, FR_OK);
        FrMesh *mesh = skin(built.plant, pool, NULL);
        if (count > 1) {
            g_assert_cmpuint(plant, ==, fr_plant_digest(built.plant));
            g_assert_cmpuint(mesh_digest, ==, fr_mesh_digest(mesh));
        }
        plant = fr_plant_digest(built.plant);
        mesh_digest = fr_mesh_digest(mesh);
        g_assert_cmpuint(built.plant->deformers->len, ==, 41);
        fr_mesh_free(mesh);
        built_free(built);
        fr_pool_free(pool);
    }
}

static void extremes(void) {
    // Whatever functions give, everything stays finite; flat and inside out are no crash.
    static const char *const kinds[] = {"triangles", "skeleton"};
    static const char *const maps[] = {"to-x=1e300*x;to-y=-1e300*y", "to-x=x^9;to-z=0",
                                       "to-x=0;to-y=0;to-z=0", "to-x=exp(1000*z)",
                                       "strength=-10;to-z=1e12*z;scale=.000001"};
    for (size_t m = 0; m < G_N_ELEMENTS(maps); m++) {
        for (int k = 0; k < 2; k++) {
            char *text = g_strdup_printf("ffd a depth=20;moves=%s;%s\n"
                                         "ffd b moves=%s;preceding=no;to-x=1e9*x\n" STEM
                                         "a - a\na . b\nb - stem",
                                         kinds[k], maps[m], kinds[1 - k]);
            Built built = build(text);
            fr_mesh_free(skin(built.plant, NULL, NULL));
            FrPlant *moved = fr_plant_deformed(built.plant);
            assert_sound(moved);
            fr_plant_free(moved);
            built_free(built);
            g_free(text);
        }
    }
}

static void no_part_of_paths(void) {
    // Put in or taken out, a deformation leaves all random numbers below as they were.
    const char *parts = "tree stem number=9;gnarl=20\nhorn twig length=.2 ~ .1;gnarl=30\n"
                        "ffd ffd strength=1 ~ 1\n";
    char *with = g_strconcat(parts, "stem = ffd\nffd - twig", NULL);
    char *without = g_strconcat(parts, "stem = twig", NULL);
    Built a = build(with), b = build(without);
    g_assert_cmpuint(a.plant->axes.count, ==, 10);
    for (uint32_t k = 0; k < 10; k++) {
        g_assert_cmpuint(a.plant->axes.path[k], ==, b.plant->axes.path[k]);
    }
    g_free(with);
    g_free(without);
    built_free(a);
    built_free(b);
}

static void too_deep(void) {
    Built built = build_graph(graph_read("ffd a depth=65\na - a"), NULL);
    g_assert_cmpint(built.status, ==, FR_ERR_LIMIT);
    g_assert_true(built_has(&built, "limit-scopes"));
    built_free(built);
    built = build_graph(graph_read("ffd a depth=500;preceding=no\na - a"), NULL);
    g_assert_cmpint(built.status, ==, FR_OK);
    built_free(built);
}

static void wrong_texts(void) {
    static const char *const texts[] = {
        "hyperpatch p points=3,0,0:0,0,0",   "hyperpatch p points=0,0,0:0,0",
        "hyperpatch p points=0,0,0",         "hyperpatch p points=-1,0,0:1,1,1",
        "hyperpatch p points=0,0,0:1,1,1x",  "hyperpatch p points=0,0,0:nan,1,1",
        "ffd p box-from=0,0,0;box-to=1,0,1",
    };
    for (size_t k = 0; k < G_N_ELEMENTS(texts); k++) {
        Built built = build_graph(graph_read(texts[k]), NULL);
        g_assert_cmpint(built.status, ==, FR_ERR_DOCUMENT);
        built_free(built);
    }
    // Functions see the point and the amount, nothing else.
    static const char *const wrong[] = {"x + t", "x + rand()", "x + q", "x +"};
    FrPgraph *graph = graph_read("ffd p");
    const FrParamTable *table = fr_pgraph_table(FR_COMPONENT_FFD);
    for (size_t k = 0; k < G_N_ELEMENTS(wrong); k++) {
        FrStatus status =
            fr_params_set(table, fr_pgraph_params(graph, 0), fr_params_find(table, "to-x"),
                          wrong[k], (FrSpan){0}, NULL, NULL);
        g_assert_cmpint(status, ==, FR_ERR_DOCUMENT);
    }
    fr_pgraph_free(graph);
}

// Where a preset takes the point of a small box that stands on it, in metres.
static void preset(const char *attributes, double x, double y, double z, const double wanted[3]) {
    char *text = g_strdup_printf("ffd ffd preset=%s;moves=skeleton;box-to=.5,.5,2\n"
                                 "simple S size=.001;translate-x=%g;translate-y=%g;translate-z=%g\n"
                                 "ffd - S",
                                 attributes, x, y, z);
    FrMesh *mesh = skin_text(text);
    double middle[3] = {0, 0, 0};
    for (uint64_t i = 0; i < mesh->vertex_count; i++) {
        for (int k = 0; k < 3; k++) {
            middle[k] += (double)mesh->vertices[i].position[k] / (double)mesh->vertex_count;
        }
    }
    for (int k = 0; k < 3; k++) {
        g_assert_cmpfloat_with_epsilon(middle[k], wanted[k], 2e-3);
    }
    fr_mesh_free(mesh);
    g_free(text);
}

static void presets(void) {
    // Over a box of 2 m. Bent by a quarter turn its axis is a quarter circle as long as it was.
    double radius = 2 / (G_PI / 2);
    preset("bend", 0, 0, 2, (const double[]){0, radius, radius});
    preset("bend", 0.1, 0, 3, (const double[]){0.1, radius + 1, radius}); // straight on
    preset("bend;amount=0", 0.1, 0.2, 1.5, (const double[]){0.1, 0.2, 1.5});
    preset("twist", 0.3, 0, 2, (const double[]){0, 0.3, 2});
    preset("taper;amount=.5", 0.4, 0, 2, (const double[]){0.2, 0, 2});
    preset("bulge", 0.2, 0, 1, (const double[]){0.4, 0, 1});
    preset("flare", 0.2, 0, 0, (const double[]){0.4, 0, 0});
    preset("flare", 0.2, 0, 2, (const double[]){0.2, 0, 2});
    preset("shear;amount=.5", 0, 0, 1, (const double[]){0, 0.5, 1});
    preset("stretch;amount=3", 0.2, 0, 1, (const double[]){0.1, 0, 4});
    preset("wave", 0, 0, 0.5, (const double[]){0, 0.2, 0.5});
    preset("spiral", 0, 0, 1, (const double[]){-0.4, 0, 1});
    preset("spherify", 0.1, 0, 1, (const double[]){1, 0, 1});
    // A line that leads aside: by arc length, and straight on beyond its end.
    preset("curve;path=0,0,0 0,0,1 0,0,2", 0.1, 0.2, 1.5, (const double[]){0.1, 0.2, 1.5});
    preset("curve;path=0,0,0 1,0,0 4,0,0", 0, 0, 3, (const double[]){3, 0, 0});
    preset("curve;path=0,0,0 1,0,0 4,0,0", 0, 0, 6, (const double[]){6, 0, 0});
    preset("curve;path=0,0,0 1,0,0 4,0,0", 0.1, 0.2, 2, (const double[]){2, 0.2, -0.1});
    preset("curve;path=0,0,0 1,0,0 4,0,0;amount=.5", 0, 0, 2, (const double[]){1, 0, 1});
    // Ruffled by noise, which is nothing at whole numbers of sevenths of the height.
    preset("ruffle;amount=0", 0.1, 0.3, 1, (const double[]){0.1, 0.3, 1});
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/pgraph/deform/C28 C29 functions and lattices that move nothing", identity);
    g_test_add_func("/pgraph/deform/C28 a twist is the analytic one, normals too", analytic_twist);
    g_test_add_func("/pgraph/deform/C30 leaves keep their form if only the skeleton moves",
                    skeleton_only);
    g_test_add_func("/pgraph/deform/nodes go where the functions take them", moved_skeleton);
    g_test_add_func("/pgraph/deform/C31 what is cut off is carried, not deformed", cut_off);
    g_test_add_func("/pgraph/deform/C32 a control point pulls its corner", control_points);
    g_test_add_func("/pgraph/deform/C33 the inner deformation comes first", nested);
    g_test_add_func("/pgraph/deform/C33 what is not below is not deformed", separate);
    g_test_add_func("/pgraph/deform/a deformation has the place and size it is given", own_place);
    g_test_add_func("/pgraph/deform/flattening and faults are warnings", flattened);
    g_test_add_func("/pgraph/deform/a mirror keeps the outside outside", mirrored);
    g_test_add_func("/pgraph/deform/the digest knows deformations", digests);
    g_test_add_func("/pgraph/deform/any number of threads deforms alike", threads);
    g_test_add_func("/pgraph/deform/extreme functions leave everything finite", extremes);
    g_test_add_func("/pgraph/deform/a deformation is no part of paths", no_part_of_paths);
    g_test_add_func("/pgraph/deform/presets move points as they say", presets);
    g_test_add_func("/pgraph/deform/too many scopes in one another are refused", too_deep);
    g_test_add_func("/pgraph/deform/wrong points, boxes and functions are errors", wrong_texts);
    return g_test_run();
}
