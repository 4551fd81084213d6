#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <optional>

#include "modules/diffraction/representations/arc/gpu_arc.h"
#include "modules/diffraction/representations/planar/planar_map.h"
#include "modules/diffraction/runtime/gpu_map.h"
#include "modules/diffraction/runtime/gpu_material.h"

namespace rowland::diffraction {

/// What GpuPlanar keeps for an object: its map, or the one that is being filled.
struct PlanarData final : ObjectData {
    std::shared_ptr<const scene::Mesh> mesh;  ///< that `flat` was found for
    std::optional<glm::dvec3> flat;           ///< the mesh's normal, in its own axes
    /// What the map is wanted for, and whether that was so a frame ago, too.
    std::optional<glm::dvec3> normal;
    std::shared_ptr<const lighting::LightSamples> texels;
    bool at_rest = false;

    std::optional<PlanarFill> fill;  ///< while azimuths are missing
    PlanarMap map;
    int filled = 0;                ///< azimuths
    std::optional<GpuMap> on_gpu;  ///< the whole map
    bool stand_in_is_old = true;

    int fills_begun = 0;      ///< since the object was first drawn
    int azimuths_filled = 0;  ///< likewise
};

/// One map for a flat object: shaders/planar_map.glsl. It is filled again, a few azimuths a frame, when the object's
/// normal or the probe has turned and then rested for a frame; a turn about the normal needs nothing. Until it is full,
/// and for what is not flat, the arc table shades.
class GpuPlanar final : public GpuMaterial {
 public:
    GpuPlanar(const CookedMaterial& cooked, const PlanarTables& tables, const glm::dmat3& xyz_to_working);

    void update(const SurfaceObject& object, SurfaceLight& light, SurfaceState& state) const override;
    bool filling(const SurfaceState& state) const override;

 private:
    void describe(const SurfaceState& state, gpu::ProgramDesc& desc) const override;
    void bind_tables(const gpu::Program& program, const SurfaceState& state) const override;

    void find_flatness(const SurfaceObject& object, const SurfaceState& state, PlanarData& data) const;
    void want(const std::optional<glm::dvec3>& normal, const SurfaceLight& light, PlanarData& data) const;
    void fill(int slices, PlanarData& data) const;

    GpuArc stand_in_;
    bool map_at_vertices_;
    PlanarMapSize size_;
    KernelTable kernel_;
    double pitch_nm_;
    glm::dmat3 zero_order_xyz_;
};

}  // namespace rowland::diffraction
