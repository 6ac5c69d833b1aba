/// @file params.h
/// The parameters of every component, one row each (param.h).
///
/// All components share FR_BASIC_PARAMS; Horn and Tree share FR_STEM_PARAMS. The shared rows come
/// first, so a parameter has the same index, and its field the same place, in every table.
#pragma once

#include "frond/param.h"

/// When it lives, how it grows and which of its material's colours it has. Times are years of its
/// own clock, which begins at its birth; `birth` and `time_scale` are of the clock around it.
#define FR_LIFE_PARAMS(X)                                                                          \
    X(NUMBER, birth, "0", -1000000, 1000000, "a", "",                                              \
      "when it comes into being: age of what it grows on")                                         \
    X(NUMBER, lifetime, "0", 0, 1000000, "a", "",                                                  \
      "how long it lives, with all that follows; 0: as long as what it grows on")                  \
    X(NUMBER, time_scale, "1", 0.000001, 1000000, "", "", "how fast its own clock runs")           \
    X(NUMBER, growth, "0", 0, 1000000, "a", "", "age at which it has its size; 0: from the first") \
    X(CURVE, growth_curve, "ramp", 0, 0, "", "", "part of its size over the part of that time")    \
    X(NUMBER, chance, "1", 0, 1, "", "",                                                           \
      "probability that it is there, with all that follows; falling in autumn: leaves fall")       \
    X(NUMBER, ramp_at, "= season", 0, 1, "", "", "where on the ramp of its material its colour is")

/// Where a component is moved to, when it is made, what it looks like.
#define FR_PLAIN_PARAMS(X)                                                                         \
    X(SWITCH, enabled, "yes", 0, 1, "", "", "made at all; if not, all that follows is left out")   \
    X(NUMBER, translate_x, "0", -10000, 10000, "m", "", "moved along its x axis, to the left")     \
    X(NUMBER, translate_y, "0", -10000, 10000, "m", "", "moved along its y axis, to the up side")  \
    X(NUMBER, translate_z, "0", -10000, 10000, "m", "", "moved along its z axis, forwards")        \
    X(NUMBER, rotate_x, "0", -36000, 36000, "deg", "", "turned first about its x axis")            \
    X(NUMBER, rotate_y, "0", -36000, 36000, "deg", "", "turned then about its y axis")             \
    X(NUMBER, rotate_z, "0", -36000, 36000, "deg", "", "turned last about its z axis")             \
    X(NUMBER, scale, "1", 0.000001, 1000000, "", "", "size of it and of all that follows")         \
    X(INTEGER, seed, "0", 0, 4294967295.0, "", "", "another seed rolls its random numbers anew")   \
    X(INTEGER, depth, "0", 0, 1000000, "", "",                                                     \
      "how often it may follow upon itself in a recursion; 0: no limit of its own")                \
    X(NUMBER, recursion_scale, "1", 0.000001, 1000, "", "",                                        \
      "scale of each further generation of a recursion")                                           \
    X(NUMBER, recursion_angle, "0", -36000, 36000, "deg", "",                                      \
      "turn about its x axis of each further generation of a recursion")                           \
    X(TEXT, only, "all", 0, 0, "", "",                                                             \
      "iterations it is made for: all, odd, even, first, last, 2,13, !2,13, 0..4, %3=1")           \
    X(TEXT, material, "", 0, 0, "", "", "id of the material; empty: as what it grows on")

/// Which way it turns whatever it stands on; degrees would depend on that.
#define FR_WORLDLY_PARAMS(X)                                                                       \
    X(CHOICE, tropism_axis, "z", 0, 0, "", "x y z", "which of its axes tropism-x, -y and -z turn") \
    X(NUMBER, tropism_x, "0", -1, 1, "", "",                                                       \
      "part of the way that axis turns to the plant's x axis; negative: away")                     \
    X(NUMBER, tropism_y, "0", -1, 1, "", "", "the same to y")                                      \
    X(NUMBER, tropism_z, "0", -1, 1, "", "", "the same to z, upright; negative: down")

/// What every component has.
#define FR_BASIC_PARAMS(X) FR_PLAIN_PARAMS(X) FR_LIFE_PARAMS(X) FR_WORLDLY_PARAMS(X)

