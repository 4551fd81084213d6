#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numbers>

#include "editor/inspector/field.h"
#include "engine/colour/illuminant.h"
#include "engine/lighting/key_lights.h"
#include "modules/diffraction/asset/gltf_extension.h"
#include "modules/diffraction/representations/representation.h"

namespace rowland::inspector {

namespace {

const char* const kPaper = "Lindsay & Agu 2006";
const char* const kFresnel = "Fresnel's equations";
const char* const kGoodman = "Goodman, Introduction to Fourier Optics, ch. 4";

std::vector<Field> joined(std::initializer_list<std::vector<Field>> parts) {
    std::vector<Field> all;
    for (const std::vector<Field>& part : parts) all.insert(all.end(), part.begin(), part.end());
    return all;
}

std::vector<Field> cover_fields() {
    return joined(
        {{{.pointer = "/cover",
           .label = "Cover",
           .kind = FieldKind::Choice,
           .choices = {{"none", nullptr}, {"over the grooves", {{"ior", 1.58}}}},
           .help = "A transparent layer over the grooves, as on a disc or a laminated foil. It adds gloss, and "
                   "multiplies the optical depth of the grooves by n.",
           .source = "Fresnel's equations; Wang 1995, doi 10.1117/12.196541"}},
         shown_for("/cover", "over the grooves",
                   {{.pointer = "/cover/ior",
                     .label = "Cover's index",
                     .minimum = 1.0,
                     .maximum = 3.0,
                     .default_value = 1.58,
                     .required = true,
                     .help = "Index of refraction n of the cover; 1 to 3. Polycarbonate 1.58, acrylic 1.49.",
                     .source = kFresnel},
                    {.pointer = "/cover/tint",
                     .label = "Cover's tint",
                     .kind = FieldKind::Colour,
                     .default_value = {1.0, 1.0, 1.0},
                     .help = "Transmittance of the cover's dye for one pass; light passes it twice. Linear "
                             "Rec.709; 0 to 1 each. Not beside a table, whose values include the dye.",
                     .source = "Mallett & Yuksel 2019"}})});
}

std::vector<Field> transmission_fields() {
    return joined(
        {{{.pointer = "/transmission",
           .label = "Transmission",
           .kind = FieldKind::Choice,
           .choices = {{"none", nullptr}, {"through a sheet", {{"ior", 1.5}}}},
           .help = "A thin transparent sheet: the orders show the light behind it, order 0 without deflection. Not "
                   "beside a metal or a cover.",
           .source = kGoodman}},
         shown_for("/transmission", "through a sheet",
                   {{.pointer = "/transmission/ior",
                     .label = "Sheet's index",
                     .minimum = 1.0,
                     .maximum = 3.0,
                     .default_value = 1.5,
                     .required = true,
                     .help = "Index of refraction n of the sheet; 1 to 3. A raised part delays light by the phase "
                             "2π (n − 1) depth/λ.",
                     .source = kGoodman},
                    {.pointer = "/transmission/reflectance",
                     .label = "Sheet's reflectance",
                     .default_value = 0.0,
                     .help = "Fraction of the light that the sheet reflects into the same orders; 0 to 1. It transmits "
                             "the remainder.",
                     .source = "a coating's, or Fresnel's equations"}})});
}

std::vector<Field> surface_fields() {
    return joined({{{.pointer = "/metal",
                     .label = "Metal",
                     .kind = FieldKind::Choice,
                     .choices = {{"none", nullptr}, {"Al", "Al"}, {"Ag", "Ag"}, {"Au", "Au"}, {"Cu", "Cu"}},
                     .help = "Coating; its reflectance at normal incidence multiplies every order. none: a perfect "
                             "mirror. Not beside a table, whose values include the metal.",
                     .source = "Fresnel's equations with measured n and k"}},
                   cover_fields(),
                   transmission_fields(),
                   {{.pointer = "/base/color",
                     .label = "Base colour",
                     .kind = FieldKind::Colour,
                     .default_value = {0.0, 0.0, 0.0},
                     .help = "Albedo of the layer under the grating, linear Rec.709; 0 to 1 each.",
                     .source = "a dielectric, lit by the power that the orders do not take"},
                    {.pointer = "/base/roughness",
                     .label = "Base roughness",
                     .default_value = 0.3,
                     .help = "Perceptual roughness of the layer under the grating; 0 to 1.",
                     .source = "glTF 2.0, metallic-roughness"}}});
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
    Field field{.pointer = std::string("/quality/") + setting.key,
                .label = setting.label,
                .kind = FieldKind::Count,
                .minimum = static_cast<double>(setting.minimum),
                .maximum = static_cast<double>(setting.maximum),
                .default_value = setting.default_value,
                .help = fmt::format("{} {} to {}.", setting.help, setting.minimum, setting.maximum),
                .source = kPaper,
                .only_with = "/quality"};
    if (setting.words.empty()) return field;
    field.kind = FieldKind::Choice;
    field.maximum = 1.0;
    field.help = setting.help;
    field.default_value = nullptr;
    field.choices = {{"default", nullptr}};
    for (const std::string_view word : setting.words) field.choices.push_back({std::string(word), word});
    return field;
}

/// A field for each setting; its range is the union of the ranges of all representations that have the setting.
std::vector<Field> setting_fields() {
    std::vector<Field> result;
    for (const auto* info : diffraction::representations())
        for (const diffraction::SettingInfo& setting : info->settings) {
            if (setting.words.empty() && setting.default_value.is_null()) continue;
            Field field = setting_field(setting);
            const auto known = std::ranges::find(result, field.pointer, &Field::pointer);
            Field& shown = known != result.end() ? *known : result.emplace_back(field);
            shown.minimum = std::min(shown.minimum, field.minimum);
            shown.maximum = std::max(shown.maximum, field.maximum);
            shown.only_for.emplace_back(info->name);
            if (setting.words.empty()) shown.defaults_by_choice.push_back({info->name, setting.default_value});
        }
    return result;
}

std::vector<Field> budget_fields() {
    return joined(
        {{{.pointer = "/quality",
           .label = "Representation",
           .kind = FieldKind::Choice,
           .default_value = {{"max_error", 0.05}},
           .choices = representation_choices(),
           .discriminator = "representation",
           .help = "The method that shades the surface. by budget: the cooker takes the cheapest within the error.",
           .source = "spikes: Lindsay & Agu 2006; the others go beyond it"}},
         shown_for("/quality", "by budget",
                   {{.pointer = "/quality/max_error",
                     .label = "Error allowed",
                     .minimum = 0.002,
                     .maximum = 20.0,
                     .logarithmic = true,
                     .default_value = 0.05,
                     .help = "Largest error against the reference; above 0.",
                     .source = "relative RMS: √(Σ|XYZ − XYZ_ref|² / Σ|XYZ_ref|²) over 120 views"},
                    {.pointer = "/quality/measure",
                     .label = "Error is",
                     .kind = FieldKind::Choice,
                     .default_value = "relative_rms",
                     .choices = {{"relative RMS", "relative_rms"}, {"ΔE2000", "delta_e"}, {"HDR-FLIP", "hdr_flip"}},
                     .help = "Relative RMS of XYZ; the 95th percentile of ΔE2000 over the views; or the mean of "
                             "HDR-FLIP over a picture.",
                     .source = "Sharma et al. 2005; Andersson et al. 2021"},
                    {.pointer = "/quality/surface",
                     .label = "Measured on",
                     .kind = FieldKind::Choice,
                     .default_value = "flat",
                     .choices = {{"flat", "flat"}, {"curved", "curved"}},
                     .help = "The surface of the measurement. flat: a compact disc tilted by 35°. curved: a sphere.",
                     .source = "120 views each"}})});
}

/// Key lights of the representations that do not require them. Without a request, those that hold all light as SH use
/// none, the others all.
Field key_lights_field() {
    Field field{.pointer = "/quality/key_lights",
                .label = "Key lights",
                .kind = FieldKind::Count,
                .maximum = lighting::kMaximumKeyLights,
                .default_value = lighting::kMaximumKeyLights,
                .help =
                    "Number of bright parts of the probe that are shaded one by one, at full sharpness. 0: none; "
                    "64: all.",
                .source = "von Mises–Fisher lobes fitted to the probe",
                .only_with = "/quality"};
    for (const auto* info : diffraction::representations()) {
        if (info->key_lights == diffraction::KeyLightUse::Always) continue;
        field.only_for.emplace_back(info->name);
        if (info->key_lights == diffraction::KeyLightUse::OnRequest)
            field.defaults_by_choice.push_back({info->name, 0});
    }
    return field;
}

std::vector<Field> light_fields() {
    return {key_lights_field(),
            {.pointer = "/quality/illuminant",
             .label = "Illuminant",
             .kind = FieldKind::Name,
             .default_value = "D65",
             .help = fmt::format("Spectrum of white light: {}, or a CSV beside the material.",
                                 fmt::join(colour::illuminant_names(), ", ")),
             .source = "CIE 15, Colorimetry"}};
}

std::vector<Field> groove_texture_fields() {
    const std::string transform = "/grooveTexture/extensions/KHR_texture_transform/";
    const char* const source = "KHR_texture_transform";
    return {{.pointer = "/grooveTexture/index",
             .label = "Texture",
             .kind = FieldKind::Count,
             .maximum = 1e9,
             .default_value = 0,
             .required = true,
             .help = "Number of the texture in the file, from 0. Pictures that are not saved yet are numbered from "
                     "1000000 on.",
             .source = diffraction::kGltfExtension},
            {.pointer = "/grooveTexture/texCoord",
             .label = "UV set",
             .kind = FieldKind::Count,
             .default_value = 0,
             .help = "The set of texture coordinates of the mesh; 0 or 1.",
             .source = "glTF 2.0, textureInfo"},
            {.pointer = "/grooveTexture/sparkle",
             .label = "Sparkle",
             .kind = FieldKind::Choice,
             .choices = {{"off", nullptr}, {"on", true}},
             .help = "on: a pixel shows the grooves of one texel, so that small cells sparkle. off: the mean over the "
                     "pixel's texels.",
             .source = diffraction::kGltfExtension},
            {.pointer = transform + "offset",
             .label = "Offset",
             .kind = FieldKind::Pair,
             .minimum = -1.0,
             .maximum = 1.0,
             .default_value = {0.0, 0.0},
             .help = "Offset of the texture on the mesh, in texture coordinates.",
             .source = source},
            {.pointer = transform + "scale",
             .label = "Repeats",
             .kind = FieldKind::Pair,
             .maximum = 10.0,
             .default_value = {1.0, 1.0},
             .help = "Number of repetitions of the texture over one unit of u and of v.",
             .source = source},
            {.pointer = transform + "rotation",
             .label = "Rotation",
             .unit = "rad",
             .minimum = -std::numbers::pi,
             .maximum = std::numbers::pi,
             .default_value = 0.0,
             .help = "Rotation of the texture about the origin of its coordinates. It does not rotate the grooves.",
             .source = source}};
}

}  // namespace

std::span<const Field> fields() {
    static const std::vector<Field> all =
        joined({grating_fields(), surface_fields(), budget_fields(), setting_fields(), light_fields()});
    return all;
}

std::span<const Field> groove_fields() {
    static const std::vector<Field> all = joined(
        {{{.pointer = "/grooveRotation",
           .label = "Groove rotation",
           .unit = "rad",
           .minimum = -std::numbers::pi,
           .maximum = std::numbers::pi,
           .default_value = 0.0,
           .help = "Rotates the grooves in the surface, from the mesh's tangent toward its bitangent. Or drag the "
                   "handle in the preview (G).",
           .source = diffraction::kGltfExtension},
          {.pointer = "/grooveTexture",
           .label = "Groove texture",
           .kind = FieldKind::Choice,
           .choices = {{"none", nullptr}, {"texture", {{"index", 0}}}},
           .help =
               "Varies the grooves over the mesh. R: rotation / 180 degrees, G: pitch / (2 pitch_nm), 0 where there "
               "is no grating.",
           .source = diffraction::kGltfExtension}},
         shown_for("/grooveTexture", "texture", groove_texture_fields())});
    return all;
}

}  // namespace rowland::inspector
