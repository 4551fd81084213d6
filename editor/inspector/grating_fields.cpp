#include "editor/inspector/grating_fields.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>

#include "modules/diffraction/model/profile.h"

namespace rowland::inspector {

namespace {

using diffraction::ProfileDescriptor;
using diffraction::ProfileMember;

/// A member as the profile starts with it; whole numbers are written without a fraction.
Json initial_value(const ProfileMember& member) {
    if (member.value == nullptr) return "";
    if (member.initial == std::floor(member.initial)) return static_cast<std::int64_t>(member.initial);
    return member.initial;
}

Field choice_of_profile() {
    Field field{.pointer = "/grating/profile",
                .label = "Profile",
                .kind = FieldKind::Choice,
                .required = true,
                .discriminator = "type",
                .help =
                    "Shape of a groove: it decides how much light each order gets. A table of measured or rigorous "
                    "efficiencies includes the effects that scalar theory neglects.",
                .source = "slit: Lindsay & Agu 2006, eq. 2; others: Goodman, Introduction to Fourier Optics, ch. 4"};
    for (const ProfileDescriptor& descriptor : diffraction::profile_descriptors()) {
        Json profile = {{"type", descriptor.name}};
        for (const ProfileMember& member : descriptor.members) profile[member.key] = initial_value(member);
        field.choices.push_back({std::string(descriptor.name), profile});
    }
    field.default_value = field.choices.front().value;
    return field;
}

Field profile_field(const ProfileMember& member) {
    Field field{.pointer = std::string("/grating/profile/") + member.key,
                .label = member.label,
                .unit = member.unit,
                .default_value = initial_value(member),
                .required = true,
                .only_with = "/grating/profile",
                .help = member.help,
                .source = member.source};
    if (member.value == nullptr) {
        field.kind = FieldKind::Name;
    } else {
        field.minimum = member.slider_least;
        field.maximum = member.slider_most;
    }
    return field;
}

/// The choice of a profile, and one field for each member; profiles with the same member share its field.
std::vector<Field> profile_fields() {
    std::vector<Field> result = {choice_of_profile()};
    for (const ProfileDescriptor& descriptor : diffraction::profile_descriptors()) {
        for (const ProfileMember& member : descriptor.members) {
            Field field = profile_field(member);
            const auto known = std::find_if(result.begin(), result.end(),
                                            [&](const Field& other) { return other.pointer == field.pointer; });
            Field& shown = known != result.end() ? *known : result.emplace_back(std::move(field));
            shown.only_for.emplace_back(descriptor.name);
        }
    }
    return result;
}

Field pitch_field() {
    return {.pointer = "/grating/pitch_nm",
            .label = "Pitch",
            .unit = "nm",
            .minimum = 200.0,
            .maximum = 20000.0,
            .logarithmic = true,
            .default_value = 1600,
            .required = true,
            .help =
                "Distance d of neighbouring grooves: order m of wavelength λ goes where d (s_g + v_g) = m λ. 1 to "
                "10 000 000 nm. A compact disc has 1600, a DVD 740.",
            .source = "the grating equation; Lindsay & Agu 2006, eq. 1"};
}

std::vector<Field> other_fields() {
    return {
        {.pointer = "/grating/orders",
         .label = "Orders",
         .kind = FieldKind::Orders,
         .default_value = {-2, -1, 1, 2},
         .help = "Orders that are shaded, or \"all\" that propagate for some visible wavelength. Without 0 the mirror "
                 "order goes to the reflection of the surroundings.",
         .source = "Lindsay & Agu 2006"},
        {.pointer = "/grating/grooves",
         .label = "Lit grooves",
         .minimum = 50.0,
         .maximum = 10000.0,
         .logarithmic = true,
         .default_value = 1500,
         .help = "Number N of grooves that are lit together; at least 1. From 50 on an order is a sharp line.",
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
         .label = "Coherent part",
         .default_value = 0.3,
         .required = true,
         .only_with = "/grating/groove_lobe",
         .only_for = {"pits"},
         .help = "Fraction κ of the light that the track reflects as if it were unbroken; 0 to 1.",
         .source = "Stam 1999, Diffraction shaders"},
    };
}

}  // namespace

std::vector<Field> grating_fields() {
    std::vector<Field> all = {pitch_field()};
    for (auto part : {profile_fields(), other_fields()}) std::move(part.begin(), part.end(), std::back_inserter(all));
    return all;
}

}  // namespace rowland::inspector
