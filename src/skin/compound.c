// Compound leaves: a rachis and leaflets, each a blade put where it stands; and a mesh of them.
//
// A stalk runs in the plane of y and z: first the petiole, then the rachis, each bent evenly. At
// each place on it stand two leaflets (or two pinnae, stalks of their own), turned to both sides
// about the stalk's upper side.
#include "skin/compound.h"

#include "skin/shape.h"

#include <cglm/struct.h>

#include <math.h>
#include <string.h>

enum { STRIP_FROM = 1, STALK_GONE = 3 };

// Pinnae and leaflets turn ever more to the tip.
#define LESS_ASIDE 0.3
// A petiole of a leaflet is so much thinner than that of the leaf.
#define THINNER 0.55F

float fr_stalk_length(const FrStalk *stalk) {
    return stalk->petiole + stalk->rachis;
}

float fr_stalk_radius(const FrStalk *stalk, float part) {
    return stalk->radius * (1.0F - 0.6F * part);
}

static FrStalk stalk_of(float petiole, float petiole_bend, float rachis, float turn, float radius) {
    FrStalk stalk = {.petiole = petiole, .rachis = rachis, .radius = radius};
    float step = fr_stalk_length(&stalk) / FR_STALK_PIECES;
    for (int i = 0; i < FR_STALK_PIECES; i++) {
        float from = step * (float)i;
        float on_petiole = fminf(fmaxf(petiole - from, 0.0F), step);
        float turned = petiole > 0.0F ? petiole_bend * on_petiole / petiole : 0.0F;
        turned += rachis > 0.0F ? turn * (step - on_petiole) / rachis : 0.0F;
        float middle = stalk.angle[i] + 0.5F * turned;
        stalk.angle[i + 1] = stalk.angle[i] + turned;
        stalk.at[i + 1] =
            glms_vec3_add(stalk.at[i], (vec3s){{0, step * sinf(middle), step * cosf(middle)}});
    }
    return stalk;
}

FrStalkPlace fr_stalk_place(const FrStalk *stalk, float way) {
    float fine =
        fr_stalk_length(stalk) > 0.0F ? way / fr_stalk_length(stalk) * FR_STALK_PIECES : 0.0F;
    int low = MIN((int)fine, FR_STALK_PIECES - 1);
    float part = fine - (float)low;
    float angle = stalk->angle[low] + part * (stalk->angle[low + 1] - stalk->angle[low]);
    return (FrStalkPlace){
        .at = glms_vec3_lerp(stalk->at[low], stalk->at[low + 1], part),
        .x = {{1, 0, 0}},
        .y = {{0, cosf(angle), -sinf(angle)}},
        .z = {{0, sinf(angle), cosf(angle)}},
    };
}

// Turned by `angle` about its upper side, to the left for positive ones.
static FrStalkPlace turned(FrStalkPlace place, float angle) {
    vec3s z = glms_vec3_scale(place.z, cosf(angle)), x = glms_vec3_scale(place.x, cosf(angle));
    return (FrStalkPlace){place.at, glms_vec3_muladds(place.z, -sinf(angle), x), place.y,
                          glms_vec3_muladds(place.x, sinf(angle), z)};
}

vec3s fr_stalk_vector(const FrStalkPlace *place, const float v[3]) {
    vec3s sum = glms_vec3_scale(place->x, v[0]);
    sum = glms_vec3_muladds(place->y, v[1], sum);
    return glms_vec3_muladds(place->z, v[2], sum);
}

// ---- leaflets ----------------------------------------------------------------------------------

typedef struct Compound {
    const FrCompoundMaker *maker;
    const FrPlant *plant;
    const FrBlade *blade;
    FrBlade leaflet;
    uint32_t pairs;
} Compound;

// Their size at a part of the rachis, by the curve.
static float size_at(const Compound *compound, float part) {
    uint32_t curve = compound->blade->leaflet_curve;
    const FrProfile *profile = curve > 0 && curve <= compound->plant->profiles->len
                                   ? &g_array_index(compound->plant->profiles, FrProfile, curve - 1)
                                   : NULL;
    if (profile == NULL || profile->count == 0) {
        return 1.0F;
    }
    float fine = part * (float)(profile->count - 1);
    uint32_t low = MIN((uint32_t)fine, profile->count > 1 ? profile->count - 2 : 0);
    double a = profile->points[low][1];
    double b = profile->points[MIN(low + 1, profile->count - 1)][1];
    double size = a + (double)(fine - (float)low) * (b - a);
    return isfinite(size) ? (float)fmin(fmax(size, 0.0), 100.0) : 0.0F;
}

