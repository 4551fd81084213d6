#include "engine/scene/wear.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <numbers>
#include <random>

namespace rowland::scene {

namespace {

constexpr float kPi = std::numbers::pi_v<float>;
/// At density 1, per square metre.
constexpr float kScratchesPerArea = 170'000.0F;
constexpr float kPrintsPerArea = 400.0F;
constexpr float kSpecksPerArea = 3e6F;
constexpr float kFibresPerArea = 6'000.0F;

/// Random numbers that are the same on all systems, as the standard library's distributions are not.
class Random {
 public:
    explicit Random(std::uint32_t seed) : generator_(seed) {}

    float operator()() { return static_cast<float>(generator_() >> 8U) * 0x1p-24F; }
    float between(float least, float most) { return least + (most - least) * (*this)(); }
    /// y is drawn before x: as arguments of one call they would be drawn in an order that the compiler chooses.
    glm::vec2 between(const glm::vec2& least, const glm::vec2& most) {
        const float y = between(least.y, most.y);
        return {between(least.x, most.x), y};
    }
    /// A point of the map, in texels.
    glm::vec2 point() { return between(glm::vec2(0.0F), glm::vec2(kWearTexels)); }
    /// Exponentially distributed with mean 1.
    float exponential() { return -std::log(1.0F - (*this)()); }

 private:
    std::mt19937 generator_;
};

/// The fraction of each texel that marks cover; x: dust, y: grease, zw: scratches, by the cosine and sine of twice
/// their angle. Marks that leave one side enter at the other.
class Canvas {
 public:
    explicit Canvas(float size_m) : texel_m_(size_m / kWearTexels), texels_(std::size_t{kWearTexels} * kWearTexels) {}

    float texel_m() const { return texel_m_; }
    glm::vec4& at(int column, int row) {
        constexpr unsigned kMask = kWearTexels - 1;
        return texels_[(static_cast<unsigned>(row) & kMask) * kWearTexels + (static_cast<unsigned>(column) & kMask)];
    }

    /// Adds an area in texels at a point in texels, shared by the four texels around it.
    void splat(const glm::vec2& point, const glm::vec4& area) {
        const glm::vec2 corner = glm::floor(point);
        const glm::vec2 part = point - corner;
        const auto column = static_cast<int>(corner.x);
        const auto row = static_cast<int>(corner.y);
        at(column, row) += area * ((1.0F - part.x) * (1.0F - part.y));
        at(column + 1, row) += area * (part.x * (1.0F - part.y));
        at(column, row + 1) += area * ((1.0F - part.x) * part.y);
        at(column + 1, row + 1) += area * (part.x * part.y);
    }

    image::ByteImage encoded() const {
        image::ByteImage image{kWearTexels, kWearTexels, {}};
        image.rgba.reserve(4 * texels_.size());
        for (glm::vec4 texel : texels_) {
            const float scratched = std::hypot(texel.z, texel.w);
            if (scratched > 1.0F) {
                texel.z /= scratched;
                texel.w /= scratched;
            }
            for (const float x : {std::min(texel.x, 1.0F), std::min(texel.y, 1.0F)})
                image.rgba.push_back(static_cast<std::uint8_t>(std::lround(255.0F * x)));
            for (const float x : {texel.z, texel.w})
                image.rgba.push_back(static_cast<std::uint8_t>(std::lround(128.0F + 127.0F * x)));
        }
        return image;
    }

