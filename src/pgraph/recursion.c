// Strongly connected components. After: Tarjan. Depth-first search and linear graph algorithms.
// SIAM Journal on Computing 1 (2), 1972; with a stack of its own, so that no graph is too deep.
#include "pgraph/recursion.h"

#include "pgraph/edit.h"

typedef struct Search {
    FrRecursions *found;
    const FrPgraph *graph;
    uint32_t *number, *low, *next; // order of visit from 1, lowest reachable, next link to follow
    GArray *path, *open;           // uint32_t
    uint32_t visited;
} Search;

static void sort_links(FrRecursions *found, const FrPgraph *graph) {
    uint32_t count = fr_pgraph_count(graph);
    uint32_t *fill = g_new0(uint32_t, count + 1);
    found->first_link = g_new0(uint32_t, count + 1);
    found->links = g_new(uint32_t, graph->links->len);
    for (uint32_t k = 0; k < graph->links->len; k++) {
        found->first_link[fr_pgraph_link_at(graph, k)->from + 1]++;
    }
    for (uint32_t c = 0; c < count; c++) {
        found->first_link[c + 1] += found->first_link[c];
        fill[c] = found->first_link[c];
    }
    for (uint32_t k = 0; k < graph->links->len; k++) {
        found->links[fill[fr_pgraph_link_at(graph, k)->from]++] = k;
    }
    g_free(fill);
}

static void enter(Search *search, uint32_t c) {
    search->number[c] = search->low[c] = ++search->visited;
    search->next[c] = search->found->first_link[c];
    search->found->of[c] = FR_NONE;
    g_array_append_val(search->path, c);
    g_array_append_val(search->open, c);
}

// All of `c` is searched: if it reaches nothing before it, it closes a set.
static void leave(Search *search, uint32_t c) {
    g_array_set_size(search->path, search->path->len - 1);
    if (search->path->len > 0) {
        uint32_t before = g_array_index(search->path, uint32_t, search->path->len - 1);
        search->low[before] = MIN(search->low[before], search->low[c]);
    }
    if (search->low[c] != search->number[c]) {
        return;
    }
    uint32_t set = search->found->count++;
    uint32_t member;
    bool is_many = g_array_index(search->open, uint32_t, search->open->len - 1) != c;
    do {
        member = g_array_index(search->open, uint32_t, search->open->len - 1);
        g_array_set_size(search->open, search->open->len - 1);
        search->found->of[member] = set;
        search->found->is_recursive[member] |= is_many;
    } while (member != c);
}

static void search_from(Search *search, uint32_t root) {
    enter(search, root);
    while (search->path->len > 0) {
        uint32_t c = g_array_index(search->path, uint32_t, search->path->len - 1);
        if (search->next[c] == search->found->first_link[c + 1]) {
            leave(search, c);
            continue;
        }
        uint32_t link = search->found->links[search->next[c]++];
        uint32_t to = fr_pgraph_link_at(search->graph, link)->to;
        search->found->is_recursive[c] |= to == c;
        if (search->number[to] == 0) {
            enter(search, to);
        } else if (search->found->of[to] == FR_NONE) {
            search->low[c] = MIN(search->low[c], search->number[to]);
        }
    }
}

static void gather_members(FrRecursions *found, const FrPgraph *graph) {
    uint32_t count = fr_pgraph_count(graph);
    found->first_member = g_new0(uint32_t, found->count + 1);
    found->members = g_new(uint32_t, count);
    found->slot = g_new(uint32_t, count);
    found->slots = g_new0(uint32_t, found->count);
    uint32_t *fill = g_new(uint32_t, found->count);
    for (uint32_t c = 0; c < count; c++) {
        found->first_member[found->of[c] + 1]++;
    }
    for (uint32_t set = 0; set < found->count; set++) {
        found->first_member[set + 1] += found->first_member[set];
        fill[set] = found->first_member[set];
    }
    for (uint32_t c = 0; c < count; c++) {
        uint32_t set = found->of[c];
        found->members[fill[set]++] = c;
        bool is_counted = found->is_recursive[c] && fr_pgraph_basic(graph, c)->depth > 0;
        found->slot[c] = is_counted ? found->slots[set]++ : FR_NONE;
    }
    g_free(fill);
}

// Cameras, or else the first of every set that no link from outside leads to.
static void find_roots(FrRecursions *found, const FrPgraph *graph) {
    uint32_t count = fr_pgraph_count(graph);
    found->roots = g_array_new(FALSE, FALSE, sizeof(uint32_t));
    for (uint32_t c = 0; c < count; c++) {
        if (fr_pgraph_kind(graph, c) == FR_COMPONENT_CAMERA) {
            g_array_append_val(found->roots, c);
        }
    }
    bool has_camera = found->roots->len > 0;
    bool *is_led_to = g_new0(bool, found->count);
    for (uint32_t k = 0; k < graph->links->len; k++) {
        const FrPgraphLink *link = fr_pgraph_link_at(graph, k);
        is_led_to[found->of[link->to]] |= found->of[link->from] != found->of[link->to];
    }
    for (uint32_t c = 0; c < count && !has_camera; c++) {
        if (!is_led_to[found->of[c]]) {
            g_array_append_val(found->roots, c);
            is_led_to[found->of[c]] = true;
        }
    }
    g_free(is_led_to);
}

