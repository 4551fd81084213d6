#include "content/demo/hud/windows.h"

#include <fmt/format.h>
#include <imgui.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "content/demo/play/action.h"
#include "engine/platform/input.h"

namespace rowland::demo {

namespace {

void graph(const platform::FrameTimes& times) {
    const std::vector<float> ms = times.in_order_ms();
    if (ms.empty()) return;
    const platform::FrameStatistics all = times.statistics();
    ImGui::Text("%.1f ms, median %.1f, longest %.1f", ms.back(), all.median_ms, all.maximum_ms);
    ImGui::PlotLines("##frames", ms.data(), static_cast<int>(ms.size()), 0, nullptr, 0.0F,
                     1.1F * static_cast<float>(all.maximum_ms),
                     {ImGui::GetContentRegionAvail().x, 4.0F * ImGui::GetFontSize()});
}

void pass_row(const std::string& name, double cpu_ms, std::optional<double> gpu_ms) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(name.c_str());
    ImGui::TableNextColumn();
    ImGui::Text("%7.2f", cpu_ms);
    ImGui::TableNextColumn();
    if (gpu_ms)
        ImGui::Text("%7.2f", *gpu_ms);
    else
        ImGui::TextDisabled("      -");
}

void pass_table(const std::vector<gpu::PassTime>& passes) {
    if (!ImGui::BeginTable("passes", 3, ImGuiTableFlags_RowBg)) return;
    ImGui::TableSetupColumn("pass");
    ImGui::TableSetupColumn("CPU ms");
    ImGui::TableSetupColumn("GPU ms");
    ImGui::TableHeadersRow();
    double cpu_ms = 0.0;
    std::optional<double> gpu_ms;
    for (const gpu::PassTime& pass : passes) {
        pass_row(pass.name, pass.cpu_ms, pass.gpu_ms);
        cpu_ms += pass.cpu_ms;
        if (pass.gpu_ms) gpu_ms = gpu_ms.value_or(0.0) + *pass.gpu_ms;
    }
    pass_row("total", cpu_ms, gpu_ms);
    ImGui::EndTable();
}

/// Approximate display colour of linear `rgb`; `white` maps to 1.
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

constexpr float kGrabWidth = 14.0F;
constexpr float kHandleRadius = 9.0F;

/// A label whose left edge, or right edge if `to_the_left`, is at `x`.
void draw_label(ImDrawList* list, float x, float y, const std::string& text, bool to_the_left) {
    const ImVec2 extent = ImGui::CalcTextSize(text.c_str());
    const float left = to_the_left ? x - extent.x - 12.0F : x;
    list->AddRectFilled({left, y}, {left + extent.x + 12.0F, y + extent.y + 6.0F},
                        ImGui::GetColorU32(ImGuiCol_WindowBg), 4.0F);
    list->AddText({left + 6.0F, y + 3.0F}, ImGui::GetColorU32(ImGuiCol_Text), text.c_str());
}

}  // namespace

std::string format_bytes(std::size_t bytes) {
    constexpr std::array kUnits = {"B", "KiB", "MiB", "GiB", "TiB"};
    auto value = static_cast<double>(bytes);
    std::size_t unit = 0;
    while (value >= 1000.0 && unit + 1 < kUnits.size()) {
        value /= 1024.0;
        ++unit;
    }
    return unit == 0 || value >= 10.0 ? fmt::format("{:.0f} {}", value, kUnits[unit])
                                      : fmt::format("{:.1f} {}", value, kUnits[unit]);
}

void frame_window(const platform::FrameTimes& times, const std::vector<gpu::PassTime>& passes, bool& open) {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({size.x - 10.0F, 10.0F}, ImGuiCond_Always, {1.0F, 0.0F});
    if (ImGui::Begin("Frames", &open, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove)) {
        ImGui::Dummy({18.0F * ImGui::GetFontSize(), 0.0F});
        graph(times);
        pass_table(passes);
    }
    ImGui::End();
}

