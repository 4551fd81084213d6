#include "engine/core/hash.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <new>

namespace rowland {

std::string Hash128::hex() const {
    return fmt::format("{:016x}{:016x}", high, low);
}

struct Hasher::State {
    XXH3_state_t* xxh;
};

Hasher::Hasher() : state_(std::make_unique<State>(State{XXH3_createState()})) {
    if (state_->xxh == nullptr) throw std::bad_alloc();
    XXH3_128bits_reset(state_->xxh);
}

Hasher::~Hasher() {
    XXH3_freeState(state_->xxh);
}

Hasher& Hasher::bytes(std::span<const std::byte> data) {
    XXH3_128bits_update(state_->xxh, data.data(), data.size());
    return *this;
}

Hasher& Hasher::text(std::string_view data) {
    const std::uint64_t size = data.size();
    XXH3_128bits_update(state_->xxh, &size, sizeof size);
    XXH3_128bits_update(state_->xxh, data.data(), data.size());
    return *this;
}

Hash128 Hasher::digest() const {
    const XXH128_hash_t value = XXH3_128bits_digest(state_->xxh);
    return {value.low64, value.high64};
}

}  // namespace rowland
