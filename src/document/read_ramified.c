/// `<ramified>`: a plant of forks, by chance, by a matrix in its text or by strands.
#include "document/reader.h"

FrRamified *fr_read_ramified(FrReader *reader, uint32_t node) {
    FrStatus before = reader->status;
    reader->status = FR_OK;
    fr_read_check_children(reader, node, FR_ELEMENT_RAMIFIED);
    FrRamifiedParams params;
    fr_params_init(fr_ramified_table(), &params);
    fr_read_attributes(reader, node, FR_ELEMENT_RAMIFIED, &params);
    FrRamified *ramified = fr_ramified_new(&params);
    fr_ramified_set_materials(
        ramified, fr_read_material(reader, node, "material", params.material),
        fr_read_material(reader, node, "leaf-material", params.leaf_material));
    FrSource *text = fr_read_source(reader, node);
    if (reader->status == FR_OK) {
        FrSpan span = fr_xml_span(reader->tree, reader->tree->nodes[node].name);
        fr_read_note(reader, fr_ramified_load(ramified, text, span, reader->context));
    }
    fr_source_unref(text);
    fr_params_clear(fr_ramified_table(), &params);
    fr_read_note(reader, before);
    return ramified;
}
