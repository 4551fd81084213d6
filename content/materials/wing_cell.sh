#!/usr/bin/env bash
# wing_cell.sh
# Draws wing_cell.png again: the heights of one cell of a butterfly's scale, a ridge with two cross-ribs. Needs ImageMagick.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
ridge='exp(-pow((i+0.5)/w-0.5,2)/0.02)'
ribs='0.35*pow(cos(2*pi*(j+0.5)/h),2)'
convert -size 48x48 xc:black -colorspace Gray -fx "max($ridge,$ribs)" -depth 8 -strip "$here/wing_cell.png"
cp "$here/wing_cell.png" "$here/../scenes/" # lattices.glb names it
