#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "content/demo/hud/windows.h"
#include "engine/platform/key.h"

namespace rowland::demo {

namespace {

/// Roughly what a display shows, with `white` as white.
ImVec4 swatch(const glm::dvec3& rgb, double white) {
    const auto encoded = [white](double linear) {
        return static_cast<float>(std::pow(std::clamp(linear / white, 0.0, 1.0), 1.0 / 2.2));
    };
    return {encoded(rgb.r), encoded(rgb.g), encoded(rgb.b), 1.0F};
}

void colour_row(const char* name, const glm::dvec3& xyz, const glm::dvec3& rgb, double white) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    const float side = ImGui::GetTextLineHeight();
    ImGui::ColorButton(name, swatch(rgb, white), ImGuiColorEditFlags_NoTooltip | ImGuiColorEditFlags_NoDragDrop,
                       {side, side});
    ImGui::SameLine();
    ImGui::TextUnformatted(name);
    ImGui::TableNextColumn();
    ImGui::Text("%.4g  %.4g  %.4g", xyz.x, xyz.y, xyz.z);
    ImGui::TableNextColumn();
    ImGui::Text("%.4g  %.4g  %.4g", rgb.r, rgb.g, rgb.b);
}

void reading_table(const PixelReading& reading, const glm::dmat3& xyz_to_working) {
    const glm::dvec3 shown = xyz_to_working * reading.point.shown;
    const glm::dvec3 reference = xyz_to_working * reading.point.reference;
    const double white = std::max({shown.r, shown.g, shown.b, reference.r, reference.g, reference.b, 1e-9});
    ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, {0.5F * ImGui::GetFontSize(), 2.0F});
    if (ImGui::BeginTable("colours", 3, ImGuiTableFlags_SizingFixedFit)) {
        ImGui::TableSetupColumn("");
        ImGui::TableSetupColumn("X  Y  Z");
        ImGui::TableSetupColumn("working R  G  B");
        ImGui::TableHeadersRow();
        colour_row("shown", reading.point.shown, shown, white);
        colour_row("reference", reading.point.reference, reference, white);
        ImGui::EndTable();
    }
    ImGui::PopStyleVar();
    ImGui::Text("error %.3g %%", 100.0 * reading.point.error);
}

}  // namespace

bool pixel_window(const PixelTarget* target, const PixelMeter& meter, const glm::dmat3& xyz_to_working) {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({size.x - 10.0F, size.y - 10.0F}, ImGuiCond_Always, {1.0F, 1.0F});
    const ImGuiWindowFlags flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                   ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings |
                                   ImGuiWindowFlags_NoFocusOnAppearing;
    bool write = false;
    if (ImGui::Begin("Pixel", nullptr, flags)) {
        ImGui::Dummy({24.0F * ImGui::GetFontSize(), 0.0F});
        if (target == nullptr) {
            ImGui::TextDisabled("point at a grating to measure its pixel");
        } else {
            ImGui::Text("%s, %s", target->object.c_str(), target->look.c_str());
            ImGui::SameLine();
            ImGui::TextDisabled(meter.current() ? "under the probe" : "measuring…");
            const std::string& refusal = target->refusal.empty() ? meter.failure() : target->refusal;
            if (!refusal.empty()) {
                ImGui::PushTextWrapPos(24.0F * ImGui::GetFontSize());
                ImGui::TextUnformatted(refusal.c_str());
                ImGui::PopTextWrapPos();
            } else if (meter.reading()) {
                reading_table(*meter.reading(), xyz_to_working);
                ImGui::SameLine();
                const std::string key(platform::name_of(row_of(Action::WritePixel).key));
                write = ImGui::SmallButton(("write (" + key + ")").c_str());
            }
        }
    }
    ImGui::End();
    return write;
}

}  // namespace rowland::demo
