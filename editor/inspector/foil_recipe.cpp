#include "editor/inspector/foil_recipe.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/core/json_schema.h"
#include "engine/image/byte_image.h"
#include "modules/diffraction/foil/grating.h"
#include "modules/diffraction/foil/raster.h"

namespace rowland::inspector {

namespace foil = diffraction::foil;

namespace {

constexpr std::uint64_t kLargestRecipe = 1 << 20;
constexpr const char* kFirstType = "cracked_ice";  ///< of a recipe that names none
constexpr int kLargestSide = 8192;                 ///< texels; what a card takes at most
constexpr std::uint64_t kLargestPicture = std::uint64_t{256} << 20;

/// What a control shows of a member; the recipe's schema has its range and default.
struct Control {
    const char* pointer;
    const char* label;
    const char* unit;
    FieldKind kind;
    const char* help;
};

constexpr std::array kControls = {
    Control{"/artwork", "Artwork", "", FieldKind::Name, "The printed picture, PNG or JPEG. It fills the card."},
    Control{"/mask", "Foil mask", "", FieldKind::Name,
            "White where there is foil, black where there is paper. Without it there is foil everywhere."},
    Control{"/foil/picture_a", "Picture A", "", FieldKind::Name, "Bright where it shines at its tilt."},
    Control{"/foil/picture_b", "Picture B", "", FieldKind::Name, "Bright where it shines at its tilt."},
    Control{"/foil/drawing", "Drawing", "", FieldKind::Name,
            "Black strokes on white or white ones on black. Light runs along them."},
    Control{"/foil/size_mm", "Piece size", "mm", FieldKind::Number,
            "Width of a piece, mean distance of shards, or the largest of the dots."},
    Control{"/foil/size_um", "Flake size", "µm", FieldKind::Number, "Width of a sparkling flake."},
    Control{"/foil/directions", "Directions", "", FieldKind::Count, "How many directions of grooves the pieces have."},
    Control{"/foil/band_mm", "Band width", "mm", FieldKind::Number, "Width of a vertical band."},
    Control{"/foil/pitch_range", "Colour range", "×", FieldKind::Number,
            "Largest distance of grooves in a band over the smallest: how much of the rainbow it holds."},
    Control{"/foil/grooves", "Grooves", "", FieldKind::Choice, "Rays make a sunburst, circles the fans of a disc."},
    Control{"/foil/centre", "Centre", "", FieldKind::Pair,
            "From the lower left corner, in widths and heights of the card."},
    Control{"/foil/stroke_mm", "Stroke width", "mm", FieldKind::Number, "Width of a brushed stroke."},
    Control{"/foil/length_mm", "Stroke length", "mm", FieldKind::Number, "Length of a brushed stroke."},
    Control{"/foil/angle_spread_deg", "Disorder", "°", FieldKind::Number,
            "How far the strokes' angles differ; standard deviation."},
    Control{"/foil/tilts_deg", "Tilts of A, B", "°", FieldKind::Pair,
            "Tilt at which each picture is seen, about the horizontal axis; positive turns the top edge away."},
    Control{"/foil/lamp_deg", "Lamp above eye", "°", FieldKind::Number,
            "How far above the eye the lamp stands for which the tilts hold."},
    Control{"/foil/cell_mm", "Cell", "mm", FieldKind::Number, "Width of the cells in which A and B alternate."},
    Control{"/foil/focal_mm", "Floats by", "mm", FieldKind::Number,
            "How far before the card the lamp's image floats: the focal length."},
    Control{"/foil/smooth_mm", "Smoothing", "mm", FieldKind::Number,
            "Width over which the directions of strokes are averaged."},
    Control{"/foil/scale", "Scale", "×", FieldKind::Number, "Multiplies all lengths of the pattern."},
    Control{"/foil/direction_deg", "Direction", "°", FieldKind::Number, "Turns all grooves, counter-clockwise."},
    Control{"/foil/groove_um", "Groove distance", "µm", FieldKind::Number,
            "Finer grooves spread the colours over wider angles."},
    Control{"/foil/spread_deg", "Spread", "°", FieldKind::Number,
            "How far a groove spreads light along itself: small sparkles, large is calm."},
    Control{"/foil/seed", "Variation", "", FieldKind::Count, "Another number gives another random pattern."},
    Control{"/ink", "Ink", "", FieldKind::Choice,
            "Opaque ink hides the foil, which shows where the artwork is transparent. Otherwise the foil is a clear "
            "film over the print. Automatic: opaque if the artwork has transparent parts."},
    Control{"/under", "Under the ink", "", FieldKind::Choice,
            "What lies under ink and foil. Automatic: metal under opaque ink, else paper."},
    Control{"/lacquer/gloss", "Lacquer", "", FieldKind::Choice, "A clear coat over the card."},
    Control{"/lacquer/tint", "Lacquer tint", "", FieldKind::Colour, "Dye of the lacquer: yellow makes silver gold."},
    Control{"/card/width_mm", "Width", "mm", FieldKind::Number, "Of the card."},
    Control{"/card/height_mm", "Height", "mm", FieldKind::Number, "Of the card."},
    Control{"/card/corner_mm", "Corner radius", "mm", FieldKind::Number, "At most half of the shorter side."},
    Control{"/card/thickness_mm", "Thickness", "mm", FieldKind::Number, "Of the card."},
    Control{"/card/back", "Back", "", FieldKind::Name, "Picture of the back. Without it the back is plain paper."},
    Control{"/texture_px", "Resolution", "px", FieldKind::Count, "Texels along the longer side of the saved card."},
};

std::vector<Choice> choices_at(std::string_view pointer) {
    if (pointer == "/foil/grooves") return {{"rays", "rays"}, {"circles", "circles"}};
    if (pointer == "/ink") return {{"automatic", nullptr}, {"opaque", "covers"}, {"lets through", "lets_through"}};
    if (pointer == "/under") return {{"automatic", nullptr}, {"metal", "metal"}, {"paper", "paper"}};
    return {{"gloss", true}, {"none", false}};
}

/// The schema of a member of a recipe with that type of foil; null: it has no such member.
Json schema_at(const Json& schema, std::string_view type, std::string_view pointer) {
    const Json* object = &schema;
    for (std::string_view rest = pointer.substr(1);;) {
        if (object->contains("oneOf"))
            for (const Json& alternative : (*object)["oneOf"])
                if (alternative["properties"]["type"].value("const", "") == type) object = &alternative;
        const std::size_t end = std::min(rest.find('/'), rest.size());
        const auto found = object->at("properties").find(std::string(rest.substr(0, end)));
        if (found == object->at("properties").end()) return nullptr;
        object = &*found;
        if (end == rest.size()) return *object;
        rest.remove_prefix(end + 1);
    }
}

std::vector<Field> make_fields(const Json& schema, std::string_view type) {
    const foil::FoilGrating grating = foil::foil_grating({.type = *foil::foil_type(type)});
    std::vector<Field> all;
    for (const Control& control : kControls) {
        const Json member = schema_at(schema, type, control.pointer);
        const bool is_spread = std::string_view(control.pointer) == "/foil/spread_deg";
        if (member.is_null() || (is_spread && grating.varies_pitch)) continue;
        Field& field = all.emplace_back(Field{.pointer = control.pointer,
                                              .label = control.label,
                                              .unit = control.unit,
                                              .kind = control.kind,
                                              .help = control.help});
        const Json& range = member.contains("items") ? member["items"] : member;
        field.minimum = range.value("minimum", 0.0);
        field.maximum = range.value("maximum", 1.0);
        field.logarithmic = field.minimum > 0.0 && field.maximum > 10.0 * field.minimum;
        field.default_value = is_spread ? Json(grating.spread_deg) : member.value("default", Json());
        if (control.kind != FieldKind::Choice) continue;
        field.choices = choices_at(control.pointer);
        if (field.default_value.is_null()) field.default_value = field.choices.front().value;
    }
    return all;
}

/// A recipe with the names of its pictures changed.
template <typename Change>
Json with_names(Json recipe, const Change& change) {
    for (const Control& control : kControls) {
        const Json::json_pointer at(control.pointer);
        if (control.kind == FieldKind::Name && recipe.contains(at) && recipe[at].is_string())
            recipe[at] = change(std::filesystem::path(recipe[at].get<std::string>())).generic_string();
    }
    return recipe;
}

std::string parent_of(const std::string& pointer) {
    return pointer.substr(0, pointer.rfind('/'));
}

}  // namespace

std::span<const Field> foil_fields(std::string_view type) {
    static const std::map<std::string, std::vector<Field>, std::less<>> by_type = [] {
        const Json schema = json_schema("", [](JsonReader& json) { foil::parse_foil_recipe(json); });
        std::map<std::string, std::vector<Field>, std::less<>> made;
        for (const std::string_view name : foil::foil_type_names())
            made.emplace(std::string(name), make_fields(schema, name));
        return made;
    }();
    const auto found = by_type.find(type);
    return found != by_type.end() ? std::span<const Field>(found->second) : std::span<const Field>();
}

std::string shown_foil_type(std::string_view type) {
    std::string shown(type);
    std::ranges::replace(shown, '_', ' ');
    if (!shown.empty()) shown[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(shown[0])));
    return shown;
}

