#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "editor/inspector/ordered_json.h"

namespace rowland::inspector {

enum class FieldKind {
    Number,
    Count,   ///< a whole number
    Choice,  ///< one of `choices`
    Orders,  ///< a list of whole numbers, or "all"
    Colour,  ///< three numbers in [0, 1], linear
    Name,    ///< of a file beside the material
};

/// What a field may be set to by name. A choice that is an object brings the members it starts with.
struct Choice {
    std::string name;
    Json value;  ///< null: the member is left out
};

/// One field of a material file: this description drives the editor, its ranges, its tooltips and reverting.
struct Field {
    std::string pointer;  ///< JSON pointer; refusals of the module's parser name the same place
    std::string label;
    std::string unit{};  ///< empty: none
    FieldKind kind = FieldKind::Number;
    double minimum = 0.0;  ///< ends of the slider; the parser alone says what is allowed
    double maximum = 1.0;
    bool logarithmic = false;  ///< the slider
    Json usual{};              ///< what an absent member means, and what reverting a required one sets
    bool required = false;     ///< reverting sets `usual` in place of leaving the member out
    std::vector<Choice> choices{};
    /// Member that tells choices apart which are objects; empty: each has members of its own, or is no object.
    std::string told_by{};
    /// Shown only where the choice of another field is one of these; empty: always.
    std::string only_with{};  ///< that field's pointer
    std::vector<std::string> only_for{};
    std::string help{};    ///< what it does and what it may be
    std::string source{};  ///< of the formula
};

/// All fields of a material file, in the order they are shown.
std::span<const Field> fields();

/// The field at a JSON pointer. A contract violation if there is none.
const Field& field_at(std::string_view pointer);

/// The field that a refusal at `place` is about: the one whose pointer is the longest beginning of it; null if none.
const Field* field_of_refusal(std::string_view place);

/// Whether the field means something to the material.
bool is_shown(const Field& field, const Json& material);

/// The field's value, or what its absence means.
Json value_of(const Field& field, const Json& material);

/// Whether reverting would change the material.
bool can_revert(const Field& field, const Json& material);

/// Name of the present choice; empty if it is none of them.
std::string choice_of(const Field& field, const Json& material);

/// The material with a field set; null leaves the member out. New members go where files usually have them.
Json with_value(const Json& material, const Field& field, const Json& value);

/// The material with another pitch; a slit keeps its share of it.
Json with_pitch(const Json& material, double pitch_nm);

/// The material with another choice. Members that both choices have keep their values.
Json with_choice(const Json& material, const Field& field, const std::string& name);

/// The material with the field as it is when nobody has set it.
Json reverted(const Json& material, const Field& field);

/// "-2 -1, 1 2" or "all" as the value of an Orders field; other text as itself, for the parser to refuse.
Json parse_orders(std::string_view text);
std::string format_orders(const Json& orders);

/// Grooves a millimetre ↔ nanometres between two. A pitch comes out in whole picometres, so that files stay legible.
double lines_per_mm(double pitch_nm);
double pitch_of_lines(double per_mm);

}  // namespace rowland::inspector
