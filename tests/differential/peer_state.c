// SPDX-License-Identifier: MIT
// See peer_state.h. y is turned, so the front has the opposite winding.
#include "peer_state.h"

#include <GLES2/gl2ext.h>

static const GLenum compares[] = {
    [RHW_COMPARE_LESS] = GL_LESS,
    [RHW_COMPARE_NEVER] = GL_NEVER,
    [RHW_COMPARE_EQUAL] = GL_EQUAL,
    [RHW_COMPARE_LESS_EQUAL] = GL_LEQUAL,
    [RHW_COMPARE_GREATER] = GL_GREATER,
    [RHW_COMPARE_NOT_EQUAL] = GL_NOTEQUAL,
    [RHW_COMPARE_GREATER_EQUAL] = GL_GEQUAL,
    [RHW_COMPARE_ALWAYS] = GL_ALWAYS,
};

static const GLenum stencil_operations[] = {
    [RHW_STENCIL_KEEP] = GL_KEEP,
    [RHW_STENCIL_ZERO] = GL_ZERO,
    [RHW_STENCIL_REPLACE] = GL_REPLACE,
    [RHW_STENCIL_INCREMENT_CLAMP] = GL_INCR,
    [RHW_STENCIL_DECREMENT_CLAMP] = GL_DECR,
    [RHW_STENCIL_INVERT] = GL_INVERT,
    [RHW_STENCIL_INCREMENT_WRAP] = GL_INCR_WRAP,
    [RHW_STENCIL_DECREMENT_WRAP] = GL_DECR_WRAP,
};

static const GLenum blend_factors[] = {
    [RHW_BLEND_ZERO] = GL_ZERO,
    [RHW_BLEND_ONE] = GL_ONE,
    [RHW_BLEND_SRC] = GL_SRC_COLOR,
    [RHW_BLEND_ONE_MINUS_SRC] = GL_ONE_MINUS_SRC_COLOR,
    [RHW_BLEND_SRC_ALPHA] = GL_SRC_ALPHA,
    [RHW_BLEND_ONE_MINUS_SRC_ALPHA] = GL_ONE_MINUS_SRC_ALPHA,
    [RHW_BLEND_DST] = GL_DST_COLOR,
    [RHW_BLEND_ONE_MINUS_DST] = GL_ONE_MINUS_DST_COLOR,
    [RHW_BLEND_DST_ALPHA] = GL_DST_ALPHA,
    [RHW_BLEND_ONE_MINUS_DST_ALPHA] = GL_ONE_MINUS_DST_ALPHA,
    [RHW_BLEND_SRC_ALPHA_SATURATED] = GL_SRC_ALPHA_SATURATE,
    [RHW_BLEND_CONSTANT] = GL_CONSTANT_COLOR,
    [RHW_BLEND_ONE_MINUS_CONSTANT] = GL_ONE_MINUS_CONSTANT_COLOR,
    [RHW_BLEND_CONSTANT_ALPHA] = GL_CONSTANT_ALPHA,
    [RHW_BLEND_ONE_MINUS_CONSTANT_ALPHA] = GL_ONE_MINUS_CONSTANT_ALPHA,
};

static const GLenum equations[] = {
    [RHW_BLEND_ADD] = GL_FUNC_ADD,
    [RHW_BLEND_SUBTRACT] = GL_FUNC_SUBTRACT,
    [RHW_BLEND_REVERSE_SUBTRACT] = GL_FUNC_REVERSE_SUBTRACT,
    [RHW_BLEND_MIN] = GL_MIN,
    [RHW_BLEND_MAX] = GL_MAX,
};

static void enable(const struct gles *gl, GLenum what, bool on)
{
    (on ? gl->enable : gl->disable)(what);
}

static GLenum source_factor(enum rhw_blend_factor factor)
{
    return factor == RHW_BLEND_DEFAULT ? GL_ONE : blend_factors[factor];
}

static GLenum target_factor(enum rhw_blend_factor factor)
{
    return factor == RHW_BLEND_DEFAULT ? GL_ZERO : blend_factors[factor];
}

