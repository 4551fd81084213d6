#include "content/demo/pixel/pixel_meter.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <variant>

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/core/json_reader.h"
#include "engine/image/image.h"
#include "engine/lighting/light_probe.h"
#include "engine/lighting/probe_recipe.h"
#include "modules/diffraction/runtime/surface_light.h"

namespace rowland::demo {

namespace {

constexpr std::uint64_t kLargestRecipe = 1 << 20;

WholeProbe from_recipe(const std::filesystem::path& path) {
    const std::string file = path.string();
    const lighting::ProbeRecipe recipe =
        lighting::parse_probe_recipe(parse_json(read_text_file(path, kLargestRecipe), file), file);
    const auto beside = [&](const std::string& name) { return image::load_image(path.parent_path() / name); };
    return {.image = lighting::render_recipe(recipe, beside, file), .key_lights = recipe.settings.key_lights};
}

}  // namespace

WholeProbe load_whole_probe(const std::filesystem::path& path, const std::string& mapping,
                            const std::filesystem::path& recipes) {
    if (path.extension() == ".json") return from_recipe(path);
    if (path.extension() != ".probe")
        return {.image = {image::load_image(path), lighting::parse_mapping(mapping), path.string()},
                .key_lights = lighting::LightProbeSettings().key_lights};
    const std::filesystem::path name = path.stem().replace_extension(".json");
    for (const std::filesystem::path& folder : {recipes, path.parent_path() / "recipes"})
        if (std::filesystem::is_regular_file(folder / name)) return from_recipe(folder / name);
    refuse_input(path.string(), "", "a cooked probe without its recipe " + (recipes / name).string(),
                 "the light at full resolution", "give the probe's image or recipe");
}

namespace {

/// Bands of the light that tables read; 0 if they read none.
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
