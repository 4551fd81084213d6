#include "editor/inspector/workbench.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <utility>

#include "editor/inspector/overwrite_question.h"

namespace rowland::inspector {

namespace {

constexpr ImGuiWindowFlags kTile = ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoCollapse |
                                   ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoSavedSettings;

bool begin_tile(const char* name, const ImVec2& corner, const ImVec2& size, ImGuiWindowFlags more = 0) {
    ImGui::SetNextWindowPos(corner);
    ImGui::SetNextWindowSize(size);
    return ImGui::Begin(name, nullptr, kTile | more);
}

}  // namespace

void Workbench::draw(const platform::InputState& input, bool keys_are_ours, const WorkbenchFrame& frame) {
    const std::vector<Command> present = commands();
    if (keys_are_ours) run_pressed(present, input);
    draw_menu_bar(present, controls_);
    draw_tiles(input, frame);
    film_.draw(controls_);
    if (help_) draw_help(present, help_, controls_);
    const float font = ImGui::GetFontSize();
    if (frame.in_window)
        messages_.draw(session_.messages(), frame.size.x - 0.5F * font, frame.size.y - 2.4F * font,
                       std::min(30.0F * font, frame.size.x - font));
    controls_.note("unread", std::to_string(messages_.shown()));
    dialogs_.draw(controls_);
    draw_overwrite_question(session_, controls_);
    note_facts();
    controls_.end_frame();
}

void Workbench::note_facts() {
    const Document& document = session_.document();
    controls_.note("document", document.name() + (document.dirty() ? " *" : ""));
    controls_.note("refused", document.refusal() ? document.refusal()->message : "no");
    controls_.note("material", document.json().dump());
    controls_.note("shape is", preview_shape_name(session_.shape()));
    controls_.note("busy", session_.busy() ? "yes" : "no");
    controls_.note("light", session_.light() ? session_.light()->path.filename().string() : "none");
    if (!session_.messages().empty()) controls_.note("message", session_.messages().back().text);
}

std::vector<Command> Workbench::commands() {
    using platform::Key;
    Document& document = session_.document();
    const auto scale_by = [this](float step) {
        return [this, step] { layout_.scale = std::clamp(layout_.scale + step, 0.5F, 4.0F); };
    };
    std::vector<Command> result = {
        {"File", "Open…", "Ctrl+O", Key::O, [this] { dialogs_.ask_open(); }},
        {"File", "Save", "Ctrl+S", Key::S, [this] { dialogs_.save(); }},
        {"File", "Save as…", "Ctrl+Shift+S", Key::S, [this] { dialogs_.ask_save_as(); }},
        {"File",
         "Close scene",
         {},
         {},
         [this] { dialogs_.unless_lost([this] { session_.close_scene(); }); },
         session_.document().is_scene()},
        {"File", ""},
        {"File", "Quit", "Ctrl+Q", Key::Q, [this] { ask_to_close(); }},
        {"Edit", "Undo", "Ctrl+Z", Key::Z, [&document] { document.undo(); }, document.can_undo()},
        {"Edit", "Redo", "Ctrl+Shift+Z", Key::Z, [&document] { document.redo(); }, document.can_redo()},
    };
    for (const char* preset : Session::presets())
        result.push_back({"Presets", preset, {}, {}, [this, preset] {
                              const auto open = [this, preset] { session_.open_preset(preset); };
                              session_.document().is_scene() ? open() : dialogs_.unless_lost(open);
                          }});
    for (std::size_t i = 0; i < kPreviewShapes.size(); ++i) {
        const PreviewShape shape = kPreviewShapes[i];
        result.push_back({"View", preview_shape_name(shape), fmt::format("Ctrl+{}", i + 1),
                          static_cast<Key>(static_cast<std::size_t>(Key::Digit1) + i),
                          [this, shape] { session_.choose_shape(shape); },
                          shape != PreviewShape::Model || session_.has_model(), shape == session_.shape()});
    }
    const std::vector<Command> rest = {
        {"View", ""},
        {"View", "Compare with saved", "F6", Key::F6, [this] { preview_.comparing = !preview_.comparing; },
         session_.saved() != nullptr, preview_.comparing},
        {"View", "Show grooves", "G", Key::G, [this] { session_.shows_grooves = !session_.shows_grooves; }, true,
         session_.shows_grooves},
        {"View", "Thin film", "F7", Key::F7, [this] { film_.open = !film_.open; }, true, film_.open},
        {"View", "Screenshot", "F12", Key::F12, [this] { screenshot_ = true; }},
        {"View", "Larger text", "Ctrl+=", Key::Equal, scale_by(0.1F)},
        {"View", "Smaller text", "Ctrl+-", Key::Minus, scale_by(-0.1F)},
        {"Help", "Keys", "F1", Key::F1, [this] { help_ = !help_; }, true, help_},
        {"", "Redo", "Ctrl+Y", Key::Y, [&document] { document.redo(); }},
        {"", "Larger text", "Ctrl+Shift+=", Key::Equal, scale_by(0.1F)},
    };
    result.insert(result.end(), rest.begin(), rest.end());
    return result;
}

void Workbench::splitter(const char* name, const ImVec2& corner, const ImVec2& size, float& value, float sign) {
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.0F, 0.0F});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1.0F, 1.0F});
    begin_tile(name, corner, size,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoNav);
    ImGui::InvisibleButton(name, size);
    controls_.mark(name);
    if (ImGui::IsItemActive()) {
        const ImVec2 moved = ImGui::GetIO().MouseDelta;
        value += sign * (size.y > size.x ? moved.x : moved.y) / ImGui::GetFontSize();
    }
    if (ImGui::IsItemHovered() || ImGui::IsItemActive())
        ImGui::GetWindowDrawList()->AddRectFilled(corner, {corner.x + size.x, corner.y + size.y},
                                                  IM_COL32(66, 140, 217, 160));
    ImGui::End();
    ImGui::PopStyleVar(2);
}

