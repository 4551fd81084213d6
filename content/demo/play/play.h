#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "content/demo/play/action.h"
#include "content/demo/play/body.h"
#include "content/demo/play/camera_control.h"
#include "content/demo/play/hand.h"
#include "engine/ecs/world.h"
#include "engine/scene/camera.h"
#include "engine/scene/light.h"

namespace rowland::demo {

/// The most lights in a world: as many as the renderer draws.
inline constexpr std::size_t kMostLights = 64;

/// All lights of the world, not only the player's.
std::size_t light_count(ecs::World& world);

/// Lights that the player adds, each in the next of a few colours.
class PlayerLights {
 public:
    /// A light at `position`, relative to `parent`, that lights what is `reach` metres away about as a room does. Adds
    /// nothing and returns false if the world has kMostLights.
    bool add(ecs::World& world, ecs::Entity parent, const glm::vec3& position, float reach);
    /// Removes the last one; false if there is none.
    bool remove(ecs::World& world);

    const std::vector<ecs::Entity>& entities() const { return lights_; }

 private:
    std::vector<ecs::Entity> lights_;
};

inline constexpr int kStepsPerSecond = 120;
inline constexpr int kFramesPerSecond = 30;  ///< without a window

/// The objects of a scene that can be played with.
struct Toys {
    ecs::Entity root;                 ///< above everything; turns against the environment
    std::vector<Body> bodies;         ///< parents before their children
    std::vector<PickTarget> targets;  ///< everything that can be pointed at
    /// For each target, the body that may be grabbed there.
    std::vector<std::optional<std::size_t>> body_of_target;
};

/// The state of a play. It advances in steps of 1/120 s, independent of frames: the same world and the same events at
/// the same steps give the same state, to the bit, on any machine at any frame rate (with the same program).
class Play {
 public:
    /// Called in each step before bodies are placed: moves everything that is a function of time_s().
    using Animate = std::function<void(const Play&)>;

    /// `world` must outlive the play. `room`: where the player may walk. `window`: as for ResizeEvent.
    Play(ecs::World& world, Toys toys, const scene::Camera& start, const scene::Bounds& room, glm::ivec2 window);

    void set_animation(Animate animate);
    /// Replaces the toys after the scene was reloaded. Bodies keep the state of earlier bodies of the same name.
    void set_toys(Toys toys);

    /// Moves all bodies to their rest pose until the next step, for measuring the scene itself.
    void move_to_rest_pose();
    /// Moves everything to its pose of this step.
    void update_nodes();

    /// One step, with the user's events since the last.
    void step(std::span<const PlayEvent> events);
    /// The commands since the last call that the caller must carry out, in order.
    using Command = std::variant<Action, SettingEvent>;
    std::vector<Command> take_commands();
    /// Carries out an action of the play itself; false if it is the caller's.
    bool perform(Action action);

    /// In world axes: the root, and the camera with it, is rotated against the environment.
    scene::Camera camera() const;
    bool walking() const { return camera_.walking(); }
    bool paused() const { return paused_; }
    /// Factor on the speed of time: 1, 0.1 in slow motion, 0 while paused.
    double speed() const;
    double time_s() const { return time_s_; }          ///< of the scene
    std::uint64_t steps() const { return steps_; }     ///< so far
    double environment_turn() const { return turn_; }  ///< radians about +Y, from above counter-clockwise
    const std::vector<Body>& bodies() const { return toys_.bodies; }
    std::optional<std::size_t> held_body() const;
    const PlayerLights& lights() const { return lights_; }
    /// A short hash of the poses of all bodies, added lights and the camera, of spins, time and steps: to the last bit of
    /// floats, as the last bits of doubles depend on the C library.
    std::string fingerprint() const;
    ecs::World& world() { return world_; }
    const Toys& toys() const { return toys_; }
    /// What is at a point of the window now.
    std::optional<Hit> hit_at(glm::dvec2 point) const;

 private:
    void apply(const PlayEvent& event);
    void read_keys();
    /// True if this step's mouse input was for a body.
    bool move_hand();
    void try_to_grab();
    void let_go();
    void advance_time();
    void put_back();
    void add_light();
    void turn_environment(double radians);
    void toggle_walking();
    void step_camera(bool drags);
    glm::dvec2 pointer() const;

    ecs::World& world_;
    Toys toys_;
    CameraControl camera_;
    glm::ivec2 window_;
    Animate animate_;
    platform::InputState input_;
    std::vector<Command> commands_;
    PlayerLights lights_;
    std::optional<Hand> hand_;
    std::vector<int> held_steps_;  ///< for how many steps each action's key has been down
    bool paused_ = false;
    bool slow_ = false;
    int extra_steps_ = 0;  ///< still to advance while paused
    double time_s_ = 0.0;
    double turn_ = 0.0;  ///< environment_turn()
    std::uint64_t steps_ = 0;
};

}  // namespace rowland::demo
