#include "studio/model/adopt.h"

#include "studio/model/borrowed.h"

// New names begin with that of the plant they are taken over with: oak_bark.
static void name_clashes(StudioNames *names, const FrContents *mine, const FrContents *theirs,
                         const char *plant) {
    for (uint32_t i = fr_contents_at(theirs, 0)->first; i != FR_NONE;
         i = fr_contents_at(theirs, i)->next) {
        const FrContentsElement *at = fr_contents_at(theirs, i);
        StudioTag tag = studio_tag_of(theirs, i);
        uint32_t own = studio_tag_is_top(tag) && at->id != NULL
                           ? studio_tag_find(mine, 0, tag, at->id)
                           : FR_NONE;
        if (own != FR_NONE && !studio_is_same(mine, own, theirs, i)) {
            char *id = tag == STUDIO_TAG_PLANT ? g_strdup(at->id)
                                               : g_strdup_printf("%s_%s", plant, at->id);
            g_strdelimit(id, "-", '_'); // in formulas it would be a minus
            studio_names_add(names, mine, 0, theirs, i, id);
            g_free(id);
        }
    }
}

uint32_t studio_adopt_behind(const FrContents *mine) {
    uint32_t last = FR_NONE;
    for (uint32_t i = fr_contents_at(mine, 0)->first; i != FR_NONE;
         i = fr_contents_at(mine, i)->next) {
        last = studio_tag_is_top(studio_tag_of(mine, i)) ? i : last;
    }
    return last;
}

char *studio_adopt_xml(const FrContents *mine, const FrContents *theirs, GHashTable *wanted) {
    GString *xml = g_string_new(NULL);
    for (uint32_t i = fr_contents_at(theirs, 0)->first; i != FR_NONE;
         i = fr_contents_at(theirs, i)->next) {
        StudioTag tag = studio_tag_of(theirs, i);
        bool is_wanted = studio_tag_is_top(tag) &&
                         (wanted == NULL || g_hash_table_contains(wanted, GUINT_TO_POINTER(i)));
        uint32_t own =
            !is_wanted ? FR_NONE : studio_tag_find(mine, 0, tag, fr_contents_at(theirs, i)->id);
        if (is_wanted && !studio_is_same(mine, own, theirs, i)) {
            char *text = studio_element_text(theirs, i);
            g_string_append_printf(xml, "%s%s", xml->len > 0 ? "\n" : "", text);
            g_free(text);
        }
    }
    return g_string_free(xml, FALSE);
}

bool studio_adopt(StudioDocument *document, FrSource *from, const char *plant, const char *key,
                  char **id) {
    *id = NULL;
    FrContext context = fr_context_default();
    FrContents *theirs;
    if (studio_document_is_broken(document) || studio_document_contents(document) == NULL ||
        fr_contents_read(from, &context, &theirs) != FR_OK) {
        return false;
    }
    const FrContents *mine = studio_document_contents(document);
    uint32_t wanted = plant == NULL ? fr_contents_child(theirs, 0, "plant")
                                    : studio_tag_find(theirs, 0, STUDIO_TAG_PLANT, plant);
    const char *own = wanted == FR_NONE ? NULL : fr_contents_at(theirs, wanted)->id;
    if (own != NULL) {
        StudioNames names;
        studio_names_init(&names, FR_NONE);
        name_clashes(&names, mine, theirs, own);
        *id = g_strdup(studio_names_get(&names, STUDIO_TAG_PLANT, own));
        FrContents *copies = studio_renamed(theirs, &names);
        char *xml = copies == NULL ? NULL : studio_adopt_xml(mine, copies, NULL);
        char *step = g_strdup_printf("Take over %s", *id);
        bool is_there =
            xml != NULL &&
            (*xml == '\0' ||
             studio_document_splice_one(
                 document, fr_contents_insert(mine, 0, studio_adopt_behind(mine), xml), step, key));
        if (!is_there) {
            g_clear_pointer(id, g_free);
        }
        g_free(step);
        g_free(xml);
        fr_contents_free(copies);
        studio_names_clear(&names);
    }
    fr_contents_free(theirs);
    return *id != NULL;
}

GHashTable *studio_adopt_elements(const FrContents *from) {
    GHashTable *elements = g_hash_table_new(NULL, NULL);
    for (uint32_t i = fr_contents_at(from, 0)->first; i != FR_NONE;
         i = fr_contents_at(from, i)->next) {
        if (studio_tag_is_top(studio_tag_of(from, i))) {
            g_hash_table_add(elements, GUINT_TO_POINTER(i));
        }
    }
    return elements;
}

StudioCarried studio_bring(const StudioDocument *document, const FrContents *theirs,
                           const char *folder, GHashTable *wanted) {
    if (!studio_names_files(theirs, wanted)) {
        return (StudioCarried){fr_source_ref(fr_contents_source(theirs)), NULL,
                               g_ptr_array_new_with_free_func(g_free)};
    }
    if (studio_document_path(document) == NULL) {
        return (StudioCarried){
            NULL, g_strdup("Save the document first: its pictures and meshes are kept beside it"),
            g_ptr_array_new_with_free_func(g_free)};
    }
    return studio_carry(theirs, &(StudioCarry){.from = folder,
                                               .is_inside = true,
                                               .to = studio_document_folder(document),
                                               .prefix = "",
                                               .wanted = wanted});
}
