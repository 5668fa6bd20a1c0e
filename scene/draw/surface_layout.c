// SPDX-License-Identifier: MIT
// What a draw binds follows from three things alone: what the pass wants, what the material has and what the mesh
// carries. Attributes and varyings that nobody reads are left out.
#include "surface_layout.h"

#include "elementary.h"

#include <string.h>

// Pixels of the picture; the last, the least of points that have a size of their own.
static const double line_half_width = 0.75, point_half_width = 2.25, disc_half_width = 1.0;
static const float data_blend_cutoff = 0.5f;

static void world_matrix(const struct scene_instance *instance, double world[16])
{
    for (int i = 0; i < 16; i++) {
        world[i] = (double)instance->world[i];
    }
}

static int32_t use_attribute(struct scene_surface_key *key, const struct scene_uploaded_mesh *mesh,
                             int attribute)
{
    if (attribute < 0) {
        return -1;
    }
    for (int32_t i = 0; i < key->attribute_count; i++) {
        if (key->attributes[i][1] == (int32_t)mesh->attributes[attribute].offset) {
            return i;
        }
    }
    key->attributes[key->attribute_count][0] = (int32_t)mesh->attributes[attribute].format;
    key->attributes[key->attribute_count][1] = (int32_t)mesh->attributes[attribute].offset;
    return key->attribute_count++;
}

// Returns where the components begin.
static int32_t add_varying(struct scene_surface_key *key, int32_t components)
{
    int32_t first = 0;
    for (int32_t i = 0; i < key->varying_count; i++) {
        first += key->varyings[i];
    }
    key->varyings[key->varying_count++] = components;
    return first;
}

// A set under a transform, shared with whoever asked for the same before; −1 where there are too many. Streams are the
// last varyings.
static int32_t use_stream(struct scene_surface *s, struct scene_surface_key *key,
                          const struct scene_uploaded_mesh *mesh, uint32_t set, const float transform[6])
{
    const int32_t attribute = use_attribute(key, mesh, mesh->uv[set]);
    for (int32_t i = 0; i < s->stream_count; i++) {
        if (s->streams[i].attribute == attribute &&
            memcmp(s->streams[i].transform, transform, sizeof s->streams[i].transform) == 0) {
            return s->varying_uv + 2 * i;
        }
    }
    if (s->stream_count == SCENE_UV_STREAMS) {
        return -1;
    }
    const int32_t at = add_varying(key, 2);
    if (s->stream_count == 0) {
        s->varying_uv = at;
    }
    struct scene_uv_stream *stream = &s->streams[s->stream_count++];
    stream->attribute = attribute;
    memcpy(stream->transform, transform, sizeof stream->transform);
    key->stream_count = s->stream_count;
    return at;
}

static void use_slot(struct scene_surface *s, struct scene_surface_key *key,
                     const struct scene_uploaded_mesh *mesh, const struct scene_material *material,
                     enum scene_slot slot)
{
    const struct scene_texture_slot *source = &material->slots[slot];
    s->slot_unit[slot] = (int32_t)slot;
    if (source->image >= 0) {
        s->slot_varying[slot] = use_stream(s, key, mesh, source->uv_set, source->transform);
    }
}

// The slots that read the stream of the first one are sampled at once, where there are several.
static uint32_t shared_slots(const struct scene_surface *s)
{
    uint32_t slots = 0;
    int32_t stream = -1;
    for (int slot = 0; slot < SCENE_BASE_SLOTS; slot++) {
        const bool read =
            s->slot_varying[slot] >= 0 && !(slot == SCENE_SLOT_OCCLUSION && s->occlusion_shared);
        stream = stream < 0 && read ? s->slot_varying[slot] : stream;
        slots |= read && s->slot_varying[slot] == stream ? 1u << slot : 0;
    }
    return slots & (slots - 1) ? slots : 0;
}

static void set_matrices(struct scene_surface *s, const struct scene_surface_pass *def,
                         const struct scene_instance *instance)
{
    double world[16], clip[16], normal[9];
    world_matrix(instance, world);
    scene_matrix_multiply(def->view_projection, world, clip);
    scene_matrix_normal(world, normal);
    for (int i = 0; i < 16; i++) {
        s->clip[i] = (float)clip[i];
    }
    for (int r = 0; r < 3; r++) {
        for (int c = 0; c < 4; c++) {
            s->world[4 * r + c] = instance->world[4 * c + r];
        }
    }
    // Only directions count; scaled so that a tiny or huge matrix does not leave float's range.
    double largest = 0.0;
    for (int i = 0; i < 9; i++) {
        const double magnitude = normal[i] < 0.0 ? -normal[i] : normal[i];
        largest = magnitude > largest ? magnitude : largest;
    }
    for (int i = 0; i < 9; i++) {
        s->normal[i] = largest > 0.0 ? (float)(normal[i] / largest) : 0.0f;
    }
    s->handedness = instance->mirrored ? -1.0f : 1.0f;
}

