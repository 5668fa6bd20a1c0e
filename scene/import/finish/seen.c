// SPDX-License-Identifier: MIT
// See seen.h. A mesh counts as seen unless the opposite is certain: an image is asked for the largest alpha of the
// rectangle around a triangle's texture coordinates, in a coarse grid.
#include "seen.h"

#include <stdlib.h>

#include "draw/camera/camera_math.h"

// What has an alpha below `least_alpha` sets no frame. It changes the grey that is behind a model, where no other
// background is asked for, by some 2 of 255; over black, where sRGB has many codes, it may show.
enum { GRID = 64 };
static const float least_alpha = 1.0f / 256;

struct alpha_grid {
    float largest[GRID][GRID]; // rows from top to bottom
};

struct search {
    struct scene_import *import;
    struct alpha_grid **grids; // one for each image, made when it is asked for
};

// Images ----------------------------------------------------------------------------------------------

static float texel_alpha(const struct scene_image *image, size_t texel)
{
    switch (image->type) {
    case SCENE_IMAGE_RGBA8: return (float)((const uint8_t *)image->texels)[4 * texel + 3] / 255;
    case SCENE_IMAGE_RGBA16: return (float)((const uint16_t *)image->texels)[4 * texel + 3] / 65535;
    case SCENE_IMAGE_RGBA32F: return ((const float *)image->texels)[4 * texel + 3];
    }
    return 1;
}

// Return the largest alpha of a rectangle of texels. An opaque one ends the search.
static float largest_alpha(const struct scene_image *image, size_t left, size_t right, size_t top,
                           size_t bottom)
{
    float largest = 0;
    for (size_t y = top; y < bottom && largest < 1; y++) {
        for (size_t x = left; x < right && largest < 1; x++) {
            const float alpha = texel_alpha(image, y * image->width + x);
            largest = alpha > largest ? alpha : largest;
        }
    }
    return largest;
}

static struct alpha_grid *find_grid(struct search *search, uint32_t index)
{
    const struct scene_image *image = &search->import->model.images[index];
    if (search->grids[index] != NULL) {
        return search->grids[index];
    }
    struct alpha_grid *grid = scene_import_allocate(search->import, 1, sizeof *grid);
    search->grids[index] = grid;
    // A small image has several cells to a texel. Each cell takes the texels that it touches.
    for (size_t row = 0; row < GRID; row++) {
        const size_t top = row * image->height / GRID, bottom = ((row + 1) * image->height + GRID - 1) / GRID;
        for (size_t column = 0; column < GRID; column++) {
            const size_t left = column * image->width / GRID,
                         right = ((column + 1) * image->width + GRID - 1) / GRID;
            grid->largest[row][column] = largest_alpha(image, left, right, top, bottom);
        }
    }
    return grid;
}

// Find the cells from `first` to `last` that a range of texture coordinates reads, with half a texel beside it. Both
// may be beyond the grid, where it is repeated.
static void find_cells(float low, float high, enum rhw_address address, uint32_t texels, int *first,
                       int *last)
{
    const float margin = 0.5f / (float)texels;
    low -= margin;
    high += margin;
    if (address == RHW_ADDRESS_CLAMP) {
        low = low > 0 ? low < 1 ? low : 1 : 0;
        high = high > 0 ? high < 1 ? high : 1 : 0;
    }
    const float most = 1e6f; // beyond it, a float tells no cells apart
    const bool whole = !(high - low < 1 && low > -most && high < most) ||
                       (address != RHW_ADDRESS_CLAMP && address != RHW_ADDRESS_REPEAT);
    *first = whole ? 0 : (int)__builtin_floorf(low * GRID);
    *last = whole ? GRID - 1 : (int)__builtin_floorf(high * GRID);
    if (!whole && address == RHW_ADDRESS_CLAMP) {
        *first = *first < GRID ? *first : GRID - 1;
        *last = *last < GRID ? *last : GRID - 1;
    }
}

