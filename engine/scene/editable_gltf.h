#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/core/hash.h"
#include "engine/core/json_text.h"
#include "engine/scene/gltf_outline.h"

namespace rowland::scene {

/// A .gltf or .glb whose materials are edited. All that an edit does not name stays byte for byte: the JSON text is
/// edited in place, and the other chunks of a GLB are copied. Files that it names are not read.
///
/// Copies have the binary chunk, and what is known of the file on disk, in common; each holds a JSON text of its own:
/// undo and redo keep copies from before and after each edit. Indices of materials, meshes and textures that are out of
/// range are logic errors.
class EditableGltf {
 public:
    enum class IfChanged { Refuse, Overwrite };

    /// Throws Error (input) as load_gltf() does for a file that is not glTF; extensions of all kinds are accepted.
    static EditableGltf open(const std::filesystem::path& path);
    /// The same for the content of a file that `path` names.
    EditableGltf(std::vector<std::byte> bytes, std::filesystem::path path);

    /// Where the file was opened from or last saved to.
    const std::filesystem::path& path() const;
    /// The names of its materials, and its meshes' primitives with the materials that they use.
    const GltfOutline& outline() const { return outline_; }

    /// A member of a material's "extensions"; null if the material does not have it.
    nlohmann::ordered_json material_extension(std::size_t material, const std::string& extension) const;
    /// Sets it, or removes it if `value` is null. Of an object only the members that differ are written. Keeps
    /// "extensionsUsed" complete, with the extensions inside of `value`, and free of what is no longer used.
    void set_material_extension(std::size_t material, const std::string& extension,
                                const nlohmann::ordered_json& value);

    /// The material of a primitive for it alone: the one that it has, if nothing else uses it, else a copy of it under
    /// a name of its own, else (if it has none) a new one. Returns its index.
    std::size_t own_material(PrimitiveId primitive);

    /// The index of a texture that shows a PNG or a JPEG through a sampler, a glTF object (null: none): one that is
    /// there already, or a new one. A GLB takes the image into its binary chunk. Otherwise it becomes a file beside the
    /// glTF, called as `name` or, if that is taken by other content, with a number after it; save() writes it. Throws
    /// Error (input) if the image cannot be drawn.
    std::size_t add_texture(std::vector<std::byte> image, const std::string& name,
                            const nlohmann::ordered_json& sampler = nullptr);

    /// The file as save() writes it.
    std::vector<std::byte> bytes() const;

    /// Whether path() holds something else than what was opened from it or last saved to it.
    bool changed_on_disk() const;
    /// Writes the images that were added as files, then replaces the file. Links are followed. Throws Error
    /// - (system) if path() changed_on_disk() and that is refused, or if writing fails; the old file stays,
    /// - (input) if `path` is in another folder and the glTF names files, which would not be found there.
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
    using Parts = std::vector<std::span<const std::byte>>;

    void rename_copy(std::size_t material, std::size_t original);
    void use_extensions(const OrderedJson& before, const OrderedJson& now);
    OrderedJson array_of(const std::string& name) const;  ///< of the root; empty if it is missing
    bool file_holds(const std::string& uri, std::span<const std::byte> image) const;
    std::span<const std::byte> view_of_binary(const OrderedJson& view) const;
    std::optional<std::size_t> find_image(std::span<const std::byte> image) const;
    std::size_t add_image(std::vector<std::byte> image, const std::string& name);
    std::size_t add_to_binary(std::vector<std::byte> image);
    std::string add_file(std::vector<std::byte> image, const std::string& name);
    std::span<const std::byte> binary() const;
    void require_files_beside(const std::filesystem::path& target) const;
    void write_added_files(const std::filesystem::path& folder) const;
    /// Adds to `owned` what the parts need besides this object.
    Parts parts(std::vector<std::byte>& owned) const;

    std::shared_ptr<OnDisk> on_disk_;  ///< shared by all copies
    JsonText json_;
    GltfOutline outline_;
    bool is_binary_ = false;
    std::shared_ptr<const std::vector<std::byte>> opened_;  ///< the whole file, if it is a GLB
    std::size_t binary_begin_ = 0;                          ///< of the data of the BIN chunk in `opened_`; 0: none
    std::size_t binary_size_ = 0;
    std::shared_ptr<const std::vector<std::byte>> appended_;  ///< to the BIN chunk; null: nothing
    std::vector<AddedFile> added_files_;
};

}  // namespace rowland::scene
