/// @file lsystem/program.h
/// The compiled form of an L-system: code for expressions, patterns, templates of successors.
///
/// A string is one array of 32-bit words. A module is a head (symbol, number of parameters and 16
/// bits of its own) followed by one float for each parameter:
///
///     ┌ head: symbol │ count │ mark ┐ ┌ float ┐ ┌ float ┐ ┌ head …
///       8 bits        8       16
///
/// The mark of `?` with parameters is the instance of the sub-L-system it calls, 0 for a new one;
/// that of any other module the production it comes from, from 1, and 0 for the axiom.
#pragma once

#include "frond/lsystem.h"
#include "lsystem/text.h"

#include <string.h>

#define FR_LHEAD_KEY 0xFFFFU
#define FR_LSYMBOLS 128

static inline uint32_t fr_lhead(unsigned symbol, unsigned count) {
    return (uint32_t)symbol | (uint32_t)count << 8;
}
static inline unsigned fr_lhead_symbol(uint32_t head) {
    return head & 0xFF;
}
static inline unsigned fr_lhead_count(uint32_t head) {
    return head >> 8 & 0xFF;
}
static inline unsigned fr_lhead_mark(uint32_t head) {
    return head >> 16;
}
/// Whether a module calls an L-system, so that its mark is an instance.
static inline bool fr_lhead_calls(uint32_t head) {
    return fr_lhead_symbol(head) == '?' && fr_lhead_count(head) > 0;
}
static inline float fr_lword_float(uint32_t word) {
    float value;
    memcpy(&value, &word, sizeof value);
    return value;
}
static inline uint32_t fr_lword(double value) {
    float single = (float)value;
    uint32_t word;
    memcpy(&word, &single, sizeof word);
    return word;
}

/// An open parameter: this NaN and no other.
#define FR_LOPEN 0x7FC0F00DU

typedef enum FrLop {
    FR_LOP_END,
    FR_LOP_CONST,       ///< push value
    FR_LOP_VAR,         ///< push variable a
    FR_LOP_STORE,       ///< pop to variable a
    FR_LOP_INDEX,       ///< pop the indices of array a, push its element
    FR_LOP_INDEX_STORE, ///< pop value, then the indices of array a; store
    FR_LOP_DROP,
    FR_LOP_NEGATE,
    FR_LOP_NOT,
    FR_LOP_ADD,
    FR_LOP_SUBTRACT,
    FR_LOP_MULTIPLY,
    FR_LOP_DIVIDE,
    FR_LOP_MODULO,
    FR_LOP_POWER,
    FR_LOP_AND, ///< 0 or 1; both sides have been computed
    FR_LOP_OR,
    FR_LOP_LESS,
    FR_LOP_LESS_EQUAL,
    FR_LOP_GREATER,
    FR_LOP_GREATER_EQUAL,
    FR_LOP_EQUAL,
    FR_LOP_UNEQUAL,
    FR_LOP_TRUTH,          ///< top becomes 0 or 1
    FR_LOP_JUMP,           ///< to a
    FR_LOP_BACK,           ///< to a, counted against endless loops
    FR_LOP_JUMP_ZERO,      ///< pop, to a if it is 0
    FR_LOP_JUMP_TRUE,      ///< to a if the top is true as a byte, and keep it
    FR_LOP_CALL,           ///< built-in function a with n arguments
    FR_LOP_PRINT,          ///< printf with text a and n arguments
    FR_LOP_SCAN_BEGIN,     ///< pop a file, read from it by text a
    FR_LOP_SCAN_NEXT,      ///< the top becomes the next number, if there is one
    FR_LOP_SCAN_END,       ///< push how many there were
    FR_LOP_USER,           ///< function a of the file, n arguments
    FR_LOP_PUT,            ///< pop to word a of the successor
    FR_LOP_VAR_MULTIPLY,   ///< top times variable a
    FR_LOP_CONST_MULTIPLY, ///< top times value
} FrLop;

typedef struct FrLcode {
    uint16_t op;
    uint16_t n;
    uint32_t a;
    double value;
} FrLcode;

/// A formal parameter: the variable it is bound to, or a number it must equal.
typedef struct FrLformal {
    uint32_t variable; ///< FR_NONE: a literal
    float literal;
} FrLformal;

/// A module of a predecessor or context.
typedef struct FrLpattern {
    uint32_t key;    ///< as the low bits of a head
    uint32_t formal; ///< first of its formals
} FrLpattern;

typedef struct FrLpatterns {
    uint32_t first, count;
} FrLpatterns;