/// The stem of Horn and Tree.
#define FR_STEM_PARAMS(X)                                                                          \
    X(CHOICE, course, "grown", 0, 0, "", "grown path steps",                                       \
      "how it runs: by curvature, gnarl and tropisms, along path, or step by step")                \
    X(NUMBER, length, "1", 0, 1000, "m", "", "length of the stem, or part of its parent's")        \
    X(CHOICE, length_mode, "absolute", 0, 0, "", "absolute of-parent of-remaining to-obstacle",    \
      "length in metres; or part of the parent stem's, of what of it is left beyond, of the way "  \
      "to a Force ahead that stems end at")                                                        \
    X(NUMBER, radius, "0.02", 0, 100, "m", "self", "radius at the base, or part of the parent's")  \
    X(CHOICE, radius_mode, "absolute", 0, 0, "", "absolute of-parent pipe",                        \
      "radius in metres; relative to the parent stem's where it is attached; or that of tips, "    \
      "and below as thick as all it bears")                                                        \
    X(NUMBER, taper, "0.8", 0, 1, "", "", "how much thinner the tip is: 0 not, 1 a point")         \
    X(CURVE, profile, "", 0, 0, "", "", "radius along the stem, in radii; instead of taper")       \
    X(NUMBER, min_radius, "0.0005", 0, 100, "m", "", "never thinner than this")                    \
    X(NUMBER, flatness, "1", 0.001, 1000, "", "self", "thickness along y over that along x")       \
    X(NUMBER, flare, "0", 0, 20, "", "", "how much wider the foot is, in radii")                   \
    X(REAL, flare_height, "0.1", 0.001, 1, "", "", "height of the wide foot, part of the length")  \
    X(POINTS, section, "", 0, 0, "", "", "cross-section of radius 1; empty: a circle")             \
    X(INTEGER, lobes, "0", 0, 32, "", "", "ribs of the cross-section, if section is empty")        \
    X(REAL, lobe_depth, "0.15", 0, 0.9, "", "", "depth of the grooves between them, in radii")     \
    X(CHOICE, primitive, "tube", 0, 0, "",                                                         \
      "tube area box sphere cone cylinder torus square circle triangle none mesh",                 \
      "a closed tube, an open area, or a string of objects")                                       \
    X(INTEGER, detail, "12", 3, 128, "", "", "segments around an object of a string")              \
    X(TEXT, file, "", 0, 0, "", "",                                                                \
      "file of triangles or surfaces for primitive=mesh, as wide as the stem")                     \
    X(CHOICE, tip, "pointed", 0, 0, "", "pointed flat round broken open", "end of the stem")       \
    X(NUMBER, break_chance, "0", 0, 1, "", "", "probability that it is broken off")                \
    X(NUMBER, break_at, "0.6", 0.01, 1, "", "", "where along the stem it then ends")               \
    X(NUMBER, forks, "0", 0, 6, "", "",                                                            \
      "how often it forks from base to tip; 1.5: twice by chance")                                 \
    X(INTEGER, fork_arms, "2", 2, 4, "", "", "stems that go on from a fork")                       \
    X(NUMBER, fork_start, "0.3", 0, 1, "", "", "where along the stem forks begin")                 \
    X(NUMBER, fork_end, "0.9", 0, 1, "", "", "where along the stem forks end")                     \
    X(NUMBER, fork_angle, "50", 0, 360, "deg", "", "angle between the arms of a fork")             \
    X(NUMBER, fork_azimuth, "0 ~ 180", -36000, 36000, "deg", "", "turn of a fork about the stem")  \
    X(NUMBER, fork_balance, "1", 0, 1, "", "",                                                     \
      "1 all arms turn aside alike, 0 one goes straight on")                                       \
    X(NUMBER, fork_radius, "0.8", 0.01, 1, "", "", "radius of each arm over that before the fork") \
    X(NUMBER, fork_straightness, "0", 0, 1, "", "", "how far arms turn back on their way")         \
    X(INTEGER, segments, "0", 0, 1000, "", "", "internodes, objects of a string; 0: as needed")    \
    X(NUMBER, curvature, "0", -3600, 3600, "deg", "self",                                          \
      "turn from base to tip, towards its y axis: up on a branch")                                 \
    X(CURVE, curvature_curve, "", 0, 0, "", "", "multiplies the curvature along the stem")         \
    X(NUMBER, twist, "0", -36000, 36000, "deg", "self", "turn about itself from base to tip")      \
    X(NUMBER, deviation, "0", 0, 90, "deg", "", "turn away from each branch: zigzag")              \
    X(NUMBER, gnarl, "0", 0, 180, "deg", "self", "how far it wanders to the sides")                \
    X(NUMBER, gnarl_frequency, "3", 0, 100, "", "", "how often it wanders over its length")        \
    X(NUMBER, gravitropism, "0", -20, 20, "", "self", "turns down; weeping; negative: away")       \
    X(NUMBER, phototropism, "0", -20, 20, "", "self", "turns up to the light; negative: away")     \
    X(NUMBER, plagiotropism, "0", -20, 20, "", "self", "turns to the horizontal; negative: away")  \
    X(NUMBER, force_weight, "1", 0, 1000, "", "", "how strongly Forces turn it; 0 not at all")     \
    X(TEXT, path, "", 0, 0, "", "", "points x,y,z x,y,z of the curve for course=path, in m")       \
    X(INTEGER, steps, "4", 1, 100000, "", "", "cross-sections or objects for course=steps")        \
    X(VECTOR, step_translate, "0, 0, 0.1", -1000, 1000, "m", "", "moved by in each step")          \
    X(NUMBER, step_rotate_x, "0", -3600, 3600, "deg", "", "turned about x in each step")           \
    X(NUMBER, step_rotate_y, "0", -3600, 3600, "deg", "", "turned about y in each step")           \
    X(NUMBER, step_rotate_z, "0", -3600, 3600, "deg", "", "turned about z in each step")           \
    X(NUMBER, step_scale, "1", 0.001, 1000, "", "", "size relative to the step before")

