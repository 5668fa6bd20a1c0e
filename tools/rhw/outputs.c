// SPDX-License-Identifier: MIT
// Outputs as raster samples and EXR channels; see outputs.h. No function here may depend on the C library's
// maths: files are to be the same bytes everywhere.
#include "outputs.h"

#include "rhw/shader.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool is_word(const char *word, const char *text, size_t length)
{
    return strlen(word) == length && memcmp(word, text, length) == 0;
}

static int find_name(const char *text, size_t length)
{
    for (int kind = 0; kind < CLI_OUTPUT_KINDS; kind++) {
        if (is_word(scene_outputs[kind].word, text, length) ||
            is_word(scene_outputs[kind].name, text, length)) {
            return kind;
        }
    }
    return -1;
}

bool cli_outputs_parse(const char *list, unsigned *kinds, const char **bad)
{
    unsigned found = 0;
    for (const char *name = list;; name++) {
        const size_t length = strcspn(name, ",");
        const int kind = find_name(name, length);
        if (kind >= 0) {
            found |= 1u << kind;
        } else if (length == 3 && memcmp(name, "all", 3) == 0) {
            found = (1u << SCENE_KIND_OVERDRAW) - 1;
        } else {
            *bad = name;
            return false;
        }
        name += length;
        if (!*name) {
            break;
        }
    }
    *kinds = found;
    return true;
}

uint32_t cli_outputs_needed(unsigned kinds, enum cli_picture_format format, int bits)
{
    uint32_t needed = 0;
    for (int kind = 0; kind < CLI_OUTPUT_KINDS; kind++) {
        if (!(kinds >> kind & 1)) {
            continue;
        }
        if (kind == SCENE_KIND_COLOR && format == CLI_PICTURE_EXR) {
            needed |= SCENE_OUTPUT_LINEAR;
        } else if (kind == SCENE_KIND_COLOR && bits == 16) {
            needed |= SCENE_OUTPUT_DISPLAY;
        } else {
            needed |= scene_outputs[kind].output;
        }
        const bool over_picture = kind == SCENE_KIND_TILES || kind == SCENE_KIND_PLAN;
        needed |= over_picture && format != CLI_PICTURE_EXR ? SCENE_OUTPUT_COLOR : 0;
    }
    return needed;
}

// Rasters -------------------------------------------------------------------------------------------

static void opaque_color_row(const void *user, int y, void *row)
{
    const struct cli_output_raster *output = user;
    const size_t width = (size_t)output->raster.width;
    const uint8_t *from = output->pictures->color + (size_t)y * width * 4;
    uint8_t *to = row;
    for (size_t x = 0; x < width; x++, from += 4, to += 3) {
        memcpy(to, from, 3);
    }
}

static void transparent_color_row(const void *user, int y, void *row)
{
    const struct cli_output_raster *output = user;
    const size_t size = (size_t)output->raster.width * 4;
    memcpy(row, output->pictures->color + (size_t)y * size, size);
}

// The sRGB transfer function (IEC 61966-2-1) with the library's own power.
static inline rhw_float encode(rhw_float linear)
{
    const rhw_float curve = 1.055f * rhw_pow(linear, rhw_splat(1.0f / 2.4f)) - 0.055f;
    return rhw_select(rhw_less_equal(linear, rhw_splat(0.0031308f)), linear * 12.92f, curve);
}

static uint16_t to_16_bits(float value)
{
    const float clamped = value > 0.0f ? value < 1.0f ? value : 1.0f : 0.0f;
    return (uint16_t)(clamped * 65535.0f + 0.5f);
}

static void fine_color_row(const void *user, int y, void *row)
{
    const struct cli_output_raster *output = user;
    const int width = output->raster.width, channels = output->raster.channels;
    const float *from = output->pictures->display + (size_t)y * (size_t)width * 4;
    uint16_t *to = row;
    for (int x = 0; x < width; x += 2, from += 8) {
        const int pixels = x + 1 < width ? 2 : 1;
        rhw_float linear = rhw_splat(0.0f);
        memcpy(&linear, from, (size_t)pixels * 4 * sizeof *from);
        const rhw_float encoded = encode(linear);
        for (int i = 0; i < pixels; i++) {
            for (int c = 0; c < channels; c++) {
                *to++ = to_16_bits(c < 3 ? encoded[4 * i + c] : linear[4 * i + c]);
            }
        }
    }
}

