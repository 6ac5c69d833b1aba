// Shapes of organs as small meshes, made once and copied wherever an organ is.
#pragma once

#include "frond/skin.h"

#include "skin/plan.h"

typedef struct FrShapeMesh {
    FrVertex *vertices; ///< owned
    uint32_t *indices;  ///< owned
    uint32_t vertex_count, index_count;
    uint32_t vertex_room, index_room; ///< while it is made
    bool is_foliage;                  ///< open: seen from both sides
    bool is_crown;                    ///< its normals point away from the middle of the crown
} FrShapeMesh;

void fr_shape_mesh_init(FrShapeMesh *mesh, const FrPlant *plant, uint32_t shape,
                        const FrDetail *detail);
void fr_shape_mesh_clear(FrShapeMesh *mesh);

/// At most so many bytes the mesh of a shape takes; counted, not made.
uint64_t fr_shape_bytes_most(const FrPlant *plant, const FrShape *shape, const FrDetail *detail);

/// Appends a vertex and answers its index.
uint32_t fr_shape_vertex(FrShapeMesh *mesh, vec3s position, vec3s normal, float u, float v);
/// Appends a triangle unless two of its corners are the same.
void fr_shape_triangle(FrShapeMesh *mesh, uint32_t a, uint32_t b, uint32_t c);

/// A whole number of segments reduced for the level of detail.
uint32_t fr_shape_segments(uint32_t wanted, uint32_t least, uint32_t most, const FrDetail *detail);

/// Quads along a blade and across each half.
void fr_blade_segments(const FrBlade *blade, const FrDetail *detail, uint32_t *along,
                       uint32_t *across);
/// A blade with its petiole.
void fr_lay_blade(FrShapeMesh *mesh, const FrPlant *plant, const FrBlade *blade,
                  const FrDetail *detail);
/// A compound leaf: its rachis and leaflets.
void fr_lay_compound(FrShapeMesh *mesh, const FrPlant *plant, const FrBlade *blade,
                     const FrDetail *detail);
/// How many leaflets it has at most.
uint64_t fr_compound_leaflets(const FrBlade *blade);
/// Turns normals as FrBlade.normals says.
void fr_turn_normals(FrShapeMesh *mesh, const FrBlade *blade);
void fr_shape_blade(FrShapeMesh *mesh, const FrPlant *plant, const FrBlade *blade,
                    const FrDetail *detail);
void fr_shape_revolution(FrShapeMesh *mesh, const FrPlant *plant, const FrShape *shape,
                         const FrDetail *detail);
void fr_shape_primitive(FrShapeMesh *mesh, const FrShape *shape, const FrDetail *detail);
/// FR_SHAPE_FILE: a part of a file, and at most so many vertices.
void fr_shape_file(FrShapeMesh *mesh, const FrPlant *plant, const FrShape *shape,
                   const FrDetail *detail);
uint64_t fr_shape_file_vertices(const FrPlant *plant, const FrShape *shape);
/// FR_SHAPE_MESH: the triangles of a profile.
void fr_shape_triangles(FrShapeMesh *mesh, const FrPlant *plant, const FrShape *shape);
