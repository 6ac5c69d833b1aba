// The sky by single scattering along the view ray and an isotropic estimate of all higher orders,
// after Hillaire 2020, A Scalable and Production Ready Sky and Atmosphere Rendering Technique
// (EGSR), sections 4 and 5. Coefficients of air and ozone: Bruneton 2017, A Qualitative and
// Quantitative Evaluation of 8 Clear Sky Models, for 680, 550 and 440 nm.
#include "render/atmosphere.h"

#include <glib.h>
#include <math.h>

#define PLANET_RADIUS 6360e3
#define AIR_RADIUS 6460e3
#define AIR_SCALE 8000.0
#define HAZE_SCALE 1200.0
#define HAZE_ALBEDO 0.97
// Vertical optical depth at 550 nm for each unit of turbidity above 1: that of Linke's turbidity 3
// with 1 cm of water (Ineichen 2008, Conversion Function between the Linke Turbidity and the
// Atmospheric Water Vapor and Aerosol Content, Solar Energy 82).
#define HAZE_DEPTH 0.052
#define HAZE_EXPONENT 1.3 // Ångström's, of continental haze
#define HAZE_FORWARD 0.76
#define OBSERVER_HEIGHT 2.0
#define LAND_ALBEDO 0.2

enum {
    LIGHT_HEIGHTS = 48,
    LIGHT_ANGLES = 128,
    SPREAD_HEIGHTS = 12,
    SPREAD_ANGLES = 24,
    LIGHT_STEPS = 48,
    SPREAD_STEPS = 20,
    VIEW_STEPS = 48,
    SPREAD_DIRECTIONS = 64,
};

typedef struct Rgb {
    double at[3];
} Rgb;

struct FrAtmosphere {
    Rgb air;                                   ///< scattering at the ground, 1/m
    Rgb ozone;                                 ///< absorption at its densest, 1/m
    Rgb haze;                                  ///< scattering at the ground, 1/m
    Rgb light[LIGHT_HEIGHTS][LIGHT_ANGLES];    ///< transmittance to the sun
    Rgb spread[SPREAD_HEIGHTS][SPREAD_ANGLES]; ///< light of all orders from the second
};

typedef struct Medium {
    Rgb air, haze, extinction;
} Medium;

static Medium medium_at(const FrAtmosphere *atmosphere, double height) {
    double air = exp(-height / AIR_SCALE);
    double haze = exp(-height / HAZE_SCALE);
    double ozone = fmax(0.0, 1.0 - fabs(height - 25e3) / 15e3);
    Medium medium;
    for (int c = 0; c < 3; c++) {
        medium.air.at[c] = atmosphere->air.at[c] * air;
        medium.haze.at[c] = atmosphere->haze.at[c] * haze;
        medium.extinction.at[c] =
            medium.air.at[c] + medium.haze.at[c] / HAZE_ALBEDO + atmosphere->ozone.at[c] * ozone;
    }
    return medium;
}

/// Distance from a point at `radius` along a direction whose cosine to the vertical is `mu` to the
/// sphere of radius `to`; negative if it is missed.
static double distance_to_sphere(double radius, double mu, double to, bool is_inside) {
    double half = radius * mu;
    double discriminant = half * half - radius * radius + to * to;
    if (discriminant < 0.0) {
        return -1.0;
    }
    return is_inside ? -half + sqrt(discriminant) : -half - sqrt(discriminant);
}

static bool hits_planet(double radius, double mu) {
    return mu < 0.0 && distance_to_sphere(radius, mu, PLANET_RADIUS, false) > 0.0;
}

static double radius_at(double radius, double mu, double distance) {
    return sqrt(radius * radius + distance * distance + 2.0 * radius * mu * distance);
}

static Rgb march_transmittance(const FrAtmosphere *atmosphere, double radius, double mu) {
    if (hits_planet(radius, mu)) {
        return (Rgb){{0, 0, 0}};
    }
    double length = distance_to_sphere(radius, mu, AIR_RADIUS, true);
    Rgb depth = {{0, 0, 0}};
    for (int i = 0; i < LIGHT_STEPS; i++) {
        double near = (double)i / LIGHT_STEPS;
        double far = (double)(i + 1) / LIGHT_STEPS;
        double middle = 0.5 * length * (near * near + far * far);
        double step = length * (far * far - near * near);
        Medium medium = medium_at(atmosphere, radius_at(radius, mu, middle) - PLANET_RADIUS);
        for (int c = 0; c < 3; c++) {
            depth.at[c] += medium.extinction.at[c] * step;
        }
    }
    return (Rgb){{exp(-depth.at[0]), exp(-depth.at[1]), exp(-depth.at[2])}};
}

