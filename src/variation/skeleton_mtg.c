// Lines of a multiscale tree graph (.mtg): an entity with coordinates is the end of a line that
// begins at the entity it hangs on.
// After: Godin, Caraglio. A Multiscale Model of Plant Topological Structures. Journal of
// Theoretical Biology 191, 1998; the text is that of AMAPmod and OpenAlea.
//
// The column of an entity says what it hangs on: with `^` the last entity of its own column, else
// the last of the nearest column before. Labels may name several scales at once, `/P1/A1/I1`; the
// features of a line are those of its last.
#include "variation/skeleton_mtg.h"

#include <math.h>
#include <string.h>

enum { MAX_COLUMNS = 4096 }; ///< of entities

typedef enum Feature { FEATURE_X, FEATURE_Y, FEATURE_Z, FEATURE_RADIUS, FEATURES } Feature;

typedef struct Mtg {
    const FrSource *source;
    const char *text;
    FrDiags *diags;
    FrStatus status;
    int columns;                 ///< of entities
    int feature[FEATURES];       ///< their columns, −1
    double radius_factor;        ///< 1/2 where the file has diameters
    bool has_point[MAX_COLUMNS]; ///< the last entity of each column …
    vec3s point[MAX_COLUMNS];    ///< … and where it is
    GArray *lines;               ///< FrSegment
} Mtg;

static void report(Mtg *mtg, size_t begin, size_t end, const char *code, const char *text) {
    FrSpan span = {(FrSource *)mtg->source, (uint32_t)begin, (uint32_t)end};
    fr_diags_add(mtg->diags, FR_ERROR, code, span, "%s", text);
    mtg->status = FR_ERR_DOCUMENT;
}

/// The cell of that column in the line [begin, end), without blanks around. False if there is none.
static bool find_cell(const char *text, size_t begin, size_t end, int column, size_t *from,
                      size_t *to) {
    size_t at = begin;
    for (int c = 0; c < column; c++) {
        const char *tab = memchr(text + at, '\t', end - at);
        if (tab == NULL) {
            return false;
        }
        at = (size_t)(tab - text) + 1;
    }
    const char *tab = memchr(text + at, '\t', end - at);
    size_t stop = tab != NULL ? (size_t)(tab - text) : end;
    while (at < stop && g_ascii_isspace(text[at])) {
        at++;
    }
    while (stop > at && g_ascii_isspace(text[stop - 1])) {
        stop--;
    }
    *from = at;
    *to = stop;
    return stop > at;
}

static bool is_word(const char *text, size_t from, size_t to, const char *word) {
    return to - from == strlen(word) && g_ascii_strncasecmp(text + from, word, to - from) == 0;
}

/// The line that names the columns: entities first, then features.
static void read_title(Mtg *mtg, size_t begin, size_t end) {
    static const char *const names[] = {"xx", "yy", "zz", "radius", "diameter"};
    size_t from, to;
    int cells = 1;
    for (size_t at = begin; at < end; at++) {
        cells += mtg->text[at] == '\t';
    }
    mtg->columns = 0;
    mtg->radius_factor = 1;
    for (int c = 1; c < cells; c++) {
        if (!find_cell(mtg->text, begin, end, c, &from, &to)) {
            continue;
        }
        mtg->columns = mtg->columns == 0 ? c : mtg->columns;
        for (int name = 0; name < (int)G_N_ELEMENTS(names); name++) {
            if (is_word(mtg->text, from, to, names[name])) {
                mtg->feature[MIN(name, (int)FEATURE_RADIUS)] = c;
                mtg->radius_factor = name > (int)FEATURE_RADIUS ? 0.5 : mtg->radius_factor;
            }
        }
    }
    if (mtg->feature[FEATURE_X] < 0 || mtg->feature[FEATURE_Y] < 0 || mtg->feature[FEATURE_Z] < 0) {
        report(mtg, begin, end, "mtg-coordinates",
               "a graph becomes lines by its features XX, YY and ZZ, which it lacks");
    } else if (mtg->columns > MAX_COLUMNS) {
        report(mtg, begin, end, "mtg-columns", "more than 4096 columns of entities");
    }
}

/// A number of a line; NAN where its cell is empty. What is no number is reported.
static double read_number(Mtg *mtg, size_t begin, size_t end, Feature feature) {
    size_t from, to;
    if (mtg->feature[feature] < 0 ||
        !find_cell(mtg->text, begin, end, mtg->feature[feature], &from, &to)) {
        return NAN;
    }
    char *stop;
    double value = g_ascii_strtod(mtg->text + from, &stop);
    if (stop != mtg->text + to || !isfinite(value) || fabs(value) > 1e9) {
        report(mtg, from, to, "mtg-number", "expected a number between -1e9 and 1e9");
        return NAN;
    }
    return value;
}

