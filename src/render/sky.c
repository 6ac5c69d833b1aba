// The table of the sky and how it is sampled: a row by the light of all its cells, a cell by its
// share of the row (Pharr, Jakob, Humphreys 2016, Physically Based Rendering, section 14.2.4).
#include "render/sky.h"

#include "frond/daylight.h"
#include "render/atmosphere.h"
#include "render/colour.h"

#include <math.h>

#define SUN_ANGULAR_RADIUS 0.00465f
// Sunlight outside the atmosphere, the unit of all light here, in kW/m².
#define SOLAR_KILOWATTS 1.361
// Standards tell brightness, not colour: skylight and sunlight of luminance 1.
#define STANDARD_COLOUR ((vec3s){{0.93f, 1.0f, 1.13f}})
#define STANDARD_SUN ((vec3s){{1.08f, 0.99f, 0.86f}})

enum { SKY_COLUMNS = 256, SKY_ROWS = 512, COARSENESS = 8, BLOCK = 4 };

static FrSky *new_table(uint32_t columns, uint32_t rows) {
    FrSky *sky = g_new0(FrSky, 1);
    size_t cells = (size_t)columns * rows;
    sky->columns = columns;
    sky->rows = rows;
    sky->radiance = g_new0(vec3s, cells);
    sky->row_cdf = g_new0(float, rows / BLOCK + 1);
    sky->column_cdf = g_new0(float, (size_t)(columns / BLOCK + 1) * (rows / BLOCK));
    sky->block_density = g_new0(float, cells / (BLOCK * BLOCK));
    sky->sun_direction = (vec3s){{0, 0, 1}};
    sky->sun_cosine = cosf(SUN_ANGULAR_RADIUS);
    return sky;
}

void fr_sky_free(FrSky *sky) {
    if (sky == NULL) {
        return;
    }
    g_free(sky->radiance);
    g_free(sky->row_cdf);
    g_free(sky->column_cdf);
    g_free(sky->block_density);
    g_free(sky);
}

static vec3s cell_direction(const FrSky *sky, float column, float row) {
    float z = 2.0f * row / (float)sky->rows - 1.0f;
    float turn = 2.0f * FR_PI_F * column / (float)sky->columns;
    float side = sqrtf(fmaxf(0.0f, 1.0f - z * z));
    return (vec3s){{side * cosf(turn), side * sinf(turn), z}};
}

/// Running sums of `weights` scaled to end at 1; the sum itself is returned.
static double make_cdf(const double *weights, uint32_t count, float *cdf) {
    double sum = 0.0;
    for (uint32_t i = 0; i < count; i++) {
        sum += weights[i];
    }
    double part = 0.0;
    cdf[0] = 0.0f;
    for (uint32_t i = 0; i < count; i++) {
        part += weights[i];
        cdf[i + 1] = (float)(sum > 0.0 ? part / sum : (i + 1.0) / count);
    }
    cdf[count] = 1.0f;
    return sum;
}

static double block_luminance(const FrSky *sky, uint32_t row, uint32_t column) {
    double sum = 0.0;
    for (uint32_t y = row * BLOCK; y < (row + 1) * BLOCK; y++) {
        for (uint32_t x = column * BLOCK; x < (column + 1) * BLOCK; x++) {
            sum += (double)fr_luminance(sky->radiance[(size_t)y * sky->columns + x]);
        }
    }
    return sum / (BLOCK * BLOCK);
}