/// The surface of a stem's foot, bark and ends. The last rows of Horn and Tree, so that they
/// changed no draw of any row before.
#define FR_FINISH_PARAMS(X)                                                                        \
    X(CHOICE, break_tip, "flat", 0, 0, "", "flat broken", "its end where it is broken off")        \
    X(REAL, tip_height, "1", 0.05, 50, "", "", "of a round end or of splinters, in radii")         \
    X(CHOICE, foot, "closed", 0, 0, "", "closed open", "its base where it stands on nothing")      \
    X(REAL, wall, "0", 0, 1, "", "",                                                               \
      "wall of a hollow stem that does not end pointed or round, in radii; 0: solid")              \
    X(INTEGER, buttresses, "0", 0, 32, "", "", "plates around the foot")                           \
    X(REAL, buttress_depth, "1.5", 0, 20, "", "", "how far they stand out, in radii of the base")  \
    X(REAL, buttress_height, "4", 0.01, 100, "", "", "how far they reach up, in radii")            \
    X(REAL, buttress_width, "0.7", 0.05, 1, "", "", "part of the foot that they take")             \
    X(REAL, buttress_jitter, "0.6", 0, 1, "", "", "how much they differ in place and size")        \
    X(REAL, relief, "0", 0, 1, "", "", "depth of the furrows of the bark, in radii")               \
    X(REAL, relief_count, "14", 1, 128, "", "", "furrows around")                                  \
    X(REAL, relief_stretch, "4", 0.1, 100, "", "", "how much longer than wide they are")           \
    X(CHOICE, junction, "collar", 0, 0, "", "collar plain welded",                                 \
      "how it meets its parent: on a collar, as a tube that begins within it, or as one surface")

