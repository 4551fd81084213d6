#include "editor/inspector/document.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/core/text.h"
#include "engine/scene/gltf_check.h"
#include "engine/scene/gltf_source.h"
#include "modules/diffraction/asset/gltf_extension.h"
#include "modules/diffraction/asset/material.h"

namespace rowland::inspector {

namespace {

constexpr std::uint64_t kLargestMaterial = 1 << 20;
constexpr std::size_t kMostSteps = 1000;
constexpr std::array kTextures = {"/grooveTexture/index", "/iridescenceTexture/index",
                                  "/iridescenceThicknessTexture/index"};
constexpr std::array kExtensions = {diffraction::kGltfExtension, thin_film::kIridescenceExtension};

std::filesystem::path folder_of(const std::filesystem::path& path) {
    return std::filesystem::absolute(path).parent_path();
}

/// The first name that does not exist yet: cd.unsaved.json, cd.unsaved-2.json, …
std::filesystem::path unsaved_file(const std::filesystem::path& folder, const std::filesystem::path& name,
                                   const std::string& extension) {
    const std::string stem = name.stem().string();
    std::filesystem::path file = folder / (stem + ".unsaved" + extension);
    for (int i = 2; std::filesystem::exists(file); ++i)
        file = folder / fmt::format("{}.unsaved-{}{}", stem, i, extension);
    return file;
}

}  // namespace

const char* extension_of(const Json& object) {
    return holds_film(object) ? thin_film::kIridescenceExtension : diffraction::kGltfExtension;
}

std::shared_ptr<const MaterialSource> accept_material(const Json& material, const std::string& file,
                                                      const std::filesystem::path& folder) {
    const nlohmann::json json(material);
    MaterialSource source{.json = material, .name = file, .parsed = {}};
    if (json.is_object() && json.contains("film")) {
        source.parsed = thin_film::parse_film_material(json, file);
    } else {
        diffraction::GltfGrating alone;
        alone.material = diffraction::parse_material(json, file, diffraction::read_beside(folder));
        alone.has_base = true;
        source.parsed = std::move(alone);
    }
    return std::make_shared<const MaterialSource>(std::move(source));
}

std::shared_ptr<const MaterialSource> accept_extension(const Json& extension, const std::string& file,
                                                       const std::filesystem::path& folder, const std::string& pointer,
                                                       const NewTextures* textures) {
    const nlohmann::json json(extension);
    MaterialSource source{.json = extension, .name = file, .parsed = {}};
    if (textures != nullptr) source.textures = *textures;
    if (holds_film(extension))
        source.parsed = thin_film::parse_gltf_iridescence(json, file, pointer);
    else
        source.parsed = diffraction::parse_gltf_extension(json, file, folder, pointer);
    return std::make_shared<const MaterialSource>(std::move(source));
}

Json moved(Json material, const std::filesystem::path& from, const std::filesystem::path& to) {
    if (from == to) return material;
    diffraction::move_named_files(material, from, to);
    if (!material.is_object() || !material.contains("quality") || !material["quality"].contains("probes"))
        return material;
    for (Json& probe : material["quality"]["probes"]) {
        Json& name = probe.is_object() ? probe["image"] : probe;
        if (name.is_string())
            name = require_utf8(std::filesystem::proximate(from / name.get<std::string>(), to).generic_string(),
                                "rename it, or save elsewhere");
    }
    return material;
}

Document Document::open(const std::filesystem::path& path) {
    Document document = open_as_new(path);
    document.path_ = path;
    document.mark_saved();
    return document;
}

Document Document::open_as_new(const std::filesystem::path& path) {
    const std::string text = read_text_file(path, kLargestMaterial);
    return make_new(parse_ordered(text, path.string()), path.filename().string(), folder_of(path));
}

Document Document::make_new(Json material, std::string name, std::filesystem::path folder) {
    Document document(std::move(name), std::move(folder));
    auto accepted = accept_material(material, document.name_, document.folder_);
    document.slots_.push_back({.json = std::move(material), .accepted = std::move(accepted)});
    return document;
}

Document Document::open_scene(scene::EditableGltf file, std::span<const scene::PrimitiveId> without_material) {
    const std::filesystem::path path = file.path();
    Document document(path.filename().string(), folder_of(path));
    document.path_ = path;
    for (std::size_t i = 0; i < file.outline().materials.size(); ++i) {
        Slot slot;
        for (const char* name : kExtensions) {
            const Json object = file.material_extension(i, name);
            if (object.is_null()) continue;
            const std::string pointer = fmt::format("/materials/{}/extensions/{}", i, name);
            if (std::string_view(name) != extension_of(object))
                refuse_input(path.string(), pointer + "/grating", holds_film(object) ? "missing" : "a grating",
                             holds_film(object) ? "a grating" : "a film");
            if (slot.accepted)
                refuse_input(path.string(), pointer, "a film on a grating", "one of them",
                             "remove one with rowland-cook attach --remove");
            slot.json = object;
            slot.accepted = accept_extension(object, path.string(), document.folder_, pointer);
        }
        document.slots_.push_back(std::move(slot));
    }
    for (const scene::PrimitiveId& primitive : without_material) document.slots_.push_back({.primitive = primitive});
    if (document.slots_.empty()) document.slots_.emplace_back();
    const auto first = std::ranges::find_if(document.slots_, [](const Slot& slot) { return !slot.json.is_null(); });
    if (first != document.slots_.end()) document.chosen_ = static_cast<std::size_t>(first - document.slots_.begin());
    document.file_ = std::move(file);
    document.boxes_ = document.file_->nodes_with(scene::kProbeExtension);
    document.mark_saved();
    return document;
}

void Document::choose(std::size_t material) {
    if (material >= slots_.size()) return;
    chosen_ = material;
    editing_ = nullptr;
}

const std::shared_ptr<const MaterialSource>& Document::accepted(std::size_t material) const {
    static const std::shared_ptr<const MaterialSource> none;
    const Slot& slot = slots_.at(material);
    return slot.json.is_null() ? none : slot.accepted;
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

void Document::set_extension(const Json& object, const std::string& name) {
    if (!is_scene()) refuse_input(name_, {}, "a material file", "a scene", "open a .gltf or .glb file");
    if (!object.is_null()) accept_extension(object, name, folder_);
    edit(object, nullptr);
}

void Document::edit(const Json& edited, const Field* field) {
    if (edited == json()) return;
    if (field != nullptr && field == editing_ && at_ > 0)
        std::get<MaterialEdit>(steps_.back()).after = edited;
    else
        add_step(MaterialEdit{chosen_, json(), edited});
    set(chosen_, edited);
    editing_ = field;
}

void Document::set_boxes(const std::vector<scene::ExtendedNode>& boxes) {
    if (boxes == boxes_) return;
    for (const scene::ExtendedNode& box : boxes)
        scene::relative_path_of_uri(name_, box.extension.at("probe"), "the light probe of " + box.name);
    if (editing_ == &boxes_ && at_ > 0)
        std::get<BoxEdit>(steps_.back()).after = boxes;
    else
        add_step(BoxEdit{boxes_, boxes});
    take_boxes(boxes);
    editing_ = &boxes_;
}

void Document::add_step(Step step) {
    steps_.resize(at_);
    steps_.push_back(std::move(step));
    if (steps_.size() > kMostSteps) steps_.erase(steps_.begin());
    at_ = steps_.size();
}

void Document::take_boxes(const std::vector<scene::ExtendedNode>& boxes) {
    boxes_ = boxes;
    editing_ = nullptr;
    ++revision_;
}

void Document::undo() {
    if (!can_undo()) return;
    const Step& step = steps_[--at_];
    if (const auto* edit = std::get_if<MaterialEdit>(&step))
        set(edit->material, edit->before);
    else
        take_boxes(std::get<BoxEdit>(step).before);
}

void Document::redo() {
    if (!can_redo()) return;
    const Step& step = steps_[at_++];
    if (const auto* edit = std::get_if<MaterialEdit>(&step))
        set(edit->material, edit->after);
    else
        take_boxes(std::get<BoxEdit>(step).after);
}

void Document::set(std::size_t material, const Json& json) {
    chosen_ = material;
    editing_ = nullptr;
    ++revision_;
    slots_[material].json = json;
    reparse(slots_[material]);
}

void Document::reparse(Slot& slot) const {
    slot.refusal.reset();
    if (slot.json.is_null() || (slot.accepted && slot.json == slot.accepted->json)) return;
    try {
        slot.accepted = is_scene() ? accept_extension(slot.json, name_, folder_, {}, &new_textures_)
                                   : accept_material(slot.json, name_, folder_);
    } catch (const Error& error) {
        const Field* field = field_of_refusal(error.info().location, slot.json);
        // For wrong content of a table or a height map the parser names that file instead of the material's.
        if (field == nullptr && error.info().file != name_) field = shown_field("/grating/profile/file", slot.json);
        slot.refusal = Refusal{field, error.what()};
    }
}

bool Document::dirty() const {
    return path_.empty() || boxes_ != boxes_in_file_ ||
           std::ranges::any_of(slots_, [](const Slot& slot) { return slot.json != slot.in_file; });
}

void Document::require_accepted() const {
    for (const Slot& slot : slots_)
        if (slot.refusal)
            refuse_input(name_, {}, slot.refusal->message, "a material that can be cooked",
                         "nothing was written; correct the field or undo");
}

void Document::mark_saved() {
    for (Slot& slot : slots_) {
        slot.in_file = slot.json;
        slot.saved = slot.json.is_null() ? nullptr : slot.accepted;
    }
    boxes_in_file_ = boxes_;
    editing_ = nullptr;
}

scene::EditableGltf Document::edited_file(const std::filesystem::path& folder) const {
    scene::EditableGltf file = *file_;
    for (std::size_t i = 0; i < slots_.size(); ++i) {
        Json extension = moved(slots_[i].json, folder_, folder);
        if (extension == slots_[i].in_file) continue;
        for (const char* index : kTextures) {
            if (!extension.contains(Json::json_pointer(index))) continue;
            Json& texture = extension[Json::json_pointer(index)];
            if (const auto added =
                    texture.is_number_unsigned() ? new_textures_.find(texture.get<std::size_t>()) : nullptr)
                texture = file.add_texture(added->bytes, added->name);
        }
        const std::size_t material = slots_[i].primitive ? file.own_material(*slots_[i].primitive) : i;
        for (const std::string name : kExtensions)
            file.set_material_extension(material, name, name == extension_of(extension) ? extension : Json());
    }
    if (boxes_ != boxes_in_file_) file.set_nodes_with(scene::kProbeExtension, boxes_);
    return file;
}

void Document::write(const std::filesystem::path& path, bool over_changes) {
    using IfChanged = scene::EditableGltf::IfChanged;
    require_accepted();
    const std::filesystem::path folder = folder_of(path);
    if (file_) {
        scene::EditableGltf file = edited_file(folder);
        file.save(path, over_changes ? IfChanged::Overwrite : IfChanged::Refuse);
        file_ = std::move(file);
        boxes_ = file_->nodes_with(scene::kProbeExtension);  // new ones have an index now
    } else {
        write_file_atomic(path, format_json(moved(json(), folder_, folder)));
    }
}

void Document::save(bool over_changes) {
    if (path_.empty()) {
        require_accepted();
        refuse_input(name_, {}, "a new material", "a file to save it to", "save it under a name");
    }
    write(path_, over_changes);
    mark_saved();
}

void Document::save_as(const std::filesystem::path& path) {
    write(path, true);
    const std::filesystem::path from = std::exchange(folder_, folder_of(path));
    path_ = path;
    name_ = path.filename().string();
    for (std::size_t i = 0; i < slots_.size(); ++i) {
        const Json there = moved(slots_[i].json, from, folder_);
        if (there == slots_[i].json) continue;
        add_step(MaterialEdit{i, slots_[i].json, there});
        slots_[i].json = there;
        reparse(slots_[i]);
    }
    mark_saved();
}

void Document::write_copy(const std::filesystem::path& path, const std::filesystem::path& folder) const {
    if (file_)
        edited_file(folder).save(path, scene::EditableGltf::IfChanged::Overwrite);
    else
        write_file_atomic(path, format_json(moved(json(), folder_, folder)));
}

std::optional<std::filesystem::path> Document::rescue(const std::optional<std::filesystem::path>& earlier) const {
    if (!dirty() || steps_.empty()) return std::nullopt;
    const std::string extension = file_ ? path_.extension().string() : ".json";
    const auto write_into = [&](const std::filesystem::path& folder) {
        std::filesystem::path file =
            earlier && earlier->parent_path() == folder ? *earlier : unsaved_file(folder, name_, extension);
        write_copy(file, folder);
        return file;
    };
    try {
        return write_into(path_.empty() ? std::filesystem::current_path() : folder_);
    } catch (const Error&) {
        return write_into(std::filesystem::temp_directory_path());
    }
}

bool Autosave::update(const Document& document, std::size_t replacements, Clock::time_point now) {
    constexpr std::chrono::minutes kDelay(1);
    const bool had_file = file_.has_value();
    if (std::exchange(replacements_, replacements) != replacements || !document.dirty() || !document.can_undo()) {
        discard();
        return had_file;
    }
    if (written_ == document.revision()) return false;
    if (!due_) due_ = now + kDelay;
    if (now < *due_) return false;
    due_.reset();
    written_ = document.revision();
    write(document);
    return !had_file;
}

void Autosave::discard() {
    std::error_code ignored;
    if (file_) std::filesystem::remove(*file_, ignored);
    file_.reset();
    due_.reset();
    written_ = 0;
}

}  // namespace rowland::inspector