// Return the largest alpha that the corners' texture coordinates and what lies between them may read.
static float image_alpha(struct search *search, const struct scene_mesh *mesh,
                         const struct scene_texture_slot *slot, const uint32_t *corners, uint32_t count)
{
    const struct scene_image *image = &search->import->model.images[slot->image];
    const bool has_border = slot->address_u == RHW_ADDRESS_BORDER || slot->address_v == RHW_ADDRESS_BORDER;
    if (!image->has_alpha || (has_border && slot->border[3] > 0)) {
        return 1;
    }
    float low[2] = {0, 0}, high[2] = {0, 0};
    for (uint32_t i = 0; i < count; i++) {
        static const float origin[2] = {0, 0};
        const float *uv = mesh->uvs[slot->uv_set] != NULL ? mesh->uvs[slot->uv_set][corners[i]] : origin;
        const float *t = slot->transform;
        const float place[2] = {t[0] * uv[0] + t[1] * uv[1] + t[2], t[3] * uv[0] + t[4] * uv[1] + t[5]};
        for (int c = 0; c < 2; c++) {
            low[c] = i == 0 || place[c] < low[c] ? place[c] : low[c];
            high[c] = i == 0 || place[c] > high[c] ? place[c] : high[c];
        }
    }
    int left, right, top, bottom;
    find_cells(low[0], high[0], slot->address_u, image->width, &left, &right);
    find_cells(low[1], high[1], slot->address_v, image->height, &top, &bottom);
    const struct alpha_grid *grid = find_grid(search, (uint32_t)slot->image);
    float largest = 0;
    for (int y = top; y <= bottom; y++) {
        for (int x = left; x <= right; x++) {
            const float alpha = grid->largest[(unsigned)y % GRID][(unsigned)x % GRID];
            largest = alpha > largest ? alpha : largest;
        }
    }
    return largest;
}

// Meshes ----------------------------------------------------------------------------------------------

// Write the cross product of two edges of a triangle.
static void cross_edges(double corners[3][3], double product[3])
{
    double a[3], b[3];
    for (int c = 0; c < 3; c++) {
        a[c] = corners[1][c] - corners[0][c];
        b[c] = corners[2][c] - corners[0][c];
    }
    scene_cross(a, b, product);
}

// Return true if a triangle has an area. One number of the product of two edges that is not 0 says so, as the first is
// nearly always.
static bool has_area(const struct scene_mesh *mesh, const uint32_t *indices)
{
    const float *const p = mesh->positions[indices[0]], *const q = mesh->positions[indices[1]],
                       *const r = mesh->positions[indices[2]];
    for (int c = 0; c < 3; c++) {
        const int d = (c + 1) % 3, e = (c + 2) % 3;
        const double a[2] = {(double)q[d] - (double)p[d], (double)q[e] - (double)p[e]};
        const double b[2] = {(double)r[d] - (double)p[d], (double)r[e] - (double)p[e]};
        if (a[0] * b[1] - a[1] * b[0] != 0) {
            return true;
        }
    }
    return false;
}

// Return true if a triangle, line or point reaches the alpha that its material asks.
static bool has_alpha(struct search *search, const struct scene_mesh *mesh,
                      const struct scene_material *material, const uint32_t *corners, uint32_t count)
{
    const struct scene_texture_slot *slot = &material->slots[SCENE_SLOT_BASE_COLOR];
    float alpha = material->base_color[3];
    if (mesh->colors != NULL) {
        float largest = 0;
        for (uint32_t i = 0; i < count; i++) {
            const float own = mesh->colors[corners[i]][3];
            largest = own > largest ? own : largest;
        }
        alpha *= largest;
    }
    const bool is_mask = material->alpha_mode == SCENE_ALPHA_MASK;
    const float least = is_mask ? material->alpha_cutoff : least_alpha;
    if (slot->image >= 0 && alpha >= least) {
        alpha *= image_alpha(search, mesh, slot, corners, count);
    }
    return alpha >= least;
}

