#include "modules/diffraction/runtime/vertex_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_inverse.hpp>
#include <numbers>
#include <optional>
#include <span>

#include "engine/core/check.h"
#include "engine/core/parallel.h"
#include "engine/math/frame_rotation.h"
#include "engine/math/spherical_harmonics.h"
#include "engine/scene/mesh.h"
#include "modules/diffraction/bake/arc_moments.h"

namespace rowland::diffraction {

namespace {

/// Tangents and normals, one array per component.
struct SplitFrames {
    std::array<std::vector<float>, 3> tangent;
    std::array<std::vector<float>, 3> normal;

    explicit SplitFrames(std::size_t count) {
        for (auto& axis : tangent) axis.resize(count);
        for (auto& axis : normal) axis.resize(count);
    }
    void set(std::size_t i, const glm::vec3& g, const glm::vec3& n) {
        for (int axis = 0; axis < 3; ++axis) {
            tangent[static_cast<std::size_t>(axis)][i] = g[axis];
            normal[static_cast<std::size_t>(axis)][i] = n[axis];
        }
    }
    math::FrameArrays arrays() const {
        return {.tangent = {tangent[0], tangent[1], tangent[2]}, .normal = {normal[0], normal[1], normal[2]}};
    }
};

/// Rotates tangents about normals; leaves them unchanged for an angle of 0.
class GrooveRotation {
 public:
    /// `mirroring`: sign of the determinant of the frames' transform.
    GrooveRotation(double radians, double mirroring)
        : cosine_(static_cast<float>(std::cos(radians))),
          sine_(static_cast<float>(std::sin(radians) * (mirroring < 0.0 ? -1.0 : 1.0))),
          rotates_(radians != 0.0) {}

    glm::vec3 operator()(const glm::vec3& tangent, const glm::vec3& normal, float bitangent_sign) const {
        if (!rotates_) return tangent;
        const glm::vec3 n = glm::normalize(normal);
        const glm::vec3 g = glm::normalize(tangent - n * glm::dot(n, tangent));
        return cosine_ * g + sine_ * bitangent_sign * glm::cross(n, g);
    }

 private:
    float cosine_;
    float sine_;
    bool rotates_;
};

/// The object's rotation, if its matrix is a rotation times a scale; nullopt for a stretched, sheared or mirrored
/// object.
std::optional<glm::dmat3> rigid_rotation(const glm::dmat3& linear) {
    const double scale = std::cbrt(glm::determinant(linear));
    if (!(scale > 0.0)) return std::nullopt;
    const glm::dmat3 rotation = linear / scale;
    const glm::dmat3 product = glm::transpose(rotation) * rotation;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            // A product of float rotations is a rotation to a few roundings.
            if (std::abs(product[i][j] - (i == j ? 1.0 : 0.0)) > 1e-6) return std::nullopt;
    const glm::dvec3 x = glm::normalize(rotation[0]);
    const glm::dvec3 z = glm::normalize(glm::cross(x, rotation[1]));
    return glm::dmat3(x, glm::cross(z, x), z);
}

std::vector<glm::dvec3> in_object_frame(const lighting::ShLight& light, const glm::dmat3& rotation) {
    std::vector<glm::dvec3> rotated(light.coefficients.size());
    math::ShRotation(glm::transpose(rotation), light.bands)
        .apply(std::span<const glm::dvec3>(light.coefficients), rotated);
    return rotated;
}

/// The mesh's frames in the object's axes.
SplitFrames object_frames(const scene::Mesh& mesh, double groove_rotation) {
    SplitFrames frames(mesh.normals.size());
    const GrooveRotation rotation(groove_rotation, 1.0);
    for (std::size_t i = 0; i < mesh.normals.size(); ++i)
        frames.set(i, rotation(glm::vec3(mesh.tangents[i]), mesh.normals[i], mesh.tangents[i].w), mesh.normals[i]);
    return frames;
}

/// The matrix over its largest entry, so that transformed vectors stay in the range of floats.
glm::dmat3 of_moderate_size(const glm::dmat3& matrix) {
    double largest = 0.0;
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row) largest = std::max(largest, std::abs(matrix[column][row]));
    return matrix / largest;
}

/// The mesh's frames in world axes. They may have any length and be skewed, as FrameArrays allow.
SplitFrames world_frames(const scene::Mesh& mesh, const glm::dmat3& linear, double groove_rotation) {
    SplitFrames frames(mesh.normals.size());
    const GrooveRotation rotation(groove_rotation, glm::determinant(linear));
    const glm::mat3 for_tangents(of_moderate_size(linear));
    const glm::mat3 for_normals(of_moderate_size(glm::inverseTranspose(linear)));
    for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
        const glm::vec3 n = for_normals * mesh.normals[i];
        frames.set(i, rotation(for_tangents * glm::vec3(mesh.tangents[i]), n, mesh.tangents[i].w), n);
    }
    return frames;
}

