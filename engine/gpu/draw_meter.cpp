#include "engine/gpu/draw_meter.h"

#include <utility>

#include "engine/gpu/context.h"

namespace rowland::gpu {

void DrawMeter::Release::operator()(GLuint name) const {
    glDeleteQueries(1, &name);
}

GLuint DrawMeter::Queries::at(std::size_t index) {
    while (names_.size() <= index) {
        GLuint name = 0;
        glCreateQueries(target_, 1, &name);
        names_.emplace_back(name);
    }
    return names_[index].get();
}

DrawMeter::DrawMeter() : software_(renders_in_software()) {}

void DrawMeter::write_time(std::size_t query) {
    glQueryCounter(frame_->times.at(query), GL_TIMESTAMP);
    // llvmpipe writes the time when it has rasterised the draws queued so far.
    if (software_) glFlush();
}

DrawMeter::Scope::Scope(DrawMeter* meter, std::uint64_t kind, std::uint64_t object)
    : meter_(meter != nullptr && meter->frame_ != nullptr ? meter : nullptr) {
    if (meter_ == nullptr) return;
    QueuedFrame& frame = *meter_->frame_;
    if (meter_->in_run_ && frame.runs.back().kind != kind) meter_->end_run();
    if (!std::exchange(meter_->in_run_, true)) {
        meter_->write_time(2 * frame.runs.size());
        frame.runs.push_back({.kind = kind, .draws = {}});
    }
    frame.runs.back().draws.push_back({.object = object});
    glBeginQuery(GL_SAMPLES_PASSED, frame.samples.at(frame.draws++));
}

DrawMeter::Scope::~Scope() {
    if (meter_ != nullptr) glEndQuery(GL_SAMPLES_PASSED);
}

void DrawMeter::end_run() {
    if (std::exchange(in_run_, false)) write_time(2 * frame_->runs.size() - 1);
}

/// Reads the results of a frame; returns false if the GPU has not finished it.
bool DrawMeter::read(QueuedFrame& frame) const {
    if (frame.runs.empty()) return true;
    // The last query is the last to be answered.
    GLuint available = GL_FALSE;
    glGetQueryObjectuiv(frame.times.at(2 * frame.runs.size() - 1), GL_QUERY_RESULT_AVAILABLE, &available);
    if (available == GL_FALSE) return false;
    const auto result = [](GLuint query) {
        GLuint64 value = 0;
        glGetQueryObjectui64v(query, GL_QUERY_RESULT, &value);
        return value;
    };
    std::size_t query = 0;
    for (std::size_t i = 0; i < frame.runs.size(); ++i) {
        const GLuint64 start = result(frame.times.at(2 * i));
        const GLuint64 end = result(frame.times.at(2 * i + 1));
        frame.runs[i].gpu_ms = end > start ? static_cast<double>(end - start) * 1e-6 : 0.0;
        for (MeteredRun::Draw& draw : frame.runs[i].draws) draw.samples = result(frame.samples.at(query++));
    }
    return true;
}

void DrawMeter::begin_frame() {
    end_run();
    if (frame_ != nullptr) frame_->pending = true;
    for (std::size_t i = 0; i < ring_.size(); ++i) {  // from the oldest on
        QueuedFrame& frame = ring_[(next_ + i) % ring_.size()];
        if (!frame.pending) continue;
        if (!read(frame)) break;
        frame.pending = false;
        finished_ = std::move(frame.runs);
    }
    frame_ = nullptr;
    if (ring_[next_].pending) return;
    frame_ = &ring_[next_];
    frame_->runs.clear();
    frame_->draws = 0;
    next_ = (next_ + 1) % ring_.size();
}

std::optional<std::vector<MeteredRun>> DrawMeter::take_finished() {
    return std::exchange(finished_, std::nullopt);
}

}  // namespace rowland::gpu
