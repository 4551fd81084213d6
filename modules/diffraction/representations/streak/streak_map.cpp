#include "modules/diffraction/representations/streak/streak_map.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <numbers>

#include "engine/core/check.h"
#include "engine/core/parallel.h"
#include "engine/lighting/environment_map.h"

namespace rowland::diffraction {

namespace {

/// Ratio of the lobe's widths at successive levels.
constexpr double kWidthGrowth = 1.5;
/// The part of a level's width that blurred_cube() adds. Interpolation between texels adds the remainder.
constexpr double kBlurredWidth = 0.866;
/// The deviations from its middle at which a blur ends.
constexpr float kReach = 3.5F;
/// Cells of a face's side, to find the light about a direction.
constexpr int kBins = 32;

/// Light blurred by a normal distribution of the angle, as a cube of one level.
struct BlurredCube {
    lighting::CubeLayout layout;
    std::vector<glm::vec3> texels;

    /// Bilinear; clamped at the edges of a face.
    glm::vec3 at(const glm::dvec3& direction) const {
        const lighting::CubePoint point = lighting::cube_point(direction);
        const auto coordinate = [&](double s) {
            return std::clamp(static_cast<float>(0.5 * (s + 1.0) * layout.face_size - 0.5), 0.0F,
                              static_cast<float>(layout.face_size) - 1.001F);
        };
        const float x = coordinate(point.s);
        const float y = coordinate(point.t);
        const int column = static_cast<int>(x);
        const int row = static_cast<int>(y);
        const float u = x - static_cast<float>(column);
        const float v = y - static_cast<float>(row);
        const glm::vec3* texel = texels.data() + layout.index(0, point.face, column, row);
        const glm::vec3* below = texel + layout.face_size;
        return (1.0F - v) * ((1.0F - u) * texel[0] + u * texel[1]) + v * ((1.0F - u) * below[0] + u * below[1]);
    }
};

glm::dvec3 centre_of(int face, int size, int column, int row) {
    return glm::normalize(
        lighting::cube_direction(face, 2.0 * (column + 0.5) / size - 1.0, 2.0 * (row + 0.5) / size - 1.0));
}

/// Indices of samples by the bin of their direction.
std::vector<std::vector<std::size_t>> binned(const lighting::LightSamples& lights, const lighting::CubeLayout& bins) {
    std::vector<std::vector<std::size_t>> result(bins.offset(1));
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const lighting::CubePoint at = lighting::cube_point(lights.direction(i));
        const auto cell = [](double s) { return std::clamp(static_cast<int>(0.5 * (s + 1.0) * kBins), 0, kBins - 1); };
        result[bins.index(0, at.face, cell(at.s), cell(at.t))].push_back(i);
    }
    return result;
}

BlurredCube blurred_cube(const lighting::LightSamples& texels, double deviation, const std::stop_token& stop) {
    const int face_size = std::clamp(static_cast<int>(std::bit_ceil(static_cast<unsigned>(2.5 / deviation))), 32, 512);
    const lighting::LightSamples lights = lighting::merge_samples(texels, face_size);
    BlurredCube cube{.layout = {.face_size = face_size, .levels = 1}, .texels = {}};
    cube.texels.resize(cube.layout.offset(1), glm::vec3(0.0F));
    const lighting::CubeLayout bins{.face_size = kBins, .levels = 1};
    const std::vector<std::vector<std::size_t>> near = binned(lights, bins);
    std::vector<glm::dvec3> middles;
    for (int cell = 0; cell < static_cast<int>(near.size()); ++cell)
        middles.push_back(centre_of(cell / (kBins * kBins), kBins, cell % kBins, cell / kBins % kBins));
    const auto reach = kReach * static_cast<float>(deviation);
    constexpr double kBinRadius = 0.05;
    const float inverse = 1.0F / static_cast<float>(deviation * deviation);
    const float peak = inverse * 0.5F / std::numbers::pi_v<float>;
    parallel_for(near.size(), [&](std::size_t bin) {
        if (stop.stop_requested()) return;
        const int face = static_cast<int>(bin) / (kBins * kBins);
        const int bin_row = static_cast<int>(bin) / kBins % kBins;
        const int bin_column = static_cast<int>(bin) % kBins;
        const glm::dvec3& middle = middles[bin];
        const double nearest_bin = std::cos(double{reach} + 2.0 * kBinRadius);
        const double nearest_light = std::cos(double{reach} + kBinRadius);
        lighting::LightSamples around;
        for (std::size_t other = 0; other < near.size(); ++other) {
            if (glm::dot(middle, middles[other]) < nearest_bin) continue;
            for (const std::size_t i : near[other])
                if (glm::dot(middle, lights.direction(i)) > nearest_light)
                    around.push_back(lights.direction(i), lights.flux(i));
        }
        const int part = face_size / kBins;
        for (int row = bin_row * part; row < (bin_row + 1) * part; ++row)
            for (int column = bin_column * part; column < (bin_column + 1) * part; ++column) {
                const glm::vec3 s(centre_of(face, face_size, column, row));
                glm::vec3 sum(0.0F);
                for (std::size_t i = 0; i < around.size(); ++i) {
                    const float square = 2.0F - 2.0F * (around.x[i] * s.x + around.y[i] * s.y + around.z[i] * s.z);
                    if (square > reach * reach) continue;
                    sum +=
                        std::exp(-0.5F * square * inverse) * glm::vec3(around.red[i], around.green[i], around.blue[i]);
                }
                cube.texels[cube.layout.index(0, face, column, row)] = peak * sum;
            }
    });
    return cube;
}

/// A texel's direction, and the tangents that its chart maps to the chart's axes.
struct ChartFrame {
    glm::dvec3 s{0.0};
    glm::dvec3 e1{0.0};
    glm::dvec3 e2{0.0};
};

ChartFrame chart_frame(const glm::dvec2& p, int chart) {
    const double square = glm::dot(p, p);
    const glm::dvec3 up = glm::dvec3(2.0 * p.x, 1.0 - square, 2.0 * p.y) / (1.0 + square);
    const glm::dvec3 bisector = up + glm::dvec3(0.0, 1.0, 0.0);
    const auto mirrored = [&](glm::dvec3 v) {
        if (chart == 1) v.y = -v.y;
        return v;
    };
    return {mirrored(up), mirrored(glm::dvec3(1.0, 0.0, 0.0) - p.x * bisector),
            mirrored(glm::dvec3(0.0, 0.0, 1.0) - p.y * bisector)};
}

/// The samples of a normal distribution along an arc.
struct ArcSample {
    double cosine = 0.0;
    double sine = 0.0;
    float weight = 0.0F;
};

std::vector<ArcSample> arc_samples(double deviation, double width) {
    const double step = std::max(1.2 * width, 0.1 * deviation);
    const int count = static_cast<int>(std::min(2.8 * deviation, 0.5 * std::numbers::pi) / step);
    std::vector<ArcSample> samples;
    double sum = 0.0;
    for (int i = -count; i <= count; ++i) {
        const double angle = i * step;
        const double weight = i == 0 ? 1.0 : std::exp(-0.5 * angle * angle / (deviation * deviation));
        samples.push_back({std::cos(angle), std::sin(angle), static_cast<float>(weight)});
        sum += weight;
    }
    for (ArcSample& sample : samples) sample.weight /= static_cast<float>(sum);
    return samples;
}

void fill_level(StreakMap& map, int level, const lighting::LightSamples& texels, const std::stop_token& stop) {
    const double width = map.size.width() * std::pow(kWidthGrowth, level);
    const double length = map.size.length * std::exp2(level);
    const BlurredCube cube = blurred_cube(texels, kBlurredWidth * width, stop);
    const std::vector<ArcSample> samples =
        arc_samples(std::sqrt(std::max(length * length - width * width, 0.0)), width);
    std::vector<glm::vec3>& values = map.levels[static_cast<std::size_t>(level)];
    values.assign(map.index(level, map.slices(level), 0, 0), glm::vec3(0.0F));
    const int rows = map.rows(level);
    parallel_for(static_cast<std::size_t>(rows), [&](std::size_t row) {
        for (int column = 0; column < 2 * rows && !stop.stop_requested(); ++column) {
            const glm::dvec2 at(column % rows + 0.5, static_cast<double>(row) + 0.5);
            const glm::dvec2 p = (at / static_cast<double>(rows) - 0.5) / kStreakChartScale;
            if (glm::length(p) > 1.0 / kStreakRim + 6.0 / rows) continue;  // no look-up reaches the corners
            const ChartFrame frame = chart_frame(p, column / rows);
            for (int slice = 0; slice < map.slices(level); ++slice) {
                const double a = 1.0 - 2.0 * (slice + 0.5) / map.slices(level);
                const glm::dvec2 image = glm::normalize(glm::dvec2(a, 1.0 - std::abs(a)));
                const glm::dvec3 along = image.x * frame.e1 + image.y * frame.e2;
                glm::vec3 sum(0.0F);
                for (const ArcSample& sample : samples)
                    sum += sample.weight * cube.at(sample.cosine * frame.s + sample.sine * along);
                values[map.index(level, slice, static_cast<int>(row), column)] = sum;
            }
        }
    });
}

glm::dvec3 trilinear(const StreakMap& map, int level, const glm::dvec3& texture) {
    const glm::dvec3 at =
        texture * glm::dvec3(map.columns(level), map.rows(level), map.slices(level)) - glm::dvec3(0.5);
    const glm::dvec3 low = glm::floor(at);
    const glm::dvec3 t = at - low;
    const int slices = map.slices(level);
    const auto clamped = [](double i, int count) { return std::clamp(static_cast<int>(i), 0, count - 1); };
    glm::dvec3 sum(0.0);
    for (int corner = 0; corner < 8; ++corner) {
        const int i = corner & 1;
        const int j = (corner >> 1) & 1;
        const int k = corner >> 2;
        const double weight = (i == 1 ? t.x : 1 - t.x) * (j == 1 ? t.y : 1 - t.y) * (k == 1 ? t.z : 1 - t.z);
        const int slice = ((static_cast<int>(low.z) + k) % slices + slices) % slices;
        sum +=
            weight * glm::dvec3(map.levels[static_cast<std::size_t>(level)][map.index(
                         level, slice, clamped(low.y + j, map.rows(level)), clamped(low.x + i, map.columns(level)))]);
    }
    return sum;
}

}  // namespace

