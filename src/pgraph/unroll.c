#include "pgraph/unroll.h"

#include "pgraph/edit.h"

#include <string.h>

// More stages than this belong to no plant; they would only fill memory.
enum { MOST_STAGES = 1 << 17, MOST_STAGE_LINKS = 1 << 20, MOST_COUNTS = 1 << 22 };

// Component and counts of a stage: what tells stages apart.
typedef struct Key {
    uint32_t component, count;
    uint32_t counts[];
} Key;

typedef struct Unroller {
    FrUnrolled *made;
    const FrPgraph *graph;
    const FrRecursions *recursions;
    const FrContext *context;
    GHashTable *index; // Key → stage
    GPtrArray *keys;   // of each stage; owned by `index`
    uint64_t counts;   // held by all keys together
} Unroller;

static guint key_hash(gconstpointer data) {
    const Key *key = data;
    return (guint)fr_digest(key->component, key->counts, key->count * sizeof *key->counts);
}

static gboolean key_equal(gconstpointer a, gconstpointer b) {
    const Key *p = a;
    const Key *q = b;
    return p->component == q->component && p->count == q->count &&
           memcmp(p->counts, q->counts, p->count * sizeof *p->counts) == 0;
}

// The stage of `component` reached from a stage with key `from` (NULL: from a root), or FR_NONE
// where its depth is used up.
static uint32_t stage_of(Unroller *unroller, const Key *from, uint32_t component) {
    const FrRecursions *recursions = unroller->recursions;
    uint32_t set = recursions->of[component];
    uint32_t slot = recursions->slot[component];
    bool is_inside = from != NULL && recursions->of[from->component] == set;
    if (is_inside && slot != FR_NONE &&
        from->counts[slot] >= fr_pgraph_basic(unroller->graph, component)->depth) {
        return FR_NONE;
    }
    uint32_t count = recursions->slots[set];
    Key *key = g_malloc(sizeof *key + count * sizeof *key->counts);
    *key = (Key){.component = component, .count = count};
    for (uint32_t k = 0; k < count; k++) {
        key->counts[k] = (is_inside ? from->counts[k] : 0) + (k == slot);
    }
    gpointer found;
    if (g_hash_table_lookup_extended(unroller->index, key, NULL, &found)) {
        g_free(key);
        return GPOINTER_TO_UINT(found);
    }
    FrStage stage = {.component = component, .generation = FR_NONE};
    if (recursions->is_recursive[component]) {
        uint32_t most = 1;
        for (uint32_t k = 0; k < count; k++) {
            most = MAX(most, key->counts[k]);
        }
        stage.generation = (slot != FR_NONE ? key->counts[slot] : most) - 1;
        stage.is_further = stage.generation > 0;
    }
    uint32_t index = unroller->made->stages->len;
    g_array_append_val(unroller->made->stages, stage);
    g_ptr_array_add(unroller->keys, key);
    g_hash_table_insert(unroller->index, key, GUINT_TO_POINTER(index));
    unroller->counts += count;
    return index;
}

static bool add_link(Unroller *unroller, const Key *from, const FrPgraphLink *link) {
    if (!fr_pgraph_basic(unroller->graph, link->to)->enabled) {
        return true;
    }
    uint32_t stage = stage_of(unroller, from, link->to);
    if (stage == FR_NONE) {
        return false;
    }
    FrStageLink made = {.stage = stage, .kind = link->kind, .symbol = link->symbol};
    g_array_append_val(unroller->made->links, made);
    return true;
}

