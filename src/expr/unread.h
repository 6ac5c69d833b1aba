/// @file unread.h
/// Parameters that others of the same object leave without effect.
#pragma once

#include "frond/param.h"

/// `parameters` of `elements` ("*": all) are read where any of the `deciders` has one of `values`;
/// all are names separated by blanks. For texts, points and curves "" is none and "*" any; for
/// numbers "0" is constantly nothing and "!0" anything else.
typedef struct FrParamCondition {
    const char *elements, *parameters, *deciders, *values;
} FrParamCondition;

/// When a parameter would have an effect that has none, like "mode is density"; NULL if it has one.
/// Free with g_free().
char *fr_params_why_unread(const FrParamCondition *conditions, size_t count,
                           const FrParamTable *table, const void *object, const FrParam *row);
