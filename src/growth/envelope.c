// Envelopes: a closed surface of revolution whose outline is given by points (radius, height), or
// any closed mesh (Beneš, Andrysco, Šťava 2009, section 3.1).
#include "growth/engine.h"

#include <cglm/struct.h>
#include <math.h>

double fr_envelope_radius(const FrPoints *outline, double height) {
    double radius = -1;
    for (size_t i = 0; i + 1 < outline->count; i++) {
        const double *a = outline->at[i], *b = outline->at[i + 1];
        double low = MIN(a[1], b[1]), high = MAX(a[1], b[1]);
        if (height >= low && height <= high) {
            double part = high > low ? (height - a[1]) / (b[1] - a[1]) : 0;
            radius = MAX(radius, a[0] + part * (b[0] - a[0]));
        }
    }
    return radius;
}

bool fr_envelope_holds(const FrReadySpecies *species, vec3s at, vec3s up) {
    if (species->envelope != NULL) {
        double place[3] = {(double)at.x, (double)at.y, (double)at.z}, outward[3];
        return fr_distance_at(species->envelope, place, outward) < 0;
    }
    const FrPoints *outline = &species->params.envelope;
    if (outline->count < 2) {
        return true;
    }
    double height = (double)glms_vec3_dot(at, up);
    vec3s across = glms_vec3_sub(at, glms_vec3_scale(up, (float)height));
    return (double)glms_vec3_norm(across) <= fr_envelope_radius(outline, height);
}
