/// @file lsystem/parse_file.h
/// The two notations of files.
#pragma once

#include "lsystem/parse.h"

/// Takes a keyword: the first letter of each word in either case, blanks within as one likes.
bool fr_lparse_keyword(FrLparser *parser, const char *keyword);
/// Takes an item of the head of an L-system and its line; false if none stands here.
bool fr_lparse_header(FrLparser *parser);
/// Reads the axiom and ends its line.
void fr_lparse_axiom(FrLparser *parser);
/// Begins a new L-system; what is read goes there.
void fr_lparse_begin_unit(FrLparser *parser);
void fr_lparse_cpfg(FrLparser *parser);
void fr_lparse_paper(FrLparser *parser);
