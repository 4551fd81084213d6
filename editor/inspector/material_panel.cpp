#include "editor/inspector/material_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace rowland::inspector {

namespace {

const ImVec4 kRefused(0.95F, 0.60F, 0.15F, 1.0F);

/// 1, 2 or 5 times a power of ten, near x.
double round_step(double x) {
    const double unit = std::pow(10.0, std::floor(std::log10(x)));
    const double digit = x / unit;
    return unit * (digit < 1.5 ? 1.0 : digit < 3.5 ? 2.0 : digit < 7.5 ? 5.0 : 10.0);
}

/// How much a pixel of drag changes a field.
double drag_step(const Field& field, double value) {
    constexpr double kPixels = 200.0;
    if (!field.logarithmic) return round_step((field.maximum - field.minimum) / kPixels);
    return round_step(std::max(std::abs(value), field.minimum) / kPixels);
}

/// A value that is no number shows as one, so that it can be mended.
double number_of(const Json& value) {
    return value.is_number() ? value.get<double>() : 0.0;
}

void help_on_hover(const Field& field) {
    if (!ImGui::IsItemHovered()) return;
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(24.0F * ImGui::GetFontSize());
    ImGui::TextUnformatted(field.help.c_str());
    ImGui::TextDisabled("Source: %s", field.source.c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

const char* section_of(const Field& field) {
    if (field.pointer.starts_with("/grating")) return "Grating";
    return field.pointer.starts_with("/quality") ? "Quality" : "Surface";
}

}  // namespace

void MaterialPanel::draw(Document& document, ControlMap& controls) {
    std::string section;
    bool open = false;
    if (document.refusal() && document.refusal()->field == nullptr) {
        ImGui::PushTextWrapPos();
        ImGui::TextColored(kRefused, "%s", document.refusal()->message.c_str());
        ImGui::PopTextWrapPos();
    }
    for (const Field& field : fields()) {
        if (!is_shown(field, document.json())) continue;
        if (section != section_of(field)) {
            section = section_of(field);
            open = ImGui::CollapsingHeader(section.c_str(), ImGuiTreeNodeFlags_DefaultOpen);
        }
        if (open) draw_field(document, field, controls);
    }
}

void MaterialPanel::draw_field(Document& document, const Field& field, ControlMap& controls) {
    ImGui::PushID(field.pointer.c_str());
    const bool refused = document.refusal() && document.refusal()->field == &field;
    const float font = ImGui::GetFontSize();
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(field.label.c_str());
    help_on_hover(field);
    ImGui::SameLine(8.2F * font);
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - 2.0F * font);
    if (refused) {
        ImGui::PushStyleColor(ImGuiCol_Border, kRefused);
        ImGui::PushStyleVar(ImGuiStyleVar_FrameBorderSize, 2.0F);
    }
    switch (field.kind) {
        case FieldKind::Number:
            draw_number(document, field);
            break;
        case FieldKind::Count:
            draw_count(document, field);
            break;
        case FieldKind::Choice:
            draw_choice(document, field, controls);
            break;
        case FieldKind::Orders:
        case FieldKind::Name:
            draw_text(document, field);
            break;
        case FieldKind::Colour: {
            std::array<float, 3> rgb{};
            const Json value = value_of(field, document.json());
            for (std::size_t i = 0; i < 3 && value.is_array() && i < value.size(); ++i)
                rgb[i] = static_cast<float>(number_of(value[i]));
            if (ImGui::ColorEdit3("##value", rgb.data(), ImGuiColorEditFlags_Float)) {
                Json edited = Json::array();
                for (const float part : rgb) edited.push_back(std::round(static_cast<double>(part) * 1e3) / 1e3);
                document.set_value(field, edited);
            }
            if (ImGui::IsItemDeactivatedAfterEdit()) document.finish_edit();
            break;
        }
    }
    controls.mark(field.pointer);
    help_on_hover(field);
    if (refused) {
        ImGui::PopStyleVar();
        ImGui::PopStyleColor();
    }
    if (can_revert(field, document.json())) {
        ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - 1.6F * font);
        if (ImGui::SmallButton("↺")) document.revert(field);
        controls.mark(field.pointer + " revert");
        if (ImGui::IsItemHovered())
            ImGui::SetTooltip("Revert to %s",
                              field.default_value.is_null() ? "none" : field.default_value.dump().c_str());
    }
    // Reverting may have changed what is refused.
    if (refused && document.refusal()) {
        ImGui::PushTextWrapPos();
        ImGui::TextColored(kRefused, "%s", document.refusal()->message.c_str());
        ImGui::PopTextWrapPos();
    }
    ImGui::PopID();
    if (field.pointer == "/grating/pitch_nm") draw_lines_per_mm(document, controls);
}

