#include "editor/inspector/grating_fields.h"

#include <algorithm>
#include <iterator>

#include "editor/inspector/lattice_fields.h"
#include "editor/inspector/profile_fields.h"

namespace rowland::inspector {

namespace {

Field of_grooves(Field field) {
    field.only_with = "/grating";
    field.only_for = {"grooves"};
    return field;
}

std::vector<Field> groove_profile_fields() {
    return profile_fields(
        of_grooves({.pointer = "/grating/profile",
                    .label = "Profile",
                    .kind = FieldKind::Choice,
                    .required = true,
                    .discriminator = "type",
                    .help = "Shape of a groove: it decides how much light each order gets. A table of measured or "
                            "rigorous efficiencies includes the effects that scalar theory neglects.",
                    .source = "slit: Lindsay & Agu 2006, eq. 2; others: Goodman, Introduction to Fourier Optics, "
                              "ch. 4"}),
        true);
}

/// Grooves or a lattice. Their other fields are shown only for one of them.
Field kind_field(const Json& profile) {
    return {.pointer = "/grating",
            .label = "Pattern",
            .kind = FieldKind::Choice,
            .required = true,
            .choices = {{"grooves", {{"pitch_nm", 1600}, {"profile", profile}}}, {"lattice", new_lattice()}},
            .help =
                "grooves: of one direction. lattice: the surface repeats along two directions, as crossed foil and "
                "the pixels of a screen do. Another choice replaces the whole grating.",
            .source = "Goodman, Introduction to Fourier Optics, ch. 4"};
}

Field pitch_field() {
    return of_grooves(
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
         .source = "the grating equation; Lindsay & Agu 2006, eq. 1"});
}

std::vector<Field> other_fields() {
    return {
        of_grooves(
            {.pointer = "/grating/orders",
             .label = "Orders",
             .kind = FieldKind::Orders,
             .default_value = {-2, -1, 1, 2},
             .help =
                 "Orders that are shaded, or \"all\" that propagate for some visible wavelength. Without 0 the mirror "
                 "order goes to the reflection of the surroundings.",
             .source = "Lindsay & Agu 2006"}),
        of_grooves(
            {.pointer = "/grating/grooves",
             .label = "Lit grooves",
             .minimum = 50.0,
             .maximum = 10000.0,
             .logarithmic = true,
             .default_value = 1500,
             .help = "Number N of grooves that are lit together; at least 1. From 50 on an order is a sharp line.",
             .source = "Lindsay & Agu 2006, eq. 3 (N = 1500)"}),
        of_grooves(
            {.pointer = "/grating/normalization",
             .label = "Normalisation",
             .kind = FieldKind::Choice,
             .default_value = "energy",
             .choices = {{"energy", "energy"}, {"agu", "agu"}},
             .help =
                 "energy: each order carries its efficiency. agu: the paper's peak form, each order times λ/550 nm; "
                 "slits only.",
             .source = "Lindsay & Agu 2006, eq. 1–3"}),
        of_grooves({.pointer = "/grating/groove_lobe",
                    .label = "Lobe",
                    .kind = FieldKind::Choice,
                    .default_value = "flat",
                    .choices = {{"flat", "flat"},
                                {"gaussian", {{"sigma", 0.1}}},
                                {"pits", {{"pits", {{"length_nm", 850}, {"coherent", 0.3}}}}}},
                    .help = "How light spreads along the grooves. flat: evenly, as in the paper. gaussian: pressed "
                            "discs and foil, "
                            "thin streaks. pits: a compact disc's data.",
                    .source = "flat: Lindsay & Agu 2006; pits: Stam 1999, Diffraction shaders"}),
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
    std::vector<Field> all = groove_profile_fields();
    all.insert(all.begin(), {pitch_field(), kind_field(all.front().default_value)});
    for (auto part : {other_fields(), lattice_fields()}) std::move(part.begin(), part.end(), std::back_inserter(all));
    return all;
}

}  // namespace rowland::inspector
