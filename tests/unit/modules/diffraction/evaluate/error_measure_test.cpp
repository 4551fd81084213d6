
#include <cmath>
#include <glm/geometric.hpp>

#include "engine/colour/colour_difference.h"
#include "engine/colour/colour_space.h"
#include "modules/diffraction/evaluate/error_measure.h"
#include "modules/diffraction/evaluate/point_shader.h"
#include "tests/support/csv.h"
#include "tests/support/files.h"

namespace rowland::diffraction {
namespace {

std::vector<glm::dvec3> shades(std::size_t count) {
    std::vector<glm::dvec3> xyz;
    for (std::size_t i = 0; i < count; ++i)
        xyz.push_back((1.0 + std::sin(0.37 * static_cast<double>(i))) * glm::dvec3(0.5, 0.4, 0.9));
    return xyz;
}

TEST(ErrorMeasure, ExposureBringsTheMeanOfWhatIsLitToMiddleGrey) {
    std::vector<glm::dvec3> xyz(4, 0.36 * colour::white_d65());
    EXPECT_NEAR(exposure_for(xyz), -1.0F, 1e-6F);
    xyz.resize(8, glm::dvec3(0.0));
    EXPECT_NEAR(exposure_for(xyz), -1.0F, 1e-6F);
    EXPECT_EQ(exposure_for(std::vector<glm::dvec3>(3, glm::dvec3(0.0))), 0.0F);
}

TEST(ErrorMeasure, AQuantileIsTheValueThatSoManyDoNotExceed) {
    EXPECT_EQ(quantile({}, 0.5), 0.0);
    EXPECT_EQ(quantile({3.0, 1.0, 2.0}, 0.5), 2.0);
    EXPECT_EQ(quantile({3.0, 1.0, 2.0, 0.0}, 0.5), 1.0);
    EXPECT_EQ(quantile({3.0, 1.0, 2.0}, 0.95), 3.0);
    EXPECT_EQ(quantile({3.0, 1.0, 2.0}, 0.0), 1.0);
}

/// Of 100 greys at the exposure's middle, 90 are right, 6 are brighter and 4 much brighter: 5 % may be worse.
TEST(ErrorMeasure, DeltaEIsWhatNineteenOfTwentyPointsDoNotExceed) {
    const ErrorFunction error = error_function(ErrorMeasure::DeltaE, SurfaceShape::Flat);
    const glm::dvec3 grey = 0.18 * colour::white_d65();
    const std::vector<glm::dvec3> reference(100, 1000.0 * grey);
    std::vector<glm::dvec3> shown = reference;
    for (std::size_t i = 90; i < 96; ++i) shown[i] *= 1.2;
    for (std::size_t i = 96; i < 100; ++i) shown[i] *= 3.0;
    const auto lab = [&](double factor) { return colour::xyz_to_lab(factor * grey, colour::white_d65()); };
    // The exposure is a float of about -10 stops: 1e-6 of the light.
    EXPECT_NEAR(error(shown, reference), colour::delta_e_2000(lab(1.2), lab(1.0)), 1e-4);
    EXPECT_EQ(error(reference, reference), 0.0);
    // All that is brighter than the display looks the same.
    EXPECT_NEAR(error(std::vector(100, 1e4 * grey), std::vector(100, 1000.0 * grey)),
                colour::delta_e_2000(lab(1.0 / 0.18), lab(1.0)), 1e-4);
}

TEST(ErrorMeasure, FlipIsTheMeanOfTheMapWhereThePictureSeesTheSurface) {
    for (const SurfaceShape surface : {SurfaceShape::Flat, SurfaceShape::Curved}) {
        const PictureLayout layout = measured_picture(surface).layout;
        const std::vector<glm::dvec3> reference = shades(layout.pixels.size());
        std::vector<glm::dvec3> shown = reference;
        for (std::size_t i = 0; i < shown.size(); i += 3) shown[i] = glm::dvec3(0.4, 0.8, 0.3);
        std::vector<glm::dvec3> shown_pixels(std::size_t{16} * 16, glm::dvec3(0.0));
        std::vector<glm::dvec3> reference_pixels = shown_pixels;
        for (std::size_t i = 0; i < shown.size(); ++i) {
            shown_pixels[layout.pixels[i]] = shown[i];
            reference_pixels[layout.pixels[i]] = reference[i];
        }
        const std::vector<double> map = colour::hdr_flip(shown_pixels, reference_pixels, 16, 16);
        double sum = 0.0;
        for (const std::size_t pixel : layout.pixels) sum += map[pixel];
        const ErrorFunction error = error_function(ErrorMeasure::HdrFlip, surface);
        const double mean = sum / static_cast<double>(layout.pixels.size());
        EXPECT_GT(mean, 0.05);
        EXPECT_DOUBLE_EQ(error(shown, reference), mean);
        EXPECT_EQ(error(reference, reference), 0.0);
    }
}

/// Back from each point along its view, all rays meet in one eye, three radii away; the points are on the surface.
TEST(MeasuredPicture, IsOfADiscOrASphereFromThreeRadii) {
    const glm::dvec3 above = 3.0 * glm::normalize(glm::dvec3(0.0, 1.0, 1.0));
    for (const auto& [surface, eye] :
         {std::pair{SurfaceShape::Flat, above}, std::pair{SurfaceShape::Curved, glm::dvec3(0.0, 0.0, 3.0)}}) {
        const MeasuredPicture seen = measured_picture(surface);
        EXPECT_GT(seen.points.size(), 16U * 16U / 3U);
        for (const ShadingPoint& point : seen.points) {
            EXPECT_TRUE(is_valid(point));
            EXPECT_GE(glm::dot(point.view, point.normal), 0.1);
            EXPECT_NEAR(glm::dot(point.grating, point.normal), 0.0, 1e-12);
            // The disc's point lies along its grating vector, the sphere's along its normal.
            const glm::dvec3 outward = surface == SurfaceShape::Flat ? point.grating : point.normal;
            const glm::dvec3 axis = glm::normalize(glm::cross(eye, point.view));
            EXPECT_NEAR(glm::dot(axis, outward), 0.0, 1e-9) << "eye, view and point are in one plane";
            const double angle = std::acos(glm::dot(glm::normalize(eye), point.view));
            if (surface == SurfaceShape::Curved) {
                EXPECT_NEAR(3.0 * std::sin(angle), glm::length(glm::cross(outward, point.view)), 1e-9);
            }
        }
    }
}

void expect_set(const std::vector<ShadingPoint>& frames, const std::filesystem::path& path) {
    const test::Csv csv = test::read_csv(path);
    ASSERT_EQ(frames.size(), csv.rows.size());
    for (std::size_t i = 0; i < frames.size(); ++i) {
        EXPECT_EQ(frames[i].view, glm::dvec3(csv.number(i, "vx"), csv.number(i, "vy"), csv.number(i, "vz")));
        EXPECT_EQ(frames[i].normal, glm::dvec3(csv.number(i, "nx"), csv.number(i, "ny"), csv.number(i, "nz")));
        EXPECT_EQ(frames[i].grating, glm::dvec3(csv.number(i, "gx"), csv.number(i, "gy"), csv.number(i, "gz")));
    }
}

TEST(FrameSets, AreTheNamedOnes) {
    ROWLAND_TEST_DATA(disc, "oracle/frames_tilted_cd.csv");
    expect_set(measured_frames(SurfaceShape::Flat), disc);
    ROWLAND_TEST_DATA(sphere, "oracle/frames_sphere.csv");
    expect_set(measured_frames(SurfaceShape::Curved), sphere);
}

/// Dark but for one texel, toward +X.
lighting::ProbeImage one_texel() {
    image::Image image{.width = 64, .height = 32, .texels = std::vector(std::size_t{64} * 32, glm::vec3(0.01F))};
    image.texels[15 * 64 + 48] = glm::vec3(100.0F);
    return {std::move(image), lighting::Mapping::Equirectangular};
}

Material measured_material(double pitch_nm, SurfaceShape surface, ErrorMeasure measure = ErrorMeasure::RelativeRms) {
    Material material;
    material.grating = {.pitch_nm = pitch_nm, .profile = SlitProfile{300.0}};
    material.quality.surface = surface;
    material.quality.measure = measure;
    return material;
}

TEST(DrawnViews, SeeBothSidesAndAimAtWhatIsBright) {
    const lighting::ProbeImage probe = one_texel();
    for (const SurfaceShape surface : {SurfaceShape::Flat, SurfaceShape::Curved}) {
        const MeasuredViews views = drawn_views(measured_material(1600.0, surface), probe);
        ASSERT_EQ(views.parts.size(), kViewParts);
        EXPECT_EQ(views.points(), 240U);
        glm::dvec3 mean(0.0);
        int aimed = 0;
        for (const std::vector<ShadingPoint>& part : views.parts)
            for (const ShadingPoint& point : part) {
                EXPECT_TRUE(is_valid(point));
                EXPECT_NEAR(glm::dot(point.grating, point.normal), 0.0, 1e-9);
                EXPECT_GE(glm::dot(point.view, point.normal), 0.1 - 1e-9);
                mean += point.normal / 240.0;
                const glm::dvec3 lamp = glm::dvec3(1.0, 0.0, 0.0) - point.normal.x * point.normal;
                aimed += glm::dot(point.grating, lamp) > 0.99 * glm::length(lamp) ? 1 : 0;
            }
        EXPECT_LT(glm::length(mean), 1e-9) << "each normal has its opposite";
        EXPECT_GE(aimed, 48);
        EXPECT_LT(aimed, 70);
    }
}

TEST(DrawnViews, FollowTheMaterial) {
    const lighting::ProbeImage probe = one_texel();
    const auto first = [&](const Material& material) { return drawn_views(material, probe).parts[0][1]; };
    const Material disc = measured_material(1600.0, SurfaceShape::Flat);
    EXPECT_EQ(first(disc).view, first(disc).view);
    EXPECT_NE(first(disc).view, first(measured_material(1500.0, SurfaceShape::Flat)).view);
    EXPECT_EQ(drawn_views(disc, probe).layout, GrooveLayout::Flat);
    Material screen = disc;
    screen.grating.lattice = Lattice{.a_nm = {1e4, 0.0}, .b_nm = {0.0, 1e4}, .profile = ApertureProfile{5e3, 5e3}};
    const MeasuredViews card = drawn_views(screen, probe);
    EXPECT_EQ(card.layout, GrooveLayout::FlatUniform);
    EXPECT_EQ(layout_of(std::span(card.parts[0]).first(5)), GrooveLayout::FlatUniform) << "a pose has one g";
    const MeasuredViews pictures =
        drawn_views(measured_material(1600.0, SurfaceShape::Curved, ErrorMeasure::HdrFlip), probe);
    ASSERT_EQ(pictures.parts.size(), kViewParts);
    EXPECT_EQ(pictures.parts[0].size(), measured_picture(SurfaceShape::Curved).layout.pixels.size());
    EXPECT_NE(pictures.parts[0][0].view, pictures.parts[1][0].view);
}

}  // namespace
}  // namespace rowland::diffraction
