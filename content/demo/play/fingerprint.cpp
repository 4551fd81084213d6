#include "content/demo/play/fingerprint.h"

#include <span>

#include "engine/core/hash.h"

namespace rowland::demo {

namespace {

template <typename T>
void add(Hasher& hasher, const T& value) {
    hasher.bytes(std::as_bytes(std::span(&value, 1)));
}

}  // namespace

std::string fingerprint(Play& play) {
    Hasher hasher;
    add(hasher, play.steps());
    add(hasher, play.time_s());
    add(hasher, play.environment_turn());
    add(hasher, play.camera().eye);
    add(hasher, play.camera().target);
    for (const Body& body : play.bodies()) {
        hasher.text(body.name);
        add(hasher, object_to_world(play.world(), body.node));
        add(hasher, body.state.spin);
    }
    for (const ecs::Entity light : play.lights().entities()) add(hasher, object_to_world(play.world(), light));
    return hasher.digest().hex().substr(0, 16);
}

}  // namespace rowland::demo
