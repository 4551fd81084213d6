#!/usr/bin/env bash
# take_pictures.sh INSPECTOR
# Takes the pictures of README.md again with the inspector at that path. Needs no display.
set -euo pipefail
inspector=$1
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
take() {
    local name=$1
    shift
    "$inspector" --layout /nonexistent/layout.json --capture "$here/pictures/$name.png" "$@"
}
take disc --preset cd --measure --size 1600x1000
take foil --preset holographic_foil --shape sheet --size 1280x1400
