// The digest of a plant's truth: what two plants must share to be the same plant.
#include "plant/columns.h"

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

FrDigest fr_plant_digest(const FrPlant *plant) {
    FrDigest digest = digest_table(0, &plant->nodes, plant->nodes.count, &fr_node_columns);
    digest = digest_table(digest, &plant->axes, plant->axes.count, &fr_axis_columns);
    digest = digest_table(digest, &plant->organs, plant->organs.count, &fr_organ_columns);
    digest = digest_table(digest, &plant->buds, plant->buds.count, &fr_bud_columns);
    digest = digest_array(digest, plant->shapes);
    digest = digest_array(digest, plant->deformers);
    for (guint i = 0; i < plant->profiles->len; i++) {
        const FrProfile *profile = &g_array_index(plant->profiles, FrProfile, i);
        uint32_t head[2] = {profile->count, profile->is_closed};
        digest = fr_digest(digest, head, sizeof head);
        digest = fr_digest(digest, profile->points, profile->count * sizeof *profile->points);
    }
    return digest;
}