/// More of stems. Rows here are counted behind all others (fr_purpose), so that a new last one
/// changes no plant there is.
#define FR_STEM_MORE_PARAMS(X)                                                                     \
    X(NUMBER, curvature_back, "0", -3600, 3600, "deg", "",                                         \
      "turn of the outer half besides; an S where it is against the curvature")                    \
    X(NUMBER, gnarl_fine, "0", 0, 180, "deg", "", "how far it trembles on top of its gnarl")       \
    X(NUMBER, gnarl_fine_frequency, "12", 0, 100, "", "", "how often, over its length")            \
    X(NUMBER, align, "0", -20, 20, "", "", "turns to the direction of what it stands on")          \
    X(NUMBER, stiffness, "0", 0, 1000000, "GPa", "",                                               \
      "sags under its weight as wood so stiff: green wood 5 to 12; 0: not at all")                 \
    X(NUMBER, load, "0", 0, 1000, "", "", "weight of what it bears over its own, for sagging")     \
    X(REAL, pipe_exponent, "2.5", 1, 4, "", "",                                                    \
      "for radius-mode=pipe: 2 keeps the cross-section where stems divide, 3 is Murray's")         \
    X(TEXT, face_material, "", 0, 0, "", "",                                                       \
      "id of the material of a flat or broken end and of the inside of a hollow stem; empty: its " \
      "own")                                                                                       \
    X(NUMBER, aim, "0", -20, 20, "", "", "turns to the direction of aim-at; negative: away")       \
    X(VECTOR, aim_at, "0, 0, 1", -1000, 1000, "", "", "a direction of the plant, for aim")

/// How a Tree places its branches. From azimuth on, evaluated for each branch.
#define FR_BRANCHING_PARAMS(X)                                                                     \
    X(CHOICE, mode, "number", 0, 0, "", "number density internode nodes proportional bifurcation", \
      "what counts the branches: number, density or internode; one whorl at each node; number "    \
      "on the longest stem of a crown; or number of them at the end")                              \
    X(NUMBER, number, "10", 0, 1000000, "", "", "branches")                                        \
    X(NUMBER, density, "10", 0, 100000, "1/m", "", "branches per metre of stem")                   \
    X(NUMBER, internode, "0.1", 0.00001, 1000, "m", "", "stem between two places")                 \
    X(NUMBER, start, "0.2", 0, 1, "", "", "where along the stem branches begin")                   \
    X(NUMBER, end, "1", 0, 1, "", "", "where along the stem branches end")                         \
    X(CHOICE, spacing, "middle", 0, 0, "", "middle ends",                                          \
      "half a gap free at start and end, or branches exactly there")                               \
    X(CURVE, density_curve, "", 0, 0, "", "", "relative density along the stem")                   \
    X(NUMBER, regularity, "1", 0, 1, "", "", "1 evenly spaced, 0 at random within each gap")       \
    X(NUMBER, whorl, "1", 1, 64, "", "", "branches at each place")                                 \
    X(CHOICE, phyllotaxis, "spiral", 0, 0, "", "spiral distichous decussate alternate custom",     \
      "turn between places: 137.5, 180, 90 in pairs, 144, or azimuth-step")                        \
    X(NUMBER, azimuth_step, "137.50776405", -3600, 3600, "deg", "", "turn for custom")             \
    X(CHOICE, placement, "auto", 0, 0, "", "auto axis surface",                                    \
      "where branches begin; auto: stems on the axis, organs on the surface")                      \
    X(NUMBER, sweep, "360", 0, 360, "deg", "",                                                     \
      "sector around the upper side that they keep to; azimuth=180 takes it below")                \
    X(CHOICE, crown, "none", 0, 0, "",                                                             \
      "none conical spherical hemispherical cylindrical tapered-cylindrical flame "                \
      "inverse-conical tend-flame",                                                                \
      "length of branches from start to end as in the crowns of Weber and Penn")                   \
    X(NUMBER, azimuth, "0", -36000, 36000, "deg", "", "turn of each about the stem")               \
    X(NUMBER, azimuth_jitter, "0", 0, 180, "deg", "", "random turn about the stem")                \
    X(NUMBER, branching_angle, "45", -180, 180, "deg", "", "angle between branch and stem")        \
    X(NUMBER, roll, "0", -36000, 36000, "deg", "", "turn of the branch about itself")              \
    X(NUMBER, child_scale, "1", 0.000001, 1000, "", "", "size of the branch")                      \
    X(NUMBER, gap_ratio, "1", 0.1, 10, "", "", "each gap between places over the one before")      \
    X(NUMBER, apart, "0", 0, 1000, "m", "",                                                        \
      "branches whose feet are nearer to each other turn aside about the stem")                    \
    X(NUMBER, sink, "0", -100, 1, "", "",                                                          \
      "how deep in the stem what stands on the surface begins, in its radii; negative: off it")

