#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "editor/trade/inputs.h"
#include "editor/trade/journal.h"
#include "editor/trade/measure_error.h"
#include "editor/trade/stage.h"
#include "engine/lighting/probe_image.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/asset/quality.h"
#include "modules/diffraction/evaluate/search.h"
#include "modules/diffraction/representations/representation.h"

namespace rowland::trade {

struct SweepInputs {
    std::vector<std::filesystem::path> materials;
    std::vector<ProbeFile> probes;
    std::vector<FrameSet> frame_sets;           ///< besides the picture
    std::vector<diffraction::Method> settings;  ///< empty: sweep_plan()
    glm::ivec2 picture_size{160, 90};
    glm::ivec2 frame_size{640, 360};  ///< of timed frames
    bool times = true;                ///< needs a GL device
    std::filesystem::path folder;     ///< of journals and results
};

/// The error of one setting of one material over one set of frames under one probe.
struct ErrorRow {
    std::size_t material = 0;
    std::size_t probe = 0;
    std::string set;
    std::size_t setting = 0;
    MethodError error{};
};

/// The cost of a setting with one material; it does not depend on the probe.
struct CostRow {
    std::size_t material = 0;
    std::size_t setting = 0;
    diffraction::ShadingCost cost;
    std::optional<FrameTime> time;
};

struct SweepResults {
    std::vector<std::string> materials;  ///< file names without extension
    std::vector<std::string> probes;
    std::vector<std::vector<diffraction::Method>> settings;  ///< of each material: those that suit it
    std::vector<ErrorRow> errors;
    std::vector<CostRow> costs;
    std::string device;  ///< that frames were timed on; empty: none was
};

/// Measures every setting with every material and probe. Writes each result to a journal in the folder at once; the
/// next run in the same folder continues from there.
class Sweep {
 public:
    /// Loads materials and probes and checks the settings. Throws Error (input).
    explicit Sweep(SweepInputs inputs);

    SweepResults run();

    /// A set under a probe, with the ground truth of a material. The returned object lives as long as the sweep.
    const diffraction::MeasuredScene& scene(std::size_t material, std::size_t probe, const FrameSet& set);
    /// Relative RMS error of scalar theory against rigorous theory, both in the reference, whichever theory the
    /// material names; nullopt if rigorous theory does not cover the grating.
    std::optional<double> theory_error(std::size_t material, std::size_t probe, const FrameSet& set);
    /// The material baked with a setting.
    diffraction::CookedMaterial cook(std::size_t material, const diffraction::Method& setting) const;
    const PictureFrames& picture_frames() const { return picture_; }
    const lighting::ProbeImage& probe(std::size_t i) const { return probes_.at(i).image; }
    const SweepInputs& inputs() const { return inputs_; }

 private:
    struct MaterialSource {
        nlohmann::json json;
        std::string file;
        std::string hash;
        diffraction::Material parsed;
        std::vector<diffraction::Method> settings;
    };
    struct ProbeSource {
        lighting::ProbeImage image;
        std::string hash;
        std::shared_ptr<diffraction::ProbeLights> lights{};  ///< of `image`
    };

    const FrameSet& set_named(const std::string& name) const;
    std::vector<ErrorRow> all_rows() const;
    /// `grating`: the material's, or that of its other theory.
    std::vector<glm::dvec3> reference(std::size_t material, const diffraction::Grating& grating, std::size_t probe,
                                      std::span<const diffraction::ShadingPoint> frames);
    const diffraction::MeasuredScene& scene_of(std::size_t material, const diffraction::Grating& grating,
                                               std::size_t probe, const FrameSet& set);
    std::string error_key(const ErrorRow& row) const;
    std::string time_key(std::size_t material, const diffraction::Method& setting, const std::string& device) const;
    void measure_errors(const SweepResults& results);
    void measure_times(SweepResults& results);
    void collect(SweepResults& results);

    SweepInputs inputs_;
    PictureFrames picture_;
    std::vector<MaterialSource> materials_;
    std::vector<ProbeSource> probes_;
    Journal references_;
    Journal results_;
    std::map<std::tuple<std::size_t, diffraction::Theory, std::size_t, std::string>, diffraction::MeasuredScene>
        scenes_;
};

}  // namespace rowland::trade
