// SPDX-License-Identifier: MIT
// What assimp leaves out of 3DS, LightWave and Blitz3D without a word. These are made of chunks, each of which says
// what it is and how long, so that marks are found without reading what lies between.
#include "assimp.h"

#include <string.h>

// Bytes that are read from their beginning on. What is not there reads as 0.
struct bytes {
    const unsigned char *at, *end;
};

static size_t left(const struct bytes *bytes)
{
    return (size_t)(bytes->end - bytes->at);
}

static struct bytes skip(struct bytes bytes, size_t count)
{
    bytes.at += count < left(&bytes) ? count : left(&bytes);
    return bytes;
}

// Return what is behind a text that a 0 ends. With `is_even`, a text of odd length has another 0.
static struct bytes skip_text(struct bytes bytes, bool is_even)
{
    const unsigned char *const zero = memchr(bytes.at, 0, left(&bytes));
    const size_t length = zero == NULL ? left(&bytes) : (size_t)(zero - bytes.at) + 1;
    return skip(bytes, length + (is_even ? length % 2 : 0));
}

static uint32_t read_little(const struct bytes *bytes, size_t place, size_t count)
{
    uint32_t number = 0;
    for (size_t i = 0; i < count && place + i < left(bytes); i++) {
        number |= (uint32_t)bytes->at[place + i] << 8 * i;
    }
    return number;
}

static uint32_t read_big(const struct bytes *bytes, size_t place, size_t count)
{
    uint32_t number = 0;
    for (size_t i = 0; i < count; i++) {
        number = number << 8 | (place + i < left(bytes) ? bytes->at[place + i] : 0);
    }
    return number;
}

static const char inverted[] = "inverted textures: drawn as they are",
                  additive[] = "additive blending: drawn as ordinary blending";

static void tell(struct scene_import *import, const char *line)
{
    scene_import_unsupported(import, "%s", line);
}

// 3DS -----------------------------------------------------------------------------------------------

// Take the next chunk, which is its kind and its length with these six bytes. Return false at the end.
static bool next_3ds(struct bytes *bytes, uint32_t *kind, struct bytes *content)
{
    enum { HEAD = 6 };
    const size_t length = read_little(bytes, 2, 4);
    if (left(bytes) < HEAD || length < HEAD || length > left(bytes)) {
        return false;
    }
    *kind = read_little(bytes, 0, 2);
    *content = (struct bytes){bytes->at + HEAD, bytes->at + length};
    bytes->at += length;
    return true;
}

static void look_at_3ds_texture(struct scene_import *import, struct bytes texture)
{
    enum { TILING = 0xa351, NEGATE = 0x4, ALPHA_SOURCE = 0x40, TINT = 0x80, RGB_TINT = 0x200 };
    uint32_t kind;
    for (struct bytes content; next_3ds(&texture, &kind, &content);) {
        const uint32_t flags = kind == TILING ? read_little(&content, 0, 2) : 0;
        if (flags & NEGATE) {
            tell(import, inverted);
        }
        if (flags & (TINT | RGB_TINT)) {
            tell(import, "tinted textures: drawn as they are");
        }
        if (flags & ALPHA_SOURCE) {
            tell(import, "textures that are the alpha of their image: drawn as its colours");
        }
    }
}

static void look_at_3ds_material(struct scene_import *import, struct bytes material)
{
    uint32_t kind;
    for (struct bytes content; next_3ds(&material, &kind, &content);) {
        switch (kind) {
        case 0xa200:                                              // the colour
        case 0xa210:                                              // how opaque it is
        case 0xa230:                                              // its relief
        case 0xa33d: look_at_3ds_texture(import, content); break; // its glow
        case 0xa33a: tell(import, "textures above each other: the first alone is used"); break;
        case 0xa33e:
        case 0xa340:
        case 0xa342:
        case 0xa344:
        case 0xa34a: tell(import, "masks of textures: not used"); break;
        case 0xa310: tell(import, "reflections of what is around (3DS): not drawn"); break;
        case 0xa083: tell(import, additive); break;
        case 0xa085: tell(import, "wire frames: drawn as surfaces"); break;
        case 0xa088: tell(import, "textures on each face (3DS): drawn by the coordinates"); break;
        default: break;
        }
    }
}

static void look_at_3ds_object(struct scene_import *import, struct bytes object)
{
    enum { HIDDEN = 0x4010, LIGHT = 0x4600, PLACE = 12, IS_OFF = 0x4620 };
    uint32_t kind;
    object = skip_text(object, false);
    for (struct bytes content; next_3ds(&object, &kind, &content);) {
        if (kind == HIDDEN) {
            tell(import, "hidden objects: drawn");
        }
        struct bytes light = kind == LIGHT ? skip(content, PLACE) : (struct bytes){content.end, content.end};
        while (next_3ds(&light, &kind, &content)) {
            if (kind == IS_OFF) {
                tell(import, "lights that are off: drawn as if they were on");
            }
        }
    }
}

