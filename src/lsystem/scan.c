// Reading numbers from files by formats, as fscanf() of C does it: blanks of a format take any
// blanks of the file, other characters themselves, %f, %g, %lf and %d a number.
#include "lsystem/scan.h"

#include <math.h>

#define MOST_BYTES 64000000
#define MOST_FILES 64

struct FrLfile {
    FrSource *source;
    const char *text; ///< ends with a zero byte
    size_t size, at;
};

void fr_lfile_free(FrLfile *file) {
    if (file != NULL) {
        fr_source_unref(file->source);
        g_free(file);
    }
}

static const char *text_of(const FrLmachine *machine, double number) {
    const GPtrArray *strings = machine->system->strings;
    return number >= 0 && number < strings->len ? g_ptr_array_index(strings, (guint)number) : "";
}

/// Files are read from the folder of the L-system and those within it.
static FrSource *load(const FrLmachine *machine, const char *name) {
    const char *folder = machine->system->folder;
    if (folder == NULL || *name == '\0' || g_path_is_absolute(name) || strstr(name, "..") != NULL) {
        return NULL;
    }
    char *path = g_build_filename(folder, name, NULL);
    FrDiags *diags = fr_diags_new(); // that it cannot be read is told as a fault
    FrStatus status;
    FrSource *source = g_file_test(path, G_FILE_TEST_IS_REGULAR)
                           ? fr_source_load(path, MOST_BYTES, diags, &status)
                           : NULL;
    fr_diags_free(diags);
    g_free(path);
    return source;
}

double fr_lfile_open(FrLmachine *machine, double name, double mode, uint32_t place) {
    bool is_read = *text_of(machine, mode) == 'r';
    FrSource *source =
        is_read && machine->files->len < MOST_FILES ? load(machine, text_of(machine, name)) : NULL;
    if (source == NULL) {
        fr_lmachine_fault(machine, is_read ? "missing-file" : "left-out", place);
        return -1;
    }
    FrLfile *file = g_new0(FrLfile, 1);
    file->source = source;
    file->text = fr_source_text(source, &file->size);
    g_ptr_array_add(machine->files, file);
    return (double)machine->files->len;
}

static FrLfile *file_of(const FrLmachine *machine, double handle) {
    return handle >= 1 && handle <= machine->files->len
               ? g_ptr_array_index(machine->files, (guint)handle - 1)
               : NULL;
}

void fr_lfile_close(FrLmachine *machine, double handle) {
    FrLfile *file = file_of(machine, handle);
    if (file != NULL) {
        g_ptr_array_index(machine->files, (guint)handle - 1) = NULL;
        fr_lfile_free(file);
    }
}

void fr_lscan_begin(FrLmachine *machine, double handle, uint32_t format) {
    machine->scan = (FrLscan){.file = file_of(machine, handle), .format = text_of(machine, format)};
}

static void skip_blanks(FrLfile *file) {
    while (file->at < file->size && g_ascii_isspace(file->text[file->at])) {
        file->at++;
    }
}

/// Goes on in format and file up to the next conversion; false at the end or where they differ.
static bool seek_conversion(FrLscan *scan) {
    FrLfile *file = scan->file;
    while (file != NULL && !scan->has_failed && *scan->format != '\0') {
        char c = *scan->format;
        if (g_ascii_isspace(c)) {
            skip_blanks(file);
        } else if (c == '%' && scan->format[1] != '%') {
            return true;
        } else {
            scan->format += c == '%';
            scan->has_failed = file->at >= file->size || file->text[file->at] != c;
            file->at += !scan->has_failed;
        }
        scan->format++;
    }
    return false;
}

/// Takes the number that a conversion stands for; false if there is none. `is_kept` tells that it
/// goes to a variable.
static bool take_number(FrLscan *scan, double *value, bool *is_kept) {
    FrLfile *file = scan->file;
    scan->format++;
    *is_kept = *scan->format != '*';
    scan->format += strspn(scan->format, "*0123456789lLh");
    bool is_number = *scan->format != '\0' && strchr("fgeFGEdiu", *scan->format) != NULL;
    scan->format += *scan->format != '\0';
    skip_blanks(file);
    char *end;
    *value = g_ascii_strtod(file->text + file->at, &end);
    size_t taken = (size_t)(end - file->text) - file->at;
    scan->is_at_end = file->at >= file->size;
    scan->has_failed = !is_number || taken == 0 || !isfinite(*value);
    file->at += scan->has_failed ? 0 : taken;
    return !scan->has_failed;
}

double fr_lscan_next(FrLmachine *machine, double otherwise) {
    FrLscan *scan = &machine->scan;
    double value;
    bool is_kept;
    while (seek_conversion(scan) && take_number(scan, &value, &is_kept)) {
        if (is_kept) {
            scan->count++;
            return value;
        }
    }
    return otherwise;
}

double fr_lscan_end(FrLmachine *machine) {
    FrLscan *scan = &machine->scan;
    seek_conversion(scan);
    bool is_over = scan->file == NULL || (scan->count == 0 && scan->is_at_end);
    return is_over ? -1 : (double)scan->count;
}
