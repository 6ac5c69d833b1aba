/// Where the plants of a document stand: each by hand, in rows, strewn over areas.
#include "scene/placing.h"

#include "pgraph/bluenoise.h"

#include <math.h>

/// Draws by the key of a plant in a row or an area.
enum { DRAW_PLANT = 1000, DRAW_SEED, DRAW_SCATTER };

/// What is being placed.
typedef struct Placing {
    const FrContext *context;
    GHashTable *plants; ///< id → FrPlantDef *
    GArray *placed;     ///< FrPlaced
} Placing;

static FrKey key_of(FrKey key, const double at[3]) {
    for (int k = 0; k < 3; k++) {
        union {
            double number;
            uint64_t bits;
        } place = {.number = at[k]};
        key = fr_key_child(key, place.bits);
    }
    return key;
}

// ---- by hand ----------------------------------------------------------------------------------

static FrStatus add_place(Placing *placing, const FrPlace *place) {
    const FrPlantDef *plant =
        place->plant == NULL ? NULL : g_hash_table_lookup(placing->plants, place->plant);
    if (plant == NULL) {
        fr_diags_add(placing->context->diags, FR_ERROR, "unknown-plant", place->span,
                     "no plant to stand here");
        return FR_ERR_DOCUMENT;
    }
    FrPlaced placed = {
        .plant = plant,
        .stand = {.at = {(double)place->at.x, (double)place->at.y, (double)place->at.z},
                  .turn = place->turn,
                  .scale = place->scale,
                  .origin = fr_span_outermost(place->span).begin},
        .seed = place->seed,
        .span = place->span};
    placed.key = place->seed >= 0 ? fr_key_child(fr_key_root((uint64_t)place->seed), 0)
                                  : fr_key_name(plant->id);
    placed.key = key_of(placed.key, placed.stand.at);
    g_array_append_val(placing->placed, placed);
    return FR_OK;
}

// ---- what rows and areas share ------------------------------------------------------------------

/// A row or an area, by what both have.
typedef struct Spread {
    const GArray *mix;
    const FrPlantDef **plants; ///< of the mix
    double whole;              ///< all shares
    uint64_t seed, individuals;
    const FrNumber *turn, *scale;
    uint64_t count;     ///< of plants, at most
    const GArray *gaps; ///< uint32_t, ascending: plants that are left out
    FrSpan span;
} Spread;

static FrStatus begin_spread(const Placing *placing, Spread *spread) {
    spread->plants = g_new0(const FrPlantDef *, spread->mix->len + 1);
    for (guint i = 0; i < spread->mix->len; i++) {
        const FrMixPart *part = &g_array_index(spread->mix, FrMixPart, i);
        spread->plants[i] = g_hash_table_lookup(placing->plants, part->plant);
        spread->whole += part->share;
        if (spread->plants[i] == NULL) {
            fr_diags_add(placing->context->diags, FR_ERROR, "unknown-plant", spread->span,
                         "there is no plant '%.64s'", part->plant);
            return FR_ERR_DOCUMENT;
        }
    }
    if (spread->mix->len == 0) {
        fr_diags_add(placing->context->diags, FR_ERROR, "unknown-plant", spread->span,
                     "no plant to stand here");
        return FR_ERR_DOCUMENT;
    }
    uint64_t wanted = fr_count_add(placing->placed->len, spread->count);
    return fr_limit_check(wanted, placing->context->limits.plants, "plants", "the scene",
                          spread->span, placing->context->diags);
}

static guint draw_part(const Spread *spread, FrKey key) {
    double lot = fr_random(key, DRAW_PLANT, 0) * spread->whole;
    guint part = 0;
    while (part + 1 < spread->mix->len) {
        lot -= g_array_index(spread->mix, FrMixPart, part).share;
        if (lot < 0) {
            break;
        }
        part++;
    }
    return part;
}

static int compare_numbers(const void *a, const void *b) {
    uint32_t left = *(const uint32_t *)a, right = *(const uint32_t *)b;
    return left == right ? 0 : left < right ? -1 : 1;
}

static bool is_left_out(const Spread *spread, uint64_t index) {
    uint32_t number = (uint32_t)index;
    return spread->gaps->len > 0 && index < UINT32_MAX &&
           bsearch(&number, spread->gaps->data, spread->gaps->len, sizeof number,
                   compare_numbers) != NULL;
}

