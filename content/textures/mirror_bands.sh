#!/usr/bin/env bash
# mirror_bands.sh FOLDER
# Etches the mirror bands of the cabinet's discs again: rings, the matrix code, a bar code. NAME_band.png is the base
# colour, NAME_band_etched.png roughness and metal. Needs ImageMagick and the DejaVu fonts.
set -euo pipefail
folder=${1:?a folder}
strip=$(mktemp --suffix=.png)
trap 'rm -f "$strip"' EXIT

# band NAME SEED CODE ...: strips of 2048 texels clockwise and 64 from the outer edge inward; texts, each at an x of its own.
band() {
    local name=$1 x draw='' i
    RANDOM=$2
    shift 2
    for ((x = 1500, i = 0; i < 46; ++i, x += 4 + RANDOM % 4)); do draw+="rectangle $x,18 $((x + RANDOM % 3)),44 "; done
    convert -size 2048x64 xc:black -fill gray70 -draw 'rectangle 0,57 2048,58' -fill gray25 -draw 'rectangle 0,48 2048,48' \
        -draw 'rectangle 0,61 2048,63' -fill gray35 -draw 'rectangle 0,0 2048,2' -fill white -draw "$draw" \
        -font DejaVu-Sans -pointsize 25 "$@" -blur 0x0.6 "$strip"
    convert "$strip" -transverse +level 100%,52% -depth 8 +dither -colors 32 -strip "$folder/${name}_band.png"
    convert "$strip" -transverse +level 3%,45% \( +clone -fill white -colorize 100 \) +swap \( -clone 0 \) -combine \
        -depth 8 +dither -colors 32 -strip "$folder/${name}_band_etched.png"
}
band cd 3 -annotate +120+40 'ROWLAND  R 1882-16' -pointsize 17 -annotate +640+38 'IFPI L882' \
    -pointsize 25 -annotate +900+40 '01 + A1' -pointsize 17 -annotate +1200+38 'MADE OF POLYCARBONATE'
band dvd 8 -annotate +60+40 'R 1882-07 L0' -pointsize 17 -annotate +420+38 'IFPI L883' \
    -pointsize 25 -annotate +760+40 'ROWLAND VERSATILE'
