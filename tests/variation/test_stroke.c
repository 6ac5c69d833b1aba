#include "plants.h"

#include <math.h>
#include <string.h>

static FrStroke *parse(const char *text, FrDiags *diags) {
    return fr_stroke_parse(text, (FrSpan){0}, diags);
}

static void texts(void) {
    FrStroke *stroke = parse(" 0,0,0  1,0,0.5,0.25\n\t2,1,1,0.5,1.5 ", NULL);
    size_t count;
    const FrStrokePoint *points = fr_stroke_points(stroke, &count);
    g_assert_cmpuint(count, ==, 3);
    g_assert_cmpfloat(points[0].pressure, ==, 1);
    g_assert_cmpfloat(points[1].pressure, ==, 0.25f);
    g_assert_cmpfloat(points[2].time, ==, 1.5);
    char *text = fr_stroke_text(stroke);
    g_assert_cmpstr(text, ==, "0,0,0 1,0,0.5,0.25,0 2,1,1,0.5,1.5");
    g_free(text);
    fr_stroke_unref(stroke);
    static const char *const wrong[] = {"",
                                        "1,2,3",
                                        "1,2,3 1,2,3",
                                        "1,2 3,4",
                                        "0,0,0 1,1,1,",
                                        "0,0,0 1,1,1,1,1,1",
                                        "0,0,0 a,b,c",
                                        "0,0,0 1,nan,0",
                                        "0,0,0 1e20,0,0",
                                        "0,0,0 inf,0,0",
                                        "0,0,0;1,1,1"};
    for (size_t i = 0; i < G_N_ELEMENTS(wrong); i++) {
        FrDiags *diags = fr_diags_new();
        g_assert_null(parse(wrong[i], diags));
        g_assert_cmpuint(fr_diags_error_count(diags), ==, 1);
        g_assert_cmpstr(fr_diags_get(diags, 0)->code, ==, "bad-stroke");
        fr_diags_free(diags);
    }
}

