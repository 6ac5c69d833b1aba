/// @file unread.h
/// Parameters of materials that others leave without effect.
#pragma once

#include "frond/material.h"

/// See fr_params_why_unread().
char *fr_material_why_unread(const FrMaterialParams *params, const FrParam *row);
