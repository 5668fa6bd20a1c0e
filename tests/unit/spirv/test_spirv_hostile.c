// SPDX-License-Identifier: MIT
// Modules that break a rule which the translation relies on, and modules that ask for more than there is: each is refused
// with a message that tells which rule, and nothing else happens. The texts of asm/ are one rule each, or have what GLSL
// does not give.
#include <rhw/spirv.h>
#include <stdlib.h>
#include <string.h>

#include "mistaken_comp.h"
#include "spirv_run.h"

struct assembled {
    const char *name, *expected; // "refused: " and a part of the message, "taken", or "gives" and words
    const uint32_t *words;
    size_t size;
};

#include "assembled.h"

// Return the stage of a module's entry point, or compute where it has none.
static enum rhw_shader_stage stage_of(const uint32_t *words, size_t size)
{
    enum { OP_ENTRY_POINT = 15, VERTEX = 0, FRAGMENT = 4 };
    for (size_t i = 5; i < size / sizeof *words && words[i] >> 16 != 0; i += words[i] >> 16) {
        if ((words[i] & 0xffff) == OP_ENTRY_POINT) {
            return words[i + 1] == VERTEX     ? RHW_SHADER_VERTEX
                   : words[i + 1] == FRAGMENT ? RHW_SHADER_FRAGMENT
                                              : RHW_SHADER_COMPUTE;
        }
    }
    return RHW_SHADER_COMPUTE;
}

// Run a shader, which has words 1, 2 and so on, and compare them afterwards with those of a text.
static void expect_words(const char *name, const char *expected, rhw_shader *shader)
{
    enum { WORDS = 16 };
    uint32_t words[WORDS];
    for (uint32_t i = 0; i < WORDS; i++) {
        words[i] = i + 1;
    }
    spirv_run(shader, &(struct spirv_bytes){words, sizeof words, false}, 1, NULL, 0, 1);
    for (int i = 0; i < WORDS && *expected != '\0'; i++) {
        char *end;
        const uint32_t wanted = (uint32_t)strtoul(expected, &end, 16);
        if (words[i] != wanted) {
            fail_msg("%s: word %d is 0x%x, where it is to be 0x%x", name, i, (unsigned)words[i],
                     (unsigned)wanted);
        }
        expected = end;
    }
}

static void expect(const char *name, const char *expected, const uint32_t *words, size_t size)
{
    static const char refused[] = "refused: ", gives[] = "gives";
    char message[RHW_SHADER_MESSAGE];
    rhw_shader *shader;
    const struct rhw_shader_def def = {.stage = stage_of(words, size)};
    const enum rhw_result result = rhw_shader_create(words, size, &def, &shader, message);
    const bool is_refused = strncmp(expected, refused, sizeof refused - 1) == 0;
    if (result != (is_refused ? RHW_ERROR_MISUSE : RHW_OK)) {
        fail_msg("%s: result %d with \"%s\", where it is to be %s", name, (int)result, message, expected);
    }
    if (is_refused && !strstr(message, expected + sizeof refused - 1)) {
        fail_msg("%s: \"%s\", where it is to be %s", name, message, expected);
    }
    if (strncmp(expected, gives, sizeof gives - 1) == 0) {
        expect_words(name, expected + sizeof gives - 1, shader);
    } else {
        rhw_shader_destroy(shader);
    }
}

static void test_broken_rules_are_named(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof assembled / sizeof *assembled; i++) {
        expect(assembled[i].name, assembled[i].expected, assembled[i].words, assembled[i].size);
    }
}

// Large modules --------------------------------------------------------------------------------------

// A module that grows word by word.
struct growing {
    uint32_t *words;
    size_t count, room;
    uint32_t next_id;
};

static void put(struct growing *module, uint32_t word)
{
    if (module->count == module->room) {
        module->room = module->room ? 2 * module->room : 1024;
        module->words = realloc(module->words, module->room * sizeof(uint32_t));
        assert_non_null(module->words);
    }
    module->words[module->count++] = word;
}

static void put_all(struct growing *module, const uint32_t *words, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        put(module, words[i]);
    }
}

