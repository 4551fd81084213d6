// The promise about cooked files (content/README.md): version_6.material was written when version 6 was new.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "modules/diffraction/asset/cooked_material.h"

namespace rowland::diffraction {
namespace {

constexpr const char* kSource = R"({
  "grating": { "pitch_nm": 1200, "profile": { "type": "lamellar", "duty": 0.4, "depth_nm": 120 }, "orders": [-1, 1] },
  "metal": "Al",
  "quality": { "representation": "arc", "bands": 2, "rank": 3, "view_resolution": 8 }
})";

TEST(CookedVersion, AMaterialOfThisVersionIsReadAndIsWhatItsSourceStillBakesTo) {
    const CookedMaterial kept = load_cooked_material(ROWLAND_COOKED_MATERIAL);
    const CookedMaterial now = cook_material(nlohmann::json::parse(kSource), "source.json");
    EXPECT_EQ(kept.material.grating.pitch_nm, 1200.0);
    EXPECT_EQ(kept.material.grating.orders, (std::vector<int>{-1, 1}));
    ASSERT_EQ(kept.kernel.antiderivative.size(), now.kernel.antiderivative.size());
    // Single precision; another compiler's mathematics may round another way.
    constexpr double rounding = 1e-6;
    double difference = 0.0;
    double largest = 0.0;
    for (std::size_t i = 0; i < now.kernel.antiderivative.size(); ++i) {
        for (int column = 0; column < 3; ++column) {
            for (int row = 0; row < 3; ++row) {
                const float a = kept.kernel.antiderivative[i][column][row];
                const float b = now.kernel.antiderivative[i][column][row];
                difference = std::max(difference, static_cast<double>(std::abs(a - b)));
                largest = std::max(largest, static_cast<double>(std::abs(b)));
            }
        }
    }
    EXPECT_GT(largest, 0.01);
    EXPECT_LE(difference, rounding * largest) << "the bake has changed: raise kMaterialAssetVersion, keep a new file";
    const auto& table = std::get<ArcTable>(kept.tables);
    const auto& expected = std::get<ArcTable>(now.tables);
    EXPECT_EQ(table.rank, expected.rank);
    EXPECT_EQ(table.grid.columns, expected.grid.columns);
    ASSERT_EQ(table.texels.size(), expected.texels.size());
}

}  // namespace
}  // namespace rowland::diffraction
