#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>

#include "engine/core/computed.h"
#include "engine/gpu/program.h"
#include "engine/lighting/light_samples.h"
#include "modules/diffraction/representations/planar/lobe_map.h"
#include "modules/diffraction/representations/planar/planar.h"
#include "modules/diffraction/runtime/map_upload.h"

namespace rowland::diffraction {

/// A material's spectra for the two maps that an object gets: a coarse one at once, then the full one.
class LobeMapper {
 public:
    LobeMapper(const PlanarLobe& lobe, const glm::dmat3& xyz_to_working);

    struct Level {
        int azimuths;
        LobeSpectrum spectrum;
    };
    const Level& coarse() const { return coarse_; }
    const Level& full() const { return full_; }

 private:
    Level coarse_;
    Level full_;
};

/// The maps of one object. They are filled on another thread; frames upload some slices each. While an object turns it
/// gets one coarse map after the other, and shows the last one.
class LobeFilling {
 public:
    struct Key {
        std::shared_ptr<const lighting::LightSamples> texels;
        glm::dvec3 normal{0.0};

        friend bool operator==(const Key&, const Key&) = default;
    };

    /// Call once per frame. Uploads at most so many slices of a full map; if that is all of them, waits for it. Throws
    /// Error (system) if a map cannot be filled.
    void update(const Key& key, const std::shared_ptr<const LobeMapper>& mapper, int slices_per_frame);

    /// A map can be shown, of this key or of an earlier one.
    bool has_map() const { return shown_.has_value(); }
    /// The full map of the last key is shown.
    bool is_complete() const { return complete_; }
    void bind(const gpu::Program& program) const;

    /// Maps begun, and maps shown of either level, since the object was first drawn.
    int fills_begun() const { return fills_begun_; }
    int maps_shown() const { return maps_shown_; }

 private:
    struct Filled {
        std::shared_ptr<MapTexels> texels;
        LobeMapSize size;
        bool half_turn = false;
        PlaneAxes axes;
        bool full = false;
    };
    using Filling = Computed<Key, Filled>;
    static Filled fill(const Key& key, const LobeMapper::Level& level, const std::stop_token& stop);
    void want(const Key& key, const std::shared_ptr<const LobeMapper>& mapper);
    void take_over(const Filling::Change& change);
    void upload(int slices);

    std::optional<Key> wanted_;
    Filling filling_;
    std::optional<MapUpload> upload_;  ///< of uploading_
    Filled uploading_;
    std::optional<GpuMap> map_;
    std::optional<Filled> shown_;  ///< what map_ is
    bool complete_ = false;
    int fills_begun_ = 0;
    int maps_shown_ = 0;
};

}  // namespace rowland::diffraction
