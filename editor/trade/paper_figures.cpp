#include "editor/trade/paper_figures.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <variant>

#include "editor/trade/inputs.h"
#include "editor/trade/measure_error.h"
#include "editor/trade/stage.h"
#include "engine/core/log.h"
#include "engine/platform/gl_context.h"
#include "engine/render/scene_lights.h"
#include "modules/diffraction/model/brdf.h"
#include "modules/diffraction/model/profile.h"
#include "modules/diffraction/runtime/surface_light.h"

namespace rowland::trade {

namespace {

using std::numbers::pi;
constexpr int kCurvePoints = 721;
constexpr double kWavelength_nm = 550.0;
constexpr int kShBands = 16;
constexpr float kExposureStops = 0.5F;
constexpr int kSeveralLights = 6;

double sinc2(double x) {
    return x == 0.0 ? 1.0 : std::pow(std::sin(pi * x) / (pi * x), 2.0);
}

double slit_fraction(const diffraction::Grating& grating) {
    const auto* slit = std::get_if<diffraction::SlitProfile>(&grating.profile);
    return slit != nullptr ? slit->width_nm / grating.pitch_nm : 0.5;
}

/// One order's peak over the view's angle, and its width between half heights.
void draw_peak(const diffraction::Grating& grating, Figure2& figure) {
    const double sine = std::min(kWavelength_nm / grating.pitch_nm, 0.99);
    const double degrees_per_order = kWavelength_nm / grating.pitch_nm / std::sqrt(1.0 - sine * sine) * 180.0 / pi;
    const double reach = 3.0 / grating.grooves;  // orders: to the third zero beside the peak
    for (int i = 0; i < kCurvePoints; ++i) {
        const double delta = reach * (2.0 * i / (kCurvePoints - 1) - 1.0);
        figure.peak.x.push_back(delta * degrees_per_order);
        figure.peak.y.push_back(diffraction::fejer(grating.grooves, delta));
    }
    double inside = 0.0;
    double outside = 1.0 / grating.grooves;
    while (outside - inside > 1e-12 / grating.grooves) {
        const double middle = 0.5 * (inside + outside);
        (diffraction::fejer(grating.grooves, middle) > 0.5 ? inside : outside) = middle;
    }
    figure.peak_width_degrees = 2.0 * inside * degrees_per_order;
}

/// Lights around the zenith, a golden angle apart. Their sum does not depend on their number.
std::vector<render::DistantLight> lights_of(int count) {
    std::vector<render::DistantLight> lights;
    const double golden_angle = pi * (3.0 - std::sqrt(5.0));
    for (int i = 0; i < count; ++i) {
        const double y = 0.55 + 0.4 * (i + 0.5) / count;
        const double s = std::sqrt(1.0 - y * y);
        const double angle = 2.2 + i * golden_angle;
        lights.push_back({.direction = glm::vec3(s * std::cos(angle), y, s * std::sin(angle)),
                          .irradiance = glm::vec3(static_cast<float>(2.0 / count))});
    }
    return lights;
}

/// A dark room with the lights as SH, as in the paper.
lighting::LightProbe probe_of(const std::vector<render::DistantLight>& lights) {
    const image::Image black{.width = 8, .height = 4, .texels = std::vector<glm::vec3>(32, glm::vec3(0.0F))};
    lighting::LightProbeSettings settings;
    settings.bands = kShBands;
    settings.key_lights = 0;
    settings.light_face = 4;
    lighting::LightProbe probe =
        lighting::build_light_probe(lighting::ProbeImage(black, lighting::Mapping::Equirectangular), settings);
    diffraction::add_distant_lights(lights, probe.sh);
    probe.ambient = lighting::ambient_coefficients(probe.sh);
    return probe;
}

nlohmann::ordered_json to_json(const Curve& curve) {
    return {{"x", curve.x}, {"y", curve.y}};
}

/// The figures that need a GL device, drawn on one stage.
class PaperStage {
 public:
    PaperStage(const diffraction::CookedMaterial& paper, glm::ivec2 size)
        : context_({.debug = false}),
          size_(size),
          stage_(size, close_camera(), false),
          material_(paper),
          spikes_(stage_.upload(material_)) {}

