#include "studio/component_icon.h"

#include <math.h>

// All in a square of 16.

static void dot(cairo_t *cairo, double x, double y, double radius) {
    cairo_new_sub_path(cairo);
    cairo_arc(cairo, x, y, radius, 0, 2 * G_PI);
    cairo_fill(cairo);
}

static void line(cairo_t *cairo, double x0, double y0, double x1, double y1) {
    cairo_move_to(cairo, x0, y0);
    cairo_line_to(cairo, x1, y1);
    cairo_stroke(cairo);
}

static void draw_camera(cairo_t *cairo) {
    cairo_rectangle(cairo, 2, 5, 8, 7);
    cairo_fill(cairo);
    cairo_move_to(cairo, 10, 8.5);
    cairo_line_to(cairo, 14, 5.5);
    cairo_line_to(cairo, 14, 11.5);
    cairo_fill(cairo);
}

static void draw_simple(cairo_t *cairo) {
    cairo_move_to(cairo, 8, 2);
    cairo_line_to(cairo, 13.5, 5);
    cairo_line_to(cairo, 13.5, 11);
    cairo_line_to(cairo, 8, 14);
    cairo_line_to(cairo, 2.5, 11);
    cairo_line_to(cairo, 2.5, 5);
    cairo_close_path(cairo);
    cairo_move_to(cairo, 2.5, 5);
    cairo_line_to(cairo, 8, 8);
    cairo_line_to(cairo, 13.5, 5);
    cairo_move_to(cairo, 8, 8);
    cairo_line_to(cairo, 8, 14);
    cairo_stroke(cairo);
}

static void draw_horn(cairo_t *cairo) {
    cairo_move_to(cairo, 3, 14);
    cairo_curve_to(cairo, 4, 8, 7, 4, 13, 2);
    cairo_curve_to(cairo, 9, 6, 8, 9, 7.5, 14);
    cairo_close_path(cairo);
    cairo_fill(cairo);
}

static void draw_tree(cairo_t *cairo) {
    cairo_set_line_width(cairo, 2);
    line(cairo, 8, 14.5, 8, 2);
    cairo_set_line_width(cairo, 1.3);
    line(cairo, 8, 11, 13, 7);
    line(cairo, 8, 8.5, 3, 5);
    line(cairo, 8, 6, 11.5, 3);
}

static void draw_leaf(cairo_t *cairo) {
    cairo_move_to(cairo, 4, 13);
    cairo_curve_to(cairo, 1.5, 6, 7, 2, 14, 2);
    cairo_curve_to(cairo, 14, 9, 10, 14.5, 4, 13);
    cairo_fill(cairo);
}

static void draw_phiball(cairo_t *cairo) {
    cairo_arc(cairo, 8, 8, 6, 0, 2 * G_PI);
    cairo_stroke(cairo);
    for (int i = 0; i < 9; i++) {
        double r = 4.6 * sqrt((i + 0.4) / 9), a = i * 2.39996;
        dot(cairo, 8 + r * cos(a), 8 + r * sin(a), 0.9);
    }
}

static void draw_revo(cairo_t *cairo) {
    cairo_move_to(cairo, 5, 14);
    cairo_curve_to(cairo, 1, 9, 6, 7, 5, 2.5);
    cairo_line_to(cairo, 11, 2.5);
    cairo_curve_to(cairo, 10, 7, 15, 9, 11, 14);
    cairo_close_path(cairo);
    cairo_stroke(cairo);
    line(cairo, 8, 2.5, 8, 14);
}

static void draw_hydra(cairo_t *cairo) {
    for (int i = 0; i < 8; i++) {
        double a = i * G_PI / 4;
        line(cairo, 8 + 1.5 * cos(a), 8 + 1.5 * sin(a), 8 + 6 * cos(a), 8 + 6 * sin(a));
    }
    dot(cairo, 8, 8, 1.6);
}

static void draw_wreath(cairo_t *cairo) {
    cairo_arc(cairo, 8, 8, 5, 0, 2 * G_PI);
    cairo_stroke(cairo);
    for (int i = 0; i < 7; i++) {
        dot(cairo, 8 + 5 * cos(i * 2 * G_PI / 7), 8 + 5 * sin(i * 2 * G_PI / 7), 1.5);
    }
}

static void draw_phyllotaxis(cairo_t *cairo) {
    for (int i = 0; i < 18; i++) {
        double r = 6.4 * sqrt((i + 0.5) / 18), a = i * 2.39996;
        dot(cairo, 8 + r * cos(a), 8 + r * sin(a), 0.55 + 0.03 * i);
    }
}

static void draw_scatter(cairo_t *cairo) {
    static const double at[][2] = {{3, 4},  {7, 3},  {12, 4}, {5, 8},  {10, 7.5},
                                   {14, 9}, {3, 12}, {8, 12}, {12, 13}};
    for (int i = 0; i < 9; i++) {
        dot(cairo, at[i][0], at[i][1], 1.1);
    }
}

