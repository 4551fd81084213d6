#include "engine/gpu/bound_state.h"

namespace rowland::gpu {

bool BoundState::changes(Slot slot, unsigned index, const Value& value) {
    const auto [known, is_new] = values_.try_emplace({slot, index}, value);
    if (!is_new && known->second == value) return false;
    known->second = value;
    return true;
}

void BoundState::forget(Slot slot, GLuint name) {
    std::erase_if(values_, [&](const auto& known) { return known.first.first == slot && known.second[0] == name; });
}

BoundState& bound_state() {
    thread_local BoundState state;
    return state;
}

void forget_bound_state() {
    bound_state().forget_all();
}

}  // namespace rowland::gpu
