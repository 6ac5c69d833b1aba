/// @file lamp_private.h
/// What the files of lamps share.
#pragma once

#include "studio/model/lamps.h"
#include "studio/model/values.h"

/// Fills a struct of a table from the attributes of an element (FR_NONE: defaults); free with
/// fr_params_clear().
void studio_read_params(const StudioDocument *document, uint32_t element, const FrParamTable *table,
                        void *params);
/// An id that nothing in the document has. Free with g_free().
char *studio_free_name(const StudioDocument *document, const char *stem);
/// Two unit vectors across a direction.
void studio_across(const double direction[3], double x[3], double y[3]);
/// Where the handle of an aim hangs.
void studio_aim_place(const FrLampParams *lamp, double reach, double at[3]);
/// The place of the probe; false: there is no `<light>`.
bool studio_probe_place(const StudioDocument *document, double at[3]);
