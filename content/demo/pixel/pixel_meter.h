#pragma once

#include <filesystem>
#include <future>
#include <memory>
#include <optional>
#include <string>

#include "content/demo/looks/background.h"
#include "engine/math/sh_window.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/evaluate/point_comparison.h"
#include "modules/diffraction/model/frame.h"

namespace rowland::demo {

/// The probe that points are measured under.
struct PixelProbe {
    std::filesystem::path path;
    std::string mapping;            ///< of images
    std::filesystem::path recipes;  ///< where cooked probes have theirs
    std::uint64_t version = 0;      ///< grows with every change of its content

    friend bool operator==(const PixelProbe&, const PixelProbe&) = default;
};

/// A point of a grating, as it is shown.
struct PixelQuery {
    std::shared_ptr<const diffraction::CookedMaterial> cooked;
    diffraction::Frame frame;
    /// On tables over harmonics; none: the mildest that does, as the renderer chooses.
    std::optional<math::SphericalWindow> window;
    PixelProbe probe;
};
bool same(const PixelQuery& a, const PixelQuery& b);

struct PixelReading {
    PixelQuery query;
    math::SphericalWindow window = math::SphericalWindow::None;  ///< that was taken
    int key_lights = 0;                                          ///< most that were taken out of the probe
    diffraction::PointComparison point;
};

/// How far a point of the picture is from the reference, measured beside the frames: of several questions that come
/// while one is worked on, the last is answered next.
class PixelMeter {
 public:
    void ask(const PixelQuery& query);
    void forget() { wanted_.reset(); }
    /// Once a frame: takes what is done and begins what is wanted.
    void poll();

    /// The last answer; it may be of an earlier question.
    const std::optional<PixelReading>& reading() const { return reading_; }
    /// Whether the last answer is that of the last question.
    bool current() const;
    /// Why the last question has no answer; empty if it has.
    const std::string& failure() const { return failure_; }

 private:
    struct Lit;
    static PixelReading measure(const std::shared_ptr<Lit>& lit, const PixelQuery& query);

    std::shared_ptr<Lit> lit_;  ///< touched by the worker alone
    std::optional<PixelQuery> wanted_;
    std::optional<PixelQuery> asked_;  ///< of running_
    std::optional<PixelReading> reading_;
    std::optional<PixelQuery> failed_;
    std::string failure_;
    std::future<PixelReading> running_;
    Background background_;
};

/// A reading as JSON: "representation", "probe", "key_lights", "window", "shown_xyz",
/// "reference_xyz" and "relative_error".
std::string reading_json(const PixelReading& reading);

}  // namespace rowland::demo
