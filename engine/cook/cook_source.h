#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/asset/container.h"
#include "engine/cook/registry.h"

namespace rowland::cook {

/// Version of the cooker, a part of every content hash.
std::string_view tool_version();

/// The text of a Makefile-syntax dependency file as make, ninja and CMake read it: `output: dependency...`.
/// `output` is written unchanged, since the build system knows it by that name; dependencies are made absolute.
/// Throws Error (input) for a name with a line break, which the syntax cannot express.
std::string depfile_text(const std::filesystem::path& output, const std::vector<std::filesystem::path>& dependencies);

/// A source baked in memory.
struct BakedAsset {
    asset::CookedAsset asset;
    bool in_container = true;  ///< false: the payload is the cooked file
    std::vector<std::filesystem::path> dependencies;
};

/// The content hash of an asset whose dependencies, the source first, have these hashes (hash_file()).
Hash128 content_hash(const AssetType& type, std::span<const Hash128> dependencies);

/// Bakes `source`. The content hash is over the tool's version, the type's name and version and the bytes of all files
/// read, in the order they were first mentioned; paths are no part of it, so that it is the same on every machine.
/// Throws Error (input) if the source is refused, Error (system) if a file changed while it was being read.
BakedAsset bake_source(const Registry& registry, const std::filesystem::path& source);

/// How many sources this process has begun to bake.
std::uint64_t sources_baked();

struct CookSettings {
    std::optional<std::filesystem::path> depfile;  ///< Makefile-syntax list of everything the output was made from
};

/// Bakes `source` and writes `output`, then the depfile: whole or, if anything fails, not at all. It always bakes:
/// when to cook is the build system's decision, since only that knows whether the cooker itself is the one that wrote
/// an existing output. Throws Error like bake_source and write_file_atomic, and
/// before it bakes (for the files that the source names: before it writes) where check_outputs() refuses an output.
BakedAsset cook_source(const Registry& registry, const std::filesystem::path& source,
                       const std::filesystem::path& output, const CookSettings& settings = {});

}  // namespace rowland::cook
