// SPDX-License-Identifier: MIT
// What picture_host.c is for lessons that are seen, without libspng and without files: a picture becomes a line with its
// name and FNV-1a of its RGBA8 pixels. The environment says what contexts there are: OUTSIDE_THREADS is a number,
// OUTSIDE_ISA the name of the highest instruction set, and OUTSIDE_VALIDATE is "on" or "off".
#include "picture.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static enum rhw_isa_limit find_isa(const char *name)
{
    int isa = 0;
    while (isa < RHW_ISA_COUNT && strcmp(name, rhw_isa_name((enum rhw_isa)isa)) != 0) {
        isa++;
    }
    must(isa < RHW_ISA_COUNT ? RHW_OK : RHW_ERROR_MISUSE, name);
    return rhw_isa_up_to((enum rhw_isa)isa);
}

rhw_context *picture_context(void)
{
    struct rhw_context_def def = rhw_context_def_default();
    const char *const threads = getenv("OUTSIDE_THREADS"), *const isa = getenv("OUTSIDE_ISA"),
                      *const validate = getenv("OUTSIDE_VALIDATE");
    if (threads) {
        def.threads = atoi(threads);
    }
    if (isa) {
        def.isa_limit = find_isa(isa);
    }
    if (validate) {
        def.validate = strcmp(validate, "on") == 0 ? RHW_VALIDATE_ON : RHW_VALIDATE_OFF;
    }
    rhw_context *context = NULL;
    must(rhw_context_create(&def, &context), "context");
    return context;
}

void picture_write_png(const char *directory, const char *name, int width, int height, const uint8_t *rgba)
{
    (void)directory;
    uint64_t hash = 14695981039346656037u;
    for (size_t i = 0; i < (size_t)width * (size_t)height * 4; i++) {
        hash = (hash ^ rgba[i]) * 1099511628211u;
    }
    printf("%s %016" PRIx64 "\n", name, hash);
}

void picture_write_ppm(const char *directory, const char *name, int width, int height, const uint8_t *rgba)
{
    picture_write_png(directory, name, width, height, rgba);
}
