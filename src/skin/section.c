// Cross-sections of tubes: regular polygons and profiles, with normals, texture coordinates and the
// triangles that close them.
// Ear clipping after: Meisters. Polygons have ears. American Mathematical Monthly 82, 1975.
#include "skin/section.h"

#include <math.h>

// Ear clipping takes quadratic time, cubic at worst; larger profiles are closed by a fan, right for
// convex ones.
enum { EARS_MOST = 128 };

static void allocate(FrSection *section, uint32_t points, bool is_closed) {
    section->is_closed = is_closed;
    section->count = is_closed ? points + 1 : points;
    section->columns = g_new0(FrColumn, section->count);
    section->cap = is_closed ? g_new(uint32_t, 3 * (size_t)(points - 2)) : NULL;
}

static void fan(uint32_t *cap, uint32_t points) {
    for (uint32_t i = 0; i + 2 < points; i++) {
        cap[3 * i] = 0;
        cap[3 * i + 1] = i + 1;
        cap[3 * i + 2] = i + 2;
    }
}

static float cross2(const FrColumn *a, const FrColumn *b, const FrColumn *c) {
    return (b->x - a->x) * (c->y - a->y) - (b->y - a->y) * (c->x - a->x);
}

static bool is_ear(const FrColumn *columns, const uint32_t *ring, uint32_t left, uint32_t at) {
    uint32_t before = (at + left - 1) % left, after = (at + 1) % left;
    const FrColumn *a = &columns[ring[before]], *b = &columns[ring[at]], *c = &columns[ring[after]];
    if (cross2(a, b, c) <= 0.0F) {
        return false;
    }
    for (uint32_t i = 0; i < left; i++) {
        const FrColumn *p = &columns[ring[i]];
        if (i != before && i != at && i != after && cross2(a, b, p) >= 0.0F &&
            cross2(b, c, p) >= 0.0F && cross2(c, a, p) >= 0.0F) {
            return false;
        }
    }
    return true;
}

static void clip_ears(const FrColumn *columns, uint32_t points, uint32_t *cap) {
    uint32_t ring[EARS_MOST];
    for (uint32_t i = 0; i < points; i++) {
        ring[i] = i;
    }
    uint32_t left = points, at = 0, missed = 0;
    while (left > 3) {
        // A polygon that crosses itself may have no ear: then any corner is cut off.
        if (!is_ear(columns, ring, left, at) && missed < left) {
            at = (at + 1) % left;
            missed++;
            continue;
        }
        *cap++ = ring[(at + left - 1) % left];
        *cap++ = ring[at];
        *cap++ = ring[(at + 1) % left];
        left--;
        for (uint32_t i = at; i < left; i++) {
            ring[i] = ring[i + 1];
        }
        at = at % left;
        missed = 0;
    }
    *cap++ = ring[0];
    *cap++ = ring[1];
    *cap++ = ring[2];
}

void fr_section_round(FrSection *section, uint32_t sides) {
    *section = (FrSection){.is_round = true};
    allocate(section, sides, true);
    for (uint32_t i = 0; i < sides; i++) {
        double angle = 2.0 * G_PI * (double)i / (double)sides;
        float x = (float)cos(angle), y = (float)sin(angle);
        section->columns[i] = (FrColumn){x, y, x, y, (float)i / (float)sides};
    }
    section->columns[sides] = section->columns[0];
    section->columns[sides].u = 1.0F;
    fan(section->cap, sides);
    for (uint32_t i = 0; i < FR_REACH_COUNT; i++) {
        section->reach[i] = 1.0F;
    }
}

bool fr_section_is_near(const double point[2]) {
    return fabs(point[0]) < FR_SECTION_FARTHEST && fabs(point[1]) < FR_SECTION_FARTHEST;
}

uint32_t fr_section_points(const FrProfile *profile, double (*out)[2]) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < profile->count; i++) {
        double x = profile->points[i][0], y = profile->points[i][1];
        if (fr_section_is_near(profile->points[i]) &&
            (count == 0 || hypot(x - out[count - 1][0], y - out[count - 1][1]) > 1e-6)) {
            out[count][0] = x;
            out[count++][1] = y;
        }
    }
    while (profile->is_closed && count > 1 &&
           hypot(out[0][0] - out[count - 1][0], out[0][1] - out[count - 1][1]) <= 1e-6) {
        count--;
    }
    return count;
}

// Closed: counter-clockwise. Open: the front is towards +y.
static bool must_turn(double (*points)[2], uint32_t count, bool is_closed) {
    if (!is_closed) {
        return points[count - 1][0] > points[0][0];
    }
    double area = 0.0;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t j = (i + 1) % count;
        area += points[i][0] * points[j][1] - points[j][0] * points[i][1];
    }
    return area < 0.0;
}

static void turn(double (*points)[2], uint32_t count) {
    for (uint32_t i = 0, j = count - 1; i < j; i++, j--) {
        for (int k = 0; k < 2; k++) {
            double swap = points[i][k];
            points[i][k] = points[j][k];
            points[j][k] = swap;
        }
    }
}

