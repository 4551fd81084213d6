#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "editor/inspector/panels.h"

namespace rowland::inspector {

namespace {

/// A handle on the surface of a scene that points along the grooves, in screen coordinates.
struct Knob {
    ImVec2 middle;
    ImVec2 end;
};

/// `at`: from the picture's upper left corner, in [0, 1]; `corner`, `size`: of the picture.
ImVec2 on_screen(const glm::vec2& at, const ImVec2& corner, const ImVec2& size) {
    return {corner.x + at.x * size.x, corner.y + at.y * size.y};
}

std::optional<Knob> knob_of(const Document& document, const View& view, const ImVec2& corner, const ImVec2& size) {
    if (!view.shows_grooves || view.shape() != PreviewShape::Scene || !view.surface() || !document.has_grating())
        return std::nullopt;
    const Preview& preview = view.preview();
    const PickedSurface surface = preview.under_current_rotation(*view.surface());
    const glm::vec3 along(glm::cross(surface.frame.normal, surface.frame.grating));
    constexpr float kStep = 1e-3F;  // metres
    const ImVec2 middle = on_screen(preview.project(surface.point.position), corner, size);
    const ImVec2 ahead = on_screen(preview.project(surface.point.position + kStep * along), corner, size);
    const glm::vec2 direction(ahead.x - middle.x, ahead.y - middle.y);
    const float length = glm::length(direction);
    if (!(length > 0.0F)) return std::nullopt;
    const glm::vec2 arm = 4.0F * ImGui::GetFontSize() / length * direction;
    return Knob{middle, {middle.x + arm.x, middle.y + arm.y}};
}

/// The angle of the same undirected groove nearest to `reference`, in [−π, π].
double nearest_rotation(double angle, double reference) {
    constexpr double kPi = std::numbers::pi;
    angle += kPi * std::round((reference - angle) / kPi);
    return angle > kPi ? angle - kPi : angle < -kPi ? angle + kPi : angle;
}

constexpr ImU32 kBright = IM_COL32(240, 240, 240, 255);
constexpr ImU32 kBlack = IM_COL32(0, 0, 0, 255);

/// A slider without a label; its name is for the control map.
struct Slider {
    const char* name;
    float Stage::*value;
    float minimum;
    float maximum;
    const char* format;
    float width;  ///< in letters
};
constexpr Slider kRotation{"turn", &Stage::rotation_deg, -180.0F, 180.0F, "rotated %.0f°", 6.6F};
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

void draw_lamp_sliders(Stage& stage, ControlMap& controls) {
    if (!stage.lamp) return;
    for (const Slider& slider : kLamp) {
        if (&slider != kLamp) ImGui::SameLine();
        draw_slider(slider, stage, controls);
    }
}

/// Says why there is no picture yet.
void draw_waiting(const char* words, const ImVec2& corner, const ImVec2& size) {
    const ImVec2 extent = ImGui::CalcTextSize(words);
    ImGui::GetWindowDrawList()->AddText({corner.x + (size.x - extent.x) / 2.0F, corner.y + (size.y - extent.y) / 2.0F},
                                        kBright, words);
}

void draw_note(const char* words, const ImVec2& corner, const ImVec2& size) {
    const float font = ImGui::GetFontSize();
    ImGui::GetWindowDrawList()->AddText({corner.x + 0.6F * font, corner.y + size.y - 1.6F * font}, kBright, words);
}

void draw_shape_picker(View& view, bool has_scene, ControlMap& controls) {
    ImGui::SetNextItemWidth(5.2F * ImGui::GetFontSize());
    if (ImGui::BeginCombo("##shape", preview_shape_name(view.shape()))) {
        for (const PreviewShape shape : kPreviewShapes) {
            if (shape == PreviewShape::Scene && !has_scene) continue;
            if (ImGui::Selectable(preview_shape_name(shape), shape == view.shape())) view.choose_shape(shape);
            controls.mark(std::string("shape=") + preview_shape_name(shape));
        }
        ImGui::EndCombo();
    }
    controls.mark("shape");
}

/// "interior (capture)"
std::string light_name(const std::filesystem::path& path) {
    constexpr std::string_view kCaptured = "captured_";
    const std::string name = path.stem().string();
    return name.starts_with(kCaptured) ? name.substr(kCaptured.size()) + " (capture)" : name;
}

void draw_light_picker(LightChoice& light, ControlMap& controls) {
    ImGui::SetNextItemWidth(9.0F * ImGui::GetFontSize());
    const std::string present = light.current() ? light_name(light.current()->path) : "loading…";
    if (ImGui::BeginCombo("##light", present.c_str())) {
        for (const std::filesystem::path& path : light.shipped()) {
            const std::string name = path.stem().string();
            if (ImGui::Selectable(light_name(path).c_str())) light.choose(path);
            controls.mark("light=" + name);
        }
        ImGui::TextDisabled("or drop an .hdr or .exr, of the mapping");
        for (const char* mapping : {"auto", "equirect", "angular"}) {
            if (ImGui::Selectable(mapping, light.mapping() == mapping)) light.choose_mapping(mapping);
            controls.mark(std::string("mapping=") + mapping);
        }
        ImGui::EndCombo();
    }
    controls.mark("light picker");
}

bool is_on_knob(const Document& document, const View& view, const ImVec2& corner, const ImVec2& size,
                const ImVec2& at) {
    const auto knob = knob_of(document, view, corner, size);
    return knob && std::hypot(at.x - knob->end.x, at.y - knob->end.y) < 0.8F * ImGui::GetFontSize();
}

/// Rotates the grooves so that the knob points to `at`, a point as Preview::pick() takes it.
void drag_knob(Document& document, const View& view, const glm::vec2& at) {
    if (!view.surface()) return;
    const PickedSurface surface = view.preview().under_current_rotation(*view.surface());
    const glm::dvec3 normal = surface.frame.normal;
    const Ray ray = view.preview().ray(at);
    const glm::dvec3 middle(surface.point.position);
    const double slope = glm::dot(normal, glm::dvec3(ray.direction));
    if (std::abs(slope) < 0.05) return;  // the surface is seen edge-on
    const double distance = glm::dot(normal, middle - glm::dvec3(ray.origin)) / slope;
    const glm::dvec3 along = glm::dvec3(ray.origin) + distance * glm::dvec3(ray.direction) - middle;
    const glm::dvec3 grating = glm::cross(along, normal);
    const Field& field = field_at("/grooveRotation");
    const Json before = value_of(field, document.json());
    const double angle =
        std::atan2(glm::dot(grating, surface.point.bitangent), glm::dot(grating, surface.point.frame.grating)) -
        surface.map_rotation;
    const double rotation = nearest_rotation(angle, before.is_number() ? before.get<double>() : 0.0);
    document.set_value(field, std::round(rotation * 1e3) / 1e3);
}

void draw_knob(const Document& document, const View& view, const ImVec2& corner, const ImVec2& size,
               ControlMap& controls) {
    const auto knob = knob_of(document, view, corner, size);
    if (!knob) return;
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const float font = ImGui::GetFontSize();
    constexpr ImU32 kDark = IM_COL32(0, 0, 0, 200);
    constexpr ImU32 kKnob = IM_COL32(255, 210, 60, 255);
    draw.AddLine(knob->middle, knob->end, kDark, 5.0F);
    draw.AddLine(knob->middle, knob->end, kKnob, 2.5F);
    draw.AddCircleFilled(knob->end, 0.5F * font, kDark);
    draw.AddCircleFilled(knob->end, 0.4F * font, kKnob);
    controls.note("groove handle", fmt::format("{:.0f} {:.0f} {:.0f} {:.0f}", knob->end.x - 2.0F, knob->end.y - 2.0F,
                                               knob->end.x + 2.0F, knob->end.y + 2.0F));
}

}  // namespace

constexpr scene::OrbitSettings kOrbit{.minimum_distance = 0.005F, .maximum_distance = 5.0F};

PreviewPanel::PreviewPanel() : camera_(opening_camera(), kOrbit) {}

void PreviewPanel::frame(View& view) {
    if (const auto sphere = view.chosen_sphere())
        camera_ = scene::OrbitCamera(scene::framed(camera_.camera(), glm::vec3(*sphere), sphere->w), kOrbit);
}

void PreviewPanel::draw_tools(bool has_scene, bool has_grating, bool has_saved, LightChoice& light, View& view,
                              ControlMap& controls) {
    draw_shape_picker(view, has_scene, controls);
    continue_line(9.0F);
    draw_light_tools(light, view, controls);
    if (has_grating) {
        continue_line(7.5F);
        ImGui::Checkbox("Look through", &view.looks_through);
        controls.mark("look through");
        if (ImGui::IsItemHovered())
            ImGui::SetTooltip("Hold the material before the camera: its glare around bright lights");
    }
    if (has_saved) {
        continue_line(4.0F);
        ImGui::Checkbox("A/B", &comparing);
        controls.mark("compare");
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("Left of the line: as saved. Drag the line.");
    }
    draw_lamp_sliders(view.stage, controls);
}

void PreviewPanel::draw_light_tools(LightChoice& light, View& view, ControlMap& controls) {
    draw_light_picker(light, controls);
    for (const Slider* slider : {&kRotation, &kExposure}) {
        continue_line(slider->width);
        draw_slider(*slider, view.stage, controls);
    }
    continue_line(4.5F);
    ImGui::Checkbox("Lamp", &view.stage.lamp);
    controls.mark("lamp");
}

const std::optional<std::pair<ImVec2, ImVec2>>& PreviewPanel::begin_picture(ControlMap& controls) {
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const ImVec2 size = ImGui::GetContentRegionAvail();
    picture_.reset();
    if (size.x < 8.0F || size.y < 8.0F) return picture_;
    ImGui::InvisibleButton("picture", size);
    controls.mark("picture");
    picture_.emplace(corner, size);
    return picture_;
}

/// Another object is seen from `camera`.
void PreviewPanel::follow(const void* shown, const scene::Camera& camera) {
    if (std::exchange(shown_, shown) != shown) camera_ = scene::OrbitCamera(camera, kOrbit);
}

void PreviewPanel::draw(OpenDocument& opened, LightChoice& light, View& view, const platform::InputState& input,
                        float pixels_per_unit, float seconds, ControlMap& controls) {
    has_saved_ = opened.surface(true) != nullptr;
    follow(opened.scene(), opening_camera());
    draw_tools(opened.scene() != nullptr, opened.document().has_grating(), has_saved_, light, view, controls);
    const auto& rectangle = begin_picture(controls);
    if (!rectangle) return;
    const auto [corner, size] = *rectangle;
    use_mouse(&opened.document(), view, input, corner, size);
    if (!view.ready()) return draw_waiting("Preparing material and light…", corner, size);
    view.draw(glm::ivec2(pixels_per_unit * glm::vec2(size.x, size.y)), camera_.camera(), comparing, seconds);
    draw_picture(view, corner, size);
    if (opened.cooking() || light.loading())
        draw_note(light.loading() ? "loading the light…" : "cooking…", corner, size);
    draw_knob(opened.document(), view, corner, size, controls);
    if (view.stage.lamp) draw_lamp(view.stage, corner, size, controls);
}

void PreviewPanel::draw(FoilStudio& studio, LightChoice& light, View& view, const platform::InputState& input,
                        float pixels_per_unit, float seconds, ControlMap& controls) {
    constexpr float kDistance = 0.41F;
    has_saved_ = false;
    follow(&studio, card_camera(kDistance));
    draw_light_tools(light, view, controls);
    continue_line(4.5F);
    ImGui::Checkbox("Tilt", &studio.tilting);
    controls.mark("tilt");
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("The card moves as a hand tilts it. A drag stops it.");
    continue_line(5.0F);
    if (ImGui::Button("Turn over")) {
        const scene::Camera camera = camera_.camera();
        camera_ = scene::OrbitCamera(
            scene::Camera(camera.target + glm::vec3(-1.0F, 1.0F, -1.0F) * (camera.eye - camera.target), camera.target),
            kOrbit);
    }
    controls.mark("turn over");
    draw_lamp_sliders(view.stage, controls);
    const auto& rectangle = begin_picture(controls);
    if (!rectangle) return;
    const auto [corner, size] = *rectangle;
    use_mouse(nullptr, view, input, corner, size);
    if (drag_ == Drag::Orbit && ImGui::IsItemActive()) studio.tilting = false;
    if (!view.ready()) return draw_waiting("Preparing card and light…", corner, size);
    if (studio.moves()) {
        constexpr float kSlow_s = 0.25F;
        constexpr float kFast_s = 0.15F;
        constexpr float kStep = 0.75F;
        if (seconds > kSlow_s) moving_scale_ = std::max(kStep * moving_scale_, 0.2F);
        if (seconds < kFast_s) moving_scale_ = std::min(moving_scale_ / kStep, 1.0F);
    }
    const float scale = pixels_per_unit * (studio.moves() ? moving_scale_ : 1.0F);
    view.draw(glm::ivec2(scale * glm::vec2(size.x, size.y)), camera_.camera(), false, seconds);
    draw_picture(view, corner, size);
    if (light.loading()) draw_note("loading the light…", corner, size);
    if (view.stage.lamp) draw_lamp(view.stage, corner, size, controls);
}

void PreviewPanel::draw_picture(const View& view, const ImVec2& corner, const ImVec2& size) const {
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const float font = ImGui::GetFontSize();
    const ImVec2 end(corner.x + size.x, corner.y + size.y);
    draw.AddImage(texture_of(view.preview().display()), corner, end, {0.0F, 1.0F}, {1.0F, 0.0F});
    if (comparing && has_saved_) draw_saved(view, corner, end);
    if (const gpu::Framebuffer* grooves = view.preview().grooves())
        draw.AddImage(texture_of(*grooves), corner, end, {0.0F, 1.0F}, {1.0F, 0.0F});
    if (const auto& picked = view.picked()) {
        const ImVec2 at = on_screen(picked->position, corner, size);
        draw.AddCircle(at, 0.45F * font, kBlack, 0, 3.5F);
        draw.AddCircle(at, 0.45F * font, IM_COL32_WHITE, 0, 1.5F);
    }
}

void PreviewPanel::draw_saved(const View& view, const ImVec2& corner, const ImVec2& end) const {
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const float font = ImGui::GetFontSize();
    const float x = corner.x + line_ * (end.x - corner.x);
    draw.AddImage(texture_of(view.preview().saved_display()), corner, {x, end.y}, {0.0F, 1.0F}, {line_, 0.0F});
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
    const ImVec2 at = on_screen(handle.position, corner, size);
    const float radius = 0.45F * ImGui::GetFontSize();
    const int alpha = handle.behind ? 90 : 220;
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddLine(on_screen(handle.centre, corner, size), at, IM_COL32(255, 235, 170, alpha / 3), 1.5F);
    draw.AddCircleFilled(at, radius, IM_COL32(255, 235, 170, alpha));
    draw.AddCircle(at, radius, kBlack, 0, 1.5F);
    controls.note("lamp handle",
                  fmt::format("{:.0f} {:.0f} {:.0f} {:.0f}", at.x - 1.0F, at.y - 1.0F, at.x + 1.0F, at.y + 1.0F));
    controls.note("lamp is", fmt::format("{:.0f} {:.0f}", stage.lamp_azimuth_deg, stage.lamp_elevation_deg));
}

bool PreviewPanel::near_lamp(const Stage& stage, const glm::vec2& at, const ImVec2& size) const {
    if (!stage.lamp) return false;
    const glm::vec2 apart =
        (lamp_handle(camera_.camera(), size.x / size.y, stage).position - at) * glm::vec2(size.x, size.y);
    return glm::length(apart) < 0.8F * ImGui::GetFontSize();
}

void PreviewPanel::use_mouse(Document* document, View& view, const platform::InputState& input, const ImVec2& corner,
                             const ImVec2& size) {
    const ImGuiIO& io = ImGui::GetIO();
    const glm::vec2 at((io.MousePos.x - corner.x) / size.x, (io.MousePos.y - corner.y) / size.y);
    const bool near_line = comparing && has_saved_ && std::abs(at.x - line_) < 6.0F / size.x;
    const bool on_lamp = near_lamp(view.stage, at, size);
    if (ImGui::IsItemActivated()) {
        drag_ = on_lamp                                                              ? Drag::Lamp
                : near_line                                                          ? Drag::Line
                : document && is_on_knob(*document, view, corner, size, io.MousePos) ? Drag::Grooves
                                                                                     : Drag::None;
        if (on_lamp) lamp_behind_ = lamp_handle(camera_.camera(), size.x / size.y, view.stage).behind;
    }
    scene::OrbitInput orbit;
    if (ImGui::IsItemActive()) {
        if (drag_ == Drag::None && ImGui::IsMouseDragging(ImGuiMouseButton_Left, 4.0F)) drag_ = Drag::Orbit;
        if (drag_ == Drag::Line) line_ = std::clamp(at.x, 0.0F, 1.0F);
        if (drag_ == Drag::Grooves) drag_knob(*document, view, at);
        if (drag_ == Drag::Lamp && (io.MouseDelta.x != 0.0F || io.MouseDelta.y != 0.0F))
            drag_lamp(view.stage, camera_.camera(), size.x / size.y, at, lamp_behind_);
        if (drag_ == Drag::Orbit) orbit.drag = {io.MouseDelta.x, io.MouseDelta.y};
    }
    if (ImGui::IsItemHovered()) orbit.scroll = static_cast<float>(input.scroll().y);
    camera_.update(orbit);
    if (ImGui::IsItemDeactivated() && drag_ == Drag::None) view.pick(at);
    if (ImGui::IsItemDeactivated() && drag_ == Drag::Grooves) document->finish_edit();
    if (ImGui::IsItemHovered() && on_lamp) ImGui::SetTooltip("Drag: move the lamp");
    if (ImGui::IsItemHovered() && near_line) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
}

}  // namespace rowland::inspector
