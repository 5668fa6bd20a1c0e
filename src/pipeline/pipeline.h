// SPDX-License-Identifier: MIT
// A pipeline whose definition was checked, with what every draw would otherwise work out again.
#ifndef RHW_PIPELINE_H
#define RHW_PIPELINE_H

#include "feedback_layout.h"
#include "format/format.h"

// What a fragment function reads of the attachments, and of the attachments that fragments are tested against.
enum {
    RHW_USE_TEST_INPUT = RHW_USE_DEPTH_INPUT | RHW_USE_STENCIL_INPUT,
    RHW_USE_TARGET_INPUT = RHW_USE_COLOR_INPUT | RHW_USE_TEST_INPUT
};

struct rhw_validator;
struct rhw_memory;

struct rhw_pipeline_data {
    struct rhw_pipeline_def def;
    // Under validation, the validator stands in the place of the pipeline's functions; see validation/validation.h.
    struct rhw_validator *validator;
    size_t validator_size; // bytes
    // The best entry for the context's instruction set. NULL: program.vertex1 is used.
    rhw_vertex_function *vertex;
    // The best entry for the context's instruction set. NULL: program.fragment1 is used; when it is NULL too, the
    // pipeline draws depth alone.
    rhw_fragment_function *fragment;
    // Targets that are left out, a bit each: their format is rhw_left_out_format, and none of their channels is
    // written.
    unsigned left_out;
    // Number of colours that the fragment function writes: those of the targets, and a second source.
    int output_count;
    struct rhw_fetch fetches[RHW_MAX_ATTRIBUTES];
    int varying_components;     // number of components of all varyings together
    enum rhw_sampling sampling; // the most that a varying asks for
    // Components that are taken at centroids, and whether others, but flat ones, are taken at centres.
    int centroid_count;
    uint8_t centroid_component[RHW_MAX_VARYING_COMPONENTS];
    bool any_at_center;
    // What is drawn: `topology` and the polygon mode in one.
    enum rhw_primitive {
        RHW_PRIMITIVE_TRIANGLES,
        RHW_PRIMITIVE_LINES,
        RHW_PRIMITIVE_POINTS,
        RHW_PRIMITIVE_POLYGON_LINES,  // triangles as their edges
        RHW_PRIMITIVE_POLYGON_POINTS, // triangles as their corners
        RHW_PRIMITIVE_NOTHING         // nothing, by rasterizer_discard
    } primitive;
    int triangles_most;   // the most triangles that tiles draw of a primitive
    bool is_smooth;       // lines are drawn by the area that they cover
    bool is_conservative; // triangles are filled, and not by what they cover
    // Components behind the varyings in a vertex record: clip distances, cull distances, point size.
    int extra_components;
    int point_size_component; // place of the point size in the record, if it is written
    bool any_noperspective, any_derivatives;
    uint8_t component_qualifier[RHW_MAX_VARYING_COMPONENTS]; // enum rhw_qualifier
    bool component_derivatives[RHW_MAX_VARYING_COMPONENTS];
    // How packing treats the 8 components from 8·n on together.
    enum rhw_vector_qualifier {
        RHW_VECTOR_SMOOTH,
        RHW_VECTOR_FLAT,
        RHW_VECTOR_MIXED
    } vector_qualifier[RHW_MAX_VARYING_COMPONENTS / 8];
    int flat_count;
    uint8_t flat_component[RHW_MAX_VARYING_COMPONENTS];
    int smooth_runs,
        screen_runs; // numbers of runs of smooth, and of noperspective, components beside each other
    struct rhw_component_run {
        int first, end; // end is one behind the last component
    } smooth_run[RHW_MAX_VARYING_COMPONENTS], screen_run[RHW_MAX_VARYING_COMPONENTS];
    bool any_constant_derivatives; // a component that is not smooth has derivatives
    // −1 for components with the qualifier, and 0 for others.
    int32_t noperspective_mask[RHW_MAX_VARYING_COMPONENTS], flat_mask[RHW_MAX_VARYING_COMPONENTS];
    // Smooth components with derivatives, by twos. Where their number is odd the last component stands twice.
    int derivative_pairs;
    uint8_t derivative_component[RHW_MAX_VARYING_COMPONENTS / 2][2];
    struct rhw_feedback_copy feedback[RHW_MAX_FEEDBACK_OUTPUTS]; // one copy for each output
    unsigned feedback_targets;                                   // a bit for each target that is written
    bool is_routed;                                              // vertices name a viewport or a layer
    // Place in the record, behind the point size, of the viewport's number and the layer's, as bits.
    int route_component;
};

// Set the data from a valid definition. `isa` is the highest instruction set whose functions are taken.
void rhw_pipeline_data_init(struct rhw_pipeline_data *data, const struct rhw_pipeline_def *def,
                            enum rhw_isa isa);

// Release what the item owns.
void rhw_pipeline_data_release(struct rhw_memory *memory, struct rhw_pipeline_data *data);

#endif
