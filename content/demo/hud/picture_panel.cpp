#include <imgui.h>

#include <string>

#include "content/demo/hud/panel.h"

namespace rowland::demo {

namespace {

void view_choice(const Panel& panel) {
    if (!ImGui::BeginCombo("view", panel.session.view().c_str())) return;
    for (const std::string& view : panel.session.views()) {
        if (ImGui::Selectable(view.c_str(), view == panel.session.view())) panel.set(Setting::View, view);
    }
    ImGui::EndCombo();
}

void slider(const Panel& panel, Setting setting, const char* label, float value, const char* format) {
    const SettingKind::Range range = kind_of(setting).range.value();
    if (ImGui::SliderFloat(label, &value, static_cast<float>(range.minimum), static_cast<float>(range.maximum), format,
                           ImGuiSliderFlags_AlwaysClamp))
        panel.set(setting, static_cast<double>(value));
}

void strength_slider(const Panel& panel, Setting setting, const char* label, float strength) {
    ImGui::SameLine(ImGui::GetFontSize() * 7.5F);
    ImGui::SetNextItemWidth(-1.0F);
    slider(panel, setting, label, strength, "%.2f");
}

}  // namespace

void picture_panel(const Panel& panel) {
    const post::PostSettings& post = panel.session.picture().post_settings();
    slider(panel, Setting::Exposure, "exposure", post.exposure_stops, "%+.2f stops");
    action_check_box(panel, Action::AutoExposure, "automatic", post.auto_exposure.has_value());
    ImGui::SameLine();
    ImGui::TextDisabled("%+.2f stops in all", static_cast<double>(panel.session.picture().exposure_stops()));
    action_check_box(panel, Action::Bloom, "blur", post.bloom.has_value());
    if (post.bloom) strength_slider(panel, Setting::Bloom, "##bloom", post.bloom->strength);
    action_check_box(panel, Action::Vignette, "vignette", post.vignette.has_value());
    if (post.vignette) strength_slider(panel, Setting::Vignette, "##vignette", post.vignette->strength);
    action_check_box(panel, Action::Dither, "dither", post.dither.has_value());
    view_choice(panel);
}

}  // namespace rowland::demo
