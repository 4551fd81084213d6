#pragma once

#include <initializer_list>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "editor/inspector/field.h"

namespace rowland::inspector {

// Building blocks of the tables of fields.

inline Field plain(FieldKind kind, std::string pointer, std::string label, Json default_value, std::string help,
                   std::string source) {
    return {.pointer = std::move(pointer),
            .label = std::move(label),
            .kind = kind,
            .default_value = std::move(default_value),
            .help = std::move(help),
            .source = std::move(source)};
}

struct Range {
    double minimum = 0.0;
    double maximum = 1.0;
    const char* unit = "";
    bool logarithmic = false;
};
inline constexpr bool kLogarithmic = true;
inline constexpr Range kTurn{-std::numbers::pi, std::numbers::pi, "rad"};

inline Field slider(FieldKind kind, std::string pointer, std::string label, const Range& range, Json default_value,
                    std::string help, std::string source) {
    Field field =
        plain(kind, std::move(pointer), std::move(label), std::move(default_value), std::move(help), std::move(source));
    field.unit = range.unit;
    field.minimum = range.minimum;
    field.maximum = range.maximum;
    field.logarithmic = range.logarithmic;
    return field;
}

inline Field choice(std::string pointer, std::string label, Json default_value, std::vector<Choice> choices,
                    std::string help, std::string source) {
    Field field = plain(FieldKind::Choice, std::move(pointer), std::move(label), std::move(default_value),
                        std::move(help), std::move(source));
    field.choices = std::move(choices);
    return field;
}

inline Field required(Field field) {
    field.required = true;
    return field;
}

/// Restricts fields to one choice of the field at the pointer `other`.
inline std::vector<Field> shown_for(const std::string& other, const std::string& choice, std::vector<Field> fields) {
    for (Field& field : fields) {
        field.only_with = other;
        field.only_for = {choice};
    }
    return fields;
}

inline std::vector<Field> joined(std::initializer_list<std::vector<Field>> parts) {
    std::vector<Field> all;
    for (const std::vector<Field>& part : parts) all.insert(all.end(), part.begin(), part.end());
    return all;
}

/// The members of a glTF textureInfo.
inline std::vector<Field> texture_fields(const std::string& pointer, const char* source) {
    const std::string transform = pointer + "/extensions/KHR_texture_transform/";
    return {required(slider(FieldKind::Count, pointer + "/index", "Texture", {0.0, 1e9}, 0,
                            "Number of the texture in the file, from 0. Pictures that are not saved yet are numbered "
                            "from 1000000 on.",
                            source)),
            slider(FieldKind::Count, pointer + "/texCoord", "UV set", {}, 0,
                   "The set of texture coordinates of the mesh; 0 or 1.", "glTF 2.0, textureInfo"),
            slider(FieldKind::Pair, transform + "offset", "Offset", {-1.0, 1.0}, {0.0, 0.0},
                   "Offset of the texture on the mesh, in texture coordinates.", "KHR_texture_transform"),
            slider(FieldKind::Pair, transform + "scale", "Repeats", {0.0, 10.0}, {1.0, 1.0},
                   "Number of repetitions of the texture over one unit of u and of v.", "KHR_texture_transform"),
            slider(FieldKind::Number, transform + "rotation", "Rotation", kTurn, 0.0,
                   "Rotation of the texture about the origin of its coordinates.", "KHR_texture_transform")};
}

}  // namespace rowland::inspector
