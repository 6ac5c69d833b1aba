// Fork surfaces: a sleeve of three patches from a stem below a fork to the stem above and the
// branch. Bloomenthal. Modeling the Mighty Maple. SIGGRAPH 1985: a ramiform is skinned by three
// sets of splines between the limbs, two and two, each across semi-ellipses.
//
// Three rings stand around the limbs, clear of one another. Each has two halves; a patch joins a
// half of one ring to a half of another over an arc at the fork, half of an ellipse. The three arcs
// share their ends, in front of the fork and behind it; one lies on the back of the stem, one below
// the branch and one above it, each a little outside the corner there. Across a patch runs a circle
// that becomes the ellipse and a circle again, along it two cubics with one tangent at the arc,
// which begin in the directions of the limbs.
#include "skin/nurbs_job.h"

#include <string.h>

enum { BELOW, ABOVE, BRANCH, LIMBS };
enum { COLUMNS = 5, ROWS = 7 };
/// The sleeve stands a little off the tubes it covers.
#define LOOSE 1.01
/// How far arcs stay outside of corners, in radii of the branch.
#define FILLET 0.3
#define HALF_ROOT2 0.70710678118654752

const double fr_fork_knots[FR_FORK_KNOTS] = {0, 0, 0,   0.5, 0.5, 1, 1, 1, 0, 0,
                                             0, 0, 0.5, 0.5, 0.5, 1, 1, 1, 1};

/// A limb where its ring stands.
typedef struct FrLimb {
    double at[3], away[3]; ///< middle, unit direction away from the fork
    double radius, reach;  ///< reach: from the fork
} FrLimb;

typedef struct FrFork {
    double at[3], along[3], aside[3],
        front[3];        ///< unit: of the stem, towards the branch, across both
    double stem, branch; ///< radii
    double cosine, sine; ///< of the angle from the stem to the branch
    FrLimb limbs[LIMBS];
} FrFork;

static void to_double(vec3s from, double to[3]) {
    for (int k = 0; k < 3; k++) {
        to[k] = (double)from.raw[k];
    }
}

static double radius_before(const FrPlant *plant, uint32_t node) {
    uint32_t axis = plant->nodes.axis[node], parent = plant->nodes.parent[node];
    bool is_first = plant->axes.first[axis] == node;
    return (double)(is_first || parent == FR_NONE ? plant->axes.base_radius[axis]
                                                  : plant->nodes.radius[parent]);
}

/// Stands a ring at `along` of an internode.
static void stand(const FrPlant *plant, uint32_t node, double along, double sign, FrLimb *limb) {
    double tip[3], length = (double)plant->nodes.length[node], before = radius_before(plant, node);
    to_double(plant->nodes.position[node], tip);
    to_double(fr_frame_heading(plant->nodes.frame[node]), limb->away);
    double part = length > 0.0 ? along / length : 1.0;
    limb->radius = LOOSE * (before + part * ((double)plant->nodes.radius[node] - before));
    for (int k = 0; k < 3; k++) {
        limb->at[k] = tip[k] + (along - length) * limb->away[k];
        limb->away[k] *= sign;
    }
    fr_unit3(limb->away);
}

/// Goes `limb->reach` along the stem from a place on it; false if that is not so long.
static bool walk(const FrPlan *plan, uint32_t node, double along, double sign, FrLimb *limb) {
    const FrNodes *nodes = &plan->plant->nodes;
    double left = limb->reach;
    for (;;) {
        double length = (double)nodes->length[node], here = sign > 0.0 ? length - along : along;
        if (left <= here) {
            stand(plan->plant, node, along + sign * left, sign, limb);
            return true;
        }
        left -= here;
        uint32_t next = sign > 0.0 ? fr_plan_next(plan, node) : nodes->parent[node];
        if (next == FR_NONE || (sign < 0.0 && nodes->axis[next] != nodes->axis[node])) {
            return false;
        }
        node = next;
        along = sign > 0.0 ? 0.0 : (double)nodes->length[node];
    }
}

static bool is_round(const FrPlan *plan, uint32_t axis) {
    return fr_plan_profile(plan, plan->plant->axes.profile[axis]) == NULL;
}

