#!/usr/bin/env bash
# take_pictures.sh [PROBE]
# Renders the gallery's pictures again, without a display; those under the captured probe only if its file is given
# (Royal Esplanade, equirectangular). Needs ImageMagick to write JPEG.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# flight NAME ARGUMENT...: the six views of the cabinet, as $work/NAME/flight_00_*.png and so on.
flight() {
    local name=$1
    shift
    "$root/rowland" demo --headless --frames 6 --width 960 --height 540 --dither --output-folder "$work/$name" "$@"
}
# keep NAME PICTURE
keep() { convert "$2" -quality 88 "$here/$1.jpg"; }

flight studio --probe "$root/content/probes/studio.json" --bloom 0.04
keep cabinet "$work"/studio/flight_00_*.png
keep beetle "$work"/studio/flight_04_*.png
flight sky --probe "$root/content/probes/clear_sky.json" --bloom 0.04
keep discs "$work"/sky/flight_02_*.png
flight night --probe "$root/content/probes/night.json" --bloom 0.04
keep foil "$work"/night/flight_03_*.png
for lobe in pits flat; do
    "$root/rowland" demo --headless --disc --sun --material "$here/cd_$lobe.json" --probe "$root/content/probes/night.json" \
        --auto-exposure --dither --width 640 --height 480 --capture "$work/$lobe.png"
    keep "$lobe" "$work/$lobe.png"
done
if [ $# -gt 0 ]; then
    flight captured --probe "$1" --auto-exposure
    keep captured_discs "$work"/captured/flight_02_*.png
    keep captured_record "$work"/captured/flight_01_*.png
fi
