#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <glm/vec3.hpp>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "engine/gpu/program.h"
#include "engine/lighting/light_samples.h"
#include "modules/diffraction/runtime/gpu_map.h"

namespace rowland::diffraction {

/// How long frames wait for maps.
enum class MapPace {
    Incremental,  ///< for coarse maps under new light, at most MapCache's longest_wait in all; never for full ones
    Whole,        ///< for full maps, always. For pictures in files
};

/// The longest that a frame waits for coarse maps, by default.
inline constexpr std::chrono::milliseconds kMapWait{250};

/// What a map is filled from, besides its material.
struct MapInput {
    std::shared_ptr<const lighting::LightSamples> texels;  ///< null: black
    glm::dvec3 normal{0.0};               ///< of a flat object, in the world; 0: the map serves every object
    std::optional<glm::dvec3> grating{};  ///< g of all its points, in the world; none: they differ
};

/// Whether one map serves both: their axes may differ by less than shows at a map's resolution.
bool same_map(const MapInput& a, const MapInput& b);

enum class MapDetail { Coarse, Full };

/// A map on its way to the GPU.
struct FilledMap {
    MapTexels texels;
    std::optional<MapTexels> second{};                      ///< of maps in two textures
    std::function<void(const gpu::Program&)> set_uniforms;  ///< besides GpuMap's
};

/// Fills a material's map on any thread; the texels are not null. After a stop request it returns early with an
/// unusable map.
using FillMap = std::function<FilledMap(const MapInput&, MapDetail, const std::stop_token&)>;

/// Fills maps one after the other, on a thread that the first add() starts.
class FillQueue {
 public:
    struct Job {
        std::function<FilledMap(const std::stop_token&)> fill;
        std::stop_source stop;  ///< stopped: nobody waits for the map
        FilledMap map;          ///< once it is done
        std::string failure;    ///< why there is none; empty: no failure
        bool done = false;
    };

    ~FillQueue();

    /// Throws Error (system) if no thread can be started.
    std::shared_ptr<Job> add(std::function<FilledMap(const std::stop_token&)> fill);
    bool is_done(const Job& job) const;
    /// Waits until the job is done, for at most `longest`; nullopt: without a limit.
    void wait(const Job& job, std::optional<std::chrono::nanoseconds> longest) const;

 private:
    void run(const std::stop_token& stop);

    mutable std::mutex lock_;  ///< of jobs_, running_ and what a job's thread writes
    mutable std::condition_variable_any changed_;
    std::deque<std::shared_ptr<Job>> jobs_;
    std::shared_ptr<Job> running_;
    std::jthread thread_;
};

/// The state on the GPU of the one map of all objects with the same `fill` and `input`.
struct SharedMap {
    std::shared_ptr<const FillMap> fill;
    MapInput input;
    std::optional<MapDetail> shown;  ///< nullopt: there is no map yet
    std::vector<GpuMap> parts;       ///< one per texture
    std::function<void(const gpu::Program&)> set_uniforms;

    /// The map that follows.
    MapDetail next = MapDetail::Coarse;
    std::function<void(const gpu::Program&)> next_uniforms;
    std::shared_ptr<FillQueue::Job> job;  ///< null: it is not being filled
    std::vector<GpuMap> uploads;          ///< empty: it is not being uploaded
    std::uint64_t last_use = 0;           ///< frame

    /// There must be a map.
    void bind(const gpu::Program& program) const;
};

/// The maps of a renderer's objects. One thread fills coarse maps in the order in which objects ask for them, another
/// the full ones of those that are seen, and frames upload them. A map that no object has is dropped.
class MapCache {
 public:
    MapCache(MapPace pace, std::chrono::milliseconds longest_wait) : pace_(pace), longest_wait_(longest_wait) {}

    MapPace pace() const { return pace_; }
    /// Call before the frame's objects are updated: takes over what was filled and uploads a part of it, stops the
    /// fills that the last frame did not use, and starts those of full maps. Throws Error (system) if a fill failed.
    void begin_frame();
    /// The map of an input: one for which same_map() holds, else a new one that is not filled yet.
    std::shared_ptr<SharedMap> find_or_add(const std::shared_ptr<const FillMap>& fill, const MapInput& input);
    /// Call for the map of each object that is seen: starts its fill. `wait`: the frame may wait for the coarse map, as
    /// the object has no other. Under MapPace::Whole it always waits for the full one. Throws Error (system) if the
    /// fill failed.
    void use(SharedMap& map, bool wait);

 private:
    void begin(SharedMap& map, MapDetail detail);
    /// Takes over the map if its job is done.
    void take(SharedMap& map);
    void upload(SharedMap& map, int slices);
    FillQueue& queue(MapDetail detail) { return detail == MapDetail::Coarse ? coarse_ : full_; }

    MapPace pace_;
    std::chrono::nanoseconds longest_wait_;
    std::chrono::nanoseconds wait_left_{0};  ///< of the frame
    std::uint64_t frame_ = 0;
    std::vector<std::shared_ptr<SharedMap>> maps_;
    std::vector<gpu::Texture> spare_;  ///< of coarse maps, for those that follow
    FillQueue coarse_;
    FillQueue full_;
};

/// An object's map, which follows its input. The last map under the same light is shown until there is another: an
/// object that turns in every frame has coarse maps.
class ObjectMap {
 public:
    /// Call in each frame in which the object is seen. `may_wait`: whether the frame may wait for the object's first
    /// map. Throws Error (system) if a map cannot be filled.
    void update(const std::shared_ptr<const FillMap>& fill, const MapInput& input, MapCache& cache, bool may_wait);

    /// Null: there is none under this light.
    const std::shared_ptr<SharedMap>& shown() const { return shown_; }
    /// Whether the full map of the last input is not shown yet.
    bool is_filling() const { return wanted_ && !(shown_ == wanted_ && shown_->shown == MapDetail::Full); }

 private:
    std::shared_ptr<SharedMap> wanted_;
    std::shared_ptr<SharedMap> shown_;
};

}  // namespace rowland::diffraction
