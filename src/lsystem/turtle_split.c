// The walk over a string in parts on several threads, with the bits of the walk in one piece.
//
// What a branch does to the turtle ends with it. So the pose where a part begins is found by a walk
// over what is open there and no branch that has ended before: a small part of a branching string.
// First all parts are searched for that, and their internodes and axes counted, side by side; then
// one walk over what stays open finds the poses; then each part is walked in full and writes its
// own rows of the plant. What reaches from one part into another is written at the end.
#include "lsystem/split.h"

#include "plant/columns.h"

#include <math.h>

enum {
    MOST_PARTS = 64,
    LEAST_WORDS = 1 << 16, // of a string that is worth it
    DEEPEST = 256          // brackets; each part keeps the poses of those around it
};

/// Whether the next segment begins an axis; that may depend on what was before the part.
typedef enum FrLfresh { FR_LFRESH_NO, FR_LFRESH_YES, FR_LFRESH_UNKNOWN } FrLfresh;

/// A piece of the string that stays open to the end of its part, without the branches in it.
typedef struct FrLopen {
    uint64_t word, end;
    uint32_t nodes, axes; ///< made in the part before it, but for axes of which it is not known
} FrLopen;

/// A branch that is open in a part, and how many pieces there were before it.
typedef struct FrLlevel {
    FrLfresh fresh;
    guint pieces;
} FrLlevel;

typedef struct FrLpart {
    uint64_t word, end, module, modules;
    // what the search finds
    bool is_plain; ///< nothing in it but what moves, turns and branches
    uint32_t nodes, axes;
    uint32_t pops;    ///< branches that end in it and have begun before it
    uint32_t deepest; ///< branches within each other that begin in it, over those at its begin
    GArray *draws;    ///< bool: for the level at its begin and each of the pops, whether it draws
                      ///< before it is known whether that begins an axis
    GArray *open;     ///< FrLopen
    // where it begins
    FrLpose pose;
    FrLpose *stack;
    FrLfoot *feet; ///< of the stack, then of the pose
    uint32_t depth;
    uint32_t first_node, first_axis;
    FrLbuilder builder;
} FrLpart;

typedef struct FrLsplit {
    FrLturtle *turtle;
    const FrLstring *string;
    FrLpart parts[MOST_PARTS];
    uint32_t count;
} FrLsplit;

static inline bool is_drawing(unsigned symbol) {
    return symbol == 'F' || symbol == 'G';
}

static inline bool is_moving(unsigned symbol) {
    return is_drawing(symbol) || symbol == 'f' || symbol == 'g';
}

// ---- the search --------------------------------------------------------------------------------

typedef struct FrLsearch {
    FrLpart *part;
    GArray *levels; ///< FrLlevel: branches that have begun in the part
    FrLfresh fresh;
    FrLopen piece;
} FrLsearch;

static void begin_piece(FrLsearch *search, uint64_t word) {
    search->piece =
        (FrLopen){.word = word, .nodes = search->part->nodes, .axes = search->part->axes};
}

static void end_piece(FrLsearch *search, uint64_t word) {
    if (word > search->piece.word) {
        search->piece.end = word;
        g_array_append_val(search->part->open, search->piece);
    }
}

static void search_move(FrLsearch *search, bool is_drawn) {
    FrLpart *part = search->part;
    if (is_drawn) {
        part->nodes++;
        part->axes += search->fresh == FR_LFRESH_YES;
        if (search->fresh == FR_LFRESH_UNKNOWN) {
            g_array_index(part->draws, bool, part->draws->len - 1) = true;
        }
    }
    search->fresh = is_drawn ? FR_LFRESH_NO : FR_LFRESH_YES;
}

static void search_open(FrLsearch *search, uint64_t word) {
    end_piece(search, word);
    FrLlevel level = {search->fresh, search->part->open->len};
    g_array_append_val(search->levels, level);
    search->part->deepest = MAX(search->part->deepest, search->levels->len);
    search->fresh = FR_LFRESH_YES;
    begin_piece(search, word);
}

static void search_close(FrLsearch *search, uint64_t behind) {
    FrLpart *part = search->part;
    if (search->levels->len > 0) {
        // Lengths are set by hand here: this is done for every branch.
        FrLlevel level = g_array_index(search->levels, FrLlevel, --search->levels->len);
        part->open->len = level.pieces;
        search->fresh = level.fresh;
    } else {
        static const bool nothing = false;
        part->pops++;
        g_array_append_val(part->draws, nothing);
        g_array_set_size(part->open, 0);
        search->fresh = FR_LFRESH_UNKNOWN;
    }
    begin_piece(search, behind);
}

