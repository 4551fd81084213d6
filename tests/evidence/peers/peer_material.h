#pragma once

#include <array>
#include <cstddef>
#include <glm/vec4.hpp>
#include <memory>
#include <span>
#include <string>

#include "engine/gpu/buffer.h"
#include "engine/gpu/program.h"
#include "engine/gpu/shader_library.h"
#include "engine/render/material.h"

namespace rowland::evidence {

/// A shader that others use for discs: NAME.glsl in this folder. Sources: README.md.
struct Peer {
    const char* name;
    const char* title;
    glm::vec4 published;  ///< peer_parameters, as the peer's file says
};

inline constexpr std::size_t kPeers = 6;
/// In the order of tables.
const std::array<Peer, kPeers>& peers_of_discs();
/// A logic error for an unknown name.
const Peer& peer_named(const std::string& name);

/// Adds the peers' shaders, and those they include.
void add_peer_shaders(gpu::ShaderLibrary& library);
/// The define of a stage that includes the peer's file.
gpu::Define peer_define(const Peer& peer);

/// Lights as the peers' shaders read them: linear Rec.709. At least one.
gpu::Buffer light_buffer(std::span<const render::DistantLight> lights);
inline constexpr unsigned kPeerLightBinding = 4;

/// Component: a surface that a peer shades in a loop over its own lights, over its StandardMaterial.
struct PeerSurface {
    const Peer* peer;
    std::shared_ptr<const gpu::Buffer> lights;
};

/// Draws entities that have a PeerSurface.
class PeerType final : public render::MaterialType {
 public:
    std::string name() const override { return "peer"; }
    void add_shaders(gpu::ShaderLibrary& library) const override { add_peer_shaders(library); }
    bool owns(ecs::World& world, ecs::Entity entity) const override;
    gpu::ProgramDesc program(ecs::World& world, ecs::Entity entity, render::ProbeSlot slot) const override;
    void update(ecs::World&, std::span<const render::FrameLight>, std::span<const render::LitEntity>) override {}
    void bind(ecs::World& world, ecs::Entity entity, render::ProbeSlot slot,
              const gpu::Program& program) const override;
};

}  // namespace rowland::evidence
