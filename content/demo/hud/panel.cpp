#include "content/demo/hud/panel.h"

#include <imgui.h>

#include <algorithm>
#include <numbers>

#include "content/demo/assets.h"
#include "engine/platform/key.h"

namespace rowland::demo {

namespace {

void key_tooltip(Action action) {
    const ActionKey& row = row_of(action);
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s  (%s)", row.help, platform::name_of(row.key).c_str());
}

void text_choice(const Panel& panel, Setting setting, const char* label, const std::vector<std::string>& names,
                 const std::string& present) {
    if (!ImGui::BeginCombo(label, present.c_str())) return;
    for (const std::string& name : names)
        if (ImGui::Selectable(name.c_str(), name == present)) panel.set(setting, name);
    ImGui::EndCombo();
}

void slider(const Panel& panel, Setting setting, const char* label, float value, const char* format) {
    const SettingKind::Range range = kind_of(setting).range.value();
    if (ImGui::SliderFloat(label, &value, static_cast<float>(range.minimum), static_cast<float>(range.maximum), format,
                           ImGuiSliderFlags_AlwaysClamp))
        panel.set(setting, static_cast<double>(value));
}

/// A check box for an effect and, while it is on, a slider for its strength.
template <typename Effect>
void effect_row(const Panel& panel, Action action, Setting setting, const char* label,
                const std::optional<Effect>& effect) {
    action_check_box(panel, action, label, effect.has_value());
    if (!effect) return;
    ImGui::SameLine(ImGui::GetFontSize() * 7.5F);
    ImGui::SetNextItemWidth(-1.0F);
    slider(panel, setting, (std::string("##") + label).c_str(), effect->strength, "%.2f");
}

}  // namespace

void action_button(const Panel& panel, Action action, const char* label) {
    if (ImGui::Button(label)) panel.act(action);
    key_tooltip(action);
}

void action_check_box(const Panel& panel, Action action, const char* label, bool on) {
    if (ImGui::Checkbox(label, &on)) panel.act(action);
    key_tooltip(action);
}

void light_panel(const Panel& panel) {
    Play& play = panel.session.play();
    std::vector<std::string> probes;
    for (const std::filesystem::path& path : probe_paths(panel.options)) probes.push_back(path.stem().string());
    text_choice(panel, Setting::Probe, "probe", probes, panel.session.probe_path().stem().string());
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

void picture_panel(const Panel& panel) {
    const post::PostSettings& post = panel.session.picture().post_settings();
    slider(panel, Setting::Exposure, "exposure", post.exposure_stops, "%+.2f stops");
    action_check_box(panel, Action::AutoExposure, "automatic", post.auto_exposure.has_value());
    ImGui::SameLine();
    ImGui::TextDisabled("%+.2f stops in all", static_cast<double>(panel.session.picture().exposure_stops()));
    effect_row(panel, Action::Bloom, Setting::Bloom, "blur", post.bloom);
    effect_row(panel, Action::Vignette, Setting::Vignette, "vignette", post.vignette);
    const std::string sheet = panel.session.sheet();
    action_check_box(panel, Action::Glare, (sheet.empty() ? "glare###glare" : "glare: " + sheet + "###glare").c_str(),
                     !sheet.empty());
    action_check_box(panel, Action::Dither, "dither", post.dither.has_value());
    text_choice(panel, Setting::View, "view", panel.session.views(), panel.session.view());
}

void play_panel(const Panel& panel) {
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
