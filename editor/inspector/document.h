#pragma once

#include <cstdint>
#include <filesystem>
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

/// A material file that is being edited: what it says, what the module makes of it, the way back. A value that the
/// module's parser refuses stays where it was put, and the last good material stays beside it.
class Document {
 public:
    /// Opens a material file. Throws Error (input) if it is refused; nothing is written.
    static Document open(const std::filesystem::path& path);
    /// Opens a file as a start for a new material: it is never written over. Throws likewise.
    static Document open_as_new(const std::filesystem::path& path);
    /// A new material. `folder`: where files that it names are. Throws Error (input) naming `name`.
    static Document make_new(Json material, std::string name, std::filesystem::path folder);

    const Json& json() const { return steps_[at_]; }
    /// The last material that was not refused.
    const diffraction::Material& material() const { return material_; }
    /// Its source.
    const Json& good_json() const { return good_json_; }
    /// Grows whenever material() changes.
    std::uint64_t version() const { return version_; }
    const std::optional<Refusal>& refusal() const { return refusal_; }

    /// Edits. Those of one field between two calls of finish_edit() are one step back.
    void set_value(const Field& field, const Json& value);
    void set_choice(const Field& field, const std::string& name);
    void revert(const Field& field);
    /// Several members at once, as one step: the quality that a budget chose.
    void replace_quality(const Json& quality);
    void finish_edit() { editing_ = nullptr; }

    bool can_undo() const { return at_ > 0; }
    bool can_redo() const { return at_ + 1 < steps_.size(); }
    void undo();
    void redo();

    /// Whether there is something that no file holds.
    bool dirty() const { return !saved_ || *saved_ != json(); }
    /// The material as saved last; null if it never was.
    const Json* saved() const { return saved_ ? &*saved_ : nullptr; }
    /// Where save() writes; empty for a new material.
    const std::filesystem::path& path() const { return path_; }
    /// The file's name, or what a new material was made from.
    const std::string& name() const { return name_; }
    /// Where files that the material names are.
    const std::filesystem::path& folder() const { return folder_; }

    /// Writes the file whole or not at all. Throws Error: (input) if the material is refused as it is, or there is no
    /// path; (system) if it cannot be written. The document is then as it was.
    void save();
    /// The same elsewhere; files that the material names stay where they are, named from the new place.
    void save_as(const std::filesystem::path& path);
    /// Writes edits that no file holds, refused or not, to a new file, when the program must end: cd.unsaved.json
    /// beside cd.json; for a new material in the current folder; in the temporary one if that cannot be written.
    /// Nothing if there are none. Throws Error (system).
    std::optional<std::filesystem::path> rescue() const;

 private:
    Document(Json material, std::string name, std::filesystem::path folder);
    void edit(Json edited, const Field* field);
    void reparse();
    void require_sane() const;

    std::vector<Json> steps_;
    std::size_t at_ = 0;
    const Field* editing_ = nullptr;  ///< whose edits the last step holds
    std::optional<Json> saved_;
    std::filesystem::path path_;
    std::string name_;
    std::filesystem::path folder_;
    diffraction::Material material_;
    Json good_json_;
    std::uint64_t version_ = 1;
    std::optional<Refusal> refusal_;
};

}  // namespace rowland::inspector
