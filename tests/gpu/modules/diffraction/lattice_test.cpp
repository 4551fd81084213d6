// Lattices on the GPU against the CPU.

#include "modules/diffraction/runtime/gpu_representations.h"
#include "tests/gpu/modules/diffraction/grating_picture.h"
#include "tests/gpu/render_test.h"

namespace rowland::diffraction {
namespace {

constexpr const char* kCrossedFoil = R"({"lattice": {"a_nm": [1000, 100], "b_nm": [-200, 1200]}, "orders": 2,
    "profile": {"type": "crossed", "along_a": {"type": "blazed", "depth_nm": 200},
                "along_b": {"type": "sinusoidal", "depth_nm": 90}}})";
constexpr const char* kScreen = R"({"lattice": {"a_nm": [4000, 0], "b_nm": [0, 5000]}, "orders": 8,
    "profile": {"type": "aperture", "width_nm": 1500, "height_nm": 4000}})";
/// Of so many orders that their points are joined.
constexpr const char* kCoarseScreen = R"({"lattice": {"a_nm": [40000, 0], "b_nm": [9000, 50000]}, "orders": 6,
    "profile": {"type": "aperture", "width_nm": 15000, "height_nm": 40000}})";
/// Of the picture's maximum: halves, and positions of 8 bits between texels of a picture whose values change by all
/// of their height from one to the next.
constexpr double kPatternTolerance = 1e-2;

class LatticePicture : public GratingPicture {
 protected:
    LatticePicture() { mesh_ = flat_triangle(); }

    static PatternPicture picture_of(const CookedMaterial& cooked) {
        return pattern_picture(cooked.material.grating, colour::LightSpectra());
    }
    /// Half the extent of the pixel in u, along the longer of its sides.
    static double footprint_in_plane(const Point& point, const glm::dvec3& toward) {
        const auto extent = [&](const Point::Change& change) {
            return glm::length(glm::dvec2(glm::dot(toward, change.g), glm::dot(toward, change.h)) + change.view);
        };
        return 0.5 * std::max(extent(point.beside), extent(point.below));
    }

    /// Shows a small map of the whole probe, until the next one.
    const PlanarLobe& show_map(const char* grating) {
        map_.emplace(
            cook(grating, R"({"representation": "planar", "map_resolution": 32, "views_h": 24, "key_lights": 0})"));
        show(*map_, 0.7);
        return *std::get<PlanarTables>(map_->tables).lobe;
    }

 private:
    std::optional<CookedMaterial> map_;
};

TEST_F(LatticePicture, MapsEqualTheCpus) {
    for (const char* grating : {kCrossedFoil, kScreen}) {
        SCOPED_TRACE(grating);
        const PlanarLobe& lobe = show_map(grating);
        const glm::dvec3 normal = glm::transpose(vertex_frame(0))[2];
        expect_map(
            fill_lobe_map(*light_.texels, LobeSpectrum(lobe.pattern, lobe.size.views), normal, lobe.size.azimuths));
    }
}

/// Where g is the same everywhere: of that azimuth alone, whether the pattern is even (kScreen) or not, and of the next
/// one after a turn.
TEST_F(LatticePicture, MapsOfOneAzimuthEqualTheCpus) {
    for (glm::vec4& tangent : mesh_.tangents) tangent = mesh_.tangents[0];
    for (const char* grating : {kCrossedFoil, kScreen}) {
        const PlanarLobe& lobe = show_map(grating);
        for (const float turn : {0.7F, -2.9F}) {
            SCOPED_TRACE(testing::Message() << grating << ", turned by " << turn);
            world_.get<DiffractionSurface>(entity_).groove_rotation = turn;
            rotation_ = double{turn};
            const glm::dmat3 axes = glm::transpose(vertex_frame(0));
            expect_map(fill_lobe_slice(*light_.texels, LobeSpectrum(lobe.pattern, one_azimuth(lobe.size).views),
                                       axes[2], axes[0]));
        }
    }
}

/// On a triangle whose normals vary.
class CurvedLattice : public GratingPicture {};