// Every block of a row that has light keeps some probability: radiance is interpolated between
// cells, and a direction with light must not be impossible.
static void make_distribution(FrSky *sky) {
    uint32_t columns = sky->columns / BLOCK;
    uint32_t rows = sky->rows / BLOCK;
    double *weights = g_new(double, columns);
    double *row_weights = g_new(double, rows);
    double mean = 0.0;
    for (uint32_t i = 0; i < columns * rows; i++) {
        mean += block_luminance(sky, i / columns, i % columns) / (columns * rows);
    }
    double block_angle = 4.0 * G_PI / (columns * rows);
    for (uint32_t row = 0; row < rows; row++) {
        double brightest = 0.0;
        for (uint32_t i = 0; i < columns; i++) {
            weights[i] = block_luminance(sky, row, i);
            brightest = fmax(brightest, weights[i]);
        }
        for (uint32_t i = 0; i < columns; i++) {
            weights[i] += brightest > 0.0 ? 0.02 * mean : 0.0;
        }
        row_weights[row] =
            make_cdf(weights, columns, sky->column_cdf + (size_t)row * (columns + 1));
    }
    double total = make_cdf(row_weights, rows, sky->row_cdf);
    for (uint32_t row = 0; row < rows; row++) {
        const float *cdf = sky->column_cdf + (size_t)row * (columns + 1);
        float row_part = total > 0.0 ? sky->row_cdf[row + 1] - sky->row_cdf[row] : 0.0f;
        for (uint32_t i = 0; i < columns; i++) {
            sky->block_density[(size_t)row * columns + i] =
                row_part * (cdf[i + 1] - cdf[i]) / (float)block_angle;
        }
    }
    g_free(weights);
    g_free(row_weights);
}

static void update_flat_irradiance(FrSky *sky) {
    double sum[3] = {0, 0, 0};
    double cell_angle = 4.0 * G_PI / ((double)sky->columns * sky->rows);
    for (uint32_t row = sky->rows / 2; row < sky->rows; row++) {
        double z = 2.0 * (row + 0.5) / sky->rows - 1.0;
        for (uint32_t i = 0; i < sky->columns; i++) {
            vec3s radiance = sky->radiance[(size_t)row * sky->columns + i];
            for (int c = 0; c < 3; c++) {
                sum[c] += (double)radiance.raw[c] * z * cell_angle;
            }
        }
    }
    float height = fmaxf(sky->sun_direction.z, 0.0f);
    for (int c = 0; c < 3; c++) {
        sky->flat_irradiance.raw[c] = (float)sum[c] + sky->sun_irradiance.raw[c] * height;
    }
}

void fr_sky_set_sun(FrSky *sky, vec3s direction, vec3s irradiance) {
    sky->sun_direction = direction;
    sky->sun_irradiance = irradiance;
    update_flat_irradiance(sky);
}

FrSky *fr_sky_new_uniform(vec3s radiance, bool is_sphere) {
    FrSky *sky = new_table(8, 16);
    for (uint32_t i = is_sphere ? 0 : 64; i < 128; i++) {
        sky->radiance[i] = radiance;
    }
    make_distribution(sky);
    update_flat_irradiance(sky);
    return sky;
}

/// What the table is filled from: the air, or a standard's sky if that is NULL.
typedef struct Fill {
    FrSky *sky;
    const FrAtmosphere *atmosphere;
    FrLamp standard;
    float strength;
} Fill;

static vec3s radiance_of(const Fill *fill, vec3s direction) {
    if (fill->atmosphere != NULL) {
        return fr_atmosphere_radiance(fill->atmosphere, direction, fill->sky->sun_direction);
    }
    float part = (float)fr_lamp_sky_brightness(&fill->standard, direction);
    return glms_vec3_scale(STANDARD_COLOUR, part);
}

static void fill_rows(void *data, size_t begin, size_t end, int worker) {
    const Fill *fill = data;
    FrSky *sky = fill->sky;
    (void)worker;
    for (size_t i = begin; i < end; i++) {
        size_t row = sky->rows / 2 + i;
        for (uint32_t column = 0; column < sky->columns; column++) {
            vec3s direction = cell_direction(sky, (float)column + 0.5f, (float)row + 0.5f);
            sky->radiance[row * sky->columns + column] =
                glms_vec3_scale(radiance_of(fill, direction), fill->strength);
        }
    }
}

