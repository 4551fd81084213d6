#include "editor/inspector/lattice_fields.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>

#include "editor/inspector/profile_fields.h"
#include "modules/diffraction/model/lattice.h"

namespace rowland::inspector {

namespace {

const char* const kSource = "Goodman, Introduction to Fourier Optics, ch. 4";

Json new_grooves() {
    return {{"type", "sinusoidal"}, {"depth_nm", 110}};
}

Json new_crossed() {
    return {{"type", "crossed"}, {"along_a", new_grooves()}, {"along_b", new_grooves()}};
}

Field of_lattice(Field field) {
    field.only_with = "/grating";
    field.only_for = {"lattice"};
    return field;
}

Field side_field(const std::string& side, const Json& initial) {
    return of_lattice({.pointer = "/grating/lattice/" + side + "_nm",
                       .label = "Side " + side,
                       .unit = "nm",
                       .kind = FieldKind::Pair,
                       .minimum = 300.0,
                       .maximum = 100000.0,
                       .logarithmic = true,
                       .default_value = initial,
                       .required = true,
                       .help = "One of the two sides of a cell, a and b, by its components along g and h. 300 to "
                               "10 000 000 nm long; at least 2° between a and b. The pixels of a telephone are 50 000 "
                               "nm wide.",
                       .source = "the grating equation in two dimensions; " + std::string(kSource)});
}

Field choice_field() {
    return of_lattice({.pointer = "/grating/profile",
                       .label = "Profile",
                       .kind = FieldKind::Choice,
                       .default_value = new_crossed(),
                       .required = true,
                       .choices = {{"crossed", new_crossed()},
                                   {"aperture", {{"type", "aperture"}, {"width_nm", 500}, {"height_nm", 500}}},
                                   {"height_map", {{"type", "height_map"}, {"file", ""}, {"depth_nm", 150}}}},
                       .discriminator = "type",
                       .help = "What a cell holds. crossed: two sets of grooves, whose heights add. aperture: one "
                               "opening, as in a screen. height_map: a picture of the heights.",
                       .source = kSource});
}

/// Grooves that cross one of the sides.
std::vector<Field> crossed_fields(const std::string& side) {
    return profile_fields({.pointer = "/grating/profile/along_" + side,
                           .label = "Along " + side,
                           .kind = FieldKind::Choice,
                           .default_value = new_grooves(),
                           .required = true,
                           .discriminator = "type",
                           .only_with = "/grating/profile",
                           .only_for = {"crossed"},
                           .help = "Shape of the grooves that follow one another along " + side +
                                   "; its length is their pitch. The fields below are theirs.",
                           .source = kSource},
                          false);
}

Field opening_field(const char* key, const char* label, const char* side) {
    return {.pointer = std::string("/grating/profile/") + key,
            .label = label,
            .unit = "nm",
            .minimum = 100.0,
            .maximum = 100000.0,
            .logarithmic = true,
            .default_value = 500,
            .required = true,
            .only_with = "/grating/profile",
            .only_for = {"aperture"},
            .help = std::string("Side of the opening along ") + side + "; above 0, at most the length of " + side + ".",
            .source = kSource};
}

std::vector<Field> height_map_fields() {
    return {{.pointer = "/grating/profile/file",
             .label = "Height map",
             .kind = FieldKind::Name,
             .default_value = "",
             .required = true,
             .only_with = "/grating/profile",
             .only_for = {"height_map"},
             .help = "A PNG of the heights of one cell beside the material, at most 256 × 256; more texels on each "
                     "side than twice the orders. White is raised by the full depth.",
             .source = kSource},
            {.pointer = "/grating/profile/depth_nm",
             .label = "Depth",
             .unit = "nm",
             .minimum = 20.0,
             .maximum = 1000.0,
             .default_value = 150,
             .required = true,
             .only_with = "/grating/profile",
             .only_for = {"height_map"},
             .help = "Height of white over black; above 0.",
             .source = kSource}};
}

Field orders_field() {
    return of_lattice({.pointer = "/grating/orders",
                       .label = "Orders",
                       .kind = FieldKind::Count,
                       .minimum = 1.0,
                       .maximum = diffraction::kHighestLatticeOrder,
                       .default_value = diffraction::Lattice().orders,
                       .help = "The highest order along each side: all (m, k) with |m| and |k| up to it are shaded, "
                               "but (0, 0).",
                       .source = kSource});
}

}  // namespace

Json new_lattice() {
    return {{"lattice", {{"a_nm", {1000, 0}}, {"b_nm", {0, 1000}}}}, {"profile", new_crossed()}};
}

std::vector<Field> lattice_fields() {
    std::vector<Field> all = {side_field("a", {1000, 0}), side_field("b", {0, 1000}), choice_field()};
    for (auto part :
         {crossed_fields("a"), crossed_fields("b"),
          std::vector<Field>{opening_field("width_nm", "Width", "a"), opening_field("height_nm", "Height", "b")},
          height_map_fields(), std::vector<Field>{orders_field()}})
        std::move(part.begin(), part.end(), std::back_inserter(all));
    return all;
}

}  // namespace rowland::inspector