static void set_material(struct scene_surface *s, const struct scene_surface_pass *def,
                         const struct scene_material *material)
{
    memcpy(s->base_color, material->base_color, sizeof s->base_color);
    memcpy(s->emissive, material->emissive, sizeof s->emissive);
    s->metallic = material->metallic;
    s->roughness = material->roughness;
    s->normal_scale = material->normal_scale;
    s->occlusion_strength = material->occlusion_strength;
    s->double_sided = material->double_sided;
    s->alpha_mode = (int32_t)material->alpha_mode;
    s->casts = !material->is_ground && !scene_material_transmits(material) &&
               material->alpha_mode != SCENE_ALPHA_BLEND;
    if (material->alpha_mode == SCENE_ALPHA_MASK) {
        s->alpha_cutoff = material->alpha_cutoff;
    } else if (material->alpha_mode == SCENE_ALPHA_BLEND && (def->data_outputs || def->shadow)) {
        s->alpha_cutoff = data_blend_cutoff;
    }
}

static void use_position(struct scene_surface *s, struct scene_surface_key *key)
{
    s->varying_position = add_varying(key, 3);
    key->position_number = key->varying_count;
}

// The plane of a fragment, in which shadows are looked up, follows from the derivatives of its position. What a facet
// stands for follows from the tangent planes of its corners.
static void use_shadows(struct scene_surface *s, struct scene_surface_key *key,
                        const struct scene_frame *frame)
{
    for (int32_t i = 0; i < frame->light_count; i++) {
        s->shadowed = s->shadowed || frame->lights[i].map_count > 0;
    }
    if (s->shadowed && s->is_triangle) {
        key->position_derivatives = true;
        key->uses |= RHW_USE_COORD; // for the guide
        s->varying_support = add_varying(key, 1);
    }
}

static void use_normal(struct scene_surface *s, struct scene_surface_key *key,
                       const struct scene_uploaded_mesh *mesh)
{
    s->attribute_normal = use_attribute(key, mesh, mesh->normal);
    if (s->attribute_normal >= 0) {
        s->varying_normal = add_varying(key, 3);
        key->uses |= s->double_sided && s->is_triangle ? RHW_USE_FACING : 0;
    }
}

static void use_tangent(struct scene_surface *s, struct scene_surface_key *key,
                        const struct scene_uploaded_mesh *mesh)
{
    s->attribute_tangent = use_attribute(key, mesh, mesh->tangent);
    if (s->attribute_tangent >= 0) {
        s->varying_tangent = add_varying(key, 4);
    }
}

static void use_color(struct scene_surface *s, struct scene_surface_key *key,
                      const struct scene_uploaded_mesh *mesh)
{
    s->attribute_color = use_attribute(key, mesh, mesh->color);
    if (s->attribute_color >= 0) {
        s->varying_color = add_varying(key, 4);
    }
}

// Textures of layers take the draw's slots after those of the base.
static void use_layers(struct scene_surface *s, const struct scene_material *material)
{
    const struct scene_layers *layers = &material->layers;
    const int32_t end = SCENE_SLOT_BACKDROP - (s->frame->peel_samples > 0);
    int32_t unit = SCENE_BASE_SLOTS;
    for (int slot = SCENE_BASE_SLOTS; slot < SCENE_SLOT_COUNT; slot++) {
        if (s->slot_varying[slot] >= 0 && unit < end) {
            s->slot_unit[slot] = unit++;
        } else {
            s->slot_varying[slot] = -1;
        }
    }
    s->peel_unit = unit;
    s->layers = layers;
    // The thickness is of the mesh; the world may stretch it, differently along each axis.
    double stretch = 0.0;
    for (int axis = 0; axis < 3; axis++) {
        double square = 0.0;
        for (int r = 0; r < 3; r++) {
            square += (double)s->world[4 * r + axis] * (double)s->world[4 * r + axis];
        }
        stretch += __builtin_sqrt(square) / 3.0;
    }
    s->thickness = layers->thickness * (float)stretch;
    for (int c = 0; c < 3; c++) {
        const double color =
            layers->attenuation_color[c] > 1e-6f ? (double)layers->attenuation_color[c] : 1e-6;
        s->attenuation[c] = (float)(scene_log(color) / scene_log(2.0) / (double)layers->attenuation_distance);
    }
}

