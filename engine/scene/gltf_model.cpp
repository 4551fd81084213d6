// A glTF file, parsed and checked, and the values of its accessors.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <glm/vec2.hpp>
#include <limits>
#include <type_traits>

#include "engine/core/error.h"
#include "engine/scene/gltf_parts.h"

namespace rowland::scene {

namespace {

/// Parses what check_gltf() returned. tinygltf gets neither buffers nor images, which load_uri() reads. An accessor
/// without a buffer view gets a temporary one, since tinygltf refuses indices without a view, which primitives with a
/// Draco stream have.
gltf::Model parse_model(nlohmann::json checked, const std::string& file) {
    nlohmann::json images = checked.value("images", nlohmann::json::array());
    for (const char* array : {"buffers", "images"}) checked.erase(array);
    const std::size_t view_count = checked.value("bufferViews", nlohmann::json::array()).size();
    if (checked.contains("accessors")) {
        for (nlohmann::json& accessor : checked["accessors"])
            if (!accessor.contains("bufferView")) accessor["bufferView"] = view_count;
        checked["bufferViews"].push_back({{"buffer", 0}, {"byteLength", 1}});
    }
    if (checked.contains("cameras"))
        for (nlohmann::json& camera : checked["cameras"])
            if (camera["type"] == "orthographic")  // ignored, but tinygltf requires its members
                camera["orthographic"] = {{"xmag", 1}, {"ymag", 1}, {"zfar", 1}, {"znear", 0}};
    gltf::Model model;
    std::string error;
    std::string warning;
    const std::string text = checked.dump();
    if (!gltf::TinyGLTF().LoadASCIIFromString(&model, &error, &warning, text.data(), static_cast<unsigned>(text.size()),
                                              "", gltf::NO_REQUIRE))
        refuse_input(file, "", error.substr(0, error.find('\n')), "glTF 2.0", "export the file again");
    model.bufferViews.resize(view_count);
    for (gltf::Accessor& accessor : model.accessors)
        if (static_cast<std::size_t>(accessor.bufferView) == view_count) accessor.bufferView = -1;
    for (const nlohmann::json& image : images) {
        gltf::Image& to = model.images.emplace_back();
        to.bufferView = image.value("bufferView", -1);
        to.uri = image.value("uri", "");
    }
    return model;
}

/// The data of the buffers, from their URIs or the BIN chunk. A buffer holds byteLength bytes, or none if it has no
/// data and no buffer view uses it.
std::vector<GltfBuffer> load_buffers(const GltfSource& source, const nlohmann::json& entries, const gltf::Model& model,
                                     MemoryBudget& budget, std::vector<std::filesystem::path>* read_files) {
    std::vector<GltfBuffer> buffers;
    for (const nlohmann::json& entry : entries) {
        const std::size_t index = buffers.size();
        const std::string pointer = fmt::format("/buffers/{}", index);
        GltfBuffer& buffer = buffers.emplace_back();
        if (entry.contains("uri"))
            buffer = load_uri(source, entry["uri"].get_ref<const std::string&>(), pointer, budget, read_files);
        else if (index == 0)
            buffer.bytes = source.binary();
        const auto length = entry["byteLength"].get<std::size_t>();
        if (buffer.bytes.empty() && std::ranges::find(model.bufferViews, static_cast<int>(index),
                                                      &gltf::BufferView::buffer) == model.bufferViews.end())
            continue;
        if (buffer.bytes.size() < length)
            refuse_input(source.file, pointer, fmt::format("{} bytes of data", buffer.bytes.size()),
                         fmt::format("the {} bytes of byteLength", length), "the file was cut, or byteLength is wrong");
        buffer.bytes = buffer.bytes.first(length);
    }
    return buffers;
}

/// Bytes of a component of an accessor (componentType).
std::size_t component_size(int component_type) {
    return static_cast<std::size_t>(gltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(component_type)));
}

/// Components in a column of an accessor's type.
int rows_of(int type) {
    return type == TINYGLTF_TYPE_SCALAR ? 1 : type % 32;
}

int columns_of(int type) {
    return gltf::GetNumComponentsInType(static_cast<std::uint32_t>(type)) / rows_of(type);
}

/// Bytes of an accessor's element; columns of matrices begin on multiples of 4 bytes (glTF 2.0, 3.6.2.4).
std::size_t element_size(const gltf::Accessor& accessor) {
    std::size_t column = static_cast<std::size_t>(rows_of(accessor.type)) * component_size(accessor.componentType);
    const auto columns = static_cast<std::size_t>(columns_of(accessor.type));
    if (columns > 1) column = (column + 3) / 4 * 4;
    return column * columns;
}

/// Whether `count` > 0 elements of `size` bytes, `stride` apart and the first at `offset`, end within `length` bytes.
bool fits(std::size_t offset, std::size_t stride, std::size_t count, std::size_t size, std::size_t length) {
    if (offset > length || size > length - offset) return false;
    return (count - 1) <= (length - offset - size) / stride;
}

/// Checks without overflow that every buffer view lies in its buffer and every accessor, with its sparse parts, in its
/// views.
void check_ranges(const GltfDocument& document) {
    const gltf::Model& model = document.model;
    const std::string& file = document.file;
    for (std::size_t i = 0; i < model.bufferViews.size(); ++i) {
        const gltf::BufferView& view = model.bufferViews[i];
        const std::size_t size = document.buffers[static_cast<std::size_t>(view.buffer)].bytes.size();
        if (view.byteOffset > size || view.byteLength > size - view.byteOffset)
            refuse_input(file, fmt::format("/bufferViews/{}", i),
                         fmt::format("bytes {} + {}", view.byteOffset, view.byteLength),
                         fmt::format("bytes within buffer {}, which has {}", view.buffer, size));
    }
    const auto length_of = [&](int view) { return model.bufferViews[static_cast<std::size_t>(view)].byteLength; };
    for (std::size_t i = 0; i < model.accessors.size(); ++i) {
        const gltf::Accessor& accessor = model.accessors[i];
        const std::string pointer = fmt::format("/accessors/{}", i);
        const std::size_t size = element_size(accessor);
        if (accessor.bufferView >= 0) {
            const std::size_t stride = model.bufferViews[static_cast<std::size_t>(accessor.bufferView)].byteStride;
            const std::size_t length = length_of(accessor.bufferView);
            if (!fits(accessor.byteOffset, stride == 0 ? size : stride, accessor.count, size, length))
                refuse_input(
                    file, pointer,
                    fmt::format("{} elements of {} bytes from offset {}", accessor.count, size, accessor.byteOffset),
                    fmt::format("elements within buffer view {}, which has {} bytes", accessor.bufferView, length));
        }
        if (!accessor.sparse.isSparse) continue;
        const auto count = static_cast<std::size_t>(accessor.sparse.count);
        if (count > accessor.count)
            refuse_input(file, pointer, fmt::format("{} sparse elements", count),
                         fmt::format("at most the accessor's {}", accessor.count));
        const std::size_t index_size = component_size(accessor.sparse.indices.componentType);
        if (!fits(static_cast<std::size_t>(accessor.sparse.indices.byteOffset), index_size, count, index_size,
                  length_of(accessor.sparse.indices.bufferView)) ||
            !fits(static_cast<std::size_t>(accessor.sparse.values.byteOffset), size, count, size,
                  length_of(accessor.sparse.values.bufferView)))
            refuse_input(file, pointer, "sparse elements beyond their buffer views", "elements within them");
    }
}

std::string pointer_of(int accessor) {
    return fmt::format("/accessors/{}", accessor);
}

const gltf::Accessor& accessor_at(const GltfDocument& document, int index) {
    return document.model.accessors.at(static_cast<std::size_t>(index));
}

/// Calls visit(element, bytes) for each element of the accessor's buffer view, then for each sparse one.
template <typename Visit>
void for_each_element(const GltfDocument& document, int index, const Visit& visit) {
    const gltf::Accessor& accessor = accessor_at(document, index);
    const std::size_t size = element_size(accessor);
    if (accessor.bufferView >= 0) {
        const std::span<const std::byte> bytes = document.view_bytes(accessor.bufferView).subspan(accessor.byteOffset);
        const std::size_t given = document.model.bufferViews[static_cast<std::size_t>(accessor.bufferView)].byteStride;
        const std::size_t stride = given == 0 ? size : given;
        for (std::size_t i = 0; i < accessor.count; ++i) visit(i, bytes.subspan(i * stride, size).data());
    }
    if (!accessor.sparse.isSparse) return;
    const auto& sparse = accessor.sparse;
    const auto indices =
        document.view_bytes(sparse.indices.bufferView).subspan(static_cast<std::size_t>(sparse.indices.byteOffset));
    const auto values =
        document.view_bytes(sparse.values.bufferView).subspan(static_cast<std::size_t>(sparse.values.byteOffset));
    const std::size_t index_size = component_size(sparse.indices.componentType);
    for (std::size_t i = 0; i < static_cast<std::size_t>(sparse.count); ++i) {
        std::uint32_t target = 0;  // little-endian, as all of glTF
        std::memcpy(&target, indices.subspan(i * index_size, index_size).data(), index_size);
        if (target >= accessor.count)
            refuse_input(document.file, pointer_of(index), fmt::format("sparse index {}", target),
                         fmt::format("below the count, {}", accessor.count));
        visit(target, values.subspan(i * size, size).data());
    }
}

template <typename Component>
float read_as(const std::byte* bytes, bool normalised) {
    Component x;
    std::memcpy(&x, bytes, sizeof x);
    const auto value = static_cast<float>(x);
    if (std::is_floating_point_v<Component> || !normalised) return value;
    // Signed types have two codes for −1 (glTF 2.0, 3.6.2.2).
    return std::max(value / static_cast<float>(std::numeric_limits<Component>::max()), -1.0F);
}

float read_component(const std::byte* bytes, int type, bool normalised) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return read_as<std::int8_t>(bytes, normalised);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return read_as<std::uint8_t>(bytes, normalised);
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return read_as<std::int16_t>(bytes, normalised);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return read_as<std::uint16_t>(bytes, normalised);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return read_as<std::uint32_t>(bytes, normalised);
        default:
            return read_as<float>(bytes, normalised);
    }
}

