// Streaks on the GPU against the CPU's evaluation, and when their map is filled.

#include "modules/diffraction/runtime/gpu_representations.h"
#include "tests/gpu/modules/diffraction/grating_picture.h"

namespace rowland::diffraction {
namespace {

constexpr const char* kNarrowCd = R"({"pitch_nm": 1600, "profile": {"type": "slit", "width_nm": 700},
                                      "groove_lobe": {"sigma": 0.05}})";
constexpr const char* kPitsCd = R"({"pitch_nm": 1500, "profile": {"type": "slit", "width_nm": 700},
                                    "groove_lobe": {"pits": {"length_nm": 850, "coherent": 0.4}}})";
constexpr const char* kStreak = R"({"representation": "streak", "map_resolution": 64})";

/// A dim room with small bright lamps of several colours.
lighting::ProbeImage lamps() {
    image::Image picture;
    picture.width = 256;
    picture.height = 128;
    picture.texels.assign(std::size_t{256} * 128, glm::vec3(0.05F));
    for (int lamp = 0; lamp < 12; ++lamp) {
        const int column = (lamp * 97 + 11) % 250;
        const int row = 8 + (lamp * 37) % 100;
        for (int i = 0; i < 4; ++i)
            for (int j = 0; j < 3; ++j)
                picture.texels[static_cast<std::size_t>((row + j) * 256 + column + i)] =
                    glm::vec3(20.0F + static_cast<float>(lamp), 30.0F - static_cast<float>(lamp), 15.0F);
    }
    return {std::move(picture), lighting::Mapping::Equirectangular};
}

class StreakSurface : public GratingPicture {
 protected:
    static const StreakTables& tables(const CookedMaterial& cooked) { return std::get<StreakTables>(cooked.tables); }

    const ObjectMap& shown_map() { return world_.get<SurfaceState>(entity_).map; }

    StreakMap map(const CookedMaterial& cooked) const {
        return fill_streak_map(*light_.probe_texels, tables(cooked).map);
    }
    static AtPoint streak_of(const Streak& streak, const StreakMap& map) {
        return [streak, shared = std::make_shared<const StreakMap>(map)](const Point& point) {
            return evaluate(streak, *shared, glm::transpose(point.to_tangent), point.view);
        };
    }
    AtPoint narrow(const CookedMaterial& cooked) const { return streak_of(tables(cooked).streak, map(cooked)); }
    AtPoint narrow_error(const CookedMaterial& cooked) const {
        return streak_of(filter_error(tables(cooked).streak), filter_error(map(cooked)));
    }
    void expect_narrow(const CookedMaterial& cooked) { expect_drawn(narrow(cooked), narrow_error(cooked)); }
    /// What the streak leaves of pits, and key lights by the lobe of that.
    std::function<glm::dvec3(const Point&)> rest(const CookedMaterial& cooked) {
        const ArcTable& table = tables(cooked).incoherent.value();
        std::vector<std::vector<glm::dvec3>> products;
        for (std::size_t vertex = 0; vertex < 3; ++vertex)
            products.push_back(light_products(table, vertex_light(vertex, light_.residual, table.bands).coefficients));
        CookedMaterial incoherent = cooked;
        incoherent.material.grating = incoherent_part(cooked.material.grating).value();
        return [this, products, &table, incoherent](const Point& point) {
            std::vector<glm::dvec3> mixed;
            for (std::size_t r = 0; r < products[0].size(); ++r)
                mixed.push_back(mix(point, {products[0][r], products[1][r], products[2][r]}));
            return shade(table, mixed, point.view) + key_light_xyz(incoherent, light_.key_lights, point);
        };
    }
};

TEST_F(StreakSurface, ANarrowLobeEqualsTheCpu) {
    const CookedMaterial cooked = cook(kNarrowCd, kStreak);
    for (const bool with_lamps : {false, true}) {
        SCOPED_TRACE(with_lamps);
        light_ = light_of(with_lamps ? lamps() : smooth_probe(), {}, with_lamps ? 2 : 1);
        show(cooked, 0.3);
        expect_narrow(cooked);
        EXPECT_GT(compared_, 500);
        EXPECT_GT(brightest_, 0.05);
    }
}

TEST_F(StreakSurface, PitsEqualTheCpu) {
    light_ = light_of(lamps(), three_keys());
    const CookedMaterial cooked = cook(
        kPitsCd, R"({"representation": "streak", "map_resolution": 64, "bands": 3, "rank": 6, "view_resolution": 12})");
    show(cooked, -0.4);
    const auto streak = narrow(cooked);
    const auto smooth = rest(cooked);
    const AtPoint expected = [&](const Point& point) { return streak(point) + 0.6 * smooth(point); };
    expect_drawn(expected, narrow_error(cooked));
    // Neither part is small.
    const Point middle = point_at(kSize / 2, kSize / 2);
    EXPECT_GT(glm::length(streak(middle)), 0.005 * brightest_);
    EXPECT_GT(glm::length(smooth(middle)), 0.005 * brightest_);
}

TEST_F(StreakSurface, OrdersOnEitherSideAndOrderZeroEqualTheCpu) {
    light_ = light_of(lamps(), {});
    const CookedMaterial cooked = cook(R"({"pitch_nm": 900, "profile": {"type": "blazed", "depth_nm": 250},
                                           "orders": [-1, 0, 1, 2], "groove_lobe": {"sigma": 0.15}})",
                                       R"({"representation": "streak", "map_resolution": 96})");
    show(cooked, 1.1);
    expect_narrow(cooked);
    EXPECT_GT(brightest_, 0.05);
}

TEST_F(StreakSurface, ANarrowLobeSeesKeyLightsInTheProbeAlone) {
    light_ = light_of(smooth_probe(), three_keys());
    const CookedMaterial cooked = cook(kNarrowCd, kStreak);
    show(cooked);
    expect_narrow(cooked);
}

TEST_F(StreakSurface, GrazingViewsEqualTheCpu) {
    light_ = light_of(lamps(), {});
    mesh_ = flat_triangle();
    look_along_the_surface();
    const CookedMaterial cooked = cook(kNarrowCd, kStreak);
    show(cooked, 0.2);
    expect_narrow(cooked);
}

TEST_F(StreakSurface, AMapIsFilledOncePerProbe) {
    const CookedMaterial cooked = cook(kNarrowCd, kStreak);
    show(cooked);
    draw();
    const auto first = shown_map().shown();
    transform_.rotation = glm::angleAxis(0.4F, glm::vec3(0.0F, 1.0F, 0.0F));
    ++light_.version;  // another sun
    draw();
    EXPECT_EQ(shown_map().shown(), first);
    light_ = light_of(lamps(), {}, light_.version + 1);
    expect_narrow(cooked);
    EXPECT_NE(shown_map().shown(), first);
}

TEST_F(StreakSurface, FramesDoNotWaitForTheFullMap) {
    light_ = light_of(lamps(), {});
    const CookedMaterial cooked = cook(kNarrowCd, kStreak);
    show(cooked, 0.3, MapPace::Incremental);
    const std::vector<glm::vec4> coarse = draw();
    EXPECT_TRUE(shown_map().is_filling());
    while (shown_map().is_filling()) draw();
    const std::vector<glm::vec4> full = draw();
    EXPECT_NE(full, coarse);
    EXPECT_LT(largest_difference(full, narrow(cooked), narrow_error(cooked)), kPictureTolerance);
}

}  // namespace
}  // namespace rowland::diffraction
