/// The sketch mode without a display: lines in depth, the drawing board, and what is drawn in the
/// document.
#include "studio.h"
#include "studio/model/sketch_board.h"
#include "studio/model/sketch_shape.h"
#include "studio/model/sketcher.h"

#include <math.h>

// ---- lines in depth ----------------------------------------------------------------------------

static StudioBoard board_of(bool is_level) {
    StudioBoard board = {.is_level = is_level};
    StudioLine lines[] = {{{-1, -1, 0}, {1, 1, 2}}, {{1, -1, 1}, {-1, 1, 1}}};
    studio_board_frame(&board, lines, 2, 1);
    return board;
}

// Pixels that a line at a height above the board's middle covers in the column in its middle.
static double covered(const StudioBoard *board, double height) {
    double from[3], to[3];
    studio_board_point(board, -0.5, 0, height, from);
    studio_board_point(board, 0.5, 0, height, to);
    StudioLine line = {.width = 12, .colour = {255, 255, 255, 255}};
    for (int i = 0; i < 3; i++) {
        line.from[i] = (float)from[i];
        line.to[i] = (float)to[i];
    }
    StudioRaster raster = {0};
    StudioLens lens = studio_board_lens(board, 1);
    studio_raster_reset(&raster, 200, 200);
    studio_raster_draw(&raster, &lens, &line, 1, 1);
    double sum = 0;
    for (uint32_t y = 0; y < 200; y++) {
        sum += (raster.pixels[y * 200 + 100] >> 24) / 255.0;
    }
    g_free(raster.pixels);
    g_free(raster.depth);
    return sum;
}

static void test_thickness(void) {
    StudioBoard board = board_of(false);
    double last = 100, eye = 1.4 * board.size;
    for (int i = 0; i <= 6; i++) {
        double pixels = covered(&board, -0.5 * i);
        g_assert_cmpfloat(pixels, <, last);
        g_assert_cmpfloat_with_epsilon(pixels, 12 * eye / (eye + 0.5 * i), 0.3);
        last = pixels;
    }
}

static void test_window(void) {
    StudioBoard board = board_of(true);
    g_assert_cmpfloat(covered(&board, 0.1), ==, 0);
    g_assert_cmpfloat(covered(&board, -0.1), >, 0);
    studio_board_raise(&board, 0.2);
    g_assert_cmpfloat(covered(&board, 0.1), >, 0);
}

static void test_place(void) {
    for (int level = 0; level < 2; level++) {
        StudioBoard board = board_of(level == 1);
        board.azimuth = 0.7;
        studio_board_raise(&board, 0.3);
        double at[3];
        studio_board_point(&board, 0.25 * board.size, -0.125 * board.size, board.height, at);
        float point[3] = {(float)at[0], (float)at[1], (float)at[2]}, seen[2];
        StudioLens lens = studio_board_lens(&board, 2);
        g_assert_true(studio_lens_see(&lens, 400, 200, point, seen));
        g_assert_cmpfloat_with_epsilon(seen[0], 250, 0.1f);
        g_assert_cmpfloat_with_epsilon(seen[1], 125, 0.1f);
        g_assert_cmpfloat_with_epsilon(studio_board_height_of(&board, at), 0.3, 1e-9);
    }
}

static void test_front(void) {
    StudioLine lines[] = {{{-1, 0, 1}, {1, 0, 1}, 8, {255, 0, 0, 255}},
                          {{0, 0.5f, 0}, {0, 0.5f, 2}, 8, {0, 0, 255, 255}}};
    StudioBoard board = board_of(false); // seen from −y: the red line is nearer
    board.height = board.reach;
    StudioLens lens = studio_board_lens(&board, 1);
    StudioRaster raster = {0};
    studio_raster_reset(&raster, 100, 100);
    studio_raster_draw(&raster, &lens, lines, 2, 1);
    g_assert_cmphex(raster.pixels[50 * 100 + 50], ==, 0xffff0000);
    studio_raster_clear(&raster);
    studio_raster_draw(&raster, &lens, &lines[1], 1, 1);
    studio_raster_draw(&raster, &lens, &lines[0], 1, 1);
    g_assert_cmphex(raster.pixels[50 * 100 + 50], ==, 0xffff0000);
    g_free(raster.pixels);
    g_free(raster.depth);
}

