#include "studio/model/scene_single.h"

#include "frond/scene.h"
#include "studio/model/scene_edit.h"
#include "studio/model/values.h"

#include <string.h>

bool studio_is_spread(const StudioDocument *document, uint32_t element) {
    const FrContents *contents = studio_document_contents(document);
    if (contents == NULL || element == FR_NONE) {
        return false;
    }
    const char *name = fr_contents_at(contents, element)->name;
    return strcmp(name, "row") == 0 || strcmp(name, "strew") == 0;
}

// What `except` says with more numbers in it.
static FrSplice leave_out(const FrContents *contents, uint32_t element, const uint32_t *numbers,
                          size_t count) {
    char *old = fr_contents_get(contents, element, "except");
    GString *text = g_string_new(old == NULL ? "" : g_strstrip(old));
    for (size_t i = 0; i < count; i++) {
        g_string_append_printf(text, "%s%u", text->len > 0 ? " " : "", numbers[i]);
    }
    FrSplice splice = fr_contents_set(contents, element, "except", text->str);
    g_string_free(text, TRUE);
    g_free(old);
    return splice;
}

bool studio_leave_out(StudioDocument *document, uint32_t element, const uint32_t *numbers,
                      size_t count, const char *key) {
    return count > 0 && studio_is_spread(document, element) &&
           studio_document_splice_one(
               document, leave_out(studio_document_contents(document), element, numbers, count),
               "Take out", key);
}

// The plant as a place: where it stands to a tenth of a millimetre.
static char *place_xml(const StudioDocument *document, const FrPlace *place) {
    const double at[3] = {(double)place->at.x, (double)place->at.y, (double)place->at.z};
    StudioSpot spot = {.at = {at[0], at[1], at[2]},
                       .turn = place->turn * 180 / G_PI,
                       .scale = place->scale,
                       .seed = place->seed};
    return studio_place_xml(document, place->plant, &spot);
}

bool studio_release(StudioDocument *document, uint32_t element, uint32_t number) {
    if (!studio_is_spread(document, element) || studio_document_is_broken(document)) {
        return false;
    }
    const FrContents *contents = studio_document_contents(document);
    FrContext context = fr_context_default();
    FrDocument *read;
    FrPlace place;
    FrStatus status = fr_document_parse(studio_document_source(document),
                                        studio_document_folder(document), &context, &read);
    // A stand knows where the name of its element begins, which is behind the bracket.
    uint32_t origin = fr_contents_at(contents, element)->begin + 1;
    bool is_found = status == FR_OK && fr_scene_find_placed(read, origin, number, &context, &place);
    if (is_found) {
        char *xml = place_xml(document, &place);
        FrSplice splices[2] = {
            leave_out(contents, element, &number, 1),
            studio_scene_insert(contents, studio_scene_last(document, "place"), xml)};
        GArray *all = g_array_new(FALSE, FALSE, sizeof(FrSplice));
        g_array_append_vals(all, splices, 2);
        is_found = studio_document_splice(document, all, "Take one plant out", NULL);
        g_array_unref(all);
        g_free(xml);
    }
    fr_document_free(read);
    return is_found;
}
