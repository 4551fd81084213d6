#include "modules/diffraction/model/colour_kernel.h"

#include <algorithm>
#include <cmath>

#include "engine/core/check.h"
#include "engine/core/parallel.h"
#include "modules/diffraction/model/brdf.h"
#include "modules/diffraction/model/grating.h"

namespace rowland::diffraction {

namespace {

constexpr std::size_t kNanometres = colour::kVisibleMax - colour::kVisibleMin;

/// Nodes of a blurred kernel per width λ/N of the sharpest order: linear interpolation of its peak is then off by
/// 8e-4 of it.
constexpr double kNodesPerWidth = 32.0;

/// Largest step of the phase N x/λ in a sum over wavelengths: 1/8 of the Fejér ratio's period.
constexpr double kPhaseStep = 0.125;

double largest_component(const glm::dmat3& matrix) {
    double largest = 0.0;
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row) largest = std::max(largest, std::abs(matrix[column][row]));
    return largest;
}

/// k(x) of few grooves: every wavelength contributes, by its Fejér ratio.
glm::dmat3 blurred(const Grating& grating, std::span<const glm::dmat3> observed, double steps_per_nm, double x_nm) {
    glm::dmat3 sum(0.0);
    for (std::size_t i = 0; i < observed.size(); ++i) {
        const double step_nm = (i == 0 || i + 1 == observed.size() ? 0.5 : 1.0) / steps_per_nm;
        const double wavelength_nm = colour::kVisibleMin + static_cast<double>(i) / steps_per_nm;
        sum += step_nm * path_density(grating, x_nm, wavelength_nm) * observed[i];
    }
    return sum;
}

/// observed_spectra() at even steps over the visible range.
std::vector<glm::dmat3> observed_at_steps(const colour::LightSpectra& spectra, double steps_per_nm) {
    std::vector<glm::dmat3> observed;
    const auto count = static_cast<std::size_t>(kNanometres * steps_per_nm);
    for (std::size_t i = 0; i <= count; ++i)
        observed.push_back(observed_spectra(spectra, colour::kVisibleMin + static_cast<double>(i) / steps_per_nm));
    return observed;
}

}  // namespace

ColourKernel::Curve::Curve(double start, double step, std::vector<glm::dmat3> values)
    : start_(start), step_(step), values_(std::move(values)), integral_(values_.size(), glm::dmat3(0.0)) {
    ROWLAND_CHECK_OP(values_.size(), >=, std::size_t{2});
    for (std::size_t i = 1; i < values_.size(); ++i)
        integral_[i] = integral_[i - 1] + (0.5 * step_) * (values_[i - 1] + values_[i]);
}

glm::dmat3 ColourKernel::Curve::value(double at) const {
    const double position = (at - start_) / step_;
    const auto last = static_cast<double>(values_.size() - 1);
    if (!(position >= 0.0 && position <= last)) return glm::dmat3(0.0);
    const std::size_t i = std::min(static_cast<std::size_t>(position), values_.size() - 2);
    const double t = position - static_cast<double>(i);
    return (1.0 - t) * values_[i] + t * values_[i + 1];
}

glm::dmat3 ColourKernel::Curve::integral_to(double at) const {
    const double position = (at - start_) / step_;
    if (!(position > 0.0)) return glm::dmat3(0.0);
    if (position >= static_cast<double>(values_.size() - 1)) return integral_.back();
    const auto i = static_cast<std::size_t>(position);
    const double t = position - static_cast<double>(i);
    return integral_[i] + (step_ * t) * ((1.0 - 0.5 * t) * values_[i] + (0.5 * t) * values_[i + 1]);
}

ColourKernel::ColourKernel(const Grating& grating, const colour::LightSpectra& spectra, double v_g) {
    ROWLAND_CHECK_OP(grating.pitch_nm, >, 0.0);
    ROWLAND_CHECK_OP(grating.grooves, >=, 1.0);
    ROWLAND_CHECK(is_solved(grating), "a grating of rigorous theory is solved first");
    if (grating.grooves < kManyGrooves)
        add_wide_orders(grating, spectra);
    else
        add_sharp_orders(grating, observed_at_steps(spectra, 1.0), v_g);
}

