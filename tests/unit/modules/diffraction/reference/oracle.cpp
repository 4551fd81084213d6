#include "tests/unit/modules/diffraction/reference/oracle.h"

#include <glm/geometric.hpp>
#include <sstream>
#include <stdexcept>

namespace rowland::diffraction::test {

using rowland::test::Csv;

namespace {

glm::dvec3 vector(const Csv& table, std::size_t row, const std::string& prefix) {
    return {table.number(row, prefix + "x"), table.number(row, prefix + "y"), table.number(row, prefix + "z")};
}

ShadingPoint frame(const Csv& table, std::size_t row) {
    return {.view = vector(table, row, "v"), .normal = vector(table, row, "n"), .grating = vector(table, row, "g")};
}

Grating grating(const Csv& table, std::size_t row) {
    Grating result;
    result.pitch_nm = table.number(row, "pitch_nm");
    const std::string& profile = table.text(row, "profile");
    if (profile == "slit") {
        result.profile = SlitProfile{table.number(row, "p1")};
    } else if (profile == "lamellar") {
        result.profile = LamellarProfile{table.number(row, "p1"), table.number(row, "p2")};
    } else if (profile == "sinusoidal") {
        result.profile = SinusoidalProfile{table.number(row, "p1")};
    } else {
        throw std::runtime_error("no such profile: " + profile);
    }
    if (!table.text(row, "sigma_h").empty()) result.lobe = GaussianLobe{table.number(row, "sigma_h")};
    std::istringstream orders(table.text(row, "orders"));
    result.orders.clear();
    for (int order = 0; orders >> order;) result.orders.push_back(order);
    return result;
}

}  // namespace

std::vector<ShadingPoint> read_frames(const Csv& table) {
    std::vector<ShadingPoint> frames;
    for (std::size_t row = 0; row < table.rows.size(); ++row) frames.push_back(frame(table, row));
    return frames;
}

std::vector<glm::dvec3> read_xyz(const Csv& table) {
    std::vector<glm::dvec3> xyz;
    for (std::size_t row = 0; row < table.rows.size(); ++row)
        xyz.emplace_back(table.number(row, "X"), table.number(row, "Y"), table.number(row, "Z"));
    return xyz;
}

std::vector<OracleCase> read_cases(const std::filesystem::path& path) {
    const Csv table = rowland::test::read_csv(path);
    const std::vector<glm::dvec3> xyz = read_xyz(table);
    std::vector<OracleCase> cases;
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
        const std::string& name = table.text(row, "case");
        if (cases.empty() || cases.back().name != name) cases.push_back({name, grating(table, row), {}, {}});
        cases.back().frames.push_back(frame(table, row));
        cases.back().xyz.push_back(xyz[row]);
    }
    return cases;
}

lighting::ShLight read_sh_light(const std::filesystem::path& path) {
    const Csv table = rowland::test::read_csv(path);
    lighting::ShLight light;
    light.bands = static_cast<int>(std::lround(std::sqrt(static_cast<double>(table.rows.size()))));
    light.coefficients.resize(table.rows.size());
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
        const int l = table.integer(row, "l");
        const auto index = static_cast<std::size_t>(l * (l + 1) + table.integer(row, "m"));
        light.coefficients.at(index) = {table.number(row, "r"), table.number(row, "g"), table.number(row, "b")};
    }
    return light;
}

double relative_rms(const std::vector<glm::dvec3>& found, const std::vector<glm::dvec3>& expected) {
    if (found.size() != expected.size()) throw std::runtime_error("another number of results than expected");
    double difference = 0.0;
    double scale = 0.0;
    for (std::size_t i = 0; i < found.size(); ++i) {
        const glm::dvec3 error = found[i] - expected[i];
        difference += glm::dot(error, error);
        scale += glm::dot(expected[i], expected[i]);
    }
    return std::sqrt(difference / scale);
}

}  // namespace rowland::diffraction::test
