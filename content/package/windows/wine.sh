#!/usr/bin/env bash
# wine.sh PROGRAM ARGUMENT...: runs a program for Windows by Wine, with Wine's own files in one folder of the build.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
cache=${ROWLAND_WINDOWS_CACHE:-$here/../../../build/windows-cache}
export WINEPREFIX="$(mkdir -p "$cache" && cd "$cache" && pwd)/wine" WINEARCH=win64 WINEDEBUG=${WINEDEBUG:--all}
# No window asks to install Mono or Gecko, which nothing here needs.
export WINEDLLOVERRIDES="mscoree=;mshtml="
# Debian's wine also starts without its 32-bit half, but says on each start that it is missing.
wine=/usr/lib/wine/wine64
[ -x "$wine" ] || wine=wine
# Wine's server and services take seconds to start, so that they stay for a minute after a program. Started by the program itself,
# they would hold its output open.
server=/usr/lib/wine/wineserver64
[ -x "$server" ] || server=wineserver
if "$server" -p60 </dev/null >/dev/null 2>&1; then "$wine" wineboot </dev/null >/dev/null 2>&1 || true; fi
exec "$wine" "$@"
