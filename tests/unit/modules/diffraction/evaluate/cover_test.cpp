// Every representation under a cover (PHYSICS §10) against the reference: no worse than without the cover. The slit's
// efficiencies do not depend on the cover, so all that differs is T(s_n) inside the representation and T(v_n) outside.

#include <algorithm>
#include <vector>

#include "engine/image/image.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/asset/quality.h"
#include "modules/diffraction/evaluate/error_measure.h"
#include "modules/diffraction/evaluate/point_shader.h"
#include "modules/diffraction/reference/reference.h"
#include "tests/support/files.h"

namespace rowland::diffraction {
namespace {

struct ProbeCase {
    std::string name;
    std::string file;
    lighting::Mapping mapping = lighting::Mapping::Equirectangular;
    std::size_t step = 4;  ///< every so many of the named frames
    bool soft = false;
    double covered_circle = 0.01;  ///< what `circle` may be off under a cover, where its series converges slowly
};

nlohmann::json material(bool covered, bool narrow) {
    nlohmann::json json =
        nlohmann::json::parse(R"({"grating": {"pitch_nm": 1600, "profile": {"type": "slit", "width_nm": 800}}})");
    if (narrow) json["grating"]["groove_lobe"]["sigma"] = 0.05;
    if (covered) json["cover"]["ior"] = 1.58;
    return json;
}

/// Those that hold the whole light, and under soft light those whose error is the detail that the light loses. Under a
/// harsh probe that error says nothing of the cover, which changes how much of the lost detail is seen.
std::vector<std::string> methods(SurfaceShape surface, bool narrow, bool soft) {
    std::vector<std::string> names;
    if (narrow)
        names = {"streak"};
    else if (surface == SurfaceShape::Flat)
        names = {"planar/map_resolution=128", "planar/map_resolution=128/key_lights=16"};
    else
        names = {"circle/key_lights=16"};
    if (soft && narrow) names.insert(names.end(), {"arc/bands=5/rank=8/view_resolution=16"});
    if (soft && !narrow)
        names.insert(names.end(), {"spikes/bands=5/spikes=4", "arc/bands=5/rank=8", "arc/bands=12/rank=16",
                                   "arc/bands=8/rank=12/key_lights=16", "direct/key_lights=16"});
    return names;
}

class CoverUnderProbe : public ::testing::TestWithParam<ProbeCase> {
 protected:
    /// The error of a method, bare or covered.
    double error(const std::string& name, bool covered, bool narrow) {
        const Method method = parse_method(name);
        const CookedMaterial cooked = cook(material(covered, narrow), "cover.json", method);
        const EvaluationLight light(*probe_, method.key_lights, method.window);
        return relative_rms(evaluate_baked(cooked, light, frames_), reference_[covered ? 1 : 0]);
    }

    void expect_no_worse(SurfaceShape surface, bool narrow) {
        ROWLAND_TEST_DATA(path, "probes/" + GetParam().file);
        probe_.emplace(image::load_image(path), GetParam().mapping, path.string());
        const std::vector<ShadingPoint> all = measured_frames(surface);
        for (std::size_t i = 0; i < all.size(); i += GetParam().step) frames_.push_back(all[i]);
        for (const bool covered : {false, true})
            reference_[covered ? 1 : 0] =
                reference_radiance(parse_material(material(covered, narrow), "cover.json").grating, *probe_,
                                   colour::LightSpectra(), frames_);
        for (const std::string& name : methods(surface, narrow, GetParam().soft)) {
            const double bare = error(name, false, narrow);
            const double covered = error(name, true, narrow);
            EXPECT_LE(covered, std::max(bare + 0.003, name.starts_with("circle") ? GetParam().covered_circle : 0.01))
                << name << ", bare " << bare;
        }
    }

 private:
    std::optional<lighting::ProbeImage> probe_;
    std::vector<ShadingPoint> frames_;
    std::vector<glm::dvec3> reference_[2];
};

TEST_P(CoverUnderProbe, OnTheDiscErrorsAreThoseWithoutIt) {
    expect_no_worse(SurfaceShape::Flat, false);
}
TEST_P(CoverUnderProbe, OnTheSphereErrorsAreThoseWithoutIt) {
    expect_no_worse(SurfaceShape::Curved, false);
}
TEST_P(CoverUnderProbe, OfANarrowLobeErrorsAreThoseWithoutIt) {
    expect_no_worse(SurfaceShape::Flat, true);
}

INSTANTIATE_TEST_SUITE_P(
    Named, CoverUnderProbe,
    ::testing::Values(ProbeCase{"venice_sunset", "venice_sunset_256.hdr", lighting::Mapping::Equirectangular, 8, true},
                      ProbeCase{"grace", "grace_probe.hdr", lighting::Mapping::Angular},
                      ProbeCase{"ennis", "ennis_probulator.hdr", lighting::Mapping::Equirectangular, 1, false, 0.04},
                      ProbeCase{"blender_sunset", "blender_sunset.exr", lighting::Mapping::Equirectangular, 4, true},
                      ProbeCase{"royal_esplanade", "royal_esplanade_1k.hdr"}),
    [](const auto& one) { return one.param.name; });

}  // namespace
}  // namespace rowland::diffraction
