#include "modules/diffraction/foil/pattern.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "engine/core/parallel.h"
#include "modules/diffraction/asset/gltf_extension.h"
#include "modules/diffraction/asset/groove_pitches.h"
#include "modules/diffraction/foil/grating.h"

namespace rowland::diffraction::foil {
namespace {

constexpr Area kArea{.width_px = 160, .height_px = 120, .width_mm = 40.0};

/// The pictures that a type needs: strokes that run up to the right.
std::vector<Brightness> pictures_for(const FoilType& type, const Area& area) {
    Brightness stripes;
    for (int row = 0; row < area.height_px; ++row)
        for (int column = 0; column < area.width_px; ++column)
            stripes.push_back(0.5F + 0.5F * std::sin(0.8F * static_cast<float>(column + row)));
    const std::size_t count = std::holds_alternative<TwoPictures>(type) ? 2 : std::holds_alternative<Own>(type) ? 1 : 0;
    return std::vector<Brightness>(count, stripes);
}

GrooveField field_of(const Foil& foil, const Area& area = kArea) {
    return groove_field(foil, area, pictures_for(foil.type, area));
}

/// The angle between two directions of grooves over π, 0 to ½.
double difference(double a, double b) {
    const double apart = fraction_of(a - b);
    return std::min(apart, 1.0 - apart);
}

std::size_t directions_in(const GrooveField& field, const Area& area) {
    std::set<long> found;
    for (int row = 0; row < area.height_px; ++row)
        for (int column = 0; column < area.width_px; ++column)
            found.insert(std::lround(1e6 * fraction_of(field(column, row).rotation)));
    return found.size();
}

TEST(FoilPattern, EachTypesMaterialCanBeDrawnAndNeverSendsMoreLightThanItGets) {
    for (const std::string_view name : foil_type_names())
        for (const Ink ink : {Ink::Covers, Ink::LetsThrough})
            for (const Under under : {Under::Metal, Under::Paper}) {
                const Foil foil{.type = *foil_type(name)};
                const nlohmann::json json =
                    nlohmann::json::parse(foil_material(foil, {.ink = ink, .under = under}, 0).dump());
                const GltfGrating grating = parse_gltf_extension(json, "card.glb", ReadNamed{}, "");
                const auto texels = groove_texels(kArea, field_of(foil));
                image::ByteImage texture{kArea.width_px, kArea.height_px, {}};
                for (std::size_t i = 0; i < texels.size(); i += 3)
                    for (const std::uint16_t value : {texels[i], texels[i + 1], texels[i + 2], std::uint16_t{65535}}) {
                        texture.rgba16.push_back(value);
                        texture.rgba.push_back(static_cast<std::uint8_t>(value >> 8U));
                    }
                const GroovePitches pitches = groove_pitches(texture);
                EXPECT_NO_THROW(drawable_material(grating, &pitches, "card.glb", "")) << name;
                Grating scalar = grating.material.grating;
                scalar.theory = Theory::Scalar;
                for (double wavelength_nm = 380.0; wavelength_nm <= 780.0; wavelength_nm += 20.0) {
                    double sum = zero_order_efficiency(scalar, wavelength_nm);
                    for (const int order : scalar.orders) sum += order_efficiency(scalar, order, wavelength_nm);
                    EXPECT_LE(sum, 1.0) << name;
                    EXPECT_GT(sum, 0.05) << name;
                }
            }
}

TEST(FoilPattern, TexelsDoNotDependOnTheNumberOfThreads) {
    for (const std::string_view name : foil_type_names()) {
        const Foil foil{.type = *foil_type(name)};
        const auto many = groove_texels(kArea, field_of(foil));
        const ThreadLimit limit(1);
        EXPECT_EQ(groove_texels(kArea, field_of(foil)), many) << name;
    }
}

TEST(FoilPattern, PitchesFitTheTextureAndAreThoseOfTheGrating) {
    for (const std::string_view name : foil_type_names()) {
        const Foil foil{.type = *foil_type(name)};
        const FoilGrating grating = foil_grating(foil);
        const GrooveField field = field_of(foil);
        bool varies = false;
        for (int row = 0; row < kArea.height_px; ++row)
            for (int column = 0; column < kArea.width_px; ++column) {
                const Groove groove = field(column, row);
                if (groove.pitch == 0.0) continue;
                ASSERT_LE(groove.pitch, 2.0) << name;
                ASSERT_GE(groove.pitch * grating.pitch_nm, grating.smallest_pitch_nm * (1.0 - 1e-9)) << name;
                varies = varies || std::abs(groove.pitch - 1.0) > 1e-9;
            }
        EXPECT_EQ(varies, grating.varies_pitch) << name;
    }
}

TEST(FoilPattern, TilesHaveOneDirectionEachOfAsManyAsAsked) {
    const GrooveField field = field_of({.type = Tiles{.size_mm = 4.0, .directions = 5}});
    EXPECT_EQ(directions_in(field, kArea), 5U);
    // A tile is 16 texels wide, and four tiles meet in the middle.
    EXPECT_EQ(field(80, 60).rotation, field(95, 75).rotation);
    EXPECT_NE(field(79, 60).rotation, field(80, 60).rotation);
}

TEST(FoilPattern, CrackedIceHasManyFacetsOfOneDirectionEach) {
    const std::size_t facets = directions_in(field_of({.type = CrackedIce{.size_mm = 5.0}}), kArea);
    EXPECT_GT(facets, 40U);  // 8 × 6 cells and those at the border
    EXPECT_LT(facets, 90U);
    EXPECT_NE(groove_texels(kArea, field_of({.seed = 1})), groove_texels(kArea, field_of({.seed = 2})));
}

TEST(FoilPattern, ARepeatingAreaHasNoSeam) {
    Area area = kArea;
    area.repeats = true;
    for (const FoilType& type : {FoilType(Tiles{.size_mm = 5.3}), FoilType(Hexagons{.size_mm = 5.3}),
                                 FoilType(CrackedIce{.size_mm = 5.3}), FoilType(Cosmos{.size_mm = 5.3})}) {
        const GrooveField field = field_of({.type = type}, area);
        // Beyond an edge the pattern goes on as it begins at the other.
        for (int i = 0; i < area.height_px; ++i)
            ASSERT_NEAR(difference(field(area.width_px + 3, i).rotation, field(3, i).rotation), 0.0, 1e-9)
                << type.index() << " row " << i;
        for (int i = 0; i < area.width_px; ++i)
            ASSERT_NEAR(difference(field(i, area.height_px + 3).rotation, field(i, 3).rotation), 0.0, 1e-9)
                << type.index() << " column " << i;
    }
}

TEST(FoilPattern, RaysAndCirclesAreAtRightAngles) {
    const GrooveField rays = field_of({.type = Radial{.circles = false}});
    const GrooveField circles = field_of({.type = Radial{.circles = true}});
    for (const int column : {10, 60, 150})
        EXPECT_NEAR(difference(rays(column, 20).rotation, circles(column, 20).rotation), 0.5, 1e-12);
    // Above the centre the grating vector of circles points up.
    EXPECT_NEAR(difference(circles(80, 0).rotation, 0.5), 0.0, 0.01);
}

TEST(FoilPattern, PillarsPitchGrowsFromEdgeToEdgeOfABand) {
    const GrooveField field = field_of({.type = Pillars{.band_mm = 10.0, .pitch_range = 1.6}});
    EXPECT_NEAR(field(0, 5).pitch, 1.0, 0.02);
    EXPECT_NEAR(field(39, 5).pitch, 1.6, 0.02);
    EXPECT_NEAR(field(40, 5).pitch, 1.0, 0.02);
    EXPECT_EQ(field(20, 5).pitch, field(20, 100).pitch);
}

TEST(FoilPattern, ALensSendsLightAlongItsNormalToItsFocus) {
    const Lens lens{.focal_mm = 30.0};
    const Foil foil{.type = lens};
    const GrooveField field = field_of(foil);
    const glm::dvec2 centre = 0.5 * glm::dvec2(kArea.width_mm, kArea.height_mm());
    for (const glm::ivec2 texel : {glm::ivec2(150, 60), glm::ivec2(100, 110), glm::ivec2(30, 20)}) {
        const glm::dvec2 from = kArea.position_mm(texel.x, texel.y) - centre;
        const Groove groove = field(texel.x, texel.y);
        const double pitch_nm = groove.pitch * foil_grating(foil).pitch_nm;
        const double r = std::hypot(from.x, from.y);
        if (kMiddleWavelength_nm / (r / std::hypot(r, lens.focal_mm)) < foil_grating(foil).smallest_pitch_nm) continue;
        EXPECT_NEAR(kMiddleWavelength_nm / pitch_nm, r / std::hypot(r, lens.focal_mm), 1e-9);
        EXPECT_NEAR(difference(groove.rotation, std::atan2(from.y, from.x) / std::numbers::pi), 0.0, 1e-9);
    }
    EXPECT_EQ(field(80, 60).pitch, 0.0) << "too coarse in the middle";
}

TEST(FoilPattern, OwnGroovesRunAlongTheStrokes) {
    const GrooveField field = field_of({.type = Own{.drawing = "d", .smooth_mm = 2.0}});
    // The stripes run where column + row is constant, up to the right: the grating vector points down to the right.
    for (const glm::ivec2 texel : {glm::ivec2(40, 40), glm::ivec2(80, 60), glm::ivec2(120, 90)})
        EXPECT_NEAR(difference(field(texel.x, texel.y).rotation, -0.25), 0.0, 0.01);
}

TEST(FoilPattern, TexelsWithoutFoilHaveNoGrating) {
    std::vector<std::uint8_t> has_foil(static_cast<std::size_t>(kArea.width_px * kArea.height_px), 0);
    has_foil[5] = 1;
    const auto texels = groove_texels(kArea, field_of({.type = Rainbow{}}), has_foil);
    EXPECT_EQ(texels[3 * 4 + 1], 0);
    EXPECT_EQ(texels[3 * 5 + 1], 32768);
    EXPECT_EQ(texels[std::size_t{3} * 5], 32768);
}

}  // namespace
}  // namespace rowland::diffraction::foil
