#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "engine/core/computed.h"
#include "engine/lighting/probe_recipe.h"
#include "engine/math/spherical_harmonics.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/evaluate/point_shader.h"
#include "modules/diffraction/model/grating.h"

namespace rowland::demo {

using lighting::FullResolutionProbe;

/// The whole probe of an image file (`mapping` "equirect" or "angular") or of a recipe. A cooked probe is replaced by
/// the recipe of the same name in `recipes`, or in the folder "recipes" beside it. Throws Error (input), also if there
/// is no such recipe.
FullResolutionProbe load_full_resolution_probe(const std::filesystem::path& path, const std::string& mapping,
                                               const std::filesystem::path& recipes);

/// The weakest sufficient window for the SH of a material's tables under the comparer's probe less its first
/// `key_lights` key lights, as the renderer chooses it; none for tables without SH.
math::SphericalWindow chosen_window(diffraction::PointComparer& comparer, const diffraction::CookedMaterial& cooked,
                                    diffraction::GrooveLayout layout, int key_lights);

/// The probe under which points are measured.
struct PixelProbe {
    std::filesystem::path path;
    std::string mapping;            ///< of images
    std::filesystem::path recipes;  ///< folder of the recipes of cooked probes
    std::uint64_t version = 0;      ///< grows with every change of its content

    friend bool operator==(const PixelProbe&, const PixelProbe&) = default;
};

/// A point of a grating, as it is shown.
struct PixelQuery {
    std::shared_ptr<const diffraction::CookedMaterial> cooked;
    diffraction::ShadingPoint frame;
    diffraction::GrooveLayout layout;  ///< of the object
    /// Window on the light of tables over harmonics; nullopt: the weakest sufficient one, as the renderer chooses.
    std::optional<math::SphericalWindow> window;
    PixelProbe probe;

    friend bool operator==(const PixelQuery& a, const PixelQuery& b) {
        return a.cooked == b.cooked && a.probe == b.probe && a.window == b.window && a.frame.view == b.frame.view &&
               a.frame.normal == b.frame.normal && a.frame.grating == b.frame.grating && a.layout == b.layout;
    }
};

struct PixelReading {
    PixelQuery query;
    math::SphericalWindow window = math::SphericalWindow::None;  ///< that was applied
    int key_lights = 0;                                          ///< at most so many were separated from the probe
    diffraction::PointComparison point;
};

/// Measures in the background how far a point of the picture is from the reference. Of several queries that come during
/// a measurement, the last is measured next.
class PixelMeter {
 public:
    void ask(const PixelQuery& query) { wanted_ = query; }
    void forget() { wanted_.reset(); }
    /// To be called once per frame: takes the result and starts the next measurement.
    void poll();

    /// The last result, perhaps of an earlier query; null before the first.
    const PixelReading* reading() const { return reading_.value(); }
    bool is_up_to_date() const { return wanted_ && reading_.is_of(*wanted_); }
    /// Why the last query has no result; empty if it has, or may get one.
    const std::string& failure() const { return failure_; }

 private:
    struct Lit;

    std::shared_ptr<Lit> lit_;  ///< used by the background work only
    std::optional<PixelQuery> wanted_;
    std::string failure_;
    Computed<PixelQuery, PixelReading> reading_;
};

/// A reading as JSON: "representation", "probe", "key_lights", "window", "shown_xyz",
/// "reference_xyz" and "relative_error".
std::string reading_json(const PixelReading& reading);

}  // namespace rowland::demo
