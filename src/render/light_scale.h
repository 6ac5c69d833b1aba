/// @file light_scale.h
/// The false colours of light. Private to render.
#pragma once

#include "frond/scene.h"

/// What the brightest colour stands for: full light, or nearly the brightest of what is shown.
float fr_light_scale_top(const FrScene *scene, const float *light, size_t count);
/// The colour of a part of the scale, sRGB: from black over blue, red and yellow to white, evenly
/// brighter.
void fr_light_scale_paint(uint8_t *pixel, float part);
