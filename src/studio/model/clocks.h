/// @file clocks.h
/// A document as it is at another time.
#pragma once

#include "frond/context.h"

/// The text with the clocks of all plants set, in years; NAN: as it is. Places of diagnostics stay
/// those of the document. A text that is not well-formed stays as it is. A reference.
FrSource *studio_source_at_time(FrSource *source, double time, const FrContext *context);
