#!/usr/bin/env bash
# Cross-compiles Rowland for 64-bit Windows and writes rowland-windows.zip: `./rowland windows`.
# usage: windows.sh [ZIP]    (build/release has the cooked content, as the preset says)
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../../.." && pwd)
zip=${1:-$root/build/rowland-windows.zip}
export ROWLAND_WINDOWS_CACHE=${ROWLAND_WINDOWS_CACHE:-$root/build/windows-cache}
build="$root/build/windows"
programs=(rowland-demo rowland-inspector rowland-cook rowland-capture rowland-trade)

say() { printf '%s\n' "$*" >&2; }

"$here/dependencies.sh" "$ROWLAND_WINDOWS_CACHE"
mkdir -p "$build"
say "building for Windows"
{ cd "$root" && cmake --preset windows &&
    cmake --build "$build" --target "${programs[@]}" rowland-decode-draco; } >"$build/build.log" 2>&1 ||
    { tail -n 40 "$build/build.log" >&2; say "error: the build failed: see $build/build.log"; exit 1; }

# A folder as it is unpacked: programs look for cooked/, content/ and fonts/ beside the folder that they lie in.
package="$build/package/rowland"
rm -rf "$package"
mkdir -p "$package/bin" "$package/cooked" "$package/content" "$package/fonts" "$package/licences"
for program in "${programs[@]}" rowland-decode-draco; do
    x86_64-w64-mingw32-strip -o "$package/bin/$program.exe" "$build/bin/$program.exe"
done
cp "$build/libexec/rowland/commit" "$package/bin/"
# Recipes name captures that this machine has, whose cooked probes go along; scenes are those that somebody has opened here.
(cd "$root/build/release/cooked" && find . -type f -not -path './recipes/*' -not -path './scenes/*' -exec cp --parents {} "$package/cooked" \;)
for folder in foil gltf materials meshes ocio probes scenes textures; do cp -r "$root/content/$folder" "$package/content/"; done
cp /usr/share/fonts/truetype/dejavu/DejaVuSans.ttf "$package/fonts/"
cp "$ROWLAND_WINDOWS_CACHE"/libraries/licences/*.txt "$package/licences/"
cp "$root/LICENSE" "$package/licences/rowland.txt"
cp /usr/share/doc/fonts-dejavu-core/copyright "$package/licences/fonts-dejavu.txt"
# The compiler's own libraries are inside each program.
cp /usr/share/doc/gcc-mingw-w64-x86-64-posix-runtime/copyright "$package/licences/gcc.txt"
cp /usr/share/doc/mingw-w64-x86-64-dev/copyright "$package/licences/mingw-w64.txt"
[ ! -f /usr/share/doc/blender-data/copyright ] || cp /usr/share/doc/blender-data/copyright "$package/licences/captures.txt"
sed 's/$/\r/' >"$package/README.txt" <<'TEXT'
Rowland: physically based real-time diffraction.

Double-click bin\rowland-demo.exe for the demo, bin\rowland-inspector.exe to edit a material.
Needed: 64-bit Windows 10 (1903) or later, and a driver with OpenGL 4.5.

In a terminal, each program tells its options with --help:
  bin\rowland-cook.exe    cooks materials, probes and scenes
  bin\rowland-trade.exe   measures speed and accuracy

The folder licences has the terms of Rowland and of all libraries inside the programs.
TEXT
mkdir -p "$(dirname "$zip")"
rm -f "$zip"
(cd "$build/package" && zip -qr "$zip" rowland)
say "the package is $zip"
