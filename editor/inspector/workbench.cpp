#include "editor/inspector/workbench.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <utility>

namespace rowland::inspector {

namespace {

using platform::Key;

constexpr ImGuiWindowFlags kTile = ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoCollapse |
                                   ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoSavedSettings;
const ImVec4 kAlert(0.95F, 0.60F, 0.15F, 1.0F);

ImTextureID texture_of(const gpu::Framebuffer& picture) {
    return reinterpret_cast<ImTextureID>(static_cast<std::intptr_t>(picture.colour().id()));
}

bool begin_tile(const char* name, float x, float y, float width, float height, ImGuiWindowFlags more = 0) {
    ImGui::SetNextWindowPos({x, y});
    ImGui::SetNextWindowSize({width, height});
    return ImGui::Begin(name, nullptr, kTile | more);
}

}  // namespace

Workbench::Workbench(const post::OcioConfig& config, Session& session, Layout& layout, ControlMap& controls)
    : session_(session),
      layout_(layout),
      controls_(controls),
      physics_(config),
      camera_(opening_camera(), {.minimum_distance = 0.08F, .maximum_distance = 5.0F}) {}

void Workbench::draw(const platform::InputState& input, bool keys_are_ours, const WorkbenchFrame& frame) {
    if (keys_are_ours) shortcuts(input);
    draw_menu();
    draw_tiles(input, frame);
    draw_dialogs();
    const Document& document = session_.document();
    controls_.note("document", document.name() + (document.dirty() ? " *" : ""));
    controls_.note("refused", document.refusal() ? document.refusal()->message : "no");
    controls_.note("material", document.json().dump());
    controls_.note("shape is", preview_shape_name(session_.shape()));
    controls_.note("busy", session_.busy() ? "yes" : "no");
    controls_.note("light", session_.light() ? session_.light()->path.filename().string() : "none");
    if (!session_.messages().empty()) controls_.note("message", session_.messages().back().text);
    controls_.end_frame();
}

void Workbench::shortcuts(const platform::InputState& input) {
    // A long frame may hold both the press and the release of a chord.
    const auto held = [&](Key key) { return input.key(key).down || input.key(key).released; };
    const bool control = held(Key::LeftControl) || held(Key::RightControl);
    const bool shift = held(Key::LeftShift) || held(Key::RightShift);
    const auto pressed = [&](Key key) { return input.key(key).pressed; };
    if (control) {
        if (pressed(Key::Z)) shift ? session_.document().redo() : session_.document().undo();
        if (pressed(Key::Y)) session_.document().redo();
        if (pressed(Key::S) && !shift) save();
        if (pressed(Key::S) && shift) {
            dialog_ = Dialog::SaveAs;
            open_dialog_ = true;
        }
        if (pressed(Key::O)) {
            dialog_ = Dialog::Open;
            open_dialog_ = true;
        }
        if (pressed(Key::Equal)) layout_.scale = std::min(layout_.scale + 0.1F, 4.0F);
        if (pressed(Key::Minus)) layout_.scale = std::max(layout_.scale - 0.1F, 0.5F);
        if (pressed(Key::Q)) ask_to_close();
        return;
    }
    constexpr std::array kShapeKeys = {Key::F1, Key::F2, Key::F3, Key::F4, Key::F5};
    for (std::size_t i = 0; i < kShapeKeys.size(); ++i)
        if (pressed(kShapeKeys[i])) session_.choose_shape(kPreviewShapes[i]);
    if (pressed(Key::F6)) comparing_ = !comparing_;
}

void Workbench::save() {
    if (session_.document().path().empty()) {
        dialog_ = Dialog::SaveAs;
        open_dialog_ = true;
    } else {
        session_.save();
    }
}

void Workbench::unless_lost(std::function<void()> action) {
    const Document& document = session_.document();
    if (document.dirty() && document.can_undo()) {
        after_discard_ = std::move(action);
        dialog_ = Dialog::Discard;
        open_dialog_ = true;
    } else {
        action();
    }
}

void Workbench::ask_to_close() {
    unless_lost([this] { closed_ = true; });
}

void Workbench::draw_menu() {
    if (!ImGui::BeginMainMenuBar()) return;
    Document& document = session_.document();
    const auto item = [&](const char* name, const char* keys, bool enabled = true) {
        const bool chosen = ImGui::MenuItem(name, keys, false, enabled);
        controls_.mark(std::string("menu ") + name);
        return chosen;
    };
    const auto menu = [&](const char* name) {
        const bool open = ImGui::BeginMenu(name);
        if (!open) controls_.mark(std::string("menu ") + name);
        return open;
    };
    if (menu("File")) {
        if (item("Open…", "Ctrl+O")) {
            dialog_ = Dialog::Open;
            open_dialog_ = true;
        }
        if (item("Save", "Ctrl+S")) save();
        if (item("Save as…", "Ctrl+Shift+S")) {
            dialog_ = Dialog::SaveAs;
            open_dialog_ = true;
        }
        ImGui::Separator();
        if (item("Quit", "Ctrl+Q")) ask_to_close();
        ImGui::EndMenu();
    }
    if (menu("Edit")) {
        if (item("Undo", "Ctrl+Z", document.can_undo())) document.undo();
        if (item("Redo", "Ctrl+Shift+Z", document.can_redo())) document.redo();
        ImGui::EndMenu();
    }
    if (menu("Presets")) {
        for (const std::string& preset : session_.presets())
            if (item(preset.c_str(), nullptr)) unless_lost([this, preset] { session_.open_preset(preset); });
        ImGui::EndMenu();
    }
    if (menu("View")) {
        for (std::size_t i = 0; i < kPreviewShapes.size(); ++i)
            if (ImGui::MenuItem(preview_shape_name(kPreviewShapes[i]), fmt::format("F{}", i + 1).c_str(),
                                session_.shape() == kPreviewShapes[i],
                                kPreviewShapes[i] != PreviewShape::Model || session_.has_model()))
                session_.choose_shape(kPreviewShapes[i]);
        ImGui::Separator();
        ImGui::MenuItem("Compare with saved", "F6", &comparing_, session_.preview().has_saved());
        if (item("Larger text", "Ctrl+=")) layout_.scale = std::min(layout_.scale + 0.1F, 4.0F);
        if (item("Smaller text", "Ctrl+-")) layout_.scale = std::max(layout_.scale - 0.1F, 0.5F);
        ImGui::EndMenu();
    }
    ImGui::EndMainMenuBar();
}

void Workbench::splitter(const char* name, float x, float y, float width, float height, float& value, float sign) {
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.0F, 0.0F});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1.0F, 1.0F});
    begin_tile(name, x, y, width, height,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoNav);
    ImGui::InvisibleButton(name, {width, height});
    controls_.mark(name);
    const bool upright = height > width;
    if (ImGui::IsItemActive()) {
        const ImVec2 moved = ImGui::GetIO().MouseDelta;
        value += sign * (upright ? moved.x : moved.y) / ImGui::GetFontSize();
    }
    if (ImGui::IsItemHovered() || ImGui::IsItemActive())
        ImGui::GetWindowDrawList()->AddRectFilled({x, y}, {x + width, y + height}, IM_COL32(66, 140, 217, 160));
    ImGui::End();
    ImGui::PopStyleVar(2);
}