// ---- the pen -----------------------------------------------------------------------------------

enum { HELIX = 160 };

// A helix of two turns, 0.2 m wide, that rises 0.4 m; the height is heard of every eighth time.
static GArray *helix(void) {
    GArray *events = g_array_new(FALSE, TRUE, sizeof(FrPenEvent));
    FrPenEvent down = {.kind = FR_PEN_DOWN}, up = {.kind = FR_PEN_UP};
    g_array_append_val(events, down);
    for (int i = 0; i <= HELIX; i++) {
        double t = (double)i / HELIX, angle = 4 * G_PI * t;
        FrPenEvent height = {.kind = FR_PEN_HEIGHT, .height = 0.4 * t, .time = t};
        FrPenEvent move = {.kind = FR_PEN_MOVE,
                           .x = 0.1 * cos(angle),
                           .y = 0.1 * sin(angle),
                           .pressure = 1,
                           .time = t};
        if (i % 8 == 0) {
            g_array_append_val(events, height);
        }
        g_array_append_val(events, move);
    }
    g_array_append_val(events, up);
    return events;
}

static const FrPenEvent *first_of(const GArray *events) {
    return (const FrPenEvent *)(const void *)events->data;
}

static void test_helix(void) {
    StudioBoard board = board_of(true);
    GArray *events = helix();
    FrStroke *stroke = studio_board_stroke(&board, first_of(events), events->len);
    size_t count;
    const FrStrokePoint *points = fr_stroke_points(stroke, &count);
    g_assert_cmpuint(count, ==, HELIX + 1);
    for (size_t i = 0; i < count; i++) {
        double wanted = 0.4 * (double)i / HELIX;
        g_assert_cmpfloat_with_epsilon((double)points[i].at.z, wanted, 0.02 * 0.2);
    }
    fr_stroke_unref(stroke);
    g_array_unref(events);
}

static void test_directions(void) {
    FrPenEvent events[] = {{.kind = FR_PEN_DOWN},
                           {.kind = FR_PEN_MOVE, .x = 0.5, .y = 0.5},
                           {.kind = FR_PEN_MOVE, .x = 0.8, .y = 0.9, .time = 1},
                           {.kind = FR_PEN_UP}};
    StudioBoard board = board_of(false);
    vec3s vector;
    g_assert_true(studio_board_vector(&board, events, 4, &vector)); // from the front
    g_assert_cmpfloat_with_epsilon(vector.x, 0.3f, 1e-3f);
    g_assert_cmpfloat_with_epsilon(vector.y, 0, 1e-6f);
    g_assert_cmpfloat_with_epsilon(vector.z, 0.4f, 1e-3f);
    board.azimuth = G_PI / 2; // from +x: what is right is +y
    g_assert_true(studio_board_vector(&board, events, 4, &vector));
    g_assert_cmpfloat_with_epsilon(vector.x, 0, 1e-6f);
    g_assert_cmpfloat_with_epsilon(vector.y, 0.3f, 1e-3f);
    events[2] = events[1];
    g_assert_false(studio_board_vector(&board, events, 4, &vector));
    g_assert_null(studio_board_stroke(&board, events, 4));
}

static void test_fit(void) {
    StudioCamera camera = studio_camera_default();
    StudioLine line = {{-1, -1, 0}, {1, 1, 6}};
    GArray *lines = g_array_new(FALSE, FALSE, sizeof(StudioLine));
    g_array_append_val(lines, line);
    GArray *layers[] = {NULL, lines};
    studio_sketch_fit(&camera, layers, 2, 0.6);
    StudioLens lens = studio_sketch_lens(&camera, 0.6);
    float low[2], high[2];
    g_assert_true(studio_lens_see(&lens, 600, 1000, line.from, low));
    g_assert_true(studio_lens_see(&lens, 600, 1000, line.to, high));
    g_assert_cmpfloat_with_epsilon(low[1], 950, 5);
    g_assert_cmpfloat_with_epsilon(high[1], 50, 5);
    g_assert_cmpfloat_with_epsilon(0.5f * (low[0] + high[0]), 300, 5);
    g_array_unref(lines);
}

// ---- in the document ---------------------------------------------------------------------------

