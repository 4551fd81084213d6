#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <string>
#include <vector>

#include "engine/core/byte_stream.h"
#include "modules/diffraction/bake/spikes.h"
#include "modules/diffraction/model/grating.h"

namespace rowland::diffraction {

/// How the 16 bits of a stored component are read: as n/65535, or as a half float.
enum class Storage : std::uint8_t { Unorm16 = 0, Half = 1 };

/// Spikes tabulated over the views of the upper hemisphere, laid out as a 2D texture array (the paper's step 4 and 5).
///
/// Spherical mapping: row i holds θ = π/2 · i/(theta_nodes−1), both ends included (row 0 is n); column j holds
/// φ = 2π j/phi_nodes, v = (sinθ cosφ, sinθ sinφ, cosθ) in (g, h, n).
/// Layer k·L + j (L = layers_per_spike) holds entries 4j..4j+3 of spike k's list [c_0 … c_{n²−1}, (λ_k − 380)/400, 0
/// …]. A component is `stored·scale + bias` with scale and bias of its layer.
struct SpikeTable {
    int bands = 0;
    int spikes = 0;
    int theta_nodes = 0;
    int phi_nodes = 0;
    int layers_per_spike = 0;
    Storage storage = Storage::Unorm16;
    std::vector<glm::vec4> scale;       ///< per layer
    std::vector<glm::vec4> bias;        ///< per layer
    std::vector<std::uint16_t> texels;  ///< RGBA, layer-major, then row θ, then column φ

    int layers() const { return spikes * layers_per_spike; }
};

struct SpikeTableSettings {
    SpikeSettings spikes;
    int theta_nodes = 32;  ///< ≥ 2
    int phi_nodes = 64;    ///< ≥ 1
    Storage storage = Storage::Unorm16;
};

/// Layers per spike: ⌈(bands²+1)/4⌉.
constexpr int spike_layers(int bands) {
    return (bands * bands + 1 + 3) / 4;
}

/// Bakes the spikes of every node. The bytes do not depend on the number of threads.
SpikeTable bake_spike_table(const Grating& grating, const SpikeTableSettings& settings);

/// The spikes of the tangent-frame view (v_g, v_h, v_n), as GL_LINEAR filtering gives them at texture coordinates
/// s = φ/2π + ½/phi_nodes (GL_REPEAT), t = (θ/(π/2)·(theta_nodes−1) + ½)/theta_nodes (GL_CLAMP_TO_EDGE).
/// A view below the horizon (v_n ≤ 0) gives zero coefficients.
SpikeSet sample(const SpikeTable& table, double v_g, double v_h, double v_n);

void write_spike_table(const SpikeTable& table, ByteWriter& writer);

/// Reads what write_spike_table() wrote. Throws Error (input) naming the offset if the bytes are not such a table;
/// every size is checked before it is used.
SpikeTable read_spike_table(ByteReader& reader);

}  // namespace rowland::diffraction
