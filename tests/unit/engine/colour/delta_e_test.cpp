#include "engine/colour/delta_e.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/colour/working_space.h"

namespace rowland::colour {
namespace {

struct Pair {
    glm::dvec3 lab_1;
    glm::dvec3 lab_2;
    double difference;
};

/// From table 1 of Sharma, Wu & Dalal 2005, which is made of the formula's pitfalls.
constexpr Pair kPublished[] = {
    {{50.0, 2.6772, -79.7751}, {50.0, 0.0, -82.7485}, 2.0425},
    {{50.0, 3.1571, -77.2803}, {50.0, 0.0, -82.7485}, 2.8615},
    {{50.0, 2.8361, -74.0200}, {50.0, 0.0, -82.7485}, 3.4412},
    {{50.0, -1.3802, -84.2814}, {50.0, 0.0, -82.7485}, 1.0000},
    {{50.0, 0.0, 0.0}, {50.0, -1.0, 2.0}, 2.3669},
    {{50.0, 2.4900, -0.0010}, {50.0, -2.4900, 0.0009}, 7.1792},
    {{50.0, 2.4900, -0.0010}, {50.0, -2.4900, 0.0011}, 7.2195},
    {{50.0, -0.0010, 2.4900}, {50.0, 0.0009, -2.4900}, 4.8045},
    {{50.0, -0.0010, 2.4900}, {50.0, 0.0011, -2.4900}, 4.7461},
    {{50.0, 2.5, 0.0}, {50.0, 0.0, -2.5}, 4.3065},
    {{50.0, 2.5, 0.0}, {73.0, 25.0, -18.0}, 27.1492},
    {{50.0, 2.5, 0.0}, {61.0, -5.0, 29.0}, 22.8977},
    {{50.0, 2.5, 0.0}, {56.0, -27.0, -3.0}, 31.9030},
    {{50.0, 2.5, 0.0}, {58.0, 24.0, 15.0}, 19.4535},
    {{60.2574, -34.0099, 36.2677}, {60.4626, -34.1751, 39.4387}, 1.2644},
    {{63.0109, -31.0961, -5.8663}, {62.8187, -29.7946, -4.0864}, 1.2630},
    {{2.0776, 0.0795, -1.1350}, {0.9033, -0.0636, -0.5514}, 0.9082},
};

TEST(DeltaE2000, AgreesWithPublishedPairs) {
    for (const Pair& pair : kPublished) {
        const double found = delta_e_2000(pair.lab_1, pair.lab_2);
        EXPECT_NEAR(found, pair.difference, 0.5001e-4) << "four digits are printed";
        EXPECT_NEAR(delta_e_2000(pair.lab_2, pair.lab_1), found, 1e-12);
    }
}

TEST(DeltaE2000, IsZeroForEqualColours) {
    EXPECT_EQ(delta_e_2000({50.0, 10.0, -20.0}, {50.0, 10.0, -20.0}), 0.0);
}

TEST(Lab, WhiteIsOneHundredAndGreysHaveNoChroma) {
    const glm::dvec3 white = white_d65();
    const glm::dvec3 lab = xyz_to_lab(white, white);
    EXPECT_NEAR(lab.x, 100.0, 1e-12);
    const glm::dvec3 grey = xyz_to_lab(0.184186518 * white, white);  // L* = 50: ((50+16)/116)^3
    EXPECT_NEAR(grey.x, 50.0, 1e-6);
    EXPECT_NEAR(std::hypot(grey.y, grey.z), 0.0, 1e-12);
    EXPECT_LT(xyz_to_lab(-0.001 * white, white).x, 0.0);
}

}  // namespace
}  // namespace rowland::colour
