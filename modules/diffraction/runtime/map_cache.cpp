#include "modules/diffraction/runtime/map_cache.h"

#include <algorithm>
#include <exception>
#include <glm/geometric.hpp>
#include <limits>
#include <system_error>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/log.h"

namespace rowland::diffraction {

namespace {

/// Smaller changes of a map's axes do not show at its resolution.
constexpr double kSameAxis = 1e-5;
/// Slices of a full map that a frame uploads.
constexpr int kSlicesPerFrame = 8;
constexpr int kAllSlices = std::numeric_limits<int>::max();
constexpr std::size_t kSpareTextures = 8;

}  // namespace

bool same_map(const MapInput& a, const MapInput& b) {
    return a.texels == b.texels && glm::distance(a.normal, b.normal) <= kSameAxis &&
           a.grating.has_value() == b.grating.has_value() &&
           (!a.grating || glm::distance(*a.grating, *b.grating) <= kSameAxis);
}

FillQueue::~FillQueue() {
    const std::scoped_lock guard(lock_);
    for (const auto& job : jobs_) job->stop.request_stop();
    if (running_) running_->stop.request_stop();
    thread_.request_stop();
}

std::shared_ptr<FillQueue::Job> FillQueue::add(std::function<FilledMap(const std::stop_token&)> fill) {
    auto job = std::make_shared<Job>();
    job->fill = std::move(fill);
    const std::scoped_lock guard(lock_);
    try {
        if (!thread_.joinable()) thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
    } catch (const std::system_error& error) {
        fail_system("", std::string("no thread can be started to fill maps: ") + error.what(),
                    "allow the program more threads (ulimit -u), or end others");
    }
    jobs_.push_back(job);
    changed_.notify_all();
    return job;
}

bool FillQueue::is_done(const Job& job) const {
    const std::scoped_lock guard(lock_);
    return job.done;
}

void FillQueue::wait(const Job& job, std::optional<std::chrono::nanoseconds> longest) const {
    std::unique_lock guard(lock_);
    const auto done = [&] { return job.done; };
    if (longest)
        changed_.wait_for(guard, *longest, done);
    else
        changed_.wait(guard, done);
}

void FillQueue::run(const std::stop_token& stop) {
    std::unique_lock guard(lock_);
    while (changed_.wait(guard, stop, [&] { return !jobs_.empty(); })) {
        running_ = std::move(jobs_.front());
        jobs_.pop_front();
        if (running_->stop.stop_requested()) continue;
        guard.unlock();
        FilledMap map;
        std::string failure;
        try {
            map = running_->fill(running_->stop.get_token());
        } catch (const std::exception& error) {
            failure = error.what();
        }
        guard.lock();
        running_->map = std::move(map);
        running_->failure = std::move(failure);
        running_->done = true;
        running_.reset();
        changed_.notify_all();
    }
}

void SharedMap::bind(const gpu::Program& program) const {
    for (std::size_t i = 0; i < parts.size(); ++i) parts[i].bind(program, i > 0);
    if (set_uniforms) set_uniforms(program);
}

std::shared_ptr<SharedMap> MapCache::find_or_add(const std::shared_ptr<const FillMap>& fill, const MapInput& input) {
    const auto found =
        std::ranges::find_if(maps_, [&](const auto& map) { return map->fill == fill && same_map(map->input, input); });
    if (found != maps_.end()) return *found;
    if (!input.texels) log_warning("the map of a grating is under a probe without texels: it stays dark");
    auto made = std::make_shared<SharedMap>();
    made->fill = fill;
    made->input = input;
    return maps_.emplace_back(std::move(made));
}

void MapCache::begin(SharedMap& map, MapDetail detail) {
    map.next = detail;
    map.job = queue(detail).add([fill = map.fill, input = map.input, detail](const std::stop_token& stop) mutable {
        if (!input.texels) input.texels = std::make_shared<const lighting::LightSamples>();
        return (*fill)(input, detail, stop);
    });
}

void MapCache::use(SharedMap& map, bool wait) {
    map.last_use = frame_;
    const bool whole = pace_ == MapPace::Whole;
    if (whole ? map.shown == MapDetail::Full : map.shown.has_value()) return;
    if (!map.job) begin(map, whole ? MapDetail::Full : MapDetail::Coarse);
    if (whole) {
        full_.wait(*map.job, std::nullopt);
    } else if (wait && wait_left_ > std::chrono::nanoseconds(0)) {
        const auto begin = std::chrono::steady_clock::now();
        coarse_.wait(*map.job, wait_left_);
        wait_left_ -= std::chrono::steady_clock::now() - begin;
    }
    take(map);
    upload(map, kAllSlices);
}

void MapCache::take(SharedMap& map) {
    if (!map.job || !queue(map.next).is_done(*map.job)) return;
    const std::shared_ptr<FillQueue::Job> job = std::exchange(map.job, nullptr);
    if (!job->failure.empty()) fail_system("", "a map that cannot be filled: " + job->failure);
    map.next_uniforms = std::move(job->map.set_uniforms);
    map.uploads.emplace_back(std::move(job->map.texels), spare_);
    if (job->map.second) map.uploads.emplace_back(std::move(*job->map.second), spare_);
}

void MapCache::upload(SharedMap& map, int slices) {
    if (map.uploads.empty()) return;
    // A coarse map is small.
    if (map.next == MapDetail::Coarse) slices = kAllSlices;
    if (!std::ranges::all_of(map.uploads, [&](GpuMap& part) { return part.upload(slices); })) return;
    map.parts = std::exchange(map.uploads, {});
    map.set_uniforms = std::move(map.next_uniforms);
    map.shown = map.next;
}

void MapCache::begin_frame() {
    wait_left_ = longest_wait_;
    for (const auto& map : maps_) {
        if (map->last_use < frame_ && map->job) std::exchange(map->job, nullptr)->stop.request_stop();
        take(*map);
        upload(*map, kSlicesPerFrame);
        const bool idle = !map->job && map->uploads.empty();
        // Not in the frame that waited for the coarse map: other maps and the driver's compiler need the cores.
        if (idle && map->last_use == frame_ && map->shown == MapDetail::Coarse) begin(*map, MapDetail::Full);
    }
    std::erase_if(maps_, [&](const auto& map) {
        if (map.use_count() > 1 || map->last_use == frame_) return false;
        if (map->shown == MapDetail::Coarse)
            for (GpuMap& part : map->parts) spare_.push_back(std::move(part).texture());
        return true;
    });
    const bool all_full = std::ranges::all_of(maps_, [](const auto& map) { return map->shown == MapDetail::Full; });
    if (all_full) spare_.clear();
    if (spare_.size() > kSpareTextures)
        spare_.erase(spare_.begin(), spare_.end() - static_cast<std::ptrdiff_t>(kSpareTextures));
    ++frame_;
}

void ObjectMap::update(const std::shared_ptr<const FillMap>& fill, const MapInput& input, MapCache& cache,
                       bool may_wait) {
    const bool of_light = wanted_ && wanted_->fill == fill && wanted_->input.texels == input.texels;
    // An object that turns in every frame would never get a map if each frame began another one.
    const bool may_change = !of_light || wanted_->shown || cache.pace() == MapPace::Whole;
    const bool changed = may_change && !(of_light && same_map(wanted_->input, input));
    if (of_light && wanted_->shown) shown_ = wanted_;
    if (shown_ && (shown_->fill != fill || shown_->input.texels != input.texels)) shown_.reset();
    if (changed) wanted_ = cache.find_or_add(fill, input);
    cache.use(*wanted_, may_wait && changed && !shown_);
    if (wanted_->shown) shown_ = wanted_;
}

}  // namespace rowland::diffraction
