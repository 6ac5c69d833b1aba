// Branches of a rational skin: a swept net each, and two ruled caps.
#include "skin/nurbs_job.h"

#include <string.h>

enum { TUBE_GRAIN = 64 };

static void measure_tubes(void *data, size_t begin, size_t end, int worker) {
    FrNurbsJob *job = data;
    FrNurbsPath *path = &job->paths[worker];
    for (size_t i = begin; i < end; i++) {
        const FrTube *tube = &g_array_index(job->plan.tubes, FrTube, i);
        job->tubes[i].has_fork = fr_fork_is_wanted(job, tube);
        fr_nurbs_path(path, &job->plan, tube, job->params, job->tubes[i].has_fork);
        job->tubes[i].rows = fr_nurbs_rows(path, job->params);
    }
}

// An axis that goes on from another with its own profile turns into it on its way.
static uint32_t profile_before(const FrPlan *plan, const FrTube *tube) {
    const FrPlant *plant = plan->plant;
    const FrAxes *axes = &plant->axes;
    uint32_t bearer = axes->bearer[tube->axis];
    bool goes_on = bearer != FR_NONE && (axes->flags[tube->axis] & FR_CONTINUES) != 0 &&
                   axes->first[tube->axis] == tube->first;
    return goes_on ? axes->profile[plant->nodes.axis[bearer]] : axes->profile[tube->axis];
}

void fr_nurbs_place_tubes(FrNurbsJob *job) {
    const FrPlan *plan = &job->plan;
    fr_parallel_for(job->context->pool, plan->tubes->len, TUBE_GRAIN, measure_tubes, job,
                    job->context->progress);
    for (uint32_t i = 0; i < plan->tubes->len; i++) {
        const FrTube *tube = &g_array_index(plan->tubes, FrTube, i);
        FrNurbsPlace *place = &job->tubes[i];
        place->section = fr_nurbs_section(&job->sections, plan, profile_before(plan, tube),
                                          plan->plant->axes.profile[tube->axis], job->params);
        if (place->rows == 0) {
            continue;
        }
        const FrNurbsSection *section =
            &g_array_index(job->sections.sections, FrNurbsSection, place->section);
        bool has_caps = job->params->caps && section->is_closed;
        place->piece = job->pieces;
        place->point = job->points;
        place->knot = job->knots;
        job->pieces += has_caps ? 3 : 1;
        job->points += (uint64_t)section->from.count * (place->rows + (has_caps ? 2 : 0));
        job->knots += place->rows + 4;
        job->pieces += place->has_fork ? FR_FORK_PIECES : 0;
        job->points += place->has_fork ? FR_FORK_POINTS : 0;
    }
    uint32_t count = job->sections.sections->len;
    job->section_knot = g_new(uint64_t, count);
    for (uint32_t i = 0; i < count; i++) {
        const FrNurbsCurve *curve = &g_array_index(job->sections.sections, FrNurbsSection, i).from;
        job->section_knot[i] = job->knots;
        job->knots += curve->count + curve->degree + 1;
    }
}

// A cap is ruled from the rim to the middle of the path's end. The row of the middle lies next to
// the tube's net, whose outermost row is the rim of both.
static void write_cap(const FrNurbsJob *job, FrNurbsPiece *piece, const FrNurbsPiece *tube,
                      bool is_tip, const double centre[3], double (*middle)[4]) {
    uint32_t width = tube->surface.count_u;
    const double(*rim)[4] = (const double(*)[4])(is_tip ? middle - width : middle + width);
    for (uint32_t i = 0; i < width; i++) {
        memcpy(middle[i], centre, 3 * sizeof(double));
        middle[i][3] = rim[i][3];
    }
    *piece = *tube;
    piece->kind = is_tip ? FR_NURBS_CAP : FR_NURBS_FOOT;
    piece->surface.degree_v = 1;
    piece->surface.count_v = 2;
    piece->surface.knots_v = job->skin->knots;
    piece->surface.points = is_tip ? rim : (const double(*)[4])middle;
}

// Where the path of a net begins: with a smooth join not at its first point.
static void net_begin(const FrNurbsPath *path, const FrNurbsParams *params, double centre[3]) {
    const FrNurbsStation *s = path->stations;
    bool is_blend = params->join == FR_JOIN_SMOOTH && path->shared == 3;
    for (int k = 0; k < 3; k++) {
        centre[k] = is_blend ? (s[0].at[k] + 4.0 * s[1].at[k] + s[2].at[k]) / 6.0 : s[0].at[k];
    }
}

static void write_tube(const FrNurbsJob *job, uint32_t index, int worker) {
    const FrPlan *plan = &job->plan;
    const FrTube *tube = &g_array_index(plan->tubes, FrTube, index);
    const FrNurbsPlace *place = &job->tubes[index];
    const FrNurbsSection *section =
        &g_array_index(job->sections.sections, FrNurbsSection, place->section);
    FrNurbsSkin *skin = job->skin;
    FrNurbsPath *path = &job->paths[worker];
    uint32_t width = section->from.count;
    bool has_caps = job->params->caps && section->is_closed;
    double(*all)[4] = skin->points + place->point, *knots = skin->knots + place->knot;
    double(*net)[4] = has_caps ? all + width : all;
    fr_nurbs_path(path, plan, tube, job->params, place->has_fork);
    fr_nurbs_sweep(path, section, plan, job->params, net, knots);
    FrNurbsPiece *piece = &skin->pieces[place->piece];
    *piece = (FrNurbsPiece){
        .surface = {.degree_u = section->from.degree,
                    .degree_v = 3,
                    .count_u = width,
                    .count_v = place->rows,
                    .knots_u = skin->knots + job->section_knot[place->section],
                    .knots_v = knots,
                    .points = (const double(*)[4])net},
        .kind = FR_NURBS_TUBE,
        .material = plan->plant->axes.material[tube->axis],
        .axis = tube->axis,
        .organ = FR_NONE,
    };
    if (has_caps) {
        double centre[3];
        net_begin(path, job->params, centre);
        write_cap(job, piece + 1, piece, false, centre, all);
        write_cap(job, piece + 2, piece, true, path->stations[path->count - 1].at,
                  net + (size_t)width * place->rows);
    }
    uint64_t own = (uint64_t)width * (place->rows + (has_caps ? 2 : 0));
    if (place->has_fork) {
        fr_fork_write(job, tube, skin->knots + FR_RULED_KNOTS, piece + (has_caps ? 3 : 1),
                      all + own);
        own += FR_FORK_POINTS;
    }
    fr_nurbs_deform(job, tube->scope, all, own, worker);
}

static void write_tubes(void *data, size_t begin, size_t end, int worker) {
    const FrNurbsJob *job = data;
    for (size_t i = begin; i < end; i++) {
        if (job->tubes[i].rows > 0) {
            write_tube(job, (uint32_t)i, worker);
        }
    }
}

void fr_nurbs_write_tubes(FrNurbsJob *job) {
    fr_parallel_for(job->context->pool, job->plan.tubes->len, TUBE_GRAIN, write_tubes, job,
                    job->context->progress);
}
