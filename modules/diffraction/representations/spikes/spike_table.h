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
/// …]. Where views lie is ViewGrid's: columns are phi_nodes, rows theta_nodes, whatever the mapping.
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
    int phi_nodes = 64;    ///< columns ≥ 1; but for the spherical mapping ≥ 2
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

/// The spikes of the tangent-frame view (v_g, v_h, v_n), as GL_LINEAR filtering gives them at view_mapping.h's
/// coordinates.
/// A view below the horizon (v_n ≤ 0) gives zero coefficients.
SpikeSet sample(const SpikeTable& table, double v_g, double v_h, double v_n);

void write(const SpikeTable& table, ByteWriter& writer);

/// Reads what write() wrote. Throws Error (input) naming the offset if the bytes are not such a table;
/// every size is checked before it is used.
SpikeTable read_spike_table(ByteReader& reader);

/// What representation.h asks of every representation's tables.
SpikeTable read(ByteReader& reader, const SpikeTableSettings& settings);
ShadingCost cost(const SpikeTable& table);
Facts facts(const SpikeTable& table);
PointShader point_shader(const SpikeTable& table, const MaterialKernel& material, const EvaluationLight& light);

}  // namespace rowland::diffraction
