#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "engine/colour/illuminant.h"
#include "engine/lighting/sh_light.h"
#include "modules/diffraction/bake/kernel_cells.h"
#include "modules/diffraction/bake/packed_texels.h"
#include "modules/diffraction/bake/view_mapping.h"
#include "modules/diffraction/model/grating.h"
#include "modules/diffraction/representations/descriptor.h"
#include "modules/diffraction/representations/point_shader.h"

namespace rowland::diffraction {

/// The numbers that describe the light at a vertex, per RGB channel.
enum class LightTerms : std::uint8_t {
    ArcMoments = 0,  ///< 2n−1 moments of the arc profile (arc_moments.h); flat lobe in air
    Harmonics = 1,   ///< n² SH coefficients; any grating
};

/// The coefficients of TransferTerms as a product (the principal components that the paper suggests, PHYSICS §5):
/// c_k,o,c(v) ≈ Σ_r w_r(v) U_r,k,c,o; o: X, Y or Z, c: red, green or blue. The CPU computes p_r = Σ_k U_r,k q_k, in
/// XYZ, for each vertex from the light's numbers q; a pixel computes Σ_r w_r(v) p_r.
///
/// w: a 2D texture array of ⌈R/4⌉ layers over views; layer j holds w_4j … w_4j+3. With a pitch axis the texture's rows
/// are pitches instead of the views' second coordinate: t = (log(f/smallest)/log(largest/smallest)·(H−1) + ½)/H for the
/// factor f.
struct ArcTable : PackedTexels {
    int bands = 0;
    int rank = 0;
    LightTerms terms = LightTerms::ArcMoments;
    ViewGrid grid;                   ///< of views; rows = 1 beside a pitch axis
    std::optional<PitchAxis> pitch;  ///< one-dimensional grids only
    std::vector<glm::mat3> factors;  ///< [r·K + k], RGB in, XYZ out; K = light_term_count()

    int rows() const { return pitch ? pitch->nodes : grid.rows; }
};

/// K: 2n−1 or n².
int light_term_count(LightTerms terms, int bands);

/// Layers of the weights' texture: ⌈R/4⌉.
constexpr std::size_t weight_layers(int rank) {
    return (static_cast<std::size_t>(rank) + 3) / 4;
}

struct ArcSettings {
    int bands = 5;                   ///< n, 1 … 32
    int rank = 8;                    ///< R ≥ 1, limited to the full rank, which is exact
    std::optional<ViewGrid> grid{};  ///< none: default_view_grid()
    std::optional<PitchAxis> pitch{};
    Storage storage = Storage::Half;
    colour::Illuminant illuminant = colour::d65();

    static const RepresentationInfo& info();
    static std::optional<Refusal> refusal(const SettingValues& values, const Grating& grating);
    static ArcSettings from(const SettingValues& values, const Grating& grating);
};

/// Throws Error (input) for fewer than kManyGrooves grooves, a one-dimensional grid or a pitch axis for a lobe that is
/// not flat. The bytes do not depend on the number of threads.
ArcTable bake(const Grating& grating, const ArcSettings& settings);

/// The part of a vertex, for the CPU: the XYZ values p_r. `light_terms`: the K arc moments or SH coefficients of the
/// light in the tangent frame.
std::vector<glm::dvec3> light_products(const ArcTable& table, std::span<const glm::dvec3> light_terms);

/// The part of a pixel: XYZ = Σ_r w_r p_r; 0 for v_n ≤ 0. Only tables with a pitch axis use the pitch factor, clamped
/// to the axis's ends.
glm::dvec3 shade(const ArcTable& table, std::span<const glm::dvec3> products, const glm::dvec3& view,
                 double pitch_factor = 1.0);

/// light_products() and shade(). For many views of one light, call them with one ArcMoments.
glm::dvec3 evaluate(const ArcTable& table, const lighting::ShLight& tangent_light, const glm::dvec3& view,
                    double pitch_factor = 1.0);

void write(const ArcTable& table, ByteWriter& writer);
/// Throws Error (input) for invalid bytes.
ArcTable read_arc_table(ByteReader& reader);

/// Required by representation.h.
ArcTable read(ByteReader& reader, const ArcSettings& settings);
ShadingCost cost(const ArcTable& table);
Facts facts(const ArcTable& table);

}  // namespace rowland::diffraction
