#include "tests/gpu/modules/diffraction/key_light_reference.h"

#include <map>
#include <tuple>

#include "modules/diffraction/representations/direct/lobe_table.h"

namespace rowland::diffraction {

namespace {

/// Kept by pitch and light, as it is slow to compute.
const LobeTable& lobe_table(const CookedMaterial& cooked, const lighting::KeyLight& key) {
    static std::map<std::tuple<double, double, double, double, double>, LobeTable> tables;
    const double pitch = cooked.material.grating.pitch_nm;
    const std::tuple name(pitch, key.concentration, key.flux.x, key.flux.y, key.flux.z);
    const auto found = tables.find(name);
    if (found != tables.end()) return found->second;
    return tables.emplace(name, make_lobe_table(smoothed(cooked), pitch, key, 4096)).first->second;
}

}  // namespace

DirectMaterial direct_material(const CookedMaterial& cooked) {
    return {.pitch_nm = cooked.material.grating.pitch_nm,
            .zero_order_xyz = cooked.zero_order_xyz,
            .lobe = cooked.material.grating.lobe};
}

const BlurredKernel& smoothed(const CookedMaterial& cooked) {
    static std::map<double, BlurredKernel> kernels;  // by the pitch: every grating here has its own
    const double pitch = cooked.material.grating.pitch_nm;
    const auto found = kernels.find(pitch);
    if (found != kernels.end()) return found->second;
    return kernels.emplace(pitch, blur(cooked.kernel, 0.2 * pitch, 4096)).first->second;
}

glm::dvec3 key_light_xyz(const CookedMaterial& cooked, const std::vector<lighting::KeyLight>& keys,
                         const Point& point) {
    const DirectMaterial material = direct_material(cooked);
    const BlurredKernel& kernel = smoothed(cooked);
    glm::dvec3 xyz(0.0);
    if (point.view.z <= 0.0) return xyz;
    const DirectView view{point.view.x, point.view.y, point.footprint};
    const bool tabled = cooked.zero_order_xyz == glm::dmat3(0.0);
    for (const lighting::KeyLight& key : keys)
        xyz += tabled ? lobe_radiance(lobe_table(cooked, key), material, key, point.to_tangent, view)
                      : direct_radiance(kernel, material, light_spot(key, point.to_tangent), view);
    return xyz;
}

}  // namespace rowland::diffraction
