#include "modules/diffraction/representations/arc/arc_turns.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "engine/scene/mesh.h"

namespace rowland::diffraction {

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
