#include "engine/render/draw_state.h"

#include <algorithm>
#include <cmath>

namespace rowland::render {

namespace {

gpu::Scissor columns_of(const PictureColumns& columns, glm::ivec2 size) {
    const auto edge = [&](float fraction) {
        return static_cast<int>(std::lround(std::clamp(fraction, 0.0F, 1.0F) * static_cast<float>(size.x)));
    };
    const int begin = edge(columns.begin);
    return {.x = begin, .y = 0, .width = std::max(edge(columns.end) - begin, 0), .height = size.y};
}

gpu::Blend blend_of(SurfaceFeatures features) {
    if ((features & feature::kPassesLight) != 0) return gpu::Blend::Filter;
    return (features & feature::kAlphaBlend) != 0 ? gpu::Blend::Over : gpu::Blend::Off;
}

}  // namespace

std::optional<gpu::PipelineState> state_of(const Draw& draw, glm::ivec2 size) {
    const gpu::Blend blend = blend_of(draw.features);
    gpu::PipelineState state{.depth_write = blend == gpu::Blend::Off,
                             .cull = draw.material->double_sided ? gpu::Cull::None : gpu::Cull::Back,
                             .blend = blend,
                             .front = draw.mirrored ? gpu::FrontFace::Clockwise : gpu::FrontFace::CounterClockwise};
    if (draw.columns != nullptr) {
        state.scissor = columns_of(*draw.columns, size);
        if (state.scissor->width == 0) return std::nullopt;
    }
    return state;
}

}  // namespace rowland::render
