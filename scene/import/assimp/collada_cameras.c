// SPDX-License-Identifier: MIT
// Cameras of Collada, written anew for assimp. assimp 5.2.5 drops the lens of a camera without a name, takes a lens of
// one angle for one of hardly any, knows no orthographic cameras, and leaves planes in the unit of the document while
// it brings all else to metres.
#include "assimp.h"
#include "collada_far.h"
#include "collada_markup.h"
#include "draw/camera/camera_math.h"
#include "edits.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double degree = 3.14159265358979324 / 180, usual_aspect = 4.0 / 3.0;

enum number { XFOV, YFOV, XMAG, YMAG, ASPECT, NEAR, FAR, NUMBERS };

struct lens {
    bool is_orthographic;
    double numbers[NUMBERS]; // 0 where the document has none
};

// Read the number of the element whose start tag is at `tag`, if it is one of a lens.
static void read_number(struct lens *lens, char *tag, char *close, const char *end)
{
    static const char *const names[NUMBERS] = {"xfov",         "yfov",  "xmag", "ymag",
                                               "aspect_ratio", "znear", "zfar"};
    for (int i = 0; i < NUMBERS; i++) {
        const char *text = close + 1;
        double number;
        if (scene_collada_is_tag(tag, names[i]) && close[-1] != '/' &&
            scene_collada_numbers(&text, end, &number, NULL, 1) == 1 && number > 0 && number < 1e30) {
            lens->numbers[i] = number;
        }
    }
}

// Read the lens of the camera whose start tag ends at `close`, of all profiles the common one. Return the > at the end
// of the camera. Return NULL if it has none.
static char *read_lens(char *close, const char *end, struct lens *lens)
{
    bool is_common = false;
    for (char *c = strchr(close, '<'); c != NULL; c = strchr(c, '<')) {
        char *const last = scene_collada_markup_end(c, end);
        if (last == NULL || scene_collada_is_end(c, "camera")) {
            return last;
        }
        const bool ends_common = scene_collada_is_end(c, "technique_common");
        is_common = (is_common && !ends_common) || scene_collada_is_tag(c, "technique_common");
        if (is_common) {
            lens->is_orthographic = lens->is_orthographic || scene_collada_is_tag(c, "orthographic");
            read_number(lens, c, last, end);
        }
        c = last;
    }
    return NULL;
}

static double half_tangent(double degrees)
{
    return scene_tangent_of_half(degrees * degree);
}

// Complete the width of a lens, and its aspect as far as the document has it, which angles and sizes of both directions
// say, too. An aspect of 0 is not known, and a width of 0 is no lens.
static void complete(struct lens *lens)
{
    double *const n = lens->numbers;
    const double wide = lens->is_orthographic ? n[XMAG] : n[XFOV] > 0 ? half_tangent(n[XFOV]) : 0;
    const double high = lens->is_orthographic ? n[YMAG] : n[YFOV] > 0 ? half_tangent(n[YFOV]) : 0;
    const double aspect = wide > 0 && high > 0 ? wide / high : n[ASPECT];
    const double width = wide > 0 ? wide : high * (aspect > 0 ? aspect : usual_aspect);
    if (lens->is_orthographic) {
        n[XMAG] = width;
    } else if (n[XFOV] <= 0) {
        n[XFOV] = 2 * scene_atan(width) / degree;
    }
    n[ASPECT] = aspect > 0 ? aspect : 0;
}

// Write a camera as assimp reads it. An orthographic one has its width for an angle and an aspect below 0.
static void write_camera(const struct lens *lens, struct scene_collada_value id, double unit, char *text,
                         size_t size)
{
    const double *const n = lens->numbers;
    const double aspect = n[ASPECT] > 0 || !lens->is_orthographic ? n[ASPECT] : usual_aspect;
    char wide[32], ratio[32], near[32], far[32];
    scene_assimp_write_number(wide, lens->is_orthographic ? n[XMAG] * unit : n[XFOV]);
    scene_assimp_write_number(ratio, lens->is_orthographic ? -aspect : aspect);
    scene_assimp_write_number(near, n[NEAR] * unit);
    scene_assimp_write_number(far, n[FAR] * unit);
    snprintf(
        text, size,
        "<camera id=\"%.*s\" name=\"%.*s\"><optics><technique_common><perspective><xfov>%s</xfov>"
        "<aspect_ratio>%s</aspect_ratio><znear>%s</znear><zfar>%s</zfar></perspective></technique_common>"
        "</optics></camera>",
        (int)id.length, id.text, (int)id.length, id.text, wide, ratio, near, far);
}

char *scene_assimp_write_cameras(struct scene_import *import, char *text, size_t *size)
{
    enum { MOST = 1024 }; // bytes of a name
    struct scene_edits edits = {0};
    const char *const end = text + *size;
    const double unit = scene_collada_unit(text, end);
    char *last;
    for (char *c = strchr(text, '<'); c != NULL; c = strchr(last, '<')) {
        char *const close = last = scene_collada_markup_end(c, end);
        const bool is_camera = close != NULL && scene_collada_is_tag(c, "camera") && close[-1] != '/';
        struct lens lens = {.is_orthographic = false};
        if (is_camera) {
            last = read_lens(close, end, &lens);
        }
        if (last == NULL) {
            break;
        }
        const struct scene_collada_value id =
            is_camera ? scene_collada_attribute(c, close, "id") : (struct scene_collada_value){0};
        if (id.length == 0 || id.length > MOST || memchr(id.text, '"', id.length) != NULL) {
            continue;
        }
        complete(&lens);
        char camera[2 * MOST + 512];
        write_camera(&lens, id, unit > 0 ? unit : 1, camera, sizeof camera);
        scene_edits_add_string(import, &edits, (size_t)(c - text), (size_t)(last + 1 - c), camera);
    }
    return scene_edits_replace(import, &edits, text, size);
}
