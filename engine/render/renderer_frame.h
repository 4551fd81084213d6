#pragma once

#include <cstddef>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <vector>

#include "engine/render/draw_list.h"
#include "engine/render/renderer.h"
#include "engine/render/scene_lights.h"
#include "engine/scene/camera.h"

namespace rowland::render {

/// The state of one call of render().
struct Renderer::Frame {
    const scene::Camera* camera = nullptr;
    glm::ivec2 size{1};
    float aspect = 1.0F;
    bool into_halves = false;  ///< the target holds half floats
    Shading shading = Shading::Full;
    bool occlusion = false;
    glm::mat4 view_projection{1.0F};
    DrawList list;
    std::vector<Draw*> used;  ///< those that need an ObjectBlock
    std::vector<const Draw*> opaque;
    std::vector<const Draw*> blended;
    std::vector<const Draw*> casters;
    ShadowView shadow;
    std::size_t light_offset = 0;   ///< of the LightBlock in frame_data_, bytes
    std::size_t joints_offset = 0;  ///< of the joint matrices
    float farthest = 0.0F;          ///< extent of the drawn entities along the camera's axis
};

}  // namespace rowland::render
