#include "modules/diffraction/model/lobe.h"

#include <gtest/gtest.h>

namespace rowland::diffraction {
namespace {

TEST(Lobe, IntegratesToOne) {
    for (const GrooveLobe& lobe :
         {GrooveLobe{FlatLobe{}}, GrooveLobe{GaussianLobe{0.02}}, GrooveLobe{GaussianLobe{0.2}},
          GrooveLobe{GaussianLobe{0.7}}, GrooveLobe{GaussianLobe{50.0}}}) {
        double sum = 0.0;
        const int nodes = 20000;  // midpoint rule: 1e-9 of a bump 0.02 wide
        for (int i = 0; i < nodes; ++i) sum += lobe_density(lobe, (i + 0.5) * 2.0 / nodes - 1.0, 550.0) * 2.0 / nodes;
        EXPECT_NEAR(sum, 1.0, 1e-8);
    }
}

/// exp(−½(s/σ)²) is flat to (1/σ)²/2 at σ = 1e4, and exactly flat in double at 1e9 and beyond.
TEST(Lobe, WideGaussianTendsToFlat) {
    EXPECT_NEAR(lobe_density(GaussianLobe{1e4}, 0.7, 550.0), 0.5, 1e-8);
    EXPECT_NEAR(lobe_density(GaussianLobe{1e150}, 0.7, 550.0), 0.5, 1e-12);
}

TEST(Lobe, NarrowGaussianIsFinite) {
    EXPECT_GT(lobe_density(GaussianLobe{1e-9}, 0.0, 550.0), 1e8);
    EXPECT_EQ(lobe_density(GaussianLobe{1e-9}, 0.1, 550.0), 0.0);
}

TEST(Lobe, IsBelowAnyNoticeBeyondItsHalfWidth) {
    const GaussianLobe lobe{0.1};
    EXPECT_LT(lobe_density(lobe, lobe_half_width(lobe), 550.0), 1e-15 * lobe_density(lobe, 0.0, 550.0));
    EXPECT_EQ(lobe_half_width(GaussianLobe{3.0}), 2.0);
    EXPECT_EQ(lobe_half_width(FlatLobe{}), 2.0);
}

}  // namespace
}  // namespace rowland::diffraction
