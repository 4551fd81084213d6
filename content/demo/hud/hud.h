#pragma once

#include <optional>
#include <string>
#include <vector>

#include "content/demo/hud/windows.h"
#include "content/demo/options.h"
#include "content/demo/pixel/pixel_meter.h"
#include "content/demo/pixel/reference_picture.h"
#include "content/demo/play/action.h"
#include "content/demo/session.h"
#include "engine/platform/frame_pacing.h"
#include "engine/platform/input.h"
#include "engine/ui/message_list.h"
#include "engine/ui/ui.h"

namespace rowland::demo {

/// The overlay of the picture: panels, times, the pixel under the cursor, the line of a wipe, help. It changes the
/// session by events, as keys do, so that recordings contain what panels do.
class Hud {
 public:
    /// Panels are closed at first. A context must be current. `options`, `session` and `frame_times` must outlive it.
    Hud(const Options& options, Session& session, const platform::FrameTimes& frame_times, glm::ivec2 window,
        float scale);

    /// Begins a frame. Returns the events that the HUD does not consume, and its own.
    std::vector<PlayEvent> begin_frame(std::vector<PlayEvent> events, const ui::UiFrame& frame);
    /// Lights the scene with a probe, in the next frame.
    void use_probe(const std::filesystem::path& probe) { panel().set(Setting::Probe, probe.string()); }
    /// Carries out an action of the HUD itself; false if it is another's.
    bool perform(Action action);
    /// Builds all windows from the session's present state.
    void build();
    /// Draws the windows over the picture, in the window's own framebuffer.
    void draw_in_window();

 private:
    /// The grating under the cursor, and where.
    struct Pointed {
        ecs::Entity grating;
        Hit hit;
    };
    std::optional<Pointed> pointed() const;
    glm::dvec2 pointer() const;
    Side side_of_pointer() const;
    Panel panel();
    void choose_look(bool detail);
    void toggle_wipe();
    void show_reference();
    PixelProbe probe() const;
    void measure_pixel();
    void write_pixel();
    void main_window();
    std::string name_of_all(Side side);

    const Options& options_;
    Session& session_;
    const platform::FrameTimes& frame_times_;
    ui::Ui ui_;
    platform::InputState input_;
    glm::ivec2 window_;
    std::vector<PlayEvent> events_;
    PixelMeter meter_;
    ReferencePicture reference_picture_;
    bool reference_ = false;  ///< show the reference right of a wipe's line
    std::optional<PixelTarget> target_;
    ui::MessageList messages_;
    bool wiped_ = false;  ///< the last frame had a wipe
    bool panels_ = false;
    bool hints_ = true;  ///< also before the panels were first opened
    bool help_ = false;
    bool times_ = false;
};

}  // namespace rowland::demo
