// SPDX-License-Identifier: MIT
// See peer_functions.h.
#include "peer_functions.h"

#include <stddef.h>

bool peer_functions_find(const struct gles *gles, struct peer_functions *functions)
{
    const struct {
        const char *name;
        void *at;
    } names[] = {
        {"glTexSubImage3D", &functions->tex_sub_image_3d},
        {"glTexStorage3D", &functions->tex_storage_3d},
        {"glCompressedTexSubImage2D", &functions->compressed_tex_sub_image_2d},
        {"glTexParameterf", &functions->tex_parameter_f},
        {"glTexParameterfv", &functions->tex_parameter_fv},
        {"glVertexAttribDivisor", &functions->vertex_attrib_divisor},
        {"glDrawArraysInstanced", &functions->draw_arrays_instanced},
        {"glDrawElementsInstanced", &functions->draw_elements_instanced},
        {"glPolygonOffset", &functions->polygon_offset},
        {"glScissor", &functions->scissor},
        {"glCullFace", &functions->cull_face},
        {"glFrontFace", &functions->front_face},
        {"glDepthMask", &functions->depth_mask},
        {"glLineWidth", &functions->line_width},
        {"glStencilFuncSeparate", &functions->stencil_func_separate},
        {"glStencilOpSeparate", &functions->stencil_op_separate},
        {"glStencilMaskSeparate", &functions->stencil_mask_separate},
        {"glBlendEquationSeparatei", &functions->blend_equation_separate_i},
        {"glBlendFuncSeparatei", &functions->blend_func_separate_i},
        {"glBlendColor", &functions->blend_color},
        {"glColorMaski", &functions->color_mask_i},
        {"glEnablei", &functions->enable_i},
        {"glDisablei", &functions->disable_i},
        {"glClearBufferfv", &functions->clear_buffer_fv},
        {"glClearBufferiv", &functions->clear_buffer_iv},
        {"glClearBufferuiv", &functions->clear_buffer_uiv},
        {"glClearBufferfi", &functions->clear_buffer_fi},
        {"glSampleMaski", &functions->sample_mask_i},
        {"glGenQueries", &functions->gen_queries},
        {"glBeginQuery", &functions->begin_query},
        {"glEndQuery", &functions->end_query},
        {"glGetQueryObjectuiv", &functions->get_query_object_uiv},
        {"glDeleteQueries", &functions->delete_queries},
        {"glTransformFeedbackVaryings", &functions->transform_feedback_varyings},
        {"glBeginTransformFeedback", &functions->begin_transform_feedback},
        {"glEndTransformFeedback", &functions->end_transform_feedback},
        {"glBindBufferBase", &functions->bind_buffer_base},
        {"glMapBufferRange", &functions->map_buffer_range},
        {"glUnmapBuffer", &functions->unmap_buffer},
        {"glMemoryBarrier", &functions->memory_barrier},
        {"glPixelStorei", &functions->pixel_store_i},
        {"glGetProgramInfoLog", &functions->get_program_info_log},
        {"glBindImageTexture", &functions->bind_image_texture},
        {"glGetInternalformativ", &functions->get_internal_format_iv},
    };
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        if (!gles_find(gles, names[i].name, names[i].at)) {
            return false;
        }
    }
    return true;
}
