/// @file commands_private.h
/// What commands on p-graphs share.
#pragma once

#include "studio/model/commands.h"

/// The text of a `<link>`. Free with g_free().
char *studio_link_xml(const char *from, const char *to, FrLinkKind kind);
/// Adds splices (FrSplice) that put components, and links if `links` is not empty, into a graph.
void studio_insert_component(const StudioDocument *document, uint32_t graph, const char *xml,
                             const char *links, GArray *splices);
