#include "engine/asset/store.h"

#include <algorithm>

#include "engine/core/log.h"

namespace rowland::asset {

bool Store::poll() {
    std::erase_if(slots_, [](const std::weak_ptr<Slot>& slot) { return slot.expired(); });
    const auto now = std::chrono::steady_clock::now();
    const bool look = now - last_look_ >= interval_;
    if (look) last_look_ = now;
    bool news = false;
    for (const std::shared_ptr<Slot>& slot : held()) {
        const bool was_loading = slot->loading();
        const bool replaced = slot->adopt();
        if (was_loading && !slot->loading()) {
            news = true;
            if (replaced)
                log_info("reloaded {}", slot->name);
            else
                log_error("{} stays as it was: {}", slot->name, slot->failure);
        }
        if (look && !slot->loading() && slot->watch.changed()) slot->start_loading();
    }
    return news;
}

void Store::reload_all() {
    for (const std::shared_ptr<Slot>& slot : held())
        if (!slot->loading()) slot->start_loading();
}

void Store::wait() const {
    for (const std::shared_ptr<Slot>& slot : held()) slot->wait();
}

std::vector<std::string> Store::failures() const {
    std::vector<std::string> result;
    for (const std::shared_ptr<Slot>& slot : held())
        if (!slot->failure.empty()) result.push_back(slot->name + ": " + slot->failure);
    return result;
}

std::shared_ptr<Slot> Store::find(const std::string& name) const {
    for (const std::shared_ptr<Slot>& slot : held())
        if (slot->name == name) return slot;
    return nullptr;
}

std::vector<std::shared_ptr<Slot>> Store::held() const {
    std::vector<std::shared_ptr<Slot>> result;
    for (const std::weak_ptr<Slot>& weak : slots_)
        if (std::shared_ptr<Slot> slot = weak.lock()) result.push_back(std::move(slot));
    return result;
}

}  // namespace rowland::asset