static void draw_variation(cairo_t *cairo) {
    line(cairo, 3, 8, 7, 8);
    line(cairo, 7, 8, 13, 3);
    line(cairo, 7, 8, 13, 8);
    line(cairo, 7, 8, 13, 13);
    dot(cairo, 13, 3, 1.4);
    dot(cairo, 13, 8, 1.4);
    dot(cairo, 13, 13, 1.4);
}

static void draw_grid(cairo_t *cairo, double bend) {
    for (int i = 0; i < 4; i++) {
        double t = 3 + 3.33 * i;
        cairo_move_to(cairo, t, 3);
        cairo_curve_to(cairo, t + bend, 6, t + bend, 10, t, 13);
        cairo_move_to(cairo, 3, t);
        cairo_curve_to(cairo, 6, t - bend, 10, t - bend, 13, t);
    }
    cairo_stroke(cairo);
}

static void draw_world(cairo_t *cairo) {
    cairo_arc(cairo, 8, 8, 6, 0, 2 * G_PI);
    cairo_move_to(cairo, 2, 8);
    cairo_line_to(cairo, 14, 8);
    cairo_move_to(cairo, 8, 2);
    cairo_curve_to(cairo, 4, 5, 4, 11, 8, 14);
    cairo_move_to(cairo, 8, 2);
    cairo_curve_to(cairo, 12, 5, 12, 11, 8, 14);
    cairo_stroke(cairo);
}

static void draw_force(cairo_t *cairo) {
    for (int i = 0; i < 3; i++) {
        double y = 4 + 4 * i;
        line(cairo, 2, y, 12, y);
        cairo_move_to(cairo, 14.5, y);
        cairo_line_to(cairo, 11, y - 1.8);
        cairo_line_to(cairo, 11, y + 1.8);
        cairo_fill(cairo);
    }
}

static void draw_graft(cairo_t *cairo) {
    cairo_set_line_width(cairo, 2.2);
    line(cairo, 8, 14.5, 8, 9);
    cairo_set_line_width(cairo, 1.3);
    line(cairo, 8, 9, 4, 2);
    line(cairo, 8, 9, 12, 2);
    line(cairo, 5, 9.5, 11, 9.5);
    line(cairo, 5, 11.5, 11, 11.5);
}

void studio_component_icon(cairo_t *cairo, FrComponentKind kind, double size) {
    static void (*const draw[FR_COMPONENT_COUNT])(cairo_t *) = {
        [FR_COMPONENT_CAMERA] = draw_camera,   [FR_COMPONENT_SIMPLE] = draw_simple,
        [FR_COMPONENT_HORN] = draw_horn,       [FR_COMPONENT_TREE] = draw_tree,
        [FR_COMPONENT_LEAF] = draw_leaf,       [FR_COMPONENT_PHIBALL] = draw_phiball,
        [FR_COMPONENT_REVO] = draw_revo,       [FR_COMPONENT_HYDRA] = draw_hydra,
        [FR_COMPONENT_WREATH] = draw_wreath,   [FR_COMPONENT_PHYLLOTAXIS] = draw_phyllotaxis,
        [FR_COMPONENT_SCATTER] = draw_scatter, [FR_COMPONENT_VARIATION] = draw_variation,
        [FR_COMPONENT_WORLD] = draw_world,     [FR_COMPONENT_FORCE] = draw_force,
        [FR_COMPONENT_GRAFT] = draw_graft,
    };
    cairo_save(cairo);
    cairo_scale(cairo, size / 16, size / 16);
    cairo_set_line_width(cairo, 1.3);
    cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
    if (kind == FR_COMPONENT_FFD || kind == FR_COMPONENT_HYPERPATCH) {
        draw_grid(cairo, kind == FR_COMPONENT_FFD ? 1.2 : -2.4);
    } else if (draw[kind] != NULL) {
        draw[kind](cairo);
    }
    cairo_restore(cairo);
}

void studio_component_colour(FrComponentKind kind, double colour[3]) {
    static const double stem[] = {0.80, 0.60, 0.38}, blade[] = {0.45, 0.74, 0.40},
                        many[] = {0.89, 0.52, 0.62}, whole[] = {0.47, 0.66, 0.90},
                        plain[] = {0.68, 0.69, 0.72};
    const double *from = plain;
    switch (kind) {
    case FR_COMPONENT_HORN:
    case FR_COMPONENT_TREE:
    case FR_COMPONENT_GRAFT:
        from = stem;
        break;
    case FR_COMPONENT_LEAF:
        from = blade;
        break;
    case FR_COMPONENT_PHIBALL:
    case FR_COMPONENT_HYDRA:
    case FR_COMPONENT_WREATH:
    case FR_COMPONENT_PHYLLOTAXIS:
    case FR_COMPONENT_SCATTER:
    case FR_COMPONENT_VARIATION:
        from = many;
        break;
    case FR_COMPONENT_FFD:
    case FR_COMPONENT_HYPERPATCH:
    case FR_COMPONENT_WORLD:
    case FR_COMPONENT_FORCE:
        from = whole;
        break;
    default:
        break;
    }
    for (int i = 0; i < 3; i++) {
        colour[i] = from[i];
    }
}
