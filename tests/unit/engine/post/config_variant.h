#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <utility>

#include "engine/core/check.h"
#include "engine/core/file.h"
#include "engine/post/ocio_config.h"

namespace rowland::test {

/// Writes the shipped configuration with some of its text replaced, and gives its path. Every text must be there.
inline std::filesystem::path write_variant(const std::filesystem::path& folder,
                                           std::initializer_list<std::pair<std::string, std::string>> replacements) {
    std::string text(post::shipped_config_file().front().text);
    for (const auto& [from, to] : replacements) {
        const std::size_t place = text.find(from);
        ROWLAND_CHECK(place != std::string::npos, from);
        text.replace(place, from.size(), to);
    }
    write_file_atomic(folder / "variant.ocio", text);
    return folder / "variant.ocio";
}

}  // namespace rowland::test
