// Rational surfaces read from files. Private to material.
#pragma once

#include "frond/mesh_file.h"

/// What a reader of a format works with.
typedef struct FrSurfaceReader {
    const char *name; ///< of the file
    FrSpan span;      ///< where it is asked for
    const FrContext *context;
    GArray *surfaces; ///< FrNurbsSurface that own their arrays
    FrStatus status;
    bool has_trims; ///< which are not read
} FrSurfaceReader;

/// True if a text of Wavefront OBJ has free-form surfaces.
bool fr_obj_has_surfaces(const char *text);
/// Reads the surfaces of a text that ends with a zero, z up, in metres.
void fr_obj_surfaces(FrSurfaceReader *reader, const char *text);
void fr_iges_surfaces(FrSurfaceReader *reader, const char *text, size_t size);

/// A surface with room for its numbers, appended once it is whole.
FrNurbsSurface fr_surface_new(uint32_t degree_u, uint32_t count_u, uint32_t degree_v,
                              uint32_t count_v, double **knots_u, double **knots_v,
                              double (**points)[4]);
/// Takes a surface if it is sound, else tells that the one at `line` is not.
void fr_surface_take(FrSurfaceReader *reader, FrNurbsSurface surface, size_t line);
void fr_surface_fail(FrSurfaceReader *reader, size_t line, const char *what);

/// Reads a file of surfaces: as triangles, and as they are. NULL and *status after a diagnostic.
FrMeshFile *fr_nurbs_file_import(const char *path, const char *name, FrSpan span,
                                 const FrContext *context, FrStatus *status);
/// True if the file is one of surfaces.
bool fr_nurbs_file_is(const char *path);
