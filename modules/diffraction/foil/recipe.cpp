#include "modules/diffraction/foil/recipe.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "modules/diffraction/foil/grating.h"
#include "modules/diffraction/foil/kinegram.h"

namespace rowland::diffraction::foil {

namespace {

constexpr NumberRange kAngle{.minimum = -360.0, .maximum = 360.0};
constexpr NumberRange kCellSize{.minimum = 0.1, .maximum = 200.0};  ///< millimetres

// Readers of members with defaults, which the schema states for editors.

void state_default(JsonReader& json, const std::string& key, const nlohmann::json& value) {
    if (json.is_recording_schema()) json.annotate(key, nlohmann::json{{"default", value}}.dump());
}

double number_or(JsonReader& json, const std::string& key, double fallback, NumberRange range) {
    const double value = json.number_or(key, fallback, range);
    state_default(json, key, fallback);
    return value;
}

std::int64_t integer_or(JsonReader& json, const std::string& key, std::int64_t fallback, std::int64_t minimum,
                        std::int64_t maximum) {
    const std::int64_t value = json.integer_or(key, fallback, minimum, maximum);
    state_default(json, key, fallback);
    return value;
}

template <typename Vector>
Vector vector_or(JsonReader& json, const std::string& key, const Vector& fallback, NumberRange range) {
    const Vector value = read_vector_or(json, key, fallback, range);
    nlohmann::json numbers = nlohmann::json::array();
    for (int i = 0; i < Vector::length(); ++i) numbers.push_back(fallback[i]);
    state_default(json, key, numbers);
    return value;
}

glm::dvec2 read_centre(JsonReader& json) {
    return vector_or(json, "centre", glm::dvec2(0.5), {.minimum = -1.0, .maximum = 2.0});
}

FoilType read_pillars(JsonReader& json) {
    Pillars pillars;
    pillars.band_mm = number_or(json, "band_mm", pillars.band_mm, kCellSize);
    pillars.pitch_range = number_or(json, "pitch_range", pillars.pitch_range, {.minimum = 1.1, .maximum = 2.0});
    return pillars;
}

FoilType read_rainbow(JsonReader&) {
    return Rainbow{};
}

FoilType read_radial(JsonReader& json) {
    return Radial{.circles = json.choice_or("grooves", "rays", {"rays", "circles"}) == "circles",
                  .centre = read_centre(json)};
}

template <typename Cells>
FoilType read_cells(JsonReader& json) {
    Cells cells;
    cells.size_mm = number_or(json, "size_mm", cells.size_mm, kCellSize);
    cells.directions = static_cast<int>(integer_or(json, "directions", cells.directions, 2, 180));
    return cells;
}

FoilType read_cosmos(JsonReader& json) {
    return Cosmos{.size_mm = number_or(json, "size_mm", Cosmos().size_mm, kCellSize)};
}

FoilType read_cracked_ice(JsonReader& json) {
    return CrackedIce{.size_mm = number_or(json, "size_mm", CrackedIce().size_mm, kCellSize)};
}

FoilType read_glitter(JsonReader& json) {
    return Glitter{.size_um = number_or(json, "size_um", Glitter().size_um, {.minimum = 10.0, .maximum = 2000.0})};
}

FoilType read_brushed(JsonReader& json) {
    Brushed brushed;
    brushed.stroke_mm = number_or(json, "stroke_mm", brushed.stroke_mm, {.minimum = 0.02, .maximum = 5.0});
    brushed.length_mm = number_or(json, "length_mm", brushed.length_mm, {.minimum = 0.1, .maximum = 1000.0});
    brushed.spread_deg = number_or(json, "angle_spread_deg", brushed.spread_deg, {.minimum = 0.0, .maximum = 45.0});
    return brushed;
}

FoilType read_two_pictures(JsonReader& json) {
    TwoPictures two;
    two.pictures = {json.file_name("picture_a", "the name of a picture file"),
                    json.file_name("picture_b", "the name of a picture file")};
    two.lamp_deg = number_or(json, "lamp_deg", two.lamp_deg, {.minimum = 5.0, .maximum = 80.0});
    two.tilts_deg = vector_or(json, "tilts_deg", two.tilts_deg, {.minimum = -60.0, .maximum = 60.0});
    two.cell_mm = number_or(json, "cell_mm", two.cell_mm, {.minimum = 0.02, .maximum = 2.0});
    if (json.is_recording_schema()) return two;
    if (const std::optional<Refusal> refused = tilt_refusal(two))
        json.fail(refused->key, refused->found, refused->expected, refused->remedy);
    return two;
}

FoilType read_lens(JsonReader& json) {
    return Lens{.focal_mm = number_or(json, "focal_mm", Lens().focal_mm, {.minimum = 5.0, .maximum = 1000.0}),
                .centre = read_centre(json)};
}

FoilType read_own(JsonReader& json) {
    return Own{.drawing = json.file_name("drawing", "the name of a picture file"),
               .smooth_mm = number_or(json, "smooth_mm", Own().smooth_mm, {.minimum = 0.05, .maximum = 20.0})};
}

struct TypeName {
    std::string_view name;
    FoilType (*read)(JsonReader&);
};

/// In the order of FoilType.
constexpr std::array<TypeName, std::variant_size_v<FoilType>> kTypes = {{{"pillars", read_pillars},
                                                                         {"rainbow", read_rainbow},
                                                                         {"radial", read_radial},
                                                                         {"tiles", read_cells<Tiles>},
                                                                         {"hexagons", read_cells<Hexagons>},
                                                                         {"cosmos", read_cosmos},
                                                                         {"cracked_ice", read_cracked_ice},
                                                                         {"glitter", read_glitter},
                                                                         {"brushed", read_brushed},
                                                                         {"two_pictures", read_two_pictures},
                                                                         {"lens", read_lens},
                                                                         {"own", read_own}}};

Foil read_foil(JsonReader json) {
    Foil foil;
    foil.direction_deg = number_or(json, "direction_deg", foil.direction_deg, kAngle);
    foil.scale = number_or(json, "scale", foil.scale, {.minimum = 0.05, .maximum = 20.0});
    foil.groove_um = number_or(json, "groove_um", foil.groove_um, {.minimum = 0.6, .maximum = 10.0});
    if (json.has("spread_deg")) foil.spread_deg = json.number("spread_deg", {.minimum = 1.0, .maximum = 30.0});
    foil.seed = static_cast<std::uint32_t>(integer_or(json, "seed", foil.seed, 0, 0xFFFFFFFF));
    json.variant("type", foil_type_names(), [&](JsonReader& member, std::size_t type) {
        foil.type = kTypes[type].read(member);
        if (!member.is_recording_schema()) return;
        if (const FoilGrating own = foil_grating({.type = foil.type}); !own.varies_pitch)
            state_default(member, "spread_deg", own.spread_deg);
    });
    json.finish();
    if (!json.is_recording_schema() && foil.spread_deg && foil_grating(foil).varies_pitch)
        json.fail("spread_deg", "a width of the light along grooves whose distance varies",
                  "a type whose grooves all have one distance", "leave spread_deg out");
    return foil;
}

CardShape read_card(JsonReader json) {
    CardShape card;
    card.width_mm = number_or(json, "width_mm", card.width_mm, {.minimum = 5.0, .maximum = 1000.0});
    card.height_mm = number_or(json, "height_mm", card.height_mm, {.minimum = 5.0, .maximum = 1000.0});
    card.thickness_mm = number_or(json, "thickness_mm", card.thickness_mm, {.minimum = 0.01, .maximum = 10.0});
    card.corner_mm = number_or(json, "corner_mm", card.corner_mm, {.minimum = 0.0, .maximum = 500.0});
    if (json.has("back")) card.back = json.file_name("back", "the name of a picture file");
    json.finish();
    if (json.is_recording_schema()) return card;
    const double shorter = std::min(card.width_mm, card.height_mm);
    const double longer = std::max(card.width_mm, card.height_mm);
    if (2.0 * card.corner_mm > shorter)
        json.fail("corner_mm", fmt::format("{:g}", card.corner_mm),
                  fmt::format("at most {:g}, half of the card's shorter side", shorter / 2.0));
    if (longer > 20.0 * shorter)
        json.fail("width_mm", fmt::format("a card of {:g} x {:g} mm", card.width_mm, card.height_mm),
                  "a longer side of at most 20 times the shorter one");
    return card;
}

}  // namespace

std::vector<std::string_view> foil_type_names() {
    std::vector<std::string_view> names;
    for (const TypeName& type : kTypes) names.push_back(type.name);
    return names;
}

std::optional<FoilType> foil_type(std::string_view name) {
    constexpr std::array<FoilType (*)(), kTypes.size()> kMake = []<std::size_t... I>(std::index_sequence<I...>) {
        return std::array<FoilType (*)(), sizeof...(I)>{+[] { return FoilType(std::in_place_index<I>); }...};
    }
    (std::make_index_sequence<kTypes.size()>());
    const auto found =
        std::find_if(kTypes.begin(), kTypes.end(), [&](const TypeName& type) { return type.name == name; });
    if (found == kTypes.end()) return std::nullopt;
    return kMake[static_cast<std::size_t>(found - kTypes.begin())]();
}

bool is_foil_recipe(const nlohmann::json& document) {
    return document.is_object() && document.contains("artwork");
}

Recipe parse_foil_recipe(const nlohmann::json& document, const std::string& file) {
    JsonReader root(document, file);
    return parse_foil_recipe(root);
}

Recipe parse_foil_recipe(JsonReader& root) {
    Recipe recipe;
    recipe.artwork = root.file_name("artwork", "the name of a picture file");
    if (root.has("mask")) recipe.mask = root.file_name("mask", "the name of a picture file");
    if (auto foil = root.object_if_there("foil")) recipe.foil = read_foil(std::move(*foil));
    if (root.has("ink"))
        recipe.ink = root.choice<Ink>("ink", {{"covers", Ink::Covers}, {"lets_through", Ink::LetsThrough}});
    if (root.has("under"))
        recipe.under = root.choice<Under>("under", {{"metal", Under::Metal}, {"paper", Under::Paper}});
    if (auto lacquer = root.object_if_there("lacquer")) {
        recipe.lacquer.gloss = lacquer->boolean_or("gloss", true);
        recipe.lacquer.tint = vector_or(*lacquer, "tint", recipe.lacquer.tint, kFraction);
        lacquer->finish();
    }
    if (auto card = root.object_if_there("card")) recipe.card = read_card(std::move(*card));
    recipe.texture_px = static_cast<int>(integer_or(root, "texture_px", recipe.texture_px, 512, 4096));
    root.finish();
    return recipe;
}

}  // namespace rowland::diffraction::foil
