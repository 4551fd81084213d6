#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/gpu/framebuffer.h"
#include "engine/gpu/program.h"
#include "engine/gpu/texture.h"
#include "modules/diffraction/model/grating.h"
#include "tests/evidence/peers/peer_material.h"

namespace rowland::evidence {

/// How a peer is evaluated.
struct PeerSetting {
    const Peer* peer;
    glm::vec4 parameters;
    bool highlight = false;  ///< with order 0, mirror and diffuse terms
    int orders = 0;          ///< how many orders are summed; 0: as many as published
};

/// Draws peers at points instead of pixels of a scene: one texel per point. Needs a current context.
class PointPass {
 public:
    explicit PointPass(std::span<const diffraction::ShadingPoint> points);

    /// Linear Rec.709 of each point under directional lights, as the shader gives it.
    std::vector<glm::dvec3> draw(const PeerSetting& setting, std::span<const render::DistantLight> lights);

 private:
    const gpu::Program& program(const PeerSetting& setting);

    std::size_t count_;
    gpu::ShaderLibrary library_;
    gpu::Texture views_;
    gpu::Texture normals_;
    gpu::Texture gratings_;
    gpu::Framebuffer target_;
    gpu::FullScreenTriangle triangle_;
    std::map<std::pair<std::string, int>, gpu::Program> programs_;  ///< by peer and orders
};

/// The same in XYZ.
std::vector<glm::dvec3> xyz_of(std::span<const glm::dvec3> rgb);

}  // namespace rowland::evidence
