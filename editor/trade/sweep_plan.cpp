#include "editor/trade/sweep_plan.h"

#include <algorithm>
#include <initializer_list>
#include <string>
#include <variant>

namespace rowland::trade {

namespace {

/// Settings in the order they were added, each once.
class Plan {
 public:
    void add(const Setting& setting) {
        if (std::find(settings_.begin(), settings_.end(), setting) == settings_.end()) settings_.push_back(setting);
    }
    /// A tier with one of its settings at each of the values.
    void vary(const char* tier, const char* key, std::initializer_list<nlohmann::json> values) {
        for (const nlohmann::json& value : values) {
            Setting setting = parse_setting(tier);
            setting.quality[key] = value;
            add(setting);
        }
    }
    void vary_key_lights(const char* tier, std::initializer_list<int> counts) {
        for (const int count : counts) {
            Setting setting = parse_setting(tier);
            setting.key_lights = count;
            add(setting);
        }
    }
    void vary_window(const char* tier) {
        for (const auto window : {math::SphericalWindow::Lanczos, math::SphericalWindow::Hann}) {
            Setting setting = parse_setting(tier);
            setting.window = window;
            add(setting);
        }
    }
    std::vector<Setting> take() { return std::move(settings_); }

 private:
    std::vector<Setting> settings_;
};

// Settings at their defaults are written out all the same, so that varying one meets the tier itself again.
constexpr const char* kPaper = "spikes/bands=5/spikes=4/view_resolution=32/storage=unorm16/view_mapping=spherical";
constexpr const char* kBins = "bins/bands=5/bins=16/view_resolution=32";
constexpr const char* kTransfer = "transfer/bands=5/storage=fp16/key_lights=16";
constexpr const char* kArc = "arc/bands=5/rank=8/storage=fp16/key_lights=16";
constexpr const char* kPlanar = "planar/map_resolution=128/key_lights=16";
constexpr const char* kCircle = "circle/map_resolution=64/key_lights=16";
constexpr const char* kDirect = "direct/key_lights=16";
constexpr const char* kStreak = "streak";

bool has_streak(const diffraction::GrooveLobe& lobe) {
    const auto* pits = std::get_if<diffraction::PitsLobe>(&lobe);
    return !is_flat(lobe) && (pits == nullptr || pits->coherent > 0.0);
}

void add_spikes(Plan& plan, bool flat) {
    plan.vary(kPaper, "bands", {2, 3, 4, 6, 8, 10, 12, 16});
    plan.vary(kPaper, "spikes", {1, 2, 3, 6, 8, 12, 16});
    plan.vary(kPaper, "view_resolution", {8, 16, 64, 128});
    plan.vary(kPaper, "storage", {"fp32", "fp16", "unorm8"});
    plan.vary_window(kPaper);
    plan.vary_key_lights(kPaper, {4, 8, 16, 32, 64});
    plan.vary("spikes/bands=5/spikes=4/view_resolution=64/storage=unorm16", "view_mapping", {"parabolic"});
    if (flat)
        plan.vary("spikes/bands=5/spikes=4/view_resolution=256/storage=unorm16", "view_mapping", {"one-dimensional"});
}

void add_bins(Plan& plan) {
    plan.vary(kBins, "bins", {4, 8, 32});
    plan.vary(kBins, "bands", {3, 8});
    plan.vary(kBins, "view_resolution", {16, 64});
}

void add_transfer(Plan& plan, bool flat) {
    plan.vary(kTransfer, "bands", {2, 3, 4, 6, 8, 12, 16});
    plan.vary(kTransfer, "storage", {"fp32", "unorm16", "unorm8"});
    plan.vary_key_lights(kTransfer, {0, 4, 64});
    if (flat) plan.vary(kTransfer, "view_resolution", {32, 64, 128, 512});
}

void add_arc(Plan& plan) {
    plan.vary(kArc, "bands", {2, 3, 4, 6, 8, 10, 12, 16});
    plan.vary(kArc, "rank", {2, 4, 6, 12, 16});
    plan.vary(kArc, "storage", {"fp32", "unorm16", "unorm8"});
    plan.vary_window(kArc);
    plan.vary_key_lights(kArc, {0, 4, 8, 32, 64});
}

void add_maps(Plan& plan) {
    plan.vary(kPlanar, "map_resolution", {16, 32, 64, 256, 512});
    plan.vary_key_lights(kPlanar, {0, 4, 32});
    plan.vary("planar", "map_resolution", {64, 256, 512});
    plan.vary(kCircle, "map_resolution", {16, 24, 32, 48, 80});
    plan.vary_key_lights(kCircle, {0, 1, 2, 4, 8, 32});
}

/// Bands, ranks and key lights together, for what varying one at a time misses.
void add_grid(Plan& plan) {
    for (const int bands : {3, 8, 16})
        for (const int rank : {4, 8, 16})
            for (const int key_lights : {0, 16, 64}) {
                Setting setting = parse_setting(kArc);
                setting.quality["bands"] = bands;
                setting.quality["rank"] = rank;
                setting.key_lights = key_lights;
                plan.add(setting);
            }
}

}  // namespace

std::vector<Tier> tiers(const diffraction::GrooveLobe& lobe) {
    std::vector<Tier> result = {{"the paper's", kPaper}, {"bins", kBins}, {"transfer", kTransfer}, {"arc", kArc}};
    if (is_flat(lobe)) {
        result.push_back({"planar", kPlanar});
        result.push_back({"circle", kCircle});
    }
    if (has_streak(lobe)) result.push_back({"streak", kStreak});
    return result;
}

std::vector<Setting> sweep_plan(const diffraction::GrooveLobe& lobe) {
    const bool flat = is_flat(lobe);
    Plan plan;
    for (const Tier& tier : tiers(lobe)) plan.add(parse_setting(tier.setting));
    add_spikes(plan, flat);
    add_bins(plan);
    add_transfer(plan, flat);
    add_arc(plan);
    plan.vary_key_lights(kDirect, {4, 16, 64});
    if (flat) add_maps(plan);
    if (has_streak(lobe)) plan.vary(kStreak, "taps", {1, 2, 5, 9});
    add_grid(plan);
    return plan.take();
}

}  // namespace rowland::trade