void Workbench::draw_tiles(const platform::InputState& input, const WorkbenchFrame& frame) {
    const float font = ImGui::GetFontSize();
    const float gap = 0.35F * font;
    const float top = ImGui::GetFrameHeight();
    const float status = 1.9F * font;
    const float height = frame.size.y - top - status;
    // Whatever the window's size, the preview keeps a third of it.
    layout_.material_width = std::clamp(layout_.material_width, 12.0F, 0.3F * frame.size.x / font);
    layout_.physics_width = std::clamp(layout_.physics_width, 12.0F, 0.34F * frame.size.x / font);
    layout_.price_height = std::clamp(layout_.price_height, 4.0F, 0.6F * height / font);
    const float left = layout_.material_width * font;
    const float right = layout_.physics_width * font;
    const float below = layout_.price_height * font;
    const float middle = frame.size.x - left - right - 2.0F * gap;

    if (begin_tile("Material", 0.0F, top, left, height)) material_.draw(session_.document(), controls_);
    ImGui::End();
    if (begin_tile("Physics", frame.size.x - right, top, right, height)) physics_.draw(session_, controls_);
    ImGui::End();
    if (begin_tile("Price", left + gap, top + height - below, middle, below))
        price_.draw(session_, frame.frame_ms, controls_);
    ImGui::End();
    if (begin_tile("Preview", left + gap, top, middle, height - below - gap,
                   ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse))
        draw_preview(input, frame);
    ImGui::End();
    splitter("left splitter", left, top, gap, height, layout_.material_width, 1.0F);
    splitter("right splitter", frame.size.x - right - gap, top, gap, height, layout_.physics_width, -1.0F);
    splitter("lower splitter", left + gap, top + height - below - gap, middle, gap, layout_.price_height, -1.0F);
    draw_status(top + height, frame.size.x, status, frame.frame_ms);
}

