// Reading one value of a parameter table.
#pragma once

#include "frond/param.h"

/// The text of a value, where it is and where its errors go.
typedef struct FrValueText {
    const char *text;
    FrSpan span;
    const FrScope *scope;
    FrDiags *diags;
} FrValueText;

/// Stores the value in `field`, which keeps its old one if the text is wrong.
FrStatus fr_value_parse(const FrValueText *value, const FrParam *param, void *field);