/// How far from the fork rings are clear of the other limbs.
static void set_reaches(FrFork *fork) {
    double cotangent = fork->cosine / fork->sine, foot = fork->branch / fork->sine;
    fork->limbs[BELOW].reach = fmax(foot - fork->stem * cotangent, 0.0) + 0.9 * fork->stem;
    fork->limbs[ABOVE].reach = fmax(foot + fork->stem * cotangent, 0.0) + 0.9 * fork->stem;
    fork->limbs[BRANCH].reach =
        fork->stem / fork->sine + fork->branch * fabs(cotangent) + 1.2 * fork->branch;
}

static bool find_fork(const FrPlan *plan, const FrTube *tube, FrFork *fork) {
    const FrPlant *plant = plan->plant;
    uint32_t bearer = plant->axes.bearer[tube->axis], first = tube->first;
    if (tube->start != FR_START_BRANCH || bearer == FR_NONE || !is_round(plan, tube->axis) ||
        !is_round(plan, plant->nodes.axis[bearer])) {
        return false;
    }
    double tip[3], origin[3], branch[3];
    to_double(plant->nodes.position[bearer], tip);
    to_double(fr_tube_origin(plan, tube), origin);
    to_double(fr_frame_heading(plant->nodes.frame[bearer]), fork->along);
    to_double(fr_frame_heading(plant->nodes.frame[first]), branch);
    double back = 0.0, length = (double)plant->nodes.length[bearer];
    for (int k = 0; k < 3; k++) {
        back += (tip[k] - origin[k]) * fork->along[k];
    }
    double along = fmin(fmax(length - back, 0.0), length);
    fork->cosine = fr_dot3(fork->along, branch);
    for (int k = 0; k < 3; k++) {
        fork->at[k] = tip[k] + (along - length) * fork->along[k];
        fork->aside[k] = branch[k] - fork->cosine * fork->along[k];
    }
    fork->sine = fr_unit3(fork->aside);
    fork->stem = LOOSE * (double)plant->nodes.radius[bearer];
    fork->branch = LOOSE * (double)fr_tube_base_radius(plan, tube);
    bool is_open = fork->sine > 0.35 && fork->branch > 1e-4 && fork->branch <= fork->stem;
    if (!is_open) {
        return false;
    }
    fr_cross3(fork->along, fork->aside, fork->front);
    set_reaches(fork);
    return walk(plan, bearer, along, -1.0, &fork->limbs[BELOW]) &&
           walk(plan, bearer, along, 1.0, &fork->limbs[ABOVE]) &&
           walk(plan, first, 0.0, 1.0, &fork->limbs[BRANCH]);
}

bool fr_fork_is_wanted(const FrNurbsJob *job, const FrTube *tube) {
    FrFork fork;
    return job->params->forks == FR_FORKS_RAMIFORM && find_fork(&job->plan, tube, &fork);
}

/// Half of a ring: from `front` over `side`, both across it, to the opposite of the former.
static void put_half(const double middle[3], const double front[3], const double side[3],
                     double (*row)[4]) {
    static const double fronts[COLUMNS] = {1, 1, 0, -1, -1}, sides[COLUMNS] = {0, 1, 1, 1, 0};
    for (int i = 0; i < COLUMNS; i++) {
        for (int k = 0; k < 3; k++) {
            row[i][k] = middle[k] + fronts[i] * front[k] + sides[i] * side[k];
        }
        row[i][3] = i % 2 == 0 ? 1.0 : HALF_ROOT2;
    }
}

/// The half of a limb's ring that looks to `side`.
static void put_limb(const FrLimb *limb, const double front[3], const double side[3],
                     double (*row)[4]) {
    double across[3], ahead[3];
    memcpy(across, front, sizeof across);
    double along = fr_dot3(across, limb->away);
    for (int k = 0; k < 3; k++) {
        across[k] -= along * limb->away[k];
    }
    fr_unit3(across);
    fr_cross3(across, limb->away, ahead);
    double sign = fr_dot3(ahead, side) < 0.0 ? -limb->radius : limb->radius;
    for (int k = 0; k < 3; k++) {
        across[k] *= limb->radius;
        ahead[k] *= sign;
    }
    put_half(limb->at, across, ahead, row);
}

/// Control points beside a ring or an arc: `step` in a direction that differs from the ends of the
/// row to its middle.
static void put_beside(const double (*row)[4], const double end[3], const double middle[3],
                       double step, double (*beside)[4]) {
    static const double shares[COLUMNS] = {0, 0.5, 1, 0.5, 0};
    for (int i = 0; i < COLUMNS; i++) {
        for (int k = 0; k < 3; k++) {
            double way = end[k] + shares[i] * (middle[k] - end[k]);
            beside[i][k] = row[i][k] + step * way;
        }
        beside[i][3] = row[i][3];
    }
}

