// The context of a call that asks for nothing special.
#include "frond/context.h"

FrContext fr_context_default(void) {
    return (FrContext){.limits = fr_limits_default()};
}