static FrStroke *simple_stroke(void) {
    FrStroke *stroke = fr_stroke_parse("0,0,0 0,0,1 0.5,0,1.5 0.5,0,2.5", (FrSpan){0}, NULL);
    g_assert_nonnull(stroke);
    return stroke;
}

static bool is_right(StudioDocument *document) {
    FrContext context = fr_context_default();
    FrDocument *parsed = NULL;
    FrStatus status = fr_document_parse(studio_document_source(document),
                                        studio_document_folder(document), &context, &parsed);
    fr_document_free(parsed);
    return status == FR_OK;
}

static void test_document(void) {
    StudioDocument *document = open_example("examples/chestnut.frond");
    FrDigest before = studio_document_digest(document);
    StudioSketchOf of = studio_sketch_of(studio_document_contents(document), first_plant(document));
    g_assert_nonnull(of.base);
    g_assert_null(of.varied);
    FrStroke *stroke = simple_stroke();
    g_assert_true(studio_sketch_add_stroke(document, &of, stroke, "trunk", FR_APPLY_BOTH));
    g_assert_nonnull(of.varied);
    g_assert_cmpuint(studio_document_steps(document), ==, 1);
    g_assert_true(studio_sketch_add_indicator(document, &of, STUDIO_PEN_WIND, (vec3s){{1, 0, 0.5f}},
                                              NULL, FR_APPLY_BOTH));
    g_assert_cmpuint(studio_document_steps(document), ==, 2);
    g_assert_true(is_right(document));
    const FrContents *contents = studio_document_contents(document);
    GArray *marks = studio_sketch_marks(contents, studio_sketch_vary(contents, of.varied));
    g_assert_cmpuint(marks->len, ==, 2);
    g_assert_nonnull(strstr(text_of(document), "<indicator kind=\"wind\" to=\"1,0,0.5\"/>"));
    g_assert_nonnull(strstr(text_of(document), "<stroke select=\"trunk\" apply=\"both\">"));
    g_assert_true(studio_sketch_remove(document, g_array_index(marks, uint32_t, 0)));
    g_assert_null(strstr(text_of(document), "<stroke"));
    g_assert_true(is_right(document));
    while (studio_document_undo(document)) {
    }
    g_assert_cmphex(studio_document_digest(document), ==, before);
    g_array_unref(marks);
    fr_stroke_unref(stroke);
    studio_sketch_of_clear(&of);
    studio_document_free(document);
}

static void test_stroke_kept(void) {
    StudioDocument *document = open_example("examples/strokes.frond");
    uint32_t plant = first_plant(document);
    StudioSketchOf of = studio_sketch_of(studio_document_contents(document), plant);
    g_assert_cmpstr(of.varied, ==, "wave"); // the first variation of the tree
    StudioBoard board = board_of(true);
    GArray *events = helix();
    FrStroke *stroke = studio_board_stroke(&board, first_of(events), events->len);
    g_assert_true(studio_sketch_add_stroke(document, &of, stroke, "trunk", FR_APPLY_SELECTED));
    const FrContents *contents = studio_document_contents(document);
    GArray *marks = studio_sketch_marks(contents, studio_sketch_vary(contents, "wave"));
    char *text = fr_contents_text(contents, g_array_index(marks, uint32_t, marks->len - 1), NULL);
    FrStroke *kept = fr_stroke_parse(text, (FrSpan){0}, NULL);
    size_t drawn_count, kept_count;
    const FrStrokePoint *drawn = fr_stroke_points(stroke, &drawn_count);
    const FrStrokePoint *read = fr_stroke_points(kept, &kept_count);
    g_assert_cmpuint(drawn_count, ==, kept_count);
    for (size_t i = 0; i < drawn_count; i++) {
        for (int k = 0; k < 3; k++) {
            g_assert_cmpfloat_with_epsilon(drawn[i].at.raw[k], read[i].at.raw[k], 1e-6f);
        }
    }
    fr_stroke_unref(kept);
    g_free(text);
    g_array_unref(marks);
    fr_stroke_unref(stroke);
    g_array_unref(events);
    studio_sketch_of_clear(&of);
    studio_document_free(document);
}