#define PUT(...) put_all(module, (const uint32_t[]){__VA_ARGS__}, sizeof((const uint32_t[]){__VA_ARGS__}) / 4)

// Numbers of instructions, with how many words they have.
enum {
    CAPABILITY = 0x20011,
    MEMORY_MODEL = 0x3000e,
    ENTRY_POINT = 0x5000f,
    EXECUTION_MODE = 0x60010,
    DECORATE = 0x30047,
    DECORATE_WITH = 0x40047,
    MEMBER_DECORATE_WITH = 0x50048,
    DECORATION_GROUP = 0x20049,
    GROUP_DECORATE = 0x3004a,
    TYPE_VOID = 0x20013,
    TYPE_BOOL = 0x20014,
    TYPE_INT = 0x40015,
    TYPE_ARRAY = 0x4001c,
    TYPE_STRUCT_OF_ONE = 0x3001e,
    TYPE_FUNCTION = 0x30021,
    CONSTANT = 0x4002b,
    UNDEF = 0x30001,
    FUNCTION = 0x50036,
    FUNCTION_END = 0x10038,
    CALL = 0x40039,
    TYPE_POINTER = 0x40020,
    VARIABLE = 0x4003b,
    LOAD = 0x4003d,
    STORE = 0x3003e,
    ACCESS_CHAIN = 0x50041,
    NOP = 0x10000,
    LABEL = 0x200f8,
    SELECTION_MERGE = 0x300f7,
    BRANCH = 0x200f9,
    SWITCH_OF_ONE = 0x500fb,
    RETURN = 0x100fd
};

enum { WORKGROUP = 4, OF_FUNCTION = 7, STORAGE_BUFFER = 12 };       // classes of storage
enum { BLOCK = 2, BINDING = 33, DESCRIPTOR_SET = 34, OFFSET = 35 }; // decorations

enum { MAIN = 1, VOID, MAIN_TYPE, UINT, ZERO, FREE };

static void begin(struct growing *module)
{
    *module = (struct growing){.next_id = FREE};
    PUT(0x07230203, 0x10300, 0, 0, 0);
    PUT(CAPABILITY, 1, MEMORY_MODEL, 0, 1, ENTRY_POINT, 5, MAIN, 0x6e69616d, 0, EXECUTION_MODE, MAIN, 17, 8,
        1, 1);
}

static void declare(struct growing *module)
{
    PUT(TYPE_VOID, VOID, TYPE_FUNCTION, MAIN_TYPE, VOID, TYPE_INT, UINT, 32, 0, CONSTANT, UINT, ZERO, 0);
}

static void begin_function(struct growing *module, uint32_t id)
{
    PUT(FUNCTION, VOID, id, 0, MAIN_TYPE, LABEL, module->next_id++);
}

static void end_function(struct growing *module)
{
    PUT(RETURN, FUNCTION_END);
}

static void finish(const char *name, const char *expected, struct growing *module)
{
    module->words[3] = module->next_id;
    expect(name, expected, module->words, module->count * sizeof(uint32_t));
    free(module->words);
}

// A block for each branch, behind one another: no depth of them may show on the stack.
static void test_many_blocks(void **state)
{
    (void)state;
    struct growing whole, *const module = &whole;
    begin(module);
    declare(module);
    begin_function(module, MAIN);
    for (int i = 0; i < 150000; i++) {
        const uint32_t label = module->next_id++;
        PUT(BRANCH, label, LABEL, label);
    }
    end_function(module);
    finish("many blocks", "taken", module);
}

static void nest_switches(struct growing *module, uint32_t depth)
{
    begin(module);
    declare(module);
    const uint32_t pointer = module->next_id++, variable = module->next_id++, selector = module->next_id++;
    PUT(TYPE_POINTER, pointer, WORKGROUP, UINT, VARIABLE, pointer, variable, WORKGROUP);
    begin_function(module, MAIN);
    PUT(LOAD, UINT, selector, variable);
    const uint32_t first = module->next_id;
    module->next_id += 2 * depth;
    for (uint32_t i = 0; i < depth; i++) {
        PUT(SELECTION_MERGE, first + 2 * i, 0, SWITCH_OF_ONE, selector, first + 2 * i, 1, first + 2 * i + 1,
            LABEL, first + 2 * i + 1);
    }
    for (uint32_t i = depth; i-- > 0;) {
        PUT(BRANCH, first + 2 * i, LABEL, first + 2 * i);
    }
    end_function(module);
}

