#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

struct XXH3_state_s;  // of xxhash.h

namespace rowland {

/// 128-bit content hash (XXH3).
struct Hash128 {
    std::uint64_t low = 0;
    std::uint64_t high = 0;

    friend bool operator==(const Hash128&, const Hash128&) = default;
    std::string hex() const;  ///< 32 lower-case digits
};

/// Incremental content hash. Strings are hashed with their length, so ("ab","c") differs from ("a","bc").
class Hasher {
 public:
    Hasher();

    Hasher& bytes(std::span<const std::byte> data);
    Hasher& text(std::string_view data);
    Hash128 digest() const;

 private:
    std::unique_ptr<XXH3_state_s, void (*)(XXH3_state_s*)> state_;
};

}  // namespace rowland
