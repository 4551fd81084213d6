#include "content/demo/play/action.h"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <utility>

#include "engine/core/check.h"
#include "engine/platform/input.h"

namespace rowland::demo {

namespace {

using platform::GamepadButton;
using platform::Key;

constexpr std::array kActionKeys{
    ActionKey{Action::Walk, Key::C, "walk", "walk; again, or Esc: orbit", false, GamepadButton::North},
    ActionKey{Action::ResetView, Key::Home, "reset view", "return to the first view"},
    ActionKey{Action::PutBack, Key::R, "put back", "put everything back where it was", false, GamepadButton::Back},
    ActionKey{Action::Pause, Key::Space, "pause", "pause or resume what moves by itself", false, GamepadButton::Start},
    ActionKey{Action::SlowMotion, Key::M, "slow motion", "slow motion (a tenth of the speed) on or off", false,
              GamepadButton::West},
    ActionKey{Action::OneStep, Key::N, "one step", "pause and advance by 1/30 s", true},
    ActionKey{Action::AddLight, Key::G, "add light", "add a light in front of what is under the cursor, at most 64",
              false, GamepadButton::RightBumper},
    ActionKey{Action::RemoveLight, Key::Backspace, "remove light", "remove the last added light", false,
              GamepadButton::LeftBumper},
    ActionKey{Action::TurnEnvironmentLeft, Key::Comma, "turn environment left", "turn the environment left", true,
              GamepadButton::Left},
    ActionKey{Action::TurnEnvironmentRight, Key::Period, "turn environment right", "turn the environment right", true,
              GamepadButton::Right},
    ActionKey{Action::Lamp, Key::L, "lamp", "lamp with shadow on or off"},
    ActionKey{Action::NextProbe, Key::P, "next probe", "the next light probe", false, GamepadButton::Up},
    ActionKey{Action::NextView, Key::V, "next view", "the next view of the display"},
    ActionKey{Action::LessExposure, Key::Minus, "less exposure", "a quarter of a stop darker", true},
    ActionKey{Action::MoreExposure, Key::Equal, "more exposure", "a quarter of a stop brighter", true},
    ActionKey{Action::Bloom, Key::Digit1, "bloom", "bloom on or off"},
    ActionKey{Action::Vignette, Key::Digit2, "vignette", "vignette on or off"},
    ActionKey{Action::AutoExposure, Key::Digit3, "automatic exposure", "automatic exposure on or off"},
    ActionKey{Action::Dither, Key::Digit4, "dither", "dither on or off"},
    ActionKey{Action::Glare, Key::Digit5, "glare",
              "look through the next sheet of glasses or screens, or through none"},
    ActionKey{Action::DepthOfField, Key::F6, "depth of field", "blur what is not in focus, or nothing"},
    ActionKey{Action::Grain, Key::F7, "grain", "film grain on or off"},
    ActionKey{Action::NextLook, Key::T, "next representation",
              "the next representation of the grating under the cursor, or of all"},
    ActionKey{Action::NextDetail, Key::Y, "next detail", "the same representation coarser or finer"},
    ActionKey{Action::Wipe, Key::X, "wipe", "two representations side by side; drag the line between them"},
    ActionKey{Action::Reference, Key::Z, "reference", "the reference, as a still picture, right of the wipe's line"},
    ActionKey{Action::Help, Key::F1, "help", "this list"},
    ActionKey{Action::Hud, Key::F2, "panels", "show or hide all panels"},
    ActionKey{Action::Reload, Key::F5, "reload", "reload shaders and assets"},
    ActionKey{Action::WritePixel, Key::F8, "write pixel", "write the measured pixel to files (CSV, JSON)"},
    ActionKey{Action::LinearScreenshot, Key::F9, "linear screenshot", "scene-linear screenshot (EXR)"},
    ActionKey{Action::FrameGraph, Key::F10, "times", "show times of frames and passes"},
    ActionKey{Action::FullScreen, Key::F11, "full screen", "full screen on or off"},
    ActionKey{Action::Screenshot, Key::F12, "screenshot", "screenshot (PNG)"},
    ActionKey{Action::Close, Key::Escape, "close", "quit"}};

constexpr std::array kHeldKeys{HeldKey{Held::Forward, Key::W, "walk forward"},
                               HeldKey{Held::Left, Key::A, "walk left"},
                               HeldKey{Held::Back, Key::S, "walk back"},
                               HeldKey{Held::Right, Key::D, "walk right"},
                               HeldKey{Held::Down, Key::Q, "walk down"},
                               HeldKey{Held::Up, Key::E, "walk up"},
                               HeldKey{Held::Fast, Key::LeftShift, "walk fast"},
                               HeldKey{Held::Slow, Key::LeftControl, "walk slowly"},
                               HeldKey{Held::Spin, Key::LeftShift, "and drag: spin an object about its own axis"}};

/// The first action of each group of the help.
constexpr std::array<std::pair<Action, const char*>, 5> kGroups{{{Action::Walk, "View and motion"},
                                                                 {Action::AddLight, "Light"},
                                                                 {Action::NextView, "Picture"},
                                                                 {Action::NextLook, "Gratings"},
                                                                 {Action::Help, "Program"}}};

const char* button_name(GamepadButton button) {
    constexpr platform::PerEnum<GamepadButton, const char*> kNames{
        "A",     "B",          "X",           "Y",  "left bumper", "right bumper", "back", "start",
        "guide", "left stick", "right stick", "up", "right",       "down",         "left"};
    return kNames[static_cast<std::size_t>(button)];
}

}  // namespace

std::span<const ActionKey> action_keys() {
    return kActionKeys;
}

const ActionKey& key_row(Action action) {
    const auto* const row = std::ranges::find(kActionKeys, action, &ActionKey::action);
    ROWLAND_CHECK(row != kActionKeys.end(), "every action has a row");
    return *row;
}

std::optional<Action> find_action(std::string_view name) {
    for (const ActionKey& row : kActionKeys)
        if (row.name == name) return row.action;
    return std::nullopt;
}

std::span<const HeldKey> held_keys() {
    return kHeldKeys;
}

platform::Key key_of(Held held) {
    const auto* const row = std::ranges::find(kHeldKeys, held, &HeldKey::held);
    ROWLAND_CHECK(row != kHeldKeys.end(), "everything held has a row");
    return row->key;
}

std::vector<HelpLine> help_lines() {
    std::vector<HelpLine> lines{{"Mouse", "drag an object", "turn it; let go while moving to throw it"},
                                {"Mouse", "wheel while dragging an object", "spin it about its own axis"},
                                {"Mouse", "drag the background", "orbit"},
                                {"Mouse", "wheel", "zoom"}};
    for (const HeldKey& row : kHeldKeys) lines.push_back({"Held keys", platform::name_of(row.key), row.help});
    const char* group = "";
    for (const ActionKey& row : kActionKeys) {
        const auto* const begun = std::ranges::find(kGroups, row.action, &std::pair<Action, const char*>::first);
        if (begun != kGroups.end()) group = begun->second;
        lines.push_back({group, platform::name_of(row.key), row.help});
    }
    constexpr const char* kPad = "Game pad";
    lines.push_back({kPad, "pad sticks", "orbit, or walk and look; with A held: turn the object in the middle"});
    for (const ActionKey& row : kActionKeys)
        if (row.button) lines.push_back({kPad, std::string("pad ") + button_name(*row.button), row.help});
    return lines;
}

std::string help_text() {
    std::string text;
    std::string group;
    for (const HelpLine& line : help_lines()) {
        if (group != line.group) text += fmt::format(" {}\n", group = line.group);
        text += fmt::format("  {:<24}{}\n", line.control, line.what);
    }
    return text;
}

namespace {

constexpr std::array<SettingKind, 13> kKinds{{
    {Setting::Exposure, "exposure", {{-12.0, 12.0}}},
    {Setting::Bloom, "bloom", {{0.0, 1.0}}},
    {Setting::Vignette, "vignette", {{0.0, 1.0}}},
    {Setting::FNumber, "f-number", {{0.5, 64.0}}},
    {Setting::Grain, "grain", {{0.0, 0.5}}},
    {Setting::GratingsMs, "gratings_ms", {{0.0, 100.0}}},
    {Setting::Rung, "rung", {{0.0, 15.0}}},
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
