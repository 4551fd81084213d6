#pragma once

#include <cstddef>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

namespace rowland::diffraction {

inline constexpr const char* kPortableFormat = "rowland-diffraction";
inline constexpr int kPortableVersion = 1;

/// Numbers for programs in any language: JSON, and the bytes that its arrays lie in. FORMAT.md states both.
struct PortableDocument {
    nlohmann::json json;
    std::vector<std::byte> bytes;  ///< little-endian floats
};

/// An array beneath `json`, appended to the bytes. `shape`: lengths, outermost first; their product is the values'.
nlohmann::json append_array(std::span<const float> values, std::span<const std::size_t> shape,
                            std::vector<std::byte>& bytes);

/// Row by row.
nlohmann::json to_json(const glm::dmat3& matrix);
nlohmann::json to_json(const glm::dvec3& vector);

/// The nine numbers of each matrix, row by row: for arrays whose last two lengths are 3, 3.
std::vector<float> rows_of(std::span<const glm::mat3> matrices);

/// A document without contents, whose bytes will lie in the file `uri` beside it.
PortableDocument make_portable(const std::string& uri);

}  // namespace rowland::diffraction
