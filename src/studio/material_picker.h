/// @file material_picker.h
/// A button that shows the material of a parameter and offers those of the document.
#pragma once

#include "studio/swatches.h"

#define STUDIO_TYPE_MATERIAL_PICKER (studio_material_picker_get_type())
G_DECLARE_FINAL_TYPE(StudioMaterialPicker, studio_material_picker, STUDIO, MATERIAL_PICKER, GtkBox)

/// Signals:
///   "chosen" (const char *id)   NULL: none
///   "wanted" (gboolean is_copy) a new material, or a copy of the one that is shown
GtkWidget *studio_material_picker_new(StudioSwatches *swatches);
/// Shows what an attribute says; NULL: nothing.
void studio_material_picker_show(StudioMaterialPicker *picker, const StudioDocument *document,
                                 const char *value);