void ColourKernel::add_sharp_orders(const Grating& grating, std::span<const glm::dmat3> observed, double v_g) {
    for (const int order : grating.orders) {
        if (grating.efficiencies && !std::ranges::binary_search(grating.efficiencies->orders, order)) continue;
        std::vector<glm::dmat3> values;
        for (std::size_t j = 0; j < observed.size(); ++j) {
            const double wavelength_nm = colour::kVisibleMin + static_cast<double>(j);
            values.push_back(order_efficiency(grating, order, wavelength_nm, v_g) * observed[j]);
        }
        Curve curve(colour::kVisibleMin, 1.0, std::move(values));
        if (order == 0) {
            zero_order_ = curve.integral_to(curve.end());
            continue;
        }
        const auto [low, high] =
            std::minmax({order * double{colour::kVisibleMin}, order * double{colour::kVisibleMax}});
        begin_nm_ = orders_.empty() ? low : std::min(begin_nm_, low);
        end_nm_ = orders_.empty() ? high : std::max(end_nm_, high);
        orders_.push_back({order, std::move(curve)});
    }
}

void ColourKernel::add_wide_orders(const Grating& grating, const colour::LightSpectra& spectra) {
    if (grating.orders.empty()) return;
    // |x| ≤ 2d for all directions; the period of a listed order ends half an order beyond it.
    const double reach_nm = 2.0 * grating.pitch_nm;
    const auto period_end = [](double order) {
        return order * (order > 0.0 ? colour::kVisibleMax : colour::kVisibleMin);
    };
    begin_nm_ = std::clamp(-period_end(0.5 - grating.orders.front()), -reach_nm, reach_nm);
    end_nm_ = std::clamp(period_end(grating.orders.back() + 0.5), -reach_nm, reach_nm);
    if (!(end_nm_ > begin_nm_)) {
        begin_nm_ = end_nm_ = 0.0;
        return;
    }
    const double furthest_nm = std::max(std::abs(begin_nm_), std::abs(end_nm_));
    const double phase_per_nm = grating.grooves * furthest_nm / (colour::kVisibleMin * double{colour::kVisibleMin});
    const double steps_per_nm = std::max(1.0, std::ceil(phase_per_nm / kPhaseStep));
    const std::vector<glm::dmat3> observed = observed_at_steps(spectra, steps_per_nm);

    const double widest_step_nm = std::min(1.0, colour::kVisibleMin / (kNodesPerWidth * grating.grooves));
    const auto cells = static_cast<std::size_t>(std::ceil((end_nm_ - begin_nm_) / widest_step_nm));
    const double step_nm = (end_nm_ - begin_nm_) / static_cast<double>(cells);
    std::vector<glm::dmat3> values(cells + 1);
    parallel_for(values.size(), [&](std::size_t i) {
        values[i] = blurred(grating, observed, steps_per_nm, begin_nm_ + step_nm * static_cast<double>(i));
    });
    orders_.push_back({1, Curve(begin_nm_, step_nm, std::move(values))});
}

glm::dmat3 ColourKernel::operator()(double x_nm) const {
    glm::dmat3 sum(0.0);
    for (const OrderCurve& one : orders_) sum += one.curve.value(x_nm / one.order) / std::abs(double(one.order));
    return sum;
}

glm::dmat3 ColourKernel::antiderivative(double x_nm) const {
    // dx = m dλ: the 1/|m| cancels, the sign stays.
    glm::dmat3 sum(0.0);
    for (const OrderCurve& one : orders_) {
        const glm::dmat3 rise = one.curve.integral_to(x_nm / one.order) - one.curve.integral_to(0.0);
        sum += one.order > 0 ? rise : -rise;
    }
    return sum;
}

glm::dmat3 ColourKernel::average(double begin_nm, double end_nm) const {
    if (begin_nm == end_nm) return (*this)(begin_nm);
    return (antiderivative(end_nm) - antiderivative(begin_nm)) / (end_nm - begin_nm);
}

glm::dmat3 KernelTable::of_view(std::size_t view, std::size_t entry, double t) const {
    const glm::mat3* const first = antiderivative.data() + view * entries() + entry;
    return (1.0 - t) * glm::dmat3(first[0]) + t * glm::dmat3(first[1]);
}

