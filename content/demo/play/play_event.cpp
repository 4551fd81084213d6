#include "content/demo/play/play_event.h"

#include <algorithm>
#include <array>

namespace rowland::demo {

namespace {

/// One row per setting.
constexpr std::array<SettingKind, 9> kKinds{{
    {Setting::Exposure, "exposure", {{-12.0, 12.0}}},
    {Setting::Bloom, "bloom", {{0.0, 1.0}}},
    {Setting::Vignette, "vignette", {{0.0, 1.0}}},
    {Setting::Wipe, "wipe", {{0.0, 1.0}}},
    {Setting::WipeLine, "wipe line", {{0.0, 1.0}}},
    {Setting::Probe, "probe", std::nullopt},
    {Setting::View, "view", std::nullopt},
    {Setting::LeftLook, "left look", std::nullopt},
    {Setting::RightLook, "right look", std::nullopt},
}};

}  // namespace

const SettingKind& kind_of(Setting setting) {
    return *std::ranges::find(kKinds, setting, &SettingKind::setting);
}

std::optional<Setting> setting_named(std::string_view name) {
    const auto found =
        std::ranges::find(kKinds, name, [](const SettingKind& kind) { return std::string_view(kind.name); });
    return found == kKinds.end() ? std::nullopt : std::optional(found->setting);
}

}  // namespace rowland::demo