// 0..1 to the raster's bits, rounded to nearest; NaN gives 0.
static void store(const struct cli_output_raster *output, void *row, size_t index, float value)
{
    if (output->raster.bits == 8) {
        ((uint8_t *)row)[index] =
            (uint8_t)((value > 0.0f ? value < 1.0f ? value : 1.0f : 0.0f) * 255.0f + 0.5f);
    } else {
        ((uint16_t *)row)[index] = to_16_bits(value);
    }
}

// Nearest white, farthest dark grey, nothing black.
static void grey_row(const void *user, int y, void *row)
{
    const struct cli_output_raster *output = user;
    const float *from = output->floats + (size_t)y * (size_t)output->raster.width;
    for (size_t x = 0; x < (size_t)output->raster.width; x++) {
        const bool nothing = output->pictures->depth == output->floats ? from[x] >= 1.0f : !isfinite(from[x]);
        store(output, row, x, nothing ? 0.0f : (from[x] - output->low[0]) * output->scale[0] + 1.0f);
    }
}

static void vector_row(const void *user, int y, void *row)
{
    const struct cli_output_raster *output = user;
    const float *from = output->floats + (size_t)y * (size_t)output->raster.width * 4;
    for (size_t x = 0; x < (size_t)output->raster.width; x++, from += 4) {
        for (size_t i = 0; i < 3; i++) {
            store(output, row, x * 3 + i,
                  from[3] > 0.0f ? (from[i] - output->low[i]) * output->scale[i] : 0.0f);
        }
    }
}

static void uv_row(const void *user, int y, void *row)
{
    const struct cli_output_raster *output = user;
    const float *from = output->floats + (size_t)y * (size_t)output->raster.width * 4;
    for (size_t x = 0; x < (size_t)output->raster.width; x++, from += 4) {
        for (size_t i = 0; i < 3; i++) {
            store(output, row, x * 3 + i, from[3] > 0.0f ? from[i] - floorf(from[i]) : 0.0f);
        }
    }
}

// A bijection of 32 bits (two rounds of multiply and shift), so neighbouring ids get unrelated colours; no
// channel is darker than 55, so nothing is taken for the black of 'nothing is here'.
static uint32_t scatter(uint32_t id)
{
    id = (id ^ id >> 16) * 0x7FEB352Du;
    id = (id ^ id >> 15) * 0x846CA68Bu;
    return id ^ id >> 16;
}

static void id_row(const void *user, int y, void *row)
{
    const struct cli_output_raster *output = user;
    const uint32_t *from = output->ids + (size_t)y * (size_t)output->raster.width;
    for (size_t x = 0; x < (size_t)output->raster.width; x++) {
        const uint32_t bits = scatter(from[x]);
        for (size_t i = 0; i < 3; i++) {
            const uint32_t level = from[x] ? 55 + (bits >> (8 * i) & 255) * 200 / 255 : 0;
            store(output, row, x * 3 + i, (float)level / 255.0f);
        }
    }
}

// Black, violet, red, yellow, white: ever lighter. `part` 0..1.
static void heat(float part, float color[3])
{
    static const float stops[5][3] = {
        {0, 0, 0}, {0.35f, 0.1f, 0.5f}, {0.85f, 0.2f, 0.25f}, {1, 0.75f, 0.2f}, {1, 1, 1}};
    const float place = part * 4.0f;
    const int stop = place < 3.0f ? (int)place : 3;
    for (int c = 0; c < 3; c++) {
        color[c] = stops[stop][c] + (place - (float)stop) * (stops[stop + 1][c] - stops[stop][c]);
    }
}

