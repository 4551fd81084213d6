#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>

namespace rowland::demo {

/// One thread that does jobs beside the frames, in the order they come. What they do in parallel takes half the cores,
/// so that frames go on.
class Background {
 public:
    Background();
    /// Ends the job at hand and drops the others: their futures are broken.
    ~Background();
    Background(const Background&) = delete;
    Background& operator=(const Background&) = delete;

    /// What the job throws comes out of the future.
    template <typename F>
    auto run(F job) {
        using Result = decltype(job());
        auto task = std::make_shared<std::packaged_task<Result()>>(std::move(job));
        std::future<Result> future = task->get_future();
        add([task] { (*task)(); });
        return future;
    }

 private:
    void add(std::function<void()> job);
    void work();

    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<std::function<void()>> jobs_;
    bool ending_ = false;
    std::thread thread_;
};

template <typename T>
bool is_ready(const std::future<T>& future) {
    return future.valid() && future.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

}  // namespace rowland::demo
