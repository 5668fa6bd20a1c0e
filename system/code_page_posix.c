// SPDX-License-Identifier: MIT
// See code_page.h.
#include "code_page.h"

#include <iconv.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// Set the name that iconv has for a code page.
static void name_page(int page, char name[32])
{
    static const struct {
        int page;
        const char *name;
    } names[] = {
        {SYSTEM_CODE_PAGE_UTF8, "UTF-8"},
        {10000, "MACINTOSH"},
        {10007, "MAC-CYRILLIC"},
        {20866, "KOI8-R"},
        {28592, "ISO-8859-2"},
        {28595, "ISO-8859-5"},
        {28605, "ISO-8859-15"},
        {51932, "EUC-JP"},
        {54936, "GB18030"},
    };
    snprintf(name, 32, "CP%d", page);
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        if (names[i].page == page) {
            snprintf(name, 32, "%s", names[i].name);
        }
    }
}

char *system_code_page_convert(int from, int to, const char *text)
{
    enum { MOST = 4 }; // bytes that a byte becomes: three in UTF-8, from a code page of single bytes
    char old_name[32], new_name[32];
    name_page(from, old_name);
    name_page(to, new_name);
    const iconv_t conversion = iconv_open(new_name, old_name);
    if (conversion == (iconv_t)-1) {
        return NULL;
    }
    size_t left = strlen(text), room = MOST * left;
    char *const converted = malloc(room + 1);
    char *in = (char *)(uintptr_t)text, *out = converted; // iconv does not write to what it reads
    // The number of characters that became others instead is no success. Some conversions keep a letter that a mark may
    // follow until they are told that it was the last.
    if (converted != NULL && iconv(conversion, &in, &left, &out, &room) == 0 &&
        iconv(conversion, NULL, NULL, &out, &room) == 0) {
        *out = 0;
        iconv_close(conversion);
        return converted;
    }
    free(converted);
    iconv_close(conversion);
    return NULL;
}
