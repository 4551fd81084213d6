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

/// The number near x that is 1, 2 or 5 times a power of ten.
double round_step(double x) {
    const double unit = std::pow(10.0, std::floor(std::log10(x)));
    const double digit = x / unit;
    return unit * (digit < 1.5 ? 1.0 : digit < 3.5 ? 2.0 : digit < 7.5 ? 5.0 : 10.0);
}

/// The change of a field per pixel of drag.
double drag_step(const Field& field, double value) {
    constexpr double kPixels = 200.0;
    if (!field.logarithmic) return round_step((field.maximum - field.minimum) / kPixels);
    return round_step(std::max(std::abs(value), field.minimum) / kPixels);
}

/// 0 for a value that is no number, so that the control can replace it.
double number_of(const Json& value) {
    return value.is_number() ? value.get<double>() : 0.0;
}

/// To 0.001, so that files stay readable.
double rounded(float value) {
    return std::round(static_cast<double>(value) * 1e3) / 1e3;
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

void draw_refusal(const Refusal& refusal) {
    ImGui::PushTextWrapPos();
    ImGui::TextColored(kRefused, "%s", refusal.message.c_str());
    ImGui::PopTextWrapPos();
}

/// The next control follows the label that was just drawn.
void begin_control() {
    const float font = ImGui::GetFontSize();
    ImGui::SameLine(7.7F * font);
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - 2.0F * font);
}

const char* section_of(const Field& field) {
    if (field.pointer.starts_with("/grating")) return "Grating";
    if (field.pointer.starts_with("/groove")) return "Grooves on the mesh";
    return field.pointer.starts_with("/quality") ? "Quality" : "Surface";
}

void draw_number(Document& document, const Field& field) {
    const bool whole = field.kind == FieldKind::Count;
    double value = number_of(value_of(field, document.json()));
    const auto step = static_cast<float>(whole ? 0.1 : drag_step(field, value));
    const std::string format = (whole ? "%.0f" : field.unit.empty() ? "%.4g" : "%.7g ") + field.unit;
    if (ImGui::DragScalar("##value", ImGuiDataType_Double, &value, step, whole ? &field.minimum : nullptr,
                          whole ? &field.maximum : nullptr, format.c_str()))
        document.set_value(field, whole ? std::round(value) : value);
}

void draw_pair(Document& document, const Field& field) {
    std::array<float, 2> pair{};
    const Json value = value_of(field, document.json());
    for (std::size_t i = 0; i < 2 && value.is_array() && i < value.size(); ++i)
        pair[i] = static_cast<float>(number_of(value[i]));
    const float largest = std::max(std::abs(pair[0]), std::abs(pair[1]));
    const auto step = static_cast<float>(drag_step(field, static_cast<double>(largest)));
    if (ImGui::DragFloat2("##value", pair.data(), step, 0.0F, 0.0F, "%.7g"))
        document.set_value(field, {rounded(pair[0]), rounded(pair[1])});
}

void draw_colour(Document& document, const Field& field) {
    std::array<float, 3> rgb{};
    const Json value = value_of(field, document.json());
    for (std::size_t i = 0; i < 3 && value.is_array() && i < value.size(); ++i)
        rgb[i] = static_cast<float>(number_of(value[i]));
    // Its numbers need room; without them a click on the patch opens them.
    const bool narrow = ImGui::CalcItemWidth() < 10.5F * ImGui::GetFontSize();
    if (!ImGui::ColorEdit3("##value", rgb.data(),
                           ImGuiColorEditFlags_Float | (narrow ? ImGuiColorEditFlags_NoInputs : 0)))
        return;
    Json edited = Json::array();
    for (const float part : rgb) edited.push_back(rounded(part));
    document.set_value(field, edited);
}

