#pragma once

#include <fmt/format.h>
#include <array>
#include <cstddef>
#include <glm/mat3x3.hpp>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "engine/core/byte_stream.h"

namespace rowland::diffraction {

/// Nodes of a segment.
inline constexpr int kSegmentNodes = 7;
/// Every pixel loops over all segments.
inline constexpr std::size_t kMostStreakSegments = 64;

/// Equidistant nodes over an interval of path differences: node j sees the light about s_g = x_j/d − v_g. Stored as it
/// is in memory.
struct StreakSegment {
    float first_nm = 0.0F;
    float step_nm = 0.0F;
    std::array<glm::mat3, kSegmentNodes> weights{};  ///< RGB in, XYZ out, per radiance that a node sees

    float path_nm(int node) const { return first_nm + static_cast<float>(node) * step_nm; }
};
static_assert(sizeof(StreakSegment) == 4 * (2 + 9 * kSegmentNodes) && std::is_trivially_copyable_v<StreakSegment>);

/// Whether all numbers are finite, and the step is 0 or more.
bool is_valid(const StreakSegment& segment);

/// Segments of any type that is_valid() takes. Throws Error (input) for an invalid one or more than
/// kMostStreakSegments.
template <typename Segment>
std::vector<Segment> read_segments(ByteReader& reader, const char* expected) {
    std::vector<Segment> segments = reader.array<Segment>();
    if (segments.size() > kMostStreakSegments)
        reader.fail(fmt::format("{} segments", segments.size()), fmt::format("at most {}", kMostStreakSegments));
    for (const Segment& segment : segments)
        if (!is_valid(segment)) reader.fail("a segment with an invalid number", expected);
    return segments;
}

/// Throws Error (input) if the number is not finite or not above 0.
double read_positive(ByteReader& reader, std::string_view name);

}  // namespace rowland::diffraction
