/// @file inspector_private.h
/// What the files of the inspector share.
#pragma once

#include "studio/inspector.h"
#include "studio/param_row.h"

enum { STUDIO_LOOK_SIZE = 88 }; ///< of a material, pixels

struct _StudioInspector {
    GtkBox parent;
    StudioDocument *document; // borrowed
    char *place;              // of the element; NULL: none
    double time;              // of the clock; NAN: as the document says
    const FrParamTable *table;
    GPtrArray *rows; // StudioParamRow *, borrowed from the sections
    StudioSwatches *swatches;
    GtkWidget *look; // of a material
    GtkWidget *stack, *id, *kind, *meaning, *search, *given, *sections, *scrolled;
};

/// The element that is shown; FR_NONE.
uint32_t studio_inspector_element(StudioInspector *inspector);
/// Shows what is called so.
void studio_inspector_follow(StudioInspector *inspector, const char *id);

// inspector_looks.c

/// Puts what chooses materials or pictures into a row for such.
void studio_inspector_put_picker(StudioInspector *inspector, StudioParamRow *row);
/// Shows how what is named looks, and a material itself; `user` is the inspector.
void studio_inspector_show_looks(void *user);
