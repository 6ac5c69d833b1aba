/// `<skeleton>`: a plant of bare lines, as a table within or in a file beside the document.
#include "document/reader.h"

FrSkeleton *fr_read_skeleton(FrReader *reader, uint32_t node) {
    FrStatus before = reader->status;
    reader->status = FR_OK;
    fr_read_check_children(reader, node, FR_ELEMENT_SKELETON);
    FrSkeletonParams params;
    fr_params_init(fr_skeleton_table(), &params);
    fr_read_attributes(reader, node, FR_ELEMENT_SKELETON, &params);
    FrSkeleton *skeleton = fr_skeleton_new(&params);
    fr_skeleton_set_material(skeleton, fr_read_material(reader, node, "material", params.material));
    FrSource *text = fr_read_own_source(reader, node, params.file);
    if (reader->status == FR_OK) {
        FrXmlRange place = fr_read_value_place(reader, node, "file");
        fr_read_note(reader, fr_skeleton_load(skeleton, text, reader->document->folder,
                                              fr_xml_span(reader->tree, place), reader->context));
    }
    fr_source_unref(text);
    fr_params_clear(fr_skeleton_table(), &params);
    fr_read_note(reader, before);
    return skeleton;
}
