#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "editor/trade/frame_sets.h"
#include "editor/trade/journal.h"
#include "editor/trade/measure_error.h"
#include "editor/trade/measure_frame.h"
#include "editor/trade/picture_scene.h"
#include "editor/trade/setting.h"
#include "engine/lighting/probe_image.h"
#include "modules/diffraction/representations/representation.h"

namespace rowland::trade {

/// A probe's file and how it covers the sphere.
struct ProbeFile {
    std::filesystem::path path;
    std::string mapping = "equirect";
};

/// "FILE" or "FILE:angular" or "FILE:equirect"; without a suffix, `mapping`.
ProbeFile parse_probe_file(const std::string& text, const std::string& mapping);

struct SweepInputs {
    std::vector<std::filesystem::path> materials;
    std::vector<ProbeFile> probes;
    std::vector<FrameSet> frame_sets;  ///< beside the picture
    std::vector<Setting> settings;     ///< empty: sweep_plan()
    glm::ivec2 picture_size{160, 90};
    glm::ivec2 frame_size{640, 360};  ///< of timed frames
    bool times = true;                ///< needs a GL device
    std::filesystem::path folder;     ///< of journals and results
};

/// The error of one setting over one set of frames.
struct ErrorRow {
    std::size_t material = 0;
    std::size_t probe = 0;
    std::string set;
    std::size_t setting = 0;
    MethodError error;
};

/// What a setting costs with one material, whatever the probe.
struct CostRow {
    std::size_t material = 0;
    std::size_t setting = 0;
    diffraction::ShadingCost cost;
    std::size_t vertex_bytes = 0;  ///< of light per vertex
    std::optional<FrameTime> time;
};

struct SweepResults {
    std::vector<std::string> materials;  ///< file names without extension
    std::vector<std::string> probes;
    std::vector<std::vector<Setting>> settings;  ///< of each material: those that suit it
    std::vector<ErrorRow> errors;
    std::vector<CostRow> costs;
    std::string device;  ///< that times were taken on; empty: none
};

/// Measures every setting with every material and probe. What is measured is in journals in the folder at once, so that
/// the next run of the same folder goes on where this one stopped.
class Sweep {
 public:
    /// Loads materials and probes. Throws Error (input).
    explicit Sweep(SweepInputs inputs);

    SweepResults run();

    /// XYZ of a set's points by the reference; computed once.
    std::vector<glm::dvec3> reference(std::size_t material, std::size_t probe, const FrameSet& set);
    /// XYZ of a set's points by a setting; computed anew.
    std::vector<glm::dvec3> by_setting(std::size_t material, std::size_t probe, const Setting& setting,
                                       const FrameSet& set);

    const PictureFrames& picture_frames() const { return picture_; }
    const lighting::ProbeImage& probe(std::size_t index) const { return probes_[index].image; }
    diffraction::CookedMaterial cook(std::size_t material, const Setting& setting) const;
    const SweepInputs& inputs() const { return inputs_; }

 private:
    struct MaterialSource {
        nlohmann::json json;
        std::string file;
        std::string hash;
        diffraction::Material parsed;
    };
    struct ProbeSource {
        lighting::ProbeImage image;
        std::string hash;
        lighting::ShLight projected;  ///< once it is asked for
    };
    struct Job {
        std::size_t material = 0;
        std::size_t setting = 0;
        std::size_t probe = 0;
    };

    std::vector<const FrameSet*> sets() const;
    std::string error_key(const Job& job, const Setting& setting, const FrameSet& set) const;
    std::string time_key(std::size_t material, const Setting& setting, const std::string& device) const;
    const diffraction::EvaluationLight& light(std::size_t probe, const Setting& setting);
    void measure_errors(const SweepResults& results);
    void measure_times(SweepResults& results);
    void collect(SweepResults& results);

    SweepInputs inputs_;
    PictureFrames picture_;
    std::vector<MaterialSource> materials_;
    std::vector<ProbeSource> probes_;
    Journal references_;
    Journal results_;
    std::map<std::tuple<std::size_t, int, math::SphericalWindow>, diffraction::EvaluationLight> lights_;
};

/// Bytes of light that a vertex holds for these tables, uploaded whenever the light or the object turns.
std::size_t vertex_light_bytes(const diffraction::BakedTables& tables);

}  // namespace rowland::trade