static void search_part(const FrLsplit *split, FrLpart *part) {
    static const bool nothing = false;
    const uint32_t *words = split->string->words;
    const uint8_t *deeds = split->turtle->deeds;
    FrLsearch search = {.part = part,
                        .levels = g_array_new(FALSE, FALSE, sizeof(FrLlevel)),
                        .fresh = FR_LFRESH_UNKNOWN};
    part->is_plain = true;
    part->open = g_array_new(FALSE, FALSE, sizeof(FrLopen));
    part->draws = g_array_new(FALSE, FALSE, sizeof(bool));
    g_array_append_val(part->draws, nothing);
    begin_piece(&search, part->word);
    for (uint64_t at = part->word; at < part->end && part->is_plain; part->modules++) {
        const uint32_t *module = words + at;
        unsigned symbol = fr_lhead_symbol(*module);
        uint64_t next = at + 1 + fr_lhead_count(*module);
        if (symbol == '[') {
            search_open(&search, at);
        } else if (symbol == ']') {
            search_close(&search, next);
        } else if (is_moving(symbol)) {
            if (fr_lturtle_length(&split->turtle->pose, module) != 0) {
                search_move(&search, is_drawing(symbol));
            }
        } else {
            part->is_plain = deeds[symbol] == symbol || deeds[symbol] == 0;
        }
        at = next;
    }
    end_piece(&search, part->end);
    g_array_unref(search.levels);
}

static void search_parts(void *data, size_t begin, size_t end, int worker) {
    (void)worker;
    FrLsplit *split = data;
    for (size_t i = begin; i < end; i++) {
        search_part(split, &split->parts[i]);
    }
}

/// Cuts the string before brackets, where no segment is half done.
static void cut(FrLsplit *split) {
    const FrLstring *string = split->string;
    const GArray *marks = string->marks;
    guint wanted = MIN(MOST_PARTS, marks->len);
    uint64_t last = 0;
    split->parts[0] = (FrLpart){.word = 0};
    split->count = 1;
    for (guint i = 1; i < wanted; i++) {
        FrLmark mark = g_array_index(marks, FrLmark, (guint)((uint64_t)i * marks->len / wanted));
        while (mark.word < string->count) {
            unsigned symbol = fr_lhead_symbol(string->words[mark.word]);
            if (symbol == '[' || symbol == ']') {
                break;
            }
            mark.word += 1 + fr_lhead_count(string->words[mark.word]);
            mark.module++;
        }
        if (mark.word > last && mark.word < string->count) {
            split->parts[split->count - 1].end = last = mark.word;
            split->parts[split->count++] = (FrLpart){.word = mark.word, .module = mark.module};
        }
    }
    split->parts[split->count - 1].end = string->count;
}

/// Whether the parts can be walked apart, and are worth it; the rows that they need.
static bool is_fit(const FrLsplit *split, uint64_t *nodes) {
    uint64_t open = 0, depth = 0;
    *nodes = 0;
    for (uint32_t i = 0; i < split->count; i++) {
        const FrLpart *part = &split->parts[i];
        // A bracket too many leaves the turtle as it is.
        if (!part->is_plain || part->pops > depth || depth + part->deepest > DEEPEST) {
            return false;
        }
        for (guint k = 0; k < part->open->len; k++) {
            const FrLopen *piece = &g_array_index(part->open, FrLopen, k);
            const uint32_t *word = split->string->words + piece->word;
            open += piece->end - piece->word;
            depth += fr_lhead_symbol(*word) == '[';
        }
        depth -= part->pops;
        *nodes += part->nodes;
    }
    return open < split->string->count / 4;
}

// ---- what stays open ---------------------------------------------------------------------------

/// The walk that finds where parts begin.
typedef struct FrLspine {
    FrLturtle turtle;
    FrLfoot feet[DEEPEST + 1]; ///< of the turtle's stack, then of its pose
    uint32_t unknown_axes;     ///< of the part: that turned out to be begun
    bool is_unknown;           ///< whether the search knew no more here
} FrLspine;

static bool begins_axis(const FrLspine *spine) {
    return fr_lstand_node(spine->turtle.pose.stand) == FR_NONE ||
           (spine->turtle.pose.stand & ~FR_LSTAND_NODE) != FR_LSTAND_TIP;
}

