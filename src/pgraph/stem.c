// Measuring stems: numbers, radii, places. How they bend is in stem_grow.c, into how many
// internodes they are cut in stem_internodes.c.
#include "pgraph/stem.h"

#include "pgraph/along.h"
#include "pgraph/fork.h"
#include "pgraph/life.h"

#include <cglm/struct.h>
#include <math.h>

#define PI 3.14159265358979323846
#define DEGREE (PI / 180)

// A place nearer to the tip than this stands on it.
#define AT_TIP 1e-6
#define LONGEST 1e9           // m
#define WEIGHT_OF_WOOD 8800.0 // N/m³, green
#define MOST_SAG 100.0
#define SHORTEST_REACH 1e-6

static uint32_t clamp_count(double count) {
    return count >= (double)(UINT32_MAX - 1) ? UINT32_MAX - 1 : count > 0 ? (uint32_t)count : 0;
}

// A thin round beam of wood under its own weight and what it bears, spread evenly: the moment of
// all beyond, as if that went straight on, over the stiffness E π r⁴/4.
double fr_stem_sag(const FrStem *stem, double at) {
    enum { PLACES = 8 };
    double beyond = 0, whole = 0;
    for (int k = 0; k < PLACES; k++) {
        double way = (1 - at) * (k + 0.5) / PLACES, far = fr_stem_radius(stem, at + way);
        double any = fr_stem_radius(stem, (k + 0.5) / PLACES);
        beyond += way * far * far * (1 - at) / PLACES;
        whole += any * any / PLACES;
    }
    beyond += stem->load * whole * 0.5 * (1 - at) * (1 - at);
    double radius = fr_stem_radius(stem, at), length = stem->length;
    double stiffness = stem->elasticity * radius * radius * radius * radius;
    double weight = 4 * WEIGHT_OF_WOOD * length * length * length * beyond;
    return weight < MOST_SAG * stiffness ? weight / stiffness : MOST_SAG;
}

static double divergence_of(const FrTreeParams *tree, FrEvaluator *evaluator) {
    switch (tree->phyllotaxis) {
    case FR_PHYLLOTAXIS_DISTICHOUS:
        return PI;
    case FR_PHYLLOTAXIS_DECUSSATE:
        return PI / 2;
    case FR_PHYLLOTAXIS_ALTERNATE:
        return 144 * DEGREE;
    case FR_PHYLLOTAXIS_CUSTOM:
        return fr_value(evaluator, &tree->azimuth_step, FR_TREE_azimuth_step);
    default:
        return 137.50776405003785 * DEGREE;
    }
}

// The branches of a Tree at the nodes of its stem, one whorl at each between start and end.
static void place_at_nodes(FrPlaces *places, uint32_t internodes) {
    double first = fmax(1, ceil(places->start * internodes - 1e-9));
    double last = floor(places->end * internodes + 1e-9);
    places->ratio = 1;
    places->irregularity = 0;
    places->pitch = internodes > 0 ? 1.0 / internodes : 0;
    places->start = first * places->pitch;
    places->branches = last >= first ? clamp_count((last - first + 1) * places->whorl) : 0;
}

