#pragma once

#include <optional>

#include "modules/diffraction/representations/arc/arc_table.h"
#include "modules/diffraction/representations/streak/lattice_streak.h"
#include "modules/diffraction/representations/streak/streak.h"

namespace rowland::diffraction {

/// Shades a narrow lobe or a lattice from a map of the whole probe, and the incoherent rest of Stam's pits with an arc
/// table.
struct StreakSurfaceSettings {
    StreakSettings streak;
    std::optional<ArcSettings> rest{};  ///< of incoherent_rest(), if any
    bool lattice = false;

    static const RepresentationInfo& info();
    static StreakSurfaceSettings from(const SettingValues& values, const Grating& grating);
    void set_illuminant(const colour::Illuminant& white);
};

struct StreakTables {
    Streak streak{};
    StreakMapSize map;
    std::optional<LatticeStreak> lattice{};  ///< in place of `streak`
    std::optional<ArcTable> rest{};          ///< of weight 1 − streak.power
};

StreakTables bake(const Grating& grating, const StreakSurfaceSettings& settings);
void write(const StreakTables& tables, ByteWriter& writer);
StreakTables read(ByteReader& reader, const StreakSurfaceSettings& settings);
ShadingCost cost(const StreakTables& tables);
Facts facts(const StreakTables& tables);
/// Throws Error (input) for band-limited light.
PointShader point_shader(const StreakTables& tables, const MaterialKernel& material, const EvaluationLight& light);

}  // namespace rowland::diffraction