/// Edge, bumps, shading and leaflets. The last rows, so that they changed no draw of any before.
#define FR_LEAF_DETAIL_PARAMS(X)                                                                   \
    X(NUMBER, edge_curl, "0", -720, 720, "deg", "",                                                \
      "turn of the outer third of each half, upwards")                                             \
    X(NUMBER, tip_droop, "0", -720, 720, "deg", "", "turn of the half towards the tip, downwards") \
    X(NUMBER, undulation, "0", 0, 1, "", "", "height of its bumps, of the width")                  \
    X(REAL, undulations, "3", 0.1, 20, "", "", "bumps along the blade")                            \
    X(CHOICE, margin, "entire", 0, 0, "", "entire serrate dentate crenate lobed", "its edge")      \
    X(INTEGER, teeth, "16", 0, 200, "", "", "teeth of each side; lobes: at most 20")               \
    X(REAL, tooth_depth, "0.06", 0, 1, "", "", "height of teeth, depth of lobes; of the width")    \
    X(REAL, tooth_sharpness, "0.5", 0, 1, "", "", "0 round, 0.5 straight, 1 hollow and pointed")   \
    X(CHOICE, normals, "surface", 0, 0, "", "surface flat round crown",                            \
      "which way it is shaded: as it is, flat, as a ball, away from the middle of the crown")      \
    X(CHOICE, compound, "simple", 0, 0, "", "simple pinnate bipinnate palmate",                    \
      "how leaflets stand; then length, width and outline are those of a leaflet")                 \
    X(NUMBER, leaflets, "5", 1, 60, "", "", "pairs of leaflets; leaflets of a palm")               \
    X(INTEGER, pinnae, "6", 1, 40, "", "", "pairs of pinnae of a bipinnate leaf")                  \
    X(SWITCH, terminal, "yes", 0, 1, "", "", "a leaflet, or pinna, at the end")                    \
    X(NUMBER, rachis_length, "0.2", 0, 100, "m", "", "from the end of the petiole to the last")    \
    X(NUMBER, rachis_curvature, "0", -720, 720, "deg", "", "turn of the rachis, upwards")          \
    X(NUMBER, leaflet_angle, "60", 0, 180, "deg", "",                                              \
      "from the rachis; of the outermost of a palm")                                               \
    X(REAL, leaflet_petiole, "0.002", 0, 10, "m", "", "length of the petiole of a leaflet")        \
    X(CURVE, leaflet_curve, "", 0, 0, "", "", "size of leaflets along the rachis")

