#include "modules/diffraction/runtime/gpu_table.h"

#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "modules/diffraction/runtime/bindings.h"

namespace rowland::diffraction {

namespace {

gpu::Format format_of(Storage storage) {
    switch (storage) {
        case Storage::Unorm16:
            return gpu::Format::RGBA16;
        case Storage::Half:
            return gpu::Format::RGBA16F;
        case Storage::Float:
            return gpu::Format::RGBA32F;
        case Storage::Unorm8:
            break;
    }
    return gpu::Format::RGBA8;
}

/// The texels' bits as components of another type.
template <typename Component>
std::vector<Component> components(const PackedTexels& packed) {
    std::vector<Component> result(packed.texels.size() * sizeof packed.texels[0] / sizeof(Component));
    std::memcpy(result.data(), packed.texels.data(), result.size() * sizeof(Component));
    return result;
}

void upload(const PackedTexels& packed, gpu::TextureSlice all, gpu::Texture& texture) {
    if (packed.storage == Storage::Float) {
        texture.upload(std::span<const float>(components<float>(packed)), all);
    } else if (packed.storage == Storage::Unorm8) {
        texture.upload(std::span<const std::uint8_t>(components<std::uint8_t>(packed)), all);
    } else {
        texture.upload(std::span<const std::uint16_t>(packed.texels), all);
    }
}

gpu::Texture make_texture(const PackedTexels& packed, const ViewGrid& grid) {
    const auto layers = static_cast<int>(packed.scale.size());
    const bool wraps = grid.mapping == ViewMapping::Spherical;
    gpu::Texture texture({.kind = gpu::TextureKind::PlaneArray,
                          .format = format_of(packed.storage),
                          .width = grid.columns,
                          .height = grid.rows,
                          .depth = layers},
                         {.filter = gpu::Filter::Linear, .wrap_s = wraps ? gpu::Wrap::Repeat : gpu::Wrap::Clamp});
    upload(packed, {.layers = layers}, texture);
    return texture;
}

std::vector<glm::vec4> ranges(const PackedTexels& packed) {
    std::vector<glm::vec4> result;
    for (std::size_t layer = 0; layer < packed.scale.size(); ++layer) {
        result.push_back(packed.scale[layer]);
        result.push_back(packed.bias[layer]);
    }
    return result;
}

}  // namespace

GpuTable::GpuTable(const PackedTexels& packed, const ViewGrid& grid)
    : mapping_(grid.mapping),
      columns_(grid.columns),
      rows_(grid.rows),
      texture_(make_texture(packed, grid)),
      ranges_(gpu::Buffer::of(std::span<const glm::vec4>(ranges(packed)))) {}

void GpuTable::add_defines(gpu::ProgramDesc& desc) const {
    desc.defines.push_back({"VIEW_MAPPING", std::to_string(static_cast<int>(mapping_))});
    desc.defines.push_back({"TABLE_COLUMNS", std::to_string(columns_)});
    desc.defines.push_back({"TABLE_ROWS", std::to_string(rows_)});
}

void GpuTable::bind() const {
    texture_.bind(kTableUnit);
    ranges_.bind_storage(kTableRangeBinding);
}

}  // namespace rowland::diffraction
