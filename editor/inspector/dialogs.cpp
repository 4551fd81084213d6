#include "editor/inspector/dialogs.h"

#include <imgui.h>

#include <array>
#include <cstring>
#include <filesystem>
#include <utility>

namespace rowland::inspector {

namespace {

bool named_button(const char* name, ControlMap& controls) {
    const bool pressed = ImGui::Button(name);
    controls.mark(std::string("button ") + name);
    return pressed;
}

bool escape_pressed() {
    return ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape));
}

}  // namespace

void Dialogs::ask(Kind kind, std::string path) {
    kind_ = kind;
    path_ = std::move(path);
    asked_ = true;
}

void Dialogs::ask_save_as() {
    const Document& document = session_.document();
    ask(Kind::SaveAs, document.path().empty()
                          ? (std::filesystem::current_path() / document.name()).replace_extension(".json").string()
                          : document.path().string());
}

void Dialogs::save() {
    session_.document().path().empty() ? ask_save_as() : session_.save();
}

void Dialogs::unless_lost(std::function<void()> action) {
    const Document& document = session_.document();
    if (!document.dirty() || !document.can_undo()) return action();
    after_discard_ = std::move(action);
    ask(Kind::Discard, {});
}

void Dialogs::draw(ControlMap& controls) {
    const char* title = kind_ == Kind::Open ? "Open" : kind_ == Kind::SaveAs ? "Save as" : "Unsaved edits";
    if (std::exchange(asked_, false)) ImGui::OpenPopup(title);
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({screen.x / 2.0F, screen.y / 2.0F}, ImGuiCond_Always, {0.5F, 0.5F});
    if (!ImGui::BeginPopupModal(title, nullptr, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings))
        return;
    if (kind_ == Kind::Discard)
        draw_discard(controls);
    else
        draw_path(kind_ == Kind::Open ? "Open" : "Save", controls);
    ImGui::EndPopup();
}

void Dialogs::draw_path(const char* button, ControlMap& controls) {
    const bool opens = kind_ == Kind::Open;
    std::array<char, 4096> buffer{};
    std::strncpy(buffer.data(), path_.c_str(), buffer.size() - 1);
    ImGui::TextUnformatted(opens ? "A material, a glTF file, a probe or a table of efficiencies. Or drop the file "
                                   "onto the window."
                                 : "A material file (.json).");
    ImGui::SetNextItemWidth(32.0F * ImGui::GetFontSize());
    if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
    const bool entered = ImGui::InputText("##path", buffer.data(), buffer.size(),
                                          ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
    path_ = buffer.data();
    controls.mark(opens ? "path of Open" : "path of Save as");
    const bool pressed = named_button(button, controls);
    ImGui::SameLine();
    if (ImGui::Button("Cancel") || escape_pressed()) return ImGui::CloseCurrentPopup();
    if (!(entered || pressed) || path_.empty()) return;
    ImGui::CloseCurrentPopup();
    if (opens)
        unless_lost([this, path = path_] { session_.open(path); });
    else
        session_.save_as(path_);
}

void Dialogs::draw_discard(ControlMap& controls) {
    ImGui::Text("%s has unsaved edits.", session_.document().name().c_str());
    const bool keep = named_button("Keep editing", controls) || escape_pressed();
    ImGui::SameLine();
    const bool discard = named_button("Discard them", controls);
    if (keep || discard) ImGui::CloseCurrentPopup();
    if (discard && !keep) std::exchange(after_discard_, nullptr)();
}

}  // namespace rowland::inspector
