// Representations of view tables, which take the light's SH at the vertices: `spikes` and `arc`.
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_inverse.hpp>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/colour/spectrum.h"
#include "engine/math/spherical_harmonics.h"
#include "modules/diffraction/runtime/bindings.h"
#include "modules/diffraction/runtime/gpu_representations.h"

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
    : grid_(grid),
      texture_(make_texture(packed, grid)),
      ranges_(gpu::Buffer::of(std::span<const glm::vec4>(ranges(packed)))) {}

void GpuTable::add_defines(gpu::ProgramDesc& desc) const {
    desc.defines.push_back({"VIEW_MAPPING", std::to_string(static_cast<int>(grid_.mapping))});
    desc.defines.push_back({"TABLE_COLUMNS", std::to_string(grid_.columns)});
    desc.defines.push_back({"TABLE_ROWS", std::to_string(grid_.rows)});
}

void GpuTable::bind() const {
    texture_.bind(kTableUnit);
    ranges_.bind_storage(kTableRangeBinding);
}

namespace {

/// For each of the light's colours, one texel per nanometre: XYZ of a spike there under light of that colour.
gpu::Texture make_wavelengths() {
    constexpr int kCount = colour::kVisibleMax - colour::kVisibleMin + 1;
    std::vector<glm::vec4> texels;
    for (int c = 0; c < 3; ++c)
        for (int i = 0; i < kCount; ++i) texels.emplace_back(glm::vec3(spike_colour(colour::kVisibleMin + i)[c]), 0.0F);
    gpu::Texture texture({.kind = gpu::TextureKind::Line, .format = gpu::Format::RGBA32F, .width = 3 * kCount});
    texture.upload(std::span<const glm::vec4>(texels));
    return texture;
}

}  // namespace

GpuSpikes::GpuSpikes(std::shared_ptr<const CookedMaterial> cooked, const SpikeTable& table,
                     const glm::dmat3& xyz_to_working)
    : GpuMaterial(std::move(cooked), xyz_to_working),
      bands_(table.bands),
      spikes_(table.spikes),
      table_(table, table.grid),
      wavelengths_(make_wavelengths()) {}

void GpuSpikes::update(const SurfaceObject& object, SurfaceLight& light, SurfaceState& state) const {
    if (!object.changed) return state.vertex_light.keep();
    require_vertex_light(object, {.texels = static_cast<std::size_t>(math::sh_count(bands_))});
    const std::vector<float> rotated =
        rotate_to_vertices(harmonics(light, bands_), object.mesh, object.object_to_world, object.groove_rotation);
    state.vertex_light.write_values(std::span<const float>(rotated));
}

void GpuSpikes::describe(const SurfaceState&, gpu::ProgramDesc& desc) const {
    set_vertex_shader(desc, "representations/spikes/spikes.glsl");
    desc.defines.push_back({"BANDS", std::to_string(bands_)});
    desc.defines.push_back({"SPIKES", std::to_string(spikes_)});
    table_.add_defines(desc);
}

void GpuSpikes::bind_tables(const gpu::Program&, const SurfaceState& state) const {
    table_.bind();
    wavelengths_.bind(kWavelengthTableUnit);
    state.vertex_light.bind_texels(kVertexLightUnit);
}

namespace {

/// A flat object under a GrooveMap has the products of every azimuth of g.
bool has_turns(const SurfaceState& state) {
    return state.grooves && state.flat;
}

ViewGrid weight_grid(const ArcTable& table) {
    ViewGrid grid = table.grid;
    grid.rows = table.rows();
    return grid;
}

}  // namespace

GpuArc::GpuArc(std::shared_ptr<const CookedMaterial> cooked, const ArcTable& table, const glm::dmat3& xyz_to_working)
    : GpuMaterial(std::move(cooked), xyz_to_working),
      products_(table, xyz_to_working),
      weights_(table, weight_grid(table)),
      pitch_(table.pitch) {}

std::vector<glm::vec4> GpuArc::grooved_products(const SurfaceObject& object, const lighting::ShLight& light,
                                                SurfaceState& state) const {
    if (!state.flat)
        return products_(light, turned_by(*state.grooves, object.mesh), object.object_to_world, object.groove_rotation);
    const glm::dmat3 linear(object.object_to_world);
    ArcTurns turns = arc_turns(products_, light, glm::normalize(glm::inverseTranspose(linear) * *state.flat));
    state.arc_e1 = turns.e1;
    state.arc_e2 = turns.e2;
    return std::move(turns.terms);
}

void GpuArc::update(const SurfaceObject& object, SurfaceLight& light, SurfaceState& state) const {
    if (!object.changed) return state.vertex_light.keep();
    require_vertex_light(object, {.bytes = static_cast<std::size_t>(3 * products_.layers()) * sizeof(glm::vec4)});
    const lighting::ShLight& sh = harmonics(light, products_.bands());
    const std::vector<glm::vec4> products =
        state.grooves ? grooved_products(object, sh, state)
                      : products_(sh, object.mesh, object.object_to_world, object.groove_rotation);
    state.vertex_light.write_values(std::span<const glm::vec4>(products));
}

void GpuArc::describe(const SurfaceState& state, gpu::ProgramDesc& desc) const {
    set_pixel_shader(desc, "representations/arc/arc.glsl");
    if (has_turns(state))
        desc.defines.push_back({"TURNS", std::to_string(products_.bands())});
    else
        desc.defines.push_back({"ARC_PRODUCTS", "1"});
    if (pitch_ && state.grooves) desc.defines.push_back({"PITCH_AXIS", "1"});
    desc.defines.push_back({"LAYERS", std::to_string(products_.layers())});
    weights_.add_defines(desc);
}

void GpuArc::bind_tables(const gpu::Program& program, const SurfaceState& state) const {
    weights_.bind();
    state.vertex_light.bind_storage(kVertexLightBinding);
    if (pitch_) program.set("pitch_scale_bias", glm::vec2(pitch_->scale_bias()));
    if (has_turns(state)) {
        program.set("arc_e1", state.arc_e1);
        program.set("arc_e2", state.arc_e2);
    }
}

}  // namespace rowland::diffraction
