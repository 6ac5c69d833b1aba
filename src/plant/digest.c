// The digest of a plant's truth: what two plants must share to be the same plant.
#include "plant/columns.h"
#include "plant/shapes.h"

#include <string.h>

static FrDigest digest_table(FrDigest seed, const void *table, uint32_t count,
                             const FrColumns *columns) {
    FrDigest digest = fr_digest(seed, &count, sizeof count);
    for (size_t c = 0; c < columns->count; c++) {
        const FrColumn *column = &columns->columns[c];
        if (!column->is_cache && count > 0) {
            digest = fr_digest(digest, fr_column_data(table, column), count * column->width);
        }
    }
    return digest;
}

static FrDigest digest_array(FrDigest seed, const GArray *array) {
    FrDigest digest = fr_digest(seed, &array->len, sizeof array->len);
    return array->len == 0
               ? digest
               : fr_digest(digest, array->data,
                           (size_t)array->len * g_array_get_element_size((GArray *)array));
}

static FrDigest digest_deformation(FrDigest digest, const FrDeformation *deformation) {
    uint32_t head[3] = {deformation->kind, deformation->is_skeleton, deformation->is_cut};
    digest = fr_digest(digest, head, sizeof head);
    for (int axis = 0; axis < 3; axis++) {
        const FrExpr *map = deformation->map[axis];
        const char *text = map != NULL ? fr_expr_text(map) : "";
        digest = fr_digest(digest, text, strlen(text) + 1);
    }
    const FrLattice *lattice = &deformation->lattice;
    if (deformation->kind == FR_DEFORM_LATTICE) {
        digest = fr_digest(digest, lattice->min, sizeof lattice->min);
        digest = fr_digest(digest, lattice->max, sizeof lattice->max);
        digest = fr_digest(digest, lattice->degree, sizeof lattice->degree);
        digest =
            fr_digest(digest, lattice->points, fr_lattice_count(lattice) * sizeof *lattice->points);
    }
    return digest;
}

// Field by field: rows have padding.
static FrDigest digest_deformer(FrDigest digest, const FrDeformer *deformer) {
    uint32_t indices[3] = {deformer->outer, deformer->deformation, deformer->node};
    float sizes[3] = {deformer->scale, deformer->strength, deformer->amount};
    digest = fr_digest(digest, indices, sizeof indices);
    digest = fr_digest(digest, sizes, sizeof sizes);
    digest = fr_digest(digest, deformer->offset.raw, sizeof deformer->offset.raw);
    return fr_digest(digest, deformer->rotation.raw, sizeof deformer->rotation.raw);
}

FrDigest fr_profile_digest(FrDigest seed, const FrProfile *profile) {
    uint32_t head[2] = {profile->count, profile->is_closed};
    FrDigest digest = fr_digest(seed, head, sizeof head);
    return fr_digest(digest, profile->points, profile->count * sizeof *profile->points);
}

FrDigest fr_plant_digest(const FrPlant *plant) {
    FrDigest digest = digest_table(0, &plant->nodes, plant->nodes.count, &fr_node_columns);
    digest = digest_table(digest, &plant->axes, plant->axes.count, &fr_axis_columns);
    digest = digest_table(digest, &plant->organs, plant->organs.count, &fr_organ_columns);
    digest = digest_table(digest, &plant->buds, plant->buds.count, &fr_bud_columns);
    digest = digest_array(digest, plant->shapes);
    digest = digest_array(digest, plant->finishes);
    for (guint i = 0; i < plant->files->len; i++) {
        const FrMeshFile *file = g_ptr_array_index(plant->files, i);
        digest = fr_digest(digest, &file->digest, sizeof file->digest);
    }
    for (guint i = 0; i < plant->deformers->len; i++) {
        digest = digest_deformer(digest, &g_array_index(plant->deformers, FrDeformer, i));
    }
    for (guint i = 0; i < plant->deformations->len; i++) {
        const FrDeformation *deformation = &g_array_index(plant->deformations, FrDeformation, i);
        digest = digest_deformation(digest, deformation);
    }
    for (guint i = 0; i < plant->profiles->len; i++) {
        digest = fr_profile_digest(digest, &g_array_index(plant->profiles, FrProfile, i));
    }
    return digest;
}
