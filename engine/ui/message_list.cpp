#include "engine/ui/message_list.h"

#include <imgui.h>

#include <algorithm>

namespace rowland::ui {

std::vector<const Message*> UnreadMessages::unread(std::span<const Message> all, Clock::time_point now) {
    constexpr std::chrono::seconds kNews(5);
    constexpr std::size_t kMost = 4;
    std::erase_if(shown_, [&](const Shown& shown) { return now >= shown.until; });
    std::vector<const Message*> result;
    for (const Message& message : all) {
        if (message.number >= next_) {
            next_ = message.number + 1;
            if (!message.failure) shown_.push_back({message.number, now + kNews});
        }
        const bool open = message.failure || std::ranges::find(shown_, message.number, &Shown::number) != shown_.end();
        if (open && !closed_.contains(message.number)) result.push_back(&message);
    }
    if (result.size() > kMost) result.erase(result.begin(), result.end() - kMost);
    return result;
}

void MessageList::draw(std::span<const Message> all, float right, float bottom, float width) {
    const std::vector<const Message*> open = unread_.unread(all, UnreadMessages::Clock::now());
    shown_ = open.size();
    if (open.empty()) return;
    ImGui::SetNextWindowPos({right, bottom}, ImGuiCond_Always, {1.0F, 1.0F});
    ImGui::SetNextWindowSize({width, 0.0F});
    ImGui::SetNextWindowBgAlpha(0.96F);
    // A list of news alone lets the mouse through to what it covers.
    const bool closes = std::ranges::any_of(open, &Message::failure);
    ImGui::Begin("##messages", nullptr,
                 (closes ? ImGuiWindowFlags_None : ImGuiWindowFlags_NoInputs) | ImGuiWindowFlags_NoTitleBar |
                     ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_AlwaysAutoResize |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing);
    for (const Message* message : open) {
        ImGui::PushID(static_cast<int>(message->number));
        if (message->failure) {
            if (ImGui::SmallButton("×")) unread_.close(*message);
            ImGui::SameLine();
        }
        ImGui::PushTextWrapPos(0.0F);
        if (message->failure)
            ImGui::TextColored({0.95F, 0.60F, 0.15F, 1.0F}, "%s", message->text.c_str());
        else
            ImGui::TextUnformatted(message->text.c_str());
        ImGui::PopTextWrapPos();
        ImGui::PopID();
    }
    ImGui::End();
}

}  // namespace rowland::ui
