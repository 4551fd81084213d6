// Numbers as text and back, by JavaScript: the C library's functions would be a tenth of a module. The bake's sources
// call these instead (CMakeLists.txt).
#include <cstddef>
#include <cstdlib>
#include <string>

#include "content/web/bake/exports.h"

extern "C" {

ROWLAND_IMPORT(number) double worker_number(const char* text, std::size_t length);
ROWLAND_IMPORT(text) std::size_t worker_text(double number, char* text);

/// A decimal number at the beginning of a text.
double strtod(const char* text, char** end) {
    const char* at = text;
    const auto skip_sign = [&] { at += *at == '+' || *at == '-' ? 1 : 0; };
    const auto skip_digits = [&] {
        const char* begin = at;
        while (*at >= '0' && *at <= '9') ++at;
        return at != begin;
    };
    skip_sign();
    bool found = skip_digits();
    if (*at == '.') {
        ++at;
        found = skip_digits() || found;
    }
    if (found && (*at == 'e' || *at == 'E')) {
        const char* mantissa = at++;
        skip_sign();
        if (!skip_digits()) at = mantissa;
    }
    if (!found) at = text;
    if (end != nullptr) *end = const_cast<char*>(at);
    return found ? worker_number(text, static_cast<std::size_t>(at - text)) : 0.0;
}
}

namespace fmt {

std::string number_text(double number) {
    char text[32];
    return {text, worker_text(number, text)};
}

}  // namespace fmt
