#!/usr/bin/env bash
# inspector_drive.sh FOLDER ACTION... -- INSPECTOR ARGUMENT...
# Runs the inspector in a window under Xvfb and plays a user with mouse and keys. Controls are found by name in the file
# that the inspector keeps of them (--controls); an action waits for its control.
#   click:NAME         press and release in a control's middle
#   drag:NAME,DX,DY    press in its middle, move, release
#   slide:NAME,DX      press in its middle, move by a pixel every 30 ms, release: for the times it logs at its end
#   pick:X,Y           click the picture at these shares of its width and height
#   key:NAME  type:TEXT
#   until:NAME=TEXT    wait until the fact NAME holds TEXT
#   keep:FILE          copy the facts to FOLDER/FILE
#   shot:FILE          a picture of the whole screen, if ImageMagick is there
#   drop:FILE          drop it onto the window, with the program $DROP_FILES
#   run:COMMAND  wait:SECONDS
# INSPECTOR_SIZE: the size of the window (960x600, whose frames a software renderer draws in half the time of 1280x780).
# Ends with Ctrl+Q, discarding edits that are not saved, and the inspector's own exit status.
set -u
screen=1280x800
. "$(dirname "${BASH_SOURCE[0]}")/under_xvfb.sh"

facts="$folder/controls"
rm -f "$facts" "$facts.frames"
"$@" --controls "$facts" --layout "$folder/layout.json" --size "${INSPECTOR_SIZE:-960x600}" &
inspector=$!
window=$(timeout 60 xdotool search --sync --onlyvisible --name "Rowland: material inspector" | head -n 1)
xdotool windowmove "$window" 0 0 windowfocus --sync "$window"

fact() { awk -F'\t' -v name="$1" '$1 == name { print $2 }' "$facts" 2>/dev/null; }
# Three frames: by then the inspector has seen what was done, and shows it.
frames() {
    local count=
    while [ -z "$count" ]; do read -r count <"$facts.frames"; done
    echo "$count"
}
pause() {
    sleep 0.06
    local goal=$(($(frames) + 3))
    for _ in $(seq 400); do
        [ "$(frames)" -ge "$goal" ] && return
        kill -0 "$inspector" 2>/dev/null || return
        sleep 0.02
    done
    fail "no frames"
}
fail() {
    echo "inspector_drive.sh: $1" >&2
    cat "$facts" >&2
    kill "$inspector"
    exit 3
}
# The middle of a control, as "x y"; waits until it is there.
middle() {
    local place
    for _ in $(seq 300); do
        place=$(fact "$1")
        [ -n "$place" ] && break
        sleep 0.1
    done
    [ -n "$place" ] || return 1
    echo "$place" | awk '{ printf "%d %d", ($1 + $3) / 2, ($2 + $4) / 2 }'
}
press_at() {
    xdotool mousemove --window "$window" "$1" "$2"
    pause
    xdotool mousedown 1
    pause
}
click_at() {
    press_at "$1" "$2"
    xdotool mouseup 1
    pause
}
until_fact() {
    for _ in $(seq 900); do
        [[ "$(fact "$1")" == *"$2"* ]] && return 0
        sleep 0.1
    done
    return 1
}

until_fact picture ' ' || fail "the window has no picture"
for action in "${actions[@]}"; do
    what=${action%%:*}
    value=${action#*:}
    case "$what" in
        click)
            place=$(middle "$value") || fail "no control '$value'"
            click_at $place
            ;;
        drag)
            IFS=, read -r name dx dy <<<"$value"
            place=$(middle "$name") || fail "no control '$name'"
            press_at $place
            xdotool mousemove_relative -- "$dx" "$dy"
            pause
            xdotool mouseup 1
            pause
            ;;
        slide)
            IFS=, read -r name dx <<<"$value"
            place=$(middle "$name") || fail "no control '$name'"
            press_at $place
            for _ in $(seq $((dx < 0 ? -dx : dx))); do
                xdotool mousemove_relative -- $((dx < 0 ? -1 : 1)) 0
                sleep 0.03
            done
            xdotool mouseup 1
            pause
            ;;
        pick)
            place=$(fact picture | awk -v at="$value" '{ split(at, s, ","); printf "%d %d", $1 + s[1] * ($3 - $1), $2 + s[2] * ($4 - $2) }')
            click_at $place
            ;;
        key) xdotool key "$value"; pause ;;
        type) xdotool type --delay 60 "$value"; pause ;;
        until) until_fact "${value%%=*}" "${value#*=}" || fail "never: $value" ;;
        keep) pause; cp "$facts" "$folder/$value" ;;
        shot) pause; command -v import >/dev/null && import -window root "$folder/$value" ;;
        drop) "$DROP_FILES" "$window" "$value" || fail "not taken: $value"; pause ;;
        run) eval "$value" ;;
        wait) sleep "$value" ;;
    esac
done
xdotool key ctrl+q
# Edits that no file holds are asked about.
for _ in $(seq 600); do
    kill -0 "$inspector" 2>/dev/null || break
    if [ -n "$(fact "button Discard them")" ]; then
        pause # a popup finds its place in its first frames
        click_at $(middle "button Discard them")
    fi
    sleep 0.1
done
wait "$inspector"
