#pragma once

#include <chrono>
#include <functional>
#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "editor/inspector/dialogs.h"
#include "editor/inspector/foil_panel.h"
#include "editor/inspector/layout.h"
#include "editor/inspector/light_boxes.h"
#include "editor/inspector/panels.h"
#include "editor/inspector/session.h"
#include "engine/app/window_loop.h"
#include "engine/platform/input.h"
#include "engine/ui/message_list.h"

namespace rowland::inspector {

/// An action with a menu item, a key, or both.
struct Command {
    std::string menu;    ///< commands of one menu are contiguous; empty: in no menu
    std::string name;    ///< empty: a separator
    std::string keys{};  ///< "Ctrl+Shift+S"; modifiers that are not named must be up
    std::optional<platform::Key> key{};
    std::function<void()> run{};
    bool enabled = true;
    bool checked = false;
    std::string title{};  ///< shown instead of the name; without `run`, a heading
};

struct WorkbenchFrame {
    glm::vec2 size{0.0F};       ///< screen coordinates
    float pixels_per_unit = 1;  ///< of the framebuffer
    float seconds = 0.0F;       ///< since the last frame
    double frame_ms = 0.0;      ///< median
    bool in_window = false;     ///< messages are shown; false for captures
};

/// Sizes of the tiles beside and below the preview, in the unit of `size`.
struct TileSizes {
    float left = 0.0F;
    float right = 0.0F;
    float below = 0.0F;
};
/// The sizes of the layout, reduced where the preview would have too little room in a small window of that size.
/// `font`: the font height.
TileSizes tile_sizes(const Layout& layout, glm::vec2 size, float font);

/// The inspector's window: a menu, the fields on the left, the preview with its price below, the physics on the right.
class Workbench {
 public:
    Workbench(const post::OcioConfig& config, Session& session, Layout& layout, ControlMap& controls)
        : config_(config),
          session_(session),
          layout_(layout),
          controls_(controls),
          physics_(config),
          dialogs_(session, layout) {}

    /// Call it between Ui::begin_frame() and Ui::draw(). `keys_are_ours`: whether shortcuts run; false while a text
    /// field has the keyboard.
    void draw(const platform::InputState& input, bool keys_are_ours, const WorkbenchFrame& frame);

    /// Opens a file; asks first if unsaved edits would be lost.
    void open(const std::filesystem::path& file) { dialogs_.open(file); }
    void offer_recovery(const std::filesystem::path& unsaved) { dialogs_.offer_recovery(unsaved); }
    /// Closes; asks first if unsaved edits would be lost.
    void ask_to_close() {
        dialogs_.ask_unsaved([this] { closed_ = true; });
    }
    bool closed() const { return closed_; }
    /// Whether the user requested a screenshot since the last call.
    bool take_screenshot() { return std::exchange(screenshot_, false); }
    /// Whether the next frame differs without input: a message disappears, or curves are being computed.
    bool due() const {
        const bool moves =
            session_.foil && session_.view.ready() && (session_.foil->moves() || session_.foil->film() != nullptr);
        return messages_.due() || film_.busy() || physics_.busy() || moves;
    }

 private:
    std::vector<Command> commands();
    std::vector<Command> file_commands();
    void ask_artwork();
    void ask_film(FilmSettings settings);
    FoilActions foil_actions();
    void draw_tiles(const platform::InputState& input, const WorkbenchFrame& frame);
    void draw_document_tiles(const platform::InputState& input, const WorkbenchFrame& frame, float height);
    void draw_foil_tiles(const platform::InputState& input, const WorkbenchFrame& frame, float height);
    void draw_status(float top, float width, float height, double frame_ms);
    /// Drags `value`, a size in font heights; `shown`: its present size in screen coordinates; `sign`: 1 if the size
    /// grows to the right, −1 if it grows to the left or upward.
    void splitter(const char* name, const ImVec2& corner, const ImVec2& size, float& value, float shown, float sign);
    void note_facts();

    const post::OcioConfig& config_;
    Session& session_;
    Layout& layout_;
    ControlMap& controls_;
    FoilPanel foil_;
    MaterialPanel material_;
    ScenePanel scene_;
    LightBoxPanel boxes_;
    PhysicsPanel physics_;
    PricePanel price_;
    PreviewPanel preview_;
    FilmPanel film_;
    Dialogs dialogs_;
    ui::MessageList messages_;
    bool focused_ = false;  ///< the first frame gave the focus to the first panel
    bool help_ = false;
    bool screenshot_ = false;
    bool closed_ = false;
};

/// Decides when the window is drawn: while something changes, and shortly afterwards.
class Redraw {
 public:
    using Clock = std::chrono::steady_clock;

    /// The next step of the loop. `changed`: the contents of the window may have changed since the last call;
    /// `working`: background work is not complete.
    app::Next next(bool changed, bool working, Clock::time_point now) {
        if (changed) {
            frames_ = kFrames;
            until_ = now + kAfterwards;
        }
        if (frames_ > 0) --frames_;
        if (frames_ > 0 || now < until_) return app::Next::Frame;
        return working ? app::Next::Watch : app::Next::Wait;
    }

 private:
    /// ImGui places a new window in its second frame, and ui::InputFeed passes a fast drag in three.
    static constexpr int kFrames = 7;
    /// A modal dialog fades in.
    static constexpr std::chrono::milliseconds kAfterwards{250};

    int frames_ = 0;
    Clock::time_point until_{};
};

}  // namespace rowland::inspector
