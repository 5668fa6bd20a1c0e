// SPDX-License-Identifier: MIT
// Draws a frame with OpenGL ES.
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "peer_program.h"
#include "peer_state.h"
#include "renderers.h"
#include "texel_pair.h"

struct peer {
    struct gles gl;
    struct peer_functions more;
    struct peer_programs programs;
    // --- of the frame that is drawn
    GLuint targets[FRAME_TARGETS], depth, textures[FRAME_TEXTURES], framebuffers[2], samples[FRAME_TARGETS];
    GLuint buffers[4], queries[FRAME_DRAWS], image;
};

static unsigned char texels[FRAME_SIDE * FRAME_SIDE * 16];

static GLenum texture_target(const struct rhw_texture_def *def)
{
    switch (def->kind) {
    case RHW_TEXTURE_3D: return GL_TEXTURE_3D;
    case RHW_TEXTURE_CUBE: return def->layers > 0 ? GL_TEXTURE_CUBE_MAP_ARRAY : GL_TEXTURE_CUBE_MAP;
    default: return def->layers > 0 ? GL_TEXTURE_2D_ARRAY : GL_TEXTURE_2D;
    }
}

static int least_one(int size)
{
    return size > 0 ? size : 1;
}

static void write_layer(const struct peer *p, GLenum target, const struct frame_texture *from, int level,
                        int layer)
{
    const struct texel_pair *const pair = texel_pair_find(from->def.format);
    const int width = least_one(from->def.width >> level), height = least_one(from->def.height >> level);
    frame_texels(from, level, layer, texels);
    if (pair->external == 0) {
        const int wide = rhw_format_block_width(pair->format), high = rhw_format_block_height(pair->format);
        const size_t blocks = (size_t)((width + wide - 1) / wide) * (size_t)((height + high - 1) / high);
        p->more.compressed_tex_sub_image_2d(target, level, 0, 0, width, height, pair->internal,
                                            (GLsizei)(blocks * rhw_format_block_bytes(pair->format)), texels);
    } else if (target == GL_TEXTURE_2D || target == GL_TEXTURE_CUBE_MAP) {
        const GLenum face = target == GL_TEXTURE_2D ? target : GL_TEXTURE_CUBE_MAP_POSITIVE_X + (GLenum)layer;
        p->gl.tex_sub_image_2d(face, level, 0, 0, width, height, pair->external, pair->type, texels);
    } else {
        p->more.tex_sub_image_3d(target, level, 0, 0, layer, width, height, 1, pair->external, pair->type,
                                 texels);
    }
}

static void make_texture(struct peer *p, const struct frame_texture *from, int i)
{
    const struct rhw_texture_def *const def = &from->def;
    const GLenum target = texture_target(def), internal = texel_pair_find(def->format)->internal;
    const int faces = def->kind == RHW_TEXTURE_CUBE ? 6 : 1;
    const int layers = faces * least_one(def->layers), levels = least_one(def->mip_levels);
    p->gl.gen_textures(1, &p->textures[i]);
    p->gl.active_texture(GL_TEXTURE0 + (GLenum)i);
    p->gl.bind_texture(target, p->textures[i]);
    if (target == GL_TEXTURE_2D || target == GL_TEXTURE_CUBE_MAP) {
        p->gl.tex_storage_2d(target, levels, internal, def->width, def->height);
    } else {
        p->more.tex_storage_3d(target, levels, internal, def->width, def->height,
                               target == GL_TEXTURE_3D ? def->depth : layers);
    }
    for (int level = 0; level < levels; level++) {
        const int slices = target == GL_TEXTURE_3D ? least_one(def->depth >> level) : layers;
        for (int layer = 0; layer < slices; layer++) {
            write_layer(p, target, from, level, layer);
        }
    }
    peer_state_set_sampler(&p->gl, &p->more, target, &from->sampler);
}