void MaterialPanel::draw_number(Document& document, const Field& field) {
    double value = number_of(value_of(field, document.json()));
    const double step = drag_step(field, value);
    const std::string format = field.unit.empty() ? "%.4g" : "%.7g " + field.unit;
    if (ImGui::DragScalar("##value", ImGuiDataType_Double, &value, static_cast<float>(step), nullptr, nullptr,
                          format.c_str()))
        document.set_value(field, value);
    if (ImGui::IsItemDeactivatedAfterEdit()) document.finish_edit();
}

void MaterialPanel::draw_count(Document& document, const Field& field) {
    int value = static_cast<int>(number_of(value_of(field, document.json())));
    if (ImGui::DragInt("##value", &value, 0.1F, static_cast<int>(field.minimum), static_cast<int>(field.maximum)))
        document.set_value(field, value);
    if (ImGui::IsItemDeactivatedAfterEdit()) document.finish_edit();
}

void MaterialPanel::draw_choice(Document& document, const Field& field, ControlMap& controls) {
    const std::string present = choice_of(field, document.json());
    if (!ImGui::BeginCombo("##value", present.empty() ? "?" : present.c_str(), ImGuiComboFlags_HeightLargest)) return;
    for (const Choice& choice : field.choices) {
        if (ImGui::Selectable(choice.name.c_str(), choice.name == present) && choice.name != present)
            document.set_choice(field, choice.name);
        controls.mark(field.pointer + "=" + choice.name);
        if (choice.name == present) ImGui::SetItemDefaultFocus();
    }
    ImGui::EndCombo();
}

void MaterialPanel::draw_text(Document& document, const Field& field) {
    const Json value = value_of(field, document.json());
    std::array<char, 512> buffer{};
    const auto typed = texts_.find(field.pointer);
    const std::string text = typed != texts_.end()             ? typed->second
                             : field.kind == FieldKind::Orders ? format_orders(value)
                             : value.is_string()               ? value.get<std::string>()
                                                               : value.dump();
    std::strncpy(buffer.data(), text.c_str(), buffer.size() - 1);
    if (ImGui::InputText("##value", buffer.data(), buffer.size())) texts_[field.pointer] = buffer.data();
    if (!ImGui::IsItemDeactivated()) return;
    if (const auto found = texts_.find(field.pointer); found != texts_.end()) {
        document.set_value(field, field.kind == FieldKind::Orders ? parse_orders(found->second) : Json(found->second));
        document.finish_edit();
        texts_.erase(found);
    }
}

void MaterialPanel::draw_lines_per_mm(Document& document, ControlMap& controls) {
    const Field& pitch = field_at("/grating/pitch_nm");
    const double pitch_nm = number_of(value_of(pitch, document.json()));
    double lines = pitch_nm > 0.0 ? lines_per_mm(pitch_nm) : 0.0;
    const float font = ImGui::GetFontSize();
    ImGui::AlignTextToFramePadding();
    ImGui::TextDisabled("  as lines");
    ImGui::SameLine(8.2F * font);
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - 2.0F * font);
    ImGui::InputDouble("##lines", &lines, 0.0, 0.0, "%.6g /mm");
    controls.mark("lines per mm");
    if (ImGui::IsItemDeactivatedAfterEdit() && lines > 0.0) {
        document.set_value(pitch, pitch_of_lines(lines));
        document.finish_edit();
    }
}

}  // namespace rowland::inspector
