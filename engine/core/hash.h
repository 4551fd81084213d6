#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

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
    ~Hasher();
    Hasher(const Hasher&) = delete;
    Hasher& operator=(const Hasher&) = delete;

    Hasher& bytes(std::span<const std::byte> data);
    Hasher& text(std::string_view data);
    Hash128 digest() const;

 private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace rowland
