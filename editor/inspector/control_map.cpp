#include "editor/inspector/control_map.h"

#include <fmt/format.h>
#include <imgui.h>

#include <fstream>

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/core/log.h"

namespace rowland::inspector {

void ControlMap::mark(const std::string& name) {
    const ImVec2 low = ImGui::GetItemRectMin();
    const ImVec2 high = ImGui::GetItemRectMax();
    if (file_) entries_[name] = fmt::format("{:.0f} {:.0f} {:.0f} {:.0f}", low.x, low.y, high.x, high.y);
}

void ControlMap::note(const std::string& name, const std::string& value) {
    if (file_) entries_[name] = value;
}

void ControlMap::end_frame() {
    if (!file_) return;
    std::string text;
    for (const auto& [name, entry] : entries_) text += fmt::format("{}\t{}\n", name, entry);
    entries_.clear();
    std::ofstream(std::filesystem::path(*file_) += ".frames") << ++frames_ << '\n';
    if (text == written_) return;
    try {
        write_file_atomic(*file_, text);
        written_ = std::move(text);
    } catch (const Error& error) {
        log_error("{}", error.what());
        file_.reset();
    }
}

}  // namespace rowland::inspector
