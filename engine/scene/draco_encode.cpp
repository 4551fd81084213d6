#include "engine/scene/draco_encode.h"

#include <draco/compression/decode.h>
#include <draco/compression/expert_encode.h>
#include <draco/mesh/mesh.h>
#include <fmt/format.h>

#include <glm/common.hpp>
#include <limits>
#include <span>

#include "engine/core/check.h"
#include "engine/core/error.h"

namespace rowland::scene {

namespace {

[[noreturn]] void fail(const std::string& found) {
    fail_system("Draco", found, "check the mesh");
}

void check_mesh(const Mesh& mesh) {
    ROWLAND_CHECK(!mesh.positions.empty() && !mesh.indices.empty(), "an empty mesh cannot be written");
    ROWLAND_CHECK_OP(mesh.normals.size(), ==, mesh.positions.size());
    ROWLAND_CHECK_OP(mesh.tangents.size(), ==, mesh.positions.size());
    ROWLAND_CHECK_OP(mesh.uvs.size(), ==, mesh.positions.size());
    ROWLAND_CHECK_OP(mesh.indices.size() % 3, ==, 0U);
    // Draco's decoders refuse streams with more: such a mesh consists mostly of unused vertices.
    ROWLAND_CHECK_OP(mesh.positions.size(), <=, mesh.indices.size());
    for (const std::uint32_t index : mesh.indices) ROWLAND_CHECK_OP(index, <, mesh.positions.size());
}

template <typename Vector>
void add_attribute(draco::Mesh& target, draco::GeometryAttribute::Type type, const std::vector<Vector>& values) {
    constexpr auto kComponents = static_cast<int8_t>(Vector::length());
    draco::GeometryAttribute attribute;
    attribute.Init(type, nullptr, static_cast<std::uint8_t>(kComponents), draco::DT_FLOAT32, false, sizeof(Vector), 0);
    const int id = target.AddAttribute(attribute, true, static_cast<std::uint32_t>(values.size()));
    for (std::uint32_t i = 0; i < values.size(); ++i)
        target.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(i), &values[i]);
}

void fill(const Mesh& mesh, draco::Mesh& target) {
    target.set_num_points(static_cast<std::uint32_t>(mesh.positions.size()));
    target.SetNumFaces(mesh.indices.size() / 3);
    for (std::uint32_t i = 0; i < target.num_faces(); ++i) {
        const std::uint32_t* corner = &mesh.indices[std::size_t{i} * 3];
        target.SetFace(draco::FaceIndex(i),
                       {draco::PointIndex(corner[0]), draco::PointIndex(corner[1]), draco::PointIndex(corner[2])});
    }
    // In the order of DracoIds.
    add_attribute(target, draco::GeometryAttribute::POSITION, mesh.positions);
    add_attribute(target, draco::GeometryAttribute::NORMAL, mesh.normals);
    // The bitstream has no type for tangents (KHR_draco_mesh_compression, "Conformance").
    add_attribute(target, draco::GeometryAttribute::GENERIC, mesh.tangents);
    add_attribute(target, draco::GeometryAttribute::TEX_COORD, mesh.uvs);
}

std::vector<char> encode(const Mesh& mesh, const DracoBits& bits) {
    draco::Mesh source;
    fill(mesh, source);
    draco::ExpertEncoder encoder(source);
    encoder.SetEncodingMethod(draco::MESH_SEQUENTIAL_ENCODING);
    constexpr int kSpeed = 5;
    encoder.SetSpeedOptions(kSpeed, kSpeed);
    encoder.SetAttributeQuantization(DracoIds::kPosition, bits.position);
    encoder.SetAttributeQuantization(DracoIds::kNormal, bits.normal);
    encoder.SetAttributeQuantization(DracoIds::kTangent, bits.tangent);
    encoder.SetAttributeQuantization(DracoIds::kUv, bits.uv);
    draco::EncoderBuffer buffer;
    const draco::Status status = encoder.EncodeToBuffer(&buffer);
    if (!status.ok()) fail(fmt::format("encoding failed: {}", status.error_msg_string()));
    return {buffer.data(), buffer.data() + buffer.size()};
}

/// The bounds after quantisation, as readers will decode them.
Bounds decoded_bounds(std::span<const char> stream, std::size_t vertex_count) {
    draco::DecoderBuffer buffer;
    buffer.Init(stream.data(), stream.size());
    draco::Decoder decoder;
    auto result = decoder.DecodeMeshFromBuffer(&buffer);
    if (!result.ok()) fail(fmt::format("what it encoded cannot be decoded: {}", result.status().error_msg_string()));
    const std::unique_ptr<draco::Mesh> mesh = std::move(result).value();
    if (mesh->num_points() != vertex_count)
        fail(fmt::format("{} vertices became {}", vertex_count, mesh->num_points()));
    const draco::PointAttribute* positions = mesh->GetAttributeByUniqueId(DracoIds::kPosition);
    Bounds box{glm::vec3(std::numeric_limits<float>::max()), glm::vec3(std::numeric_limits<float>::lowest())};
    for (std::uint32_t i = 0; i < mesh->num_points(); ++i) {
        glm::vec3 position;
        positions->GetMappedValue(draco::PointIndex(i), &position);
        box.minimum = glm::min(box.minimum, position);
        box.maximum = glm::max(box.maximum, position);
    }
    return box;
}

}  // namespace

DracoStream encode_draco(const Mesh& mesh, const DracoBits& bits) {
    check_mesh(mesh);
    for (const int count : {bits.position, bits.normal, bits.tangent, bits.uv}) {
        ROWLAND_CHECK_OP(count, >=, 2);
        ROWLAND_CHECK_OP(count, <=, 30);
    }
    DracoStream stream;
    stream.bytes = encode(mesh, bits);
    stream.bounds = decoded_bounds(stream.bytes, mesh.positions.size());
    return stream;
}

}  // namespace rowland::scene
