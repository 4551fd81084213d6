#pragma once

#include <glm/vec2.hpp>
#include <optional>

#include "engine/gpu/pipeline_state.h"
#include "engine/render/draw_list.h"

namespace rowland::render {

/// The fixed-function state that draws a surface into a target of this size; none if no pixel may change.
std::optional<gpu::PipelineState> state_of(const Draw& draw, glm::ivec2 size);

}  // namespace rowland::render