static void test_standing(void) {
    StudioDocument *document = open_example("examples/sunflower.frond");
    StudioSketchOf of = studio_sketch_of(studio_document_contents(document), first_plant(document));
    g_assert_false(studio_sketch_place(document, &of, 1, 3, 2)); // nothing is drawn
    FrStroke *stroke = simple_stroke();
    g_assert_true(studio_sketch_add_stroke(document, &of, stroke, "", FR_APPLY_SELECTED));
    g_assert_true(studio_sketch_place(document, &of, 4, 3, 2));
    g_assert_cmpuint(studio_document_steps(document), ==, 2);
    FrContext context = fr_context_default();
    FrDocument *parsed;
    FrScene *scene;
    g_assert_cmpint(fr_document_parse(studio_document_source(document), NULL, &context, &parsed),
                    ==, FR_OK);
    g_assert_cmpint(fr_scene_build(parsed, -1, &context, &scene), ==, FR_OK);
    g_assert_cmpuint(scene->stands->len, ==, 4); // what stood there before, and three
    fr_scene_free(scene);
    fr_document_free(parsed);
    FrSource *preview = studio_sketch_preview(document, &of, 1, 5, 2);
    g_assert_cmpint(fr_document_parse(preview, NULL, &context, &parsed), ==, FR_OK);
    g_assert_cmpint(fr_scene_build(parsed, -1, &context, &scene), ==, FR_OK);
    g_assert_cmpuint(scene->stands->len, ==, 5); // and nothing else
    fr_scene_free(scene);
    fr_document_free(parsed);
    fr_source_unref(preview);
    fr_stroke_unref(stroke);
    studio_sketch_of_clear(&of);
    studio_document_free(document);
}

static void test_broken(void) {
    StudioDocument *document = open_example("examples/sunflower.frond");
    StudioSketchOf of = studio_sketch_of(studio_document_contents(document), first_plant(document));
    g_assert_true(studio_document_replace(document, "<frond", 6, "Type", NULL));
    FrDigest before = studio_document_digest(document);
    FrStroke *stroke = simple_stroke();
    g_assert_false(studio_sketch_add_stroke(document, &of, stroke, "", FR_APPLY_SELECTED));
    g_assert_null(studio_sketch_preview(document, &of, 1, 5, 2));
    g_assert_cmphex(studio_document_digest(document), ==, before);
    fr_stroke_unref(stroke);
    studio_sketch_of_clear(&of);
    studio_document_free(document);
}

// ---- growing -----------------------------------------------------------------------------------

typedef struct Waiting {
    GMutex lock;
    GCond changed;
    bool is_woken;
} Waiting;

static void wake(void *user) {
    Waiting *waiting = user;
    g_mutex_lock(&waiting->lock);
    waiting->is_woken = true;
    g_cond_signal(&waiting->changed);
    g_mutex_unlock(&waiting->lock);
}

static StudioSketched *wait_for(StudioSketcher *sketcher, Waiting *waiting, uint64_t serial) {
    gint64 end = g_get_monotonic_time() + 100 * G_TIME_SPAN_SECOND;
    for (;;) {
        g_mutex_lock(&waiting->lock);
        while (!waiting->is_woken) {
            g_assert_true(g_cond_wait_until(&waiting->changed, &waiting->lock, end));
        }
        waiting->is_woken = false;
        g_mutex_unlock(&waiting->lock);
        StudioSketched *done = studio_sketcher_take(sketcher);
        if (done != NULL && done->serial == serial) {
            return done;
        }
        studio_sketched_free(done);
    }
}

static StudioSketched *sketch(StudioSketcher *sketcher, Waiting *waiting, StudioDocument *document,
                              const StudioSketchOf *of, StudioSketchAsk ask) {
    uint64_t serial = studio_sketcher_ask(sketcher, studio_document_source(document),
                                          studio_document_folder(document), of, ask);
    return wait_for(sketcher, waiting, serial);
}

