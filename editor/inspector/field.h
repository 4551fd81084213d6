#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rowland::inspector {

/// JSON whose members keep the order of the file.
using Json = nlohmann::ordered_json;

/// Parses untrusted text. Throws Error (input) as parse_json() does.
Json parse_ordered(std::string_view text, const std::string& file);

/// Formats as in content/materials: indented by two spaces, one line per member of the outermost object; inner arrays
/// and objects on one line if that is at most 100 columns wide. Ends with a line break.
std::string format_json(const Json& value);

enum class FieldKind {
    Number,
    Count,   ///< a whole number
    Choice,  ///< one of `choices`
    Orders,  ///< a list of whole numbers, or "all"
    Colour,  ///< three numbers in [0, 1], linear
    Name,    ///< of a file in the material's folder
    Pair,    ///< two numbers
};

/// A named value of a field. An object holds the initial members of the choice.
struct Choice {
    std::string name;
    Json value;  ///< null: the member is left out
};

/// Whether a valid material object (of a file or a scene's extension) describes a film; false for a grating and null.
bool holds_film(const Json& material);

/// One field of a material file: label, range, tooltip and reset value of its control. Several fields may have the same
/// pointer; a material shows at most one of them.
struct Field {
    std::string pointer;  ///< JSON pointer, as in the refusals of the module's parser
    std::string label;
    std::string unit{};  ///< empty: none
    FieldKind kind = FieldKind::Number;
    double minimum = 0.0;  ///< ends of the slider; the parser decides which values are valid
    double maximum = 1.0;
    bool logarithmic = false;  ///< the slider
    Json default_value{};      ///< of an absent member
    /// Reverting sets `default_value` instead of removing the member; if that is null, the field cannot be reverted.
    bool required = false;
    std::vector<Choice> choices{};
    /// The member whose value identifies a choice that is an object; empty: the names of its members identify it.
    std::string discriminator{};
    std::string help{};    ///< the effect and the allowed values
    std::string source{};  ///< of the formula
    /// The field is shown if the field at the pointer `only_with` is shown and its choice is one of `only_for`. Empty:
    /// always.
    std::string only_with{};
    std::vector<std::string> only_for{};
    /// Of a choice: the member that replaces this one. Setting this member removes the alternative; removing this
    /// member sets the alternative to `alternative_value`, or leaves it alone if that is null.
    std::string alternative{};
    Json alternative_value{};
    /// Defaults by the choice of `only_with`; for other choices `default_value`.
    std::vector<Choice> defaults_by_choice{};
};

/// All fields of a grating's material file, in the order of display.
std::span<const Field> fields();
/// The additional fields of a scene's grating: its grooves on the mesh.
std::span<const Field> groove_fields();
/// All fields of a film's material file.
std::span<const Field> film_fields();
/// All fields of a scene's film, KHR_materials_iridescence.
std::span<const Field> iridescence_fields();

/// The lists of fields that a material may show.
std::vector<std::span<const Field>> fields_of(const Json& material);

/// The first field at a JSON pointer, which must exist; the fields of gratings come first.
const Field& field_at(std::string_view pointer);

/// Whether the field applies to the material.
bool is_shown(const Field& field, const Json& material);

/// The material's field at a JSON pointer; null: none.
const Field* shown_field(std::string_view pointer, const Json& material);

/// The material's field that contains the JSON pointer of a refusal; the innermost of several, null if none does.
const Field* field_of_refusal(std::string_view pointer, const Json& material);

/// The field's value, or its default if the member is absent.
Json value_of(const Field& field, const Json& material);

/// Whether reverting would change the material.
bool can_revert(const Field& field, const Json& material);

/// The name of the current choice; empty if the value matches none.
std::string choice_of(const Field& field, const Json& material);

// Edits return the changed material.

/// Sets a field; null removes the member. A new member is inserted in the order of other files.
Json with_value(const Json& material, const Field& field, const Json& value);
/// Sets the pitch and scales the width of a slit with it.
Json with_pitch(const Json& material, double pitch_nm);
/// Selects a choice, which must exist. Members that both choices have keep their values, except for "/grating".
Json with_choice(const Json& material, const Field& field, const std::string& name);
/// Sets the field to its default.
Json reverted(const Json& material, const Field& field);

/// 0 for a value that is no number, so that a control can replace it.
double number_of(const Json& value);
/// To 0.001, so that files stay readable.
double rounded(double value);

/// The number that a control shows for a number of the file, and the inverse: radians as degrees, others unchanged.
double shown_number(const Field& field, double stored);
double stored_number(const Field& field, double shown);
/// "°" for radians; other units unchanged.
std::string shown_unit(const Field& field);

/// "-2 -1, 1 2" or "all" as the value of an Orders field. Other text is returned unchanged, for the parser to refuse.
Json parse_orders(std::string_view text);
std::string format_orders(const Json& orders);

/// Converts between the pitch and lines per millimetre. A pitch is rounded to 0.001 nm, so that files stay readable.
double lines_per_mm(double pitch_nm);
double pitch_of_lines(double per_mm);

}  // namespace rowland::inspector
