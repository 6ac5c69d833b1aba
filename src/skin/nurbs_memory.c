// Rational skins: memory and digest.
#include "frond/nurbs_skin.h"

#include <stdlib.h>

void fr_nurbs_skin_free(FrNurbsSkin *skin) {
    if (skin != NULL) {
        free(skin->pieces);
        free(skin->knots);
        free(skin->points);
        free(skin->copies);
        free(skin->textures);
        g_free(skin);
    }
}

uint64_t fr_nurbs_skin_bytes(const FrNurbsSkin *skin) {
    return skin->count * sizeof *skin->pieces + skin->knot_count * sizeof *skin->knots +
           skin->point_count * sizeof *skin->points + skin->copy_count * sizeof *skin->copies +
           skin->texture_count * sizeof *skin->textures;
}

uint64_t fr_nurbs_skin_surfaces(const FrNurbsSkin *skin) {
    uint64_t surfaces = skin->count;
    for (uint64_t i = 0; i < skin->copy_count; i++) {
        surfaces += skin->copies[i].piece_count;
    }
    return surfaces;
}

FrDigest fr_nurbs_skin_digest(const FrNurbsSkin *skin) {
    FrDigest digest = fr_digest(0, skin->points, skin->point_count * sizeof *skin->points);
    digest = fr_digest(digest, skin->copies, skin->copy_count * sizeof *skin->copies);
    digest = fr_digest(digest, skin->knots, skin->knot_count * sizeof *skin->knots);
    for (uint64_t i = 0; i < skin->count; i++) {
        const FrNurbsPiece *piece = &skin->pieces[i];
        const uint32_t numbers[] = {piece->kind,
                                    piece->material,
                                    piece->axis,
                                    piece->organ,
                                    piece->surface.degree_u,
                                    piece->surface.degree_v,
                                    piece->surface.count_u,
                                    piece->surface.count_v};
        digest = fr_digest(digest, numbers, sizeof numbers);
    }
    return digest;
}
