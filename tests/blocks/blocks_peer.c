// SPDX-License-Identifier: MIT
// Compressed formats against a second implementation: Mesa's decoders, through OpenGL ES and its driver softpipe
// (llvmpipe mixes BC1 to BC5 in code of its own, with rounder thirds). Random blocks go through both; a line for each
// format says how many channels of texels differ, and by how much at most, in steps of the format.
// usage: blocks_peer [ROUNDS]; exit status 77 where there is no peer.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "gles.h"
#include "random_block.h"

enum { BLOCKS = 64, SIDE = 12 * BLOCKS, CHANNELS = 4 }; // blocks each way; texels of the widest

// How the peer's floats become codes.
enum kind {
    UNORM8,  // bytes
    SRGB8,   // the same behind the sRGB transfer function
    LOWER8,  // bytes, where ours are fractions: it cuts them off
    LOWER_S, // the same of −127..127
    EAC_U,   // 0..2047
    EAC_S,   // −1023..1023
    HALF     // the very number
};

// Why a peer may differ by a step: it mixes colours that it has widened to 8 bits, and cuts off thirds and sevenths; it
// mixes an end of −128 as such, which counts as −127.
enum { CUT = 1, MIXES_128 = 1 };

struct pair {
    enum rhw_format format;
    GLenum peer;
    enum kind kind;
    int allowed; // steps: CUT, MIXES_128 or 0
    const char *extension;
};

static const char s3tc[] = "GL_EXT_texture_compression_s3tc",
                  s3tc_srgb[] = "GL_EXT_texture_compression_s3tc_srgb",
                  rgtc[] = "GL_EXT_texture_compression_rgtc", bptc[] = "GL_EXT_texture_compression_bptc",
                  astc[] = "GL_KHR_texture_compression_astc_ldr", core[] = "";