 private:
    float texel_m_;
    std::vector<glm::vec4> texels_;
};

/// An arc in the surface, drawn from its beginning. Metres.
struct Line {
    float angle;
    float curvature;  ///< 1 / m
    float length;
    float width;
};

/// Adds a line whose ends taper. `area_of(angle)` is what each unit of area adds where the line has that direction.
template <typename AreaOf>
void draw_line(Random& random, const Line& line, const AreaOf& area_of, Canvas& canvas) {
    constexpr float kStep = 0.5F;  // texels
    glm::vec2 point = random.point();
    const float texel = canvas.texel_m();
    const int steps = std::max(static_cast<int>(line.length / (kStep * texel)), 1);
    float angle = line.angle;
    for (int i = 0; i < steps; ++i) {
        const float taper = std::sqrt(std::sin(kPi * (static_cast<float>(i) + 0.5F) / static_cast<float>(steps)));
        canvas.splat(point, kStep * taper * line.width / texel * area_of(angle));
        point += kStep * glm::vec2(std::cos(angle), std::sin(angle));
        angle += line.curvature * kStep * texel;
    }
}

void draw_scratches(float count, Random& random, Canvas& canvas) {
    for (auto left = static_cast<int>(count); left > 0; --left) {
        const Line line{.angle = random.between(0.0F, 2.0F * kPi),
                        .curvature = random.between(-20.0F, 20.0F),
                        .length = std::min(0.003F + 0.012F * random.exponential(), 0.08F),
                        .width = 1e-6F * std::min(4.0F + 8.0F * random.exponential(), 60.0F)};
        draw_line(
            random, line,
            [](float angle) { return glm::vec4(0.0F, 0.0F, std::cos(2.0F * angle), std::sin(2.0F * angle)); }, canvas);
    }
}

void draw_disc(const glm::vec2& middle, float radius, const glm::vec4& coverage, Canvas& canvas) {
    const auto reach = static_cast<int>(radius + 1.5F);
    const glm::vec2 nearest = glm::round(middle);
    for (int row = -reach; row <= reach; ++row)
        for (int column = -reach; column <= reach; ++column) {
            const glm::vec2 texel = nearest + glm::vec2(column, row);
            const float covered = glm::clamp(radius - glm::distance(texel, middle) + 0.5F, 0.0F, 1.0F);
            canvas.at(static_cast<int>(texel.x), static_cast<int>(texel.y)) += covered * coverage;
        }
}

void draw_dust(float area, float density, Random& random, Canvas& canvas) {
    constexpr glm::vec4 kDust(1.0F, 0.0F, 0.0F, 0.0F);
    for (auto left = static_cast<int>(kSpecksPerArea * area * density); left > 0; --left) {
        // Few are large: the radii are from 15 to 137 micrometres, with a probability density that falls with the
        // radius cubed.
        const float radius = 15e-6F / std::sqrt(1.0F - 0.988F * random()) / canvas.texel_m();
        const glm::vec2 middle = random.point();
        if (radius < 0.6F)
            canvas.splat(middle, kPi * radius * radius * kDust);
        else
            draw_disc(middle, radius, kDust, canvas);
    }
    for (auto left = static_cast<int>(kFibresPerArea * area * density); left > 0; --left) {
        const Line fibre{.angle = random.between(0.0F, 2.0F * kPi),
                         .curvature = random.between(-1500.0F, 1500.0F),
                         .length = random.between(0.5e-3F, 3e-3F),
                         .width = random.between(12e-6F, 25e-6F)};
        draw_line(
            random, fibre, [&](float) { return kDust; }, canvas);
    }
}

/// Draws a finger's ridges around a core, lengths in millimetres. The skin touches in patches, within an ellipse.
void draw_fingerprint(Random& random, Canvas& canvas) {
    constexpr float kRidge = 0.45F;  // from one ridge to the next
    const glm::vec2 half = random.between(glm::vec2(6.5F, 9.0F), glm::vec2(8.5F, 12.0F));
    const glm::vec2 middle = random.point();
    const glm::vec2 core = random.between(glm::vec2(-1.0F, -2.5F), glm::vec2(1.0F, 0.5F));
    const float angle = random.between(0.0F, 2.0F * kPi);
    const float strength = random.between(0.25F, 0.6F);
    const float lean = random.between(-0.12F, 0.12F);
    std::array<glm::vec3, 6> waves{};  // of the patches: frequency and phase
    for (glm::vec3& wave : waves)
        wave = {random.between(-1.1F, 1.1F), random.between(-1.1F, 1.1F), random.between(0.0F, 2.0F * kPi)};
    const glm::vec2 along(std::cos(angle), std::sin(angle));
    const float texel_mm = 1e3F * canvas.texel_m();
    // At most half the map, so that a print larger than the surface does not overlap itself.
    const int reach = std::min(static_cast<int>(half.y / texel_mm) + 1, kWearTexels / 2);
    for (int row = -reach; row < reach; ++row)
        for (int column = -reach; column < reach; ++column) {
            const glm::vec2 offset = texel_mm * glm::vec2(column, row);
            const glm::vec2 at(glm::dot(offset, along), glm::dot(offset, glm::vec2(-along.y, along.x)));
            const float inside = glm::length(at / half);
            if (inside >= 1.0F) continue;
            float patches = 0.0F;
            for (const glm::vec3& wave : waves) patches += std::sin(wave.x * at.x + wave.y * at.y + wave.z) / 6.0F;
            const float touch = glm::clamp(0.75F + 1.2F * patches, 0.0F, 1.0F) * std::min(4.0F * (1.0F - inside), 1.0F);
            const glm::vec2 bent(at.x - core.x + lean * at.y, 0.55F * (at.y - core.y) + 0.04F * at.x * at.x);
            const float ridge = 0.5F + 0.5F * std::cos(2.0F * kPi / kRidge * (glm::length(bent) + 0.25F * patches));
            // Ridges closer than two texels become even grey.
            const float seen = glm::clamp(kRidge / (2.0F * texel_mm) - 1.0F, 0.0F, 1.0F);
            glm::vec4& texel = canvas.at(static_cast<int>(middle.x) + column, static_cast<int>(middle.y) + row);
            texel.y += strength * touch * glm::mix(0.5F, ridge * ridge, seen);
        }
}

}  // namespace

image::ByteImage wear_map(const Wear& wear) {
    Random random(wear.seed);
    Canvas canvas(wear.size_m);
    const float area = wear.size_m * wear.size_m;
    for (auto left = std::lround(kPrintsPerArea * area * wear.fingerprints); left > 0; --left)
        draw_fingerprint(random, canvas);
    draw_dust(area, wear.dust, random, canvas);
    draw_scratches(kScratchesPerArea * area * wear.scratches, random, canvas);
    return canvas.encoded();
}

void mask_wear(const image::ByteImage& mask, image::ByteImage& map) {
    const glm::ivec2 last(mask.width - 1, mask.height - 1);
    const auto value = [&](int column, int row) {
        const glm::ivec2 texel = glm::clamp(glm::ivec2(column, row), glm::ivec2(0), last);
        return static_cast<float>(
                   mask.rgba[4 * (static_cast<std::size_t>(texel.y) * static_cast<std::size_t>(mask.width) +
                                  static_cast<std::size_t>(texel.x))]) /
               255.0F;
    };
    for (int row = 0; row < map.height; ++row)
        for (int column = 0; column < map.width; ++column) {
            const glm::vec2 at = (glm::vec2(column, row) + 0.5F) / glm::vec2(map.width, map.height) *
                                     glm::vec2(mask.width, mask.height) -
                                 0.5F;
            const glm::ivec2 corner(glm::floor(at));
            const glm::vec2 part = at - glm::vec2(corner);
            const float kept =
                glm::mix(glm::mix(value(corner.x, corner.y), value(corner.x + 1, corner.y), part.x),
                         glm::mix(value(corner.x, corner.y + 1), value(corner.x + 1, corner.y + 1), part.x), part.y);
            std::uint8_t* texel = &map.rgba[4 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(map.width) +
                                                 static_cast<std::size_t>(column))];
            for (int i = 0; i < 4; ++i) {
                const float none = i < 2 ? 0.0F : 128.0F;
                texel[i] = static_cast<std::uint8_t>(std::lround(none + kept * (static_cast<float>(texel[i]) - none)));
            }
        }
}

}  // namespace rowland::scene
