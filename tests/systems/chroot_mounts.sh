# Sourced by the scripts that run in a chroot: folders that are mounted below $root until the script ends.
mounted=()
leave() { for folder in "${mounted[@]}"; do umount "$root/$folder"; done; }
trap leave EXIT
# bind FOLDER [BELOW_ROOT]
bind() {
    local below=${2:-${1#/}}
    mkdir -p "$root/$below"
    mount --bind "$1" "$root/$below"
    mounted=("$below" "${mounted[@]}")
}
mkdir -p "$root/proc"
mount -t proc proc "$root/proc"
mounted=(proc)
bind /dev
