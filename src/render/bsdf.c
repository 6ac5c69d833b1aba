// Matt reflection after Oren and Nayar 1994, Generalization of Lambert's Reflectance Model; matt
// transmission; a GGX coat (Walter, Marschner, Li, Torrance 2007) with Schlick's Fresnel term,
// sampled by visible normals (Heitz 2018, Sampling the GGX Distribution of Visible Normals).
#include "render/bsdf.h"

#include "render/colour.h"

#include <math.h>

void fr_bsdf_set_roughness(FrBsdf *bsdf, float sigma) {
    float square = sigma * sigma;
    bsdf->rough_a = 1.0f - 0.5f * square / (square + 0.33f);
    bsdf->rough_b = 0.45f * square / (square + 0.09f);
}

static float fresnel(float coat, float cosine) {
    float m = 1.0f - fminf(fmaxf(cosine, 0.0f), 1.0f);
    float m2 = m * m;
    return coat + (1.0f - coat) * m2 * m2 * m;
}

/// What the coat leaves of light on its way in or out.
static float through_coat(const FrBsdf *bsdf, float cosine) {
    return bsdf->coat > 0.0f ? 1.0f - fresnel(bsdf->coat, cosine) : 1.0f;
}

static float ggx(float alpha, float cosine) {
    float square = alpha * alpha;
    float base = cosine * cosine * (square - 1.0f) + 1.0f;
    return square / (FR_PI_F * base * base);
}

static float smith_lambda(float alpha, float cosine) {
    float square = cosine * cosine;
    float tangent = fmaxf(0.0f, 1.0f - square) / fmaxf(square, 1e-12f);
    return 0.5f * (sqrtf(1.0f + alpha * alpha * tangent) - 1.0f);
}

typedef struct Lobes {
    float coat, matt, through; ///< probabilities, together 1 or all 0
} Lobes;

static Lobes lobe_probabilities(const FrBsdf *bsdf, float out_cosine) {
    float coat = bsdf->coat > 0.0f ? fresnel(bsdf->coat, out_cosine) : 0.0f;
    float matt = fr_luminance(bsdf->reflectance);
    float through = fr_luminance(bsdf->transmittance);
    float sum = coat + matt + through;
    if (!(sum > 0.0f)) {
        return (Lobes){0, 0, 0};
    }
    return (Lobes){coat / sum, matt / sum, through / sum};
}

static float oren_nayar(const FrBsdf *bsdf, vec3s out, vec3s in, float out_cosine,
                        float in_cosine) {
    if (bsdf->rough_b <= 0.0f) {
        return bsdf->rough_a;
    }
    // cos(φi − φo) sin α tan β = (in·out − cos cos) / max(cos): both sines cancel.
    float across = glms_vec3_dot(out, in) - out_cosine * in_cosine;
    if (across <= 0.0f) {
        return bsdf->rough_a;
    }
    return bsdf->rough_a + bsdf->rough_b * across / fmaxf(fmaxf(out_cosine, in_cosine), 1e-4f);
}

/// True if `in` leaves on the viewer's side; light that would leak through the surface because its
/// two normals disagree counts for neither side.
static bool classify(const FrBsdf *bsdf, vec3s in, float in_cosine, bool *is_reflection) {
    float side = glms_vec3_dot(bsdf->side, in);
    *is_reflection = side > 0.0f;
    return side * in_cosine > 0.0f;
}

FrStraight fr_bsdf_decide(const FrBsdf *bsdf, float *choice, vec3s *factor) {
    const float mirror = fr_luminance(bsdf->mirror), clear = fr_luminance(bsdf->clear);
    *factor = glms_vec3_one();
    if (!(mirror + clear > 0.0f)) {
        return FR_STRAIGHT_NO;
    }
    float rest = fr_luminance(bsdf->reflectance) + fr_luminance(bsdf->transmittance);
    float sum = mirror + clear + rest;
    float at = *choice * sum;
    if (at < mirror) {
        *factor = glms_vec3_scale(bsdf->mirror, sum / mirror);
        return FR_STRAIGHT_MIRROR;
    }
    if (at < mirror + clear || !(rest > 0.0f)) {
        *factor = glms_vec3_scale(bsdf->clear, sum / clear);
        return clear > 0.0f ? FR_STRAIGHT_CLEAR : FR_STRAIGHT_MIRROR;
    }
    *factor = glms_vec3_fill(sum / rest);
    *choice = fminf((at - mirror - clear) / rest, 0x1.fffffep-1f);
    return FR_STRAIGHT_NO;
}

