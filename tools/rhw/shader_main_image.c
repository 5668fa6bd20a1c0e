// SPDX-License-Identifier: MIT
// See shader_main_image.h.
#include "shader_main_image.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const struct {
    const char *type, *name, *elements;
} uniforms[] = {
    {"vec3", "iResolution", ""},
    {"float", "iTime", ""},
    {"float", "iTimeDelta", ""},
    {"int", "iFrame", ""},
    {"float", "iFrameRate", ""},
    {"vec4", "iMouse", ""},
    {"vec4", "iDate", ""},
    {"float", "iSampleRate", ""},
    {"float", "iChannelTime", "[4]"},
    {"vec3", "iChannelResolution", "[4]"},
    {"sampler2D", "iChannel0", ""},
    {"sampler2D", "iChannel1", ""},
    {"sampler2D", "iChannel2", ""},
    {"sampler2D", "iChannel3", ""},
};
enum { UNIFORMS = sizeof uniforms / sizeof *uniforms };

static const char main_function[] =
    "\nlayout(location = 0) out vec4 rhw_color;\n"
    "void main() { mainImage(rhw_color, vec2(gl_FragCoord.x, iResolution.y - gl_FragCoord.y)); }\n";

// What a text has.
struct names {
    bool has_main, has_main_image;
    bool is_declared[UNIFORMS];
};

static const char letters[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789";

// Go behind white space and comments.
static const char *skip(const char *text)
{
    for (;;) {
        text += strspn(text, " \t\r\n");
        if (text[0] == '/' && text[1] == '/') {
            text += strcspn(text, "\n");
        } else if (text[0] == '/' && text[1] == '*') {
            const char *const end = strstr(text + 2, "*/");
            text = end ? end + 2 : text + strlen(text);
        } else {
            return text;
        }
    }
}

static bool is(const char *word, size_t length, const char *name)
{
    return strlen(name) == length && memcmp(word, name, length) == 0;
}

static struct names find_names(const char *text)
{
    struct names names = {0};
    bool declares = false; // between `uniform` and the end of its declaration
    while (*(text = skip(text))) {
        const char *const word = text;
        const size_t length = strspn(word, letters);
        text += length > 0 ? length : 1;
        declares = length == 0 ? declares && *word != ';' : declares || is(word, length, "uniform");
        const bool is_called = *skip(text) == '(';
        names.has_main = names.has_main || (is_called && is(word, length, "main"));
        names.has_main_image = names.has_main_image || (is_called && is(word, length, "mainImage"));
        for (int i = 0; i < UNIFORMS && declares; i++) {
            names.is_declared[i] = names.is_declared[i] || is(word, length, uniforms[i].name);
        }
    }
    return names;
}

bool cli_shader_main_image(const char *text, size_t size, struct cli_shader_main_image *made)
{
    *made = (struct cli_shader_main_image){0};
    const struct names names = find_names(text);
    if (names.has_main || !names.has_main_image) {
        return true;
    }
    size_t length = 0;
    for (int i = 0; i < UNIFORMS; i++) {
        if (!names.is_declared[i]) {
            length +=
                (size_t)snprintf(made->before + length, sizeof made->before - length, "uniform %s %s%s; ",
                                 uniforms[i].type, uniforms[i].name, uniforms[i].elements);
        }
    }
    made->text = malloc(size + sizeof main_function);
    if (made->text) {
        memcpy(made->text, text, size);
        memcpy(made->text + size, main_function, sizeof main_function);
        made->size = size + sizeof main_function - 1;
    }
    return made->text != NULL;
}