    nlohmann::ordered_json figure_3() {
        nlohmann::ordered_json figure;
        for (int lights = 1; lights <= 512; lights *= 2) {
            figure["lights"].push_back(lights);
            show_sh(lights);
            figure["sh_fps"].push_back(fps());
            show_loop(lights);
            figure["loop_fps"].push_back(fps());
        }
        return figure;
    }

    nlohmann::ordered_json figure_6() {
        nlohmann::ordered_json figure = {{"several", kSeveralLights}};
        stage_.set_camera(far_camera());
        for (const auto& [name, lights] : {std::pair("one", 1), std::pair("several", kSeveralLights)}) {
            show_sh(lights);
            figure[std::string("sh_") + name] = picture();
            show_loop(lights);
            figure[std::string("direct_") + name] = picture();
        }
        stage_.set_camera(close_camera());
        return figure;
    }

    nlohmann::ordered_json rates() {
        stage_.set_probe(probe_of(lights_of(kSeveralLights)));
        stage_.show_plain();
        nlohmann::ordered_json rates = {{"vertices", stage_.vertices()}, {"plain_fps", fps()}};
        stage_.show_grating(spikes_);
        rates["fps"] = fps();
        rates["fps_with_effects"] = fps(true);
        return rates;
    }

 private:
    void show_loop(int lights) {
        auto loop = std::make_shared<LightLoop>(material_.material.grating,
                                                colour::LightSpectra(material_.material.quality.illuminant),
                                                stage_.xyz_to_working());
        loop->set_lights(lights_of(lights));
        stage_.show_light_loop(loop);
    }

    void show_sh(int lights) {
        stage_.set_probe(probe_of(lights_of(lights)));
        stage_.show_grating(spikes_);
    }

    std::string picture() {
        return data_url({.width = size_.x, .height = size_.y, .rgb = stage_.picture(kExposureStops)});
    }

    /// Of the fastest of some frames.
    double fps(bool effects = false) {
        constexpr int kFrames = 4;
        constexpr double kLongest_ms = 400.0;
        stage_.draw(effects);  // links programs
        double ms = std::numeric_limits<double>::infinity();
        double spent_ms = 0.0;
        for (int i = 0; i < kFrames && spent_ms < kLongest_ms; ++i) {
            const double frame = stage_.draw(effects);
            ms = std::min(ms, frame);
            spent_ms += frame;
        }
        return 1000.0 / ms;
    }

    platform::HeadlessContext context_;
    glm::ivec2 size_;
    Stage stage_;
    diffraction::CookedMaterial material_;
    std::shared_ptr<const diffraction::GpuMaterial> spikes_;
};

}  // namespace

Figure2 figure_2(const diffraction::Grating& grating) {
    Figure2 figure;
    const double fraction = slit_fraction(grating);
    for (int i = 0; i < kCurvePoints; ++i) {
        const double orders = 2.0 * i / (kCurvePoints - 1) - 1.0;
        // The nodes include the whole orders: each peak is one node wide.
        figure.diffraction.x.push_back(orders * pi);
        figure.diffraction.y.push_back(sinc2(fraction * orders) *
                                       diffraction::fejer(grating.grooves, orders - std::round(orders)));
        figure.interference.x.push_back(orders * pi);
        figure.interference.y.push_back(std::pow(std::sin(orders * pi), 2.0));
    }
    draw_peak(grating, figure);
    return figure;
}

nlohmann::ordered_json paper_evidence(const diffraction::CookedMaterial& paper, glm::ivec2 size, bool gpu) {
    const diffraction::Grating& grating = paper.material.grating;
    const Figure2 figure = figure_2(grating);
    nlohmann::ordered_json json;
    json["figure_2"] = {{"diffraction", to_json(figure.diffraction)},
                        {"interference", to_json(figure.interference)},
                        {"peak", to_json(figure.peak)},
                        {"peak_width_degrees", figure.peak_width_degrees},
                        {"grooves", grating.grooves}};
    if (!gpu || grating.lattice || !is_flat(grating.lobe) || grating.cover || grating.transmission) return json;
    Progress progress("the paper's figures", 3);
    PaperStage stage(paper, size);
    json["rates"] = stage.rates();
    progress.advance();
    json["figure_6"] = stage.figure_6();
    progress.advance();
    json["figure_3"] = stage.figure_3();
    progress.advance();
    return json;
}

}  // namespace rowland::trade
