#include <imgui.h>

#include <string>

#include "content/demo/hud/panel.h"
#include "engine/core/error.h"
#include "engine/core/log.h"

namespace rowland::demo {

namespace {

void view_choice(const Panel& panel) {
    if (!ImGui::BeginCombo("view", panel.session.view().c_str())) return;
    for (const std::string& view : panel.session.views()) {
        if (!ImGui::Selectable(view.c_str(), view == panel.session.view())) continue;
        try {
            panel.session.use_view(view);
        } catch (const Error& error) {
            log_error("{}", error.what());
        }
    }
    ImGui::EndCombo();
}

void share_slider(const char* label, float& share, float most) {
    ImGui::SameLine(ImGui::GetFontSize() * 7.5F);
    ImGui::SetNextItemWidth(-1.0F);
    ImGui::SliderFloat(label, &share, 0.0F, most, "%.2f", ImGuiSliderFlags_AlwaysClamp);
}

}  // namespace

void picture_panel(const Panel& panel) {
    constexpr float kMostStops = 12.0F;
    post::PostSettings& post = panel.session.picture().post_settings();
    ImGui::SliderFloat("exposure", &post.exposure_stops, -kMostStops, kMostStops, "%+.2f stops");
    action_check_box(panel, Action::AutoExposure, "automatic", post.auto_exposure.has_value());
    ImGui::SameLine();
    ImGui::TextDisabled("%+.2f stops in all", static_cast<double>(panel.session.picture().exposure_stops()));
    action_check_box(panel, Action::Bloom, "blur", post.bloom.has_value());
    if (post.bloom) share_slider("##bloom", post.bloom->strength, 1.0F);
    action_check_box(panel, Action::Vignette, "vignette", post.vignette.has_value());
    if (post.vignette) share_slider("##vignette", post.vignette->strength, 1.0F);
    action_check_box(panel, Action::Dither, "dither", post.dither.has_value());
    view_choice(panel);
}

}  // namespace rowland::demo
