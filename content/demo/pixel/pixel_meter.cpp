#include "content/demo/pixel/pixel_meter.h"

#include <nlohmann/json.hpp>
#include <variant>

#include "content/demo/pixel/whole_probe.h"
#include "engine/core/error.h"
#include "modules/diffraction/runtime/light_window.h"

namespace rowland::demo {

namespace {

/// Bands of the light that tables take; 0 where they take none.
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

/// The probe of the last question, and what was derived from it.
struct PixelMeter::Lit {
    PixelProbe source;
    std::optional<diffraction::PointComparer> comparer;
    int key_lights = 0;
    std::shared_ptr<const diffraction::CookedMaterial> windowed;  ///< that `window` was chosen for
    math::SphericalWindow window = math::SphericalWindow::None;
};

bool same(const PixelQuery& a, const PixelQuery& b) {
    return a.cooked == b.cooked && a.probe == b.probe && a.window == b.window && a.frame.view == b.frame.view &&
           a.frame.normal == b.frame.normal && a.frame.grating == b.frame.grating;
}

void PixelMeter::ask(const PixelQuery& query) {
    wanted_ = query;
    if (!failed_ || same(*failed_, query)) return;
    failed_.reset();
    failure_.clear();
}

bool PixelMeter::current() const {
    return wanted_ && reading_ && same(reading_->query, *wanted_);
}

void PixelMeter::poll() {
    if (is_ready(running_)) {
        failure_.clear();
        failed_.reset();
        try {
            reading_ = running_.get();
        } catch (const Error& error) {
            failure_ = error.what();
            failed_ = asked_;
        }
    }
    const bool answered = !wanted_ || current() || (failed_ && same(*failed_, *wanted_));
    if (running_.valid() || answered) return;
    if (!lit_) lit_ = std::make_shared<Lit>();
    asked_ = wanted_;
    running_ = background_.run([lit = lit_, query = *wanted_] { return measure(lit, query); });
}

PixelReading PixelMeter::measure(const std::shared_ptr<Lit>& lit, const PixelQuery& query) {
    if (!lit->comparer || !(lit->source == query.probe)) {
        lit->comparer.reset();
        WholeProbe probe = load_whole_probe(query.probe.path, query.probe.mapping, query.probe.recipes);
        lit->key_lights = probe.key_lights;
        lit->comparer.emplace(std::move(probe.image), probe.key_lights);
        lit->source = query.probe;
        lit->windowed.reset();
    }
    const bool key_lights = query.cooked->material.quality.key_lights;
    PixelReading reading{.query = query, .key_lights = key_lights ? lit->key_lights : 0, .point = {}};
    if (query.window) {
        reading.window = *query.window;
    } else if (const int bands = bands_of(query.cooked->tables); bands > 0) {
        if (lit->windowed != query.cooked)
            lit->window = diffraction::weakest_window(lit->comparer->harmonics(key_lights, bands), bands);
        lit->windowed = query.cooked;
        reading.window = lit->window;
    }
    reading.point = lit->comparer->compare(query.cooked, reading.window, query.frame);
    return reading;
}

std::string reading_json(const PixelReading& reading) {
    const auto list = [](const glm::dvec3& v) { return nlohmann::json::array({v.x, v.y, v.z}); };
    const nlohmann::json json = {
        {"representation", diffraction::representation_name(reading.query.cooked->tables.index())},
        {"probe", reading.query.probe.path.string()},
        {"key_lights", reading.key_lights},
        {"window", math::window_name(reading.window)},
        {"shown_xyz", list(reading.point.shown)},
        {"reference_xyz", list(reading.point.reference)},
        {"relative_error", reading.point.error}};
    return json.dump(2) + '\n';
}

}  // namespace rowland::demo
