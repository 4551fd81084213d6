#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "content/demo/hud/windows.h"
#include "content/demo/options.h"
#include "content/demo/pixel/pixel_meter.h"
#include "content/demo/pixel/reference_still.h"
#include "content/demo/play/play_event.h"
#include "content/demo/session.h"
#include "engine/platform/input.h"
#include "engine/ui/ui.h"

namespace rowland::demo {

/// What lies over the picture: panels, times, the pixel under the cursor, the line of a wipe, help. It changes the
/// session as keys do, by calling for actions, so that what a panel does is recorded, too.
class Hud {
 public:
    /// Panels are open from the start in windows that have room for them. A context must be current.
    Hud(const Options& options, Session& session, glm::ivec2 window, float scale);

    /// A frame begins: takes what happened, and hands back what is not for the HUD, with what it called for itself.
    std::vector<PlayEvent> begin_frame(std::vector<PlayEvent> events, const ui::UiFrame& frame);
    /// Carries out an action that is the HUD's own; false if it is not.
    bool perform(Action action);
    /// All windows, as the session stands now.
    void build();
    /// Over the picture, in the window's own framebuffer.
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
    void toggle_reference();
    void show_reference();
    PixelProbe probe() const;
    void measure_pixel();
    void write_pixel();
    void main_window();
    std::string name_of_all(Side side);

    const Options& options_;
    Session& session_;
    ui::Ui ui_;
    platform::InputState input_;
    glm::ivec2 window_;
    std::vector<PlayEvent> called_for_;
    std::deque<float> frame_ms_;
    PixelMeter meter_;
    ReferenceStill still_;
    bool reference_ = false;  ///< right of a wipe's line
    std::optional<PixelTarget> target_;
    int pixels_written_ = 0;
    bool panels_;
    bool help_ = false;
    bool times_ = false;
};

}  // namespace rowland::demo