// Leaf links of all members of the recursion that lead out of it: they bloom at its end.
static void add_last_links(Unroller *unroller, const Key *key) {
    const FrRecursions *recursions = unroller->recursions;
    uint32_t set = recursions->of[key->component];
    for (uint32_t m = recursions->first_member[set]; m < recursions->first_member[set + 1]; m++) {
        uint32_t member = recursions->members[m];
        for (uint32_t k = recursions->first_link[member]; k < recursions->first_link[member + 1];
             k++) {
            const FrPgraphLink *link = fr_pgraph_link_at(unroller->graph, recursions->links[k]);
            bool is_outer = recursions->of[link->to] != set;
            if (link->kind == FR_LINK_LEAF && (is_outer || member == key->component)) {
                add_link(unroller, key, link);
            }
        }
    }
}

static void add_links(Unroller *unroller, uint32_t stage) {
    const FrRecursions *recursions = unroller->recursions;
    const Key *key = g_ptr_array_index(unroller->keys, stage);
    uint32_t c = key->component;
    uint32_t first = unroller->made->links->len;
    bool is_recursive = recursions->is_recursive[c];
    bool goes_on = false;
    for (uint32_t k = recursions->first_link[c]; k < recursions->first_link[c + 1]; k++) {
        const FrPgraphLink *link = fr_pgraph_link_at(unroller->graph, recursions->links[k]);
        if (!is_recursive || link->kind != FR_LINK_LEAF) {
            bool is_made = add_link(unroller, key, link);
            goes_on |= is_made && recursions->of[link->to] == recursions->of[c];
        }
    }
    if (is_recursive && !goes_on) {
        add_last_links(unroller, key);
    }
    FrStage *made = &g_array_index(unroller->made->stages, FrStage, stage);
    made->first_link = first;
    made->link_count = unroller->made->links->len - first;
}

static FrStatus check_depths(const FrPgraph *graph, const FrRecursions *recursions,
                             const FrContext *context) {
    for (uint32_t c = 0; c < fr_pgraph_count(graph); c++) {
        const FrPrototype *prototype = fr_pgraph_prototype(graph, c);
        uint64_t depth = (uint64_t)fr_pgraph_basic(graph, c)->depth;
        if (recursions->is_recursive[c]) {
            FrStatus status = fr_limit_check(depth, context->limits.depth, "depth", prototype->id,
                                             prototype->span, context->diags);
            if (status != FR_OK) {
                return status;
            }
        }
    }
    return FR_OK;
}

static FrStatus check_size(const Unroller *unroller, uint32_t stage) {
    uint32_t c = g_array_index(unroller->made->stages, FrStage, stage).component;
    uint64_t most = MIN(unroller->context->limits.instances, MOST_STAGES);
    uint64_t wanted = unroller->made->stages->len;
    if (unroller->counts > MOST_COUNTS || unroller->made->links->len > MOST_STAGE_LINKS) {
        wanted = fr_count_add(most, wanted); // the table, not the number of rows, is too large
    }
    return fr_limit_check(wanted, most, "instances", fr_pgraph_id(unroller->graph, c),
                          fr_pgraph_prototype(unroller->graph, c)->span, unroller->context->diags);
}

FrStatus fr_unroll(FrUnrolled *made, const FrPgraph *graph, const FrRecursions *recursions,
                   const FrContext *context) {
    *made = (FrUnrolled){
        .stages = g_array_new(FALSE, FALSE, sizeof(FrStage)),
        .links = g_array_new(FALSE, FALSE, sizeof(FrStageLink)),
        .roots = g_array_new(FALSE, FALSE, sizeof(uint32_t)),
        .replacements = g_array_new(FALSE, FALSE, sizeof(uint32_t)),
    };
    Unroller unroller = {
        .made = made,
        .graph = graph,
        .recursions = recursions,
        .context = context,
        .index = g_hash_table_new_full(key_hash, key_equal, g_free, NULL),
        .keys = g_ptr_array_new(),
    };
    FrStatus status = check_depths(graph, recursions, context);
    for (uint32_t k = 0; k < recursions->roots->len && status == FR_OK; k++) {
        uint32_t root = g_array_index(recursions->roots, uint32_t, k);
        if (fr_pgraph_basic(graph, root)->enabled) {
            uint32_t stage = stage_of(&unroller, NULL, root);
            g_array_append_val(made->roots, stage);
        }
    }
    for (uint32_t k = 0; k < graph->edits->len && status == FR_OK; k++) {
        uint32_t component = fr_graph_edit(graph, k)->replacement;
        uint32_t stage = component != FR_NONE ? stage_of(&unroller, NULL, component) : FR_NONE;
        g_array_append_val(made->replacements, stage);
    }
    for (uint32_t stage = 0; stage < made->stages->len && status == FR_OK; stage++) {
        add_links(&unroller, stage);
        status = check_size(&unroller, stage);
    }
    g_ptr_array_unref(unroller.keys);
    g_hash_table_unref(unroller.index);
    return status;
}

