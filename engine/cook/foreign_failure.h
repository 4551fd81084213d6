#pragma once

#include <exception>
#include <filesystem>
#include <new>
#include <string>
#include <utility>

#include "engine/core/error.h"

namespace rowland::cook {

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
