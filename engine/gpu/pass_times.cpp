#include "engine/gpu/pass_times.h"

#include <algorithm>

#include "engine/gpu/context.h"

namespace rowland::gpu {

namespace {

using Clock = std::chrono::steady_clock;

/// Adds to the total of that name; appends it if there is none.
template <typename Total>
void add(std::vector<Total>& totals, const std::string& name, double ms) {
    const auto found =
        std::find_if(totals.begin(), totals.end(), [&](const Total& total) { return total.name == name; });
    if (found == totals.end()) {
        totals.push_back({name, ms});
    } else {
        found->ms += ms;
    }
}

template <typename Total>
std::vector<Total> sums(const std::vector<Total>& runs) {
    std::vector<Total> totals;
    for (const Total& run : runs) add(totals, run.name, run.ms);
    return totals;
}

GLuint64 nanoseconds(GLuint query) {
    GLuint64 time = 0;
    glGetQueryObjectui64v(query, GL_QUERY_RESULT, &time);
    return time;
}

}  // namespace

void PassTimes::Release::operator()(GLuint name) const {
    glDeleteQueries(1, &name);
}

PassTimes::PassTimes() : slot_(0), software_(renders_in_software()) {}

void PassTimes::write_time(std::size_t query) {
    std::vector<Handle<Release>>& queries = ring_[*slot_].queries;
    while (queries.size() <= query) {
        GLuint name = 0;
        glCreateQueries(GL_TIMESTAMP, 1, &name);
        queries.emplace_back(name);
    }
    glQueryCounter(queries[query].get(), GL_TIMESTAMP);
}

PassTimes::Scope::Scope(PassTimes* times, std::string_view name) : times_(times) {
    if (times_ == nullptr) return;
    run_ = times_->runs_.size();
    times_->runs_.push_back({std::string(name), 0.0});
    if (times_->slot_) {
        times_->write_time(2 * run_);
        // llvmpipe writes the time when it has rasterised the draws queued so far.
        if (times_->software_) glFlush();
    }
    start_ = Clock::now();
}

PassTimes::Scope::~Scope() {
    if (times_ == nullptr) return;
    times_->runs_[run_].ms = std::chrono::duration<double, std::milli>(Clock::now() - start_).count();
    if (times_->slot_) times_->write_time(2 * run_ + 1);
}

bool PassTimes::is_finished(const QueuedFrame& frame) {
    for (std::size_t i = 0; i < frame.passes.size(); ++i) {
        GLuint available = GL_FALSE;
        glGetQueryObjectuiv(frame.queries[2 * i + 1].get(), GL_QUERY_RESULT_AVAILABLE, &available);
        if (available == GL_FALSE) return false;
    }
    return true;
}

std::vector<PassTimes::Total> PassTimes::gpu_totals(const QueuedFrame& frame) {
    std::vector<Total> totals;
    for (std::size_t i = 0; i < frame.passes.size(); ++i) {
        const GLuint64 start = nanoseconds(frame.queries[2 * i].get());
        const GLuint64 end = nanoseconds(frame.queries[2 * i + 1].get());
        add(totals, frame.passes[i], end > start ? static_cast<double>(end - start) * 1e-6 : 0.0);
    }
    return totals;
}

void PassTimes::collect_finished() {
    for (std::size_t i = 0; i < ring_.size(); ++i) {
        QueuedFrame& frame = ring_[(oldest_ + i) % ring_.size()];
        if (!frame.pending) continue;
        if (!is_finished(frame)) return;  // nor are later ones
        finished_gpu_ = gpu_totals(frame);
        frame.pending = false;
    }
}

void PassTimes::begin_frame() {
    if (!runs_.empty()) {
        last_cpu_ = sums(runs_);
        if (slot_) {
            QueuedFrame& frame = ring_[*slot_];
            frame.passes.clear();
            for (const Total& run : runs_) frame.passes.push_back(run.name);
            frame.pending = true;
            oldest_ = (*slot_ + 1) % ring_.size();
        }
        runs_.clear();
    }
    collect_finished();
    slot_.reset();
    if (!ring_[oldest_].pending) slot_ = oldest_;
}

std::vector<PassTime> PassTimes::latest() const {
    std::vector<PassTime> result;
    for (const Total& total : runs_.empty() ? last_cpu_ : sums(runs_))
        result.push_back({.name = total.name, .cpu_ms = total.ms, .gpu_ms = {}});
    for (PassTime& pass : result)
        for (const Total& total : finished_gpu_)
            if (total.name == pass.name) pass.gpu_ms = total.ms;
    return result;
}

}  // namespace rowland::gpu
