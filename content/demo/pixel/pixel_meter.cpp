#include "content/demo/pixel/pixel_meter.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>
#include <variant>

#include "engine/core/error.h"
#include "modules/diffraction/runtime/surface_light.h"
#include "modules/diffraction/runtime/vertex_light.h"

namespace rowland::demo {

FullResolutionProbe load_full_resolution_probe(const std::filesystem::path& path, const std::string& mapping,
                                               const std::filesystem::path& recipes) {
    if (path.extension() != ".probe") return lighting::load_full_resolution_probe(path, mapping);
    const std::filesystem::path name = path.stem().replace_extension(".json");
    for (const std::filesystem::path& folder : {recipes, path.parent_path() / "recipes"})
        if (std::filesystem::is_regular_file(folder / name))
            return lighting::load_full_resolution_probe(folder / name, mapping);
    refuse_input(path.string(), "", "a cooked probe without its recipe " + (recipes / name).string(),
                 "the light at full resolution", "give the probe's image or recipe");
}

namespace {

/// SH bands that the tables were baked for; 0 for tables without SH.
int bands_of(const diffraction::BakedTables& tables) {
    return std::visit(
        [](const auto& t) -> int {
            if constexpr (requires { t.bands; }) return t.bands;
            if constexpr (requires { t.incoherent->bands; }) return t.incoherent ? t.incoherent->bands : 0;
            return 0;
        },
        tables);
}

}  // namespace

math::SphericalWindow chosen_window(diffraction::PointComparer& comparer, const diffraction::CookedMaterial& cooked,
                                    diffraction::GrooveLayout layout, int key_lights) {
    const int bands = bands_of(drawn_tables(cooked.tables, layout));
    return bands > 0 ? diffraction::weakest_window(comparer.harmonics(key_lights, bands), bands)
                     : math::SphericalWindow::None;
}

/// The probe of the last query, and what was derived from it.
struct PixelMeter::Lit {
    PixelProbe source;
    std::optional<diffraction::PointComparer> comparer;
    int key_light_limit = 0;
    /// For which `window` was chosen.
    std::pair<std::shared_ptr<const diffraction::CookedMaterial>, diffraction::GrooveLayout> windowed;
    math::SphericalWindow window = math::SphericalWindow::None;

    PixelReading measure(const PixelQuery& query) {
        if (!comparer || source != query.probe) {
            comparer.reset();
            FullResolutionProbe probe =
                load_full_resolution_probe(query.probe.path, query.probe.mapping, query.probe.recipes);
            key_light_limit = probe.key_lights;
            comparer.emplace(std::move(probe.image), probe.key_lights);
            source = query.probe;
            windowed = {};
        }
        const int key_lights = std::min(query.cooked->material.quality.key_lights, key_light_limit);
        PixelReading reading{.query = query, .key_lights = key_lights, .point = {}};
        if (query.window) {
            reading.window = *query.window;
        } else {
            if (std::exchange(windowed, {query.cooked, query.layout}) != std::pair{query.cooked, query.layout})
                window = chosen_window(*comparer, *query.cooked, query.layout, key_lights);
            reading.window = window;
        }
        reading.point = comparer->compare(query.cooked, reading.window, query.frame, query.layout);
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
    const nlohmann::json json = {
        {"representation", drawn_info(reading.query.cooked->tables, reading.query.layout).name},
        {"probe", reading.query.probe.path.string()},
        {"key_lights", reading.key_lights},
        {"window", math::window_name(reading.window)},
        {"shown_xyz", list(reading.point.shown)},
        {"reference_xyz", list(reading.point.reference)},
        {"relative_error", reading.point.error}};
    return json.dump(2) + '\n';
}

}  // namespace rowland::demo
