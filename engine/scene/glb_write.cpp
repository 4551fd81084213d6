#include "engine/scene/glb_write.h"

#include <draco/compression/decode.h>
#include <draco/compression/expert_encode.h>
#include <draco/mesh/mesh.h>
#include <fmt/format.h>

#include <charconv>
#include <glm/common.hpp>
#include <limits>
#include <span>
#include <sstream>

#include "engine/core/check.h"
#include "engine/core/error.h"
#include "engine/scene/gltf_check.h"
#include "engine/scene/tinygltf.h"

namespace rowland::scene {

namespace {

[[noreturn]] void fail_draco(const std::string& found) {
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
    // The order gives the attributes the numbers in DracoIds.
    add_attribute(target, draco::GeometryAttribute::POSITION, mesh.positions);
    add_attribute(target, draco::GeometryAttribute::NORMAL, mesh.normals);
    // The bitstream has no type for tangents (KHR_draco_mesh_compression, "Conformance").
    add_attribute(target, draco::GeometryAttribute::GENERIC, mesh.tangents);
    add_attribute(target, draco::GeometryAttribute::TEX_COORD, mesh.uvs);
}

std::vector<char> encode(const Mesh& mesh) {
    draco::Mesh source;
    fill(mesh, source);
    draco::ExpertEncoder encoder(source);
    encoder.SetEncodingMethod(draco::MESH_SEQUENTIAL_ENCODING);
    constexpr int kSpeed = 5;
    encoder.SetSpeedOptions(kSpeed, kSpeed);
    for (const int id : {DracoIds::kPosition, DracoIds::kNormal, DracoIds::kTangent, DracoIds::kUv})
        encoder.SetAttributeQuantization(id, kDracoBits);
    draco::EncoderBuffer buffer;
    const draco::Status status = encoder.EncodeToBuffer(&buffer);
    if (!status.ok()) fail_draco(fmt::format("encoding failed: {}", status.error_msg_string()));
    return {buffer.data(), buffer.data() + buffer.size()};
}

/// The bounds after quantisation, as readers will decode them.
Bounds decoded_bounds(std::span<const char> stream, std::size_t vertex_count) {
    draco::DecoderBuffer buffer;
    buffer.Init(stream.data(), stream.size());
    draco::Decoder decoder;
    auto result = decoder.DecodeMeshFromBuffer(&buffer);
    if (!result.ok())
        fail_draco(fmt::format("what it encoded cannot be decoded: {}", result.status().error_msg_string()));
    const std::unique_ptr<draco::Mesh> mesh = std::move(result).value();
    if (mesh->num_points() != vertex_count)
        fail_draco(fmt::format("{} vertices became {}", vertex_count, mesh->num_points()));
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

/// The shortest decimal number that rounds to the float, whatever the locale.
double shortest_decimal(float x) {
    const std::string text = fmt::format("{}", x);
    double value = 0.0;
    std::from_chars(text.data(), text.data() + text.size(), value);
    return value;
}

std::vector<double> shortest_decimal(const glm::vec3& v) {
    return {shortest_decimal(v.x), shortest_decimal(v.y), shortest_decimal(v.z)};
}

/// Adds an accessor whose values a Draco stream holds; returns its index.
int add_accessor(gltf::Model& model, int component_type, int type, std::size_t count) {
    gltf::Accessor& accessor = model.accessors.emplace_back();
    accessor.componentType = component_type;
    accessor.type = type;
    accessor.count = count;
    return static_cast<int>(model.accessors.size()) - 1;
}

gltf::Primitive add_primitive(gltf::Model& model, const Mesh& mesh, const DracoStream& stream) {
    struct Attribute {
        const char* name;
        int type;
        int id;
    };
    gltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    gltf::Value::Object ids;
    for (const Attribute& attribute : {Attribute{"POSITION", TINYGLTF_TYPE_VEC3, DracoIds::kPosition},
                                       Attribute{"NORMAL", TINYGLTF_TYPE_VEC3, DracoIds::kNormal},
                                       Attribute{"TANGENT", TINYGLTF_TYPE_VEC4, DracoIds::kTangent},
                                       Attribute{"TEXCOORD_0", TINYGLTF_TYPE_VEC2, DracoIds::kUv}}) {
        primitive.attributes[attribute.name] =
            add_accessor(model, TINYGLTF_COMPONENT_TYPE_FLOAT, attribute.type, mesh.positions.size());
        ids[attribute.name] = gltf::Value(attribute.id);
    }
    gltf::Accessor& positions = model.accessors[static_cast<std::size_t>(primitive.attributes["POSITION"])];
    positions.minValues = shortest_decimal(stream.bounds.minimum);
    positions.maxValues = shortest_decimal(stream.bounds.maximum);
    primitive.indices =
        add_accessor(model, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR, mesh.indices.size());
    primitive.extensions[kDracoExtension] =
        gltf::Value({{"bufferView", gltf::Value(0)}, {"attributes", gltf::Value(std::move(ids))}});
    return primitive;
}

}  // namespace

DracoStream encode_draco(const Mesh& mesh) {
    check_mesh(mesh);
    DracoStream stream;
    stream.bytes = encode(mesh);
    stream.bounds = decoded_bounds(stream.bytes, mesh.positions.size());
    return stream;
}

std::vector<std::byte> write_glb(const Mesh& mesh, const std::string& name) {
    const DracoStream stream = encode_draco(mesh);
    gltf::Model model;
    model.asset.generator = "Rowland";
    model.extensionsUsed = model.extensionsRequired = {kDracoExtension};
    model.buffers.emplace_back().data.assign(stream.bytes.begin(), stream.bytes.end());
    gltf::BufferView& view = model.bufferViews.emplace_back();
    view.buffer = 0;
    view.byteLength = stream.bytes.size();
    gltf::Mesh& written = model.meshes.emplace_back();
    written.name = name;
    written.primitives.push_back(add_primitive(model, mesh, stream));
    gltf::Node& node = model.nodes.emplace_back();
    node.name = name;
    node.mesh = 0;
    model.scenes.emplace_back().nodes = {0};
    model.defaultScene = 0;
    std::ostringstream file(std::ios::binary);
    ROWLAND_CHECK(gltf::TinyGLTF().WriteGltfSceneToStream(&model, file, false, true), "tinygltf writes any model");
    const std::string text = file.str();
    const auto bytes = std::as_bytes(std::span(text));
    return {bytes.begin(), bytes.end()};
}

}  // namespace rowland::scene