/// Phototropism and gravitropism are evaluated for each leaf; the rest for each shape.
#define FR_LEAF_PARAMS(X)                                                                          \
    X(NUMBER, length, "0.1", 0.00001, 100, "m", "", "length of the blade")                         \
    X(NUMBER, width, "0.05", 0.00001, 100, "m", "", "greatest width of the blade")                 \
    X(NUMBER, petiole_length, "0.02", 0, 100, "m", "", "length of the petiole")                    \
    X(NUMBER, petiole_radius, "0.001", 0, 10, "m", "", "radius of the petiole")                    \
    X(NUMBER, petiole_bend, "0", -360, 360, "deg", "", "turn of the petiole, upwards")             \
    X(CHOICE, outline, "elliptic", 0, 0, "",                                                       \
      "elliptic ovate obovate lanceolate oblanceolate linear cordate orbicular rhombic "           \
      "spatulate deltoid petal superformula",                                                      \
      "form of the blade")                                                                         \
    X(POINTS, outline_points, "", 0, 0, "", "",                                                    \
      "own form: along 0-1, half width 0-0.5, base to tip; instead of outline")                    \
    X(NUMBER, curvature_along, "0", -720, 720, "deg", "self", "turn from base to tip, upwards")    \
    X(CURVE, along_curve, "", 0, 0, "", "", "spreads curvature-along from base to tip")            \
    X(NUMBER, curvature_across, "0", -720, 720, "deg", "self",                                     \
      "turn from midrib to margin, upwards")                                                       \
    X(CURVE, across_curve, "", 0, 0, "", "", "spreads curvature-across from base to tip")          \
    X(NUMBER, fold, "0", -180, 180, "deg", "self", "angle each half is lifted about the midrib")   \
    X(NUMBER, twist, "0", -720, 720, "deg", "self", "turn about the midrib from base to tip")      \
    X(NUMBER, wave, "0", 0, 1, "", "self", "height of the waves of the margin, of the width")      \
    X(NUMBER, waves, "3", 0, 100, "", "", "waves along the margin")                                \
    X(INTEGER, segments_along, "6", 1, 64, "", "", "segments from base to tip")                    \
    X(INTEGER, segments_across, "2", 1, 32, "", "", "segments of each half")                       \
    X(POINTS, left_points, "", 0, 0, "", "",                                                       \
      "left half of outline-points, where the halves differ")                                      \
    X(REAL, super_m, "4", 0, 20, "", "", "superformula: how many lobes a turn has")                \
    X(REAL, super_a, "1", 0.01, 5, "", "", "superformula: a, length of every other lobe")          \
    X(REAL, super_b, "1", 0.01, 5, "", "", "superformula: b, length of those between")             \
    X(REAL, super_n1, "2", 0.1, 50, "", "", "superformula: n1, small is slender")                  \
    X(REAL, super_n2, "2", 0.1, 50, "", "", "superformula: n2, form of the lobes")                 \
    X(REAL, super_n3, "2", 0.1, 50, "", "", "superformula: n3, form of the gaps")                  \
    X(INTEGER, variants, "8", 1, 256, "", "", "shapes its random numbers choose from")             \
    X(NUMBER, phototropism, "0", 0, 1, "", "", "turns its upper face to the light: 1 fully")       \
    X(NUMBER, gravitropism, "0", -1, 1, "", "", "hangs down: 1 fully; negative: stands up")        \
    FR_LEAF_DETAIL_PARAMS(X)

#define FR_SIMPLE_PARAMS(X)                                                                        \
    X(CHOICE, primitive, "box", 0, 0, "",                                                          \
      "tube area box sphere cone cylinder torus square circle triangle none mesh",                 \
      "a solid, or one cross-section of a tube or area joined with the next")                      \
    X(VECTOR, size, "0.1, 0.1, 0.1", 0, 10000, "m", "", "extent along x, y, z")                    \
    X(INTEGER, detail, "12", 3, 128, "", "", "segments around")                                    \
    X(TEXT, file, "", 0, 0, "", "",                                                                \
      "file of triangles or surfaces for primitive=mesh, in its own size")                         \
    X(POINTS, section, "", 0, 0, "", "", "cross-section of radius 1; empty: a circle")

typedef struct FrBasicParams {
    FR_BASIC_PARAMS(FR_PARAM_FIELD)
} FrBasicParams;

typedef struct FrSimpleParams {
    FR_BASIC_PARAMS(FR_PARAM_FIELD)
    FR_SIMPLE_PARAMS(FR_PARAM_FIELD)
} FrSimpleParams;

typedef struct FrStemParams {
    FR_BASIC_PARAMS(FR_PARAM_FIELD)
    FR_STEM_PARAMS(FR_PARAM_FIELD)
    FR_STEM_MORE_PARAMS(FR_PARAM_FIELD)
} FrStemParams;

typedef struct FrFinishParams {
    FR_FINISH_PARAMS(FR_PARAM_FIELD)
} FrFinishParams;

/// Both begin as FrStemParams.
typedef struct FrHornParams {
    FR_BASIC_PARAMS(FR_PARAM_FIELD)
    FR_STEM_PARAMS(FR_PARAM_FIELD)
    FR_STEM_MORE_PARAMS(FR_PARAM_FIELD)
    FR_FINISH_PARAMS(FR_PARAM_FIELD)
} FrHornParams;

typedef struct FrTreeParams {
    FR_BASIC_PARAMS(FR_PARAM_FIELD)
    FR_STEM_PARAMS(FR_PARAM_FIELD)
    FR_STEM_MORE_PARAMS(FR_PARAM_FIELD)
    FR_BRANCHING_PARAMS(FR_PARAM_FIELD)
    FR_FINISH_PARAMS(FR_PARAM_FIELD)
} FrTreeParams;