static void lay_leaflet(const Compound *compound, FrStalkPlace place, float angle, float size) {
    const FrCompoundMaker *maker = compound->maker;
    uint32_t first = maker->count(maker->user);
    if (size > 1e-3F) {
        place = turned(place, angle);
        maker->leaflet(maker->user, &compound->leaflet);
        maker->put(maker->user, first, &place, size);
    }
}

// Calls for both sides of each pair, and for the end.
static void lay_pinnate(const Compound *compound, const FrStalk *stalk, uint32_t pairs,
                        bool is_outer) {
    const FrBlade *blade = compound->blade;
    bool has_end = blade->is_terminal != 0;
    for (uint32_t k = 0; k < 2 * pairs + (has_end ? 1U : 0U); k++) {
        bool is_end = k == 2 * pairs;
        float spaces = (float)pairs - (has_end ? 0.0F : 1.0F);
        float part = is_end || !(spaces > 0.0F) ? 1.0F : (float)(k / 2) / spaces;
        FrStalkPlace place = fr_stalk_place(stalk, stalk->petiole + part * stalk->rachis);
        float angle = blade->leaflet_angle * (1.0F - (float)LESS_ASIDE * part);
        angle = is_end ? 0.0F : k % 2 == 0 ? angle : -angle;
        float size = size_at(compound, part);
        if (!is_outer) {
            lay_leaflet(compound, place, angle, size);
            continue;
        }
        // A pinna: a smaller pinnate leaf.
        const FrCompoundMaker *maker = compound->maker;
        uint32_t first = maker->count(maker->user);
        float length = 0.5F * blade->rachis_length;
        FrStalk pinna = stalk_of(blade->leaflet_petiole * 2.0F, 0.0F, length,
                                 0.5F * blade->rachis_curvature, THINNER * blade->petiole_radius);
        maker->stalk(maker->user, &pinna);
        Compound inner = *compound;
        FrBlade even = *blade;
        even.leaflet_curve = 0;
        inner.blade = &even;
        lay_pinnate(&inner, &pinna, compound->pairs, false);
        place = turned(place, angle);
        maker->put(maker->user, first, &place, size);
    }
}

static void lay_palmate(const Compound *compound, const FrStalk *stalk, uint32_t leaflets) {
    FrStalkPlace end = fr_stalk_place(stalk, stalk->petiole);
    for (uint32_t k = 0; k < leaflets; k++) {
        float aside = leaflets > 1 ? 2.0F * (float)k / (float)(leaflets - 1) - 1.0F : 0.0F;
        float size = compound->blade->leaflet_curve > 0 ? size_at(compound, fabsf(aside))
                                                        : 1.0F - 0.4F * aside * aside;
        lay_leaflet(compound, end, aside * compound->blade->leaflet_angle, size);
    }
}

uint64_t fr_compound_leaflets(const FrBlade *blade) {
    uint64_t of_stalk = 2 * (uint64_t)blade->leaflets + 1;
    uint64_t pinnae = 2 * (uint64_t)blade->pinnae + 1;
    return blade->compound == FR_COMPOUND_SIMPLE      ? 1
           : blade->compound == FR_COMPOUND_BIPINNATE ? pinnae * of_stalk
                                                      : of_stalk;
}

void fr_compound_make(const FrCompoundMaker *maker, const FrPlant *plant, const FrBlade *blade,
                      uint32_t pairs, uint32_t pinnae) {
    bool is_palmate = blade->compound == FR_COMPOUND_PALMATE;
    Compound compound = {maker, plant, blade, *blade, pairs};
    FrBlade *leaflet = &compound.leaflet;
    leaflet->compound = FR_COMPOUND_SIMPLE;
    leaflet->petiole_length = blade->leaflet_petiole;
    leaflet->petiole_radius = THINNER * blade->petiole_radius;
    leaflet->petiole_bend = 0.0F;
    // Fewer are wider, to keep their area.
    leaflet->width *= fminf((float)MAX(blade->leaflets, 1) / (float)pairs, 2.0F);
    FrStalk stalk = stalk_of(blade->petiole_length, blade->petiole_bend,
                             is_palmate ? 0.0F : blade->rachis_length, blade->rachis_curvature,
                             blade->petiole_radius);
    maker->stalk(maker->user, &stalk);
    if (is_palmate) {
        lay_palmate(&compound, &stalk, pairs);
    } else if (blade->compound == FR_COMPOUND_BIPINNATE) {
        lay_pinnate(&compound, &stalk, pinnae, true);
    } else {
        lay_pinnate(&compound, &stalk, pairs, false);
    }
}

