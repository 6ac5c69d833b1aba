#include "pgraph/params.h"

#include "frond/pgraph.h"

#define FR_PARAM_STRUCT FrBasicParams
static const FrParam camera_rows[] = {FR_BASIC_PARAMS(FR_PARAM_ROW)};
#undef FR_PARAM_STRUCT
#define FR_PARAM_STRUCT FrSimpleParams
static const FrParam simple_rows[] = {FR_BASIC_PARAMS(FR_PARAM_ROW) FR_SIMPLE_PARAMS(FR_PARAM_ROW)};
#undef FR_PARAM_STRUCT
#define FR_PARAM_STRUCT FrHornParams
static const FrParam horn_rows[] = {FR_BASIC_PARAMS(FR_PARAM_ROW) FR_STEM_PARAMS(
    FR_PARAM_ROW) FR_STEM_MORE_PARAMS(FR_PARAM_ROW) FR_FINISH_PARAMS(FR_PARAM_ROW)};
#undef FR_PARAM_STRUCT
#define FR_PARAM_STRUCT FrTreeParams
static const FrParam tree_rows[] = {
    FR_BASIC_PARAMS(FR_PARAM_ROW) FR_STEM_PARAMS(FR_PARAM_ROW) FR_STEM_MORE_PARAMS(FR_PARAM_ROW)
        FR_BRANCHING_PARAMS(FR_PARAM_ROW) FR_FINISH_PARAMS(FR_PARAM_ROW)};
#undef FR_PARAM_STRUCT
#define FR_PARAM_STRUCT FrLeafParams
static const FrParam leaf_rows[] = {FR_BASIC_PARAMS(FR_PARAM_ROW) FR_LEAF_PARAMS(FR_PARAM_ROW)};
#undef FR_PARAM_STRUCT
#define FR_PARAM_STRUCT FrPhiballParams
static const FrParam phiball_rows[] = {FR_BASIC_PARAMS(FR_PARAM_ROW) FR_GOLDEN_PARAMS(FR_PARAM_ROW)
                                           FR_PHIBALL_PARAMS(FR_PARAM_ROW)};
#undef FR_PARAM_STRUCT
#define FR_PARAM_STRUCT FrPhyllotaxisParams
static const FrParam phyllotaxis_rows[] = {FR_BASIC_PARAMS(FR_PARAM_ROW) FR_GOLDEN_PARAMS(
    FR_PARAM_ROW) FR_PHYLLOTAXIS_PARAMS(FR_PARAM_ROW)};
#undef FR_PARAM_STRUCT
#define FR_PARAM_STRUCT FrRingParams
static const FrParam hydra_rows[] = {FR_BASIC_PARAMS(FR_PARAM_ROW) FR_RING_PARAMS(FR_PARAM_ROW)};
#define wreath_rows hydra_rows
#undef FR_PARAM_STRUCT
#define FR_PARAM_STRUCT FrScatterParams
static const FrParam scatter_rows[] = {FR_BASIC_PARAMS(FR_PARAM_ROW)
                                           FR_SCATTER_PARAMS(FR_PARAM_ROW)};
#undef FR_PARAM_STRUCT
#define FR_PARAM_STRUCT FrVariationParams
static const FrParam variation_rows[] = {FR_BASIC_PARAMS(FR_PARAM_ROW)
                                             FR_VARIATION_PARAMS(FR_PARAM_ROW)};
#undef FR_PARAM_STRUCT
#define FR_PARAM_STRUCT FrRevoParams
static const FrParam revo_rows[] = {FR_BASIC_PARAMS(FR_PARAM_ROW) FR_REVO_PARAMS(FR_PARAM_ROW)};
#undef FR_PARAM_STRUCT

#define FR_PARAM_STRUCT FrFfdParams
static const FrParam ffd_rows[] = {FR_BASIC_PARAMS(FR_PARAM_ROW) FR_SCOPE_PARAMS(FR_PARAM_ROW)
                                       FR_FFD_PARAMS(FR_PARAM_ROW)};
#undef FR_PARAM_STRUCT
#define FR_PARAM_STRUCT FrHyperpatchParams
static const FrParam hyperpatch_rows[] = {
    FR_BASIC_PARAMS(FR_PARAM_ROW) FR_SCOPE_PARAMS(FR_PARAM_ROW) FR_HYPERPATCH_PARAMS(FR_PARAM_ROW)};
#undef FR_PARAM_STRUCT
#define FR_PARAM_STRUCT FrWorldParams
static const FrParam world_rows[] = {FR_BASIC_PARAMS(FR_PARAM_ROW) FR_WORLD_PARAMS(FR_PARAM_ROW)};
#undef FR_PARAM_STRUCT
#define FR_PARAM_STRUCT FrForceParams
static const FrParam force_rows[] = {FR_BASIC_PARAMS(FR_PARAM_ROW) FR_FORCE_PARAMS(FR_PARAM_ROW)};
#undef FR_PARAM_STRUCT

#define FR_PARAM_STRUCT FrGraftParams
static const FrParam graft_rows[] = {FR_BASIC_PARAMS(FR_PARAM_ROW) FR_GRAFT_PARAMS(FR_PARAM_ROW)};
#undef FR_PARAM_STRUCT

#define TABLE(name, kind, type, text)                                                              \
    [FR_COMPONENT_##kind] = {.element = #name,                                                     \
                             .meaning = text,                                                      \
                             .rows = name##_rows,                                                  \
                             .count = sizeof name##_rows / sizeof name##_rows[0],                  \
                             .struct_size = sizeof(type)}

static const FrParamTable tables[FR_COMPONENT_COUNT] = {
    TABLE(camera, CAMERA, FrBasicParams, "the root of a plant's components"),
    TABLE(simple, SIMPLE, FrSimpleParams, "a solid, or one cross-section of a tube or area"),
    TABLE(horn, HORN, FrHornParams, "a stem, or a string of objects"),
    TABLE(tree, TREE, FrTreeParams, "a stem that multiplies its branch links along itself"),
    TABLE(leaf, LEAF, FrLeafParams, "a leaf, petal or sepal"),
    TABLE(phiball, PHIBALL, FrPhiballParams,
          "multiplies what follows, spread over a sphere by the golden section"),
    TABLE(revo, REVO, FrRevoParams, "a surface of revolution: a vase, a fruit, a bud"),
    TABLE(hydra, HYDRA, FrRingParams, "multiplies what follows, as the arms of a star"),
    TABLE(wreath, WREATH, FrRingParams, "multiplies what follows, as the candles of a wreath"),
    TABLE(phyllotaxis, PHYLLOTAXIS, FrPhyllotaxisParams,
          "multiplies what follows, spread over a surface of revolution by the golden section"),
    TABLE(scatter, SCATTER, FrScatterParams,
          "multiplies what follows, strewn evenly by chance over a disc, square or ring"),
    TABLE(variation, VARIATION, FrVariationParams, "makes one of what follows"),
    TABLE(ffd, FFD, FrFfdParams, "deforms all that follows by functions"),
    TABLE(hyperpatch, HYPERPATCH, FrHyperpatchParams,
          "deforms all that follows by moving control points of a box"),
    TABLE(world, WORLD, FrWorldParams, "gravity and light for all that follows"),
    TABLE(force, FORCE, FrForceParams, "draws the stems of all that follows"),
    TABLE(graft, GRAFT, FrGraftParams,
          "a plant of the document, whose symbols place what is linked to them"),
};

const FrParamTable *fr_pgraph_table(FrComponentKind kind) {
    FR_ASSERT(kind < FR_COMPONENT_COUNT);
    return &tables[kind];
}
