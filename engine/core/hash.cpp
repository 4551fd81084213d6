#include "engine/core/hash.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <new>

namespace rowland {

std::string Hash128::hex() const {
    return fmt::format("{:016x}{:016x}", high, low);
}

Hasher::Hasher() : state_(XXH3_createState(), [](XXH3_state_s* state) { XXH3_freeState(state); }) {
    if (state_ == nullptr) throw std::bad_alloc();
    XXH3_128bits_reset(state_.get());
}

Hasher& Hasher::bytes(std::span<const std::byte> data) {
    XXH3_128bits_update(state_.get(), data.data(), data.size());
    return *this;
}

Hasher& Hasher::text(std::string_view data) {
    const std::uint64_t size = data.size();
    XXH3_128bits_update(state_.get(), &size, sizeof size);
    XXH3_128bits_update(state_.get(), data.data(), data.size());
    return *this;
}

Hash128 Hasher::digest() const {
    const XXH128_hash_t value = XXH3_128bits_digest(state_.get());
    return {value.low64, value.high64};
}

}  // namespace rowland