typedef struct FrLeafParams {
    FR_BASIC_PARAMS(FR_PARAM_FIELD)
    FR_LEAF_PARAMS(FR_PARAM_FIELD)
} FrLeafParams;

/// Index of each row in its table; fr_purpose() makes of it the purpose of its random draws.
#define FR_BASIC_ID(kind, field, ...) FR_BASIC_##field,
#define FR_STEM_ID(kind, field, ...) FR_STEM_##field,
#define FR_TREE_ID(kind, field, ...) FR_TREE_##field,
#define FR_LEAF_ID(kind, field, ...) FR_LEAF_##field,
enum { FR_BASIC_PARAMS(FR_BASIC_ID) FR_BASIC_COUNT };
enum { FR_PLAIN_COUNT = FR_BASIC_birth };
enum {
    FR_STEM_BEFORE = FR_BASIC_COUNT - 1,
    FR_STEM_PARAMS(FR_STEM_ID) FR_STEM_MORE_PARAMS(FR_STEM_ID) FR_STEM_COUNT
};
enum { FR_STEM_MORE = FR_STEM_curvature_back };
enum { FR_TREE_BEFORE = FR_STEM_COUNT - 1, FR_BRANCHING_PARAMS(FR_TREE_ID) FR_TREE_COUNT };
enum { FR_LEAF_BEFORE = FR_BASIC_COUNT - 1, FR_LEAF_PARAMS(FR_LEAF_ID) FR_LEAF_COUNT };
#undef FR_BASIC_ID
#undef FR_STEM_ID
#undef FR_TREE_ID
#undef FR_LEAF_ID

enum { FR_PURPOSE_LATER = 1 << 16 };

/// The purpose of a parameter's draws. Some rows came after those that stand behind them; they have
/// purposes of their own, so that they changed no plant there was.
static inline uint32_t fr_purpose(uint32_t parameter) {
    enum { LIFE = FR_BASIC_COUNT - FR_PLAIN_COUNT, MORE = FR_STEM_COUNT - FR_STEM_MORE };
    return parameter < FR_PLAIN_COUNT   ? parameter
           : parameter < FR_BASIC_COUNT ? parameter + FR_PURPOSE_LATER
           : parameter < FR_STEM_MORE   ? parameter - LIFE
           : parameter < FR_STEM_COUNT  ? parameter - FR_STEM_MORE + 2 * FR_PURPOSE_LATER
                                        : parameter - LIFE - MORE;
}

// The values of the CHOICE rows, in their order.
enum { FR_COURSE_GROWN, FR_COURSE_PATH, FR_COURSE_STEPS };
enum { FR_SIZE_ABSOLUTE, FR_SIZE_OF_PARENT, FR_SIZE_OF_REMAINING, FR_SIZE_TO_OBSTACLE };
enum { FR_RADIUS_BY_PIPES = 2 };
enum {
    FR_PRIMITIVE_TUBE,
    FR_PRIMITIVE_AREA,
    FR_PRIMITIVE_FIRST_SHAPE, ///< box; from here on in the order of FrShapeKind
    FR_PRIMITIVE_NONE = 10,
    FR_PRIMITIVE_MESH,
};
enum { FR_TIP_POINTED, FR_TIP_FLAT }; // from flat on in the order of FrCap
enum { FR_CROWN_NONE };
enum {
    FR_BRANCHES_BY_NUMBER,
    FR_BRANCHES_BY_DENSITY,
    FR_BRANCHES_BY_INTERNODE,
    FR_BRANCHES_AT_NODES,
    FR_BRANCHES_IN_PROPORTION,
    FR_BRANCHES_AT_END,
};
enum { FR_SPACING_MIDDLE, FR_SPACING_ENDS };
enum {
    FR_PHYLLOTAXIS_SPIRAL,
    FR_PHYLLOTAXIS_DISTICHOUS,
    FR_PHYLLOTAXIS_DECUSSATE,
    FR_PHYLLOTAXIS_ALTERNATE,
    FR_PHYLLOTAXIS_CUSTOM
};
enum { FR_PLACE_AUTO, FR_PLACE_ON_AXIS, FR_PLACE_ON_SURFACE };

#include "pgraph/params_global.h"
#include "pgraph/params_graft.h"
#include "pgraph/params_spread.h"
