#include "engine/core/program.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>

#include "engine/core/error.h"
#include "engine/core/log.h"

namespace rowland {

int run_program(const std::function<int()>& body) {
    try {
        const int code = body();
        // A full disk or a closed pipe shows only when the results leave the buffer.
        if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
            throw Error({.file = "standard output",
                         .place = {},
                         .found = fmt::format("writing failed: {}", std::strerror(errno)),
                         .expected = {},
                         .remedy = {},
                         .fault = Fault::System});
        return code;
    } catch (const Error& error) {
        log_error("{}", error.what());
        return error.info().fault == Fault::Input ? 2 : 1;
    } catch (const std::bad_alloc&) {
        log_error("out of memory");
        return 1;
    } catch (const std::exception& error) {
        log_error("{}", error.what());
        return 1;
    }
}

}  // namespace rowland
