#include "modules/thin_film/runtime/film_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <nlohmann/json.hpp>
#include <span>
#include <utility>

#include "engine/core/log.h"
#include "engine/render/draw_list.h"
#include "engine/render/surface_textures.h"
#include "modules/thin_film/asset/gltf_iridescence.h"
#include "modules/thin_film/shaders/shader_files.h"

namespace rowland::thin_film {

namespace {

/// Of the material's KHR_materials_ior.
double dielectric_ior(ecs::World& world, ecs::Entity entity, const std::string& file, const std::string& pointer) {
    constexpr double kDefault = 1.5;
    const auto* material = world.find<render::FileMaterial>(entity);
    if (material == nullptr) return kDefault;
    const auto& extensions = material->description->extensions;
    const auto found = extensions.find(kIorExtension);
    if (found == extensions.end()) return kDefault;
    return parse_gltf_ior(found->second, file, pointer.substr(0, pointer.rfind('/') + 1) + kIorExtension);
}

render::SurfaceTexture texture(const std::optional<scene::TextureUse>& use, render::SurfaceTextures& textures,
                               const std::string& file, const std::string& pointer) {
    if (!use) return {};
    render::require_texture(textures.scene(), use->texture, file, pointer);
    return textures.get(*use, render::TexelMeaning::Linear);
}

/// PHYSICS §3: what the file names, else an index that gives the metallic-roughness surface's reflectance at normal
/// incidence.
Base base_of(const GltfIridescence& iridescence, const render::StandardMaterial& material, double ior) {
    if (iridescence.base) return *iridescence.base;
    if (material.metallic == 0.0F) return std::complex<double>(ior, 0.0);
    const double dielectric = std::pow((ior - 1.0) / (ior + 1.0), 2.0);
    return NormalReflectance{glm::mix(glm::dvec3(dielectric), glm::clamp(glm::dvec3(material.base_colour), 0.0, 1.0),
                                      static_cast<double>(material.metallic))};
}

FilmMaterial film_material(const GltfIridescence& iridescence, const render::StandardMaterial& material, double ior) {
    const bool varies = iridescence.thickness_texture.has_value();
    const double other_nm = varies ? iridescence.thickness_at_0_nm : iridescence.thickness_at_1_nm;
    const auto [thinnest_nm, thickest_nm] = std::minmax(other_nm, iridescence.thickness_at_1_nm);
    const double roughness = material.roughness;
    return {.film = {.layers = {{.index = iridescence.ior, .thickness_nm = thickest_nm}},
                     .base = base_of(iridescence, material, ior)},
            .range = {.thinnest_nm = thinnest_nm,
                      .thickest_nm = thickest_nm,
                      .smoothest = material.metallic_roughness_texture ? 0.0 : roughness,
                      .roughest = roughness},
            .illuminant = iridescence.illuminant};
}

/// Whether nothing is seen of the light that passes the film.
bool is_black(const render::StandardMaterial& material) {
    const bool metal = material.metallic == 1.0F && !material.metallic_roughness_texture;
    return !material.passes_light && (metal || material.base_colour == glm::vec3(0.0F));
}

void add_map(const char* define, const render::SurfaceTexture& texture, gpu::ProgramDesc& desc) {
    if (!texture) return;
    desc.defines.push_back({define, texture.uv_set == 1 ? "uv1" : "uv"});
    const gpu::Define attribute{texture.uv_set == 1 ? "HAS_UV1" : "HAS_UV", ""};
    if (std::find(desc.defines.begin(), desc.defines.end(), attribute) == desc.defines.end())
        desc.defines.push_back(attribute);
}

}  // namespace

void add_film(ecs::World& world, ecs::Entity entity, const CookedFilm& cooked, const glm::dmat3& xyz_to_working) {
    auto& material = world.get<render::StandardMaterial>(entity);
    material.base_colour = glm::vec3(0.0F);
    material.roughness = static_cast<float>(cooked.material.range.roughest);
    material.clear_coat = 0.0F;
    material.passes_light = material.alpha_mode == scene::AlphaMode::Blend;
    world.add(entity, FilmSurface{.film = std::make_shared<const GpuFilm>(cooked.table, xyz_to_working,
                                                                          cooked.material.illuminant.name),
                                  .thickness_at_1_nm = static_cast<float>(cooked.material.range.thickest_nm)});
}

std::string FilmSurfaceType::gltf_extension() const {
    return kIridescenceExtension;
}

std::vector<std::string> FilmSurfaceType::gltf_extensions_beside() const {
    return {kIorExtension};
}

void FilmSurfaceType::attach(ecs::World& world, ecs::Entity entity, const nlohmann::json& extension,
                             render::SurfaceTextures& textures, const std::string& file, const std::string& pointer) {
    const GltfIridescence read = parse_gltf_iridescence(extension, file, pointer);
    FilmSurface surface{
        .factor = static_cast<float>(read.factor),
        .factor_texture = texture(read.factor_texture, textures, file, pointer + "/iridescenceTexture"),
        .thickness_at_0_nm = static_cast<float>(read.thickness_at_0_nm),
        .thickness_at_1_nm = static_cast<float>(read.thickness_at_1_nm),
        .thickness_texture = texture(read.thickness_texture, textures, file, pointer + "/iridescenceThicknessTexture")};
    auto& material = world.get<render::StandardMaterial>(entity);
    if (read.factor == 0.0 || material.unlit) return;
    if (material.clear_coat > 0.0F)
        log_warning("{}: {}: KHR_materials_clearcoat over a thin film is not drawn", file, pointer);
    material.clear_coat = 0.0F;
    material.passes_light = material.alpha_mode == scene::AlphaMode::Blend;
    const double ior = dielectric_ior(world, entity, file, pointer);
    const std::string key = fmt::format("{} {} {} {} {} {} {} {}", extension.dump(), ior, material.metallic,
                                        material.base_colour.r, material.base_colour.g, material.base_colour.b,
                                        material.roughness, static_cast<bool>(material.metallic_roughness_texture));
    surface.film = baked(film_material(read, material, ior), key);
    world.add(entity, std::move(surface));
}

std::shared_ptr<const GpuFilm> FilmSurfaceType::baked(const FilmMaterial& material, const std::string& key) {
    if (auto present = baked_[key].lock()) return present;
    auto made = std::make_shared<const GpuFilm>(bake_film(material), xyz_to_working_, material.illuminant.name);
    baked_[key] = made;
    return made;
}

void FilmSurfaceType::add_shaders(gpu::ShaderLibrary& library) const {
    library.add_embedded(shader_files());
}

bool FilmSurfaceType::owns(ecs::World& world, ecs::Entity entity) const {
    return world.find<FilmSurface>(entity) != nullptr;
}

gpu::ProgramDesc FilmSurfaceType::program(ecs::World& world, ecs::Entity entity) const {
    const FilmSurface& surface = world.get<FilmSurface>(entity);
    gpu::ProgramDesc desc{.vertex = "engine/render/shaders/plain.vert.glsl",
                          .fragment = "modules/thin_film/shaders/film.frag.glsl",
                          .defines = {{"AMBIENT_AT_VERTICES", "1"}}};
    for (const gpu::Define& define : surface.film->defines()) desc.defines.push_back(define);
    if (surface.factor == 1.0F && !surface.factor_texture) desc.defines.push_back({"FILM_WHOLE", "1"});
    const auto& material = world.get<render::StandardMaterial>(entity);
    if (material.passes_light) desc.defines.push_back({"FILM_PASSES_LIGHT", "1"});
    if (is_black(material)) desc.defines.push_back({"FILM_ON_BLACK", "1"});
    add_map("FILM_FACTOR_MAP", surface.factor_texture, desc);
    add_map("FILM_THICKNESS_MAP", surface.thickness_texture, desc);
    return desc;
}

void FilmSurfaceType::update(ecs::World& world, const render::FrameLight& light) {
    if (!light.probe) return;
    const std::string& lit_by = light.probe->illuminant.name;
    world.view<FilmSurface>().each([&](ecs::Entity, const FilmSurface& surface) {
        const std::string& baked_for = surface.film->illuminant();
        if (baked_for == lit_by || !warned_of_.insert(baked_for + " " + lit_by).second) return;
        log_warning("a film baked for the illuminant {} is lit by {}: it shows the colours of {}", baked_for, lit_by,
                    baked_for);
    });
}

void FilmSurfaceType::bind(ecs::World& world, ecs::Entity entity, const gpu::Program& program) const {
    const FilmSurface& surface = world.get<FilmSurface>(entity);
    surface.film->bind(program);
    program.set("film_factor", surface.factor);
    program.set("film_thickness", glm::vec2(surface.thickness_at_0_nm, surface.thickness_at_1_nm));
    if (!surface.factor_texture && !surface.thickness_texture) return;
    const std::array<render::UvTransform, 2> uv = {render::uv_transform(surface.factor_texture.transform),
                                                   render::uv_transform(surface.thickness_texture.transform)};
    const std::array<glm::vec4, 2> linear = {uv[0].linear, uv[1].linear};
    program.set("film_uv_linear", std::span<const glm::vec4>(linear));
    program.set("film_uv_offset", glm::vec4(uv[0].offset, uv[1].offset));
    if (surface.factor_texture) surface.factor_texture.texture->bind(kFactorMapUnit);
    if (surface.thickness_texture) surface.thickness_texture.texture->bind(kThicknessMapUnit);
}

}  // namespace rowland::thin_film