static void overdraw_row(const void *user, int y, void *row)
{
    const struct cli_output_raster *output = user;
    const float *from = output->floats + (size_t)y * (size_t)output->raster.width;
    for (size_t x = 0; x < (size_t)output->raster.width; x++) {
        float color[3];
        heat(from[x] * output->scale[0], color);
        for (size_t i = 0; i < 3; i++) {
            store(output, row, x * 3 + i, color[i]);
        }
    }
}

// What a tile's plans look like: each has a colour, several the mean of theirs.
static void plan_color(uint32_t plans, float color[3])
{
    static const float colors[3][3] = {{0.25f, 0.5f, 1}, {1, 0.55f, 0.1f}, {0.2f, 0.8f, 0.3f}};
    color[0] = color[1] = color[2] = 0.0f;
    for (int plan = 0; plan < 3; plan++) {
        for (int c = 0; c < 3 && plans >> plan & 1; c++) {
            color[c] += colors[plan][c] / (float)__builtin_popcount(plans);
        }
    }
}

// Over the picture in grey, so that one sees what lies in the tile.
static void tile_row(const void *user, int y, void *row)
{
    const struct cli_output_raster *output = user;
    const size_t first = (size_t)y * (size_t)output->raster.width;
    const bool is_plan = output->ids == output->pictures->plan;
    for (size_t x = 0; x < (size_t)output->raster.width; x++) {
        const uint8_t *const seen = output->pictures->color + 4 * (first + x);
        const float grey = (float)(seen[0] + 2 * seen[1] + seen[2]) / (4.0f * 255.0f);
        const uint32_t value = output->ids[first + x];
        float color[3];
        if (is_plan) {
            plan_color(value, color);
        } else {
            heat((float)value * output->scale[0], color);
        }
        for (size_t i = 0; i < 3; i++) {
            store(output, row, x * 3 + i, 0.65f * color[i] + 0.35f * grey);
        }
    }
}

// Range of the values that show something; an empty picture gives 0..1.
static void find_range(const struct cli_output_raster *output, float *least, float *most)
{
    const size_t count = (size_t)output->raster.width * (size_t)output->raster.height;
    const bool is_depth = output->floats == output->pictures->depth;
    *least = INFINITY;
    *most = -INFINITY;
    for (size_t i = 0; i < count; i++) {
        const float value = output->floats[i];
        if (!isfinite(value) || (is_depth && value >= 1.0f)) {
            continue;
        }
        *least = value < *least ? value : *least;
        *most = value > *most ? value : *most;
    }
    if (*least > *most) {
        *least = 0.0f;
        *most = 1.0f;
    }
}

static void set_grey(struct cli_output_raster *output, const char *name)
{
    float least, most;
    find_range(output, &least, &most);
    output->raster.channels = 1;
    output->raster.row = grey_row;
    output->low[0] = least;
    output->scale[0] = most > least ? -0.9f / (most - least) : 0.0f;
    snprintf(output->raster.comment, sizeof output->raster.comment,
             "%s: white is %.9g, the grey of one tenth is %.9g, black is nothing", name, (double)least,
             (double)most);
}

static void set_vector(struct cli_output_raster *output, const float *floats, const float low[3],
                       const float high[3])
{
    output->floats = floats;
    output->raster.row = vector_row;
    for (int i = 0; i < 3; i++) {
        output->low[i] = low[i];
        output->scale[i] = high[i] > low[i] ? 1.0f / (high[i] - low[i]) : 0.0f;
    }
    snprintf(output->raster.comment, sizeof output->raster.comment,
             "0 to full: x %.9g to %.9g, y %.9g to %.9g, z %.9g to %.9g", (double)low[0], (double)high[0],
             (double)low[1], (double)high[1], (double)low[2], (double)high[2]);
}

static void set_position(struct cli_output_raster *output, const float low[3], const float high[3])
{
    const double *const o = output->pictures->origin;
    set_vector(output, output->pictures->position, low, high);
    if (scene_origin_is_far(o)) {
        snprintf(output->raster.comment, sizeof output->raster.comment,
                 "0 to full: x %.15g to %.15g, y %.15g to %.15g, z %.15g to %.15g", o[0] + (double)low[0],
                 o[0] + (double)high[0], o[1] + (double)low[1], o[1] + (double)high[1], o[2] + (double)low[2],
                 o[2] + (double)high[2]);
    }
}

