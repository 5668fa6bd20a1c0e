// SPDX-License-Identifier: MIT
// Meshes into interleaved buffers, material slots into textures (upload_image.h) and samplers.
//
// Lines and points become quads here: 4 vertices each, which carry both ends of their line, so that the
// vertex function can place them on the screen. Quads as vertices take more memory than instances
// would, but instances of 4 vertices leave half of every group of 8 lanes empty.
#include "upload.h"

#include "draw/camera/camera_math.h"

#include <stdlib.h>
#include <string.h>

static void add_attribute(struct scene_uploaded_mesh *mesh, enum rhw_vertex_format format)
{
    mesh->attributes[mesh->attribute_count++] =
        (struct rhw_attribute){.format = format, .offset = mesh->stride};
    mesh->stride += (uint32_t)rhw_vertex_format_size(format);
}

static void lay_out(struct scene_uploaded_mesh *mesh, const struct scene_mesh *source)
{
    mesh->normal = mesh->tangent = mesh->color = mesh->uv[0] = mesh->uv[1] = -1;
    add_attribute(mesh, RHW_VERTEX_FLOAT3);
    if (source->primitive == SCENE_PRIMITIVE_LINES) {
        add_attribute(mesh, RHW_VERTEX_FLOAT3);
    }
    if (source->normals) {
        mesh->normal = mesh->attribute_count;
        add_attribute(mesh, RHW_VERTEX_FLOAT3);
    }
    if (source->colors) {
        mesh->color = mesh->attribute_count;
        add_attribute(mesh, RHW_VERTEX_FLOAT4);
    }
    if (source->primitive != SCENE_PRIMITIVE_TRIANGLES) {
        return;
    }
    if (source->tangents) {
        mesh->tangent = mesh->attribute_count;
        add_attribute(mesh, RHW_VERTEX_FLOAT4);
    }
    for (int set = 0; set < SCENE_UV_SETS; set++) {
        if (source->uvs[set]) {
            mesh->uv[set] = mesh->attribute_count;
            add_attribute(mesh, RHW_VERTEX_FLOAT2);
        }
    }
}

// `other` is the far end of a line.
static void pack_vertex(const struct scene_uploaded_mesh *mesh, const struct scene_mesh *source, uint32_t v,
                        uint32_t other, unsigned char *out)
{
    const struct rhw_attribute *attributes = mesh->attributes;
    memcpy(out, source->positions[v], sizeof source->positions[v]);
    if (source->primitive == SCENE_PRIMITIVE_LINES) {
        memcpy(out + attributes[1].offset, source->positions[other], sizeof source->positions[other]);
    }
    if (mesh->normal >= 0) {
        memcpy(out + attributes[mesh->normal].offset, source->normals[v], sizeof source->normals[v]);
    }
    if (mesh->color >= 0) {
        memcpy(out + attributes[mesh->color].offset, source->colors[v], sizeof source->colors[v]);
    }
    if (mesh->tangent >= 0) {
        memcpy(out + attributes[mesh->tangent].offset, source->tangents[v], sizeof source->tangents[v]);
    }
    for (int set = 0; set < SCENE_UV_SETS; set++) {
        if (mesh->uv[set] >= 0) {
            memcpy(out + attributes[mesh->uv[set]].offset, source->uvs[set][v], sizeof source->uvs[set][v]);
        }
    }
}

static enum rhw_result create_buffer(rhw_context *context, void *data, size_t size, rhw_buffer *buffer)
{
    struct rhw_buffer_def def = rhw_buffer_def_default();
    def.size = size;
    def.data = data;
    return rhw_buffer_create(context, &def, buffer);
}

static enum rhw_result upload_triangles(rhw_context *context, const struct scene_mesh *source,
                                        struct scene_uploaded_mesh *mesh)
{
    unsigned char *packed = malloc((size_t)source->vertex_count * mesh->stride);
    if (!packed) {
        return RHW_ERROR_OUT_OF_MEMORY;
    }
    for (uint32_t v = 0; v < source->vertex_count; v++) {
        pack_vertex(mesh, source, v, v, packed + (size_t)v * mesh->stride);
    }
    enum rhw_result result =
        create_buffer(context, packed, (size_t)source->vertex_count * mesh->stride, &mesh->vertices);
    free(packed);
    if (result == RHW_OK) {
        result = create_buffer(context, source->indices,
                               (size_t)source->index_count * sizeof *source->indices, &mesh->indices);
    }
    mesh->index_count = source->index_count;
    return result;
}

