#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include "editor/inspector/field.h"
#include "editor/inspector/field_parts.h"
#include "engine/colour/illuminant.h"
#include "engine/lighting/key_lights.h"
#include "modules/diffraction/asset/gltf_extension.h"
#include "modules/diffraction/model/lattice.h"
#include "modules/diffraction/model/profile.h"
#include "modules/diffraction/representations/representation.h"

namespace rowland::inspector {

namespace {

using diffraction::ProfileDescriptor;
using diffraction::ProfileMember;
using FieldKind::Colour;
using FieldKind::Count;
using FieldKind::Name;
using FieldKind::Number;
using FieldKind::Orders;
using FieldKind::Pair;

const char* const kPaper = "Lindsay & Agu 2006";
const char* const kMaxwell = "Li 1996; Chandezon et al. 1982";
const char* const kFresnel = "Fresnel's equations";
const char* const kGoodman = "Goodman, Introduction to Fourier Optics, ch. 4";
const char* const kStam = "Stam 1999, Diffraction shaders";
const char* const kSun = "Sun et al. 2000, Rendering iridescent colors of optical disks";

/// The field with the pointer of `field`, which is added if there is none.
Field& merged_into(std::vector<Field>& fields, const Field& field) {
    const auto known = std::ranges::find(fields, field.pointer, &Field::pointer);
    return known != fields.end() ? *known : fields.emplace_back(field);
}

/// The value of a member in a new profile; whole numbers are written without a fraction.
Json initial_value(const ProfileMember& member) {
    if (member.value == nullptr) return "";
    if (member.initial == std::floor(member.initial)) return static_cast<std::int64_t>(member.initial);
    return member.initial;
}

Json initial_profile(const ProfileDescriptor& descriptor) {
    Json profile = {{"type", descriptor.name}};
    for (const ProfileMember& member : descriptor.members) profile[member.key] = initial_value(member);
    return profile;
}

Field profile_field(const Field& profile, const ProfileMember& member) {
    const bool has_limit = !member.within_pitch && std::isfinite(member.less_than);
    const Range range = has_limit ? Range{0.02 * member.less_than, 0.98 * member.less_than, member.unit}
                                  : Range{10.0, 2000.0, member.unit};
    const std::string pointer = profile.pointer + "/" + member.key;
    Field field =
        required(member.value == nullptr
                     ? plain(Name, pointer, member.label, initial_value(member), member.help, member.source)
                     : slider(Number, pointer, member.label, range, initial_value(member), member.help, member.source));
    field.only_with = profile.pointer;
    return field;
}

/// The field `profile` with all groove profiles as its choices, then a field for each of their members; a member that
/// several profiles have has one field. `with_table`: a table of efficiencies is among the profiles.
std::vector<Field> profile_fields(Field profile, bool with_table) {
    profile.required = true;
    profile.discriminator = "type";
    std::vector<Field> result = {profile};
    for (const ProfileDescriptor& descriptor : diffraction::profile_descriptors()) {
        if (!with_table && std::holds_alternative<diffraction::EfficiencyTable>(descriptor.empty)) continue;
        result.front().choices.push_back({std::string(descriptor.name), initial_profile(descriptor)});
        for (const ProfileMember& member : descriptor.members)
            merged_into(result, profile_field(profile, member)).only_for.emplace_back(descriptor.name);
    }
    if (result.front().default_value.is_null()) result.front().default_value = result.front().choices.front().value;
    return result;
}

Field groove_profile() {
    return shown_for(
               "/grating", "grooves",
               {choice("/grating/profile", "Profile", nullptr, {},
                       "Shape of a groove; it determines the efficiency of each order. A table of measured or "
                       "rigorous efficiencies includes the effects that scalar theory neglects.",
                       "slit: Lindsay & Agu 2006, eq. 2; others: Goodman, Introduction to Fourier Optics, ch. 4")})
        .front();
}

std::vector<Field> pitch_fields() {
    return shown_for(
        "/grating", "grooves",
        {required(slider(Number, "/grating/pitch_nm", "Pitch", {200.0, 20000.0, "nm", kLogarithmic}, 1600,
                         "Distance d of adjacent grooves. Grating equation for order m and wavelength λ: d (s_g + "
                         "v_g) = m λ. 1 to 10 000 000 nm. A compact disc has 1600, a DVD 740.",
                         "the grating equation; Lindsay & Agu 2006, eq. 1"))});
}

/// Of a compact disc.
Json initial_spacings() {
    return {900, 1200, 1500, 1800, 2100, 2400, 2700, 3000, 3300};
}

std::vector<Field> order_and_lobe_fields() {
    return joined(
        {shown_for(
             "/grating", "grooves",
             {plain(Orders, "/grating/orders", "Orders", {-2, -1, 1, 2},
                    "The shaded orders, or \"all\" that propagate for some visible wavelength. If 0 is not listed, "
                    "the mirror's order reflects the environment.",
                    kPaper),
              slider(Number, "/grating/grooves", "Lit grooves", {50.0, 10000.0, "", kLogarithmic}, 1500,
                     "Number N of grooves that are lit together; at least 1. From 50 on an order is a sharp line.",
                     "Lindsay & Agu 2006, eq. 3 (N = 1500)"),
              choice(
                  "/grating/theory", "Theory", nullptr,
                  {{"by the grooves", nullptr}, {"scalar", "scalar"}, {"rigorous", "rigorous"}},
                  "scalar: closed forms that depend on wavelength alone. rigorous: Maxwell's equations, of lamellar, "
                  "sinusoidal and blazed grooves of a metal or a sheet; solving takes seconds, drawing costs the same. "
                  "by the grooves: rigorous where it knows a metal's.",
                  kMaxwell),
              choice("/grating/films", "Film on the grooves", nullptr,
                     {{"none", nullptr}, {"a film", {{{"ior", 1.6}, {"thickness_nm", 120}}}}},
                     "A transparent film that follows the relief, as lacquer or an oxide does. Rigorous theory alone "
                     "knows it.",
                     kMaxwell),
              choice("/grating/normalization", "Normalisation", "energy", {{"energy", "energy"}, {"agu", "agu"}},
                     "energy: each order has the power of its efficiency. agu: the paper's peak form, each order "
                     "times λ/550 nm; slits only.",
                     "Lindsay & Agu 2006, eq. 1–3"),
              choice("/grating/groove_lobe", "Lobe", "flat",
                     {{"flat", "flat"},
                      {"gaussian", {{"sigma", 0.1}}},
                      {"pits", {{"pits", {{"length_nm", 850}, {"coherent", 0.3}}}}},
                      {"pit sequence",
                       {{"pit_sequence", {{"spacings_nm", initial_spacings()}, {"coherent", 0.3}, {"sigma", 0.02}}}}}},
                     "Distribution of light along the grooves. flat: uniform, as in the paper. gaussian: thin "
                     "streaks, as of pressed discs and foil. pits: the data of a compact disc. pit sequence: the same "
                     "as gratings along the track, of several spacings at once.",
                     "flat: Lindsay & Agu 2006; pits: Stam 1999, Diffraction shaders; pit sequence: Sun et al. 2000")}),
         shown_for("/grating/films", "a film",
                   {required(slider(Number, "/grating/films/0/ior", "Film's index", {1.0, 3.0}, 1.6,
                                    "Index of refraction n of the film at all wavelengths; 1 to 4.", kMaxwell)),
                    required(slider(Number, "/grating/films/0/thickness_nm", "Film's thickness", {5.0, 500.0, "nm"},
                                    120, "Above 0, at most the pitch.", kMaxwell))}),
         shown_for("/grating/groove_lobe", "gaussian",
                   {required(slider(Number, "/grating/groove_lobe/sigma", "Lobe width", {0.005, 1.0, "", kLogarithmic},
                                    0.1, "Standard deviation σ of s_h + v_h along the grooves; above 0.",
                                    "a normal distribution, truncated at the hemisphere"))}),
         shown_for(
             "/grating/groove_lobe", "pits",
             {required(slider(Number, "/grating/groove_lobe/pits/length_nm", "Pit length", {200.0, 4000.0, "nm"}, 850,
                              "Length ℓ of the pits, whose positions along the track are a Poisson process; above 0, "
                              "at most 100 000.",
                              kStam)),
              required(slider(Number, "/grating/groove_lobe/pits/coherent", "Coherent part", {}, 0.3,
                              "Fraction κ of the light that is reflected as by a continuous track; 0 to 1.", kStam))}),
         shown_for(
             "/grating/groove_lobe", "pit sequence",
             {required(slider(Orders, "/grating/groove_lobe/pit_sequence/spacings_nm", "Pit spacings",
                              {100.0, 100000.0, "nm"}, initial_spacings(),
                              "Distances in nm of one pit from the next, each of a grating of its own: 1 to 16, "
                              "ascending, 100 to 100 000.",
                              kSun)),
              slider(Number, "/grating/groove_lobe/pit_sequence/coherent", "Coherent part", {}, 0.3,
                     "Fraction κ of the light that is reflected as by a continuous track; 0 to 1.", kSun),
              slider(Number, "/grating/groove_lobe/pit_sequence/sigma", "Width of an order",
                     {0.004, 0.2, "", kLogarithmic}, 0.02,
                     "Standard deviation σ of s_h + v_h around each order along the track; 0.004 to 0.2.", kSun)})});
}

Json initial_sinusoid() {
    return {{"type", "sinusoidal"}, {"depth_nm", 110}};
}

Json initial_crossed() {
    return {{"type", "crossed"}, {"along_a", initial_sinusoid()}, {"along_b", initial_sinusoid()}};
}

Json initial_lattice() {
    return {{"lattice", {{"a_nm", {1000, 0}}, {"b_nm", {0, 1000}}}}, {"profile", initial_crossed()}};
}

Field side_field(const std::string& side, const Json& initial) {
    return required(slider(
        Pair, "/grating/lattice/" + side + "_nm", "Side " + side, {300.0, 100000.0, "nm", kLogarithmic}, initial,
        "Components along g and h of one of the two sides of a cell, a and b. 300 to 10 000 000 nm long; at least 2° "
        "between a and b. The pixels of a telephone are 50 000 nm wide.",
        "the grating equation in two dimensions; " + std::string(kGoodman)));
}

/// The fields of the grooves that repeat along one of the sides.
std::vector<Field> crossed_fields(const std::string& side) {
    const std::vector<Field> profile =
        shown_for("/grating/profile", "crossed",
                  {choice("/grating/profile/along_" + side, "Along " + side, initial_sinusoid(), {},
                          "Shape of the grooves that repeat along " + side +
                              "; its length is their pitch. The fields below belong to them.",
                          kGoodman)});
    return profile_fields(profile.front(), false);
}

Field opening_field(const std::string& key, const char* label, const std::string& side) {
    return required(slider(Number, "/grating/profile/" + key, label, {100.0, 100000.0, "nm", kLogarithmic}, 500,
                           "Length of the opening along " + side + "; above 0, at most the length of " + side + ".",
                           kGoodman));
}

Field lattice_profile() {
    Field field = required(
        choice("/grating/profile", "Profile", initial_crossed(),
               {{"crossed", initial_crossed()},
                {"aperture", {{"type", "aperture"}, {"width_nm", 500}, {"height_nm", 500}}},
                {"height_map", {{"type", "height_map"}, {"file", ""}, {"depth_nm", 150}}}},
               "Content of a cell. crossed: two sets of grooves whose heights add. aperture: one opening, as in a "
               "screen. height_map: a picture of the heights.",
               kGoodman));
    field.discriminator = "type";
    return field;
}

std::vector<Field> lattice_fields() {
    return joined(
        {shown_for("/grating", "lattice", {side_field("a", {1000, 0}), side_field("b", {0, 1000}), lattice_profile()}),
         crossed_fields("a"), crossed_fields("b"),
         shown_for("/grating/profile", "aperture",
                   {opening_field("width_nm", "Width", "a"), opening_field("height_nm", "Height", "b")}),
         shown_for(
             "/grating/profile", "height_map",
             {required(plain(Name, "/grating/profile/file", "Height map", "",
                             "A PNG of the heights of one cell beside the material, at most 256 × 256; on each side "
                             "more texels than twice the orders. White is raised by the full depth.",
                             kGoodman)),
              required(slider(Number, "/grating/profile/depth_nm", "Depth", {20.0, 1000.0, "nm"}, 150,
                              "Height of white over black; above 0.", kGoodman))}),
         shown_for("/grating", "lattice",
                   {slider(Count, "/grating/orders", "Orders", {1.0, diffraction::kHighestLatticeOrder},
                           diffraction::Lattice().orders,
                           "The highest order along each side: all (m, k) with |m| and |k| up to it are shaded, but "
                           "(0, 0).",
                           kGoodman)})});
}

std::vector<Field> grating_fields() {
    const std::vector<Field> profiles = profile_fields(groove_profile(), true);
    return joined(
        {pitch_fields(),
         {required(choice("/grating", "Pattern", nullptr,
                          {{"grooves", {{"pitch_nm", 1600}, {"profile", profiles.front().default_value}}},
                           {"lattice", initial_lattice()}},
                          "grooves: of one direction. lattice: a surface that repeats along two directions, as "
                          "crossed foil or the pixels of a screen. Another choice replaces the whole grating.",
                          kGoodman))},
         profiles,
         order_and_lobe_fields(),
         lattice_fields()});
}

std::vector<Field> cover_fields() {
    return joined(
        {{choice("/cover", "Cover", nullptr, {{"none", nullptr}, {"over the grooves", {{"ior", 1.58}}}},
                 "A transparent layer over the grooves, as on a disc or a laminated foil. It adds gloss, and "
                 "multiplies the optical depth of the grooves by n.",
                 "Fresnel's equations; Wang 1995, doi 10.1117/12.196541")},
         shown_for("/cover", "over the grooves",
                   {required(slider(Number, "/cover/ior", "Cover's index", {1.0, 3.0}, 1.58,
                                    "Index of refraction n of the cover; 1 to 3. Polycarbonate 1.58, acrylic 1.49.",
                                    kFresnel)),
                    plain(Colour, "/cover/tint", "Cover's tint", {1.0, 1.0, 1.0},
                          "Transmittance of the cover's dye for one pass; light passes it twice. Linear Rec.709; 0 to "
                          "1 each. Not beside a table, whose values include the dye.",
                          "Mallett & Yuksel 2019")})});
}

std::vector<Field> transmission_fields() {
    return joined(
        {{choice("/transmission", "Transmission", nullptr, {{"none", nullptr}, {"through a sheet", {{"ior", 1.5}}}},
                 "A thin transparent sheet: the orders show the light behind it, order 0 without deflection. Not "
                 "beside a metal or a cover.",
                 kGoodman)},
         shown_for("/transmission", "through a sheet",
                   {required(slider(Number, "/transmission/ior", "Sheet's index", {1.0, 3.0}, 1.5,
                                    "Index of refraction n of the sheet; 1 to 3. A raised part delays light by the "
                                    "phase 2π (n − 1) depth/λ.",
                                    kGoodman)),
                    slider(Number, "/transmission/reflectance", "Sheet's reflectance", {}, 0.0,
                           "Fraction of the light that the sheet reflects into the same orders; 0 to 1. It transmits "
                           "the remainder.",
                           "a coating's, or Fresnel's equations")})});
}

std::vector<Field> surface_fields() {
    return joined(
        {{choice("/metal", "Metal", nullptr,
                 {{"none", nullptr}, {"Al", "Al"}, {"Ag", "Ag"}, {"Au", "Au"}, {"Cu", "Cu"}},
                 "Coating; its reflectance at normal incidence multiplies every order. none: a perfect mirror. Not "
                 "beside a table, whose values include the metal.",
                 "Fresnel's equations with measured n and k")},
         cover_fields(),
         transmission_fields(),
         {plain(Colour, "/base/color", "Base colour", {0.0, 0.0, 0.0},
                "Albedo of the layer under the grating, linear Rec.709; 0 to 1 each.",
                "a dielectric, lit by the power that the orders do not take"),
          slider(Number, "/base/roughness", "Base roughness", {}, 0.3,
                 "Perceptual roughness of the layer under the grating; 0 to 1.", "glTF 2.0, metallic-roughness")}});
}

/// The settings that a new choice of the representation writes into the file: the resolution of a map, else all numbers
/// that have a default.
std::vector<std::string> initial_settings(const diffraction::RepresentationInfo& info) {
    if (info.find("map_resolution") != nullptr) return {"map_resolution"};
    std::vector<std::string> keys;
    for (const diffraction::SettingInfo& setting : info.settings)
        if (setting.default_value.is_number()) keys.emplace_back(setting.key);
    return keys;
}

std::vector<Choice> representation_choices() {
    std::vector<Choice> choices{{"by budget", {{"max_error", 0.05}}}};
    for (const auto* info : diffraction::representations()) {
        Json initial = {{"representation", info->name}};
        for (const std::string& key : initial_settings(*info)) initial[key] = Json(info->find(key)->default_value);
        choices.push_back({info->name, std::move(initial)});
    }
    return choices;
}

Field setting_field(const diffraction::SettingInfo& setting) {
    const std::string pointer = std::string("/quality/") + setting.key;
    std::vector<Choice> words{{"default", nullptr}};
    for (const std::string_view word : setting.words) words.push_back({std::string(word), word});
    Field field = setting.words.empty()
                      ? slider(Count, pointer, setting.label,
                               {static_cast<double>(setting.minimum), static_cast<double>(setting.maximum)},
                               setting.default_value,
                               fmt::format("{} {} to {}.", setting.help, setting.minimum, setting.maximum), kPaper)
                      : choice(pointer, setting.label, nullptr, std::move(words), setting.help, kPaper);
    field.only_with = "/quality";
    return field;
}

/// A field for each setting; its range is the union of the ranges of all representations that have the setting.
std::vector<Field> setting_fields() {
    std::vector<Field> result;
    for (const auto* info : diffraction::representations())
        for (const diffraction::SettingInfo& setting : info->settings) {
            if (setting.words.empty() && setting.default_value.is_null()) continue;
            const Field field = setting_field(setting);
            Field& shown = merged_into(result, field);
            shown.minimum = std::min(shown.minimum, field.minimum);
            shown.maximum = std::max(shown.maximum, field.maximum);
            shown.only_for.emplace_back(info->name);
            if (setting.words.empty()) shown.defaults_by_choice.push_back({info->name, setting.default_value});
        }
    return result;
}

Field quality_field() {
    Field field =
        choice("/quality", "Representation", {{"max_error", 0.05}}, representation_choices(),
               "The method that shades the surface. by budget: the cooker takes the cheapest within the error.",
               "spikes: Lindsay & Agu 2006; the others go beyond it");
    field.discriminator = "representation";
    return field;
}

std::vector<Field> budget_fields() {
    return joined(
        {{quality_field()},
         shown_for(
             "/quality", "by budget",
             {slider(Number, "/quality/max_error", "Error allowed", {0.002, 20.0, "", kLogarithmic}, 0.05,
                     "Largest error against the reference; above 0.",
                     "relative RMS: √(Σ|XYZ − XYZ_ref|² / Σ|XYZ_ref|²) over 30 views"),
              choice("/quality/measure", "Error is", "relative_rms",
                     {{"relative RMS", "relative_rms"}, {"ΔE2000", "delta_e"}, {"HDR-FLIP", "hdr_flip"}},
                     "Relative RMS of XYZ; the 95th percentile of ΔE2000 over the views; or the mean of "
                     "HDR-FLIP over a picture.",
                     "Sharma et al. 2005; Andersson et al. 2021"),
              choice("/quality/surface", "Measured on", "flat", {{"flat", "flat"}, {"curved", "curved"}},
                     "The surface of the measurement. flat: a compact disc, of a lattice a card. curved: a sphere.",
                     "240 views in eight parts; the largest error of a part counts")})});
}

/// Key lights of the representations that do not require them. By default, representations that hold all light as SH
/// use none, the others all.
Field key_lights_field() {
    Field field = slider(
        Count, "/quality/key_lights", "Key lights", {0.0, lighting::kMaximumKeyLights}, lighting::kMaximumKeyLights,
        "Number of bright parts of the probe that are shaded one by one, at full sharpness. 0: none; 64: all.",
        "von Mises–Fisher lobes fitted to the probe");
    field.only_with = "/quality";
    for (const auto* info : diffraction::representations()) {
        if (info->key_lights == diffraction::KeyLightUse::Always) continue;
        field.only_for.emplace_back(info->name);
        if (info->key_lights == diffraction::KeyLightUse::OnRequest)
            field.defaults_by_choice.push_back({info->name, 0});
    }
    return field;
}

std::vector<Field> light_fields() {
    return {key_lights_field(), plain(Name, "/quality/illuminant", "Illuminant", "D65",
                                      fmt::format("Spectrum of white light: {}, or a CSV beside the material.",
                                                  fmt::join(colour::illuminant_names(), ", ")),
                                      "CIE 15, Colorimetry")};
}

}  // namespace

std::span<const Field> fields() {
    static const std::vector<Field> all =
        joined({grating_fields(), surface_fields(), budget_fields(), setting_fields(), light_fields()});
    return all;
}

std::span<const Field> groove_fields() {
    static const std::vector<Field> all = joined(
        {{slider(Number, "/grooveRotation", "Groove rotation", kTurn, 0.0,
                 "Rotates the grooves in the surface, from the mesh's tangent toward its bitangent. Or drag the handle "
                 "in the preview (G).",
                 diffraction::kGltfExtension),
          choice("/grooveTexture", "Groove texture", nullptr, {{"none", nullptr}, {"texture", {{"index", 0}}}},
                 "Varies the grooves over the mesh. R: rotation / 180 degrees, G: pitch / (2 pitch_nm), 0 where there "
                 "is no grating.",
                 diffraction::kGltfExtension)},
         shown_for("/grooveTexture", "texture",
                   joined({texture_fields("/grooveTexture", diffraction::kGltfExtension),
                           {choice("/grooveTexture/sparkle", "Sparkle", nullptr, {{"off", nullptr}, {"on", true}},
                                   "on: a pixel shows the grooves of one texel, so that small cells sparkle. off: the "
                                   "mean over the pixel's texels.",
                                   diffraction::kGltfExtension)}}))});
    return all;
}

}  // namespace rowland::inspector
