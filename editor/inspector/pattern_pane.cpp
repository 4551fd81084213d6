#include "editor/inspector/pattern_pane.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "editor/inspector/plot.h"

namespace rowland::inspector {

namespace {

/// Half the width, and the position of the brightest texel.
std::string numbers_of_pattern(const PatternFigure& figure) {
    const auto found = std::ranges::max_element(figure.xyz, {}, &glm::dvec3::y);
    const auto index = static_cast<int>(found - figure.xyz.begin());
    const auto u = [&](int texel) { return ((2.0 * texel + 1.0) / figure.size - 1.0) * figure.half_width; };
    return fmt::format("{:.4f} of {:.4f} {:.4f}", figure.half_width, u(index % figure.size), u(index / figure.size));
}

}  // namespace

void PatternPane::paint(const Session& session, const post::DisplayTransform& display) {
    if (shown_ == session.pattern() && exposure_stops_ == session.stage.exposure_stops) return;
    shown_ = session.pattern();
    exposure_stops_ = session.stage.exposure_stops;
    const glm::dmat3& to_working = session.preview().xyz_to_working();
    std::vector<glm::vec3> pixels;
    for (const glm::dvec3& xyz : shown_->xyz) pixels.emplace_back(to_working * xyz);
    display.apply_cpu(pixels, exposure_stops_);
    if (texture_.size().x != shown_->size)
        texture_ = gpu::Texture({.format = gpu::Format::RGBA8, .width = shown_->size, .height = shown_->size});
    texture_.upload(std::span<const glm::vec3>(pixels));
}

void PatternPane::draw(const Session& session, const post::DisplayTransform& display, ControlMap& controls) {
    if (!session.pattern()) return ImGui::TextDisabled("Computing…");
    if (session.pattern()->size == 0) return ImGui::TextDisabled("No listed order has light.");
    paint(session, display);
    const double end = shown_->half_width;
    // Its axes take as much of the width as of the height.
    const Plot plot("##pattern", ImGui::GetContentRegionAvail().x + 0.2F * ImGui::GetFontSize(), {-end, end, "u_g"},
                    {-end, end, "u_h"});
    const auto id = reinterpret_cast<ImTextureID>(static_cast<std::intptr_t>(texture_.id()));
    plot.draw().AddImage(id, plot.minimum(), plot.maximum(), {0.0F, 1.0F}, {1.0F, 0.0F});
    ImGui::PushTextWrapPos();
    ImGui::TextDisabled(
        "Where white light goes: u = s + v. The mirror image of a lamp lies in the middle. As exposed in the "
        "view.");
    ImGui::PopTextWrapPos();
    controls.note("pattern", numbers_of_pattern(*shown_));
}

}  // namespace rowland::inspector
