#pragma once

#include <imgui.h>

#include <cstddef>
#include <glm/mat4x4.hpp>
#include <optional>
#include <string>
#include <vector>

#include "editor/inspector/document.h"
#include "editor/inspector/preview.h"
#include "editor/inspector/preview_object.h"
#include "editor/inspector/widgets.h"

namespace rowland::inspector {

/// A box around the scene, upright, whose probe has a file name of its own.
scene::ExtendedNode new_light_box(const Document& document, const SceneObject& scene);

/// From the unit cube around the origin to the box in the scene.
glm::mat4 box_to_scene(const scene::ExtendedNode& box, const SceneObject& scene);

/// The boxes of a scene with a light probe of their own: their list, and the fields of the chosen one.
class LightBoxPanel {
 public:
    /// Into the current ImGui window.
    void draw(Document& document, const SceneObject& scene, ControlMap& controls);
    /// Draws the boxes' edges over the picture in that rectangle, while their list is open.
    void draw_edges(const Document& document, const SceneObject& scene, const Preview& preview, const ImVec2& corner,
                    const ImVec2& size) const;

 private:
    void draw_list(Document& document, const SceneObject& scene, ControlMap& controls);
    void draw_fields(Document& document, ControlMap& controls);
    void draw_probe(Document& document, ControlMap& controls);

    bool open_ = false;  ///< in the last frame
    std::size_t chosen_ = 0;
    std::optional<std::string> typed_;  ///< name of the probe's file
    std::string typed_over_;            ///< the name that it replaces
    std::string refusal_;               ///< of typed_
};

}  // namespace rowland::inspector
