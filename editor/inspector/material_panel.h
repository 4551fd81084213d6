#pragma once

#include <map>
#include <string>

#include "editor/inspector/control_map.h"
#include "editor/inspector/document.h"

namespace rowland::inspector {

/// The fields of the material, each with its unit, tooltip and way back; what is refused says so below its field.
class MaterialPanel {
 public:
    /// Into the present ImGui window.
    void draw(Document& document, ControlMap& controls);

 private:
    void draw_field(Document& document, const Field& field, ControlMap& controls);
    void draw_number(Document& document, const Field& field);
    void draw_count(Document& document, const Field& field);
    void draw_choice(Document& document, const Field& field, ControlMap& controls);
    void draw_text(Document& document, const Field& field);
    void draw_lines_per_mm(Document& document, ControlMap& controls);

    std::map<std::string, std::string> texts_;  ///< being typed, by the field's pointer
};

}  // namespace rowland::inspector
