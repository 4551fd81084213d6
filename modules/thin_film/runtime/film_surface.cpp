#include "modules/thin_film/runtime/film_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/matrix.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>
#include <utility>
#include <vector>

#include "engine/core/file.h"
#include "engine/core/log.h"
#include "engine/render/draw_list.h"
#include "engine/render/surface_programs.h"
#include "engine/render/surface_textures.h"
#include "modules/thin_film/asset/gltf_iridescence.h"
#include "modules/thin_film/shaders/shader_files.h"

namespace rowland::thin_film {

namespace {

/// In 32-bit floats: software renderers read them faster than halves.
gpu::Texture upload(const FilmTable& table, const glm::dmat3& xyz_to_working) {
    const glm::ivec2 size = texture_size(table);
    gpu::Texture texture({.kind = is_line(table) ? gpu::TextureKind::Line : gpu::TextureKind::Plane,
                          .format = gpu::Format::RGBA32F,
                          .width = size.x,
                          .height = size.y});
    texture.upload(std::span<const glm::vec4>(working_columns(table, xyz_to_working)));
    return texture;
}

std::vector<gpu::Define> defines_for(const FilmTable& table) {
    if (is_line(table)) return {{"FILM_LINE", "1"}};
    if (has_roughnesses(table)) return {{"FILM_ROUGHNESSES", "1"}};
    if (table.by_lobe_nodes) return {{"FILM_LOBE_NODES", "1"}};
    return {};
}

}  // namespace

GpuFilm::GpuFilm(const FilmTable& table, const glm::dmat3& xyz_to_working, std::string illuminant)
    : texture_(upload(table, xyz_to_working)),
      defines_(defines_for(table)),
      axes_(film_axes(table)),
      illuminant_(std::move(illuminant)) {}

void GpuFilm::bind(const gpu::Program& program) const {
    texture_.bind(kFilmTableUnit);
    program.set("film_path", axes_.path);
    program.set("film_axes", axes_.axes);
}

namespace {

render::SurfaceTexture texture(const std::optional<scene::TextureUse>& use, render::SurfaceTextures& textures,
                               const std::string& file, const std::string& pointer) {
    if (!use) return {};
    scene::require_texture(textures.scene(), use->texture, file, pointer);
    return textures.get(*use, render::TexelMeaning::Linear);
}

/// Whether light transmitted by the film is absorbed.
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
                                  .maximum_thickness_nm = static_cast<float>(cooked.material.range.thickest_nm)});
}

std::string FilmSurfaceType::gltf_extension() const {
    return kIridescenceExtension;
}

std::vector<std::string> FilmSurfaceType::gltf_extensions_beside() const {
    return {kIorExtension};
}

void add_film(ecs::World& world, ecs::Entity entity, const GltfIridescence& read, std::shared_ptr<const GpuFilm> film,
              render::SurfaceTextures& textures, const std::string& file, const std::string& pointer) {
    FilmSurface surface{
        .film = std::move(film),
        .factor = static_cast<float>(read.factor),
        .factor_texture = texture(read.factor_texture, textures, file, pointer + "/iridescenceTexture"),
        .minimum_thickness_nm = static_cast<float>(read.minimum_thickness_nm),
        .maximum_thickness_nm = static_cast<float>(read.maximum_thickness_nm),
        .thickness_texture = texture(read.thickness_texture, textures, file, pointer + "/iridescenceThicknessTexture")};
    auto& material = world.get<render::StandardMaterial>(entity);
    if (surface.film == nullptr) return;
    if (material.clear_coat > 0.0F)
        log_warning("{}: {}: KHR_materials_clearcoat over a thin film is not drawn", file, pointer);
    material.clear_coat = 0.0F;
    material.passes_light = material.alpha_mode == scene::AlphaMode::Blend;
    world.add(entity, std::move(surface));
}

void FilmSurfaceType::attach(ecs::World& world, ecs::Entity entity, const render::MaterialExtension& extension,
                             render::SurfaceTextures& textures) {
    const auto& [object, description, file, pointer] = extension;
    const GltfIridescence read = parse_gltf_iridescence(object, file, pointer);
    const bool drawn = read.factor != 0.0 && !description.unlit;  // as film_material() decides
    add_film(world, entity, read,
             drawn ? uploaded(extension.tables(kIridescenceExtension), read, file + ": " + pointer) : nullptr, textures,
             file, pointer);
}

std::shared_ptr<const GpuFilm> FilmSurfaceType::uploaded(const std::vector<std::byte>& tables,
                                                         const GltfIridescence& extension, const std::string& file) {
    std::weak_ptr<const GpuFilm>& kept = uploaded_[Hasher().bytes(tables).digest().hex()];
    if (auto present = kept.lock()) return present;
    auto made =
        std::make_shared<const GpuFilm>(read_gltf_film(tables, file), xyz_to_working_, extension.illuminant.name);
    kept = made;
    return made;
}

void FilmSurfaceType::add_shaders(gpu::ShaderLibrary& library) const {
    library.add_embedded(shader_files());
}

bool FilmSurfaceType::owns(ecs::World& world, ecs::Entity entity) const {
    return world.find<FilmSurface>(entity) != nullptr;
}

gpu::ProgramDesc FilmSurfaceType::program(ecs::World& world, ecs::Entity entity, render::ProbeSlot /*slot*/) const {
    const FilmSurface& surface = world.get<FilmSurface>(entity);
    gpu::ProgramDesc desc{.vertex = "engine/render/shaders/plain.vert.glsl",
                          .fragment = "modules/thin_film/shaders/film.frag.glsl",
                          .defines = {{"AMBIENT_AT_VERTICES", "1"}, {render::kMaterialSamplers, "4"}}};
    for (const gpu::Define& define : surface.film->defines()) desc.defines.push_back(define);
    if (surface.factor == 1.0F && !surface.factor_texture) desc.defines.push_back({"FILM_WHOLE", "1"});
    const auto& material = world.get<render::StandardMaterial>(entity);
    if (material.passes_light) desc.defines.push_back({"FILM_PASSES_LIGHT", "1"});
    if (is_black(material)) desc.defines.push_back({"FILM_ON_BLACK", "1"});
    add_map("FILM_FACTOR_MAP", surface.factor_texture, desc);
    add_map("FILM_THICKNESS_MAP", surface.thickness_texture, desc);
    return desc;
}

void FilmSurfaceType::update(ecs::World& world, std::span<const render::FrameLight> lights,
                             std::span<const render::LitEntity> seen) {
    for (const render::LitEntity& lit : seen) {
        if (!owns(world, lit.entity)) continue;
        const std::string& baked_for = world.get<FilmSurface>(lit.entity).film->illuminant();
        const std::string& lit_by = lights[lit.light.first].probe->illuminant.name;
        if (baked_for == lit_by || !warned_pairs_.emplace(baked_for, lit_by).second) continue;
        log_warning("a film baked for the illuminant {} is lit by {}: it shows the colours of {}", baked_for, lit_by,
                    baked_for);
    }
}

void FilmSurfaceType::bind(ecs::World& world, ecs::Entity entity, render::ProbeSlot /*slot*/,
                           const gpu::Program& program) const {
    const FilmSurface& surface = world.get<FilmSurface>(entity);
    surface.film->bind(program);
    program.set("film_factor", surface.factor);
    program.set("film_thickness", glm::vec2(surface.minimum_thickness_nm, surface.maximum_thickness_nm));
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
