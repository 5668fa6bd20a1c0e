// SPDX-License-Identifier: MIT
// Calls Draco and undoes what it calls transforms.
#include "draco_decoder.h"

#include <cmath>
#include <memory>
#include <string>

#include <draco/attributes/attribute_octahedron_transform.h>
#include <draco/attributes/attribute_quantization_transform.h>
#include <draco/compression/decode.h>

struct scene_draco {
    std::unique_ptr<draco::Mesh> mesh;
};

namespace {

// Read elements as they are kept, before what Draco calls a transform.
bool read_whole(const draco::PointAttribute &attribute, uint32_t vertex, int count, int32_t *values)
{
    const draco::AttributeValueIndex place = attribute.mapped_index(draco::PointIndex(vertex));
    return attribute.ConvertValue<int32_t>(place, static_cast<int8_t>(count), values);
}

// Make floats of whole numbers that count from the least value on: min + q·range/(2^bits − 1).
bool make_scaled(const draco::PointAttribute &attribute, uint32_t vertices, int components, float *out)
{
    draco::AttributeQuantizationTransform transform;
    if (!transform.InitFromAttribute(attribute)) {
        return false;
    }
    const float step = transform.range() / static_cast<float>((1u << transform.quantization_bits()) - 1);
    for (uint32_t i = 0; i < vertices; i++) {
        int32_t values[16] = {};
        if (!read_whole(attribute, i, components, values)) {
            return false;
        }
        for (int c = 0; c < components; c++) {
            *out++ = transform.min_value(c) + static_cast<float>(values[c]) * step;
        }
    }
    return true;
}

// Make unit vectors of two coordinates on an octahedron that is cut open along its far half and laid flat.
bool make_normals(const draco::PointAttribute &attribute, uint32_t vertices, float *out)
{
    draco::AttributeOctahedronTransform transform;
    if (!transform.InitFromAttribute(attribute)) {
        return false;
    }
    const float scale = 2 / static_cast<float>((1u << transform.quantization_bits()) - 2);
    for (uint32_t i = 0; i < vertices; i++, out += 3) {
        int32_t values[2] = {};
        if (!read_whole(attribute, i, 2, values)) {
            return false;
        }
        float y = static_cast<float>(values[0]) * scale - 1, z = static_cast<float>(values[1]) * scale - 1;
        const float x = 1 - std::fabs(y) - std::fabs(z), beyond = x < 0 ? -x : 0;
        y += y < 0 ? beyond : -beyond;
        z += z < 0 ? beyond : -beyond;
        const float length = std::sqrt(x * x + y * y + z * z);
        out[0] = length > 0 ? x / length : 0;
        out[1] = length > 0 ? y / length : 0;
        out[2] = length > 0 ? z / length : 0;
    }
    return true;
}

template <typename T>
bool convert(const draco::PointAttribute &attribute, uint32_t vertices, int components, void *elements)
{
    T *out = static_cast<T *>(elements);
    for (uint32_t i = 0; i < vertices; i++, out += components) {
        const draco::AttributeValueIndex place = attribute.mapped_index(draco::PointIndex(i));
        if (!attribute.ConvertValue<T>(place, static_cast<int8_t>(components), out)) {
            return false;
        }
    }
    return true;
}

bool read_attribute(const draco::PointAttribute &attribute, uint32_t vertices, scene_draco_type type,
                    int components, void *elements)
{
    if (const draco::AttributeTransformData *data = attribute.GetAttributeTransformData()) {
        if (type != SCENE_DRACO_FLOAT) {
            return false;
        }
        float *floats = static_cast<float *>(elements);
        return data->transform_type() == draco::ATTRIBUTE_OCTAHEDRON_TRANSFORM
                   ? components == 3 && make_normals(attribute, vertices, floats)
                   : make_scaled(attribute, vertices, components, floats);
    }
    switch (type) {
    case SCENE_DRACO_INT8: return convert<int8_t>(attribute, vertices, components, elements);
    case SCENE_DRACO_UINT8: return convert<uint8_t>(attribute, vertices, components, elements);
    case SCENE_DRACO_INT16: return convert<int16_t>(attribute, vertices, components, elements);
    case SCENE_DRACO_UINT16: return convert<uint16_t>(attribute, vertices, components, elements);
    case SCENE_DRACO_UINT32: return convert<uint32_t>(attribute, vertices, components, elements);
    default: return convert<float>(attribute, vertices, components, elements);
    }
}

} // namespace

const struct scene_draco *scene_draco_open(const void *bytes, size_t size, const char **problem)
try {
    draco::DecoderBuffer buffer;
    buffer.Init(static_cast<const char *>(bytes), size);
    draco::Decoder decoder;
    for (int type = draco::GeometryAttribute::POSITION;
         type < draco::GeometryAttribute::NAMED_ATTRIBUTES_COUNT; type++) {
        decoder.SetSkipAttributeTransform(static_cast<draco::GeometryAttribute::Type>(type));
    }
    auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok()) {
        static std::string reason;
        reason = decoded.status().error_msg_string();
        *problem = reason.c_str();
        return nullptr;
    }
    return new scene_draco{std::move(decoded).value()};
} catch (...) {
    *problem = "needs more memory than there is";
    return nullptr;
}

uint32_t scene_draco_vertex_count(const struct scene_draco *draco)
{
    return draco->mesh->num_points();
}

uint32_t scene_draco_triangle_count(const struct scene_draco *draco)
{
    return draco->mesh->num_faces();
}

void scene_draco_indices(const struct scene_draco *draco, uint32_t *indices)
{
    for (uint32_t i = 0; i < draco->mesh->num_faces(); i++) {
        const draco::Mesh::Face &face = draco->mesh->face(draco::FaceIndex(i));
        for (int k = 0; k < 3; k++) {
            *indices++ = face[k].value();
        }
    }
}

int scene_draco_components(const struct scene_draco *draco, uint32_t id)
{
    const draco::PointAttribute *attribute = draco->mesh->GetAttributeByUniqueId(id);
    if (attribute == nullptr) {
        return 0;
    }
    const draco::AttributeTransformData *data = attribute->GetAttributeTransformData();
    const bool is_octahedron =
        data != nullptr && data->transform_type() == draco::ATTRIBUTE_OCTAHEDRON_TRANSFORM;
    return is_octahedron ? 3 : attribute->num_components();
}

bool scene_draco_attribute(const struct scene_draco *draco, uint32_t id, enum scene_draco_type type,
                           int components, void *elements)
try {
    const draco::PointAttribute *attribute = draco->mesh->GetAttributeByUniqueId(id);
    return attribute != nullptr &&
           read_attribute(*attribute, draco->mesh->num_points(), type, components, elements);
} catch (...) {
    return false;
}
