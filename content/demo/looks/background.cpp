#include "content/demo/looks/background.h"

#include <tbb/task_arena.h>

#include <algorithm>

namespace rowland::demo {

Background::Background() : thread_([this] { work(); }) {}

Background::~Background() {
    {
        const std::lock_guard lock(mutex_);
        ending_ = true;
        jobs_.clear();
    }
    changed_.notify_all();
    thread_.join();
}

void Background::add(std::function<void()> job) {
    {
        const std::lock_guard lock(mutex_);
        jobs_.push_back(std::move(job));
    }
    changed_.notify_one();
}

void Background::work() {
    tbb::task_arena half(std::max(1, static_cast<int>(std::thread::hardware_concurrency() / 2)));
    for (;;) {
        std::function<void()> job;
        {
            std::unique_lock lock(mutex_);
            changed_.wait(lock, [this] { return ending_ || !jobs_.empty(); });
            if (ending_) return;
            job = std::move(jobs_.front());
            jobs_.pop_front();
        }
        half.execute(job);
    }
}

}  // namespace rowland::demo
