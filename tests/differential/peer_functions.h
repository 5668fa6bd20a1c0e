// SPDX-License-Identifier: MIT
// Functions of OpenGL ES 3.2 beyond those of bench/gles.h.
#ifndef DIFFERENTIAL_PEER_FUNCTIONS_H
#define DIFFERENTIAL_PEER_FUNCTIONS_H

#include "gles.h"

#include <GLES3/gl32.h>

struct peer_functions {
    PFNGLTEXSUBIMAGE3DPROC tex_sub_image_3d;
    PFNGLTEXSTORAGE3DPROC tex_storage_3d;
    PFNGLCOMPRESSEDTEXSUBIMAGE2DPROC compressed_tex_sub_image_2d;
    PFNGLTEXPARAMETERFPROC tex_parameter_f;
    PFNGLTEXPARAMETERFVPROC tex_parameter_fv;
    PFNGLVERTEXATTRIBDIVISORPROC vertex_attrib_divisor;
    PFNGLDRAWARRAYSINSTANCEDPROC draw_arrays_instanced;
    PFNGLDRAWELEMENTSINSTANCEDPROC draw_elements_instanced;
    PFNGLPOLYGONOFFSETPROC polygon_offset;
    PFNGLSCISSORPROC scissor;
    PFNGLCULLFACEPROC cull_face;
    PFNGLFRONTFACEPROC front_face;
    PFNGLDEPTHMASKPROC depth_mask;
    PFNGLLINEWIDTHPROC line_width;
    PFNGLSTENCILFUNCSEPARATEPROC stencil_func_separate;
    PFNGLSTENCILOPSEPARATEPROC stencil_op_separate;
    PFNGLSTENCILMASKSEPARATEPROC stencil_mask_separate;
    PFNGLBLENDEQUATIONSEPARATEIPROC blend_equation_separate_i;
    PFNGLBLENDFUNCSEPARATEIPROC blend_func_separate_i;
    PFNGLBLENDCOLORPROC blend_color;
    PFNGLCOLORMASKIPROC color_mask_i;
    PFNGLENABLEIPROC enable_i;
    PFNGLDISABLEIPROC disable_i;
    PFNGLCLEARBUFFERFVPROC clear_buffer_fv;
    PFNGLCLEARBUFFERIVPROC clear_buffer_iv;
    PFNGLCLEARBUFFERUIVPROC clear_buffer_uiv;
    PFNGLCLEARBUFFERFIPROC clear_buffer_fi;
    PFNGLSAMPLEMASKIPROC sample_mask_i;
    PFNGLGENQUERIESPROC gen_queries;
    PFNGLBEGINQUERYPROC begin_query;
    PFNGLENDQUERYPROC end_query;
    PFNGLGETQUERYOBJECTUIVPROC get_query_object_uiv;
    PFNGLDELETEQUERIESPROC delete_queries;
    PFNGLTRANSFORMFEEDBACKVARYINGSPROC transform_feedback_varyings;
    PFNGLBEGINTRANSFORMFEEDBACKPROC begin_transform_feedback;
    PFNGLENDTRANSFORMFEEDBACKPROC end_transform_feedback;
    PFNGLBINDBUFFERBASEPROC bind_buffer_base;
    PFNGLMAPBUFFERRANGEPROC map_buffer_range;
    PFNGLUNMAPBUFFERPROC unmap_buffer;
    PFNGLMEMORYBARRIERPROC memory_barrier;
    PFNGLPIXELSTOREIPROC pixel_store_i;
    PFNGLGETPROGRAMINFOLOGPROC get_program_info_log;
    PFNGLBINDIMAGETEXTUREPROC bind_image_texture;
    PFNGLGETINTERNALFORMATIVPROC get_internal_format_iv;
};

// False where the driver lacks one.
bool peer_functions_find(const struct gles *gles, struct peer_functions *functions);

#endif
