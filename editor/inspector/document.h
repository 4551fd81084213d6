#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "editor/inspector/field.h"
#include "editor/inspector/material_source.h"
#include "editor/inspector/new_textures.h"
#include "editor/inspector/ordered_json.h"
#include "engine/scene/editable_gltf.h"

namespace rowland::inspector {

/// Why the material as edited is refused.
struct Refusal {
    const Field* field = nullptr;  ///< null: it is about no field
    std::string message;
};

/// What the editor edits, with its history for undo and redo: a material file, or the gratings of all materials of a
/// scene file, one of which is chosen. A value that the module's parser refuses stays in json(); accepted() is then
/// still the last material without such a value.
class Document {
 public:
    /// Opens a material file. Throws Error (input) if it is refused; nothing is written.
    static Document open(const std::filesystem::path& path);
    /// Opens a file as the start of a new material, which save() does not write over. Throws Error (input).
    static Document open_as_new(const std::filesystem::path& path);
    /// A new material. Files that it names are relative to `folder`. Throws Error (input) naming `name`.
    static Document make_new(Json material, std::string name, std::filesystem::path folder);
    /// The gratings of a scene: of its materials, then of primitives without one (`without_material`), which get a
    /// material when they are saved with a grating. The first grating is chosen, else the first material. Throws Error
    /// (input) if one of them is refused.
    static Document open_scene(scene::EditableGltf file, std::span<const scene::PrimitiveId> without_material = {});

    bool is_scene() const { return file_.has_value(); }
    /// The materials of the scene, 1 if it has none; 1 for a material file.
    std::size_t material_count() const { return slots_.size(); }
    std::size_t chosen() const { return chosen_; }
    void choose(std::size_t material);

    /// The chosen material; null if it has no grating.
    const Json& json() const { return json(chosen_); }
    const Json& json(std::size_t material) const { return slots_.at(material).json; }
    bool has_grating() const { return accepted() != nullptr; }
    /// The last material that was not refused; another pointer whenever it changes. Null: no grating.
    const std::shared_ptr<const MaterialSource>& accepted() const { return accepted(chosen_); }
    const std::shared_ptr<const MaterialSource>& accepted(std::size_t material) const;
    /// The chosen material must have a grating.
    const diffraction::Material& material() const { return accepted()->material; }
    const std::optional<Refusal>& refusal() const { return slots_[chosen_].refusal; }

    /// Edits. All edits of one field between two calls of finish_edit() are one step of undo.
    void set_value(const Field& field, const Json& value);
    void set_choice(const Field& field, const std::string& name);
    void revert(const Field& field);
    /// Replaces all members of the quality in one step.
    void replace_quality(const Json& quality);
    /// Gives the chosen material of a scene a grating, the extension's object, in place of the one it has; null removes
    /// it. Throws Error (input) naming `name` if it is refused.
    void set_grating(const Json& grating, const std::string& name);
    void finish_edit() { editing_ = nullptr; }

    bool can_undo() const { return at_ > 0; }
    bool can_redo() const { return at_ < steps_.size(); }
    /// Both choose the material that they change.
    void undo();
    void redo();

    /// Whether a material differs from the file, or there is no file.
    bool dirty() const;
    /// Whether one material of the scene does.
    bool edited(std::size_t material) const { return slots_[material].json != slots_[material].in_file; }
    /// The chosen material in the file; null if there is none.
    const std::shared_ptr<const MaterialSource>& saved() const { return slots_[chosen_].saved; }
    /// Where save() writes; empty for a new material.
    const std::filesystem::path& path() const { return path_; }
    /// The file's name, or that of the file a new material started from.
    const std::string& name() const { return name_; }
    /// That of the files that a material names.
    const std::filesystem::path& folder() const { return folder_; }
    /// Whether save() would write over a scene file that another program changed since it was opened.
    bool changed_outside() const { return file_ && file_->changed_on_disk(); }

    /// Pictures for groove textures that the scene file does not hold yet; saving adds those that a material uses.
    const NewTextures& new_textures() const { return new_textures_; }
    NewTextures& new_textures() { return new_textures_; }

    /// Writes the file completely or not at all. Throws Error: (input) if json() is refused or there is no path;
    /// (system) if the file cannot be written. The document is unchanged then. `over_changes`: of another program, to a
    /// scene file; without it they are an Error (input).
    void save(bool over_changes = false);
    /// Writes another file. Files that the material names stay where they are; their relative names are adapted.
    void save_as(const std::filesystem::path& path);
    /// Writes unsaved edits, refused or not, to a new file when the program must end: cd.unsaved.json beside cd.json;
    /// for a new material into the current folder; into the temporary folder if that fails. Returns nullopt if there
    /// are no edits. Throws Error (system).
    std::optional<std::filesystem::path> rescue() const;

 private:
    /// A material and its state.
    struct Slot {
        std::optional<scene::PrimitiveId> primitive = {};  ///< one without a material
        Json json = {};
        Json in_file = {};  ///< null: no grating
        std::shared_ptr<const MaterialSource> accepted = {};
        std::shared_ptr<const MaterialSource> saved = {};
        std::optional<Refusal> refusal = {};
    };
    struct Step {
        std::size_t material = 0;
        Json before;
        Json after;
    };

    Document(std::string name, std::filesystem::path folder) : name_(std::move(name)), folder_(std::move(folder)) {}
    void edit(Json edited, const Field* field);
    void set(std::size_t material, const Json& json);
    void reparse(Slot& slot) const;
    void require_accepted() const;
    void note_saved();
    /// The scene file with the gratings as edited, for a folder.
    scene::EditableGltf edited_file(const std::filesystem::path& folder) const;
    void write(const std::filesystem::path& path, bool over_changes);
    void write_copy(const std::filesystem::path& path, const std::filesystem::path& folder) const;

    std::vector<Slot> slots_;
    std::size_t chosen_ = 0;
    std::vector<Step> steps_;
    std::size_t at_ = 0;              ///< steps that are done; later ones are undone
    const Field* editing_ = nullptr;  ///< further edits of this field change the last step
    std::filesystem::path path_;
    std::string name_;
    std::filesystem::path folder_;
    std::optional<scene::EditableGltf> file_;  ///< of a scene, as last saved
    NewTextures new_textures_;
};

}  // namespace rowland::inspector
