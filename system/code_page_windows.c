// SPDX-License-Identifier: MIT
// See code_page.h. Windows converts by way of UTF-16.
#include "code_page.h"

#include <stdlib.h>
#include <windows.h>

static wchar_t *widen(int from, const char *text)
{
    const int length = MultiByteToWideChar((UINT)from, MB_ERR_INVALID_CHARS, text, -1, NULL, 0);
    wchar_t *const wide = length > 0 ? malloc((size_t)length * sizeof *wide) : NULL;
    if (wide != NULL && MultiByteToWideChar((UINT)from, MB_ERR_INVALID_CHARS, text, -1, wide, length) == 0) {
        free(wide);
        return NULL;
    }
    return wide;
}

char *system_code_page_convert(int from, int to, const char *text)
{
    wchar_t *const wide = widen(from, text);
    if (wide == NULL) {
        return NULL;
    }
    // UTF-8 has every character, and takes no place for one that has to tell of another.
    BOOL changed = FALSE;
    BOOL *const tells = to == SYSTEM_CODE_PAGE_UTF8 ? NULL : &changed;
    const int length = WideCharToMultiByte((UINT)to, 0, wide, -1, NULL, 0, NULL, NULL);
    char *converted = length > 0 ? malloc((size_t)length) : NULL;
    if (converted != NULL &&
        (WideCharToMultiByte((UINT)to, 0, wide, -1, converted, length, NULL, tells) == 0 || changed)) {
        free(converted);
        converted = NULL;
    }
    free(wide);
    return converted;
}
