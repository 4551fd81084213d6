#include "tests/unit/content/demo/play/small_world.h"

#include <cmath>

namespace rowland::test {

namespace {

// A camera 1 m before the plane that sees 1 m of it.
scene::Camera camera() {
    return {.eye = {0.0F, 0.0F, 1.0F},
            .target = {0.0F, 0.0F, 0.0F},
            .vertical_field_of_view = static_cast<float>(2.0 * std::atan(0.5))};
}

}  // namespace

std::shared_ptr<const scene::Mesh> square() {
    auto mesh = std::make_shared<scene::Mesh>();
    mesh->positions = {{-0.1F, -0.1F, 0.0F}, {0.1F, -0.1F, 0.0F}, {0.1F, 0.1F, 0.0F}, {-0.1F, 0.1F, 0.0F}};
    mesh->indices = {0, 1, 2, 0, 2, 3};
    return mesh;
}

SmallWorld::SmallWorld() {
    const auto node = [this](ecs::Entity parent, const scene::Transform& transform) {
        const ecs::Entity entity = world.create();
        world.add(entity, transform);
        if (world.alive(parent)) world.add(entity, scene::Parent{parent});
        return entity;
    };
    root = node({}, {});
    // A quarter turn about Z, so that its children's axes are not the world's; and twice as large.
    stand = node(root, {.translation = {-0.15F, 0.0F, 0.0F},
                        .rotation = glm::angleAxis(static_cast<float>(std::numbers::pi) / 2.0F, glm::vec3(0, 0, 1)),
                        .scale = glm::vec3(2.0F)});
    left = node(stand, {.scale = glm::vec3(0.5F)});
    right = node(root, {.translation = {0.15F, 0.0F, 0.0F}});
}

demo::Toys SmallWorld::toys() const {
    demo::Body turning;
    turning.node = left;
    turning.name = "left";
    turning.rest = {.scale = glm::vec3(0.5F)};
    turning.radius = 0.1F;
    turning.clearance = 0.05F;
    turning.spin_axis = {0.0F, 0.0F, 1.0F};
    turning.idle_spin = 0.5;
    turning.grab = true;
    demo::Body lying;
    lying.node = right;
    lying.name = "right";
    lying.rest = {.translation = {0.15F, 0.0F, 0.0F}};
    lying.radius = 0.1F;
    lying.clearance = 0.05F;
    lying.grab = true;
    const scene::Bounds bounds = scene::bounds(*square());
    return {.root = root,
            .bodies = {turning, lying},
            .targets = {{left, square(), bounds}, {right, square(), bounds}},
            .body_of_target = {0, 1}};
}

demo::Play SmallWorld::play() {
    const scene::Bounds room{{-2.0F, -1.0F, -2.0F}, {2.0F, 1.0F, 2.0F}};
    return {world, toys(), camera(), room, kWindow};
}

demo::PlayEvent key(platform::Key key, bool down) {
    return platform::InputEvent(platform::KeyEvent{key, down});
}
demo::PlayEvent mouse(glm::dvec2 place) {
    return platform::InputEvent(platform::MouseMoveEvent{place});
}
demo::PlayEvent button(bool down) {
    return platform::InputEvent(platform::MouseButtonEvent{platform::MouseButton::Left, down});
}
demo::PlayEvent wheel(double notches) {
    return platform::InputEvent(platform::ScrollEvent{{0.0, notches}});
}

void wait(demo::Play& play, int steps) {
    for (int i = 0; i < steps; ++i) play.step({});
}

void tap(demo::Play& play, platform::Key which) {
    play.step(std::vector{key(which, true)});
    play.step(std::vector{key(which, false)});
}

void drag(demo::Play& play, glm::dvec2 from, glm::dvec2 per_step, int steps) {
    play.step(std::vector{mouse(from)});
    play.step(std::vector{button(true)});
    for (int i = 1; i <= steps; ++i) play.step(std::vector{mouse(from + static_cast<double>(i) * per_step)});
}

}  // namespace rowland::test
