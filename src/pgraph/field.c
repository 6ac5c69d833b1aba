// What turns a stem in fields that depend on where it is.
//
// In a constant field the angle α between stem and field decays as e^−κs; where several fields
// draw, their turns add and decay with the sum of their strengths (tropism.h). Here that solution
// is taken over stretches so short that the fields hardly change, always as many of them over the
// whole stem. So the form of a stem does not depend on its internodes, nor does strength overshoot.
#include "pgraph/field.h"

#include "pgraph/force.h"

#include <math.h>

#define PI 3.14159265358979323846

// Stretches of a stem: so many for each of the longest internodes that its fields allow, within
// bounds.
#define STRETCHES_PER_STEP 4.0
#define FEWEST_STRETCHES 16.0
#define MOST_STRETCHES 1024.0
// Away from fields a stem turns no faster than this over a stretch.
#define MOST_AWAY -1.0
// Shorter vectors have no direction.
#define SHORTEST 1e-12

bool fr_pgraph_samples_light(const FrPgraph *graph) {
    for (guint i = 0; i < graph->prototypes->len; i++) {
        const FrPrototype *prototype = fr_pgraph_prototype(graph, i);
        if (prototype->kind == FR_COMPONENT_WORLD &&
            ((const FrWorldParams *)prototype->params)->sampled) {
            return true;
        }
    }
    return false;
}

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void formula(const FrFields *fields, const FrField *field, const FrExpr *const map[3],
                    uint32_t parameter, const double local[3], double out[3]) {
    static const FrVars nothing = {0};
    double value[3];
    for (int k = 0; k < 3; k++) {
        FrExprFault fault = {0};
        value[k] = map[k] != NULL ? fr_expr_eval_with(map[k], &nothing, local, &fault) : 0;
        value[k] = fmax(-1e6, fmin(value[k], 1e6));
        fr_value_note(fields->evaluator, field->component, parameter + (uint32_t)k, &fault);
    }
    for (int r = 0; r < 3; r++) {
        out[r] = dot(field->axes[r], value);
    }
}

// The nearest World around; NULL if there is none.
static const FrField *world_of(const FrFields *fields) {
    for (uint32_t f = fields->innermost; f != FR_NONE; f = fields->fields[f].outer) {
        const FrField *field = &fields->fields[f];
        if (fields->prepared[field->component].kind == FR_COMPONENT_WORLD) {
            return field;
        }
    }
    return NULL;
}

// Whether a field is a Force that acts on a stem of this order.
static bool is_force_on(const FrFields *fields, const FrField *field) {
    const FrPrepared *prepared = &fields->prepared[field->component];
    if (prepared->kind != FR_COMPONENT_FORCE) {
        return false;
    }
    int to = ((const FrForceParams *)prepared->params)->apply_to;
    bool is_further = fields->order > field->order;
    return to == FR_APPLIES_TO_BOTH || is_further != (to == FR_APPLIES_TO_SELF);
}

void fr_field_gravity(const FrFields *fields, const double at[3], double gravity[3]) {
    const FrField *world = world_of(fields);
    gravity[0] = gravity[1] = 0;
    gravity[2] = -1;
    if (world != NULL) {
        const FrWorldParams *params = fields->prepared[world->component].params;
        const FrExpr *const map[3] = {params->gravity_x, params->gravity_y, params->gravity_z};
        double local[3];
        fr_field_local(world, at, local);
        formula(fields, world, map, FR_WORLD_gravity_x, local, gravity);
    }
}

void fr_field_light(const FrFields *fields, const double at[3], double light[3]) {
    const FrField *world = world_of(fields);
    light[0] = light[1] = 0;
    light[2] = 1;
    if (world != NULL) {
        const FrWorldParams *params = fields->prepared[world->component].params;
        if (params->sampled && fields->light != NULL) {
            vec3s point = {{(float)at[0], (float)at[1], (float)at[2]}};
            vec3s towards = fr_light_field_at(fields->light, point);
            for (int k = 0; k < 3; k++) {
                light[k] = (double)towards.raw[k];
            }
            return;
        }
        if (params->sun) {
            for (int r = 0; r < 3; r++) {
                light[r] = dot(world->axes[r], world->sun);
            }
            return;
        }
        const FrExpr *const map[3] = {params->light_x, params->light_y, params->light_z};
        double local[3];
        fr_field_local(world, at, local);
        formula(fields, world, map, FR_WORLD_light_x, local, light);
    }
}

