#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/evaluate/search.h"

namespace rowland::diffraction {

/// The settings that a budget chooses from, as members of a material's "quality". `key_light_limit`: the most key
/// lights that a probe has.
std::vector<nlohmann::json> budget_candidates(const Grating& grating, SurfaceShape surface, int key_light_limit);

/// A representation chosen for a material.
struct BudgetChoice {
    nlohmann::json settings;  ///< of budget_candidates()
    CookedMaterial cooked;    ///< baked with them, with the record of the errors and the cheaper rungs
};

/// Constraints of a choice besides the budget.
struct ChoiceRules {
    std::string pointer;  ///< JSON pointer of the material's object, for messages
    /// Whether it is an error if no setting is within max_error. Otherwise the best one is taken, with a warning.
    bool must_meet_budget = true;
    /// The qualities that may be chosen; empty: all.
    std::function<bool(const Quality&)> allows = {};
};

/// The cheapest of budget_candidates() whose error (quality.measure, over the views of each probe) is within the
/// material's quality.max_error under every probe, by search(). The material pins nothing. If the least error that can
/// be reached is above max_error, throws Error (input) naming both and `file`, or warns: must_meet_budget.
BudgetChoice choose_representation(const Material& material, std::span<const BudgetProbe> probes,
                                   std::span<const MeasuredViews> views, const std::string& file,
                                   const ChoiceRules& rules = {});

/// The errors of a material that pins its representation, and its cheaper rungs.
struct PinnedRecord {
    BudgetRecord measured;
    std::vector<CookedRung> cheaper;
};
/// `settings`: the members of the material's "quality" that pin the representation. The cheaper rungs are chosen from
/// the same settings with fewer key lights, an arc table, and key lights alone. nullopt if an error is infinite, as the
/// reference is black. `allows`: see ChoiceRules.
std::optional<PinnedRecord> measure_pinned(const Material& material, const nlohmann::json& settings,
                                           std::span<const BudgetProbe> probes, std::span<const MeasuredViews> views,
                                           const std::function<bool(const Quality&)>& allows = {});

}  // namespace rowland::diffraction
