#pragma once

#include <engine/cook/registry.h>
#include <engine/render/renderer.h>

namespace metal {

/// Component: a surface that reflects as a metal of complex index n + ik, at red, green and blue (Rec.709).
struct MetalSurface {
    glm::vec3 n{1.0F};
    glm::vec3 k{0.0F};
};

/// Makes cooked scenes keep the glTF extension; it has no tables.
void register_module(rowland::cook::Registry& registry);

/// Makes the renderer draw entities that have a MetalSurface, and read it from glTF files:
///     "extensions": { "EXAMPLE_materials_metal": { "n": [0.18, 0.42, 1.37], "k": [3.42, 2.35, 1.77] } }
void register_module(rowland::render::Renderer& renderer);

}  // namespace metal
