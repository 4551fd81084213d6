#!/usr/bin/env bash
# under_zink.sh FOLDER [TEST_PROGRAM [ARGUMENT...]]
# Runs the GPU tests of build/release on another OpenGL driver: zink over lavapipe of Debian 13's Mesa, in a chroot below
# FOLDER, with Vulkan's validation layer. Fails if a test does, or if the layer or OpenGL has a message. What the programs
# wrote is in FOLDER/PROGRAM.log. With one program, that one alone, with these arguments.
# Needs root, mmdebstrap, the network, 1 GB and ten minutes on two cores.
# example: tests/systems/under_zink.sh /tmp/trixie test_gpu_scene --gtest_filter='Shadow*'
set -euo pipefail
[ $# -ge 1 ] || { sed -n '2,7s/^# //p' "$0" >&2; exit 2; }
mkdir -p "$1"
folder=$(cd "$1" && pwd)
root=$folder/zink
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
programs=(test_gpu test_gpu_post test_gpu_scene test_gpu_ui test_gpu_render test_gpu_diffraction)
[ $# -lt 2 ] || programs=("$2")
shift $(($# < 2 ? $# : 2))
[ -d "$root" ] || mmdebstrap --variant=minbase \
    --include=fonts-dejavu-core,libegl1,libgl1,libgl1-mesa-dri,libepoxy0,mesa-vulkan-drivers,vulkan-validationlayers trixie "$root"

source "$source/tests/systems/chroot_mounts.sh"
bind "$source"
bind "$folder"

# The libraries that the programs were built with and the chroot lacks; its Mesa keeps its own.
rm -rf "$root/libraries"
mkdir "$root/libraries"
for program in "${programs[@]}"; do ldd "$source/build/release/bin/$program"; done | awk '$2 == "=>" { print $3 }' | sort -u |
    while read -r library; do
        [ -e "$root/usr/lib/x86_64-linux-gnu/$(basename "$library")" ] || cp -L "$library" "$root/libraries/"
    done

# in_it PROGRAM ARGUMENT...: ROWLAND_GPU refuses any other driver.
in_it() {
    chroot "$root" env -i PATH=/usr/bin:/bin LANG=C.UTF-8 LD_LIBRARY_PATH=/libraries ROWLAND_GPU=zink \
        LIBGL_ALWAYS_SOFTWARE=1 MESA_LOADER_DRIVER_OVERRIDE=zink VK_LOADER_LAYERS_ENABLE='*khronos_validation*' \
        VK_LOADER_DEBUG=layer VK_DRIVER_FILES=/usr/share/vulkan/icd.d/lvp_icd.json \
        ${ROWLAND_TEST_FILTERING:+ROWLAND_TEST_FILTERING=$ROWLAND_TEST_FILTERING} \
        bash -c 'cd "$0" && shopt -s inherit_errexit && stdbuf -o0 "build/release/bin/$@"' "$source" "$@"
}
failed=0
for program in "${programs[@]}"; do
    log=$folder/$program.log
    status=0
    in_it "$program" "$@" >"$log" 2>&1 || status=$?
    result=$(grep -E '^\[==========\] .* ran' "$log" || echo "did not finish, exit status $status")
    messages=$(grep -cE 'Validation (Error|Warning|Performance)|VUID-|MESA: (error|warning)|OpenGL \[' "$log" || true)
    grep -q 'Insert instance layer "VK_LAYER_KHRONOS_validation"' "$log" || { messages="no validation layer, $messages"; status=1; }
    echo "$program: $result exit status $status, $messages messages"
    [ "$status" = 0 ] && [ "$messages" = 0 ] || failed=1
done
exit $failed