// The tables are finest near the ground and for a sun near the horizon: height and the cosine of
// the sun's zenith angle go by their square roots.
#define LOWEST_SUN (-0.35)

static double angle_of(double x) {
    double root = -sqrt(-LOWEST_SUN) + x * (1.0 + sqrt(-LOWEST_SUN));
    return copysign(root * root, root);
}

static double place_of_angle(double mu) {
    double root = copysign(sqrt(fabs(mu)), mu);
    return (root + sqrt(-LOWEST_SUN)) / (1.0 + sqrt(-LOWEST_SUN));
}

static double height_of(double y) {
    return y * y * (AIR_RADIUS - PLANET_RADIUS);
}

static double place_of_height(double height) {
    return sqrt(fmax(height, 0.0) / (AIR_RADIUS - PLANET_RADIUS));
}

static Rgb look_up(const Rgb *table, int heights, int angles, double height, double mu) {
    double x = fmin(fmax(place_of_angle(mu), 0.0), 1.0) * (angles - 1);
    double y = fmin(place_of_height(height), 1.0) * (heights - 1);
    int column = (int)fmin(x, angles - 2);
    int row = (int)fmin(y, heights - 2);
    double fx = x - column;
    double fy = y - row;
    const Rgb *at = table + row * angles + column;
    Rgb value;
    for (int c = 0; c < 3; c++) {
        double low = at[0].at[c] * (1.0 - fx) + at[1].at[c] * fx;
        double high = at[angles].at[c] * (1.0 - fx) + at[angles + 1].at[c] * fx;
        value.at[c] = low * (1.0 - fy) + high * fy;
    }
    return value;
}

static Rgb light_at(const FrAtmosphere *atmosphere, double height, double mu) {
    return look_up(&atmosphere->light[0][0], LIGHT_HEIGHTS, LIGHT_ANGLES, height, mu);
}

/// Second-order light and the share of light scattered once more, from one direction.
static void march_spread(const FrAtmosphere *atmosphere, double radius, double mu, double sun_mu,
                         double cosine, Rgb *light, Rgb *share) {
    bool is_ground = hits_planet(radius, mu);
    double length = is_ground ? distance_to_sphere(radius, mu, PLANET_RADIUS, false)
                              : distance_to_sphere(radius, mu, AIR_RADIUS, true);
    Rgb through = {{1, 1, 1}};
    double step = length / SPREAD_STEPS;
    for (int i = 0; i < SPREAD_STEPS; i++) {
        double distance = (i + 0.5) * step;
        double here = radius_at(radius, mu, distance);
        double sun_here = (radius * sun_mu + distance * cosine) / here;
        Medium medium = medium_at(atmosphere, here - PLANET_RADIUS);
        Rgb sun = light_at(atmosphere, here - PLANET_RADIUS, sun_here);
        for (int c = 0; c < 3; c++) {
            double extinction = medium.extinction.at[c];
            double passed = exp(-extinction * step);
            double scattered = (medium.air.at[c] + medium.haze.at[c]) * (1.0 - passed) /
                               fmax(extinction, 1e-20) * through.at[c];
            light->at[c] += scattered * sun.at[c] / (4.0 * G_PI);
            share->at[c] += scattered;
            through.at[c] *= passed;
        }
    }
    if (is_ground) {
        double sun_here = (radius * sun_mu + length * cosine) / PLANET_RADIUS;
        Rgb sun = light_at(atmosphere, 0.0, sun_here);
        for (int c = 0; c < 3; c++) {
            light->at[c] += through.at[c] * sun.at[c] * fmax(sun_here, 0.0) * LAND_ALBEDO / G_PI;
        }
    }
}

static Rgb spread_at(const FrAtmosphere *atmosphere, double height, double sun_mu) {
    Rgb light = {{0, 0, 0}};
    Rgb share = {{0, 0, 0}};
    double sun_side = sqrt(fmax(0.0, 1.0 - sun_mu * sun_mu));
    for (int i = 0; i < SPREAD_DIRECTIONS; i++) {
        double mu = 1.0 - 2.0 * (i + 0.5) / SPREAD_DIRECTIONS;
        double turn = i * 2.399963229728653; // golden angle: evenly over the sphere
        double cosine = mu * sun_mu + sqrt(1.0 - mu * mu) * cos(turn) * sun_side;
        march_spread(atmosphere, PLANET_RADIUS + fmax(height, 1.0), mu, sun_mu, cosine, &light,
                     &share);
    }
    Rgb spread;
    for (int c = 0; c < 3; c++) {
        double once_more = fmin(share.at[c] / SPREAD_DIRECTIONS, 0.98);
        spread.at[c] = light.at[c] / SPREAD_DIRECTIONS / (1.0 - once_more);
    }
    return spread;
}

