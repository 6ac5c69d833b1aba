/// @file lsystem/parse.h
/// What the parts of the parser share. It reads characters, not tokens: what a character means
/// depends on whether modules or an expression are being read.
#pragma once

#include "lsystem/program.h"

typedef struct FrLparser {
    FrLsystem *system;
    const FrLtext *text;
    const char *bytes; ///< of the text, ending with a zero byte
    size_t at, size;
    const FrContext *context;
    FrLunit *unit;
    GHashTable *locals;     ///< of the production: name → variable + 1; NULL outside
    const FrLvalue *values; ///< set from outside
    size_t value_count;
    bool *is_used;       ///< of each of them
    GHashTable *formals; ///< names bound by its predecessor, a subset of locals
    size_t barrier;      ///< code before it may not be folded: something jumps there
    uint32_t depth;      ///< of nested expressions and blocks
    int stack;           ///< values that the code so far leaves on the stack
    bool is_block;       ///< newlines are blanks
    bool is_leaf;        ///< the expression read last is a number or a name
    bool is_impure;      ///< what was compiled so far writes, draws or prints
    bool is_round;       ///< round brackets branch
    bool has_failed;     ///< within this line
    uint32_t errors;
    GHashTable *names;    ///< name of a production → how many have it
    const char *function; ///< name of that whose definition is being read, NULL outside
} FrLparser;

void fr_lparse_error(FrLparser *parser, size_t begin, size_t end, const char *code,
                     const char *format, ...) FR_PRINTF(5, 6);
void fr_lparse_warning(FrLparser *parser, size_t begin, size_t end, const char *code,
                       const char *format, ...) FR_PRINTF(5, 6);
/// Skips blanks, and a newline that is followed by a tab; in blocks every newline.
void fr_lparse_blanks(FrLparser *parser);
/// The next character behind blanks, '\0' at the end.
char fr_lparse_peek(FrLparser *parser);
/// Takes `text` if it comes next.
bool fr_lparse_accept(FrLparser *parser, const char *text);
/// Takes `text` or complains.
bool fr_lparse_expect(FrLparser *parser, const char *text);
/// Takes a name; NULL if there is none. Free with g_free().
char *fr_lparse_name(FrLparser *parser);
bool fr_lparse_at_line_end(FrLparser *parser);
/// Leaves the rest of the line and its continuations.
void fr_lparse_skip_line(FrLparser *parser);

// ---- parse_expression.c -----------------------------------------------------------------------

/// The indices of an array, whose values are left on the stack; how many. `begin`: of its name.
uint32_t fr_lparse_indices(FrLparser *parser, uint32_t array, size_t begin);
/// The next character of an expression, '\\0' at the end. cpfg reads over `\` there, which long
/// macros leave behind.
char fr_lparse_peek_value(FrLparser *parser);
/// A number, name, call or bracket, with the signs before it.
void fr_lparse_unary(FrLparser *parser);
/// Lets the jump at `jump` lead to the code that comes next.
void fr_lparse_land(FrLparser *parser, uint32_t jump);
uint32_t fr_lparse_code_here(const FrLparser *parser);
void fr_lparse_emit(FrLparser *parser, FrLop op, uint32_t a, uint32_t n, double value, size_t at);
/// The variable of a name: local, then global; made where it is not known. `is_new` may be NULL.
uint32_t fr_lparse_variable(FrLparser *parser, const char *name, bool is_assigned, size_t at);
uint32_t fr_lparse_new_variable(FrLparser *parser, uint64_t count, size_t at);
/// A quoted text; its number in the table of strings, FR_NONE if there is none.
uint32_t fr_lparse_string(FrLparser *parser);
/// The array of that name, or FR_NONE.
uint32_t fr_lparse_find_array(FrLparser *parser, const char *name);

// ---- parse_operators.c ------------------------------------------------------------------------

/// Compiles an expression; its value is on the stack.
void fr_lparse_expression(FrLparser *parser);
/// An expression as a piece of code of its own.
uint32_t fr_lparse_value(FrLparser *parser);

// ---- parse_statement.c ------------------------------------------------------------------------

/// { statements }, compiled as a piece of code of its own.
uint32_t fr_lparse_block(FrLparser *parser);
/// define: { array a[3] = {1, 2, 3}; external v; }
void fr_lparse_define(FrLparser *parser);

// ---- parse_modules.c --------------------------------------------------------------------------

/// Modules with expressions as parameters, up to the end of the line or `stop`.
typedef struct FrLmodules {
    uint32_t words, word_count, modules, values;
} FrLmodules;
FrLmodules fr_lparse_modules(FrLparser *parser);
/// A production; appends it to the section. `label` may be NULL and is taken.
void fr_lparse_production(FrLparser *parser, FrLsection *section, char *label);
