// The syntax tree of an expression: what parse.c makes and generate.c reads.
#pragma once

#include "frond/expr.h"

#include "expr/code.h"

/// Limits that keep a hostile text from costing more than it is long.
enum {
    FR_EXPR_LONGEST = 65536, ///< bytes of text
    FR_EXPR_NESTING = 200,   ///< parentheses and operators inside one another
    FR_EXPR_DEPTH = 1000,    ///< of the tree, with the functions called in it
    FR_EXPR_WORK = 16384,    ///< tree nodes visited while code is made
};

typedef enum FrNodeKind {
    FR_NODE_NUMBER,
    FR_NODE_VARIABLE,  ///< index: FrVar
    FR_NODE_ARGUMENT,  ///< index: extra variable or parameter of the function
    FR_NODE_OPERATION, ///< index: FrOp; one or two children
    FR_NODE_CONDITION, ///< three children
    FR_NODE_TRUTH,     ///< 1 if the child is not 0
    FR_NODE_BUILTIN,   ///< index: into fr_builtins
    FR_NODE_FUNCTION,  ///< index: into the tree's functions
    FR_NODE_CURVE,     ///< index: into the tree's curves; one child
} FrNodeKind;

typedef struct FrNode {
    FrNodeKind kind;
    uint32_t index;
    uint32_t first; ///< child, FR_NONE
    uint32_t next;  ///< sibling, FR_NONE
    uint32_t depth; ///< 1 for a leaf
    uint32_t begin, end;
    double number;
} FrNode;

typedef struct FrTree {
    FrSpan span;          ///< of the text; its source is kept alive
    GArray *nodes;        ///< FrNode
    GPtrArray *curves;    ///< FrCurve, owned references
    GPtrArray *functions; ///< FrFunction, borrowed from the scope
    uint32_t root;
} FrTree;

/// A function defined by the user.
typedef struct FrFunction {
    char *name;
    char **parameters; ///< ends with NULL
    uint32_t count;
    FrTree *tree;
} FrFunction;

FrTree *fr_tree_new(FrSpan span);
void fr_tree_free(FrTree *tree);
/// Appends a node without children.
uint32_t fr_tree_add(FrTree *tree, FrNodeKind kind, uint32_t index, size_t begin, size_t end);
/// Appends `child` as the last child of `node`.
void fr_tree_adopt(FrTree *tree, uint32_t node, uint32_t child);

static inline FrNode *fr_tree_node(const FrTree *tree, uint32_t index) {
    return &g_array_index(tree->nodes, FrNode, index);
}

/// Text to tree. NULL and diagnostics if it is wrong.
FrTree *fr_tree_parse(const char *text, FrSpan span, const FrScope *scope,
                      const char *const *arguments, size_t count, FrDiags *diags);
/// The variable of that name.
bool fr_variable_find(const char *name, FrVar *variable);
/// A tree that is the curve at t.
FrTree *fr_tree_curve(FrCurve *curve, FrSpan span);

/// Tree to code. NULL and a diagnostic if it would become too large.
FrExpr *fr_code_generate(const FrTree *tree, FrDiags *diags);

/// The expression "this curve at t", whose text is the curve's name.
FrExpr *fr_expr_of_curve(FrCurve *curve, const char *text, FrSpan span);

// ---- scope ------------------------------------------------------------------------------------

const FrFunction *fr_scope_function(const FrScope *scope, const char *name);
/// As fr_scope_curve(); a name with `_` also finds the curve with `-`.
FrCurve *fr_scope_find_curve(const FrScope *scope, const char *name);
/// Adds the names of numbers to `names`, in any order.
void fr_scope_list_values(const FrScope *scope, GPtrArray *names);
/// Adds the names of functions to `names`.
void fr_scope_list_functions(const FrScope *scope, GPtrArray *names);
/// Adds the names of curves, also built-in ones, to `names`.
void fr_scope_list_curves(const FrScope *scope, GPtrArray *names);