/// Where the arc between two limbs has its middle, from the fork; `tangent` is that of the patch.
static void find_apex(const FrFork *fork, int from, int to, double apex[3], double tangent[3]) {
    const double *start = fork->limbs[from].away, *end = fork->limbs[to].away;
    double out[3], r = fork->branch, up = from == ABOVE ? 1.0 : -1.0;
    // Where the outlines of stem and branch meet, above or below.
    double reach = (fork->stem + up * r * fork->cosine) / fork->sine;
    double height = reach * fork->cosine + up * r * fork->sine;
    for (int k = 0; k < 3; k++) {
        out[k] = start[k] + end[k];
        tangent[k] = end[k] - start[k];
    }
    fr_unit3(tangent);
    bool is_back = to != BRANCH;
    double lift = is_back || !(fr_unit3(out) > 1e-6) ? 0.0 : FILLET * r;
    for (int k = 0; k < 3; k++) {
        apex[k] = is_back ? -fork->stem * fork->aside[k]
                          : height * fork->along[k] + fork->stem * fork->aside[k] + lift * out[k];
    }
}

static void put_patch(const FrFork *fork, int from, int to, double (*net)[4]) {
    const FrLimb *limbs[2] = {&fork->limbs[from], &fork->limbs[to]};
    double apex[3], tangent[3], back[3], front[3], inwards[2][3], side[2][3];
    find_apex(fork, from, to, apex, tangent);
    double turned = from == BELOW && to == BRANCH ? -1.0 : 1.0; // so that patches face outwards
    for (int k = 0; k < 3; k++) {
        front[k] = turned * fork->stem * fork->front[k];
        back[k] = -tangent[k];
        inwards[0][k] = -limbs[0]->away[k];
        inwards[1][k] = -limbs[1]->away[k];
        // A ring looks to the limb it is joined to, those on the back away from the branch.
        side[0][k] = to == BRANCH ? limbs[1]->away[k] : -fork->aside[k];
        side[1][k] = to == BRANCH ? limbs[0]->away[k] : -fork->aside[k];
    }
    double(*rows[ROWS])[4];
    for (int j = 0; j < ROWS; j++) {
        rows[j] = net + (size_t)j * COLUMNS;
    }
    double unit[3];
    memcpy(unit, front, sizeof unit);
    fr_unit3(unit);
    put_limb(limbs[0], unit, side[0], rows[0]);
    put_half(fork->at, front, apex, rows[3]);
    put_limb(limbs[1], unit, side[1], rows[6]);
    // The same for all patches: they share what is beside the ends of the arcs.
    double step = 0.3 * fmin(fork->limbs[BELOW].reach,
                             fmin(fork->limbs[ABOVE].reach, fork->limbs[BRANCH].reach));
    put_beside((const double(*)[4])rows[0], inwards[0], inwards[0], limbs[0]->reach / 3.0, rows[1]);
    put_beside((const double(*)[4])rows[3], limbs[0]->away, back, step, rows[2]);
    put_beside((const double(*)[4])rows[3], limbs[1]->away, tangent, step, rows[4]);
    put_beside((const double(*)[4])rows[6], inwards[1], inwards[1], limbs[1]->reach / 3.0, rows[5]);
}

void fr_fork_write(const FrNurbsJob *job, const FrTube *tube, const double *knots,
                   FrNurbsPiece *pieces, double (*points)[4]) {
    static const int pairs[FR_FORK_PIECES][2] = {{BELOW, ABOVE}, {BELOW, BRANCH}, {ABOVE, BRANCH}};
    FrFork fork;
    bool is_fork = find_fork(&job->plan, tube, &fork);
    FR_ASSERT(is_fork);
    const FrPlant *plant = job->plan.plant;
    uint32_t bearer = plant->nodes.axis[plant->axes.bearer[tube->axis]];
    for (int p = 0; p < FR_FORK_PIECES; p++) {
        double(*net)[4] = points + (size_t)p * COLUMNS * ROWS;
        put_patch(&fork, pairs[p][0], pairs[p][1], net);
        pieces[p] = (FrNurbsPiece){
            .surface = {2, 3, COLUMNS, ROWS, knots, knots + 8, (const double(*)[4])net},
            .kind = FR_NURBS_PATCH,
            .material = plant->axes.material[bearer],
            .axis = tube->axis,
            .organ = FR_NONE};
    }
}