void FoilPictures::read(const std::filesystem::path& file) {
    auto picture = std::make_shared<const foil::NamedPicture>(
        foil::NamedPicture{file.filename().string(), read_file(file, kLargestPicture, "scale the picture down")});
    const std::scoped_lock guard(lock_);
    whole_[file.string()] = std::move(picture);
    ++revision_;
}

bool FoilPictures::contains(const std::string& path) const {
    const std::scoped_lock guard(lock_);
    return whole_.contains(path);
}

std::size_t FoilPictures::revision() const {
    const std::scoped_lock guard(lock_);
    return revision_;
}

foil::NamedPictures FoilPictures::of(const foil::Recipe& recipe, std::optional<int> most) const {
    foil::NamedPictures named;
    for (const std::string& path : foil::picture_names(recipe)) named[path] = *at(path, most);
    return named;
}

FoilPictures::Picture FoilPictures::at(const std::string& path, std::optional<int> most) const {
    Picture whole;
    {
        const std::scoped_lock guard(lock_);
        whole = whole_.at(path);
        if (!most) return whole;
        if (const auto known = reduced_.find({whole, *most}); known != reduced_.end()) return known->second;
    }
    const image::ByteImageSize size = image::byte_image_size(whole->bytes, whole->file);
    const int longer = std::max(size.width, size.height);
    Picture made = whole;
    // One that is too large is refused by who makes the card.
    if (longer > *most && longer <= kLargestSide) {
        const auto side = [&](int texels) { return std::max(1, (texels * *most + longer / 2) / longer); };
        const image::ByteImage small =
            foil::fill_card(image::decode_byte_image(whole->bytes, whole->file), side(size.width), side(size.height));
        made = std::make_shared<const foil::NamedPicture>(foil::NamedPicture{
            whole->file, image::encode_png(small.width, small.height, 4, small.rgba, image::PngEffort::Fast)});
    }
    const std::scoped_lock guard(lock_);
    return reduced_[{whole, *most}] = made;
}

