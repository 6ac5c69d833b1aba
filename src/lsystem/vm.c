// The evaluator. What would be an error in arithmetic has a defined value and is told once.
#include "lsystem/vm.h"

#include "lsystem/scan.h"

#include <math.h>

/// C's conversion to int where that is defined, else the nearest int.
static int64_t whole(double value) {
    return isnan(value) ? 0 : (int64_t)CLAMP(value, -9.2e18, 9.2e18);
}

double fr_lmachine_binary(FrLop op, double a, double b, bool *is_fault) {
    switch (op) {
    case FR_LOP_ADD:
        return a + b;
    case FR_LOP_SUBTRACT:
        return a - b;
    case FR_LOP_MULTIPLY:
        return a * b;
    case FR_LOP_DIVIDE:
        *is_fault |= b == 0;
        return b == 0 ? a : a / b;
    case FR_LOP_MODULO: {
        int64_t divisor = whole(b);
        *is_fault |= divisor == 0;
        return divisor == 0 || divisor == -1 ? 0 : (double)(whole(a) % divisor);
    }
    case FR_LOP_POWER:
        return pow(a, b);
    case FR_LOP_AND:
        return a != 0 && b != 0;
    case FR_LOP_OR:
        return a != 0 || b != 0;
    case FR_LOP_LESS:
        return a < b;
    case FR_LOP_LESS_EQUAL:
        return a <= b;
    case FR_LOP_GREATER:
        return a > b;
    case FR_LOP_GREATER_EQUAL:
        return a >= b;
    case FR_LOP_EQUAL:
        return a == b;
    default:
        return a != b;
    }
}

void fr_lmachine_fault(FrLmachine *machine, const char *code, uint32_t place) {
    for (uint32_t i = 0; i < machine->fault_count; i++) {
        if (machine->faults[i].place == place) {
            return;
        }
    }
    if (machine->fault_count < FR_LFAULTS) {
        machine->faults[machine->fault_count++] = (FrLfault){code, place, machine->module};
    }
}

void fr_lmachine_fault_depth(FrLmachine *machine, const char *code,
                             const FrLproduction *production) {
    const GArray *productions = machine->system->productions;
    ptrdiff_t index = production - (const FrLproduction *)(const void *)productions->data;
    fr_lmachine_fault(machine, code, FR_LPLACE_PRODUCTION | (uint32_t)index);
}

/// The variable of an element. What is out of range becomes the nearest that is in it; fractions
/// count until the place is known.
static uint32_t element(FrLmachine *machine, const FrLcode *code, const double *indices,
                        uint32_t place) {
    const FrLarray *array = &g_array_index(machine->system->arrays, FrLarray, code->a);
    double offset = 0;
    for (uint32_t d = 0; d < code->n; d++) {
        double index = indices[d];
        if (!(index >= 0 && index < array->dimensions[d])) {
            fr_lmachine_fault(machine, "index-range", place);
            index = index > 0 ? array->dimensions[d] - 1 : 0;
        }
        offset = offset * array->dimensions[d] + index;
    }
    return array->first + (uint32_t)offset;
}

static void print(FrLmachine *machine, const FrLcode *code, const double *arguments) {
    if (machine->print == NULL) {
        return;
    }
    const char *at = g_ptr_array_index(machine->system->strings, code->a);
    GString *out = g_string_new(NULL);
    uint32_t used = 0;
    while (*at != '\0') {
        if (*at != '%' || at[1] == '%') {
            g_string_append_c(out, *at);
            at += *at == '%' ? 2 : 1;
            continue;
        }
        // Only flags, width and precision reach the C library; the conversion is one of ours.
        size_t length = 1 + strspn(at + 1, "-+ 0#.123456789");
        size_t sized = length + strspn(at + length, "lLh");
        char conversion = at[sized];
        char format[24];
        if (length < 8 && conversion != '\0' && strchr("fgeFGEdi", conversion) != NULL) {
            double value = used < code->n ? arguments[used] : 0;
            used++;
            memcpy(format, at, length);
            format[length] = strchr("di", conversion) != NULL ? 'g' : conversion;
            format[length + 1] = '\0';
            char buffer[512];
            g_ascii_formatd(buffer, sizeof buffer, format, value);
            g_string_append(out, buffer);
            at += sized + 1;
        } else {
            g_string_append_len(out, at, (gssize)length);
            at += length;
        }
    }
    machine->print(machine->print_user, out->str);
    g_string_free(out, TRUE);
}

static double call_user(FrLmachine *machine, const FrLcode *code, const double *arguments) {
    const FrLfunction *function = &g_array_index(machine->system->functions, FrLfunction, code->a);
    for (uint32_t i = 0; i < code->n; i++) {
        machine->variables[function->first + i] = arguments[i];
    }
    return fr_lmachine_run(machine, function->code);
}

