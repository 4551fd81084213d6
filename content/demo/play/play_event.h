#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "content/demo/play/action.h"
#include "engine/platform/input.h"

namespace rowland::demo {

/// What the user sets to a value, say with a slider; an Action only steps to the next one.
enum class Setting { Exposure, Bloom, Vignette, Wipe, WipeLine, Probe, View, LeftLook, RightLook };

/// The name and values of a setting. One without a range is a text.
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
    std::string object = {};                  ///< whose look it is; empty: of all

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
