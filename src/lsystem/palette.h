/// @file lsystem/palette.h
/// Materials by colour index.
#pragma once

#include "frond/material.h"

/// Reads a colour map (.map) or materials (.mat): 256 materials, those that the file has not are
/// NULL. NULL with an error where it is neither.
FrMaterial **fr_lpalette_read(FrSource *source, FrDiags *diags);
void fr_lpalette_free(FrMaterial **colours);
