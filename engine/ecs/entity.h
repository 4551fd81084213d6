#pragma once

#include <cstdint>

namespace rowland::ecs {

/// A versioned id: the index is reused after destroy(), the version is not, so a stale id is never mistaken for a live
/// entity.
struct Entity {
    static constexpr std::uint32_t kNoIndex = 0xFFFFFFFFU;

    std::uint32_t index = kNoIndex;
    std::uint32_t version = 0;

    friend bool operator==(const Entity&, const Entity&) = default;
};

}  // namespace rowland::ecs