glm::dmat3 KernelTable::at(double x_nm, double v_g) const {
    const auto last = static_cast<double>(entries() - 1);
    const double position =
        end_nm > begin_nm ? std::clamp((x_nm - begin_nm) / (end_nm - begin_nm), 0.0, 1.0) * last : 0.0;
    const std::size_t i = std::min(static_cast<std::size_t>(position), entries() - 2);
    const double t = position - static_cast<double>(i);
    if (views == 1) return of_view(0, i, t);
    const EfficiencyGrid::ViewCell cell = EfficiencyGrid::view_cell(v_g);
    return (1.0 - cell.weight) * of_view(cell.first, i, t) + cell.weight * of_view(cell.first + 1, i, t);
}

glm::dmat3 KernelTable::average(double begin_nm_wanted, double end_nm_wanted, double v_g) const {
    return (at(end_nm_wanted, v_g) - at(begin_nm_wanted, v_g)) / (end_nm_wanted - begin_nm_wanted);
}

KernelTable tabulate(const ColourKernel& kernel, std::size_t entries) {
    ROWLAND_CHECK_OP(entries, >=, std::size_t{2});
    KernelTable table{.begin_nm = kernel.begin_nm(), .end_nm = kernel.end_nm(), .antiderivative = {}};
    const double step_nm = (table.end_nm - table.begin_nm) / static_cast<double>(entries - 1);
    for (std::size_t i = 0; i < entries; ++i)
        table.antiderivative.emplace_back(kernel.antiderivative(table.begin_nm + step_nm * static_cast<double>(i)));
    return table;
}

double interpolation_error(const KernelTable& table, const ColourKernel& kernel) {
    const double rise = largest_component(kernel.antiderivative(table.end_nm) - kernel.antiderivative(table.begin_nm));
    if (rise == 0.0) return 0.0;
    constexpr int kChecked = 7;
    const double step_nm = (table.end_nm - table.begin_nm) / static_cast<double>(table.entries() - 1);
    double largest = 0.0;
    for (std::size_t i = 0; i + 1 < table.entries(); ++i)
        for (int j = 1; j <= kChecked; ++j) {
            const double position = static_cast<double>(i) + static_cast<double>(j) / (kChecked + 1);
            const double x_nm = table.begin_nm + position * step_nm;
            largest = std::max(largest, largest_component(table.at(x_nm) - kernel.antiderivative(x_nm)));
        }
    return largest / rise;
}

KernelTable kernel_table(const Grating& grating, const colour::LightSpectra& spectra) {
    KernelTable table = tabulate(ColourKernel(grating, spectra));
    if (!depends_on_direction(grating)) return table;
    const std::size_t entries = table.entries();
    table.views = EfficiencyGrid::kViews;
    table.antiderivative.resize(entries * EfficiencyGrid::kViews);
    parallel_for(EfficiencyGrid::kViews, [&](std::size_t view) {
        const ColourKernel kernel(grating, spectra, EfficiencyGrid::view_at(static_cast<int>(view)));
        const double step_nm = (table.end_nm - table.begin_nm) / static_cast<double>(entries - 1);
        for (std::size_t i = 0; i < entries; ++i)
            table.antiderivative[view * entries + i] =
                glm::mat3(kernel.antiderivative(table.begin_nm + step_nm * static_cast<double>(i)));
    });
    return table;
}

bool is_even(const KernelTable& kernel) {
    double largest = 0.0;
    double difference = 0.0;
    const double reach = std::max(std::abs(kernel.begin_nm), std::abs(kernel.end_nm));
    // Neighbouring entries and views differ little.
    const auto samples = static_cast<int>(kernel.entries()) / (kernel.views == 1 ? 1 : 8);
    for (int i = 1; i <= samples * kernel.views; ++i) {
        const double v_g = kernel.views == 1 ? 0.0 : EfficiencyGrid::view_at((i - 1) / samples);
        const double x_nm = reach * ((i - 1) % samples + 1) / samples;
        const glm::dmat3 right = kernel.at(x_nm, v_g) - kernel.at(0.0, v_g);
        const glm::dmat3 left = kernel.at(0.0, -v_g) - kernel.at(-x_nm, -v_g);
        largest = std::max(largest, largest_component(right));
        difference = std::max(difference, largest_component(right - left));
    }
    return difference <= 1e-5 * largest;
}

KernelTable in_space(KernelTable kernel, const glm::dmat3& xyz_to_space) {
    for (glm::mat3& value : kernel.antiderivative) value = glm::mat3(xyz_to_space * glm::dmat3(value));
    return kernel;
}

}  // namespace rowland::diffraction