static FrPlaces measure_places(const FrStem *stem, FrEvaluator *evaluator, FrStemBase base) {
    const FrTreeParams *tree = stem->prepared->params;
    double start = fr_value(evaluator, &tree->start, FR_TREE_start);
    double end = fr_value(evaluator, &tree->end, FR_TREE_end);
    bool is_decussate = tree->phyllotaxis == FR_PHYLLOTAXIS_DECUSSATE;
    double whorl = floor(fr_value(evaluator, &tree->whorl, FR_TREE_whorl) + 0.5);
    // Places are parts of what a break has left.
    FrPlaces places = {
        .whorl = (uint32_t)fmax(whorl, is_decussate ? 2 : 1),
        .start = fmin(fmin(start, end) / stem->whole, 1),
        .end = fmin(fmax(start, end) / stem->whole, 1),
        .irregularity = 1 - fr_value(evaluator, &tree->regularity, FR_TREE_regularity),
        .divergence = divergence_of(tree, evaluator),
        .is_at_ends = tree->spacing == FR_SPACING_ENDS,
        .density = stem->prepared->density,
        .key = evaluator->vars.key,
        .ratio = fr_value(evaluator, &tree->gap_ratio, FR_TREE_gap_ratio),
    };
    double reach = (places.end - places.start) * stem->length;
    if (tree->mode == FR_BRANCHES_BY_NUMBER || tree->mode == FR_BRANCHES_IN_PROPORTION) {
        double number = fr_value(evaluator, &tree->number, FR_TREE_number);
        double whole = fabs(end - start), left = (places.end - places.start) * stem->whole;
        number *= stem->whole < 1 && whole > 0 ? left / whole : 1;
        number *= tree->mode == FR_BRANCHES_IN_PROPORTION ? fmax(base.stretch, 0) : 1;
        places.branches = clamp_count(floor(number + 0.5));
    } else if (tree->mode == FR_BRANCHES_AT_END) {
        double number = fr_value(evaluator, &tree->number, FR_TREE_number);
        places.branches = places.whorl = clamp_count(floor(number + 0.5));
        places.whorl = MAX(places.whorl, 1);
        places.start = places.end;
    } else if (tree->mode == FR_BRANCHES_AT_NODES) {
        place_at_nodes(&places, stem->internodes);
    } else if (tree->mode == FR_BRANCHES_BY_DENSITY) {
        double density = fr_value(evaluator, &tree->density, FR_TREE_density) / base.scale;
        places.branches = clamp_count(floor(density * reach + 0.5));
    } else {
        double internode = base.scale * fr_value(evaluator, &tree->internode, FR_TREE_internode);
        double count = fr_places_within(reach / internode, places.ratio);
        places.branches = stem->length > 0 ? clamp_count(count * places.whorl) : 0;
        places.pitch = stem->length > 0 ? internode / stem->length : 0;
    }
    places.count = places.branches / places.whorl + (places.branches % places.whorl != 0);
    return places;
}

static versors turn_xyz(double x, double y, double z) {
    versors about_x = fr_rotation_about((vec3s){{1, 0, 0}}, (float)x);
    versors about_y = fr_rotation_about((vec3s){{0, 1, 0}}, (float)y);
    versors about_z = fr_rotation_about((vec3s){{0, 0, 1}}, (float)z);
    return fr_frame_step(about_z, fr_frame_step(about_y, about_x));
}

// Each step is T·R·S, so the chord to the next cross-section is T in the frame of the last. With
// the internode's frame turned onto the chord, every internode but the first turns by the same.
static void measure_steps(FrStem *stem, const FrStemParams *params, FrEvaluator *evaluator) {
    vec3s by = params->step_translate;
    double length = sqrt((double)(by.x * by.x + by.y * by.y + by.z * by.z));
    versors turn = turn_xyz(fr_value(evaluator, &params->step_rotate_x, FR_STEM_step_rotate_x),
                            fr_value(evaluator, &params->step_rotate_y, FR_STEM_step_rotate_y),
                            fr_value(evaluator, &params->step_rotate_z, FR_STEM_step_rotate_z));
    stem->step_chord = (versors){{0, 0, 0, 1}};
    if (length > 0) {
        float inverse = (float)(1 / length);
        vec3s chord = {{by.x * inverse, by.y * inverse, by.z * inverse}};
        stem->step_chord = fr_rotation_between((vec3s){{0, 0, 1}}, chord);
    }
    versors back = stem->step_chord;
    back.x = -back.x;
    back.y = -back.y;
    back.z = -back.z;
    stem->step_turn = fr_frame_step(fr_frame_step(back, turn), stem->step_chord);
    stem->step_scale = fr_value(evaluator, &params->step_scale, FR_STEM_step_scale);
    stem->step_length = length * stem->scale;
    stem->internodes = (uint32_t)params->steps - 1;
    double steps = stem->internodes, ratio = stem->step_scale;
    double sum = fabs(ratio - 1) < 1e-9 ? steps : (pow(ratio, steps) - 1) / (ratio - 1);
    stem->length = fmin(stem->step_length * sum, LONGEST);
}

