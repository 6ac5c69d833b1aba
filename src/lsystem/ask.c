#include "lsystem/ask.h"

FrStatus fr_lderivation_ask(FrLderivation *derivation, const FrContext *context) {
    (void)context;
    derivation->is_answered = true;
    return FR_OK;
}