// ---- a mesh ------------------------------------------------------------------------------------

typedef struct MeshMaker {
    FrShapeMesh *mesh;
    const FrPlant *plant;
    const FrDetail *detail;
} MeshMaker;

static uint32_t count_vertices(void *user) {
    return ((const MeshMaker *)user)->mesh->vertex_count;
}

// Moves all vertices from `first` on to a place.
static void put(void *user, uint32_t first, const FrStalkPlace *place, float scale) {
    FrShapeMesh *mesh = ((const MeshMaker *)user)->mesh;
    for (uint32_t i = first; i < mesh->vertex_count; i++) {
        FrVertex *v = &mesh->vertices[i];
        vec3s at = fr_stalk_vector(place, v->position), normal = fr_stalk_vector(place, v->normal);
        at = glms_vec3_muladds(at, scale, place->at);
        memcpy(v->position, at.raw, sizeof at.raw);
        memcpy(v->normal, normal.raw, sizeof normal.raw);
    }
}

// A tube of three sides, from near; a strip from farther away. It has the colour of the midrib.
static void lay_stalk(void *user, const FrStalk *stalk) {
    FrShapeMesh *mesh = ((const MeshMaker *)user)->mesh;
    const FrDetail *detail = ((const MeshMaker *)user)->detail;
    float bent = 0.0F, length = fr_stalk_length(stalk);
    for (int i = 0; i < FR_STALK_PIECES; i++) {
        bent += fabsf(stalk->angle[i + 1] - stalk->angle[i]);
    }
    if (detail->lod >= STALK_GONE || !(stalk->radius > 0.0F) || !(length > 0.0F)) {
        return;
    }
    bool is_strip = detail->lod >= STRIP_FROM;
    uint32_t sides = is_strip ? 2 : 3, rows = (uint32_t)CLAMP(bent / 0.15F + 1.0F, 1.0F, 12.0F);
    for (uint32_t j = 0; j <= rows; j++) {
        float part = (float)j / (float)rows;
        FrStalkPlace place = fr_stalk_place(stalk, part * length);
        float radius = fr_stalk_radius(stalk, part);
        for (uint32_t i = 0; i < sides; i++) {
            float angle =
                is_strip ? (float)G_PI * (float)i : (float)G_PI * (0.5F + 2.0F * (float)i / 3.0F);
            vec3s out = glms_vec3_scale(place.x, cosf(angle));
            out = glms_vec3_muladds(place.y, is_strip ? 0.0F : sinf(angle), out);
            fr_shape_vertex(mesh, glms_vec3_muladds(out, radius, place.at),
                            is_strip ? place.y : out, 0.5F - 0.005F * cosf(angle),
                            0.94F - 0.04F * part);
        }
        for (uint32_t i = 0; j > 0 && i < (is_strip ? 1 : sides); i++) {
            uint32_t base = mesh->vertex_count - 2 * sides, a = base + i;
            uint32_t b = base + (i + 1) % sides;
            fr_shape_triangle(mesh, a, b, b + sides);
            fr_shape_triangle(mesh, a, b + sides, a + sides);
        }
    }
}

static void lay_leaflet_mesh(void *user, const FrBlade *leaflet) {
    const MeshMaker *maker = user;
    fr_lay_blade(maker->mesh, maker->plant, leaflet, maker->detail);
}

void fr_lay_compound(FrShapeMesh *mesh, const FrPlant *plant, const FrBlade *blade,
                     const FrDetail *detail) {
    MeshMaker user = {mesh, plant, detail};
    const FrCompoundMaker maker = {count_vertices, lay_stalk, lay_leaflet_mesh, put, &user};
    uint32_t leaflets = MAX(blade->leaflets, 1), pinnae = MAX(blade->pinnae, 1);
    fr_compound_make(&maker, plant, blade, fr_shape_segments(leaflets, 1, leaflets, detail),
                     fr_shape_segments(pinnae, 1, pinnae, detail));
}
