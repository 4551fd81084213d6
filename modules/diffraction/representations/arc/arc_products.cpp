#include "modules/diffraction/representations/arc/arc_products.h"

#include <algorithm>

#include "engine/core/parallel.h"
#include "engine/math/sh_basis.h"
#include "modules/diffraction/bake/arc_moments.h"
#include "modules/diffraction/runtime/tangent_light.h"

namespace rowland::diffraction {

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

}  // namespace rowland::diffraction