// A switch becomes three structures within each other.
static void test_switches_within_each_other(void **state)
{
    (void)state;
    struct growing module;
    nest_switches(&module, RHW_SHADER_MAX_NESTING - 1);
    finish("as deep as is allowed", "taken", &module);
    nest_switches(&module, RHW_SHADER_MAX_NESTING);
    finish("deeper", "refused: nested more than 128 deep", &module);
    nest_switches(&module, 30000);
    finish("much deeper", "refused: nested more than 128 deep", &module);
}

// Each function calls the next one twice.
static void put_calls(struct growing *module, uint32_t depth, uint32_t nops)
{
    begin(module);
    declare(module);
    const uint32_t first = module->next_id;
    module->next_id += depth;
    for (uint32_t i = 0; i <= depth; i++) {
        begin_function(module, i == 0 ? (uint32_t)MAIN : first + i - 1);
        for (int k = 0; i < depth && k < 2; k++) {
            PUT(CALL, VOID, module->next_id, first + i);
            module->next_id++;
        }
        for (uint32_t n = 0; i == depth && n < nops; n++) {
            PUT(NOP);
        }
        end_function(module);
    }
}

static void test_calls_that_double(void **state)
{
    (void)state;
    struct growing module;
    put_calls(&module, 60, 0);
    finish("calls", "refused: more than 262144 operations", &module);
    put_calls(&module, 16, 100000);
    finish("calls of what does nothing", "refused: too many instructions", &module);
    put_calls(&module, RHW_SHADER_MAX_NESTING, 0);
    finish("calls within each other", "refused: nested more than 128 deep", &module);
}

// Constants that fall into one bucket of any table that takes the upper bits of a product.
static void test_constants_of_one_bucket(void **state)
{
    (void)state;
    struct growing whole, *const module = &whole;
    begin(module);
    declare(module);
    const uint32_t first = module->next_id;
    for (uint32_t i = 0; i < 100000; i++) {
        PUT(CONSTANT, UINT, module->next_id++, i * 0x0e8b2f51u); // times 2654435761 it is i
    }
    const uint32_t pointer = module->next_id++, variable = module->next_id++;
    PUT(TYPE_POINTER, pointer, OF_FUNCTION, UINT);
    begin_function(module, MAIN);
    PUT(VARIABLE, pointer, variable, OF_FUNCTION);
    for (uint32_t i = 0; i < 100000; i++) {
        PUT(STORE, variable, first + i);
    }
    end_function(module);
    finish("constants", "taken", module);
}

static void test_decorations_without_end(void **state)
{
    (void)state;
    struct growing whole, *const module = &whole;
    begin(module);
    const uint32_t group = module->next_id++, target = module->next_id++;
    for (int i = 0; i < 1000; i++) {
        PUT(DECORATE, group, 24);
    }
    PUT(DECORATION_GROUP, group);
    for (int i = 0; i < 5; i++) { // nearly as many as the module has words
        PUT(GROUP_DECORATE, group, target);
    }
    for (int i = 0; i < 1000; i++) {
        PUT(DECORATE, target, 24);
    }
    declare(module);
    begin_function(module, MAIN);
    end_function(module);
    finish("decorations", "refused: too many decorations", module);
}

