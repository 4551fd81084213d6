#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <optional>
#include <tuple>
#include <vector>

#include "engine/core/parallel.h"
#include "engine/gpu/buffer.h"
#include "engine/gpu/program.h"
#include "engine/gpu/texture.h"
#include "modules/diffraction/runtime/gpu_material.h"
#include "modules/diffraction/runtime/vertex_light.h"

namespace rowland::diffraction {

/// A view table on the GPU: shaders/view_table.glsl.
class GpuTable {
 public:
    /// As many layers as `packed` has scales.
    GpuTable(const PackedTexels& packed, const ViewGrid& grid);

    void add_defines(gpu::ProgramDesc& desc) const;
    void bind() const;

 private:
    ViewGrid grid_;
    gpu::Texture texture_;
    gpu::Buffer ranges_;
};

/// The paper's representation, which shades vertices from a view table and the light's SH in each vertex's tangent
/// frame: spikes.glsl.
class GpuSpikes final : public GpuMaterial {
 public:
    GpuSpikes(std::shared_ptr<const CookedMaterial> cooked, const SpikeTable& table, const glm::dmat3& xyz_to_working);

    void update(const SurfaceObject& object, SurfaceLight& light, SurfaceState& state) const override;

 private:
    void describe(const SurfaceState& state, gpu::ProgramDesc& desc) const override;
    void bind_tables(const gpu::Program& program, const SurfaceState& state) const override;

    int bands_;
    int spikes_;
    GpuTable table_;
    gpu::Texture wavelengths_;
};

/// Products of arc moments or SH at the vertices, a sum over ranks at the pixels: arc.glsl. Under a GrooveMap a flat
/// object has the products as a series over the azimuth of g, evaluated per pixel. On other objects the vertices are
/// rotated as the map says.
class GpuArc final : public GpuMaterial {
 public:
    GpuArc(std::shared_ptr<const CookedMaterial> cooked, const ArcTable& table, const glm::dmat3& xyz_to_working);

    void update(const SurfaceObject& object, SurfaceLight& light, SurfaceState& state) const override;
    void describe(const SurfaceState& state, gpu::ProgramDesc& desc) const override;
    void bind_tables(const gpu::Program& program, const SurfaceState& state) const override;

 private:
    std::vector<glm::vec4> grooved_products(const SurfaceObject& object, const lighting::ShLight& light,
                                            SurfaceState& state) const;

    ArcProducts products_;
    GpuTable weights_;
    std::optional<PitchAxis> pitch_;
};

/// Analytic lights and key lights alone.
class GpuDirect final : public GpuMaterial {
 public:
    GpuDirect(std::shared_ptr<const CookedMaterial> cooked, const DirectTables&, const glm::dmat3& xyz_to_working)
        : GpuMaterial(std::move(cooked), xyz_to_working) {}

    void update(const SurfaceObject&, SurfaceLight&, SurfaceState&) const override {}

 private:
    void describe(const SurfaceState&, gpu::ProgramDesc&) const override {}
    void bind_tables(const gpu::Program&, const SurfaceState&) const override {}
    bool has_common_tables(const SurfaceState&) const override { return true; }
};

/// One map for all flat objects with one normal: planar_map.glsl. It follows the normal and the probe; a rotation about
/// the normal leaves it valid, except for a map of one g, over v_g and v_h alone. An arc table shades objects
/// that are not flat, those without a probe's texels, and others until there is a map.
class GpuPlanar final : public GpuMaterial {
 public:
    GpuPlanar(std::shared_ptr<const CookedMaterial> cooked, const PlanarTables& tables,
              const glm::dmat3& xyz_to_working);

    void update(const SurfaceObject& object, SurfaceLight& light, SurfaceState& state) const override;

 private:
    void describe(const SurfaceState& state, gpu::ProgramDesc& desc) const override;
    void bind_tables(const gpu::Program& program, const SurfaceState& state) const override;
    bool has_common_tables(const SurfaceState& state) const override { return !state.without_map; }

    MapInput map_input(const SurfaceObject& object, const SurfaceLight& light, const SurfaceState& state) const;

    Lazy<std::unique_ptr<const GpuArc>> stand_in_;
    std::shared_ptr<const FillMap> fill_;
    bool lobe_map_;   ///< of a lobe that is not flat
    bool half_turn_;  ///< such a map has half of the azimuths
    bool pitch_axis_;
};

/// One map for all objects of a material: circle.glsl. It follows the probe; objects do not matter. Until it is there,
/// only analytic lights and key lights are shown.
class GpuCircle final : public GpuMaterial {
 public:
    GpuCircle(std::shared_ptr<const CookedMaterial> cooked, const CircleTables& tables,
              const glm::dmat3& xyz_to_working);

    void update(const SurfaceObject& object, SurfaceLight& light, SurfaceState& state) const override;

 private:
    void describe(const SurfaceState& state, gpu::ProgramDesc& desc) const override;
    void bind_tables(const gpu::Program& program, const SurfaceState& state) const override;
    bool has_common_tables(const SurfaceState&) const override { return true; }

    CircleMapSize size_;
    int charts_;
    std::shared_ptr<const FillMap> fill_;
};

/// The streak of a narrow lobe from a map of the whole probe, and an arc table for the incoherent part of Stam's pits:
/// streak.glsl. One map for all objects of a material; it follows the probe.
class GpuStreak final : public GpuMaterial {
 public:
    GpuStreak(std::shared_ptr<const CookedMaterial> cooked, const StreakTables& tables,
              const glm::dmat3& xyz_to_working);

    void update(const SurfaceObject& object, SurfaceLight& light, SurfaceState& state) const override;

 private:
    void describe(const SurfaceState& state, gpu::ProgramDesc& desc) const override;
    void bind_tables(const gpu::Program& program, const SurfaceState& state) const override;
    bool has_common_tables(const SurfaceState&) const override { return !incoherent_; }

    gpu::Buffer segments_;
    float reach_;         ///< Streak::reach()
    float level_;         ///< log2 of the lobe's deviation over the map's
    float power_;         ///< scale of the streak's sum
    float arc_fraction_;  ///< of the light that the arc table of the incoherent part shades
    std::optional<GpuArc> incoherent_;

    std::shared_ptr<const FillMap> fill_;
};

/// The classes that draw the alternatives of BakedTables, in its order.
using GpuClasses = std::tuple<GpuSpikes, GpuArc, GpuDirect, GpuPlanar, GpuCircle, GpuStreak>;
static_assert(std::tuple_size_v<GpuClasses> == kRepresentationCount);

}  // namespace rowland::diffraction
