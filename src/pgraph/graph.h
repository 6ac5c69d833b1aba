/// @file graph.h
/// The p-graph as it was put together: prototypes and links.
#pragma once

#include "frond/pgraph.h"

#include "pgraph/params.h"

/// A number that the plant of a graft knows by this name.
typedef struct FrGraftDefine {
    char *name; ///< owned
    FrNumber number;
} FrGraftDefine;

/// A component as the user declared it; instances are made after it.
typedef struct FrPrototype {
    FrComponentKind kind;
    char *id; ///< owned
    FrSpan span;
    void *params;    ///< owned; the struct of the kind's table, begins with FrBasicParams
    GArray *defines; ///< FrGraftDefine; NULL for kinds other than a graft
} FrPrototype;

typedef struct FrPgraphLink {
    uint32_t from, to;
    FrLinkKind kind;
    char symbol; ///< for FR_LINK_SYMBOL, else 0
    FrSpan span;
} FrPgraphLink;

struct FrPgraph {
    char *name;
    uint64_t seed;
    FrPgraphState state;
    char *folder;               ///< that files are relative to; owned; NULL: the working folder
    GArray *prototypes;         ///< FrPrototype
    GArray *links;              ///< FrPgraphLink, as they were added
    GPtrArray *materials;       ///< FrMaterial *, owned references
    GArray *edits;              ///< FrGraphEdit
    GHashTable *by_id;          ///< id → index + 1
    GHashTable *material_names; ///< name, borrowed → index + 1
    GHashTable *link_keys;      ///< links there are, as int64_t
};

/// Whether a component multiplies all its links, whatever their kind.
static inline bool fr_is_spreading(FrComponentKind kind) {
    return kind == FR_COMPONENT_PHIBALL || kind == FR_COMPONENT_PHYLLOTAXIS ||
           kind == FR_COMPONENT_HYDRA || kind == FR_COMPONENT_WREATH ||
           kind == FR_COMPONENT_SCATTER;
}

static inline const FrPrototype *fr_pgraph_prototype(const FrPgraph *graph, uint32_t component) {
    FR_ASSERT(component < graph->prototypes->len);
    return &g_array_index(graph->prototypes, FrPrototype, component);
}

static inline const FrBasicParams *fr_pgraph_basic(const FrPgraph *graph, uint32_t component) {
    return fr_pgraph_prototype(graph, component)->params;
}

static inline const FrPgraphLink *fr_pgraph_link_at(const FrPgraph *graph, uint32_t link) {
    return &g_array_index(graph->links, FrPgraphLink, link);
}
