// Numbers as text and back, by JavaScript: the C library's functions would be a tenth of a module. The sources of the
// bake call these instead (CMakeLists.txt).
#include <algorithm>
#include <cstdarg>
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
    *end = const_cast<char*>(at);
    return found ? worker_number(text, static_cast<std::size_t>(at - text)) : 0.0;
}

/// What the JSON library prints: bytes of text that is not UTF-8, in hexadecimal.
int snprintf(char* text, std::size_t size, const char* format, ...) {
    std::va_list values;
    va_start(values, format);
    std::string out;
    for (; *format != '\0'; ++format) {
        if (*format != '%') {
            out += *format;
            continue;
        }
        while (*format != 'x' && *format != 'X') ++format;
        const unsigned value = va_arg(values, unsigned);
        const int digits = format[-1] - '0';
        for (int shift = 4 * digits - 4; shift >= 0; shift -= 4) out += "0123456789abcdef"[value >> shift & 15];
    }
    va_end(values);
    out.copy(text, size - 1);
    text[std::min(out.size(), size - 1)] = '\0';
    return static_cast<int>(out.size());
}
}

namespace fmt {

std::string number_text(double number) {
    char text[32];
    return {text, worker_text(number, text)};
}

}  // namespace fmt
