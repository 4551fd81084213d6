#include "content/demo/pixel/pixel_meter.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <variant>

#include "content/demo/pixel/whole_probe.h"
#include "modules/diffraction/runtime/light_window.h"

namespace rowland::demo {

namespace {

/// Bands of the light that tables read; 0 if they read none.
int bands_of(const diffraction::BakedTables& tables) {
    return std::visit(
        [](const auto& t) -> int {
            if constexpr (requires { t.bands; }) return t.bands;
            if constexpr (requires { t.rest->bands; }) return t.rest ? t.rest->bands : 0;
            return 0;
        },
        tables);
}

}  // namespace

/// The probe of the last query, and what was derived from it.
struct PixelMeter::Lit {
    PixelProbe source;
    std::optional<diffraction::PointComparer> comparer;
    int most_key_lights = 0;
    std::shared_ptr<const diffraction::CookedMaterial> windowed;  ///< for which `window` was chosen
    math::SphericalWindow window = math::SphericalWindow::None;

    PixelReading measure(const PixelQuery& query) {
        if (!comparer || source != query.probe) {
            comparer.reset();
            WholeProbe probe = load_whole_probe(query.probe.path, query.probe.mapping, query.probe.recipes);
            most_key_lights = probe.key_lights;
            comparer.emplace(std::move(probe.image), probe.key_lights);
            source = query.probe;
            windowed.reset();
        }
        const int key_lights = std::min(query.cooked->material.quality.key_lights, most_key_lights);
        PixelReading reading{.query = query, .key_lights = key_lights, .point = {}};
        if (query.window) {
            reading.window = *query.window;
        } else if (const int bands = bands_of(query.cooked->tables); bands > 0) {
            if (windowed != query.cooked)
                window = diffraction::weakest_window(comparer->harmonics(key_lights, bands), bands);
            windowed = query.cooked;
            reading.window = window;
        }
        reading.point = comparer->compare(query.cooked, reading.window, query.frame);
        return reading;
    }
};

void PixelMeter::poll() {
    if (!lit_) lit_ = std::make_shared<Lit>();
    if (!reading_.wants(wanted_)) {
        failure_.clear();
        reading_.want(wanted_, [lit = lit_, query = wanted_](const auto&, const auto&) {
            return std::optional(lit->measure(*query));
        });
    }
    if (const auto change = reading_.poll(); !change.failure.empty()) failure_ = change.failure;
}

std::string reading_json(const PixelReading& reading) {
    const auto list = [](const glm::dvec3& v) { return nlohmann::json::array({v.x, v.y, v.z}); };
    const nlohmann::json json = {{"representation", info(reading.query.cooked->tables).name},
                                 {"probe", reading.query.probe.path.string()},
                                 {"key_lights", reading.key_lights},
                                 {"window", math::window_name(reading.window)},
                                 {"shown_xyz", list(reading.point.shown)},
                                 {"reference_xyz", list(reading.point.reference)},
                                 {"relative_error", reading.point.error}};
    return json.dump(2) + '\n';
}

}  // namespace rowland::demo
