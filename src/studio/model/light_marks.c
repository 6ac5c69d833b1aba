#include "studio/model/light_marks.h"

#include <math.h>

enum { SLICE_CELLS = 96 };

static const double least_box = 0.5; // m, of what a slice shows
static const double around = 0.06;   // of the box: so much a slice goes beyond it

void studio_light_colour(float part, float opaque, float colour[4]) {
    uint8_t pixel[3];
    fr_light_scale_paint(pixel, part);
    for (int c = 0; c < 3; c++) {
        colour[c] = (float)pixel[c] / 255.0f;
    }
    colour[3] = opaque;
}

// ---- slices ------------------------------------------------------------------------------------

StudioSlice studio_slice_of(const FrScene *scene, int axis, double part) {
    static const int axes[3][2] = {{1, 2}, {0, 2}, {0, 1}};
    StudioSlice slice = {.across = axes[axis][0], .up = axes[axis][1], .depth = axis};
    double min[3], max[3];
    fr_scene_bounds(scene, min, max);
    for (int c = 0; c < 3; c++) {
        bool is_empty = !(max[c] >= min[c]);
        double middle = is_empty ? 0 : 0.5 * (min[c] + max[c]);
        double half = 0.5 * fmax(is_empty ? 0 : max[c] - min[c], least_box);
        min[c] = middle - half;
        max[c] = middle + half;
    }
    slice.at = min[axis] + part * (max[axis] - min[axis]);
    double width = max[slice.across] - min[slice.across], height = max[slice.up] - min[slice.up];
    double beyond = around * fmax(width, height);
    slice.cell = (fmax(width, height) + 2 * beyond) / SLICE_CELLS;
    slice.corner[0] = min[slice.across] - beyond;
    slice.corner[1] = min[slice.up] - (slice.up == 2 ? 0 : beyond); // not below the ground
    slice.columns = (uint32_t)ceil((width + 2 * beyond) / slice.cell) + 1;
    slice.rows = (uint32_t)ceil((height + 2 * beyond) / slice.cell) + 1;
    return slice;
}

GArray *studio_slice_places(const StudioSlice *slice) {
    GArray *places = g_array_new(FALSE, FALSE, sizeof(vec3s));
    for (uint32_t i = 0; i < slice->columns * slice->rows; i++) {
        vec3s at;
        at.raw[slice->across] = (float)(slice->corner[0] + slice->cell * (i % slice->columns));
        at.raw[slice->up] = (float)(slice->corner[1] + slice->cell * (i / slice->columns));
        at.raw[slice->depth] = (float)slice->at;
        g_array_append_val(places, at);
    }
    return places;
}

static double top_of(const FrScene *scene, const FrLightAnswer *answers, guint count) {
    float *light = g_new(float, count + 1);
    for (guint i = 0; i < count; i++) {
        light[i] = answers[i].intensity;
    }
    double top = (double)fr_light_scale_top(scene, light, count);
    g_free(light);
    return top;
}

static StudioMark mark_of(vec3s at, float part, float opaque, float size) {
    StudioMark mark = {.at = {at.x, at.y, at.z}, .size = size};
    studio_light_colour(part, opaque, mark.colour);
    return mark;
}

StudioOverlay *studio_slice_marks(const FrScene *scene, const StudioSlice *slice,
                                  const GArray *places, const FrLightAnswer *answers, double *top) {
    static const uint32_t corners[6][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
    StudioOverlay *overlay = studio_overlay_new();
    *top = top_of(scene, answers, places->len);
    overlay->through = 0.0f;
    for (uint32_t row = 0; row + 1 < slice->rows; row++) {
        for (uint32_t column = 0; column + 1 < slice->columns; column++) {
            for (int k = 0; k < 6; k++) {
                uint32_t i = (row + corners[k][1]) * slice->columns + column + corners[k][0];
                StudioMark mark = mark_of(g_array_index(places, vec3s, i),
                                          answers[i].intensity / (float)*top, 0.8f, 0);
                g_array_append_val(overlay->triangles, mark);
            }
        }
    }
    return overlay;
}

// ---- points ------------------------------------------------------------------------------------

StudioOverlay *studio_light_points(const FrScene *scene, const FrLightPlaces *places,
                                   const FrLightAnswer *answers, double *top) {
    StudioOverlay *overlay = studio_overlay_new();
    *top = top_of(scene, answers, places->at->len);
    overlay->through = 0.3f;
    for (guint i = 0; i < places->at->len; i++) {
        vec3s at = g_array_index(places->at, vec3s, i);
        StudioMark mark = mark_of(at, answers[i].intensity / (float)*top, 1.0f, 7.0f);
        g_array_append_val(overlay->points, mark);
        StudioMark end = mark;
        float length = places->line * answers[i].confidence;
        for (int c = 0; c < 3; c++) {
            end.at[c] += length * answers[i].direction.raw[c];
        }
        mark.size = end.size = 1.5f;
        g_array_append_val(overlay->lines, mark);
        g_array_append_val(overlay->lines, end);
    }
    return overlay;
}

// ---- rays and cells ----------------------------------------------------------------------------

StudioOverlay *studio_ray_marks(const GArray *rays) {
    static const float colours[][4] = {{1.0f, 0.86f, 0.42f, 0.55f},
                                       {1.0f, 0.55f, 0.25f, 0.40f},
                                       {0.90f, 0.33f, 0.33f, 0.30f},
                                       {0.66f, 0.28f, 0.52f, 0.25f}};
    StudioOverlay *overlay = studio_overlay_new();
    overlay->through = 0.1f;
    for (guint i = 0; i < rays->len; i++) {
        const FrLightRay *ray = &g_array_index(rays, FrLightRay, i);
        double ends[2][3];
        for (int c = 0; c < 3; c++) {
            ends[0][c] = (double)ray->from.raw[c];
            ends[1][c] = (double)ray->to.raw[c];
        }
        studio_overlay_line(overlay, ends[0], ends[1], 1,
                            colours[MIN(ray->bounce, G_N_ELEMENTS(colours) - 1)]);
    }
    return overlay;
}

StudioOverlay *studio_cell_marks(const GArray *cells) {
    StudioOverlay *overlay = studio_overlay_new();
    double most = 0;
    for (guint i = 0; i < cells->len; i++) {
        const FrLightCell *cell = &g_array_index(cells, FrLightCell, i);
        most = fmax(most, cell->ray_count / (cell->width * cell->width));
    }
    for (guint i = 0; i < cells->len; i++) {
        const FrLightCell *cell = &g_array_index(cells, FrLightCell, i);
        double dense = cell->ray_count / (cell->width * cell->width), max[3];
        float colour[4];
        studio_light_colour((float)(0.25 + 0.75 * sqrt(most > 0 ? dense / most : 0)), 0.4f, colour);
        for (int c = 0; c < 3; c++) {
            max[c] = cell->min[c] + cell->width;
        }
        studio_overlay_box(overlay, cell->min, max, 1, colour);
    }
    overlay->through = 0.15f;
    return overlay;
}