/// Adds plant `index` of `count`, unless it is left out, where a row or an area has a place for it.
static void add_spread(Placing *placing, const Spread *spread, uint64_t index, const double at[3],
                       double turn) {
    if (is_left_out(spread, index)) {
        return;
    }
    FrKey key = fr_key_child(fr_key_root(spread->seed), index);
    guint part = draw_part(spread, key);
    FrVars vars = {.key = key};
    vars.value[FR_VAR_i] = (double)index;
    vars.value[FR_VAR_n] = (double)spread->count;
    vars.value[FR_VAR_t] = spread->count > 1 ? (double)index / (double)(spread->count - 1) : 0;
    FrPlaced placed = {.plant = spread->plants[part],
                       .stand = {.at = {at[0], at[1], at[2]},
                                 .origin = fr_span_outermost(spread->span).begin,
                                 .number = (uint32_t)index},
                       .span = spread->span};
    placed.stand.turn = turn + fr_number_eval(spread->turn, &vars, 0, NULL);
    placed.stand.scale = fr_number_eval(spread->scale, &vars, 1, NULL);
    uint64_t individual = spread->individuals == 0
                              ? fr_random_bits(key, DRAW_SEED, 0)
                              : fr_random_bits(key, DRAW_SEED, 0) % spread->individuals;
    placed.seed = (int64_t)(fr_key_child(fr_key_root(spread->seed), individual) & UINT32_MAX);
    placed.key = key_of(key, at);
    g_array_append_val(placing->placed, placed);
}

// ---- rows -------------------------------------------------------------------------------------

/// The line of a row: straight pieces or a curve.
typedef struct Line {
    const FrStroke *stroke;
    FrPath *path; ///< NULL: straight
    double length;
} Line;

static Line open_line(const FrRow *row) {
    Line line = {.stroke = row->along, .length = fr_stroke_length(row->along)};
    if (row->line == FR_LINE_SMOOTH) {
        size_t count;
        const FrStrokePoint *points = fr_stroke_points(row->along, &count);
        vec3s *at = g_new(vec3s, count);
        for (size_t i = 0; i < count; i++) {
            at[i] = points[i].at;
        }
        line.path = fr_path_new(at, count);
        line.length = line.path != NULL ? fr_path_length(line.path) : line.length;
        g_free(at);
    }
    return line;
}

static void line_at(const Line *line, double distance, double point[3], double along[2]) {
    double direction[3];
    if (line->path == NULL) {
        fr_stroke_at(line->stroke, distance, point, direction);
    } else {
        vec3s at, tangent;
        fr_path_at(line->path, distance, &at, &tangent);
        for (int k = 0; k < 3; k++) {
            point[k] = (double)at.raw[k];
            direction[k] = (double)tangent.raw[k];
        }
    }
    double level = hypot(direction[0], direction[1]);
    along[0] = level > 0 ? direction[0] / level : 1;
    along[1] = level > 0 ? direction[1] / level : 0;
}

/// As many as stand in a row of this length.
static uint64_t count_along(double length, double spacing) {
    // A last place that rounding has put beyond the end counts.
    double count = floor(length / spacing + 1e-6) + 1;
    return count < 1e18 ? (uint64_t)count : UINT64_MAX;
}

static void add_in_row(Placing *placing, const Spread *spread, const FrRow *row, const Line *line,
                       uint64_t k, uint64_t side) {
    bool is_shifted = row->staggered && side % 2 == 1;
    double distance = ((double)k + (is_shifted ? 0.5 : 0)) * row->spacing;
    if (distance > line->length + 1e-6 * row->spacing) {
        return;
    }
    double at[3], along[2];
    line_at(line, distance, at, along);
    double aside = ((double)side - 0.5 * (double)(row->rows - 1)) * row->between;
    // Its number stays when rows are added.
    uint64_t index = side * (spread->count / (uint64_t)row->rows) + k;
    FrKey key = fr_key_child(fr_key_root(spread->seed), index);
    double off = row->scatter * sqrt(fr_random(key, DRAW_SCATTER, 0));
    double turn = 2 * G_PI * fr_random(key, DRAW_SCATTER, 1);
    at[0] += -along[1] * aside + off * cos(turn);
    at[1] += along[0] * aside + off * sin(turn);
    add_spread(placing, spread, index, at, atan2(along[1], along[0]));
}

