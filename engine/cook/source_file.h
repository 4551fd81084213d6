#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <new>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/file.h"

namespace rowland::cook {

/// The largest source, so that a sparse file of terabytes does not occupy a cook for hours.
inline constexpr std::uint64_t kMaximumSourceBytes = std::uint64_t{1} << 30;

/// Content hash of a file, or null if it is no regular file, unreadable or larger than kMaximumSourceBytes.
std::optional<Hash128> hash_file(const std::filesystem::path& path);

/// Throws Error (system): a file has changed since the cook first read it.
[[noreturn]] void fail_changed(const std::filesystem::path& path);

/// The first `size` bytes of a file, or all of a shorter one. Throws Error (input) for inputs that no loader accepts:
/// an empty file, a folder, a pipe, a device, a file that cannot be read.
std::vector<std::byte> read_beginning(const std::filesystem::path& path, std::size_t size);

/// Runs a loader on `file`. Exceptions of the libraries it uses become an Error (input).
template <typename Loader>
decltype(auto) as_refusal_of(const std::filesystem::path& file, const Loader& loader) {
    const auto refuse = [&file](std::string reason) {
        return Error({.file = file.string(),
                      .location = {},
                      .found = std::move(reason),
                      .expected = "a sane file",
                      .remedy = {}});
    };
    try {
        return loader();
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw refuse("needs more memory than there is");
    } catch (const std::exception& error) {
        throw refuse(error.what());
    }
}

}  // namespace rowland::cook
