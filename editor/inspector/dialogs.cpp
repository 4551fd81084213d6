#include "editor/inspector/dialogs.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cstring>
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

/// Tab in the path's field: types as much as all listed names have in common.
int complete_path(ImGuiInputTextCallbackData* field) {
    const auto& completed = *static_cast<const std::string*>(field->UserData);
    field->DeleteChars(0, field->BufTextLen);
    field->InsertChars(0, completed.c_str());
    return 0;
}

bool is_folder(const std::filesystem::path& path) {
    std::error_code ignored;
    return std::filesystem::is_directory(path, ignored);
}

std::string with_slash(const std::filesystem::path& folder) {
    return (folder / "").string();
}

}  // namespace

void Dialogs::ask(Kind kind, std::string path) {
    kind_ = kind;
    path_ = std::move(path);
    folder_ = std::filesystem::current_path();
    replaced_.clear();
    asked_ = type_ = true;
}

void Dialogs::ask_open() {
    const auto& recent = layout_.recent;
    const std::filesystem::path folder =
        recent.empty() ? std::filesystem::current_path() : std::filesystem::path(recent.front()).parent_path();
    shown_ = FileKind::All;
    ask(Kind::Open, with_slash(is_folder(folder) ? folder : std::filesystem::current_path()));
}

void Dialogs::ask_save_as(std::function<void()> after) {
    const Document& document = session_.document();
    after_ = std::move(after);
    shown_ = document.is_scene() ? FileKind::Models : FileKind::Materials;
    ask(Kind::SaveAs, document.path().empty()
                          ? (std::filesystem::current_path() / document.name()).replace_extension(".json").string()
                          : std::filesystem::absolute(document.path()).string());
}

void Dialogs::open(const std::filesystem::path& path) {
    const auto now = [this, path] {
        const auto last_refusal = [this] {
            const Message* last = session_.messages().empty() ? nullptr : &session_.messages().back();
            return last != nullptr && last->failure ? std::optional(last->number) : std::nullopt;
        };
        const auto before = last_refusal();
        session_.open(path);
        if (last_refusal() == before) remember(layout_, path);
    };
    session_.replaces_document(path) ? unless_lost(now) : now();
}

void Dialogs::save(std::function<void()> after) {
    if (session_.document().path().empty()) return ask_save_as(std::move(after));
    session_.save();
    if (after && !session_.document().dirty()) after();
}

void Dialogs::unless_lost(std::function<void()> action) {
    const Document& document = session_.document();
    if (!document.dirty() || !document.can_undo()) return action();
    after_ = std::move(action);
    ask(Kind::Unsaved, {});
}

void Dialogs::draw(ControlMap& controls) {
    const char* title = kind_ == Kind::Open ? "Open" : kind_ == Kind::SaveAs ? "Save as" : "Unsaved edits";
    if (std::exchange(asked_, false)) ImGui::OpenPopup(title);
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({screen.x / 2.0F, screen.y / 2.0F}, ImGuiCond_Always, {0.5F, 0.5F});
    if (!ImGui::BeginPopupModal(title, nullptr, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings))
        return;
    kind_ == Kind::Unsaved ? draw_unsaved(controls) : draw_file(controls);
    ImGui::EndPopup();
}

void Dialogs::draw_file(ControlMap& controls) {
    const bool opens = kind_ == Kind::Open;
    const FileList list = list_files(path_, folder_, shown_);
    ImGui::TextUnformatted(
        opens ? "Type a path (Tab completes it) or choose a file. Files may be dropped onto the window."
        : session_.document().is_scene() ? "A glTF file (.gltf, .glb)."
                                         : "A material file (.json).");
    const bool entered = draw_path(list, controls);
    draw_list(list, controls);
    if (opens && !layout_.recent.empty()) {
        ImGui::SameLine();
        draw_recent(controls);
    }
    if (opens) draw_kinds(controls);
    const bool replaces = !replaced_.empty() && replaced_ == resolved(path_, folder_);
    if (replaces) ImGui::Text("%s exists.", replaced_.filename().string().c_str());
    const bool pressed = named_button(opens ? "Open" : replaces ? "Replace" : "Save", controls);
    ImGui::SameLine();
    if (named_button("Cancel", controls) || escape_pressed()) {
        after_ = nullptr;
        return ImGui::CloseCurrentPopup();
    }
    if ((entered || pressed) && !path_.empty()) choose(resolved(path_, folder_));
}