static void measure_path(FrStem *stem) {
    const GArray *path = stem->path;
    const vec3s *points = (const vec3s *)(const void *)path->data;
    stem->internodes = path->len - 1;
    double length = 0;
    for (uint32_t k = 0; k + 1 < path->len; k++) {
        double x = (double)points[k + 1].x - (double)points[k].x;
        double y = (double)points[k + 1].y - (double)points[k].y;
        double z = (double)points[k + 1].z - (double)points[k].z;
        length += sqrt(x * x + y * y + z * z);
    }
    stem->length = length * stem->scale;
}

// Metres of length 1.
static double unit_of_length(const FrStemParams *params, FrStemBase base) {
    switch (params->length_mode) {
    case FR_SIZE_OF_PARENT:
        return base.scale * (base.has_parent ? base.parent_length : 1);
    case FR_SIZE_OF_REMAINING:
        return base.scale * (base.has_parent ? base.parent_length * fmax(1 - base.place, 0) : 1);
    case FR_SIZE_TO_OBSTACLE:
        return base.ahead >= 0 ? base.ahead : base.scale;
    default:
        return base.scale;
    }
}

// Where a stem aims at; a vector without direction turns nothing.
static void measure_aim(FrStem *stem, double strength) {
    vec3s at = ((const FrStemParams *)stem->prepared->params)->aim_at;
    float size = glms_vec3_norm(at);
    stem->aim = size > 0 ? strength : 0;
    stem->aim_at = size > 0 ? glms_vec3_divs(at, size) : at;
}

static void measure_numbers(FrStem *stem, FrEvaluator *evaluator, FrStemBase base) {
    const FrStemParams *params = stem->prepared->params;
#define FR_GET(field) fr_value(evaluator, &params->field, FR_STEM_##field)
    stem->length = FR_GET(length) * unit_of_length(params, base);
    stem->length *= base.stretch;
    bool is_relative = params->radius_mode == FR_SIZE_OF_PARENT && base.has_parent;
    stem->radius_unit = base.scale * (is_relative ? base.parent_radius : 1);
    stem->radius = FR_GET(radius) * base.scale * (is_relative ? base.parent_radius : 1);
    stem->taper = FR_GET(taper);
    stem->min_radius = FR_GET(min_radius);
    stem->flatness = FR_GET(flatness);
    stem->flare = FR_GET(flare);
    stem->curvature = FR_GET(curvature);
    stem->twist = FR_GET(twist);
    stem->gnarl = FR_GET(gnarl);
    stem->gnarl_frequency = FR_GET(gnarl_frequency);
    stem->curvature_back = FR_GET(curvature_back);
    stem->gnarl_fine = FR_GET(gnarl_fine);
    stem->gnarl_fine_frequency = FR_GET(gnarl_fine_frequency);
    stem->align = FR_GET(align);
    stem->align_to = base.heading;
    measure_aim(stem, FR_GET(aim));
    stem->elasticity = FR_GET(stiffness) * 1e9;
    stem->load = FR_GET(load);
    stem->tropism.up = FR_GET(phototropism);
    stem->tropism.down = FR_GET(gravitropism);
    stem->tropism.flat = FR_GET(plagiotropism);
    stem->forks = FR_GET(forks);
    stem->force_weight = FR_GET(force_weight);
    stem->deviation = stem->prepared->kind == FR_COMPONENT_TREE && stem->course == FR_COURSE_GROWN
                          ? FR_GET(deviation)
                          : 0;
#undef FR_GET
}

