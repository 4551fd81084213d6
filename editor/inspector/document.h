#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "editor/inspector/field.h"
#include "engine/image/byte_image.h"
#include "engine/scene/editable_gltf.h"
#include "modules/diffraction/asset/gltf_extension.h"
#include "modules/diffraction/asset/material.h"
#include "modules/thin_film/asset/film_material.h"
#include "modules/thin_film/asset/gltf_iridescence.h"

namespace rowland::inspector {

/// A picture that a scene file does not hold yet.
struct NewTexture {
    std::string name;                                 ///< of the file it becomes
    std::vector<std::byte> bytes;                     ///< PNG or JPEG
    std::shared_ptr<const image::ByteImage> picture;  ///< decoded
};

/// Pictures that materials of a scene use before they are saved. Their texture indices are above those of any file.
class NewTextures {
 public:
    static constexpr std::size_t kFirst = 1'000'000;

    /// Adds a PNG or JPEG; returns its index, kFirst or above. Throws Error (input) naming `name` if it cannot be read.
    std::size_t add(std::vector<std::byte> bytes, const std::string& name) {
        auto picture = std::make_shared<const image::ByteImage>(image::decode_byte_image(bytes, name));
        all_.push_back(std::make_shared<const NewTexture>(NewTexture{name, std::move(bytes), std::move(picture)}));
        return kFirst + all_.size() - 1;
    }
    /// The texture with that index; null if there is none.
    std::shared_ptr<const NewTexture> find(std::size_t index) const {
        return index >= kFirst && index - kFirst < all_.size() ? all_[index - kFirst] : nullptr;
    }
    /// That of index kFirst and its successors.
    std::span<const std::shared_ptr<const NewTexture>> all() const { return all_; }

 private:
    std::vector<std::shared_ptr<const NewTexture>> all_;
};

/// A material that a module's parser accepted, with its source. Never changes, so the pointer to it is its identity.
struct MaterialSource {
    Json json;
    std::string name;  ///< of the file, for messages
    /// A grating (of a material file: without grooves on a mesh), the film of a material file, or the film of a scene.
    std::variant<diffraction::GltfGrating, thin_film::FilmMaterial, thin_film::GltfIridescence> parsed;
    NewTextures textures = {};  ///< that the material may use besides those of the file

    /// Null: a film.
    const diffraction::GltfGrating* grating() const { return std::get_if<diffraction::GltfGrating>(&parsed); }
};

/// The glTF extension that an object in a scene belongs to: a grating's or a film's.
const char* extension_of(const Json& object);

/// Parses a material file's object, or a scene material's extension, whose textures may be some of `textures`. Named
/// files are relative to `folder`. Throws Error (input) naming `file` and a location below `pointer`.
std::shared_ptr<const MaterialSource> accept_material(const Json& material, const std::string& file,
                                                      const std::filesystem::path& folder);
std::shared_ptr<const MaterialSource> accept_extension(const Json& extension, const std::string& file,
                                                       const std::filesystem::path& folder,
                                                       const std::string& pointer = "",
                                                       const NewTextures* textures = nullptr);

/// The material with its relative file names rewritten from the folder `from` to the folder `to`. Throws Error (input)
/// if a new name is not UTF-8.
Json moved(Json material, const std::filesystem::path& from, const std::filesystem::path& to);

/// Why the edited material is refused.
struct Refusal {
    const Field* field = nullptr;  ///< null: no single field
    std::string message;
};

/// The edited material file, or the gratings and films of all materials of a scene file, one of which is chosen; with
/// the history for undo and redo. json() may contain values that the module's parser refuses; accepted() is the last
/// material without such a value.
class Document {
 public:
    /// Opens a material file. Throws Error (input) if it is refused; nothing is written.
    static Document open(const std::filesystem::path& path);
    /// Opens a file as the start of a new material; save() never overwrites the file. Throws Error (input).
    static Document open_as_new(const std::filesystem::path& path);
    /// A new material. Files that it names are relative to `folder`. Throws Error (input) naming `name`.
    static Document make_new(Json material, std::string name, std::filesystem::path folder);
    /// Opens the gratings and films of a scene: those of its materials, then those of the primitives
    /// `without_material`, which get a material once they are saved with a grating or a film. Chooses the first
    /// material that has a grating or a film, else the first. Throws Error (input) if one is refused, or if a material
    /// has both.
    static Document open_scene(scene::EditableGltf file, std::span<const scene::PrimitiveId> without_material = {});

