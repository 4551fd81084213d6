#include "editor/inspector/preview_panel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <string>

#include "editor/inspector/groove_handle.h"
#include "editor/inspector/lamp_handle.h"

namespace rowland::inspector {

namespace {

constexpr ImU32 kBright = IM_COL32(240, 240, 240, 255);
constexpr ImU32 kBlack = IM_COL32(0, 0, 0, 255);

ImTextureID texture_of(const gpu::Framebuffer& picture) {
    return reinterpret_cast<ImTextureID>(static_cast<std::intptr_t>(picture.colour().id()));
}

/// A slider without a label; its name is for the control map.
struct Slider {
    const char* name;
    float Stage::*value;
    float minimum;
    float maximum;
    const char* format;
    float width;  ///< in letters
};
constexpr Slider kTurn{"turn", &Stage::rotation_deg, -180.0F, 180.0F, "turned %.0f°", 6.2F};
constexpr Slider kExposure{"exposure", &Stage::exposure_stops, -8.0F, 8.0F, "%+.2f stops", 5.6F};
constexpr Slider kLamp[] = {
    {"lamp azimuth", &Stage::lamp_azimuth_deg, -180.0F, 180.0F, "azimuth %.0f°", 8.0F},
    {"lamp elevation", &Stage::lamp_elevation_deg, 0.0F, 90.0F, "elevation %.0f°", 8.0F},
    {"lamp strength", &Stage::lamp_irradiance, 0.0F, 20.0F, "irradiance %.1f", 8.0F},
};

void draw_slider(const Slider& slider, Stage& stage, ControlMap& controls) {
    ImGui::SetNextItemWidth(slider.width * ImGui::GetFontSize());
    ImGui::SliderFloat((std::string("##") + slider.name).c_str(), &(stage.*slider.value), slider.minimum,
                       slider.maximum, slider.format);
    controls.mark(slider.name);
}

/// Stays on the line of the last control if that many letters fit; a narrow preview has several lines of tools.
void continue_line(float letters) {
    const float right = ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x;
    const float end = ImGui::GetItemRectMax().x + ImGui::GetStyle().ItemSpacing.x + letters * ImGui::GetFontSize();
    if (end <= right) ImGui::SameLine();
}

void draw_shape_picker(Session& session, ControlMap& controls) {
    ImGui::SetNextItemWidth(5.2F * ImGui::GetFontSize());
    if (ImGui::BeginCombo("##shape", preview_shape_name(session.shape()))) {
        for (const PreviewShape shape : kPreviewShapes) {
            if (shape == PreviewShape::Model && !session.has_model()) continue;
            if (ImGui::Selectable(preview_shape_name(shape), shape == session.shape())) session.choose_shape(shape);
            controls.mark(std::string("shape=") + preview_shape_name(shape));
        }
        ImGui::EndCombo();
    }
    controls.mark("shape");
}

void draw_light_picker(Session& session, ControlMap& controls) {
    ImGui::SetNextItemWidth(7.6F * ImGui::GetFontSize());
    const std::string present = session.light() ? session.light()->path.stem().string() : "loading…";
    if (ImGui::BeginCombo("##light", present.c_str())) {
        for (const std::filesystem::path& path : session.shipped_lights()) {
            const std::string name = path.stem().string();
            if (ImGui::Selectable(name.c_str())) session.choose_light(path);
            controls.mark("light=" + name);
        }
        ImGui::TextDisabled("or drop an .hdr or .exr, of the mapping");
        for (const char* mapping : {"auto", "equirect", "angular"}) {
            if (ImGui::Selectable(mapping, session.mapping() == mapping)) session.choose_mapping(mapping);
            controls.mark(std::string("mapping=") + mapping);
        }
        ImGui::EndCombo();
    }
    controls.mark("light picker");
}

}  // namespace

PreviewPanel::PreviewPanel() : camera_(opening_camera(), {.minimum_distance = 0.08F, .maximum_distance = 5.0F}) {}

void PreviewPanel::draw_tools(Session& session, ControlMap& controls) {
    draw_shape_picker(session, controls);
    continue_line(7.6F);
    draw_light_picker(session, controls);
    for (const Slider* slider : {&kTurn, &kExposure}) {
        continue_line(slider->width);
        draw_slider(*slider, session.stage, controls);
    }
    continue_line(4.5F);
    ImGui::Checkbox("Lamp", &session.stage.lamp);
    controls.mark("lamp");
    continue_line(7.5F);
    ImGui::Checkbox("Look through", &session.looks_through);
    controls.mark("look through");
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("Hold the material before the camera: what it does to bright lights");
    if (session.saved()) {
        continue_line(4.0F);
        ImGui::Checkbox("A/B", &comparing);
        controls.mark("compare");
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("Left of the line: as saved. Drag the line.");
    }
    if (!session.stage.lamp) return;
    for (const Slider& slider : kLamp) {
        if (&slider != kLamp) ImGui::SameLine();
        draw_slider(slider, session.stage, controls);
    }
}

void PreviewPanel::draw(Session& session, const platform::InputState& input, float pixels_per_unit, float seconds,
                        ControlMap& controls) {
    draw_tools(session, controls);
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const ImVec2 size = ImGui::GetContentRegionAvail();
    if (size.x < 8.0F || size.y < 8.0F) return;
    ImGui::InvisibleButton("picture", size);
    controls.mark("picture");
    use_mouse(session, input, corner, size);
    if (!session.ready()) {
        const char* words = "Preparing material and light…";
        const ImVec2 extent = ImGui::CalcTextSize(words);
        ImGui::GetWindowDrawList()->AddText(
            {corner.x + (size.x - extent.x) / 2.0F, corner.y + (size.y - extent.y) / 2.0F}, kBright, words);
        return;
    }
    session.draw(glm::ivec2(pixels_per_unit * glm::vec2(size.x, size.y)), camera_.camera(), comparing, seconds);
    draw_picture(session, corner, size);
    GrooveHandle::draw(session, corner, size, controls);
    if (session.stage.lamp) draw_lamp(session.stage, corner, size, controls);
}

void PreviewPanel::draw_picture(const Session& session, const ImVec2& corner, const ImVec2& size) const {
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const float font = ImGui::GetFontSize();
    const ImVec2 end(corner.x + size.x, corner.y + size.y);
    // The first row of a framebuffer is its lowest.
    draw.AddImage(texture_of(session.preview().display()), corner, end, {0.0F, 1.0F}, {1.0F, 0.0F});
    if (comparing && session.saved()) draw_saved(session, corner, end);
    if (const gpu::Framebuffer* grooves = session.preview().grooves())
        draw.AddImage(texture_of(*grooves), corner, end, {0.0F, 1.0F}, {1.0F, 0.0F});
    if (const auto& picked = session.picked()) {
        const ImVec2 at(corner.x + picked->at.x * size.x, corner.y + picked->at.y * size.y);
        draw.AddCircle(at, 0.45F * font, kBlack, 0, 3.5F);
        draw.AddCircle(at, 0.45F * font, IM_COL32_WHITE, 0, 1.5F);
    }
    if (session.cooking() || session.loading_light())
        draw.AddText({corner.x + 0.6F * font, end.y - 1.6F * font}, kBright,
                     session.loading_light() ? "loading the light…" : "cooking…");
}

void PreviewPanel::draw_saved(const Session& session, const ImVec2& corner, const ImVec2& end) const {
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const float font = ImGui::GetFontSize();
    const float x = corner.x + line_ * (end.x - corner.x);
    draw.AddImage(texture_of(session.preview().saved_display()), corner, {x, end.y}, {0.0F, 1.0F}, {line_, 0.0F});
    draw.AddLine({x, corner.y}, {x, end.y}, IM_COL32(0, 0, 0, 160), 4.0F);
    draw.AddLine({x, corner.y}, {x, end.y}, IM_COL32(255, 255, 255, 230), 2.0F);
    const auto label = [&](float left, const char* words) {
        const ImVec2 extent = ImGui::CalcTextSize(words);
        draw.AddRectFilled({left - 0.3F * font, corner.y + 0.3F * font},
                           {left + extent.x + 0.3F * font, corner.y + 0.7F * font + extent.y}, IM_COL32(0, 0, 0, 150),
                           3.0F);
        draw.AddText({left, corner.y + 0.5F * font}, kBright, words);
    };
    label(x - 0.8F * font - ImGui::CalcTextSize("saved").x, "saved");
    label(x + 0.8F * font, "now");
}

void PreviewPanel::draw_lamp(const Stage& stage, const ImVec2& corner, const ImVec2& size, ControlMap& controls) const {
    const LampHandle handle = lamp_handle(camera_.camera(), size.x / size.y, stage);
    const auto in_window = [&](const glm::vec2& at) {
        return ImVec2(corner.x + at.x * size.x, corner.y + at.y * size.y);
    };
    const ImVec2 at = in_window(handle.at);
    const float radius = 0.45F * ImGui::GetFontSize();
    const int alpha = handle.behind ? 90 : 220;
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddLine(in_window(handle.centre), at, IM_COL32(255, 235, 170, alpha / 3), 1.5F);
    draw.AddCircleFilled(at, radius, IM_COL32(255, 235, 170, alpha));
    draw.AddCircle(at, radius, kBlack, 0, 1.5F);
    controls.note("lamp handle",
                  fmt::format("{:.0f} {:.0f} {:.0f} {:.0f}", at.x - 1.0F, at.y - 1.0F, at.x + 1.0F, at.y + 1.0F));
    controls.note("lamp is", fmt::format("{:.0f} {:.0f}", stage.lamp_azimuth_deg, stage.lamp_elevation_deg));
}

bool PreviewPanel::near_lamp(const Stage& stage, const glm::vec2& at, const ImVec2& size) const {
    if (!stage.lamp) return false;
    const glm::vec2 apart = (lamp_handle(camera_.camera(), size.x / size.y, stage).at - at) * glm::vec2(size.x, size.y);
    return glm::length(apart) < 0.8F * ImGui::GetFontSize();
}

void PreviewPanel::use_mouse(Session& session, const platform::InputState& input, const ImVec2& corner,
                             const ImVec2& size) {
    const ImGuiIO& io = ImGui::GetIO();
    const glm::vec2 at((io.MousePos.x - corner.x) / size.x, (io.MousePos.y - corner.y) / size.y);
    const bool near_line = comparing && session.saved() && std::abs(at.x - line_) < 6.0F / size.x;
    const bool on_lamp = near_lamp(session.stage, at, size);
    if (ImGui::IsItemActivated()) {
        drag_ = on_lamp                                                   ? Drag::Lamp
                : near_line                                               ? Drag::Line
                : GrooveHandle::grabs(session, corner, size, io.MousePos) ? Drag::Grooves
                                                                          : Drag::None;
        if (on_lamp) lamp_behind_ = lamp_handle(camera_.camera(), size.x / size.y, session.stage).behind;
    }
    scene::OrbitInput orbit;
    if (ImGui::IsItemActive()) {
        if (drag_ == Drag::None && ImGui::IsMouseDragging(ImGuiMouseButton_Left, 4.0F)) drag_ = Drag::Orbit;
        if (drag_ == Drag::Line) line_ = std::clamp(at.x, 0.0F, 1.0F);
        if (drag_ == Drag::Grooves) GrooveHandle::drag(session, at);
        if (drag_ == Drag::Lamp && (io.MouseDelta.x != 0.0F || io.MouseDelta.y != 0.0F))
            drag_lamp(session.stage, camera_.camera(), size.x / size.y, at, lamp_behind_);
        if (drag_ == Drag::Orbit) orbit.drag = {io.MouseDelta.x, io.MouseDelta.y};
    }
    if (ImGui::IsItemHovered()) orbit.scroll = static_cast<float>(input.scroll().y);
    camera_.update(orbit);
    if (ImGui::IsItemDeactivated() && drag_ == Drag::None) session.pick(at);
    if (ImGui::IsItemDeactivated() && drag_ == Drag::Grooves) session.document().finish_edit();
    if (ImGui::IsItemHovered() && on_lamp) ImGui::SetTooltip("Drag: move the lamp");
    if (ImGui::IsItemHovered() && near_line) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
}

}  // namespace rowland::inspector
