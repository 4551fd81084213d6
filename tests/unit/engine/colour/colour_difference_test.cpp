#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/matrix.hpp>
#include <numbers>
#include <random>

#include "engine/colour/colour_difference.h"
#include "engine/colour/colour_space.h"

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

using Pixels = std::vector<glm::dvec3>;

constexpr int kFlipWidth = 23;
constexpr int kFlipHeight = 14;
constexpr std::size_t kFlipPixels = std::size_t{kFlipWidth} * kFlipHeight;

Pixels uniform(const glm::dvec3& rgb) {
    return Pixels(kFlipPixels, rgb);
}

/// Noise over two halves of different colour.
Pixels picture(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> noise(0.0, 0.4);
    Pixels result;
    for (std::size_t i = 0; i < kFlipPixels; ++i) {
        const glm::dvec3 base = i % kFlipWidth < 11 ? glm::dvec3(0.6, 0.3, 0.1) : glm::dvec3(0.05, 0.2, 0.5);
        result.push_back(base + glm::dvec3(noise(random), noise(random), noise(random)));
    }
    return result;
}

/// Sum over a square of pixels around (x, y), weighted by kernel(dx, dy); the picture's edges continue outward.
template <typename Value, typename Kernel>
auto convolved(const std::vector<Value>& values, int x, int y, int radius, const Kernel& kernel) {
    Value sum(0.0);
    for (int dy = -radius; dy <= radius; ++dy)
        for (int dx = -radius; dx <= radius; ++dx) {
            const int column = std::clamp(x + dx, 0, kFlipWidth - 1);
            const int row = std::clamp(y + dy, 0, kFlipHeight - 1);
            sum += kernel(dx, dy) * values[static_cast<std::size_t>(row * kFlipWidth + column)];
        }
    return sum;
}

/// ꟻLIP as its paper writes it: whole kernels, one pixel at a time.
class SlowFlip {
 public:
    explicit SlowFlip(double pixels_per_degree) : ppd_(pixels_per_degree) {}

    double at(const Pixels& a, const Pixels& b, int x, int y) const {
        const double largest = std::pow(distance(lab({0, 1, 0}), lab({0, 0, 1})), 0.7);
        const double colour = std::pow(distance(lab(seen(a, x, y)), lab(seen(b, x, y))), 0.7);
        const double knee = 0.4 * largest;
        const double mapped = colour < knee ? 0.95 / knee * colour : 0.95 + (colour - knee) / (largest - knee) * 0.05;
        const double edges = std::abs(feature(a, x, y, false) - feature(b, x, y, false));
        const double points = std::abs(feature(a, x, y, true) - feature(b, x, y, true));
        return std::pow(mapped, 1.0 - std::pow(std::max(edges, points) / std::sqrt(2.0), 0.5));
    }

 private:
    static glm::dvec3 white() { return rec709_to_xyz() * glm::dvec3(1.0); }
    static glm::dvec3 lab(const glm::dvec3& rgb) {
        const glm::dvec3 lab = xyz_to_lab(rec709_to_xyz() * rgb, white());
        return {lab.x, 0.01 * lab.x * lab.y, 0.01 * lab.x * lab.z};
    }
    static double distance(const glm::dvec3& a, const glm::dvec3& b) {
        return std::abs(a.x - b.x) + std::sqrt((a.y - b.y) * (a.y - b.y) + (a.z - b.z) * (a.z - b.z));
    }

    glm::dvec3 seen(const Pixels& pixels, int x, int y) const {
        constexpr double kPi2 = std::numbers::pi * std::numbers::pi;
        const int radius = static_cast<int>(std::ceil(3.0 * std::sqrt(0.04 / (2.0 * kPi2)) * ppd_));
        Pixels opponent;
        for (const glm::dvec3& rgb : pixels) {
            const glm::dvec3 xyz = rec709_to_xyz() * rgb / white();
            opponent.push_back({116.0 * xyz.y - 16.0, 500.0 * (xyz.x - xyz.y), 200.0 * (xyz.y - xyz.z)});
        }
        const auto sensitivity = [&](int dx, int dy) {
            const double d2 = (dx * dx + dy * dy) / (ppd_ * ppd_);
            const auto gaussian = [&](double a, double b) {
                return a * std::sqrt(std::numbers::pi / b) * std::exp(-kPi2 * d2 / b);
            };
            return glm::dvec3(gaussian(1.0, 0.0047), gaussian(1.0, 0.0053),
                              gaussian(34.1, 0.04) + gaussian(13.5, 0.025));
        };
        glm::dvec3 total(0.0);
        for (int dy = -radius; dy <= radius; ++dy)
            for (int dx = -radius; dx <= radius; ++dx) total += sensitivity(dx, dy);
        const glm::dvec3 c = convolved(opponent, x, y, radius, sensitivity) / total;
        const double relative_y = (c.x + 16.0) / 116.0;
        const glm::dvec3 xyz = white() * glm::dvec3(c.y / 500.0 + relative_y, relative_y, relative_y - c.z / 200.0);
        return glm::clamp(glm::inverse(rec709_to_xyz()) * xyz, 0.0, 1.0);
    }

