// Tree to code. Constants are folded, functions are written out where they are called, and what
// can be read where it stands (constants, variables) is not copied to the stack first.
#include "expr/builtin.h"
#include "expr/code.h"
#include "expr/lexer.h"
#include "expr/tree.h"

#include <math.h>

// Where the value of a node is: nothing is written for it until someone needs it on the stack.
typedef struct Operand {
    enum { NUMBER, VARIABLE, EXTRA, SLOT, TOP } kind;
    uint32_t index;
    double number;
} Operand;

// The tree whose nodes are being read, and where the arguments of its parameters are.
typedef struct Frame {
    const FrTree *tree;
    const Operand *arguments; // NULL: they are extra variables
} Frame;

typedef struct Generator {
    GArray *code, *spans, *constants;
    GPtrArray *curves, *sources;
    FrDiags *diags;
    FrSpan whole;
    uint32_t variables, draws;
    bool is_random, uses_extra;
    unsigned height; // values on the stack
    unsigned depth, work;
    bool has_failed;
} Generator;

static Operand generate(Generator *g, const Frame *frame, uint32_t index);

static const Operand on_top = {.kind = TOP};

static Operand constant(double value) {
    return (Operand){.kind = NUMBER, .number = value};
}

static FrSpan span_of(const Frame *frame, const FrNode *node) {
    return fr_place(frame->tree->span, node->begin, node->end);
}

static void fail(Generator *g, const char *code, const char *why) {
    if (!g->has_failed) {
        fr_diags_add(g->diags, FR_ERROR, code, g->whole, "%s", why);
    }
    g->has_failed = true;
}

// ---- instructions -----------------------------------------------------------------------------

// Returns where it stands, for jumps to be completed.
static guint emit(Generator *g, FrOp op, uint32_t argument, FrSpan span) {
    FrInstruction instruction = {.op = (uint8_t)op, .argument = (uint16_t)argument};
    g_array_append_val(g->code, instruction);
    g_array_append_val(g->spans, span);
    return g->code->len - 1;
}

static void land(Generator *g, guint jump) {
    g_array_index(g->code, FrInstruction, jump).argument = (uint16_t)g->code->len;
}

static uint32_t keep_number(Generator *g, double value) {
    g_array_append_val(g->constants, value);
    return g->constants->len - 1;
}

// Brings a value to the top of the stack.
static void load(Generator *g, Operand operand, FrSpan span) {
    switch (operand.kind) {
    case NUMBER:
        emit(g, FR_OP_CONSTANT, keep_number(g, operand.number), span);
        break;
    case VARIABLE:
        emit(g, FR_OP_VARIABLE, operand.index, span);
        break;
    case EXTRA:
        emit(g, FR_OP_EXTRA, operand.index, span);
        break;
    case SLOT:
        emit(g, FR_OP_SLOT, operand.index, span);
        break;
    case TOP:
        return;
    }
    if (++g->height >= FR_STACK_SIZE) {
        fail(g, "expression-nesting", "the expression needs too many values at a time");
    }
}

static void generate_to_top(Generator *g, const Frame *frame, uint32_t index) {
    Operand operand = generate(g, frame, index);
    load(g, operand, span_of(frame, fr_tree_node(frame->tree, index)));
}

// ---- operations -------------------------------------------------------------------------------

// The forms of + − × ÷, of which the right (or, reversed, the left) operand is read in place.
static const struct {
    FrOp plain, number, variable, reversed_number, reversed_variable;
} forms[] = {
    {FR_OP_ADD, FR_OP_ADD_C, FR_OP_ADD_V, FR_OP_ADD_C, FR_OP_ADD_V},
    {FR_OP_SUBTRACT, FR_OP_SUBTRACT_C, FR_OP_SUBTRACT_V, FR_OP_SUBTRACT_REVERSED_C,
     FR_OP_SUBTRACT_REVERSED_V},
    {FR_OP_MULTIPLY, FR_OP_MULTIPLY_C, FR_OP_MULTIPLY_V, FR_OP_MULTIPLY_C, FR_OP_MULTIPLY_V},
    {FR_OP_DIVIDE, FR_OP_DIVIDE_C, FR_OP_DIVIDE_V, FR_OP_DIVIDE_REVERSED_C,
     FR_OP_DIVIDE_REVERSED_V},
};

