// Polygons, generalized cylinders and surfaces: what begins and ends them.
#include "lsystem/build.h"

#include <math.h>

#define MOST_CORNERS 4000000
#define MOST_POLYGONS 1000

void fr_lturtle_corner(FrLturtle *turtle) {
    if (turtle->builder == NULL) {
        return;
    }
    if (turtle->corners->len >= MOST_CORNERS) {
        turtle->status = fr_lbuilder_limit(turtle->builder, turtle->corners->len + UINT64_C(1),
                                           MOST_CORNERS, "corners", "an open polygon");
        return;
    }
    g_array_append_vals(turtle->corners, turtle->pose.position, 1);
}

void fr_lturtle_open_shape(FrLturtle *turtle, const uint32_t *module) {
    double kind = fr_lturtle_value(module, 0, 0);
    fr_lturtle_end_node(turtle);
    if (kind != 0) {
        fr_lspline_begin(turtle, fr_lturtle_int(kind),
                         fr_lturtle_int(fr_lturtle_value(module, 1, 0)));
    } else if (turtle->polygons->len < MOST_POLYGONS) {
        FrLpolygon polygon = {turtle->pose, turtle->corners->len, fr_lhead_mark(*module)};
        g_array_append_val(turtle->polygons, polygon);
    }
}

void fr_lturtle_warn_of_open(const FrLturtle *turtle) {
    if (turtle->polygons->len > 0) {
        FrSpan span;
        uint32_t maker = g_array_index(turtle->polygons, FrLpolygon, 0).maker;
        fr_lderivation_maker(turtle->derivation, (uint16_t)maker, &span);
        fr_diags_add(turtle->context->diags, FR_WARNING, "polygon", span,
                     "a polygon begins here with '{' and no '}' ends it, so it is not drawn");
    }
}

void fr_lturtle_close_shape(FrLturtle *turtle, const uint32_t *module) {
    if (fr_lturtle_value(module, 0, 0) != 0) {
        fr_lspline_end(turtle);
        return;
    }
    if (turtle->polygons->len == 0) {
        return;
    }
    fr_lturtle_end_node(turtle);
    FrLpolygon polygon = g_array_index(turtle->polygons, FrLpolygon, turtle->polygons->len - 1);
    g_array_set_size(turtle->polygons, turtle->polygons->len - 1);
    if (turtle->builder != NULL) {
        fr_lbuilder_polygon(turtle->builder, &polygon.pose,
                            (const double(*)[3])(void *)turtle->corners->data + polygon.first,
                            turtle->corners->len - polygon.first);
        turtle->status = MAX(turtle->status, turtle->builder->status);
    }
    g_array_set_size(turtle->corners, polygon.first);
}

void fr_lturtle_dot(FrLturtle *turtle, const uint32_t *module) {
    if (turtle->polygons->len > 0) {
        fr_lturtle_corner(turtle);
    } else {
        fr_lspline_point(turtle, fr_lturtle_int(fr_lturtle_value(module, 0, 0)));
    }
}

/// Where the turtle goes after a surface; only the first of three scales counts.
static void leave_surface(FrLturtle *turtle, const FrLsurface *surface, double scale) {
    FrLpose *pose = &turtle->pose;
    for (int k = 0; k < 3; k++) {
        double to = pose->position[k] + surface->end[0] * scale * pose->left[k] +
                    surface->end[1] * scale * pose->heading[k] +
                    surface->end[2] * scale * pose->up[k];
        pose->stand &= surface->end[k] == 0 ? ~UINT64_C(0) : ~FR_LSTAND_TIP;
        pose->position[k] = surface->is_mesh  ? pose->position[k]
                            : fabs(to) < 1e12 ? (double)(float)to
                                              : 0;
    }
    turtle->is_moved = true;
}

void fr_lturtle_surface(FrLturtle *turtle, char symbol, const uint32_t *module) {
    FrLpose *pose = &turtle->pose;
    const GArray *surfaces = turtle->view->surfaces;
    for (guint i = 0; i < surfaces->len; i++) {
        const FrLsurface *surface = &g_array_index(surfaces, FrLsurface, i);
        if (surface->symbol != symbol) {
            continue;
        }
        double scale[3];
        bool is_three = fr_lhead_count(*module) >= 3;
        for (unsigned k = 0; k < 3; k++) {
            float value = (float)fr_lturtle_value(module, is_three ? k : 0, 1) * pose->scale;
            scale[k] = (double)value;
        }
        if (turtle->builder != NULL) {
            fr_lbuilder_surface(turtle->builder, pose, surface, scale);
            turtle->status = MAX(turtle->status, turtle->builder->status);
        }
        leave_surface(turtle, surface, scale[0]);
        return;
    }
}
