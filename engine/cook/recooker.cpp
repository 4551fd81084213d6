#include "engine/cook/recooker.h"

#include <exception>
#include <utility>

#include "engine/cook/cook_source.h"
#include "engine/core/log.h"

namespace rowland::cook {

namespace {

using FileClock = std::filesystem::file_time_type::clock;

}  // namespace

Recooker::Recooker(const Registry& registry, std::vector<Job> jobs, std::filesystem::path parts_folder,
                   std::chrono::milliseconds interval)
    : registry_(registry), parts_folder_(std::move(parts_folder)), interval_(interval) {
    for (Job& job : jobs) {
        Watched& watched = watched_.emplace_back();
        watched.watch = asset::FileWatch({job.source});
        watched.job = std::move(job);
        watched.running = std::async(std::launch::async, [this, job = watched.job] { return find_dependencies(job); });
    }
}

void Recooker::poll() {
    for (Watched& watched : watched_) adopt(watched);
    const auto now = std::chrono::steady_clock::now();
    if (now - last_look_ < interval_) return;
    last_look_ = now;
    for (Watched& watched : watched_) {
        if (watched.running.valid() || !watched.watch.changed()) continue;
        log_info("cooking {}", watched.job.source.string());
        watched.cooking = true;
        watched.running = std::async(
            std::launch::async, [this, job = watched.job, files = watched.watch.files()] { return cook(job, files); });
    }
}

void Recooker::wait() const {
    for (const Watched& watched : watched_)
        if (watched.running.valid()) watched.running.wait();
}

std::vector<std::string> Recooker::failures() const {
    std::vector<std::string> result;
    for (const Watched& watched : watched_)
        if (!watched.failure.empty()) result.push_back(watched.failure);
    return result;
}

void Recooker::adopt(Watched& watched) {
    if (!watched.running.valid() || watched.running.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
        return;
    Result result = watched.running.get();
    watched.watch = std::move(result.watch);
    watched.failure = std::move(result.failure);
    if (watched.cooking && !watched.failure.empty()) log_error("{}", watched.failure);
    watched.cooking = false;
}

Recooker::Result Recooker::cook(const Job& job, std::vector<std::filesystem::path> watched) const {
    const auto started = FileClock::now();
    try {
        const BakedAsset baked =
            cook_source(registry_, job.source, job.output, {.depfile = {}, .parts_folder = parts_folder_});
        return {asset::FileWatch(baked.dependencies, started), {}};
    } catch (const std::exception& error) {
        return {asset::FileWatch(std::move(watched), started), error.what()};
    }
}

Recooker::Result Recooker::find_dependencies(const Job& job) const {
    const auto started = FileClock::now();
    Context context(job.source);
    try {
        registry_.type_of_source(job.source).check(context);
    } catch (const std::exception&) {
        // Only the source is watched then; cooking it reports why it is refused.
    }
    return {asset::FileWatch(context.dependencies(), started), {}};
}

}  // namespace rowland::cook
