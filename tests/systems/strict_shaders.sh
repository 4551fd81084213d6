#!/usr/bin/env bash
# strict_shaders.sh FOLDER [TEST_PROGRAM [ARGUMENT...]]
# Runs the GPU tests of build/release that draw with the project's shaders, captures every program that they link into
# FOLDER/programs (emptied first), and checks each stage, and the stages together, by the reference compiler of GLSL, which
# is stricter than most drivers. Fails if it has a message. With one test program, that one alone, with these arguments.
# Needs Mesa and glslangValidator (Debian: glslang-tools); five minutes on two cores.
# example: tests/systems/strict_shaders.sh /tmp/shaders test_gpu_scene --gtest_filter='Shadow*'
set -euo pipefail
[ $# -ge 1 ] || { sed -n '2,8s/^# //p' "$0" >&2; exit 2; }
command -v glslangValidator >/dev/null || { echo "error: no glslangValidator: install glslang-tools" >&2; exit 1; }
mkdir -p "$1"
folder=$(cd "$1" && pwd)/programs
build=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../build/release" && pwd)
programs=(test_gpu_post test_gpu_scene test_gpu_ui test_gpu_render test_gpu_diffraction)
[ $# -lt 2 ] || programs=("$2")
shift $(($# < 2 ? $# : 2))

rm -rf "$folder"
for program in "${programs[@]}"; do
    mkdir -p "$folder/$program"
    MESA_SHADER_CACHE_DISABLE=true MESA_SHADER_CAPTURE_PATH=$folder/$program "$build/bin/$program" "$@" \
        >"$folder/$program.log" 2>&1 || { echo "error: $program failed: see $folder/$program.log" >&2; exit 1; }
done

# Each stage of a capture becomes a file; its suffix tells the compiler the stage.
find "$folder" -name '*.shader_test' -print0 | xargs -0 -r awk '
    FNR == 1 { close(out); out = "" }
    /^\[(vertex|fragment|compute) shader\]$/ {
        stage = /vertex/ ? "vert" : /fragment/ ? "frag" : "comp"
        out = substr(FILENAME, 1, length(FILENAME) - length("shader_test")) stage
        next
    }
    /^\[[a-z]/ { close(out); out = "" }
    out { print >out }'

# check LABEL FILE...: one line per message.
messages=0
check() {
    local label=$1 said
    shift
    said=$(glslangValidator "$@" 2>&1 | grep -iE 'error|warning' || true)
    [ -z "$said" ] && return
    messages=$((messages + $(wc -l <<<"$said")))
    sed "s|^|$label: |" <<<"$said"
}
linked=0
declare -A seen=()
while read -r first; do
    capture=${first%.*}
    files=()
    for stage in vert frag comp; do [ ! -f "$capture.$stage" ] || files+=("$capture.$stage"); done
    # Tests link the same programs again and again.
    sum=$(cat "${files[@]}" | md5sum)
    [ -z "${seen[$sum]:-}" ] || continue
    seen[$sum]=1
    for file in "${files[@]}"; do check "$file" "$file"; done
    [ ${#files[@]} -lt 2 ] || check "$capture" -l "${files[@]}"
    linked=$((linked + 1))
done < <(find "$folder" \( -name '*.vert' -o -name '*.comp' \) | sort)
echo "$linked different programs: $messages messages"
[ "$linked" -gt 0 ] && [ "$messages" = 0 ]