static void look_at_3ds_editor(struct scene_import *import, struct bytes editor)
{
    uint32_t kind;
    for (struct bytes content; next_3ds(&editor, &kind, &content);) {
        switch (kind) {
        case 0x4000: look_at_3ds_object(import, content); break;
        case 0xafff: look_at_3ds_material(import, content); break;
        case 0x1101: // a background is a picture, a colour or a gradient
        case 0x1201:
        case 0x1301: tell(import, "the background: not drawn"); break;
        case 0x2201: // fog, and beneath it cues of distance and layers of fog
        case 0x2301:
        case 0x2303: tell(import, "fog: not drawn"); break;
        default: break;
        }
    }
}

static void look_at_3ds(struct scene_import *import, struct bytes file)
{
    enum { FILE_OF_MESHES = 0x4d4d, EDITOR = 0x3d3d };
    uint32_t kind;
    struct bytes parts;
    if (!next_3ds(&file, &kind, &parts) || kind != FILE_OF_MESHES) {
        return;
    }
    for (struct bytes content; next_3ds(&parts, &kind, &content);) {
        if (kind == EDITOR) {
            look_at_3ds_editor(import, content);
        }
    }
}

// LightWave -----------------------------------------------------------------------------------------

// Return the number that four letters are as the name of a chunk.
static uint32_t name_of(const char *letters)
{
    const struct bytes bytes = {(const unsigned char *)letters, (const unsigned char *)letters + 4};
    return read_big(&bytes, 0, 4);
}

// Take the next chunk, which is four letters and its length in 4 bytes, or in 2 within other chunks. A byte follows an
// odd length. Return false at the end.
static bool next_lwo(struct bytes *bytes, size_t width, uint32_t *id, struct bytes *content)
{
    const size_t head = 4 + width, length = read_big(bytes, 4, width);
    if (left(bytes) < head || length > left(bytes) - head) {
        return false;
    }
    *id = read_big(bytes, 0, 4);
    *content = (struct bytes){bytes->at + head, bytes->at + head + length};
    *bytes = skip(*bytes, head + length + length % 2);
    return true;
}

// An image, of which assimp reads the name alone where that is first.
static void look_at_lwo_image(struct scene_import *import, struct bytes image)
{
    const uint32_t one = 0x3f800000; // as a float
    uint32_t id;
    for (struct bytes content; next_lwo(&image, 2, &id, &content);) {
        const uint32_t value = read_big(&content, 0, 4);
        const bool is_shifted =
            (id == name_of("BRIT") || id == name_of("CONT") || id == name_of("SATR") || id == name_of("HUE "))
                ? value != 0
                : id == name_of("GAMM") && value != 0 && value != one;
        if (id == name_of("NEGA") && read_big(&content, 0, 2) != 0) {
            tell(import, inverted);
        }
        if (is_shifted) {
            tell(import, "images of changed colours (LightWave): drawn as they are");
        }
    }
}

// A texture, which begins with a chunk that has its name and what it is for.
static void look_at_lwo_texture(struct scene_import *import, struct bytes texture)
{
    uint32_t id;
    struct bytes head;
    if (!next_lwo(&texture, 2, &id, &head)) {
        return;
    }
    head = skip_text(head, true);
    for (struct bytes content; next_lwo(&head, 2, &id, &content);) {
        if (id == name_of("NEGA") && read_big(&content, 0, 2) != 0) {
            tell(import, inverted);
        }
    }
}

static void look_at_lwo_surface(struct scene_import *import, struct bytes surface, bool is_old)
{
    enum { NEGATIVE = 0x10, ADDITIVE = 0x200 };
    uint32_t id;
    surface = skip_text(surface, true);
    surface = is_old ? surface : skip_text(surface, true); // the name of the surface that it is made of
    for (struct bytes content; next_lwo(&surface, 2, &id, &content);) {
        const uint32_t flags = read_big(&content, 0, 2);
        if (id == name_of("BLOK")) {
            look_at_lwo_texture(import, content);
        } else if (id == name_of("RIMG") && (is_old || flags != 0)) {
            tell(import, "reflection textures: not used");
        } else if (id == name_of("LINE") && flags % 2 == 1) {
            tell(import, "edges that are drawn (LightWave): not drawn");
        } else if (is_old && id == name_of("TFLG") && (flags & NEGATIVE)) {
            tell(import, inverted);
        } else if (is_old && id == name_of("FLAG") && (flags & ADDITIVE)) {
            tell(import, additive);
        }
    }
}

