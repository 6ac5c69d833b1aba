/// frond schema and frond reference: the format's own description.
#include "cli/cli.h"

#include <stdio.h>

FrStatus cli_schema(CliSession *session) {
    (void)session;
    char *schema = fr_document_schema();
    fputs(schema, stdout);
    g_free(schema);
    return FR_OK;
}

FrStatus cli_reference(CliSession *session) {
    (void)session;
    char *reference = fr_document_reference();
    fputs(reference, stdout);
    g_free(reference);
    return FR_OK;
}
