#include "engine/scene/animation.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "engine/core/check.h"
#include "engine/scene/mesh.h"
#include "engine/scene/transform.h"

namespace rowland::scene {

namespace {

/// The two keys around a time.
struct Span {
    std::size_t first = 0;
    std::size_t second = 0;
    double fraction = 0.0;  ///< of the time from the first to the second, in [0, 1]
    double seconds = 0.0;   ///< between them
};

Span find_span(const std::vector<float>& times, float time) {
    // A time that is not a number counts as the beginning.
    if (!(time > times.front())) return {};
    const std::size_t last = times.size() - 1;
    if (time >= times.back()) return {last, last, 0.0, 0.0};
    const auto after = std::upper_bound(times.begin(), times.end(), time);
    const auto second = static_cast<std::size_t>(after - times.begin());
    const double seconds = static_cast<double>(times[second]) - static_cast<double>(times[second - 1]);
    const double elapsed = static_cast<double>(time) - static_cast<double>(times[second - 1]);
    return {second - 1, second, elapsed / seconds, seconds};
}

/// Spherical interpolation of unit quaternions along the shorter arc (glTF 2.0, appendix C.4).
glm::dvec4 slerp(const glm::dvec4& a, glm::dvec4 b, double fraction) {
    double cosine = glm::dot(a, b);
    if (cosine < 0.0) {
        b = -b;
        cosine = -cosine;
    }
    // Below this angle arc and chord agree in double precision, and the quotient would be rounding errors.
    constexpr double kNearlyParallel = 1.0 - 1e-12;
    if (cosine > kNearlyParallel) return a + fraction * (b - a);
    const double angle = std::acos(cosine);
    return (std::sin((1.0 - fraction) * angle) * a + std::sin(fraction * angle) * b) / std::sin(angle);
}

/// glTF 2.0, appendix C.5. Keys are in-tangent, value, out-tangent.
glm::dvec4 cubic(const std::vector<glm::vec4>& values, const Span& span) {
    const double t = span.fraction;
    const double t2 = t * t;
    const double t3 = t2 * t;
    const auto at = [&](std::size_t index) { return glm::dvec4(values[index]); };
    return (2.0 * t3 - 3.0 * t2 + 1.0) * at(3 * span.first + 1) +
           span.seconds * (t3 - 2.0 * t2 + t) * at(3 * span.first + 2) +
           (3.0 * t2 - 2.0 * t3) * at(3 * span.second + 1) + span.seconds * (t3 - t2) * at(3 * span.second);
}

/// `q` of unit length; no rotation if it has no length.
glm::dvec4 unit(const glm::dvec4& q) {
    const double length = glm::length(q);
    return length > 0.0 && std::isfinite(length) ? q / length : glm::dvec4(0.0, 0.0, 0.0, 1.0);
}

glm::dvec4 interpolate(const AnimationChannel& channel, const Span& span) {
    if (channel.interpolation == Interpolation::CubicSpline) return cubic(channel.values, span);
    const glm::dvec4 first(channel.values[span.first]);
    if (channel.interpolation == Interpolation::Step) return first;
    const glm::dvec4 second(channel.values[span.second]);
    if (channel.property == AnimatedProperty::Rotation) return slerp(unit(first), unit(second), span.fraction);
    return (1.0 - span.fraction) * first + span.fraction * second;
}

}  // namespace

glm::vec4 sample(const AnimationChannel& channel, float time_s) {
    ROWLAND_CHECK_OP(channel.times_s.size(), >, 0U);
    ROWLAND_CHECK_OP(channel.values.size(), ==,
                     channel.times_s.size() * (channel.interpolation == Interpolation::CubicSpline ? 3 : 1));
    const glm::dvec4 value = interpolate(channel, find_span(channel.times_s, time_s));
    if (channel.property == AnimatedProperty::Rotation) return glm::vec4(unit(value));
    // A spline may leave the range of its keys, and of floats.
    constexpr double kLargest = std::numeric_limits<float>::max();
    return glm::vec4(glm::clamp(value, glm::dvec4(-kLargest), glm::dvec4(kLargest)));
}

void pose(const Animation& animation, float time_s, std::span<Transform> nodes) {
    for (const AnimationChannel& channel : animation.channels) {
        ROWLAND_CHECK_OP(channel.node, <, nodes.size());
        Transform& node = nodes[channel.node];
        const glm::vec4 value = sample(channel, time_s);
        switch (channel.property) {
            case AnimatedProperty::Translation:
                node.translation = glm::vec3(value);
                break;
            case AnimatedProperty::Rotation:
                node.rotation = glm::quat(value.w, value.x, value.y, value.z);
                break;
            case AnimatedProperty::Scale:
                node.scale = glm::vec3(value);
                break;
        }
    }
}

namespace {

/// The matrices of a vertex's joints, blended by its weights.
glm::mat4 blend(const glm::u16vec4& joints, const glm::vec4& weights, std::span<const glm::mat4> matrices) {
    glm::mat4 blended(0.0F);
    for (int i = 0; i < 4; ++i) {
        // The joint of an unused slot may have a matrix that overflows.
        if (weights[i] == 0.0F) continue;
        ROWLAND_CHECK_OP(joints[i], <, matrices.size());
        blended += weights[i] * matrices[joints[i]];
    }
    return blended;
}

}  // namespace

std::vector<glm::mat4> joint_matrices(ecs::World& world, const Skin& skin) {
    ROWLAND_CHECK_OP(skin.joints.size(), ==, skin.inverse_bind.size());
    std::vector<glm::mat4> matrices;
    matrices.reserve(skin.joints.size());
    for (std::size_t i = 0; i < skin.joints.size(); ++i) {
        const WorldMatrix* joint = world.find<WorldMatrix>(skin.joints[i]);
        matrices.push_back(joint ? joint->matrix * skin.inverse_bind[i] : skin.inverse_bind[i]);
    }
    return matrices;
}

Mesh posed(const Mesh& mesh, std::span<const glm::mat4> joints) {
    ROWLAND_CHECK_OP(mesh.joints.size(), ==, mesh.positions.size());
    ROWLAND_CHECK_OP(mesh.weights.size(), ==, mesh.positions.size());
    Mesh result = mesh;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        transform_vertex(result, i, blend(mesh.joints[i], mesh.weights[i], joints));
    return result;
}

}  // namespace rowland::scene
