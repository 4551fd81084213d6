#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

#include "engine/core/computed.h"
#include "engine/gpu/program.h"
#include "engine/gpu/texture.h"
#include "engine/lighting/light_samples.h"

namespace rowland::diffraction {

/// Largest magnitude of a component, above 0.
float largest_component(std::span<const glm::vec3> xyz);
float largest_component(std::span<const glm::vec4> values);

/// A map of radiance (XYZ) in its texture's layout, divided by its largest component: in fp16, which ends at 65504, or
/// in 10 bits.
struct MapTexels {
    gpu::TextureDesc desc;
    gpu::Sampling sampling;
    float scale = 1.0F;  ///< the largest component
    /// Halves of each level, four per texel, or texels of RGB10_A2 in ten_bits.
    std::vector<std::vector<std::uint16_t>> levels{};
    std::vector<std::uint32_t> ten_bits{};
};

/// `levels`: values in the order of each level's rows and slices. Uses all cores.
MapTexels pack(std::span<const std::vector<glm::vec3>> levels, gpu::TextureDesc desc, const gpu::Sampling& sampling);
MapTexels pack(std::span<const std::vector<glm::vec4>> levels, gpu::TextureDesc desc, const gpu::Sampling& sampling);

/// Values of either sign in ten bits per component, 0 to 1 for −scale to scale: one level, as RGB10_A2.
MapTexels pack_ten_bits(std::span<const glm::vec3> values, gpu::TextureDesc desc, const gpu::Sampling& sampling);

/// A map on the GPU, uploaded some slices at a time.
class GpuMap {
 public:
    GpuMap() = default;
    /// `spare` is a map that is no longer shown: its texture is used again if it has the size. Maps of one size are
    /// sampled in one way.
    GpuMap(MapTexels texels, GpuMap spare);

    /// Uploads up to so many slices, at least one; true when all are uploaded.
    bool upload(int slices);

    /// All must be uploaded. `second`: beside another map of the same program.
    void bind(const gpu::Program& program, bool second) const;

 private:
    /// Uploads a part of a level's slices.
    template <typename Word>
    void upload_slices(std::span<const Word> words, int count);

    MapTexels texels_;  ///< without values once they are uploaded
    gpu::Texture texture_;
    std::size_t level_ = 0;
    int slice_ = 0;  ///< of the level, the next to upload
};

/// How long frames wait for maps.
enum class MapPace {
    Incremental,  ///< for a coarse map, tens of milliseconds, where the light is new; never for full ones
    Whole,        ///< for full maps, always. For pictures in files
};

/// What a map is filled from, besides its material.
struct MapInput {
    std::shared_ptr<const lighting::LightSamples> texels;  ///< null: black
    glm::dvec3 normal{0.0};               ///< of a flat object, in the world; 0: the map serves every object
    std::optional<glm::dvec3> grating{};  ///< g of all its points, in the world; none: they differ

    friend bool operator==(const MapInput&, const MapInput&) = default;
};

enum class MapDetail { Coarse, Full };

/// A map on its way to the GPU.
struct FilledMap {
    MapTexels texels;
    std::optional<MapTexels> second{};                      ///< of maps in two textures
    std::function<void(const gpu::Program&)> set_uniforms;  ///< besides GpuMap's
};

/// Fills a map on any thread; the texels are not null. After a stop request it returns early with an unusable map.
using FillMap = std::function<FilledMap(const MapInput&, MapDetail, const std::stop_token&)>;

/// A map that follows its input: another thread fills a coarse map and then the full one, and frames upload them. The
/// last map under the same light is shown until there is another: an object that turns in every frame gets coarse maps.
class MapFilling {
 public:
    /// Call once per frame; then there is a map. Throws Error (system) if a map cannot be filled.
    void update(const MapInput& input, const std::shared_ptr<const FillMap>& fill, MapPace pace);

    /// Some map is shown.
    bool has_map() const { return !map_.empty(); }
    /// The full map of the last input is shown.
    bool is_complete() const { return shown_ && shown_->detail == MapDetail::Full && shown_->input == wanted_; }
    /// There must be a map.
    void bind(const gpu::Program& program) const;

    /// Inputs for which maps were begun, and maps shown of either detail.
    int fills_begun() const { return fills_begun_; }
    int maps_shown() const { return maps_shown_; }

 private:
    struct Filled {
        std::shared_ptr<FilledMap> map;  ///< without its texels once they are uploaded
        MapInput input;
        MapDetail detail;
    };
    using Filling = Computed<MapInput, Filled>;

    void fill_now(const MapInput& input, const FillMap& fill, MapDetail detail);
    void want(const MapInput& input, const std::shared_ptr<const FillMap>& fill);
    void begin_upload(Filled filled);
    void upload(int slices);

    std::optional<MapInput> wanted_;
    Filling filling_;
    std::vector<GpuMap> uploads_;  ///< of uploading_, one per texture
    std::optional<Filled> uploading_;
    std::vector<GpuMap> map_;      ///< one per texture
    std::vector<GpuMap> spare_;    ///< the map before it, whose textures the next one of its size takes
    std::optional<Filled> shown_;  ///< what map_ is
    int fills_begun_ = 0;
    int maps_shown_ = 0;
};

}  // namespace rowland::diffraction