    double feature(const Pixels& pixels, int x, int y, bool point) const {
        const double deviation = 0.5 * 0.082 * ppd_;
        const int radius = static_cast<int>(std::ceil(3.0 * deviation));
        const auto shape = [&](int along, int across) {
            const double s = along / deviation;
            return (point ? s * s - 1.0 : -s) *
                   std::exp(-0.5 * (along * along + across * across) / (deviation * deviation));
        };
        double positive = 0.0;
        double negative = 0.0;
        for (int dy = -radius; dy <= radius; ++dy)
            for (int dx = -radius; dx <= radius; ++dx)
                (shape(dx, dy) > 0.0 ? positive : negative) += std::abs(shape(dx, dy));
        const auto kernel = [&](int along, int across) {
            const double value = shape(along, across);
            return value / (value > 0.0 ? positive : negative);
        };
        std::vector<double> luminance;
        for (const glm::dvec3& rgb : pixels) luminance.push_back((rec709_to_xyz() * rgb).y / white().y);
        return std::hypot(convolved(luminance, x, y, radius, [&](int dx, int dy) { return kernel(dx, dy); }),
                          convolved(luminance, x, y, radius, [&](int dx, int dy) { return kernel(dy, dx); }));
    }

    double ppd_;
};

TEST(Flip, IsWhatItsPaperWrites) {
    const Pixels a = picture(1);
    const Pixels b = picture(2);
    for (const double pixels_per_degree : {kPixelsPerDegree, 20.0}) {
        const std::vector<double> map = flip(a, b, kFlipWidth, kFlipHeight, pixels_per_degree);
        for (const auto& [x, y] : {std::pair(0, 0), {22, 13}, {11, 7}, {10, 3}, {5, 12}})
            EXPECT_NEAR(map[static_cast<std::size_t>(y * kFlipWidth + x)], SlowFlip(pixels_per_degree).at(a, b, x, y),
                        1e-9)
                << x << ' ' << y;
    }
}

TEST(Flip, OfUniformPicturesIsOfTheirColours) {
    const auto of = [](const glm::dvec3& a, const glm::dvec3& b) {
        return flip(uniform(a), uniform(b), kFlipWidth, kFlipHeight)[40];
    };
    EXPECT_EQ(of({0.2, 0.5, 0.9}, {0.2, 0.5, 0.9}), 0.0);
    EXPECT_NEAR(of({0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}), 1.0, 1e-9) << "the largest difference there is";
    EXPECT_NEAR(of({1.0, 1.0, 1.0}, {0.0, 0.0, 0.0}), 0.9674, 1e-3);
    EXPECT_NEAR(of({0.5, 0.5, 0.5}, {0.51, 0.51, 0.51}), of({0.51, 0.51, 0.51}, {0.5, 0.5, 0.5}), 1e-12);
}

Pixels in_xyz(const Pixels& rgb, double scale) {
    Pixels xyz;
    for (const glm::dvec3& value : rgb) xyz.push_back(scale * (rec709_to_xyz() * value));
    return xyz;
}

TEST(HdrFlip, DoesNotDependOnTheUnitOfLight) {
    const auto once = hdr_flip(in_xyz(picture(1), 1.0), in_xyz(picture(2), 1.0), kFlipWidth, kFlipHeight);
    const auto brighter = hdr_flip(in_xyz(picture(1), 4000.0), in_xyz(picture(2), 4000.0), kFlipWidth, kFlipHeight);
    for (std::size_t i = 0; i < kFlipPixels; ++i) EXPECT_NEAR(once[i], brighter[i], 1e-9);
}

TEST(HdrFlip, SeesHighlightsAndWhatIsDim) {
    // A lamp's reflection a thousand times as bright as the rest; half the pixels are background.
    Pixels reference = uniform(glm::dvec3(0.1));
    for (std::size_t i = 0; i < kFlipPixels / 2; ++i) reference[i] = glm::dvec3(0.0);
    const std::size_t lamp = kFlipPixels - std::size_t{5} * kFlipWidth - 8;
    reference[lamp] = glm::dvec3(100.0);
    Pixels dimmer_lamp = reference;
    dimmer_lamp[lamp] *= 0.5;
    Pixels dimmer_rest = reference;
    for (std::size_t i = kFlipPixels / 2; i < kFlipPixels; ++i)
        if (i != lamp) dimmer_rest[i] *= 0.5;
    const auto at = [&](const Pixels& changed, std::size_t pixel) {
        return hdr_flip(in_xyz(changed, 1.0), in_xyz(reference, 1.0), kFlipWidth, kFlipHeight)[pixel];
    };
    EXPECT_GT(at(dimmer_lamp, lamp), 0.02);
    EXPECT_GT(at(dimmer_rest, kFlipPixels - 1), 0.1);
    EXPECT_LT(at(dimmer_lamp, kFlipPixels - 1), 1e-6);
}

TEST(HdrFlip, OfABlackReferenceIsNothing) {
    const Pixels black = uniform(glm::dvec3(0.0));
    for (const double value : hdr_flip(in_xyz(picture(1), 1.0), black, kFlipWidth, kFlipHeight)) EXPECT_EQ(value, 0.0);
}

}  // namespace

}  // namespace rowland::colour