// Without a ground the view from above meets the colour of the horizon, which turns into that of
// distant land in haze.
static void fill_below(FrSky *sky) {
    vec3s land = glms_vec3_scale(sky->flat_irradiance, 0.25f / FR_PI_F);
    const vec3s *horizon = sky->radiance + (size_t)sky->rows / 2 * sky->columns;
    for (uint32_t row = 0; row < sky->rows / 2; row++) {
        float depth = 1.0f - 2.0f * ((float)row + 0.5f) / (float)sky->rows;
        float part = glm_smoothstep(0.0f, 0.4f, depth);
        for (uint32_t i = 0; i < sky->columns; i++) {
            sky->radiance[(size_t)row * sky->columns + i] = glms_vec3_lerp(horizon[i], land, part);
        }
    }
}

/// Scales a standard's sky to bring `irradiance` to level ground.
static void scale_sky(FrSky *sky, float irradiance) {
    update_flat_irradiance(sky);
    float scale = irradiance / fmaxf(fr_luminance(sky->flat_irradiance), 1e-9f);
    for (size_t i = 0; i < (size_t)sky->columns * sky->rows; i++) {
        sky->radiance[i] = glms_vec3_scale(sky->radiance[i], scale);
    }
}

/// Fills the upper half as the air makes it, and sets the sun.
static void fill_air(Fill *fill, const FrSceneParams *params, const FrContext *context) {
    FrSky *sky = fill->sky;
    FrAtmosphere *atmosphere = fr_atmosphere_new(params->turbidity);
    fill->atmosphere = atmosphere;
    fill->strength = (float)params->sky_strength;
    fr_parallel_for(context->pool, sky->rows / 2, 8, fill_rows, fill, NULL);
    vec3s sunlight = fr_atmosphere_sunlight(atmosphere, sin(params->sun_elevation));
    fr_sky_set_sun(sky, sky->sun_direction, glms_vec3_scale(sunlight, (float)params->sun_strength));
    fr_atmosphere_free(atmosphere);
}

/// The same for a standard's sky. Plants are lit by as much (frond/daylight.h); an overcast sky
/// hides its sun.
static void fill_standard(Fill *fill, const FrSceneParams *params, const FrContext *context) {
    FrSky *sky = fill->sky;
    FrLamp lamps[3];
    size_t count =
        fr_light_sun_and_sky((FrSkyKind)(params->sky - FR_SCENE_SKY_UNIFORM), params->sun_azimuth,
                             params->sun_elevation, params->sun_strength, 1, lamps);
    vec3s sunlight = glms_vec3_zero();
    float level = 0;
    for (size_t i = 0; i < count; i++) {
        float power = (float)(lamps[i].power / SOLAR_KILOWATTS);
        if (lamps[i].kind == FR_LAMP_SUN) {
            sunlight = glms_vec3_scale(STANDARD_SUN, power);
        } else {
            fill->standard = lamps[i];
            level = power;
        }
    }
    fr_parallel_for(context->pool, sky->rows / 2, 8, fill_rows, fill, NULL);
    scale_sky(sky, level * (float)params->sky_strength);
    fr_sky_set_sun(sky, sky->sun_direction, sunlight);
}

static FrSky *new_filled(uint32_t columns, uint32_t rows, const FrSceneParams *params,
                         bool has_ground, const FrContext *context) {
    FrSky *sky = new_table(columns, rows);
    sky->sun_direction = fr_light_sun_direction(params->sun_azimuth, params->sun_elevation);
    Fill fill = {.sky = sky, .strength = 1};
    if (params->sky == FR_SCENE_SKY_AIR) {
        fill_air(&fill, params, context);
    } else {
        fill_standard(&fill, params, context);
    }
    if (!has_ground) {
        fill_below(sky);
    }
    make_distribution(sky);
    return sky;
}

FrSky *fr_sky_new(const FrSceneParams *params, bool has_ground, const FrContext *context) {
    return new_filled(SKY_COLUMNS, SKY_ROWS, params, has_ground, context);
}

FrSky *fr_sky_new_coarse(const FrSceneParams *params, bool has_ground, const FrContext *context) {
    return new_filled(SKY_COLUMNS / COARSENESS, SKY_ROWS / COARSENESS, params, has_ground, context);
}