    bool is_scene() const { return file_.has_value(); }
    /// The materials of the scene, 1 if it has none; 1 for a material file.
    std::size_t material_count() const { return slots_.size(); }
    std::size_t chosen() const { return chosen_; }
    /// Does nothing if there is no such material.
    void choose(std::size_t material);

    /// The chosen material; null if it has neither a grating nor a film.
    const Json& json() const { return json(chosen_); }
    const Json& json(std::size_t material) const { return slots_.at(material).json; }
    /// The last accepted material; a new pointer whenever it changes. Null: neither a grating nor a film.
    const std::shared_ptr<const MaterialSource>& accepted() const { return accepted(chosen_); }
    const std::shared_ptr<const MaterialSource>& accepted(std::size_t material) const;
    bool has_grating() const { return accepted() && accepted()->grating() != nullptr; }
    bool has_film() const { return accepted() && !has_grating(); }
    /// The chosen material must have a grating.
    const diffraction::Material& material() const { return accepted()->grating()->material; }
    const std::optional<Refusal>& refusal() const { return slots_[chosen_].refusal; }

    /// Edits. All edits of one field between two calls of finish_edit() are one step of undo.
    void set_value(const Field& field, const Json& value);
    void set_choice(const Field& field, const std::string& name);
    void revert(const Field& field);
    /// Replaces all members of the quality in one step.
    void replace_quality(const Json& quality);
    /// Sets the grating or the film of the chosen material of a scene from an extension's object; null removes it.
    /// Throws Error (input) naming `name` if the object is refused, and for the document of a material file.
    void set_extension(const Json& object, const std::string& name);
    void finish_edit() { editing_ = nullptr; }

    /// The boxes of a scene with a light probe of their own: nodes with ROWLAND_light_probe.
    const std::vector<scene::ExtendedNode>& boxes() const { return boxes_; }
    /// Replaces them; all calls between two of finish_edit() are one step of undo. Throws Error (input) if a probe is
    /// not named as a file in the scene's folder, or below it.
    void set_boxes(const std::vector<scene::ExtendedNode>& boxes);

    bool can_undo() const { return at_ > 0; }
    bool can_redo() const { return at_ < steps_.size(); }
    /// Both choose the changed material, if one changes.
    void undo();
    void redo();

    /// Whether a material differs from the file, or there is no file.
    bool dirty() const;
    /// Whether that material differs from the file.
    bool edited(std::size_t material) const { return slots_[material].json != slots_[material].in_file; }
    /// The chosen material as saved; null if it is not in the file.
    const std::shared_ptr<const MaterialSource>& saved() const { return slots_[chosen_].saved; }
    /// Where save() writes; empty for a new material.
    const std::filesystem::path& path() const { return path_; }
    /// The name of the file, or of the file from which a new material started.
    const std::string& name() const { return name_; }
    /// The folder of the files that a material names.
    const std::filesystem::path& folder() const { return folder_; }
    /// Whether another program changed the scene file since it was opened.
    bool changed_outside() const { return file_ && file_->changed_on_disk(); }

    /// Pictures for textures that are not in the scene file yet; saving adds those that a material uses.
    const NewTextures& new_textures() const { return new_textures_; }
    NewTextures& new_textures() { return new_textures_; }