TEST_F(CurvedLattice, SpikesEqualTheCpus) {
    for (const char* grating : {kCrossedFoil, kCoarseScreen}) {
        const CookedMaterial cooked =
            cook(grating, R"({"representation": "spikes", "bands": 4, "view_resolution": 16})");
        SCOPED_TRACE(grating);
        show(cooked, 0.7);
        expect_drawn(table_xyz<SpikeTable>(cooked, light_.sh));
    }
}

TEST_F(CurvedLattice, MapsForFlatMeshesAreReplacedByArc) {
    const CookedMaterial arc = cook(kCrossedFoil, R"({"representation": "arc", "bands": 4, "key_lights": 0})");
    show(arc, 0.7);
    const std::vector<glm::vec4> by_arc = draw();
    expect_drawn(arc_xyz(arc, light_.sh));
    use(cook(kCrossedFoil, R"({"representation": "planar", "bands": 4, "map_resolution": 32, "key_lights": 0})"));
    EXPECT_EQ(draw(), by_arc);
}

TEST_F(LatticePicture, KeyLightsEqualTheCpu) {
    light_ = light_of(smooth_probe(), three_keys());
    for (const char* grating : {kCrossedFoil, kScreen}) {
        const CookedMaterial cooked = cook(grating, R"({"representation": "direct"})");
        SCOPED_TRACE(grating);
        show(cooked, 0.5);
        const std::vector<LightPicture> pictures =
            key_light_pictures(cooked.material.grating, colour::LightSpectra(), light_.key_lights);
        const auto expected = [&](const Point& point) {
            glm::dvec3 xyz(0.0);
            for (std::size_t i = 0; i < pictures.size(); ++i) {
                const lighting::KeyLight& light = light_.key_lights[i];
                const double mean = lighting::lobe_moments(light.concentration).mean;
                xyz += pattern_radiance(pictures[i], light, std::nullopt, point.to_tangent, glm::dvec2(point.view),
                                        footprint_in_plane(point, mean * light.direction));
            }
            return xyz;
        };
        expect_drawn(expected, nullptr, kPatternTolerance);
    }
}

/// Of two colours: each has a layer of the picture. The second is a disc.
TEST_F(LatticePicture, DirectionalLightsEqualTheCpu) {
    const CookedMaterial cooked = cook(kCrossedFoil, R"({"representation": "direct"})");
    show(cooked, 0.5);
    const PatternPicture picture = picture_of(cooked);
    const glm::dvec3 directions[] = {glm::normalize(glm::vec3(0.5F, 0.4F, 1.0F)),
                                     glm::normalize(glm::vec3(-0.6F, 0.2F, 0.8F))};
    const glm::dvec3 irradiances[] = {glm::dvec3(1.0), glm::dvec3(0.1, 0.3, 2.0)};
    constexpr double kRadii[] = {0.0, 0.04};
    for (int i = 0; i < 2; ++i)
        world_.add(world_.create(), scene::DirectionalLight{.direction = glm::vec3(directions[i]),
                                                            .irradiance = glm::vec3(irradiances[i]),
                                                            .angular_radius = static_cast<float>(kRadii[i])});
    const auto expected = [&](const Point& point) {
        const glm::dvec3 n = glm::transpose(point.to_tangent)[2];
        const glm::dvec3 v = glm::normalize(glm::dvec3(camera_.eye) - point.position);
        glm::dvec3 xyz(0.0);
        for (int i = 0; i < 2; ++i) {
            const DirectLight light{.direction = directions[i], .flux = irradiances[i], .angular_radius = kRadii[i]};
            xyz += pattern_radiance(picture, pattern_light(light, std::nullopt, point.to_tangent),
                                    glm::dvec2(point.view), footprint_in_plane(point, directions[i]));
            xyz += layer_weights(cooked.material.grating).base *
                   rowland::test::reflected(directions[i], n, v, glm::dvec3(0.0), 0.0,
                                            static_cast<double>(cooked.material.base.roughness), kRadii[i]) *
                   (colour::rec709_to_xyz() * irradiances[i]);
        }
        return xyz;
    };
    expect_drawn(expected, nullptr, kPatternTolerance);
    EXPECT_GT(brightest_, 0.05);
}

}  // namespace
}  // namespace rowland::diffraction
