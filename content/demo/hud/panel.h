#pragma once

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "content/demo/looks/comparison.h"
#include "content/demo/options.h"
#include "content/demo/pixel/pixel_meter.h"
#include "content/demo/play/action.h"
#include "content/demo/session.h"

namespace rowland::demo {

/// What the panels show. They do not modify the session; they emit events, which are recorded.
struct Panel {
    const Options& options;
    Session& session;
    std::vector<PlayEvent>& events;
    bool reference = false;  ///< the reference is shown right of the wipe's line

    void act(Action action) const { events.emplace_back(ActionEvent{action}); }
    void set(Setting setting, std::variant<double, std::string> value, std::string object = {}) const {
        events.emplace_back(SettingEvent{setting, std::move(value), std::move(object)});
    }
    Comparison& comparison() const { return session.comparison(); }
};

/// Each adds one section to the current ImGui window.
void light_panel(const Panel& panel);
void picture_panel(const Panel& panel);
void play_panel(const Panel& panel);
void gratings_panel(const Panel& panel);

}  // namespace rowland::demo
