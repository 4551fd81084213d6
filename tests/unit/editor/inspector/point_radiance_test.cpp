#include "editor/inspector/physics/point_radiance.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <glm/geometric.hpp>
#include <sstream>
#include <string>

#include "editor/inspector/document.h"
#include "engine/colour/observer.h"
#include "engine/core/file.h"
#include "engine/image/load.h"
#include "tests/support/source_tree.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/test_data.h"

namespace rowland::inspector {
namespace {

const std::filesystem::path kMaterials = test::content_path("materials");

/// The frame of a point as the programs read it, and as we do.
const diffraction::ShadingPoint kFrame{.view = {0.2, 0.6, 0.77}, .normal = {0.0, 1.0, 0.1}, .grating = {1.0, 0.0, 0.3}};

/// The numbers of the row that rowland-trade prints.
glm::dvec3 evaluated(const std::string& arguments, const std::filesystem::path& folder) {
    write_file_atomic(folder / "frames.csv", "vx,vy,vz,nx,ny,nz,gx,gy,gz\n0.2,0.6,0.77,0,1,0.1,1,0,0.3\n");
    const std::string output = (folder / "out.csv").string();
    const std::string command = fmt::format("'{}' evaluate {} --frames '{}' > '{}'", ROWLAND_TRADE, arguments,
                                            (folder / "frames.csv").string(), output);
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
    std::istringstream text(read_text_file(output, 1 << 16));
    std::string line;
    std::getline(text, line);
    std::getline(text, line);
    glm::dvec3 xyz(-1.0);
    EXPECT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%lf", &xyz.x, &xyz.y, &xyz.z), 3) << line;
    return xyz;
}

void expect_same(const glm::dvec3& a, const glm::dvec3& b, double relative, const std::string& what) {
    EXPECT_LE(glm::length(a - b), relative * glm::length(b)) << what << ": " << a.y << " and " << b.y;
    EXPECT_GT(b.y, 0.0) << what;
}

// The panes' numbers follow material and probe, and are what the programs print of them.
TEST(PointRadiance, IsWhatEvaluatePrints) {
    ROWLAND_TEST_DATA(venice, "probes/venice_sunset_256.hdr");
    ROWLAND_TEST_DATA(sunset, "probes/pmndrs_sunset.exr");
    const test::TemporaryFolder folder;
    glm::dvec3 last(0.0);
    for (const auto& [material, probe] :
         {std::pair{"cd.json", venice}, std::pair{"dvd.json", venice}, std::pair{"dvd.json", sunset}}) {
        const Document document = Document::open(kMaterials / material);
        const lighting::ProbeImage image(image::load_image(probe), lighting::Mapping::Equirectangular);
        const diffraction::CookedMaterial cooked = diffraction::bake_material(document.material());
        const diffraction::EvaluationLight light(image, 16, math::SphericalWindow::None);
        const PointRadiance point = point_radiance(cooked, image, light, kFrame);

        const std::string of_probe = fmt::format("--probe '{}'", probe.string());
        const std::string source = (kMaterials / material).string();
        // Nine digits are printed.
        expect_same(point.reference,
                    evaluated(fmt::format("--material '{}' {} --method reference", source, of_probe), folder.path()),
                    1e-8, "reference");
        const std::string baked = (folder.path() / "m.material").string();
        ASSERT_EQ(std::system(fmt::format("'{}' cook '{}' --output '{}'", ROWLAND_COOK, source, baked).c_str()), 0);
        expect_same(point.drawn, evaluated(fmt::format("--cooked '{}' {}", baked, of_probe), folder.path()), 1e-8,
                    "drawn");
        EXPECT_GT(glm::distance(point.reference, last), 0.01 * glm::length(last)) << "another probe or material";
        last = point.reference;
    }
}

TEST(PointRadiance, ItsSpectrumIsItsColour) {
    ROWLAND_TEST_DATA(venice, "probes/venice_sunset_256.hdr");
    const Document document = Document::open(kMaterials / "cd.json");
    const lighting::ProbeImage image(image::load_image(venice), lighting::Mapping::Equirectangular);
    const diffraction::CookedMaterial cooked = diffraction::bake_material(document.material());
    const diffraction::EvaluationLight light(image, 16, math::SphericalWindow::None);
    const PointRadiance point = point_radiance(cooked, image, light, kFrame);
    ASSERT_EQ(point.spectrum.size(), 401U);
    glm::dvec3 xyz(0.0);
    for (std::size_t i = 0; i < point.spectrum.size(); ++i) {
        const double weight = i == 0 || i + 1 == point.spectrum.size() ? 0.5 : 1.0;  // trapezoid
        xyz += weight * point.spectrum[i] * colour::cie_xyz(380.0 + static_cast<double>(i));
    }
    // The reference takes finer steps where the probe is sharp, and samples the panels of an arc at other points.
    expect_same(xyz, point.reference, 5e-3, "spectrum");
}

TEST(ViewSweep, TheReferenceAndWhatIsDrawnAreThoseOfAPoint) {
    ROWLAND_TEST_DATA(venice, "probes/venice_sunset_256.hdr");
    const Document document = Document::open(kMaterials / "cd.json");
    const lighting::ProbeImage image(image::load_image(venice), lighting::Mapping::Equirectangular);
    const diffraction::CookedMaterial cooked = diffraction::bake_material(document.material());
    const diffraction::EvaluationLight light(image, 16, math::SphericalWindow::None);
    const ViewSweep sweep = view_sweep(cooked, image, light, kFrame, 5, 9);
    diffraction::ShadingPoint straight = kFrame;
    straight.view = glm::normalize(kFrame.normal);
    const PointRadiance point = point_radiance(cooked, image, light, straight);
    EXPECT_NEAR(sweep.angles_deg[4], 0.0, 1e-12);
    EXPECT_NEAR(sweep.reference[4], point.reference.y, 1e-9 * point.reference.y);
    EXPECT_NEAR(sweep.drawn[4], point.drawn.y, 1e-9 * point.drawn.y);
    EXPECT_GT(std::abs(sweep.harmonics[4] - point.drawn.y), 1e-6 * point.drawn.y);
}

}  // namespace
}  // namespace rowland::inspector
