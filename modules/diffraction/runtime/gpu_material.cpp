#include "modules/diffraction/runtime/gpu_material.h"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>

#include "engine/render/surface_programs.h"
#include "modules/diffraction/asset/material.h"
#include "modules/diffraction/runtime/bindings.h"
#include "modules/diffraction/runtime/gpu_representations.h"

namespace rowland::diffraction {

namespace {

/// Whether the grating is one of the sides of a sheet.
bool passes_light(const Grating& grating) {
    return grating.transmission || grating.side_reflectance;
}

std::uint64_t next_number() {
    static std::atomic<std::uint64_t> last{0};
    return ++last;
}

/// A path below modules/diffraction/, as a define that names a file to include.
std::string shader_file(const char* path) {
    return std::string("\"modules/diffraction/") + path + '"';
}

bool defines(const gpu::ProgramDesc& desc, const char* name) {
    return std::ranges::any_of(desc.defines, [&](const gpu::Define& define) { return define.first == name; });
}

/// Adds to the number of the fragment stage's samplers, which the engine reads from kMaterialSamplers.
void add_samplers(gpu::ProgramDesc& desc, int samplers) {
    for (auto& [name, value] : desc.defines)
        if (name == render::kMaterialSamplers) {
            value = std::to_string(std::stoi(value) + samplers);
            return;
        }
    desc.defines.emplace_back(render::kMaterialSamplers, std::to_string(samplers));
}

}  // namespace

GpuMaterial::GpuMaterial(std::shared_ptr<const CookedMaterial> cooked, const glm::dmat3& xyz_to_working)
    : number_(next_number()),
      cooked_(std::move(cooked)),
      base_{.base_colour = cooked_->material.base.colour,
            .metallic = 0.0F,
            .roughness = cooked_->material.base.roughness,
            .passes_light = passes_light(cooked_->material.grating)},
      even_kernel_(is_even(cooked_->kernel)),
      key_lights_(cooked_->material.quality.key_lights),
      separate_lights_(key_lights_ > 0 || info(cooked_->tables).is_map),
      lights_at_vertices_(cooked_->material.quality.lights_at_vertices && cooked_->zero_order_xyz == glm::dmat3(0.0) &&
                          !cooked_->material.grating.lattice),
      kernel_(cooked_, xyz_to_working) {
    const Material& material = cooked_->material;
    if (cooked_->reflected) reflected_ = make_gpu_material(cooked_->reflected, xyz_to_working);
    const LayerWeights weights = layer_weights(material.grating, material.quality.illuminant);
    if (material.grating.lattice) pattern_.emplace(material, xyz_to_working);
    mirror_weight_ = glm::vec3(xyz_to_working * weights.mirror);
    base_weight_ = glm::vec3(xyz_to_working * weights.base);
    reflectance_ = glm::vec3(xyz_to_working * weights.reflected);
}

gpu::ProgramDesc GpuMaterial::program(const SurfaceState& state) const {
    if (state.mean_colour)
        return {.vertex = "modules/diffraction/shaders/mean.vert.glsl",
                .fragment = "modules/diffraction/shaders/mean.frag.glsl"};
    gpu::ProgramDesc desc{.vertex = "modules/diffraction/shaders/grating.vert.glsl",
                          .fragment = "modules/diffraction/shaders/grating.frag.glsl"};
    describe(state, desc);
    add_defines(state, desc);
    return desc;
}

std::uint64_t GpuMaterial::program_key(const SurfaceState& state) const {
    std::uint64_t key = number_;
    for (const bool bit : {state.mean_colour, state.without_map, state.flat.has_value(), state.grooves != nullptr,
                           state.grooves && state.grooves->uv_set() == 1, state.grooves && state.grooves->has_gaps()})
        key = 2 * key + (bit ? 1 : 0);
    return key;
}

std::uint64_t GpuMaterial::binding_key(const SurfaceState& state) const {
    if (state.mean_colour) return 1;
    if (!has_common_tables(state)) return 0;
    std::uint64_t key = 1;
    for (const std::uint64_t read : {std::uint64_t{reinterpret_cast<std::uintptr_t>(state.map.shown().get())},
                                     std::uint64_t{reinterpret_cast<std::uintptr_t>(state.grooves.get())},
                                     std::uint64_t{std::bit_cast<std::uint32_t>(state.groove_rotation)}})
        key = std::rotl((key ^ read) * 0x9E3779B97F4A7C15U, 29);  // Fibonacci hashing
    return std::max<std::uint64_t>(key, 1);
}

void GpuMaterial::add_defines(const SurfaceState& state, gpu::ProgramDesc& desc) const {
    if (separate_lights_) desc.defines.push_back({"SEPARATE_LIGHTS", "1"});
    // Ambient light is nearly linear between vertices, and at the pixels takes a fifth of the plain surface's time.
    desc.defines.push_back({"AMBIENT_AT_VERTICES", "1"});
    if (cooked_->material.grating.cover) desc.defines.push_back({"COVER", "1"});
    if (transmits()) desc.defines.push_back({"TRANSMISSION", "1"});
    if (cooked_->material.grating.side_reflectance) desc.defines.push_back({"REFLECTED_SIDE", "1"});
    kernel_.add_defines(desc);
    if (pattern_) desc.defines.push_back({"LATTICE", shader_file("shaders/pattern.glsl")});
    if (shades_key_lights(desc)) desc.defines.push_back({"KEY_LOBES", key_light_shader(state)});
    if (state.grooves) state.grooves->add_defines(even_kernel_, desc);
    // The kernel or a lattice's pattern; the groove map, or tables of key lights.
    add_samplers(desc, state.grooves || defines(desc, "KEY_LOBES") ? 2 : 1);
    if (lights_at_vertices_ && !state.grooves) desc.defines.push_back({"LIGHTS_AT_VERTICES", "1"});
}

/// A streak shows the whole probe, key lights included. The arc table beside it, of the incoherent part of Stam's pits,
/// needs them.
bool GpuMaterial::shades_key_lights(const gpu::ProgramDesc& desc) const {
    return key_lights_ > 0 && !(defines(desc, "STREAK") && (defines(desc, "LOBE_GAUSSIAN") || pattern_));
}

/// The tables of key lights, one look-up for each, do not support order 0 or varying pitches.
bool GpuMaterial::key_windows(const SurfaceState& state) const {
    return key_lights_ > 0 && (kernel_.has_zero_order() || state.grooves);
}

std::string GpuMaterial::key_light_shader(const SurfaceState& state) const {
    if (pattern_) return "";  // pattern.glsl
    return shader_file(key_windows(state) ? "shaders/key_light_windows.glsl" : "shaders/key_light_tables.glsl");
}

void GpuMaterial::bind(const gpu::Program& program, const SurfaceLight& light, const SurfaceState& state) const {
    program.set("base_weight", base_weight_);
    program.set("reflectance", reflectance_);
    if (state.mean_colour) return;
    bind_tables(program, state);
    if (pattern_)
        pattern_->bind(program, light.key_lights(key_lights_), light.light_colours());
    else
        kernel_.bind(program, light.key_lights(key_lights_), light.light_colours(), key_windows(state));
    light.bind_light_colours();
    if (key_lights_ > 0) light.bind_key_lights(key_lights_);
    if (state.grooves) state.grooves->bind(even_kernel_, program);
    program.set("mirror_weight", mirror_weight_);
    if (const auto& cover = cooked_->material.grating.cover)
        program.set("cover_square", static_cast<float>(cover->ior * cover->ior));
    program.set("groove_turn", glm::vec2(std::cos(state.groove_rotation), std::sin(state.groove_rotation)));
}

void GpuMaterial::require_vertex_light(const SurfaceObject& object, const VertexLight& light) const {
    const std::size_t vertices = object.mesh.positions.size();
    gpu::require_vertex_storage(
        {.what = fmt::format("a grating of representation {} on {} vertices", info(cooked_->tables).name, vertices),
         .blocks = light.blocks + (object.skinned ? 1 : 0),
         .bytes = vertices * light.bytes,
         .texels = vertices * light.texels,
         .remedy = "take fewer bands, a mesh of fewer vertices, or the representation circle or direct"},
        limits_);
}

std::shared_ptr<const GpuMaterial> make_gpu_material(std::shared_ptr<const CookedMaterial> cooked,
                                                     const glm::dmat3& xyz_to_working) {
    std::shared_ptr<const GpuMaterial> material;
    const auto make_if = [&]<std::size_t I>(std::integral_constant<std::size_t, I>) {
        if (const auto* tables = std::get_if<I>(&cooked->tables))
            material = std::make_shared<const std::tuple_element_t<I, GpuClasses>>(cooked, *tables, xyz_to_working);
    };
    [&]<std::size_t... I>(std::index_sequence<I...>) {
        (make_if(std::integral_constant<std::size_t, I>()), ...);
    }
    (std::make_index_sequence<kRepresentationCount>());
    return material;
}

void set_pixel_shader(gpu::ProgramDesc& desc, const char* file, int samplers) {
    add_samplers(desc, samplers);
    std::erase_if(desc.defines, [](const gpu::Define& define) { return define.first == "PROBE_LIGHT"; });
    desc.defines.push_back({"PROBE_LIGHT", shader_file(file)});
}

void set_vertex_shader(gpu::ProgramDesc& desc, const char* file) {
    desc.defines.push_back({"VERTEX_SHADED", "1"});
    desc.defines.push_back({"VERTEX_LIGHT", shader_file(file)});
}

namespace {

/// Like a map without key lights, a picture shows the whole probe and no other light.
std::shared_ptr<const CookedMaterial> as_a_map(const CookedMaterial& cooked) {
    auto map = std::make_shared<CookedMaterial>(cooked);
    map->material.quality.key_lights = 0;
    map->tables = CircleTables{};
    map->reflected = nullptr;  // the image shows both sides of a sheet
    return map;
}

}  // namespace

GpuPicture::GpuPicture(const CookedMaterial& cooked, std::shared_ptr<const gpu::Texture> picture,
                       const glm::dmat3& xyz_to_working)
    : GpuMaterial(as_a_map(cooked), xyz_to_working), picture_(std::move(picture)) {}

void GpuPicture::describe(const SurfaceState&, gpu::ProgramDesc& desc) const {
    set_pixel_shader(desc, "shaders/picture.glsl");
}

void GpuPicture::bind_tables(const gpu::Program& program, const SurfaceState&) const {
    picture_->bind(kMapUnit);
    // The viewport is that of the whole image, whatever the scissor.
    std::array<GLint, 4> viewport{};
    glGetIntegerv(GL_VIEWPORT, viewport.data());
    program.set("picture_scale", 1.0F / glm::vec2(viewport[2], viewport[3]));
}

}  // namespace rowland::diffraction