// A module that reads a number of buffers of a set.
static void read_buffers(struct growing *module, uint32_t count, uint32_t set)
{
    begin(module);
    const uint32_t type = module->next_id++, to_type = module->next_id++, to_word = module->next_id++;
    const uint32_t first = module->next_id;
    module->next_id += count;
    PUT(DECORATE, type, BLOCK, MEMBER_DECORATE_WITH, type, 0, OFFSET, 0);
    for (uint32_t i = 0; i < count; i++) {
        PUT(DECORATE_WITH, first + i, DESCRIPTOR_SET, set, DECORATE_WITH, first + i, BINDING, i);
    }
    declare(module);
    PUT(TYPE_STRUCT_OF_ONE, type, UINT, TYPE_POINTER, to_type, STORAGE_BUFFER, type, TYPE_POINTER, to_word,
        STORAGE_BUFFER, UINT);
    for (uint32_t i = 0; i < count; i++) {
        PUT(VARIABLE, to_type, first + i, STORAGE_BUFFER);
    }
    begin_function(module, MAIN);
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t place = module->next_id++;
        PUT(ACCESS_CHAIN, to_word, place, first + i, ZERO, STORE, place, ZERO);
    }
    end_function(module);
}

// A module whose workgroup shares a number of words.
static void share_words(struct growing *module, uint32_t count)
{
    begin(module);
    declare(module);
    const uint32_t length = module->next_id++, array = module->next_id++, pointer = module->next_id++,
                   variable = module->next_id++;
    PUT(CONSTANT, UINT, length, count, TYPE_ARRAY, array, UINT, length, TYPE_POINTER, pointer, WORKGROUP,
        array, VARIABLE, pointer, variable, WORKGROUP);
    begin_function(module, MAIN);
    end_function(module);
}

static void test_resources_are_bounded(void **state)
{
    (void)state;
    struct growing module;
    share_words(&module, RHW_MAX_SHARED_SIZE / 4);
    finish("shared memory", "taken", &module);
    share_words(&module, RHW_MAX_SHARED_SIZE / 4 + 1);
    finish("too much of it", "refused: a workgroup has at most 65536 bytes", &module);
    read_buffers(&module, RHW_SHADER_MAX_RESOURCES, RHW_SHADER_MAX_SETS - 1);
    finish("buffers", "taken", &module);
    read_buffers(&module, RHW_SHADER_MAX_RESOURCES + 1, 0);
    finish("too many buffers", "refused: more than 256 resources", &module);
    read_buffers(&module, 1, RHW_SHADER_MAX_SETS);
    finish("a set beyond all", "refused: a set below 8", &module);
}

static void test_bounds_are_named(void **state)
{
    (void)state;
    struct growing whole, *const module = &whole;
    begin(module);
    for (int i = 0; i < 256; i++) {
        PUT(ENTRY_POINT, 5, MAIN, 0x6e69616d, 0);
    }
    finish("entry points", "refused: more than 256 entry points", module);
    begin(module);
    declare(module);
    const uint32_t length = module->next_id++, array = module->next_id++;
    PUT(CONSTANT, UINT, length, 16384, TYPE_ARRAY, array, UINT, length);
    for (int i = 0; i < 5000; i++) {
        PUT(UNDEF, array, module->next_id);
        module->next_id++;
    }
    finish("memory", "refused: more than 268435456 bytes", module);
    begin(module);
    module->next_id = RHW_SHADER_MAX_IDS + 1;
    finish("ids", "refused: bound of 1048577 ids", module);
}

static void test_layouts_are_bounded(void **state)
{
    (void)state;
    struct growing whole, *const module = &whole;
    begin(module);
    declare(module);
    begin_function(module, MAIN);
    end_function(module);
    module->words[3] = module->next_id;
    const struct rhw_shader_def def = {.stage = RHW_SHADER_COMPUTE};
    const struct rhw_shader_layout layout[] = {{0, 0, INT32_MAX / 2}, {0, 1, INT32_MAX / 2}, {0, 2, 2}};
    char message[RHW_SHADER_MESSAGE];
    rhw_shader *shader;
    rhw_shader_program *program;
    const size_t size = module->count * sizeof(uint32_t);
    assert_int_equal(rhw_shader_create(module->words, size, &def, &shader, message), RHW_OK);
    const struct rhw_shader_program_def link = {.compute = shader, .layout = layout, .layout_count = 3};
    assert_int_equal(rhw_shader_program_create(&link, &program, message), RHW_ERROR_MISUSE);
    assert_non_null(strstr(message, "fewer than 2^31"));
    rhw_shader_destroy(shader);
    free(module->words);
}

