#include "editor/inspector/document.h"

#include <fmt/format.h>

#include <utility>

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/core/utf8.h"
#include "modules/diffraction/asset/material_json.h"

namespace rowland::inspector {

namespace {

constexpr std::uint64_t kLargestMaterial = 1 << 20;
constexpr std::size_t kMostSteps = 1000;

std::shared_ptr<const MaterialSource> accept(const Json& material, const std::string& file,
                                             const std::filesystem::path& folder) {
    return std::make_shared<const MaterialSource>(MaterialSource{
        material, diffraction::parse_material(nlohmann::json(material), file, diffraction::read_beside(folder)), file});
}

/// Rewrites a file name that is relative to one folder so that it is relative to another.
void move_name(Json& name, const std::filesystem::path& from, const std::filesystem::path& to) {
    if (!name.is_string()) return;
    const std::filesystem::path file = name.get<std::string>();
    if (file.empty() || file.is_absolute()) return;
    name = require_utf8(std::filesystem::proximate(from / file, to), "rename it, or save elsewhere");
}

/// The material with its file names relative to another folder.
Json moved(Json material, const std::filesystem::path& from, const std::filesystem::path& to) {
    Json& profile = material["grating"]["profile"];
    if (profile.contains("file")) move_name(profile["file"], from, to);
    if (!material.contains("quality")) return material;
    Json& quality = material["quality"];
    if (quality.contains("illuminant") && quality["illuminant"].is_string() &&
        quality["illuminant"].get<std::string>().ends_with(".csv"))
        move_name(quality["illuminant"], from, to);
    if (quality.contains("probes"))
        for (Json& probe : quality["probes"]) move_name(probe.is_object() ? probe["image"] : probe, from, to);
    return material;
}

std::filesystem::path folder_of(const std::filesystem::path& path) {
    return std::filesystem::absolute(path).parent_path();
}

/// The first name that does not exist yet: cd.unsaved.json, cd.unsaved-2.json, …
std::filesystem::path unsaved_file(const std::filesystem::path& folder, const std::string& name) {
    const std::string stem = std::filesystem::path(name).stem().string();
    std::filesystem::path file = folder / (stem + ".unsaved.json");
    for (int i = 2; std::filesystem::exists(file); ++i) file = folder / fmt::format("{}.unsaved-{}.json", stem, i);
    return file;
}

}  // namespace

Document::Document(Json material, std::string name, std::filesystem::path folder)
    : name_(std::move(name)), folder_(std::move(folder)), accepted_(accept(material, name_, folder_)) {
    steps_.push_back(std::move(material));
}

Document Document::open(const std::filesystem::path& path) {
    Document document = open_as_new(path);
    document.path_ = path;
    document.saved_ = document.accepted_;
    return document;
}

Document Document::open_as_new(const std::filesystem::path& path) {
    const std::string text = read_text_file(path, kLargestMaterial);
    return make_new(parse_ordered(text, path.string()), path.filename().string(), folder_of(path));
}

Document Document::make_new(Json material, std::string name, std::filesystem::path folder) {
    return Document(std::move(material), std::move(name), std::move(folder));
}

void Document::set_value(const Field& field, const Json& value) {
    const bool pitch = &field == &field_at("/grating/pitch_nm") && value.is_number();
    edit(pitch ? with_pitch(json(), value.get<double>()) : with_value(json(), field, value), &field);
}

void Document::set_choice(const Field& field, const std::string& name) {
    edit(with_choice(json(), field, name), nullptr);
}

void Document::revert(const Field& field) {
    edit(reverted(json(), field), nullptr);
}

void Document::replace_quality(const Json& quality) {
    edit(with_value(json(), field_at("/quality"), quality), nullptr);
}

void Document::edit(Json edited, const Field* field) {
    if (edited == json()) return;
    steps_.resize(at_ + 1);
    if (field != nullptr && field == editing_ && at_ > 0) {
        steps_[at_] = std::move(edited);
    } else {
        steps_.push_back(std::move(edited));
        if (steps_.size() > kMostSteps) steps_.erase(steps_.begin());
        at_ = steps_.size() - 1;
    }
    editing_ = field;
    reparse();
}

void Document::undo() {
    if (can_undo()) move_to(at_ - 1);
}

void Document::redo() {
    if (can_redo()) move_to(at_ + 1);
}

void Document::move_to(std::size_t step) {
    at_ = step;
    editing_ = nullptr;
    reparse();
}

void Document::reparse() {
    refusal_.reset();
    if (json() == accepted_->json) return;
    try {
        accepted_ = accept(json(), name_, folder_);
    } catch (const Error& error) {
        const Field* field = field_of_refusal(error.info().location);
        // The parser names the table's file, not the material's, if a row of the table is wrong.
        if (field == nullptr && error.info().file != name_) field = &field_at("/grating/profile/file");
        refusal_ = Refusal{field, error.what()};
    }
}

void Document::require_accepted() const {
    if (refusal_)
        refuse_input(name_, {}, refusal_->message, "a material that can be cooked",
                     "nothing was written; correct the field or undo");
}

void Document::save() {
    require_accepted();
    if (path_.empty()) refuse_input(name_, {}, "a new material", "a file to save it to", "save it under a name");
    write_file_atomic(path_, format_json(json()));
    saved_ = accepted_;
    editing_ = nullptr;
}

void Document::save_as(const std::filesystem::path& path) {
    require_accepted();
    const std::filesystem::path folder = folder_of(path);
    Json there = moved(json(), folder_, folder);
    write_file_atomic(path, format_json(there));
    path_ = path;
    name_ = path.filename().string();
    folder_ = folder;
    edit(std::move(there), nullptr);
    saved_ = accepted_;
    editing_ = nullptr;
}

std::optional<std::filesystem::path> Document::rescue() const {
    if (!dirty() || steps_.size() == 1) return std::nullopt;
    const auto write_into = [&](const std::filesystem::path& folder) {
        std::filesystem::path file = unsaved_file(folder, name_);
        write_file_atomic(file, format_json(folder == folder_ ? json() : moved(json(), folder_, folder)));
        return file;
    };
    try {
        return write_into(path_.empty() ? std::filesystem::current_path() : folder_);
    } catch (const Error&) {
        return write_into(std::filesystem::temp_directory_path());
    }
}

}  // namespace rowland::inspector
