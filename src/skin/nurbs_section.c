// Cross-sections of rational sweeps: exact circles, profiles as control polygons, and one that
// turns into another. Two curves blend point by point once they have the same degree and knots.
#include "skin/nurbs.h"

static void section_clear(gpointer data) {
    FrNurbsSection *section = data;
    if (section->changes) {
        fr_nurbs_curve_clear(&section->to);
    }
    fr_nurbs_curve_clear(&section->from);
}

void fr_nurbs_sections_init(FrNurbsSections *sections) {
    sections->sections = g_array_new(FALSE, FALSE, sizeof(FrNurbsSection));
    g_array_set_clear_func(sections->sections, section_clear);
    sections->index = g_hash_table_new_full(fr_key_hash, g_int64_equal, g_free, NULL);
}

void fr_nurbs_sections_clear(FrNurbsSections *sections) {
    g_array_unref(sections->sections);
    g_hash_table_unref(sections->index);
}

/// The curve of a profile, or a circle of the wanted form.
static FrNurbsCurve curve_of(const FrPlan *plan, uint32_t profile, FrNurbsCircle circle,
                             uint32_t degree) {
    const FrSection *section = fr_plan_profile(plan, profile);
    if (section == NULL) {
        return fr_nurbs_circle(circle);
    }
    uint32_t count = section->is_closed ? section->count - 1 : section->count;
    double(*points)[2] = g_malloc_n(count, sizeof *points);
    for (uint32_t i = 0; i < count; i++) {
        points[i][0] = (double)section->columns[i].x;
        points[i][1] = (double)section->columns[i].y;
    }
    FrNurbsCurve curve =
        fr_nurbs_from_polygon((const double(*)[2])points, count, section->is_closed, degree);
    g_free(points);
    return curve;
}

static bool is_closed(const FrPlan *plan, uint32_t profile) {
    const FrSection *section = fr_plan_profile(plan, profile);
    return section == NULL || section->is_closed;
}

uint32_t fr_nurbs_section(FrNurbsSections *sections, const FrPlan *plan, uint32_t from, uint32_t to,
                          const FrNurbsParams *params) {
    if (is_closed(plan, from) != is_closed(plan, to)) {
        from = to; // a tube does not open on its way
    }
    gint64 key = (gint64)((((uint64_t)from + 1) << 32) | ((uint64_t)to + 1));
    gpointer found = g_hash_table_lookup(sections->index, &key);
    if (found != NULL) {
        return GPOINTER_TO_UINT(found) - 1;
    }
    uint32_t degree = (uint32_t)params->profile_degree;
    FrNurbsSection section = {
        .is_round = fr_plan_profile(plan, from) == NULL && fr_plan_profile(plan, to) == NULL,
        .is_closed = is_closed(plan, to),
        .changes = from != to,
    };
    if (section.changes) {
        // A cubic circle and cubic profiles have a common refinement.
        section.from = curve_of(plan, from, FR_CIRCLE_CUBIC, 3);
        section.to = curve_of(plan, to, FR_CIRCLE_CUBIC, 3);
        section.changes = section.from.degree == section.to.degree;
    }
    if (section.changes) {
        fr_nurbs_curves_merge(&section.from, &section.to);
    } else {
        fr_nurbs_curve_clear(&section.from);
        fr_nurbs_curve_clear(&section.to);
        section.from = curve_of(plan, to, (FrNurbsCircle)params->circle, degree);
        section.to = section.from;
    }
    g_array_append_val(sections->sections, section);
    gint64 *own = g_new(gint64, 1);
    *own = key;
    g_hash_table_insert(sections->index, own, GUINT_TO_POINTER(sections->sections->len));
    return sections->sections->len - 1;
}
