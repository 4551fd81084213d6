#pragma once

#include <filesystem>
#include <string>

#include "engine/cook/registry.h"

namespace rowland::cook {

/// Loads a source, or a cooked asset (recognised by its magic), as the engine would. Returns its kind, such as "probe
/// source" or "cooked probe". Throws Error (input) if it is refused or of no known kind. Other exceptions of a loader
/// become such an Error.
std::string check_file(const Registry& registry, const std::filesystem::path& path);

/// What a cooked asset holds, a "name: value" line each: its header, then its payload as its type describes it.
/// Throws Error (input) like check_file, and for a source.
std::string describe_file(const Registry& registry, const std::filesystem::path& path);

}  // namespace rowland::cook
