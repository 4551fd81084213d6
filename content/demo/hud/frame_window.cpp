#include <imgui.h>

#include <vector>

#include "content/demo/hud/windows.h"

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
    pass_row("together", cpu_ms, gpu_ms);
    ImGui::EndTable();
}

}  // namespace

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

}  // namespace rowland::demo