void Workbench::draw_tiles(const platform::InputState& input, const WorkbenchFrame& frame) {
    const float font = ImGui::GetFontSize();
    const float gap = 0.35F * font;
    const float top = ImGui::GetFrameHeight();
    const float status = 1.9F * font;
    const float height = frame.size.y - top - status;
    // The preview keeps a third of the window, whatever its size.
    layout_.material_width = std::clamp(layout_.material_width, 12.0F, 0.32F * frame.size.x / font);
    layout_.physics_width = std::clamp(layout_.physics_width, 12.0F, 0.34F * frame.size.x / font);
    layout_.price_height = std::clamp(layout_.price_height, 4.0F, 0.6F * height / font);
    const float left = layout_.material_width * font;
    const float right = layout_.physics_width * font;
    const float below = layout_.price_height * font;
    const float middle = frame.size.x - left - right - 2.0F * gap;

    if (begin_tile("Material", {0.0F, top}, {left, height})) {
        scene_.draw(session_, controls_);
        if (session_.document().has_grating()) material_.draw(session_.document(), controls_);
    }
    ImGui::End();
    const auto draw_if_grating = [this](const auto& draw) {
        session_.document().has_grating() ? draw() : ImGui::TextDisabled("The chosen material has no grating.");
    };
    if (begin_tile("Physics", {frame.size.x - right, top}, {right, height}))
        draw_if_grating([&] { physics_.draw(session_, controls_); });
    ImGui::End();
    if (begin_tile("Price", {left + gap, top + height - below}, {middle, below}))
        draw_if_grating([&] { price_.draw(session_, frame.frame_ms, controls_); });
    ImGui::End();
    if (begin_tile("Preview", {left + gap, top}, {middle, height - below - gap},
                   ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse))
        preview_.draw(session_, input, frame.pixels_per_unit, frame.seconds, controls_);
    ImGui::End();
    splitter("left splitter", {left, top}, {gap, height}, layout_.material_width, 1.0F);
    splitter("right splitter", {frame.size.x - right - gap, top}, {gap, height}, layout_.physics_width, -1.0F);
    splitter("lower splitter", {left + gap, top + height - below - gap}, {middle, gap}, layout_.price_height, -1.0F);
    draw_status(top + height, frame.size.x, status, frame.frame_ms);
    // The first Tab goes to the first field. A window takes the focus when it appears.
    if (!std::exchange(begun_, true)) ImGui::SetWindowFocus("Material");
}

void Workbench::draw_status(float top, float width, float height, double frame_ms) {
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1.0F, 1.0F});
    begin_tile("##status", {0.0F, top}, {width, height},
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoScrollbar);
    const Document& document = session_.document();
    ImGui::TextUnformatted((document.name() + (document.dirty() ? " •" : "")).c_str());
    if (document.dirty() && ImGui::IsItemHovered()) ImGui::SetTooltip("Not saved");
    if (frame_ms > 0.0) {
        ImGui::SameLine();
        ImGui::TextDisabled("%.1f ms", frame_ms);
    }
    if (!session_.messages().empty()) {
        const Message& last = session_.messages().back();
        ImGui::SameLine();
        if (last.failure)
            ImGui::TextColored({0.95F, 0.60F, 0.15F, 1.0F}, "%s", last.text.c_str());
        else
            ImGui::TextDisabled("%s", last.text.c_str());
        if (ImGui::IsItemHovered() && last.text.size() > 60) {
            ImGui::BeginTooltip();
            ImGui::PushTextWrapPos(40.0F * ImGui::GetFontSize());
            ImGui::TextUnformatted(last.text.c_str());
            ImGui::PopTextWrapPos();
            ImGui::EndTooltip();
        }
    }
    ImGui::End();
    ImGui::PopStyleVar();
}

}  // namespace rowland::inspector
