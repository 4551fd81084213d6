#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "editor/inspector/field.h"
#include "editor/inspector/ordered_json.h"
#include "modules/diffraction/asset/material.h"

namespace rowland::inspector {

/// Why the material as edited is refused.
struct Refusal {
    const Field* field = nullptr;  ///< null: it is about no field
    std::string message;
};

/// A material that the module's parser accepted, with its source. Never changes, so the pointer to it is its identity.
struct MaterialSource {
    Json json;
    diffraction::Material material;
    std::string name;  ///< of the file, for messages
};

/// A material file in the editor, with its history for undo and redo. A value that the module's parser refuses stays in
/// json(); accepted() is then still the last material without such a value.
class Document {
 public:
    /// Opens a material file. Throws Error (input) if it is refused; nothing is written.
    static Document open(const std::filesystem::path& path);
    /// Opens a file as the start of a new material, which save() does not write over. Throws Error (input).
    static Document open_as_new(const std::filesystem::path& path);
    /// A new material. Files that it names are relative to `folder`. Throws Error (input) naming `name`.
    static Document make_new(Json material, std::string name, std::filesystem::path folder);

    const Json& json() const { return steps_[at_]; }
    /// The last material that was not refused; another pointer whenever it changes.
    const std::shared_ptr<const MaterialSource>& accepted() const { return accepted_; }
    const diffraction::Material& material() const { return accepted_->material; }
    const std::optional<Refusal>& refusal() const { return refusal_; }

    /// Edits. All edits of one field between two calls of finish_edit() are one step of undo.
    void set_value(const Field& field, const Json& value);
    void set_choice(const Field& field, const std::string& name);
    void revert(const Field& field);
    /// Replaces all members of the quality in one step.
    void replace_quality(const Json& quality);
    void finish_edit() { editing_ = nullptr; }

    bool can_undo() const { return at_ > 0; }
    bool can_redo() const { return at_ + 1 < steps_.size(); }
    void undo();
    void redo();

    /// Whether json() differs from the file, or there is no file.
    bool dirty() const { return !saved_ || saved_->json != json(); }
    /// The material in the file; null if there is none.
    const std::shared_ptr<const MaterialSource>& saved() const { return saved_; }
    /// Where save() writes; empty for a new material.
    const std::filesystem::path& path() const { return path_; }
    /// The file's name, or that of the file a new material started from.
    const std::string& name() const { return name_; }

    /// Writes the file completely or not at all. Throws Error: (input) if json() is refused or there is no path;
    /// (system) if the file cannot be written. The document is unchanged then.
    void save();
    /// Writes another file. Files that the material names stay where they are; their relative names are adapted.
    void save_as(const std::filesystem::path& path);
    /// Writes unsaved edits, refused or not, to a new file when the program must end: cd.unsaved.json beside cd.json;
    /// for a new material into the current folder; into the temporary folder if that fails. Returns nullopt if there
    /// are no edits. Throws Error (system).
    std::optional<std::filesystem::path> rescue() const;

 private:
    Document(Json material, std::string name, std::filesystem::path folder);
    void edit(Json edited, const Field* field);
    void move_to(std::size_t step);
    void reparse();
    void require_accepted() const;

    std::vector<Json> steps_;
    std::size_t at_ = 0;
    const Field* editing_ = nullptr;  ///< further edits of this field change the last step
    std::shared_ptr<const MaterialSource> saved_;
    std::filesystem::path path_;
    std::string name_;
    std::filesystem::path folder_;
    std::shared_ptr<const MaterialSource> accepted_;
    std::optional<Refusal> refusal_;
};

}  // namespace rowland::inspector