StreakPosition streak_position(const glm::dvec3& direction, const glm::dvec3& along, int chart) {
    const double up = chart == 0 ? 1.0 : -1.0;
    const glm::dvec2 p = glm::dvec2(direction.x, direction.z) / std::max(1.0 + up * direction.y, kStreakRim);
    glm::dvec2 image = glm::dvec2(along.x, along.z) - up * along.y * p;
    if (image.y < 0.0) image = -image;
    return {{0.5 * (chart + 0.5 + kStreakChartScale * p.x), 0.5 + kStreakChartScale * p.y,
             0.5 - 0.5 * image.x / std::max(std::abs(image.x) + image.y, 1e-12)},
            0.0};
}

StreakMap fill_streak_map(const lighting::LightSamples& texels, const StreakMapSize& size,
                          const std::stop_token& stop) {
    ROWLAND_CHECK(size.side >= 8 && size.side % 4 == 0, "a streak map's side is a multiple of 4");
    ROWLAND_CHECK(size.directions >= 4 && size.directions % 4 == 0, "a streak map's directions are a multiple of 4");
    StreakMap map{.size = size, .levels = {}};
    for (int level = 0; level < kStreakLevels; ++level) fill_level(map, level, texels, stop);
    return map;
}

glm::dvec3 sample(const StreakMap& map, const StreakPosition& position) {
    const double level = std::clamp(position.level, 0.0, kStreakLevels - 1.0);
    const int fine = static_cast<int>(level);
    const double between = level - fine;
    const glm::dvec3 value = trilinear(map, fine, position.texture);
    return between == 0.0 ? value : (1.0 - between) * value + between * trilinear(map, fine + 1, position.texture);
}

namespace {

constexpr double kLeastExtent = 1e-6;

}  // namespace

StreakPath::StreakPath(double low, double high, const LobePoint& before, const LobePoint& centre,
                       const LobePoint& after)
    : middle_(0.5 * (low + high)), scale_(2.0 / std::max(high - low, kLeastExtent)), level_(centre.level) {
    const int chart = centre.direction.y < 0.0 ? 1 : 0;
    const auto texture = [chart](const LobePoint& point) {
        return streak_position(point.direction, point.along, chart).texture;
    };
    const glm::dvec3 first = texture(before);
    glm::dvec3 last = texture(after);
    last.z -= std::round(last.z - first.z);
    mean_ = 0.5 * (last + first);
    slope_ = 0.5 * (last - first);
    bend_ = glm::dvec3(glm::dvec2(mean_ - texture(centre)), 0.0);
}

StreakPosition StreakPath::at(double x) const {
    const double t = scale_ * (x - middle_);
    return {mean_ + t * slope_ + (t * t - 1.0) * bend_, level_};
}

}  // namespace rowland::diffraction
