#include "engine/lighting/probe_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>
#include <utility>
#include <vector>

#include "engine/core/check.h"
#include "engine/core/error.h"
#include "engine/core/log.h"
#include "engine/core/parallel.h"
#include "engine/image/image.h"

namespace rowland::lighting {

namespace {

constexpr std::array kNames{std::pair("equirect", Mapping::Equirectangular), std::pair("angular", Mapping::Angular),
                            std::pair("auto", Mapping::Auto)};

/// Whether the image is black outside its inscribed circle.
bool black_outside_circle(const image::Image& image) {
    constexpr double kBlack = 0.01;   // of the mean radiance inside
    constexpr double kCaption = 0.1;  // of the texels outside
    double inside = 0.0;
    std::size_t inside_count = 0;
    std::vector<double> outside;
    for (int row = 0; row < image.height; ++row)
        for (int column = 0; column < image.width; ++column) {
            const glm::vec3& texel = image.at(column, row);
            const double sum = static_cast<double>(texel.x) + texel.y + texel.z;
            const double radiance = std::isfinite(sum) ? sum : 0.0;
            // The rim crosses texels up to a diagonal away.
            const double radius = std::hypot(2 * column + 1 - image.width, 2 * row + 1 - image.height);
            if (radius <= image.width) {
                inside += radiance;
                ++inside_count;
            } else if (radius > image.width + 3) {
                outside.push_back(radiance);
            }
        }
    if (outside.empty()) return false;
    const double limit = kBlack * inside / static_cast<double>(inside_count);
    std::size_t bright = 0;
    for (const double radiance : outside) bright += radiance > limit ? 1 : 0;
    return static_cast<double>(bright) <= kCaption * static_cast<double>(outside.size());
}

}  // namespace

Mapping parse_mapping(const std::string& name) {
    for (const auto& [known, mapping] : kNames)
        if (name == known) return mapping;
    refuse_input("probe mapping", "", fmt::format("\"{}\"", name.substr(0, 40)), "equirect, angular or auto");
}

const char* mapping_name(Mapping mapping) {
    return kNames.at(static_cast<std::size_t>(mapping)).first;
}

Mapping detect_mapping(const image::Image& image, const std::string& file) {
    if (image.width != image.height || image.width <= 1) return Mapping::Equirectangular;
    if (black_outside_circle(image)) return Mapping::Angular;
    refuse_input(
        file, "",
        fmt::format("a square image of {} x {} texels with light outside its circle", image.width, image.height),
        "an angular map, black outside its circle, or a panorama twice as wide as high",
        "say which it is: the mapping \"angular\" or \"equirect\"");
}

namespace {

using std::numbers::pi;

/// Sets components that are no radiance to 0 and counts their texels, each once: as NaN, else infinite, else negative.
InvalidTexelCounts clean(image::Image& image) {
    InvalidTexelCounts report;
    for (glm::vec3& texel : image.texels) {
        bool nan = false;
        bool infinite = false;
        bool negative = false;
        for (int c = 0; c < 3; ++c) {
            const float x = texel[c];
            nan = nan || std::isnan(x);
            infinite = infinite || std::isinf(x);
            negative = negative || (x < 0 && !std::isinf(x));
            if (!(x >= 0) || std::isinf(x)) texel[c] = 0;
        }
        if (nan)
            ++report.nan;
        else if (infinite)
            ++report.infinite;
        else if (negative)
            ++report.negative;
    }
    return report;
}

void check_shape(const image::Image& image, Mapping mapping, const std::string& file) {
    ROWLAND_CHECK_OP(image.texels.size(), ==,
                     static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
    const auto size = fmt::format("an image of {} x {} texels", image.width, image.height);
    if (image.width < 1 || image.height < 1) refuse_input(file, "", size, "at least one texel");
    if (mapping == Mapping::Angular && image.width != image.height)
        refuse_input(file, "", size, "a square image for the angular mapping",
                     "use the mapping \"equirect\" if it is a panorama");
}

/// sin(πρ)/(πρ): the angular map's solid angle per area of the (πu, πv) plane.
double angular_density(double radius) {
    const double angle = pi * radius;
    return angle < 1e-4 ? 1 - angle * angle / 6 : std::sin(angle) / angle;
}

/// Solid angle of an angular map's texel that the rim crosses, or of a coarse map's: midpoint sums over the part inside
/// the disc. (x, y) is the texel's corner nearest the origin of its quadrant, in units of the radius, `side` its
/// side.
double sampled_angular_solid_angle(double x, double y, double side) {
    constexpr int kSteps = 16;
    const double step = side / kSteps;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) {
        const double u = x + (i + 0.5) * step;
        // Only the part of the column inside the disc, so that the rim itself is not sampled.
        const double top = std::min(y + side, std::sqrt(std::max(0.0, 1 - u * u)));
        if (top <= y) continue;
        const double height = (top - y) / kSteps;
        for (int j = 0; j < kSteps; ++j) sum += height * angular_density(std::hypot(u, y + (j + 0.5) * height));
    }
    return pi * pi * step * sum;
}

double angular_solid_angle(int size, int column, int row) {
    const double side = 2.0 / size;
    // By symmetry, the texel's mirror image in the first quadrant.
    const double u = std::abs((column + 0.5) * side - 1);
    const double v = std::abs(1 - (row + 0.5) * side);
    const double radius = std::hypot(u, v);
    if (radius > 1) return 0;
    constexpr int kCoarse = 64;
    if (size < kCoarse || std::hypot(u + side / 2, v + side / 2) > 1) {
        // An odd map's middle texels reach across the axes, which midpoint sums allow.
        return sampled_angular_solid_angle(u - side / 2, v - side / 2, side);
    }
    // The formula at the centre, f = sin(πρ)/(πρ), and its second-order correction side²/24 · ∇²f, where
    // ∇²f = −π²f − f'/ρ because f is a spherical Bessel function. The remainder is of order (2π/size)⁴.
    const double f = angular_density(radius);
    const double slope_over_radius = radius < 1e-4 ? -pi * pi / 3 : (std::cos(pi * radius) - f) / (radius * radius);
    const double laplacian = -pi * pi * f - slope_over_radius;
    return pi * pi * side * side * (f + side * side / 24 * laplacian);
}

/// Bilinear position: the lower texel's index and the upper's weight.
struct Position {
    int low = 0;
    double weight = 0;
};

Position locate(double coordinate) {
    const double floor = std::floor(coordinate);
    return {static_cast<int>(floor), coordinate - floor};
}

glm::dvec3 equirectangular_radiance(const image::Image& image, const glm::dvec3& d) {
    const double theta = std::acos(std::clamp(d.y, -1.0, 1.0));
    const double phi = std::atan2(d.x, -d.z);
    const Position x = locate((phi / (2 * pi) + 0.5) * image.width - 0.5);
    const Position y = locate(theta / pi * image.height - 0.5);
    const int left = x.low < 0 ? x.low + image.width : x.low % image.width;
    const int right = left + 1 == image.width ? 0 : left + 1;
    const int top = std::clamp(y.low, 0, image.height - 1);
    const int bottom = std::clamp(y.low + 1, 0, image.height - 1);
    const auto row = [&](int r) {
        return glm::mix(glm::dvec3(image.at(left, r)), glm::dvec3(image.at(right, r)), x.weight);
    };
    return glm::mix(row(top), row(bottom), y.weight);
}

bool inside_disc(int size, int column, int row) {
    const int u = 2 * column + 1 - size;
    const int v = 2 * row + 1 - size;
    return std::int64_t{u} * u + std::int64_t{v} * v <= std::int64_t{size} * size;
}

glm::dvec3 angular_map_radiance(const image::Image& image, const glm::dvec3& d) {
    const int size = image.width;
    const double across = std::hypot(d.x, d.y);
    const double radius = std::atan2(across, -d.z) / pi;
    // +Z is the whole rim.
    const double u = across > 0 ? radius * d.x / across : radius;
    const double v = across > 0 ? radius * d.y / across : 0;
    const Position x = locate((u + 1) / 2 * size - 0.5);
    const Position y = locate((1 - v) / 2 * size - 0.5);
    glm::dvec3 sum(0.0);
    double total = 0;
    glm::dvec3 inner(0.0);
    double inner_distance = 2;
    for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 2; ++i) {
            const int column = std::clamp(x.low + i, 0, size - 1);
            const int row = std::clamp(y.low + j, 0, size - 1);
            if (!inside_disc(size, column, row)) continue;
            const double weight = (i == 1 ? x.weight : 1 - x.weight) * (j == 1 ? y.weight : 1 - y.weight);
            const glm::dvec3 texel(image.at(column, row));
            sum += weight * texel;
            total += weight;
            const double distance = std::hypot(i - x.weight, j - y.weight);
            if (distance < inner_distance) {
                inner_distance = distance;
                inner = texel;
            }
        }
    // At the very rim the texels inside the disc may have no weight; then the nearest of them is returned.
    return total > 1e-6 ? sum / total : inner;
}

/// An image that is the same in all directions. With its 64 rows, sums over texel centres differ from integrals in four
/// bands by at most 4e-4 (measured).
image::Image everywhere(const glm::vec3& radiance, Mapping mapping) {
    constexpr int kRows = 64;
    const int columns = mapping == Mapping::Angular ? kRows : 2 * kRows;
    return {columns, kRows, std::vector<glm::vec3>(static_cast<std::size_t>(columns * kRows), radiance)};
}

/// For texel i of `count`, resampled to `new_count`: calls add(k, overlap) for each new texel k that it overlaps. The
/// overlap is in new texels.
template <typename Add>
void spread(int i, int count, int new_count, const Add& add) {
    const double scale = static_cast<double>(new_count) / count;
    for (int k = static_cast<int>(i * scale); k < new_count && k < (i + 1) * scale; ++k) {
        const double overlap = std::min<double>(k + 1, (i + 1) * scale) - std::max<double>(k, i * scale);
        if (overlap > 0) add(k, overlap);
    }
}

/// The image in fewer columns and rows, each texel the mean by solid angle of those it replaces.
image::Image averaged(const image::Image& image, int width, int height) {
    if (width == image.width && height == image.height) return image;
    std::vector<glm::dvec4> sums(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), glm::dvec4(0.0));
    for (int row = 0; row < image.height; ++row) {
        const double sine = std::sin(pi * (row + 0.5) / image.height);
        spread(row, image.height, height, [&](int new_row, double row_overlap) {
            for (int column = 0; column < image.width; ++column)
                spread(column, image.width, width, [&](int new_column, double overlap) {
                    sums[static_cast<std::size_t>(new_row) * static_cast<std::size_t>(width) +
                         static_cast<std::size_t>(new_column)] +=
                        sine * row_overlap * overlap * glm::dvec4(image.at(column, row), 1.0);
                });
        });
    }
    image::Image result = image::make_image(width, height);
    for (std::size_t i = 0; i < sums.size(); ++i) result.texels[i] = glm::vec3(glm::dvec3(sums[i]) / sums[i].w);
    return result;
}

}  // namespace

