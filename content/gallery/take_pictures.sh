#!/usr/bin/env bash
# take_pictures.sh
# Renders the gallery's pictures again, without a display. Needs ImageMagick to write JPEG, and img2webp (Debian: webp).
# GRACE: the path of Paul Debevec's grace_probe.hdr, for the sheets of painted foil, which also need Chromium, Node.js and
# what content/web/web.sh builds; without it they stay.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

demo() { "$root/rowland" demo --headless --dither "$@"; }
# flight CAPTURE: the six views of the cabinet, as $work/CAPTURE/flight_00_*.png and so on.
flight() {
    demo --frames 6 --width 960 --height 540 --bloom 0.04 --output-folder "$work/$1" \
        --probe "$root/build/release/cooked/captured_$1.probe"
}
# keep NAME PICTURE
keep() { convert "$2" -quality 88 "$here/$1.jpg"; }

flight interior
keep cabinet "$work"/interior/flight_00_*.png
keep discs "$work"/interior/flight_02_*.png
flight sunset
keep record "$work"/sunset/flight_01_*.png
keep foil "$work"/sunset/flight_03_*.png
keep beetle "$work"/sunset/flight_04_*.png
flight night
keep discs_at_night "$work"/night/flight_02_*.png
for card in mountain heavens crystal day_and_night wave scarab; do
    demo --scene "$root/build/release/cooked/foil/$card.glb" --sun --camera 0,0.145,0.36,0,0.06,0 --bloom 0.03 --frames 1 \
        --probe "$root/build/release/cooked/captured_night.probe" --width 480 --height 640 --capture "$work/$card.png"
done
convert \( "$work"/{mountain,heavens,crystal}.png +append \) \( "$work"/{day_and_night,wave,scarab}.png +append \) \
    -append -resize 75% -quality 86 "$here/cards.jpg"
# scene NAME CAPTURE PICTURE [OPTIONS]: a scene of content/scenes.
scene() {
    demo --scene "$root/build/release/cooked/$1.scene" --probe "$root/build/release/cooked/captured_$2.probe" \
        --width 960 --height 540 --bloom 0.04 --frames 1 --capture "$work/$3.png" "${@:4}"
    keep "$3" "$work/$3.png"
}
scene films courtyard films
scene lattices night lattices
scene sheets sunset sheets
scene sheets sunset starbursts --glare "$root/content/materials/camera_under_display.json"
for lobe in pits flat; do
    demo --disc --sun --material "$here/cd_$lobe.json" --probe "$root/content/probes/night.json" \
        --auto-exposure --width 640 --height 480 --capture "$work/$lobe.png"
    keep "$lobe" "$work/$lobe.png"
done
# The README's table of looks: the disc alone.
for material in cd_pressed holographic_foil ruled_600 butterfly_wing diffraction_glasses; do
    demo --disc --material "$root/content/materials/$material.json" --bloom 0.03 --width 640 --height 360 \
        --probe "$root/build/release/cooked/captured_interior.probe" --capture "$work/$material.png"
    convert "$work/$material.png" -crop 324x300+160+30 +repage -resize 50% -quality 85 "$here/look_$material.jpg"
done
# Scalar theory above rigorous theory.
for theory in scalar rigorous; do
    for material in cd_pressed dvd blu_ray; do
        sed "s/\"theory\": \"rigorous\"/\"theory\": \"$theory\"/" "$root/content/materials/$material.json" \
            >"$work/$material.json"
        demo --disc --material "$work/$material.json" --bloom 0.03 --width 640 --height 360 \
            --probe "$root/build/release/cooked/captured_interior.probe" --capture "$work/${theory}_$material.png"
    done
done
montage "$work"/scalar_{cd_pressed,dvd,blu_ray}.png "$work"/rigorous_{cd_pressed,dvd,blu_ray}.png \
    -crop 324x300+160+30 +repage -tile 3x2 -geometry 320x296+2+2 -background "#222" -quality 85 "$here/rigorous.jpg"
mkdir "$work/film"
demo --disc --material "$root/content/materials/cd_pressed.json" --frames 96 --width 480 --height 300 --bloom 0.04 \
    --probe "$root/build/release/cooked/captured_interior.probe" --capture "$work/film/frame.png"
img2webp -loop 0 -lossy -q 70 -d 33 "$work"/film/*.png -o "$here/turning_disc.webp"
[[ -z ${GRACE:-} ]] || node "$here/painted_foil.mjs" "$GRACE"
