#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "engine/platform/input.h"

namespace rowland::demo {

/// What a key press does.
enum class Action {
    // clang-format off
    Walk, ResetView, PutBack, Pause, SlowMotion, OneStep, AddLight, RemoveLight, TurnEnvironmentLeft, TurnEnvironmentRight,
    Lamp, NextProbe, NextView, LessExposure, MoreExposure, Bloom, Vignette, AutoExposure, Dither, Glare,
    DepthOfField, Grain,
    Help, Hud, FrameGraph, NextLook, NextDetail, Wipe, Reference, WritePixel,
    Reload, LinearScreenshot, FullScreen, Screenshot, Close,
    // clang-format on
};

/// The key and the description of an action. Input and help both read these tables.
struct ActionKey {
    Action action;
    platform::Key key;
    const char* name;      ///< as recordings write it
    const char* help;      ///< what it does, for the help
    bool repeats = false;  ///< while the key is held
    std::optional<platform::GamepadButton> button{};
};

/// One row per action, in the order of the help.
std::span<const ActionKey> action_keys();
const ActionKey& key_row(Action action);
std::optional<Action> find_action(std::string_view name);

/// Effects that last while a key is held.
enum class Held { Forward, Back, Left, Right, Down, Up, Fast, Slow, Spin };

struct HeldKey {
    Held held;
    platform::Key key;
    const char* help;
};
std::span<const HeldKey> held_keys();
platform::Key key_of(Held held);

/// Mouse drag that equals a stick at full travel.
inline constexpr float kStickPixelsPerSecond = 400.0F;

/// A line of the list of controls: "Picture", "F12", "screenshot".
struct HelpLine {
    std::string group;  ///< lines of one group follow each other
    std::string control;
    std::string what;
};
/// Mouse, keys and game pad.
std::vector<HelpLine> help_lines();
/// The lines as text in two columns.
std::string help_text();

/// What the user sets to a value, such as with a slider; an Action only toggles it or steps to the next value.
enum class Setting {
    Exposure,
    Bloom,
    Vignette,
    FNumber,
    Grain,
    GratingsMs,
    Rung,  ///< chosen within GratingsMs, not by the user: the index of a grating's rung, from 0, the cheapest
    Wipe,
    WipeLine,
    Probe,
    View,
    LeftLook,
    RightLook
};

/// The name and values of a setting. A setting without a range is a text.
struct SettingKind {
    Setting setting;
    const char* name;  ///< as recordings write it
    struct Range {
        double minimum;
        double maximum;
    };
    std::optional<Range> range;
};

const SettingKind& kind_of(Setting setting);
std::optional<Setting> setting_named(std::string_view name);

/// A setting was changed.
struct SettingEvent {
    Setting setting;
    std::variant<double, std::string> value;  ///< a number within the range, or a text
    std::string object = {};                  ///< whose look it is, empty: of all; whose rung it is, by number

    friend bool operator==(const SettingEvent&, const SettingEvent&) = default;
};

/// The window's new size, in the mouse's units; each >= 1.
struct ResizeEvent {
    glm::ivec2 size{1};
};
/// An action that was chosen in a panel, not by its key.
struct ActionEvent {
    Action action;
};

/// All input of a play besides the scene: the same events at the same steps make the same play.
using PlayEvent = std::variant<platform::InputEvent, ResizeEvent, ActionEvent, SettingEvent>;

}  // namespace rowland::demo