static enum rhw_result upload_quads(rhw_context *context, const struct scene_mesh *source,
                                    struct scene_uploaded_mesh *mesh)
{
    const uint32_t per_quad = source->primitive == SCENE_PRIMITIVE_LINES ? 2 : 1;
    const uint32_t quads = source->index_count / per_quad;
    const size_t bytes = (size_t)quads * 4 * mesh->stride;
    if (quads > UINT32_MAX / 6) {
        return RHW_ERROR_UNSUPPORTED;
    }
    unsigned char *packed = malloc(bytes);
    uint32_t *indices = malloc((size_t)quads * 6 * sizeof *indices);
    if (!packed || !indices) {
        free(packed);
        free(indices);
        return RHW_ERROR_OUT_OF_MEMORY;
    }
    static const uint32_t quad[6] = {0, 1, 2, 2, 1, 3};
    for (uint32_t q = 0; q < quads; q++) {
        const uint32_t *ends = &source->indices[q * per_quad];
        for (uint32_t c = 0; c < 4; c++) {
            const uint32_t end = per_quad == 2 ? c >> 1 : 0;
            pack_vertex(mesh, source, ends[end], ends[per_quad - 1 - end],
                        packed + ((size_t)q * 4 + c) * mesh->stride);
        }
        for (uint32_t i = 0; i < 6; i++) {
            indices[(size_t)q * 6 + i] = q * 4 + quad[i];
        }
    }
    enum rhw_result result = create_buffer(context, packed, bytes, &mesh->vertices);
    if (result == RHW_OK) {
        result = create_buffer(context, indices, (size_t)quads * 6 * sizeof *indices, &mesh->indices);
    }
    mesh->index_count = quads * 6;
    free(packed);
    free(indices);
    return result;
}

// Tell whether the normals of a facet's corners lie on its other side, 120 degrees or more from the facet's own, which
// is further than interpolation leads.
static bool is_turned(const struct scene_mesh *mesh, uint32_t triangle)
{
    const uint32_t *const corner = &mesh->indices[3 * (size_t)triangle];
    double edge[2][3], sum[3], across[3];
    for (int c = 0; c < 3; c++) {
        const double first = (double)mesh->positions[corner[0]][c];
        edge[0][c] = (double)mesh->positions[corner[1]][c] - first;
        edge[1][c] = (double)mesh->positions[corner[2]][c] - first;
        sum[c] = (double)mesh->normals[corner[0]][c] + (double)mesh->normals[corner[1]][c] +
                 (double)mesh->normals[corner[2]][c];
    }
    scene_cross(edge[0], edge[1], across);
    const double along = scene_dot(sum, across), third = along / 3.0;
    return along < 0.0 && third * third > 0.25 * scene_dot(across, across);
}

// Tell whether most facets are turned. Some facets, spread over the mesh, speak for all.
static bool is_inside_out(const struct scene_mesh *mesh)
{
    enum { ASKED = 256 };
    if (mesh->primitive != SCENE_PRIMITIVE_TRIANGLES || !mesh->normals) {
        return false;
    }
    const uint32_t count = mesh->index_count / 3, step = count / ASKED + 1;
    uint32_t turned = 0, asked = 0;
    for (uint32_t triangle = 0; triangle < count; triangle += step) {
        turned += is_turned(mesh, triangle);
        asked++;
    }
    return turned > asked / 2;
}

static enum rhw_result upload_mesh(rhw_context *context, const struct scene_mesh *source,
                                   struct scene_uploaded_mesh *mesh)
{
    static const enum scene_vertex_kind kinds[] = {[SCENE_PRIMITIVE_TRIANGLES] = SCENE_VERTEX_SURFACE,
                                                   [SCENE_PRIMITIVE_LINES] = SCENE_VERTEX_LINE,
                                                   [SCENE_PRIMITIVE_POINTS] = SCENE_VERTEX_POINT};
    mesh->kind = kinds[source->primitive];
    mesh->inside_out = is_inside_out(source);
    lay_out(mesh, source);
    if (source->vertex_count == 0 || source->index_count == 0) {
        return RHW_OK; // index_count stays 0: nothing is drawn
    }
    return mesh->kind == SCENE_VERTEX_SURFACE ? upload_triangles(context, source, mesh)
                                              : upload_quads(context, source, mesh);
}

static enum rhw_result upload_material(struct scene_upload *upload, uint32_t m)
{
    const struct scene_material *source = &upload->model->materials[m];
    struct scene_uploaded_material *material = &upload->materials[m];
    for (int s = 0; s < SCENE_SLOT_COUNT; s++) {
        const struct scene_texture_slot *slot = &source->slots[s];
        if (slot->image < 0) {
            continue;
        }
        const bool as_color = scene_slot_is_color((enum scene_slot)s);
        const struct scene_uploaded_image *image = &upload->images[slot->image];
        struct rhw_sampler_def def = rhw_sampler_def_default();
        def.min_filter = slot->min_filter;
        def.mag_filter = slot->mag_filter;
        def.mip_filter = slot->mip_filter;
        def.address_u = slot->address_u;
        def.address_v = slot->address_v;
        memcpy(def.border, slot->border, sizeof def.border);
        material->slots[s].texture = as_color ? image->color : image->data;
        const enum rhw_result result = rhw_sampler_create(upload->context, &def, &material->slots[s].sampler);
        if (result != RHW_OK) {
            return result;
        }
        material->textured = material->textured || s != SCENE_SLOT_NORMAL;
    }
    const enum scene_occlusion occlusion = scene_occlusion_of(upload->model, source);
    material->occlusion_shared = occlusion != SCENE_OCCLUSION_APART;
    if (occlusion != SCENE_OCCLUSION_COMBINED) {
        return RHW_OK;
    }
    rhw_texture *const texture = &material->slots[SCENE_SLOT_METALLIC_ROUGHNESS].texture;
    const enum rhw_result result =
        scene_upload_combined(upload->context, upload->model, source, &upload->combined, texture);
    material->slots[SCENE_SLOT_OCCLUSION].texture = *texture;
    return result;
}

