#include "editor/inspector/overwrite_question.h"

#include <imgui.h>

namespace rowland::inspector {

void draw_overwrite_question(Session& session, ControlMap& controls) {
    constexpr const char* kTitle = "Changed by another program";
    if (session.asks_to_overwrite && !ImGui::IsPopupOpen(kTitle)) ImGui::OpenPopup(kTitle);
    if (!ImGui::BeginPopupModal(kTitle, nullptr, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings))
        return;
    ImGui::Text("%s was changed since it was opened here.", session.document().name().c_str());
    ImGui::TextDisabled("Overwriting loses those changes. To keep both, save under another name.");
    const bool overwrite = ImGui::Button("Overwrite");
    controls.mark("button Overwrite");
    ImGui::SameLine();
    const bool keep = ImGui::Button("Keep editing");
    controls.mark("button Keep editing");
    if (overwrite || keep) {
        session.asks_to_overwrite = false;
        ImGui::CloseCurrentPopup();
    }
    if (overwrite) session.save(true);
    ImGui::EndPopup();
}

}  // namespace rowland::inspector
