// SPDX-License-Identifier: MIT
// What assimp leaves out. Part of it assimp says in its log, which is read here. Of the rest it says nothing, such as
// of frames after the first of models that move by frames. Marks in the file tell of these.
#include <assimp/cimport.h>
#include <ctype.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "assimp.h"

// Log -----------------------------------------------------------------------------------------------

// Return true if a text has one of some words, which are in lower case, in any case.
static bool has_any(const char *text, const char *const *words, size_t count)
{
    bool found = false;
    for (; *text != 0; text++) {
        for (size_t i = 0; i < count; i++) {
            found = found || strncasecmp(text, words[i], strlen(words[i])) == 0;
        }
    }
    return found;
}

// Return true if a line of the log says that something is not in the scene. What concerns animations is told by other
// lines, and what concerns no picture is not told.
static bool tells_of_gap(const char *line)
{
    static const char *const gaps[] = {"unsupported",
                                       "not supported",
                                       "not currently supported",
                                       "skip",
                                       "ignor",
                                       "not implemented",
                                       "discard",
                                       "dropped",
                                       "neither material",
                                       "with no faces",
                                       "external file",
                                       "unable to find",
                                       "unknown data object in m",
                                       "unknown data object in frame",
                                       "unknown node",
                                       "no material has been found",
                                       "unresolved reference",
                                       "unable to resolve",
                                       "failed to resolve",
                                       "could not resolve",
                                       "cannot resolve",
                                       "failed to match",
                                       "failed to find source file",
                                       "failed to convert source",
                                       "unable to open material",
                                       "couldn't find a handler",
                                       "cannot represent",
                                       "out of range",
                                       "out of bounds",
                                       "index overflow",
                                       "failure evaluating",
                                       "just one",
                                       "only triangles",
                                       "type flag of a surface",
                                       "unknown surface shader",
                                       "unknown texture type",
                                       "unknown blend function",
                                       "unrecognized material type",
                                       "did not find uv channel"};
    static const char *const others[] = {
        "format version",
        "blenddna",
        "animation",
        "animator",
        "keyframe",
        "track",
        "binormal",
        "tangent",
        "metadata",
        "comment",
        "importer settings",
        "empty",
        "property",
        "thumbnail",
        "dummy",
        "zero length",
        "length of texture",
        "light source",
        "plugin",
        "subchunk",
        "unknown ''",
        "eof",
        "duplicate",
        "transition code",
        "weight channel",
        "tcb",
        "envelopes",
        "degenerate",
        "null geometry",
        "maya texture blend mode",
        "setting default material",
        "unsupported chunk:",
        "type is unsupported: `", // blender_gaps.c tells of objects of Blender
        "unknown node \"",        // an X3D is read again without it
    };
    return has_any(line, gaps, sizeof gaps / sizeof *gaps) &&
           !has_any(line, others, sizeof others / sizeof *others);
}

// Tell of a line of the log, without its numbers: lines that differ by them alone are one.
static void read_log(const char *line, char *user)
{
    struct scene_import *import = (struct scene_import *)(void *)user;
    const char *text = strstr(line, ": ");
    char kept[256];
    size_t length = 0;
    if ((strncmp(line, "Warn", 4) != 0 && strncmp(line, "Error", 5) != 0) || text == NULL ||
        !tells_of_gap(line)) {
        return;
    }
    for (text += 2; *text != 0 && *text != '\n' && length + 1 < sizeof kept; text++) {
        if (isdigit((unsigned char)*text) && !isalnum((unsigned char)text[-1])) {
            const bool is_hexadecimal = strncmp(text, "0x", 2) == 0;
            kept[length++] = 'N';
            text += is_hexadecimal ? 2 + strspn(text + 2, "0123456789abcdefABCDEF") - 1
                                   : strspn(text, "0123456789") - 1;
        } else {
            kept[length++] = *text;
        }
    }
    scene_import_unsupported(import, "assimp leaves out: %s", scene_import_string(import, kept, length));
}

void scene_assimp_listen(struct scene_import *import)
{
    const struct aiLogStream stream = {read_log, (char *)(void *)import};
    aiAttachLogStream(&stream);
}

// Marks ---------------------------------------------------------------------------------------------

// Write blanks over the comments of a text of XML, a 0 behind it.
static void blank_comments(char *text)
{
    for (char *start = strstr(text, "<!--"); start != NULL; start = strstr(start, "<!--")) {
        char *const end = strstr(start, "-->");
        if (end == NULL) {
            return;
        }
        memset(start, ' ', (size_t)(end - start));
        start = end;
    }
}