static void count_triangles(struct scene_upload *upload)
{
    uint32_t next = 1;
    for (uint32_t i = 0; i < upload->model->instance_count; i++) {
        const struct scene_mesh *mesh = &upload->model->meshes[upload->model->instances[i].mesh];
        static const uint32_t vertices[] = {
            [SCENE_PRIMITIVE_TRIANGLES] = 3, [SCENE_PRIMITIVE_LINES] = 2, [SCENE_PRIMITIVE_POINTS] = 1};
        upload->first_triangle[i] = next;
        next += mesh->index_count / vertices[mesh->primitive];
    }
}

// Meshes and where they stand.
static enum rhw_result upload_shape(struct scene_upload *upload)
{
    const struct scene_model *const model = upload->model;
    upload->meshes = calloc((size_t)model->mesh_count + 1, sizeof *upload->meshes);
    upload->first_triangle = calloc((size_t)model->instance_count + 1, sizeof *upload->first_triangle);
    if (!upload->meshes || !upload->first_triangle) {
        return RHW_ERROR_OUT_OF_MEMORY;
    }
    enum rhw_result result = RHW_OK;
    for (uint32_t i = 0; i < model->mesh_count && result == RHW_OK; i++) {
        result = upload_mesh(upload->context, &model->meshes[i], &upload->meshes[i]);
    }
    count_triangles(upload);
    return result;
}

enum rhw_result scene_upload_create(rhw_context *context, const struct scene_model *model,
                                    struct scene_upload *upload)
{
    *upload = (struct scene_upload){.context = context, .model = model};
    // One more than needed: calloc(0) may return NULL.
    upload->images = calloc((size_t)model->image_count + 1, sizeof *upload->images);
    upload->materials = calloc((size_t)model->material_count + 1, sizeof *upload->materials);
    upload->combined.images = calloc((size_t)model->material_count + 1, sizeof *upload->combined.images);
    enum rhw_result result = RHW_ERROR_OUT_OF_MEMORY;
    if (upload->images && upload->materials && upload->combined.images) {
        result = upload_shape(upload);
    }
    if (result == RHW_OK) {
        result = scene_upload_images(context, model, upload->images);
    }
    for (uint32_t i = 0; i < model->material_count && result == RHW_OK; i++) {
        result = upload_material(upload, i);
    }
    if (result != RHW_OK) {
        scene_upload_destroy(upload);
        return result;
    }
    return RHW_OK;
}

static void destroy_buffer(rhw_context *context, rhw_buffer buffer)
{
    if (buffer.generation) {
        rhw_buffer_destroy(context, buffer);
    }
}

static void destroy_texture(rhw_context *context, rhw_texture texture)
{
    if (texture.generation) {
        rhw_texture_destroy(context, texture);
    }
}

static void destroy_shape(struct scene_upload *upload)
{
    for (uint32_t i = 0; upload->meshes && i < upload->model->mesh_count; i++) {
        destroy_buffer(upload->context, upload->meshes[i].vertices);
        destroy_buffer(upload->context, upload->meshes[i].indices);
    }
    free(upload->meshes);
    free(upload->first_triangle);
    upload->meshes = NULL;
    upload->first_triangle = NULL;
}

enum rhw_result scene_upload_pose(struct scene_upload *upload, const struct scene_model *pose)
{
    destroy_shape(upload);
    upload->model = pose;
    return upload_shape(upload);
}

void scene_upload_destroy(struct scene_upload *upload)
{
    const struct scene_model *model = upload->model;
    destroy_shape(upload);
    for (uint32_t i = 0; upload->images && i < model->image_count; i++) {
        destroy_texture(upload->context, upload->images[i].color);
        destroy_texture(upload->context, upload->images[i].data);
    }
    for (uint32_t i = 0; i < upload->combined.count; i++) {
        destroy_texture(upload->context, upload->combined.images[i].texture);
    }
    for (uint32_t i = 0; upload->materials && i < model->material_count; i++) {
        for (int s = 0; s < SCENE_SLOT_COUNT; s++) {
            const rhw_sampler sampler = upload->materials[i].slots[s].sampler;
            if (sampler.generation) {
                rhw_sampler_destroy(upload->context, sampler);
            }
        }
    }
    free(upload->images);
    free(upload->materials);
    free(upload->combined.images);
    *upload = (struct scene_upload){0};
}