void help_window(bool& open) {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const float width = std::min(34.0F * ImGui::GetFontSize(), size.x - 20.0F);
    ImGui::SetNextWindowPos({size.x - 10.0F, 10.0F}, ImGuiCond_Always, {1.0F, 0.0F});
    ImGui::SetNextWindowSize({width, size.y - 20.0F});
    ImGui::SetNextWindowBgAlpha(0.96F);
    if (ImGui::Begin("Controls", &open, ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove) &&
        ImGui::BeginTable("controls", 2, ImGuiTableFlags_RowBg)) {
        ImGui::TableSetupColumn("control", ImGuiTableColumnFlags_WidthFixed, 12.5F * ImGui::GetFontSize());
        ImGui::TableSetupColumn("what");
        std::string group;
        for (const HelpLine& line : help_lines()) {
            if (group != line.group) {
                ImGui::TableNextRow();
                ImGui::TableNextColumn();
                ImGui::TextDisabled("%s", (group = line.group).c_str());
            }
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(line.control.c_str());
            ImGui::TableNextColumn();
            ImGui::TextWrapped("%s", line.what.c_str());
        }
        ImGui::EndTable();
    }
    ImGui::End();
}

void key_hints() {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const auto key = [](Action action) { return std::string(platform::name_of(key_row(action).key)); };
    const std::string text = key(Action::Help) + " controls    " + key(Action::Hud) + " panels    " +
                             key(Action::FrameGraph) + " times    " + key(Action::Wipe) + " wipe    " +
                             key(Action::Close) + " quit";
    const ImVec2 extent = ImGui::CalcTextSize(text.c_str());
    ImDrawList* list = ImGui::GetBackgroundDrawList();
    const ImVec2 at(20.0F, size.y - extent.y - 14.0F);
    list->AddRectFilled({at.x - 10.0F, at.y - 4.0F}, {at.x + extent.x + 10.0F, at.y + extent.y + 4.0F},
                        ImGui::GetColorU32(ImGuiCol_WindowBg), 5.0F);
    list->AddText(at, ImGui::GetColorU32(ImGuiCol_TextDisabled), text.c_str());
}

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
            ImGui::Text("%s, %s", target->object.c_str(), target->representation.c_str());
            ImGui::SameLine();
            ImGui::TextDisabled(meter.is_up_to_date() ? "under the probe" : "measuring…");
            const std::string& problem = target->refusal.empty() ? meter.failure() : target->refusal;
            if (!problem.empty()) {
                ImGui::PushTextWrapPos(24.0F * ImGui::GetFontSize());
                ImGui::TextUnformatted(problem.c_str());
                ImGui::PopTextWrapPos();
            } else if (meter.reading()) {
                reading_table(*meter.reading(), xyz_to_working);
                ImGui::SameLine();
                const std::string key(platform::name_of(key_row(Action::WritePixel).key));
                write = ImGui::SmallButton(("write (" + key + ")").c_str());
            }
        }
    }
    ImGui::End();
    return write;
}

std::optional<double> wipe_handle(float line, const std::string& left, const std::string& right) {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const float x = line * size.x;
    ImGui::SetNextWindowPos({x - 0.5F * kGrabWidth, 0.0F});
    ImGui::SetNextWindowSize({kGrabWidth, size.y});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.0F, 0.0F});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1.0F, 1.0F});
    ImGui::Begin("##wipe", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoBackground |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing |
                     ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoNav);
    ImGui::InvisibleButton("line", {kGrabWidth, size.y});
    const bool held = ImGui::IsItemActive();
    std::optional<double> moved;
    if (held && size.x > 0.0F) moved = std::clamp(static_cast<double>(ImGui::GetIO().MousePos.x / size.x), 0.0, 1.0);
    const bool hot = held || ImGui::IsItemHovered();
    ImGui::End();
    ImGui::PopStyleVar(2);

    ImDrawList* list = ImGui::GetBackgroundDrawList();
    const ImU32 colour = ImGui::GetColorU32(hot ? ImGuiCol_SliderGrabActive : ImGuiCol_Text);
    list->AddLine({x + 1.0F, 0.0F}, {x + 1.0F, size.y}, IM_COL32(0, 0, 0, 160), 3.0F);
    list->AddLine({x, 0.0F}, {x, size.y}, colour, 1.5F);
    list->AddCircleFilled({x, 0.5F * size.y}, kHandleRadius, colour);
    // Below the title of the collapsed panel.
    const float top = 10.0F + 1.5F * ImGui::GetFrameHeight();
    draw_label(list, x - 8.0F, top, left, true);
    draw_label(list, x + 8.0F, top, right, false);
    return moved;
}

}  // namespace rowland::demo