// Framebuffer 0 has textures of one sample, framebuffer 1 renderbuffers of several.
static void make_targets(struct peer *p, const struct frame *f)
{
    GLenum attachments[FRAME_TARGETS];
    const GLenum depth_point =
        f->depth_format == RHW_FORMAT_D24_UNORM_S8_UINT || f->depth_format == RHW_FORMAT_D32_FLOAT_S8_UINT
            ? GL_DEPTH_STENCIL_ATTACHMENT
            : GL_DEPTH_ATTACHMENT;
    p->gl.gen_framebuffers(2, p->framebuffers);
    p->gl.gen_textures(f->target_count, p->targets);
    p->gl.gen_renderbuffers(f->target_count, p->samples);
    for (int side = 0; side < 2; side++) {
        p->gl.bind_framebuffer(GL_FRAMEBUFFER, p->framebuffers[side]);
        for (int i = 0; i < f->target_count; i++) {
            const GLenum internal = texel_pair_find(f->formats[i])->internal;
            attachments[i] = GL_COLOR_ATTACHMENT0 + (GLenum)i;
            if (side == 0) {
                p->gl.bind_texture(GL_TEXTURE_2D, p->targets[i]);
                p->gl.tex_storage_2d(GL_TEXTURE_2D, 1, internal, f->width, f->height);
                p->gl.framebuffer_texture_2d(GL_FRAMEBUFFER, attachments[i], GL_TEXTURE_2D, p->targets[i], 0);
            } else if (f->samples > 1) {
                p->gl.bind_renderbuffer(GL_RENDERBUFFER, p->samples[i]);
                p->gl.renderbuffer_storage_multisample(GL_RENDERBUFFER, f->samples, internal, f->width,
                                                       f->height);
                p->gl.framebuffer_renderbuffer(GL_FRAMEBUFFER, attachments[i], GL_RENDERBUFFER,
                                               p->samples[i]);
            }
        }
        p->gl.draw_buffers(f->target_count, attachments);
    }
    p->gl.bind_framebuffer(GL_FRAMEBUFFER, p->framebuffers[f->samples > 1]);
    if (f->depth_format != RHW_FORMAT_NONE) {
        p->gl.gen_renderbuffers(1, &p->depth);
        p->gl.bind_renderbuffer(GL_RENDERBUFFER, p->depth);
        p->gl.renderbuffer_storage_multisample(GL_RENDERBUFFER, f->samples > 1 ? f->samples : 0,
                                               texel_pair_find(f->depth_format)->internal, f->width,
                                               f->height);
        p->gl.framebuffer_renderbuffer(GL_FRAMEBUFFER, depth_point, GL_RENDERBUFFER, p->depth);
    }
}

static void make_image(struct peer *p)
{
    static const GLuint zeros[FRAME_NUMBERS];
    p->gl.gen_textures(1, &p->image);
    p->gl.active_texture(GL_TEXTURE0 + FRAME_TEXTURES);
    p->gl.bind_texture(GL_TEXTURE_2D, p->image);
    p->gl.tex_storage_2d(GL_TEXTURE_2D, 1, GL_R32UI, FRAME_IMAGE_SIDE, FRAME_IMAGE_SIDE);
    p->gl.tex_sub_image_2d(GL_TEXTURE_2D, 0, 0, 0, FRAME_IMAGE_SIDE, FRAME_IMAGE_SIDE, GL_RED_INTEGER,
                           GL_UNSIGNED_INT, zeros);
    p->more.bind_image_texture(0, p->image, 0, GL_FALSE, 0, GL_READ_WRITE, GL_R32UI);
}

static void make_buffers(struct peer *p, const struct frame *f)
{
    enum { VERTICES, INSTANCES, INDICES, NUMBERS };
    static const GLuint zeros[FRAME_NUMBERS];
    p->gl.gen_buffers(4, p->buffers);
    p->gl.bind_buffer(GL_ARRAY_BUFFER, p->buffers[VERTICES]);
    p->gl.buffer_data(GL_ARRAY_BUFFER, (GLsizeiptr)((size_t)f->vertex_count * sizeof *f->vertices),
                      f->vertices, GL_STATIC_DRAW);
    const GLsizei stride = sizeof *f->vertices;
    p->gl.vertex_attrib_pointer(0, 4, GL_FLOAT, GL_FALSE, stride,
                                (const void *)offsetof(struct frame_vertex, position));
    p->gl.vertex_attrib_pointer(1, 4, GL_FLOAT, GL_FALSE, stride,
                                (const void *)offsetof(struct frame_vertex, value));
    p->gl.bind_buffer(GL_ARRAY_BUFFER, p->buffers[INSTANCES]);
    p->gl.buffer_data(GL_ARRAY_BUFFER, sizeof f->instances, f->instances, GL_STATIC_DRAW);
    p->gl.vertex_attrib_pointer(2, 4, GL_FLOAT, GL_FALSE, 0, NULL);
    for (GLuint i = 0; i < 3; i++) {
        p->gl.enable_vertex_attrib_array(i);
    }
    p->gl.bind_buffer(GL_ELEMENT_ARRAY_BUFFER, p->buffers[INDICES]);
    p->gl.buffer_data(GL_ELEMENT_ARRAY_BUFFER, sizeof f->indices, f->indices, GL_STATIC_DRAW);
    const GLenum kind = f->extra == FRAME_FEEDBACK ? GL_TRANSFORM_FEEDBACK_BUFFER : GL_SHADER_STORAGE_BUFFER;
    p->gl.bind_buffer(kind, p->buffers[NUMBERS]);
    p->gl.buffer_data(kind, sizeof zeros, zeros, GL_DYNAMIC_READ);
    p->more.bind_buffer_base(kind, 0, p->buffers[NUMBERS]);
    if (f->extra == FRAME_OCCLUSION) {
        p->more.gen_queries(f->draw_count, p->queries);
    }
}

