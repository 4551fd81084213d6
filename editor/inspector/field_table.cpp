#include <span>
#include <vector>

#include "editor/inspector/field.h"

namespace rowland::inspector {

namespace {

const char* const kScalar = "Goodman, Introduction to Fourier Optics, ch. 4: scalar theory at normal incidence";
const char* const kPaper = "Lindsay & Agu 2006";

std::vector<Field> grating_fields() {
    const auto of_profile = [](Field field, std::vector<std::string> profiles) {
        field.required = true;
        field.only_with = "/grating/profile";
        field.only_for = std::move(profiles);
        return field;
    };
    const Field depth{.pointer = "/grating/profile/depth_nm",
                      .label = "Groove depth",
                      .unit = "nm",
                      .minimum = 10.0,
                      .maximum = 1000.0,
                      .default_value = 150,
                      .help = "Depth of a groove, from top to bottom. Above 0. The phase it gives light is 4π depth/λ.",
                      .source = kScalar};
    return {
        {.pointer = "/grating/pitch_nm",
         .label = "Pitch",
         .unit = "nm",
         .minimum = 200.0,
         .maximum = 20000.0,
         .logarithmic = true,
         .default_value = 1600,
         .required = true,
         .help = "Distance d of neighbouring grooves: order m of wavelength λ goes where d (s_g + v_g) = m λ. 1 to "
                 "10 000 000 nm. A compact disc has 1600, a DVD 740.",
         .source = "the grating equation; Lindsay & Agu 2006, eq. 1"},
        {.pointer = "/grating/profile",
         .label = "Profile",
         .kind = FieldKind::Choice,
         .default_value = {{"type", "slit"}, {"width_nm", 800}},
         .required = true,
         .choices = {{"slit", {{"type", "slit"}, {"width_nm", 800}}},
                     {"lamellar", {{"type", "lamellar"}, {"duty", 0.5}, {"depth_nm", 150}}},
                     {"sinusoidal", {{"type", "sinusoidal"}, {"depth_nm", 150}}},
                     {"blazed", {{"type", "blazed"}, {"depth_nm", 250}}},
                     {"table", {{"type", "table"}, {"file", ""}}}},
         .discriminator = "type",
         .help = "Shape of a groove: it decides how much of the light each order gets. A table of measured or rigorous "
                 "efficiencies knows what scalar theory misses.",
         .source = "slit: Lindsay & Agu 2006, eq. 2; others: Goodman, Introduction to Fourier Optics, ch. 4"},
        of_profile({.pointer = "/grating/profile/width_nm",
                    .label = "Slit width",
                    .unit = "nm",
                    .minimum = 10.0,
                    .maximum = 2000.0,
                    .default_value = 800,
                    .help = "Width b of the part of a groove that reflects; above 0, at most the pitch. "
                            "η_m = (b/d)² sinc²(m b/d).",
                    .source = "Lindsay & Agu 2006, eq. 2"},
                   {"slit"}),
        of_profile({.pointer = "/grating/profile/duty",
                    .label = "Duty",
                    .minimum = 0.02,
                    .maximum = 0.98,
                    .default_value = 0.5,
                    .help = "Share w of the pitch that is raised; between 0 and 1. "
                            "η_m = 4w² sinc²(m w) sin²(φ/2), φ = 4π depth/λ.",
                    .source = kScalar},
                   {"lamellar"}),
        of_profile(depth, {"lamellar", "sinusoidal", "blazed"}),
        of_profile({.pointer = "/grating/profile/file",
                    .label = "Table",
                    .kind = FieldKind::Name,
                    .default_value = "",
                    .help = "CSV beside the material: wavelength_nm,R-2,R-1,R+0,R+1,… The metal is already in it.",
                    .source = "a measurement, or a rigorous solver"},
                   {"table"}),
        {.pointer = "/grating/orders",
         .label = "Orders",
         .kind = FieldKind::Orders,
         .default_value = {-2, -1, 1, 2},
         .help = "Orders that are shaded, or \"all\" that propagate for some visible wavelength. Without 0 the mirror "
                 "order goes to the reflection of the surroundings.",
         .source = kPaper},
        {.pointer = "/grating/grooves",
         .label = "Lit grooves",
         .minimum = 50.0,
         .maximum = 10000.0,
         .logarithmic = true,
         .default_value = 1500,
         .help = "Grooves N that light falls on together; at least 1. From 50 on an order is a sharp line.",
         .source = "Lindsay & Agu 2006, eq. 3 (N = 1500)"},
        {.pointer = "/grating/normalization",
         .label = "Normalisation",
         .kind = FieldKind::Choice,
         .default_value = "energy",
         .choices = {{"energy", "energy"}, {"agu", "agu"}},
         .help = "energy: each order carries its efficiency. agu: the paper's peak form, each order times λ/550 nm; "
                 "slits only.",
         .source = "Lindsay & Agu 2006, eq. 1–3"},
        {.pointer = "/grating/groove_lobe",
         .label = "Lobe",
         .kind = FieldKind::Choice,
         .default_value = "flat",
         .choices = {{"flat", "flat"},
                     {"gaussian", {{"sigma", 0.1}}},
                     {"pits", {{"pits", {{"length_nm", 850}, {"coherent", 0.3}}}}}},
         .help =
             "How light spreads along the grooves. flat: evenly, as in the paper. gaussian: pressed discs and foil, "
             "thin streaks. pits: a compact disc's data.",
         .source = "flat: Lindsay & Agu 2006; pits: Stam 1999, Diffraction shaders"},
        {.pointer = "/grating/groove_lobe/sigma",
         .label = "Lobe width",
         .minimum = 0.005,
         .maximum = 1.0,
         .logarithmic = true,
         .default_value = 0.1,
         .required = true,
         .only_with = "/grating/groove_lobe",
         .only_for = {"gaussian"},
         .help = "Standard deviation σ of s_h + v_h along the grooves; above 0.",
         .source = "a normal distribution, cut to the hemisphere"},
        {.pointer = "/grating/groove_lobe/pits/length_nm",
         .label = "Pit length",
         .unit = "nm",
         .minimum = 200.0,
         .maximum = 4000.0,
         .default_value = 850,
         .required = true,
         .only_with = "/grating/groove_lobe",
         .only_for = {"pits"},
         .help = "Length ℓ of the pits, which are Poisson-distributed along the track; above 0, at most 100 000.",
         .source = "Stam 1999, Diffraction shaders"},
        {.pointer = "/grating/groove_lobe/pits/coherent",
         .label = "Coherent share",
         .default_value = 0.3,
         .required = true,
         .only_with = "/grating/groove_lobe",
         .only_for = {"pits"},
         .help = "Share κ of the light that the track reflects as if it were unbroken; 0 to 1.",
         .source = "Stam 1999, Diffraction shaders"},
    };
}

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
