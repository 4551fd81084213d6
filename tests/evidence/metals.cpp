#include "tests/evidence/metals.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "engine/colour/illuminant.h"
#include "engine/core/error.h"
#include "engine/core/text.h"
#include "tests/evidence/section.h"

namespace rowland::evidence {

namespace {

constexpr double kFrom_nm = 400.0;
constexpr double kTo_nm = 750.0;
constexpr double kEvery_nm = 5.0;

/// "Rakic 1995" of "Al_Rakic_1995".
std::string author_of(const std::string& stem) {
    std::string author = stem.substr(stem.find('_') + 1);
    std::ranges::replace(author, '_', ' ');
    return author;
}

/// Mean reflectance under a flat spectrum as an eye weighs it (CIE Y).
template <typename Reflectance>
double luminous_reflectance(const Reflectance& reflectance_at) {
    double sum = 0.0;
    double weight = 0.0;
    for (double wavelength_nm = kFrom_nm; wavelength_nm <= kTo_nm; wavelength_nm += kEvery_nm) {
        const double y = colour::cie_xyz(wavelength_nm).y;
        sum += y * reflectance_at(wavelength_nm);
        weight += y;
    }
    return sum / weight;
}

/// What the tables of one metal say.
struct MetalSpread {
    colour::Metal metal{};
    std::vector<const IndexTable*> tables;

    double ours(double wavelength_nm) const { return colour::metal_reflectance(metal, wavelength_nm); }
    /// The least and the largest reflectance of all tables.
    std::pair<double, double> range(double wavelength_nm) const {
        std::pair<double, double> result(1.0, 0.0);
        for (const IndexTable* table : tables) {
            const double value = reflectance(*table, wavelength_nm);
            result = {std::min(result.first, value), std::max(result.second, value)};
        }
        return result;
    }
    /// Half of the mean width of that range.
    double error_bar() const {
        return 0.5 * luminous_reflectance([&](double wavelength_nm) {
                   const auto [low, high] = range(wavelength_nm);
                   return high - low;
               });
    }
    /// RMS over wavelengths of our reflectance from the median of the tables.
    double from_median() const {
        double sum = 0.0;
        int count = 0;
        for (double wavelength_nm = kFrom_nm; wavelength_nm <= kTo_nm; wavelength_nm += kEvery_nm, ++count) {
            std::vector<double> values;
            for (const IndexTable* table : tables) values.push_back(reflectance(*table, wavelength_nm));
            std::ranges::sort(values);
            const double median = 0.5 * (values[(values.size() - 1) / 2] + values[values.size() / 2]);
            sum += std::pow(ours(wavelength_nm) - median, 2);
        }
        return std::sqrt(sum / count);
    }
};

Json metal_plot(const MetalSpread& spread) {
    double least = 1.0;
    Json band = Json::array();
    Json ours = Json::array();
    for (double wavelength_nm = kFrom_nm; wavelength_nm <= kTo_nm; wavelength_nm += kEvery_nm) {
        const auto [low, high] = spread.range(wavelength_nm);
        band.push_back({wavelength_nm, low, high});
        least = std::min({least, low, spread.ours(wavelength_nm)});
        ours.push_back({wavelength_nm, spread.ours(wavelength_nm)});
    }
    Json series = {{{"name", "all sources"}, {"kind", "band"}, {"points", band}},
                   {{"name", "in use"}, {"kind", "line"}, {"points", ours}}};
    for (const IndexTable* table : spread.tables) {
        Json points = Json::array();
        for (const double wavelength_nm : table->wavelengths_nm)
            if (wavelength_nm >= kFrom_nm && wavelength_nm <= kTo_nm)
                points.push_back({wavelength_nm, reflectance(*table, wavelength_nm)});
        series.push_back({{"name", table->author}, {"kind", "points"}, {"points", points}});
    }
    return {
        {"caption", colour::metal_name(spread.metal)},
        {"x", {{"label", "wavelength (nm)"}, {"from", kFrom_nm}, {"to", kTo_nm}}},
        {"y", {{"label", "reflectance at normal incidence"}, {"from", std::floor(10.0 * least) / 10.0}, {"to", 1.0}}},
        {"series", series}};
}

}  // namespace

std::vector<IndexTable> read_index_tables(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    std::error_code missing;
    for (const auto& entry : std::filesystem::directory_iterator(folder, missing))
        if (entry.path().extension() == ".csv") files.push_back(entry.path());
    if (files.empty()) refuse_input(folder.string(), "", "no tables", "files METAL_Author_year.csv");
    std::ranges::sort(files);
    std::vector<IndexTable> tables;
    for (const std::filesystem::path& file : files) {
        const std::string stem = file.stem().string();
        const auto metal = colour::parse_metal(stem.substr(0, stem.find('_')));
        if (!metal || stem.size() < 4)
            refuse_input(file.string(), "", "another name", "METAL_Author_year.csv, as Al_Rakic_1995.csv");
        IndexTable table{.metal = *metal, .author = author_of(stem), .wavelengths_nm = {}, .n = {}, .k = {}};
        for (const auto& row : read_number_table(file, "wavelength_nm,n,k").rows) {
            table.wavelengths_nm.push_back(row[0]);
            table.n.push_back(row[1]);
            table.k.push_back(row[2]);
        }
        if (table.n.size() < 2 || !std::ranges::is_sorted(table.wavelengths_nm))
            refuse_input(file.string(), "", "rows out of order", "two rows or more, their wavelengths ascending");
        tables.push_back(std::move(table));
    }
    return tables;
}

double reflectance(const IndexTable& table, double wavelength_nm) {
    const auto& x = table.wavelengths_nm;
    const auto above = std::ranges::upper_bound(x, wavelength_nm);
    const auto i =
        static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(std::distance(x.begin(), above) - 1, 0, std::ssize(x) - 2));
    const double t = std::clamp((wavelength_nm - x[i]) / (x[i + 1] - x[i]), 0.0, 1.0);
    const double n = std::lerp(table.n[i], table.n[i + 1], t);
    const double k = std::lerp(table.k[i], table.k[i + 1], t);
    return ((n - 1.0) * (n - 1.0) + k * k) / ((n + 1.0) * (n + 1.0) + k * k);
}