void draw_choice(Document& document, const Field& field, ControlMap& controls) {
    const std::string present = choice_of(field, document.json());
    const float letters = ImGui::CalcTextSize(present.c_str()).x;
    const bool narrow = ImGui::CalcItemWidth() < letters + 2.5F * ImGui::GetFontSize();
    if (!ImGui::BeginCombo("##value", present.empty() ? "?" : present.c_str(),
                           ImGuiComboFlags_HeightLargest | (narrow ? ImGuiComboFlags_NoArrowButton : 0)))
        return;
    for (const Choice& choice : field.choices) {
        if (ImGui::Selectable(choice.name.c_str(), choice.name == present) && choice.name != present)
            document.set_choice(field, choice.name);
        controls.mark(field.pointer + "=" + choice.name);
        if (choice.name == present) ImGui::SetItemDefaultFocus();
    }
    ImGui::EndCombo();
}

void draw_lines_per_mm(Document& document, ControlMap& controls) {
    const Field& pitch = field_at("/grating/pitch_nm");
    const double pitch_nm = number_of(value_of(pitch, document.json()));
    double lines = pitch_nm > 0.0 ? lines_per_mm(pitch_nm) : 0.0;
    ImGui::AlignTextToFramePadding();
    ImGui::TextDisabled("  as lines");
    begin_control();
    ImGui::InputDouble("##lines", &lines, 0.0, 0.0, "%.6g /mm");
    controls.mark("lines per mm");
    if (ImGui::IsItemDeactivatedAfterEdit() && lines > 0.0) {
        document.set_value(pitch, pitch_of_lines(lines));
        document.finish_edit();
    }
}

}  // namespace

void MaterialPanel::draw(Document& document, ControlMap& controls) {
    std::string section;
    bool open = false;
    if (document.refusal() && document.refusal()->field == nullptr) draw_refusal(*document.refusal());
    for (const auto all : {document.is_scene() ? groove_fields() : std::span<const Field>(), fields()})
        for (const Field& field : all) {
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
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(field.label.c_str());
    help_on_hover(field);
    begin_control();
    if (refused) {
        ImGui::PushStyleColor(ImGuiCol_Border, kRefused);
        ImGui::PushStyleVar(ImGuiStyleVar_FrameBorderSize, 2.0F);
    }
    draw_control(document, field, controls);
    controls.mark(field.pointer);
    help_on_hover(field);
    if (refused) {
        ImGui::PopStyleVar();
        ImGui::PopStyleColor();
    }
    if (can_revert(field, document.json())) {
        ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - 1.6F * ImGui::GetFontSize());
        if (ImGui::SmallButton("↺")) document.revert(field);
        controls.mark(field.pointer + " revert");
        if (ImGui::IsItemHovered())
            ImGui::SetTooltip("Reset to %s",
                              field.default_value.is_null() ? "none" : field.default_value.dump().c_str());
    }
    // A reset may have ended the refusal.
    if (refused && document.refusal()) draw_refusal(*document.refusal());
    ImGui::PopID();
    if (field.pointer == "/grating/pitch_nm") draw_lines_per_mm(document, controls);
}

void MaterialPanel::draw_control(Document& document, const Field& field, ControlMap& controls) {
    switch (field.kind) {
        case FieldKind::Choice:
            return draw_choice(document, field, controls);
        case FieldKind::Orders:
        case FieldKind::Name:
            return draw_text(document, field);
        case FieldKind::Colour:
            draw_colour(document, field);
            break;
        case FieldKind::Pair:
            draw_pair(document, field);
            break;
        case FieldKind::Number:
        case FieldKind::Count:
            draw_number(document, field);
            break;
    }
    if (ImGui::IsItemDeactivatedAfterEdit()) document.finish_edit();
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
    const auto found = texts_.find(field.pointer);
    if (ImGui::IsItemDeactivated() && found != texts_.end()) {
        document.set_value(field, field.kind == FieldKind::Orders ? parse_orders(found->second) : Json(found->second));
        document.finish_edit();
        texts_.erase(found);
    }
}

}  // namespace rowland::inspector
