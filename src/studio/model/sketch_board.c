// The board of the 3D Tractus (Lapides, Sharlin, Costa Sousa, Streit 2006) without the device: a
// plane with a pen on it and a height of its own.
#include "studio/model/sketch_board.h"

#include <cglm/struct.h>

#include <math.h>

static const double eye_distance = 1.4; // from the window, in its heights

// How far lines reach along the axes of the board, from the plant's origin.
static void extents(const StudioBoard *board, const StudioLine *lines, size_t count, double low[3],
                    double high[3]) {
    double axes[3][3];
    studio_board_axes(board, axes[0], axes[1], axes[2]);
    for (size_t i = 0; i < 2 * count; i++) {
        const float *at = i % 2 == 0 ? lines[i / 2].from : lines[i / 2].to;
        for (int k = 0; k < 3; k++) {
            double along = (double)at[0] * axes[k][0] + (double)at[1] * axes[k][1] +
                           (double)at[2] * axes[k][2];
            low[k] = i == 0 ? along : fmin(low[k], along);
            high[k] = i == 0 ? along : fmax(high[k], along);
        }
    }
}

void studio_board_frame(StudioBoard *board, const StudioLine *lines, size_t count, double aspect) {
    double low[3] = {0, 0, 0}, high[3] = {0, 0, 0}, axes[3][3];
    studio_board_axes(board, axes[0], axes[1], axes[2]);
    extents(board, lines, count, low, high);
    for (int i = 0; i < 3; i++) {
        board->centre[i] = 0;
        for (int k = 0; k < 3; k++) {
            board->centre[i] += 0.5 * (low[k] + high[k]) * axes[k][i];
        }
    }
    double largest = fmax(high[1] - low[1], (high[0] - low[0]) / fmax(aspect, 0.01));
    board->size = largest > 1e-9 ? 1.15 * largest : 1;
    board->reach = fmax(0.6 * (high[2] - low[2]), 0.3 * board->size);
    board->height = 0;
}

void studio_board_raise(StudioBoard *board, double by) {
    board->height = fmin(fmax(board->height + by, -board->reach), board->reach);
}

double studio_board_lean(const StudioBoard *board, double tilt) {
    return isnan(tilt) ? board->height : -CLAMP(tilt, -1, 1) * board->reach;
}

double studio_pen_pressure(double told) {
    return isnan(told) ? 1 : CLAMP(told, 0, 1);
}

void studio_board_axes(const StudioBoard *board, double right[3], double up[3], double out[3]) {
    double c = cos(board->azimuth), s = sin(board->azimuth);
    right[0] = c, right[1] = s, right[2] = 0;
    if (board->is_level) {
        up[0] = -s, up[1] = c, up[2] = 0;
        out[0] = out[1] = 0, out[2] = 1;
    } else {
        up[0] = up[1] = 0, up[2] = 1;
        out[0] = s, out[1] = -c, out[2] = 0;
    }
}

void studio_board_point(const StudioBoard *board, double x, double y, double height, double at[3]) {
    double right[3], up[3], out[3];
    studio_board_axes(board, right, up, out);
    for (int i = 0; i < 3; i++) {
        at[i] = board->centre[i] + x * right[i] + y * up[i] + height * out[i];
    }
}

double studio_board_height_of(const StudioBoard *board, const double at[3]) {
    double right[3], up[3], out[3], height = 0;
    studio_board_axes(board, right, up, out);
    for (int i = 0; i < 3; i++) {
        height += (at[i] - board->centre[i]) * out[i];
    }
    return height;
}

StudioLens studio_board_lens(const StudioBoard *board, double aspect) {
    double right[3], up[3], out[3], eye[3], away = eye_distance * board->size;
    studio_board_axes(board, right, up, out);
    studio_board_point(board, 0, 0, board->height + away, eye);
    mat4s view = GLMS_MAT4_IDENTITY;
    const double *rows[] = {right, up, out};
    for (int row = 0; row < 3; row++) {
        double move = 0;
        for (int i = 0; i < 3; i++) {
            view.raw[i][row] = (float)rows[row][i];
            move -= rows[row][i] * eye[i];
        }
        view.raw[3][row] = (float)move;
    }
    float angle = (float)(2 * atan(0.5 / eye_distance));
    mat4s project = glms_perspective(angle, (float)aspect, (float)(0.01 * away),
                                     (float)(away + 100 * board->size));
    // A hair before the plane, so that what is just being drawn is seen.
    return (StudioLens){glms_mat4_mul(project, view), (float)away, (float)(away * 0.9999)};
}

// What coordinates are rounded to: a power of ten, about a ten-thousandth of the board.
static double fineness_of(const StudioBoard *board) {
    return pow(10, floor(log10(1e-4 * board->size)));
}

FrStroke *studio_board_stroke(const StudioBoard *board, const FrPenEvent *events, size_t count) {
    FrPen *pen = fr_pen_simulated(events, count);
    FrStroke *hand = fr_pen_stroke(pen);
    fr_pen_free(pen);
    if (hand == NULL) {
        return NULL;
    }
    size_t points;
    const FrStrokePoint *drawn = fr_stroke_points(hand, &points);
    FrStrokePoint *turned = g_new(FrStrokePoint, points);
    double right[3], up[3], out[3], fine = fineness_of(board);
    studio_board_axes(board, right, up, out);
    for (size_t p = 0; p < points; p++) {
        vec3s from = glms_vec3_sub(drawn[p].at, drawn[0].at);
        turned[p] = drawn[p];
        for (int i = 0; i < 3; i++) {
            double along =
                (double)from.x * right[i] + (double)from.y * up[i] + (double)from.z * out[i];
            turned[p].at.raw[i] = (float)(round(along / fine) * fine + 0.0); // no −0
        }
    }
    FrStroke *stroke = fr_stroke_new(turned, points);
    g_free(turned);
    fr_stroke_unref(hand);
    return stroke;
}

bool studio_board_vector(const StudioBoard *board, const FrPenEvent *events, size_t count,
                         vec3s *vector) {
    FrStroke *stroke = studio_board_stroke(board, events, count);
    if (stroke == NULL) {
        return false;
    }
    size_t points;
    const FrStrokePoint *drawn = fr_stroke_points(stroke, &points);
    *vector = glms_vec3_sub(drawn[points - 1].at, drawn[0].at);
    fr_stroke_unref(stroke);
    return glms_vec3_norm2(*vector) > 0;
}
