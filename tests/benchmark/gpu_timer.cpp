#include "tests/benchmark/gpu_timer.h"

#include <glm/vec4.hpp>

namespace rowland::gpu {

namespace {

GLuint create_query() {
    GLuint name = 0;
    glCreateQueries(GL_TIME_ELAPSED, 1, &name);
    return name;
}

double milliseconds(GLuint64 nanoseconds) {
    return static_cast<double>(nanoseconds) * 1e-6;
}

}  // namespace

void Timer::Release::operator()(GLuint name) const {
    glDeleteQueries(1, &name);
}

Timer::Timer() : query_(create_query()), first_pass_(FramebufferDesc{.colours = {Format::RGBA8}}) {}

void Timer::begin() {
    glBeginQuery(GL_TIME_ELAPSED, query_.get());
    // llvmpipe takes the start time when it rasterises the next pass, and measures near zero if that is the measured
    // pass itself: a clear of one pixel is a separate pass.
    first_pass_.clear(glm::vec4(0.0F));
}

void Timer::end() {
    glEndQuery(GL_TIME_ELAPSED);
}

std::optional<double> Timer::poll() const {
    GLuint available = GL_FALSE;
    glGetQueryObjectuiv(query_.get(), GL_QUERY_RESULT_AVAILABLE, &available);
    if (available == GL_FALSE) return std::nullopt;
    return wait();
}

double Timer::wait() const {
    GLuint64 nanoseconds = 0;
    glGetQueryObjectui64v(query_.get(), GL_QUERY_RESULT, &nanoseconds);
    return milliseconds(nanoseconds);
}

}  // namespace rowland::gpu
