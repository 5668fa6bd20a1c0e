// SPDX-License-Identifier: MIT
// A pipeline as it was validated, with what every draw would otherwise work out again.
#ifndef RHW_PIPELINE_H
#define RHW_PIPELINE_H

#include "feedback_layout.h"
#include "format/format.h"

// What a fragment function reads of the attachments, and of those that fragments are tested against.
enum {
    RHW_USE_TEST_INPUT = RHW_USE_DEPTH_INPUT | RHW_USE_STENCIL_INPUT,
    RHW_USE_TARGET_INPUT = RHW_USE_COLOR_INPUT | RHW_USE_TEST_INPUT
};

struct rhw_validator;
struct rhw_memory;

struct rhw_pipeline_data {
    struct rhw_pipeline_def def;
    // Under validation, and then in the place of its functions; see binding/validation/validation.h.
    struct rhw_validator *validator;
    size_t validator_size;       // bytes
    rhw_vertex_function *vertex; // best entry for the context's instruction set; NULL: use program.vertex1
    rhw_fragment_function *fragment; // likewise; NULL: program.fragment1, and when that is NULL too, depth only
    // Targets that are left out, a bit each: their format is rhw_left_out_format, and none of their channels is
    // written.
    unsigned left_out;
    int output_count; // colours that the fragment function writes: the targets', and a second source
    struct rhw_fetch fetches[RHW_MAX_ATTRIBUTES];
    int varying_components;     // of all varyings together
    enum rhw_sampling sampling; // the most that one of them asks for
    // What is drawn: `topology` and the polygon mode in one.
    enum rhw_primitive {
        RHW_PRIMITIVE_TRIANGLES,
        RHW_PRIMITIVE_LINES,
        RHW_PRIMITIVE_POINTS,
        RHW_PRIMITIVE_POLYGON_LINES,  // triangles as their edges
        RHW_PRIMITIVE_POLYGON_POINTS, // and as their corners
        RHW_PRIMITIVE_NOTHING         // rasterizer_discard
    } primitive;
    int triangles_most;   // that tiles draw of a primitive
    bool is_smooth;       // lines are drawn by the area that they cover
    bool is_conservative; // triangles are filled, and not by what they cover
    int extra_components; // behind the varyings in a vertex record: clip distances, cull distances, point size
    int point_size_component; // of the record; where it is written
    bool any_noperspective, any_derivatives;
    uint8_t component_qualifier[RHW_MAX_VARYING_COMPONENTS]; // enum rhw_qualifier
    bool component_derivatives[RHW_MAX_VARYING_COMPONENTS];
    // Of 8 components from 8·n on, which packing treats together:
    enum rhw_vector_qualifier {
        RHW_VECTOR_SMOOTH,
        RHW_VECTOR_FLAT,
        RHW_VECTOR_MIXED
    } vector_qualifier[RHW_MAX_VARYING_COMPONENTS / 8];
    int flat_count;
    uint8_t flat_component[RHW_MAX_VARYING_COMPONENTS];
    int smooth_runs; // of smooth components beside each other
    struct rhw_component_run {
        int first, end; // the one behind the last
    } smooth_run[RHW_MAX_VARYING_COMPONENTS];
    bool any_constant_derivatives; // of components that are not smooth
    int32_t noperspective_mask[RHW_MAX_VARYING_COMPONENTS],
        flat_mask[RHW_MAX_VARYING_COMPONENTS]; // −1 where it is so
    // Smooth components with derivatives, by twos; where their number is odd the last stands twice.
    int derivative_pairs;
    uint8_t derivative_component[RHW_MAX_VARYING_COMPONENTS / 2][2];
    struct rhw_feedback_copy feedback[RHW_MAX_FEEDBACK_OUTPUTS]; // as many as outputs
    unsigned feedback_targets;                                   // a bit for each that is written
    bool is_routed;                                              // vertices name a viewport or a layer
    int route_component; // of the record, behind the point size: the viewport's number and the layer's, as bits
};

// `def` is valid; `isa` is the highest whose functions are taken.
void rhw_pipeline_data_init(struct rhw_pipeline_data *data, const struct rhw_pipeline_def *def,
                            enum rhw_isa isa);

// Releases what the item owns.
void rhw_pipeline_data_release(struct rhw_memory *memory, struct rhw_pipeline_data *data);

#endif