static void walk_pops(FrLspine *spine, const FrLpart *part) {
    static const uint32_t bracket = ']';
    for (uint32_t k = 0; k < part->pops; k++) {
        spine->unknown_axes += g_array_index(part->draws, bool, k) && begins_axis(spine);
        fr_lturtle_take(&spine->turtle, &bracket, 0);
    }
}

/// A segment: its node and axis are known by counting.
static void walk_segment(FrLspine *spine, const uint32_t *module, uint32_t node, uint32_t axis) {
    FrLfoot *foot = &spine->feet[spine->turtle.depth];
    if (begins_axis(spine)) {
        bool is_first = fr_lstand_node(spine->turtle.pose.stand) == FR_NONE;
        foot->axis = axis;
        foot->order = is_first ? 0 : (uint16_t)(foot->order + (foot->order < UINT16_MAX));
    }
    foot->node = node;
    fr_lturtle_take(&spine->turtle, module, 0);
    spine->turtle.pose.stand = node | FR_LSTAND_TIP;
}

static void walk_piece(FrLspine *spine, const FrLstring *string, const FrLpart *part,
                       const FrLopen *piece) {
    uint32_t node = part->first_node + piece->nodes;
    uint32_t axis = part->first_axis + piece->axes + spine->unknown_axes;
    for (uint64_t at = piece->word; at < piece->end;) {
        const uint32_t *module = string->words + at;
        unsigned symbol = fr_lhead_symbol(*module);
        at += 1 + fr_lhead_count(*module);
        bool is_length = is_moving(symbol) && fr_lturtle_length(&spine->turtle.pose, module) != 0;
        if (is_length && is_drawing(symbol)) {
            bool begins = begins_axis(spine);
            spine->unknown_axes += begins && spine->is_unknown;
            walk_segment(spine, module, node++, axis);
            axis += begins;
        } else {
            fr_lturtle_take(&spine->turtle, module, 0);
        }
        spine->is_unknown &= !is_length && symbol != '[';
        if (symbol == '[') {
            spine->feet[spine->turtle.depth] = spine->feet[spine->turtle.depth - 1];
        }
    }
}

static void keep_begin(FrLpart *part, const FrLspine *spine) {
    const FrLturtle *turtle = &spine->turtle;
    part->pose = turtle->pose;
    part->depth = turtle->depth;
    part->stack = g_memdup2(turtle->stack, turtle->depth * sizeof *turtle->stack);
    part->feet = g_memdup2(spine->feet, (turtle->depth + 1) * sizeof *spine->feet);
}

/// Where each part begins; how many axes there are in all.
static uint32_t walk_open(FrLsplit *split) {
    FrLspine spine = {.feet = {{.node = FR_NONE}}};
    uint32_t nodes = 0, axes = 0;
    fr_lturtle_init(&spine.turtle, split->turtle->derivation, NULL, split->turtle->context);
    for (uint32_t i = 0; i < split->count; i++) {
        FrLpart *part = &split->parts[i];
        keep_begin(part, &spine);
        part->first_node = nodes;
        part->first_axis = axes;
        spine.unknown_axes = 0;
        spine.is_unknown = true;
        walk_pops(&spine, part);
        // A branch that has ended may have used up what was not known.
        for (guint k = 0; k < part->open->len; k++) {
            walk_piece(&spine, split->string, part, &g_array_index(part->open, FrLopen, k));
        }
        nodes += part->nodes;
        axes += part->axes + spine.unknown_axes;
    }
    fr_lturtle_clear(&spine.turtle);
    return axes;
}

// ---- the parts ---------------------------------------------------------------------------------

static void walk_part(const FrLsplit *split, FrLpart *part) {
    FrLturtle turtle;
    fr_lturtle_init(&turtle, split->turtle->derivation, &part->builder, split->turtle->context);
    turtle.pose = part->pose;
    turtle.stack = g_steal_pointer(&part->stack);
    turtle.depth = turtle.capacity = part->depth;
    fr_lturtle_walk(&turtle, split->string->words, part->word, part->end, part->module);
    fr_lturtle_end_node(&turtle);
    fr_lbuilder_settle_frames(&part->builder);
    part->builder.status = MAX(part->builder.status, turtle.status);
    fr_lturtle_clear(&turtle);
}

static void walk_parts(void *data, size_t begin, size_t end, int worker) {
    (void)worker;
    FrLsplit *split = data;
    for (size_t i = begin; i < end; i++) {
        walk_part(split, &split->parts[i]);
    }
}

