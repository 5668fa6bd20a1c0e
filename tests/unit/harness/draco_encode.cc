// SPDX-License-Identifier: MIT
// See draco_encode.h.
#include "draco_encode.h"

#include <cstring>

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>

size_t draco_encode(const struct draco_soup *soup, unsigned char *bytes, size_t room)
{
    using draco::GeometryAttribute;
    draco::TriangleSoupMeshBuilder builder;
    builder.Start(soup->triangles);
    const int ids[5] = {
        builder.AddAttribute(GeometryAttribute::POSITION, 3, draco::DT_FLOAT32),
        soup->normals ? builder.AddAttribute(GeometryAttribute::NORMAL, 3, draco::DT_FLOAT32) : -1,
        soup->uvs ? builder.AddAttribute(GeometryAttribute::TEX_COORD, 2, draco::DT_FLOAT32) : -1,
        soup->colors ? builder.AddAttribute(GeometryAttribute::COLOR, 4, draco::DT_UINT8) : -1,
        soup->joints ? builder.AddAttribute(GeometryAttribute::GENERIC, 4, draco::DT_FLOAT32) : -1,
    };
    for (int i = 0; i < soup->triangles; i++) {
        const draco::FaceIndex face(static_cast<uint32_t>(i));
        const int k = 3 * i;
        builder.SetAttributeValuesForFace(ids[0], face, soup->positions[k], soup->positions[k + 1],
                                          soup->positions[k + 2]);
        if (soup->normals) {
            builder.SetAttributeValuesForFace(ids[1], face, soup->normals[k], soup->normals[k + 1],
                                              soup->normals[k + 2]);
        }
        if (soup->uvs) {
            builder.SetAttributeValuesForFace(ids[2], face, soup->uvs[k], soup->uvs[k + 1], soup->uvs[k + 2]);
        }
        if (soup->colors) {
            builder.SetAttributeValuesForFace(ids[3], face, soup->colors[k], soup->colors[k + 1],
                                              soup->colors[k + 2]);
        }
        if (soup->joints) {
            builder.SetAttributeValuesForFace(ids[4], face, soup->joints[k], soup->joints[k + 1],
                                              soup->joints[k + 2]);
        }
    }
    std::unique_ptr<draco::Mesh> mesh = builder.Finalize();
    if (!mesh) {
        return 0;
    }
    for (int i = 0; i < 5; i++) {
        if (ids[i] >= 0) {
            mesh->attribute(ids[i])->set_unique_id(static_cast<uint32_t>(i));
        }
    }
    draco::Encoder encoder;
    encoder.SetAttributeQuantization(GeometryAttribute::POSITION, soup->position_bits);
    encoder.SetAttributeQuantization(GeometryAttribute::NORMAL, soup->normal_bits);
    encoder.SetAttributeQuantization(GeometryAttribute::TEX_COORD, soup->uv_bits);
    encoder.SetAttributeQuantization(GeometryAttribute::GENERIC, soup->joint_bits);
    draco::EncoderBuffer buffer;
    if (!encoder.EncodeMeshToBuffer(*mesh, &buffer).ok() || buffer.size() > room) {
        return 0;
    }
    std::memcpy(bytes, buffer.data(), buffer.size());
    return buffer.size();
}
