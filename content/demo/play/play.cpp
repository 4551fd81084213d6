#include "content/demo/play/play.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

#include "content/demo/play/body.h"
#include "engine/core/check.h"
#include "engine/core/file.h"
#include "engine/core/log.h"
#include "engine/scene/light.h"
#include "engine/scene/transform.h"

namespace rowland::demo {

namespace {

// Linear Rec.709, each of luminance 1.
constexpr std::array<glm::vec3, 8> kColours = {{{1.38F, 0.92F, 0.52F},   // candle
                                                {0.86F, 1.01F, 1.31F},   // overcast sky
                                                {2.05F, 0.66F, 1.28F},   // rose
                                                {0.35F, 1.21F, 0.87F},   // sea
                                                {1.75F, 0.88F, 0.12F},   // amber
                                                {0.77F, 0.88F, 2.87F},   // violet
                                                {1.0F, 1.0F, 1.0F},      // white
                                                {0.95F, 1.1F, 0.22F}}};  // lime
constexpr float kIrradiance = 1.5F;                                      ///< at a distance of `reach`

}  // namespace

std::size_t light_count(ecs::World& world) {
    return world.view<scene::DirectionalLight>().count() + world.view<scene::PunctualLight>().count();
}

bool PlayerLights::add(ecs::World& world, ecs::Entity parent, const glm::vec3& position, float reach) {
    if (light_count(world) >= kMostLights) return false;
    const ecs::Entity entity = world.create();
    world.add(entity, scene::Transform{.translation = position});
    world.add(entity, scene::Parent{parent});
    constexpr float kRangeInReaches = 8.0F;
    world.add(entity, scene::PunctualLight{
                          .intensity = kColours[lights_.size() % kColours.size()] * kIrradiance * reach * reach,
                          .radius_m = scene::kBulbRadius_m,
                          .range_m = kRangeInReaches * reach});
    lights_.push_back(entity);
    return true;
}

bool PlayerLights::remove(ecs::World& world) {
    if (lights_.empty()) return false;
    world.destroy(lights_.back());
    lights_.pop_back();
    return true;
}

namespace {

using platform::GamepadButton;
using platform::MouseButton;

constexpr double kStep_s = 1.0 / kStepsPerSecond;
constexpr double kSlowMotion = 0.1;
constexpr int kStepsPerFrameAdvance = kStepsPerSecond / 30;
constexpr double kEnvironmentTurn = 5.0 / 180.0 * std::numbers::pi;
// A key held for more than 0.4 s acts ten times a second, first at 0.5 s.
constexpr int kStepsToRepeat = kStepsPerSecond * 2 / 5;
constexpr int kStepsBetweenRepeats = kStepsPerSecond / 10;
constexpr auto kPadGrab = GamepadButton::South;

bool acts_again(int held_steps) {
    return held_steps > kStepsToRepeat && (held_steps - kStepsToRepeat) % kStepsBetweenRepeats == 0;
}

}  // namespace

Play::Play(ecs::World& world, Toys toys, const scene::Camera& start, const scene::Bounds& room, glm::ivec2 window)
    : world_(world),
      toys_(std::move(toys)),
      camera_(start, room),
      window_(window),
      held_steps_(action_keys().size(), 0) {
    update_nodes();
}

void Play::set_animation(Animate animate) {
    animate_ = std::move(animate);
    update_nodes();
}

void Play::set_toys(Toys toys) {
    let_go();
    for (Body& body : toys.bodies)
        for (const Body& before : toys_.bodies)
            if (before.name == body.name) body.state = before.state;
    toys_ = std::move(toys);
    turn_environment(0.0);  // applies turn_ to the new root
    update_nodes();
}

void Play::step(std::span<const PlayEvent> events) {
    input_.begin_frame();
    for (const PlayEvent& event : events) apply(event);
    read_keys();
    const bool hand_drags = move_hand();
    step_camera(!hand_drags);
    advance_time();
    update_nodes();
    ++steps_;
}

void Play::apply(const PlayEvent& event) {
    if (const auto* input = std::get_if<platform::InputEvent>(&event)) input_.apply(*input);
    if (const auto* resize = std::get_if<ResizeEvent>(&event)) window_ = glm::max(resize->size, glm::ivec2(1));
    if (const auto* chosen = std::get_if<ActionEvent>(&event))
        if (!perform(chosen->action)) commands_.emplace_back(chosen->action);
    if (const auto* setting = std::get_if<SettingEvent>(&event)) commands_.emplace_back(*setting);
}

void Play::read_keys() {
    const auto rows = action_keys();
    for (std::size_t i = 0; i < rows.size(); ++i) {
        platform::ButtonState state = input_.key(rows[i].key);
        if (rows[i].button) {
            const platform::ButtonState& button = input_.gamepad_button(*rows[i].button);
            state.down = state.down || button.down;
            state.pressed = state.pressed || button.pressed;
        }
        held_steps_[i] = state.down ? held_steps_[i] + 1 : 0;
        const bool acts = state.pressed || (rows[i].repeats && acts_again(held_steps_[i]));
        if (acts && !perform(rows[i].action)) commands_.emplace_back(rows[i].action);
    }
}

bool Play::perform(Action action) {
    switch (action) {
        case Action::Walk:
            toggle_walking();
            return true;
        case Action::Close:  // ends walking first
            if (!walking()) return false;
            toggle_walking();
            return true;
        case Action::ResetView:
            camera_.reset();
            return true;
        case Action::PutBack:
            put_back();
            return true;
        case Action::Pause:
            paused_ = !paused_;
            return true;
        case Action::SlowMotion:
            slow_ = !slow_;
            return true;
        case Action::OneStep:
            paused_ = true;
            extra_steps_ += kStepsPerFrameAdvance;
            return true;
        case Action::AddLight:
            add_light();
            return true;
        case Action::RemoveLight:
            if (lights_.remove(world_)) log_info("{} lights", light_count(world_));
            return true;
        case Action::TurnEnvironmentLeft:
            turn_environment(kEnvironmentTurn);
            return true;
        case Action::TurnEnvironmentRight:
            turn_environment(-kEnvironmentTurn);
            return true;
        default:
            return false;
    }
}

std::vector<Play::Command> Play::take_commands() {
    return std::exchange(commands_, {});
}

std::string Play::fingerprint() const {
    Hasher hasher;
    const auto add = [&](const auto&... values) { (hasher.bytes(std::as_bytes(std::span(&values, 1))), ...); };
    const scene::Camera seen_from = camera();
    add(steps_, time_s_, static_cast<float>(turn_), seen_from.eye, seen_from.target);
    for (const Body& body : toys_.bodies) {
        hasher.text(body.name);
        add(object_to_world(world_, body.node), glm::vec3(body.state.spin));
    }
    for (const ecs::Entity light : lights_.entities()) add(object_to_world(world_, light));
    return hasher.digest().hex().substr(0, 16);
}

double Play::speed() const {
    if (paused_) return 0.0;
    return slow_ ? kSlowMotion : 1.0;
}

scene::Camera Play::camera() const {
    scene::Camera camera = camera_.camera();
    const glm::quat turned = world_.get<scene::Transform>(toys_.root).rotation;
    camera.eye = turned * camera.eye;
    camera.target = turned * camera.target;
    return camera;
}

std::optional<std::size_t> Play::held_body() const {
    return hand_ ? std::optional(hand_->body()) : std::nullopt;
}

glm::dvec2 Play::pointer() const {
    // While walking, or grabbing by game pad, the player points at the middle.
    const bool middle = walking() || input_.gamepad_button(kPadGrab).down;
    return middle ? 0.5 * glm::dvec2(window_) : input_.mouse_position();
}

std::optional<Hit> Play::hit_at(glm::dvec2 point) const {
    return pick(world_, toys_.targets, ray_through(camera(), point, window_));
}

void Play::try_to_grab() {
    const auto hit = hit_at(pointer());
    if (!hit) return;
    const auto body = toys_.body_of_target[hit->target];
    if (body) hand_.emplace(world_, *body, toys_.bodies[*body], hit->point, camera(), window_.y);
}

void Play::let_go() {
    if (hand_) hand_->let_go(toys_.bodies[hand_->body()]);
    hand_.reset();
}

bool Play::move_hand() {
    const platform::ButtonState& button = input_.mouse_button(MouseButton::Left);
    const platform::ButtonState& pad = input_.gamepad_button(kPadGrab);
    if (!hand_ && (button.pressed || pad.pressed)) try_to_grab();
    if (!hand_) return false;
    const glm::vec2 mouse =
        walking() ? glm::vec2(input_.mouse_delta()) : glm::vec2(input_.mouse_drag(MouseButton::Left));
    const glm::vec2 stick = glm::vec2(input_.right_stick().x, -input_.right_stick().y) * kStickPixelsPerSecond *
                            static_cast<float>(kStep_s);
    const HandMove move{.drag = mouse + stick,
                        .wheel = static_cast<float>(input_.scroll().y),
                        .about_own_axis = input_.key(key_of(Held::Spin)).down};
    const bool released = !button.down && !pad.down;
    // A step whose only event is the release has no motion: skipping it keeps the velocity of the throw.
    if (!released || move.drag != glm::vec2(0.0F)) hand_->move(world_, toys_.bodies[hand_->body()], move, kStep_s);
    if (released) let_go();
    return true;
}

void Play::advance_time() {
    const int advances = paused_ ? std::min(extra_steps_, 1) : 1;
    extra_steps_ = paused_ ? extra_steps_ - advances : 0;
    const double seconds = kStep_s * advances * (slow_ ? kSlowMotion : 1.0);
    time_s_ += seconds;
    for (Body& body : toys_.bodies) {
        if (seconds > 0.0) demo::step(body, seconds);
        step_lift(body, kStep_s);
    }
}

void Play::update_nodes() {
    if (animate_) animate_(*this);
    for (const Body& body : toys_.bodies)
        if (world_.alive(body.node)) update_node(world_, body);
}

void Play::move_to_rest_pose() {
    for (const Body& body : toys_.bodies)
        if (world_.alive(body.node)) world_.get<scene::Transform>(body.node) = body.rest;
}

void Play::put_back() {
    hand_.reset();
    for (Body& body : toys_.bodies) body.state = {};
}

void Play::add_light() {
    // On the ray, nearer to the eye than the hit point by a quarter of the distance, and raised by half as much.
    constexpr float kReachInDistances = 0.25F;
    const scene::Camera seen_from = camera();
    const Ray ray = ray_through(seen_from, pointer(), window_);
    const auto hit = pick(world_, toys_.targets, ray);
    const float distance = hit ? hit->triangle.distance : glm::length(seen_from.target - seen_from.eye);
    const float reach = kReachInDistances * distance;
    const glm::vec3 position = ray.origin + (distance - reach) * ray.direction + glm::vec3(0.0F, 0.5F * reach, 0.0F);
    const glm::quat turned = world_.get<scene::Transform>(toys_.root).rotation;
    if (lights_.add(world_, toys_.root, glm::conjugate(turned) * position, reach))
        log_info("{} lights", light_count(world_));
    else
        log_info("{} lights are the most", light_count(world_));
}

void Play::turn_environment(double radians) {
    turn_ = std::remainder(turn_ + radians, 2.0 * std::numbers::pi);
    // The root turns the other way, objects and camera with it: the picture is that of a turned environment.
    world_.get<scene::Transform>(toys_.root).rotation = glm::quat(glm::angleAxis(-turn_, glm::dvec3(0.0, 1.0, 0.0)));
}

/// A walker stops before what stands in the way, and slides along the axes that are free.
void Play::step_camera(bool drags) {
    const scene::Camera before = camera();
    camera_.step(input_, kStep_s, drags);
    const glm::vec3 way = camera().eye - before.eye;
    const auto is_free = [&](const glm::vec3& from, const glm::vec3& step) {
        const float length = glm::length(step);
        if (!(length > 0.0F)) return true;
        constexpr float kNearPlanes = 2.0F;  // kept between the eye and a surface
        const auto hit = pick(world_, toys_.targets, {from, step / length});
        return !hit || hit->triangle.distance >= length + kNearPlanes * before.near_plane;
    };
    if (!walking() || is_free(before.eye, way)) return;
    glm::vec3 eye = before.eye;
    for (int axis = 0; axis < 3; ++axis) {
        glm::vec3 step(0.0F);
        step[axis] = way[axis];
        if (is_free(eye, step)) eye += step;
    }
    camera_.stop_at(glm::conjugate(world_.get<scene::Transform>(toys_.root).rotation) * eye);
}

void Play::toggle_walking() {
    if (!walking()) {
        camera_.walk();
        return;
    }
    const auto ahead = hit_at(0.5 * glm::dvec2(window_));
    camera_.stop_walking(ahead ? std::max(ahead->triangle.distance, 0.05F) : 1.0F);
}

}  // namespace rowland::demo
