#!/usr/bin/env bash
# under_wine.sh FOLDER
# Runs the programs of build/rowland-windows.zip by Wine, unpacked below FOLDER into a folder whose name has spaces and Cyrillic
# letters, beside those of build/release: pictures of the flight, cooked bytes, a report, a recording, and real clicks in the
# inspector. A line each says how it went; FOLDER/*.log say why. Exits 1 if any failed.
# Needs the two builds, blender-data, wine64, xvfb, xauth, xdotool, imagemagick, unzip; some minutes.
# example: ./rowland windows && tests/systems/under_wine.sh /tmp/wine
set -euo pipefail
[ $# -eq 1 ] || { sed -n '2,7s/^# //p' "$0" >&2; exit 2; }
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
release=$source/build/release
# OpenGL under Wine is the display's.
[ -n "${DISPLAY:-}" ] || exec xvfb-run -a "$0" "$@"
mkdir -p "$1"
folder=$(cd "$1" && pwd)
unpacked="$folder/Мои программы (new)"
failed=0

say() { printf '%s\n' "$*"; }
# check NAME COMMAND...
check() {
    local name=$1 begin=$SECONDS
    shift
    if (set -e; "$@") >"$folder/$name.log" 2>&1; then
        say "$name: passed in $((SECONDS - begin)) s"
    else
        say "$name: failed, see $folder/$name.log"
        failed=1
    fi
}
# windows PROGRAM ARGUMENT...
windows() {
    local program=$1
    shift
    "$source/content/package/windows/wine.sh" "$unpacked/rowland/bin/$program.exe" "$@"
}

rm -rf "$unpacked"
mkdir -p "$unpacked"
unzip -q "$source/build/rowland-windows.zip" -d "$unpacked"
cd "$folder"

# Of all pixels 99.9 % are within 1/255 of Linux'.
flight() {
    local options=(--headless --frames 4 --width 320 --height 180) one pixels different total=0 all=0
    rm -rf linux windows
    "$release/bin/rowland-demo" "${options[@]}" --output-folder linux
    windows rowland-demo "${options[@]}" --output-folder windows
    for one in linux/*.png; do
        different=$(compare -metric AE -fuzz 0.4% "$one" "windows/$(basename "$one")" null: 2>&1 || true)
        pixels=$((320 * 180))
        say "$one: $different of $pixels pixels differ by more than 1/255"
        total=$((total + ${different%.*})) all=$((all + pixels))
    done
    [ "$all" -gt 0 ] && [ $((1000 * total)) -le "$all" ]
}

# Materials of each kind, a probe, a foil card and a scene, cooked by both.
cooked() {
    local one
    rm -rf cooked
    for one in linux windows; do mkdir -p "cooked/$one"; done
    both() {
        "$release/bin/rowland-cook" "${@//SYSTEM/linux}"
        windows rowland-cook "${@//SYSTEM/windows}"
    }
    for one in cd dvd vinyl holographic_foil phone_screen soap_film; do
        both cook "$source/content/materials/$one.json" -o "cooked/SYSTEM/$one.material"
    done
    both cook "$source/content/probes/night.json" -o cooked/SYSTEM/night.probe
    both foil "$source/content/foil/mountain.json" -o cooked/SYSTEM/mountain.glb
    diff -r cooked/linux cooked/windows
}

report() {
    rm -rf report
    windows rowland-trade report --material "$source/content/materials/cd.json" --probe /usr/share/blender/datafiles/studiolights/world/night.exr \
        --setting direct --setting arc --picture-size 64 36 --frame-size 64 36 --output report
    [ -s report/report.html ]
}

# The window tests' user, before the inspector for Windows; what Linux recorded is played by the demo for Windows.
cat >inspector <<EOF
#!/usr/bin/env bash
exec "$source/content/package/windows/wine.sh" "$unpacked/rowland/bin/rowland-inspector.exe" "\$@"
EOF
sed 's/rowland-inspector/rowland-demo/' inspector >demo
chmod +x inspector demo
in_window() {
    CI=true ROWLAND_TEST_INSPECTOR="$folder/inspector" ROWLAND_TEST_PLAYER="$folder/demo" \
        "$release/bin/test_window" --gtest_filter="$1"
}

check flight flight
check cooked cooked
check recording in_window 'PlayWindow.ARecordingPlaysAgainToTheSameStateWithAndWithoutAWindow'
check inspector in_window 'SceneWindow.OneSampleOfManyGetsAGratingAlone'
check report report
exit $failed