    /// Writes the file completely or not at all. Throws Error: (input) if a material is refused or there is no path;
    /// (system) if the file cannot be written. The document is unchanged then. `over_changes`: overwrites
    /// the changes of another program to a scene file, which are an Error (input) otherwise.
    void save(bool over_changes = false);
    /// Writes another file and makes file names in the materials relative to its folder. Throws as save() does.
    void save_as(const std::filesystem::path& path);
    /// Writes unsaved edits, refused or not, to a new file when the program must end: cd.unsaved.json beside cd.json;
    /// for a new material into the current folder; into the temporary folder if that fails. Returns nullopt if there
    /// are no edits. `earlier`: the file of an earlier call, which is overwritten if it is in the same folder. Throws
    /// Error (system).
    std::optional<std::filesystem::path> rescue(const std::optional<std::filesystem::path>& earlier = {}) const;
    /// Another number after each edit, undo or redo.
    std::size_t revision() const { return revision_; }

 private:
    /// A material and its state.
    struct Slot {
        std::optional<scene::PrimitiveId> primitive = {};  ///< for a primitive without a material
        Json json = {};
        Json in_file = {};  ///< null: neither a grating nor a film
        std::shared_ptr<const MaterialSource> accepted = {};
        std::shared_ptr<const MaterialSource> saved = {};
        std::optional<Refusal> refusal = {};
    };
    struct MaterialEdit {
        std::size_t material = 0;
        Json before;
        Json after;
    };
    struct BoxEdit {
        std::vector<scene::ExtendedNode> before;
        std::vector<scene::ExtendedNode> after;
    };
    using Step = std::variant<MaterialEdit, BoxEdit>;

    Document(std::string name, std::filesystem::path folder) : name_(std::move(name)), folder_(std::move(folder)) {}
    void edit(const Json& edited, const Field* field);
    void set(std::size_t material, const Json& json);
    void add_step(Step step);
    void take_boxes(const std::vector<scene::ExtendedNode>& boxes);
    void reparse(Slot& slot) const;
    void require_accepted() const;
    void mark_saved();
    /// The scene file with the gratings and films as edited, the files that they name relative to `folder`.
    scene::EditableGltf edited_file(const std::filesystem::path& folder) const;
    void write(const std::filesystem::path& path, bool over_changes);
    void write_copy(const std::filesystem::path& path, const std::filesystem::path& folder) const;

    std::vector<Slot> slots_;
    std::size_t chosen_ = 0;
    std::vector<scene::ExtendedNode> boxes_;
    std::vector<scene::ExtendedNode> boxes_in_file_;
    std::vector<Step> steps_;
    std::size_t at_ = 0;  ///< steps that are done; later ones are undone
    std::size_t revision_ = 0;
    const void* editing_ = nullptr;  ///< further edits of this field, or of boxes_, change the last step
    std::filesystem::path path_;
    std::string name_;
    std::filesystem::path folder_;
    std::optional<scene::EditableGltf> file_;  ///< of a scene, as last saved
    NewTextures new_textures_;
};

/// Writes unsaved edits to a separate file, a minute after the first edit that this file lacks, and removes the file
/// once nothing is unsaved.
class Autosave {
 public:
    using Clock = std::chrono::steady_clock;

    /// Call it often. `replacements`: the number of documents before this one. Returns whether file() changed.
    /// Throws Error (system).
    bool update(const Document& document, std::size_t replacements, Clock::time_point now);
    /// Writes the edits at once. Throws Error (system).
    void write(const Document& document) { file_ = document.rescue(file_); }
    /// Removes the file.
    void discard();
    const std::optional<std::filesystem::path>& file() const { return file_; }

 private:
    std::optional<std::filesystem::path> file_;
    std::optional<Clock::time_point> due_;
    std::size_t replacements_ = 0;
    std::size_t written_ = 0;  ///< Document::revision()
};

}  // namespace rowland::inspector