/// Where an entity in that column hangs: the column of the point it goes on from, −1.
static int find_bearer(const Mtg *mtg, int column, bool goes_on) {
    if (goes_on) {
        return mtg->has_point[column] ? column : -1;
    }
    int bearer = column - 1;
    while (bearer >= 0 && !mtg->has_point[bearer]) {
        bearer--;
    }
    return bearer;
}

static void read_entity(Mtg *mtg, size_t begin, size_t end) {
    size_t from = begin, to = end;
    int column = 0;
    while (column < mtg->columns && !find_cell(mtg->text, begin, end, column, &from, &to)) {
        column++;
    }
    if (column == mtg->columns) {
        report(mtg, begin, end, "mtg-entity", "a line without an entity");
        return;
    }
    if (strchr("/<+^", mtg->text[from]) == NULL) {
        report(mtg, from, to, "mtg-entity", "an entity begins with /, <, + or ^");
        return;
    }
    int bearer = find_bearer(mtg, column, mtg->text[from] == '^');
    vec3s tip;
    bool has_tip = true;
    for (int k = 0; k < 3; k++) {
        double value = read_number(mtg, begin, end, (Feature)k);
        has_tip = has_tip && !isnan(value);
        tip.raw[k] = isnan(value) ? 0 : (float)value;
    }
    double radius = read_number(mtg, begin, end, FEATURE_RADIUS);
    bool is_wood = mtg->feature[FEATURE_RADIUS] < 0 || !isnan(radius);
    if (has_tip && is_wood && bearer >= 0) {
        float thick = isnan(radius) ? 0.01F : (float)(fabs(radius) * mtg->radius_factor);
        FrSegment line = {mtg->point[bearer], tip, thick};
        g_array_append_val(mtg->lines, line);
    }
    mtg->has_point[column] = has_tip && (is_wood || bearer < 0); // a plant has a place, no wood
    mtg->point[column] = tip;
    memset(mtg->has_point + column + 1, 0, (size_t)(mtg->columns - column - 1) * sizeof(bool));
}

static bool begins_with(const char *text, size_t begin, size_t end, const char *word) {
    return end - begin >= strlen(word) && strncmp(text + begin, word, strlen(word)) == 0;
}

/// Reads line by line: the header up to MTG: is skipped, then comes the title, then entities.
static void read_lines(Mtg *mtg, size_t length, const FrContext *context) {
    enum { HEADER, TITLE, ENTITIES } part = HEADER;
    for (size_t begin = 0, next; begin < length && fr_diags_error_count(mtg->diags) < 20;
         begin = next) {
        size_t end = begin, blank = begin; // bytes, not words: a file may be long
        while (end < length && mtg->text[end] != '\r' && mtg->text[end] != '\n') {
            end++;
        }
        while (blank < end && (mtg->text[blank] == ' ' || mtg->text[blank] == '\t')) {
            blank++;
        }
        next = end + 1;
        if (blank >= end || mtg->text[blank] == '#') {
            continue;
        }
        if (part == HEADER) {
            part = begins_with(mtg->text, begin, end, "MTG") ? TITLE : HEADER;
        } else if (part == TITLE) {
            read_title(mtg, begin, end);
            part = ENTITIES;
            if (mtg->status != FR_OK) {
                return;
            }
        } else {
            read_entity(mtg, begin, end);
        }
        if (mtg->lines->len > context->limits.nodes) {
            return; // the caller refuses that many
        }
    }
    if (part != ENTITIES) {
        report(mtg, 0, MIN(length, 1), "mtg-section",
               "no section MTG: with its line of columns; is this a multiscale tree graph?");
    }
}

FrStatus fr_skeleton_read_mtg(const FrSource *source, const FrContext *context,
                              FrSegment **segments, size_t *count) {
    size_t size;
    const char *text = fr_source_text(source, &size);
    Mtg *mtg = g_new0(Mtg, 1);
    *mtg = (Mtg){.source = source, .text = text, .diags = context->diags, .status = FR_OK};
    mtg->lines = g_array_new(FALSE, FALSE, sizeof(FrSegment));
    for (int f = 0; f < (int)FEATURES; f++) {
        mtg->feature[f] = -1;
    }
    size_t length = strlen(text);
    if (length < size) {
        report(mtg, length, length + 1, "mtg-section", "a graph is text; this is a zero byte");
    } else {
        read_lines(mtg, length, context);
    }
    FrStatus status = mtg->status;
    *count = status == FR_OK ? mtg->lines->len : 0;
    *segments = (FrSegment *)(void *)g_array_free(mtg->lines, status != FR_OK);
    g_free(mtg);
    return status;
}