// ---- turning ----------------------------------------------------------------------------------

// A stem on its way.
typedef struct Way {
    double heading[3];
    double side[3]; ///< across it, for where nothing else says about what to turn
    double turn[3]; ///< of all fields: axis times strength times angle
    double sum;     ///< of their strengths
} Way;

// Adds the turn towards `field`; across it where `is_across`.
static void draw(Way *way, const double field[3], double strength, bool is_across) {
    double size = sqrt(dot(field, field));
    if (size < SHORTEST || strength == 0) {
        return;
    }
    const double *h = way->heading;
    double axis[3] = {h[1] * field[2] - h[2] * field[1], h[2] * field[0] - h[0] * field[2],
                      h[0] * field[1] - h[1] * field[0]};
    double sine = sqrt(dot(axis, axis)), cosine = dot(h, field);
    double angle = atan2(sine, cosine);
    for (int k = 0; k < 3; k++) {
        axis[k] = sine > 1e-9 * size ? axis[k] / sine : way->side[k];
    }
    double rest = is_across ? 0.5 * PI : 0;
    for (int k = 0; k < 3; k++) {
        way->turn[k] += strength * size * (angle - rest) * axis[k];
    }
    way->sum += strength * size;
}

static void draw_all(const FrFields *fields, const FrDraw *what, const double at[3], double part,
                     Way *way) {
    double field[3];
    if (what->tropism.down != 0 || what->tropism.flat != 0) {
        fr_field_gravity(fields, at, field);
        draw(way, field, what->tropism.down * part, false);
        draw(way, field, what->tropism.flat * part, true);
    }
    if (what->tropism.up != 0) {
        fr_field_light(fields, at, field);
        draw(way, field, what->tropism.up * part, false);
    }
    for (uint32_t f = fields->innermost; f != FR_NONE; f = fields->fields[f].outer) {
        const FrField *force = &fields->fields[f];
        const FrPrepared *prepared = &fields->prepared[force->component];
        if (is_force_on(fields, force) && force->strength != 0) {
            double weight = fr_force_at(force, prepared, at, way->heading, field);
            double metres = part * what->length / force->scale * what->weight;
            const FrForceParams *params = prepared->params;
            metres *= params->order_factor != 1 ? pow(params->order_factor, fields->order) : 1;
            draw(way, field, weight * force->strength * metres, false);
        }
    }
}

static versors turned_by(const double turn[3], double size, double angle) {
    vec3s axis = {{(float)(turn[0] / size), (float)(turn[1] / size), (float)(turn[2] / size)}};
    return fr_rotation_about(axis, (float)angle);
}

versors fr_field_turn(const FrFields *fields, const FrDraw *what, versors frame, vec3s from,
                      double step) {
    versors whole = {{0, 0, 0, 1}};
    double at[3] = {(double)from.x, (double)from.y, (double)from.z};
    double stretches = STRETCHES_PER_STEP * what->length / what->finest;
    stretches = fmax(FEWEST_STRETCHES, fmin(stretches, MOST_STRETCHES));
    uint32_t count = (uint32_t)fmax(1, ceil(step * stretches - 1e-9));
    double part = step / count;
    for (uint32_t k = 0; k < count; k++) {
        Way way = {0};
        vec3s heading = fr_frame_heading(frame), side = fr_frame_left(frame);
        for (int r = 0; r < 3; r++) {
            way.heading[r] = (double)heading.raw[r];
            way.side[r] = (double)side.raw[r];
            at[r] += 0.5 * part * what->length * way.heading[r];
        }
        draw_all(fields, what, at, part, &way);
        double sum = fmax(way.sum, MOST_AWAY);
        double shrunk = fabs(sum) > 1e-9 ? -expm1(-sum) / sum : 1;
        double angle = sqrt(dot(way.turn, way.turn));
        if (angle > SHORTEST) {
            versors turn = turned_by(way.turn, angle, fmin(shrunk * angle, PI));
            frame = fr_frame_step(turn, frame);
            whole = fr_frame_step(turn, whole);
            heading = fr_frame_heading(frame);
        }
        for (int r = 0; r < 3; r++) {
            at[r] += 0.5 * part * what->length * (double)heading.raw[r];
        }
    }
    return whole;
}

// ---- solids -----------------------------------------------------------------------------------

