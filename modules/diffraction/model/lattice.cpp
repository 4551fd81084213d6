#include "modules/diffraction/model/lattice.h"

#include <Eigen/Core>
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

/// exp(−2πi m j/count) of sample j < count, a row each, and order m, a column each.
Eigen::MatrixXcd fourier_matrix(int count, int orders) {
    std::vector<Amplitude> roots;
    for (int j = 0; j < count; ++j) roots.push_back(std::polar(1.0, -2.0 * pi * j / count));
    return Eigen::MatrixXcd::NullaryExpr(count, 2 * orders + 1, [&](Eigen::Index j, Eigen::Index column) {
        const Eigen::Index turns = (column - orders) * j % count;
        return roots[static_cast<std::size_t>(turns < 0 ? turns + count : turns)];
    });
}

/// |DFT(e^(iφ))|² of one cell: first along the rows, then across them.
std::vector<double> efficiencies_of(const HeightMap& map, const Lattice&, int orders, double wavelength_nm) {
    ROWLAND_CHECK_OP(map.heights.size(), ==,
                     static_cast<std::size_t>(map.columns) * static_cast<std::size_t>(map.rows));
    std::array<Amplitude, 256> reflected;
    for (std::size_t height = 0; height < reflected.size(); ++height)
        reflected[height] =
            std::polar(1.0, 4.0 * pi * map.depth_nm / wavelength_nm * static_cast<double>(height) / 255.0);
    const auto cell = Eigen::MatrixXcd::NullaryExpr(map.rows, map.columns, [&](Eigen::Index row, Eigen::Index column) {
        return reflected[map.heights[static_cast<std::size_t>(row * map.columns + column)]];
    });
    const Eigen::MatrixXcd along_rows = cell * fourier_matrix(map.columns, orders);
    // Rows run against b, so the exponent's sign is the other one. A column for each k.
    const Eigen::MatrixXcd sums = along_rows.transpose() * fourier_matrix(map.rows, orders).conjugate();
    std::vector<double> efficiencies;
    const auto cells = static_cast<double>(map.heights.size());
    for (const Amplitude& sum : sums.reshaped()) efficiencies.push_back(std::norm(sum / cells));
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