/// Calls use(coefficients, frames) with the light and the vertices' frames in the same axes, object or world.
template <typename Use>
void in_vertex_frames(const lighting::ShLight& light, const scene::Mesh& mesh, const glm::mat4& object_to_world,
                      double groove_rotation, const Use& use) {
    const glm::dmat3 linear(object_to_world);
    if (const auto rotation = rigid_rotation(linear))
        use(in_object_frame(light, *rotation), object_frames(mesh, groove_rotation).arrays());
    else
        use(light.coefficients, world_frames(mesh, linear, groove_rotation).arrays());
}

}  // namespace

glm::dmat3 tangent_frame(const glm::vec3& normal, const glm::vec3& tangent, const glm::mat4& object_to_world) {
    const glm::dmat3 linear(object_to_world);
    const glm::dvec3 n = glm::normalize(glm::inverseTranspose(linear) * glm::dvec3(normal));
    const glm::dvec3 along = linear * glm::dvec3(tangent);
    const glm::dvec3 g = glm::normalize(along - n * glm::dot(n, along));
    return glm::transpose(glm::dmat3(g, glm::cross(n, g), n));
}

glm::dmat3 tangent_frame(const glm::vec3& normal, const glm::vec4& tangent, const glm::mat4& object_to_world,
                         double groove_rotation) {
    const glm::dmat3 axes = glm::transpose(tangent_frame(normal, glm::vec3(tangent), object_to_world));
    const double sign = (glm::determinant(glm::dmat3(object_to_world)) < 0.0 ? -1.0 : 1.0) * double{tangent.w};
    const glm::dvec3 g = std::cos(groove_rotation) * axes[0] + sign * std::sin(groove_rotation) * axes[1];
    return glm::transpose(glm::dmat3(g, glm::cross(axes[2], g), axes[2]));
}

std::vector<float> rotate_to_vertices(const lighting::ShLight& light, const scene::Mesh& mesh,
                                      const glm::mat4& object_to_world, double groove_rotation) {
    std::vector<float> result(mesh.normals.size() * light.coefficients.size() * 3);
    in_vertex_frames(light, mesh, object_to_world, groove_rotation,
                     [&](std::span<const glm::dvec3> coefficients, const math::FrameArrays& frames) {
                         math::rotate_to_frames(coefficients, light.bands, frames, result);
                     });
    return result;
}

std::vector<float> project_to_vertices(const lighting::ShLight& light, const math::FrameProjection& projection,
                                       const scene::Mesh& mesh, const glm::mat4& object_to_world,
                                       double groove_rotation) {
    ROWLAND_CHECK_OP(light.bands, ==, projection.bands());
    std::vector<float> result(mesh.normals.size() * static_cast<std::size_t>(projection.rows()) * 3);
    in_vertex_frames(light, mesh, object_to_world, groove_rotation,
                     [&](std::span<const glm::dvec3> coefficients, const math::FrameArrays& frames) {
                         math::rotate_and_project(coefficients, frames, projection, result);
                     });
    return result;
}

std::optional<glm::dvec3> flat_normal(const scene::Mesh& mesh) {
    glm::dvec3 sum(0.0);
    for (const glm::vec3& normal : mesh.normals) sum += glm::dvec3(normal);
    const double length = glm::length(sum);
    if (!(length > 0.5 * static_cast<double>(mesh.normals.size()))) return std::nullopt;
    const glm::dvec3 mean = sum / length;
    for (const glm::vec3& normal : mesh.normals)
        if (glm::length(glm::cross(mean, glm::dvec3(normal))) > kFlatness || glm::dot(mean, glm::dvec3(normal)) < 0.0)
            return std::nullopt;
    return mean;
}

std::optional<glm::vec4> common_tangent(const scene::Mesh& mesh) {
    if (mesh.tangents.empty()) return std::nullopt;
    const glm::vec4& first = mesh.tangents[0];
    const bool agree = std::all_of(mesh.tangents.begin(), mesh.tangents.end(), [&](const glm::vec4& tangent) {
        return tangent.w == first.w &&
               glm::distance(glm::vec3(tangent), glm::vec3(first)) < static_cast<float>(kFlatness);
    });
    return agree ? std::optional(first) : std::nullopt;
}

GrooveLayout groove_layout(const scene::Mesh& mesh, bool skinned, bool has_groove_texture) {
    if (skinned || !flat_normal(mesh)) return GrooveLayout::Curved;
    return !has_groove_texture && common_tangent(mesh) ? GrooveLayout::FlatUniform : GrooveLayout::Flat;
}

const RepresentationInfo& drawn_info(const BakedTables& tables, GrooveLayout layout) {
    const RepresentationInfo& own = info(tables);
    return own.needs_flat_surface && layout == GrooveLayout::Curved ? ArcSettings::info() : own;
}

