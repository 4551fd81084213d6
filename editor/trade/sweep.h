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

#include "editor/trade/film_methods.h"
#include "editor/trade/frame_sets.h"
#include "editor/trade/journal.h"
#include "editor/trade/measure_error.h"
#include "editor/trade/measure_frame.h"
#include "editor/trade/picture_scene.h"
#include "editor/trade/probe_statistics.h"
#include "engine/lighting/probe_image.h"
#include "modules/diffraction/asset/method.h"
#include "modules/diffraction/evaluate/measured_scene.h"
#include "modules/diffraction/representations/representation.h"

namespace rowland::trade {

/// A probe's file and how it covers the sphere.
struct ProbeFile {
    std::filesystem::path path;
    std::string mapping = "auto";
};

/// "FILE" or "FILE:angular" or "FILE:equirect"; without a suffix, `mapping`.
ProbeFile parse_probe_file(const std::string& text, const std::string& mapping);

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

/// What a setting costs with one material, whatever the probe.
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

    /// How many frame times were taken while other programs used more than kLoaded of the processors.
    std::size_t loaded_times() const;
};

/// Measures every setting with every material and probe. Each result is written to a journal in the folder at once, so
/// that the next run in the same folder continues where this one stopped.
class Sweep {
 public:
    /// Loads materials and probes and checks the settings. Throws Error (input).
    explicit Sweep(SweepInputs inputs);

    SweepResults run();

    /// A set under a probe, with the reference of a material. The reference stays valid.
    const diffraction::MeasuredScene& scene(std::size_t material, std::size_t probe, const FrameSet& set);
    diffraction::CookedMaterial cook(std::size_t material, const diffraction::Method& setting) const;
    const PictureFrames& picture_frames() const { return picture_; }
    std::vector<ProbeStatistics> probe_statistics() const;
    /// The methods for thin films, under each probe.
    std::vector<std::vector<FilmRow>> film_rows() const;
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
    std::vector<glm::dvec3> reference(std::size_t material, std::size_t probe,
                                      std::span<const diffraction::ShadingPoint> frames);
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
    std::map<std::tuple<std::size_t, std::size_t, std::string>, diffraction::MeasuredScene> scenes_;
};

/// The CSV files that a material file names. Throws Error (input).
std::vector<std::filesystem::path> files_named_in(const std::filesystem::path& material);

}  // namespace rowland::trade
