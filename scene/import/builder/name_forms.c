// SPDX-License-Identifier: MIT
// Nothing is guessed here: every form is tried, and the file that is there decides.
#include "name_forms.h"

#include <stdlib.h>
#include <string.h>

#include "accents.h"
#include "code_page.h"
#include "confine.h"

static char *copy(struct scene_import *import, const char *text, size_t length)
{
    char *const copied = scene_import_allocate(import, length + 1, 1);
    memcpy(copied, text, length);
    return copied;
}

// Add a name, which the forms own from then on.
static void add(struct scene_import *import, struct scene_name_forms *forms, char *name)
{
    if (import->confine != NULL) {
        scene_import_drop_detours(name);
    }
    bool known = name[0] == 0;
    for (size_t i = 0; i < forms->count && !known; i++) {
        known = strcmp(forms->names[i], name) == 0;
    }
    if (known) {
        free(name);
        return;
    }
    scene_import_reserve(import, &forms->names, &forms->capacity, forms->count + 1, sizeof *forms->names);
    forms->names[forms->count++] = name;
}

static int hex_digit(char c)
{
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                  : -1;
}

char *scene_name_decode_percent(char *text)
{
    char *out = text;
    for (const char *in = text; *in != 0; out++) {
        const int high = in[0] == '%' ? hex_digit(in[1]) : -1, low = high >= 0 ? hex_digit(in[2]) : -1;
        const bool is_coded = low >= 0 && high + low > 0; // "%00" would end the name
        *out = is_coded ? (char)(high * 16 + low) : *in;
        in += is_coded ? 3 : 1;
    }
    *out = 0;
    return text;
}

// Add a name as it is, decoded, and cut before what follows the path of a URI.
static void add_uris(struct scene_import *import, struct scene_name_forms *forms, const char *name,
                     size_t length)
{
    char *const whole = copy(import, name, length);
    const size_t query = strcspn(whole, "?"), fragment = strcspn(whole, "#");
    add(import, forms, scene_name_decode_percent(copy(import, name, length)));
    add(import, forms, scene_name_decode_percent(copy(import, name, query)));
    add(import, forms, scene_name_decode_percent(copy(import, name, fragment < query ? fragment : query)));
    free(whole);
}

void scene_name_forms_add(struct scene_import *import, struct scene_name_forms *forms, const char *name)
{
    const size_t before = forms->count, length = strlen(name);
    const bool quoted = length > 2 && (name[0] == '"' || name[0] == '\'') && name[length - 1] == name[0];
    add(import, forms, copy(import, name, length));
    add_uris(import, forms, name, length);
    if (quoted) {
        add(import, forms, copy(import, name + 1, length - 2));
        add_uris(import, forms, name + 1, length - 2);
    }
    const size_t spelled = forms->count;
    for (size_t i = before; i < spelled; i++) {
        char *const turned = copy(import, forms->names[i], strlen(forms->names[i]));
        for (char *c = turned; *c != 0; c++) {
            *c = *c == '\\' ? '/' : *c;
        }
        add(import, forms, turned);
    }
}

// Add the forms of a name after its conversion. Return what it is converted to, to be freed. Return NULL if it cannot
// be.
static char *add_converted(struct scene_import *import, struct scene_name_forms *forms, const char *name,
                           int from, int to)
{
    char *const converted = system_code_page_convert(from, to, name);
    if (converted != NULL) {
        scene_name_forms_add(import, forms, converted);
    }
    return converted;
}

void scene_name_forms_add_code_pages(struct scene_import *import, struct scene_name_forms *forms,
                                     const char *name)
{
    static const int pages[] = {936,  932,  949, 950, 1252, 1251,  1250,  1253,  1254,  1255,  1256,
                                1257, 1258, 874, 437, 850,  852,   866,   20866, 10000, 10007, 855,
                                857,  862,  737, 775, 1361, 28592, 28595, 28605, 51932, 54936};
    // Code pages that programs take the names in an archive for.
    static const int unpacked[] = {437, 850, 1252};
    const size_t page_count = sizeof pages / sizeof pages[0];
    for (size_t i = 0; i < page_count; i++) {
        free(add_converted(import, forms, name, pages[i], SYSTEM_CODE_PAGE_UTF8));
    }
    for (size_t i = 0; i < page_count; i++) {
        char *const narrow = add_converted(import, forms, name, SYSTEM_CODE_PAGE_UTF8, pages[i]);
        for (size_t k = 0; narrow != NULL && k < sizeof unpacked / sizeof unpacked[0]; k++) {
            free(add_converted(import, forms, narrow, unpacked[k], SYSTEM_CODE_PAGE_UTF8));
        }
        free(narrow);
    }
}

void scene_name_forms_add_accents(struct scene_import *import, struct scene_name_forms *forms,
                                  const char *name)
{
    char *const other[] = {scene_accents_join(import, name), scene_accents_part(import, name)};
    for (size_t i = 0; i < sizeof other / sizeof other[0]; i++) {
        if (other[i] != NULL) {
            scene_name_forms_add(import, forms, other[i]);
        }
        free(other[i]);
    }
}

void scene_name_forms_free(struct scene_name_forms *forms)
{
    for (size_t i = 0; i < forms->count; i++) {
        free(forms->names[i]);
    }
    free(forms->names);
}