/// Operators of numbers that need more than one line. `top` points behind the last value.
static void operate(FrLmachine *machine, const FrLcode *code, double *top, uint32_t place) {
    bool is_fault = false;
    top[-2] = fr_lmachine_binary((FrLop)code->op, top[-2], top[-1], &is_fault);
    if (is_fault) {
        fr_lmachine_fault(machine, "division-by-zero", place);
    }
}

/// A parameter as it is kept. What is no finite number is told once.
static inline uint32_t put(FrLmachine *machine, double value, uint32_t place) {
    uint32_t word = fr_lword(value);
    if ((word & 0x7F800000) == 0x7F800000 && word != FR_LOPEN) {
        fr_lmachine_fault(machine, "no-number", place);
    }
    return word;
}

// One function because it is one loop over the code: the cases share its registers.
double fr_lmachine_run(FrLmachine *machine, uint32_t start) {
    const FrLcode *base = (const FrLcode *)(const void *)machine->system->code->data;
    double *variables = machine->variables;
    double stack[FR_LSTACK];
    double *top = stack;
    for (const FrLcode *code = base + start;; code++) {
        uint32_t place = (uint32_t)(code - base);
        switch ((FrLop)code->op) {
        case FR_LOP_END:
            return top > stack ? top[-1] : 0;
        case FR_LOP_CONST:
            *top++ = code->value;
            break;
        case FR_LOP_VAR:
            *top++ = variables[code->a];
            break;
        case FR_LOP_STORE:
            variables[code->a] = *--top;
            break;
        case FR_LOP_PUT:
            machine->out[code->a] = put(machine, *--top, place);
            break;
        case FR_LOP_VAR_MULTIPLY:
            top[-1] *= variables[code->a];
            break;
        case FR_LOP_CONST_MULTIPLY:
            top[-1] *= code->value;
            break;
        case FR_LOP_ADD:
            top--;
            top[-1] += *top;
            break;
        case FR_LOP_SUBTRACT:
            top--;
            top[-1] -= *top;
            break;
        case FR_LOP_MULTIPLY:
            top--;
            top[-1] *= *top;
            break;
        case FR_LOP_DIVIDE:
        case FR_LOP_MODULO:
        case FR_LOP_POWER:
        case FR_LOP_AND:
        case FR_LOP_OR:
        case FR_LOP_LESS:
        case FR_LOP_LESS_EQUAL:
        case FR_LOP_GREATER:
        case FR_LOP_GREATER_EQUAL:
        case FR_LOP_EQUAL:
        case FR_LOP_UNEQUAL:
            operate(machine, code, top--, place);
            break;
        case FR_LOP_NEGATE:
            top[-1] = -top[-1];
            break;
        case FR_LOP_NOT:
            top[-1] = top[-1] == 0;
            break;
        case FR_LOP_TRUTH:
            top[-1] = top[-1] != 0;
            break;
        case FR_LOP_DROP:
            top--;
            break;
        case FR_LOP_BACK:
            if (++machine->loops > machine->most_loops) {
                if (!machine->is_endless) {
                    machine->endless = (FrLfault){"limit-iterations", code->a, machine->module};
                }
                machine->is_endless = true;
                return 0;
            }
            code = base + code->a - 1;
            break;
        case FR_LOP_JUMP:
            code = base + code->a - 1;
            break;
        case FR_LOP_JUMP_ZERO:
            code = *--top == 0 ? base + code->a - 1 : code;
            break;
        case FR_LOP_JUMP_TRUE:
            code = (whole(top[-1]) & 0xFF) != 0 ? base + code->a - 1 : code;
            break;
        case FR_LOP_INDEX:
            top -= code->n;
            *top = variables[element(machine, code, top, place)];
            top++;
            break;
        case FR_LOP_INDEX_STORE:
            top -= code->n + 1;
            variables[element(machine, code, top, place)] = top[code->n];
            break;
        case FR_LOP_CALL:
            top -= code->n;
            *top = fr_lbuiltin_call(machine, code->a, top, code->n, place);
            top++;
            break;
        case FR_LOP_PRINT:
            top -= code->n;
            print(machine, code, top);
            *top++ = 0;
            break;
        case FR_LOP_SCAN_BEGIN:
            fr_lscan_begin(machine, *--top, code->a);
            break;
        case FR_LOP_SCAN_NEXT:
            top[-1] = fr_lscan_next(machine, top[-1]);
            break;
        case FR_LOP_SCAN_END:
            *top++ = fr_lscan_end(machine);
            break;
        case FR_LOP_USER:
            top -= code->n;
            *top = call_user(machine, code, top);
            top++;
            break;
        }
    }
}

// x → a·x + c, `count` times: powers of the map by squaring.
uint64_t fr_lrandom_skip(uint64_t state, uint64_t count) {
    uint64_t a = UINT64_C(0x5DEECE66D), c = 0xB;
    for (; count > 0; count >>= 1) {
        if (count & 1) {
            state = a * state + c;
        }
        c *= a + 1;
        a *= a;
    }
    return state & ((UINT64_C(1) << 48) - 1);
}