// One of the operands is on top, or neither; tries to read the other in place.
static bool combine_in_place(Generator *g, FrOp op, Operand left, Operand right, FrSpan span) {
    bool is_reversed = right.kind == TOP;
    Operand other = is_reversed ? left : right;
    if (other.kind != NUMBER && other.kind != VARIABLE) {
        return false;
    }
    for (size_t i = 0; i < G_N_ELEMENTS(forms); i++) {
        if (forms[i].plain == op) {
            if (!is_reversed) {
                load(g, left, span);
            }
            bool is_number = other.kind == NUMBER;
            FrOp form = is_reversed
                            ? (is_number ? forms[i].reversed_number : forms[i].reversed_variable)
                            : (is_number ? forms[i].number : forms[i].variable);
            emit(g, form, is_number ? keep_number(g, other.number) : other.index, span);
            return true;
        }
    }
    return false;
}

static Operand power_of_constant(Generator *g, Operand base, double exponent, FrSpan span) {
    load(g, base, span);
    if (exponent == 2 || exponent == 3) {
        emit(g, exponent == 2 ? FR_OP_SQUARE : FR_OP_CUBE, 0, span);
    } else {
        load(g, constant(exponent), span);
        emit(g, FR_OP_POWER, 0, span);
        g->height--;
    }
    return on_top;
}

// Loads a left operand that waited until the right one was on top, so that they stand in the wrong
// order; returns the operation that makes up for it.
static FrOp load_below(Generator *g, FrOp op, Operand left, FrSpan span) {
    load(g, left, span);
    switch (op) {
    case FR_OP_ADD:
    case FR_OP_MULTIPLY:
    case FR_OP_EQUAL:
    case FR_OP_NOT_EQUAL:
        return op;
    case FR_OP_LESS:
        return FR_OP_GREATER;
    case FR_OP_LESS_EQUAL:
        return FR_OP_GREATER_EQUAL;
    case FR_OP_GREATER:
        return FR_OP_LESS;
    case FR_OP_GREATER_EQUAL:
        return FR_OP_LESS_EQUAL;
    default:
        emit(g, FR_OP_SWAP, 0, span);
        return op;
    }
}

static Operand generate_unary(Generator *g, const Frame *frame, const FrNode *node) {
    FrSpan span = span_of(frame, node);
    FrOp op = node->kind == FR_NODE_TRUTH ? FR_OP_TRUTH : (FrOp)node->index;
    Operand operand = generate(g, frame, node->first);
    if (operand.kind == NUMBER) {
        return constant(fr_operate(op, operand.number, 0));
    }
    load(g, operand, span);
    emit(g, op, 0, span);
    return on_top;
}

static Operand generate_operation(Generator *g, const Frame *frame, const FrNode *node) {
    uint32_t second = fr_tree_node(frame->tree, node->first)->next;
    if (second == FR_NONE) {
        return generate_unary(g, frame, node);
    }
    FrOp op = (FrOp)node->index;
    FrSpan span = span_of(frame, node);
    Operand left = generate(g, frame, node->first);
    Operand right = generate(g, frame, second);
    if (left.kind == NUMBER && right.kind == NUMBER) {
        double value = fr_operate(op, left.number, right.number);
        if (isfinite(value)) {
            return constant(value);
        }
    }
    if (op == FR_OP_POWER && right.kind == NUMBER) {
        return power_of_constant(g, left, right.number, span);
    }
    if (combine_in_place(g, op, left, right, span)) {
        return on_top;
    }
    if (left.kind != TOP && right.kind == TOP) {
        op = load_below(g, op, left, span);
    } else {
        load(g, left, span);
        load(g, right, span);
    }
    emit(g, op, 0, span);
    g->height--;
    return on_top;
}

// ---- branches and calls -----------------------------------------------------------------------

