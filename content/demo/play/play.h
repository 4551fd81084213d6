#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "content/demo/play/action.h"
#include "content/demo/play/body.h"
#include "content/demo/play/camera_control.h"
#include "content/demo/play/hand.h"
#include "content/demo/play/pick.h"
#include "content/demo/play/play_event.h"
#include "content/demo/play/player_lights.h"
#include "engine/ecs/world.h"
#include "engine/scene/camera.h"

namespace rowland::demo {

inline constexpr int kStepsPerSecond = 120;
inline constexpr int kFramesPerSecond = 30;  ///< of what is drawn without a window

/// What of a scene can be played with.
struct Toys {
    ecs::Entity root;                 ///< above everything that the environment does not turn with
    std::vector<Body> bodies;         ///< one that another one carries comes after it
    std::vector<PickTarget> targets;  ///< all that can be pointed at
    /// The body that each target belongs to, if it may be grabbed.
    std::vector<std::optional<std::size_t>> body_of_target;
};

/// The state of a play, moved on by steps of 1/120 s that know nothing of frames: the same world and the same events at
/// the same steps give the same state, to the bit, on any machine at any frame rate (with the same program).
class Play {
 public:
    /// Called in each step before bodies are placed: moves what moves as a function of time_s().
    using Pose = std::function<void(const Play&)>;

    /// `world` must outlive the play. `room`: where the player may walk. `window`: as for ResizeEvent.
    Play(ecs::World& world, Toys toys, const scene::Camera& start, const scene::Bounds& room, glm::ivec2 window);

    void set_pose(Pose pose);
    /// The scene was loaded anew: bodies keep the state of those of the same name before.
    void set_toys(Toys toys);

    /// Has everything stand as in its file until the next step: for one who looks at the scene itself.
    void rest();
    /// Puts everything where it is in the play.
    void place_all();

    /// One step, with what the user did meanwhile.
    void step(std::span<const PlayEvent> events);
    /// What was called for since the last call that is for others to carry out, in order.
    using Order = std::variant<Action, SettingEvent>;
    std::vector<Order> take_orders();
    /// Carries out an action if it is one of the play's own; false if it is for others.
    bool perform(Action action);

    /// In the world that is drawn: the root stands turned against the environment, and the camera with it.
    scene::Camera camera() const;
    bool walking() const { return camera_.walking(); }
    bool paused() const { return paused_; }
    /// Share of the usual speed at which time goes on.
    double speed() const;
    double time_s() const { return time_s_; }          ///< of the scene
    std::uint64_t steps() const { return steps_; }     ///< so far
    double environment_turn() const { return turn_; }  ///< radians about +Y, from above counter-clockwise
    const std::vector<Body>& bodies() const { return toys_.bodies; }
    /// The body in the player's hand.
    std::optional<std::size_t> held_body() const;
    const PlayerLights& lights() const { return lights_; }
    ecs::World& world() { return world_; }
    const Toys& toys() const { return toys_; }
    /// What lies under a place of the window, as the world stands now.
    std::optional<Hit> hit_at(glm::dvec2 place) const;

 private:
    void apply(const PlayEvent& event);
    void read_keys();
    /// True if what the mouse did in this step, it did to a body.
    bool move_hand();
    void try_to_grab();
    void let_go();
    void advance_time();
    void put_back();
    void add_light();
    void turn_environment(double radians);
    void toggle_walking();
    glm::dvec2 pointer() const;

    ecs::World& world_;
    Toys toys_;
    CameraControl camera_;
    glm::ivec2 window_;
    Pose pose_;
    platform::InputState input_;
    std::vector<Order> orders_;
    PlayerLights lights_;
    std::optional<Hand> hand_;
    std::vector<int> held_steps_;  ///< for how many steps each action's key is down
    bool paused_ = false;
    bool slow_ = false;
    int extra_steps_ = 0;  ///< to simulate though time stands still
    double time_s_ = 0.0;
    double turn_ = 0.0;
    std::uint64_t steps_ = 0;
};

}  // namespace rowland::demo