// Lifts the heading off a surface until the internode's end is clear of it. True if it was turned.
static bool lift(const FrField *force, const FrPrepared *prepared, const double from[3],
                 double length, double radius, double heading[3]) {
    enum { TRIES = 6 };
    bool is_turned = false;
    for (int k = 0; k < TRIES; k++) {
        double end[3], outward[3];
        for (int r = 0; r < 3; r++) {
            end[r] = from[r] + length * heading[r];
        }
        double depth = radius - fr_force_clearance(force, prepared, end, outward);
        if (!(depth > 1e-7 * length)) {
            break;
        }
        double rise = dot(heading, outward), along[3];
        for (int r = 0; r < 3; r++) {
            along[r] = heading[r] - rise * outward[r];
        }
        double size = sqrt(dot(along, along));
        if (size < 1e-6) { // straight at it: aside, always to the same side
            int k0 = fabs(outward[0]) < 0.6 ? 0 : 1;
            for (int r = 0; r < 3; r++) {
                along[r] = (r == k0) - outward[k0] * outward[r];
            }
            size = sqrt(dot(along, along));
        }
        double wanted = fmin(rise + 1.01 * depth / length, 1);
        double flat = sqrt(fmax(0, 1 - wanted * wanted));
        for (int r = 0; r < 3; r++) {
            heading[r] = wanted * outward[r] + flat * along[r] / size;
        }
        is_turned = true;
    }
    return is_turned;
}

bool fr_field_deflect(const FrFields *fields, versors frame, vec3s from, double length,
                      double radius, versors *turn) {
    vec3s before = fr_frame_heading(frame);
    double at[3], heading[3];
    for (int r = 0; r < 3; r++) {
        at[r] = (double)from.raw[r];
        heading[r] = (double)before.raw[r];
    }
    bool is_turned = false;
    for (uint32_t f = fields->innermost; f != FR_NONE && length > 0; f = fields->fields[f].outer) {
        const FrField *force = &fields->fields[f];
        const FrPrepared *prepared = &fields->prepared[force->component];
        const FrForceParams *params = prepared->params;
        if (is_force_on(fields, force) && params->solid == FR_SOLID_SLIDE) {
            is_turned |= lift(force, prepared, at, length, radius, heading);
        }
    }
    if (is_turned) {
        vec3s after = {{(float)heading[0], (float)heading[1], (float)heading[2]}};
        *turn = fr_rotation_between(before, after);
    }
    return is_turned;
}

// How far one may go from `from` until one meets a force: where its surface is at least so far
// away, one may go as far (Hart. Sphere Tracing. The Visual Computer 12, 1996).
static double free_of(const FrField *force, const FrPrepared *prepared, const double from[3],
                      const double heading[3], double length, bool *may_come_out) {
    enum { MOST_STEPS = 64 };
    double gone = 0, nearest = 1e-4 * length;
    for (int k = 0; k < MOST_STEPS; k++) {
        double at[3], outward[3];
        for (int r = 0; r < 3; r++) {
            at[r] = from[r] + gone * heading[r];
        }
        double clear = fr_force_clearance(force, prepared, at, outward);
        *may_come_out &= clear < nearest;
        if (clear < nearest && !*may_come_out) {
            return gone;
        }
        gone += fmax(fabs(clear), nearest);
        if (gone >= length) {
            break;
        }
    }
    return length;
}

double fr_field_free(const FrFields *fields, versors frame, vec3s from, double length,
                     uint64_t *out, bool *is_cut) {
    vec3s before = fr_frame_heading(frame);
    double at[3], heading[3], free = length;
    for (int r = 0; r < 3; r++) {
        at[r] = (double)from.raw[r];
        heading[r] = (double)before.raw[r];
    }
    *is_cut = false;
    uint64_t bit = 1;
    for (uint32_t f = fields->innermost; f != FR_NONE && free > 0; f = fields->fields[f].outer) {
        const FrField *force = &fields->fields[f];
        const FrPrepared *prepared = &fields->prepared[force->component];
        const FrForceParams *params = prepared->params;
        if (is_force_on(fields, force) && params->solid >= FR_SOLID_STOP) {
            bool may_come_out = (*out & bit) == 0;
            double own = free_of(force, prepared, at, heading, free, &may_come_out);
            *out |= may_come_out ? 0 : bit;
            bit = bit << 1 | bit >> 63;
            *is_cut = own < free ? params->solid == FR_SOLID_PRUNE : *is_cut;
            free = own;
        }
    }
    return free;
}
