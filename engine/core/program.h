#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace rowland {

/// Runs a program's body. The exit code is what `body` returns, 2 for bad input or usage, or 1 for any other failure,
/// such as results that could not be written. Errors are printed as one line on standard error.
int run_program(const std::function<int()>& body);

/// "PROGRAM 0.1.0, commit 0123456789ab, GNU 12.2.0 Release". The commit is read from a file that the build writes
/// ("unknown" if it is missing) and not compiled in: a program that changed with each commit would cook all assets
/// again.
std::string version_text(const std::string& program);

/// The folder above the program's, of a build or an installation: beside the programs lie cooked/, content/ and fonts/.
std::filesystem::path program_prefix();

/// The folder that holds content/ and the shaders: `sources`, from which the program was built; or, where that is not
/// on this machine, program_prefix().
std::filesystem::path resources_folder(const std::filesystem::path& sources);

/// The folder of helper programs that the library was built for. Weak: find_package(Rowland) defines it for other
/// projects' programs as the folder of the package it found.
const char* installed_helper_folder();

/// The path of the helper program `name`: in the folder $ROWLAND_HELPER_FOLDER, else beside the running program or the
/// shared library that holds this code, in the installation's folder relative to either (../libexec/rowland), or in
/// installed_helper_folder(). Throws Error (system) if it is in none of them.
std::filesystem::path helper_program(const std::string& name);

}  // namespace rowland