static FrStatus add_row(Placing *placing, const FrRow *row) {
    if (row->along == NULL) {
        return FR_ERR_DOCUMENT;
    }
    Line line = open_line(row);
    uint64_t along = count_along(line.length, row->spacing);
    Spread spread = {.mix = row->mix,
                     .seed = (uint64_t)row->seed,
                     .individuals = (uint64_t)row->individuals,
                     .turn = &row->turn,
                     .scale = &row->scale,
                     .count = fr_count_multiply(along, (uint64_t)row->rows),
                     .gaps = row->gaps,
                     .span = row->span};
    FrStatus status = begin_spread(placing, &spread);
    for (uint64_t i = 0; i < spread.count && status == FR_OK; i++) {
        add_in_row(placing, &spread, row, &line, i % along, i / along);
    }
    fr_path_unref(line.path);
    g_free(spread.plants);
    return status;
}

// ---- areas ------------------------------------------------------------------------------------

/// An area within the square from −1 to 1 over its longer side.
typedef struct Area {
    const FrStrew *strew;
    double half; ///< of its longer side, m
    double width, depth;
} Area;

/// Brightness of a picture's pixels around a place in it, from 0 to 1 each, bilinear.
static double brightness_at(const FrImage *picture, double u, double v) {
    double x = u * picture->width - 0.5, y = v * picture->height - 0.5, sum = 0;
    for (int corner = 0; corner < 4; corner++) {
        double column = floor(x) + (corner & 1), row = floor(y) + (corner >> 1);
        double weight = (1 - fabs(x - column)) * (1 - fabs(y - row));
        size_t at = (size_t)CLAMP(row, 0, picture->height - 1) * picture->width +
                    (size_t)CLAMP(column, 0, picture->width - 1);
        const uint8_t *pixel = picture->pixels + at * picture->channels;
        double grey = picture->channels == 1
                          ? pixel[0]
                          : 0.2126 * pixel[0] + 0.7152 * pixel[1] + 0.0722 * pixel[2];
        sum += weight * grey / 255;
    }
    return sum;
}

static double density_at(const void *data, const double point[2]) {
    const Area *area = data;
    double x = point[0] * 2 * area->half / area->width;
    double y = point[1] * 2 * area->half / area->depth;
    if (area->strew->area == FR_STREW_DISC && x * x + y * y > 1) {
        return 0;
    }
    const FrImage *picture = area->strew->picture;
    return picture == NULL ? 1 : brightness_at(picture, 0.5 * (1 + x), 0.5 * (1 - y));
}

/// Leaves out points that are nearer to one before them than the spacing.
static void drop_near(double (*points)[2], uint32_t count, double spacing) {
    GHashTable *cells = g_hash_table_new_full(g_int64_hash, g_int64_equal, g_free, NULL);
    uint32_t *next = g_new(uint32_t, MAX(count, 1));
    for (uint32_t i = 0; i < count; i++) {
        if (isnan(points[i][0])) {
            continue;
        }
        int64_t column = (int64_t)floor(points[i][0] / spacing);
        int64_t row = (int64_t)floor(points[i][1] / spacing);
        bool is_near = false;
        for (int k = 0; k < 9 && !is_near; k++) {
            int64_t cell = (row + k / 3 - 1) * 0x100000000 + (column + k % 3 - 1);
            uint32_t found = GPOINTER_TO_UINT(g_hash_table_lookup(cells, &cell));
            for (; found != 0 && !is_near; found = next[found - 1]) {
                is_near = hypot(points[found - 1][0] - points[i][0],
                                points[found - 1][1] - points[i][1]) < spacing;
            }
        }
        if (is_near) {
            points[i][0] = points[i][1] = NAN;
            continue;
        }
        int64_t cell = row * 0x100000000 + column;
        next[i] = GPOINTER_TO_UINT(g_hash_table_lookup(cells, &cell));
        g_hash_table_insert(cells, g_memdup2(&cell, sizeof cell), GUINT_TO_POINTER(i + 1));
    }
    g_hash_table_unref(cells);
    g_free(next);
}

static void add_points(Placing *placing, const Spread *spread, const Area *area,
                       double (*points)[2]) {
    const FrStrew *strew = area->strew;
    double sine = sin(strew->aside), cosine = cos(strew->aside);
    for (uint64_t i = 0; i < spread->count; i++) {
        if (!isnan(points[i][0])) {
            double x = points[i][0] * area->half, y = points[i][1] * area->half;
            double at[3] = {(double)strew->at.x + cosine * x - sine * y,
                            (double)strew->at.y + sine * x + cosine * y, (double)strew->at.z};
            add_spread(placing, spread, i, at, strew->aside);
        }
    }
}