void require_type(const GltfDocument& document, int accessor, bool is_expected, const std::string& expected) {
    if (!is_expected) refuse_input(document.file, pointer_of(accessor), "another type", expected);
}

/// Elements that consist of `Length` floats; zeros where the file holds no data (glTF 2.0, 3.6.2.1).
template <typename Element, int Length>
std::vector<Element> read_elements(const GltfDocument& document, int index, MemoryBudget& budget) {
    const gltf::Accessor& accessor = accessor_at(document, index);
    static_assert(sizeof(Element) == Length * sizeof(float));
    budget.spend(accessor.count, sizeof(Element), pointer_of(index));
    std::vector<Element> elements(accessor.count, Element(0.0F));
    const std::size_t size = component_size(accessor.componentType);
    for_each_element(document, index, [&](std::size_t element, const std::byte* bytes) {
        std::array<float, Length> components;
        for (std::size_t c = 0; c < Length; ++c)
            components[c] = read_component(bytes + c * size, accessor.componentType, accessor.normalized);
        std::memcpy(static_cast<void*>(&elements[element]), components.data(), sizeof components);
    });
    return elements;
}

}  // namespace

std::span<const std::byte> GltfDocument::view_bytes(int view) const {
    const gltf::BufferView& at = model.bufferViews.at(static_cast<std::size_t>(view));
    return buffers.at(static_cast<std::size_t>(at.buffer)).bytes.subspan(at.byteOffset, at.byteLength);
}