glm::ivec2 resampled_size(int width, int height) {
    constexpr double kLongest = 8;
    const double most = std::max(2.0 * width * height, std::exp2(20));
    const glm::dvec2 size(width, height);
    // Texels are 2π/width wide and π/height high.
    const double ratio = 2 * size.y / size.x;
    if (ratio > kLongest) {
        const double rows = std::min(size.y, std::floor(std::sqrt(most * kLongest / 2)));
        return {static_cast<int>(std::ceil(2 * rows / kLongest)), static_cast<int>(rows)};
    }
    if (ratio < 1 / kLongest) {
        const double columns = std::min(size.x, std::floor(std::sqrt(most * kLongest * 2)));
        return {static_cast<int>(columns), static_cast<int>(std::ceil(columns / (2 * kLongest)))};
    }
    return {width, height};
}

ProbeImage::ProbeImage(image::Image image, Mapping mapping, const std::string& file)
    : image_(std::move(image)),
      mapping_(mapping == Mapping::Auto ? detect_mapping(image_, file) : mapping),
      file_(file) {
    check_shape(image_, mapping_, file);
    report_ = clean(image_);
    if (image_.width == 1 && image_.height == 1) image_ = everywhere(image_.texels[0], mapping_);
    if (mapping_ == Mapping::Equirectangular) resample();
}

