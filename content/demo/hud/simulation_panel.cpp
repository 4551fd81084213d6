#include <imgui.h>

#include "content/demo/hud/panel.h"

namespace rowland::demo {

void simulation_panel(const Panel& panel) {
    const Play& play = panel.session.play();
    action_check_box(panel, Action::Pause, "paused", play.paused());
    ImGui::SameLine();
    action_button(panel, Action::OneStep, "step");
    ImGui::SameLine();
    action_button(panel, Action::PutBack, "put back");
    action_check_box(panel, Action::SlowMotion, "slow motion", play.speed() < 1.0);
    ImGui::SameLine();
    ImGui::TextDisabled("%.1f s, %s", play.time_s(), play.walking() ? "walking" : "orbiting");
}

}  // namespace rowland::demo
