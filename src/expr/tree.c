#include "expr/tree.h"

FrTree *fr_tree_new(FrSpan span) {
    FrTree *tree = g_new0(FrTree, 1);
    tree->span = span;
    if (span.source != NULL) {
        fr_source_ref(span.source);
    }
    tree->nodes = g_array_new(FALSE, FALSE, sizeof(FrNode));
    tree->curves = g_ptr_array_new_with_free_func((GDestroyNotify)fr_curve_unref);
    tree->functions = g_ptr_array_new();
    tree->root = FR_NONE;
    return tree;
}

void fr_tree_free(FrTree *tree) {
    if (tree == NULL) {
        return;
    }
    fr_source_unref(tree->span.source);
    g_array_unref(tree->nodes);
    g_ptr_array_unref(tree->curves);
    g_ptr_array_unref(tree->functions);
    g_free(tree);
}

uint32_t fr_tree_add(FrTree *tree, FrNodeKind kind, uint32_t index, size_t begin, size_t end) {
    FrNode node = {
        .kind = kind,
        .index = index,
        .first = FR_NONE,
        .next = FR_NONE,
        .depth = 1,
        .begin = (uint32_t)begin,
        .end = (uint32_t)end,
    };
    g_array_append_val(tree->nodes, node);
    return tree->nodes->len - 1;
}

void fr_tree_adopt(FrTree *tree, uint32_t node, uint32_t child) {
    FrNode *parent = fr_tree_node(tree, node);
    uint32_t *link = &parent->first;
    while (*link != FR_NONE) {
        link = &fr_tree_node(tree, *link)->next;
    }
    *link = child;
    parent->depth = MAX(parent->depth, fr_tree_node(tree, child)->depth + 1);
}

FrTree *fr_tree_curve(FrCurve *curve, FrSpan span) {
    FrTree *tree = fr_tree_new(span);
    size_t size = span.end - span.begin;
    g_ptr_array_add(tree->curves, fr_curve_ref(curve));
    tree->root = fr_tree_add(tree, FR_NODE_CURVE, 0, 0, size);
    fr_tree_adopt(tree, tree->root, fr_tree_add(tree, FR_NODE_VARIABLE, FR_VAR_t, 0, size));
    return tree;
}
