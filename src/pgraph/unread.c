// Parameters of components that others leave without effect.
#include "expr/unread.h"
#include "pgraph/params.h"

#include "frond/pgraph.h"

static const FrParamCondition conditions[] = {
    // stems
    {"horn tree", "length length_mode break_chance break_at forks curvature curvature_curve",
     "course", "grown"},
    {"horn tree", "gnarl gnarl_frequency gravitropism phototropism plagiotropism force_weight",
     "course", "grown"},
    {"horn tree", "curvature_back gnarl_fine align aim stiffness load deviation", "course",
     "grown"},
    {"horn tree", "aim_at", "aim", "!0"},
    {"horn tree", "segments twist", "course", "grown path"},
    {"horn tree", "path", "course", "path"},
    {"horn tree", "steps step_translate step_rotate_x step_rotate_y step_rotate_z step_scale",
     "course", "steps"},
    {"horn tree", "profile", "course", "grown path"},
    {"horn tree", "taper", "profile", ""},
    {"horn tree", "taper profile", "radius_mode", "absolute of-parent"},
    {"horn tree", "pipe_exponent", "radius_mode", "pipe"},
    {"horn tree simple", "section", "primitive", "tube area"},
    {"horn tree", "lobes lobe_depth", "section", ""},
    {"horn tree", "lobes lobe_depth", "primitive", "tube"},
    {"horn tree simple", "file", "primitive", "mesh"},
    {"horn tree simple", "detail", "primitive", "sphere cone cylinder torus circle"},
    {"simple", "size", "primitive",
     "tube area box sphere cone cylinder torus square circle triangle"},
    {"horn tree", "fork_arms fork_start fork_end fork_angle fork_azimuth fork_balance fork_radius",
     "forks", "!0"},
    {"horn tree", "fork_straightness", "forks", "!0"},
    {"horn tree", "break_at", "break_chance", "!0"},
    {"horn tree", "flare_height", "flare", "!0"},
    {"horn tree", "gnarl_fine_frequency", "gnarl_fine", "!0"},
    {"horn tree", "load", "stiffness", "!0"},
    {"horn tree", "deviation", "forks", "0"},
    // branches
    {"tree", "number", "mode", "number proportional bifurcation"},
    {"tree scatter", "density", "mode", "density"},
    {"tree", "internode", "mode", "internode"},
    {"tree", "start whorl", "mode", "number density internode nodes proportional"},
    {"tree", "regularity gap_ratio", "mode", "number density internode proportional"},
    {"tree", "spacing density_curve", "mode", "number density proportional"},
    {"tree", "azimuth_step", "phyllotaxis", "custom"},
    // leaves
    {"leaf", "outline", "outline_points", ""},
    {"leaf", "left_points", "outline_points", "*"},
    {"leaf", "super_m super_a super_b super_n1 super_n2 super_n3", "outline_points", ""},
    {"leaf", "super_m super_a super_b super_n1 super_n2 super_n3", "outline", "superformula"},
    // what spreads, scatters and chooses
    {"phiball phyllotaxis", "radius", "radius_mode", "absolute"},
    {"phiball phyllotaxis", "child_area", "radius_mode", "by-area"},
    {"phiball phyllotaxis", "child_radius", "radius_mode", "touching"},
    {"phyllotaxis", "form", "outline", ""},
    {"phyllotaxis", "smooth", "outline", "*"},
    {"scatter", "file density_file slope_from slope_to height_from height_to align", "surface",
     "mesh"},
    {"scatter", "radius", "surface", "disc square ring"},
    {"scatter", "inner_radius", "surface", "ring"},
    {"scatter", "number", "mode", "number"},
    {"variation", "weights", "rule", "random"},
    {"variation", "choice", "rule", "choice"},
    // what acts on all that follows
    {"ffd", "to_x to_y to_z", "preset", "none"},
    {"ffd", "path", "preset", "curve"},
    {"ffd", "degree_x degree_y degree_z", "form", "lattice"},
    {"world", "light_x light_y light_z", "sun", "no"},
    {"world", "sun_azimuth sun_elevation", "sun", "yes"},
    {"force", "direction", "kind", "direction"},
    {"force", "path", "kind", "curve"},
    {"force", "size", "kind", "box cylinder"},
    {"force", "file", "kind", "mesh"},
    {"force", "pitch", "kind", "vortex"},
    {"force", "range", "falloff", "linear inverse gauss"},
    {"force", "reach", "action", "follow pull avoid"},
    // all
    {"*", "growth_curve", "growth", "!0"},
    {"*", "tropism_axis", "tropism_x tropism_y tropism_z", "!0"},
};

char *fr_pgraph_why_unread(FrComponentKind kind, const void *params, const FrParam *row) {
    return fr_params_why_unread(conditions, G_N_ELEMENTS(conditions), fr_pgraph_table(kind), params,
                                row);
}
