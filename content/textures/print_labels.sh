#!/usr/bin/env bash
# print_labels.sh
# Sets the prints of the cabinet's discs again. Needs ImageMagick and the fonts of fonts-urw-base35 (Debian).
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
fonts=/usr/share/fonts/opentype/urw-base35
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# wrap PRINT INNER ROWS: a round print of 2048 pixels as a strip of ROWS pixels, from the angle "up" counter-clockwise, and
# from INNER pixels from the middle outward.
wrap() { convert "$work/$1.png" -distort DePolar "1024,$2,1024,1024" -resize "2048x$3!" "$work/$1_strip.png"; }
# around PRINT COLOUR SIZE OFFSET TEXT: text along the strip with its feet toward the middle, OFFSET pixels from the outer edge.
around() {
    convert "$work/$1_strip.png" -rotate 180 -roll +1024+0 -font "$fonts/URWGothic-Demi.otf" -pointsize "$3" -kerning 6 \
        -fill "$2" -gravity north -annotate "+0+$4" "$5" -roll +1024+0 -rotate 180 "$work/$1_strip.png"
}
# Quarter turns so that "up" is where a mesh has its quarter of a turn; colours few enough for a small file.
on_disc() { convert "$work/$1_strip.png" -roll +512+0 -transpose +dither -colors 16 -strip "$here/$1.png"; }
under_disc() { convert "$work/$1_strip.png" -flop -roll +512+0 +dither -colors 16 -strip "$here/$1.png"; }

cream='#dccba7'
red='#9e2919'
convert -size 2048x2048 "xc:$red" -fill "$cream" -draw 'circle 1024,1024 1024,1900' \
    -fill "$red" -draw 'circle 1024,1024 1024,1880' -fill "$cream" -draw 'rectangle 424,770 1624,780' \
    -gravity center -font "$fonts/URWGothic-Demi.otf" -pointsize 210 -annotate +0-390 'ROWLAND' \
    -pointsize 84 -annotate -520+0 'SIDE 1' -annotate +520-46 '33' -pointsize 60 -annotate +520+46 'STEREO' \
    -font "$fonts/URWBookman-LightItalic.otf" -pointsize 110 -annotate +0+300 'Lines of the Elements' \
    -font "$fonts/URWBookman-Light.otf" -pointsize 68 -annotate +0+430 '1  Sodium D     2  Hydrogen Alpha' \
    -annotate +0+520 '3  Mercury Green     4  Neon' \
    -font "$fonts/URWGothic-Book.otf" -pointsize 56 -annotate +0+650 'R 1882-60' "$work/record_label.png"
wrap record_label 74 512
around record_label "$cream" 40 32 'MADE OF VINYL  ·  GROOVES 60 µm APART  ·  PLAY IN GOOD LIGHT'
on_disc record_label

# disc_print NAME COLOUR TITLE PITCH
disc_print() {
    convert -size 2048x2048 "xc:$2" -fill '#d8d8d6' -draw 'circle 1024,1024 1024,1500' -fill "$2" \
        -draw 'circle 1024,1024 1024,1488' -fill '#d8d8d6' \
        -gravity center -font "$fonts/URWGothic-Demi.otf" -pointsize 200 -annotate +0-640 'ROWLAND' \
        -font "$fonts/URWGothic-Book.otf" -pointsize 120 -annotate +0+620 "$3" -pointsize 80 -annotate +0+740 "$4" \
        "$work/$1.png"
    wrap "$1" 344 384
    around "$1" '#d8d8d6' 34 20 'A REFLECTION GRATING  ·  KEEP THE OTHER SIDE CLEAN'
    under_disc "$1"
}
disc_print cd_print '#c96512' 'Compact Disc' 'tracks 1600 nm apart'
disc_print dvd_print '#27509b' 'Versatile Disc' 'tracks 740 nm apart'
