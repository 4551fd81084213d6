#include "editor/trade/sweep_plan.h"

#include <fmt/format.h>

#include <algorithm>

namespace rowland::trade {

namespace {

/// Settings in the order they were added, each once; those that do not suit the lobe are left out.
class Plan {
 public:
    explicit Plan(const diffraction::GrooveLobe& lobe) { grating_.lobe = lobe; }

    void add(const diffraction::Method& setting) {
        if (refusal(setting, grating_)) return;
        if (std::find(settings_.begin(), settings_.end(), setting) == settings_.end()) settings_.push_back(setting);
    }
    std::vector<diffraction::Method> take() { return std::move(settings_); }

 private:
    diffraction::Grating grating_;
    std::vector<diffraction::Method> settings_;
};

std::string text_of(const diffraction::RepresentationInfo& info, const char* settings) {
    return *settings == 0 ? info.name : fmt::format("{}/{}", info.name, settings);
}

/// The starting point with one of its settings at each of the values that the representation names.
void vary_one_at_a_time(const diffraction::RepresentationInfo& info, Plan& plan) {
    const diffraction::Method tier = diffraction::parse_method(text_of(info, info.sweep_tier));
    for (const diffraction::SettingInfo& axis : info.settings)
        for (const nlohmann::json& value : axis.sweep) {
            diffraction::Method setting = tier;
            setting.quality[axis.key] = value;
            plan.add(setting);
        }
    for (const int count : info.sweep_key_lights) {
        diffraction::Method setting = tier;
        setting.key_lights = count;
        plan.add(setting);
    }
    for (const auto window : info.sweep_windows) {
        diffraction::Method setting = tier;
        setting.window = window;
        plan.add(setting);
    }
    for (const std::string& more : info.sweep_more) plan.add(diffraction::parse_method(text_of(info, more.c_str())));
}

}  // namespace

std::vector<Tier> tiers(const diffraction::GrooveLobe& lobe) {
    std::vector<Tier> result;
    for (const auto* info : diffraction::representations()) {
        const std::string text = text_of(*info, info->sweep_tier);
        if (!refusal(diffraction::parse_method(text), diffraction::Grating{.lobe = lobe}))
            result.push_back({info->name, text});
    }
    return result;
}

diffraction::Method paper_setting() {
    return diffraction::parse_method("spikes/bands=5/spikes=4");
}

std::vector<diffraction::Method> sweep_plan(const diffraction::GrooveLobe& lobe) {
    Plan plan(lobe);
    for (const Tier& tier : tiers(lobe)) plan.add(diffraction::parse_method(tier.setting));
    for (const auto* info : diffraction::representations()) vary_one_at_a_time(*info, plan);
    return plan.take();
}

}  // namespace rowland::trade
