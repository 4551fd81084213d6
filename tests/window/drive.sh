#!/usr/bin/env bash
# drive.sh FOLDER ACTION... -- DEMO ARGUMENT...
# Runs the demo in a window under Xvfb and plays a user: key:NAME, drag:DX,DY, at:X,Y (the mouse), click:X,Y,
# dragat:X,Y,DX,DY, throw:X,Y,DX,DY (a drag that is let go in motion), down:KEY, up:KEY, log:SECONDS,TEXT (waits, at most
# so long, until the demo has said that), shot (F12, and waits for the file), pixel:SECONDS (F8 until a measured pixel is
# written, at most so long), run:COMMAND, wait:SECONDS, drop:FILE (with the program $DROP_FILES), other:SECONDS (shots
# until one differs from the last, at most so long), settle:SECONDS (shots until one is as the last), filled:SECONDS
# (waits, at most so long, until the window's title no longer says that maps are being filled). Shots lie in FOLDER
# as shot_1.png and so on. Ends with the demo's own exit status, after Escape.
set -u
screen=1024x768
. "$(dirname "${BASH_SOURCE[0]}")/under_xvfb.sh"

"$@" --output-folder "$folder" 2> >(tee "$folder/log" >&2) &
demo=$!
window=$(timeout 60 xdotool search --sync --onlyvisible --name Rowland | head -n 1)
xdotool windowfocus --sync "$window"

taken=0
shots=0
# Has the demo write a screenshot, and says where it is.
take() {
    local file
    file="$folder/$(printf 'screenshot_%04d.png' "$taken")"
    taken=$((taken + 1))
    xdotool key F12
    for _ in $(seq 1200); do
        [ -f "$file" ] && break
        sleep 0.05
    done
    taken_file=$file
}
# What was taken last is the test's next shot.
keep() {
    shots=$((shots + 1))
    mv "$taken_file" "$folder/shot_$shots.png"
}
shot() {
    take
    keep
}
# Shots until one differs from the last, for at most so many seconds; the last one counts.
other() {
    local before="$folder/shot_$shots.png" end=$((SECONDS + $1))
    while take && cmp -s "$taken_file" "$before" && [ "$SECONDS" -lt "$end" ]; do
        sleep 0.1
    done
    keep
}
# Shots until one is as the last, for at most so many seconds: nothing moves any more.
settle() {
    local before="$folder/settling.png" end=$((SECONDS + $1))
    take
    while [ "$SECONDS" -lt "$end" ]; do
        mv "$taken_file" "$before"
        sleep 0.3
        take
        cmp -s "$taken_file" "$before" && break
    done
    keep
}
pixels=0
# Has the demo write the pixel under the mouse once it is measured.
pixel() {
    local file end=$((SECONDS + $1))
    file="$folder/$(printf 'pixel_%04d.json' "$pixels")"
    pixels=$((pixels + 1))
    while [ ! -f "$file" ] && [ "$SECONDS" -lt "$end" ]; do
        xdotool key F8
        sleep 0.3
    done
    # What was asked for meanwhile is written, too.
    sleep 1
    while [ -f "$folder/$(printf 'pixel_%04d.json' "$pixels")" ]; do pixels=$((pixels + 1)); done
}
press() {
    xdotool mousemove --window "$window" "${1%%,*}" "${1#*,}"
    sleep 0.1
    xdotool mousedown 1
    sleep 0.1
}
throw() {
    local x y dx dy
    IFS=, read -r x y dx dy <<<"$1"
    press "$x,$y"
    # Longer than a frame takes, so that one of them ends in motion.
    for _ in $(seq 30); do
        xdotool mousemove_relative -- $((dx / 30)) $((dy / 30))
        sleep 0.02
    done
    xdotool mouseup 1
}
await() {
    local end=$((SECONDS + ${1%%,*}))
    until grep -qF -- "${1#*,}" "$folder/log" || [ "$SECONDS" -ge "$end" ]; do
        sleep 0.2
    done
}
filled() {
    local end=$((SECONDS + $1)) title
    sleep 0.6 # the title is renewed every half a second
    while title=$(xdotool getwindowname "$window") && [ "$SECONDS" -lt "$end" ]; do
        [[ "$title" == *" ms a frame"* && "$title" != *"filling maps"* ]] && break
        sleep 0.2
    done
}
# The first picture tells that the demo is drawing; it is not one of the test's.
take

for action in "${actions[@]}"; do
    what=${action%%:*}
    value=${action#*:}
    case "$what" in
        key) xdotool key "$value" ;;
        drag)
            xdotool mousemove --window "$window" 100 100
            sleep 0.1
            xdotool mousedown 1
            sleep 0.1
            xdotool mousemove_relative -- "${value%,*}" "${value#*,}"
            sleep 0.1
            xdotool mouseup 1
            ;;
        at) xdotool mousemove --window "$window" "${value%%,*}" "${value#*,}" ;;
        click)
            press "$value"
            xdotool mouseup 1
            ;;
        dragat)
            IFS=, read -r x y dx dy <<<"$value"
            press "$x,$y"
            xdotool mousemove_relative -- "$dx" "$dy"
            sleep 0.1
            xdotool mouseup 1
            ;;
        throw) throw "$value" ;;
        down) xdotool keydown "$value" ;;
        up) xdotool keyup "$value" ;;
        log) await "$value" ;;
        shot) shot ;;
        pixel) pixel "$value" ;;
        other) other "$value" ;;
        settle) settle "$value" ;;
        filled) filled "$value" ;;
        wait) sleep "$value" ;;
        drop) "$DROP_FILES" "$window" "$value" || echo "drive.sh: $value was not taken" >&2 ;;
        run) eval "$value" ;;
    esac
    sleep 0.1
done
xdotool key Escape
wait "$demo"
