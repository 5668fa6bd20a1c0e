// SPDX-License-Identifier: MIT
#include "data_uri.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

static int base64_digit(int c)
{
    return c >= 'A' && c <= 'Z'   ? c - 'A'
           : c >= 'a' && c <= 'z' ? c - 'a' + 26
           : c >= '0' && c <= '9' ? c - '0' + 52
           : c == '+' || c == '-' ? 62
           : c == '/' || c == '_' ? 63
                                  : -1;
}

bool scene_data_uri_is(const char *name)
{
    return strncasecmp(name, "data:", 5) == 0;
}

// Take the next character of a URI, which may be encoded by a percent sign and two digits.
static int take_character(const char **at)
{
    const char *const digits = "0123456789abcdef";
    const char *const start = *at;
    const char *const high = start[0] == '%' && start[1] != 0 ? strchr(digits, start[1] | 0x20) : NULL;
    const char *const low = high != NULL && start[2] != 0 ? strchr(digits, start[2] | 0x20) : NULL;
    *at += low != NULL ? 3 : 1;
    return low != NULL ? (int)((high - digits) * 16 + (low - digits)) : (unsigned char)start[0];
}

static bool is_blank(int c)
{
    return c == ' ' || (c >= '\t' && c <= '\r');
}

unsigned char *scene_data_uri_decode(struct scene_import *import, const char *uri, size_t *size)
{
    const char *const comma = strchr(uri, ',');
    if (comma == NULL || comma - uri < 7 || strncasecmp(comma - 7, ";base64", 7) != 0) {
        return NULL;
    }
    unsigned char *const bytes = scene_import_allocate(import, strlen(comma) / 4 * 3 + 3, 1);
    uint32_t bits = 0;
    int held = 0;
    *size = 0;
    for (const char *at = comma + 1; *at != 0 && *at != '?' && *at != '#';) {
        const int c = take_character(&at), digit = base64_digit(c);
        if (c == '=') {
            break;
        }
        if (digit < 0 && !is_blank(c)) {
            free(bytes);
            return NULL;
        }
        if (digit < 0) {
            continue;
        }
        bits = bits << 6 | (uint32_t)digit;
        held += 6;
        if (held >= 8) {
            held -= 8;
            bytes[(*size)++] = (unsigned char)(bits >> held);
        }
    }
    return bytes;
}
