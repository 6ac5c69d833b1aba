// What a compiled file says that is allowed and yet unlikely to be meant: symbols that have no
// effect, modules with a number of parameters that no production knows, branches without an end.
#include "lsystem/warn.h"

#include <math.h>

/// How many parameters the predecessors of each symbol have: bit n for n of them.
typedef struct Warner {
    const FrLsystem *system;
    FrDiags *diags;
    uint64_t known[FR_LSYMBOLS];
    GHashTable *told; ///< texts of symbols left out, heads of odd modules
} Warner;

/// Symbols that the turtle reads over: `@L` labels, `@I` and so on.
static const char *left_out(char symbol) {
    static const struct {
        char symbol;
        const char *what;
    } symbols[] = {{'L', "@L: labels are not drawn"},
                   {'I', "@I: nothing is included"},
                   {'J', "@J: nothing is included"},
                   {'S', "@S: no commands are run"},
                   {';', "@;: surfaces have the same colour on both sides"},
                   {',', "@,: surfaces have the same colour on both sides"}};
    for (size_t i = 0; i < G_N_ELEMENTS(symbols); i++) {
        if (symbol == symbols[i].symbol) {
            return symbols[i].what;
        }
    }
    return NULL;
}

/// `A(1)` where all productions of A have two parameters.
static void check_count(Warner *warner, uint32_t head, FrSpan span) {
    unsigned symbol = fr_lhead_symbol(head), count = fr_lhead_count(head);
    uint64_t known = symbol < FR_LSYMBOLS ? warner->known[symbol] : 0;
    bool is_odd = known != 0 && count < 64 && (known >> count & 1) == 0;
    gpointer key = GUINT_TO_POINTER((head & FR_LHEAD_KEY) + 1);
    if (!is_odd || !g_hash_table_add(warner->told, key)) {
        return;
    }
    unsigned least = 0;
    while ((known >> least & 1) == 0) {
        least++;
    }
    fr_diags_add(warner->diags, FR_WARNING, "parameter-count", span,
                 "'%c' stands here with %u parameter%s, and no production knows that; there is one "
                 "for %u",
                 (char)symbol, count, count == 1 ? "" : "s", least);
}

/// Whether a call leads nowhere: to a label that nobody has, or where there is only one L-system.
static bool is_lost(const Warner *warner, uint32_t head) {
    const GPtrArray *units = warner->system->units;
    double id = fr_lword_float(g_array_index(warner->system->words, uint32_t, head + 1));
    bool is_lost = id != 0 || units->len == 1; // 0 may wait for what an expression gives
    for (guint u = 0; u < units->len && units->len > 1; u++) {
        is_lost &= (double)((const FrLunit *)g_ptr_array_index(units, u))->id != trunc(id);
    }
    return is_lost && !warner->system->is_paper;
}

static void check_template(Warner *warner, uint32_t first, uint32_t count, FrSpan span) {
    char before = '\0', before_that = '\0';
    for (uint32_t at = 0; at < count;) {
        uint32_t head = g_array_index(warner->system->words, uint32_t, first + at);
        char symbol = (char)fr_lhead_symbol(head);
        const char *what = before == '@' ? left_out(symbol) : NULL;
        if (before_that == '@' && before == 'T' && symbol == 'x') {
            what = "@Tx: textures are not drawn";
        }
        if (what != NULL && g_hash_table_add(warner->told, (gpointer)what)) {
            fr_diags_add(warner->diags, FR_WARNING, "left-out", span, "%s", what);
        }
        if (fr_lhead_calls(head) && is_lost(warner, first + at)) {
            fr_diags_add(warner->diags, FR_WARNING, "unknown-call", span,
                         "there is no L-system of that label; the call does nothing");
        }
        bool is_raw = before == '@' || before == '~' || before == '?' || before_that == '@';
        if (g_ascii_isalpha(symbol) && !is_raw) {
            check_count(warner, head, span);
        }
        before_that = before;
        before = fr_lhead_count(head) == 0 ? symbol : '\0';
        at += 1 + fr_lhead_count(head);
    }
}