// Return true if a text has a word. "<Text" is a word of its own, others may begin longer ones. A 0 follows the text.
static bool has_word(const char *text, const char *end, const char *word)
{
    const size_t length = strlen(word);
    const bool is_whole = strcmp(word, "<Text") == 0;
    const char *place = text;
    while (place != NULL && (size_t)(end - place) >= length &&
           (memcmp(place, word, length) != 0 || (is_whole && isalnum((unsigned char)place[length])))) {
        place = memchr(place + 1, word[0], (size_t)(end - place) - 1);
    }
    return place != NULL && (size_t)(end - place) >= length;
}

// Words of text formats, and of FBX, that stand for what assimp does not know.
static void look_for_words(struct scene_import *import, const char *bytes, size_t size)
{
    static const struct {
        const char *ending, *word, *what;
    } words[] = {
        {"fbx", "NurbsSurface", "NURBS surfaces"},
        {"fbx", "NurbsCurve", "NURBS curves"},
        {"fbx", "VertexCacheDeformer", "movements of vertices that are in a file beside it"},
        {"x3d", "<Text", "text"},
        {"x3d", "<Nurbs", "NURBS"},
        {"x3d", "<Geo", "geospatial nodes"},
        {"x3d", "<HAnim", "humanoids"},
        {"x3d", "<Proto", "prototypes"},
        {"x3d", "<Script", "what scripts make"},
        {"x3d", "<VolumeData", "volumes"},
        {"x3d", "<PixelTexture", "textures in the file"},
        {"x3d", "<MovieTexture", "films"},
        {"x3d", "<MultiTexture", "textures above each other"},
        {"x3d", "<Background", "the background"},
        {"x3d", "<Fog", "fog"},
        {"x3d", "<ParticleSystem", "particles"},
        {"x3d", "<RigidBody", "rigid bodies"},
        {"x3d", "<LayerSet", "layers"},
        {"amf", "<composite", "composite materials"},
        {"amf", "<edge", "curved edges"},
    };
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++) {
        if (strcasecmp(import->ending, words[i].ending) != 0) {
            continue;
        }
        if (has_word(bytes, bytes + size, words[i].word)) {
            scene_import_unsupported(import, "%s: not drawn", words[i].what);
        }
    }
}

// Tell of frames after the first, by the head of a model that moves by frames.
static void look_for_frames(struct scene_import *import, const unsigned char *bytes, size_t size)
{
    static const struct {
        const char *mark;
        size_t count_at; // place of the number of frames
    } heads[] = {{"IDP2", 40}, {"IDP3", 76}, {"IDPC", 76}, {"IDPO", 68}};
    for (size_t i = 0; i < sizeof heads / sizeof heads[0]; i++) {
        const unsigned char *count = bytes + heads[i].count_at;
        if (size >= heads[i].count_at + 4 && memcmp(bytes, heads[i].mark, 4) == 0 &&
            (count[0] > 1 || count[1] > 0 || count[2] > 0)) {
            scene_import_unsupported(import, "frames after the first: not drawn");
        }
    }
}

void scene_assimp_find_gaps(struct scene_import *import)
{
    const char *problem = NULL;
    size_t size = 0;
    char *bytes = scene_import_read_file(import, import->model.path, &size, &problem);
    if (bytes != NULL && strcasecmp(import->ending, "zae") == 0 && strncmp(bytes, "PK", 2) == 0) {
        free(bytes);
        bytes = scene_assimp_read_zae(import, &size);
    }
    if (bytes == NULL) {
        scene_import_warn(import, "cannot be looked through for what is not drawn: %s", problem);
        return;
    }
    if (strcasecmp(import->ending, "x3d") == 0 || strcasecmp(import->ending, "amf") == 0) {
        blank_comments(bytes);
    }
    look_for_words(import, bytes, size);
    look_for_frames(import, (const unsigned char *)bytes, size);
    scene_assimp_look_at_chunks(import, bytes, size);
    if (scene_assimp_may_be_collada(import)) {
        scene_assimp_look_at_collada(import, bytes, size);
    }
    scene_assimp_look_at_ase(import, bytes, size);
    if (strcasecmp(import->ending, "dxf") == 0) {
        scene_assimp_look_at_dxf(import, bytes, size);
    } else {
        scene_assimp_look_at_text(import, bytes, size);
    }
    free(bytes);
}

void scene_assimp_find_gaps_within(struct scene_import *import, const char *path)
{
    const char *problem = NULL;
    size_t size = 0;
    char *const bytes = scene_import_read_bytes(path, &size, &problem);
    if (bytes != NULL) {
        blank_comments(bytes);
        look_for_words(import, bytes, size);
        free(bytes);
    }
}
