#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "editor/inspector/field.h"
#include "modules/diffraction/foil/card.h"

namespace rowland::inspector {

/// The fields of a foil recipe that a type of foil has, in the order of display. Ranges and defaults are those of the
/// recipe's JSON Schema. Pictures are of FieldKind::Name.
std::span<const Field> foil_fields(std::string_view type);

/// "Cracked ice" for "cracked_ice".
std::string shown_foil_type(std::string_view type);

/// The pictures of a recipe, as they were when they were chosen, by their paths. May be used from several threads.
class FoilPictures {
 public:
    /// Reads a file, again if it was read before. Throws Error (input).
    void read(const std::filesystem::path& file);
    bool contains(const std::string& path) const;
    /// Another number after each read().
    std::size_t revision() const;

    /// Those that a recipe names. `most`: larger ones are reduced to so many texels a side; none: as the files are.
    /// Throws Error (input) for a picture that is to be reduced and cannot be decoded.
    diffraction::foil::NamedPictures of(const diffraction::foil::Recipe& recipe, std::optional<int> most) const;

 private:
    using Picture = std::shared_ptr<const diffraction::foil::NamedPicture>;

    Picture at(const std::string& path, std::optional<int> most) const;

    mutable std::mutex lock_;
    std::map<std::string, Picture> whole_;
    mutable std::map<std::pair<Picture, int>, Picture> reduced_;
    std::size_t revision_ = 0;
};

/// An edited foil recipe with its pictures, and the history for undo and redo. json() may hold values that the recipe's
/// parser refuses; accepted() is the last one without such a value.
class FoilRecipe {
 public:
    /// A recipe for an artwork, with all defaults. Throws Error (input) if the file cannot be read.
    static FoilRecipe make_new(const std::filesystem::path& artwork);
    /// Throws Error (input) for a recipe that is refused, and for pictures that cannot be read.
    static FoilRecipe open(const std::filesystem::path& path);

    /// The names of pictures are absolute paths.
    const Json& json() const { return json_; }
    const diffraction::foil::Recipe& accepted() const { return accepted_; }
    std::shared_ptr<const FoilPictures> pictures() const { return pictures_; }
    /// Why json() is refused; empty: it is accepted.
    const std::string& refusal() const { return refusal_; }
    /// The field that a refusal, of the recipe or of a card made of it, is about; null: no single field.
    const Field* field_of(std::string_view refusal) const;

    std::string type() const;
    std::span<const Field> fields() const { return foil_fields(type()); }

    /// Sets a field; its default removes the member. All edits of one field between two calls of finish_edit() are one
    /// step of undo. Throws Error (input) for a picture that cannot be read; nothing is changed then.
    void set(const Field& field, const Json& value);
    /// Chooses a type of foil. What types have in common keeps its value; a type that was chosen before has its numbers
    /// again; pictures that a type needs are the artwork until they are set.
    void set_type(std::string_view type);
    /// json() with that type, as set_type() makes it.
    Json with_type(std::string_view type) const;
    /// A text that differs where cards of such a json() may: with what its pictures are.
    std::string key(const Json& json) const { return json.dump() + std::to_string(pictures_->revision()); }
    void finish_edit() { editing_.clear(); }

    bool can_undo() const { return at_ > 0; }
    bool can_redo() const { return at_ + 1 < steps_.size(); }
    void undo();
    void redo();

    bool dirty() const { return json_ != saved_; }
    /// Empty: not saved yet.
    const std::filesystem::path& path() const { return path_; }
    /// The name of the file; of a new recipe the artwork's, with ".json".
    std::string name() const;
    /// Where files of the card are suggested: beside the recipe or the artwork.
    std::filesystem::path suggested(const std::string& extension) const;
    /// Writes the recipe, whose pictures are named relative to its folder. Throws Error: (input) if json() is refused,
    /// (system) if it cannot be written.
    void save(const std::filesystem::path& path);

 private:
    FoilRecipe() = default;
    void read_pictures(const Json& json);
    void accept(Json json);
    void step(Json json, const std::string& editing);

    Json json_;
    Json saved_;
    diffraction::foil::Recipe accepted_;
    std::string refusal_;
    std::filesystem::path path_;
    std::shared_ptr<FoilPictures> pictures_ = std::make_shared<FoilPictures>();
    std::map<std::string, Json, std::less<>> last_of_type_;
    std::vector<Json> steps_;  ///< json_ is that at at_
    std::size_t at_ = 0;
    std::string editing_;  ///< pointer of the field whose further edits change the last step
};

}  // namespace rowland::inspector
