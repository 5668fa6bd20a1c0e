// SPDX-License-Identifier: MIT
// The colours of filaments, which slicers keep beside the model: PrusaSlicer and SuperSlicer in lines of text, Bambu
// Studio and OrcaSlicer in JSON.
#include <jansson.h>
#include <stdlib.h>
#include <string.h>

#include "import/builder/text_lines.h"
#include "threemf.h"
#include "xml.h"
#include "import/builder/zip.h"

enum { MOST_FILAMENTS = 1024 };

void scene_3mf_set_filament(struct scene_3mf *file, uint32_t filament, const char *text)
{
    float color[4];
    if (filament == 0 || filament > MOST_FILAMENTS || !scene_3mf_color(text, color)) {
        return;
    }
    scene_import_reserve(file->import, &file->filaments, &file->filament_capacity, filament,
                         sizeof *file->filaments);
    for (; file->filament_count < filament; file->filament_count++) {
        file->filaments[file->filament_count][3] = -1;
    }
    memcpy(file->filaments[filament - 1], color, sizeof color);
}

// Read colours between semicolons, each perhaps in quotation marks. Some may be empty.
static void read_colors(struct scene_3mf *file, const char *text)
{
    static const char separators[] = ";,";
    for (uint32_t filament = 1; *text != 0 && filament <= MOST_FILAMENTS; filament++) {
        scene_3mf_set_filament(file, filament, text + strspn(text, " \t\""));
        text += strcspn(text, separators);
        text += *text != 0;
    }
}

// Read lines of the form "; key = value". The colour that was chosen for an extruder goes before that of its filament.
static void read_lines(struct scene_3mf *file, char *bytes, size_t size)
{
    static const char *const keys[] = {"filament_colour", "extruder_colour"};
    for (size_t i = 0; i < sizeof keys / sizeof keys[0]; i++) {
        struct scene_text text = scene_text_open(file->import, bytes, size);
        struct scene_line line;
        while (scene_text_line(&text, false, &line)) {
            struct scene_word word;
            bool is_there = scene_text_word(&line, &word);
            if (is_there && scene_word_is(word, ";")) {
                is_there = scene_text_word(&line, &word);
            }
            struct scene_word equals;
            if (is_there && scene_word_is(word, keys[i]) && scene_text_word(&line, &equals) &&
                scene_word_is(equals, "=")) {
                read_colors(file, scene_word_string(file->import, scene_text_rest(line)));
            }
        }
    }
}

static void read_json(struct scene_3mf *file, const char *name, const char *bytes, size_t size)
{
    json_error_t error;
    json_t *root = json_loadb(bytes, size, JSON_ALLOW_NUL, &error);
    if (root == NULL) {
        scene_import_warn(file->import, "\"%s\" in the archive is not valid JSON: its colours are left out",
                          name);
        return;
    }
    const json_t *colors = json_object_get(root, "filament_colour");
    size_t i;
    json_t *value;
    json_array_foreach(colors, i, value)
    {
        if (i < MOST_FILAMENTS) {
            scene_3mf_set_filament(file, (uint32_t)i + 1, json_string_value(value));
        }
    }
    if (json_is_string(colors)) {
        read_colors(file, json_string_value(colors));
    }
    json_decref(root);
}

void scene_3mf_read_filaments(struct scene_3mf *file)
{
    static const char *const names[] = {"Metadata/Slic3r_PE.config", "Metadata/SuperSlicer.config",
                                        "Metadata/project_settings.config"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        size_t size;
        char *bytes = scene_zip_read_all(file->zip, names[i], &size);
        if (bytes == NULL) {
            continue;
        }
        if (bytes[strspn(bytes, " \t\r\n")] == '{') {
            read_json(file, names[i], bytes, size);
        } else {
            read_lines(file, bytes, size);
        }
        free(bytes);
    }
}

struct scene_3mf_paint scene_3mf_filament_paint(struct scene_3mf *file, uint32_t filament)
{
    struct scene_3mf_paint paint = scene_3mf_find_paint(file, NULL, 0);
    if (filament == 0) {
        return paint;
    }
    if (filament <= file->filament_count && file->filaments[filament - 1][3] >= 0) {
        memcpy(paint.color, file->filaments[filament - 1], sizeof paint.color);
        paint.described = true;
    } else if (filament > 1 || file->filament_count > 0 || file->painting_count > 0) {
        // The only filament of a file without colours means nothing.
        scene_import_warn(file->import, "names no colour of filament %u: drawn in grey", filament);
    }
    return paint;
}