static void clear(const struct peer *p, const struct frame *f)
{
    p->gl.disable(GL_SCISSOR_TEST);
    p->gl.disable(GL_DITHER);
    p->more.depth_mask(GL_TRUE);
    p->more.stencil_mask_separate(GL_FRONT_AND_BACK, 255);
    for (int i = 0; i < f->target_count; i++) {
        const enum texel_kind kind = texel_pair_find(f->formats[i])->kind;
        p->more.color_mask_i((GLuint)i, GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
        if (kind == TEXEL_SIGNED) {
            p->more.clear_buffer_iv(GL_COLOR, i, f->clear_integer[i]);
        } else if (kind == TEXEL_UNSIGNED) {
            p->more.clear_buffer_uiv(GL_COLOR, i, (const GLuint *)f->clear_integer[i]);
        } else {
            p->more.clear_buffer_fv(GL_COLOR, i, f->clear[i]);
        }
    }
    p->more.clear_buffer_fi(GL_DEPTH_STENCIL, 0, f->depth_clear, f->stencil_clear);
}

static void draw_one(struct peer *p, const struct frame *f, int index)
{
    const struct frame_draw *const d = &f->draws[index];
    const GLuint program = peer_program_find(&p->gl, &p->more, &p->programs, d->shaders);
    const GLenum topology = peer_state_topology(d->state.topology);
    static const char *const names[FRAME_TEXTURES] = {"texture0", "texture1"};
    p->gl.use_program(program);
    p->gl.uniform_4fv(p->gl.get_uniform_location(program, "uniforms"), FRAME_UNIFORMS, d->uniforms[0]);
    for (int i = 0; i < f->texture_count; i++) {
        p->gl.uniform_1i(p->gl.get_uniform_location(program, names[i]), i);
    }
    if (f->extra == FRAME_IMAGE) {
        p->more.memory_barrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT); // what draws before this one stored
    }
    p->more.vertex_attrib_divisor(2, (GLuint)least_one(d->instance_step));
    peer_state_set(&p->gl, &p->more, f, d);
    if (f->extra == FRAME_OCCLUSION) {
        p->more.begin_query(GL_ANY_SAMPLES_PASSED, p->queries[index]);
    }
    if (f->extra == FRAME_FEEDBACK && index == 0) {
        p->more.begin_transform_feedback(GL_TRIANGLES);
    }
    if (d->indexed) {
        p->more.draw_elements_instanced(topology, d->count, GL_UNSIGNED_SHORT,
                                        (const void *)((size_t)d->first * sizeof *f->indices), d->instances);
    } else {
        p->more.draw_arrays_instanced(topology, d->first, d->count, d->instances);
    }
    if (f->extra == FRAME_FEEDBACK && index == 0) {
        p->more.end_transform_feedback();
    }
    if (f->extra == FRAME_OCCLUSION) {
        p->more.end_query(GL_ANY_SAMPLES_PASSED);
    }
}

// What draws do not reach.
static void leave_out(const struct peer *p, const struct frame *f)
{
    GLenum attachments[FRAME_TARGETS];
    for (int i = 0; i < f->target_count; i++) {
        attachments[i] = f->left_out >> i & 1 ? GL_NONE : GL_COLOR_ATTACHMENT0 + (GLenum)i;
    }
    p->gl.draw_buffers(f->target_count, attachments);
}

