/// Is it UTF-8, and is it XML? libxml2 answers the second; it reads without
/// network, entities or tree, piece by piece, and stops at the first thing wrong.
#include "document/tree.h"

#include <libxml/parser.h>
#include <string.h>

// ---- encoding ---------------------------------------------------------------------------------

static FrSpan span_at(FrSource *source, size_t offset, size_t length) {
    return (FrSpan){source, (uint32_t)offset, (uint32_t)(offset + length)};
}

/// The value of `encoding` in an XML declaration at the text's very start; false if none is given.
static bool find_declared_encoding(const char *text, size_t size, size_t *begin, size_t *end) {
    size_t start = size >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0 ? 3 : 0;
    if (size - start < 6 || memcmp(text + start, "<?xml", 5) != 0 ||
        !g_ascii_isspace(text[start + 5])) {
        return false;
    }
    const char *stop = memchr(text + start, '>', size - start);
    size_t length = stop == NULL ? 0 : (size_t)(stop - text) - start;
    const char *word = memmem(text + start, length, "encoding", 8);
    if (word == NULL) {
        return false;
    }
    size_t at = (size_t)(word - text) + 8;
    while (at < size && (g_ascii_isspace(text[at]) || text[at] == '=')) {
        at++;
    }
    const char *close = at < size ? memchr(text + at + 1, text[at], size - at - 1) : NULL;
    if (close == NULL) {
        return false;
    }
    *begin = at + 1;
    *end = (size_t)(close - text);
    return true;
}

FrStatus fr_xml_check_encoding(FrSource *source, FrDiags *diags) {
    size_t size;
    const char *text = fr_source_text(source, &size);
    if (size >= 2 && (memcmp(text, "\xff\xfe", 2) == 0 || memcmp(text, "\xfe\xff", 2) == 0)) {
        fr_diags_add(diags, FR_ERROR, "encoding", span_at(source, 0, 0),
                     "this is UTF-16; save the document as UTF-8");
        return FR_ERR_DOCUMENT;
    }
    size_t begin, end;
    if (find_declared_encoding(text, size, &begin, &end) &&
        (end - begin != 5 || g_ascii_strncasecmp(text + begin, "UTF-8", 5) != 0)) {
        fr_diags_add(diags, FR_ERROR, "encoding", span_at(source, begin, end - begin),
                     "the encoding is '%.*s'; only UTF-8 is read", (int)MIN(end - begin, 32),
                     text + begin);
        return FR_ERR_DOCUMENT;
    }
    const char *bad;
    if (!g_utf8_validate_len(text, size, &bad)) {
        size_t offset = (size_t)(bad - text);
        if (*bad == '\0') {
            fr_diags_add(diags, FR_ERROR, "encoding", span_at(source, offset, 1),
                         "a zero byte: this is not a text in UTF-8");
        } else {
            fr_diags_add(diags, FR_ERROR, "encoding", span_at(source, offset, 1),
                         "byte 0x%02x is not UTF-8", (unsigned)(unsigned char)*bad);
        }
        return FR_ERR_DOCUMENT;
    }
    return FR_OK;
}

// ---- well-formed ------------------------------------------------------------------------------

typedef struct Judge {
    xmlParserCtxt *parser;
    FrSource *source;
    FrDiags *diags;
    size_t given; ///< bytes that libxml2 has asked for
    bool is_wrong;
} Judge;

static int give_bytes(void *user, char *buffer, int length) {
    Judge *judge = user;
    size_t size;
    const char *text = fr_source_text(judge->source, &size);
    size_t count = MIN((size_t)length, size - judge->given);
    memcpy(buffer, text + judge->given, count);
    judge->given += count;
    return (int)count;
}

static int close_bytes(void *user) {
    (void)user;
    return 0;
}

/// What libxml2 says, as one line without its full stop.
static char *message_of(const xmlError *error) {
    char *message = g_strdup(error->message != NULL ? error->message : "not well-formed");
    g_strdelimit(message, "\n", ' ');
    g_strchomp(message);
    return message;
}

static void on_error(void *user, xmlError *error) {
    Judge *judge = user;
    if (error->level != XML_ERR_FATAL || judge->is_wrong) {
        return;
    }
    judge->is_wrong = true;
    size_t size;
    fr_source_text(judge->source, &size);
    long consumed = xmlByteConsumed(judge->parser);
    size_t offset = consumed < 0 ? size : MIN((size_t)consumed, size);
    char *message = message_of(error);
    fr_diags_add(judge->diags, FR_ERROR, "not-well-formed", span_at(judge->source, offset, 0),
                 "not well-formed XML: %s", message);
    g_free(message);
    xmlStopParser(judge->parser);
}

static void ignore_warning(void *user, const char *format, ...) {
    (void)user;
    (void)format;
}

FrStatus fr_xml_check_well_formed(FrSource *source, FrDiags *diags) {
    size_t size;
    fr_source_text(source, &size);
    if (size == 0) {
        fr_diags_add(diags, FR_ERROR, "not-well-formed", span_at(source, 0, 0),
                     "the document is empty");
        return FR_ERR_DOCUMENT;
    }
    xmlInitParser();
    Judge judge = {.source = source, .diags = diags};
    xmlSAXHandler handler = {
        .initialized = XML_SAX2_MAGIC, .serror = on_error, .warning = ignore_warning};
    xmlParserCtxt *parser = xmlCreateIOParserCtxt(&handler, &judge, give_bytes, close_bytes, &judge,
                                                  XML_CHAR_ENCODING_UTF8);
    FR_ASSERT(parser != NULL);
    judge.parser = parser;
    // HUGE lifts fixed limits on long texts; ours on bytes, elements and nesting already hold.
    xmlCtxtUseOptions(parser, XML_PARSE_NONET | XML_PARSE_HUGE);
    xmlParseDocument(parser);
    if (!judge.is_wrong && !parser->wellFormed) {
        judge.is_wrong = true;
        fr_diags_add(diags, FR_ERROR, "not-well-formed", span_at(source, size, 0),
                     "not well-formed XML");
    }
    xmlFreeParserCtxt(parser);
    return judge.is_wrong ? FR_ERR_DOCUMENT : FR_OK;
}