static void set_color(struct cli_output_raster *output, bool transparent)
{
    output->raster.channels = transparent ? 4 : 3;
    output->raster.srgb = true;
    output->raster.row = output->raster.bits == 16 ? fine_color_row
                         : transparent             ? transparent_color_row
                                                   : opaque_color_row;
}

static void set_ids(struct cli_output_raster *output, const uint32_t *ids)
{
    output->ids = ids;
    output->raster.row = id_row;
}

// White is the most there is.
static void set_heat(struct cli_output_raster *output, float most, const char *name)
{
    output->scale[0] = most > 0.0f ? 1.0f / most : 0.0f;
    snprintf(output->raster.comment, sizeof output->raster.comment, "%s: black is none, white is %.9g", name,
             (double)most);
}

static void set_overdraw(struct cli_output_raster *output, size_t pixels)
{
    float most = 0.0f;
    output->floats = output->pictures->overdraw;
    output->raster.row = overdraw_row;
    for (size_t i = 0; i < pixels; i++) {
        most = output->floats[i] > most ? output->floats[i] : most;
    }
    set_heat(output, most, "surfaces above each other");
}

static void set_tiles(struct cli_output_raster *output, size_t pixels)
{
    uint32_t most = 0;
    output->ids = output->pictures->tiles;
    output->raster.row = tile_row;
    for (size_t i = 0; i < pixels; i++) {
        most = output->ids[i] > most ? output->ids[i] : most;
    }
    set_heat(output, (float)most, "triangles of the tile");
}

static void set_plan(struct cli_output_raster *output)
{
    output->ids = output->pictures->plan;
    output->raster.row = tile_row;
    snprintf(output->raster.comment, sizeof output->raster.comment,
             "how tiles are drawn: blue in order, orange depth first, green backwards");
}

void cli_output_rasterize(struct cli_output_raster *output, const struct scene_pictures *pictures,
                          enum scene_output_kind kind, int bits, bool transparent, const float bounds_min[3],
                          const float bounds_max[3])
{
    static const float minus_one[3] = {-1, -1, -1}, zero[3] = {0, 0, 0}, one[3] = {1, 1, 1};
    *output = (struct cli_output_raster){.pictures = pictures};
    const size_t pixels = (size_t)pictures->width * (size_t)pictures->height;
    const bool grey = kind == SCENE_KIND_DEPTH || kind == SCENE_KIND_DISTANCE;
    output->raster = (struct cli_raster){.width = pictures->width,
                                         .height = pictures->height,
                                         .channels = 3,
                                         .bits = bits   ? bits
                                                 : grey ? 16
                                                        : 8,
                                         .user = output};
    switch (kind) {
    case SCENE_KIND_COLOR: set_color(output, transparent); break;
    case SCENE_KIND_DEPTH:
        output->floats = pictures->depth;
        set_grey(output, "NDC depth");
        break;
    case SCENE_KIND_DISTANCE:
        output->floats = pictures->distance;
        set_grey(output, "distance along the view");
        break;
    case SCENE_KIND_NORMAL: set_vector(output, pictures->normal, minus_one, one); break;
    case SCENE_KIND_POSITION: set_position(output, bounds_min, bounds_max); break;
    case SCENE_KIND_UV:
        output->floats = pictures->uv;
        output->raster.row = uv_row;
        break;
    case SCENE_KIND_OBJECT: set_ids(output, pictures->object); break;
    case SCENE_KIND_TRIANGLE: set_ids(output, pictures->triangle); break;
    case SCENE_KIND_OVERDRAW: set_overdraw(output, pixels); break;
    case SCENE_KIND_TILES: set_tiles(output, pixels); break;
    case SCENE_KIND_PLAN: set_plan(output); break;
    case SCENE_KIND_BARYCENTRIC: set_vector(output, pictures->barycentric, zero, one); break;
    default: break; // has no word
    }
}

// EXR -----------------------------------------------------------------------------------------------

