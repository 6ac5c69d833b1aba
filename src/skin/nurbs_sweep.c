// Generalized cylinders as control nets: a rational profile at every point of a path.
// Beneš. Generating a Model of Plant Using NURBS: the orientation at a joint is the mean of those
// of the two internodes, weighted with their radii (equation 1); Figures 2 to 4.
// Wang, Jüttler, Zheng, Liu 2008: on a polyline the smallest rotation at each joint is the
// rotation-minimizing frame. Bronsvoort, Klok 1985: Frenet frames.
//
// With tangent joins knots are chord lengths, clamped. With smooth joins they are uniform: a
// uniform cubic through three points of the parent has its position, tangent and curvature there.
// Nets are written clamped all the same, as every CAD program reads them; the two ends are
// blossoms of the uniform net: f(0,0,0) = (P₀ + 4P₁ + P₂)/6 and f(0,0,1) = (2P₁ + P₂)/3.
#include "skin/nurbs.h"

#include <string.h>

/// What is carried along the path.
typedef struct FrCarry {
    double heading[3]; ///< of the segment behind
    double side[3];    ///< unit, across it
} FrCarry;

static void direction(const FrNurbsPath *path, uint32_t segment, double out[3]) {
    const double *a = path->stations[segment].at, *b = path->stations[segment + 1].at;
    for (int k = 0; k < 3; k++) {
        out[k] = b[k] - a[k];
    }
    fr_unit3(out);
}

/// Makes `v` perpendicular to `heading` and of length 1; any such vector if there is none.
static void set_across(double v[3], const double heading[3]) {
    double along = fr_dot3(v, heading);
    for (int k = 0; k < 3; k++) {
        v[k] -= along * heading[k];
    }
    if (!(fr_unit3(v) > 1e-6)) {
        int least = fabs(heading[0]) < fabs(heading[1]) ? 0 : 1;
        least = fabs(heading[2]) < fabs(heading[least]) ? 2 : least;
        double pick[3] = {least == 0, least == 1, least == 2};
        fr_cross3(heading, pick, v);
        fr_unit3(v);
    }
}

/// Turns `v`, across unit `from`, by the smallest rotation to `to`.
static void carry(double v[3], const double from[3], const double to[3]) {
    double scale = 1.0 + fr_dot3(from, to);
    if (scale > 1e-6) {
        double part = fr_dot3(v, to) / scale;
        for (int k = 0; k < 3; k++) {
            v[k] -= part * (from[k] + to[k]);
        }
    }
    set_across(v, to);
}

// Equation 1: from the heading in, w_out / (w_in + w_out) of the way to the heading out.
static void joint_heading(const double in[3], const double out[3], double weight_in,
                          double weight_out, double heading[3]) {
    double cosine = fmin(fmax(fr_dot3(in, out), -1.0), 1.0), angle = acos(cosine);
    double sine = sin(angle), part = weight_out / (weight_in + weight_out);
    bool is_plain = sine < 1e-6;
    double a = is_plain ? 1.0 : sin((1.0 - part) * angle) / sine;
    double b = is_plain ? 0.0 : sin(part * angle) / sine;
    for (int k = 0; k < 3; k++) {
        heading[k] = a * in[k] + b * out[k];
    }
    fr_unit3(heading);
}

static void node_side(const FrPlan *plan, uint32_t node, double side[3]) {
    vec3s left =
        node != FR_NONE ? fr_frame_left(plan->plant->nodes.frame[node]) : (vec3s){{1, 0, 0}};
    for (int k = 0; k < 3; k++) {
        side[k] = (double)left.raw[k];
    }
}

/// The x direction of the section at a station: how it is turned about the branch.
static void turn_side(FrCarry *state, const FrPlan *plan, const FrNurbsStation *station,
                      bool is_round, FrNurbsFrames frames, const double onward[3],
                      const double heading[3], double side[3]) {
    memcpy(side, state->side, sizeof state->side);
    carry(side, state->heading, heading);
    if (frames == FR_FRAMES_FRENET) {
        double binormal[3];
        fr_cross3(state->heading, onward, binormal);
        if (fr_unit3(binormal) > 1e-9) {
            fr_cross3(binormal, heading, side); // towards the inside of the bend
        }
    } else if (!is_round) {
        node_side(plan, station->node, side);
    }
    set_across(side, heading);
    memcpy(state->side, side, sizeof state->side);
    carry(state->side, heading, onward);
    memcpy(state->heading, onward, sizeof state->heading);
}

static void put_ring(const FrNurbsStation *station, const FrNurbsSection *section, double blend,
                     const double heading[3], const double side[3], double (*row)[4]) {
    double up[3], x_axis[3], y_axis[3];
    fr_cross3(heading, side, up);
    for (int k = 0; k < 3; k++) {
        x_axis[k] = station->radius * side[k];
        y_axis[k] = station->radius * station->flatness * up[k];
    }
    for (uint32_t i = 0; i < section->from.count; i++) {
        double p[4];
        memcpy(p, section->from.points[i], sizeof p);
        for (int k = 0; section->changes && k < 4; k++) {
            p[k] += blend * (section->to.points[i][k] - p[k]);
        }
        for (int k = 0; k < 3; k++) {
            row[i][k] = station->at[k] + p[0] * x_axis[k] + p[1] * y_axis[k];
        }
        row[i][3] = p[3];
    }
}

