#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <optional>

#include "modules/diffraction/representations/arc/gpu_arc.h"
#include "modules/diffraction/representations/planar/lobe_filling.h"
#include "modules/diffraction/representations/planar/planar_map.h"
#include "modules/diffraction/runtime/gpu_map.h"
#include "modules/diffraction/runtime/gpu_material.h"

namespace rowland::diffraction {

/// GpuPlanar's data of an object: its map, or the map that is being filled.
struct PlanarData final : ObjectData {
    std::shared_ptr<const scene::Mesh> mesh;  ///< of `flat`
    std::optional<glm::dvec3> flat;           ///< the mesh's normal, in its own axes
    std::optional<glm::dvec3> normal;         ///< in the world; with `texels`, the map's key
    std::shared_ptr<const lighting::LightSamples> texels;
    bool at_rest = false;  ///< the key was the same in the last frame

    std::optional<PlanarFill> fill;  ///< while azimuths are missing
    PlanarMap map;
    int filled = 0;                ///< azimuths
    std::optional<GpuMap> on_gpu;  ///< the whole map
    bool stand_in_is_old = true;   ///< the stand-in's vertex data are out of date

    int fills_begun = 0;      ///< since the object was first drawn
    int azimuths_filled = 0;  ///< likewise

    LobeFilling lobe;  ///< the maps of a lobe that is not flat, in place of `fill`, `map` and `on_gpu`
};

/// One map for each flat object: planar_map.glsl. When the object's normal or the probe changes and then stays the same
/// for a frame, the map is filled again, a few azimuths per frame. A rotation about the normal leaves it valid. The arc
/// table shades until the map is full, and objects that are not flat. With a lobe that is not flat the maps are filled
/// on another thread, and the last one is shown until there is another: LobeFilling.
class GpuPlanar final : public GpuMaterial {
 public:
    GpuPlanar(const CookedMaterial& cooked, const PlanarTables& tables, const glm::dmat3& xyz_to_working);

    void update(const SurfaceObject& object, SurfaceLight& light, SurfaceState& state) const override;
    bool filling(const SurfaceState& state) const override;

 private:
    void describe(const SurfaceState& state, gpu::ProgramDesc& desc) const override;
    bool describe_other(const SurfaceState& state, gpu::ProgramDesc& desc) const override;
    void describe_map(const SurfaceState& state, gpu::ProgramDesc& desc) const;
    void bind_tables(const gpu::Program& program, const SurfaceState& state) const override;

    void find_flatness(const SurfaceObject& object, const SurfaceState& state, PlanarData& data) const;
    void want(const std::optional<glm::dvec3>& normal, const SurfaceLight& light, PlanarData& data) const;
    void fill(int slices, PlanarData& data) const;
    void update_map(const SurfaceObject& object, SurfaceLight& light, PlanarData& data) const;
    bool has_map(const PlanarData& data) const {
        return mapper_ ? data.normal && data.lobe.has_map() : data.on_gpu.has_value();
    }

    GpuArc stand_in_;
    PlanarMapSize size_;
    std::shared_ptr<const LobeMapper> mapper_;  ///< of a lobe that is not flat
};

}  // namespace rowland::diffraction