void Workbench::draw_tools() {
    const float font = ImGui::GetFontSize();
    Stage& stage = session_.stage;
    const float right = ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x;
    // A narrow preview has its tools on several lines.
    const auto beside = [&](float letters) {
        const float end = ImGui::GetItemRectMax().x + ImGui::GetStyle().ItemSpacing.x + letters * font;
        if (end <= right) ImGui::SameLine();
    };
    ImGui::SetNextItemWidth(5.2F * font);
    if (ImGui::BeginCombo("##shape", preview_shape_name(session_.shape()))) {
        for (const PreviewShape shape : kPreviewShapes)
            if (shape != PreviewShape::Model || session_.has_model()) {
                if (ImGui::Selectable(preview_shape_name(shape), shape == session_.shape()))
                    session_.choose_shape(shape);
                controls_.mark(std::string("shape=") + preview_shape_name(shape));
            }
        ImGui::EndCombo();
    }
    controls_.mark("shape");
    beside(7.6F);
    ImGui::SetNextItemWidth(7.6F * font);
    const std::string light = session_.light() ? session_.light()->path.stem().string() : "loading…";
    if (ImGui::BeginCombo("##light", light.c_str())) {
        for (const std::filesystem::path& path : session_.shipped_lights()) {
            if (ImGui::Selectable(path.stem().string().c_str())) session_.choose_light(path);
            controls_.mark("light=" + path.stem().string());
        }
        ImGui::TextDisabled("or drop an .hdr or .exr");
        ImGui::EndCombo();
    }
    controls_.mark("light picker");
    beside(6.2F);
    ImGui::SetNextItemWidth(6.2F * font);
    ImGui::SliderFloat("##turn", &stage.rotation_deg, -180.0F, 180.0F, "turned %.0f°");
    controls_.mark("turn");
    beside(5.6F);
    ImGui::SetNextItemWidth(5.6F * font);
    ImGui::SliderFloat("##exposure", &stage.exposure_stops, -8.0F, 8.0F, "%+.2f stops");
    controls_.mark("exposure");
    beside(4.5F);
    ImGui::Checkbox("Lamp", &stage.lamp);
    controls_.mark("lamp");
    if (session_.preview().has_saved()) {
        beside(4.0F);
        ImGui::Checkbox("A/B", &comparing_);
        controls_.mark("compare");
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("Left of the line: as saved. Drag the line.");
    }
    if (stage.lamp) {
        ImGui::SetNextItemWidth(8.0F * font);
        ImGui::SliderFloat("##lamp azimuth", &stage.lamp_azimuth_deg, -180.0F, 180.0F, "azimuth %.0f°");
        ImGui::SameLine();
        ImGui::SetNextItemWidth(8.0F * font);
        ImGui::SliderFloat("##lamp elevation", &stage.lamp_elevation_deg, 0.0F, 90.0F, "elevation %.0f°");
        ImGui::SameLine();
        ImGui::SetNextItemWidth(8.0F * font);
        ImGui::SliderFloat("##lamp strength", &stage.lamp_irradiance, 0.0F, 20.0F, "irradiance %.1f");
    }
}

