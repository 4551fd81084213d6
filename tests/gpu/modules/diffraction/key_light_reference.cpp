#include "tests/gpu/modules/diffraction/key_light_reference.h"

#include "tests/gpu/modules/diffraction/filter_error.h"

namespace rowland::diffraction {

namespace {

/// Of the table that is drawn with, which has steps as large at most: blur_for_lights().
constexpr int kFewestColumns = 1024;

struct LobeReference {
    LobeTable table;
    LobeTable error;
};

/// Kept by pitch and light, as it is slow to compute.
const LobeReference& lobe_reference(const CookedMaterial& cooked, const lighting::KeyLight& key) {
    static std::map<std::tuple<double, int, double, double, double, double>, LobeReference> tables;
    const double pitch = cooked.material.grating.pitch_nm;
    const std::tuple name(pitch, cooked.kernel.views, key.concentration, key.flux.x, key.flux.y, key.flux.z);
    const auto found = tables.find(name);
    if (found != tables.end()) return found->second;
    const BlurredKernel& kernel = smoothed(cooked);
    return tables
        .emplace(name, LobeReference{.table = make_lobe_table(kernel, key, 4096),
                                     .error = filter_error(make_lobe_table(kernel, key, kFewestColumns))})
        .first->second;
}

bool has_tables(const CookedMaterial& cooked) {
    return cooked.zero_order_xyz == glm::dmat3(0.0);
}

}  // namespace

DirectMaterial direct_material(const CookedMaterial& cooked) {
    return {.pitch_nm = cooked.material.grating.pitch_nm,
            .zero_order_xyz = cooked.zero_order_xyz,
            .lobe = cooked.material.grating.lobe,
            .cover = cooked.material.grating.cover};
}

const BlurredKernel& smoothed(const CookedMaterial& cooked) {
    // By the pitch: every grating here has its own, and of one view another.
    static std::map<std::pair<double, int>, BlurredKernel> kernels;
    const double pitch = cooked.material.grating.pitch_nm;
    const std::pair name(pitch, cooked.kernel.views);
    const auto found = kernels.find(name);
    if (found != kernels.end()) return found->second;
    return kernels.emplace(name, blur(cooked.kernel, pitch, 0.2 * pitch, 4096)).first->second;
}

glm::dvec3 key_light_xyz(const CookedMaterial& cooked, const std::vector<lighting::KeyLight>& keys,
                         const Point& point) {
    const DirectMaterial material = direct_material(cooked);
    glm::dvec3 xyz(0.0);
    if (point.view.z <= 0.0) return xyz;
    for (const lighting::KeyLight& key : keys) {
        const DirectView view{point.view.x, point.view.y, footprint(point, key.direction)};
        xyz += has_tables(cooked)
                   ? lobe_radiance(lobe_reference(cooked, key).table, material, key, point.to_tangent, view)
                   : direct_radiance(smoothed(cooked), material, light_spot(key, point.to_tangent), view);
    }
    return xyz;
}

glm::dvec3 order_zero_xyz(const CookedMaterial& cooked, const std::vector<lighting::KeyLight>& keys,
                          const Point& point) {
    constexpr int kSlices = 1000;
    glm::dvec3 xyz(0.0);
    for (const lighting::KeyLight& key : keys) {
        const LightSpot spot = light_spot(key, point.to_tangent);
        const double pixel = footprint(point, key.direction);
        double density = 0.0;
        for (const LobeSlice& slice : lobe_slices(LobeCosine(spot.axis, spot.concentration), kSlices)) {
            const double deviation = std::hypot(0.5 * (slice.end_g - slice.begin_g), pixel) / std::sqrt(3.0);
            const double z = (0.5 * (slice.begin_g + slice.end_g) + point.view.x) / deviation;
            density += slice.cosine * std::exp(-0.5 * z * z) / (deviation * std::sqrt(2.0 * std::numbers::pi));
        }
        xyz += 0.5 * transmittance(cooked.material.grating.cover, spot) * density * (cooked.zero_order_xyz * key.flux);
    }
    return xyz;
}

glm::dvec3 key_light_error(const CookedMaterial& cooked, const std::vector<lighting::KeyLight>& keys,
                           const Point& point) {
    glm::dvec3 xyz(0.0);
    if (point.view.z <= 0.0 || !has_tables(cooked)) return xyz;
    for (const lighting::KeyLight& key : keys)
        xyz += lobe_radiance(lobe_reference(cooked, key).error, direct_material(cooked), key, point.to_tangent,
                             {point.view.x, point.view.y, footprint(point, key.direction)});
    return xyz;
}

}  // namespace rowland::diffraction