// Samples become texels, and regions others.
static void finish(const struct peer *p, const struct frame *f)
{
    const int *const a = f->blit_from, *const b = f->blit_to;
    p->gl.disable(GL_SCISSOR_TEST);
    for (int i = 0; f->samples > 1 && i < f->target_count; i++) {
        const GLenum attachment = GL_COLOR_ATTACHMENT0 + (GLenum)i;
        GLenum attachments[FRAME_TARGETS] = {GL_NONE, GL_NONE, GL_NONE, GL_NONE};
        attachments[i] = attachment;
        p->gl.bind_framebuffer(GL_READ_FRAMEBUFFER, p->framebuffers[1]);
        p->gl.read_buffer(attachment);
        p->gl.bind_framebuffer(GL_DRAW_FRAMEBUFFER, p->framebuffers[0]);
        p->gl.draw_buffers(f->target_count, attachments);
        p->gl.blit_framebuffer(0, 0, f->width, f->height, 0, 0, f->width, f->height, GL_COLOR_BUFFER_BIT,
                               GL_NEAREST);
    }
    p->gl.bind_framebuffer(GL_FRAMEBUFFER, p->framebuffers[0]);
    if (f->extra == FRAME_BLIT) {
        static const GLenum second[] = {GL_NONE, GL_COLOR_ATTACHMENT1};
        p->gl.read_buffer(GL_COLOR_ATTACHMENT0);
        p->gl.draw_buffers(2, second);
        p->gl.blit_framebuffer(a[0], a[1], a[2], a[3], b[0], b[1], b[2], b[3], GL_COLOR_BUFFER_BIT,
                               f->blit_filter == RHW_FILTER_LINEAR ? GL_LINEAR : GL_NEAREST);
    }
}

static void read_target(const struct peer *p, const struct frame *f, int target, double (*values)[4])
{
    const struct texel_pair *const pair = texel_pair_find(f->formats[target]);
    const bool is_integer = pair->kind == TEXEL_SIGNED || pair->kind == TEXEL_UNSIGNED;
    const GLenum type = pair->kind == TEXEL_SIGNED     ? GL_INT
                        : pair->kind == TEXEL_UNSIGNED ? GL_UNSIGNED_INT
                        : pair->kind == TEXEL_PACKED   ? GL_UNSIGNED_INT_2_10_10_10_REV
                        : pair->kind == TEXEL_BYTES    ? GL_UNSIGNED_BYTE
                                                       : GL_FLOAT;
    p->gl.read_buffer(GL_COLOR_ATTACHMENT0 + (GLenum)target);
    p->gl.read_pixels(0, 0, f->width, f->height, is_integer ? GL_RGBA_INTEGER : GL_RGBA, type, texels);
    for (int at = 0; at < f->width * f->height; at++) {
        uint32_t words[4];
        float numbers[4];
        memcpy(words, texels + (type == GL_UNSIGNED_INT_2_10_10_10_REV ? 4 : 16) * (size_t)at, sizeof words);
        memcpy(numbers, words, sizeof words);
        for (int c = 0; c < pair->channels; c++) {
            values[at][c] = type == GL_INT             ? (double)(int32_t)words[c]
                            : type == GL_UNSIGNED_INT  ? (double)words[c]
                            : type == GL_UNSIGNED_BYTE ? texels[4 * at + c]
                            : type == GL_UNSIGNED_INT_2_10_10_10_REV
                                ? (c == 3 ? words[0] >> 30 : words[0] >> 10 * c & 1023)
                                : (double)numbers[c];
        }
    }
}

static void read_image(const struct peer *p, double *numbers)
{
    static GLuint words[FRAME_NUMBERS][4];
    p->more.memory_barrier(GL_ALL_BARRIER_BITS);
    p->gl.bind_framebuffer(GL_FRAMEBUFFER, p->framebuffers[1]);
    p->gl.framebuffer_texture_2d(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, p->image, 0);
    p->gl.read_buffer(GL_COLOR_ATTACHMENT0);
    p->gl.read_pixels(0, 0, FRAME_IMAGE_SIDE, FRAME_IMAGE_SIDE, GL_RGBA_INTEGER, GL_UNSIGNED_INT, words);
    for (int i = 0; i < FRAME_NUMBERS; i++) {
        numbers[i] = (double)words[i][0];
    }
}