bool Dialogs::draw_path(const FileList& list, ControlMap& controls) {
    std::array<char, 4096> buffer{};
    std::strncpy(buffer.data(), path_.c_str(), buffer.size() - 1);
    ImGui::SetNextItemWidth(44.0F * ImGui::GetFontSize());
    if (std::exchange(type_, false)) ImGui::SetKeyboardFocusHere();
    std::string completed = list.completed;
    const bool entered = ImGui::InputText("##path", buffer.data(), buffer.size(),
                                          ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll |
                                              ImGuiInputTextFlags_CallbackCompletion,
                                          complete_path, &completed);
    path_ = buffer.data();
    controls.mark(kind_ == Kind::Open ? "path of Open" : "path of Save as");
    return entered;
}

void Dialogs::draw_list(const FileList& list, ControlMap& controls) {
    const float font = ImGui::GetFontSize();
    const bool recent = kind_ == Kind::Open && !layout_.recent.empty();
    ImGui::BeginChild("files", {(recent ? 26.0F : 44.0F) * font, 15.0F * font}, true);
    ImGui::TextDisabled("%s", list.folder.string().c_str());
    const auto row = [&](const std::string& name, const std::string& path) {
        if (ImGui::Selectable(name.c_str(), false, ImGuiSelectableFlags_DontClosePopups)) {
            path_ = path;
            type_ = name.ends_with('/');
            if (!type_ && kind_ == Kind::Open) choose(path_);
        }
        controls.mark("file " + name);
    };
    row("../", with_slash(list.folder.parent_path()));
    for (const ListedFile& file : list.files) {
        const std::filesystem::path path = list.folder / file.name;
        row(file.folder ? file.name + "/" : file.name, file.folder ? with_slash(path) : path.string());
    }
    ImGui::EndChild();
}

void Dialogs::draw_kinds(ControlMap& controls) {
    ImGui::SetNextItemWidth(20.0F * ImGui::GetFontSize());
    if (ImGui::BeginCombo("##kind", file_kind_name(shown_))) {
        for (const FileKind kind : kFileKinds) {
            if (ImGui::Selectable(file_kind_name(kind), kind == shown_)) shown_ = kind;
            controls.mark(std::string("kind=") + file_kind_name(kind));
        }
        ImGui::EndCombo();
    }
    controls.mark("kind of files");
}

void Dialogs::draw_recent(ControlMap& controls) {
    const float font = ImGui::GetFontSize();
    ImGui::BeginChild("recent", {0.0F, 15.0F * font}, true);
    ImGui::TextDisabled("Opened last");
    for (const std::string& path : layout_.recent) {
        const std::string name = std::filesystem::path(path).filename().string();
        if (ImGui::Selectable((name + "##" + path).c_str(), false, ImGuiSelectableFlags_DontClosePopups)) choose(path);
        controls.mark("recent " + name);
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", path.c_str());
    }
    ImGui::EndChild();
}

void Dialogs::choose(const std::filesystem::path& path) {
    if (is_folder(path)) {
        path_ = with_slash(path);
        type_ = true;
        return;
    }
    std::error_code ignored;
    const bool own = std::filesystem::equivalent(path, session_.document().path(), ignored);
    if (kind_ == Kind::SaveAs && !own && replaced_ != path && std::filesystem::exists(path, ignored)) {
        replaced_ = path;
        type_ = true;
        return;
    }
    ImGui::CloseCurrentPopup();
    if (kind_ == Kind::Open) return open(path);
    session_.save_as(path);
    if (session_.document().dirty()) return;
    remember(layout_, path);
    if (const auto after = std::exchange(after_, nullptr)) after();
}

void Dialogs::draw_unsaved(ControlMap& controls) {
    ImGui::Text("%s has unsaved edits.", session_.document().name().c_str());
    const bool saves = named_button("Save", controls);
    ImGui::SameLine();
    const bool discards = named_button("Discard", controls);
    ImGui::SameLine();
    const bool stays = named_button("Cancel", controls) || escape_pressed();
    if (!saves && !discards && !stays) return;
    ImGui::CloseCurrentPopup();
    auto action = std::exchange(after_, nullptr);
    if (stays) return;
    saves ? save(std::move(action)) : action();
}

}  // namespace rowland::inspector