static void reach(FrRecursions *found, const FrPgraph *graph) {
    found->is_reached = g_new0(bool, fr_pgraph_count(graph));
    GArray *open = g_array_copy(found->roots);
    for (uint32_t k = 0; k < graph->edits->len; k++) {
        const FrGraphEdit *edit = fr_graph_edit(graph, k);
        if (edit->replacement != FR_NONE) {
            g_array_append_val(open, edit->replacement);
        }
    }
    for (uint32_t k = 0; k < open->len; k++) {
        found->is_reached[g_array_index(open, uint32_t, k)] = true;
    }
    while (open->len > 0) {
        uint32_t c = g_array_index(open, uint32_t, open->len - 1);
        g_array_set_size(open, open->len - 1);
        for (uint32_t k = found->first_link[c]; k < found->first_link[c + 1]; k++) {
            uint32_t to = fr_pgraph_link_at(graph, found->links[k])->to;
            if (!found->is_reached[to]) {
                found->is_reached[to] = true;
                g_array_append_val(open, to);
            }
        }
    }
    g_array_unref(open);
}

void fr_recursions_find(FrRecursions *found, const FrPgraph *graph) {
    uint32_t count = fr_pgraph_count(graph);
    *found = (FrRecursions){
        .of = g_new(uint32_t, count),
        .is_recursive = g_new0(bool, count),
    };
    sort_links(found, graph);
    Search search = {
        .found = found,
        .graph = graph,
        .number = g_new0(uint32_t, count),
        .low = g_new(uint32_t, count),
        .next = g_new(uint32_t, count),
        .path = g_array_new(FALSE, FALSE, sizeof(uint32_t)),
        .open = g_array_new(FALSE, FALSE, sizeof(uint32_t)),
    };
    for (uint32_t c = 0; c < count; c++) {
        if (search.number[c] == 0) {
            search_from(&search, c);
        }
    }
    g_array_unref(search.path);
    g_array_unref(search.open);
    g_free(search.number);
    g_free(search.low);
    g_free(search.next);
    gather_members(found, graph);
    find_roots(found, graph);
    reach(found, graph);
}

void fr_recursions_clear(FrRecursions *found) {
    g_free(found->of);
    g_free(found->is_recursive);
    g_free(found->slot);
    g_free(found->slots);
    g_free(found->first_link);
    g_free(found->links);
    g_free(found->first_member);
    g_free(found->members);
    g_array_unref(found->roots);
    g_free(found->is_reached);
}

uint32_t fr_recursions_endless_link(const FrRecursions *found, const FrPgraph *graph) {
    // Takes away, again and again, what no link leads to any more (Kahn 1962). Counted prototypes
    // go first; what is left lies on or behind a way round without any of them.
    uint32_t count = fr_pgraph_count(graph);
    uint32_t *leading = g_new0(uint32_t, count);
    GArray *free_ones = g_array_new(FALSE, FALSE, sizeof(uint32_t));
#define FR_COUNTS(link)                                                                            \
    (found->of[(link)->from] == found->of[(link)->to] && found->slot[(link)->from] == FR_NONE &&   \
     found->slot[(link)->to] == FR_NONE)
    for (uint32_t k = 0; k < graph->links->len; k++) {
        const FrPgraphLink *link = fr_pgraph_link_at(graph, k);
        leading[link->to] += FR_COUNTS(link);
    }
    for (uint32_t c = 0; c < count; c++) {
        if (leading[c] == 0) {
            g_array_append_val(free_ones, c);
        }
    }
    for (uint32_t done = 0; done < free_ones->len; done++) {
        uint32_t c = g_array_index(free_ones, uint32_t, done);
        for (uint32_t k = found->first_link[c]; k < found->first_link[c + 1]; k++) {
            const FrPgraphLink *link = fr_pgraph_link_at(graph, found->links[k]);
            if (FR_COUNTS(link) && --leading[link->to] == 0) {
                g_array_append_val(free_ones, link->to);
            }
        }
    }
    uint32_t endless = FR_NONE;
    for (uint32_t k = 0; k < graph->links->len && endless == FR_NONE; k++) {
        const FrPgraphLink *link = fr_pgraph_link_at(graph, k);
        if (FR_COUNTS(link) && leading[link->from] > 0 && leading[link->to] > 0) {
            endless = k;
        }
    }
#undef FR_COUNTS
    g_array_unref(free_ones);
    g_free(leading);
    return endless;
}
