#pragma once

#include "engine/core/byte_stream.h"
#include "modules/diffraction/bake/packed_texels.h"
#include "modules/diffraction/bake/view_mapping.h"
#include "modules/diffraction/model/grating.h"
#include "modules/diffraction/representations/descriptor.h"
#include "modules/diffraction/representations/point_shader.h"
#include "modules/diffraction/representations/spikes/spikes.h"

namespace rowland::diffraction {

/// Spikes tabulated over the views of the upper hemisphere, laid out as a 2D texture array (the paper's step 4 and 5).
///
/// Layer k·L + j (L = layers_per_spike) holds entries 4j..4j+3 of spike k's list [c_0 … c_{n²−1}, (λ_k − 380)/400, 0
/// …]. The grid is that of ViewGrid: phi_nodes columns and theta_nodes rows, for every mapping.
struct SpikeTable : PackedTexels {
    int bands = 0;
    int spikes = 0;
    int theta_nodes = 0;
    int phi_nodes = 0;
    int layers_per_spike = 0;
    ViewMapping mapping = ViewMapping::Spherical;

    int layers() const { return spikes * layers_per_spike; }
    ViewGrid grid() const { return {.mapping = mapping, .columns = phi_nodes, .rows = theta_nodes}; }
};

struct SpikeTableSettings {
    SpikeSettings spikes;
    int theta_nodes = 32;  ///< rows ≥ 2; one-dimensional: 1
    int phi_nodes = 64;    ///< columns; spherical: ≥ 1, else ≥ 2
    Storage storage = Storage::Unorm16;
    ViewMapping mapping = ViewMapping::Spherical;  ///< one-dimensional: flat lobe only

    static const RepresentationInfo& info();
    static std::optional<Refusal> refusal(const SettingValues& values, const Grating& grating);
    static SpikeTableSettings from(const SettingValues& values, const Grating& grating);
    void set_illuminant(const colour::Illuminant& white) { spikes.illuminant = white; }
};

/// Layers per spike: ⌈(bands²+1)/4⌉.
constexpr int spike_layers(int bands) {
    return (bands * bands + 1 + 3) / 4;
}

/// Bakes the spikes of every node. Throws Error (input) for a one-dimensional mapping of a lobe that is not flat. The
/// bytes do not depend on the number of threads.
SpikeTable bake(const Grating& grating, const SpikeTableSettings& settings);

/// The spikes of the tangent-frame view (v_g, v_h, v_n), as GL_LINEAR filters at the coordinates of view_mapping.h.
/// Coefficients are 0 for a view below the horizon (v_n ≤ 0).
SpikeSet sample(const SpikeTable& table, double v_g, double v_h, double v_n);

/// XYZ of the tangent-frame view: evaluate_spikes() of sample().
inline glm::dvec3 evaluate(const SpikeTable& table, const lighting::ShLight& tangent_light, const glm::dvec3& view) {
    return evaluate_spikes(sample(table, view.x, view.y, view.z), tangent_light);
}

void write(const SpikeTable& table, ByteWriter& writer);

/// Inverse of write(). Throws Error (input) naming the offset for invalid bytes.
SpikeTable read_spike_table(ByteReader& reader);

/// Required by representation.h.
SpikeTable read(ByteReader& reader, const SpikeTableSettings& settings);
ShadingCost cost(const SpikeTable& table);
Facts facts(const SpikeTable& table);

}  // namespace rowland::diffraction
