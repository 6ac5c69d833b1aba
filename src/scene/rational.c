/// How plants are shown: as skins of triangles or as rational surfaces.
#include "scene/rational.h"

#include <math.h>

void fr_rational_set(FrScenePlant *plant, const FrPlantDef *definition, double time) {
    plant->has_nurbs = definition->has_nurbs;
    plant->nurbs = definition->nurbs;
    plant->nurbs_span = definition->nurbs_span;
    double now = isnan(time) ? definition->time : time;
    plant->nurbs.phase += 2.0 * G_PI * fmod(now / definition->nurbs.period, 1.0);
}

FrDigest fr_rational_digest(FrDigest seed, const FrScenePlant *plant) {
    const FrParamTable *table = fr_nurbs_table();
    FrDigest digest = seed;
    for (size_t i = 0; plant->has_nurbs && i < table->count; i++) {
        digest = fr_param_digest(digest, &table->rows[i], &plant->nurbs);
    }
    return digest;
}

FrStatus fr_scene_mesh(const FrScenePlant *plant, const FrSkinParams *skin, FrUpAxis up,
                       const FrContext *context, FrMesh **mesh) {
    if (!plant->has_nurbs) {
        return fr_skin_plant(plant->plant, skin, up, context, mesh);
    }
    return fr_nurbs_mesh(plant->plant, &plant->nurbs, (int)skin->lod, up, plant->nurbs_span,
                         context, mesh);
}
