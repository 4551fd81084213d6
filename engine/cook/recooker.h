#pragma once

#include <chrono>
#include <filesystem>
#include <future>
#include <string>
#include <vector>

#include "engine/asset/file_watch.h"
#include "engine/cook/registry.h"

namespace rowland::cook {

/// Cooks sources again, on another thread, when they or the files they name change: what the build does, while a
/// program runs. A source that is refused leaves the cooked file as it was.
class Recooker {
 public:
    struct Job {
        std::filesystem::path source;
        std::filesystem::path output;
    };

    /// The registry must outlive it.
    Recooker(const Registry& registry, std::vector<Job> jobs,
             std::chrono::milliseconds interval = std::chrono::milliseconds(50));

    /// Once a frame: starts cooking what has changed.
    void poll();
    /// Waits for what is being cooked.
    void wait() const;
    /// Why sources could not be cooked, until they can.
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
        bool cooking = false;  ///< or only finding out which files the source names
        std::future<Result> running;
    };

    Result cook(const Job& job, std::vector<std::filesystem::path> watched) const;
    Result find_dependencies(const Job& job) const;
    void adopt(Watched& watched);

    const Registry& registry_;
    std::vector<Watched> watched_;
    std::chrono::milliseconds interval_;
    std::chrono::steady_clock::time_point last_look_ = {};
};

}  // namespace rowland::cook
