#include "editor/inspector/dialogs.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <system_error>
#include <utility>

#include "engine/core/system.h"

namespace rowland::inspector {

namespace {

/// ASCII letters in lower case; other bytes as they are.
std::string lower(std::string text) {
    std::ranges::transform(text, text.begin(),
                           [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
    return text;
}

/// Whether file_kind_name() lists the extension.
bool lists_extension(FileKind kind, const std::string& extension) {
    const std::string name = file_kind_name(kind);
    return !extension.empty() &&
           (name.find(extension + ",") != std::string::npos || name.find(extension + ")") != std::string::npos);
}

/// The longest common beginning of all names.
std::string common_beginning(const std::vector<ListedFile>& files) {
    if (files.empty()) return {};
    std::string common = files.front().name;
    for (const ListedFile& file : files)
        common.resize(static_cast<std::size_t>(std::ranges::mismatch(common, file.name).in1 - common.begin()));
    return common;
}

bool named_button(const char* name, ControlMap& controls) {
    const bool pressed = ImGui::Button(name);
    controls.mark(std::string("button ") + name);
    return pressed;
}

bool escape_pressed() {
    return ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape));
}

/// Tab in the path's field: completes the longest common beginning of all listed names.
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

const char* file_kind_name(FileKind kind) {
    constexpr std::array kNames = {"all kinds",
                                   "materials (.json)",
                                   "models (.gltf, .glb)",
                                   "lights (.hdr, .exr, .pic, .json)",
                                   "tables of efficiencies (.csv)",
                                   "pictures (.png, .jpg, .jpeg)",
                                   "films (.webp)"};
    return kNames.at(static_cast<std::size_t>(kind));
}

bool is_of_kind(const std::filesystem::path& file, FileKind kind) {
    const std::string extension = lower(file.extension().string());
    if (kind != FileKind::All) return lists_extension(kind, extension);
    return std::ranges::any_of(kFileKinds, [&](FileKind each) { return lists_extension(each, extension); });
}

std::filesystem::path resolved(const std::string& typed, const std::filesystem::path& folder) {
    const auto home = typed.starts_with("~/") ? home_folder() : std::nullopt;
    if (home) return *home / typed.substr(2);
    return folder / typed;
}

FileList list_files(const std::string& typed, const std::filesystem::path& folder, FileKind kind) {
    const std::filesystem::path path = resolved(typed, folder);
    const std::string beginning = path.filename().string();
    FileList list{.folder = path.parent_path(), .files = {}, .completed = typed};
    std::error_code failure;
    std::filesystem::directory_iterator entry(list.folder, failure);
    for (; !failure && entry != std::filesystem::directory_iterator(); entry.increment(failure)) {
        const std::string name = entry->path().filename().string();
        if (!lower(name).starts_with(lower(beginning)) || (name.starts_with('.') && !beginning.starts_with('.')))
            continue;
        std::error_code unknown;
        const bool is_folder = entry->is_directory(unknown);
        if (is_folder || is_of_kind(name, kind)) list.files.push_back({name, is_folder});
    }
    std::ranges::sort(list.files, [](const ListedFile& a, const ListedFile& b) {
        return a.folder != b.folder ? a.folder : std::pair(lower(a.name), a.name) < std::pair(lower(b.name), b.name);
    });
    const std::string common = common_beginning(list.files);
    if (common.size() >= beginning.size() && !list.files.empty())
        list.completed = typed.substr(0, typed.size() - beginning.size()) + common +
                         (list.files.size() == 1 && list.files.front().folder ? "/" : "");
    return list;
}

void Dialogs::ask(Kind kind, std::string path) {
    kind_ = kind;
    path_ = std::move(path);
    folder_ = std::filesystem::current_path();
    replaced_.clear();
    use_ = nullptr;
    asked_ = focus_path_ = true;
}

std::string Dialogs::folder_of_recent() const {
    const auto& recent = layout_.recent;
    const std::filesystem::path folder =
        recent.empty() ? std::filesystem::current_path() : std::filesystem::path(recent.front()).parent_path();
    return with_slash(is_folder(folder) ? folder : std::filesystem::current_path());
}

void Dialogs::ask_open() {
    shown_ = FileKind::All;
    words_ = "Type a path (Tab completes it) or choose a file. Files may be dropped onto the window.";
    ask(Kind::Open, folder_of_recent());
}

void Dialogs::ask_picture(std::string words, Use use) {
    shown_ = FileKind::Pictures;
    words_ = std::move(words);
    ask(Kind::Open, folder_of_recent());
    use_ = std::move(use);
}

void Dialogs::ask_file(FileKind kind, std::string words, const std::filesystem::path& suggested, Use use) {
    after_ = nullptr;
    shown_ = kind;
    words_ = std::move(words);
    ask(Kind::SaveAs, suggested.string());
    use_ = std::move(use);
}

void Dialogs::ask_save_as(std::function<void()> after) {
    if (FoilStudio* const foil = session_.foil.get()) {
        ask_file(FileKind::Materials, "A foil recipe (.json).", foil->recipe().suggested(".json"),
                 [this](const std::filesystem::path& path) {
                     session_.foil->save(path);
                     if (session_.foil->recipe().dirty()) return;
                     remember(layout_, path);
                     if (const auto next = std::exchange(after_, nullptr)) next();
                 });
        after_ = std::move(after);
        return;
    }
    const Document& document = session_.opened.document();
    after_ = std::move(after);
    shown_ = document.is_scene() ? FileKind::Models : FileKind::Materials;
    words_ = document.is_scene() ? "A glTF file (.gltf, .glb)." : "A material file (.json).";
    ask(Kind::SaveAs, document.path().empty()
                          ? (std::filesystem::current_path() / document.name()).replace_extension(".json").string()
                          : std::filesystem::absolute(document.path()).string());
}

void Dialogs::open(const std::filesystem::path& path) {
    const auto now = [this, path] {
        const auto last_refusal = [this] {
            const Message* last = session_.messages.all().empty() ? nullptr : &session_.messages.all().back();
            return last != nullptr && last->failure ? std::optional(last->number) : std::nullopt;
        };
        const auto before = last_refusal();
        session_.open(path);
        if (last_refusal() == before) remember(layout_, path);
    };
    session_.is_replaced_by(path) ? ask_unsaved(now) : now();
}

void Dialogs::save(std::function<void()> after) {
    if (FoilStudio* const foil = session_.foil.get()) {
        if (foil->recipe().path().empty()) return ask_save_as(std::move(after));
        foil->save(foil->recipe().path());
        if (after && !foil->recipe().dirty()) after();
        return;
    }
    if (session_.opened.document().path().empty()) return ask_save_as(std::move(after));
    session_.opened.save();
    if (after && !session_.opened.document().dirty()) after();
}

void Dialogs::ask_unsaved(std::function<void()> action) {
    const Document& document = session_.opened.document();
    const bool edited = session_.foil ? session_.foil->recipe().dirty() : document.dirty() && document.can_undo();
    if (!edited) return action();
    after_ = std::move(action);
    ask(Kind::Unsaved, {});
}

void Dialogs::offer_recovery(const std::filesystem::path& unsaved) {
    ask(Kind::Recovery, unsaved.string());
}

void Dialogs::draw(ControlMap& controls) {
    draw_overwrite(controls);
    constexpr std::array kTitles = {"Open", "Save as", "Unsaved edits", "Recovery"};
    const char* title = kTitles.at(static_cast<std::size_t>(kind_));
    if (std::exchange(asked_, false)) ImGui::OpenPopup(title);
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({screen.x / 2.0F, screen.y / 2.0F}, ImGuiCond_Always, {0.5F, 0.5F});
    if (!ImGui::BeginPopupModal(title, nullptr, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings))
        return;
    switch (kind_) {
        case Kind::Unsaved:
            draw_unsaved(controls);
            break;
        case Kind::Recovery:
            draw_recovery(controls);
            break;
        default:
            draw_file(controls);
    }
    ImGui::EndPopup();
}

void Dialogs::draw_file(ControlMap& controls) {
    const bool opens = kind_ == Kind::Open;
    const FileList list = list_files(path_, folder_, shown_);
    ImGui::TextUnformatted(words_.c_str());
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
    if (std::exchange(focus_path_, false)) ImGui::SetKeyboardFocusHere();
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
            focus_path_ = name.ends_with('/');
            if (!focus_path_ && kind_ == Kind::Open) choose(path_);
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
    if (use_) return;
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
        if (ImGui::Selectable(fmt::format("{}##{}", name, path).c_str(), false, ImGuiSelectableFlags_DontClosePopups))
            choose(path);
        controls.mark("recent " + name);
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", path.c_str());
    }
    ImGui::EndChild();
}

void Dialogs::choose(const std::filesystem::path& path) {
    if (is_folder(path)) {
        path_ = with_slash(path);
        focus_path_ = true;
        return;
    }
    std::error_code ignored;
    const std::filesystem::path& saved =
        session_.foil ? session_.foil->recipe().path() : session_.opened.document().path();
    const bool own = std::filesystem::equivalent(path, saved, ignored);
    if (kind_ == Kind::SaveAs && !own && replaced_ != path && std::filesystem::exists(path, ignored)) {
        replaced_ = path;
        focus_path_ = true;
        return;
    }
    ImGui::CloseCurrentPopup();
    if (const Use use = std::exchange(use_, nullptr)) return use(path);
    if (kind_ == Kind::Open) return open(path);
    session_.opened.save_as(path);
    if (session_.opened.document().dirty()) return;
    remember(layout_, path);
    if (const auto after = std::exchange(after_, nullptr)) after();
}

void Dialogs::draw_unsaved(ControlMap& controls) {
    ImGui::Text("%s has unsaved edits.", session_.document_name().c_str());
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

void Dialogs::draw_recovery(ControlMap& controls) {
    ImGui::TextUnformatted("The last session ended before its edits were saved. They are in:");
    ImGui::TextUnformatted(path_.c_str());
    const bool opens = named_button("Open them", controls);
    ImGui::SameLine();
    const bool keeps = named_button("Keep the file", controls) || escape_pressed();
    ImGui::SameLine();
    const bool removes = named_button("Delete the file", controls);
    if (!opens && !keeps && !removes) return;
    ImGui::CloseCurrentPopup();
    if (opens) open(path_);
    std::error_code ignored;
    if (removes) std::filesystem::remove(path_, ignored);
}

void Dialogs::draw_overwrite(ControlMap& controls) {
    constexpr const char* kTitle = "Changed by another program";
    if (session_.opened.asks_to_overwrite && !ImGui::IsPopupOpen(kTitle)) ImGui::OpenPopup(kTitle);
    if (!ImGui::BeginPopupModal(kTitle, nullptr, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings))
        return;
    ImGui::Text("%s was changed since it was opened here.", session_.opened.document().name().c_str());
    ImGui::TextDisabled("Overwriting loses those changes. To keep both, save under another name.");
    const bool overwrite = named_button("Overwrite", controls);
    ImGui::SameLine();
    const bool keep = named_button("Keep editing", controls);
    if (overwrite || keep) {
        session_.opened.asks_to_overwrite = false;
        ImGui::CloseCurrentPopup();
    }
    if (overwrite) session_.opened.save(true);
    ImGui::EndPopup();
}

}  // namespace rowland::inspector
