// SPDX-License-Identifier: MIT
// See triangle_order.h. Distances become integers that sort as the distances do. A radix sort takes them in three steps
// and keeps the order of equal ones.
#include "triangle_order.h"

#include <stdlib.h>
#include <string.h>

enum { DIGIT_BITS = 11, DIGITS = 3, BUCKETS = 1 << DIGIT_BITS };

struct sorting {
    uint32_t *keys, *spare_keys; // far ones first
    uint32_t *triangles, *spare_triangles;
    uint32_t count;
};

// Lower for what is farther.
static uint32_t key_of(float distance)
{
    uint32_t bits;
    memcpy(&bits, &distance, sizeof bits);
    const uint32_t rising = bits & 0x80000000u ? ~bits : bits | 0x80000000u;
    return ~rising;
}

static void sort_by_digit(struct sorting *sorting, int digit)
{
    _Static_assert(DIGIT_BITS * DIGITS >= 32, "all bits are looked at");
    uint32_t starts[BUCKETS] = {0}, next = 0;
    const int shift = digit * DIGIT_BITS;
    for (uint32_t i = 0; i < sorting->count; i++) {
        starts[sorting->keys[i] >> shift & (BUCKETS - 1)]++;
    }
    for (int b = 0; b < BUCKETS; b++) {
        const uint32_t count = starts[b];
        starts[b] = next;
        next += count;
    }
    for (uint32_t i = 0; i < sorting->count; i++) {
        const uint32_t place = starts[sorting->keys[i] >> shift & (BUCKETS - 1)]++;
        sorting->spare_keys[place] = sorting->keys[i];
        sorting->spare_triangles[place] = sorting->triangles[i];
    }
    uint32_t *const keys = sorting->keys, *const triangles = sorting->triangles;
    sorting->keys = sorting->spare_keys;
    sorting->triangles = sorting->spare_triangles;
    sorting->spare_keys = keys;
    sorting->spare_triangles = triangles;
}

// Set thrice the distance of each triangle's middle along the view. The place of the mesh is left out, which is the
// same for all triangles.
static void set_keys(struct sorting *sorting, const struct scene_mesh *mesh, const float world[16],
                     const float forward[3])
{
    double along[3];
    for (int c = 0; c < 3; c++) {
        along[c] = (double)world[4 * c] * (double)forward[0] + (double)world[4 * c + 1] * (double)forward[1] +
                   (double)world[4 * c + 2] * (double)forward[2];
    }
    for (uint32_t t = 0; t < sorting->count; t++) {
        double sum = 0.0;
        for (uint32_t corner = 0; corner < 3; corner++) {
            const float *const p = mesh->positions[mesh->indices[3 * t + corner]];
            sum += along[0] * (double)p[0] + along[1] * (double)p[1] + along[2] * (double)p[2];
        }
        sorting->keys[t] = key_of((float)sum);
        sorting->triangles[t] = t;
    }
}

bool scene_triangle_order_sort(const struct scene_mesh *mesh, const float world[16], const float forward[3],
                               uint32_t *sorted)
{
    struct sorting sorting = {.count = mesh->index_count / 3};
    uint32_t *const memory = malloc((size_t)sorting.count * 4 * sizeof *memory);
    if (!memory) {
        return false;
    }
    sorting.keys = memory;
    sorting.spare_keys = memory + sorting.count;
    sorting.triangles = memory + (size_t)sorting.count * 2;
    sorting.spare_triangles = memory + (size_t)sorting.count * 3;
    set_keys(&sorting, mesh, world, forward);
    for (int digit = 0; digit < DIGITS; digit++) {
        sort_by_digit(&sorting, digit);
    }
    for (uint32_t t = 0; t < sorting.count; t++) {
        memcpy(&sorted[(size_t)t * 3], &mesh->indices[(size_t)sorting.triangles[t] * 3], 3 * sizeof *sorted);
    }
    free(memory);
    return true;
}

static enum rhw_result sort_instance(const struct scene_upload *upload, const struct scene_frame *frame,
                                     uint32_t instance, rhw_buffer *indices)
{
    const struct scene_instance *const place = &upload->model->instances[instance];
    const struct scene_mesh *const mesh = &upload->model->meshes[place->mesh];
    struct rhw_buffer_def def = rhw_buffer_def_default();
    def.size = (size_t)mesh->index_count * sizeof *mesh->indices;
    uint32_t *const sorted = malloc(def.size);
    enum rhw_result result = RHW_ERROR_OUT_OF_MEMORY;
    if (sorted && scene_triangle_order_sort(mesh, place->world, frame->forward, sorted)) {
        def.data = sorted;
        result = rhw_buffer_create(upload->context, &def, indices);
    }
    free(sorted);
    return result;
}

enum rhw_result scene_triangle_order_make(struct scene_triangle_order *order,
                                          const struct scene_upload *upload, const struct scene_frame *frame)
{
    const struct scene_model *const model = upload->model;
    scene_triangle_order_destroy(upload->context, order);
    order->indices = calloc((size_t)model->instance_count + 1, sizeof *order->indices);
    if (!order->indices) {
        return RHW_ERROR_OUT_OF_MEMORY;
    }
    order->count = model->instance_count;
    enum rhw_result result = RHW_OK;
    for (uint32_t i = 0; i < model->instance_count && result == RHW_OK; i++) {
        const struct scene_mesh *const mesh = &model->meshes[model->instances[i].mesh];
        if (mesh->primitive == SCENE_PRIMITIVE_TRIANGLES && mesh->index_count > 0 &&
            model->materials[mesh->material].alpha_mode == SCENE_ALPHA_BLEND) {
            result = sort_instance(upload, frame, i, &order->indices[i]);
        }
    }
    return result;
}

void scene_triangle_order_destroy(rhw_context *context, struct scene_triangle_order *order)
{
    for (uint32_t i = 0; i < order->count; i++) {
        if (order->indices[i].generation) {
            rhw_buffer_destroy(context, order->indices[i]);
        }
    }
    free(order->indices);
    *order = (struct scene_triangle_order){0};
}

rhw_buffer scene_triangle_order_of(const struct scene_triangle_order *order, uint32_t instance)
{
    return order && instance < order->count ? order->indices[instance] : (rhw_buffer){0};
}