FoilRecipe FoilRecipe::make_new(const std::filesystem::path& artwork) {
    FoilRecipe made;
    const Json json = {{"artwork", std::filesystem::absolute(artwork).lexically_normal().generic_string()},
                       {"foil", {{"type", kFirstType}}}};
    made.read_pictures(json);
    made.step(json, {});
    return made;
}

FoilRecipe FoilRecipe::open(const std::filesystem::path& path) {
    const Json json = parse_ordered(read_text_file(path, kLargestRecipe), path.string());
    foil::parse_foil_recipe(nlohmann::json(json), path.string());
    FoilRecipe made;
    made.path_ = std::filesystem::absolute(path);
    Json absolute = with_names(
        json, [&](const std::filesystem::path& name) { return (made.path_.parent_path() / name).lexically_normal(); });
    if (!absolute.contains("foil")) absolute["foil"] = {{"type", kFirstType}};
    made.read_pictures(absolute);
    made.step(absolute, {});
    made.saved_ = made.json_;
    return made;
}

void FoilRecipe::read_pictures(const Json& json) {
    with_names(json, [&](const std::filesystem::path& name) {
        if (!pictures_->contains(name.string())) pictures_->read(name);
        return name;
    });
}

const Field* FoilRecipe::field_of(std::string_view refusal) const {
    for (const Field& field : fields()) {
        const Json value = value_of(field, json_);
        const bool is_named =
            field.kind == FieldKind::Name && value.is_string() &&
            refusal.starts_with(std::filesystem::path(value.get<std::string>()).filename().string() + ":");
        if (is_named || refusal.find(": " + field.pointer + ":") != std::string_view::npos ||
            refusal.find(": " + field.pointer + "/") != std::string_view::npos)
            return &field;
    }
    return nullptr;
}