static Operand generate_condition(Generator *g, const Frame *frame, const FrNode *node) {
    FrSpan span = span_of(frame, node);
    uint32_t yes = fr_tree_node(frame->tree, node->first)->next;
    uint32_t no = fr_tree_node(frame->tree, yes)->next;
    Operand test = generate(g, frame, node->first);
    if (test.kind == NUMBER) {
        return generate(g, frame, test.number != 0 ? yes : no);
    }
    load(g, test, span);
    guint to_no = emit(g, FR_OP_JUMP_IF_ZERO, 0, span);
    g->height--;
    generate_to_top(g, frame, yes);
    guint to_end = emit(g, FR_OP_JUMP, 0, span);
    land(g, to_no);
    g->height--;
    generate_to_top(g, frame, no);
    land(g, to_end);
    return on_top;
}

// rand() without an argument is numbered by where it stands, so that each is another draw.
static Operand generate_draw(Generator *g, const Frame *frame, const FrNode *node, bool is_normal) {
    FrSpan span = span_of(frame, node);
    g->is_random = true;
    if (node->first != FR_NONE) {
        generate_to_top(g, frame, node->first);
        emit(g, is_normal ? FR_OP_NORMAL_AT : FR_OP_RANDOM_AT, 0, span);
        return on_top;
    }
    emit(g, is_normal ? FR_OP_NORMAL : FR_OP_RANDOM, g->draws++, span);
    if (++g->height >= FR_STACK_SIZE) {
        fail(g, "expression-nesting", "the expression needs too many values at a time");
    }
    return on_top;
}

static Operand generate_builtin(Generator *g, const Frame *frame, const FrNode *node) {
    const FrBuiltin *builtin = &fr_builtins[node->index];
    if (builtin->kind != FR_BUILTIN_FUNCTION) {
        return generate_draw(g, frame, node, builtin->kind == FR_BUILTIN_NORMAL);
    }
    guint code_before = g->code->len;
    unsigned height_before = g->height;
    double numbers[FR_MOST_ARGUMENTS];
    unsigned count = 0;
    bool all_numbers = true;
    for (uint32_t child = node->first; child != FR_NONE;
         child = fr_tree_node(frame->tree, child)->next) {
        Operand operand = generate(g, frame, child);
        all_numbers = all_numbers && operand.kind == NUMBER;
        numbers[count++] = operand.number;
        load(g, operand, span_of(frame, node));
    }
    if (all_numbers) {
        double value = builtin->function(numbers, count);
        if (isfinite(value)) {
            g_array_set_size(g->code, code_before);
            g_array_set_size(g->spans, code_before);
            g->height = height_before;
            return constant(value);
        }
    }
    guint call = emit(g, FR_OP_CALL, node->index, span_of(frame, node));
    g_array_index(g->code, FrInstruction, call).count = (uint8_t)count;
    g->height -= count - 1;
    return on_top;
}

static Operand generate_curve(Generator *g, const Frame *frame, const FrNode *node) {
    FrCurve *curve = g_ptr_array_index(frame->tree->curves, node->index);
    Operand place = generate(g, frame, node->first);
    if (place.kind == NUMBER) {
        double value = fr_curve_eval(curve, place.number);
        if (isfinite(value)) {
            return constant(value);
        }
    }
    load(g, place, span_of(frame, node));
    g_ptr_array_add(g->curves, fr_curve_ref(curve));
    emit(g, FR_OP_CURVE, g->curves->len - 1, span_of(frame, node));
    return on_top;
}

static void keep_source(Generator *g, FrSource *source) {
    if (source != NULL && !g_ptr_array_find(g->sources, source, NULL)) {
        g_ptr_array_add(g->sources, fr_source_ref(source));
    }
}

