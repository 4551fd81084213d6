#pragma once

#include <cstddef>
#include <filesystem>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "engine/core/file.h"
#include "engine/scene/gltf_source.h"
#include "engine/scene/imported_scene.h"

namespace rowland::scene {

struct GltfMeshOutline {
    std::string name;
    std::vector<std::optional<std::size_t>> materials;  ///< of each primitive
};

/// The names of a glTF's materials, and the primitives that use them. Names may be empty and may repeat.
struct GltfOutline {
    std::vector<std::string> materials;
    std::vector<GltfMeshOutline> meshes;

    /// How many primitives use a material.
    std::size_t uses(std::size_t material) const;
};

/// A node with an extension.
struct ExtendedNode {
    std::optional<std::size_t> index = {};  ///< nullopt: it is not in the file yet
    std::string name = {};
    glm::dvec3 translation{0.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
    glm::dvec3 scale{1.0};
    nlohmann::ordered_json extension = {};  ///< its object

    friend bool operator==(const ExtendedNode&, const ExtendedNode&) = default;
};

/// A .gltf or .glb whose materials, and nodes with an extension, are edited. Everything that an edit does not name is
/// kept: the order of members, extras, unknown extensions and the other chunks of a GLB. For this the document is held
/// as the file's JSON, since tinygltf's writer would lose some of these. Files that it names are not read.
///
/// Undo and redo keep copies from before and after each edit. Copies share the binary chunk, what is known of the file
/// on disk and, until one of them is edited, the JSON. Indices of materials, meshes, nodes and textures that are out of
/// range are logic errors.
class EditableGltf {
 public:
    enum class IfChanged { Refuse, Overwrite };

    /// Throws Error (input) as load_gltf() does for a file that is not glTF; extensions of all kinds are accepted.
    static EditableGltf open(const std::filesystem::path& path);
    /// The same for the content of a file that `path` names.
    EditableGltf(std::vector<std::byte> bytes, std::filesystem::path path);

    /// Where the file was opened from or last saved to.
    const std::filesystem::path& path() const { return on_disk_->path; }
    const GltfOutline& outline() const { return outline_; }

    /// A member of a material's "extensions"; null if the material does not have it.
    nlohmann::ordered_json material_extension(std::size_t material, const std::string& extension) const;
    /// Sets it, or removes it if `value` is null. Members of an object that are there already keep their position.
    /// Adds the extension and those inside of `value` to "extensionsUsed", and removes those that are no longer used
    /// from it and from "extensionsRequired".
    void set_material_extension(std::size_t material, const std::string& extension,
                                const nlohmann::ordered_json& value);

    /// The nodes with that extension, in the order of the file. A matrix is given as translation, rotation and scale.
    std::vector<ExtendedNode> nodes_with(const std::string& extension) const;
    /// Sets the extension, translation and rotation of these nodes where they differ, and takes the extension from all
    /// others. Those that are not in the file become nodes of its scene.
    void set_nodes_with(const std::string& extension, std::span<const ExtendedNode> nodes);

    /// Gives a primitive a material that no other primitive uses: the one that it has, if that is so already, else a
    /// renamed copy of it, or a new one if it has none. Returns the material's index.
    std::size_t own_material(PrimitiveId primitive);

    /// The index of a texture of a PNG or JPEG with a sampler, a glTF object (null: none); it is added if there is no
    /// such texture. A GLB stores the image in its binary chunk, unless its first buffer is a file. Otherwise save()
    /// writes the image to a file beside the glTF, called `name`, with a number after it if a file with other content
    /// has that name. Throws Error (input) if the image's header is not that of a PNG or JPEG within the limits.
    std::size_t add_texture(std::vector<std::byte> image, const std::string& name,
                            const nlohmann::ordered_json& sampler = nullptr);

    /// The file as save() writes it: a .gltf with line breaks if it had any, a .glb without spaces.
    std::vector<std::byte> bytes() const;

    /// Whether path() holds something else than what was opened from it or last saved to it.
    bool changed_on_disk() const;
    /// Writes the images that were added as files, then replaces the file. Links are followed. Throws Error
    /// - (system) if `path` is path(), changed_on_disk() and `if_changed` is Refuse, or if writing fails; the old file
    ///   stays,
    /// - (input) if `path` is in another folder and the glTF names files, which would not be found there, or if a file
    ///   with the name of an added image has other content.
    void save(const std::filesystem::path& path, IfChanged if_changed = IfChanged::Refuse);
    void save() { save(path()); }

    /// Whether both have the same content, apart from the path.
    friend bool operator==(const EditableGltf& a, const EditableGltf& b);

 private:
    /// Where the file is, and what it held when it was last read or written.
    struct OnDisk {
        std::filesystem::path path;
        Hash128 hash;
    };
    struct AddedFile {
        std::string name;
        std::shared_ptr<const std::vector<std::byte>> bytes;
    };
    using OrderedJson = nlohmann::ordered_json;

    /// The JSON for editing, from now on not shared with copies.
    OrderedJson& edit();
    const OrderedJson& array(const char* name) const;  ///< of the root; empty if it is missing
    void add_node(const std::string& extension, const ExtendedNode& node);
    void rename_copy(OrderedJson& copy, const std::string& original);
    void list_extensions(const std::set<std::string>& before, const std::set<std::string>& now);
    std::span<const std::byte> appended() const;
    bool has_binary() const;
    std::size_t index_of(const char* array, const OrderedJson& object);
    bool file_holds(const std::string& uri, std::span<const std::byte> image) const;
    std::optional<std::size_t> find_image(std::span<const std::byte> image) const;
    std::size_t add_image(std::vector<std::byte> image, const std::string& name);
    std::size_t add_to_binary(std::vector<std::byte> image);
    std::string add_file(std::vector<std::byte> image, const std::string& name);
    void require_files_beside(const std::filesystem::path& target) const;
    void write_added_files(const std::filesystem::path& folder) const;
    /// The bytes of the file as consecutive parts; `owned` receives those that this object does not hold.
    std::vector<std::span<const std::byte>> parts(std::vector<std::byte>& owned) const;

    std::shared_ptr<OnDisk> on_disk_;  ///< shared by all copies
    std::shared_ptr<OrderedJson> json_;
    GltfOutline outline_;
    bool in_lines_ = false;                                   ///< the JSON text has line breaks
    std::shared_ptr<const GltfSource> opened_;                ///< without its JSON
    std::shared_ptr<const std::vector<std::byte>> appended_;  ///< to the BIN chunk; null: nothing
    std::vector<AddedFile> added_files_;
};

}  // namespace rowland::scene
