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

/// The value of an expression of numbers and sliders in bytes [begin, end) of the text.
bool fr_value_fixed(const FrValueText *value, size_t begin, size_t end, double *number);
/// "= 2*size, 0, 1" or "= size": three such numbers within the parameter's range, or one for all.
bool fr_value_fixed_vector(const FrValueText *value, const FrParam *param, double parts[3]);
/// Whether it is "= pick(number, first; second; third)", for kinds that are no numbers.
bool fr_value_is_pick(const FrValueText *value, const FrParam *param);
/// Stores what is picked, as fr_value_parse() does. The number is rounded and held in range; all
/// that may be picked must be right.
FrStatus fr_value_pick(const FrValueText *value, const FrParam *param, void *field);
/// Stores the value in `field`, which keeps its old one if the text is wrong.
FrStatus fr_value_parse(const FrValueText *value, const FrParam *param, void *field);
