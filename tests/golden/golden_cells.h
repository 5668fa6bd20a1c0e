// SPDX-License-Identifier: MIT
// Shaders of the scenes that lay a feature out in cells, compiled once per instruction set.
#ifndef GOLDEN_CELLS_H
#define GOLDEN_CELLS_H

#include <rhw/isa.h>
#include <rhw/rhw.h>

struct golden_vertex {
    float position[4]; ///< clip coordinates
    float value[4];
};

enum golden_cell_vertex {
    GOLDEN_CELL_PLAIN, ///< attribute 0 is the position, 1 the varyings 0..3
    GOLDEN_CELL_INSTANCED, ///< as PLAIN; attribute 2: offset x, y, scale; 3: factor of the value; varying 4, 5: ids
    GOLDEN_CELL_SCREEN, ///< no attributes: a triangle over the viewport; varyings 0, 1 run over it from 0 to 1
    GOLDEN_CELL_SIZED,  ///< as PLAIN; with point sizes, two clip distances and a cull distance
    GOLDEN_CELL_ROUTED, ///< as PLAIN; an instance to each layer, triangles to four viewports in turn
    GOLDEN_CELL_VERTICES
};

enum golden_cell_fragment {
    GOLDEN_CELL_VALUE,    ///< varyings 0..3 to every target
    GOLDEN_CELL_FACING,   ///< the same; back faces get the complement
    GOLDEN_CELL_TEXTURE,  ///< texture 0 at varyings 0, 1 with their derivatives
    GOLDEN_CELL_LEVEL,    ///< texture 0 at varyings 0, 1; level of detail in varying 2
    GOLDEN_CELL_IDS,      ///< a colour of primitive, instance and draw; as integers in targets 1, 2, 3
    GOLDEN_CELL_BUILTINS, ///< coord, both barycentrics, their derivatives, those of the varyings, facing
    GOLDEN_CELL_HEIGHTS,  ///< moves the depth by waves, discards discs, shades by derivatives
    GOLDEN_CELL_MATHS,    ///< a function for each of 8×4 cells, over arguments that uniforms scale
    GOLDEN_CELL_KINDS,    ///< texture 0 of any kind at varyings 0.., asked as uniforms say
    GOLDEN_CELL_POINT,    ///< varyings 0, 1 times point coordinates
    GOLDEN_CELL_ROUTE,    ///< varyings 0..3, darker by layer and viewport
    GOLDEN_CELL_COVERED,  ///< varyings 0..3, half as bright where the triangle does not contain the pixel
    GOLDEN_CELL_OFFSET,   ///< varyings 0..2 at offsets that differ from pixel to pixel; varying 3 is W
    GOLDEN_CELL_FRAGMENTS
};

/// Of GOLDEN_CELL_KINDS.
enum golden_question {
    GOLDEN_ASK_GRADIENT,
    GOLDEN_ASK_OFFSET, ///< at a level, shifted by texels
    GOLDEN_ASK_FETCH,
    GOLDEN_ASK_GATHER,
    GOLDEN_ASK_LEVEL, ///< the level of detail, and sizes
    GOLDEN_QUESTIONS
};

struct golden_kind_uniforms {
    int32_t question;
    int32_t components; ///< of coordinates, without the layer
};

struct golden_cell_uniforms {
    int32_t targets;
    float low, high; ///< arguments of MATHS
    int32_t bits;    ///< they are bit patterns: the whole range of floats
};

void golden_cells_fill(struct rhw_program *program, enum golden_cell_vertex vertex,
                       enum golden_cell_fragment fragment);

/// PLAIN vertices in one buffer of struct golden_vertex, four smooth varyings with derivatives, one target.
struct rhw_pipeline_def golden_cells_def(enum golden_cell_fragment fragment, enum rhw_format format);

// One per instruction set; golden_cells_fill is who calls them.
typedef void golden_cells_function(struct rhw_program *program, enum rhw_isa isa,
                                   enum golden_cell_vertex vertex, enum golden_cell_fragment fragment);
RHW_ISA_DECLARE(golden_cells_function, golden_cells);

#endif
