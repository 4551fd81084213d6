#pragma once

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "engine/core/byte_stream.h"
#include "engine/core/error.h"
#include "tests/unit/modules/diffraction/reference/oracle.h"

namespace rowland::diffraction::test {

/// A frame as baked tables see it: light and view in the tangent frame.
struct TangentView {
    lighting::ShLight light;
    glm::dvec3 view{0.0};
};

inline std::vector<TangentView> tangent_views(const lighting::ShLight& light, std::span<const ShadingPoint> frames) {
    std::vector<TangentView> result;
    for (const ShadingPoint& frame : frames) {
        const glm::dmat3 tangent = world_to_tangent(frame);
        TangentView one{{light.bands, std::vector<glm::dvec3>(light.coefficients.size())},
                        tangent * glm::normalize(frame.view)};
        math::ShRotation(tangent, light.bands)
            .apply(std::span<const glm::dvec3>(light.coefficients), std::span<glm::dvec3>(one.light.coefficients));
        result.push_back(one);
    }
    return result;
}

/// XYZ of each by the table's evaluate().
template <typename Table>
std::vector<glm::dvec3> evaluated(const Table& table, std::span<const TangentView> views) {
    std::vector<glm::dvec3> result;
    for (const TangentView& one : views) result.push_back(evaluate(table, one.light, one.view));
    return result;
}

/// Bytes as `write` writes them.
template <typename Table>
std::vector<std::byte> written(const Table& table) {
    ByteWriter writer;
    write(table, writer);
    return writer.take();
}

/// The bytes of a table, and back: what is read writes the same bytes; every shortened copy is refused; and a
/// copy with a byte of its first 200 changed is refused or read, but never more than that.
template <typename Table, typename Read>
void expect_sound_bytes(const Table& table, const Read& read) {
    const std::vector<std::byte> bytes = written(table);
    ByteReader reader(bytes, "table");
    EXPECT_EQ(written(read(reader)), bytes);
    EXPECT_EQ(reader.remaining(), 0U);
    for (std::size_t size = 0; size < bytes.size(); size += size < 200 ? 1 : 211) {
        ByteReader shortened(std::span<const std::byte>(bytes).first(size), "table");
        EXPECT_THROW(read(shortened), Error) << size;
    }
    int refused = 0;
    const std::size_t changed = std::min<std::size_t>(bytes.size(), 200);
    for (std::size_t at = 0; at < changed; ++at)
        for (const int wild : {0x00, 0x7f, 0x80, 0xff}) {
            std::vector<std::byte> broken = bytes;
            broken[at] = static_cast<std::byte>(wild);
            ByteReader hostile(broken, "table");
            try {
                read(hostile);
            } catch (const Error&) {
                ++refused;
            }
        }
    EXPECT_GT(refused, 20);  // the sizes among them
}

}  // namespace rowland::diffraction::test