static void cutting(void) {
    // An angle whose legs are 3 and 1 long, drawn with a resting hand, cut as 1 : 2 : 1.
    FrStroke *stroke = parse("5,5,5 5,5,5 8,5,5 8,5,5 8,6,5", NULL);
    g_assert_cmpfloat(fr_stroke_length(stroke), ==, 4);
    static const float lengths[] = {0.2f, 0.4f, 0.2f};
    vec3s headings[3];
    fr_stroke_resample(stroke, lengths, 3, headings);
    static const float wanted[3][3] = {{1, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    for (int n = 0; n < 3; n++) {
        for (int k = 0; k < 3; k++) {
            g_assert_cmpfloat_with_epsilon(headings[n].raw[k], wanted[n][k], 1e-6);
        }
    }
    static const float none[] = {0, 0, 0, 0};
    vec3s even[4];
    fr_stroke_resample(stroke, none, 4, even);
    g_assert_cmpfloat_with_epsilon(even[2].x, 1, 1e-6);
    g_assert_cmpfloat_with_epsilon(even[3].y, 1, 1e-6);
    fr_stroke_unref(stroke);
}

#define RADIUS 0.06
#define PITCH 0.08 // m a turn
enum { TURNS = 4 };

/// What a tablet of 0.1 mm on a table with a potentiometer of 10 bits over 0.4 m hears of a helix
/// that a hand draws in 8 s: the pen 120 times a second, the height 40 times.
static char *helix_heard(void) {
    GString *heard = g_string_new("# a helix\ndown\n");
    const int pens = 120 * 8;
    for (int i = 0; i <= pens; i++) {
        double time = 8.0 * i / pens, angle = 2 * G_PI * TURNS * time / 8;
        FrPenEvent move = {FR_PEN_MOVE,
                           round(1e4 * RADIUS * cos(angle)) / 1e4,
                           round(1e4 * RADIUS * sin(angle)) / 1e4,
                           0.5,
                           0,
                           time};
        if (i % 3 == 0) {
            double step = 0.4 / 1023;
            FrPenEvent height = {
                FR_PEN_HEIGHT, 0, 0, 0, round(PITCH * TURNS * time / 8 / step) * step, time};
            char *line = fr_pen_line(&height);
            g_string_append(heard, line);
            g_free(line);
        }
        char *line = fr_pen_line(&move);
        g_string_append(heard, line);
        g_free(line);
    }
    g_string_append(heard, "up\n");
    return g_string_free(heard, FALSE);
}

/// Rise for a turn by least squares over all points.
static double pitch_of(const vec3s *points, size_t count) {
    double sum_a = 0, sum_z = 0, sum_aa = 0, sum_az = 0, angle = 0;
    for (size_t i = 0; i < count; i++) {
        if (i > 0) {
            double cross = (double)(points[i - 1].x * points[i].y - points[i - 1].y * points[i].x);
            double dot = (double)(points[i - 1].x * points[i].x + points[i - 1].y * points[i].y);
            angle += atan2(cross, dot);
        }
        sum_a += angle;
        sum_z += (double)points[i].z;
        sum_aa += angle * angle;
        sum_az += angle * (double)points[i].z;
    }
    double n = (double)count;
    return 2 * G_PI * (n * sum_az - sum_a * sum_z) / (n * sum_aa - sum_a * sum_a);
}

static FrStroke *draw_helix(void) {
    char *heard = helix_heard();
    size_t wrong;
    FrPen *pen = fr_pen_from_lines(heard, strlen(heard), &wrong);
    g_assert_cmpuint(wrong, ==, 0);
    FrStroke *stroke = fr_pen_stroke(pen);
    g_assert_nonnull(stroke);
    g_assert_null(fr_pen_stroke(pen));
    fr_pen_free(pen);
    g_free(heard);
    return stroke;
}

static void helix(void) {
    FrStroke *stroke = draw_helix();
    size_t count;
    const FrStrokePoint *points = fr_stroke_points(stroke, &count);
    g_assert_cmpuint(count, ==, 961); // the raw hand: nothing is left out, nothing smoothed
    vec3s *at = g_new(vec3s, count);
    for (size_t i = 0; i < count; i++) {
        at[i] = points[i].at;
    }
    g_assert_cmpfloat_with_epsilon(pitch_of(at, count) / PITCH, 1, 0.02);
    // And as the shape of a stem of 200 internodes, 1.53 m tall: the same angle of climb.
    FrPlant *stem = fr_plant_new("stem");
    add_branch(stem, FR_NONE, 0, 200, 10);
    FrVaryParams params = vary_params();
    params.scatter = 0;
    params.anticipation = 1;
    FrVary *vary = fr_vary_new(&params);
    fr_vary_add_stroke(vary, stroke, "", FR_APPLY_SELECTED, (FrSpan){0});
    FrContext context = fr_context_default();
    FrVaryPlan *plan;
    g_assert_cmpint(fr_vary_prepare(vary, stem, &context, &plan), ==, FR_OK);
    FrPlant *grown = fr_vary_instance(plan, 1);
    // Headings on a helix climb by the same angle against its axis, the sum of all turns' axes.
    vec3s axis = {{0, 0, 0}};
    for (uint32_t i = 1; i < 200; i++) {
        axis = glms_vec3_add(axis, glms_vec3_cross(fr_frame_heading(grown->nodes.frame[i - 1]),
                                                   fr_frame_heading(grown->nodes.frame[i])));
    }
    double climb = 0;
    vec3s whole = grown->nodes.position[199];
    climb = (double)glms_vec3_dot(whole, glms_vec3_normalize(axis)) / 10;
    double turn = 2 * G_PI * RADIUS;
    double wanted = PITCH / sqrt(PITCH * PITCH + turn * turn);
    g_assert_cmpfloat_with_epsilon(climb / wanted, 1, 0.02);
    fr_plant_free(grown);
    fr_vary_plan_free(plan);
    fr_vary_free(vary);
    fr_params_clear(fr_vary_table(), &params);
    fr_plant_free(stem);
    fr_stroke_unref(stroke);
    g_free(at);
}

static void protocol(void) {
    static const char lines[] = "# hello\n\nmove 9 9 1 0\nheight 0.5 0\ndown\r\nmove 0 0 0.5 0.1\n"
                                "  move 1 0 2 0.2 # pressure is cut\nup\nbogus\nmove 1\n"
                                "move 1 2 3 4 5\ndown\nup\ndown\nmove 0 0 1 1\nheight 1 2\n"
                                "move 0 1 1 1.5\nup\ndown\nmove 1 1 1 1";
    size_t wrong;
    FrPen *pen = fr_pen_from_lines(lines, sizeof lines - 1, &wrong);
    g_assert_cmpuint(wrong, ==, 3);
    FrStroke *first = fr_pen_stroke(pen), *second = fr_pen_stroke(pen);
    size_t count;
    const FrStrokePoint *points = fr_stroke_points(first, &count);
    g_assert_cmpuint(count, ==, 2);
    g_assert_cmpfloat(points[0].at.z, ==, 0.5f);
    g_assert_cmpfloat(points[1].pressure, ==, 1);
    points = fr_stroke_points(second, &count);
    g_assert_cmpuint(count, ==, 2);
    g_assert_cmpfloat_with_epsilon(points[0].at.z, 0.75f, 1e-6);
    g_assert_cmpfloat_with_epsilon(points[1].at.z, 0.875f, 1e-6);
    g_assert_null(fr_pen_stroke(pen)); // not ended
    fr_stroke_unref(first);
    fr_stroke_unref(second);
    fr_pen_free(pen);
}

int main(int argc, char **argv) {
    g_test_init(&argc, &argv, NULL);
    g_test_add_func("/variation/stroke/points are read and written", texts);
    g_test_add_func("/variation/stroke/a stroke is cut by arc length", cutting);
    g_test_add_func("/variation/stroke/a helix comes back with its pitch", helix);
    g_test_add_func("/variation/stroke/devices speak in lines", protocol);
    return g_test_run();
}
