#include "modules/diffraction/model/lattice.h"

#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "engine/core/check.h"

namespace rowland::diffraction {

namespace {

using Amplitude = std::complex<double>;
using std::numbers::pi;

std::vector<double> product(const std::vector<double>& along_a, const std::vector<double>& along_b) {
    std::vector<double> efficiencies;
    efficiencies.reserve(along_a.size() * along_b.size());
    for (const double b : along_b)
        for (const double a : along_a) efficiencies.push_back(a * b);
    return efficiencies;
}

std::vector<double> groove_orders(const Profile& profile, double pitch_nm, int orders, double wavelength_nm) {
    std::vector<double> efficiencies;
    for (int order = -orders; order <= orders; ++order)
        efficiencies.push_back(profile_efficiency(profile, pitch_nm, order, wavelength_nm));
    return efficiencies;
}

std::vector<double> efficiencies_of(const CrossedProfile& crossed, const Lattice& lattice, int orders,
                                    double wavelength_nm) {
    return product(groove_orders(crossed.along_a, glm::length(lattice.a_nm), orders, wavelength_nm),
                   groove_orders(crossed.along_b, glm::length(lattice.b_nm), orders, wavelength_nm));
}

std::vector<double> efficiencies_of(const ApertureProfile& aperture, const Lattice& lattice, int orders,
                                    double wavelength_nm) {
    return product(groove_orders(SlitProfile{aperture.width_nm}, glm::length(lattice.a_nm), orders, wavelength_nm),
                   groove_orders(SlitProfile{aperture.height_nm}, glm::length(lattice.b_nm), orders, wavelength_nm));
}

/// exp(−2πi j/count) for j < count.
std::vector<Amplitude> roots_of_unity(int count) {
    std::vector<Amplitude> roots;
    for (int j = 0; j < count; ++j) roots.push_back(std::polar(1.0, -2.0 * pi * j / count));
    return roots;
}

std::size_t modulo(int value, int count) {
    return static_cast<std::size_t>((value % count + count) % count);
}

/// |DFT(e^(iφ))|² of one cell: first along the rows, then across them.
std::vector<double> efficiencies_of(const HeightMap& map, const Lattice&, int orders, double wavelength_nm) {
    ROWLAND_CHECK_OP(map.heights.size(), ==,
                     static_cast<std::size_t>(map.columns) * static_cast<std::size_t>(map.rows));
    std::array<Amplitude, 256> reflected;
    for (std::size_t height = 0; height < reflected.size(); ++height)
        reflected[height] =
            std::polar(1.0, 4.0 * pi * map.depth_nm / wavelength_nm * static_cast<double>(height) / 255.0);
    const std::vector<Amplitude> roots_a = roots_of_unity(map.columns);
    const std::vector<Amplitude> roots_b = roots_of_unity(map.rows);
    const int columns = 2 * orders + 1;
    const auto count = static_cast<std::size_t>(columns);
    std::vector<Amplitude> sums(count * count);
    for (int row = 0; row < map.rows; ++row) {
        const std::uint8_t* heights = map.heights.data() + static_cast<std::ptrdiff_t>(row) * map.columns;
        for (int m = -orders; m <= orders; ++m) {
            Amplitude along = 0.0;
            const std::size_t step = modulo(m, map.columns);
            std::size_t root = 0;
            for (int column = 0; column < map.columns; ++column) {
                along += reflected[heights[column]] * roots_a[root];
                root += step;
                if (root >= roots_a.size()) root -= roots_a.size();
            }
            for (int k = -orders; k <= orders; ++k)  // rows run against b
                sums[modulo(k + orders, columns) * count + static_cast<std::size_t>(m + orders)] +=
                    along * roots_b[modulo(-k * row, map.rows)];
        }
    }
    std::vector<double> efficiencies;
    const auto cells = static_cast<double>(map.heights.size());
    for (const Amplitude& sum : sums) efficiencies.push_back(std::norm(sum / cells));
    return efficiencies;
}

}  // namespace

glm::dmat2 reciprocal(const Lattice& lattice) {
    return glm::transpose(glm::inverse(glm::dmat2(lattice.a_nm, lattice.b_nm)));
}

std::vector<double> lattice_efficiencies(const Lattice& lattice, double wavelength_nm) {
    return std::visit(
        [&](const auto& profile) { return efficiencies_of(profile, lattice, lattice.orders, wavelength_nm); },
        lattice.profile);
}

double lattice_zero_order(const Lattice& lattice, double wavelength_nm) {
    return std::visit([&](const auto& profile) { return efficiencies_of(profile, lattice, 0, wavelength_nm)[0]; },
                      lattice.profile);
}

}  // namespace rowland::diffraction
