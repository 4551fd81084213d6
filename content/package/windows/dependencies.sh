#!/usr/bin/env bash
# Builds the libraries that Rowland needs for 64-bit Windows, from Debian's source packages, as static libraries.
# usage: dependencies.sh CACHE    (installs into CACHE/libraries; a library that is there stays)
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
cache=$(mkdir -p "$1" && cd "$1" && pwd)
prefix="$cache/libraries" sources="$cache/sources" logs="$cache/logs"
triple=x86_64-w64-mingw32
export CC="$triple-gcc-posix" CXX="$triple-g++-posix" AR="$triple-ar" RANLIB="$triple-ranlib"
flags="-O2 -Wa,-muse-unaligned-vector-move -fno-ipa-ra" # the reasons are in toolchain.cmake
jobs=${ROWLAND_JOBS:-$(nproc)}
mkdir -p "$prefix"/{include,lib/pkgconfig} "$sources" "$logs"

say() { printf '%s\n' "$*" >&2; }

# Both suites, as the newer one has the sources of some packages that the older one's mirrors miss.
suites=(bookworm trixie)
apt() {
    apt-get -o Dir::Etc::sourcelist="$cache/apt/sources.list" -o Dir::Etc::sourceparts=- -o Dir::Etc::preferencesparts=- \
        -o Dir::State::lists="$cache/apt/lists" -o Dir::Cache="$cache/apt" -o APT::Get::List-Cleanup=false "$@"
}

# The user's own list of sources stays as it is.
prepare_apt() {
    [ -f "$cache/apt/sources.list" ] && return
    mkdir -p "$cache/apt/lists/partial" "$cache/apt/archives/partial"
    local suite list=""
    for suite in "${suites[@]}"; do
        list+="deb-src [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg]"
        list+=" http://deb.debian.org/debian $suite main"$'\n'
    done
    printf '%s' "$list" >"$cache/apt/sources.list.new"
    apt -o Dir::Etc::sourcelist="$cache/apt/sources.list.new" update -qq
    mv "$cache/apt/sources.list.new" "$cache/apt/sources.list"
}

