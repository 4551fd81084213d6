#include <span>
#include <vector>

#include "editor/inspector/field.h"
#include "editor/inspector/grating_fields.h"

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

std::vector<Choice> representations() {
    return {{"by budget", {{"max_error", 0.05}}},
            {"spikes", {{"representation", "spikes"}, {"bands", 5}, {"spikes", 4}}},
            {"bins", {{"representation", "bins"}, {"bands", 5}, {"bins", 16}}},
            {"transfer", {{"representation", "transfer"}, {"bands", 5}}},
            {"arc", {{"representation", "arc"}, {"bands", 8}, {"rank", 12}}},
            {"direct", {{"representation", "direct"}}},
            {"planar", {{"representation", "planar"}, {"map_resolution", 128}}},
            {"circle", {{"representation", "circle"}, {"map_resolution", 64}}},
            {"streak", {{"representation", "streak"}, {"nodes", 8}, {"taps", 3}}}};
}

std::vector<Field> quality_fields() {
    const auto count = [](const char* name, const char* label, double maximum, int usual,
                          std::vector<std::string> representations, const char* help) {
        return Field{.pointer = std::string("/quality/") + name,
                     .label = label,
                     .kind = FieldKind::Count,
                     .minimum = 1.0,
                     .maximum = maximum,
                     .default_value = usual,
                     .only_with = "/quality",
                     .only_for = std::move(representations),
                     .help = help,
                     .source = kPaper};
    };
    std::vector<Field> result = {
        {.pointer = "/quality",
         .label = "Representation",
         .kind = FieldKind::Choice,
         .default_value = {{"max_error", 0.05}},
         .choices = representations(),
         .discriminator = "representation",
         .help = "How the surface is drawn. by budget: the cooker takes the cheapest that is within the error.",
         .source = "spikes: Lindsay & Agu 2006; the others go beyond it"},
        {.pointer = "/quality/max_error",
         .label = "Error allowed",
         .minimum = 0.002,
         .maximum = 1.0,
         .logarithmic = true,
         .default_value = 0.05,
         .only_with = "/quality",
         .only_for = {"by budget"},
         .help = "Relative RMS error against the reference that can be borne; above 0.",
         .source = "√(Σ|XYZ − XYZ_ref|² / Σ|XYZ_ref|²) over 120 views"},
        {.pointer = "/quality/surface",
         .label = "Measured on",
         .kind = FieldKind::Choice,
         .default_value = "flat",
         .choices = {{"flat", "flat"}, {"curved", "curved"}},
         .only_with = "/quality",
         .only_for = {"by budget"},
         .help = "What the error is measured on: a compact disc tilted by 35°, or a sphere.",
         .source = "120 views each"},
        count("bands", "Bands", 16.0, 5, {"spikes", "bins", "transfer", "arc", "planar"},
              "Bands n of spherical harmonics, n² coefficients; 1 to 16. More follow sharper light."),
        count("spikes", "Spikes", 64.0, 4, {"spikes"}, "Wavelengths of the composite model a view; 1 to 64."),
        count("bins", "Bins", 64.0, 16, {"bins"}, "Fixed wavelength bins; 1 to 64."),
        count("rank", "Rank", 16.0, 8, {"arc", "planar"}, "Products of the arc table's decomposition; 1 to 16."),
        count("map_resolution", "Map resolution", 512.0, 128, {"planar", "circle"},
              "Cells along a side of the map; planar 8 to 1024, circle 8 to 128."),
        count("nodes", "Nodes", 32.0, 8, {"streak"}, "Wavelength nodes an order; 1 to 32."),
        count("taps", "Taps", 9.0, 3, {"streak"}, "Look-ups across the lobe; 1 to 9."),
        {.pointer = "/quality/key_lights",
         .label = "Key lights",
         .kind = FieldKind::Choice,
         .choices = {{"usual", nullptr}, {"on", true}, {"off", false}},
         .only_with = "/quality",
         .only_for = {"spikes", "bins", "transfer", "arc", "planar", "circle"},
         .help = "Whether the probe's bright parts are shaded as lights of their own, at full sharpness.",
         .source = "von Mises–Fisher lobes fitted to the probe"},
        {.pointer = "/quality/illuminant",
         .label = "Illuminant",
         .kind = FieldKind::Name,
         .default_value = "D65",
         .help = "Spectrum of the light's white: A, D65, E, F2, F11, LED-B3, or a CSV beside the material.",
         .source = "CIE 15, Colorimetry"}};
    return result;
}

std::vector<Field> make_fields() {
    std::vector<Field> all = grating_fields();
    for (auto part : {surface_fields(), quality_fields()}) all.insert(all.end(), part.begin(), part.end());
    return all;
}

}  // namespace

std::span<const Field> fields() {
    static const std::vector<Field> all = make_fields();
    return all;
}

}  // namespace rowland::inspector
