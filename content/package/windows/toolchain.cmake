# Cross-compiles for 64-bit Windows by Debian's MinGW-w64. ROWLAND_WINDOWS_LIBRARIES is where dependencies.sh installed the
# libraries.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR AMD64)
set(triple x86_64-w64-mingw32)
# The "posix" variant has the threads of C++11.
set(CMAKE_C_COMPILER ${triple}-gcc-posix)
set(CMAKE_CXX_COMPILER ${triple}-g++-posix)
set(CMAKE_RC_COMPILER ${triple}-windres)
# Programs contain the compiler's libraries, so that they start from any folder. GCC takes the stack of Windows for aligned to
# 32 bytes, which it is not (GCC bug 54412), so the assembler turns aligned moves of AVX registers into unaligned ones. With -fipa-ra
# a caller relies on the registers that its own copy of an inline function leaves alone, where the linker may have kept another
# copy, of a source with other options.
set(CMAKE_C_FLAGS_INIT "-Wa,-muse-unaligned-vector-move -Wa,-mbig-obj -fno-ipa-ra")
set(CMAKE_CXX_FLAGS_INIT "-Wa,-muse-unaligned-vector-move -Wa,-mbig-obj -fno-ipa-ra")
set(CMAKE_EXE_LINKER_FLAGS_INIT "-static")

if(NOT ROWLAND_WINDOWS_LIBRARIES)
  set(cache "$ENV{ROWLAND_WINDOWS_CACHE}")
  if(NOT cache)
    cmake_path(ABSOLUTE_PATH CMAKE_CURRENT_LIST_DIR NORMALIZE OUTPUT_VARIABLE here)
    cmake_path(SET cache NORMALIZE "${here}/../../../build/windows-cache")
  endif()
  set(ROWLAND_WINDOWS_LIBRARIES "${cache}/libraries")
endif()
set(ROWLAND_WINDOWS_LIBRARIES "${ROWLAND_WINDOWS_LIBRARIES}" CACHE PATH "The libraries that dependencies.sh installed")
# CMake's own trial projects include this file as well.
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES ROWLAND_WINDOWS_LIBRARIES)
set(CMAKE_FIND_ROOT_PATH ${ROWLAND_WINDOWS_LIBRARIES} /usr/${triple} ${CMAKE_PREFIX_PATH})
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
set(PKG_CONFIG_EXECUTABLE /usr/bin/pkg-config)
set(PKG_CONFIG_ARGN --static)
set(ENV{PKG_CONFIG_LIBDIR} ${ROWLAND_WINDOWS_LIBRARIES}/lib/pkgconfig:${ROWLAND_WINDOWS_LIBRARIES}/share/pkgconfig)
set(ENV{PKG_CONFIG_PATH} "")
set(CMAKE_CROSSCOMPILING_EMULATOR ${CMAKE_CURRENT_LIST_DIR}/wine.sh)