static const struct pair pairs[] = {
    {RHW_FORMAT_BC1_RGB_UNORM, 0x83f0, UNORM8, CUT, s3tc},
    {RHW_FORMAT_BC1_RGB_SRGB, 0x8c4c, SRGB8, CUT, s3tc_srgb},
    {RHW_FORMAT_BC1_RGBA_UNORM, 0x83f1, UNORM8, CUT, s3tc},
    {RHW_FORMAT_BC1_RGBA_SRGB, 0x8c4d, SRGB8, CUT, s3tc_srgb},
    {RHW_FORMAT_BC2_UNORM, 0x83f2, UNORM8, CUT, s3tc},
    {RHW_FORMAT_BC2_SRGB, 0x8c4e, SRGB8, CUT, s3tc_srgb},
    {RHW_FORMAT_BC3_UNORM, 0x83f3, UNORM8, CUT, s3tc},
    {RHW_FORMAT_BC3_SRGB, 0x8c4f, SRGB8, CUT, s3tc_srgb},
    {RHW_FORMAT_BC4_UNORM, 0x8dbb, LOWER8, 0, rgtc},
    {RHW_FORMAT_BC4_SNORM, 0x8dbc, LOWER_S, MIXES_128, rgtc},
    {RHW_FORMAT_BC5_UNORM, 0x8dbd, LOWER8, 0, rgtc},
    {RHW_FORMAT_BC5_SNORM, 0x8dbe, LOWER_S, MIXES_128, rgtc},
    {RHW_FORMAT_BC6H_UFLOAT, 0x8e8f, HALF, 0, bptc},
    {RHW_FORMAT_BC6H_SFLOAT, 0x8e8e, HALF, 0, bptc},
    {RHW_FORMAT_BC7_UNORM, 0x8e8c, UNORM8, 0, bptc},
    {RHW_FORMAT_BC7_SRGB, 0x8e8d, SRGB8, 0, bptc},
    {RHW_FORMAT_ETC2_RGB8_UNORM, GL_COMPRESSED_RGB8_ETC2, UNORM8, 0, core},
    {RHW_FORMAT_ETC2_RGB8_SRGB, GL_COMPRESSED_SRGB8_ETC2, SRGB8, 0, core},
    {RHW_FORMAT_ETC2_RGB8A1_UNORM, GL_COMPRESSED_RGB8_PUNCHTHROUGH_ALPHA1_ETC2, UNORM8, 0, core},
    {RHW_FORMAT_ETC2_RGB8A1_SRGB, GL_COMPRESSED_SRGB8_PUNCHTHROUGH_ALPHA1_ETC2, SRGB8, 0, core},
    {RHW_FORMAT_ETC2_RGBA8_UNORM, GL_COMPRESSED_RGBA8_ETC2_EAC, UNORM8, 0, core},
    {RHW_FORMAT_ETC2_RGBA8_SRGB, GL_COMPRESSED_SRGB8_ALPHA8_ETC2_EAC, SRGB8, 0, core},
    {RHW_FORMAT_EAC_R11_UNORM, GL_COMPRESSED_R11_EAC, EAC_U, 0, core},
    {RHW_FORMAT_EAC_R11_SNORM, GL_COMPRESSED_SIGNED_R11_EAC, EAC_S, 0, core},
    {RHW_FORMAT_EAC_RG11_UNORM, GL_COMPRESSED_RG11_EAC, EAC_U, 0, core},
    {RHW_FORMAT_EAC_RG11_SNORM, GL_COMPRESSED_SIGNED_RG11_EAC, EAC_S, 0, core},
    {RHW_FORMAT_ASTC_4X4_UNORM, 0x93b0, UNORM8, 0, astc},
    {RHW_FORMAT_ASTC_4X4_SRGB, 0x93d0, SRGB8, 0, astc},
    {RHW_FORMAT_ASTC_5X4_UNORM, 0x93b1, UNORM8, 0, astc},
    {RHW_FORMAT_ASTC_5X4_SRGB, 0x93d1, SRGB8, 0, astc},
    {RHW_FORMAT_ASTC_5X5_UNORM, 0x93b2, UNORM8, 0, astc},
    {RHW_FORMAT_ASTC_5X5_SRGB, 0x93d2, SRGB8, 0, astc},
    {RHW_FORMAT_ASTC_6X5_UNORM, 0x93b3, UNORM8, 0, astc},
    {RHW_FORMAT_ASTC_6X5_SRGB, 0x93d3, SRGB8, 0, astc},
    {RHW_FORMAT_ASTC_6X6_UNORM, 0x93b4, UNORM8, 0, astc},
    {RHW_FORMAT_ASTC_6X6_SRGB, 0x93d4, SRGB8, 0, astc},
    {RHW_FORMAT_ASTC_8X5_UNORM, 0x93b5, UNORM8, 0, astc},
    {RHW_FORMAT_ASTC_8X5_SRGB, 0x93d5, SRGB8, 0, astc},
    {RHW_FORMAT_ASTC_8X6_UNORM, 0x93b6, UNORM8, 0, astc},
    {RHW_FORMAT_ASTC_8X6_SRGB, 0x93d6, SRGB8, 0, astc},
    {RHW_FORMAT_ASTC_8X8_UNORM, 0x93b7, UNORM8, 0, astc},
    {RHW_FORMAT_ASTC_8X8_SRGB, 0x93d7, SRGB8, 0, astc},
    {RHW_FORMAT_ASTC_10X5_UNORM, 0x93b8, UNORM8, 0, astc},
    {RHW_FORMAT_ASTC_10X5_SRGB, 0x93d8, SRGB8, 0, astc},
    {RHW_FORMAT_ASTC_10X6_UNORM, 0x93b9, UNORM8, 0, astc},
    {RHW_FORMAT_ASTC_10X6_SRGB, 0x93d9, SRGB8, 0, astc},
    {RHW_FORMAT_ASTC_10X8_UNORM, 0x93ba, UNORM8, 0, astc},
    {RHW_FORMAT_ASTC_10X8_SRGB, 0x93da, SRGB8, 0, astc},
    {RHW_FORMAT_ASTC_10X10_UNORM, 0x93bb, UNORM8, 0, astc},
    {RHW_FORMAT_ASTC_10X10_SRGB, 0x93db, SRGB8, 0, astc},
    {RHW_FORMAT_ASTC_12X10_UNORM, 0x93bc, UNORM8, 0, astc},
    {RHW_FORMAT_ASTC_12X10_SRGB, 0x93dc, SRGB8, 0, astc},
    {RHW_FORMAT_ASTC_12X12_UNORM, 0x93bd, UNORM8, 0, astc},
    {RHW_FORMAT_ASTC_12X12_SRGB, 0x93dd, SRGB8, 0, astc},
};
enum { PAIRS = sizeof pairs / sizeof pairs[0] };
_Static_assert(PAIRS == RHW_FORMAT_ASTC_12X12_SRGB - RHW_FORMAT_BC1_RGB_UNORM + 1, "every compressed format");