// The positions in the coordinates of the file, as far as floats go. NULL without memory.
static float *make_positions(const struct scene_pictures *pictures)
{
    const size_t pixels = (size_t)pictures->width * (size_t)pictures->height;
    float *const positions = malloc(4 * pixels * sizeof *positions);
    for (size_t i = 0; i < pixels && positions; i++) {
        const float *const from = pictures->position + 4 * i;
        for (size_t c = 0; c < 4; c++) {
            const double moved = c < 3 && from[3] > 0.0f ? pictures->origin[c] : 0.0;
            positions[4 * i + c] = (float)((double)from[c] + moved);
        }
    }
    return positions;
}

static int add_channels(const char *const layer[4], enum scene_output_kind kind, const void *picture,
                        struct cli_exr_channel *channels)
{
    int count = 0;
    for (; count < 4 && layer[count]; count++) {
        channels[count] =
            (struct cli_exr_channel){.name = layer[count],
                                     .integer = scene_output_element(kind) == SCENE_ELEMENT_UINT32,
                                     .first = (const uint8_t *)picture + 4 * count,
                                     .pixel_stride = 4 * scene_output_channels(kind)};
    }
    return count;
}

int cli_outputs_exr_channels(const struct scene_pictures *pictures, unsigned kinds,
                             struct cli_exr_channel channels[CLI_EXR_CHANNELS_MAX], float **positions)
{
    static const char *const from_origin[4] = {"positionFromOrigin.X", "positionFromOrigin.Y",
                                               "positionFromOrigin.Z", NULL};
    int count = 0;
    *positions = NULL;
    if (kinds >> SCENE_KIND_POSITION & 1 && scene_origin_is_far(pictures->origin)) {
        *positions = make_positions(pictures);
        if (!*positions) {
            return 0;
        }
        count = add_channels(from_origin, SCENE_KIND_POSITION, pictures->position, channels);
    }
    for (int i = 0; i < CLI_OUTPUT_KINDS; i++) {
        // The colour of an EXR is light.
        const enum scene_output_kind kind =
            i == SCENE_KIND_COLOR ? SCENE_KIND_LINEAR : (enum scene_output_kind)i;
        const void *const picture =
            i == SCENE_KIND_POSITION && *positions ? *positions : scene_picture_get(pictures, kind);
        count +=
            kinds >> i & 1 ? add_channels(scene_outputs[kind].layer, kind, picture, channels + count) : 0;
    }
    return count;
}

// A node's, or where it has none its mesh's.
static const char *object_name(const struct scene_model *model, const struct scene_instance *instance)
{
    const bool is_named = instance->name && *instance->name;
    return is_named ? instance->name : model->meshes[instance->mesh].name;
}

bool cli_outputs_exr_describe(const struct scene_model *model, const struct scene_camera *camera,
                              double aspect, const double origin[3], struct cli_exr_about *about)
{
    double projection[16];
    uint32_t largest = 0;
    for (uint32_t i = 0; i < model->instance_count; i++) {
        largest = model->instances[i].object > largest ? model->instances[i].object : largest;
    }
    *about = (struct cli_exr_about){.has_camera = true,
                                    .object_count = (int)largest,
                                    .objects = calloc((size_t)largest + 1, sizeof *about->objects)};
    const struct scene_camera from_origin = scene_camera_from_origin(camera, origin);
    memcpy(about->origin, origin, sizeof about->origin);
    about->is_far = scene_origin_is_far(origin);
    scene_camera_projection(camera, aspect, projection);
    scene_camera_view(camera, about->world_to_camera);
    scene_matrix_multiply(projection, about->world_to_camera, about->world_to_ndc);
    scene_camera_view(&from_origin, about->origin_to_camera);
    scene_matrix_multiply(projection, about->origin_to_camera, about->origin_to_ndc);
    for (uint32_t i = 0; about->objects && i < model->instance_count; i++) {
        about->objects[model->instances[i].object - 1] = object_name(model, &model->instances[i]);
    }
    for (uint32_t i = 0; i < largest && about->objects; i++) {
        about->objects[i] = about->objects[i] ? about->objects[i] : ""; // of nodes that are left out
    }
    return about->objects != NULL;
}