void fr_unrolled_clear(FrUnrolled *unrolled) {
    g_array_unref(unrolled->stages);
    g_array_unref(unrolled->links);
    g_array_unref(unrolled->roots);
    g_array_unref(unrolled->replacements);
}

// Stages in an order in which each comes before what it makes.
static uint32_t *stage_order(const FrUnrolled *unrolled) {
    uint32_t count = unrolled->stages->len;
    uint32_t *order = g_new(uint32_t, count);
    uint32_t *before = g_new0(uint32_t, count);
    uint32_t known = 0;
    for (uint32_t k = 0; k < unrolled->links->len; k++) {
        before[g_array_index(unrolled->links, FrStageLink, k).stage]++;
    }
    for (uint32_t s = 0; s < count; s++) {
        if (before[s] == 0) {
            order[known++] = s;
        }
    }
    for (uint32_t done = 0; done < known; done++) {
        const FrStage *stage = &g_array_index(unrolled->stages, FrStage, order[done]);
        for (uint32_t k = 0; k < stage->link_count; k++) {
            uint32_t to = g_array_index(unrolled->links, FrStageLink, stage->first_link + k).stage;
            if (--before[to] == 0) {
                order[known++] = to;
            }
        }
    }
    FR_ASSERT(known == count);
    g_free(before);
    return order;
}

uint64_t fr_unrolled_least(const FrUnrolled *unrolled, const FrPgraph *graph,
                           const uint64_t *multiplicity, const bool *is_flagged,
                           uint32_t *culprit) {
    uint32_t count = unrolled->stages->len;
    uint32_t *order = stage_order(unrolled);
    uint64_t *instances = g_new0(uint64_t, count);
    uint64_t total = 0, most = 0;
    for (uint32_t k = 0; k < unrolled->roots->len; k++) {
        instances[g_array_index(unrolled->roots, uint32_t, k)] = 1;
    }
    *culprit = FR_NONE;
    for (uint32_t done = 0; done < count; done++) {
        const FrStage *stage = &g_array_index(unrolled->stages, FrStage, order[done]);
        uint64_t made = instances[order[done]];
        FrComponentKind kind = fr_pgraph_kind(graph, stage->component);
        total = fr_count_add(total, made);
        for (uint32_t k = 0; k < stage->link_count; k++) {
            FrStageLink link = g_array_index(unrolled->links, FrStageLink, stage->first_link + k);
            bool is_multiplied = fr_link_is_multiplied(kind, link.kind);
            uint64_t times = is_multiplied ? multiplicity[stage->component] : 1;
            uint32_t to = g_array_index(unrolled->stages, FrStage, link.stage).component;
            // Flags may leave out any of the children: counted as none.
            times = is_flagged[to] ? 0 : times;
            // A variation may follow another link.
            times = kind == FR_COMPONENT_VARIATION && stage->link_count > 1 ? 0 : times;
            instances[link.stage] =
                fr_count_add(instances[link.stage], fr_count_multiply(made, times));
        }
        if (made > most) {
            most = made;
            *culprit = stage->component;
        }
    }
    g_free(instances);
    g_free(order);
    return total;
}