static struct {
    struct gles gl;
    const char *extensions;
    rhw_context *context;
    unsigned char blocks[BLOCKS * BLOCKS * 16];
    float theirs[SIDE * SIDE][CHANNELS], ours[SIDE * SIDE][CHANNELS];
    unsigned char read[SIDE * SIDE * 16];
} all;

static bool open_peer(const char **why)
{
    const struct gles *const gl = &all.gl;
    if (!gles_open(&all.gl, "softpipe", why)) {
        return false;
    }
    all.extensions = (const char *)gl->get_string(GL_EXTENSIONS);
    const char *const vertex =
        "#version 300 es\nvoid main() { gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - "
        "1.0, 0, 1); }";
    const char *const fragment =
        "#version 300 es\nprecision highp float; uniform highp sampler2D blocks; out vec4 texel;\n"
        "void main() { texel = texelFetch(blocks, ivec2(gl_FragCoord.xy), 0); }";
    const GLuint program = gles_program(gl, &vertex, &fragment, 1, NULL, 0);
    gl->use_program(program);
    GLuint framebuffer, target;
    gl->gen_framebuffers(1, &framebuffer);
    gl->bind_framebuffer(GL_FRAMEBUFFER, framebuffer);
    gl->gen_renderbuffers(1, &target);
    gl->bind_renderbuffer(GL_RENDERBUFFER, target);
    gl->renderbuffer_storage(GL_RENDERBUFFER, GL_RGBA32F, SIDE, SIDE);
    gl->framebuffer_renderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, target);
    *why = "it lacks float targets";
    return program != 0 && gl->check_framebuffer_status(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
}

static bool decode_there(const struct pair *pair, int width, int height, size_t size)
{
    const struct gles *const gl = &all.gl;
    GLuint texture;
    gl->gen_textures(1, &texture);
    gl->bind_texture(GL_TEXTURE_2D, texture);
    gl->tex_parameter_i(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl->tex_parameter_i(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl->compressed_tex_image_2d(GL_TEXTURE_2D, 0, pair->peer, width, height, 0, (GLsizei)size, all.blocks);
    gl->viewport(0, 0, SIDE, SIDE);
    gl->draw_arrays(GL_TRIANGLES, 0, 3);
    gl->read_pixels(0, 0, width, height, GL_RGBA, GL_FLOAT, all.theirs);
    gl->delete_textures(1, &texture);
    return gl->get_error() == GL_NO_ERROR;
}

static float half_value(const unsigned char *bytes)
{
    const int bits = bytes[0] | bytes[1] << 8, exponent = bits >> 10 & 31, mantissa = bits & 0x3ff;
    const double size = exponent == 31  ? (double)INFINITY
                        : exponent == 0 ? ldexp(mantissa, -24)
                                        : ldexp(1024 + mantissa, exponent - 25);
    return (float)(bits & 0x8000 ? -size : size);
}

static bool decode_here(const struct pair *pair, int width, int height)
{
    const struct rhw_texture_def def = {.format = pair->format, .width = width, .height = height};
    rhw_texture texture;
    const bool done = rhw_texture_create(all.context, &def, &texture) == RHW_OK &&
                      rhw_texture_write(all.context, texture, 0, all.blocks, 0) == RHW_OK &&
                      rhw_texture_read(all.context, texture, 0, all.read, 0) == RHW_OK;
    rhw_texture_destroy(all.context, texture);
    const enum rhw_format decoded = rhw_format_decoded(pair->format);
    for (int i = 0; i < width * height; i++) {
        const unsigned char *const texel = all.read + rhw_format_size(decoded) * (size_t)i;
        float *const value = all.ours[i];
        value[1] = value[2] = 0;
        value[3] = 1;
        for (int c = 0; c < CHANNELS; c++) {
            if (decoded == RHW_FORMAT_RGBA16_FLOAT) {
                value[c] = half_value(texel + 2 * c);
            } else if (decoded == RHW_FORMAT_RGBA8_UNORM || decoded == RHW_FORMAT_RGBA8_SRGB) {
                value[c] = texel[c];
            }
        }
        if (decoded == RHW_FORMAT_R32_FLOAT || decoded == RHW_FORMAT_RGBA32_FLOAT) {
            memcpy(value, texel, rhw_format_size(decoded));
        }
    }
    return done;
}

static double srgb_code(double linear)
{
    return round(255 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1 / 2.4) - 0.055));
}

