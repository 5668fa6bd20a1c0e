// SPDX-License-Identifier: MIT
// The vertices are sorted into cells, a hundred along the longest side. The mirror image of a vertex is there if its
// cell or one beside it has a vertex. All axes are looked along in one walk over the vertices.
#include "symmetry.h"

#include <math.h>
#include <stdlib.h>

#include "draw/camera/camera_math.h"
#include "draw/camera/subject.h"

enum { CELLS = 100, SAMPLE = 4096 };

// A set of cells. The number of a cell is not 0, which stands for a free place.
struct cells {
    uint32_t *places;
    size_t mask;
};

static uint32_t number_of(const int cell[3])
{
    const int side = CELLS + 4; // The cells beside the outermost ones have numbers too.
    return 1 + (uint32_t)((cell[0] + 2) * side * side + (cell[1] + 2) * side + cell[2] + 2);
}

// Return the place of a cell, or the free one where it belongs.
static uint32_t *find(const struct cells *cells, uint32_t number)
{
    size_t i = number * 0x9e3779b1u & cells->mask;
    while (cells->places[i] != 0 && cells->places[i] != number) {
        i = (i + 1) & cells->mask;
    }
    return &cells->places[i];
}

static void cell_of(const struct scene_box *frame, const double point[3], int cell[3])
{
    const double size = scene_box_longest(frame) / CELLS;
    for (int c = 0; c < 3; c++) {
        const double place = floor((point[c] - frame->low[c]) / size);
        cell[c] = place < 0 ? 0 : place > CELLS ? CELLS : (int)place;
    }
}

static bool has_cell_beside(const struct cells *cells, const int cell[3])
{
    bool found = false;
    for (int i = 0; i < 27 && !found; i++) {
        const int beside[3] = {cell[0] + i % 3 - 1, cell[1] + i / 3 % 3 - 1, cell[2] + i / 9 - 1};
        const uint32_t number = number_of(beside);
        found = *find(cells, number) == number;
    }
    return found;
}

// What is done with each vertex that counts.
struct walk {
    struct scene_box frame;
    struct cells cells;
    bool is_search; // look for mirror images instead of filling cells
    uint64_t step, seen, asked, found[3];
};

static void visit(struct walk *walk, const double point[3])
{
    int cell[3];
    if (!scene_box_has(&walk->frame, point)) {
        return;
    }
    if (!walk->is_search) {
        cell_of(&walk->frame, point, cell);
        *find(&walk->cells, number_of(cell)) = number_of(cell);
        walk->seen++;
        return;
    }
    if (walk->seen++ % walk->step != 0) {
        return;
    }
    walk->asked++;
    for (int axis = 0; axis < 3; axis++) {
        double image[3] = {point[0], point[1], point[2]};
        image[axis] = walk->frame.low[axis] + walk->frame.high[axis] - point[axis];
        cell_of(&walk->frame, image, cell);
        walk->found[axis] += has_cell_beside(&walk->cells, cell);
    }
}

static void visit_all(struct walk *walk, const struct scene_model *model)
{
    for (uint32_t i = 0; i < model->instance_count; i++) {
        const struct scene_instance *const instance = &model->instances[i];
        const struct scene_mesh *const mesh = &model->meshes[instance->mesh];
        for (uint32_t k = 0; k < mesh->vertex_count && !instance->unseen; k++) {
            double point[3];
            scene_place_point(instance->world, mesh->positions[k], point);
            visit(walk, point);
        }
    }
}

void scene_symmetry_find(struct scene_import *import, double shares[3])
{
    const struct scene_model *const model = &import->model;
    struct walk walk = {.frame = scene_subject_frame(model)};
    size_t vertices = 0, size = 16;
    shares[0] = shares[1] = shares[2] = 0;
    for (uint32_t i = 0; i < model->instance_count; i++) {
        vertices += model->meshes[model->instances[i].mesh].vertex_count;
    }
    const size_t most = (size_t)(CELLS + 1) * (CELLS + 1) * (CELLS + 1);
    while (size < 2 * (vertices < most ? vertices : most)) {
        size *= 2;
    }
    if (!(scene_box_longest(&walk.frame) > 0)) {
        return;
    }
    walk.cells = (struct cells){scene_import_allocate(import, size, sizeof *walk.cells.places), size - 1};
    visit_all(&walk, model);
    walk.step = walk.seen / SAMPLE + 1;
    walk.seen = 0;
    walk.is_search = true;
    visit_all(&walk, model);
    free(walk.cells.places);
    for (int axis = 0; axis < 3 && walk.asked > 0; axis++) {
        shares[axis] = (double)walk.found[axis] / (double)walk.asked;
    }
}
