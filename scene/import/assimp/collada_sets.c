// SPDX-License-Identifier: MIT
// Texture coordinates of Collada for assimp. A texture names its coordinates (texcoord="CHANNEL1"), and a
// bind_vertex_input says the set that is meant. assimp 5.2.5 takes the first number in the name for the set, so that
// a CHANNEL1 of 3ds Max, which is bound to set 0, reads a second set. It also counts the sets of a mesh from 0 on,
// whatever their numbers are. The number that assimp is to take replaces the name, and blanks fill what is left of it.
// Exporters of Blender 2.4 bind set 1 where the inputs have no numbers, which makes them set 0.
#include "assimp.h"
#include "collada_markup.h"

#include <stdlib.h>
#include <string.h>

enum { SETS = 8 }; // as many as assimp reads

struct binding {
    struct scene_collada_value name;
    unsigned set;
};

struct sets {
    struct binding *bindings;
    size_t count, capacity;
    unsigned primitive;   // a bit for each set of the primitive that is being read
    unsigned first[SETS]; // each set has the bits of the first primitive that has it
};

static bool is_texcoord(struct scene_collada_value semantic)
{
    return semantic.length == 8 && memcmp(semantic.text, "TEXCOORD", 8) == 0;
}

// Return the first number in a value. Return `otherwise` where there is none. SETS stands for all that are greater.
static unsigned find_number(struct scene_collada_value value, unsigned otherwise)
{
    size_t i = 0;
    while (i < value.length && (value.text[i] < '0' || value.text[i] > '9')) {
        i++;
    }
    unsigned number = i < value.length ? 0 : otherwise;
    for (; i < value.length && value.text[i] >= '0' && value.text[i] <= '9'; i++) {
        number = 10 * number + (unsigned)(value.text[i] - '0');
        number = number < SETS ? number : SETS;
    }
    return number;
}

static void end_primitive(struct sets *sets)
{
    for (unsigned set = 0; set < SETS; set++) {
        if ((sets->primitive >> set & 1) != 0 && sets->first[set] == 0) {
            sets->first[set] = sets->primitive;
        }
    }
    sets->primitive = 0;
}

static void add_binding(struct sets *sets, struct binding binding)
{
    if (sets->count == sets->capacity) {
        const size_t capacity = sets->capacity == 0 ? 64 : 2 * sets->capacity;
        struct binding *const grown = realloc(sets->bindings, capacity * sizeof *grown);
        if (grown == NULL) {
            return; // the name stays as it is
        }
        sets->bindings = grown;
        sets->capacity = capacity;
    }
    sets->bindings[sets->count++] = binding;
}

static void collect(char *tag, char *close, void *user)
{
    struct sets *const sets = user;
    if (scene_collada_is_tag(tag, "input")) {
        const unsigned set = find_number(scene_collada_attribute(tag, close, "set"), 0);
        if (set < SETS && is_texcoord(scene_collada_attribute(tag, close, "semantic"))) {
            sets->primitive |= 1u << set;
        }
        return;
    }
    end_primitive(sets);
    const struct scene_collada_value name = scene_collada_attribute(tag, close, "semantic");
    if (scene_collada_is_tag(tag, "bind_vertex_input") && name.length > 0 &&
        is_texcoord(scene_collada_attribute(tag, close, "input_semantic"))) {
        add_binding(sets,
                    (struct binding){name, find_number(scene_collada_attribute(tag, close, "input_set"), 0)});
    }
}

static int compare_names(const void *a, const void *b)
{
    const struct scene_collada_value *const x = &((const struct binding *)a)->name,
                                            *const y = &((const struct binding *)b)->name;
    if (x->length != y->length) {
        return x->length < y->length ? -1 : 1;
    }
    return memcmp(x->text, y->text, x->length);
}

// Sort by names, and those that are the same by their place in the document.
static int compare_bindings(const void *a, const void *b)
{
    const struct binding *const x = a, *const y = b;
    const int order = compare_names(a, b);
    return order != 0 ? order : (x->name.text > y->name.text) - (x->name.text < y->name.text);
}

// Keep of several bindings of a name the first.
static void sort_bindings(struct sets *sets)
{
    size_t kept = 0;
    if (sets->count > 0) {
        qsort(sets->bindings, sets->count, sizeof *sets->bindings, compare_bindings);
    }
    for (size_t i = 0; i < sets->count; i++) {
        if (kept == 0 || compare_names(&sets->bindings[kept - 1], &sets->bindings[i]) != 0) {
            sets->bindings[kept++] = sets->bindings[i];
        }
    }
    sets->count = kept;
}

// Return the set that a name means. A name that nothing binds, or binds to a set that no mesh has, means the set of its
// number if there is one, else the first.
static unsigned find_set(const struct sets *sets, struct scene_collada_value name)
{
    const struct binding key = {.name = name};
    const struct binding *const found =
        sets->count == 0 ? NULL
                         : bsearch(&key, sets->bindings, sets->count, sizeof *sets->bindings, compare_names);
    if (found != NULL && (found->set >= SETS || sets->first[found->set] != 0)) {
        return found->set;
    }
    const unsigned number = find_number(name, 0);
    return number < SETS && sets->first[number] != 0 ? number : 0;
}

static void number_texture(char *tag, char *close, void *user)
{
    const struct sets *const sets = user;
    const struct scene_collada_value name = scene_collada_attribute(tag, close, "texcoord");
    if (!scene_collada_is_tag(tag, "texture") || name.length == 0) {
        return;
    }
    const unsigned set = find_set(sets, name);
    if (set >= SETS) {
        return;
    }
    unsigned before = sets->first[set] == 0 ? set : 0; // how many sets of the mesh have smaller numbers
    for (unsigned other = 0; other < set; other++) {
        before += sets->first[set] >> other & 1;
    }
    memset(name.text, ' ', name.length);
    name.text[0] = (char)('0' + before);
}

static void each_start_tag(char *text, const char *end, void (*visit)(char *tag, char *close, void *user),
                           void *user)
{
    for (char *c = strchr(text, '<'); c != NULL; c = strchr(c, '<')) {
        char *const close = scene_collada_markup_end(c, end);
        if (close == NULL) {
            return;
        }
        if (c[1] != '/' && c[1] != '!' && c[1] != '?') {
            visit(c, close, user);
        }
        c = close;
    }
}

void scene_assimp_number_sets(char *text, size_t size)
{
    struct sets sets = {0};
    each_start_tag(text, text + size, collect, &sets);
    end_primitive(&sets);
    sort_bindings(&sets);
    each_start_tag(text, text + size, number_texture, &sets);
    free(sets.bindings);
}
