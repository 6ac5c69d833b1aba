/// `<edits>`: changes of single instances of a plant of components.
#include "document/reader.h"

static void read_edit(FrReader *reader, uint32_t node, FrPgraph *graph) {
    const FrParamTable *table = fr_element(FR_ELEMENT_EDIT).table;
    FrEditParams params;
    FrStatus before = reader->status;
    fr_read_check_children(reader, node, FR_ELEMENT_EDIT);
    reader->status = FR_OK;
    fr_params_init(table, &params);
    fr_read_attributes(reader, node, FR_ELEMENT_EDIT, &params);
    if (reader->status == FR_OK) {
        FrSpan span = fr_xml_span(reader->tree, fr_read_value_place(reader, node, "at"));
        fr_read_note(reader, fr_pgraph_edit(graph, &params, span, reader->diags));
    }
    fr_read_note(reader, before);
    fr_params_clear(table, &params);
}

void fr_read_edits(FrReader *reader, uint32_t plant, FrPgraph *graph) {
    uint32_t node = fr_read_first(reader, plant, FR_ELEMENT_EDITS);
    if (node == FR_NONE) {
        return;
    }
    fr_read_check_children(reader, node, FR_ELEMENT_EDITS);
    for (uint32_t edit = fr_read_first(reader, node, FR_ELEMENT_EDIT); edit != FR_NONE;
         edit = fr_read_next(reader, edit, FR_ELEMENT_EDIT)) {
        read_edit(reader, edit, graph);
    }
}
