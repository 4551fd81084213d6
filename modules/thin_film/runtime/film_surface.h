#pragma once

#include <cstddef>
#include <glm/mat3x3.hpp>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/gpu/program.h"
#include "engine/gpu/texture.h"
#include "engine/render/material.h"
#include "modules/thin_film/asset/film_material.h"
#include "modules/thin_film/asset/gltf_iridescence.h"
#include "modules/thin_film/bake/film_table.h"
#include "modules/thin_film/runtime/film_texels.h"

namespace rowland::thin_film {

// As in shaders/.
inline constexpr unsigned kFilmTableUnit = 8;
inline constexpr unsigned kFactorMapUnit = 9;
inline constexpr unsigned kThicknessMapUnit = 10;

/// A film's table on the GPU, in the working space.
class GpuFilm {
 public:
    /// `illuminant`: the name of the one that the table was baked for.
    GpuFilm(const FilmTable& table, const glm::dmat3& xyz_to_working, std::string illuminant);

    void bind(const gpu::Program& program) const;
    /// For the shaders that read it.
    const std::vector<gpu::Define>& defines() const { return defines_; }
    const std::string& illuminant() const { return illuminant_; }

 private:
    gpu::Texture texture_;
    std::vector<gpu::Define> defines_;
    FilmAxes axes_;
    std::string illuminant_;
};

/// Component: a film over the entity's StandardMaterial. What the film and its base reflect is in the table; the
/// material's colour and metallic factor give the diffuse light from below and, under a factor below 1, the bare
/// surface.
struct FilmSurface {
    std::shared_ptr<const GpuFilm> film = nullptr;
    float factor = 1.0F;                            ///< 0: no film
    render::SurfaceTexture factor_texture = {};     ///< R
    float minimum_thickness_nm = 0.0F;              ///< where the thickness texture is 0
    float maximum_thickness_nm = 400.0F;            ///< where it is 1, and everywhere without one
    render::SurfaceTexture thickness_texture = {};  ///< G
};

/// Gives an entity, which already has its StandardMaterial, a cooked film. The material gets the film's roughness,
/// black below it and no clear coat. `xyz_to_working`: the renderer's.
void add_film(ecs::World& world, ecs::Entity entity, const CookedFilm& cooked, const glm::dmat3& xyz_to_working);

/// The same for the film of a glTF's material, which keeps its roughness and colour; null: it is not drawn. `textures`:
/// those of the glTF. `file` and `pointer`, the JSON pointer of the extension, are for messages. Throws Error (input)
/// for a missing texture.
void add_film(ecs::World& world, ecs::Entity entity, const GltfIridescence& iridescence,
              std::shared_ptr<const GpuFilm> film, render::SurfaceTextures& textures, const std::string& file,
              const std::string& pointer);

/// Draws entities that have a FilmSurface, and reads KHR_materials_iridescence.
class FilmSurfaceType final : public render::MaterialType {
 public:
    /// `xyz_to_working`: the renderer's.
    explicit FilmSurfaceType(const glm::dmat3& xyz_to_working) : xyz_to_working_(xyz_to_working) {}

    std::string name() const override { return "thin film"; }
    std::string gltf_extension() const override;
    std::vector<std::string> gltf_extensions_beside() const override;
    /// Entities with equal tables share one GpuFilm.
    void attach(ecs::World& world, ecs::Entity entity, const render::MaterialExtension& extension,
                render::SurfaceTextures& textures) override;

    void add_shaders(gpu::ShaderLibrary& library) const override;
    bool owns(ecs::World& world, ecs::Entity entity) const override;
    gpu::ProgramDesc program(ecs::World& world, ecs::Entity entity, render::ProbeSlot slot) const override;
    void update(ecs::World& world, std::span<const render::FrameLight> lights,
                std::span<const render::LitEntity> seen) override;
    void bind(ecs::World& world, ecs::Entity entity, render::ProbeSlot slot,
              const gpu::Program& program) const override;

 private:
    std::shared_ptr<const GpuFilm> uploaded(const std::vector<std::byte>& tables, const GltfIridescence& extension,
                                            const std::string& file);

    glm::dmat3 xyz_to_working_;
    std::map<std::string, std::weak_ptr<const GpuFilm>> uploaded_;  ///< by the hash of the tables
    std::set<std::pair<std::string, std::string>> warned_pairs_;    ///< illuminants baked for, lit by
};

}  // namespace rowland::thin_film