static void lay_out_color(struct scene_surface *s, struct scene_surface_key *key,
                          const struct scene_surface_pass *def, const struct scene_uploaded_mesh *mesh,
                          const struct scene_material *material,
                          const struct scene_uploaded_material *uploaded)
{
    const bool plain = def->frame->plain != 0;
    const bool lit = !plain && !material->unlit && mesh->normal >= 0;
    const bool layered = lit && material->layers.used && mesh->kind == SCENE_VERTEX_SURFACE;
    const bool mapped =
        lit && mesh->tangent >= 0 && (layered || material->slots[SCENE_SLOT_NORMAL].image >= 0);
    if (lit) {
        use_position(s, key);
        use_normal(s, key, mesh);
        use_shadows(s, key, def->frame);
        key->uses |= def->frame->guide.occlusion ? RHW_USE_COORD : 0;
    }
    if (mapped) {
        use_tangent(s, key, mesh);
    }
    use_color(s, key, mesh);
    if (mesh->kind == SCENE_VERTEX_POINT) {
        s->varying_disc = add_varying(key, 2);
    }
    if (mesh->kind == SCENE_VERTEX_SURFACE) {
        use_slot(s, key, mesh, material, SCENE_SLOT_BASE_COLOR);
        const int slots = !lit ? 0 : layered ? SCENE_SLOT_COUNT : SCENE_BASE_SLOTS;
        for (int slot = SCENE_SLOT_METALLIC_ROUGHNESS; slot < slots; slot++) {
            if (slot != SCENE_SLOT_NORMAL || mapped) {
                use_slot(s, key, mesh, material, (enum scene_slot)slot);
            }
        }
    }
    if (layered) {
        use_layers(s, material);
    } else {
        s->occlusion_shared = uploaded->occlusion_shared;
        s->shared_slots = lit ? shared_slots(s) : 0;
    }
    const bool textured = uploaded->textured && mesh->kind == SCENE_VERTEX_SURFACE;
    key->fragment = material->is_ground ? SCENE_FRAGMENT_GROUND
                    : !lit              ? SCENE_FRAGMENT_UNLIT
                    : layered           ? SCENE_FRAGMENT_LAYERED
                    : mapped            ? SCENE_FRAGMENT_MAPPED
                    : textured          ? SCENE_FRAGMENT_TEXTURED
                                        : SCENE_FRAGMENT_LIT;
    const bool blended = material->alpha_mode == SCENE_ALPHA_BLEND && !plain;
    key->peel = def->part == SCENE_SURFACES_PEELED || def->part == SCENE_SURFACES_GLASS;
    key->blend = blended && !key->peel;
    if (def->frame->peel_samples > 0) {
        key->uses |= RHW_USE_COORD | RHW_USE_DISCARD | (def->frame->peel_samples > 1 ? RHW_USE_SAMPLE : 0);
    }
    if (def->wireframe != SCENE_WIREFRAME_NONE && s->is_triangle) {
        s->wireframe = 1;
        key->uses |= RHW_USE_BARYCENTRIC | RHW_USE_BARYCENTRIC_DERIVATIVES;
    }
}

static void lay_out_data(struct scene_surface *s, struct scene_surface_key *key,
                         const struct scene_surface_pass *def, const struct scene_uploaded_mesh *mesh,
                         const struct scene_material *material)
{
    const uint32_t outputs = def->data_outputs;
    const bool normal = (outputs & SCENE_OUTPUT_NORMAL) && mesh->normal >= 0;
    const bool mapped =
        normal && !def->guide && mesh->tangent >= 0 && material->slots[SCENE_SLOT_NORMAL].image >= 0;
    use_position(s, key);
    if (normal) {
        use_normal(s, key, mesh);
    }
    if (mapped) {
        use_tangent(s, key, mesh);
    }
    if (s->alpha_cutoff > 0.0f) {
        use_color(s, key, mesh);
    }
    if (mesh->kind == SCENE_VERTEX_POINT) {
        s->varying_disc = add_varying(key, 2);
    }
    if (mesh->kind == SCENE_VERTEX_SURFACE) {
        static const float identity[6] = {1.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f};
        if (s->alpha_cutoff > 0.0f) {
            use_slot(s, key, mesh, material, SCENE_SLOT_BASE_COLOR);
        }
        if (mapped) {
            use_slot(s, key, mesh, material, SCENE_SLOT_NORMAL);
        }
        if ((outputs & SCENE_OUTPUT_UV) && mesh->uv[0] >= 0) {
            s->uv_varying = use_stream(s, key, mesh, 0, identity);
        }
    }
    key->fragment = def->guide ? SCENE_FRAGMENT_GUIDE : SCENE_FRAGMENT_DATA;
    key->position_derivatives = def->guide && s->is_triangle;
    key->counts = outputs == SCENE_OUTPUT_OVERDRAW;
    key->uses |= outputs & (SCENE_OUTPUT_DEPTH | SCENE_OUTPUT_DISTANCE) ? RHW_USE_COORD : 0;
    key->uses |= outputs & SCENE_OUTPUT_TRIANGLE ? RHW_USE_IDS : 0;
    key->uses |= outputs & SCENE_OUTPUT_BARYCENTRIC ? RHW_USE_BARYCENTRIC : 0;
}

