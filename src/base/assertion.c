// The end of a program that found a mistake of ours.
#include "frond/api.h"

#include <stdio.h>
#include <stdlib.h>

void fr_assertion_failed(const char *condition, const char *file, int line) {
    fprintf(stderr, "frond: internal error at %s:%d: %s\n", file, line, condition);
    abort();
}
