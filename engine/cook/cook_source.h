#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
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
/// `parts_folder`: see cook_part(). Throws Error (input) if the source is refused, Error (system) if a file changed
/// while it was being read.
BakedAsset bake_source(const Registry& registry, const std::filesystem::path& source,
                       const std::filesystem::path& parts_folder = {});

/// How many sources this process has begun to bake.
std::uint64_t sources_baked();

struct CookSettings {
    std::optional<std::filesystem::path> depfile;  ///< Makefile-syntax list of everything the output was made from
    std::filesystem::path parts_folder = {};       ///< see cook_part()
};

/// Bakes `source` and writes `output`, then the depfile: each whole or, if anything fails, not at all. It always bakes;
/// the build system decides when to cook, since only that knows whether this cooker wrote an existing output. Throws
/// Error as bake_source() and write_file_atomic() do. It also throws where check_outputs() refuses an output: as one of
/// the files that the source names, before it writes, otherwise before it bakes.
BakedAsset cook_source(const Registry& registry, const std::filesystem::path& source,
                       const std::filesystem::path& output, const CookSettings& settings = {});

/// The record of a finished cook, by which the same cook is not repeated: what made the output, from which files, and
/// the output's hash.
struct CookRecord {
    std::string cooker;                               ///< hash of the program; empty: any of this tool_version()
    std::vector<std::filesystem::path> dependencies;  ///< the source first
    std::string content_hash;                         ///< cook::content_hash() of them
    std::string output_hash;                          ///< empty: not recorded
};

/// Replaces the file as a whole. Throws Error (system).
void write_cook_record(const std::filesystem::path& file, const CookRecord& record);

/// nullopt if there is no such file or it is not a record: then the source is to be cooked.
std::optional<CookRecord> read_cook_record(const std::filesystem::path& file);

/// The result of `make`, such as a grating's tables in a scene. It is taken from the context's folder of parts if it
/// was made there for an equal `key`, which names all that it depends on but files, from files of the same content;
/// else it is made and kept there. `make` reads files other than the source through the context that it is given.
/// Several processes may call it at once.
std::vector<std::byte> cook_part(Context& context, const std::string& key,
                                 const std::function<std::vector<std::byte>(Context&)>& make);

/// Where cook_once() keeps its parts.
std::filesystem::path parts_folder(const std::filesystem::path& cache_folder);

/// The cooked file of `source` in a cache: cooked now, unless a file there was cooked from the same content of the
/// source and of all its dependencies, in whatever folder the source was. Replaces `read_files` by the dependencies, or
/// if it throws adds `source`. Several processes may call it at once. Throws Error as bake_source() and
/// write_file_atomic() do. Its parts are kept in parts_folder().
std::filesystem::path cook_once(const Registry& registry, const std::filesystem::path& source,
                                const std::filesystem::path& cache_folder,
                                std::vector<std::filesystem::path>& read_files);

/// Loads a source, or a cooked asset (recognised by its magic), as the engine would. Returns its kind, such as "probe
/// source" or "cooked probe". Throws Error (input) if it is refused or of no known kind, or if a loader throws another
/// exception.
std::string check_file(const Registry& registry, const std::filesystem::path& path);

/// What a cooked asset holds, a "name: value" line each: its header, then its payload as its type describes it.
/// Throws Error (input) like check_file, and for a source.
std::string describe_file(const Registry& registry, const std::filesystem::path& path);

}  // namespace rowland::cook
