// SPDX-License-Identifier: MIT
// What stands in the attributes of 3MF's elements: numbers, indices, colours, transforms.
#include <string.h>

#include "xml.h"
#include "import/builder/numbers.h"
#include "import/builder/text_lines.h"

const char *scene_3mf_local_name(const char *name)
{
    const char *colon = strrchr(name, ':');
    return colon == NULL ? name : colon + 1;
}

_Noreturn void scene_3mf_refuse(const struct scene_3mf_xml *xml, const char *problem)
{
    scene_import_fail(xml->file->import, "\"%s\", line %lu: %s", xml->file->parts[xml->part],
                      (unsigned long)XML_GetCurrentLineNumber(xml->parser), problem);
}

const char *scene_3mf_attribute(const char **attributes, const char *name)
{
    for (int i = 0; attributes[i] != NULL; i += 2) {
        if (strcmp(scene_3mf_local_name(attributes[i]), name) == 0) {
            return attributes[i + 1];
        }
    }
    return NULL;
}

bool scene_3mf_next_number(const char **text, double *value)
{
    while (**text == ' ' || **text == '\t' || **text == '\n' || **text == '\r') {
        ++*text;
    }
    size_t length = 0;
    if (!scene_word_number((struct scene_word){*text, strcspn(*text, " \t\n\r")}, value, &length)) {
        return false;
    }
    *text += length;
    return true;
}

float scene_3mf_number(const struct scene_3mf_xml *xml, const char **attributes, const char *name,
                       float otherwise)
{
    const char *text = scene_3mf_attribute(attributes, name);
    double value = (double)otherwise;
    if (text != NULL && !scene_3mf_next_number(&text, &value)) {
        scene_3mf_refuse(xml, "an attribute is not a number");
    }
    return (float)value;
}

uint32_t scene_3mf_index(const struct scene_3mf_xml *xml, const char **attributes, const char *name,
                         uint32_t otherwise)
{
    const char *text = scene_3mf_attribute(attributes, name);
    if (text == NULL) {
        return otherwise;
    }
    uint64_t value = 0;
    const char *digit = text;
    for (; *digit >= '0' && *digit <= '9' && value <= INT32_MAX; digit++) {
        value = value * 10 + (uint64_t)(*digit - '0');
    }
    if (digit == text || value > INT32_MAX) {
        scene_3mf_refuse(xml, "an id or index is not a whole number from 0 to 2147483647");
    }
    return (uint32_t)value;
}

const char *scene_3mf_string(const struct scene_3mf_xml *xml, const char **attributes, const char *name,
                             const char *otherwise)
{
    const char *text = scene_3mf_attribute(attributes, name);
    return text == NULL ? otherwise : scene_import_string(xml->file->import, text, strlen(text));
}

void scene_3mf_list(struct scene_3mf_xml *xml, const char *text, size_t *first, size_t *count)
{
    struct scene_3mf *file = xml->file;
    double value;
    *first = file->list_count;
    while (text != NULL && scene_3mf_next_number(&text, &value)) {
        scene_import_reserve(xml->file->import, &file->lists, &file->list_capacity, file->list_count + 1,
                             sizeof *file->lists);
        file->lists[file->list_count++] = value;
    }
    *count = file->list_count - *first;
}

bool scene_3mf_color(const char *text, float color[4])
{
    unsigned bytes[4] = {0, 0, 0, 255};
    const size_t digits = text == NULL || *text != '#' ? 0 : strspn(text + 1, "0123456789abcdefABCDEF");
    if (digits < 6) {
        return false;
    }
    for (size_t i = 0; i < digits / 2 && i < 4; i++) {
        const char *digit = text + 1 + 2 * i;
        bytes[i] = 0;
        for (int k = 0; k < 2; k++) {
            const unsigned value =
                digit[k] <= '9' ? (unsigned)(digit[k] - '0') : (unsigned)((digit[k] | 32) - 'a') + 10;
            bytes[i] = bytes[i] * 16 + value;
        }
    }
    for (int c = 0; c < 3; c++) {
        color[c] = scene_import_from_srgb((float)bytes[c] / 255);
    }
    color[3] = (float)bytes[3] / 255;
    return true;
}

// Read four columns of three numbers. The format multiplies a point from the left, so its rows are the model's columns
// (Core, 3.3).
struct scene_import_place scene_3mf_transform(const struct scene_3mf_xml *xml, const char **attributes)
{
    const char *text = scene_3mf_attribute(attributes, "transform");
    struct scene_import_place place = scene_import_place_identity();
    for (int i = 0; i < 12 && text != NULL; i++) {
        const int at = i / 3 * 4 + i % 3;
        if (!scene_3mf_next_number(&text, &place.exact[at])) {
            scene_3mf_refuse(xml, "a transform needs 12 numbers");
        }
        place.world[at] = (float)place.exact[at];
    }
    return place;
}

uint32_t scene_3mf_part(struct scene_3mf *file, const char *name)
{
    enum { MOST = 1 << 16 };
    name += *name == '/';
    for (size_t i = file->part_count; i > 0; i--) {
        if (strcasecmp(file->parts[i - 1], name) == 0) {
            return (uint32_t)i - 1;
        }
    }
    if (file->part_count == MOST) {
        scene_import_fail(file->import, "has more than %d parts", MOST);
    }
    scene_import_reserve(file->import, &file->parts, &file->part_capacity, file->part_count + 1,
                         sizeof *file->parts);
    file->parts[file->part_count] = scene_import_string(file->import, name, strlen(name));
    return (uint32_t)file->part_count++;
}