// Each edge turned clockwise points outwards; a corner has the mean of its edges.
static void set_normals(FrSection *section, uint32_t points) {
    FrColumn *c = section->columns;
    for (uint32_t i = 0; i < points; i++) {
        const FrColumn *before = &c[i > 0 ? i - 1 : (section->is_closed ? points - 1 : 0)];
        const FrColumn *after = &c[i + 1 < points ? i + 1 : (section->is_closed ? 0 : i)];
        float x = 0.0F, y = 0.0F;
        const FrColumn *ends[3] = {before, &c[i], after};
        for (int k = 0; k < 2; k++) {
            float dx = ends[k + 1]->x - ends[k]->x, dy = ends[k + 1]->y - ends[k]->y;
            float length = sqrtf(dx * dx + dy * dy);
            if (length > 0.0F) {
                x += dy / length;
                y -= dx / length;
            }
        }
        float length = sqrtf(x * x + y * y);
        bool is_spike = length < 1e-4F;
        float radius = sqrtf(c[i].x * c[i].x + c[i].y * c[i].y);
        c[i].normal_x = !is_spike ? x / length : radius > 0.0F ? c[i].x / radius : 0.0F;
        c[i].normal_y = !is_spike ? y / length : radius > 0.0F ? c[i].y / radius : 1.0F;
    }
}

static void set_texture(FrSection *section, uint32_t points) {
    FrColumn *c = section->columns;
    float length = 0.0F;
    for (uint32_t i = 0; i < points; i++) {
        const FrColumn *after = &c[i + 1 < points ? i + 1 : 0];
        c[i].u = length;
        bool is_last = i + 1 == points && !section->is_closed;
        length += is_last ? 0.0F : hypotf(after->x - c[i].x, after->y - c[i].y);
    }
    for (uint32_t i = 0; i < points; i++) {
        c[i].u /= length;
    }
    if (section->is_closed) {
        c[points] = c[0];
        c[points].u = 1.0F;
    }
}

// For every direction the nearest crossing of the margin: inside of it is surely inside the tube.
static void set_reach(FrSection *section) {
    float direction[FR_REACH_COUNT][2];
    for (uint32_t k = 0; k < FR_REACH_COUNT; k++) {
        double angle = 2.0 * G_PI * (double)k / FR_REACH_COUNT;
        direction[k][0] = (float)cos(angle);
        direction[k][1] = (float)sin(angle);
        section->reach[k] = INFINITY;
    }
    for (uint32_t i = 0; i + 1 < section->count; i++) {
        const FrColumn *a = &section->columns[i], *b = a + 1;
        for (uint32_t k = 0; k < FR_REACH_COUNT; k++) {
            float dx = direction[k][0], dy = direction[k][1];
            float side_a = dx * a->y - dy * a->x, side_b = dx * b->y - dy * b->x;
            if (side_a == side_b || side_a * side_b > 0.0F) {
                continue;
            }
            float t = side_a / (side_a - side_b);
            float along = dx * (a->x + t * (b->x - a->x)) + dy * (a->y + t * (b->y - a->y));
            bool is_nearer = along > 0.0F && along < section->reach[k];
            section->reach[k] = is_nearer ? along : section->reach[k];
        }
    }
    for (uint32_t k = 0; k < FR_REACH_COUNT; k++) {
        section->reach[k] = isfinite(section->reach[k]) ? section->reach[k] : 0.0F;
    }
}

bool fr_section_profile(FrSection *section, const FrProfile *profile) {
    *section = (FrSection){0};
    double(*points)[2] = g_malloc_n(MAX(profile->count, 1), sizeof *points);
    uint32_t count = fr_section_points(profile, points);
    if (count < (profile->is_closed ? 3U : 2U)) {
        g_free(points);
        return false;
    }
    if (must_turn(points, count, profile->is_closed)) {
        turn(points, count);
    }
    allocate(section, count, profile->is_closed);
    for (uint32_t i = 0; i < count; i++) {
        section->columns[i].x = (float)points[i][0];
        section->columns[i].y = (float)points[i][1];
    }
    g_free(points);
    set_normals(section, count);
    set_texture(section, count);
    set_reach(section);
    if (section->is_closed && count <= EARS_MOST) {
        clip_ears(section->columns, count, section->cap);
    } else if (section->is_closed) {
        fan(section->cap, count);
    }
    return true;
}

void fr_section_clear(FrSection *section) {
    g_clear_pointer(&section->columns, g_free);
    g_clear_pointer(&section->cap, g_free);
}

float fr_section_reach(const FrSection *section, float x, float y) {
    if (section->is_round) {
        return 1.0F;
    }
    float turn_part = atan2f(y, x) / (float)(2.0 * G_PI);
    float at = (turn_part < 0.0F ? turn_part + 1.0F : turn_part) * (float)FR_REACH_COUNT;
    uint32_t low = MIN((uint32_t)at, FR_REACH_COUNT - 1);
    return fminf(section->reach[low], section->reach[(low + 1) % FR_REACH_COUNT]);
}
