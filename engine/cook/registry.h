#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <functional>
#include <new>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/file.h"

namespace rowland::scene {
struct ImportedScene;
}

namespace rowland::cook {

/// The content hash of a file that a cook depends on: zero if it does not exist, else hash_file().
std::optional<Hash128> hash_dependency(const std::filesystem::path& path);

/// The files that one cook reads. Each is read through it or named to depend_on(), so that the dependency file is
/// complete.
class Context {
 public:
    /// `parts_folder`: where cook_part() keeps its results; empty: nowhere.
    explicit Context(std::filesystem::path source, std::filesystem::path parts_folder = {})
        : source_(std::move(source)), parts_folder_(std::move(parts_folder)) {
        depend_on(source_);
    }

    const std::filesystem::path& source() const { return source_; }
    const std::filesystem::path& parts_folder() const { return parts_folder_; }
    /// A path named inside the source, relative to the source's folder.
    std::filesystem::path beside_source(const std::string& name) const { return source_.parent_path() / name; }
    /// Records that the result depends on `path`, and the file's present hash. Call it before reading the file. It does
    /// not throw if the file is missing or unreadable: an optional one may be missing, and reading refuses any other.
    void depend_on(const std::filesystem::path& path);
    /// A context of the same source, as yet without other files.
    Context part() const;
    /// Depends on all that `part`, a context of the same source, depends on. Throws Error (system) if a file has
    /// changed between the two.
    void depend_on_all_of(const Context& part);
    /// Each file once, in the order of the first mention; the source comes first.
    const std::vector<std::filesystem::path>& dependencies() const { return dependencies_; }
    /// hash_dependency() of each of `dependencies()` when it was first mentioned.
    const std::vector<std::optional<Hash128>>& fingerprints() const { return fingerprints_; }

    /// Reads and records a file. Throws Error (input) as rowland::read_file does, and Error (system) if it has changed
    /// since it was first mentioned.
    std::vector<std::byte> read(const std::filesystem::path& path, std::uint64_t max_bytes,
                                const std::string& remedy = "");
    /// A file parsed as JSON (at most 16 MiB, depth-limited), and recorded. Throws Error (input).
    nlohmann::json read_json(const std::filesystem::path& path);
    /// The same with its members in the order of the file.
    nlohmann::ordered_json read_ordered_json(const std::filesystem::path& path);

 private:
    Context() = default;

    std::filesystem::path source_;
    std::filesystem::path parts_folder_;
    std::vector<std::filesystem::path> dependencies_;
    std::vector<std::optional<Hash128>> fingerprints_;
};

/// How one kind of source becomes one kind of cooked asset. Registered by the engine's parts and by modules.
struct AssetType {
    std::string name;           ///< "probe", "material", "mesh"
    std::uint32_t version = 1;  ///< raise it whenever the payload's layout or the bake's result changes
    std::string extension;      ///< of the cooked file, with the dot
    bool in_container = true;   ///< false: the payload is itself a file (GLB), written without the container

    /// Whether a source is of this type. `json` is the parsed source if its extension is .json, else null.
    std::function<bool(const std::filesystem::path& source, const nlohmann::json* json)> recognises;
    /// Source → payload. Deterministic: the same sources give the same bytes with any number of threads.
    /// Empty if sources of this type are only ever checked, not cooked.
    std::function<std::vector<std::byte>(Context&)> cook;
    /// Loads a source as the engine would; throws Error (input) if it is refused.
    std::function<void(Context&)> check;
    /// The JSON Schema of its JSON sources; empty if it has none.
    std::function<nlohmann::ordered_json()> schema = {};
    /// Parses a cooked payload fully and describes it, a "name: value" line each. Throws Error (input).
    /// Empty only where `cook` is.
    std::function<std::string(std::span<const std::byte> payload, const std::string& file)> describe;
    /// Describes a source in the same form. Throws Error (input). Empty: cooked files only are described.
    std::function<std::string(Context&)> describe_source = {};
};

/// A material extension in a scene that is cooked; the scene's file is Context::source().
struct SceneExtension {
    const nlohmann::json& object;
    std::string pointer;  ///< JSON pointer of the object
    const scene::ImportedScene& scene;
    std::size_t material;  ///< index of the material in `scene`
};

/// A glTF material extension that a module reads. All functions throw Error (input) for what the module refuses.
struct GltfExtension {
    std::string name;
    /// The JSON Schema of its objects; empty if none is offered.
    std::function<nlohmann::ordered_json()> schema = {};
    /// Reads an object of the extension as the engine would, and describes it in one line. `pointer` is its JSON
    /// pointer in the glTF `file`.
    std::function<std::string(const nlohmann::json& object, const std::string& file, const std::string& pointer)>
        describe;

    std::uint32_t version = 0;  ///< raise it whenever the tables' layout or the bake's result changes
    /// The tables that drawing an extension takes. Deterministic like AssetType::cook. Empty function: it takes none.
    std::function<std::vector<std::byte>(Context&, const SceneExtension&)> cook;
    /// What the tables depend on besides the files that `cook` reads: of the object, and of the scene. Scenes for which
    /// it is equal share tables, cook_part(). Empty function: they are cooked with every scene.
    std::function<std::string(const SceneExtension&)> part_key = {};
    /// Describes the tables, a "name: value" line each. Empty only where `cook` is.
    std::function<std::string(std::span<const std::byte> tables, const std::string& file)> describe_tables;

    // For `rowland-cook attach`; empty if no source becomes such an object.
    std::string source_type;  ///< the AssetType of those sources
    /// The object for a source; names of files are relative to the source's folder.
    std::function<nlohmann::ordered_json(Context&)> from_source;
    /// Makes the names of files in an object relative to another folder.
    std::function<void(nlohmann::ordered_json& object, const std::filesystem::path& from,
                       const std::filesystem::path& to)>
        move;
    std::string rotation_member;  ///< the name of the member that is a rotation in radians
    std::string texture_member;   ///< the name of the member that is a textureInfo
};

/// Throws Error (system): a file has changed since the cook first read it.
[[noreturn]] void fail_changed(const std::filesystem::path& path);

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

class Registry {
 public:
    /// Adds a type; its name must be new, and it must recognise and check its sources.
    void add(AssetType type);
    const std::vector<AssetType>& types() const { return types_; }
    /// Adds a glTF material extension that a module reads. Files that require any other are refused.
    void add_gltf_extension(GltfExtension extension) { gltf_extensions_.push_back(std::move(extension)); }
    const std::vector<GltfExtension>& gltf_extensions() const { return gltf_extensions_; }
    std::vector<std::string> gltf_extension_names() const;
    /// The type of a source file, or null. Throws Error (input) if it is JSON that cannot be read, and if two types
    /// claim it.
    const AssetType* recognise(const std::filesystem::path& source) const;
    /// The same; throws Error (input) that lists the known types if there is none.
    const AssetType& type_of_source(const std::filesystem::path& source) const;
    /// The type called `name`, or null.
    const AssetType* find(const std::string& name) const;

 private:
    [[noreturn]] void fail_type(const std::filesystem::path& source, std::string found) const;

    std::vector<AssetType> types_;
    std::vector<GltfExtension> gltf_extensions_;
};

}  // namespace rowland::cook
