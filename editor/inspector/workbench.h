#pragma once

#include <imgui.h>

#include <functional>
#include <glm/vec2.hpp>
#include <string>

#include "editor/inspector/control_map.h"
#include "editor/inspector/layout.h"
#include "editor/inspector/material_panel.h"
#include "editor/inspector/physics_panel.h"
#include "editor/inspector/price_panel.h"
#include "editor/inspector/session.h"
#include "engine/platform/input.h"
#include "engine/scene/orbit_camera.h"

namespace rowland::inspector {

/// Size and pace of a frame.
struct WorkbenchFrame {
    glm::vec2 size{0.0F};       ///< screen coordinates
    float pixels_per_unit = 1;  ///< of the framebuffer
    float seconds = 0.0F;       ///< since the last frame
    double frame_ms = 0.0;      ///< median
};

/// The inspector's window: a menu, the fields on the left, the preview with its price below, the physics on the right.
/// Call between Ui::begin_frame() and Ui::draw().
class Workbench {
 public:
    Workbench(const post::OcioConfig& config, Session& session, Layout& layout, ControlMap& controls);

    void draw(const platform::InputState& input, bool keys_are_ours, const WorkbenchFrame& frame);

    /// The user wants to leave: asks first if edits would be lost.
    void ask_to_close();
    bool closed() const { return closed_; }

 private:
    enum class Dialog { None, Open, SaveAs, Discard };

    void shortcuts(const platform::InputState& input);
    void draw_menu();
    void draw_tiles(const platform::InputState& input, const WorkbenchFrame& frame);
    void draw_preview(const platform::InputState& input, const WorkbenchFrame& frame);
    void draw_tools();
    void draw_picture(const ImVec2& corner, const ImVec2& size) const;
    void use_mouse(const platform::InputState& input, const ImVec2& corner, const ImVec2& size);
    void draw_status(float top, float width, float height, double frame_ms);
    void draw_dialogs();
    void draw_path_dialog(const char* title, const char* button);
    void draw_discard_dialog();
    void splitter(const char* name, float x, float y, float width, float height, float& value, float sign);
    void save();
    /// Runs what would lose edits, after asking.
    void unless_lost(std::function<void()> action);

    Session& session_;
    Layout& layout_;
    ControlMap& controls_;
    MaterialPanel material_;
    PhysicsPanel physics_;
    PricePanel price_;
    scene::OrbitCamera camera_;
    bool comparing_ = false;
    float wipe_ = 0.5F;  ///< share of the picture, from the left, that is as saved
    bool moving_wipe_ = false;
    bool orbiting_ = false;
    bool closed_ = false;
    Dialog dialog_ = Dialog::None;
    bool open_dialog_ = false;
    std::string typed_path_;
    std::function<void()> after_discard_;
};

}  // namespace rowland::inspector