static void test_sketcher(void) {
    StudioDocument *document = open_example("examples/strokes.frond");
    StudioSketchOf of = {g_strdup("tree"), NULL};
    Waiting waiting = {0};
    StudioSketcher *sketcher = studio_sketcher_new(wake, &waiting);
    StudioSketchAsk ask = {1, 7, 1};
    StudioSketched *first = sketch(sketcher, &waiting, document, &of, ask);
    g_assert_cmpint(first->status, ==, FR_OK);
    g_assert_nonnull(first->base);
    g_assert_cmpuint(first->instances->len, ==, 0);
    FrStroke *stroke = simple_stroke();
    g_assert_true(studio_sketch_add_stroke(document, &of, stroke, "trunk", FR_APPLY_SELECTED));
    StudioSketched *second = sketch(sketcher, &waiting, document, &of, ask);
    g_assert_true(second->base == first->base); // what is chosen of it stays
    g_assert_cmpuint(second->instances->len, ==, 7);
    uint32_t shaped = 0;
    for (uint32_t a = 0; a < second->base->plant->axes.count; a++) {
        shaped += second->stroke[a] != FR_NONE;
    }
    g_assert_cmpuint(shaped, ==, 1);
    FrPlant **instances = (FrPlant **)second->instances->pdata;
    g_assert_cmphex(fr_plant_digest(instances[0]), !=, fr_plant_digest(instances[1]));
    ask = (StudioSketchAsk){2, 1, 1}; // the second of them, alone
    StudioSketched *third = sketch(sketcher, &waiting, document, &of, ask);
    g_assert_cmphex(fr_plant_digest(third->instances->pdata[0]), ==, fr_plant_digest(instances[1]));
    studio_sketched_free(first);
    studio_sketched_free(second);
    studio_sketched_free(third);
    fr_stroke_unref(stroke);
    studio_sketcher_free(sketcher);
    studio_sketch_of_clear(&of);
    studio_document_free(document);
}

static double tip_x(const FrPlant *plant) {
    return (double)plant->nodes.position[plant->axes.last[0]].x;
}

static void test_strength(void) {
    StudioDocument *document = open_example("examples/indicators.frond");
    StudioSketchOf of = {g_strdup("tree"), g_strdup("wind")};
    Waiting waiting = {0};
    StudioSketcher *sketcher = studio_sketcher_new(wake, &waiting);
    double tips[3];
    for (int i = 0; i < 3; i++) {
        StudioSketchAsk ask = {1, 1, 0.5 * i};
        StudioSketched *done = sketch(sketcher, &waiting, document, &of, ask);
        g_assert_cmpint(done->status, ==, FR_OK);
        tips[i] = tip_x(done->instances->pdata[0]);
        studio_sketched_free(done);
    }
    g_assert_cmpfloat(tips[0], <, tips[1]);
    g_assert_cmpfloat(tips[1], <, tips[2]);
    studio_sketcher_free(sketcher);
    studio_sketch_of_clear(&of);
    studio_document_free(document);
}

static void test_mistakes(void) {
    StudioDocument *document = open_example("examples/strokes.frond");
    Waiting waiting = {0};
    StudioSketcher *sketcher = studio_sketcher_new(wake, &waiting);
    StudioSketchOf none = {g_strdup("nobody"), NULL};
    StudioSketchAsk ask = {1, 1, 1};
    StudioSketched *done = sketch(sketcher, &waiting, document, &none, ask);
    g_assert_cmpint(done->status, ==, FR_ERR_DOCUMENT);
    g_assert_cmpuint(fr_diags_error_count(done->diags), ==, 1);
    g_assert_null(done->base);
    studio_sketched_free(done);
    StudioSketchOf of = {g_strdup("tree"), g_strdup("wave")};
    FrStroke *stroke = simple_stroke();
    g_assert_true(studio_sketch_add_stroke(document, &of, stroke, "trunc", FR_APPLY_SELECTED));
    done = sketch(sketcher, &waiting, document, &of, ask);
    g_assert_cmpint(done->status, !=, FR_OK);
    g_assert_nonnull(done->base);
    g_assert_cmpstr(fr_diags_get(done->diags, 0)->code, ==, "unknown-branch");
    studio_sketched_free(done);
    fr_stroke_unref(stroke);
    studio_sketcher_free(sketcher);
    studio_sketch_of_clear(&none);
    studio_sketch_of_clear(&of);
    studio_document_free(document);
}

// ---- what is chosen ----------------------------------------------------------------------------

