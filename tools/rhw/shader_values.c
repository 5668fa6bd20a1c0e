// SPDX-License-Identifier: MIT
// See shader_values.h.
#include "shader_values.h"

#include "shader_job.h"

#include <errno.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#define MOST_BYTES ((size_t)1 << 30)

static const char *const type_names[] = {"f32", "i32", "u32"};
enum type { FLOAT, INT, UINT };

// Read one number at *text, and go behind it.
static bool read_number(const char **text, enum type type, uint32_t *bits)
{
    char *end;
    errno = 0;
    if (type == FLOAT) {
        const float number = strtof(*text, &end);
        memcpy(bits, &number, sizeof number);
    } else {
        const long long number = strtoll(*text, &end, 0);
        const long long least = type == INT ? INT32_MIN : 0, most = type == INT ? INT32_MAX : UINT32_MAX;
        if (errno != 0 || number < least || number > most) {
            return false;
        }
        *bits = (uint32_t)number;
    }
    const bool is_read = end != *text && (*end == ',' || *end == 0);
    *text = end;
    return is_read;
}

static bool read_numbers(const char *option, const char *argument, const char *text, enum type type,
                         void **bytes, size_t *size)
{
    size_t count = 1;
    for (const char *c = text; *c; c++) {
        count += *c == ',';
    }
    uint32_t *const numbers = calloc(count, sizeof *numbers);
    for (size_t i = 0; numbers && i < count; i++) {
        if (!read_number(&text, type, &numbers[i])) {
            cli_error(option, "'%s': number %zu is no %s", argument, i + 1, type_names[type]);
            free(numbers);
            return false;
        }
        text += *text == ',';
    }
    if (!numbers) {
        cli_error(option, "out of memory");
    }
    *bytes = numbers;
    *size = count * sizeof *numbers;
    return numbers != NULL;
}

static bool make_zeros(const char *option, const char *argument, const char *text, void **bytes, size_t *size)
{
    const unsigned long long number = strlen(text) < 12 ? strtoull(text, NULL, 10) : 0;
    if (number < 1 || number > MOST_BYTES) {
        cli_error(option, "'%s': a buffer has 1 to %zu bytes", argument, MOST_BYTES);
        return false;
    }
    *size = (size_t)number;
    *bytes = calloc(1, *size);
    if (!*bytes) {
        cli_error(option, "'%s': out of memory", argument);
    }
    return *bytes != NULL;
}

bool cli_shader_values_read(const char *option, const char *argument, const char *value, void **bytes,
                            size_t *size)
{
    for (int type = 0; type < 3; type++) {
        if (strncmp(value, type_names[type], 3) == 0 && value[3] == ':') {
            return read_numbers(option, argument, value + 4, (enum type)type, bytes, size);
        }
    }
    if (strspn(value, "0123456789") == strlen(value)) {
        return make_zeros(option, argument, value, bytes, size);
    }
    *bytes = cli_shader_read(value, MOST_BYTES, size);
    return *bytes != NULL;
}

void cli_shader_values_print_float(uint32_t bits)
{
    char text[32];
    float number;
    memcpy(&number, &bits, sizeof number);
    for (int digits = 6; digits <= 9; digits++) {
        snprintf(text, sizeof text, "%.*g", digits, (double)number);
        if (strtof(text, NULL) == number) {
            break;
        }
    }
    fputs(text, stdout);
}

// Find the type of a name. Return false if there is none.
static bool find_type(const char *name, enum type *type)
{
    for (*type = FLOAT; *type <= UINT; ++*type) {
        if (strcmp(name, type_names[*type]) == 0) {
            return true;
        }
    }
    return false;
}

bool cli_shader_values_are(const char *type)
{
    enum type kind;
    return find_type(type, &kind);
}

bool cli_shader_values_print(const char *type, const void *bytes, size_t size)
{
    enum type kind;
    if (!find_type(type, &kind)) {
        return false;
    }
    for (size_t i = 0; i < size / sizeof(uint32_t); i++) {
        uint32_t bits;
        memcpy(&bits, (const char *)bytes + 4 * i, sizeof bits);
        fputs(i > 0 ? "," : "", stdout);
        if (kind == FLOAT) {
            cli_shader_values_print_float(bits);
        } else if (kind == INT) {
            printf("%" PRId32, (int32_t)bits);
        } else {
            printf("%" PRIu32, bits);
        }
    }
    putchar('\n');
    return true;
}
