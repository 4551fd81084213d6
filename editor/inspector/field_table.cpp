#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <span>
#include <vector>

#include "editor/inspector/field.h"
#include "editor/inspector/grating_fields.h"
#include "engine/colour/illuminant.h"
#include "engine/lighting/key_lights.h"
#include "modules/diffraction/representations/representation.h"

namespace rowland::inspector {

namespace {

const char* const kPaper = "Lindsay & Agu 2006";

std::vector<Field> surface_fields() {
    return {
        {.pointer = "/metal",
         .label = "Metal",
         .kind = FieldKind::Choice,
         .choices = {{"none", nullptr}, {"Al", "Al"}, {"Ag", "Ag"}, {"Au", "Au"}, {"Cu", "Cu"}},
         .help = "Coating; its reflectance at normal incidence multiplies every order. none: a perfect mirror. Not "
                 "beside a table, which has its metal inside.",
         .source = "Fresnel's equations with measured n and k"},
        {.pointer = "/cover",
         .label = "Cover",
         .kind = FieldKind::Choice,
         .choices = {{"none", nullptr}, {"over the grooves", {{"ior", 1.58}}}},
         .help = "A transparent layer over the grooves, as on a disc or a laminated foil: gloss on top, and a groove's "
                 "depth counts n times.",
         .source = "Fresnel's equations; Wang 1995, doi 10.1117/12.196541"},
        {.pointer = "/cover/ior",
         .label = "Cover's index",
         .minimum = 1.0,
         .maximum = 3.0,
         .default_value = 1.58,
         .required = true,
         .only_with = "/cover",
         .only_for = {"over the grooves"},
         .help = "Index of refraction n of the cover; 1 to 3. Polycarbonate 1.58, acrylic 1.49.",
         .source = "Fresnel's equations"},
        {.pointer = "/cover/tint",
         .label = "Cover's tint",
         .kind = FieldKind::Colour,
         .default_value = {1.0, 1.0, 1.0},
         .only_with = "/cover",
         .only_for = {"over the grooves"},
         .help = "What a dye in the cover passes on the way in, and again on the way out, linear Rec.709; 0 to 1 each. "
                 "Not beside a table, which has its dye inside.",
         .source = "Mallett & Yuksel 2019"},
        {.pointer = "/transmission",
         .label = "Transmission",
         .kind = FieldKind::Choice,
         .choices = {{"none", nullptr}, {"through a sheet", {{"ior", 1.5}}}},
         .help = "A thin sheet that one looks through: the orders show the light behind it, order 0 what lies straight "
                 "behind. Not beside a metal or a cover.",
         .source = "Goodman, Introduction to Fourier Optics, ch. 4"},
        {.pointer = "/transmission/ior",
         .label = "Sheet's index",
         .minimum = 1.0,
         .maximum = 3.0,
         .default_value = 1.5,
         .required = true,
         .only_with = "/transmission",
         .only_for = {"through a sheet"},
         .help =
             "Index of refraction n of the sheet; 1 to 3. Light through a raised part is late by 2π (n − 1) depth/λ.",
         .source = "Goodman, Introduction to Fourier Optics, ch. 4"},
        {.pointer = "/transmission/reflectance",
         .label = "Sheet's reflectance",
         .minimum = 0.0,
         .maximum = 1.0,
         .default_value = 0.0,
         .only_with = "/transmission",
         .only_for = {"through a sheet"},
         .help = "Fraction of the light that the sheet reflects, by the same orders; 0 to 1. It transmits the rest.",
         .source = "a coating's, or Fresnel's equations"},
        {.pointer = "/base/color",
         .label = "Base colour",
         .kind = FieldKind::Colour,
         .default_value = {0.0, 0.0, 0.0},
         .help = "Albedo of what lies under the grating, linear Rec.709; 0 to 1 each.",
         .source = "a dielectric, lit by what the orders leave over"},
        {.pointer = "/base/roughness",
         .label = "Base roughness",
         .default_value = 0.3,
         .help = "Perceptual roughness of what lies under the grating; 0 to 1.",
         .source = "glTF 2.0, metallic-roughness"},
    };
}

std::vector<Choice> representation_choices() {
    std::vector<Choice> choices{{"by budget", {{"max_error", 0.05}}}};
    for (const auto* info : diffraction::representations()) {
        Json start = {{"representation", info->name}};
        for (const char* key : info->editor_start) start[key] = Json(info->find(key)->default_value);
        choices.push_back({info->name, std::move(start)});
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
                .only_with = "/quality",
                .help = fmt::format("{} {} to {}.", setting.help, setting.minimum, setting.maximum),
                .source = kPaper};
    if (setting.words.empty()) return field;
    field.kind = FieldKind::Choice;
    field.maximum = 1.0;
    field.help = setting.help;
    field.default_value = nullptr;
    field.choices = {{"default", nullptr}};
    for (const std::string_view word : setting.words) field.choices.push_back({std::string(word), word});
    return field;
}

/// A field for each setting, from the least to the largest limit of the representations that have it.
std::vector<Field> setting_fields() {
    std::vector<Field> result;
    for (const auto* info : diffraction::representations())
        for (const diffraction::SettingInfo& setting : info->settings) {
            if (setting.words.empty() && setting.default_value.is_null()) continue;
            Field field = setting_field(setting);
            const auto known = std::find_if(result.begin(), result.end(),
                                            [&](const Field& other) { return other.pointer == field.pointer; });
            Field& shown = known != result.end() ? *known : result.emplace_back(field);
            shown.minimum = std::min(shown.minimum, field.minimum);
            shown.maximum = std::max(shown.maximum, field.maximum);
            shown.only_for.emplace_back(info->name);
            if (setting.words.empty()) shown.defaults_by_choice.push_back({info->name, setting.default_value});
        }
    return result;
}

std::vector<std::string> with_optional_key_lights() {
    std::vector<std::string> names;
    for (const auto* info : diffraction::representations())
        if (info->key_lights != diffraction::KeyLightUse::Always) names.emplace_back(info->name);
    return names;
}

/// Spikes, bins and transfer take all light as SH.
std::vector<Choice> defaults_of_key_lights() {
    std::vector<Choice> result;
    for (const auto* info : diffraction::representations())
        if (info->key_lights == diffraction::KeyLightUse::OnRequest) result.push_back({info->name, 0});
    return result;
}

std::vector<Field> budget_fields() {
    return {{.pointer = "/quality",
             .label = "Representation",
             .kind = FieldKind::Choice,
             .default_value = {{"max_error", 0.05}},
             .choices = representation_choices(),
             .discriminator = "representation",
             .help = "How the surface is drawn. by budget: the cooker takes the cheapest that is within the error.",
             .source = "spikes: Lindsay & Agu 2006; the others go beyond it"},
            {.pointer = "/quality/max_error",
             .label = "Error allowed",
             .minimum = 0.002,
             .maximum = 20.0,
             .logarithmic = true,
             .default_value = 0.05,
             .only_with = "/quality",
             .only_for = {"by budget"},
             .help = "Error against the reference that is tolerated; above 0.",
             .source = "relative RMS: √(Σ|XYZ − XYZ_ref|² / Σ|XYZ_ref|²) over 120 views"},
            {.pointer = "/quality/measure",
             .label = "Error is",
             .kind = FieldKind::Choice,
             .default_value = "relative_rms",
             .choices = {{"relative RMS", "relative_rms"}, {"ΔE2000", "delta_e"}, {"HDR-FLIP", "hdr_flip"}},
             .only_with = "/quality",
             .only_for = {"by budget"},
             .help = "Relative RMS of XYZ; ΔE2000 that 95 % of the views do not exceed; or mean HDR-FLIP of a picture.",
             .source = "Sharma et al. 2005; Andersson et al. 2021"},
            {.pointer = "/quality/surface",
             .label = "Measured on",
             .kind = FieldKind::Choice,
             .default_value = "flat",
             .choices = {{"flat", "flat"}, {"curved", "curved"}},
             .only_with = "/quality",
             .only_for = {"by budget"},
             .help = "What the error is measured on: a compact disc tilted by 35°, or a sphere.",
             .source = "120 views each"}};
}

std::vector<Field> light_fields() {
    return {{.pointer = "/quality/key_lights",
             .label = "Key lights",
             .kind = FieldKind::Count,
             .minimum = 0,
             .maximum = lighting::kMaximumKeyLights,
             .default_value = lighting::kMaximumKeyLights,
             .only_with = "/quality",
             .only_for = with_optional_key_lights(),
             .defaults_by_choice = defaults_of_key_lights(),
             .help = "How many of the probe's bright parts are shaded one by one, at full sharpness. 0: none; 64: all.",
             .source = "von Mises–Fisher lobes fitted to the probe"},
            {.pointer = "/quality/illuminant",
             .label = "Illuminant",
             .kind = FieldKind::Name,
             .default_value = "D65",
             .help = fmt::format("Spectrum of the light's white: {}, or a CSV beside the material.",
                                 fmt::join(colour::illuminant_names(), ", ")),
             .source = "CIE 15, Colorimetry"}};
}

std::vector<Field> make_fields() {
    std::vector<Field> all = grating_fields();
    for (auto part : {surface_fields(), budget_fields(), setting_fields(), light_fields()})
        all.insert(all.end(), part.begin(), part.end());
    return all;
}

}  // namespace

std::span<const Field> fields() {
    static const std::vector<Field> all = make_fields();
    return all;
}

}  // namespace rowland::inspector