const nlohmann::json& GltfDocument::extras(const char* array, std::size_t index) const {
    static const nlohmann::json none;
    const nlohmann::json& element = json.at(array).at(index);
    return element.contains("extras") ? element.at("extras") : none;
}

GltfDocument parse_gltf(const GltfSource& source, std::span<const std::string> handled_extensions, MemoryBudget& budget,
                        std::vector<std::filesystem::path>* read_files, std::vector<std::string>& warnings) {
    nlohmann::json checked = check_gltf(source.json, source.file, handled_extensions, budget, warnings);
    const nlohmann::json buffers = checked.value("buffers", nlohmann::json::array());
    GltfDocument document{source.file, source.json, parse_model(std::move(checked), source.file), {}};
    document.buffers = load_buffers(source, buffers, document.model, budget, read_files);
    check_ranges(document);
    return document;
}

template <typename Vector>
std::vector<Vector> read_vectors(const GltfDocument& document, int index, MemoryBudget& budget) {
    const gltf::Accessor& accessor = accessor_at(document, index);
    require_type(document, index,
                 columns_of(accessor.type) == 1 && rows_of(accessor.type) == Vector::length() &&
                     accessor.componentType != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
                 fmt::format("vectors of {} components", Vector::length()));
    return read_elements<Vector, Vector::length()>(document, index, budget);
}
template std::vector<glm::vec2> read_vectors<glm::vec2>(const GltfDocument&, int, MemoryBudget&);
template std::vector<glm::vec3> read_vectors<glm::vec3>(const GltfDocument&, int, MemoryBudget&);
template std::vector<glm::vec4> read_vectors<glm::vec4>(const GltfDocument&, int, MemoryBudget&);

std::vector<float> read_floats(const GltfDocument& document, int index, MemoryBudget& budget) {
    const gltf::Accessor& accessor = accessor_at(document, index);
    require_type(document, index,
                 accessor.type == TINYGLTF_TYPE_SCALAR && accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT,
                 "scalars of floats");
    return read_elements<float, 1>(document, index, budget);
}

std::vector<glm::mat4> read_matrices(const GltfDocument& document, int index, MemoryBudget& budget) {
    const gltf::Accessor& accessor = accessor_at(document, index);
    // Columns of four floats have no padding between them.
    require_type(document, index,
                 accessor.type == TINYGLTF_TYPE_MAT4 && accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT,
                 "4 x 4 matrices of floats");
    return read_elements<glm::mat4, 16>(document, index, budget);
}

std::vector<std::uint32_t> read_indices(const GltfDocument& document, int index, MemoryBudget& budget) {
    const gltf::Accessor& accessor = accessor_at(document, index);
    const bool is_unsigned = accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                             accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
                             accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    require_type(document, index, accessor.type == TINYGLTF_TYPE_SCALAR && is_unsigned,
                 "indices: a scalar of unsigned integers");
    budget.spend(accessor.count, sizeof(std::uint32_t), pointer_of(index));
    std::vector<std::uint32_t> values(accessor.count, 0);
    const std::size_t size = component_size(accessor.componentType);
    for_each_element(document, index,
                     [&](std::size_t element, const std::byte* bytes) { std::memcpy(&values[element], bytes, size); });
    return values;
}

}  // namespace rowland::scene
