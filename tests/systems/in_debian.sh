#!/usr/bin/env bash
# in_debian.sh SUITE FOLDER [DATA]
# The README's two commands on a bare Debian (bookworm, trixie) in a chroot below FOLDER, from a clone of this repository's
# last commit: what a user of that system would see. DATA: the test data, without which tests that need it are skipped.
# Prints how long each took, and how long the tests take when nothing has changed.
# Needs root, mmdebstrap, the network, 8 GB and half an hour on two cores.
# example: tests/systems/in_debian.sh trixie /tmp/trixie ../shared
set -euo pipefail
[ $# -ge 2 ] || { sed -n '2,7s/^# //p' "$0" >&2; exit 2; }
suite=$1
root=$2/root
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
data=${3:+$(cd "$3" && pwd)}
[ -d "$root" ] || mmdebstrap --variant=minbase --include=ca-certificates,git "$suite" "$root"

source "$source/tests/systems/chroot_mounts.sh"
mkdir -p "$root/dev/shm"
[ -z "$data" ] || bind "$data" shared
cp /etc/resolv.conf "$root/etc/resolv.conf"

rm -rf "$root/rowland"
git clone --quiet "$source" "$root/rowland"
in_it() { chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 ${data:+CI=true ROWLAND_DATA=/shared} bash -c "$1"; }
in_it 'cat /etc/debian_version; cd /rowland && time ./rowland demo && rm -rf build ~/.cache && time ./rowland test && time ./rowland test'
