// Compound leaves as surfaces: the tubes of stalks, and leaflets that are leaves.
#include "skin/nurbs_leaf.h"

#include "skin/compound.h"

enum { ROWS_MOST = 12 };

typedef struct FormMaker {
    GArray *forms;
    const FrPlant *plant;
    const FrNurbsParams *params;
} FormMaker;

static uint32_t count_forms(void *user) {
    return ((const FormMaker *)user)->forms->len;
}

static void lay_stalk(void *user, const FrStalk *stalk) {
    const FormMaker *maker = user;
    float length = fr_stalk_length(stalk), bent = 0.0F;
    if (!(stalk->radius > 0.0F) || !(length > 0.0F)) {
        return;
    }
    for (int i = 0; i < FR_STALK_PIECES; i++) {
        bent += fabsf(stalk->angle[i + 1] - stalk->angle[i]);
    }
    uint32_t rows = (uint32_t)CLAMP(bent / 0.15F + 1.0F, 1.0F, (float)ROWS_MOST);
    FrNurbsPath path = {0};
    for (uint32_t j = 0; j <= rows; j++) {
        float part = (float)j / (float)rows;
        FrStalkPlace place = fr_stalk_place(stalk, part * length);
        const double at[3] = {(double)place.at.x, (double)place.at.y, (double)place.at.z};
        double radius = fmax((double)fr_stalk_radius(stalk, part), 1e-5);
        fr_nurbs_path_add(&path, at, radius, 1.0, FR_NONE);
    }
    fr_nurbs_stalk(maker->forms, &path, maker->params);
    fr_nurbs_path_clear(&path);
}

static void lay_leaflet(void *user, const FrBlade *leaflet) {
    const FormMaker *maker = user;
    fr_nurbs_blade(maker->forms, maker->plant, leaflet, maker->params);
}

static void put(void *user, uint32_t first, const FrStalkPlace *place, float scale) {
    const FormMaker *maker = user;
    const vec3s *axes[3] = {&place->x, &place->y, &place->z};
    for (uint32_t f = first; f < maker->forms->len; f++) {
        FrNurbsForm *form = &g_array_index(maker->forms, FrNurbsForm, f);
        for (size_t i = 0; i < (size_t)form->count_u * form->count_v; i++) {
            double moved[3];
            for (int k = 0; k < 3; k++) {
                moved[k] = (double)place->at.raw[k];
                for (int a = 0; a < 3; a++) {
                    moved[k] += (double)scale * form->points[i][a] * (double)axes[a]->raw[k];
                }
            }
            for (int k = 0; k < 3; k++) {
                form->points[i][k] = moved[k];
            }
        }
    }
}

void fr_nurbs_compound(GArray *forms, const FrPlant *plant, const FrBlade *blade,
                       const FrNurbsParams *params) {
    FormMaker user = {forms, plant, params};
    const FrCompoundMaker maker = {count_forms, lay_stalk, lay_leaflet, put, &user};
    fr_compound_make(&maker, plant, blade, MAX(blade->leaflets, 1), MAX(blade->pinnae, 1));
}
