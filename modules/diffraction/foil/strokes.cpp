// Foil whose grooves run along the strokes of a drawing.

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>

#include "engine/core/parallel.h"
#include "modules/diffraction/foil/pattern.h"

namespace rowland::diffraction::foil {

namespace {

/// A value per texel.
struct Plane {
    int width = 0;
    int height = 0;
    std::vector<float> values{};

    float& at(int column, int row) {
        return values[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(column)];
    }
    float clamped(int column, int row) const {
        return values[static_cast<std::size_t>(std::clamp(row, 0, height - 1)) * static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(std::clamp(column, 0, width - 1))];
    }
};

Plane plane_of(int width, int height) {
    return {width, height, std::vector<float>(static_cast<std::size_t>(width) * static_cast<std::size_t>(height))};
}

/// Means over 2 × 2 texels.
Plane halved(const Plane& from) {
    Plane to = plane_of((from.width + 1) / 2, (from.height + 1) / 2);
    parallel_for(static_cast<std::size_t>(to.height), [&](std::size_t line) {
        const int row = static_cast<int>(line);
        for (int column = 0; column < to.width; ++column)
            to.at(column, row) =
                0.25F * (from.clamped(2 * column, 2 * row) + from.clamped(2 * column + 1, 2 * row) +
                         from.clamped(2 * column, 2 * row + 1) + from.clamped(2 * column + 1, 2 * row + 1));
    });
    return to;
}

/// Means over boxes of 2 · radius + 1 texels along rows or columns, by sums that slide.
Plane box_mean(const Plane& from, int radius, bool along_rows) {
    Plane to = plane_of(from.width, from.height);
    const int length = along_rows ? from.width : from.height;
    parallel_for(static_cast<std::size_t>(along_rows ? from.height : from.width), [&](std::size_t line) {
        const int fixed = static_cast<int>(line);
        const auto read = [&](int i) { return along_rows ? from.clamped(i, fixed) : from.clamped(fixed, i); };
        double sum = 0.0;
        for (int i = -radius; i <= radius; ++i) sum += read(i);
        for (int i = 0; i < length; ++i) {
            (along_rows ? to.at(i, fixed) : to.at(fixed, i)) = static_cast<float>(sum / (2 * radius + 1));
            sum += read(i + radius + 1) - read(i - radius);
        }
    });
    return to;
}

/// Two passes of boxes along each axis: about a Gaussian.
Plane smoothed(Plane plane, int radius) {
    for (int pass = 0; pass < 2; ++pass) {
        plane = box_mean(plane, radius, true);
        plane = box_mean(plane, radius, false);
    }
    return plane;
}

/// The structure tensor [Bigün & Granlund 1987] but for its trace: the vector of twice the angle of the gradient, times
/// the gradient's square.
struct Tensor {
    Plane cosine;
    Plane sine;
};

Tensor tensor_of(const Plane& picture) {
    Tensor tensor{plane_of(picture.width, picture.height), plane_of(picture.width, picture.height)};
    parallel_for(static_cast<std::size_t>(picture.height), [&](std::size_t line) {
        const int row = static_cast<int>(line);
        // Weights of 3, 10 and 3 turn with the gradient [Scharr 2000].
        const auto across = [&](int column) {
            return 3.0F * picture.clamped(column, row - 1) + 10.0F * picture.clamped(column, row) +
                   3.0F * picture.clamped(column, row + 1);
        };
        const auto down = [&](int column, int at) {
            return 3.0F * picture.clamped(column - 1, at) + 10.0F * picture.clamped(column, at) +
                   3.0F * picture.clamped(column + 1, at);
        };
        for (int column = 0; column < picture.width; ++column) {
            const float x = across(column + 1) - across(column - 1);
            const float y = down(column, row - 1) - down(column, row + 1);  // up
            tensor.cosine.at(column, row) = x * x - y * y;
            tensor.sine.at(column, row) = 2.0F * x * y;
        }
    });
    return tensor;
}

}  // namespace

GrooveField stroke_field(const Own& own, double scale, const Area& area, const Brightness& drawing) {
    Plane picture{area.width_px, area.height_px, drawing};
    int halvings = 0;
    // Directions are smooth, so that a coarser picture does.
    for (; std::max(picture.width, picture.height) > 1024; ++halvings) picture = halved(picture);
    const double texel_mm = area.texel_mm() * (1 << halvings);
    const int radius = std::max(1, static_cast<int>(std::lround(0.5 * own.smooth_mm * scale / texel_mm)));
    const Tensor fine = tensor_of(smoothed(std::move(picture), 1));
    auto sum = std::make_shared<Tensor>(
        Tensor{plane_of(fine.sine.width, fine.sine.height), plane_of(fine.sine.width, fine.sine.height)});
    // Where there is no stroke nearby, the strokes farther away decide.
    float weight = 1.0F;
    for (const int wider : {1, 4, 16, 64}) {
        const Plane cosine = smoothed(fine.cosine, radius * wider);
        const Plane sine = smoothed(fine.sine, radius * wider);
        for (std::size_t i = 0; i < cosine.values.size(); ++i) {
            sum->cosine.values[i] += weight * cosine.values[i];
            sum->sine.values[i] += weight * sine.values[i];
        }
        weight *= 1e-2F;
    }
    return [sum, halvings](int column, int row) {
        // Bilinear between the coarser texels, as a texture of 16 bits shows steps of the angle.
        const double side = 1 << halvings;
        const double x = (column + 0.5) / side - 0.5;
        const double y = (row + 0.5) / side - 0.5;
        const int left = static_cast<int>(std::floor(x));
        const int top = static_cast<int>(std::floor(y));
        const auto mean = [&](const Plane& plane) {
            const double s = x - left;
            const double t = y - top;
            return (1.0 - t) * ((1.0 - s) * plane.clamped(left, top) + s * plane.clamped(left + 1, top)) +
                   t * ((1.0 - s) * plane.clamped(left, top + 1) + s * plane.clamped(left + 1, top + 1));
        };
        const double cosine = mean(sum->cosine);
        const double sine = mean(sum->sine);
        const double angle = 0.5 * std::atan2(sine, cosine);
        return Groove{angle / std::numbers::pi};
    };
}

}  // namespace rowland::diffraction::foil