// The distance of two values in steps of the format.
static double distance(enum kind kind, int channel, double ours, double theirs)
{
    const double little = 1e-3; // of a step: what is lost in floats
    switch (kind) {
    case UNORM8: return fabs(ours - round(255 * theirs));
    case SRGB8: return fabs(ours - (channel < 3 ? srgb_code(theirs) : round(255 * theirs)));
    case LOWER8: return fabs(floor(255 * ours + little) - round(255 * theirs));
    case LOWER_S: return fabs(trunc(127 * ours + copysign(little, ours)) - round(127 * theirs));
    case EAC_U: return fabs(round(2047 * ours) - round(2047 * theirs));
    case EAC_S: return fabs(round(1023 * ours) - round(1023 * theirs));
    default: return ours == theirs ? 0 : INFINITY;
    }
}

// Prints what differs first.
static void show(const struct pair *pair, int width, int texel)
{
    const int block_width = rhw_format_block_width(pair->format),
              columns = (width + block_width - 1) / block_width;
    const int x = texel % width, y = texel / width;
    const size_t bytes = rhw_format_block_bytes(pair->format);
    const int block = y / rhw_format_block_height(pair->format) * columns + x / block_width;
    printf("  texel %d, %d: here %g %g %g %g, there %g %g %g %g; block", x, y, (double)all.ours[texel][0],
           (double)all.ours[texel][1], (double)all.ours[texel][2], (double)all.ours[texel][3],
           (double)all.theirs[texel][0], (double)all.theirs[texel][1], (double)all.theirs[texel][2],
           (double)all.theirs[texel][3]);
    for (size_t i = 0; i < bytes; i++) {
        printf(" %02x", all.blocks[(size_t)block * bytes + i]);
    }
    printf("\n");
}

static bool compare(const struct pair *pair, int rounds)
{
    const int width = BLOCKS * rhw_format_block_width(pair->format) - 1;
    const int height = BLOCKS * rhw_format_block_height(pair->format) - 3;
    const size_t bytes = rhw_format_block_bytes(pair->format), size = bytes * BLOCKS * BLOCKS;
    uint64_t state = (uint64_t)(pair->format - RHW_FORMAT_BC1_RGB_UNORM);
    long differing = 0, texels = 0;
    double most = 0;
    for (int round = 0; round < rounds; round++) {
        for (size_t at = 0; at < size; at += bytes) {
            random_block(pair->format, &state, all.blocks + at);
        }
        if (!decode_here(pair, width, height) || !decode_there(pair, width, height, size)) {
            printf("0x%04x: not decoded\n", pair->peer);
            return false;
        }
        for (int i = 0; i < width * height; i++, texels++) {
            for (int c = 0; c < CHANNELS; c++) {
                const double d = distance(pair->kind, c, (double)all.ours[i][c], (double)all.theirs[i][c]);
                if (d > pair->allowed && !(most > pair->allowed)) {
                    show(pair, width, i);
                }
                differing += d != 0;
                most = fmax(most, d);
            }
        }
    }
    printf("0x%04x: %ld texels, %ld channels differ, by %g at most (%d allowed)\n", pair->peer, texels,
           differing, most, pair->allowed);
    return most <= pair->allowed;
}

int main(int argument_count, char **arguments)
{
    const int rounds = argument_count > 1 ? atoi(arguments[1]) : 1;
    const struct rhw_context_def def = {.threads = 2};
    const char *why;
    if (!open_peer(&why)) {
        printf("no peer: %s\n", why);
        return 77;
    }
    if (rhw_context_create(&def, &all.context) != RHW_OK) {
        return 1;
    }
    int failed = 0;
    for (int i = 0; i < PAIRS; i++) {
        if (strstr(all.extensions, pairs[i].extension)) {
            failed += !compare(&pairs[i], rounds);
        } else {
            printf("0x%04x: the peer lacks %s\n", pairs[i].peer, pairs[i].extension);
        }
    }
    rhw_context_destroy(all.context);
    gles_close(&all.gl);
    return failed != 0;
}
