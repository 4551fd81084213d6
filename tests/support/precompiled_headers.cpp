#include "tests/support/precompiled_headers.h"