typedef struct FrLproduction {
    FrLpatterns left, strict, right;
    uint32_t before, condition, after; ///< code, FR_NONE: none
    uint32_t weight;                   ///< code, FR_NONE: 1
    uint32_t words, word_count;        ///< template of the successor
    uint32_t modules;                  ///< of the successor
    uint32_t values;                   ///< code that puts its parameters; FR_NONE: all constant
    bool is_pure;                      ///< writes nothing, draws no number, prints nothing
    bool is_plain;                     ///< one strict module, no context, no condition, no blocks
    FrSpan span;
    char *name; ///< owned; its label or its text up to the arrow
} FrLproduction;

/// Productions by the symbol their strict predecessor begins with.
typedef struct FrLsection {
    GArray *list;                    ///< uint32_t: productions, in order
    uint32_t start[FR_LSYMBOLS + 1]; ///< into `sorted`
    uint32_t *sorted;                ///< production indices by first symbol, in order
    uint32_t depth;                  ///< code of `maximum depth`, FR_NONE
    uint32_t seed;                   ///< code, FR_NONE
    bool warns;
    bool has_context;
} FrLsection;

enum { FR_LDERIVE, FR_LDECOMPOSE, FR_LHOMOMORPHISM, FR_LSECTIONS };
enum { FR_LSTART, FR_LSTART_EACH, FR_LEND_EACH, FR_LEND, FR_LBLOCKS };

typedef struct FrLarray {
    uint32_t first; ///< variable
    uint32_t size;
    uint32_t dimensions[8];
    uint32_t dimension_count;
} FrLarray;

/// A variable that belongs to the caller of a sub-L-system.
typedef struct FrLexternal {
    char *name; ///< owned
    uint32_t variable, size;
} FrLexternal;

/// One `Lsystem: id` … `endlsystem`.
typedef struct FrLunit {
    int64_t id;
    FrLsection sections[FR_LSECTIONS];
    uint32_t blocks[FR_LBLOCKS];                ///< code, FR_NONE
    GArray *initializers;                       ///< uint32_t: code that fills arrays before Start
    uint32_t seed, length;                      ///< code, FR_NONE
    uint32_t axiom, axiom_words, axiom_modules; ///< template
    uint32_t axiom_values;                      ///< code, FR_NONE
    FrSpan axiom_span;
    uint32_t variables;  ///< number of them
    GHashTable *globals; ///< name → variable + 1
    GArray *externals;   ///< FrLexternal
    bool is_ignored[FR_LSYMBOLS];
    bool is_ring;
    bool is_stochastic; ///< has seed:, or weights in the notation of papers
} FrLunit;

/// A function that the file defines: f(i) = expression.
typedef struct FrLfunction {
    char *name;     ///< owned
    uint32_t first; ///< variable of its first formal; the others follow
    uint32_t count;
    uint32_t code;
    uint64_t calls; ///< of functions that one call makes, itself included
} FrLfunction;

/// Variables of every L-system; behind them come the values set from outside.
enum { FR_LVAR_Q, FR_LVAR_Z, FR_LVAR_FIRST };

struct FrLsystem {
    FrLtext *text;
    GArray *code;        ///< FrLcode
    GArray *places;      ///< uint32_t: where in the text, one for each code
    GArray *patterns;    ///< FrLpattern
    GArray *formals;     ///< FrLformal
    GArray *words;       ///< uint32_t: templates
    GArray *productions; ///< FrLproduction
    GArray *arrays;      ///< FrLarray
    GArray *functions;   ///< FrLfunction
    GPtrArray *strings;  ///< char *, owned
    GPtrArray *units;    ///< FrLunit *, owned
    GArray *values;      ///< double: set from outside, variables from FR_LVAR_FIRST on
    char *folder;        ///< owned; where files are read from, NULL: nowhere
    bool is_open;        ///< asks an environment or the turtle
    bool asks_space;     ///< … for free space
    bool has_cut;        ///< % occurs
    bool has_at;         ///< @ occurs, so that more of the turtle's state may change
    bool is_paper;       ///< written in the notation of papers
};

/// Finds a built-in function: FR_NONE or its number; how many arguments it takes.
uint32_t fr_lbuiltin_find(const char *name, uint32_t *least, uint32_t *most);
/// False for those that draw random numbers, stop or say something.
bool fr_lbuiltin_is_pure(uint32_t function);
/// Functions of cpfg that are left out: they are read, warned about, and give 0.
bool fr_lbuiltin_is_left_out(uint32_t function);
