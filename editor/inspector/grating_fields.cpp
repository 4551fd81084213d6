#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>

#include "editor/inspector/field.h"
#include "modules/diffraction/model/lattice.h"
#include "modules/diffraction/model/profile.h"

namespace rowland::inspector {

namespace {

using diffraction::ProfileDescriptor;
using diffraction::ProfileMember;

const char* const kSource = "Goodman, Introduction to Fourier Optics, ch. 4";

void append(std::vector<Field> part, std::vector<Field>& all) {
    std::move(part.begin(), part.end(), std::back_inserter(all));
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

Field profile_field(const Field& choice, const ProfileMember& member) {
    Field field{.pointer = choice.pointer + "/" + member.key,
                .label = member.label,
                .unit = member.unit,
                .default_value = initial_value(member),
                .required = true,
                .help = member.help,
                .source = member.source,
                .only_with = choice.pointer};
    if (member.value == nullptr) {
        field.kind = FieldKind::Name;
        return field;
    }
    const bool has_limit = !member.within_pitch && std::isfinite(member.less_than);
    field.minimum = has_limit ? 0.02 * member.less_than : 10.0;  // nm
    field.maximum = has_limit ? 0.98 * member.less_than : 2000.0;
    return field;
}

/// The field `choice` with all groove profiles as its choices, then a field for each of their members; a member that
/// several profiles have has one field. `with_table`: a table of efficiencies is among the profiles.
std::vector<Field> profile_fields(Field choice, bool with_table) {
    std::vector<Field> result = {choice};
    for (const ProfileDescriptor& descriptor : diffraction::profile_descriptors()) {
        if (!with_table && std::holds_alternative<diffraction::EfficiencyTable>(descriptor.empty)) continue;
        result.front().choices.push_back({std::string(descriptor.name), initial_profile(descriptor)});
        for (const ProfileMember& member : descriptor.members) {
            Field field = profile_field(choice, member);
            const auto known = std::ranges::find(result, field.pointer, &Field::pointer);
            Field& shown = known != result.end() ? *known : result.emplace_back(std::move(field));
            shown.only_for.emplace_back(descriptor.name);
        }
    }
    if (result.front().default_value.is_null()) result.front().default_value = result.front().choices.front().value;
    return result;
}

std::vector<Field> groove_profile_fields() {
    return profile_fields(
        {.pointer = "/grating/profile",
         .label = "Profile",
         .kind = FieldKind::Choice,
         .required = true,
         .discriminator = "type",
         .help = "Shape of a groove; it determines the efficiency of each order. A table of measured or rigorous "
                 "efficiencies includes the effects that scalar theory neglects.",
         .source = "slit: Lindsay & Agu 2006, eq. 2; others: Goodman, Introduction to Fourier Optics, ch. 4",
         .only_with = "/grating",
         .only_for = {"grooves"}},
        true);
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
                "Distance d of adjacent grooves. Grating equation for order m and wavelength λ: d (s_g + v_g) = m λ. "
                "1 to 10 000 000 nm. A compact disc has 1600, a DVD 740.",
            .source = "the grating equation; Lindsay & Agu 2006, eq. 1"};
}

std::vector<Field> order_and_lobe_fields() {
    std::vector<Field> all = shown_for(
        "/grating", "grooves",
        {{.pointer = "/grating/orders",
          .label = "Orders",
          .kind = FieldKind::Orders,
          .default_value = {-2, -1, 1, 2},
          .help = "The shaded orders, or \"all\" that propagate for some visible wavelength. If 0 is not listed, the "
                  "mirror's order reflects the environment.",
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
          .help = "energy: each order has the power of its efficiency. agu: the paper's peak form, each order times "
                  "λ/550 nm; slits only.",
          .source = "Lindsay & Agu 2006, eq. 1–3"},
         {.pointer = "/grating/groove_lobe",
          .label = "Lobe",
          .kind = FieldKind::Choice,
          .default_value = "flat",
          .choices = {{"flat", "flat"},
                      {"gaussian", {{"sigma", 0.1}}},
                      {"pits", {{"pits", {{"length_nm", 850}, {"coherent", 0.3}}}}}},
          .help = "Distribution of light along the grooves. flat: uniform, as in the paper. gaussian: thin streaks, as "
                  "of pressed discs and foil. pits: the data of a compact disc.",
          .source = "flat: Lindsay & Agu 2006; pits: Stam 1999, Diffraction shaders"}});
    append(shown_for("/grating/groove_lobe", "gaussian",
                     {{.pointer = "/grating/groove_lobe/sigma",
                       .label = "Lobe width",
                       .minimum = 0.005,
                       .maximum = 1.0,
                       .logarithmic = true,
                       .default_value = 0.1,
                       .required = true,
                       .help = "Standard deviation σ of s_h + v_h along the grooves; above 0.",
                       .source = "a normal distribution, truncated at the hemisphere"}}),
           all);
    append(
        shown_for("/grating/groove_lobe", "pits",
                  {{.pointer = "/grating/groove_lobe/pits/length_nm",
                    .label = "Pit length",
                    .unit = "nm",
                    .minimum = 200.0,
                    .maximum = 4000.0,
                    .default_value = 850,
                    .required = true,
                    .help = "Length ℓ of the pits, whose positions along the track are a Poisson process; above 0, at "
                            "most 100 000.",
                    .source = "Stam 1999, Diffraction shaders"},
                   {.pointer = "/grating/groove_lobe/pits/coherent",
                    .label = "Coherent part",
                    .default_value = 0.3,
                    .required = true,
                    .help = "Fraction κ of the light that is reflected as by a continuous track; 0 to 1.",
                    .source = "Stam 1999, Diffraction shaders"}}),
        all);
    return all;
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
    return {.pointer = "/grating/lattice/" + side + "_nm",
            .label = "Side " + side,
            .unit = "nm",
            .kind = FieldKind::Pair,
            .minimum = 300.0,
            .maximum = 100000.0,
            .logarithmic = true,
            .default_value = initial,
            .required = true,
            .help =
                "Components along g and h of one of the two sides of a cell, a and b. 300 to 10 000 000 nm long; at "
                "least 2° between a and b. The pixels of a telephone are 50 000 nm wide.",
            .source = "the grating equation in two dimensions; " + std::string(kSource)};
}

/// Grooves that cross one of the sides.
std::vector<Field> crossed_fields(const std::string& side) {
    return profile_fields({.pointer = "/grating/profile/along_" + side,
                           .label = "Along " + side,
                           .kind = FieldKind::Choice,
                           .default_value = initial_sinusoid(),
                           .required = true,
                           .discriminator = "type",
                           .help = "Shape of the grooves that repeat along " + side +
                                   "; its length is their pitch. The fields below belong to them.",
                           .source = kSource,
                           .only_with = "/grating/profile",
                           .only_for = {"crossed"}},
                          false);
}

Field opening_field(const char* key, const char* label, const std::string& side) {
    return {.pointer = std::string("/grating/profile/") + key,
            .label = label,
            .unit = "nm",
            .minimum = 100.0,
            .maximum = 100000.0,
            .logarithmic = true,
            .default_value = 500,
            .required = true,
            .help = "Length of the opening along " + side + "; above 0, at most the length of " + side + ".",
            .source = kSource};
}

std::vector<Field> lattice_fields() {
    std::vector<Field> all = shown_for(
        "/grating", "lattice",
        {side_field("a", {1000, 0}),
         side_field("b", {0, 1000}),
         {.pointer = "/grating/profile",
          .label = "Profile",
          .kind = FieldKind::Choice,
          .default_value = initial_crossed(),
          .required = true,
          .choices = {{"crossed", initial_crossed()},
                      {"aperture", {{"type", "aperture"}, {"width_nm", 500}, {"height_nm", 500}}},
                      {"height_map", {{"type", "height_map"}, {"file", ""}, {"depth_nm", 150}}}},
          .discriminator = "type",
          .help = "Content of a cell. crossed: two sets of grooves whose heights add. aperture: one opening, as in a "
                  "screen. height_map: a picture of the heights.",
          .source = kSource}});
    append(crossed_fields("a"), all);
    append(crossed_fields("b"), all);
    append(shown_for("/grating/profile", "aperture",
                     {opening_field("width_nm", "Width", "a"), opening_field("height_nm", "Height", "b")}),
           all);
    append(shown_for("/grating/profile", "height_map",
                     {{.pointer = "/grating/profile/file",
                       .label = "Height map",
                       .kind = FieldKind::Name,
                       .default_value = "",
                       .required = true,
                       .help = "A PNG of the heights of one cell beside the material, at most 256 × 256; on each side "
                               "more texels than twice the orders. White is raised by the full depth.",
                       .source = kSource},
                      {.pointer = "/grating/profile/depth_nm",
                       .label = "Depth",
                       .unit = "nm",
                       .minimum = 20.0,
                       .maximum = 1000.0,
                       .default_value = 150,
                       .required = true,
                       .help = "Height of white over black; above 0.",
                       .source = kSource}}),
           all);
    append(
        shown_for("/grating", "lattice",
                  {{.pointer = "/grating/orders",
                    .label = "Orders",
                    .kind = FieldKind::Count,
                    .minimum = 1.0,
                    .maximum = diffraction::kHighestLatticeOrder,
                    .default_value = diffraction::Lattice().orders,
                    .help = "The highest order along each side: all (m, k) with |m| and |k| up to it are shaded, but "
                            "(0, 0).",
                    .source = kSource}}),
        all);
    return all;
}

}  // namespace

std::vector<Field> grating_fields() {
    std::vector<Field> profiles = groove_profile_fields();
    std::vector<Field> all = shown_for("/grating", "grooves", {pitch_field()});
    append({{.pointer = "/grating",
             .label = "Pattern",
             .kind = FieldKind::Choice,
             .required = true,
             .choices = {{"grooves", {{"pitch_nm", 1600}, {"profile", profiles.front().default_value}}},
                         {"lattice", initial_lattice()}},
             .help = "grooves: of one direction. lattice: a surface that repeats along two directions, as crossed foil "
                     "or the pixels of a screen. Another choice replaces the whole grating.",
             .source = kSource}},
           all);
    append(std::move(profiles), all);
    append(order_and_lobe_fields(), all);
    append(lattice_fields(), all);
    return all;
}

}  // namespace rowland::inspector
