#include "modules/thin_film/evaluate/drawn_film.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/lighting/environment_map.h"
#include "engine/lighting/lobe_nodes.h"

namespace rowland::thin_film {

glm::dvec3 drawn_radiance(const FilmTable& table, double thickness_nm, double roughness,
                          const lighting::EnvironmentMap& environment, const glm::dvec3& n, const glm::dvec3& v,
                          Reflections reflections) {
    const double n_v = glm::dot(n, v);
    glm::dvec3 sum(0.0);
    if (reflections == Reflections::OneLookUp) {
        sum = table.at(n_v, thickness_nm, roughness) *
              lighting::environment_light(environment, lighting::lobe_direction(n, v, roughness), roughness);
    } else {
        const glm::dvec3 mirrored = glm::reflect(-v, n);
        const double first_rough = 1.0 / std::max(environment.layout.levels - 1, 1);
        for (const lighting::LobeNode& node : lighting::lobe_node_table().at(n_v, roughness))
            sum +=
                node.weight * (table.at(node.cosine, thickness_nm, 0.0) *
                               lighting::environment_light(environment, glm::mix(mirrored, n, node.lean),
                                                           std::max(node.roughness, std::min(roughness, first_rough))));
    }
    return lighting::lobe_albedo(n_v, roughness) * sum;
}

}  // namespace rowland::thin_film