// What is left of a broken stem is as if it went on to where it was.
static void measure_break(FrStem *stem, FrEvaluator *evaluator) {
    const FrStemParams *params = stem->prepared->params;
    stem->whole = stem->slim = 1;
    if (stem->course != FR_COURSE_GROWN) {
        return;
    }
    double chance = fr_value(evaluator, &params->break_chance, FR_STEM_break_chance);
    if (chance > 0 && fr_random(stem->key, fr_purpose(FR_STEM_break_chance), 1) < chance) {
        stem->whole = stem->slim = fr_value(evaluator, &params->break_at, FR_STEM_break_at);
        stem->is_broken = stem->whole < 1;
        stem->length *= stem->whole;
        stem->twist *= stem->whole;
        stem->gnarl_frequency *= stem->whole;
        stem->gnarl_fine_frequency *= stem->whole;
    }
}

// What has grown up to now is as if all were there; only its thickness is that of a younger stem.
// Places are parts of what will be there.
static void measure_growth(FrStem *stem, FrEvaluator *evaluator) {
    if (!stem->prepared->grows) {
        return;
    }
    const FrBasicParams *basic = stem->prepared->params;
    double grown = fr_growth_now(stem->prepared, evaluator);
    stem->growth_time = fr_value(evaluator, &basic->growth, FR_BASIC_growth);
    stem->radius *= grown;
    stem->radius_unit *= grown;
    if (stem->course == FR_COURSE_STEPS) {
        stem->step_length *= grown;
        stem->length *= grown;
        return; // in all its parts at once
    }
    stem->reach = fmax(SHORTEST_REACH, fmin(grown / stem->whole, 1)); // a break is not there yet
    stem->slim = fmin(stem->whole / fmax(grown, SHORTEST_REACH), 1);
    stem->length *= stem->reach;
    stem->twist *= stem->reach;
    stem->gnarl_frequency *= stem->reach;
    stem->gnarl_fine_frequency *= stem->reach;
    stem->whole *= stem->reach;
    if (stem->limbs != NULL) {
        fr_stem_grow_limbs(stem);
    }
    if (stem->gaps > 0) {
        uint32_t each = stem->internodes / stem->gaps, gaps = 1;
        while (gaps < stem->gaps && fr_place_at(&stem->places, gaps - 1) < stem->reach) {
            gaps++;
        }
        stem->gaps = gaps;
        stem->internodes = each * gaps;
    }
}

double fr_stem_age_at(const FrStem *stem, double age, double at) {
    const FrBasicParams *basic = stem->prepared->params;
    double part = at * stem->whole / stem->reach; // of all that might be there
    double since = age - stem->growth_time * fr_growth_when(basic->growth_curve, part);
    return at <= stem->reach ? fmax(since, 0) : -1;
}

FrStem fr_stem_measure(const FrPrepared *prepared, FrEvaluator *evaluator, FrStemBase base) {
    const FrStemParams *params = prepared->params;
    FrStem stem = {
        .prepared = prepared,
        .evaluator = evaluator,
        .scale = base.scale,
        .key = evaluator->vars.key,
        .step = base.step,
        .is_in_field = base.is_in_field,
        .order = base.order,
        .is_on_ground = base.is_on_ground,
        .limb_count = 1,
        .axes = 1,
        .tips = 1,
        .reach = 1,
        .course = base.axis != NULL ? FR_COURSE_PATH : params->course,
        .path = base.axis != NULL ? base.axis : prepared->path,
        .bend = base.bend,
        .bend_aside = base.bend_aside,
    };
    measure_numbers(&stem, evaluator, base);
    measure_break(&stem, evaluator);
    if (stem.course == FR_COURSE_STEPS) {
        measure_steps(&stem, params, evaluator);
    } else if (stem.course == FR_COURSE_PATH) {
        measure_path(&stem);
    } else {
        stem.internodes =
            params->segments > 0 ? (uint32_t)params->segments : fr_stem_internodes(&stem);
    }
    if (prepared->kind == FR_COMPONENT_TREE) {
        stem.places = measure_places(&stem, evaluator, base);
        if (stem.deviation > 0 && stem.places.count > 0 && !(stem.forks > 0)) {
            double last = fr_place_at(&stem.places, stem.places.count - 1);
            stem.gaps = stem.places.count + (last < 1 - AT_TIP);
            uint32_t each = (stem.internodes + stem.gaps - 1) / stem.gaps;
            stem.internodes = clamp_count((double)each * stem.gaps);
        }
    }
    if (stem.forks > 0) {
        fr_stem_fork(&stem, evaluator);
    }
    measure_growth(&stem, evaluator);
    return stem;
}

