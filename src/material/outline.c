#include "material/outline.h"

#include <math.h>
#include <string.h>

/// More points than this cannot be told apart in a picture.
enum { MOST_POINTS = 512, ELLIPSE_POINTS = 65, RUN = 16 };

// ---- making -----------------------------------------------------------------------------------

static void add_point(FrOutline *outline, float x, float y) {
    const float apart = 0.002f;
    if (outline->count > 0) {
        const float *last = outline->points[outline->count - 1];
        if (hypotf(x - last[0], y - last[1]) < apart) {
            return;
        }
    }
    outline->points[outline->count][0] = x;
    outline->points[outline->count][1] = y;
    outline->count++;
}

static void add_given(FrOutline *outline, const FrPoints *given) {
    size_t stride = 1 + given->count / MOST_POINTS;
    const double *first = given->at[0];
    add_point(outline, 0, (float)CLAMP(first[0], 0, 1));
    for (size_t i = 0; i < given->count; i += stride) {
        double along = given->at[i][0], half_width = given->at[i][1];
        if (isfinite(along) && isfinite(half_width)) {
            add_point(outline, (float)CLAMP(half_width, 0, 0.5) * outline->aspect,
                      (float)CLAMP(along, 0, 1));
        }
    }
    const double *last = given->at[given->count - 1];
    add_point(outline, 0, (float)CLAMP(last[0], 0, 1));
}

static void add_ellipse(FrOutline *outline) {
    for (int i = 0; i < ELLIPSE_POINTS; i++) {
        float angle = (float)(G_PI * i / (ELLIPSE_POINTS - 1));
        add_point(outline, 0.5f * outline->aspect * sinf(angle), 0.5f - 0.5f * cosf(angle));
    }
}

FrOutline *fr_outline_new(const FrMaterialParams *params, float aspect) {
    FrOutline *outline = g_new0(FrOutline, 1);
    outline->aspect = aspect;
    outline->points = g_malloc(sizeof(float[2]) * (MOST_POINTS + ELLIPSE_POINTS));
    if (params->outline.count >= 3) {
        add_given(outline, &params->outline);
    }
    if (outline->count < 3) {
        outline->count = 0;
        add_ellipse(outline);
    }
    outline->arc = g_new0(float, outline->count);
    for (int i = 1; i < outline->count; i++) {
        const float *a = outline->points[i - 1], *b = outline->points[i];
        outline->length += hypotf(b[0] - a[0], b[1] - a[1]);
        outline->arc[i] = outline->length;
    }
    return outline;
}

void fr_outline_free(FrOutline *outline) {
    g_free(outline->points);
    g_free(outline->arc);
    g_free(outline);
}

// ---- asking -----------------------------------------------------------------------------------

/// Squared distance from (x, y) to segment `i` → i + 1, and how far along it the foot is.
static float segment_distance(const FrOutline *outline, int i, float x, float y, float *foot) {
    const float *a = outline->points[i], *b = outline->points[i + 1];
    float dx = b[0] - a[0], dy = b[1] - a[1];
    float t = ((x - a[0]) * dx + (y - a[1]) * dy) / (dx * dx + dy * dy);
    t = CLAMP(t, 0.0f, 1.0f);
    float ex = a[0] + t * dx - x, ey = a[1] + t * dy - y;
    *foot = t;
    return ex * ex + ey * ey;
}

/// Where the horizontal line at `y` crosses the right half; returns how many crossings.
static int crossings(const FrOutline *outline, float y, float *at) {
    int count = 0;
    for (int i = 0; i + 1 < outline->count; i++) {
        const float *a = outline->points[i], *b = outline->points[i + 1];
        if ((a[1] <= y) != (b[1] <= y)) {
            at[count++] = a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
        }
    }
    return count;
}

/// The midrib closes the half outline, so a point is inside if a ray outwards crosses an odd
/// number of times.
static bool is_inside(const float *at, int count, float x) {
    bool inside = false;
    for (int i = 0; i < count; i++) {
        inside ^= at[i] > x;
    }
    return inside;
}