namespace {

constexpr std::size_t kVerticesAtOnce = 256;

math::FrameProjection projection_of(const ArcTable& table) {
    if (table.terms == LightTerms::ArcMoments)
        return math::FrameProjection(ArcMoments(table.bands).matrix(), table.bands);
    const auto count = static_cast<std::size_t>(math::sh_count(table.bands));
    std::vector<double> identity(count * count, 0.0);
    for (std::size_t i = 0; i < count; ++i) identity[i * count + i] = 1.0;
    return math::FrameProjection(identity, table.bands);
}

std::vector<glm::vec4> factors_of(const ArcTable& table, const glm::dmat3& xyz_to_space) {
    const auto terms = static_cast<std::size_t>(light_term_count(table.terms, table.bands));
    const std::size_t vectors = 3 * weight_layers(table.rank);
    std::vector<glm::vec4> factors(terms * 3 * vectors, glm::vec4(0.0F));
    for (std::size_t r = 0; r < static_cast<std::size_t>(table.rank); ++r)
        for (std::size_t k = 0; k < terms; ++k) {
            const glm::mat3 factor(xyz_to_space * glm::dmat3(table.factors[r * terms + k]));
            for (int c = 0; c < 3; ++c)
                for (int o = 0; o < 3; ++o)
                    factors[(k * 3 + static_cast<std::size_t>(c)) * vectors + r / 4 * 3 + static_cast<std::size_t>(o)]
                           [static_cast<int>(r % 4)] = factor[c][o];
        }
    return factors;
}

}  // namespace

ArcProducts::ArcProducts(const ArcTable& table, const glm::dmat3& xyz_to_space)
    : layers_(static_cast<int>(weight_layers(table.rank))),
      projection_(projection_of(table)),
      factors_(factors_of(table, xyz_to_space)) {}

std::vector<glm::vec4> ArcProducts::operator()(const lighting::ShLight& light, const scene::Mesh& mesh,
                                               const glm::mat4& object_to_world, double groove_rotation) const {
    const std::vector<float> terms = project_to_vertices(light, projection_, mesh, object_to_world, groove_rotation);
    const std::size_t vertices = mesh.normals.size();
    const std::size_t inputs = 3 * static_cast<std::size_t>(projection_.rows());
    const std::size_t vectors = 3 * static_cast<std::size_t>(layers_);
    std::vector<glm::vec4> products(vertices * vectors, glm::vec4(0.0F));
    parallel_for((vertices + kVerticesAtOnce - 1) / kVerticesAtOnce, [&](std::size_t block) {
        const std::size_t end = std::min(vertices, (block + 1) * kVerticesAtOnce);
        for (std::size_t vertex = block * kVerticesAtOnce; vertex < end; ++vertex) {
            glm::vec4* to = products.data() + vertex * vectors;
            for (std::size_t i = 0; i < inputs; ++i) {
                const float term = terms[vertex * inputs + i];
                const glm::vec4* factor = factors_.data() + i * vectors;
                for (std::size_t j = 0; j < vectors; ++j) to[j] += term * factor[j];
            }
        }
    });
    return products;
}

ArcTurns arc_turns(const ArcProducts& products, const lighting::ShLight& light, const glm::dvec3& normal) {
    ArcTurns turns;
    const glm::dvec3 aside = std::abs(normal.x) < 0.7 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
    turns.e1 = glm::normalize(glm::cross(aside, normal));
    turns.e2 = glm::cross(normal, turns.e1);
    // The series is determined by as many azimuths as it has terms.
    const std::size_t count = 2 * static_cast<std::size_t>(products.bands()) - 1;
    const auto azimuth = [&](std::size_t j) {
        return 2.0 * std::numbers::pi * static_cast<double>(j) / static_cast<double>(count);
    };
    scene::Mesh frames;
    for (std::size_t j = 0; j < count; ++j) {
        frames.normals.emplace_back(normal);
        frames.tangents.emplace_back(glm::vec3(std::cos(azimuth(j)) * turns.e1 + std::sin(azimuth(j)) * turns.e2),
                                     1.0F);
    }
    const std::vector<glm::vec4> around = products(light, frames, glm::mat4(1.0F), 0.0);
    const std::size_t vectors = around.size() / count;
    turns.terms.assign(around.size(), glm::vec4(0.0F));
    for (std::size_t term = 0; term < count; ++term) {
        const std::size_t multiple = (term + 1) / 2;
        for (std::size_t j = 0; j < count; ++j) {
            const double angle = static_cast<double>(multiple) * azimuth(j);
            const double wave = term % 2 == 1 ? std::cos(angle) : term == 0 ? 0.5 : std::sin(angle);
            const auto weight = static_cast<float>(2.0 / static_cast<double>(count) * wave);
            for (std::size_t i = 0; i < vectors; ++i)
                turns.terms[term * vectors + i] += weight * around[j * vectors + i];
        }
    }
    return turns;
}

}  // namespace rowland::diffraction
