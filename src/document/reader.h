/// @file reader.h
/// What the readers of the sections share. A reader never stops at an error: it notes it and goes
/// on, so that one run reports many.
#pragma once

#include "document/format.h"
#include "document/tree.h"

struct FrDocument {
    FrXmlTree *tree;
    char *folder;
    GPtrArray *plants, *places, *rows, *strews, *views, *materials;
    FrSceneParams scene;
    FrSurroundings surroundings;
    FrGrowthDef growth;
    FrScope *scope;
};

typedef struct FrReader {
    FrDocument *document;
    const FrXmlTree *tree;
    FrDiags *diags;
    const FrContext *context; ///< NULL: nothing but the tree may be read
    FrStatus status;          ///< the worst so far
    GHashTable *material_ids; ///< id → FrMaterial *
    GHashTable *plant_ids;    ///< id → FrPlantDef *
    const FrScope *scope;     ///< what expressions may use where the reader is
    uint32_t hints;           ///< names suggested so far
} FrReader;

void fr_reader_open(FrReader *reader, FrDocument *document, FrDiags *diags);
void fr_reader_close(FrReader *reader);

/// Reads all sections of document->tree into the document.
FR_MUST_USE FrStatus fr_document_read(FrDocument *document, const FrContext *context);

/// Each reads the children of `parent` that belong to its section.
void fr_read_curves(FrReader *reader, uint32_t parent);
/// The file an attribute names must be there, relative to the document.
void fr_read_check_file(FrReader *reader, uint32_t node, const char *attribute, const char *file);
void fr_read_materials(FrReader *reader, uint32_t parent);
void fr_read_plants(FrReader *reader, uint32_t parent);
/// Reads the `<slider>`s of a `<plant>`; each becomes a number of `scope`. Free with
/// g_ptr_array_unref().
GPtrArray *fr_read_sliders(FrReader *reader, uint32_t plant, FrScope *scope);
/// Reports sliders and components of one name, which `--set` could not tell apart.
void fr_read_check_sliders(FrReader *reader, uint32_t plant, const FrPgraph *graph);
void fr_read_pgraph(FrReader *reader, uint32_t node, FrPgraph *graph);
/// The `<plant>` of a definition.
uint32_t fr_read_find_plant(const FrXmlTree *tree, const FrPlantDef *plant);
/// Reads an `<lsystem>` and compiles it.
FrLmodel *fr_read_lsystem(FrReader *reader, uint32_t node);
/// Reads a `<define>`: its id, to be freed with g_free(), or NULL with an error. `value` is set.
char *fr_read_define(FrReader *reader, uint32_t node, FrNumber *value);
/// Reports grafts of plants that cannot be grafted, and numbers those do not know.
void fr_read_check_grafts(FrReader *reader);
/// What grafts do not see of the scene; after fr_read_scenes().
void fr_read_warn_grafts(FrReader *reader);
/// Reads the `<edits>` of a plant whose graph has been read.
void fr_read_edits(FrReader *reader, uint32_t plant, FrPgraph *graph);
/// Reads a `<skeleton>` and its table.
FrSkeleton *fr_read_skeleton(FrReader *reader, uint32_t node);
/// Reads a `<ramified>` and its matrix.
FrRamified *fr_read_ramified(FrReader *reader, uint32_t node);
/// Reads a `<vary>`; NULL after an error that leaves nothing of it.
FrVary *fr_read_vary(FrReader *reader, uint32_t node);
/// Reports varied plants whose base is no other plant.
void fr_read_check_bases(FrReader *reader);
/// Reads a `<species>`.
FrSpeciesDef *fr_read_species(FrReader *reader, uint32_t node);
void fr_species_def_free(FrSpeciesDef *species);
/// The `<growth>` of a `<scene>`.
void fr_read_growth(FrReader *reader, uint32_t scene);
void fr_growth_def_init(FrGrowthDef *growth);
void fr_growth_def_clear(FrGrowthDef *growth);
void fr_read_scenes(FrReader *reader, uint32_t parent);
/// Where plants stand in a `<scene>`.
void fr_read_placing(FrReader *reader, uint32_t scene);
/// Arrays of FrRow * and FrStrew *.
GPtrArray *fr_rows_new(void);
GPtrArray *fr_strews_new(void);
/// What stands and shines in a `<scene>`.
void fr_read_surroundings(FrReader *reader, uint32_t scene);
void fr_surroundings_init(FrSurroundings *surroundings);
void fr_surroundings_clear(FrSurroundings *surroundings);

