#include <imgui.h>

#include <filesystem>
#include <numbers>
#include <string>

#include "content/demo/assets.h"
#include "content/demo/hud/panel.h"

namespace rowland::demo {

namespace {

void probe_choice(const Panel& panel) {
    const std::filesystem::path& present = panel.session.probe_path();
    if (!ImGui::BeginCombo("probe", present.stem().string().c_str())) return;
    for (const std::filesystem::path& path : probe_paths(panel.options)) {
        if (ImGui::Selectable(path.stem().string().c_str(), path == present))
            panel.set(Setting::Probe, path.stem().string());
    }
    ImGui::EndCombo();
}

}  // namespace

void light_panel(const Panel& panel) {
    Play& play = panel.session.play();
    probe_choice(panel);
    action_button(panel, Action::TurnLightLeft, " < ");
    ImGui::SameLine();
    action_button(panel, Action::TurnLightRight, " > ");
    ImGui::SameLine();
    ImGui::Text("environment at %.0f°", play.environment_turn() * 180.0 / std::numbers::pi);
    action_button(panel, Action::RemoveLight, " - ");
    ImGui::SameLine();
    action_button(panel, Action::AddLight, " + ");
    ImGui::SameLine();
    ImGui::Text("%zu of %zu lights", light_count(play.world()), kMostLights);
    action_check_box(panel, Action::Lamp, "lamp with shadow", panel.session.scene().sun());
}

}  // namespace rowland::demo