// Arguments are computed once, below the body; the body reads them there. There is no recursion:
// a function only knows those defined before it.
static Operand generate_function(Generator *g, const Frame *frame, const FrNode *node) {
    const FrFunction *function = g_ptr_array_index(frame->tree->functions, node->index);
    FrSpan span = span_of(frame, node);
    Operand arguments[FR_MOST_ARGUMENTS];
    unsigned height_before = g->height;
    unsigned count = 0;
    for (uint32_t child = node->first; child != FR_NONE;
         child = fr_tree_node(frame->tree, child)->next) {
        arguments[count] = generate(g, frame, child);
        if (arguments[count].kind == TOP) {
            arguments[count] = (Operand){.kind = SLOT, .index = g->height};
        }
        count++;
    }
    keep_source(g, function->tree->span.source);
    Frame body = {.tree = function->tree, .arguments = arguments};
    Operand result = generate(g, &body, function->tree->root);
    unsigned computed = g->height - height_before - (result.kind == TOP ? 1 : 0);
    if (computed == 0) {
        return result;
    }
    load(g, result, span);
    emit(g, FR_OP_SLIDE, computed, span);
    g->height -= computed;
    return on_top;
}

// ---- the whole --------------------------------------------------------------------------------

static Operand generate_node(Generator *g, const Frame *frame, const FrNode *node) {
    switch (node->kind) {
    case FR_NODE_NUMBER:
        return constant(node->number);
    case FR_NODE_VARIABLE:
        g->variables |= UINT32_C(1) << node->index;
        return (Operand){.kind = VARIABLE, .index = node->index};
    case FR_NODE_ARGUMENT:
        if (frame->arguments != NULL) {
            return frame->arguments[node->index];
        }
        g->uses_extra = true;
        return (Operand){.kind = EXTRA, .index = node->index};
    case FR_NODE_OPERATION:
        return generate_operation(g, frame, node);
    case FR_NODE_TRUTH:
        return generate_unary(g, frame, node);
    case FR_NODE_CONDITION:
        return generate_condition(g, frame, node);
    case FR_NODE_BUILTIN:
        return generate_builtin(g, frame, node);
    case FR_NODE_FUNCTION:
        return generate_function(g, frame, node);
    case FR_NODE_CURVE:
        return generate_curve(g, frame, node);
    }
    return constant(0);
}

// Functions that call each other can ask for exponentially much: the work is counted.
static Operand generate(Generator *g, const Frame *frame, uint32_t index) {
    if (++g->work > FR_EXPR_WORK) {
        fail(g, "expression-size", "the expression with the functions it calls is too large");
    }
    if (g->depth >= FR_EXPR_DEPTH) {
        fail(g, "expression-nesting", "functions call each other too deep");
    }
    if (g->has_failed) {
        return constant(0);
    }
    g->depth++;
    Operand result = generate_node(g, frame, fr_tree_node(frame->tree, index));
    g->depth--;
    return result;
}

FrExpr *fr_code_generate(const FrTree *tree, FrDiags *diags) {
    Generator g = {
        .code = g_array_new(FALSE, FALSE, sizeof(FrInstruction)),
        .spans = g_array_new(FALSE, FALSE, sizeof(FrSpan)),
        .constants = g_array_new(FALSE, FALSE, sizeof(double)),
        .curves = g_ptr_array_new(),
        .sources = g_ptr_array_new(),
        .diags = diags,
        .whole = tree->span,
    };
    keep_source(&g, tree->span.source);
    Frame frame = {.tree = tree};
    generate_to_top(&g, &frame, tree->root);
    const FrNode *root = fr_tree_node(tree, tree->root);
    emit(&g, FR_OP_END, 0, span_of(&frame, root));
    FrExpr *expr = g_new0(FrExpr, 1);
    expr->references = 1;
    expr->code_count = g.code->len;
    expr->constant_count = g.constants->len;
    expr->curve_count = g.curves->len;
    expr->source_count = g.sources->len;
    expr->variables = g.variables;
    expr->is_random = g.is_random;
    expr->uses_extra = g.uses_extra;
    expr->code = (FrInstruction *)(void *)g_array_free(g.code, FALSE);
    expr->spans = (FrSpan *)(void *)g_array_free(g.spans, FALSE);
    expr->constants = (double *)(void *)g_array_free(g.constants, FALSE);
    expr->curves = (FrCurve **)g_ptr_array_free(g.curves, FALSE);
    expr->sources = (FrSource **)g_ptr_array_free(g.sources, FALSE);
    if (g.has_failed) {
        fr_expr_unref(expr);
        return NULL;
    }
    return expr;
}
