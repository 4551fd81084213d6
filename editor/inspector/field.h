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
    Name,    ///< of a file in the material's folder
    Pair,    ///< two numbers
};

/// A value that a field is set to by name. An object holds the members that the choice starts with.
struct Choice {
    std::string name;
    Json value;  ///< null: the member is left out
};

/// One field of a material file: the editor's control, its range, its tooltip and its reset value. A pointer may have
/// several fields, of which a material shows one at most.
struct Field {
    std::string pointer;  ///< JSON pointer, as in the refusals of the module's parser
    std::string label;
    std::string unit{};  ///< empty: none
    FieldKind kind = FieldKind::Number;
    double minimum = 0.0;  ///< ends of the slider; only the parser decides what is allowed
    double maximum = 1.0;
    bool logarithmic = false;  ///< the slider
    Json default_value{};      ///< of an absent member
    /// Reverting sets `default_value` instead of removing the member; if that is null, there is no reverting.
    bool required = false;
    std::vector<Choice> choices{};
    /// The member whose value identifies a choice that is an object; empty: the names of its members identify it.
    std::string discriminator{};
    /// Shown only if the field `only_with` (a pointer) is, and its choice is one of `only_for`; empty: always.
    std::string only_with{};
    std::vector<std::string> only_for{};
    /// Values of an absent member that depend on the choice of `only_with`; others have `default_value`.
    std::vector<Choice> defaults_by_choice{};
    std::string help{};    ///< the effect and the allowed values
    std::string source{};  ///< of the formula
};

/// All fields of a material file, in the order they are shown.
std::span<const Field> fields();

/// The fields that only a scene's material has: its grooves on the mesh.
std::span<const Field> groove_fields();

/// The first field at a JSON pointer, which must exist.
const Field& field_at(std::string_view pointer);

/// Whether the field has a meaning for the material.
bool is_shown(const Field& field, const Json& material);

/// The material's field at a JSON pointer; null: none.
const Field* shown_field(std::string_view pointer, const Json& material);

/// The material's field that contains the JSON pointer of a refusal; the innermost of several, null if none does.
const Field* field_of_refusal(std::string_view pointer, const Json& material);

/// The field's value, or its default if the member is absent.
Json value_of(const Field& field, const Json& material);

/// Whether reverting would change the material.
bool can_revert(const Field& field, const Json& material);

/// Name of the present choice; empty if the value is none of them.
std::string choice_of(const Field& field, const Json& material);

// Edits return the changed material.

/// Sets a field; null removes the member. A new member is inserted where files usually have it.
Json with_value(const Json& material, const Field& field, const Json& value);
/// Sets the pitch. The width of a slit stays the same fraction of it.
Json with_pitch(const Json& material, double pitch_nm);
/// Makes another choice. Members that both choices have keep their values.
Json with_choice(const Json& material, const Field& field, const std::string& name);
/// Sets the field to its default.
Json reverted(const Json& material, const Field& field);

/// "-2 -1, 1 2" or "all" as the value of an Orders field; other text is returned unchanged, for the parser to refuse.
Json parse_orders(std::string_view text);
std::string format_orders(const Json& orders);

/// Converts between the pitch and lines per millimetre. A pitch is rounded to 0.001 nm, so that files stay readable.
double lines_per_mm(double pitch_nm);
double pitch_of_lines(double per_mm);

}  // namespace rowland::inspector