static size_t block_of(const FrSky *sky, vec3s direction) {
    uint32_t columns = sky->columns / BLOCK;
    uint32_t rows = sky->rows / BLOCK;
    float turn = atan2f(direction.y, direction.x) / (2.0f * FR_PI_F);
    float x = (turn - floorf(turn)) * (float)columns;
    float y = (direction.z * 0.5f + 0.5f) * (float)rows;
    uint32_t column = (uint32_t)fminf(x, (float)(columns - 1));
    uint32_t row = (uint32_t)fminf(fmaxf(y, 0.0f), (float)(rows - 1));
    return (size_t)row * columns + column;
}

// Bilinear, but never across the horizon.
vec3s fr_sky_radiance(const FrSky *sky, vec3s direction) {
    float turn = atan2f(direction.y, direction.x) / (2.0f * FR_PI_F);
    float x = (turn - floorf(turn)) * (float)sky->columns - 0.5f;
    float half = (float)(sky->rows / 2);
    float low = direction.z >= 0.0f ? half : 0.0f;
    float y = (direction.z * 0.5f + 0.5f) * (float)sky->rows - 0.5f;
    y = fminf(fmaxf(y, low), low + half - 1.0f);
    float left = floorf(x);
    float below = fminf(floorf(y), low + half - 2.0f);
    float fx = x - left;
    float fy = y - below;
    int columns = (int)sky->columns;
    int x0 = ((int)left + columns) % columns;
    int x1 = (x0 + 1) % columns;
    const vec3s *row0 = sky->radiance + (size_t)below * sky->columns;
    const vec3s *row1 = row0 + sky->columns;
    vec3s lower = glms_vec3_lerp(row0[x0], row0[x1], fx);
    vec3s upper = glms_vec3_lerp(row1[x0], row1[x1], fx);
    return glms_vec3_lerp(lower, upper, fy);
}

vec3s fr_sky_sun_radiance(const FrSky *sky, vec3s direction) {
    if (glms_vec3_dot(direction, sky->sun_direction) < sky->sun_cosine) {
        return glms_vec3_zero();
    }
    float solid_angle = 2.0f * FR_PI_F * (1.0f - sky->sun_cosine);
    return glms_vec3_scale(sky->sun_irradiance, 1.0f / solid_angle);
}

/// The last i with cdf[i] <= u among those with some probability.
static uint32_t search(const float *cdf, uint32_t count, float u) {
    uint32_t low = 0;
    uint32_t high = count;
    while (high - low > 1) {
        uint32_t middle = (low + high) / 2;
        if (cdf[middle] <= u) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return low;
}

vec3s fr_sky_sample(const FrSky *sky, float u, float v, float *density) {
    uint32_t columns = sky->columns / BLOCK;
    uint32_t row = search(sky->row_cdf, sky->rows / BLOCK, u);
    float row_part = sky->row_cdf[row + 1] - sky->row_cdf[row];
    float in_row = (u - sky->row_cdf[row]) / row_part;
    const float *cdf = sky->column_cdf + (size_t)row * (columns + 1);
    uint32_t column = search(cdf, columns, v);
    float in_column = (v - cdf[column]) / (cdf[column + 1] - cdf[column]);
    *density = sky->block_density[(size_t)row * columns + column];
    return cell_direction(sky, BLOCK * ((float)column + in_column), BLOCK * ((float)row + in_row));
}

float fr_sky_density(const FrSky *sky, vec3s direction) {
    return sky->block_density[block_of(sky, direction)];
}

vec3s fr_sky_sample_sun(const FrSky *sky, float u, float v) {
    float cosine = 1.0f - u * (1.0f - sky->sun_cosine);
    float side = sqrtf(fmaxf(0.0f, 1.0f - cosine * cosine));
    float turn = 2.0f * FR_PI_F * v;
    vec3s x;
    vec3s y;
    fr_basis(sky->sun_direction, &x, &y);
    return fr_from_basis(x, y, sky->sun_direction,
                         (vec3s){{side * cosf(turn), side * sinf(turn), cosine}});
}