static void note_predecessors(Warner *warner) {
    const GArray *productions = warner->system->productions;
    for (guint i = 0; i < productions->len; i++) {
        const FrLproduction *production = &g_array_index(productions, FrLproduction, i);
        for (uint32_t k = 0; k < production->strict.count; k++) {
            uint32_t key =
                g_array_index(warner->system->patterns, FrLpattern, production->strict.first + k)
                    .key;
            unsigned symbol = fr_lhead_symbol(key), count = fr_lhead_count(key);
            // What the turtle draws and turns by has meanings with and without a number.
            if (symbol < FR_LSYMBOLS && count < 64 && strchr("FfGg", (int)symbol) == NULL) {
                warner->known[symbol] |= UINT64_C(1) << count;
            }
        }
    }
}

/// How many more branches a template opens than it closes.
static int64_t opens_of(const FrLsystem *system, uint32_t first, uint32_t count) {
    int64_t opens = 0;
    for (uint32_t at = 0; at < count;) {
        uint32_t head = g_array_index(system->words, uint32_t, first + at);
        opens += (fr_lhead_symbol(head) == '[') - (fr_lhead_symbol(head) == ']');
        at += 1 + fr_lhead_count(head);
    }
    return opens;
}

/// The same for a production: what its predecessor opens is no surplus of its successor.
static int64_t opens_more(const FrLsystem *system, const FrLproduction *production) {
    int64_t opens = opens_of(system, production->words, production->word_count);
    for (uint32_t i = 0; i < production->strict.count; i++) {
        uint32_t key =
            g_array_index(system->patterns, FrLpattern, production->strict.first + i).key;
        opens -= (fr_lhead_symbol(key) == '[') - (fr_lhead_symbol(key) == ']');
    }
    return opens;
}

static void tell_brackets(Warner *warner, int64_t opens, FrSpan span) {
    if (opens != 0) {
        fr_diags_add(warner->diags, FR_WARNING, "bracket", span,
                     opens > 0 ? "a branch begins here with '[' and no ']' ends it"
                               : "here is a ']' and no '[' before it that it could end");
    }
}

/// One production may open what another closes; so only where the file lacks brackets of one kind.
static void check_brackets(Warner *warner) {
    const FrLsystem *system = warner->system;
    bool opens = false, closes = false;
    for (int pass = 0; pass < 2 && !(opens && closes); pass++) {
        for (guint u = 0; u < system->units->len; u++) {
            const FrLunit *unit = g_ptr_array_index(system->units, u);
            int64_t more = opens_of(system, unit->axiom, unit->axiom_words);
            opens |= more > 0;
            closes |= more < 0;
            tell_brackets(warner, pass == 0 ? 0 : more, unit->axiom_span);
        }
        for (guint i = 0; i < system->productions->len; i++) {
            const FrLproduction *production = &g_array_index(system->productions, FrLproduction, i);
            int64_t more = opens_more(system, production);
            opens |= more > 0;
            closes |= more < 0;
            tell_brackets(warner, pass == 0 ? 0 : more, production->span);
        }
    }
}

void fr_lwarn(const FrLsystem *system, FrDiags *diags) {
    Warner warner = {.system = system, .diags = diags, .told = g_hash_table_new(NULL, NULL)};
    note_predecessors(&warner);
    for (guint u = 0; u < system->units->len; u++) {
        const FrLunit *unit = g_ptr_array_index(system->units, u);
        check_template(&warner, unit->axiom, unit->axiom_words, unit->axiom_span);
    }
    for (guint i = 0; i < system->productions->len; i++) {
        const FrLproduction *production = &g_array_index(system->productions, FrLproduction, i);
        check_template(&warner, production->words, production->word_count, production->span);
    }
    check_brackets(&warner);
    g_hash_table_unref(warner.told);
}
