#include "editor/inspector/light_boxes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstring>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>
#include <utility>

#include "engine/core/error.h"
#include "engine/scene/gltf_check.h"

namespace rowland::inspector {

namespace {

using Box = scene::ExtendedNode;

double default_fade_m() {
    return static_cast<double>(scene::ImportedProbe{}.fade_m);
}

std::string probe_of(const Box& box) {
    return box.extension.at("probe").get<std::string>();
}

glm::dvec3 size_of(const Box& box) {
    glm::dvec3 size;
    for (int i = 0; i < 3; ++i) size[i] = box.extension.at("size_m").at(static_cast<std::size_t>(i)).get<double>();
    return size;
}

void set_size(Box& box, const glm::dvec3& size) {
    box.extension["size_m"] = {rounded(size.x), rounded(size.y), rounded(size.z)};
}

/// About Y, then X, then Z of the rotated node, in degrees.
glm::dvec3 angles_of(const glm::dquat& rotation) {
    const glm::dmat3 axes = glm::mat3_cast(glm::normalize(rotation));
    return glm::degrees(glm::dvec3(std::atan2(axes[2][0], axes[2][2]),
                                   std::asin(std::clamp(0.0 - axes[2][1], -1.0, 1.0)),
                                   std::atan2(axes[0][1], axes[1][1])));
}

glm::dquat rotation_of(const glm::dvec3& degrees) {
    const auto about = [&](int angle, const glm::dvec3& axis) {
        return glm::angleAxis(glm::radians(degrees[angle]), axis);
    };
    const glm::dquat rotation = about(0, {0.0, 1.0, 0.0}) * about(1, {1.0, 0.0, 0.0}) * about(2, {0.0, 0.0, 1.0});
    return {rounded(rotation.w), rounded(rotation.x), rounded(rotation.y), rounded(rotation.z)};
}

struct BoxDrag {
    const char* label;
    const char* name;  ///< for the control map
    const char* help;
    float step;
    NumberRange range;
    const char* format;
};
constexpr BoxDrag kBoxSize{.label = "Size",
                           .name = "box size",
                           .help = "Width, height and depth; times the scale of the box's node",
                           .step = 0.01F,
                           .range = scene::kProbeBoxSide,
                           .format = "%.5g m"};
constexpr BoxDrag kBoxPosition{.label = "Position",
                               .name = "box position",
                               .help = "Of its centre, relative to its node's parent",
                               .step = 0.01F,
                               .range = {.minimum = -1e6, .maximum = 1e6},
                               .format = "%.5g m"};
constexpr BoxDrag kBoxRotation{.label = "Rotation",
                               .name = "box rotation",
                               .help = "About the vertical, then its own x, then its own z",
                               .step = 0.5F,
                               .range = {.minimum = -360.0, .maximum = 360.0},
                               .format = "%.5g°"};
constexpr BoxDrag kBoxFade{.label = "Fade",
                           .name = "box fade",
                           .help = "How far beyond the box its light gives way to other light",
                           .step = 0.01F,
                           .range = scene::kProbeFade,
                           .format = "%.5g m"};

/// Whether the user changed one of the numbers.
bool draw_box_drag(const BoxDrag& drag, double* numbers, int count, ControlMap& controls) {
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(drag.label);
    begin_control(5.2F);
    const bool changed =
        ImGui::DragScalarN((std::string("##") + drag.name).c_str(), ImGuiDataType_Double, numbers, count, drag.step,
                           &drag.range.minimum, &drag.range.maximum, drag.format, ImGuiSliderFlags_AlwaysClamp);
    controls.mark(drag.name);
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", drag.help);
    return changed;
}

}  // namespace

Box new_light_box(const Document& document, const SceneObject& scene) {
    constexpr double kLeastSize_m = 0.01;
    Box box;
    std::string probe;
    std::string stem = std::filesystem::path(document.name()).stem().string();
    std::ranges::replace_if(
        stem, [](unsigned char letter) { return std::isalnum(letter) == 0; }, '_');
    for (std::size_t number = 1;
         probe.empty() || std::ranges::find(document.boxes(), probe, probe_of) != document.boxes().end(); ++number) {
        box.name = fmt::format("box {}", number);
        probe = fmt::format("{}_light/box_{}.probe", stem, number);
    }
    const glm::dvec3 centre = 0.5F * (scene.bounds.minimum + scene.bounds.maximum);
    box.translation = {rounded(centre.x), rounded(centre.y), rounded(centre.z)};
    set_size(box, glm::max(glm::dvec3(scene.bounds.maximum - scene.bounds.minimum), glm::dvec3(kLeastSize_m)));
    box.extension["fade_m"] = default_fade_m();
    box.extension["probe"] = probe;
    return box;
}

glm::mat4 box_to_scene(const Box& box, const SceneObject& scene) {
    // A node's index in the imported scene differs from its index in the file.
    const scene::ImportedScene& imported = scene.imported;
    const auto probe = std::ranges::find(imported.probes, box.index, &scene::ImportedProbe::gltf_node);
    glm::mat4 above(1.0F);
    if (box.index && probe != imported.probes.end())
        if (const auto parent = imported.nodes[probe->node].parent) above = imported.nodes[*parent].world;
    glm::dmat4 local = glm::translate(glm::dmat4(1.0), box.translation) * glm::mat4_cast(glm::normalize(box.rotation));
    local = glm::scale(local, box.scale * size_of(box));
    return above * glm::mat4(local);
}

void LightBoxPanel::draw(Document& document, const SceneObject& scene, ControlMap& controls) {
    const std::string title = fmt::format("Light boxes ({})###boxes", document.boxes().size());
    open_ = ImGui::CollapsingHeader(title.c_str());
    controls.mark("light boxes");
    if (!open_) return;
    draw_list(document, scene, controls);
    chosen_ = std::min(chosen_, document.boxes().size() - (document.boxes().empty() ? 0 : 1));
    if (chosen_ < document.boxes().size()) draw_fields(document, controls);
}

void LightBoxPanel::draw_list(Document& document, const SceneObject& scene, ControlMap& controls) {
    const auto change = [&](auto&& edit) {
        std::vector<Box> boxes = document.boxes();
        edit(boxes);
        document.finish_edit();
        document.set_boxes(boxes);
        document.finish_edit();
    };
    for (std::size_t i = 0; i < document.boxes().size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        const Box& box = document.boxes()[i];
        const std::string label = (box.name.empty() ? probe_of(box) : box.name) + "##box";
        if (ImGui::Selectable(label.c_str(), i == chosen_)) chosen_ = i;
        controls.mark(fmt::format("box {}", i));
        ImGui::PopID();
    }
    if (ImGui::Button("Add box")) {
        chosen_ = document.boxes().size();
        change([&](std::vector<Box>& boxes) { boxes.push_back(new_light_box(document, scene)); });
    }
    controls.mark("add box");
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("Objects inside are lit by a probe of the box's own.\nSave, then F9 captures its light.");
    if (chosen_ >= document.boxes().size()) return;
    ImGui::SameLine();
    if (ImGui::Button("Remove box"))
        change([&](std::vector<Box>& boxes) { boxes.erase(boxes.begin() + static_cast<std::ptrdiff_t>(chosen_)); });
    controls.mark("remove box");
}

void LightBoxPanel::draw_fields(Document& document, ControlMap& controls) {
    draw_probe(document, controls);
    std::vector<Box> boxes = document.boxes();
    Box& box = boxes[chosen_];
    const auto finish = [&] {
        if (ImGui::IsItemDeactivatedAfterEdit()) document.finish_edit();
    };
    glm::dvec3 size = size_of(box);
    if (draw_box_drag(kBoxSize, &size.x, 3, controls)) {
        set_size(box, size);
        document.set_boxes(boxes);
    }
    finish();
    if (draw_box_drag(kBoxPosition, &box.translation.x, 3, controls)) {
        for (int i = 0; i < 3; ++i) box.translation[i] = rounded(box.translation[i]);
        document.set_boxes(boxes);
    }
    finish();
    glm::dvec3 angles = angles_of(box.rotation);
    if (draw_box_drag(kBoxRotation, &angles.x, 3, controls)) {
        box.rotation = rotation_of(angles);
        document.set_boxes(boxes);
    }
    finish();
    double fade = box.extension.value("fade_m", default_fade_m());
    if (draw_box_drag(kBoxFade, &fade, 1, controls)) {
        box.extension["fade_m"] = rounded(fade);
        document.set_boxes(boxes);
    }
    finish();
    controls.note("box is", fmt::format("{} {}", box.extension.dump(),
                                        format_json({box.translation.x, box.translation.y, box.translation.z})));
}

void LightBoxPanel::draw_probe(Document& document, ControlMap& controls) {
    std::array<char, 512> buffer{};
    const std::string present = probe_of(document.boxes()[chosen_]);
    if (std::exchange(typed_over_, present) != present) {
        typed_.reset();
        refusal_.clear();
    }
    const std::string text = typed_.value_or(present);
    std::strncpy(buffer.data(), text.c_str(), buffer.size() - 1);
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted("Probe");
    begin_control(5.2F);
    if (ImGui::InputText("##probe", buffer.data(), buffer.size())) typed_ = buffer.data();
    controls.mark("box probe");
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("The file of its light, in the scene's folder or below it. F9 captures and writes it.");
    if (ImGui::IsItemDeactivated() && typed_) {
        std::vector<Box> boxes = document.boxes();
        boxes[chosen_].extension["probe"] = *typed_;
        try {
            document.finish_edit();
            document.set_boxes(boxes);
            document.finish_edit();
        } catch (const Error& error) {
            refusal_ = error.what();
        }
    }
    if (!refusal_.empty()) draw_refusal(refusal_);
}

void LightBoxPanel::draw_edges(const Document& document, const SceneObject& scene, const Preview& preview,
                               const ImVec2& corner, const ImVec2& size) const {
    constexpr int kPieces = 16;  // of an edge, so that only what is behind the eye is missing
    if (!open_) return;
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.PushClipRect(corner, {corner.x + size.x, corner.y + size.y}, true);
    for (std::size_t i = 0; i < document.boxes().size(); ++i) {
        const glm::mat4 to_world = preview.scene_to_world() * box_to_scene(document.boxes()[i], scene);
        const ImU32 colour = i == chosen_ ? IM_COL32(255, 210, 60, 255) : IM_COL32(255, 210, 60, 110);
        const auto piece = [&](const glm::vec3& from, const glm::vec3& to) {
            std::array<glm::vec2, 2> ends{};
            for (std::size_t end = 0; end < 2; ++end) {
                const glm::vec4 point = to_world * glm::vec4(end == 0 ? from : to, 1.0F);
                ends[end] = preview.project(glm::vec3(point));
                if (ends[end] == glm::vec2(-1.0F)) return;
            }
            draw.AddLine({corner.x + ends[0].x * size.x, corner.y + ends[0].y * size.y},
                         {corner.x + ends[1].x * size.x, corner.y + ends[1].y * size.y}, colour,
                         i == chosen_ ? 2.0F : 1.0F);
        };
        for (int axis = 0; axis < 3; ++axis)
            for (const float a : {-0.5F, 0.5F})
                for (const float b : {-0.5F, 0.5F})
                    for (int part = 0; part < kPieces; ++part) {
                        glm::vec3 from;
                        from[(axis + 1) % 3] = a;
                        from[(axis + 2) % 3] = b;
                        glm::vec3 to = from;
                        from[axis] = static_cast<float>(part) / kPieces - 0.5F;
                        to[axis] = static_cast<float>(part + 1) / kPieces - 0.5F;
                        piece(from, to);
                    }
    }
    draw.PopClipRect();
}

}  // namespace rowland::inspector