Json metals(const Inputs& /*inputs*/) {
    const std::vector<IndexTable> tables = read_index_tables(ROWLAND_SOURCE_FOLDER "/tests/evidence/data/metals");
    Json rows = Json::array();
    Json plots = Json::array();
    Json figures;
    std::string outside;
    for (const std::string& name : colour::metal_names()) {
        MetalSpread spread{.metal = *colour::parse_metal(name), .tables = {}};
        std::string authors;
        for (const IndexTable& table : tables)
            if (table.metal == spread.metal) {
                spread.tables.push_back(&table);
                authors += (authors.empty() ? "" : ", ") + table.author;
            }
        if (spread.tables.empty()) continue;
        const double ours = luminous_reflectance([&](double wavelength_nm) { return spread.ours(wavelength_nm); });
        double low = 1.0;
        double high = 0.0;
        for (const IndexTable* table : spread.tables) {
            const double value = luminous_reflectance([&](double nm) { return reflectance(*table, nm); });
            low = std::min(low, value);
            high = std::max(high, value);
        }
        rows.push_back({name, fmt::format("{:.3f}", ours), fmt::format("{:.3f} to {:.3f}", low, high),
                        fmt::format("± {:.3f}", spread.error_bar()), fmt::format("{:.3f}", spread.from_median()),
                        authors});
        plots.push_back(metal_plot(spread));
        if (ours < low || ours > high)
            outside += fmt::format(" The {} in use reflects {:.3f} {} than any other source says.", name,
                                   ours < low ? low - ours : ours - high, ours < low ? "less" : "more");
        figures["metals.luminous_reflectance." + name] = ours;
        figures["metals.error_bar." + name] = spread.error_bar();
        figures["metals.from_median." + name] = spread.from_median();
    }
    return {{"title", "Metals: how well their reflectance is known"},
            {"text",
             {"Reflectance at normal incidence from the refractive indices n + ik that several authors measured; the "
              "spread between them is the error bar of every metal here. Samples differ more than instruments do: "
              "evaporated, sputtered, template-stripped or crystalline, rough or smooth, with or without oxide.",
              std::string(
                  "In use are the tables of the SOPRA collection, for one reason: pbrt and Mitsuba distribute the same "
                  "ones, so that a picture can be compared with theirs.") +
                  outside,
              "The tables and their sources: tests/evidence/data/README.md."}},
            {"tables",
             {{{"caption", "Reflectance weighed as an eye does (CIE Y), 400 to 750 nm"},
               {"columns", {"metal", "in use", "all sources", "error bar", "RMS from the median", "sources"}},
               {"rows", rows}}}},
            {"plots", plots},
            {"figures", figures}};
}

}  // namespace rowland::evidence