static void read_numbers(const struct peer *p, const struct frame *f, double *numbers)
{
    if (f->extra == FRAME_OCCLUSION) {
        for (int i = 0; i < f->draw_count; i++) {
            GLuint passed = 0;
            p->more.get_query_object_uiv(p->queries[i], GL_QUERY_RESULT, &passed);
            numbers[i] = passed != 0;
        }
        p->more.delete_queries(f->draw_count, p->queries);
        return;
    }
    if (f->extra == FRAME_IMAGE) {
        read_image(p, numbers);
        return;
    }
    const GLenum kind = f->extra == FRAME_FEEDBACK ? GL_TRANSFORM_FEEDBACK_BUFFER : GL_SHADER_STORAGE_BUFFER;
    p->more.memory_barrier(GL_ALL_BARRIER_BITS);
    const void *const words =
        p->more.map_buffer_range(kind, 0, FRAME_NUMBERS * (GLsizeiptr)sizeof(GLuint), GL_MAP_READ_BIT);
    for (int i = 0; words && i < FRAME_NUMBERS; i++) {
        uint32_t word;
        float number;
        memcpy(&word, (const unsigned char *)words + sizeof word * (size_t)i, sizeof word);
        memcpy(&number, &word, sizeof number);
        numbers[i] = f->extra != FRAME_FEEDBACK ? (double)word
                     : i % 8 == 1               ? (double)-number // y is turned
                                                : (double)number;
    }
    p->more.unmap_buffer(kind);
}

static void release(struct peer *p, const struct frame *f)
{
    p->gl.delete_framebuffers(2, p->framebuffers);
    p->gl.delete_textures(f->target_count, p->targets);
    p->gl.delete_textures(f->texture_count, p->textures);
    p->gl.delete_renderbuffers(f->target_count, p->samples);
    p->gl.delete_renderbuffers(1, &p->depth);
    p->gl.delete_textures(1, &p->image);
    p->image = 0;
    p->gl.delete_buffers(4, p->buffers);
    p->depth = 0;
}

struct peer *peer_open(const char *driver, const char **why)
{
    struct peer *const p = calloc(1, sizeof *p);
    *why = "out of memory";
    if (!p || !gles_open(&p->gl, driver, why)) {
        free(p);
        return NULL;
    }
    if (strstr(p->gl.name, "OpenGL ES 3.2") && peer_functions_find(&p->gl, &p->more)) {
        p->more.pixel_store_i(GL_UNPACK_ALIGNMENT, 1);
        return p;
    }
    *why = "it lacks OpenGL ES 3.2";
    peer_close(p);
    return NULL;
}

void peer_close(struct peer *p)
{
    gles_close(&p->gl);
    free(p);
}

const char *peer_name(const struct peer *p)
{
    return p->gl.name;
}

const char *peer_lacks(const struct peer *p, const struct frame *f)
{
    enum { MOST = 16 };
    GLint counts[MOST] = {0};
    bool has_samples = f->samples <= 1;
    p->more.get_internal_format_iv(GL_RENDERBUFFER, texel_pair_find(f->formats[0])->internal, GL_SAMPLES,
                                   MOST, counts);
    for (int i = 0; i < MOST; i++) {
        has_samples = has_samples || counts[i] == f->samples;
    }
    const char *const extensions = (const char *)p->gl.get_string(GL_EXTENSIONS);
    for (int i = 0; i < f->texture_count; i++) {
        if (f->textures[i].sampler.max_anisotropy > 1 &&
            !(extensions && strstr(extensions, "GL_EXT_texture_filter_anisotropic"))) {
            return "the peer has no anisotropic filter";
        }
    }
    return has_samples ? NULL : "the peer has no such number of samples";
}

bool draw_there(struct peer *p, const struct frame *f, struct drawn *drawn)
{
    make_targets(p, f);
    for (int i = 0; i < f->texture_count; i++) {
        make_texture(p, &f->textures[i], i);
    }
    make_buffers(p, f);
    if (f->extra == FRAME_IMAGE) {
        make_image(p);
    }
    const GLenum status = p->gl.check_framebuffer_status(GL_FRAMEBUFFER);
    if (status == GL_FRAMEBUFFER_COMPLETE) {
        clear(p, f);
        leave_out(p, f);
        for (int i = 0; i < f->draw_count; i++) {
            draw_one(p, f, i);
        }
        finish(p, f);
        for (int i = 0; i < f->target_count; i++) {
            read_target(p, f, i, drawn->targets[i]);
        }
        read_numbers(p, f, drawn->numbers);
    }
    release(p, f);
    const GLenum error = p->gl.get_error();
    if (error != GL_NO_ERROR || status != GL_FRAMEBUFFER_COMPLETE) {
        fprintf(stderr, "OpenGL ES: error 0x%x, framebuffer 0x%x\n", error, status);
        return false;
    }
    return true;
}
