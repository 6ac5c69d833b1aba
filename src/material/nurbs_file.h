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

/// Bytes of a text's first line; lines end with \n, \r\n or \r.
size_t fr_line_length(const char *text, size_t size);
/// Bytes of the line's end there.
size_t fr_line_end(const char *text, size_t size);

/// True if a text of Wavefront OBJ has free-form surfaces.
bool fr_obj_has_surfaces(const char *text, size_t size);
/// True if it has polygons.
bool fr_obj_has_faces(const char *text, size_t size);
/// Reads the surfaces of a text, z up, in metres.
void fr_obj_surfaces(FrSurfaceReader *reader, const char *text, size_t size);
void fr_iges_surfaces(FrSurfaceReader *reader, const char *text, size_t size);
/// Writes blanks over all free-form statements, so that those of polygons are left, in lines that
/// end with \n or \r\n. True if there are faces among them.
bool fr_obj_keep_faces(char *text, size_t size);

/// A surface with room for its numbers, appended once it is whole.
FrNurbsSurface fr_surface_new(uint32_t degree_u, uint32_t count_u, uint32_t degree_v,
                              uint32_t count_v, double **knots_u, double **knots_v,
                              double (**points)[4]);
/// Takes the part of a surface within `ranges` of u and v if it is sound, else tells that the one
/// at `line` is not.
void fr_surface_take(FrSurfaceReader *reader, FrNurbsSurface surface, double ranges[2][2],
                     size_t line);
void fr_surface_fail(FrSurfaceReader *reader, size_t line, const char *what, ...) FR_PRINTF(3, 4);
void fr_surface_warn(FrSurfaceReader *reader, size_t line, const char *what, ...) FR_PRINTF(3, 4);

/// Reads a file of surfaces: as triangles, and as they are; of an .obj also its polygons. NULL and
/// *status after a diagnostic.
FrMeshFile *fr_nurbs_file_import(const char *path, const char *name, FrSpan span,
                                 const FrContext *context, FrStatus *status);
/// True if the file is one of surfaces.
bool fr_nurbs_file_is(const char *path);