static void lay_out_shadow(struct scene_surface *s, struct scene_surface_key *key,
                           const struct scene_uploaded_mesh *mesh, const struct scene_material *material)
{
    key->fragment = SCENE_FRAGMENT_NONE;
    if (s->alpha_cutoff > 0.0f) {
        use_color(s, key, mesh);
        use_slot(s, key, mesh, material, SCENE_SLOT_BASE_COLOR);
        key->fragment = SCENE_FRAGMENT_SHADOW;
    }
}

// A row of the matrix is as long as a unit of the model is wide, or high, in clip coordinates.
static void set_disc(struct scene_surface *s, float radius)
{
    for (int row = 0; row < 2; row++) {
        const float *m = s->clip + row;
        s->disc[row] = radius * __builtin_sqrtf(m[0] * m[0] + m[4] * m[4] + m[8] * m[8]);
    }
}

void scene_surface_lay_out(const struct scene_upload *upload, const struct scene_surface_pass *def,
                           uint32_t instance_index, struct scene_surface *s, struct scene_surface_key *key)
{
    const struct scene_instance *instance = &upload->model->instances[instance_index];
    const struct scene_uploaded_mesh *mesh = &upload->meshes[instance->mesh];
    const uint32_t material_index = upload->model->meshes[instance->mesh].material;
    const struct scene_material *material = &upload->model->materials[material_index];
    memset(key, 0, sizeof *key);
    *s = (struct scene_surface){.frame = def->frame,
                                .attribute_normal = -1,
                                .attribute_tangent = -1,
                                .attribute_color = -1,
                                .varying_position = -1,
                                .varying_normal = -1,
                                .varying_tangent = -1,
                                .varying_color = -1,
                                .varying_disc = -1,
                                .varying_support = -1,
                                .uv_varying = -1};
    for (int slot = 0; slot < SCENE_SLOT_COUNT; slot++) {
        s->slot_varying[slot] = -1;
    }
    s->peel_unit = SCENE_BASE_SLOTS;
    s->is_triangle = mesh->kind == SCENE_VERTEX_SURFACE;
    s->inside_out = mesh->inside_out;
    s->triangles_per_id = s->is_triangle ? 1 : 2;
    s->object = instance->object;
    s->first_triangle = upload->first_triangle[instance_index];
    const float radius = upload->model->meshes[instance->mesh].point_radius;
    s->half_width = def->frame->samples * (float)(mesh->kind == SCENE_VERTEX_LINE ? line_half_width
                                                  : radius > 0                    ? disc_half_width
                                                                                  : point_half_width);
    set_matrices(s, def, instance);
    set_disc(s, radius);
    set_material(s, def, material);

    key->vertex = (int32_t)mesh->kind;
    key->stride = (int32_t)mesh->stride;
    key->interpolate = (int32_t)def->interpolate;
    // The thickness of a volume takes its far side in already.
    const bool is_volume = def->part == SCENE_SURFACES_GLASS && material->layers.thickness > 0.0f;
    const bool has_back = (s->double_sided && !is_volume) || !s->is_triangle;
    key->cull = has_back ? RHW_CULL_NONE : RHW_CULL_BACK;
    key->front = instance->mirrored ? RHW_CLOCKWISE : RHW_COUNTER_CLOCKWISE;
    key->format_count = def->format_count;
    for (int i = 0; i < def->format_count; i++) {
        key->formats[i] = (int32_t)def->formats[i];
    }
    key->ground = material->is_ground;
    use_attribute(key, mesh, 0);
    if (mesh->kind == SCENE_VERTEX_LINE) {
        use_attribute(key, mesh, 1);
    }
    if (def->shadow) {
        lay_out_shadow(s, key, mesh, material);
    } else if (def->data_outputs) {
        lay_out_data(s, key, def, mesh, material);
    } else {
        lay_out_color(s, key, def, mesh, material, &upload->materials[material_index]);
    }
    key->uses |= s->alpha_cutoff > 0.0f || s->varying_disc >= 0 ? RHW_USE_DISCARD : 0;
}