double fr_stem_radius(const FrStem *stem, double at) {
    const FrStemParams *params = stem->prepared->params;
    double thick = fr_is_along(stem, FR_ALONG_RADIUS)
                       ? fr_along_at(stem, FR_ALONG_RADIUS, at) * stem->radius_unit
                       : stem->radius;
    double radius;
    if (stem->course == FR_COURSE_STEPS) {
        radius = thick * fmin(pow(stem->step_scale, at * stem->internodes), 1e6);
    } else if (params->radius_mode == FR_RADIUS_BY_PIPES) {
        radius = thick; // of tips; what is below follows once all is there
    } else if (params->profile != NULL) {
        radius = thick * fr_curve_eval(params->profile, at * stem->slim);
    } else {
        radius = thick * (1 - stem->taper * at * stem->slim);
    }
    if (stem->flare > 0 && at * stem->slim < params->flare_height) {
        double above = 1 - at * stem->slim / params->flare_height;
        radius += stem->radius * stem->flare * above * above * above;
    }
    return fmax(radius, stem->min_radius);
}

double fr_stem_flatness(const FrStem *stem, double at) {
    return fr_is_along(stem, FR_ALONG_FLATNESS) ? fr_along_at(stem, FR_ALONG_FLATNESS, at)
                                                : stem->flatness;
}

// The stretch between two places that bend the stem.
static void gap_ends(const FrStem *stem, uint32_t gap, double ends[2]) {
    ends[0] = gap > 0 ? fr_place_at(&stem->places, gap - 1) / stem->reach : 0;
    ends[1] = gap + 1 < stem->gaps ? fr_place_at(&stem->places, gap) / stem->reach : 1;
}

double fr_stem_node_end(const FrStem *stem, uint32_t k) {
    if (stem->gaps == 0) {
        return (double)(k + 1) / stem->internodes;
    }
    uint32_t each = stem->internodes / stem->gaps;
    double ends[2];
    gap_ends(stem, k / each, ends);
    return ends[0] + (ends[1] - ends[0]) * (k % each + 1) / each;
}

FrLimb fr_stem_whole(const FrStem *stem) {
    return (FrLimb){
        .end = 1,
        .before = FR_NONE,
        .begins_axis = true,
        .internodes = stem->internodes,
        .thinner = 1,
        .key = stem->key,
        .end_branch = stem->places.branches,
    };
}

double fr_limb_node_end(const FrStem *stem, const FrLimb *limb, uint32_t k) {
    if (stem->gaps > 0) {
        return fr_stem_node_end(stem, k);
    }
    return limb->start + (limb->end - limb->start) * (k + 1) / limb->internodes;
}

double fr_limb_radius(const FrStem *stem, const FrLimb *limb, double at) {
    double radius = fr_stem_radius(stem, at);
    return limb->thinner < 1 ? fmax(radius * limb->thinner, stem->min_radius) : radius;
}

uint32_t fr_limb_node_of(const FrStem *stem, const FrLimb *limb, double at, uint32_t place,
                         double *back) {
    if (stem->gaps > 0) {
        uint32_t each = stem->internodes / stem->gaps;
        *back = 0;
        return MIN((place + 1) * each, stem->internodes) - 1;
    }
    double along = (at - limb->start) / (limb->end - limb->start) * limb->internodes;
    double k = ceil(along - 1e-9) - 1;
    uint32_t last = limb->internodes > 0 ? limb->internodes - 1 : 0;
    uint32_t node = k <= 0 ? 0 : k >= last ? last : (uint32_t)k;
    *back = fmax(0, (double)(node + 1) - along);
    return node;
}
