#include "tests/evidence/peers/peer_material.h"

#include <algorithm>
#include <glm/vec2.hpp>
#include <vector>

#include "engine/core/check.h"
#include "engine/core/text.h"
#include "engine/ecs/world.h"
#include "modules/diffraction/shaders/shader_files.h"

namespace rowland::evidence {

/// The shaders of this folder.
std::span<const EmbeddedFile> peer_files();

const std::array<Peer, kPeers>& peers_of_discs() {
    static const std::array<Peer, kPeers> peers = {
        {{"stam", "Stam, GPU Gems", {10.0F, 50.0F, 0.0F, 1.0F}},
         {"zucconi", "Zucconi, CD-ROM shader", {1600.0F, 0.0F, 0.0F, 1.0F}},
         {"egholm", "Egholm & Christensen, after Sun", {1600.0F, 0.05F, 0.0F, 1.0F}},
         {"projected", "projected angles, a wave-optics path tracer", {1600.0F, 110.0F, 0.0F, 0.0F}},
         {"three_lobes", "three shifted lobes", {0.17F, 0.03F, 0.5F, 0.0F}},
         {"iridescence", "KHR_materials_iridescence", {400.0F, 1.8F, 0.3F, 0.5F}}}};
    return peers;
}

const Peer& peer_named(const std::string& name) {
    const auto& all = peers_of_discs();
    const auto* found = std::find_if(all.begin(), all.end(), [&](const Peer& peer) { return peer.name == name; });
    ROWLAND_CHECK(found != all.end(), "a peer of another name");
    return *found;
}

void add_peer_shaders(gpu::ShaderLibrary& library) {
    library.add_embedded(diffraction::shader_files());
    library.add_embedded(peer_files());
}

gpu::Define peer_define(const Peer& peer) {
    return {"PEER", std::string("\"tests/evidence/peers/") + peer.name + ".glsl\""};
}

gpu::Buffer light_buffer(std::span<const render::DistantLight> lights) {
    std::vector<glm::vec4> values;
    for (const render::DistantLight& light : lights) {
        values.emplace_back(light.direction, 0.0F);
        values.emplace_back(light.irradiance, 0.0F);
    }
    return gpu::Buffer::of(std::span<const glm::vec4>(values));
}

bool PeerType::owns(ecs::World& world, ecs::Entity entity) const {
    return world.find<PeerSurface>(entity) != nullptr;
}

gpu::ProgramDesc PeerType::program(ecs::World& world, ecs::Entity entity, render::ProbeSlot /*slot*/) const {
    return {.vertex = "modules/diffraction/shaders/grating.vert.glsl",
            .fragment = "tests/evidence/peers/peer.frag.glsl",
            .defines = {peer_define(*world.get<PeerSurface>(entity).peer)}};
}

void PeerType::bind(ecs::World& world, ecs::Entity entity, render::ProbeSlot /*slot*/,
                    const gpu::Program& program) const {
    const PeerSurface& surface = world.get<PeerSurface>(entity);
    surface.lights->bind_storage(kPeerLightBinding);
    program.set("peer_parameters", surface.peer->published);
    program.set("peer_highlight", 1.0F);
    program.set("groove_turn", glm::vec2(1.0F, 0.0F));
}

}  // namespace rowland::evidence