// Return true if each triangle, line and point of an opaque mesh is seen, which nearly every mesh has.
static bool is_seen_whole(const struct scene_mesh *mesh, const struct scene_material *material)
{
    bool whole = material->alpha_mode == SCENE_ALPHA_OPAQUE || scene_material_transmits(material);
    for (uint32_t i = 0; i + 3 <= mesh->index_count && whole && scene_mesh_corners(mesh) == 3; i += 3) {
        whole = has_area(mesh, mesh->indices + i);
    }
    return whole;
}

static struct scene_seen_mesh see_mesh(struct search *search, const struct scene_mesh *mesh)
{
    const struct scene_material *material = &search->import->model.materials[mesh->material];
    const uint32_t count = scene_mesh_corners(mesh);
    struct scene_seen_mesh seen = {.shows = mesh->index_count > 0};
    if (is_seen_whole(mesh, material)) {
        return seen;
    }
    const bool is_opaque = material->alpha_mode == SCENE_ALPHA_OPAQUE || scene_material_transmits(material);
    seen.shows = false;
    seen.vertices = scene_import_allocate(search->import, mesh->vertex_count, sizeof *seen.vertices);
    for (uint32_t i = 0; i + count <= mesh->index_count; i += count) {
        const uint32_t *corners = mesh->indices + i;
        const bool shows = (count < 3 || has_area(mesh, corners)) &&
                           (is_opaque || has_alpha(search, mesh, material, corners, count));
        for (uint32_t k = 0; k < count && shows; k++) {
            seen.vertices[corners[k]] = seen.shows = true;
        }
    }
    return seen;
}

struct scene_seen_mesh *scene_seen_find(struct scene_import *import)
{
    const struct scene_model *model = &import->model;
    struct search search = {
        .import = import,
        .grids = scene_import_allocate(import, model->image_count, sizeof(struct alpha_grid *)),
    };
    struct scene_seen_mesh *seen = scene_import_allocate(import, model->mesh_count, sizeof *seen);
    for (uint32_t i = 0; i < model->mesh_count; i++) {
        seen[i] = see_mesh(&search, &model->meshes[i]);
    }
    for (uint32_t i = 0; i < model->image_count; i++) {
        free(search.grids[i]);
    }
    free(search.grids);
    return seen;
}

void scene_seen_free(struct scene_seen_mesh *seen, const struct scene_model *model)
{
    for (uint32_t i = 0; i < model->mesh_count; i++) {
        free(seen[i].vertices);
    }
    free(seen);
}

// Instances -------------------------------------------------------------------------------------------

// Return true if the matrix leaves an area to at least one triangle.
static bool leaves_area(const struct scene_mesh *mesh, const float world[16])
{
    for (uint32_t i = 0; i + 3 <= mesh->index_count; i += 3) {
        double corners[3][3], product[3];
        for (int k = 0; k < 3; k++) {
            scene_place_point(world, mesh->positions[mesh->indices[i + (uint32_t)k]], corners[k]);
        }
        cross_edges(corners, product);
        if (product[0] != 0 || product[1] != 0 || product[2] != 0) {
            return true;
        }
    }
    return false;
}

// Return true if a matrix leaves a mesh an area or, of lines and points, a length.
static bool is_placed(const struct scene_mesh *mesh, const float world[16])
{
    bool has_length = false, is_singular = false;
    for (int c = 0; c < 3; c++) {
        const float *column = world + 4 * c;
        const bool is_zero = column[0] == 0 && column[1] == 0 && column[2] == 0;
        has_length = has_length || !is_zero;
        is_singular = is_singular || is_zero;
    }
    return has_length &&
           (mesh->primitive != SCENE_PRIMITIVE_TRIANGLES || !is_singular || leaves_area(mesh, world));
}

bool scene_seen_mark(struct scene_model *model, const struct scene_seen_mesh *seen)
{
    bool shows = false;
    for (uint32_t i = 0; i < model->instance_count; i++) {
        struct scene_instance *instance = &model->instances[i];
        instance->unseen =
            !seen[instance->mesh].shows || !is_placed(&model->meshes[instance->mesh], instance->world);
        shows = shows || !instance->unseen;
    }
    for (uint32_t i = 0; i < model->instance_count && !shows; i++) {
        model->instances[i].unseen = false;
    }
    return shows;
}
