// A document around a file of lines.
#include "frond/document.h"

char *fr_document_wrap_skeleton(const char *id, const char *file) {
    return g_markup_printf_escaped("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                                   "<frond version=\"1\">\n"
                                   "  <plant id=\"%s\">\n    <skeleton file=\"%s\"/>\n  </plant>\n"
                                   "</frond>\n",
                                   id, file);
}
