#pragma once

#include <glm/vec2.hpp>
#include <utility>
#include <vector>

#include "editor/inspector/command.h"
#include "editor/inspector/control_map.h"
#include "editor/inspector/dialogs.h"
#include "editor/inspector/film_panel.h"
#include "editor/inspector/layout.h"
#include "editor/inspector/material_panel.h"
#include "editor/inspector/physics_panel.h"
#include "editor/inspector/preview_panel.h"
#include "editor/inspector/price_panel.h"
#include "editor/inspector/scene_panel.h"
#include "editor/inspector/session.h"
#include "engine/platform/input.h"
#include "engine/ui/message_list.h"

namespace rowland::inspector {

struct WorkbenchFrame {
    glm::vec2 size{0.0F};       ///< screen coordinates
    float pixels_per_unit = 1;  ///< of the framebuffer
    float seconds = 0.0F;       ///< since the last frame
    double frame_ms = 0.0;      ///< median
    bool in_window = false;     ///< messages are shown; false for captures
};

/// The inspector's window: a menu, the fields on the left, the preview with its price below, the physics on the right.
/// Call between Ui::begin_frame() and Ui::draw().
class Workbench {
 public:
    Workbench(const post::OcioConfig& config, Session& session, Layout& layout, ControlMap& controls)
        : session_(session), layout_(layout), controls_(controls), physics_(config), dialogs_(session, layout) {}

    void draw(const platform::InputState& input, bool keys_are_ours, const WorkbenchFrame& frame);

    /// Opens a file; asks first if edits would be lost.
    void open(const std::filesystem::path& file) { dialogs_.open(file); }
    /// Closes; asks first if edits would be lost.
    void ask_to_close() {
        dialogs_.unless_lost([this] { closed_ = true; });
    }
    bool closed() const { return closed_; }
    /// Whether the user asked for a screenshot since the last call.
    bool take_screenshot() { return std::exchange(screenshot_, false); }
    /// Whether a message disappears with the next frame, or the film's curves may change.
    bool due() const { return messages_.due() || film_.busy(); }

 private:
    std::vector<Command> commands();
    void draw_tiles(const platform::InputState& input, const WorkbenchFrame& frame);
    void draw_status(float top, float width, float height, double frame_ms);
    void splitter(const char* name, const ImVec2& corner, const ImVec2& size, float& value, float sign);
    void note_facts();

    Session& session_;
    Layout& layout_;
    ControlMap& controls_;
    MaterialPanel material_;
    ScenePanel scene_;
    PhysicsPanel physics_;
    PricePanel price_;
    PreviewPanel preview_;
    FilmPanel film_;
    Dialogs dialogs_;
    ui::MessageList messages_;
    bool begun_ = false;  ///< a frame was drawn
    bool help_ = false;
    bool screenshot_ = false;
    bool closed_ = false;
};

}  // namespace rowland::inspector