# unpack NAME: Debian's source of the package, with Debian's patches; without them where only upstream's archive can be had.
unpack() {
    local name=$1 suite
    [ -d "$sources/$name" ] && return
    prepare_apt
    local folder="$sources/.$name"
    rm -rf "$folder"
    mkdir -p "$folder/archives"
    cd "$folder/archives"
    if apt source -qq --download-only "$name/${suites[0]}" >&2; then
        dpkg-source --no-check -x ./*.dsc ../tree >/dev/null
    else
        say "note: not all of $name's source package can be had; taking upstream's archive alone"
        for suite in "${suites[@]}"; do
            rm -f ./*
            apt source -qq --download-only --tar-only "$name/$suite" >&2 && break
        done
        mkdir ../tree
        tar -xf ./*.orig.tar.* -C ../tree
        # Some archives hold their files in a folder, some do not.
        local inside=(../tree/*)
        [ ${#inside[@]} -ne 1 ] || { mv "${inside[0]}" ../inner; rmdir ../tree 2>/dev/null || rm -rf ../tree; mv ../inner ../tree; }
    fi
    cd "$cache"
    mv "$folder/tree" "$sources/$name"
    rm -rf "$folder"
}

# by_cmake NAME SUBFOLDER OPTION...
by_cmake() {
    local name=$1 subfolder=$2
    shift 2
    cmake -S "$sources/$name/$subfolder" -B "$cache/build/$name" -G Ninja -DCMAKE_BUILD_TYPE=Release \
        -DCMAKE_TOOLCHAIN_FILE="$here/toolchain.cmake" -DROWLAND_WINDOWS_LIBRARIES="$prefix" -DCMAKE_INSTALL_PREFIX="$prefix" \
        -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_INSTALL_LIBDIR:STRING=lib -DBUILD_SHARED_LIBS=OFF -DBUILD_TESTING=OFF \
        -DCMAKE_POLICY_DEFAULT_CMP0077=NEW "${launcher[@]}" "$@"
    cmake --build "$cache/build/$name" -j "$jobs"
    cmake --install "$cache/build/$name"
}
launcher=()
command -v ccache >/dev/null && launcher=(-DCMAKE_C_COMPILER_LAUNCHER=ccache -DCMAKE_CXX_COMPILER_LAUNCHER=ccache)

# pc NAME LIBS REQUIRES CFLAGS: a pkg-config file for a library that has none, or one that omits what a static link needs.
pc() {
    cat >"$prefix/lib/pkgconfig/$1.pc" <<PC
prefix=$prefix
libdir=\${prefix}/lib
includedir=\${prefix}/include
Name: $1
Description: $1, static, for Windows
Version: 0
Requires: $3
Libs: -L\${libdir} $2
Cflags: -I\${includedir} $4
PC
}

# ---- the libraries, each after those it needs

# Debian's source leaves win32/ out, without which upstream's build systems refuse Windows.
build_zlib() {
    mkdir -p "$cache/build/zlib"
    (cd "$cache/build/zlib" && "$CC" $flags -c "$sources/zlib"/*.c)
    "$AR" rcs "$prefix/lib/libz.a" "$cache/build/zlib"/*.o
    cp "$sources/zlib"/{zlib,zconf}.h "$prefix/include/"
}
build_libpng1.6() { by_cmake libpng1.6 . -DPNG_SHARED=OFF -DPNG_TESTS=OFF; }
build_libjpeg-turbo() { by_cmake libjpeg-turbo . -DENABLE_SHARED=OFF -DWITH_TURBOJPEG=ON; }
build_libwebp() {
    by_cmake libwebp . -DWEBP_BUILD_{ANIM_UTILS,CWEBP,DWEBP,GIF2WEBP,IMG2WEBP,VWEBP,WEBPINFO,EXTRAS}=OFF -DWEBP_BUILD_WEBPMUX=OFF
}
build_libzstd() { by_cmake libzstd build/cmake -DZSTD_BUILD_SHARED=OFF -DZSTD_BUILD_PROGRAMS=OFF -DZSTD_BUILD_TESTS=OFF; }
build_xxhash() { by_cmake xxhash cmake_unofficial -DXXHASH_BUILD_XXHSUM=OFF; }
build_fmtlib() { by_cmake fmtlib . -DFMT_TEST=OFF -DFMT_DOC=OFF; }
build_onetbb() {
    by_cmake onetbb . -DTBB_TEST=OFF -DTBB_STRICT=OFF -DTBBMALLOC_BUILD=OFF -DTBB_ENABLE_IPO=OFF \
        -DTBB_DISABLE_HWLOC_AUTOMATIC_SEARCH=ON
}
build_draco() { by_cmake draco . -DDRACO_TESTS=OFF; }
build_imath() { by_cmake imath . -DPYTHON=OFF; }
build_openexr() {
    by_cmake openexr . -DOPENEXR_BUILD_TOOLS=OFF -DOPENEXR_INSTALL_TOOLS=OFF -DOPENEXR_INSTALL_EXAMPLES=OFF
}
# Debian's patches compare XML_DTD with 1, which upstream's CMake files define without a value.
build_expat() {
    sed -i 's/^#cmakedefine XML_DTD$/#cmakedefine XML_DTD 1/' "$sources/expat/expat/expat_config.h.cmake"
    by_cmake expat expat -DEXPAT_SHARED_LIBS=OFF -DEXPAT_BUILD_TOOLS=OFF -DEXPAT_BUILD_EXAMPLES=OFF -DEXPAT_BUILD_TESTS=OFF
}
build_yaml-cpp() {
    by_cmake yaml-cpp . -DYAML_BUILD_SHARED_LIBS=OFF -DYAML_CPP_BUILD_TESTS=OFF -DYAML_CPP_BUILD_TOOLS=OFF
}
# Upstream's Makefile makes a .so alone.
build_pystring() {
    mkdir -p "$cache/build/pystring" "$prefix/include/pystring"
    "$CXX" $flags -c "$sources/pystring/pystring.cpp" -o "$cache/build/pystring/pystring.o"
    "$AR" rcs "$prefix/lib/libpystring.a" "$cache/build/pystring/pystring.o"
    cp "$sources/pystring/pystring.h" "$prefix/include/pystring/"
}
# As Debian builds it: its SSE code has coarser exponentials and logarithms, ten times as far from what a GPU computes.
build_opencolorio() {
    by_cmake opencolorio . -DOCIO_USE_SSE=OFF -DOCIO_INSTALL_EXT_PACKAGES=NONE -DOCIO_BUILD_APPS=OFF -DOCIO_BUILD_TESTS=OFF \
        -DOCIO_BUILD_GPU_TESTS=OFF -DOCIO_BUILD_PYTHON=OFF -DOCIO_BUILD_DOCS=OFF -DOCIO_BUILD_OPENFX=OFF -DOCIO_WARNING_AS_ERROR=OFF
    pc OpenColorIO "-lOpenColorIO -lyaml-cpp -lpystring -lexpat -lImath-3_1 -lgdi32 -luser32" "" "-DOpenColorIO_SKIP_IMPORTS"
}
build_libepoxy() {
    cat >"$cache/meson.cross" <<CROSS
[binaries]
c = '$CC'
ar = '$AR'
strip = '$triple-strip'
windres = '$triple-windres'
pkgconfig = 'pkg-config'
[host_machine]
system = 'windows'
cpu_family = 'x86_64'
cpu = 'x86_64'
endian = 'little'
CROSS
    rm -rf "$cache/build/libepoxy"
    meson setup "$cache/build/libepoxy" "$sources/libepoxy" --cross-file "$cache/meson.cross" --prefix "$prefix" --libdir lib \
        --buildtype release --default-library static -Degl=no -Dglx=no -Dx11=false -Dtests=false
    ninja -C "$cache/build/libepoxy" -j "$jobs" install
    pc epoxy "-lepoxy -lopengl32 -lgdi32" "" ""
}
build_glfw3() { by_cmake glfw3 . -DGLFW_BUILD_DOCS=OFF -DGLFW_BUILD_TESTS=OFF -DGLFW_BUILD_EXAMPLES=OFF; }
build_libstb() {
    make -C "$sources/libstb" MULTIARCH= CC="$CC" AR="$AR" CFLAGS="$flags -fwrapv -w" -j "$jobs" libstb.a
    mkdir -p "$prefix/include/stb"
    cp "$sources/libstb"/*.h "$prefix/include/stb/"
    cp "$sources/libstb/libstb.a" "$prefix/lib/"
    pc stb "-lstb" "" "-I$prefix/include/stb"
}
# Debian's Makefile, less the parts for other windowing libraries.
build_imgui() {
    local tree="$sources/imgui"
    local from=("$tree"/*.cpp "$tree/misc/cpp"/*.cpp "$tree"/backends/imgui_impl_{glfw,opengl3}.cpp) to="$cache/build/imgui" file
    mkdir -p "$to" "$prefix/include/imgui/backends"
    for file in "${from[@]}"; do
        "$CXX" $flags -I"$tree" -I"$prefix/include" -DIMGUI_DISABLE_STB_RECT_PACK_IMPLEMENTATION \
            -DIMGUI_STB_RECT_PACK_FILENAME="<stb/stb_rect_pack.h>" -DIMGUI_DISABLE_STB_TRUETYPE_IMPLEMENTATION \
            -DIMGUI_STB_TRUETYPE_FILENAME="<stb/stb_truetype.h>" -c "$file" -o "$to/$(basename "$file" .cpp).o"
    done
    rm -f "$prefix/lib/libimgui.a"
    "$AR" rcs "$prefix/lib/libimgui.a" "$to"/*.o
    cp "$tree"/*.h "$tree/misc/cpp"/*.h "$prefix/include/imgui/"
    cp "$tree"/backends/imgui_impl_{glfw,opengl3}.h "$prefix/include/imgui/backends/"
    pc imgui "-limgui -limm32" "stb" "-I$prefix/include/imgui"
}
build_googletest() { by_cmake googletest . -DBUILD_GMOCK=ON; }
build_rapidcheck() { by_cmake rapidcheck . -DRC_ENABLE_GTEST=ON -DCMAKE_CXX_STANDARD=14; }

# Libraries that are headers alone come from the installed Debian packages.
headers=(libglm-dev libcli11-dev nlohmann-json3-dev libeigen3-dev libtinygltf-dev)
copy_headers() {
    local file
    for file in $(dpkg -L "${headers[@]}" | grep -E '^/usr/(include|share/(cmake|eigen3|pkgconfig))/'); do
        [ ! -f "$file" ] || install -D -m 644 "$file" "$prefix/${file#/usr/}"
    done
}

libraries=(zlib libpng1.6 libjpeg-turbo libwebp libzstd xxhash fmtlib googletest onetbb libepoxy glfw3 libstb imgui imath openexr
    expat yaml-cpp pystring opencolorio draco rapidcheck)
for name in "${libraries[@]}"; do
    [ -f "$prefix/.built-$name" ] && continue
    say "building $name"
    # A subshell of its own process: "set -e" does not hold in a condition.
    (set -e; unpack "$name"; "build_$name") >"$logs/$name.log" 2>&1 &
    wait $! || { tail -n 40 "$logs/$name.log" >&2; say "error: $name was not built: see $logs/$name.log"; exit 1; }
    touch "$prefix/.built-$name"
    rm -rf "$cache/build/$name"
done
copy_headers
# What the zip must say about each.
mkdir -p "$prefix/licences"
for name in "${libraries[@]}"; do
    for file in "$sources/$name"/{debian/copyright,COPYING,LICENSE*,LICENSE.md}; do
        [ ! -f "$file" ] || { cp "$file" "$prefix/licences/$name.txt"; break; }
    done
done
for name in "${headers[@]}"; do cp -L "/usr/share/doc/$name/copyright" "$prefix/licences/$name.txt"; done
say "the libraries are in $prefix"
