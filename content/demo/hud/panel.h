#pragma once

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "content/demo/looks/comparison.h"
#include "content/demo/options.h"
#include "content/demo/pixel/pixel_meter.h"
#include "content/demo/play/play_event.h"
#include "content/demo/session.h"

namespace rowland::demo {

/// What the panels show. What they are to change is not done here but called for, so that it is recorded.
struct Panel {
    const Options& options;
    Session& session;
    std::vector<PlayEvent>& called_for;
    bool reference = false;  ///< its still is wanted

    void call_for(Action action) const { called_for.emplace_back(ActionEvent{action}); }
    void set(Setting setting, std::variant<double, std::string> value, std::string object = {}) const {
        called_for.emplace_back(SettingEvent{setting, std::move(value), std::move(object)});
    }
    Comparison& comparison() const { return session.comparison(); }
};

/// A section each, within the window that is being built.
void light_panel(const Panel& panel);
void picture_panel(const Panel& panel);
void simulation_panel(const Panel& panel);
void gratings_panel(const Panel& panel);

/// A control for an action, with its key in the tooltip. A check box returns nothing: the action turns it over.
void action_button(const Panel& panel, Action action, const char* label);
void action_check_box(const Panel& panel, Action action, const char* label, bool on);

}  // namespace rowland::demo
