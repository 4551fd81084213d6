#include "modules/diffraction/reference/reference.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <optional>

#include "engine/core/log.h"
#include "engine/core/parallel.h"
#include "modules/diffraction/model/grating.h"

namespace rowland::diffraction {

namespace {

/// The spectra and all orders' efficiencies at one whole nanometre.
struct LatticeNode {
    double wavelength_nm = 0.0;
    glm::dmat3 observed{0.0};        ///< cmf Eᵀ per nm
    std::vector<double> efficiency;  ///< of lattice_order_efficiencies()
};

std::vector<LatticeNode> nodes_of(const Grating& grating, const colour::LightSpectra& spectra) {
    std::vector<LatticeNode> nodes(colour::kVisibleMax - colour::kVisibleMin + 1);
    parallel_for(nodes.size(), [&](std::size_t i) {
        const double wavelength_nm = colour::kVisibleMin + static_cast<double>(i);
        nodes[i] = {.wavelength_nm = wavelength_nm,
                    .observed = observed_spectra(spectra, wavelength_nm),
                    .efficiency = lattice_order_efficiencies(grating, wavelength_nm)};
    });
    return nodes;
}

/// One view of the lattice.
class LatticeView {
 public:
    LatticeView(const Grating& grating, const IncidentLight& light, const ShadingPoint& frame, int refinement)
        : light_(light),
          cover_(grating.cover),
          from_behind_(grating.transmission.has_value()),
          tangent_(world_to_tangent(frame)),
          refinement_(refinement) {
        v_ = tangent_ * glm::normalize(frame.view);
    }

    glm::dvec3 radiance(const Lattice& lattice, const std::vector<LatticeNode>& nodes) const {
        if (v_.z <= 0.0) return glm::dvec3(0.0);
        const glm::dmat2 stars = reciprocal(lattice);
        const int columns = order_columns(lattice);
        glm::dvec3 xyz(0.0);
        for (std::size_t order = 0; order < nodes.front().efficiency.size(); ++order) {
            const int index = static_cast<int>(order);
            const glm::dvec2 u = stars * glm::dvec2(index % columns - lattice.orders, index / columns - lattice.orders);
            if (u != glm::dvec2(0.0)) xyz += order_radiance(u, order, nodes);
        }
        return transmittance(cover_, v_.z) * xyz;
    }

 private:
    /// The trapezoid rule between every two nanometres, in more steps where the direction turns by more than a panel,
    /// as it does at the horizon.
    glm::dvec3 order_radiance(const glm::dvec2& u, std::size_t order, const std::vector<LatticeNode>& nodes) const {
        glm::dvec3 xyz(0.0);
        for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
            const LatticeNode& low = nodes[i];
            const LatticeNode& high = nodes[i + 1];
            const glm::dvec3 begin = direction(low.wavelength_nm * u);
            const glm::dvec3 end = direction(high.wavelength_nm * u);
            const bool dark = low.efficiency[order] == 0.0 && high.efficiency[order] == 0.0;
            if (dark || (begin.z <= 0.0 && end.z <= 0.0)) continue;
            const int steps =
                refinement_ * std::max(1, static_cast<int>(std::ceil(glm::length(end - begin) / light_.panel_angle)));
            for (int step = 0; step <= steps; ++step) {
                const double t = static_cast<double>(step) / steps;
                const glm::dvec3 s = direction((low.wavelength_nm + t) * u);
                if (s.z <= 0.0) continue;
                const glm::dmat3 weight =
                    (1.0 - t) * low.efficiency[order] * low.observed + t * high.efficiency[order] * high.observed;
                const double width = (step == 0 || step == steps ? 0.5 : 1.0) / steps;
                xyz += width * transmittance(cover_, s.z) * (weight * incident(s));
            }
        }
        return xyz;
    }

    /// Radiance from `s` or, through a sheet, from its mirror image behind the surface, PHYSICS (12.3).
    glm::dvec3 incident(const glm::dvec3& s) const {
        return light_.radiance(glm::dvec3(s.x, s.y, from_behind_ ? -s.z : s.z) * tangent_);
    }

    /// Toward the light, z = 0 if it is below the horizon.
    glm::dvec3 direction(const glm::dvec2& u) const {
        const glm::dvec2 s_p = u - glm::dvec2(v_);
        return {s_p, std::sqrt(std::max(0.0, 1.0 - glm::dot(s_p, s_p)))};
    }

    const IncidentLight& light_;
    const std::optional<Cover>& cover_;
    bool from_behind_;
    glm::dmat3 tangent_;
    glm::dvec3 v_{0.0};
    int refinement_;
};

}  // namespace

std::vector<glm::dvec3> lattice_radiance(const Grating& grating, const IncidentLight& light,
                                         const colour::LightSpectra& spectra, std::span<const ShadingPoint> points,
                                         int refinement) {
    const std::vector<LatticeNode> nodes = nodes_of(grating, spectra);
    std::vector<glm::dvec3> result(points.size());
    Progress progress(refinement == 1 ? "reference" : "reference, finer", points.size());
    parallel_for(points.size(), [&](std::size_t i) {
        result[i] = LatticeView(grating, light, points[i], refinement).radiance(*grating.lattice, nodes);
        progress.advance();
    });
    return result;
}

}  // namespace rowland::diffraction
