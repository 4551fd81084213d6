#include "engine/scene/glb_write.h"

#include <draco/compression/decode.h>
#include <draco/compression/expert_encode.h>
#include <draco/mesh/mesh.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>

#include "engine/core/byte_stream.h"
#include "engine/core/check.h"
#include "engine/core/error.h"

namespace rowland::scene {

namespace {

/// Keys in the order they are written, so that the bytes are the same every time.
using Json = nlohmann::ordered_json;

// Draco's ids of the attributes, in the order in which they are added.
enum AttributeId : int { kPosition = 0, kNormal = 1, kTangent = 2, kUv = 3 };

[[noreturn]] void fail(const std::string& found) {
    throw Error({.file = {},
                 .place = "Draco",
                 .found = found,
                 .expected = {},
                 .remedy = "check the mesh",
                 .fault = Fault::System});
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
    add_attribute(target, draco::GeometryAttribute::POSITION, mesh.positions);
    add_attribute(target, draco::GeometryAttribute::NORMAL, mesh.normals);
    // The bitstream has no type for tangents (KHR_draco_mesh_compression, "Conformance").
    add_attribute(target, draco::GeometryAttribute::GENERIC, mesh.tangents);
    add_attribute(target, draco::GeometryAttribute::TEX_COORD, mesh.uvs);
}

std::vector<char> encode(const Mesh& mesh, const GlbWriteSettings& settings) {
    draco::Mesh source;
    fill(mesh, source);
    draco::ExpertEncoder encoder(source);
    encoder.SetEncodingMethod(draco::MESH_SEQUENTIAL_ENCODING);
    constexpr int kSpeed = 5;
    encoder.SetSpeedOptions(kSpeed, kSpeed);
    encoder.SetAttributeQuantization(kPosition, settings.position_bits);
    encoder.SetAttributeQuantization(kNormal, settings.normal_bits);
    encoder.SetAttributeQuantization(kTangent, settings.tangent_bits);
    encoder.SetAttributeQuantization(kUv, settings.uv_bits);
    draco::EncoderBuffer buffer;
    const draco::Status status = encoder.EncodeToBuffer(&buffer);
    if (!status.ok()) fail(fmt::format("encoding failed: {}", status.error_msg_string()));
    return {buffer.data(), buffer.data() + buffer.size()};
}

struct Extent {
    glm::vec3 minimum{std::numeric_limits<float>::max()};
    glm::vec3 maximum{std::numeric_limits<float>::lowest()};
};

/// The bounds that readers will find: those of the decoded positions, not of the ones before quantisation.
Extent decoded_extent(std::span<const char> stream, std::size_t vertex_count) {
    draco::DecoderBuffer buffer;
    buffer.Init(stream.data(), stream.size());
    draco::Decoder decoder;
    auto result = decoder.DecodeMeshFromBuffer(&buffer);
    if (!result.ok()) fail(fmt::format("what it encoded cannot be decoded: {}", result.status().error_msg_string()));
    const std::unique_ptr<draco::Mesh> mesh = std::move(result).value();
    if (mesh->num_points() != vertex_count)
        fail(fmt::format("{} vertices became {}", vertex_count, mesh->num_points()));
    const draco::PointAttribute* positions = mesh->GetAttributeByUniqueId(kPosition);
    Extent extent;
    for (std::uint32_t i = 0; i < mesh->num_points(); ++i) {
        glm::vec3 position;
        positions->GetMappedValue(draco::PointIndex(i), &position);
        extent.minimum = glm::min(extent.minimum, position);
        extent.maximum = glm::max(extent.maximum, position);
    }
    return extent;
}

Json to_json(const glm::vec3& v) {
    return Json::array({v.x, v.y, v.z});
}

Json describe(const Mesh& mesh, const Extent& extent, std::size_t stream_size, const std::string& name) {
    constexpr int kFloat = 5126;
    constexpr int kUint32 = 5125;
    constexpr const char* kDraco = "KHR_draco_mesh_compression";
    const auto accessor = [&](int component, std::size_t count, const char* type) {
        return Json{{"componentType", component}, {"count", count}, {"type", type}};
    };
    const std::size_t vertices = mesh.positions.size();
    Json positions = accessor(kFloat, vertices, "VEC3");
    positions["min"] = to_json(extent.minimum);
    positions["max"] = to_json(extent.maximum);
    const Json attributes = {{"POSITION", 0}, {"NORMAL", 1}, {"TANGENT", 2}, {"TEXCOORD_0", 3}};
    const Json ids = {{"POSITION", +kPosition}, {"NORMAL", +kNormal}, {"TANGENT", +kTangent}, {"TEXCOORD_0", +kUv}};
    const Json primitive = {{"attributes", attributes},
                            {"indices", 4},
                            {"extensions", {{kDraco, {{"bufferView", 0}, {"attributes", ids}}}}}};
    Json root;
    root["asset"] = {{"version", "2.0"}, {"generator", "Rowland"}};
    root["extensionsUsed"] = Json::array({kDraco});
    root["extensionsRequired"] = Json::array({kDraco});
    root["scene"] = 0;
    root["scenes"] = Json::array({Json{{"nodes", Json::array({0})}}});
    root["nodes"] = Json::array({Json{{"name", name}, {"mesh", 0}}});
    root["meshes"] = Json::array({Json{{"name", name}, {"primitives", Json::array({primitive})}}});
    root["accessors"] =
        Json::array({positions, accessor(kFloat, vertices, "VEC3"), accessor(kFloat, vertices, "VEC4"),
                     accessor(kFloat, vertices, "VEC2"), accessor(kUint32, mesh.indices.size(), "SCALAR")});
    root["bufferViews"] = Json::array({Json{{"buffer", 0}, {"byteLength", stream_size}}});
    root["buffers"] = Json::array({Json{{"byteLength", stream_size}}});
    return root;
}

void write_chunk(ByteWriter& writer, std::uint32_t type, std::span<const char> data, char padding) {
    const std::size_t padded = (data.size() + 3) / 4 * 4;
    writer.value(static_cast<std::uint32_t>(padded));
    writer.value(type);
    for (std::size_t i = 0; i < padded; ++i) writer.value(i < data.size() ? data[i] : padding);
}

std::vector<std::byte> pack(const std::string& json, std::span<const char> stream) {
    ByteWriter chunks;
    write_chunk(chunks, 0x4E4F534A, json, ' ');     // "JSON"
    write_chunk(chunks, 0x004E4942, stream, '\0');  // "BIN"
    ByteWriter file;
    constexpr std::uint32_t kHeaderSize = 12;
    file.value<std::uint32_t>(0x46546C67);  // "glTF"
    file.value<std::uint32_t>(2);
    file.value(static_cast<std::uint32_t>(kHeaderSize + chunks.data().size()));
    std::vector<std::byte> bytes = file.take();
    bytes.insert(bytes.end(), chunks.data().begin(), chunks.data().end());
    return bytes;
}

}  // namespace

std::vector<std::byte> write_glb(const Mesh& mesh, const GlbWriteSettings& settings) {
    check_mesh(mesh);
    for (const int bits : {settings.position_bits, settings.normal_bits, settings.tangent_bits, settings.uv_bits}) {
        ROWLAND_CHECK_OP(bits, >=, 2);
        ROWLAND_CHECK_OP(bits, <=, 30);
    }
    const std::vector<char> stream = encode(mesh, settings);
    const Extent extent = decoded_extent(stream, mesh.positions.size());
    return pack(describe(mesh, extent, stream.size(), settings.name).dump(), stream);
}

}  // namespace rowland::scene
