// SPDX-License-Identifier: MIT
// From words to what rhw render understands by them; and memory for JavaScript.
#include "web_module.h"

#include <emscripten.h>
#include <stdlib.h>
#include <string.h>

#include "message.h"

bool web_job_parse(struct cli_render_job *job, char *words, size_t size)
{
    enum { WORDS = 128 };
    // The picture goes nowhere; any format that holds every output will do.
    static char verb[] = "render", out[] = "--out=-", format[] = "--format=exr";
    static char *argv[WORDS + 4]; // the job points to its operands
    int argc = 0, status;
    argv[argc++] = verb;
    argv[argc++] = out;
    argv[argc++] = format;
    for (char *word = words; word < words + size; word += strlen(word) + 1) {
        if (argc == WORDS + 3) {
            cli_error("render", "has more than %d options", WORDS);
            return false;
        }
        argv[argc++] = word;
    }
    argv[argc] = NULL;
    return cli_render_job_parse(job, NULL, argc, argv, &status);
}

EMSCRIPTEN_KEEPALIVE void *web_allocate(size_t size)
{
    enum { ALIGNMENT = 64 };
    return aligned_alloc(ALIGNMENT, (size + ALIGNMENT) / ALIGNMENT * ALIGNMENT);
}

EMSCRIPTEN_KEEPALIVE void web_free(void *memory)
{
    free(memory);
}