void Workbench::draw_preview(const platform::InputState& input, const WorkbenchFrame& frame) {
    draw_tools();
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const ImVec2 size = ImGui::GetContentRegionAvail();
    if (size.x < 8.0F || size.y < 8.0F) return;
    ImGui::InvisibleButton("picture", size);
    controls_.mark("picture");
    use_mouse(input, corner, size);
    const glm::ivec2 pixels(static_cast<int>(size.x * frame.pixels_per_unit),
                            static_cast<int>(size.y * frame.pixels_per_unit));
    if (!session_.preview().ready()) {
        const char* words = "Preparing material and light…";
        const ImVec2 extent = ImGui::CalcTextSize(words);
        ImGui::GetWindowDrawList()->AddText(
            {corner.x + (size.x - extent.x) / 2.0F, corner.y + (size.y - extent.y) / 2.0F},
            IM_COL32(205, 205, 205, 255), words);
        return;
    }
    session_.draw(pixels, camera_.camera(), comparing_, frame.seconds);
    draw_picture(corner, size);
}

void Workbench::draw_picture(const ImVec2& corner, const ImVec2& size) const {
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const ImVec2 end(corner.x + size.x, corner.y + size.y);
    // Framebuffers begin at the lower left.
    draw.AddImage(texture_of(session_.preview().display()), corner, end, {0.0F, 1.0F}, {1.0F, 0.0F});
    const float font = ImGui::GetFontSize();
    if (comparing_ && session_.preview().has_saved()) {
        const float x = corner.x + wipe_ * size.x;
        draw.AddImage(texture_of(session_.preview().saved_display()), corner, {x, end.y}, {0.0F, 1.0F}, {wipe_, 0.0F});
        draw.AddLine({x, corner.y}, {x, end.y}, IM_COL32(0, 0, 0, 160), 4.0F);
        draw.AddLine({x, corner.y}, {x, end.y}, IM_COL32(255, 255, 255, 230), 2.0F);
        const auto label = [&](float left, const char* words) {
            const ImVec2 extent = ImGui::CalcTextSize(words);
            draw.AddRectFilled({left - 0.3F * font, corner.y + 0.3F * font},
                               {left + extent.x + 0.3F * font, corner.y + 0.7F * font + extent.y},
                               IM_COL32(0, 0, 0, 150), 3.0F);
            draw.AddText({left, corner.y + 0.5F * font}, IM_COL32(240, 240, 240, 255), words);
        };
        label(x - 0.8F * font - ImGui::CalcTextSize("saved").x, "saved");
        label(x + 0.8F * font, "now");
    }
    if (const auto& picked = session_.picked()) {
        const ImVec2 at(corner.x + picked->at.x * size.x, corner.y + picked->at.y * size.y);
        draw.AddCircle(at, 0.45F * font, IM_COL32(0, 0, 0, 255), 0, 3.5F);
        draw.AddCircle(at, 0.45F * font, IM_COL32(255, 255, 255, 255), 0, 1.5F);
    }
    if (session_.cooking() || session_.loading_light()) {
        const char* words = session_.loading_light() ? "loading the light…" : "cooking…";
        draw.AddText({corner.x + 0.6F * font, end.y - 1.6F * font}, IM_COL32(240, 240, 240, 255), words);
    }
}

void Workbench::use_mouse(const platform::InputState& input, const ImVec2& corner, const ImVec2& size) {
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const glm::vec2 at((mouse.x - corner.x) / size.x, (mouse.y - corner.y) / size.y);
    const float near_wipe = 6.0F / size.x;
    if (ImGui::IsItemActivated()) {
        moving_wipe_ = comparing_ && session_.preview().has_saved() && std::abs(at.x - wipe_) < near_wipe;
        orbiting_ = false;
    }
    const glm::vec2 drag(ImGui::GetIO().MouseDelta.x, ImGui::GetIO().MouseDelta.y);
    scene::OrbitInput orbit;
    if (ImGui::IsItemActive() && moving_wipe_) wipe_ = std::clamp(at.x, 0.0F, 1.0F);
    if (ImGui::IsItemActive() && !moving_wipe_) {
        orbiting_ = orbiting_ || ImGui::IsMouseDragging(ImGuiMouseButton_Left, 4.0F);
        if (orbiting_) orbit.drag = drag;
    }
    if (ImGui::IsItemHovered()) orbit.scroll = static_cast<float>(input.scroll().y);
    camera_.update(orbit);
    if (ImGui::IsItemDeactivated() && !moving_wipe_ && !orbiting_) session_.pick(at);
    if (ImGui::IsItemHovered() && comparing_ && std::abs(at.x - wipe_) < near_wipe)
        ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
}

