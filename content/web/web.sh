#!/usr/bin/env bash
# web.sh [--out FOLDER] [--port N]: builds the package @rowland/three and the page over it, and serves the page on this
# machine alone, or writes it into a folder. `./rowland web` installs what it needs before. Exits with 3 where the C++
# sources do not compile, with 1 where another step fails.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
build="$here/../../build/web"
site="$build/site" port=8080 serve=1

say() { printf '%s\n' "$*" >&2; }
refuse() { say "error: web takes --out FOLDER and --port N, found '$1'"; exit 2; }

while [ $# -gt 0 ]; do
    [ $# -ge 2 ] || refuse "$1"
    case "$1" in
        --out) site=$(realpath -m "$2") serve=0 ;;
        --port) [[ "$2" =~ ^[0-9]+$ ]] || refuse "$1 $2"; port=$2 ;;
        *) refuse "$1" ;;
    esac
    shift 2
done

mkdir -p "$build/three"
build=$(realpath "$build")
say "building the page for browsers"
fail() { cat "$build/build.log" >&2; exit "$1"; }
cmake -S "$here/bake" -B "$build/bake" -G Ninja -DCMAKE_BUILD_TYPE=MinSizeRel \
    -DCMAKE_TOOLCHAIN_FILE=/usr/share/emscripten/cmake/Modules/Platform/Emscripten.cmake \
    -DCMAKE_CXX_COMPILER_LAUNCHER="$(command -v ccache || true)" >"$build/build.log" 2>&1 || fail 1
cmake --build "$build/bake" >>"$build/build.log" 2>&1 || fail 3 # the sources do not compile
{
    cp -RT "$here/three" "$build/three" && cd "$build/three" &&
        npm ci --ignore-scripts && npm run build &&
        node "$here/page/build.mjs" "$site" "$build/three"
} >>"$build/build.log" 2>&1 || fail 1

if [ $serve -eq 0 ]; then
    say "the page is $site/index.html; serve that folder, as browsers start no worker from a file"
else
    say "the page is http://127.0.0.1:$port/ (Ctrl+C ends)"
    python3 -m http.server "$port" --bind 127.0.0.1 --directory "$site" 2>/dev/null
fi
