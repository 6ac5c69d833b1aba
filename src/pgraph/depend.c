#include "pgraph/depend.h"

#include "pgraph/choice.h"
#include "pgraph/edit.h"
#include "pgraph/ramp.h"
#include "pgraph/strewn.h"

#include <string.h>

typedef enum Effect {
    ON_GROWTH, // what is made, and where
    ON_FORM,   // a leaf's shape, not where the leaf is
    ON_LOOK,   // the material
} Effect;

static Effect effect_of(FrComponentKind kind, size_t row) {
    if (row == FR_BASIC_material) {
        return ON_LOOK;
    }
    bool is_form = (row >= FR_LEAF_length && row <= FR_LEAF_variants) || row >= FR_LEAF_edge_curl;
    return kind == FR_COMPONENT_LEAF && is_form ? ON_FORM : ON_GROWTH;
}

static FrDigest digest_parameters(FrDigest digest, const FrPrepared *prepared, Effect effect) {
    const FrParamTable *table = fr_pgraph_table(prepared->kind);
    for (size_t row = 0; row < table->count; row++) {
        if (effect_of(prepared->kind, row) == effect) {
            digest = fr_param_digest(digest, &table->rows[row], prepared->params);
        }
    }
    return digest;
}

FrDigest fr_depend_inputs(const FrPgraph *graph) {
    FrDigest digest = fr_digest(0, &graph->seed, sizeof graph->seed);
    bool has_ramps = fr_has_ramps(graph);
    digest = fr_digest(digest, &has_ramps, sizeof has_ramps);
    digest = fr_edits_digest(digest, graph);
    return fr_digest(digest, &graph->state, sizeof graph->state);
}

static FrDigest digest_component(const FrExpansion *expansion, uint32_t component) {
    const FrPrepared *prepared = &expansion->prepared[component];
    uint64_t head[] = {prepared->kind, prepared->key_word, prepared->bears, prepared->bears_welded};
    FrDigest digest = fr_digest(0, head, sizeof head);
    for (guint k = 0; prepared->weights != NULL && k < prepared->weights->len; k++) {
        const FrWeight *weight = &g_array_index(prepared->weights, FrWeight, k);
        uint64_t link[] = {expansion->prepared[weight->to].key_word, weight->kind};
        digest = fr_digest(digest, link, sizeof link);
        digest = fr_digest(digest, &weight->weight, sizeof weight->weight);
    }
    if (prepared->file != NULL) {
        digest = fr_digest(digest, &prepared->file->digest, sizeof prepared->file->digest);
    }
    if (prepared->strewn != NULL && prepared->strewn->map != NULL) {
        const FrImage *map = prepared->strewn->map;
        size_t size = (size_t)map->width * map->height * map->channels;
        digest = fr_digest(digest, map->pixels, size);
    }
    return digest_parameters(digest, prepared, ON_GROWTH);
}

// What an instance reads of the component that a link leads to.
static FrDigest digest_follower(FrDigest digest, FrLinkKind link, const FrPrepared *to) {
    const FrBasicParams *basic = to->params;
    uint64_t head[] = {link, to->kind, to->key_word, to->is_stem, to->is_point_set, 0};
    if (to->kind == FR_COMPONENT_SIMPLE) {
        head[5] = (uint64_t)((const FrSimpleParams *)to->params)->primitive;
    }
    const char *only = basic->only != NULL ? basic->only : "";
    return fr_digest(fr_digest(digest, head, sizeof head), only, strlen(only) + 1);
}

static FrDigest digest_stage(const FrExpansion *expansion, const FrStage *stage,
                             FrDigest component) {
    uint64_t head[] = {component, stage->generation, stage->is_further, stage->link_count};
    FrDigest digest = fr_digest(0, head, sizeof head);
    for (uint32_t k = 0; k < stage->link_count; k++) {
        const FrStageLink *link = fr_stage_link(expansion, stage, k);
        digest = digest_follower(digest, link->kind, fr_stage_prepared(expansion, link->stage));
    }
    return digest;
}

FrDigest *fr_depend_stages(const FrExpansion *expansion) {
    guint count = expansion->unrolled->stages->len;
    FrDigest *components = g_new0(FrDigest, fr_pgraph_count(expansion->graph));
    FrDigest *digests = g_new(FrDigest, count + 1);
    for (guint s = 0; s < count; s++) {
        const FrStage *stage = &g_array_index(expansion->unrolled->stages, FrStage, s);
        FrDigest *component = &components[stage->component];
        *component = *component != 0 ? *component : digest_component(expansion, stage->component);
        digests[s] = digest_stage(expansion, stage, *component);
    }
    g_free(components);
    return digests;
}

// The order of stages is what instances reach first, so they name each component once at least.
FrDigest fr_depend_tables(const FrExpansion *expansion) {
    const FrPlant *plant = expansion->plant;
    bool has_own_shapes = fr_depend_has_own_shapes(expansion);
    FrDigest digest = 0;
    for (guint s = 0; s < expansion->unrolled->stages->len; s++) {
        uint32_t component = g_array_index(expansion->unrolled->stages, FrStage, s).component;
        const FrPrepared *prepared = &expansion->prepared[component];
        uint32_t head[] = {
            component,       prepared->material,     prepared->profile,    prepared->finish,
            prepared->shape, prepared->shape_choice, prepared->deformation};
        digest = fr_digest(digest, head, sizeof head);
        digest =
            fr_digest(digest, prepared->pieces, prepared->piece_count * sizeof *prepared->pieces);
        if (prepared->shape_choice == FR_SHAPE_VARIANT) {
            digest = fr_digest(digest, prepared->variants,
                               prepared->variant_count * sizeof *prepared->variants);
        }
        if (prepared->shape_choice == FR_SHAPE_EVALUATED) {
            digest = digest_parameters(digest, prepared, ON_FORM);
        }
    }
    // Shapes of single leaves come behind those of components and may be equal to some.
    if (has_own_shapes) {
        uint32_t profiles = plant->profiles->len;
        digest = fr_digest(digest, &profiles, sizeof profiles);
        digest = fr_digest(digest, plant->shapes->data, plant->shapes->len * sizeof(FrShape));
    }
    return digest;
}

bool fr_depend_has_own_shapes(const FrExpansion *expansion) {
    for (guint s = 0; s < expansion->unrolled->stages->len; s++) {
        const FrPrepared *prepared = fr_stage_prepared(expansion, s);
        if (prepared->kind == FR_COMPONENT_LEAF && prepared->shape_choice == FR_SHAPE_EVALUATED) {
            return true;
        }
    }
    return false;
}