static void begin_parts(FrLsplit *split, uint32_t nodes, uint32_t axes) {
    FrLbuilder *whole = split->turtle->builder;
    fr_columns_extend(&whole->plant->nodes, &fr_node_columns, nodes);
    fr_columns_extend(&whole->plant->axes, &fr_axis_columns, axes);
    for (uint32_t i = 0; i < split->count; i++) {
        FrLpart *part = &split->parts[i];
        bool is_last = i + 1 == split->count;
        part->builder = *whole;
        part->builder.nodes = part->builder.framed = part->builder.node_room = part->first_node;
        part->builder.axes = part->builder.axis_room = part->first_axis;
        part->builder.part = g_new(FrLbuilderPart, 1);
        *part->builder.part = (FrLbuilderPart){
            .first_node = part->first_node,
            .first_axis = part->first_axis,
            .end_node = is_last ? nodes : part[1].first_node,
            .end_axis = is_last ? axes : part[1].first_axis,
            .feet = part->feet,
            .feet_count = part->depth + 1,
            .ties = g_array_new(FALSE, FALSE, sizeof(FrLtie)),
        };
        part->builder.first_node = part->first_node;
    }
}

static void join(FrLsplit *split, uint32_t nodes, uint32_t axes) {
    FrLbuilder *whole = split->turtle->builder;
    FrLdrawn *drawn = &whole->drawn;
    whole->nodes = whole->framed = whole->node_room = nodes;
    whole->axes = whole->axis_room = axes;
    for (uint32_t i = 0; i < split->count; i++) {
        const FrLbuilder *part = &split->parts[i].builder;
        FR_ASSERT(part->status != FR_OK ||
                  (part->nodes == part->part->end_node && part->axes == part->part->end_axis));
        whole->status = MAX(whole->status, part->status);
        drawn->segments += part->drawn.segments;
        for (int k = 0; k < 3; k++) {
            drawn->min[k] = fmin(drawn->min[k], part->drawn.min[k]);
            drawn->max[k] = fmax(drawn->max[k], part->drawn.max[k]);
        }
    }
    for (uint32_t i = 0; i < split->count && whole->status == FR_OK; i++) {
        fr_lbuilder_join(whole, split->parts[i].builder.part);
    }
}

/// What was left to the end, because its order is that of all rows.
static void sum_up(FrLbuilder *builder) {
    const FrNodes *nodes = &builder->plant->nodes;
    uint32_t *component = builder->plant->axes.component;
    for (uint32_t i = 0; i < builder->nodes; i++) {
        double length = (double)nodes->length[i];
        bool is_drawn = length * length > 1e-5 && nodes->radius[i] > 0;
        builder->drawn.length += is_drawn ? length : 0;
    }
    for (uint32_t a = 0; a < builder->axes; a++) {
        component[a] = fr_lbuilder_component(builder, component[a]);
    }
}

static void clear(FrLsplit *split) {
    for (uint32_t i = 0; i < split->count; i++) {
        FrLpart *part = &split->parts[i];
        g_array_unref(part->open);
        g_array_unref(part->draws);
        g_free(part->stack);
        g_free(part->feet);
        if (part->builder.part != NULL) {
            g_array_unref(part->builder.part->ties);
            g_free(part->builder.part);
        }
    }
    g_free(split);
}

bool fr_lturtle_read_split(FrLturtle *turtle, const FrLstring *string) {
    const FrLbuilder *builder = turtle->builder;
    FrPool *pool = turtle->context->pool;
    bool is_whole = builder->palette != NULL || builder->origins != NULL || turtle->has_sites;
    if (fr_pool_threads(pool) < 2 || string->count < LEAST_WORDS || is_whole) {
        return false;
    }
    FrLsplit *split = g_new0(FrLsplit, 1);
    split->turtle = turtle;
    split->string = string;
    cut(split);
    fr_parallel_for(pool, split->count, 1, search_parts, split, NULL);
    uint64_t nodes, most = MIN(turtle->context->limits.nodes, FR_NONE - UINT64_C(1));
    bool is_split = split->count > 1 && is_fit(split, &nodes) && nodes <= most && nodes > 0;
    if (is_split) {
        uint32_t axes = walk_open(split);
        begin_parts(split, (uint32_t)nodes, axes);
        fr_parallel_for(pool, split->count, 1, walk_parts, split,
                        NULL); // each looks for cancelling
        join(split, (uint32_t)nodes, axes);
        if (fr_progress_is_cancelled(turtle->context->progress)) {
            turtle->status = FR_CANCELLED;
        } else {
            sum_up(turtle->builder);
        }
        turtle->modules += string->modules;
    }
    clear(split);
    return is_split;
}
