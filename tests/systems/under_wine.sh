#!/usr/bin/env bash
# under_wine.sh FOLDER
# Runs the programs of build/rowland-windows.zip by Wine, unpacked below FOLDER into a folder whose name has spaces and Cyrillic
# letters, beside those of build/release: pictures of the flight, cooked bytes, a report, a recording, real clicks in the
# inspector, examples built by MinGW, and cooks that are killed, that fill a disk, that may not write, or that are two at once. A
# line each says how it went; FOLDER/*.log say why. Exits 1 if any failed.
# Needs the two builds, blender-data, wine64, xvfb, xauth, xdotool, imagemagick, unzip, and root, which mounts small disks; some
# minutes.
# example: ./rowland windows && tests/systems/under_wine.sh /tmp/wine
set -euo pipefail
[ $# -eq 1 ] || { sed -n '2,9s/^# //p' "$0" >&2; exit 2; }
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
    local name=$1 begin=$SECONDS status
    shift
    # "set -e" does not hold in a condition.
    set +e
    (set -e; "$@") >"$folder/$name.log" 2>&1
    status=$?
    set -e
    if [ $status -eq 0 ]; then
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

# A cook of a moment, into the file that is named; its messages are in cook.err.
cat >small.json <<'JSON'
{ "grating": { "pitch_nm": 1600, "profile": { "type": "slit", "width_nm": 800 } },
  "quality": { "representation": "spikes", "bands": 8, "spikes": 4, "view_resolution": 16 } }
JSON
cook() { windows rowland-cook cook small.json -o "$1" 2>cook.err; }

# Killed ever later, it leaves the old file or the new one whole, and nothing beside it.
killed() {
    local hundredths=0 killed=0 attempt
    rm -rf killed && mkdir killed
    cook killed/whole
    while :; do
        hundredths=$((hundredths + 3))
        printf old >killed/asset
        # Without a function between them, $! is the program.
        "$source/content/package/windows/wine.sh" "$unpacked/rowland/bin/rowland-cook.exe" cook small.json -o killed/asset &
        sleep "$(printf '%d.%02d' $((hundredths / 100)) $((hundredths % 100)))"
        kill -KILL $! 2>/dev/null || true
        if wait $!; then
            cmp killed/asset killed/whole
            break
        fi
        # Wine's server removes the file that was marked for deletion once it sees that the program is dead.
        for attempt in 1 2 3 4 5 6 7 8 9 10; do
            [ "$(ls -A killed)" != "$(printf 'asset\nwhole')" ] || break
            sleep 0.1
        done
        ls -A killed
        [ "$attempt" -lt 10 ]
        [ "$(head -c 3 killed/asset)" = old ] || cmp killed/asset killed/whole
        killed=$((killed + 1))
    done
    say "killed $killed times"
    [ $killed -gt 5 ]
}

# on_disk SIZE COMMAND...: with a small disk at disk/.
on_disk() {
    local size=$1 status=0
    shift
    mkdir -p disk
    mount -t tmpfs -o "size=$size" tmpfs disk
    ("$@") || status=$?
    umount disk
    return $status
}
# refused CODE TEXT: the cook failed in this way, and the old file is there alone.
refused() {
    cat cook.err
    [ "$status" -eq "$1" ] && grep -q "$2" cook.err && [ "$(cat disk/asset)" = old ] && [ "$(ls -A disk)" = asset ]
}
full() {
    local status=0
    printf old >disk/asset
    cook disk/asset || status=$?
    refused 1 'writing failed: .*; check permissions and free space'
}
read_only() {
    local status=0
    printf old >disk/asset
    mount -o remount,ro disk
    cook disk/asset || status=$?
    refused 2 'a file that can be written; name another file'
}

# Two cooks of one file at once both succeed.
two() {
    rm -rf two && mkdir two
    cook two/alone
    cook two/asset &
    cook two/asset
    wait $!
    cmp two/asset two/alone
    [ "$(ls -A two)" = "$(printf 'alone\nasset')" ]
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
check examples env ROWLAND_TEST_WINDOWS="$source/build/windows" CI=true "$release/bin/test_package" \
    --gtest_filter='PackageTest.*Example*:PackageTest.AModule*'
check killed killed
check full_disk on_disk 40k full
check read_only on_disk 1m read_only
check two_at_once two
exit $failed