void ProbeImage::resample() {
    const glm::ivec2 shape = resampled_size(image_.width, image_.height);
    if (shape == glm::ivec2(image_.width, image_.height)) return;
    image_ = averaged(image_, std::min(shape.x, image_.width), std::min(shape.y, image_.height));
    image::Image divided = image::make_image(shape.x, shape.y);
    parallel_for(static_cast<std::size_t>(shape.y), [&](std::size_t task) {
        const int row = static_cast<int>(task);
        for (int column = 0; column < shape.x; ++column)
            divided.at(column, row) = glm::vec3(
                radiance(direction((column + 0.5) * image_.width / shape.x, (row + 0.5) * image_.height / shape.y)));
    });
    image_ = std::move(divided);
}

ProbeImage load_probe_image(const std::filesystem::path& path, Mapping mapping) {
    ProbeImage probe(image::load_image(path), mapping, path.string());
    warn_about(probe, path.string());
    return probe;
}

void warn_about(const ProbeImage& probe, const std::string& file) {
    const InvalidTexelCounts& report = probe.report();
    if (report.total() > 0)
        log_warning("{}: {} texels are negative or not finite and taken as black ({} NaN, {} infinite, {} negative)",
                    file, report.total(), report.nan, report.infinite, report.negative);
    const image::Image& image = probe.image();
    if (probe.mapping() == Mapping::Equirectangular && image.width == image.height)
        log_warning(
            "{}: a square image of {} x {} texels as \"equirect\", which is twice as wide as high; did you mean "
            "the mapping \"angular\"?",
            file, image.width, image.height);
}

glm::dvec3 ProbeImage::direction(double x, double y) const {
    if (mapping_ == Mapping::Equirectangular) {
        const double theta = pi * y / image_.height;
        const double phi = 2 * pi * (x / image_.width - 0.5);
        return {std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi)};
    }
    const double u = 2 * x / image_.width - 1;
    const double v = 1 - 2 * y / image_.height;
    const double radius = std::hypot(u, v);
    const double scale = pi * angular_density(radius);  // sin(πρ)/ρ
    return {scale * u, scale * v, -std::cos(pi * radius)};
}

double ProbeImage::solid_angle(int column, int row) const {
    if (mapping_ == Mapping::Angular) return angular_solid_angle(image_.width, column, row);
    // cos a − cos b without cancellation.
    const double middle = pi * (row + 0.5) / image_.height;
    return 2 * pi / image_.width * 2 * std::sin(middle) * std::sin(pi / (2 * image_.height));
}

glm::dvec3 ProbeImage::radiance(const glm::dvec3& direction) const {
    return mapping_ == Mapping::Angular ? angular_map_radiance(image_, direction)
                                        : equirectangular_radiance(image_, direction);
}

}  // namespace rowland::lighting