static void set_blend(const struct peer_functions *more, GLuint index, const struct rhw_color_target *t)
{
    const unsigned mask = t->write_mask == 0 ? 15u : t->write_mask;
    more->color_mask_i(index, (mask & RHW_WRITE_RED) != 0, (mask & RHW_WRITE_GREEN) != 0,
                       (mask & RHW_WRITE_BLUE) != 0, (mask & RHW_WRITE_ALPHA) != 0);
    (t->blend ? more->enable_i : more->disable_i)(GL_BLEND, index);
    more->blend_equation_separate_i(index, equations[t->color.operation], equations[t->alpha.operation]);
    more->blend_func_separate_i(index, source_factor(t->color.src), target_factor(t->color.dst),
                                source_factor(t->alpha.src), target_factor(t->alpha.dst));
}

static GLuint stencil_mask(unsigned mask)
{
    return mask == 0 ? 255 : mask & 255;
}

static void set_stencil(const struct peer_functions *more, GLenum face, const struct rhw_stencil_face *s,
                        uint8_t reference)
{
    more->stencil_func_separate(face, s->compares ? compares[s->compare] : GL_ALWAYS, reference,
                                stencil_mask(s->read_mask));
    more->stencil_op_separate(face, stencil_operations[s->fail], stencil_operations[s->depth_fail],
                              stencil_operations[s->pass]);
    more->stencil_mask_separate(face, stencil_mask(s->write_mask));
}

static void set_tests(const struct gles *gl, const struct peer_functions *more, const struct frame_draw *draw)
{
    const struct rhw_pipeline_def *const s = &draw->state;
    enable(gl, GL_DEPTH_TEST, s->depth_test);
    gl->depth_func(compares[s->depth_compare]);
    more->depth_mask(!s->depth_read_only);
    enable(gl, GL_POLYGON_OFFSET_FILL, s->depth_bias.constant != 0 || s->depth_bias.slope != 0);
    more->polygon_offset(s->depth_bias.slope, s->depth_bias.constant);
    enable(gl, GL_STENCIL_TEST, s->stencil_test);
    set_stencil(more, GL_FRONT, &s->stencil_front, draw->reference_front);
    set_stencil(more, GL_BACK, &s->stencil_back, draw->reference_back);
    enable(gl, GL_SAMPLE_ALPHA_TO_COVERAGE, s->alpha_to_coverage);
    enable(gl, GL_SAMPLE_MASK, s->sample_mask != 0);
    more->sample_mask_i(0, s->sample_mask == 0 ? ~0u : s->sample_mask);
}

void peer_state_set(const struct gles *gl, const struct peer_functions *more, const struct frame *frame,
                    const struct frame_draw *draw)
{
    const struct rhw_pipeline_def *const s = &draw->state;
    const struct rhw_viewport *const v = &draw->viewport;
    const struct rhw_rect *const cut = &draw->scissor;
    if (v->width > 0) {
        gl->viewport((GLint)v->x, (GLint)v->y, (GLsizei)v->width, (GLsizei)v->height);
        const bool whole = v->depth_min == 0 && v->depth_max == 0; // zeros stand for 0 and 1
        gl->depth_range_f(v->depth_min, whole ? 1 : v->depth_max);
    } else {
        gl->viewport(0, 0, frame->width, frame->height);
        gl->depth_range_f(0, 1);
    }
    enable(gl, GL_SCISSOR_TEST, cut->width > 0);
    more->scissor(cut->x, cut->y, cut->width, cut->height);
    enable(gl, GL_CULL_FACE, s->cull != RHW_CULL_NONE);
    more->cull_face(s->cull == RHW_CULL_FRONT  ? GL_FRONT
                    : s->cull == RHW_CULL_BACK ? GL_BACK
                                               : GL_FRONT_AND_BACK);
    more->front_face(s->front == RHW_CLOCKWISE ? GL_CCW : GL_CW);
    more->line_width(s->line_width > 0 ? s->line_width : 1);
    enable(gl, GL_PRIMITIVE_RESTART_FIXED_INDEX, s->primitive_restart);
    set_tests(gl, more, draw);
    more->blend_color(draw->blend_constant[0], draw->blend_constant[1], draw->blend_constant[2],
                      draw->blend_constant[3]);
    for (int i = 0; i < s->target_count; i++) {
        set_blend(more, (GLuint)i, &s->targets[i]);
    }
}

