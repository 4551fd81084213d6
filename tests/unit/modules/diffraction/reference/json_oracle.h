#pragma once

#include "tests/unit/modules/diffraction/reference/oracle.h"

namespace rowland::diffraction::test {

/// A case of an oracle file whose rows hold the grating as JSON.
struct JsonCase : OracleCase {
    std::string light;  ///< name of the light; empty: the file has no such column
};

/// The cases of a file with semicolons: consecutive rows of equal name and light.
std::vector<JsonCase> read_json_cases(const std::filesystem::path& path);

}  // namespace rowland::diffraction::test