/// row[to] = a·row[i] + b·row[i + 1] + c·row[i + 2], all of `width` points.
static void mix_rows(double (*net)[4], uint32_t width, uint32_t to, uint32_t i, double a, double b,
                     double c) {
    for (uint32_t k = 0; k < width; k++) {
        const double *p = net[(size_t)i * width + k], *q = net[((size_t)i + 1) * width + k];
        const double *r = c != 0.0 ? net[((size_t)i + 2) * width + k] : q;
        double *out = net[(size_t)to * width + k];
        for (int d = 0; d < 4; d++) {
            out[d] = a * p[d] + b * q[d] + c * r[d];
        }
    }
}

static void copy_row(double (*net)[4], uint32_t width, uint32_t to, uint32_t from) {
    memmove(net[(size_t)to * width], net[(size_t)from * width], width * sizeof *net);
}

// Two points are a line and three a parabola; degree elevation makes them cubic.
static void elevate(double (*net)[4], uint32_t width, uint32_t stations) {
    if (stations == 2) {
        copy_row(net, width, 3, 1);
        for (uint32_t k = 0; k < width; k++) {
            const double *first = net[k], *last = net[3 * (size_t)width + k];
            for (int d = 0; d < 4; d++) {
                net[(size_t)width + k][d] = (2.0 * first[d] + last[d]) / 3.0;
                net[2 * (size_t)width + k][d] = (first[d] + 2.0 * last[d]) / 3.0;
            }
        }
    } else {
        copy_row(net, width, 3, 2);
        for (uint32_t k = 0; k < width; k++) {
            const double *first = net[k], *last = net[3 * (size_t)width + k];
            double *second = net[(size_t)width + k], *third = net[2 * (size_t)width + k];
            for (int d = 0; d < 4; d++) {
                double middle = second[d];
                second[d] = (first[d] + 2.0 * middle) / 3.0;
                third[d] = (2.0 * middle + last[d]) / 3.0;
            }
        }
    }
}

// Ends of a uniform net, clamped; see above. A free end has a point reflected about it before it.
static void clamp_uniform(double (*net)[4], uint32_t width, uint32_t stations, bool is_joined) {
    if (!is_joined && stations == 2) {
        elevate(net, width, 2);
        return;
    }
    uint32_t last = is_joined ? stations : stations + 1;
    if (is_joined) {
        mix_rows(net, width, 0, 0, 1.0 / 6, 4.0 / 6, 1.0 / 6);
        mix_rows(net, width, 1, 1, 2.0 / 3, 1.0 / 3, 0.0);
        copy_row(net, width, last, last - 1);
    } else {
        copy_row(net, width, last, stations - 1);
        for (uint32_t row = stations - 1; row-- > 1;) {
            copy_row(net, width, row + 1, row);
        }
        mix_rows(net, width, 1, 0, 2.0 / 3, 0.0, 1.0 / 3);
    }
    // The row before the last: one third of the way from the end back to its neighbour.
    for (uint32_t k = 0; k < width; k++) {
        const double *end = net[(size_t)last * width + k];
        const double *before = net[((size_t)last - 2) * width + k];
        for (int d = 0; d < 4; d++) {
            net[((size_t)last - 1) * width + k][d] = (2.0 * end[d] + before[d]) / 3.0;
        }
    }
}

static void put_knots(const FrNurbsPath *path, const FrNurbsParams *params, double *knots) {
    uint32_t rows = fr_nurbs_rows(path, params);
    if (params->join != FR_JOIN_SMOOTH && path->count >= 4) {
        fr_nurbs_average_knots(path->along, path->count, 3, knots);
        return;
    }
    for (uint32_t i = 0; i < rows + 4; i++) {
        uint32_t step = i > 3 ? MIN(i - 3, rows - 3) : 0;
        knots[i] = (double)step / (rows - 3);
    }
}

// Distances along the path in parts of the whole.
static void measure(FrNurbsPath *path) {
    double total = 0.0;
    path->along[0] = 0.0;
    for (uint32_t i = 1; i < path->count; i++) {
        double step[3];
        for (int k = 0; k < 3; k++) {
            step[k] = path->stations[i].at[k] - path->stations[i - 1].at[k];
        }
        total += sqrt(fr_dot3(step, step));
        path->along[i] = total;
    }
    for (uint32_t i = 1; i < path->count; i++) {
        path->along[i] /= total;
    }
}

void fr_nurbs_sweep(FrNurbsPath *path, const FrNurbsSection *section, const FrPlan *plan,
                    const FrNurbsParams *params, double (*net)[4], double *knots) {
    const FrNurbsStation *stations = path->stations;
    uint32_t width = section->from.count, count = path->count;
    measure(path);
    FrCarry state;
    direction(path, 0, state.heading);
    node_side(plan, stations[0].node, state.side);
    set_across(state.side, state.heading);
    double begin = path->along[path->shared > 0 ? path->shared - 1 : 0];
    for (uint32_t i = 0; i < count; i++) {
        double onward[3], heading[3], side[3];
        direction(path, MIN(i, count - 2), onward);
        joint_heading(state.heading, onward, stations[i].radius,
                      stations[MIN(i + 1, count - 1)].radius, heading);
        turn_side(&state, plan, &stations[i], section->is_round && stations[i].flatness == 1.0,
                  (FrNurbsFrames)params->frames, onward, heading, side);
        double blend = fmax(path->along[i] - begin, 0.0) / (1.0 - begin);
        put_ring(&stations[i], section, blend, heading, side, net + (size_t)i * width);
    }
    if (params->join == FR_JOIN_SMOOTH) {
        clamp_uniform(net, width, count, path->shared == 3);
    } else if (count < 4) {
        elevate(net, width, count);
    }
    put_knots(path, params, knots);
}