static GLint address_mode(enum rhw_address address)
{
    static const GLint modes[] = {
        [RHW_ADDRESS_REPEAT] = GL_REPEAT,
        [RHW_ADDRESS_MIRROR] = GL_MIRRORED_REPEAT,
        [RHW_ADDRESS_CLAMP] = GL_CLAMP_TO_EDGE,
        [RHW_ADDRESS_BORDER] = GL_CLAMP_TO_BORDER,
    };
    return modes[address];
}

static GLint min_filter(const struct rhw_sampler_def *s)
{
    static const GLint filters[2][3] = {
        [RHW_FILTER_LINEAR] = {[RHW_MIP_FILTER_LINEAR] = GL_LINEAR_MIPMAP_LINEAR,
                               [RHW_MIP_FILTER_NEAREST] = GL_LINEAR_MIPMAP_NEAREST,
                               [RHW_MIP_FILTER_NONE] = GL_LINEAR},
        [RHW_FILTER_NEAREST] = {[RHW_MIP_FILTER_LINEAR] = GL_NEAREST_MIPMAP_LINEAR,
                                [RHW_MIP_FILTER_NEAREST] = GL_NEAREST_MIPMAP_NEAREST,
                                [RHW_MIP_FILTER_NONE] = GL_NEAREST},
    };
    return filters[s->min_filter][s->mip_filter];
}

void peer_state_set_sampler(const struct gles *gl, const struct peer_functions *more, GLenum target,
                            const struct rhw_sampler_def *sampler)
{
    gl->tex_parameter_i(target, GL_TEXTURE_MIN_FILTER, min_filter(sampler));
    gl->tex_parameter_i(target, GL_TEXTURE_MAG_FILTER,
                        sampler->mag_filter == RHW_FILTER_LINEAR ? GL_LINEAR : GL_NEAREST);
    gl->tex_parameter_i(target, GL_TEXTURE_WRAP_S, address_mode(sampler->address_u));
    gl->tex_parameter_i(target, GL_TEXTURE_WRAP_T, address_mode(sampler->address_v));
    gl->tex_parameter_i(target, GL_TEXTURE_WRAP_R, address_mode(sampler->address_w));
    more->tex_parameter_fv(target, GL_TEXTURE_BORDER_COLOR, sampler->border);
    more->tex_parameter_f(target, GL_TEXTURE_MIN_LOD, sampler->lod_min);
    if (sampler->lod_max != 0) {
        more->tex_parameter_f(target, GL_TEXTURE_MAX_LOD, sampler->lod_max);
    }
    if (sampler->max_anisotropy > 1) {
        more->tex_parameter_f(target, GL_TEXTURE_MAX_ANISOTROPY_EXT, sampler->max_anisotropy);
    }
    if (sampler->compares) {
        gl->tex_parameter_i(target, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
        gl->tex_parameter_i(target, GL_TEXTURE_COMPARE_FUNC, (GLint)compares[sampler->compare]);
    }
}

GLenum peer_state_topology(enum rhw_topology topology)
{
    switch (topology) {
    case RHW_TRIANGLE_STRIP: return GL_TRIANGLE_STRIP;
    case RHW_TRIANGLE_FAN: return GL_TRIANGLE_FAN;
    case RHW_POINT_LIST: return GL_POINTS;
    case RHW_LINE_LIST: return GL_LINES;
    case RHW_LINE_STRIP: return GL_LINE_STRIP;
    case RHW_LINE_LOOP: return GL_LINE_LOOP;
    default: return GL_TRIANGLES;
    }
}
