#!/usr/bin/env bash
# drive.sh FOLDER ACTION... -- DEMO ARGUMENT...
# Runs the demo in a window under Xvfb and plays a user: key:NAME, drag:DX,DY, shot (F12, and waits for the file),
# run:COMMAND, wait:SECONDS, other:SECONDS (shots until one differs from the last, at most so long). Shots lie in FOLDER
# as shot_1.png and so on. Ends with the demo's own exit status, after Escape.
set -u
folder=$1
shift
actions=()
while [ "$1" != -- ]; do
    actions+=("$1")
    shift
done
shift

if [ -z "${ROWLAND_INSIDE_XVFB:-}" ]; then
    ROWLAND_INSIDE_XVFB=1 exec xvfb-run -a -s "-screen 0 800x600x24" bash "$0" "$folder" "${actions[@]}" -- "$@"
fi

"$@" --output-folder "$folder" &
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
    for _ in $(seq 400); do
        [ -f "$file" ] && break
        sleep 0.05
    done
    taken_file=$file
}
shot() {
    take
    shots=$((shots + 1))
    mv "$taken_file" "$folder/shot_$shots.png"
}
# Shots until one differs from the last, for at most so many seconds; the last one counts.
other() {
    local before="$folder/shot_$shots.png" end=$((SECONDS + $1))
    while take && cmp -s "$taken_file" "$before" && [ "$SECONDS" -lt "$end" ]; do
        sleep 0.1
    done
    shots=$((shots + 1))
    mv "$taken_file" "$folder/shot_$shots.png"
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
        shot) shot ;;
        other) other "$value" ;;
        wait) sleep "$value" ;;
        run) eval "$value" ;;
    esac
    sleep 0.1
done
xdotool key Escape
wait "$demo"