void Workbench::draw_status(float top, float width, float height, double frame_ms) {
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1.0F, 1.0F});
    begin_tile("##status", 0.0F, top, width, height,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoScrollbar);
    const Document& document = session_.document();
    ImGui::TextUnformatted((document.name() + (document.dirty() ? " •" : "")).c_str());
    if (document.dirty() && ImGui::IsItemHovered()) ImGui::SetTooltip("Not saved");
    if (frame_ms > 0.0) {
        ImGui::SameLine();
        ImGui::TextDisabled("%.1f ms", frame_ms);
    }
    if (!session_.messages().empty()) {
        ImGui::SameLine();
        const Session::Message& last = session_.messages().back();
        if (last.failure)
            ImGui::TextColored(kAlert, "%s", last.text.c_str());
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

void Workbench::draw_dialogs() {
    const char* title = dialog_ == Dialog::Open ? "Open" : dialog_ == Dialog::SaveAs ? "Save as" : "Unsaved edits";
    if (open_dialog_) {
        open_dialog_ = false;
        typed_path_ = dialog_ == Dialog::SaveAs ? session_.document().path().string() : "";
        if (dialog_ == Dialog::SaveAs && typed_path_.empty())
            typed_path_ = (std::filesystem::current_path() / session_.document().name()).replace_extension(".json");
        ImGui::OpenPopup(title);
    }
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({screen.x / 2.0F, screen.y / 2.0F}, ImGuiCond_Always, {0.5F, 0.5F});
    if (!ImGui::BeginPopupModal(title, nullptr, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings))
        return;
    if (dialog_ == Dialog::Discard)
        draw_discard_dialog();
    else
        draw_path_dialog(title, dialog_ == Dialog::Open ? "Open" : "Save");
    ImGui::EndPopup();
}

void Workbench::draw_path_dialog(const char* title, const char* button) {
    std::array<char, 4096> buffer{};
    std::strncpy(buffer.data(), typed_path_.c_str(), buffer.size() - 1);
    ImGui::TextUnformatted(dialog_ == Dialog::Open
                               ? "A material, a glTF file, a probe or a table of efficiencies. Dropping it works, too."
                               : "A material file (.json).");
    ImGui::SetNextItemWidth(32.0F * ImGui::GetFontSize());
    if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
    const bool entered = ImGui::InputText("##path", buffer.data(), buffer.size(),
                                          ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
    typed_path_ = buffer.data();
    controls_.mark(std::string("path of ") + title);
    const bool pressed = ImGui::Button(button);
    controls_.mark(std::string("button ") + button);
    ImGui::SameLine();
    if (ImGui::Button("Cancel") || ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape))) {
        dialog_ = Dialog::None;
        ImGui::CloseCurrentPopup();
        return;
    }
    if (!(entered || pressed) || typed_path_.empty()) return;
    ImGui::CloseCurrentPopup();
    const std::filesystem::path path = typed_path_;
    if (std::exchange(dialog_, Dialog::None) == Dialog::Open)
        unless_lost([this, path] { session_.open(path); });
    else
        session_.save_as(path);
}

void Workbench::draw_discard_dialog() {
    ImGui::Text("%s has edits that no file holds.", session_.document().name().c_str());
    const auto choice = [&](const char* name) {
        const bool chosen = ImGui::Button(name);
        controls_.mark(std::string("button ") + name);
        ImGui::SameLine();
        return chosen;
    };
    if (choice("Keep editing") || ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape))) {
        dialog_ = Dialog::None;
        ImGui::CloseCurrentPopup();
    } else if (choice("Discard them")) {
        dialog_ = Dialog::None;
        ImGui::CloseCurrentPopup();
        std::exchange(after_discard_, nullptr)();
    }
    ImGui::NewLine();
}

}  // namespace rowland::inspector
