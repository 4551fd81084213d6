#include "editor/inspector/groove_handle.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>

namespace rowland::inspector {

namespace {

/// In screen coordinates.
struct Knob {
    ImVec2 middle;
    ImVec2 end;
};

ImVec2 on_screen(const glm::vec2& at, const ImVec2& corner, const ImVec2& size) {
    return {corner.x + at.x * size.x, corner.y + at.y * size.y};
}

std::optional<Knob> knob_of(const Session& session, const ImVec2& corner, const ImVec2& size) {
    if (!session.shows_grooves || session.shape() != PreviewShape::Model || !session.surface() ||
        !session.document().has_grating())
        return std::nullopt;
    const Preview& preview = session.preview();
    const PickedSurface surface = preview.as_placed_now(*session.surface());
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
double nearest_turn(double angle, double reference) {
    constexpr double kPi = std::numbers::pi;
    angle += kPi * std::round((reference - angle) / kPi);
    return angle > kPi ? angle - kPi : angle < -kPi ? angle + kPi : angle;
}

}  // namespace

bool GrooveHandle::grabs(const Session& session, const ImVec2& corner, const ImVec2& size, const ImVec2& at) {
    const auto knob = knob_of(session, corner, size);
    return knob && std::hypot(at.x - knob->end.x, at.y - knob->end.y) < 0.8F * ImGui::GetFontSize();
}

void GrooveHandle::drag(Session& session, const glm::vec2& at) {
    if (!session.surface()) return;
    const PickedSurface surface = session.preview().as_placed_now(*session.surface());
    const glm::dvec3 normal = surface.frame.normal;
    const Ray ray = session.preview().ray(at);
    const glm::dvec3 middle(surface.point.position);
    const double slope = glm::dot(normal, glm::dvec3(ray.direction));
    if (std::abs(slope) < 0.05) return;  // seen from its edge
    const double distance = glm::dot(normal, middle - glm::dvec3(ray.origin)) / slope;
    const glm::dvec3 along = glm::dvec3(ray.origin) + distance * glm::dvec3(ray.direction) - middle;
    const glm::dvec3 grating = glm::cross(along, normal);
    const Field& field = field_at("/grooveRotation");
    const Json before = value_of(field, session.document().json());
    const double angle =
        std::atan2(glm::dot(grating, surface.point.bitangent), glm::dot(grating, surface.point.frame.grating)) -
        surface.map_rotation;
    const double turn = nearest_turn(angle, before.is_number() ? before.get<double>() : 0.0);
    session.document().set_value(field, std::round(turn * 1e3) / 1e3);
}

void GrooveHandle::draw(const Session& session, const ImVec2& corner, const ImVec2& size, ControlMap& controls) {
    const auto knob = knob_of(session, corner, size);
    if (!knob) return;
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const float font = ImGui::GetFontSize();
    constexpr ImU32 kDark = IM_COL32(0, 0, 0, 200);
    constexpr ImU32 kBright = IM_COL32(255, 210, 60, 255);
    draw.AddLine(knob->middle, knob->end, kDark, 5.0F);
    draw.AddLine(knob->middle, knob->end, kBright, 2.5F);
    draw.AddCircleFilled(knob->end, 0.5F * font, kDark);
    draw.AddCircleFilled(knob->end, 0.4F * font, kBright);
    controls.note("groove handle", fmt::format("{:.0f} {:.0f} {:.0f} {:.0f}", knob->end.x - 2.0F, knob->end.y - 2.0F,
                                               knob->end.x + 2.0F, knob->end.y + 2.0F));
}

}  // namespace rowland::inspector