static void look_at_lwo(struct scene_import *import, struct bytes file)
{
    enum { HEAD = 12 };
    const uint32_t type = read_big(&file, 8, 4), of_polygons = name_of("POLS");
    const bool is_old = type == name_of("LWOB");
    uint32_t id;
    if (read_big(&file, 0, 4) != name_of("FORM") || (!is_old && type != name_of("LWO2"))) {
        return;
    }
    file = skip(file, HEAD);
    for (struct bytes content; next_lwo(&file, 4, &id, &content);) {
        const uint32_t kind = read_big(&content, 0, 4);
        if (id == name_of("CLIP")) {
            look_at_lwo_image(import, skip(content, 4));
        } else if (id == name_of("SURF")) {
            look_at_lwo_surface(import, content, is_old);
        } else if (id == of_polygons && !is_old && (kind == name_of("PTCH") || kind == name_of("SUBD"))) {
            tell(import, "subdivision surfaces: drawn as their cages");
        }
    }
}

// Blitz3D -------------------------------------------------------------------------------------------

static void look_at_b3d_textures(struct scene_import *import, struct bytes textures)
{
    enum { CLAMPED = 0x30, AROUND = 0xc0, SECOND_SET = 0x10000, ADD = 3, NUMBERS = 28 };
    const uint32_t one = 0x3f800000; // as a float
    while (left(&textures) > 0) {
        textures = skip_text(textures, false);
        const uint32_t flags = read_little(&textures, 0, 4), blend = read_little(&textures, 4, 4);
        const bool is_placed = read_little(&textures, 8, 4) == 0 && read_little(&textures, 12, 4) == 0 &&
                               read_little(&textures, 16, 4) == one && read_little(&textures, 20, 4) == one &&
                               read_little(&textures, 24, 4) == 0;
        if (left(&textures) < NUMBERS) {
            return;
        }
        if (flags & CLAMPED) {
            tell(import, "textures that are not repeated (B3D): repeated");
        }
        if (flags & AROUND) {
            tell(import, "textures of what is around (B3D): drawn by the coordinates");
        }
        if (flags & SECOND_SET) {
            tell(import, "texture coordinate set 1 (B3D): set 0 is read instead");
        }
        if (blend == ADD) {
            tell(import, "textures that are added or subtracted: multiplied");
        }
        if (!is_placed) {
            tell(import, "textures that are moved, scaled or turned (B3D): drawn as they are");
        }
        textures = skip(textures, NUMBERS);
    }
}

static void look_at_b3d_materials(struct scene_import *import, struct bytes materials)
{
    enum { MULTIPLY = 2, ADD = 3, BRIGHT = 1, COLOR = 20, MOST = 8 };
    const uint32_t none = UINT32_MAX, count = read_little(&materials, 0, 4);
    materials = skip(materials, 4);
    while (left(&materials) > 0 && count <= MOST) {
        materials = skip(skip_text(materials, false), COLOR);
        const uint32_t blend = read_little(&materials, 0, 4), effects = read_little(&materials, 4, 4);
        if (blend == ADD) {
            tell(import, additive);
        }
        if (blend == MULTIPLY) {
            tell(import, "multiplied blending: drawn as ordinary blending");
        }
        if (effects & BRIGHT) {
            tell(import, "surfaces that are not lit (B3D): lit");
        }
        for (uint32_t i = 1; i < count && left(&materials) >= 8 + 4 * (size_t)count; i++) {
            if (read_little(&materials, 8 + 4 * (size_t)i, 4) != none) {
                tell(import, "textures above each other: the first alone is used");
            }
        }
        materials = skip(materials, 8 + 4 * (size_t)count);
    }
}

static void look_at_b3d(struct scene_import *import, struct bytes file)
{
    enum { HEAD = 12, CHUNK = 8 };
    if (read_big(&file, 0, 4) != name_of("BB3D")) {
        return;
    }
    for (file = skip(file, HEAD); left(&file) >= CHUNK;) {
        const uint32_t id = read_big(&file, 0, 4);
        const size_t length = read_little(&file, 4, 4);
        file = skip(file, CHUNK);
        const struct bytes content = {file.at, skip(file, length).at};
        if (id == name_of("TEXS")) {
            look_at_b3d_textures(import, content);
        } else if (id == name_of("BRUS")) {
            look_at_b3d_materials(import, content);
        }
        file = skip(file, length);
    }
}

void scene_assimp_look_at_chunks(struct scene_import *import, const void *bytes, size_t size)
{
    const struct bytes file = {bytes, (const unsigned char *)bytes + size};
    look_at_3ds(import, file);
    look_at_lwo(import, file);
    look_at_b3d(import, file);
}