static FrMargin margin_among(const FrOutline *outline, const int *segments, int count, float x,
                             float y) {
    float least = INFINITY, arc = 0;
    for (int k = 0; k < count; k++) {
        int i = segments[k];
        float foot;
        float distance = segment_distance(outline, i, x, y, &foot);
        if (distance < least) {
            least = distance;
            arc = outline->arc[i] + foot * (outline->arc[i + 1] - outline->arc[i]);
        }
    }
    return (FrMargin){.distance = sqrtf(least), .arc = arc / outline->length};
}

FrMargin fr_outline_at(const FrOutline *outline, float x, float y) {
    int all[MOST_POINTS + ELLIPSE_POINTS];
    float at[MOST_POINTS + ELLIPSE_POINTS];
    for (int i = 0; i + 1 < outline->count; i++) {
        all[i] = i;
    }
    x = fabsf(x);
    FrMargin margin = margin_among(outline, all, outline->count - 1, x, y);
    if (!is_inside(at, crossings(outline, y, at), x)) {
        margin.distance = -margin.distance;
    }
    return margin;
}

float fr_outline_half_width(const FrOutline *outline, float y) {
    float at[MOST_POINTS + ELLIPSE_POINTS];
    int count = crossings(outline, y, at);
    float widest = 0;
    for (int i = 0; i < count; i++) {
        widest = fmaxf(widest, at[i]);
    }
    return widest;
}

/// The segments that can be nearest to some point within `reach` of (x, y).
static int near_segments(const FrOutline *outline, float x, float y, float reach, int *segments) {
    float distance[MOST_POINTS + ELLIPSE_POINTS];
    float least = INFINITY;
    for (int i = 0; i + 1 < outline->count; i++) {
        float foot;
        distance[i] = sqrtf(segment_distance(outline, i, x, y, &foot));
        least = fminf(least, distance[i]);
    }
    int count = 0;
    for (int i = 0; i + 1 < outline->count; i++) {
        if (distance[i] <= least + 2.0f * reach) {
            segments[count++] = i;
        }
    }
    return count;
}

void fr_outline_row(const FrOutline *outline, int size, int row, FrMargin *margins) {
    int segments[MOST_POINTS + ELLIPSE_POINTS];
    float at[MOST_POINTS + ELLIPSE_POINTS];
    float y = fr_blade_y(size, (float)row);
    int crossed = crossings(outline, y, at);
    float reach = 0.5f * RUN * outline->aspect / (float)size;
    for (int begin = size / 2; begin < size; begin += RUN) {
        float centre = fr_blade_x(outline, size, (float)begin + 0.5f * (RUN - 1));
        int count = near_segments(outline, centre, y, reach, segments);
        for (int column = begin; column < MIN(begin + RUN, size); column++) {
            float x = fr_blade_x(outline, size, (float)column);
            FrMargin margin = margin_among(outline, segments, count, x, y);
            if (!is_inside(at, crossed, x)) {
                margin.distance = -margin.distance;
            }
            margins[column] = margins[size - 1 - column] = margin;
        }
    }
}

/// Serrate teeth: from each point the margin falls back slowly towards the base of the next tooth
/// nearer the tip, so the points look to the tip. They shrink at both ends of the blade.
static float tooth_cut(const FrOutline *outline, const FrMaterialParams *params, float arc) {
    if (params->teeth <= 0) {
        return 0;
    }
    float phase = arc * (float)params->teeth;
    phase -= floorf(phase);
    float ends = CLAMP(fminf(arc * 8.0f, (1.0f - arc) * 12.0f), 0.0f, 1.0f);
    float rise = 0.12f; // part of a tooth taken by its short side, towards the tip
    float cut = phase < rise ? phase / rise : (1.0f - phase) / (1.0f - rise);
    cut = phase < rise ? cut : powf(cut, 1.25f);
    return cut * ends * (float)params->tooth_depth * outline->aspect;
}

float fr_outline_alpha(const FrOutline *outline, const FrMaterialParams *params, FrMargin margin,
                       float texel) {
    float inside = margin.distance + FR_OUTLINE_BLEED - tooth_cut(outline, params, margin.arc);
    return CLAMP(0.5f + inside / texel, 0.0f, 1.0f);
}
