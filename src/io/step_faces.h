// Faces of a STEP file: surfaces, and the edges and vertices that bound them.
#pragma once

#include "io/nurbs_scene.h"

/// A STEP file on its way: entities are numbered as they are written.
typedef struct FrStep {
    FrOutput output;
    uint64_t last;      ///< number of the last entity
    const FrPose *pose; ///< of the plant whose pieces are written
    GArray *scratch;    ///< uint64_t: numbers an entity still has to name
    bool is_203;        ///< AP203, else AP214
} FrStep;

/// Begins the next entity, `#n=`; answers n.
uint64_t fr_step_begin(FrStep *step);
void fr_step_text(FrStep *step, const char *text);
/// `#n`
void fr_step_reference(FrStep *step, uint64_t entity);
/// A list of references in brackets.
void fr_step_references(FrStep *step, const uint64_t *entities, size_t count);
void fr_step_real(FrStep *step, double value, int digits);
/// A point in metres, where it stands.
uint64_t fr_step_point(FrStep *step, const double at[3]);
uint64_t fr_step_direction(FrStep *step, const double v[3]);
/// A place with its z and x axis.
uint64_t fr_step_placement(FrStep *step, const double at[3], const double axis[3],
                           const double across[3]);

/// Writes the faces of the shell that begins with pieces[0] into `faces`, room for three: a tube
/// and its caps, the halves of a blade, or one piece alone. Answers how many pieces it took, of
/// `count`; `is_closed` tells whether the shell has no rim.
uint32_t fr_step_shell(FrStep *step, const FrNurbsPiece *pieces, uint64_t count, uint64_t faces[3],
                       bool *is_closed);

// ---- step_product.c ----------------------------------------------------------------------------

/// Header, contexts and units.
void fr_step_head(FrStep *step);
/// An entity with a name and references: `#n=KIND('name',#a,#b);`
uint64_t fr_step_entity(FrStep *step, const char *kind, const char *before,
                        const uint64_t *references, size_t count, const char *after);
/// A product of that shape.
void fr_step_product(FrStep *step, const char *name, uint64_t representation);
