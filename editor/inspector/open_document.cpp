#include "editor/inspector/open_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "editor/inspector/groove_texture.h"
#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/core/json_reader.h"
#include "modules/diffraction/asset/gltf_extension.h"
#include "modules/diffraction/asset/material.h"
#include "modules/diffraction/foil/recipe.h"
#include "modules/thin_film/asset/gltf_iridescence.h"

namespace rowland::inspector {

namespace {

constexpr std::uint64_t kLargestSource = 16 << 20;
constexpr std::uint64_t kLargestPicture = 64 << 20;

constexpr Preset kPresets[] = {
    {"cd", "Compact disc, for any mesh", "Discs"},
    {"cd_pressed", "Compact disc, pressed", "Discs"},
    {"cd_r", "CD-R", "Discs"},
    {"dvd", "DVD", "Discs"},
    {"blu_ray", "Blu-ray disc", "Discs"},
    {"vinyl", "Vinyl record", "Discs"},
    {"cd_paper", "Compact disc of Lindsay & Agu 2006", "Discs"},
    {"ruled_600", "Ruled, 600 lines per mm", "Gratings"},
    {"ruled_1200", "Ruled, 1200 lines per mm", "Gratings"},
    {"holographic_foil", "Holographic foil", "Foils"},
    {"crossed_foil", "Crossed foil", "Foils"},
    {"diffraction_glasses", "Diffraction glasses", "Sheets and screens"},
    {"screen_door", "Insect screen", "Sheets and screens"},
    {"camera_under_display", "Display over a camera", "Sheets and screens"},
    {"phone_screen", "Phone screen", "Sheets and screens"},
    {"feather", "Feather", "Nature"},
    {"butterfly_wing", "Butterfly's wing", "Nature"},
    {"soap_film", "Soap film", "Thin films"},
    {"oil_on_water", "Oil on water", "Thin films"},
    {"coated_lens", "Coated lens", "Thin films"},
    {"anodised_titanium", "Anodised titanium", "Thin films"},
};

bool has_extension(const std::filesystem::path& path, std::initializer_list<const char*> extensions) {
    return std::ranges::count(extensions, path.extension().string()) > 0;
}

bool is_scene_file(const std::filesystem::path& path) {
    return has_extension(path, {".gltf", ".glb"});
}

/// The object of a valid material file in the folder `from`, as a scene in `folder` holds it. `file` is for messages.
Json as_extension(const Json& material, const std::filesystem::path& from, const std::filesystem::path& folder,
                  const std::string& file) {
    return holds_film(material) ? thin_film::gltf_object(material, file)
                                : diffraction::gltf_object(material, from, folder);
}

const char* kind_of(const Document& document) {
    return document.has_film() ? "film" : "grating";
}

bool is_table(const diffraction::Grating& grating) {
    return std::holds_alternative<diffraction::EfficiencyTable>(grating.profile);
}

}  // namespace

bool is_light_file(const std::filesystem::path& path) {
    if (has_extension(path, {".hdr", ".exr", ".pic", ".probe"})) return true;
    if (is_scene_file(path) || is_picture_file(path) || has_extension(path, {".csv"})) return false;
    const nlohmann::json json = parse_json(read_text_file(path, kLargestSource), path.string());
    return json.is_object() && json.contains("probe");
}

bool is_picture_file(const std::filesystem::path& path) {
    return has_extension(path, {".png", ".jpg", ".jpeg"});
}

bool is_foil_recipe_file(const std::filesystem::path& path) {
    return has_extension(path, {".json"}) &&
           diffraction::foil::is_foil_recipe(parse_json(read_text_file(path, kLargestSource), path.string()));
}

OpenDocument::OpenDocument(std::filesystem::path presets, Messages& messages)
    : presets_(std::move(presets)),
      messages_(messages),
      document_(Document::open_as_new(presets_ / "cd.json")),
      cook_(std::make_shared<SurfaceCook>(nullptr)) {}

std::string OpenDocument::chosen_name() const {
    return scene() != nullptr && document_.chosen() < scene()->materials.size()
               ? scene()->materials[document_.chosen()].name
               : document_.name();
}

void OpenDocument::open(const std::filesystem::path& path) {
    const std::string file = path.filename().string();
    messages_.attempt([&] {
        if (is_scene_file(path)) {
            opening_path_ = std::make_shared<const std::filesystem::path>(path);
        } else if (is_picture_file(path)) {
            use_picture(read_file(path, kLargestPicture), file);
        } else if (has_extension(path, {".csv"})) {
            opened_table_ = diffraction::parse_efficiency_csv(read_text_file(path, diffraction::kMaximumNamedFileSize),
                                                              path.string());
            messages_.say(file + ": compared with the efficiencies of the profile");
        } else {
            use_material(Document::open(path), path);
        }
    });
}

bool OpenDocument::open_preset(const std::string& name) {
    const std::filesystem::path path = presets_ / (name + ".json");
    return messages_.attempt([&] { use_material(Document::open_as_new(path), path); });
}

OpenDocument::~OpenDocument() {
    std::error_code ignored;
    if (demo_copy_) std::filesystem::remove(*demo_copy_, ignored);
}

std::vector<std::string> OpenDocument::demo_arguments() {
    std::filesystem::path file = document_.folder() / document_.name();
    if (auto copy = document_.rescue(demo_copy_)) file = *(demo_copy_ = std::move(copy));
    if (document_.is_scene()) return {"--scene", file.string()};
    return {"--disc", "--material", file.string()};
}

std::span<const Preset> OpenDocument::presets() {
    return kPresets;
}

bool OpenDocument::is_replaced_by(const std::filesystem::path& path) const {
    if (is_scene_file(path)) return true;
    if (document_.is_scene() || is_picture_file(path) || has_extension(path, {".csv"})) return false;
    try {
        return !is_light_file(path);
    } catch (const Error&) {
        return false;  // the file will be refused
    }
}

void OpenDocument::close_scene() {
    if (document_.is_scene()) messages_.attempt([&] { replace(Document::open_as_new(presets_ / "cd.json"), nullptr); });
}

void OpenDocument::replace(Document document, std::shared_ptr<const PreviewObject> object) {
    document_ = std::move(document);
    ++replacements_;
    object_ = std::move(object);
    cook_ = std::make_shared<SurfaceCook>(object_ ? object_->scene : nullptr);
    scene_surfaces_.reset();
    if (object_) return;
    messages_.say(document_.name() + (document_.path().empty() ? ": the start of a new material" : ": opened"));
}

void OpenDocument::replace(OpenedScene opened) {
    auto object = std::make_shared<const PreviewObject>(
        PreviewObject{PreviewShape::Scene, upload(*opened.object), opened.object});
    replace(std::move(opened.document), std::move(object));
    const std::string file = document_.name();
    for (const std::string& warning : scene()->imported.warnings) messages_.say(fmt::format("{}: {}", file, warning));
    std::size_t surfaces = 0;
    for (std::size_t i = 0; i < document_.material_count(); ++i) surfaces += document_.accepted(i) ? 1 : 0;
    messages_.say(
        fmt::format("{}: opened: {} materials, {} with a grating or film", file, scene()->materials.size(), surfaces));
}

void OpenDocument::use_material(Document material, const std::filesystem::path& path) {
    if (!document_.is_scene()) return replace(std::move(material), nullptr);
    document_.set_extension(
        as_extension(material.json(), std::filesystem::absolute(path).parent_path(), document_.folder(), path.string()),
        material.name());
    messages_.say(material.name() + ": the " + kind_of(document_) + " of " + chosen_name());
}

void OpenDocument::start_opening() {
    opening_.want(
        opening_path_ ? std::optional(opening_path_) : std::nullopt,
        [path = opening_path_](const std::stop_token& stop, auto&&) -> std::optional<std::shared_ptr<OpenedScene>> {
            auto object = load_scene_object(*path);
            Document document = Document::open_scene(scene::EditableGltf::open(*path), object->without_material);
            if (stop.stop_requested()) return std::nullopt;
            return std::make_shared<OpenedScene>(OpenedScene{std::move(object), std::move(document)});
        });
}

bool OpenDocument::take_opened(const Opening::Change& change) {
    if (!change.failure.empty()) {
        messages_.say(change.failure, true);
        opening_path_.reset();
        return true;
    }
    if (!change.value || !opening_path_) return change.value;
    opening_path_.reset();
    messages_.attempt([&] { replace(std::move(**opening_.value())); });
    opening_.reset();
    return true;
}

void OpenDocument::finish_opening() {
    start_opening();
    take_opened(opening_.wait());
}

void OpenDocument::cancel_opening() {
    if (!opening_path_) return;
    messages_.say(opening_path_->filename().string() + ": not opened");
    opening_path_.reset();
    opening_.reset();
}

void OpenDocument::save(bool over_changes) {
    asks_to_overwrite = !over_changes && document_.changed_outside();
    if (asks_to_overwrite) return messages_.say(document_.name() + ": changed by another program since it was opened");
    if (messages_.attempt([&] { document_.save(over_changes); })) messages_.say(document_.path().string() + ": saved");
}

void OpenDocument::save_as(const std::filesystem::path& path) {
    if (messages_.attempt([&] { document_.save_as(path); })) messages_.say(path.string() + ": saved");
}

void OpenDocument::paste(const std::string& text) {
    messages_.attempt([&] {
        const Json object = parse_ordered(text, "the clipboard");
        const bool is_file = object.is_object() && object.contains("film");
        if (is_file) accept_material(object, "the clipboard", document_.folder());
        document_.set_extension(
            is_file ? as_extension(object, document_.folder(), document_.folder(), "the clipboard") : object,
            "the clipboard");
        messages_.say(fmt::format("the {} of {} is the clipboard's", kind_of(document_), chosen_name()));
    });
}

void OpenDocument::remove() {
    messages_.attempt([&] {
        const std::string kind = kind_of(document_);
        document_.set_extension(nullptr, document_.name());
        messages_.say(chosen_name() + ": without a " + kind);
    });
}

void OpenDocument::use_picture(std::vector<std::byte> picture, const std::string& name) {
    if (document_.is_scene() && document_.has_film())
        return set_texture(field_at("/iridescenceThicknessTexture"), std::move(picture), name);
    set_groove_texture(as_groove_texture(picture, name),
                       std::filesystem::path(name).replace_extension(".png").string());
}

void OpenDocument::set_groove_texture(std::vector<std::byte> picture, const std::string& name) {
    if (!document_.is_scene() || !document_.has_grating())
        refuse_input(name, {}, "a picture", "a scene with a grating or a film on the chosen material",
                     "open a .gltf or .glb, choose a material and attach a grating or a film; the picture then varies "
                     "its grooves or thickness");
    set_texture(field_at("/grooveTexture"), std::move(picture), name);
}

void OpenDocument::set_texture(const Field& field, std::vector<std::byte> picture, const std::string& name) {
    const std::size_t index = document_.new_textures().add(std::move(picture), name);
    Json texture = value_of(field, document_.json());
    if (texture.is_null()) texture = Json::object();
    texture["index"] = index;
    document_.finish_edit();
    document_.set_value(field, texture);
    document_.finish_edit();
    messages_.say(fmt::format("{}: the {} of {}", name, document_.has_film() ? "thickness" : "grooves", chosen_name()));
}

void OpenDocument::set_foil_pattern(const std::string& name) {
    messages_.attempt([&] { set_groove_texture(foil_pattern(name), name + ".png"); });
}

void OpenDocument::cook(Cooking& cooking, const std::shared_ptr<const MaterialSource>& source) {
    cooking.want(
        source ? std::optional(source) : std::nullopt,
        [cook = cook_, source, material = document_.chosen()](auto&&...) { return cook->cook(*source, material); });
}

bool OpenDocument::update() {
    start_opening();
    bool news = take_opened(opening_.poll());
    cook(cooked_, document_.accepted());
    cook(saved_, document_.saved());
    const auto change = cooked_.poll();
    if (!change.failure.empty()) messages_.say(change.failure, true);
    if (change.value && (*cooked_.value())->material && !is_table((*cooked_.value())->material->material.grating))
        last_scalar_ = (*cooked_.value())->material->material.grating;
    news = change.value || !change.failure.empty() || news;
    news = saved_.poll().value || news;  // cooked_ reports the same failure
    news = scene_surfaces_.update(document_, cook_, cooked_.current() ? *cooked_.value() : nullptr) || news;
    for (std::string& failure : scene_surfaces_.take_failures()) messages_.say(std::move(failure), true);
    return news;
}

bool OpenDocument::busy() const {
    const auto& source = document_.accepted();
    return !cooked_.wants(source ? std::optional(source) : std::nullopt) || cooked_.busy() || saved_.busy() ||
           scene_surfaces_.busy() || opening_path_ != nullptr;
}

std::shared_ptr<const CookedSurface> OpenDocument::surface(bool as_saved) const {
    const Cooking& cooking = as_saved ? saved_ : cooked_;
    const bool is_there = (as_saved ? document_.saved() : document_.accepted()) != nullptr;
    return is_there && cooking.value() != nullptr ? *cooking.value() : nullptr;
}

CookedSurfaces OpenDocument::surfaces(bool as_saved) const {
    CookedSurfaces all = scene_surfaces_.all();
    if (as_saved) all.at(document_.chosen()) = surface(true);
    return all;
}

std::shared_ptr<const thin_film::CookedFilm> OpenDocument::film() const {
    const auto cooked = document_.has_film() ? surface(false) : nullptr;
    return cooked && cooked->film ? cooked->film->cooked : nullptr;
}

std::optional<diffraction::Grating> OpenDocument::compared() const {
    if (!document_.has_grating()) return std::nullopt;
    diffraction::Grating other = document_.material().grating;
    if (is_table(other) && last_scalar_) return last_scalar_;
    if (!opened_table_) return std::nullopt;
    other.profile = *opened_table_;
    other.metal.reset();
    other.normalization = diffraction::Normalization::Energy;
    return other;
}

}  // namespace rowland::inspector
