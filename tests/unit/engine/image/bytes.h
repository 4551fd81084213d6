#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace rowland::test {

inline std::span<const std::byte> as_bytes(std::string_view text) {
    return std::as_bytes(std::span(text.data(), text.size()));
}

}  // namespace rowland::test
