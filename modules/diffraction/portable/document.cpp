#include "modules/diffraction/portable/document.h"

#include <bit>
#include <glm/matrix.hpp>

#include "engine/colour/working_space.h"
#include "engine/core/check.h"

namespace rowland::diffraction {

static_assert(std::endian::native == std::endian::little, "arrays are written as they lie in memory");

nlohmann::json append_array(std::span<const float> values, std::span<const std::size_t> shape,
                            std::vector<std::byte>& bytes) {
    std::size_t count = 1;
    for (const std::size_t length : shape) count *= length;
    ROWLAND_CHECK_OP(count, ==, values.size());
    const std::size_t offset = bytes.size();
    const auto begin = std::as_bytes(values);
    bytes.insert(bytes.end(), begin.begin(), begin.end());
    return {{"offset", offset}, {"shape", std::vector<std::size_t>(shape.begin(), shape.end())}, {"type", "float32"}};
}

nlohmann::json to_json(const glm::dmat3& matrix) {
    nlohmann::json rows = nlohmann::json::array();
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column) rows.push_back(matrix[column][row]);
    return rows;
}

nlohmann::json to_json(const glm::dvec3& vector) {
    return {vector.x, vector.y, vector.z};
}

std::vector<float> rows_of(std::span<const glm::mat3> matrices) {
    std::vector<float> numbers;
    numbers.reserve(9 * matrices.size());
    for (const glm::mat3& matrix : matrices)
        for (int row = 0; row < 3; ++row)
            for (int column = 0; column < 3; ++column) numbers.push_back(matrix[column][row]);
    return numbers;
}

PortableDocument make_portable(const std::string& uri) {
    return {.json = {{"format", kPortableFormat},
                     {"version", kPortableVersion},
                     {"bytes", {{"uri", uri}}},
                     {"xyz_to_linear_srgb", to_json(glm::inverse(colour::rec709_to_xyz()))}},
            .bytes = {}};
}

}  // namespace rowland::diffraction