static FrStatus add_strew(Placing *placing, const FrStrew *strew) {
    Spread spread = {.mix = strew->mix,
                     .seed = (uint64_t)strew->seed,
                     .individuals = (uint64_t)strew->individuals,
                     .turn = &strew->turn,
                     .scale = &strew->scale,
                     .count = (uint64_t)strew->number,
                     .gaps = strew->gaps,
                     .span = strew->span};
    FrStatus status = begin_spread(placing, &spread);
    if (status == FR_OK) {
        double(*points)[2] = g_malloc_n(MAX(spread.count, 1), sizeof *points);
        Area area = {strew, 0.5 * fmax(strew->width, strew->depth), strew->width, strew->depth};
        FrStrewnDensity density = {
            {0.5 * area.width / area.half, 0.5 * area.depth / area.half}, density_at, &area};
        fr_bluenoise(points, (uint32_t)spread.count, FR_STREWN_SQUARE, 0, (uint32_t)strew->evenness,
                     fr_key_root(spread.seed), &density, placing->context->progress);
        if (strew->spacing > 0) {
            drop_near(points, (uint32_t)spread.count, strew->spacing / area.half);
        }
        guint before = placing->placed->len;
        add_points(placing, &spread, &area, points);
        if (placing->placed->len == before && spread.count > 0 && strew->gaps->len == 0) {
            fr_diags_add(placing->context->diags, FR_WARNING, "no-room", strew->span,
                         "no plant finds a place in this area");
        }
        g_free(points);
    }
    g_free(spread.plants);
    return status;
}

/// Heights of places count from the ground.
static void stand_on(const FrHills *hills, GArray *placed) {
    for (guint i = 0; hills != NULL && i < placed->len; i++) {
        double *at = g_array_index(placed, FrPlaced, i).stand.at, height;
        at[2] += fr_hills_height(hills, at[0], at[1], &height) ? height : 0;
    }
}

FrStatus fr_scene_places(const FrDocument *document, const FrHills *hills, const FrContext *context,
                         GArray **placed) {
    Placing placing = {context, g_hash_table_new(g_str_hash, g_str_equal),
                       g_array_new(FALSE, FALSE, sizeof(FrPlaced))};
    const GPtrArray *plants = fr_document_plants(document);
    for (guint i = 0; i < plants->len; i++) {
        FrPlantDef *plant = g_ptr_array_index(plants, i);
        g_hash_table_insert(placing.plants, plant->id, plant);
    }
    const GPtrArray *places = fr_document_places(document);
    const GPtrArray *rows = fr_document_rows(document);
    const GPtrArray *strews = fr_document_strews(document);
    FrStatus status = FR_OK;
    if (places->len > 0) {
        const FrPlace *first = g_ptr_array_index(places, 0);
        status = fr_limit_check(places->len, context->limits.plants, "plants", "the scene",
                                first->span, context->diags);
    }
    for (guint i = 0; i < places->len && status == FR_OK; i++) {
        status = add_place(&placing, g_ptr_array_index(places, i));
    }
    for (guint i = 0; i < rows->len && status == FR_OK; i++) {
        status = add_row(&placing, g_ptr_array_index(rows, i));
    }
    for (guint i = 0; i < strews->len && status == FR_OK; i++) {
        status = add_strew(&placing, g_ptr_array_index(strews, i));
    }
    g_hash_table_unref(placing.plants);
    stand_on(hills, placing.placed);
    if (status != FR_OK) {
        g_array_unref(placing.placed);
        placing.placed = NULL;
    }
    *placed = placing.placed;
    return status;
}

bool fr_scene_find_placed(const FrDocument *document, uint32_t origin, uint32_t number,
                          const FrContext *context, FrPlace *place) {
    GArray *placed;
    bool is_found = false;
    FrStatus status = fr_scene_places(document, NULL, context, &placed);
    for (guint i = 0; status == FR_OK && i < placed->len && !is_found; i++) {
        const FrPlaced *one = &g_array_index(placed, FrPlaced, i);
        is_found = one->stand.origin == origin && one->stand.number == number;
        if (is_found) {
            *place = (FrPlace){
                .plant = one->plant->id,
                .at = {{(float)one->stand.at[0], (float)one->stand.at[1], (float)one->stand.at[2]}},
                .turn = one->stand.turn,
                .scale = one->stand.scale,
                .seed = one->seed,
                .span = one->span};
        }
    }
    g_clear_pointer(&placed, g_array_unref);
    return is_found;
}

FrStatus fr_scene_count(const FrDocument *document, const FrContext *context, uint64_t *count) {
    GArray *placed;
    FrStatus status = fr_scene_places(document, NULL, context, &placed);
    *count = placed != NULL ? placed->len : 0;
    g_clear_pointer(&placed, g_array_unref);
    return status;
}
