// SPDX-License-Identifier: MIT
// See code_page.h.
#include "code_page.h"

#include <iconv.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static iconv_t open_conversion(int from, int to)
{
    char names[2][32];
    const int pages[2] = {to, from};
    for (int i = 0; i < 2; i++) {
        if (pages[i] == SYSTEM_CODE_PAGE_UTF8) {
            strcpy(names[i], "UTF-8");
        } else {
            snprintf(names[i], sizeof names[i], "CP%d", pages[i]);
        }
    }
    return iconv_open(names[0], names[1]);
}

char *system_code_page_convert(int from, int to, const char *text)
{
    enum { MOST = 4 }; // bytes that a byte becomes: three in UTF-8, from a code page of single bytes
    const iconv_t conversion = open_conversion(from, to);
    if (conversion == (iconv_t)-1) {
        return NULL;
    }
    size_t left = strlen(text), room = MOST * left;
    char *const converted = malloc(room + 1);
    char *in = (char *)(uintptr_t)text, *out = converted; // iconv does not write to what it reads
    // The number of characters that became others instead is no success.
    if (converted != NULL && iconv(conversion, &in, &left, &out, &room) == 0) {
        *out = 0;
        iconv_close(conversion);
        return converted;
    }
    free(converted);
    iconv_close(conversion);
    return NULL;
}
