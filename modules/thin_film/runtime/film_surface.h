#pragma once

#include <glm/mat3x3.hpp>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "engine/render/material.h"
#include "modules/thin_film/asset/cooked_film.h"
#include "modules/thin_film/runtime/gpu_film.h"

namespace rowland::thin_film {

/// Component: a film over the entity's StandardMaterial. The table decides what the film lies on: the material's
/// metallic factor and colour are those of its diffuse base.
struct FilmSurface {
    std::shared_ptr<const GpuFilm> film = nullptr;
    float factor = 1.0F;                            ///< 0: no film
    render::SurfaceTexture factor_texture = {};     ///< R
    float thickness_at_0_nm = 0.0F;                 ///< where the thickness texture is 0
    float thickness_at_1_nm = 400.0F;               ///< where it is 1, and everywhere without one
    render::SurfaceTexture thickness_texture = {};  ///< G
};

/// Gives an entity, which already has its StandardMaterial, a cooked film: its roughness, and black below.
/// `xyz_to_working` as the renderer's.
void add_film(ecs::World& world, ecs::Entity entity, const CookedFilm& cooked, const glm::dmat3& xyz_to_working);

/// Draws entities that have a FilmSurface, and reads KHR_materials_iridescence.
class FilmSurfaceType final : public render::MaterialType {
 public:
    /// `xyz_to_working` as the renderer's.
    explicit FilmSurfaceType(const glm::dmat3& xyz_to_working) : xyz_to_working_(xyz_to_working) {}

    std::string name() const override { return "thin film"; }
    std::string gltf_extension() const override;
    std::vector<std::string> gltf_extensions_beside() const override;
    /// Bakes the film now. Equal films share their tables.
    void attach(ecs::World& world, ecs::Entity entity, const nlohmann::json& extension,
                render::SurfaceTextures& textures, const std::string& file, const std::string& pointer) override;

    void add_shaders(gpu::ShaderLibrary& library) const override;
    bool owns(ecs::World& world, ecs::Entity entity) const override;
    gpu::ProgramDesc program(ecs::World& world, ecs::Entity entity) const override;
    void update(ecs::World& world, const render::FrameLight& light) override;
    void bind(ecs::World& world, ecs::Entity entity, const gpu::Program& program) const override;

 private:
    std::shared_ptr<const GpuFilm> baked(const FilmMaterial& material, const std::string& key);

    glm::dmat3 xyz_to_working_;
    std::map<std::string, std::weak_ptr<const GpuFilm>> baked_;
    std::set<std::string> warned_of_;  ///< illuminants baked for and lit by
};

}  // namespace rowland::thin_film
