#pragma once

#include <chrono>
#include <filesystem>
#include <future>
#include <string>
#include <vector>

#include "engine/asset/file_watch.h"
#include "engine/cook/registry.h"

namespace rowland::cook {

/// Cooks sources again, on another thread, when they or the files they name change. A source that is refused leaves the
/// cooked file as it was.
class Recooker {
 public:
    struct Job {
        std::filesystem::path source;
        std::filesystem::path output;
    };

    /// The registry must outlive the Recooker. `parts_folder`: see cook_part().
    Recooker(const Registry& registry, std::vector<Job> jobs, std::filesystem::path parts_folder = {},
             std::chrono::milliseconds interval = std::chrono::milliseconds(50));

    /// Starts cooking what has changed; call it every frame.
    void poll();
    /// Waits for the work that is running; the next poll() takes over its results.
    void wait() const;
    /// Messages of sources that could not be cooked, until they can.
    std::vector<std::string> failures() const;

 private:
    struct Result {
        asset::FileWatch watch;
        std::string failure;
    };
    struct Watched {
        Job job;
        asset::FileWatch watch;
        std::string failure;
        bool cooking = false;  ///< false: only finding the files that the source names
        std::future<Result> running;
    };

    Result cook(const Job& job, std::vector<std::filesystem::path> watched) const;
    Result find_dependencies(const Job& job) const;
    void adopt(Watched& watched);

    const Registry& registry_;
    std::filesystem::path parts_folder_;
    std::vector<Watched> watched_;
    std::chrono::milliseconds interval_;
    std::chrono::steady_clock::time_point last_look_ = {};
};

}  // namespace rowland::cook