FrAtmosphere *fr_atmosphere_new(double turbidity) {
    FrAtmosphere *atmosphere = g_new(FrAtmosphere, 1);
    atmosphere->air = (Rgb){{5.802e-6, 13.558e-6, 33.1e-6}};
    atmosphere->ozone = (Rgb){{0.650e-6, 1.881e-6, 0.085e-6}};
    double haze = (turbidity - 1.0) * HAZE_DEPTH / HAZE_SCALE * HAZE_ALBEDO;
    atmosphere->haze = (Rgb){
        {haze * pow(550.0 / 680.0, HAZE_EXPONENT), haze, haze * pow(550.0 / 440.0, HAZE_EXPONENT)}};
    for (int y = 0; y < LIGHT_HEIGHTS; y++) {
        double radius = PLANET_RADIUS + fmax(height_of((double)y / (LIGHT_HEIGHTS - 1)), 0.5);
        for (int x = 0; x < LIGHT_ANGLES; x++) {
            double mu = angle_of((double)x / (LIGHT_ANGLES - 1));
            atmosphere->light[y][x] =
                march_transmittance(atmosphere, fmin(radius, AIR_RADIUS - 0.5), mu);
        }
    }
    for (int y = 0; y < SPREAD_HEIGHTS; y++) {
        double height = fmin(height_of((double)y / (SPREAD_HEIGHTS - 1)), 99e3);
        for (int x = 0; x < SPREAD_ANGLES; x++) {
            double mu = angle_of((double)x / (SPREAD_ANGLES - 1));
            atmosphere->spread[y][x] = spread_at(atmosphere, height, mu);
        }
    }
    return atmosphere;
}

void fr_atmosphere_free(FrAtmosphere *atmosphere) {
    g_free(atmosphere);
}

vec3s fr_atmosphere_sunlight(const FrAtmosphere *atmosphere, double sun_height) {
    Rgb light = march_transmittance(atmosphere, PLANET_RADIUS + OBSERVER_HEIGHT, sun_height);
    return (vec3s){{(float)light.at[0], (float)light.at[1], (float)light.at[2]}};
}

static double air_phase(double cosine) {
    return 3.0 / (16.0 * G_PI) * (1.0 + cosine * cosine);
}

// Cornette and Shanks 1992.
static double haze_phase(double cosine) {
    double g = HAZE_FORWARD;
    double base = 1.0 + g * g - 2.0 * g * cosine;
    return 3.0 / (8.0 * G_PI) * (1.0 - g * g) * (1.0 + cosine * cosine) /
           ((2.0 + g * g) * base * sqrt(base));
}

vec3s fr_atmosphere_radiance(const FrAtmosphere *atmosphere, vec3s direction, vec3s sun) {
    double radius = PLANET_RADIUS + OBSERVER_HEIGHT;
    double mu = fmax((double)direction.z, 0.0);
    double sun_mu = (double)sun.z;
    double cosine = (double)direction.x * (double)sun.x + (double)direction.y * (double)sun.y +
                    (double)direction.z * (double)sun.z;
    double length = distance_to_sphere(radius, mu, AIR_RADIUS, true);
    double air = air_phase(cosine);
    double haze = haze_phase(cosine);
    Rgb through = {{1, 1, 1}};
    Rgb radiance = {{0, 0, 0}};
    for (int i = 0; i < VIEW_STEPS; i++) {
        double near = (double)i / VIEW_STEPS;
        double far = (double)(i + 1) / VIEW_STEPS;
        double distance = 0.5 * length * (near * near + far * far);
        double step = length * (far * far - near * near);
        double here = radius_at(radius, mu, distance);
        double sun_here = (radius * sun_mu + distance * cosine) / here;
        double height = here - PLANET_RADIUS;
        Medium medium = medium_at(atmosphere, height);
        Rgb light = light_at(atmosphere, height, sun_here);
        Rgb spread =
            look_up(&atmosphere->spread[0][0], SPREAD_HEIGHTS, SPREAD_ANGLES, height, sun_here);
        for (int c = 0; c < 3; c++) {
            double extinction = medium.extinction.at[c];
            double passed = exp(-extinction * step);
            double source = light.at[c] * (medium.air.at[c] * air + medium.haze.at[c] * haze) +
                            spread.at[c] * (medium.air.at[c] + medium.haze.at[c]);
            radiance.at[c] += through.at[c] * source * (1.0 - passed) / fmax(extinction, 1e-20);
            through.at[c] *= passed;
        }
    }
    return (vec3s){{(float)radiance.at[0], (float)radiance.at[1], (float)radiance.at[2]}};
}
