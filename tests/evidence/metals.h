#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/colour/spectrum.h"

namespace rowland::evidence {

/// A metal's refractive index as one author measured it.
struct IndexTable {
    colour::Metal metal{};
    std::string author;  ///< "Rakic 1995"
    std::vector<double> wavelengths_nm;
    std::vector<double> n;
    std::vector<double> k;
};

/// The tables of a folder: files METAL_Author_year.csv of wavelength_nm,n,k. Sorted by name. Throws Error (input) for a
/// malformed file and a folder without one.
std::vector<IndexTable> read_index_tables(const std::filesystem::path& folder);

/// The reflectance of a polished surface at normal incidence, in air. Linear in n and k between the table's rows,
/// constant beyond its ends.
double reflectance(const IndexTable& table, double wavelength_nm);

}  // namespace rowland::evidence
