#pragma once

#include <stdexcept>
#include <string>

namespace rowland {

/// Who is at fault: the user's input or arguments (exit code 2), or the system under us (exit code 1).
enum class Fault { Input, System };

/// What a user needs to repair a failure. Empty fields are left out of the message.
struct ErrorInfo {
    std::string file;      ///< the file (or option) at fault, as the user named it
    std::string location;  ///< where in it: line and column, JSON pointer, byte offset, row
    std::string found;     ///< what was there
    std::string expected;  ///< what should have been there
    std::string remedy;    ///< what to do about it
    Fault fault = Fault::Input;
};

/// The one exception type: bad input or a failing system. Logic errors are ROWLAND_CHECKs, not exceptions.
/// what() is one line, "file: location: found; expected X; remedy": control characters in the fields are shown as \xNN
/// and overlong fields are shortened.
class Error : public std::runtime_error {
 public:
    explicit Error(ErrorInfo info);

    const ErrorInfo& info() const { return info_; }

 private:
    ErrorInfo info_;
};

/// Throws Error (input).
[[noreturn]] void refuse_input(std::string file, std::string location, std::string found, std::string expected,
                               std::string remedy = "");
/// Throws Error (system).
[[noreturn]] void fail_system(std::string file, std::string found, std::string remedy = "", std::string expected = "");

}  // namespace rowland
