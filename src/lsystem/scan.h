/// @file lsystem/scan.h
/// fopen(), fscanf() and fclose() of the language: numbers from files beside the L-system.
#pragma once

#include "lsystem/vm.h"

typedef struct FrLfile FrLfile;

void fr_lfile_free(FrLfile *file);
/// Opens a file for reading; `name` and `mode` are numbers of texts. Its handle, from 1; −1 and a
/// fault where it is not there, lies elsewhere or is to be written.
double fr_lfile_open(FrLmachine *machine, double name, double mode, uint32_t place);
void fr_lfile_close(FrLmachine *machine, double handle);
/// Begins to read by a format; what follows are its numbers, one after the other.
void fr_lscan_begin(FrLmachine *machine, double handle, uint32_t format);
/// The next number, or `otherwise` where the file has something else.
double fr_lscan_next(FrLmachine *machine, double otherwise);
/// Reads what stands behind the last number; how many there were, −1 at the end of the file.
double fr_lscan_end(FrLmachine *machine);
