#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>

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

struct SettingEvent {
    Setting setting;
    std::variant<double, std::string> value;  ///< a number within the range, or a text
    std::string object = {};                  ///< whose look it is; empty: of all

    friend bool operator==(const SettingEvent&, const SettingEvent&) = default;
};

}  // namespace rowland::demo