vec3s fr_bsdf_eval(const FrBsdf *bsdf, vec3s out, vec3s in) {
    float in_cosine = glms_vec3_dot(bsdf->normal, in);
    float out_cosine = fmaxf(glms_vec3_dot(bsdf->normal, out), 1e-4f);
    bool is_reflection;
    if (!classify(bsdf, in, in_cosine, &is_reflection)) {
        return glms_vec3_zero();
    }
    float coated = through_coat(bsdf, out_cosine) * through_coat(bsdf, fabsf(in_cosine));
    float matt = coated * fabsf(in_cosine) / FR_PI_F;
    if (!is_reflection) {
        return glms_vec3_scale(bsdf->transmittance, matt);
    }
    matt *= oren_nayar(bsdf, out, in, out_cosine, in_cosine);
    vec3s value = glms_vec3_scale(bsdf->reflectance, matt);
    if (bsdf->coat > 0.0f) {
        vec3s half = glms_vec3_normalize(glms_vec3_add(out, in));
        float alpha = bsdf->coat_width;
        float shadow = 1.0f + smith_lambda(alpha, out_cosine) + smith_lambda(alpha, in_cosine);
        float gloss = fresnel(bsdf->coat, glms_vec3_dot(half, in)) *
                      ggx(alpha, glms_vec3_dot(bsdf->normal, half)) / (4.0f * out_cosine * shadow);
        value = glms_vec3_adds(value, gloss);
    }
    return value;
}

float fr_bsdf_density(const FrBsdf *bsdf, vec3s out, vec3s in) {
    float in_cosine = glms_vec3_dot(bsdf->normal, in);
    float out_cosine = fmaxf(glms_vec3_dot(bsdf->normal, out), 1e-4f);
    bool is_reflection;
    if (!classify(bsdf, in, in_cosine, &is_reflection)) {
        return 0.0f;
    }
    Lobes lobes = lobe_probabilities(bsdf, out_cosine);
    float matt = fabsf(in_cosine) / FR_PI_F;
    if (!is_reflection) {
        return lobes.through * matt;
    }
    float density = lobes.matt * matt;
    if (lobes.coat > 0.0f) {
        vec3s half = glms_vec3_normalize(glms_vec3_add(out, in));
        float alpha = bsdf->coat_width;
        density += lobes.coat * ggx(alpha, glms_vec3_dot(bsdf->normal, half)) /
                   (4.0f * out_cosine * (1.0f + smith_lambda(alpha, out_cosine)));
    }
    return density;
}

/// A normal of the coat's facets as seen from `out`, both in the frame of the shading normal.
static vec3s sample_facet(float alpha, vec3s out, float u, float v) {
    vec3s stretched =
        glms_vec3_normalize((vec3s){{alpha * out.x, alpha * out.y, fmaxf(out.z, 1e-4f)}});
    // The visible half of the facets' hemisphere is a half disc joined to a squeezed one; they meet
    // along x, which lies on the horizon.
    vec3s x = {{1, 0, 0}};
    float length = stretched.x * stretched.x + stretched.y * stretched.y;
    if (length > 1e-12f) {
        x = glms_vec3_scale((vec3s){{-stretched.y, stretched.x, 0}}, 1.0f / sqrtf(length));
    }
    vec3s y = glms_vec3_cross(stretched, x);
    float radius = sqrtf(u);
    float turn = 2.0f * FR_PI_F * v;
    float a = radius * cosf(turn);
    float b = radius * sinf(turn);
    float squeeze = 0.5f * (1.0f + stretched.z);
    b = (1.0f - squeeze) * sqrtf(fmaxf(0.0f, 1.0f - a * a)) + squeeze * b;
    float c = sqrtf(fmaxf(0.0f, 1.0f - a * a - b * b));
    vec3s facet = fr_from_basis(x, y, stretched, (vec3s){{a, b, c}});
    return glms_vec3_normalize((vec3s){{alpha * facet.x, alpha * facet.y, fmaxf(0.0f, facet.z)}});
}

bool fr_bsdf_sample(const FrBsdf *bsdf, vec3s out, float choice, float u, float v, vec3s *in,
                    vec3s *factor, float *density) {
    float out_cosine = fmaxf(glms_vec3_dot(bsdf->normal, out), 1e-4f);
    Lobes lobes = lobe_probabilities(bsdf, out_cosine);
    vec3s x;
    vec3s y;
    fr_basis(bsdf->normal, &x, &y);
    if (choice < lobes.coat) {
        vec3s local = {{glms_vec3_dot(x, out), glms_vec3_dot(y, out), out_cosine}};
        vec3s facet =
            fr_from_basis(x, y, bsdf->normal, sample_facet(bsdf->coat_width, local, u, v));
        *in = glms_vec3_sub(glms_vec3_scale(facet, 2.0f * glms_vec3_dot(out, facet)), out);
        if (glms_vec3_dot(bsdf->normal, *in) <= 0.0f) {
            return false;
        }
    } else {
        float sign = choice < lobes.coat + lobes.matt ? 1.0f : -1.0f;
        float radius = sqrtf(u);
        float turn = 2.0f * FR_PI_F * v;
        float height = sign * sqrtf(fmaxf(0.0f, 1.0f - u));
        *in = fr_from_basis(x, y, bsdf->normal,
                            (vec3s){{radius * cosf(turn), radius * sinf(turn), height}});
    }
    *in = glms_vec3_normalize(*in);
    *density = fr_bsdf_density(bsdf, out, *in);
    if (!(*density > 0.0f)) {
        return false;
    }
    *factor = glms_vec3_scale(fr_bsdf_eval(bsdf, out, *in), 1.0f / *density);
    return true;
}
