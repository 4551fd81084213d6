#include "tests/unit/engine/scene/hand_written_gltf.h"

#include "engine/core/error.h"

namespace rowland::scene::test {

using nlohmann::json;

namespace {

constexpr std::array<float, 15> kPositions = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0};

std::string base64(std::span<const std::byte> bytes) {
    constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        unsigned bits = 0;
        for (std::size_t k = 0; k < 3; ++k)
            bits = bits << 8 | (i + k < bytes.size() ? std::to_integer<unsigned>(bytes[i + k]) : 0U);
        for (std::size_t k = 0; k < 4; ++k) text += i + k <= bytes.size() ? kDigits[bits >> (18 - 6 * k) & 63U] : '=';
    }
    return text;
}

}  // namespace

std::string data_uri(std::span<const std::byte> bytes, const std::string& type) {
    return "data:" + type + ";base64," + base64(bytes);
}

json document(int mode) {
    const auto bytes = std::as_bytes(std::span(kPositions));
    return {{"asset", {{"version", "2.0"}}},
            {"scene", 0},
            {"scenes", {{{"nodes", {0}}}}},
            {"nodes", {{{"mesh", 0}, {"name", "node"}}}},
            {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"mode", mode}}}}}}},
            {"accessors", {{{"bufferView", 0}, {"componentType", 5126}, {"count", 5}, {"type", "VEC3"}}}},
            {"bufferViews", {{{"buffer", 0}, {"byteLength", bytes.size()}}}},
            {"buffers", {{{"byteLength", bytes.size()}, {"uri", data_uri(bytes)}}}}};
}

json indexed(int mode, const std::vector<std::uint16_t>& indices) {
    json file = document(mode);
    file["meshes"][0]["primitives"][0]["indices"] =
        add_accessor(file, "SCALAR", 5123, indices.size(), std::as_bytes(std::span(indices)));
    return file;
}

std::size_t add_view(json& file, std::span<const std::byte> bytes) {
    file["buffers"].push_back({{"byteLength", bytes.size()}, {"uri", data_uri(bytes)}});
    file["bufferViews"].push_back({{"buffer", file["buffers"].size() - 1}, {"byteLength", bytes.size()}});
    return file["bufferViews"].size() - 1;
}

std::size_t add_accessor(json& file, const std::string& type, int component_type, std::size_t count,
                         std::span<const std::byte> bytes, bool normalised) {
    const std::size_t view = add_view(file, bytes);
    file["accessors"].push_back({{"bufferView", view},
                                 {"componentType", component_type},
                                 {"count", count},
                                 {"type", type},
                                 {"normalized", normalised}});
    return file["accessors"].size() - 1;
}

std::size_t add_floats(json& file, const std::string& type, const std::vector<float>& values) {
    const std::map<std::string, std::size_t> sizes = {
        {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}};
    return add_accessor(file, type, 5126, values.size() / sizes.at(type), std::as_bytes(std::span(values)));
}

json primitive_of(json& file, const Mesh& mesh) {
    const auto add = [&](const char* type, const auto& values) {
        return add_accessor(file, type, 5126, values.size(), std::as_bytes(std::span(values)));
    };
    json attributes = {{"POSITION", add("VEC3", mesh.positions)}};
    const Bounds box = bounds(mesh);
    file["accessors"].back()["min"] = {box.minimum.x, box.minimum.y, box.minimum.z};
    file["accessors"].back()["max"] = {box.maximum.x, box.maximum.y, box.maximum.z};
    attributes["NORMAL"] = add("VEC3", mesh.normals);
    attributes["TANGENT"] = add("VEC4", mesh.tangents);
    attributes["TEXCOORD_0"] = add("VEC2", mesh.uvs);
    const std::size_t indices =
        add_accessor(file, "SCALAR", 5125, mesh.indices.size(), std::as_bytes(std::span(mesh.indices)));
    return {{"attributes", attributes}, {"indices", indices}};
}

void set_attribute(json& file, const std::string& name, std::size_t accessor) {
    file["meshes"][0]["primitives"][0]["attributes"][name] = accessor;
}

std::vector<std::byte> glb_of(const json& file) {
    return glb_beginning(file.dump(), std::nullopt, 0, "f.glb");
}

ImportedScene load(const json& file, std::span<const std::string> handled) {
    const std::string text = file.dump();
    return load_glb(std::as_bytes(std::span(text.data(), text.size())), "f.gltf", handled);
}

std::string error_of(const json& file) {
    try {
        load(file);
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

}  // namespace rowland::scene::test