// An output that holds 2^124 structures without members.
static void test_arrays_of_nothing(void **state)
{
    (void)state;
    enum { ENTRY_POINT_OF_ONE = 0x6000f, MODE_ALONE = 0x30010, ORIGIN_UPPER_LEFT = 7, OUTPUT = 3 };
    enum { FRAGMENT = 4, LOCATION = 30, TYPE_STRUCT_OF_NONE = 0x2001e, DEPTH = 4 };
    struct growing whole = {.next_id = FREE}, *const module = &whole;
    const uint32_t output = FREE, many = FREE + 1, pointer = FREE + 2, type = FREE + 3;
    module->next_id = type + DEPTH + 1;
    PUT(0x07230203, 0x10300, 0, 0, 0);
    PUT(CAPABILITY, 1, MEMORY_MODEL, 0, 1, ENTRY_POINT_OF_ONE, FRAGMENT, MAIN, 0x6e69616d, 0, output);
    PUT(MODE_ALONE, MAIN, ORIGIN_UPPER_LEFT, DECORATE_WITH, output, LOCATION, 0);
    declare(module);
    PUT(CONSTANT, UINT, many, INT32_MAX, TYPE_STRUCT_OF_NONE, type);
    for (uint32_t i = 0; i < DEPTH; i++) {
        PUT(TYPE_ARRAY, type + i + 1, type + i, many);
    }
    PUT(TYPE_POINTER, pointer, OUTPUT, type + DEPTH, VARIABLE, pointer, output, OUTPUT);
    begin_function(module, MAIN);
    end_function(module);
    finish("an output of nothing", "taken", module);
}

// A texture with a dimension that the shader does not know of is read at its first slice.
static void test_a_texture_of_another_kind(void **state)
{
    (void)state;
    static const float texels[4] = {1, 2, 3, 4};
    const struct rhw_texture_def texture = {
        .format = RHW_FORMAT_R32_FLOAT, .kind = RHW_TEXTURE_3D, .width = 1, .height = 1, .depth = 4};
    struct rhw_sampler_def sampler = rhw_sampler_def_default();
    sampler.min_filter = sampler.mag_filter = RHW_FILTER_NEAREST;
    struct rig rig;
    rhw_texture solid;
    rhw_sampler nearest;
    struct rhw_binding set[2];
    float results[8][4] = {{0}};
    rig_open(&rig, 4, 4);
    assert_int_equal(rhw_texture_create(rig.context, &texture, &solid), RHW_OK);
    assert_int_equal(rhw_sampler_create(rig.context, &sampler, &nearest), RHW_OK);
    assert_int_equal(rhw_texture_write(rig.context, solid, 0, texels, 0), RHW_OK);
    assert_int_equal(rhw_binding_of_texture(rig.context, solid, nearest, &set[0]), RHW_OK);
    set[1] = spirv_memory(results, sizeof results);
    rhw_shader_program *const program =
        spirv_link(NULL, NULL, SPIRV_CREATE(mistaken_comp, RHW_SHADER_COMPUTE));
    const struct rhw_shader_frame frame = {.sets = {set}};
    assert_int_equal(spirv_dispatch(&rig, program, &frame, 1), RHW_OK);
    for (int i = 0; i < 8; i++) {
        assert_memory_equal(results[i], ((const float[4]){1, 0, 0, 1}), sizeof *results);
    }
    rhw_shader_program_destroy(program);
    rhw_sampler_destroy(rig.context, nearest);
    rhw_texture_destroy(rig.context, solid);
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_broken_rules_are_named),     cmocka_unit_test(test_many_blocks),
    cmocka_unit_test(test_switches_within_each_other), cmocka_unit_test(test_calls_that_double),
    cmocka_unit_test(test_constants_of_one_bucket),    cmocka_unit_test(test_decorations_without_end),
    cmocka_unit_test(test_bounds_are_named),           cmocka_unit_test(test_layouts_are_bounded),
    cmocka_unit_test(test_resources_are_bounded),      cmocka_unit_test(test_arrays_of_nothing),
    cmocka_unit_test(test_a_texture_of_another_kind),
};

const struct unit_tests test_spirv_hostile = UNIT_TESTS(tests, NULL, NULL);