std::string FoilRecipe::type() const {
    const Json::json_pointer at("/foil/type");
    const Json name = json_.contains(at) ? json_[at] : Json();
    return name.is_string() ? name.get<std::string>() : kFirstType;
}

void FoilRecipe::accept(Json json) {
    json_ = std::move(json);
    last_of_type_[type()] = json_.value("foil", Json::object());
    try {
        accepted_ = foil::parse_foil_recipe(nlohmann::json(json_), name());
        refusal_.clear();
    } catch (const Error& error) {
        refusal_ = error.what();
    }
}

void FoilRecipe::step(Json json, const std::string& editing) {
    if (json == json_) return;
    if (editing.empty() || editing != editing_) {
        steps_.resize(steps_.empty() ? 0 : at_ + 1);
        steps_.emplace_back();
        at_ = steps_.size() - 1;
    }
    editing_ = editing;
    steps_[at_] = json;
    accept(std::move(json));
}

void FoilRecipe::set(const Field& field, const Json& value) {
    Json edited = with_value(json_, field, value == field.default_value ? Json() : value);
    // Nothing is left of an object whose members all have their defaults.
    const Json::json_pointer parent(parent_of(field.pointer));
    if (!parent.empty() && edited.contains(parent) && edited[parent].empty()) edited.erase(parent.back());
    // A file that is chosen again may have changed.
    if (field.kind == FieldKind::Name && value.is_string()) pictures_->read(value.get<std::string>());
    read_pictures(edited);
    step(std::move(edited), field.pointer);
}

Json FoilRecipe::with_type(std::string_view type) const {
    if (type == this->type()) return json_;
    Json recipe = json_;
    const Json before = json_.value("foil", Json::object());
    Json after = {{"type", type}};
    const auto last = last_of_type_.find(type);
    if (last != last_of_type_.end()) after.update(last->second);
    for (const char* common : {"direction_deg", "scale", "groove_um", "spread_deg", "seed"}) {
        after.erase(common);
        const bool has = std::ranges::count(foil_fields(type), std::string("/foil/") + common, &Field::pointer) > 0;
        if (has && before.contains(common)) after[common] = before[common];
    }
    for (const char* picture : {"picture_a", "picture_b", "drawing"}) {
        const bool needs = std::ranges::count(foil_fields(type), std::string("/foil/") + picture, &Field::pointer) > 0;
        if (needs && !after.contains(picture)) after[picture] = json_["artwork"];
    }
    recipe["foil"] = std::move(after);
    return recipe;
}

void FoilRecipe::set_type(std::string_view type) {
    if (type != this->type()) step(with_type(type), {});
}

void FoilRecipe::undo() {
    if (!can_undo()) return;
    finish_edit();
    accept(steps_[--at_]);
}

void FoilRecipe::redo() {
    if (!can_redo()) return;
    finish_edit();
    accept(steps_[++at_]);
}

std::string FoilRecipe::name() const {
    return suggested(".json").filename().string();
}

std::filesystem::path FoilRecipe::suggested(const std::string& extension) const {
    std::filesystem::path path = path_.empty() ? std::filesystem::path(json_.value("artwork", "card")) : path_;
    return path.replace_extension(extension);
}

void FoilRecipe::save(const std::filesystem::path& path) {
    if (!refusal_.empty()) refuse_input(refusal_, {}, {}, {});
    const std::filesystem::path absolute = std::filesystem::absolute(path);
    const Json relative = with_names(
        json_, [&](const std::filesystem::path& name) { return name.lexically_proximate(absolute.parent_path()); });
    write_file_atomic(absolute, format_json(relative));
    path_ = absolute;
    saved_ = json_;
}

}  // namespace rowland::inspector
