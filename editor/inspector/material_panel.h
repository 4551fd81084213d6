#pragma once

#include <map>
#include <string>

#include "editor/inspector/control_map.h"
#include "editor/inspector/document.h"

namespace rowland::inspector {

/// The fields of the material, each with its unit, tooltip and reset button. A refusal is shown below its field.
class MaterialPanel {
 public:
    /// Into the current ImGui window.
    void draw(Document& document, ControlMap& controls);

 private:
    void draw_field(Document& document, const Field& field, ControlMap& controls);
    void draw_control(Document& document, const Field& field, ControlMap& controls);
    void draw_text(Document& document, const Field& field);

    std::map<std::string, std::string> texts_;  ///< being typed, by the field's pointer
};

}  // namespace rowland::inspector
