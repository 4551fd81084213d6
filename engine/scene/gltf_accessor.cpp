#include "engine/scene/gltf_accessor.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <glm/vec2.hpp>
#include <limits>
#include <type_traits>

#include "engine/core/error.h"

namespace rowland::scene {

namespace {

std::string pointer_to(const char* array, std::size_t index) {
    return fmt::format("/{}/{}", array, index);
}

std::size_t component_size(ComponentType type) {
    if (type == ComponentType::Int8 || type == ComponentType::Uint8) return 1;
    if (type == ComponentType::Int16 || type == ComponentType::Uint16) return 2;
    return 4;
}

std::size_t element_size(const GltfAccessor& accessor) {
    std::size_t column = static_cast<std::size_t>(accessor.rows) * component_size(accessor.type);
    // Columns of matrices begin on multiples of 4 bytes (glTF 2.0, 3.6.2.4).
    if (accessor.columns > 1) column = (column + 3) / 4 * 4;
    return column * static_cast<std::size_t>(accessor.columns);
}

/// Whether `count` > 0 elements of `size` bytes, `stride` apart and the first at `offset`, end within `length` bytes.
bool fits(std::size_t offset, std::size_t stride, std::size_t count, std::size_t size, std::size_t length) {
    if (offset > length || size > length - offset) return false;
    return (count - 1) <= (length - offset - size) / stride;
}

std::size_t stride_of(const GltfDocument& document, const GltfAccessor& accessor) {
    const std::size_t stride = document.views[*accessor.view].stride;
    return stride == 0 ? element_size(accessor) : stride;
}

void check_sparse(const GltfDocument& document, const GltfAccessor& accessor, const std::string& pointer) {
    const GltfSparse& sparse = *accessor.sparse;
    const std::size_t index_size = component_size(sparse.index_type);
    const std::size_t value_size = element_size(accessor);
    if (sparse.count > accessor.count)
        refuse_input(document.file, pointer, fmt::format("{} sparse elements", sparse.count),
                     fmt::format("at most the accessor's {}", accessor.count));
    if (!fits(sparse.index_offset, index_size, sparse.count, index_size, document.views[sparse.index_view].length) ||
        !fits(sparse.value_offset, value_size, sparse.count, value_size, document.views[sparse.value_view].length))
        refuse_input(document.file, pointer, "sparse elements beyond their buffer views", "elements within them");
}

/// Calls visit(element, bytes) for each element of the accessor's buffer view, then for each sparse one.
template <typename Visit>
void for_each_element(const GltfDocument& document, std::size_t index, const Visit& visit) {
    const GltfAccessor& accessor = document.accessors[index];
    const std::size_t size = element_size(accessor);
    if (accessor.view) {
        const std::span<const std::byte> bytes = view_bytes(document, *accessor.view).subspan(accessor.offset);
        const std::size_t stride = stride_of(document, accessor);
        for (std::size_t i = 0; i < accessor.count; ++i) visit(i, bytes.subspan(i * stride, size).data());
    }
    if (!accessor.sparse) return;
    const GltfSparse& sparse = *accessor.sparse;
    const auto positions = view_bytes(document, sparse.index_view).subspan(sparse.index_offset);
    const auto values = view_bytes(document, sparse.value_view).subspan(sparse.value_offset);
    const std::size_t index_size = component_size(sparse.index_type);
    for (std::size_t i = 0; i < sparse.count; ++i) {
        std::uint32_t target = 0;  // little-endian, as all of glTF
        std::memcpy(&target, positions.subspan(i * index_size, index_size).data(), index_size);
        if (target >= accessor.count)
            refuse_input(document.file, pointer_to("accessors", index), fmt::format("sparse index {}", target),
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

float read_component(const std::byte* bytes, ComponentType type, bool normalised) {
    switch (type) {
        case ComponentType::Int8:
            return read_as<std::int8_t>(bytes, normalised);
        case ComponentType::Uint8:
            return read_as<std::uint8_t>(bytes, normalised);
        case ComponentType::Int16:
            return read_as<std::int16_t>(bytes, normalised);
        case ComponentType::Uint16:
            return read_as<std::uint16_t>(bytes, normalised);
        case ComponentType::Uint32:
            return read_as<std::uint32_t>(bytes, normalised);
        case ComponentType::Float:
            break;
    }
    return read_as<float>(bytes, normalised);
}

}  // namespace

void check_ranges(const GltfDocument& document) {
    for (std::size_t i = 0; i < document.views.size(); ++i) {
        const GltfBufferView& view = document.views[i];
        const std::size_t size = document.buffers.at(view.buffer).bytes.size();
        if (view.offset > size || view.length > size - view.offset)
            refuse_input(document.file, pointer_to("bufferViews", i),
                         fmt::format("bytes {} + {}", view.offset, view.length),
                         fmt::format("bytes within buffer {}, which has {}", view.buffer, size));
    }
    for (std::size_t i = 0; i < document.accessors.size(); ++i) {
        const GltfAccessor& accessor = document.accessors[i];
        const std::string pointer = pointer_to("accessors", i);
        if (accessor.view && !fits(accessor.offset, stride_of(document, accessor), accessor.count,
                                   element_size(accessor), document.views.at(*accessor.view).length))
            refuse_input(document.file, pointer,
                         fmt::format("{} elements of {} bytes from offset {}", accessor.count, element_size(accessor),
                                     accessor.offset),
                         fmt::format("elements within buffer view {}, which has {} bytes", *accessor.view,
                                     document.views[*accessor.view].length));
        if (accessor.sparse) check_sparse(document, accessor, pointer);
    }
}

std::span<const std::byte> view_bytes(const GltfDocument& document, std::size_t view) {
    const GltfBufferView& at = document.views.at(view);
    return document.buffers.at(at.buffer).bytes.subspan(at.offset, at.length);
}

namespace {

void require_type(const GltfDocument& document, std::size_t accessor, bool is_expected, const std::string& expected) {
    if (!is_expected) refuse_input(document.file, pointer_to("accessors", accessor), "another type", expected);
}

bool is_scalar(const GltfDocument& document, std::size_t accessor, std::initializer_list<ComponentType> types) {
    const GltfAccessor& at = document.accessors.at(accessor);
    return at.columns == 1 && at.rows == 1 && std::ranges::find(types, at.type) != types.end();
}

/// Elements that consist of `Length` floats; zeros where the file holds no data (glTF 2.0, 3.6.2.1).
template <typename Element, int Length>
std::vector<Element> read_elements(const GltfDocument& document, std::size_t index, MemoryBudget& budget) {
    const GltfAccessor& accessor = document.accessors.at(index);
    static_assert(sizeof(Element) == Length * sizeof(float));
    budget.spend(accessor.count, sizeof(Element), pointer_to("accessors", index));
    std::vector<Element> elements(accessor.count, Element(0.0F));
    const std::size_t size = component_size(accessor.type);
    for_each_element(document, index, [&](std::size_t element, const std::byte* bytes) {
        std::array<float, Length> components;
        for (std::size_t c = 0; c < Length; ++c)
            components[c] = read_component(bytes + c * size, accessor.type, accessor.normalised);
        std::memcpy(static_cast<void*>(&elements[element]), components.data(), sizeof components);
    });
    return elements;
}

}  // namespace

template <typename Vector>
std::vector<Vector> read_vectors(const GltfDocument& document, std::size_t index, MemoryBudget& budget) {
    const GltfAccessor& accessor = document.accessors.at(index);
    require_type(document, index,
                 accessor.columns == 1 && accessor.rows == Vector::length() && accessor.type != ComponentType::Uint32,
                 fmt::format("vectors of {} components", Vector::length()));
    return read_elements<Vector, Vector::length()>(document, index, budget);
}
template std::vector<glm::vec2> read_vectors<glm::vec2>(const GltfDocument&, std::size_t, MemoryBudget&);
template std::vector<glm::vec3> read_vectors<glm::vec3>(const GltfDocument&, std::size_t, MemoryBudget&);
template std::vector<glm::vec4> read_vectors<glm::vec4>(const GltfDocument&, std::size_t, MemoryBudget&);

std::vector<float> read_floats(const GltfDocument& document, std::size_t index, MemoryBudget& budget) {
    require_type(document, index, is_scalar(document, index, {ComponentType::Float}), "scalars of floats");
    return read_elements<float, 1>(document, index, budget);
}

std::vector<glm::mat4> read_matrices(const GltfDocument& document, std::size_t index, MemoryBudget& budget) {
    const GltfAccessor& accessor = document.accessors.at(index);
    // Columns of four floats have no padding between them.
    require_type(document, index, accessor.columns == 4 && accessor.rows == 4 && accessor.type == ComponentType::Float,
                 "4 x 4 matrices of floats");
    return read_elements<glm::mat4, 16>(document, index, budget);
}

std::vector<std::uint32_t> read_indices(const GltfDocument& document, std::size_t index, MemoryBudget& budget) {
    const GltfAccessor& accessor = document.accessors.at(index);
    require_type(document, index,
                 is_scalar(document, index, {ComponentType::Uint8, ComponentType::Uint16, ComponentType::Uint32}),
                 "indices: a scalar of unsigned integers");
    budget.spend(accessor.count, sizeof(std::uint32_t), pointer_to("accessors", index));
    std::vector<std::uint32_t> values(accessor.count, 0);
    const std::size_t size = component_size(accessor.type);
    for_each_element(document, index,
                     [&](std::size_t element, const std::byte* bytes) { std::memcpy(&values[element], bytes, size); });
    return values;
}

}  // namespace rowland::scene