static void test_states(void) {
    FrPlant *plant = fr_plant_new("fork");
    uint32_t stem = fr_plant_add_axis(plant, FR_NONE, (vec3s){{0, 0, 0}}, 0.1f);
    uint32_t node = fr_plant_add_node(plant, stem, GLMS_QUAT_IDENTITY, 1, 0.1f);
    versors aside = fr_rotation_about((vec3s){{0, 1, 0}}, 0.8f);
    uint32_t branch = fr_plant_add_axis(plant, node, (vec3s){{0, 0, 0}}, 0.05f);
    fr_plant_add_node(plant, branch, aside, 1, 0.02f);
    fr_plant_update_frames(plant, 0);
    FrSelection *selection = fr_selection_new(plant);
    fr_selection_touch(selection, stem);
    fr_selection_touch(selection, branch);
    uint8_t states[2];
    studio_sketch_states(plant, selection, STUDIO_CHOSEN_PAINTED, FR_NONE, states);
    g_assert_cmpuint(states[stem], ==, FR_SELECTED);
    g_assert_cmpuint(states[branch], ==, FR_UNDETERMINED);
    StudioSketchColours colours = studio_sketch_colours(true);
    GArray *lines = g_array_new(FALSE, FALSE, sizeof(StudioLine));
    studio_sketch_add_skeleton(lines, plant, states, &colours, 100);
    g_assert_cmpuint(lines->len, ==, 2);
    const StudioLine *drawn = (const StudioLine *)(const void *)lines->data;
    g_assert_true(memcmp(drawn[0].colour, colours.selected, 4) == 0);
    g_assert_true(memcmp(drawn[1].colour, colours.undetermined, 4) == 0);
    g_assert_true(memcmp(colours.undetermined, colours.selected, 4) != 0);
    g_assert_true(memcmp(colours.undetermined, colours.bare, 4) != 0);
    studio_sketch_states(plant, selection, STUDIO_CHOSEN_ALL, FR_NONE, states);
    g_assert_cmpuint(states[branch], ==, FR_SELECTED);
    g_array_unref(lines);
    fr_selection_free(selection);
    fr_plant_free(plant);
}

static void test_pen(void) {
    StudioBoard board = {.size = 1, .height = 0.25, .reach = 2};
    static const double leans[][2] = {{-1, 2}, {-0.5, 1}, {0, 0}, {0.25, -0.5}, {1, -2}, {7, -2}};
    for (size_t i = 0; i < G_N_ELEMENTS(leans); i++) {
        g_assert_cmpfloat(studio_board_lean(&board, leans[i][0]), ==, leans[i][1]);
    }
    g_assert_cmpfloat(studio_board_lean(&board, NAN), ==, 0.25);
    static const double presses[][2] = {{0, 0}, {0.4, 0.4}, {1, 1}, {-3, 0}, {1.5, 1}, {NAN, 1}};
    for (size_t i = 0; i < G_N_ELEMENTS(presses); i++) {
        g_assert_cmpfloat(studio_pen_pressure(presses[i][0]), ==, presses[i][1]);
    }
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
#define TEST(name, function) g_test_add_func("/studio/sketch/" name, function)
    TEST("a pen that leans moves the board, and one that tells nothing is a mouse", test_pen);
    TEST("the farther a line is the thinner it is", test_thickness);
    TEST("nothing before the board is seen", test_window);
    TEST("a point on the board is seen where it was drawn", test_place);
    TEST("what is in front is drawn over what is behind, in any order", test_front);
    TEST("a helix drawn while the board rises keeps its pitch within two percent", test_helix);
    TEST("directions on the board are those of the plant as it is seen", test_directions);
    TEST("lines are looked at from as near as all of them are seen", test_fit);
    TEST("a stroke is a step, the first one makes a variation, and all is undone to the byte",
         test_document);
    TEST("a stroke in the document is the one that was drawn", test_stroke_kept);
    TEST("instances stand beside what stands, and a preview has nothing else", test_standing);
    TEST("a text that is not well-formed is left alone", test_broken);
    TEST("the plant that is drawn over stays the same while its instances follow", test_sketcher);
    TEST("indicators come up with their strength", test_strength);
    TEST("mistakes are told, and what can be shown is shown", test_mistakes);
    TEST("a branch that is not certain has a colour of its own", test_states);
#undef TEST
    return g_test_run();
}