/// The material of that id, which an attribute names; NULL for none, or with an error.
FrMaterial *fr_read_material(FrReader *reader, uint32_t node, const char *attribute,
                             const char *id);
/// The text within an element as a source of its own, whose places are those of the document; NULL
/// if there is nothing but blanks.
FrSource *fr_read_source(const FrReader *reader, uint32_t node);
/// The same for an element that has either a text or a `file`, with an error if it has both or
/// neither.
FrSource *fr_read_own_source(FrReader *reader, uint32_t node, const char *file);
/// The text within an element and its place, from its first to its last text or CDATA section.
/// Free with g_free().
char *fr_read_text(const FrReader *reader, uint32_t node, FrXmlRange *place);
/// The line that the text within an element gives, point by point; NULL with an error. Free with
/// fr_stroke_unref().
FrStroke *fr_read_line(FrReader *reader, uint32_t node);
/// The same for an element of that kind that draws nothing: an error if there is a text.
void fr_read_check_no_line(FrReader *reader, uint32_t node, const char *message);
/// Where a file that an attribute names lies; NULL for none, or with an error. Free with g_free().
char *fr_read_path(FrReader *reader, uint32_t node, const char *attribute, const char *file);
/// The picture that an attribute names, relative to the document; NULL for none, or with an error.
FrImage *fr_read_picture(FrReader *reader, uint32_t node, const char *attribute, const char *file);
void fr_read_note(FrReader *reader, FrStatus status);
/// An error at a place of the text.
void fr_read_error(FrReader *reader, const char *code, FrXmlRange place, const char *format, ...)
    FR_PRINTF(4, 5);

/// The first child of `parent` that is such an element, FR_NONE.
uint32_t fr_read_first(const FrReader *reader, uint32_t parent, FrElementId id);
/// The next such sibling after `node`, FR_NONE.
uint32_t fr_read_next(const FrReader *reader, uint32_t node, FrElementId id);
/// Reports children that do not belong in such an element, text where there is none, and repeated
/// elements that may stand once.
void fr_read_check_children(FrReader *reader, uint32_t node, FrElementId id);
/// Sets the attributes of `node` in `object`, which fr_params_init() has filled; reports unknown,
/// wrong and missing ones.
void fr_read_attributes(FrReader *reader, uint32_t node, FrElementId id, void *object);
/// Says, once they are read, why a parameter has no effect beside the others; NULL if it has one.
typedef char *(*FrWhyUnread)(const void *object, const FrParam *row, const void *user);
/// Warns of attributes that have no effect.
void fr_read_check_effects(FrReader *reader, uint32_t node, FrElementId id, const void *object,
                           FrWhyUnread why, const void *user);
/// One of them.
void fr_read_attribute(FrReader *reader, uint32_t node, const FrXmlAttribute *attribute,
                       FrElementId id, void *object);
/// The element's id, to be freed with g_free(); NULL with an error if it is missing or wrong.
char *fr_read_id(FrReader *reader, uint32_t node);
/// The place of an attribute's value, else that of the element's name.
FrXmlRange fr_read_value_place(const FrReader *reader, uint32_t node, const char *attribute);
/// As many of `count` names as are worth giving to fr_read_hint(): a document may hold 100 000
/// misspelt names of 100 000.
static inline uint32_t fr_read_candidates(size_t count) {
    return count < 1000 ? (uint32_t)count : 1000;
}
/// "; did you mean 'x'?" or "". Free with g_free(). Looks for the first errors of a document only.
char *fr_read_hint(FrReader *reader, const char *name, const char *const *candidates, size_t count);
